"""Deflections of beams between their ends, EN 1990:2002+A1, A1.4.3, and EN 1993-1-1:2005, 7.2.1.

A deflection is that from the chord between the ends of the span: of a beam that braces meet in its middle, between the
columns. It follows from the moments at the ends and the loads on the span, with shear deformation. Floors hold beams
sideways, and nothing is cambered.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.codes.en1990.combinations import Combination
from edesign.codes.rule_check import RuleCheck, at_most, first_of_largest
from edesign.core.space import PROPERTIES
from edesign.project.building.design import BeamDeflections
from edesign.space.analysis.response import StaticResponse
from edesign.space.structure.frame import LoadCase, SpaceFrame

LIMITED = "EN 1993-1-1, 7.2.1"
"""Clause of the criteria on deflections."""
PLACES = np.linspace(0.0, 1.0, 25)
"""Where deflections are taken, as fractions of the length: the largest is missed by (pi / 48)^2 / 2 = 0.2 % at most."""
_M_Y = 4


@dataclass(frozen=True)
class Deflections:
    """The largest deflections of beams in characteristic combinations, without sign.

    Attributes:
        members: (n_beams,) numbers of the beams.
        span: (n_beams,) m; of the parts of a beam that braces meet, that of the whole.
        total: (n_beams,) under permanent and variable loads, m.
        live: (n_beams,) under the variable loads alone, m.
        combination: (n_beams,) which of the characteristic combinations gives `total`, from 0.
    """

    members: np.ndarray
    span: np.ndarray
    total: np.ndarray
    live: np.ndarray
    combination: np.ndarray


class DeflectionAnalysis:
    """Finds the deflections of beams, whatever sections they have; what sections do not change is prepared once.

    Args:
        cases: load cases by name, permanent ones first; their uniform loads may change with the sections.
        permanent: names of the permanent cases.
        combinations: characteristic ones.
    """

    def __init__(
        self,
        frame: SpaceFrame,
        cases: Mapping[str, LoadCase],
        permanent: Sequence[str],
        combinations: Sequence[Combination],
    ) -> None:
        self.members = np.array([k for k, member in enumerate(frame.members) if member.kind == "beam"], dtype=int)
        self._length = frame.length[self.members]
        self._cases = tuple(cases)
        self._factors = np.array([[row.static.get(case, 0.0) for case in cases] for row in combinations])
        self._variable = self._factors * ~np.isin(self._cases, permanent)
        place = np.full(len(frame.members), -1)
        place[self.members] = np.arange(self.members.size)
        shape = len(cases), self.members.size, PLACES.size
        self._bending, self._moment = np.zeros(shape), np.zeros(shape)  # of point loads: E I v, and M of pinned ends
        for number, case in enumerate(cases.values()):
            on_beams = place[case.point_member] >= 0
            of, P = place[case.point_member[on_beams]], -case.point_force[on_beams, 2]
            bending, moment = under_point_loads(P, case.point_position[on_beams], self._length[of])
            np.add.at(self._bending[number], of, bending)
            np.add.at(self._moment[number], of, moment)
        self._spans(frame)

    def _spans(self, frame: SpaceFrame) -> None:
        """Keep the nodes at the ends of each span, and where each beam begins and ends in it."""
        parts: dict[str, list[int]] = {}
        for k, number in enumerate(self.members):
            if frame.members[number].beam:
                parts.setdefault(frame.members[number].beam, []).append(k)
        start, end = (nodes_of[self.members].copy() for nodes_of in frame.ends)
        self.span = self._length.copy()
        self._share = np.stack([np.zeros(self.span.size), np.ones(self.span.size)])
        self._nodes = np.stack([start, end])
        self._chord = self._nodes.copy()
        for beam in parts.values():
            self.span[beam] = self._length[beam].sum()
            self._chord[:, beam] = [[start[beam[0]]] * len(beam), [end[beam[-1]]] * len(beam)]
            self._share[:, beam] = np.transpose([frame.members[self.members[k]].part for k in beam])

    def deflections(self, frame: SpaceFrame, properties: np.ndarray, static: StaticResponse) -> Deflections:
        """Return the deflections.

        Args:
            frame: with the load cases that were given, and their uniform loads.
            properties: (n_members, 8) in the order of `PROPERTIES`.
            static: effects of the load cases.
        """
        of, L = dict(zip(PROPERTIES, properties[self.members].T, strict=True)), self._length
        EI, GA = of["E"] * of["I_y"], of["G"] * of["A_z"]
        per_GA = np.divide(1.0, GA, out=np.zeros_like(GA), where=GA > 0.0)
        w = -np.stack([frame.cases[case].uniform[self.members, 2] for case in self._cases])
        sagging = -static.internal[:, self.members][:, :, [0, -1], _M_Y]
        x = PLACES
        bending = self._bending + (w * L**4 / 24.0)[:, :, None] * (x - 2.0 * x**3 + x**4)
        shear = self._moment + (w * L**2 / 2.0)[:, :, None] * (x - x**2)
        ends = sagging[:, :, :1] * (2.0 * x - 3.0 * x**2 + x**3) + sagging[:, :, 1:] * (x - x**3)
        each = (bending + (L**2 / 6.0)[:, None] * ends) / EI[:, None] + shear * per_GA[:, None]
        down = -static.displacements[:, :, 2]
        chord, ends_of = down[:, self._chord], down[:, self._nodes]  # (cases, 2, beams)
        apart = ends_of - chord[:, :1] * (1.0 - self._share) - chord[:, 1:] * self._share
        each += apart[:, 0, :, None] * (1.0 - x) + apart[:, 1, :, None] * x
        total = np.abs(np.tensordot(self._factors, each, 1)).max(axis=2)
        live = np.abs(np.tensordot(self._variable, each, 1)).max(axis=2)
        return Deflections(self.members, self.span, total.max(axis=0), live.max(axis=0), total.argmax(axis=0))


def deflection_criteria(deflections: Deflections, limits: BeamDeflections, names: Sequence[str]) -> list[RuleCheck]:
    """Return whether beams deflect no more than the file allows; nothing where it sets no limit.

    Args:
        limits: shares of the span.
        names: of all members.

    Source: EN 1993-1-1:2005, 7.2.1(1)B: limits are those of the National Annex and of the client.
    """
    found = []
    for text, limit, of in (
        ("all loads", limits.total, deflections.total),
        ("variable loads alone", limits.live, deflections.live),
    ):
        if limit is not None and of.size:
            share = of / deflections.span
            worst = first_of_largest(share)
            name = f"deflection of beams over span, characteristic, {text}"
            found.append(at_most(LIMITED, name, limit, float(share[worst]), names[deflections.members[worst]]))
    return found


def under_point_loads(P: np.ndarray, position: np.ndarray, L: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return E I times the deflection by bending, and the moment, of beams on hinges, (n_loads, n_places) N m3 and N m.

    v = P L3 / 6EI b x (1 - b2 - x2) up to the load, at a = 1 - b of the length, and from the other end beyond it.

    Args:
        P: (n_loads,) N, downwards.
        position: (n_loads,) a as a fraction of the length.
        L: (n_loads,) length, m.
    """
    a = position[:, None]
    x = np.where(a >= PLACES, PLACES, 1.0 - PLACES)
    b = np.where(a >= PLACES, 1.0 - a, a)
    bending = (P * L**3 / 6.0)[:, None] * b * x * (1.0 - b**2 - x**2)
    return bending, (P * L)[:, None] * b * x
