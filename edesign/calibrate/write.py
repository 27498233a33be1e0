"""A calibration as files: JSON for programs, the corrected law for projects, histories in an archive."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

import numpy as np
import yaml

from edesign.archive.dataset import Group
from edesign.calibrate.result import Calibration, CarriedLaw, Coverage, Effect, Estimate, Series, Stage
from edesign.damper.effects_file import write_effects
from edesign.damper.laws import law as law_of
from edesign.damper.parameters import read_parameters, write_parameters
from edesign.damper.temperature import REFERENCE_C, GammaT
from edesign.damper.testing.campaign import Campaign
from edesign.damper.testing.specimen import Specimen

_STAGES: tuple[Stage, ...] = ("declared", "refit", "corrected")


def calibration_json(found: Calibration) -> dict[str, Any]:
    """All that was found, in SI; NRMS as ratios, numbers that are not finite as null."""
    return {
        "title": found.title,
        "law": found.law,
        "verdict": found.verdict,
        **({"law_kind": _kind(found)} if found.subject == "damper" else {}),
        "search": found.ending,
        "coverage": _coverage(found.coverage),
        "error": {
            stage: {
                "fit": found.errors[stage].fit,
                "validate": found.errors[stage].validate,
                "tests": dict(found.errors[stage].tests),
                **({"channels": dict(found.errors[stage].channels)} if found.errors[stage].channels else {}),
            }
            for stage in _STAGES
        },
        "noise_floor": found.noise_floor,
        "noise_floor_fit": found.noise_floor_fit,
        "worst_test": None if found.worst is None else asdict(found.worst),
        "effects": _effects(found.effects),
        "hypotheses": [{**_effects([one.effect])[0], "why": one.why} for one in found.hypotheses],
        "unexplained": {"share": _finite(found.unexplained_share), "shape": found.unexplained_shape},
        "next_test": None
        if found.next_test is None
        else {
            "test": found.next_test.text,
            "separates": list(found.next_test.separates),
            "difference": _finite(found.next_test.difference),
            "largest_so_far": _finite(found.next_test.largest),
        },
        "refused": [{"effect": label, "evidence": evidence} for label, evidence in found.refused],
        "law_held": found.law_held,
        **({**_reading(found), "starts": _starts(found)} if found.subject == "damper" else {}),
        "law_file": None if found.carried is None else _carried(found.carried),
        "parameters": {
            stage: {name: _estimate(value) for name, value in found.parameters[stage].items()} for stage in _STAGES
        },
        "held": dict(found.held),
        "seconds": round(found.seconds, 2),
    }


def _kind(found: Calibration) -> dict[str, Any]:
    """Whether the law was fitted first, and the law of another kind that does better; null where none does."""
    return {"fitted_first": found.fitted_first, "better": None if found.kind is None else asdict(found.kind)}


def _coverage(coverage: Coverage) -> dict[str, Any]:
    return {
        "forms": len(coverage.forms),
        "screened": len(coverage.forms) - len(coverage.not_screened),
        "fitted": sorted(coverage.fitted.intersection(coverage.forms)),
        "not_screened": list(coverage.not_screened),
    }


def _reading(found: Calibration) -> dict[str, str]:
    return {"extremes": "lasting" if found.lasting else "fresh", "gamma_T_of": found.gamma_of}


def _starts(found: Calibration) -> dict[str, Any]:
    """Tests that start away from rest, by name."""
    return {
        series.name: {
            "displacement": start.displacement,
            "velocity": start.velocity,
            "judged_from": start.judged_from,
            "dies_away": start.dies_away,
            "deformation_before": start.before[0],
            "velocity_before": start.before[1],
            "before_is": "said" if start.known else "found",
        }
        for series in found.series
        if (start := series.start) is not None
    }


def _carried(law: CarriedLaw) -> dict[str, Any]:
    return {
        "validate": _finite(law.validate),
        "effects": [{"name": one.name, "form": one.label.partition(".")[2]} for one in law.effects],
        "replaced": list(law.replaced),
        "withheld": law.withheld,
    }


def _effects(effects: Sequence[Effect]) -> list[dict[str, Any]]:
    """An entry of each effect in order of adoption; further forms of one that is there add their parameters to it."""
    forms: dict[str, list[Effect]] = {}
    for effect in effects:
        forms.setdefault(effect.name, []).append(effect)
    found = []
    for name, (first, *further) in forms.items():
        every = (first, *further)
        parameters = dict(first.parameters)
        parameters |= {f"{form.form}.{key}": value for form in further for key, value in form.parameters.items()}
        alike = dict.fromkeys(other for form in every for other in form.indistinguishable_from if other != name)
        found.append(
            {
                "name": name,
                "kind": first.kind,
                "form": " + ".join(form.form for form in every),
                "title": "; ".join(form.title for form in every),
                "parameters": {key: _estimate(value) for key, value in parameters.items()},
                "delta_validate": _finite(max(form.delta_validate for form in every)),
                "evidence": "; ".join(form.evidence for form in every),
                "indistinguishable_from": list(alike),
            }
        )
    return found


def law_text(found: Calibration, campaign: Campaign) -> str:
    """The corrected law as a law file: parameters, effects of the damper, specimen, what the tests covered.

    Faults of rig and instrument are no part of it. What ages or wears is as after the last test.
    """
    assert campaign.law is not None and found.carried is not None
    law, carried = law_of(found.law), found.carried
    values = read_parameters(law, campaign.law.parameters or {})
    data: dict[str, Any] = {"type": found.law, "parameters": write_parameters(law, {**values, **carried.parameters})}
    left_out = [
        f"{effect.name} ({effect.kind}): {effect.title}; no part of the damper"
        for effect in found.effects
        if effect.kind != "damper"
    ]
    for label in carried.replaced:
        name = label.split(".")[0]
        other = next((one.form for one in carried.effects if one.name == name), None)
        instead = "left out" if other is None else f"fitted as {name}.{other} instead"
        why = "in forms of law files the validation tests are predicted worse than without effects"
        left_out.append(f"{label}: {why if carried.withheld else f'law files cannot carry this form; {instead}'}")
    left_out += [f"{one.effect.name}.{one.effect.form} (hypothesis): {one.why}" for one in found.hypotheses]
    if carried.effects:
        data["effects"] = write_effects(carried.effects)
    if found.law in GammaT().laws and any(_mean_C(series) != REFERENCE_C for series in found.series):
        # as the loop takes it
        data["temperature_law"] = {"gamma_T": {f"{t:g} degC": gamma for t, gamma in GammaT().table}}
        if found.gamma_of != "parameters":
            data["temperature_law"]["of"] = found.gamma_of
    specimen = campaign.specimen
    if specimen is not None:
        data["prototype"] = {
            "layers": specimen.layers,
            "layer_area": f"{1e6 * specimen.layer_area:.12g} mm^2",
            "layer_thickness": f"{1e3 * specimen.layer_thickness:.12g} mm",
        }
    data["tested"] = _tested(found, specimen)
    best = "" if not carried.replaced else f"; {100 * found.errors['corrected'].validate:.3g} % with forms it lacks"
    head = [
        f"# {law.title}, calibrated by {len(found.series)} tests of {found.title}: {found.verdict_words}",
        f"# NRMS of the validation tests {100 * carried.validate:.3g} %{best}, as declared "
        f"{100 * found.errors['declared'].validate:.3g} %, noise {100 * found.noise_floor:.3g} %",
    ]
    if found.lasting:
        head.append("# extremes soften it from test to test for good: the parameters are those of a virgin damper")
    head += [
        f"# {name} is held: {why}" for name, why in found.held.items() if name in carried.parameters or name in values
    ]
    head += [f"# not carried: {text}" for text in left_out]
    return "\n".join(head) + "\n" + yaml.safe_dump(data, sort_keys=False, allow_unicode=True, width=1000)


def archive_groups(found: Calibration) -> dict[str, Group]:
    """Histories of every test or channel: motion, what was measured and predicted; by the name of the group."""
    groups = {}
    for series in found.series:
        group = Group(
            attributes={"title": series.title, "use": series.use, "order": series.order, "noise": series.noise}
        )
        group.add("time", ("sample",), series.time, "s", "time")
        if found.subject == "damper":
            group.attributes["judged_from"] = series.start.judged_from if series.start else 0.0
            group.add("displacement", ("sample",), series.displacement, "m", "displacement, freed from noise")
            group.add("temperature", ("sample",), series.temperature, "degC", "temperature")
            model = "law"
        else:
            group.attributes["channel"] = series.channel
            group.add("displacement", ("sample",), series.displacement, "m", "of the floor, by the corrected building")
            model = "building"
        what, unit = series.quantity, series.unit
        group.add(f"measured_{what}", ("sample",), series.measured, unit, f"measured {what}")
        for stage, predicted in series.predicted.items():
            group.add(f"{stage}_{what}", ("sample",), predicted, unit, f"{what} predicted by the {stage} {model}")
        group.coords["sample"] = _samples(series.time.size)
        groups[f"tests/{series.name}"] = group
    return groups


def _samples(count: int) -> Any:
    from edesign.archive.dataset import Variable

    return Variable(("sample",), np.arange(count), "1", "sample")


def _tested(found: Calibration, specimen: Specimen | None) -> dict[str, str]:
    largest = np.array([np.max(np.abs(series.displacement)) for series in found.series])
    name, values, unit = ("deformation", 1e3 * largest, "mm")
    if specimen is not None:
        name, values, unit = ("shear_strain", 100.0 * specimen.strain(largest), "%")
    temperatures = [_mean_C(series) for series in found.series]
    return {
        name: _span(float(values.min()), float(values.max()), unit),
        "temperature": _span(min(temperatures), max(temperatures), "degC"),
    }


def _mean_C(series: Series) -> float:
    return float(np.mean(series.temperature))


def _span(low: float, high: float, unit: str) -> str:
    texts = f"{low:.4g}", f"{high:.4g}"
    return f"{texts[0]} {unit}" if texts[0] == texts[1] else f"{texts[0]} to {texts[1]} {unit}"


def _estimate(estimate: Estimate) -> dict[str, Any]:
    return {
        "value": _finite(estimate.value),
        "standard_error": _finite(estimate.standard_error),
        "interval": [_finite(end) for end in estimate.interval],
        "unit": estimate.unit,
        **({"not_determined": estimate.untold} if estimate.untold else {}),
    }


def _finite(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
