"""M_b,Rd of beams that no slab holds, by their moment diagram in each combination, EN 1993-1-1:2005, 6.3.2.3.

Loads stand on the top flange. A response to an earthquake has no sign: its magnitudes are added to those of the static
moments at every place, which gives the least C1.

A beam that chevrons or V braces meet is two members, and the braces do not hold it sideways: each half has the length
of the whole, a uniform moment, and its own loads twice, which is on the safe side.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from edesign.codes.ec3.buckling import IMPERFECTION
from edesign.codes.ec3.lateral_torsional import buckling_moments, quarter_moments, rolled_curve
from edesign.project.building.building import Steel
from edesign.space.analysis.bracing import Bracing
from edesign.space.analysis.effects import Effects
from edesign.space.analysis.live_load_reduction import whole_case
from edesign.space.structure.frame import SpaceFrame

_M_Y = 4


@dataclass(frozen=True)
class FreeBeamMoments:
    """M_b,Rd of beams that no slab holds, under combinations.

    Attributes:
        members: (n_beams,) numbers of the beams.
        loads: (n_cases, n_beams) sum of P sin2(pi x / L) of the loads on a beam, N, downwards.
        M_b_Rd: (n_beams, n_combinations) N m.
        span: (n_beams,) between restraints, m.
        uniform: (n_beams,) whether a uniform moment is taken for the diagram.
    """

    members: np.ndarray
    loads: np.ndarray
    M_b_Rd: np.ndarray
    span: np.ndarray
    uniform: np.ndarray


class FreeBeams:
    """Finds M_b,Rd of beams with lateral restraints at their ends alone, whatever sections they have.

    Args:
        materials: of the building, by name.
        gamma_M1: partial factor.
        bracing: that meets some of the beams.

    Attributes:
        members: numbers of the beams.
    """

    def __init__(self, frame: SpaceFrame, materials: Mapping[str, Steel], gamma_M1: float, bracing: Bracing) -> None:
        self.members = np.array([k for k, member in enumerate(frame.members) if member.kind == "beam"], dtype=int)
        self._section, self._materials, self._gamma_M1 = frame.section, materials, gamma_M1
        self._place = np.full(len(frame.members), -1)
        self._place[self.members] = np.arange(self.members.size)
        self._length = bracing.span[self.members]
        self._half = np.isin(self.members, bracing.halves)

    def resistances(
        self,
        frame: SpaceFrame,
        effects: Effects,
        spectral: np.ndarray,
        static_factors: np.ndarray,
        spectral_factors: np.ndarray,
        M_Rk: np.ndarray,
    ) -> FreeBeamMoments:
        """Return M_b,Rd of the beams under combinations.

        Args:
            frame: with the sections of the members, and the load cases.
            spectral: (d, n_members, n_stations, 6) magnitudes of the responses.
            static_factors: (k, n_cases) factors of the load cases in k combinations.
            spectral_factors: (k, d) factors of the responses in them.
            M_Rk: (n_beams,) W_y f_y, N m.

        Returns:
            M_b,Rd by combination and beam, with what it follows from.
        """
        steady = np.tensordot(static_factors, effects.static[..., _M_Y][:, self.members], 1)  # (k, beams, stations)
        alternating = np.tensordot(np.abs(spectral_factors), spectral[..., _M_Y][:, self.members], 1)
        largest = (np.abs(steady) + alternating).max(axis=2)
        pairs, of_members = frame.sections
        of = np.array([self._properties(*pair) for pair in pairs])[of_members[self.members]].T
        euler, squared = of[0] / self._length**2, of[1] + of[2] * self._length**2
        loads = self._loads(frame, effects)
        tipping = loads * self._length * of[3] / math.pi**2  # (cases, beams)
        found = buckling_moments(
            np.broadcast_to(M_Rk, largest.shape),
            largest,
            np.where(self._half, largest, quarter_moments(steady, alternating)),
            np.maximum(static_factors @ tipping, 0.0),
            euler,
            squared,
            of[4],
        )
        hollow = of[5] > 0.0  # they do not buckle sideways
        M_b_Rd = np.where(hollow, M_Rk, found).T / self._gamma_M1
        return FreeBeamMoments(self.members, loads, M_b_Rd, self._length, self._half)

    def _properties(self, name: str, material: str) -> list[float]:
        """pi2 E I_z; I_w / I_z; G I_t / (pi2 E I_z); z_g; alpha_LT; whether the section is hollow."""
        s, steel = self._section(name), self._materials[material]
        bending = math.pi**2 * steel.E * s.I_z
        torsion = steel.E / (2.0 * (1.0 + steel.nu)) * s.I_t
        imperfection = IMPERFECTION[rolled_curve(s.h, s.b, not s.welded)] if s.kind == "I" else 0.0
        return [bending, s.I_w / s.I_z, torsion / bending, 0.5 * s.h, imperfection, float(s.kind != "I")]

    def _loads(self, frame: SpaceFrame, effects: Effects) -> np.ndarray:
        """Return the sum of P sin2(pi x / L) on each beam, (n_cases, n_beams) N, downwards; half of a uniform load."""
        found = np.zeros((len(effects.cases), self.members.size))
        for number, name in enumerate(effects.cases):
            case = frame.cases.get(whole_case(name))
            if case is None:
                continue  # of sway imperfections, without loads on beams
            found[number] = -0.5 * case.uniform[self.members, 2] * self._length
            of = self._place[case.point_member]
            shape = np.where(self._half[of], 2.0, np.sin(math.pi * case.point_position) ** 2)
            np.add.at(found[number], of[of >= 0], (-case.point_force[:, 2] * shape)[of >= 0])
        return found
