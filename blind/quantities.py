"""Parameters that mean the same in the truth and in a result, so that intervals can be checked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

NORMAL_95 = 1.96

SI = {
    "s": (1.0, "s"),
    "ms": (1e-3, "s"),
    "s/m": (1.0, "s/m"),
    "N": (1.0, "N"),
    "kN": (1e3, "N"),
    "kg": (1.0, "kg"),
    "t": (1e3, "kg"),
    "Hz": (1.0, "Hz"),
    "m": (1.0, "m"),
    "mm": (1e-3, "m"),
    "N/m": (1.0, "N/m"),
    "kN/m": (1e3, "N/m"),
    "kN/mm": (1e6, "N/m"),
    "N/s": (1.0, "N/s"),
    "kN/s": (1e3, "N/s"),
    "1": (1.0, "1"),
    "-": (1.0, "1"),
    "": (1.0, "1"),
    "%": (1e-2, "1"),
}
"""Units with their factor and that of SI."""


@dataclass(frozen=True)
class Same:
    """A parameter of the truth, and names it may have in a result.

    Attributes:
        true: key in the truth.
        names: in results, in lower case.
        forms: of the truth, for which it means the same.
        in_forms: words one of which the result's form must hold; none: any form.
        sign: whether the sign is the same; else only sizes are compared.
    """

    true: str
    names: tuple[str, ...]
    forms: tuple[str, ...]
    in_forms: tuple[str, ...] = ()
    sign: bool = True


_K = ("stiffness", "k", "k_s", "ks", "k_series")
SAME: dict[str, tuple[Same, ...]] = {
    "lag": (
        Same(
            "delay",
            ("delay", "lag", "time", "shift", "dt", "tau"),
            ("force_late", "displacement_late"),
            ("delay", "lag", "shift"),
            sign=False,
        ),
        Same("delay", ("tau", "time_constant", "time", "delay"), ("first_order",), ("first", "filter"), sign=False),
    ),
    "inertia": (Same("mass", ("mass", "m"), ("rigid",)),),
    "friction": (Same("force", ("force", "friction", "friction_force", "f_c", "fc", "coulomb"), ("coulomb", "dahl")),),
    "hum": (
        Same("frequency", ("frequency", "f"), ("mains", "mains_with_harmonic", "pump")),
        Same("amplitude", ("amplitude", "a"), ("mains", "pump")),
    ),
    "series_flexibility": (Same("stiffness", _K, ("linear",), ("linear",)),),
    "play": (Same("gap", ("gap", "play", "g", "width"), ("gap", "backlash")),),
    "gain": (
        Same("gain", ("gain", "factor"), ("force_from_one_test", "force_all")),
        Same("error", ("error", "gain_error", "change"), ("force_from_one_test", "force_all")),
    ),
    "offset": (
        Same("force", ("offset", "force", "f0", "value"), ("force",)),
        Same("displacement", ("offset", "displacement", "u0", "value"), ("displacement",), sign=False),
    ),
    "drift": (Same("rate", ("rate", "slope", "drift"), ("linear_each_test",)),),
    "relaxation_branch": (
        Same("stiffness", ("k", "stiffness"), ("slow", "fast")),
        Same("relaxation_time", ("tau", "relaxation_time"), ("slow", "fast")),
    ),
    "velocity_exponent": (Same("exponent", ("alpha", "exponent", "p"), ("dashpot",)),),
    "hardening": (Same("power", ("p", "power", "exponent"), ("polynomial",)),),
    "static_offset": (
        Same("force", ("force", "load", "f0", "offset"), ("hanging_mass",)),
        Same(
            "pre_shear",
            ("pre_shear", "shear", "u0", "displacement", "deformation"),
            ("pre_shear", "pre_shear_tared"),
            sign=False,
        ),
    ),
}


def compared(true: Mapping[str, Any], found: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Parameters of one effect in truth and result: name, true value, value and standard error in SI, inside or not.

    Args:
        true: effect of a truth file.
        found: effect of the same name in a result.
    """
    out = []
    given = {name.lower(): value for name, value in (found.get("parameters") or {}).items()}
    form = str(found.get("form", "")).lower()
    for same in SAME.get(true["name"], ()):
        if true["form"] not in same.forms or (same.in_forms and not any(word in form for word in same.in_forms)):
            continue
        right = true["parameters"][same.true]
        scale, dimension = SI[right["unit"]]
        for name in same.names:
            parameter = given.get(name)
            if not isinstance(parameter, Mapping) or parameter.get("value") is None:
                continue
            unit, its_dimension = SI.get(str(parameter.get("unit") or ""), (1.0, "unknown"))
            if its_dimension != dimension:
                continue
            a, b = scale * right["value"], unit * float(parameter["value"])
            error = unit * float(parameter.get("standard_error") or 0.0)
            miss = abs(b - a) if same.sign else abs(abs(b) - abs(a))
            out.append(
                {"name": same.true, "true": a, "value": b, "standard_error": error, "inside": miss <= NORMAL_95 * error}
            )
            break
    return out
