"""A calibrated building as files: its block of a campaign file, and laws of its isolation layer for projects."""

from __future__ import annotations

from typing import Any

import numpy as np
import yaml

from edesign.calibrate.result import Calibration, Effect
from edesign.calibrate.structure.building import Building
from edesign.calibrate.structure.campaign import StructureCampaign
from edesign.calibrate.structure.effects import MODULES
from edesign.calibrate.structure.problem import StructureProblem
from edesign.damper.amendments import Amendment
from edesign.damper.effects_file import write_effects
from edesign.damper.laws import law as law_of
from edesign.damper.parameters import write_parameters

_BESIDE = {
    "isolation_softening.bouc_wen": lambda p: ("bouc_wen", {"Fy": p["F"], "Y": p["Y"], "alpha": 0.0}),
    "isolation_softening.friction": lambda p: ("elastic_plastic", {"k": p["F"] / p["Y"], "Fy": p["F"], "b": 0.0}),
}
"""Effects of the isolation layer that are a damper law of their own, beside the declared one."""

LAWS_BESIDE = ("law_beside_bouc_wen.yaml", "law_beside_elastic_plastic.yaml")
"""Their law files."""


def structure_text(found: Calibration, campaign: StructureCampaign) -> str:
    """The corrected building as `structure` and `law` of a campaign file; what these cannot say stands in comments."""
    problem = StructureProblem.of(campaign)
    building = problem.building(np.array([one.value for one in found.parameters["corrected"].values()]))
    left_out = []
    for effect in found.effects:
        form = _form(problem, effect)
        changed = form.building(_values(effect), building)
        said = changed is not building and changed.sway == building.sway and changed.rocking == building.rocking
        building = changed
        if not said:
            left_out.append(effect)
    data: dict[str, Any] = {"structure": _block(building, campaign)}
    if campaign.isolation is not None:
        data["law"] = _law(found, campaign)
    head = [
        f"# {found.title}, calibrated by {len(found.tests)} tests: {found.verdict_words}",
        *_errors(found),
        *(f"# beside it: {_told(effect)}" for effect in left_out),
        *_hypotheses(found),
    ]
    return _text(head, data)


def law_texts(found: Calibration, campaign: StructureCampaign) -> dict[str, str]:
    """Law files of an isolation layer by name: the law as corrected, and what acts beside it; none of a fixed base.

    Effects of building and instruments are no part of them.
    """
    if campaign.isolation is None:
        return {}
    carried, beside, left_out = [], {}, []
    for effect in found.effects:
        values = _values(effect)
        label = f"{effect.name}.{effect.form}"
        if effect.amendment:
            name, form = effect.amendment.split(".")
            carried.append(Amendment(name, form, values | dict(effect.fixed)))
        elif label in _BESIDE:
            kind, own = _BESIDE[label](values)
            head = [f"# {effect.title} of {found.title}: acts beside law.yaml, between the same nodes", *_errors(found)]
            parameters = write_parameters(law_of(kind), own)
            beside[f"law_beside_{kind}.yaml"] = _text(head, {"type": kind, "parameters": parameters})
        else:
            left_out.append(f"# left out: {_told(effect)}")
    data = _law(found, campaign)
    if carried:
        data["effects"] = write_effects(carried)
    head = [
        f"# isolation layer of {found.title}, calibrated by {len(found.tests)} tests: {found.verdict_words}",
        *_errors(found),
        *(f"# acts beside it: {name}" for name in beside),
        *(f"# {name} is held: {why}" for name, why in found.held.items()),
        *left_out,
        *_hypotheses(found),
    ]
    return {"law.yaml": _text(head, data), **beside}


def _hypotheses(found: Calibration) -> list[str]:
    return [f"# left out: {one.effect.name}.{one.effect.form} (hypothesis): {one.why}" for one in found.hypotheses]


def _errors(found: Calibration) -> list[str]:
    corrected, declared = (100.0 * found.errors[stage].validate for stage in ("corrected", "declared"))
    return [f"# NRMS of the validation tests {corrected:.3g} %, as declared {declared:.3g} %"]


def _law(found: Calibration, campaign: StructureCampaign) -> dict[str, Any]:
    assert campaign.isolation is not None
    law, values = law_of(campaign.isolation.law), dict(campaign.isolation.values)
    values |= {n: one.value for n, one in found.parameters["corrected"].items() if n in values}
    return {"type": law.name, "parameters": write_parameters(law, values)}


def _block(building: Building, campaign: StructureCampaign) -> dict[str, Any]:
    first = 1 if building.isolated else 0
    block: dict[str, Any] = {
        "name": campaign.name,
        "base": "isolated" if building.isolated else "fixed",
        "floor_masses": [f"{1e-3 * mass:.6g} t" for mass in building.masses],
    }
    if building.floors > first:
        block["storey_stiffness"] = [f"{1e-6 * k:.6g} kN/mm" for k in building.stiffness[first:]]
        block["damping"] = {
            "type": building.damping.kind,
            "ratio": f"{100.0 * building.damping.ratio:.6g} %",
            "modes": list(building.damping.modes),
        }
    if building.heights is not None:
        heights = np.diff(building.heights, prepend=0.0)[first:]
        block["storey_heights"] = [f"{height:.6g} m" for height in heights]
    if np.any(building.dashpots[first:]):
        block["storey_dashpots"] = [f"{1e-3 * c:.6g} kN*s/m" for c in building.dashpots[first:]]
    return block


def _form(problem: StructureProblem, effect: Effect) -> Any:
    forms = {(form.name, form.form): form for module in MODULES for form in module.forms(problem.setting)}
    return forms[effect.name, effect.form]  # it was found among these


def _values(effect: Effect) -> dict[str, float]:
    return {name: one.value for name, one in effect.parameters.items()}


def _told(effect: Effect) -> str:
    numbers = ", ".join(f"{name} = {one.value:.6g} {one.unit}".rstrip() for name, one in effect.parameters.items())
    return f"{effect.name}.{effect.form} ({effect.kind}): {effect.title}; {numbers}"


def _text(head: list[str], data: dict[str, Any]) -> str:
    return "\n".join(head) + "\n" + yaml.safe_dump(data, sort_keys=False, default_flow_style=None, width=120)
