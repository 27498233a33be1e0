"""An identified rig as a rig file and as plain data."""

from __future__ import annotations

from typing import Any

import yaml

from edesign.substructure.rig.identify import IdentifiedRig
from edesign.substructure.rig.rig_fit import RigFit, RigParameter

KINDS = {0: "delay", 1: "first_order", 2: "second_order"}
"""Of rig files, by order."""
_SHOWN = {"s": (1e3, "ms"), "m": (1e6, "um")}
"""Units that a laboratory writes, with their number in an SI unit."""


def rig_file_text(found: IdentifiedRig) -> str:
    """Return the text of a rig file, which a file of substructure tests names by `rig: {file: rig.yaml}`."""
    chosen = found.chosen
    a0, a1, a2 = found.alpha
    data = {
        "rig": {"kind": KINDS[chosen.order], **{name: _text(one) for name, one in chosen.parameters.items()}},
        "alpha": [_rounded(a0), f"{_rounded(1e3 * a1)} ms", f"{_rounded(a2)} s^2"],
        "encoder_noise": f"{_rounded(1e6 * chosen.noise)} um",
        "standard_errors": {name: _text(_error(one)) for name, one in chosen.parameters.items()},
        "covariance": [[float(f"{value:.10g}") for value in row] for row in chosen.covariance],
        "source": f"{found.source.name}: {found.samples} samples in {found.step * found.samples:.4g} s; {found.why}",
    }
    return yaml.safe_dump(data, sort_keys=False, default_flow_style=None, width=1000, allow_unicode=True)


def rig_data(found: IdentifiedRig) -> dict[str, Any]:
    """Return what was found as plain data in SI, for JSON."""
    return {
        "source": str(found.source),
        "step": found.step,
        "samples": found.samples,
        "why": found.why,
        "rig": _fit_data(found.chosen),
        "tried": [
            {**_fit_data(fit), "criterion": value} for fit, value in zip(found.tried, found.criteria, strict=True)
        ],
        "alpha": list(found.alpha),
        "alpha_of_rig": list(found.alpha_of_rig),
        "notes": list(found.notes),
    }


def _fit_data(fit: RigFit) -> dict[str, Any]:
    numbers = {**fit.parameters, "low_frequency_delay": fit.low_frequency_delay}
    return {
        "kind": KINDS[fit.order],
        "parameters": {
            name: {"value": one.value, "standard_error": one.standard_error, "unit": one.unit}
            for name, one in numbers.items()
        },
        "covariance": fit.covariance.tolist(),
        "offset": fit.offset,
        "encoder_noise": fit.noise,
        "left": fit.left,
        "independent": fit.independent,
    }


def _error(one: RigParameter) -> RigParameter:
    return RigParameter(one.standard_error, 0.0, one.unit)


def _text(one: RigParameter) -> str | float:
    scale, unit = _SHOWN.get(one.unit, (1.0, one.unit))
    value = _rounded(scale * one.value)
    return f"{value} {unit}" if unit else value


def _rounded(value: float) -> float:
    return float(f"{value:.5g}")
