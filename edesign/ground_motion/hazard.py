"""The hazard of a project as spectra of its code."""

from __future__ import annotations

from collections.abc import Callable
from typing import overload

from edesign.codes.ec8 import ElasticSpectrum, NationalParameters, VerticalSpectrum
from edesign.codes.fema356.objectives import OBJECTIVES, is_of_level
from edesign.codes.motion_sets import SetRules
from edesign.codes.ntc2018.parameters import ntc_parameters
from edesign.codes.registry import find_code
from edesign.codes.spectrum import DesignOrdinates, Spectrum
from edesign.errors import InputError
from edesign.ground_motion.seismic_action.action import SeismicAction
from edesign.ground_motion.seismic_action.asce7 import AsceAction
from edesign.ground_motion.seismic_action.ec8 import EC8Action
from edesign.ground_motion.seismic_action.ntc2018 import NtcAction
from edesign.ground_motion.seismic_action.user import UserAction
from edesign.project.actions.hazard import AsceHazard, EC8Hazard, NtcHazard, UserHazard
from edesign.project.actions.hazard_base import Hazard
from edesign.project.analysis_file import AnalysisFile

_ACTIONS: dict[type[Hazard], Callable[..., SeismicAction]] = {
    EC8Hazard: EC8Action,
    NtcHazard: NtcAction,
    AsceHazard: AsceAction,
    UserHazard: UserAction,
}


def action_of(hazard: Hazard) -> SeismicAction:
    """Return the spectra of a hazard by its code.

    Args:
        hazard: block of the project.
    """
    return _ACTIONS[type(hazard)](hazard)


def checked_hazard(project: AnalysisFile) -> Hazard:
    """Return the hazard of a project or building after checking everything that its code has to say.

    Args:
        project: from `load_project` or `load_building`.

    Raises:
        InputError: it has no hazard, or names a country, zone or parameter that does not exist or fit; the
            message names the place in the file.
    """
    hazard = project.hazard
    if hazard is None:
        raise InputError(
            f"{project.where('hazard')}: hazard: this block is missing; docs/reference/project_file.md explains it"
            " [E-KEY-02]"
        )
    for place, check in action_of(hazard).checks():
        try:
            check()
        except InputError as error:
            raise InputError(f"{project.where('hazard', *place)}: hazard.{'.'.join(place)}: {error}") from error
    return hazard


@overload
def elastic_spectrum(hazard: EC8Hazard, level: str | None = None) -> ElasticSpectrum: ...
@overload
def elastic_spectrum(hazard: Hazard, level: str | None = None) -> Spectrum: ...
def elastic_spectrum(hazard: Hazard, level: str | None = None) -> Spectrum:
    """Return the horizontal elastic spectrum at the surface.

    Args:
        hazard: the block of the project file.
        level: one of its levels; None for what records are fitted to: the action of which all levels are multiples
            (gamma_I = 1 in EN 1998-1), or the only level of an action whose levels have spectra of their own.

    Raises:
        InputError: a country, zone, level or parameter does not exist or fit, or a level must be named.
    """
    return action_of(hazard).elastic(level)


@overload
def vertical_spectrum(hazard: EC8Hazard, level: str | None = None) -> VerticalSpectrum: ...
@overload
def vertical_spectrum(hazard: Hazard, level: str | None = None) -> Spectrum: ...
def vertical_spectrum(hazard: Hazard, level: str | None = None) -> Spectrum:
    """Return the vertical elastic spectrum; errors as `elastic_spectrum`, or the code has none.

    Args:
        hazard: block of the project.
        level: its name; None: the action that records are fitted to.

    Source: EN 1998-1:2004, 3.2.2.3; NTC 2018, 3.2.3.2.2.
    """
    return action_of(hazard).vertical(level)


def design_spectrum(hazard: Hazard, level: str | None = None) -> DesignOrdinates:
    """Return the horizontal design spectrum for the behaviour factor (q or R) of the hazard.

    The damping of the hazard does not enter, as the behaviour factor covers it.

    Args:
        hazard: block of the project.
        level: its name; None: the action that records are fitted to.

    Raises:
        InputError: as `elastic_spectrum`, or the hazard has no behaviour factor.
    """
    design = action_of(hazard).design(level, None)
    if design is None:
        raise InputError("hazard.behaviour_factor: this key is missing; the design spectrum needs it [E-KEY-02]")
    return design


def code_spectra(
    hazard: Hazard, level: str | None = None, vertical: bool = False, q: float | None = None
) -> tuple[Spectrum, DesignOrdinates | None]:
    """Return elastic and design spectrum of one component.

    Args:
        hazard: the block of the project file.
        level: as in `elastic_spectrum`.
        vertical: the vertical component instead of a horizontal one.
        q: behaviour factor; None takes that of the hazard for a horizontal component, and without one, or for the
            vertical component, gives no design spectrum.

    Returns:
        The elastic spectrum; the design spectrum, or None where there is none.

    Raises:
        InputError: as `elastic_spectrum`, or something that the code does not allow or has not.
    """
    action = action_of(hazard)
    if not vertical:
        return action.elastic(level), action.design(level, q)
    return action.vertical(level), None if q is None else action.vertical_design(level, q)


def factor_of_level(hazard: Hazard, level: str) -> float:
    """Return by what factor a level differs from the spectrum that records are fitted to.

    That is gamma_I in EN 1998-1, 1 or 1.5 in ASCE/SEI 7, and 1 where levels have spectra of their own.

    Args:
        hazard: block of the project.

    Raises:
        InputError: there is no such level.
    """
    return action_of(hazard).factor(level)


def objective_level(letter: str, hazard: Hazard | None) -> str | None:
    """Return the name of the hazard level of an objective, None if the hazard has none.

    A level counts with its probability in 50 years, as the file states it or as its return period has it, within what
    rounding of return periods makes; levels given by a factor, an importance class or a risk have none.

    Args:
        hazard: the seismic action; None: the project has none.
    """
    if hazard is None:
        return None
    wanted, action = OBJECTIVES[letter].probability, action_of(hazard)
    for name in hazard.levels:
        probability = action.probability(name)
        if probability is not None and is_of_level(probability, wanted):
            return name
    return None


def rules_in_force(hazard: Hazard | None) -> SetRules:
    """Return what the code of an action asks of histories: how many there are, and from which number the mean counts.

    Args:
        hazard: block of the project; None: it has none, and the rules are those of EN 1998-1.
    """
    if hazard is None:
        return find_code("ec8-2004").set_rules
    return find_code(hazard.criteria if isinstance(hazard, UserHazard) else hazard.code).set_rules


def national_of(hazard: EC8Hazard | NtcHazard) -> NationalParameters:
    """Return the national parameters: those that the file states, then those of its country, then the recommended ones.

    An action of NTC 2018 has those of this code.

    Args:
        hazard: block of the project.

    Raises:
        InputError: the country has no data file.
    """
    return ntc_parameters() if isinstance(hazard, NtcHazard) else EC8Action(hazard).national


def national_values(hazard: Hazard) -> str | None:
    """Return whose national values an action has; None: its code has none.

    Raises:
        InputError: a file of the country is not at hand.
    """
    if not isinstance(hazard, EC8Hazard):
        return None
    country = national_of(hazard).country
    own = ", but where `hazard: national` states them" if hazard.national.stated() else ""
    if country is None:
        return f"recommended ones of EN 1998-1{own}"
    zone = f", zone {hazard.zone}" if hazard.zone is not None else ""
    name = country.replace("_", " ").title()
    return f"National Annex of {name}{zone}; recommended ones where its data file says nothing{own}"
