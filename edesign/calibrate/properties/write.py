"""A calibration by a property table as files: JSON for programs, the corrected law for projects."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from edesign.archive.files import make_folder, write_text, write_yaml
from edesign.calibrate.properties.repeatability import QUANTITIES
from edesign.calibrate.properties.result import PropertyCalibration
from edesign.calibrate.properties.shape import relative
from edesign.calibrate.result import Stage
from edesign.calibrate.write import calibration_json
from edesign.damper.effects_file import write_effects
from edesign.damper.laws import law as law_of
from edesign.damper.parameters import write_parameters

STAGES: tuple[Stage, ...] = ("declared", "refit", "corrected")


def property_calibration_json(calibration: PropertyCalibration) -> dict[str, Any]:
    """All that was found, and the rows; errors are mean squares of relative errors, moduli in Pa."""
    table = calibration.campaign.table
    use = {int(row): group.use for group in calibration.campaign.groups for row in group.rows}
    columns: dict[str, Any] = {
        "temperature_C": table.temperature_C,
        "strain": table.strain,
        "frequency_Hz": table.frequency,
        "use": [use[row] for row in range(len(table))],
        "measured": {name: _list(getattr(table, name)) for name in QUANTITIES},
    }
    columns |= {stage: {name: _list(getattr(calibration.rows[stage], name)) for name in QUANTITIES} for stage in STAGES}
    rows = {name: _list(values) if isinstance(values, np.ndarray) else values for name, values in columns.items()}
    rms = {
        stage: {
            part: {name: float(np.sqrt(np.mean(r[chosen] ** 2))) for name, r in residuals.items()}
            for part, chosen in (("fit", _used(calibration, "fit")), ("validate", _used(calibration, "validate")))
        }
        for stage in STAGES
        for residuals in (relative(calibration.rows[stage], table),)
    }
    told = calibration_json(calibration.found)
    return {**told, "repeatability": calibration.noise, "rms_relative_error": rms, "rows": rows}


def law_text(calibration: PropertyCalibration) -> str:
    """The corrected law as a law file."""
    found, law = calibration.found, law_of(calibration.found.law)
    corrected, specimen, table = calibration.law, calibration.campaign.specimen, calibration.campaign.table
    data: dict[str, Any] = {
        "type": law.name,
        "parameters": _six_digits(write_parameters(law, _rounded(corrected.values))),
    }
    if corrected.gamma_T is not None:
        data["temperature_law"] = {"gamma_T": {f"{t:g} degC": round(g, 6) for t, g in corrected.gamma_T.table}}
    if corrected.effects:
        data["effects"] = write_effects([replace(one, values=_rounded(one.values)) for one in corrected.effects])
        for effect in data["effects"]:
            effect["parameters"] = _six_digits(effect["parameters"])
    data["prototype"] = {
        "layers": specimen.layers,
        "layer_area": f"{1e6 * specimen.layer_area:.12g} mm^2",
        "layer_thickness": f"{1e3 * specimen.layer_thickness:.12g} mm",
    }
    data["tested"] = {
        "shear_strain": _span(100.0 * table.strain, "%"),
        "frequency": _span(table.frequency, "Hz"),
        "temperature": _span(table.temperature_C, "degC"),
    }
    error = {stage: 100.0 * float(np.sqrt(found.errors[stage].validate)) for stage in STAGES}
    head = [
        f"# {law.title}, calibrated by {len(table)} rows of {calibration.campaign.title or table.source}: "
        f"{found.verdict_words}",
        f"# rms relative error of the properties of rows held out {error['corrected']:.2f} %, as declared "
        f"{error['declared']:.2f} %, refitted {error['refit']:.2f} %",
        *(f"# {name} is held: {why}" for name, why in found.held.items()),
        *(f"# left out: {text}" for text in corrected.left_out),
        *(f"# left out: {one.effect.name}.{one.effect.form} (hypothesis): {one.why}" for one in found.hypotheses),
    ]
    return "\n".join(head) + "\n" + yaml.safe_dump(data, sort_keys=False, allow_unicode=True, width=1000)


def write_property_files(calibration: PropertyCalibration, folder: Path) -> list[Path]:
    """Write calibration.json and law.yaml; each appears when it is whole.

    Raises:
        ArchiveError: one cannot be written.
    """
    make_folder(folder)
    json_path, law_path = folder / "calibration.json", folder / "law.yaml"
    write_text(json.dumps(property_calibration_json(calibration), indent=1, allow_nan=False) + "\n", json_path)
    write_yaml(law_text(calibration), law_path, calibration.campaign.path)
    return [json_path, law_path]


def _used(calibration: PropertyCalibration, use: str) -> np.ndarray:
    return np.concatenate([group.rows for group in calibration.campaign.groups if group.use == use])


def _list(values: np.ndarray) -> list[float]:
    return [float(f"{value:.6g}") for value in values]


def _rounded(values: Mapping[str, float]) -> dict[str, float]:
    """Six digits in SI too: exponents stand in units."""
    return {name: float(f"{value:.6g}") for name, value in values.items()}


def _six_digits(texts: Any) -> dict[str, Any]:
    """Numbers with six digits: more are not known."""
    found: dict[str, Any] = {}
    for name, text in texts.items():
        number, _, unit = str(text).partition(" ")
        rounded = f"{float(number):.6g}"
        found[name] = f"{rounded} {unit}" if unit else float(rounded)
    return found


def _span(values: np.ndarray, unit: str) -> str:
    return f"{values.min():.4g} to {values.max():.4g} {unit}"
