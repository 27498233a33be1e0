"""The action of EN 1998-1:2004."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial

from edesign.codes.ec8 import (
    DesignSpectrum,
    ElasticSpectrum,
    HorizontalParameters,
    NationalParameters,
    VerticalSpectrum,
    national_parameters,
    vertical_design_spectrum,
)
from edesign.codes.ec8.action.importance import factor_of_probability, factor_of_return_period
from edesign.codes.ec8.national import parameters_of_file
from edesign.codes.registry import find_code
from edesign.errors import InputError
from edesign.ground_motion.seismic_action.action import Check, check_level, in_50_years
from edesign.project.actions.hazard import EC8Hazard
from edesign.project.actions.hazard_base import YEAR
from edesign.project.actions.national_file import read_national_file
from edesign.project.notation.units import STANDARD_GRAVITY


@dataclass(frozen=True)
class EC8Action:
    """Spectra of a hazard of EN 1998-1; the interface is `SeismicAction`."""

    hazard: EC8Hazard

    def checks(self) -> Iterator[Check]:
        """Yield the checks of country, national values, zone, type, parameters and levels."""
        yield ("country",), lambda: self.country
        yield ("national",), lambda: self.national.vertical(self.hazard.spectrum)
        yield ("zone",), lambda: self.a_gR
        yield ("spectrum",), lambda: self.spectrum_type
        yield ("parameters",), lambda: self.parameters
        if self.hazard.k is not None:
            rare = [name for name, one in self.hazard.levels.items() if one.probability or one.return_period]
            yield ("k",), lambda: [self.factor(level) for level in rare]
        for level in self.hazard.levels:
            yield ("levels", level), partial(self.factor, level)

    @property
    def title(self) -> str:
        """Title of the code."""
        return find_code(self.hazard.code).title

    @property
    def country(self) -> NationalParameters:
        """The parameters of the country, by its name or from the file that the hazard names.

        Raises:
            InputError: there is no such country, or its file is wrong.
        """
        file = self.hazard.country_file
        if file is None:
            return national_parameters(self.hazard.country)
        path = self.hazard.path_of(file)
        return parameters_of_file(path.stem, read_national_file(self.hazard, file))

    @property
    def national(self) -> NationalParameters:
        """The parameters that the hazard states, then those of its country, then the recommended ones."""
        return self.country.with_values(self.hazard.national.stated(), self.hazard.spectrum)

    @property
    def a_gR(self) -> float:
        """Reference peak ground acceleration, m/s2.

        Raises:
            InputError: the zone does not exist, or is missing.
        """
        if self.hazard.a_gR is not None:
            return self.hazard.a_gR
        if self.hazard.zone is None:
            raise InputError("hazard: give either `country` and `zone`, or `a_gR` [E-KEY-03]")
        return self.national.a_gR(self.hazard.zone)

    @property
    def spectrum_type(self) -> int:
        """The type of spectrum, which the zone may fix."""
        if self.hazard.zone is not None:
            self.national.check_spectrum_type(self.hazard.zone, self.hazard.spectrum)
        return self.hazard.spectrum

    @property
    def parameters(self) -> HorizontalParameters:
        """The table's values, and those of the hazard in their place."""
        table = self.national.horizontal(self.spectrum_type, self.hazard.ground)
        return replace(table, **self.hazard.parameters.model_dump(exclude_none=True))

    def elastic(self, level: str | None) -> ElasticSpectrum:
        """Return S_e(T); None is the reference action, gamma_I = 1.

        Args:
            level: its name in the hazard.

        Source: EN 1998-1:2004, 3.2.2.2.
        """
        parameters = self.parameters
        shape = f"type {parameters.spectrum_type}, ground {parameters.ground}"
        label = f"{self.title} {shape}, {self._action(level)}"
        return ElasticSpectrum(self.a_gR, parameters, self._gamma_I(level), self.hazard.damping, label)

    def vertical(self, level: str | None) -> VerticalSpectrum:
        """Return S_ve(T).

        Args:
            level: its name in the hazard.

        Source: EN 1998-1:2004, 3.2.2.3.
        """
        label = f"{self.title} type {self.hazard.spectrum}, vertical, {self._action(level)}"
        parameters = self.national.vertical(self.spectrum_type)
        return VerticalSpectrum(self.a_gR, parameters, self._gamma_I(level), self.hazard.damping, label)

    def design(self, level: str | None, q: float | None) -> DesignSpectrum | None:
        """Return S_d(T); None: there is no behaviour factor.

        Args:
            level: its name in the hazard.

        Source: EN 1998-1:2004, 3.2.2.5.
        """
        q = self.hazard.behaviour_factor if q is None else q
        if q is None:
            return None
        label = f"{self.title} design, q = {q:g}, ground {self.hazard.ground}, {self._action(level)}"
        return DesignSpectrum.of(self.elastic(level), q, self.national.beta, label)

    def vertical_design(self, level: str | None, q: float) -> DesignSpectrum:
        """Return S_vd(T).

        Args:
            level: its name in the hazard.
            q: behaviour factor.

        Source: EN 1998-1:2004, 3.2.2.5(5) to (7).
        """
        return vertical_design_spectrum(self.vertical(level), q, self.national.beta)

    def factor(self, level: str) -> float:
        """Return gamma_I of a level.

        Args:
            level: its name in the hazard.

        Returns:
            gamma_I, dimensionless.

        Raises:
            InputError: there is no such level, or it says nothing of its importance.

        Source: EN 1998-1:2004, 2.1(4) Note and 4.2.5(5)P; thesis Eq. 5.5.
        """
        check_level(self.hazard, level)
        given, national = self.hazard.levels[level], self.national
        k = self.hazard.k if self.hazard.k is not None else national.hazard_exponent
        if given.probability is not None:
            return factor_of_probability(given.probability, national.reference_probability, k)
        if given.return_period is not None:
            return factor_of_return_period(given.return_period / YEAR, national.reference_return_period, k)
        if given.importance_class is not None:
            return national.gamma_I(given.importance_class)
        if given.gamma_I is not None:
            return given.gamma_I
        raise InputError(
            f"hazard.levels.{level}: give probability, return_period, importance_class or gamma_I [E-KEY-03]"
        )

    def probability(self, level: str) -> float | None:
        """Return the probability of exceedance of a level in 50 years; None for a level by class or factor.

        Args:
            level: its name in the hazard.
        """
        given = self.hazard.levels[level]
        return in_50_years(given.probability, given.return_period)

    def facts(self, level: str) -> str:
        """Return probability or return period, importance class and factor, of a level.

        Args:
            level: its name in the hazard.
        """
        given = self.hazard.levels[level]
        chance = f"{100 * given.probability:g} % in 50 years, " if given.probability is not None else ""
        if given.return_period is not None:
            chance = f"once in {given.return_period / YEAR:g} years, "
        of_class = f"importance class {given.importance_class}, " if given.importance_class is not None else ""
        return f"{chance}{of_class}gamma_I = {self.factor(level):.4g}"

    def _gamma_I(self, level: str | None) -> float:
        return 1.0 if level is None else self.factor(level)

    def _action(self, level: str | None) -> str:
        reference = f"a_gR = {self.a_gR / STANDARD_GRAVITY:.3g} g"
        return reference if level is None else f"{level}: {reference} x {self.factor(level):.3g}"
