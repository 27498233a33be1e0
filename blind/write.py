"""Campaigns as files: campaign.yaml with CSVs in a folder, and the truth beside the folder."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from blind import law
from blind.campaign import Campaign
from blind.law import Parameters

_UNITS = {
    "k1": "kN/mm",
    "c1": "kN*s/mm",
    "k0": "kN/mm",
    "alpha": "",
    "k_a": "kN/mm",
    "k_b": "kN/mm",
    "u_ref": "mm",
    "c_a": "kN*s/mm",
    "c_b": "kN*s/mm",
    "v_ref": "mm/s",
}


def truth_path(folder: Path) -> Path:
    """Where the truth about a campaign's folder stands."""
    return folder.with_name(f"{folder.name}.truth.json")


def write(campaign: Campaign, folder: Path) -> Path:
    """Write a campaign; the truth last, so that it is there for whole campaigns only.

    Returns:
        The campaign file.
    """
    folder.mkdir(parents=True, exist_ok=True)
    for i, test in enumerate(campaign.tests):
        columns = [campaign.time[i], campaign.displacement[i], campaign.force[i]]
        header = "time_s,displacement_mm,force_kN"
        if campaign.temperature is not None:
            columns.append(campaign.temperature[i])
            header += ",temperature_C"
        form = ",".join(["%.9g"] * len(columns))
        rows = [form % row for row in zip(*(column.tolist() for column in columns), strict=True)]
        (folder / f"{test.name}.csv").write_text("\n".join([header, *rows, ""]), encoding="ascii")
    path = folder / "campaign.yaml"
    path.write_text(campaign_file(campaign), encoding="ascii")
    truth_path(folder).write_text(json.dumps(truth(campaign), indent=1) + "\n", encoding="ascii")
    return path


def truth(campaign: Campaign) -> dict[str, Any]:
    """What the judge knows."""
    return {
        "seed": campaign.seed,
        "number": campaign.planned.number,
        "kind": campaign.planned.kind,
        "effects": [
            {
                "name": h.effect.name,
                "kind": h.effect.kind,
                "form": h.effect.form,
                "size": h.effect.size,
                "nrms": h.alone,
                "nrms_beside_others": h.beside,
                "parameters": {
                    key: {"value": value, "unit": unit} for key, (value, unit) in h.effect.true_parameters().items()
                },
            }
            for h in campaign.hidden
        ],
        "nrms_of_effects": campaign.joint,
        "nrms_after_refit": campaign.after_refit,
        "noise_floor": campaign.floor,
        "noise_floor_with_channels": campaign.floor_with_law,
        "noise": vars(campaign.noise),
        "law": {
            "true": dict(campaign.true),
            "declared": dict(campaign.declared or law.TABLE_4_2),
            "exact": dict(campaign.true) == dict(campaign.declared or law.TABLE_4_2),
            "refit": campaign.refit,
        },
        "temperatures": len({test.temperature for test in campaign.tests}),
    }


def campaign_file(campaign: Campaign) -> str:
    """Text of campaign.yaml."""
    warm = len({test.temperature for test in campaign.tests}) > 1
    title = f"campaign {campaign.planned.number}" + (", temperatures with gamma_T of Table 4.4" if warm else "")
    lines = [
        f"title: '{title}'",
        f"specimen: {{name: prototype, layers: {law.LAYERS}, layer_area_mm2: {law.AREA_MM2}, "
        f"layer_thickness_mm: {law.THICKNESS_MM}}}",
        "law:",
        "  type: mgmm",
        *_parameters(campaign.declared),
        f"  refit: {'true' if campaign.refit else 'false'}",
        "tests:",
    ]
    for test in campaign.tests:
        conditions = f"temperature_C: {test.temperature:g}, use: {test.use}"
        lines.append(f"  - {{file: {test.name}.csv, title: '{test.title}', {conditions}}}")
    return "\n".join([*lines, ""])


def _parameters(declared: Parameters | None) -> list[str]:
    if declared is None:
        return ["  parameters: thesis_table_4_2"]
    units = {**_UNITS, "c_NL": f"kN*(s/mm)^{declared['alpha']:g}"}
    return ["  parameters:", *(f"    {name}: {value:g} {units[name]}".rstrip() for name, value in declared.items())]
