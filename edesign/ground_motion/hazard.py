"""The hazard of a project as spectra of its code."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from edesign.codes import Code, find_code
from edesign.codes.ec8 import (
    DesignSpectrum,
    ElasticSpectrum,
    HorizontalParameters,
    NationalParameters,
    VerticalSpectrum,
    vertical_design_spectrum,
)
from edesign.codes.ec8.importance import factor_of_probability, factor_of_return_period
from edesign.errors import InputError
from edesign.project.hazard import YEAR, Hazard
from edesign.project.problems import unknown_name
from edesign.project.project import Project
from edesign.project.units import STANDARD_GRAVITY

if TYPE_CHECKING:
    from edesign.project.building.building import Building


def checked_hazard(project: Project | Building) -> Hazard:
    """Return the hazard of a project or building after checking everything that its code has to say.

    Args:
        project: the validated project or building.

    Raises:
        InputError: it has no hazard, or names a country, zone or parameter that does not exist or fit; the
            message names the place in the file.
    """
    hazard = project.hazard
    if hazard is None:
        raise InputError(f"{project.where('hazard')}: hazard: this block is missing; docs/project_file.md explains it")
    place = "country"
    try:
        _code(hazard).national(hazard.country)
        place = "national"
        national_of(hazard).vertical(hazard.spectrum)
        place = "zone"
        _a_gR(hazard)
        place = "spectrum"
        _spectrum_type(hazard)
        place = "parameters"
        _parameters(hazard)
        place = "levels"
        for level in hazard.levels:
            importance_factor(hazard, level)
    except InputError as error:
        raise InputError(f"{project.where('hazard', place)}: hazard.{place}: {error}") from error
    return hazard


def elastic_spectrum(hazard: Hazard, level: str | None = None) -> ElasticSpectrum:
    """Return the horizontal elastic spectrum at the surface.

    Args:
        hazard: the block of the project file.
        level: one of its levels; None for the reference action, gamma_I = 1.

    Raises:
        InputError: a country, zone, level or parameter does not exist or fit.

    Source: EN 1998-1:2004, 3.2.2.2.
    """
    parameters = _parameters(hazard)
    shape = f"type {parameters.spectrum_type}, ground {parameters.ground}"
    label = f"{_code(hazard).title} {shape}, {_action(hazard, level)}"
    gamma_I = 1.0 if level is None else importance_factor(hazard, level)
    return _code(hazard).elastic(_a_gR(hazard), parameters, gamma_I, hazard.damping, label)


def vertical_spectrum(hazard: Hazard, level: str | None = None) -> VerticalSpectrum:
    """Return the vertical elastic spectrum; arguments and errors as `elastic_spectrum`.

    Source: EN 1998-1:2004, 3.2.2.3.
    """
    gamma_I = 1.0 if level is None else importance_factor(hazard, level)
    label = f"{_code(hazard).title} type {hazard.spectrum}, vertical, {_action(hazard, level)}"
    return VerticalSpectrum(
        _a_gR(hazard), national_of(hazard).vertical(_spectrum_type(hazard)), gamma_I, hazard.damping, label
    )


def design_spectrum(hazard: Hazard, level: str | None = None) -> DesignSpectrum:
    """Return the horizontal design spectrum for the behaviour factor of the hazard.

    Arguments as `elastic_spectrum`; the damping of the hazard does not enter, as q covers it.

    Raises:
        InputError: as `elastic_spectrum`, or the hazard has no behaviour factor.

    Source: EN 1998-1:2004, 3.2.2.5.
    """
    if hazard.behaviour_factor is None:
        raise InputError("hazard.behaviour_factor: this key is missing; the design spectrum needs it")
    return _design(hazard, level, hazard.behaviour_factor)


def code_spectra(
    hazard: Hazard, level: str | None = None, vertical: bool = False, q: float | None = None
) -> tuple[ElasticSpectrum | VerticalSpectrum, DesignSpectrum | None]:
    """Return elastic and design spectrum of one component.

    Args:
        hazard: the block of the project file.
        level: one of its levels; None for the reference action.
        vertical: the vertical component instead of a horizontal one.
        q: behaviour factor; None takes that of the hazard for a horizontal component, and without one, or for the
            vertical component, gives no design spectrum.

    Raises:
        InputError: as `elastic_spectrum`, or a q that EN 1998-1 does not allow.
    """
    if not vertical:
        q = hazard.behaviour_factor if q is None else q
        return elastic_spectrum(hazard, level), None if q is None else _design(hazard, level, q)
    elastic = vertical_spectrum(hazard, level)
    return elastic, None if q is None else vertical_design_spectrum(elastic, q, national_of(hazard).beta)


def importance_factor(hazard: Hazard, level: str) -> float:
    """Return gamma_I of a level: by what factor it differs from the reference action.

    Raises:
        InputError: there is no such level.

    Source: EN 1998-1:2004, 2.1(4) Note and 4.2.5(5)P; thesis Eq. 5.5.
    """
    if level not in hazard.levels:
        raise InputError(f"hazard.levels: {unknown_name('level', level, hazard.levels)}")
    given, national = hazard.levels[level], national_of(hazard)
    k = hazard.k if hazard.k is not None else national.hazard_exponent
    if given.probability is not None:
        return factor_of_probability(given.probability, national.reference_probability, k)
    if given.return_period is not None:
        return factor_of_return_period(given.return_period / YEAR, national.reference_return_period, k)
    if given.importance_class is not None:
        return national.gamma_I(given.importance_class)
    if given.gamma_I is not None:
        return given.gamma_I
    raise InputError(f"hazard.levels.{level}: give probability, return_period, importance_class or gamma_I")


def national_of(hazard: Hazard) -> NationalParameters:
    """Return the national parameters: those that the file states, then those of its country, then the recommended ones.

    Raises:
        InputError: the country has no data file.
    """
    of_country = _code(hazard).national(hazard.country)
    return of_country.with_values(hazard.national.stated(), hazard.spectrum)


def _design(hazard: Hazard, level: str | None, q: float) -> DesignSpectrum:
    label = f"{_code(hazard).title} design, q = {q:g}, ground {hazard.ground}, {_action(hazard, level)}"
    return _code(hazard).design.of(elastic_spectrum(hazard, level), q, national_of(hazard).beta, label)


def _code(hazard: Hazard) -> Code:
    return find_code(hazard.code)


def _national(hazard: Hazard) -> NationalParameters:
    return _code(hazard).national(hazard.country)


def _a_gR(hazard: Hazard) -> float:
    if hazard.a_gR is not None:
        return hazard.a_gR
    if hazard.zone is None:
        raise InputError("hazard: give either `country` and `zone`, or `a_gR`")
    return national_of(hazard).a_gR(hazard.zone)


def _spectrum_type(hazard: Hazard) -> int:
    """The type of spectrum, which the zone may fix."""
    if hazard.zone is not None:
        national_of(hazard).check_spectrum_type(hazard.zone, hazard.spectrum)
    return hazard.spectrum


def _parameters(hazard: Hazard) -> HorizontalParameters:
    """The table's values, and those of the project in their place."""
    table = national_of(hazard).horizontal(_spectrum_type(hazard), hazard.ground)
    return replace(table, **hazard.parameters.model_dump(exclude_none=True))


def _action(hazard: Hazard, level: str | None) -> str:
    reference = f"a_gR = {_a_gR(hazard) / STANDARD_GRAVITY:.3g} g"
    return reference if level is None else f"{level}: {reference} x {importance_factor(hazard, level):.3g}"
