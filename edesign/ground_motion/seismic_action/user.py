"""The action as tables of the user."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

from edesign.codes.registry import find_code
from edesign.codes.spectrum import DesignOrdinates, Spectrum
from edesign.codes.tabulated import TabulatedSpectrum
from edesign.errors import InputError
from edesign.ground_motion.seismic_action.action import Check, check_level, in_50_years
from edesign.ground_motion.seismic_action.spectrum_file import read_spectrum
from edesign.project.actions.hazard import UserHazard
from edesign.project.actions.hazard_base import YEAR, level_of
from edesign.project.actions.spectrum_tables import SpectrumTable, SpectrumValues


@dataclass(frozen=True)
class UserAction:
    """Spectra of a hazard that is a table, or one for each level; the interface is `SeismicAction`."""

    hazard: UserHazard

    def checks(self) -> Iterator[Check]:
        """Yield the check of each table."""
        for keys, table in self.hazard.tables():
            yield tuple(map(str, keys)), partial(self._spectrum, table, 1.0, "")

    def elastic(self, level: str | None) -> TabulatedSpectrum:
        """Return the table of a level, or that of the action times its factor.

        Args:
            level: its name in the hazard.
        """
        if self.hazard.spectrum is not None:
            factor = 1.0 if level is None else self.factor(level)
            name = "spectrum of the user" if level is None else f"spectrum of the user, {level}: x {factor:.4g}"
            return self._spectrum(self.hazard.spectrum, factor, name)
        name = level_of(self.hazard, level)
        check_level(self.hazard, name)
        table = self.hazard.levels[name].spectrum
        assert table is not None, "check_hazard wants it"
        return self._spectrum(table, 1.0, f"spectrum of the user, {name}")

    def vertical(self, level: str | None) -> Spectrum:
        """Refuse a vertical spectrum.

        Args:
            level: its name in the hazard.

        Raises:
            InputError: always; a table is of the horizontal component.
        """
        raise InputError(
            "a spectrum of the user is that of the horizontal component; there is no vertical one [E-SPEC-03]"
        )

    def design(self, level: str | None, q: float | None) -> DesignOrdinates | None:
        """Refuse a behaviour factor; without one there is no design spectrum.

        Args:
            level: its name in the hazard.

        Raises:
            InputError: q is given; a table does not say how it is reduced.
        """
        if q is not None:
            raise InputError(
                "--q: a spectrum of the user does not say how it is reduced by a behaviour factor [E-SPEC-04]"
            )
        return None

    def vertical_design(self, level: str | None, q: float) -> DesignOrdinates:
        """Refuse a vertical spectrum.

        Args:
            level: its name in the hazard.
            q: behaviour factor.

        Raises:
            InputError: always; a table is of the horizontal component.
        """
        raise InputError(
            "a spectrum of the user is that of the horizontal component; there is no vertical one [E-SPEC-03]"
        )

    def factor(self, level: str) -> float:
        """Return the factor of a level on the spectrum of the action; 1 where levels have tables of their own.

        Args:
            level: its name in the hazard.
        """
        check_level(self.hazard, level)
        return self.hazard.levels[level].factor or 1.0

    def probability(self, level: str) -> float | None:
        """Return the probability of exceedance of a level in 50 years; None where the file does not state it.

        Args:
            level: its name in the hazard.
        """
        given = self.hazard.levels[level]
        return in_50_years(given.probability, given.return_period)

    def facts(self, level: str) -> str:
        """Return how rare a level is, if the file says so, and its factor.

        Args:
            level: its name in the hazard.
        """
        given = self.hazard.levels[level]
        parts = [f"{100 * given.probability:g} % in 50 years"] if given.probability is not None else []
        parts += [f"T_R = {given.return_period / YEAR:.4g} years"] if given.return_period is not None else []
        parts += [f"factor {given.factor:g}"] if given.factor is not None else []
        return ", ".join(parts)

    def _spectrum(self, table: SpectrumTable, factor: float, label: str) -> TabulatedSpectrum:
        if isinstance(table, SpectrumValues):
            periods, ordinates = table.periods, table.accelerations
        else:
            periods, ordinates = read_spectrum(self.hazard, table)
        rules = find_code(self.hazard.criteria).set_rules
        return TabulatedSpectrum(
            periods,
            ordinates,
            self.hazard.damping,
            rules,
            self.hazard.interpolation,
            factor,
            label,
            self.hazard.damping_correction,
            table.corner_period,
        )
