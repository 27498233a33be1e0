"""The combinations of actions of a building: persistent, seismic, characteristic ones, and those of local actions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from edesign.codes.ec8.national import NationalParameters
from edesign.codes.en1990.combinations import Combination, characteristic, fundamental, seismic
from edesign.project.building.building import Building
from edesign.project.building.design import Design
from edesign.space.analysis.actions import (
    action_factors_of,
    patterns_of,
    psi_of,
    relieving_cases,
    stated_combinations,
)
from edesign.space.analysis.bracing import Bracing
from edesign.space.analysis.vertical_component import vertical_combinations
from edesign.space.analysis.yielded_braces import yielded_combinations
from edesign.space.file_places import telling_place
from edesign.space.structure.frame import LoadCase
from edesign.space.structure.load_cases import NON_STRUCTURAL


@dataclass(frozen=True)
class BuildingCombinations:
    """The combinations of a building.

    Attributes:
        fundamental: of persistent situations, with those that the file states.
        seismic: with the horizontal components.
        characteristic: of serviceability.
        yielded: of beams beside buckled braces.
        vertical: of members that the vertical component concerns.
    """

    fundamental: tuple[Combination, ...]
    seismic: tuple[Combination, ...]
    characteristic: tuple[Combination, ...]
    yielded: tuple[Combination, ...]
    vertical: tuple[Combination, ...]


def building_combinations(
    building: Building,
    design: Design,
    national: NationalParameters,
    cases: Mapping[str, LoadCase],
    bracing: Bracing,
    with_vertical: bool,
    restrained: Sequence[int] = (),
) -> BuildingCombinations:
    """Return the combinations of a building.

    Args:
        design: its block `design`, with what it leaves to the country.
        cases: load cases by name, permanent ones joined.
        with_vertical: whether the vertical component concerns some members.
        restrained: numbers of buckling-restrained braces.

    Raises:
        InputError: psi factors of a category are not known.
    """
    categories = {name: case.category for name, case in cases.items()}
    psi = psi_of(building, national)
    directions = "srss" if design.directions == "srss" else "30 %"
    asked, factors = design.fundamental, action_factors_of(design, national)
    partly = relieving_cases(cases), patterns_of(cases, building.loads.pattern)
    apart = [name for name in categories if name == NON_STRUCTURAL]
    with telling_place(building, "loads"):
        persistent = fundamental(categories, psi, factors, asked.expression, asked.favourable, *partly, apart)
    in_earthquakes = seismic(categories, psi, directions, relieving=partly[0])
    with_E_z = seismic(categories, psi, directions, True, partly[0]) if with_vertical else ()
    return BuildingCombinations(
        fundamental=persistent + stated_combinations(design, cases),
        seismic=in_earthquakes,
        characteristic=characteristic(categories, psi, False, *partly),
        yielded=yielded_combinations(in_earthquakes[0], bracing, design, restrained),
        vertical=vertical_combinations(with_E_z),
    )
