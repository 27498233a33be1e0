"""What a hazard offers as spectra, whatever its code."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Protocol

from edesign.codes.spectrum import DesignOrdinates, Spectrum
from edesign.errors import InputError
from edesign.project.actions.hazard_base import YEAR, Hazard
from edesign.project.reading.problems import unknown_name

Check = tuple[tuple[str, ...], Callable[[], object]]
"""A place below `hazard`, and what raises an `InputError` if something is wrong there."""


class SeismicAction(Protocol):
    """Spectra of a hazard.

    A level of None is what records are fitted to: the action of which all levels are multiples, or the only level of an
    action whose levels have spectra of their own.
    """

    def checks(self) -> Iterator[Check]:
        """Yield what only the code can check, in the order in which it is reported."""

    def elastic(self, level: str | None) -> Spectrum:
        """Return the horizontal elastic spectrum.

        Args:
            level: its name in the hazard; None: see the class.

        Returns:
            Spectrum, m/s2 over s.
        """

    def vertical(self, level: str | None) -> Spectrum:
        """Return the vertical elastic spectrum.

        Args:
            level: its name in the hazard; None: see the class.

        Returns:
            Spectrum, m/s2 over s.

        Raises:
            InputError: the code has none here.
        """

    def design(self, level: str | None, q: float | None) -> DesignOrdinates | None:
        """Return the horizontal spectrum reduced by q.

        Args:
            level: its name in the hazard; None: see the class.
            q: behaviour factor; None takes what the hazard says.

        Returns:
            The ordinates; None: neither `q` nor the hazard says a behaviour factor.

        Raises:
            InputError: the code has no such thing.
        """

    def vertical_design(self, level: str | None, q: float) -> DesignOrdinates:
        """Return the vertical spectrum reduced by q.

        Args:
            level: its name in the hazard; None: see the class.
            q: behaviour factor of the vertical component.

        Returns:
            The ordinates.

        Raises:
            InputError: the code has no such thing.
        """

    def factor(self, level: str) -> float:
        """Return the spectrum of a level over that of None; 1 where levels have spectra of their own.

        Args:
            level: its name in the hazard.

        Returns:
            The factor, dimensionless.
        """

    def probability(self, level: str) -> float | None:
        """Return the probability of exceedance of a level in 50 years; None where it is not known.

        Args:
            level: its name in the hazard.
        """

    def facts(self, level: str) -> str:
        """Return how rare a level is and what it follows from, for people; empty where nothing is known.

        Args:
            level: its name in the hazard.

        Returns:
            Text for people.
        """


def check_level(hazard: Hazard, level: str) -> None:
    """Check that there is a level.

    Args:
        hazard: block of the project.

    Raises:
        InputError: there is not.
    """
    if level not in hazard.levels:
        raise InputError(f"hazard.levels: {unknown_name('level', level, hazard.levels)}")


def in_50_years(probability: float | None, return_period: float | None) -> float | None:
    """Return a probability in 50 years that a level states, or that of its return period; None: it states neither.

    Args:
        probability: of exceedance in 50 years.
        return_period: T_R, s.

    Source: EN 1998-1:2004, 2.1(1)P Note 4 and NTC 2018, Eq. 3.2.0, of 50 years: 1 - exp(-50 years / T_R).
    """
    if probability is not None:
        return probability
    return None if return_period is None else -math.expm1(-50.0 * YEAR / return_period)
