"""Effects of combinations of actions on members."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from edesign.codes.en1990.combinations import Combination
from edesign.space.analysis.response import SeismicResponse, StaticResponse
from edesign.space.analysis.storeys import Storeys
from edesign.space.structure.frame import AXES, Axis, SpaceFrame
from edesign.space.structure.model import TENSION_ONLY_SHARE


@dataclass(frozen=True)
class Effects:
    """Internal forces of load cases and of the seismic action in both directions, with its second-order effects.

    Attributes:
        cases: (n_cases,) names.
        static: (n_cases, n_members, n_stations, 6) N, V_y, V_z, T, M_y, M_z, with sign; N tension positive.
        seismic: (2, n_members, n_stations, 6) along x and y, without sign.
    """

    cases: tuple[str, ...]
    static: np.ndarray
    seismic: np.ndarray

    def of_static(self, combination: Combination) -> np.ndarray:
        """Return the static part of a combination, (n_members, n_stations, 6).

        Args:
            combination: of load cases and responses.
        """
        acting = [(self.numbers[case], factor) for case, factor in combination.static.items() if case in self.numbers]
        found = np.zeros(self.static.shape[1:])
        for number, factor in sorted(acting):  # few of hundreds of sway imperfections
            found += factor * self.static[number]
        return found

    @cached_property
    def numbers(self) -> Mapping[str, int]:
        """The number of each case by its name."""
        return {name: number for number, name in enumerate(self.cases)}

    def static_factors(self, combinations: Sequence[Combination]) -> np.ndarray:
        """Return the factors of the load cases in combinations, (n_combinations, n_cases).

        Args:
            combinations: of load cases and responses.
        """
        found = np.zeros((len(combinations), len(self.cases)))
        for row, combination in zip(found, combinations, strict=True):
            for case, factor in combination.static.items():
                if case in self.numbers:
                    row[self.numbers[case]] = factor
        return found

    def of_seismic(self, combination: Combination) -> np.ndarray:
        """Return the magnitude of the seismic part of a combination, (n_members, n_stations, 6).

        Args:
            combination: of load cases and responses.
        """
        factors = np.abs(combination.seismic[:2])
        if combination.directions == "srss":
            return np.asarray(np.sqrt(np.tensordot(factors**2, self.seismic**2, 1)))
        return np.asarray(np.tensordot(factors, self.seismic, 1))


def effects(
    frame: SpaceFrame,
    static: StaticResponse,
    seismic: Mapping[Axis, SeismicResponse],
    storeys: Mapping[Axis, Storeys],
) -> Effects:
    """Return the effects on members; those of the seismic action grow by the factor of the member's storey.

    A brace that does not count in compression carries alone what the model divides between two.

    Args:
        static: effects of the load cases.
        seismic: effects of the seismic action, by direction.
        storeys: with the factors for second-order effects.

    Source: EN 1998-1:2004, 4.4.2.2(3), 6.7.2(2)P.
    """
    alone = np.where(frame.in_compression, 1.0, 1.0 / TENSION_ONLY_SHARE)
    grown = [
        seismic[axis].internal * (alone * storeys[axis].amplification[frame.storey])[:, None, None] for axis in AXES
    ]
    return Effects(static.names, static.internal, np.stack(grown))


def largest(effects: Effects, combinations: Sequence[Combination]) -> np.ndarray:
    """Return the largest magnitude of each internal force over combinations, (n_members, n_stations, 6).

    Args:
        combinations: of load cases and responses.
    """
    found = np.zeros(effects.static.shape[1:])
    for combination in distinct(combinations):
        np.maximum(found, np.abs(effects.of_static(combination)) + effects.of_seismic(combination), out=found)
    return found


def distinct(combinations: Sequence[Combination]) -> list[Combination]:
    """Return combinations of which no two differ in signs of the seismic action alone."""
    alike = {
        (tuple(sorted(row.static.items())), tuple(np.abs(row.seismic)), row.directions): row for row in combinations
    }
    return list(alike.values())
