"""Fits as files: the law for project files in YAML, all of the fit in JSON."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import yaml

from edesign.damper.fitting.fit import Fit, mean_nrms
from edesign.damper.fitting.thermal import gamma_name
from edesign.damper.parameters import practical_unit, practical_units, write_parameters
from edesign.damper.testing.specimen import Specimen

_DIGITS = 9
_ERROR_DIGITS = 3


def law_yaml(fit: Fit, title: str = "", specimen: Specimen | None = None) -> str:
    """Return the fitted law as a law file, with the specimen, standard errors and the range that was tested.

    Args:
        title: for people.
    """
    parameters = {name: _text(*number) for name, number in practical(fit).items() if name in fit.values}
    data: dict[str, Any] = {"type": fit.law.name, "parameters": parameters}
    thermal = _temperature(fit)
    if thermal:
        data["temperature_law"] = thermal
    if specimen is not None:
        data["prototype"] = {
            "layers": specimen.layers,
            "layer_area": f"{1e6 * specimen.layer_area:.12g} mm^2",
            "layer_thickness": f"{1e3 * specimen.layer_thickness:.12g} mm",
        }
    data["standard_errors"] = practical_errors(fit, fit.standard_error)
    data["tested"] = tested(fit)
    head = f"# {fit.law.title}, fitted to {_counted(fit)}" + (f" of {title}" if title else "")
    lines = [
        head,
        f"# NRMS (of measured forces) {100.0 * fit.nrms_overall:.4g} %; standard errors: {fit.error_kind}",
    ]
    lines += [f"# {name}: fixed; {why}" for name, why in fit.fixed.items() if name in fit.values and why != "a choice"]
    lines += [f"# {warning}" for warning in fit.warnings]
    return "\n".join(lines) + "\n" + yaml.safe_dump(data, sort_keys=False, allow_unicode=True, width=1000)


def fit_json(fit: Fit) -> dict[str, Any]:
    """Return all of a fit in SI, for programs; numbers that are not finite are null."""
    return {
        "law": fit.law.name,
        "against": fit.against,
        "parameters": fit.values,
        "units": {parameter.name: parameter.unit for parameter in fit.law.all_parameters(fit.values)},
        "temperature": {"kind": fit.thermal.kind, "reference_C": fit.thermal.reference_C, **fit.thermal_values},
        "fitted": list(fit.free),
        "held": fit.fixed,
        "at_bound": fit.at_bound,
        "standard_error": _finite(fit.standard_error),
        "standard_error_white_noise": _finite(fit.standard_error_white),
        "standard_error_robust": _finite(fit.standard_error_robust),
        "error_kind": fit.error_kind,
        "correlation": fit.correlation.tolist(),
        "nrms_percent": {name: 100.0 * value for name, value in fit.nrms.items()},
        "nrms_percent_overall": 100.0 * fit.nrms_overall,
        "nrms_percent_mean": 100.0 * mean_nrms(fit.nrms),
        "rms_error_percent": {name: 100.0 * value for name, value in fit.rms_error.items()},
        "rms_error_over_peak_percent": {name: 100.0 * value for name, value in fit.peak_error.items()},
        "R2": _finite(fit.determination),
        "condition": fit.condition if math.isfinite(fit.condition) else None,
        "doubts": list(fit.warnings),
        "starts": {"costs": list(fit.starts), "same_minimum": fit.same_minimum},
        "iterations": fit.iterations,
        "evaluations": fit.evaluations,
        "converged": fit.converged,
        "samples": fit.samples,
        "independent_errors": fit.independent,
        "tested": tested(fit),
        "seconds": fit.seconds,
    }


def practical_errors(fit: Fit, errors: Mapping[str, float]) -> dict[str, str | float]:
    """Return standard errors in the units in which the parameters are written.

    Args:
        errors: by parameter, SI.
    """
    shown, units = practical(fit), practical_units(fit.law, fit.values)
    return {
        name: _text(error / units.get(name, (1.0, ""))[0], shown[name][1], _ERROR_DIGITS)
        for name, error in errors.items()
    }


def practical(fit: Fit) -> dict[str, tuple[float, str]]:
    """Return number and practical unit of every parameter, and of the unknowns of the temperature."""
    texts = write_parameters(fit.law, fit.values)
    found = {
        parameter.name: (
            float(texts[parameter.name].split(" ")[0]),
            practical_unit(parameter) if parameter.unit else "",
        )
        for parameter in fit.law.all_parameters(fit.values)
    }
    return found | {name: (value, "") for name, value in fit.thermal_values.items()}


def tested(fit: Fit) -> dict[str, str]:
    """Return the range of the tests for people."""
    low, high = fit.tested.deformation
    deformation = _span(100.0 * low, 100.0 * high, "%") if fit.tested.strain else _span(1e3 * low, 1e3 * high, "mm")
    return {
        "shear_strain" if fit.tested.strain else "deformation": deformation,
        "frequency": _span(*fit.tested.frequency, "Hz"),
        "temperature": _span(*fit.tested.temperature_C, "degC"),
    }


def _temperature(fit: Fit) -> dict[str, Any]:
    thermal, values = fit.thermal, fit.thermal_values
    if thermal.kind == "gamma":
        gammas = {t: 1.0 if t == thermal.reference_C else values[gamma_name(t)] for t in thermal.temperatures}
        return {"gamma_T": {f"{t:g} degC": float(f"{gamma:.12g}") for t, gamma in gammas.items()}}
    if thermal.kind == "ferry":
        reference = f"{thermal.reference_C:g} degC"
        return {"ferry": {"p1": values["p1"], "p2": f"{values['p2']:.12g} K", "reference": reference}}
    return {}


def _text(number: float, unit: str, digits: int = _DIGITS) -> str | float:
    """As it stands in YAML: text with its unit, or a plain number."""
    return f"{number:.{digits}g} {unit}" if unit else float(f"{number:.{digits}g}")


def _span(low: float, high: float, unit: str) -> str:
    texts = f"{low:.4g}", f"{high:.4g}"
    return f"{texts[0]} {unit}" if texts[0] == texts[1] else f"{texts[0]} to {texts[1]} {unit}"


def _counted(fit: Fit) -> str:
    return f"{len(fit.nrms)} tests" if fit.against == "forces" else f"{fit.samples} properties"


def _finite(values: Mapping[str, float]) -> dict[str, float | None]:
    return {name: value if math.isfinite(value) else None for name, value in values.items()}
