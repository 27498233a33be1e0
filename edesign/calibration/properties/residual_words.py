"""What residuals of properties look like, in words."""

from __future__ import annotations

import numpy as np

from edesign.calibration.properties.repeatability import QUANTITIES
from edesign.damper.testing.property_table import PropertyTable
from edesign.damper.testing.steady_state import PropertyRows

_WORDS = {"G_storage": "G'", "G_eq": "G_eq", "loss_factor": "the loss factor"}


def relative_errors(rows: PropertyRows, table: PropertyTable) -> dict[str, np.ndarray]:
    """Predicted over measured less one, (n,) each."""
    return {name: getattr(rows, name) / getattr(table, name) - 1.0 for name in QUANTITIES}


def describe_residual(rows: PropertyRows, table: PropertyTable) -> str:
    """Mean and size of what is left of each quantity, and where it is largest in the mean."""
    texts = []
    for name, residual in relative_errors(rows, table).items():
        driver, place, mean = _worst(residual, table)
        average, size = 100.0 * float(residual.mean()), 100.0 * float(np.sqrt(np.mean(residual**2)))
        most = f"most over {driver} ({100.0 * mean:+.1f} % at {place})"
        texts.append(f"{_WORDS[name]} {average:+.1f} % in the mean, {size:.1f} % rms, {most}")
    return "; ".join(texts) + "."


def _worst(residual: np.ndarray, table: PropertyTable) -> tuple[str, str, float]:
    """The driver over whose levels the means scatter most, and the level of the largest mean."""
    temperatures, strains, frequencies = table.levels
    best: tuple[float, str, str, float] | None = None
    for driver, column, levels, scale, unit in (
        ("temperature", table.temperature_C, temperatures, 1.0, "degC"),
        ("strain", table.strain, strains, 100.0, "%"),
        ("frequency", table.frequency, frequencies, 1.0, "Hz"),
    ):
        nearest = np.argmin(np.abs(column[:, None] - levels[None, :]), axis=1)
        means = np.array([residual[nearest == i].mean() for i in range(levels.size)])
        worst = int(np.argmax(np.abs(means - residual.mean())))
        scatter = float(np.std(means))
        if best is None or scatter > best[0]:
            best = (scatter, driver, f"{scale * levels[worst]:.4g} {unit}", float(means[worst]))
    assert best is not None
    return best[1:]
