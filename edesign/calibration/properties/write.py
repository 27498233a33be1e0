"""What files say of a calibration by a table of moduli: its rows for programs, the corrected law for projects."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from edesign.calibration.properties.outcome import PropertyCalibration
from edesign.calibration.properties.repeatability import QUANTITIES
from edesign.calibration.properties.residual_words import relative_errors
from edesign.calibration.residual.series import STAGES
from edesign.calibration.results.law_file import law_file_text, law_lines
from edesign.damper.effects_file import write_effects
from edesign.damper.laws import law as law_of
from edesign.damper.parameters import write_parameters
from edesign.damper.testing.measured_histories import USES, Use


def rows_json(found: PropertyCalibration) -> dict[str, Any]:
    """Return the rows, how well they repeat, and rms relative errors of each property; moduli in Pa."""
    table = found.campaign.table
    use = {int(row): group.use for group in found.campaign.groups for row in group.rows}
    columns: dict[str, Any] = {
        "temperature_C": _list(table.temperature_C),
        "strain": _list(table.strain),
        "frequency_Hz": _list(table.frequency),
        "use": [use[row] for row in range(len(table))],
        "measured": {name: _list(getattr(table, name)) for name in QUANTITIES},
    }
    columns |= {stage: {name: _list(getattr(found.rows[stage], name)) for name in QUANTITIES} for stage in STAGES}
    rms = {
        stage: {
            part: {name: float(np.sqrt(np.mean(r[_used(found, part)] ** 2))) for name, r in residuals.items()}
            for part in USES
        }
        for stage in STAGES
        for residuals in (relative_errors(found.rows[stage], table),)
    }
    return {"repeatability": found.repeats, "rms_relative_error": rms, "rows": columns}


def property_law_text(found: PropertyCalibration) -> str:
    """Return the corrected law as a law file, its numbers with six digits: more are not known."""
    law, file, table = law_of(found.law), found.law_file, found.campaign.table
    effects = write_effects([replace(one, values=_rounded(one.values)) for one in file.effects])
    for effect in effects:
        effect["parameters"] = _six_digits(effect["parameters"])
    tested = {
        "shear_strain": _span(100.0 * table.strain, "%"),
        "frequency": _span(table.frequency, "Hz"),
        "temperature": _span(table.temperature_C, "degC"),
    }
    error = {stage: 100.0 * float(np.sqrt(found.errors[stage].validate)) for stage in STAGES}
    head = [
        f"{law.title}, calibrated by {len(table)} rows of {found.campaign.title or table.source}: "
        f"{found.verdict_words}",
        f"rms relative error of the properties of rows held out {100.0 * np.sqrt(file.validate):.2f} % with this law "
        f"and what was read, {error['corrected']:.2f} % corrected, {error['refit']:.2f} % refitted, "
        f"{error['declared']:.2f} % as declared",
        *law_lines(found),
    ]
    parameters = _six_digits(write_parameters(law, _rounded(file.parameters)))
    return law_file_text(found, parameters, effects, found.campaign.specimen, tested, head)


def _used(found: PropertyCalibration, use: Use) -> np.ndarray:
    return np.concatenate([group.rows for group in found.campaign.groups if group.use == use])


def _list(values: np.ndarray) -> list[float]:
    return [float(f"{value:.6g}") for value in values]


def _rounded(values: Mapping[str, float]) -> dict[str, float]:
    """Six digits in SI too: exponents stand in units."""
    return {name: float(f"{value:.6g}") for name, value in values.items()}


def _six_digits(texts: Any) -> dict[str, Any]:
    """Numbers with six digits, and their units."""
    found: dict[str, Any] = {}
    for name, text in texts.items():
        number, _, unit = str(text).partition(" ")
        rounded = f"{float(number):.6g}"
        found[name] = f"{rounded} {unit}" if unit else float(rounded)
    return found


def _span(values: np.ndarray, unit: str) -> str:
    return f"{values.min():.4g} to {values.max():.4g} {unit}"
