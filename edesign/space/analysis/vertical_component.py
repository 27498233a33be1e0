"""The vertical component of the seismic action on long beams and cantilevers, EN 1998-1:2004, 4.3.3.5.2.

It concerns single members, so that each is a model of its own (4.3.3.5.2(2)): its masses, those of G + psi_2 Q, have
the acceleration of the plateau of the vertical design spectrum, whatever its period. So E_z is a share of the effects
of gravity, S_vd / g. The columns below have the moments of the same share, and the reactions of these beams.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from edesign.codes.ec8 import VerticalSpectrum
from edesign.codes.ec8.action.design import LARGEST_VERTICAL_Q, vertical_design_spectrum
from edesign.codes.ec8.analysis.directions import vertical_component_counts
from edesign.codes.en1990.combinations import Combination
from edesign.codes.ntc2018 import NtcDesignSpectrum, NtcVerticalSpectrum
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.space.analysis.bracing import joined_beams
from edesign.space.analysis.effects import Effects
from edesign.space.structure.frame import SpaceFrame

CASE = "E_z"
NAMED = 4  # spans in the note
N, V_Z = 0, 2  # places in internal forces


@dataclass(frozen=True)
class VerticalComponent:
    """The members that the vertical component concerns; sections do not change them.

    Attributes:
        beams: (n,) numbers of the beams.
        columns: (c,) numbers of the columns below their ends.
        from_ends: (c, 2, n) 1 where the start, or the end, of a beam stands on a column.
        a_vg: peak acceleration, m/s2.
        S_vd: of the plateau of the design spectrum, m/s2.
        spans: names of the spans and their lengths, for people.
    """

    beams: np.ndarray
    columns: np.ndarray
    from_ends: np.ndarray
    a_vg: float
    S_vd: float
    spans: tuple[str, ...]

    @property
    def members(self) -> np.ndarray:
        """Numbers of all members that are concerned."""
        return np.concatenate([self.beams, self.columns])

    @property
    def note(self) -> str:
        """Note on the vertical component for the engineer."""
        named = ", ".join(self.spans[:NAMED])
        of = named if len(self.spans) <= NAMED else f"{named} and {len(self.spans) - NAMED} more"
        return (
            f"the vertical component of the seismic action counts, a_vg = {self.a_vg / STANDARD_GRAVITY:.2f} g, "
            f"for {of}; E_z is {self.S_vd / STANDARD_GRAVITY:.2f} of their gravity (EN 1998-1, 4.3.3.5.2)"
        )

    def with_case(self, effects: Effects, gravity: Combination) -> Effects:
        """Return the effects with those of the vertical component as one more static case, downwards.

        Args:
            effects: of all actions.
            gravity: a seismic combination, whose loads of gravity have the masses.
        """
        own = self.S_vd / STANDARD_GRAVITY * effects.of_static(gravity)
        found = np.zeros((1, *own.shape))
        found[0, self.beams] = own[self.beams]
        found[0, self.columns] = own[self.columns]
        shear = np.abs(own[self.beams][:, [0, -1], V_Z]).T
        found[0, self.columns, :, N] = -np.tensordot(self.from_ends, shear, 2)[:, None]
        return Effects((*effects.cases, CASE), np.concatenate([effects.static, found]), effects.seismic)


def vertical_component(
    frame: SpaceFrame,
    elastic: VerticalSpectrum | NtcVerticalSpectrum,
    beta: float,
    counts: Callable[[float, float, float], bool] = vertical_component_counts,
) -> VerticalComponent | None:
    """Return the members that the vertical component concerns; None if there are none.

    Args:
        beta: lower bound factor of the design spectrum.
        counts: whether it counts for a member, by a_vg, span and length of a cantilever.

    Source: EN 1998-1:2004, 4.3.3.5.2(1)-(3); q = 1.5 (3.2.2.5(6)). NTC 2018, 7.2.2, and 7.3.1 with the same q.
    """
    a_vg = elastic.zero_period
    beams, spans, ends = [], [], []
    for run, length, cantilever in _spans(frame):
        if counts(a_vg, 0.0 if cantilever else length, length if cantilever else 0.0):
            beams += run
            first, last = (frame.members[number] for number in (run[0], run[-1]))
            spans.append(f"{first.name} ({length:g} m{', cantilever' if cantilever else ''})")
            ends += [(run[0], 0, first.start), (run[-1], 1, last.end)]
    if not beams:
        return None
    top = frame.ends[1][frame.columns]
    lines, tops = frame.coordinates[top, :2], frame.level_of_nodes[top]
    from_ends = np.zeros((frame.columns.size, 2, len(beams)))
    for number, side, node in ends:
        same = np.abs(lines - frame.coordinates[node, :2]).max(axis=1) < 1e-9 * frame.levels[-1]
        from_ends[same & (tops <= frame.level_of_nodes[node]), side, beams.index(number)] = 1.0
    below = from_ends.any(axis=(1, 2))
    reduced = (
        NtcDesignSpectrum(elastic, LARGEST_VERTICAL_Q)
        if isinstance(elastic, NtcVerticalSpectrum)
        else vertical_design_spectrum(elastic, beta=beta)
    )
    plateau = float(reduced.acceleration(elastic.corners["T_B"]))
    return VerticalComponent(np.array(beams), frame.columns[below], from_ends[below], a_vg, plateau, tuple(spans))


def vertical_combinations(rows: Sequence[Combination]) -> tuple[Combination, ...]:
    """Return seismic combinations with E_z as a static case, whose sign counts; those of E_x and E_y do not."""
    return tuple(
        replace(row, static={**row.static, CASE: row.seismic[2]}, seismic=(*row.seismic[:2], 0.0))
        for row in rows
        if row.seismic[0] > 0.0 and row.seismic[1] > 0.0
    )


def _spans(frame: SpaceFrame) -> Iterator[tuple[list[int], float, bool]]:
    """Yield the beams between columns, end to end, with their length, and whether they are a cantilever."""
    on_columns = {frame.members[number].end for number in frame.columns}
    crossing = np.bincount(np.concatenate(frame.ends), minlength=len(frame.node_names))
    for joined in joined_beams(frame):
        run: list[int] = []
        for number in joined:
            run.append(number)
            if frame.members[number].end in on_columns or number == joined[-1]:
                ends = frame.members[run[0]].start, frame.members[number].end
                free = [node for node in ends if node not in on_columns and crossing[node] == 1]
                yield run, float(frame.length[run].sum()), len(free) == 1
                run = []
