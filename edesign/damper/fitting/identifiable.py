"""Parameters that force and deformation cannot determine, and the values they are fixed at by default."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace

from edesign.damper.fitting.scales import Scales
from edesign.damper.law import Law, Parameter
from edesign.errors import InputError


@dataclass(frozen=True)
class FixedParameter:
    """A parameter that is not fitted unless the user asks for it.

    Attributes:
        why: for people.
        value: SI, where neither start nor law gives one; in the unit of `of` if that is said; None: it must be given.
        of: "force": largest force of the tests; "frequency": their mean circular frequency; "": SI.
    """

    why: str
    value: float | None
    of: str = ""


_BOUC_WEN = {
    "A": FixedParameter("A only scales z, as the yield force and yield deformation do", 1.0),
    "gamma": FixedParameter(
        "it is held at A - beta: z is then 1 at most, and strength and Y are those of yielding", 0.5
    ),
}

_CORE = "it is measured on the brace; force and deformation determine F_ysc A_sc and KF E A_sc / L_wp alone"

FIXED: dict[str, dict[str, FixedParameter]] = {
    "buckling_restrained": {
        "A_sc": FixedParameter(_CORE, None),
        "E": FixedParameter(_CORE, None),
        "L_wp": FixedParameter(_CORE, None),
        "L_y": FixedParameter(_CORE, None),
        "strain1": FixedParameter("it is where omega1 and beta1 are asked for", None),
    },
    "friction": {"N": FixedParameter("only the slip force mu N acts on the damper", 1.0, "force")},
    "friction_pendulum": {"W": FixedParameter("only W/R, f_slow W and f_fast W act on the damper", 10.0, "force")},
    "ramberg_osgood": {"a": FixedParameter("only a / Fy^(n-1) enters the law", 1.0)},
    "bouc_wen": _BOUC_WEN,
    "modified_bouc_wen": _BOUC_WEN,
    "linearised": {"omega": FixedParameter("only zeta_eff / omega enters the force", 1.0, "frequency")},
    "mgmm": {
        "k0": FixedParameter("Eq. 4.29 contains only k0 + k_b, c1/k1 and c1/k1 k0 + c1 + c_b", 0.0),
        "c_b": FixedParameter("Eq. 4.29 contains only k0 + k_b, c1/k1 and c1/k1 k0 + c1 + c_b", 0.0),
    },
}
"""Parameters fixed by default, by law. Values that a start gives are kept: fixed is a value, not zero."""


LIMITED_BY = {"mgmm": {"c1": "c_b", "k_b": "k0"}}
"""Parameters that shrink to nothing where data want less than what another one, fixed above zero, gives already."""


_STEEPEST = 10.0  # -beta/A: unloads more than twenty times as steeply as it loads, which no test tells from at once


def is_bouc_wen(law: Law) -> bool:
    """Return whether a law has the z of Bouc and Wen, whose unit three of its parameters share."""
    return FIXED.get(law.name) is _BOUC_WEN


def held(law: Law, values: Mapping[str, float]) -> dict[str, float]:
    """Return parameters of a law with those that are held by others: gamma = A - beta of Bouc-Wen laws.

    z comes to (A / (beta + gamma))^(1/n). That is 1, so that the strength of the law is none of its shape.

    Args:
        values: all of its parameters, SI.
    """
    return {**values, "gamma": values["A"] - values["beta"]} if is_bouc_wen(law) else dict(values)


def as_held(law: Law, values: Mapping[str, float]) -> dict[str, float]:
    """Return the parameters that `held` leaves as they are, with which a law has the same force.

    With z = s z', Y and Fy are s times, and beta and gamma s^n times as large. Beyond the bounds of `beside` it is the
    nearest law within them.

    Args:
        values: all of its parameters, SI.
    """
    found, whole = dict(values), values.get("beta", 0.0) + values.get("gamma", 0.0)
    if not is_bouc_wen(law):
        return found
    size = max(whole / values["A"], (values["gamma"] / values["A"]) / (1.0 + _STEEPEST))
    factor = size ** (-1.0 / values["n"])
    found |= {name: factor * values[name] for name in ("Fy", "Y") if name in values}
    return held(law, found | {"beta": max(values["beta"] / size, -_STEEPEST * values["A"])})


def beside(law: Law, parameter: Parameter, values: Mapping[str, float], holds: bool = True) -> Parameter:
    """Return a parameter with the bounds that it has beside others.

    beta of Bouc-Wen laws leaves gamma above 0, or else loops make energy (Erlicher & Point 2004, C. R. Mecanique 332,
    51-57; tests/verification/test_verify_passivity.py). Where gamma is fixed and not `held`, beta is at least -gamma:
    z has a bound then.

    A search then stops there as at any bound. Where nothing but refused predictions shows it, all steps that lead
    beyond it are refused as a whole, and the search stands still in all its parameters.

    Args:
        parameter: of the law, or beside it.
        values: of parameters, SI; where those that it depends on are not among them, nothing is known of it.
        holds: whether parameters are held by others, see `held`.
    """
    if not is_bouc_wen(law) or parameter.name != "beta":
        return parameter
    if holds:
        return replace(
            parameter, lower=-_STEEPEST * values["A"], lower_allowed=True, upper=values["A"], upper_allowed=False
        )
    return replace(parameter, lower=-values["gamma"], lower_allowed=True) if "gamma" in values else parameter


def fixed_by_default(law: Law, start: Mapping[str, float] | None, scales: Scales, force: float) -> dict[str, float]:
    """Return the values of the parameters that are not fitted by default.

    Args:
        start: values the user gave, SI.
        scales: sizes in the tests.
        force: largest measured force, N.

    Returns:
        By name, SI; choices of the law that are no numbers for data to determine are among them.

    Raises:
        InputError: one of them must be given.
    """
    given = dict(start or {})
    values = {}
    for name, fixed in FIXED.get(law.name, {}).items():
        value = given.get(name, _value(fixed, scales, force))
        if value is None:
            raise InputError(f"fit of law {law.name}: `{name}` is needed from you: {fixed.why} [E-FIT-02]")
        values[name] = value
    for name, value in given.items():  # of further branches, whose first is fixed
        if _first(name) in values:
            values.setdefault(name, value)
    for parameter in law.parameters:
        if not parameter.fitted and parameter.default is not None:
            values[parameter.name] = given.get(parameter.name, parameter.default)
    return values


def why_fixed(law: Law, name: str) -> str:
    """Return the reason for which a parameter is fixed by default; "" if it is not."""
    fixed = FIXED.get(law.name, {}).get(name) or FIXED.get(law.name, {}).get(_first(name))
    return fixed.why if fixed else ""


def reasons_fixed(law: Law, fitted: Collection[str]) -> dict[str, str]:
    """Return the parameters that are fixed by default and were not fitted, with the reason."""
    return {name: why_fixed(law, name) for name in FIXED.get(law.name, {}) if name not in fitted}


def _first(name: str) -> str:
    """The name that a parameter of a branch has in the first one."""
    return f"{name.rstrip('0123456789')}1"


def _value(fixed: FixedParameter, scales: Scales, force: float) -> float | None:
    if fixed.value is None:
        return None
    return fixed.value * {"": 1.0, "force": force, "frequency": 1.0 / scales.time}[fixed.of]
