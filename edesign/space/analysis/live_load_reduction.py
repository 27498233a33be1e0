"""Reduced imposed loads in the checks of members, EN 1991-1-1:2002, 6.3.1.2(10) and (11).

Beams: alpha_A by the area of floor whose load they carry, on all effects of the imposed load. Columns: alpha_n by the
loaded storeys above, on N, which is the total of these storeys; moments and shears come from the floors at their ends.
Neither where the imposed load accompanies another action, or acts with psi_2: psi has reduced it already (3.3.1(2)P).
The sway imperfections are those of the whole loads.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from edesign.codes.ec8.national import Psi
from edesign.codes.en1990.combinations import Combination
from edesign.codes.en1991.imposed import REDUCED, alpha_A, alpha_n
from edesign.project.building.building import Building
from edesign.project.building.layout import Panel, edges
from edesign.project.building.names import BeamPlace
from edesign.project.building.places import panels_in
from edesign.space.analysis.effects import Effects
from edesign.space.structure.area_loads import bay_shares
from edesign.space.structure.frame import LoadCase, SpaceFrame
from edesign.space.structure.load_cases import members_of, on_nodes

NOTE = (
    "imposed loads that lead a persistent combination are reduced by alpha_A in beams and alpha_n in columns in their "
    "recommended forms, Eqs. 6.1 and 6.2 of EN 1991-1-1; the National Annex may have others"
)
_N = 0


class LiveLoadReduction:
    """Reduces the imposed loads of a building by members; what sections do not change is prepared once.

    Args:
        psi: factors by category.

    Attributes:
        factors: by the names of the load cases that may be reduced, (n_members, 6) of each internal force.
    """

    def __init__(
        self, building: Building, frame: SpaceFrame, cases: Mapping[str, LoadCase], psi: Mapping[str, Psi]
    ) -> None:
        reduced = {name: case for name, case in cases.items() if case.category in REDUCED}
        self.factors = {
            name: _factors(building, frame, case, psi[case.category].psi_0) for name, case in reduced.items()
        }

    def rows(self, combinations: Sequence[Combination]) -> tuple[Combination, ...]:
        """Return persistent combinations with reduced imposed loads in the place of those that lead.

        Args:
            combinations: of load cases and responses.
        """
        return tuple(self._row(row) for row in combinations)

    def _row(self, row: Combination) -> Combination:
        name, static = row.name, dict(row.static)
        for case in row.leading:
            if case in self.factors:
                static[_reduced(case)] = static.pop(case)
                name = re.sub(rf"\b{case}\b", _reduced(case), name)
        return replace(row, name=name, static=static)

    def added(self, effects: Effects) -> Effects:
        """Return effects with those of the reduced imposed loads as cases of their own."""
        if not self.factors:
            return effects
        more = [effects.static[effects.cases.index(case)] * of[:, None] for case, of in self.factors.items()]
        return replace(
            effects,
            cases=(*effects.cases, *map(_reduced, self.factors)),
            static=np.concatenate([effects.static, np.stack(more)]),
        )


_ALPHA = "alpha "


def _reduced(case: str) -> str:
    return _ALPHA + case


def whole_case(case: str) -> str:
    """Return the name of the load case that a reduced one is of, or its own name."""
    return case.removeprefix(_ALPHA)


def _factors(building: Building, frame: SpaceFrame, case: LoadCase, psi_0: float) -> np.ndarray:
    """Return the factor of each internal force of each member under a load case, (n_members, 6)."""
    found = np.ones((len(frame.members), 6))
    numbers = {member.name: number for number, member in enumerate(frame.members)}
    for place, area in loaded_areas(building, case.category).items():
        for number in members_of(place, numbers):
            found[number] = alpha_A(area, case.category, psi_0)
    loaded = on_nodes(frame, case)[:, 2] < 0.0
    start, end = np.round(frame.coordinates[:, :2], 6), frame.ends[1]
    for number in frame.columns:
        above = (start == start[end[number]]).all(axis=1) & (frame.level_of_nodes >= frame.members[number].storey)
        storeys = np.unique(frame.level_of_nodes[above & loaded]).size
        found[number, _N] = alpha_n(storeys, case.category, psi_0)
    return found


def loaded_areas(building: Building, category: str) -> dict[BeamPlace, float]:
    """Return the area of floor whose imposed load of a category comes to each beam, m2.

    Where several loads lie on one bay it counts once, by the one that brings most of it to the beam. Loads a length
    bring no area.
    """
    widths_x, widths_y = building.widths("x"), building.widths("y")
    areas: dict[tuple[BeamPlace, Panel], float] = {}
    for load in building.loads.areas:
        if load.Q == 0.0 or load.category != category:
            continue
        wanted = panels_in(load.bays, len(widths_x), len(widths_y))
        for floor in load.floors.numbers(1, building.n_storeys):
            for panel in wanted & building.layout.floors[floor]:
                width_x, width_y = widths_x[panel[0] - 1], widths_y[panel[1] - 1]
                of = bay_shares(1.0, width_x, width_y, load.spans, load.secondary_beams)
                for place in edges(panel, floor, building.axes):
                    area = of.along_x.total(width_x) if place.along == "x" else of.along_y.total(width_y)
                    areas[place, panel] = max(areas.get((place, panel), 0.0), area)
    found: dict[BeamPlace, float] = {}
    for (place, _), area in areas.items():
        if area > 0.0:
            found[place] = found.get(place, 0.0) + area
    return found
