"""A corrected building as files say it: `structure` and `law` of a campaign file, and laws of its isolation layer."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import yaml

from edesign.calibration.form import FormInCampaign
from edesign.calibration.residual.series import Stage
from edesign.calibration.results.law_file import LAW
from edesign.calibration.results.result import Calibration, LawFile
from edesign.calibration.results.result import Effect as FoundEffect
from edesign.calibration.search.models import FittedModel
from edesign.calibration.search.problem import Effect
from edesign.calibration.structures.building import Building
from edesign.calibration.structures.campaign import StructureCampaign
from edesign.calibration.structures.effect import ChangedBuilding, StructureForm
from edesign.calibration.structures.from_campaign import blank_problem
from edesign.calibration.structures.problem import StructureProblem
from edesign.damper.effects import LawEffect
from edesign.damper.effects_file import write_effects
from edesign.damper.laws import law as law_of
from edesign.damper.parameters import write_parameters

STRUCTURE = "structure.yaml"
BOUC_WEN, FRICTION = "law_beside_bouc_wen.yaml", "law_beside_elastic_plastic.yaml"
FILES = (STRUCTURE, LAW, BOUC_WEN, FRICTION)
"""Files of a corrected building; those of laws are of isolated ones."""

_LAW_EFFECTS = {
    "isolation_softening.envelope": "payne.elastic",
    "isolation_hardening.power": "hardening.power",
    "isolation_hardening.threshold": "hardening.threshold",
}
_BESIDE: Mapping[str, tuple[str, str, Callable[[Mapping[str, float]], dict[str, float]]]] = {
    "isolation_softening.bouc_wen": (
        BOUC_WEN,
        "bouc_wen",
        lambda p: {"Fy": p["F"], "Y": p["Y"], "alpha": 0.0},
    ),
    "isolation_softening.friction": (
        FRICTION,
        "elastic_plastic",
        lambda p: {"k": p["F"] / p["Y"], "Fy": p["F"], "b": 0.0},
    ),
}
"""Effects of the isolation layer that are a damper law of their own, beside the declared one."""
_CHANGED = ("partitions", "mass_error", "damping")
_LINKS = ("partitions.lost", "damping.friction")  # no key of a campaign says so


def where_carried(effect: Effect | FoundEffect | StructureForm) -> str:
    """Return the file that carries an effect of the building; "" if none does.

    Args:
        effect: of a model, found, or of the library.
    """
    if effect.label in _BESIDE:
        return _BESIDE[effect.label][0]
    if effect.label in _LAW_EFFECTS:
        return LAW
    return STRUCTURE if effect.name in _CHANGED and effect.label not in _LINKS else ""


def law_file(campaign: StructureCampaign, problem: StructureProblem, final: FittedModel, validate: float) -> LawFile:
    """Return the law of the isolation layer as a law file has it; without parameters on a fixed base.

    Args:
        campaign: records.
        problem: of them.
        validate: NRMS of the validation tests with it.
    """
    parameters: dict[str, float] = {}
    if campaign.isolation is not None:
        fitted = dict(zip((one.name for one in problem.base), map(float, final.fit.values), strict=False))
        parameters = {name: fitted.get(name, value) for name, value in campaign.isolation.values.items()}
    effects, measured, lacking = [], [], []
    for index, effect in enumerate(final.effects):
        of, own = effect.data, final.fit.values[final.places(index)]
        if effect.kind != "structure":
            measured.append(f"{effect.label} ({effect.kind}): {of.words(own).title}")
        elif effect.label in _LAW_EFFECTS:
            name, form = _LAW_EFFECTS[effect.label].split(".")
            values = of.values(own)
            effects.append(LawEffect(name, form, dict(values)))
        elif not where_carried(effect):
            lacking.append(effect.label)
    stage: Stage = "corrected" if final.effects else "refit"
    return LawFile(stage, parameters, tuple(effects), None, tuple(measured), tuple(lacking), validate)


def corrected_texts(found: Calibration, campaign: StructureCampaign) -> dict[str, str]:
    """Return the files of a corrected building by name."""
    head = [
        f"{found.title}, calibrated by {len(found.tests)} tests: {found.verdict_words}",
        f"NRMS of the validation tests {100.0 * found.errors['corrected'].validate:.3g} %, as declared "
        f"{100.0 * found.errors['declared'].validate:.3g} %, noise {100.0 * found.noise_floor:.3g} %",
    ]
    hypotheses = [f"hypothesis, in no file: {one.effect.label}: {one.why}" for one in found.hypotheses]
    return {
        STRUCTURE: _structure_text(found, campaign, head, hypotheses),
        **_law_texts(found, campaign, head, hypotheses),
    }


def _structure_text(found: Calibration, campaign: StructureCampaign, head: list[str], tail: list[str]) -> str:
    """Return `structure` and `law` of a campaign file; what these cannot say stands in comments."""
    problem = blank_problem(campaign)
    forms = {effect.label: effect.data for effect in problem.effects}
    building = problem.building({name: one.value for name, one in found.parameters["corrected"].items()})[0]
    comments = []
    for effect in found.effects:
        of: FormInCampaign = forms[effect.label]
        mechanisms = [mechanism for mechanism in of.form.mechanisms if isinstance(mechanism, ChangedBuilding)]
        if where_carried(effect) == STRUCTURE and mechanisms:
            for mechanism in mechanisms:
                building = mechanism.change(of.values(one.value for one in effect.parameters.values()), building)
        else:
            where = where_carried(effect)
            comments.append(f"{f'in {where}' if where else 'in no file'}: {_in_words(effect)}")
    data: dict[str, Any] = {"structure": _block(building, campaign)}
    if campaign.isolation is not None:
        data["law"] = _law(found, campaign)
    return _text([*head, *comments, *tail], data)


def _law_texts(found: Calibration, campaign: StructureCampaign, head: list[str], tail: list[str]) -> dict[str, str]:
    """Return law files of an isolation layer: the law as corrected, and what acts beside it; none of a fixed base."""
    if campaign.isolation is None:
        return {}
    beside, others = {}, []
    for effect in found.effects:
        where = where_carried(effect)
        if effect.label in _BESIDE:
            _, kind, parameters = _BESIDE[effect.label]
            own = parameters({name: one.value for name, one in effect.parameters.items()})
            first = f"{effect.title}: acts beside {LAW}, between the same nodes"
            law = {"type": kind, "parameters": write_parameters(law_of(kind), own)}
            beside[where] = _text([first, *head], law)
        elif where != LAW:
            others.append(f"{f'in {where}' if where else 'in no file'}: {_in_words(effect)}")
    data = _law(found, campaign)
    if found.law_file.effects:
        data["effects"] = write_effects(found.law_file.effects)
    lines = [
        "isolation layer of " + head[0],
        *head[1:],
        *(f"acts beside it: {name}" for name in beside),
        *(f"{name} is fixed: {why}" for name, why in found.fixed.items()),
        *others,
        *tail,
    ]
    return {LAW: _text(lines, data), **beside}


def _law(found: Calibration, campaign: StructureCampaign) -> dict[str, Any]:
    assert campaign.isolation is not None
    law = law_of(campaign.isolation.law)
    return {"type": law.name, "parameters": write_parameters(law, found.law_file.parameters)}


def _block(building: Building, campaign: StructureCampaign) -> dict[str, Any]:
    first = int(building.isolated)
    block: dict[str, Any] = {
        "name": campaign.name,
        "base": "isolated" if building.isolated else "fixed",
        "floor_masses": [f"{1e-3 * mass:.6g} t" for mass in building.masses],
    }
    if building.floors > first:
        block["storey_stiffness"] = [f"{1e-6 * k:.6g} kN/mm" for k in building.stiffness[first:]]
        damping = building.damping
        block["damping"] = {
            "type": damping.kind,
            "ratio": f"{100.0 * damping.ratio:.6g} %",
            "modes": list(damping.modes),
        }
        if damping.other is not None:
            block["damping"] |= {"other": damping.other, "share": f"{100.0 * damping.share:.6g} %"}
    if building.heights is not None:
        heights = np.diff(building.heights, prepend=0.0)[first:]
        block["storey_heights"] = [f"{height:.6g} m" for height in heights]
    if np.any(building.dashpots[first:]):
        block["storey_dashpots"] = [f"{1e-3 * c:.6g} kN*s/m" for c in building.dashpots[first:]]
    return block


def _in_words(effect: FoundEffect) -> str:
    numbers = ", ".join(f"{name} = {one.value:.6g} {one.unit}".rstrip() for name, one in effect.parameters.items())
    return f"{effect.label} ({effect.kind}): {effect.title}; {numbers}"


def _text(head: list[str], data: dict[str, Any]) -> str:
    lines = "".join(f"# {line}\n" for line in head)
    return lines + yaml.safe_dump(data, sort_keys=False, allow_unicode=True, default_flow_style=None, width=120)
