"""Files of a campaign, and its truth."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from blind.laboratories.wharf.campaign import Campaign
from blind.laboratories.wharf.laws import LAWS, REMEMBER, Array
from blind.laboratories.wharf.names import ACCEPT, NAMES


def write(of: Campaign, folder: Path, seed: int) -> Path:
    """Write a campaign and its truth.

    Args:
        of: the campaign.
        folder: of the campaign; the truth stands beside it.
        seed: for the record.

    Returns:
        The folder.
    """
    folder.mkdir(parents=True, exist_ok=True)
    for reading in of.readings:
        columns = [reading.time, reading.displacement, reading.force]
        header, form = "time_s,displacement_mm,force_kN", ["%.7g", "%.8g", "%.8g"]
        if reading.temperature is not None:
            columns.append(reading.temperature)
            header, form = header + ",temperature_C", [*form, "%.2f"]
        np.savetxt(folder / f"{reading.test.name}.csv", np.column_stack(columns), form, ",", header=header, comments="")
    text = yaml.safe_dump(_campaign(of), sort_keys=False, allow_unicode=True, width=110)
    (folder / "campaign.yaml").write_text(text, encoding="utf-8")
    truth = folder.with_name(f"{folder.name}.truth.json")
    truth.write_text(json.dumps(truth_of(of, folder.name, seed), indent=1) + "\n", encoding="utf-8")
    return folder


def _campaign(of: Campaign) -> dict[str, Any]:
    law: dict[str, Any] = {"type": of.law, "parameters": _with_units(of.law, of.stated)}
    if of.law == "mgmm":
        law["extremes"] = "lasting" if of.lasting else "fresh"
    file: dict[str, Any] = {"title": "Acceptance tests", "specimen": {"name": "specimen"}, "law": law}
    if of.order_unknown:
        file["order"] = "unknown"
    file["tests"] = []
    for i, reading in enumerate(of.readings):
        test: dict[str, Any] = {"file": f"{reading.test.name}.csv", "temperature_C": round(reading.typed, 1)}
        test["use"] = reading.test.use
        if of.say_start and reading.test.in_motion:
            test["start"] = "in_motion"
        if of.conditions is not None:
            test["conditions"] = {of.conditions[0]: of.conditions[1][i]}
        file["tests"].append(test)
    return file


def _with_units(law: str, values: Array) -> dict[str, Any]:
    """Parameters with units; the exponent stands in the unit as a number."""
    names, units = LAWS[law].names, LAWS[law].units
    numbers = {name: float(f"{value:.6g}") for name, value in zip(names, values, strict=True)}
    said: dict[str, Any] = {}
    for name, unit in zip(names, units, strict=True):
        for exponent in ("alpha_d", "alpha"):
            if unit.endswith("^" + exponent):
                unit = unit.removesuffix(exponent) + f"{numbers[exponent]:g}"
        said[name] = f"{numbers[name]:.6g} {unit}" if unit else numbers[name]
    return said


def _si(law: str, values: Array) -> dict[str, float]:
    """Parameters in SI, from kN and mm."""
    numbers = dict(zip(LAWS[law].names, map(float, values), strict=True))
    found = {}
    for name, unit in zip(LAWS[law].names, LAWS[law].units, strict=True):
        power = next((numbers[e] for e in ("alpha_d", "alpha") if unit.endswith(f"(s/mm)^{e}")), 1.0)
        over, under = unit.partition("/")[0], unit.partition("/")[2]
        scale = (1e3 if "kN" in over else 1.0) * (1e-3 if over.endswith("mm") else 1.0)
        found[name] = numbers[name] * scale * (1e3**power if "mm" in under else 1.0)
    return found


def truth_of(of: Campaign, name: str, seed: int) -> dict[str, Any]:
    """What the judge reads, and what people want to know beside it; parameters of laws in SI, others in kN and mm."""
    listed = []
    for effect, ratio in zip(of.effects, of.ratios, strict=True):
        entry: dict[str, Any] = {
            "name": effect.name,
            "description": NAMES[effect.name],
            "accept": list(ACCEPT.get(effect.name, ())),
            "stage": effect.kind.stage,
            "size": effect.size,
            "size_over_noise": None if math.isnan(ratio) else ratio,
            "draws": effect.draws,
        }
        test = effect.draws.get("test", effect.test)
        if test is not None:
            entry["test"] = of.tests[test].name
        listed.append(entry)
    return {
        "laboratory": "wharf",
        "name": name,
        "seed": seed,
        "category": of.category,
        "group": of.group,
        "law": of.law,
        "law_true": {"parameters": _si(of.law, of.true)},
        "law_declared": {"parameters": _si(of.law, of.stated), "exact": of.exact},
        "remembers_between_tests": of.lasting if of.law in REMEMBER else None,
        "tests_in_motion": of.in_motion,
        "in_motion": [test.name for test in of.tests if test.in_motion],
        "effects": listed,
        "noise_floor_validate": of.floor,
        "nrms_is": "root of noise power over force power, tests to validate pooled by their samples",
        "habits": of.habits,
        "tests": {
            test.name: {
                "use": test.use,
                "sampling_Hz": test.sampling,
                "fastest_Hz": test.plan.top,
                "temperature_C": test.temperature,
                "in_motion": test.in_motion,
            }
            for test in of.tests
        },
    }
