"""The files of a calibration by a table of moduli: JSON for programs, the corrected law for projects."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from edesign.archive.files import make_folder, write_text, write_yaml
from edesign.calibration.properties.repeatability import QUANTITIES
from edesign.calibration.properties.residual_words import relative_errors
from edesign.calibration.properties.run import PropertyCalibration
from edesign.calibration.residual.series import STAGES
from edesign.calibration.results.law_file import law_lines, prototype_block, temperature_block
from edesign.calibration.results.write import JSON, LAW, calibration_json
from edesign.damper.effects_file import write_effects
from edesign.damper.laws import law as law_of
from edesign.damper.parameters import write_parameters
from edesign.damper.testing.measured_histories import USES, Use
from edesign.optional_stages import earlier, optional


def property_calibration_json(calibration: PropertyCalibration) -> dict[str, Any]:
    """Return all that was found, and the rows; errors are mean squares of relative errors, moduli in Pa."""
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
            part: {name: float(np.sqrt(np.mean(r[_used(calibration, part)] ** 2))) for name, r in residuals.items()}
            for part in USES
        }
        for stage in STAGES
        for residuals in (relative_errors(calibration.rows[stage], table),)
    }
    told = calibration_json(calibration.found)
    return {**told, "repeatability": calibration.repeats, "rms_relative_error": rms, "rows": rows}


def property_law_text(calibration: PropertyCalibration) -> str:
    """Return the corrected law as a law file."""
    found, law = calibration.found, law_of(calibration.found.law)
    file, table = found.law_file, calibration.campaign.table
    data: dict[str, Any] = {
        "type": law.name,
        "parameters": _six_digits(write_parameters(law, _rounded(file.parameters))),
    }
    if file.amendments:
        data["effects"] = write_effects([replace(one, values=_rounded(one.values)) for one in file.amendments])
        for effect in data["effects"]:
            effect["parameters"] = _six_digits(effect["parameters"])
    if file.temperature is not None:
        data["temperature_law"] = temperature_block(file.temperature)
    data["prototype"] = prototype_block(calibration.campaign.specimen)
    data["tested"] = {
        "shear_strain": _span(100.0 * table.strain, "%"),
        "frequency": _span(table.frequency, "Hz"),
        "temperature": _span(table.temperature_C, "degC"),
    }
    error = {stage: 100.0 * float(np.sqrt(found.errors[stage].validate)) for stage in STAGES}
    source = calibration.campaign.title or table.source
    head = [
        f"{law.title}, calibrated by {len(table)} rows of {source}: {found.verdict_words}",
        f"rms relative error of the properties of rows held out {100.0 * np.sqrt(file.validate):.2f} % with this law "
        f"and what was read, {error['corrected']:.2f} % corrected, {error['refit']:.2f} % refitted, "
        f"{error['declared']:.2f} % as declared",
        *law_lines(found),
    ]
    lines = "".join(f"# {line}\n" for line in head)
    return lines + yaml.safe_dump(data, sort_keys=False, allow_unicode=True, width=1000)


def write_property_files(calibration: PropertyCalibration, folder: Path) -> list[Path]:
    """Write calibration.json and law.yaml; each appears when it is whole.

    Args:
        calibration: what was found.
        folder: where the files go.

    Returns:
        The files.

    Raises:
        ArchiveError: one cannot be written.
    """
    make_folder(folder)
    told = json.dumps(property_calibration_json(calibration), indent=1, allow_nan=False) + "\n"
    write_text(told, folder / JSON)
    law = ""
    with optional("the corrected law", f"{folder / JSON} is written{earlier(folder / LAW)}"):
        law = property_law_text(calibration)
    if not law:
        return [folder / JSON]
    write_yaml(law, folder / LAW, calibration.campaign.path)
    return [folder / JSON, folder / LAW]


def _used(calibration: PropertyCalibration, use: Use) -> np.ndarray:
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
