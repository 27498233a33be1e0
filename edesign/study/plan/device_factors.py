"""The factors on devices that a study asks for, or that go with the code of its hazard."""

from __future__ import annotations

from edesign.assess.raised_devices import RaisedDevices
from edesign.codes.device_factors import DeviceFactors, device_factors, factors_of_code
from edesign.codes.rule_check import UNREAD
from edesign.errors import InputError
from edesign.project.actions.hazard import UserHazard
from edesign.project.actions.hazard_base import Hazard
from edesign.project.dampers.dampers import GivenFactors
from edesign.project.dampers.placement import PlacementDesign
from edesign.project.study.study import Study
from edesign.study.design.building import law_at


def factors_in_force(study: Study | None, hazard: Hazard | None) -> DeviceFactors:
    """Return the factors on devices.

    Args:
        study: the study; None: of a project, which has those of its code.
        hazard: block of the project; None: it has none.
    """
    asked = None if study is None else study.device_factors
    if isinstance(asked, GivenFactors):
        return DeviceFactors("", **asked.model_dump())
    if asked is not None:
        return device_factors(asked)
    if hazard is None:
        return factors_of_code("")
    return factors_of_code(hazard.criteria if isinstance(hazard, UserHazard) else hazard.code)


def raised_devices(study: Study, design: str) -> RaisedDevices:
    """Return the factors of the code on the dampers of a design, and the law that they have."""
    factors = factors_in_force(study, study.hazard)
    spec = study.designs.get(design)
    law = None
    if spec is not None and not isinstance(spec, PlacementDesign):
        try:
            law = law_at(study.base, spec.law, spec.temperature)
        except InputError:  # a law file is not at hand
            law = None
    return RaisedDevices(factors, law, factors_note(factors, study.device_factors is not None))


def factors_note(factors: DeviceFactors, asked: bool) -> str:
    """Return what factors there are, and where they come from, in a sentence; "" for none.

    Args:
        asked: whether the study names them; otherwise they go with the code of the hazard.
    """
    named = {
        "stroke": factors.stroke,
        "velocity": factors.velocity,
        "overstrength of what holds the dampers": factors.overstrength,
        "stroke of isolators": factors.isolator_stroke,
    }
    given = ", ".join(f"{what} {value:g}" for what, value in named.items() if value != 1.0)
    if not given:
        return ""
    source = f" by {factors.clause}" if factors.clause else ""
    whose = "" if asked else "; they go with the code of the hazard, and `device_factors` changes them"
    return f"Factors{source}: {given}{whose}." + f" {UNREAD}" * factors.unread
