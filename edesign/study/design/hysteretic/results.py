"""A design of hysteretic dampers as variables of the archive."""

from __future__ import annotations

import math

import numpy as np

from edesign.archive.dataset import Group
from edesign.project.dampers.designs import HYSTERETIC_TARGETS
from edesign.study.design.condensed import LinearModes
from edesign.study.design.hysteretic.model import HystereticModel
from edesign.study.design.hysteretic.sizing import LARGEST_SHARE, HystereticSizing, vibration_of
from edesign.study.design.loop import Round
from edesign.study.design.optimum import objective
from edesign.study.design.results import (
    DEVICE_COUNT,
    DEVICE_DEMANDS,
    MODE,
    ONE,
    PLACE,
    STOREY,
    STROKE,
    Results,
)
from edesign.study.results.recording import coordinate

_DAMPING = "added equivalent damping ratio of the first mode, secant stiffness and loops with braces"
_PERIOD = "first period with the secants of dampers and braces"
_DEVICE = "yield or slip force of one damper"
_CURVE_POINTS, _CURVE_START = 25, 0.01  # shares of the storey shears, in geometric steps up to the largest
_SHEARS = {
    "spectrum": "elastic shear of the storey {}, CQC of the response spectrum",
    "first_mode": "elastic shear of the storey {}, first mode",
    "given": "shear of the storey, given",
}
_TENSION = "adjusted strength in tension, omega R_y F_ysc A_sc"
_COMPRESSION = "adjusted strength in compression, beta omega R_y F_ysc A_sc"


def _scale(model: HystereticModel, sizing: HystereticSizing) -> np.ndarray:
    """Yield force of one damper of each storey over that of its law, (s,)."""
    return model.of_device(sizing.size) / model.loop.yield_force


def _periods(modes: LinearModes) -> np.ndarray:
    return np.asarray(2.0 * np.pi / modes.omega[modes.told])


def _objective(model: HystereticModel, one: Round[HystereticSizing]) -> float | None:
    """What an optimum makes least; None: there is no optimum, or no history."""
    optimum = model.spec.optimum
    return None if optimum is None or one.outcome is None else objective(one.outcome, optimum.least)


def _least(model: HystereticModel) -> str:
    """What that is."""
    assert model.spec.optimum is not None
    which = "largest" if model.spec.optimum.least == "worst" else "mean"
    return f"{which} demand over limit of the criteria: made least"


def _of_core(model: HystereticModel, sizing: HystereticSizing, name: str) -> np.ndarray | None:
    """A strength or area of the steel cores, (s,); None for other dampers."""
    restrained = model.building.law.restrained
    return None if restrained is None else _scale(model, sizing) * getattr(restrained, name)


_SHEAR_SHARE = "yield force of the dampers of the storey over its shear"
_DEVICE_YIELD_DEFORMATION = "deformation at which it yields, the largest of the storey"
_YIELD_DRIFT = "drift over height at which dampers and braces yield, their column bases fixed"
_DESIGN_STROKE = "deformation of the dampers at the amplitude of the design, first mode"
_DESIGN_CORE_STRAIN = "strain of the steel core at that amplitude"
_ELASTIC_PERIOD = "natural period with dampers that do not yield, and braces"
_PERIOD_LABEL = "natural period with the secants of dampers and braces"
_DEVICE_DUCTILITY = "that stroke over the deformation at yield"
_DEVICE_CORE_STRAIN = "strain of the steel core at that stroke"

HYSTERETIC = Results(
    storeys=(
        ("storey_shear", STOREY, lambda m, s: m.shears, "N", lambda m: _SHEARS[m.shear_of].format(m.without)),
        ("yield_force", STOREY, lambda m, s: s.size, "N", "yield force of all dampers of the storey along its drift"),
        ("shear_share", STOREY, lambda m, s: s.size / m.shears, "1", _SHEAR_SHARE),
        ("device_yield_force", STOREY, lambda m, s: m.of_device(s.size), "N", _DEVICE),
        ("device_scale", STOREY, _scale, "1", "yield force of one damper over that of its law"),
        (
            "device_stiffness",
            PLACE,
            lambda m, s: m.stiffness(m.scale(s.size)) / m.spec.number,
            "N/m",
            "initial stiffness of one damper, the largest of the storey",
        ),
        ("device_yield_deformation", PLACE, lambda m, s: m.yield_deformation, "m", _DEVICE_YIELD_DEFORMATION),
        ("device_core_area", STOREY, lambda m, s: _of_core(m, s, "area"), "m^2", "area of the steel core, A_sc"),
        ("device_adjusted_tension", STOREY, lambda m, s: _of_core(m, s, "adjusted_tension"), "N", _TENSION),
        ("device_adjusted_compression", STOREY, lambda m, s: _of_core(m, s, "adjusted_compression"), "N", _COMPRESSION),
        DEVICE_COUNT,
        ("yield_drift", STOREY, lambda m, s: m.yield_drift(s.size), "1", _YIELD_DRIFT),
        ("design_stroke", PLACE, lambda m, s: s.vibration.secants.stroke, "m", _DESIGN_STROKE),
        (
            "design_ductility",
            PLACE,
            lambda m, s: s.vibration.secants.stroke / m.yield_deformation,
            "1",
            "that deformation over the one at which they yield",
        ),
        ("design_core_strain", PLACE, lambda m, s: m.core_strain(s.vibration.secants.stroke), "1", _DESIGN_CORE_STRAIN),
        (
            "device_secant_stiffness",
            PLACE,
            lambda m, s: s.vibration.stiffness / m.spec.number,
            "N/m",
            "secant stiffness of one damper with its brace",
        ),
    ),
    facts={
        "hardening": lambda m, s: m.loop.hardening,
        "target": lambda m, s: next(key for key in HYSTERETIC_TARGETS if getattr(m.spec, key) is not None),
        "share": lambda m, s: s.share,
        "shear_of": lambda m, s: m.shear_of,
        "equivalent_damping": lambda m, s: m.spec.equivalent_damping,
        "roof_displacement_m": lambda m, s: s.vibration.roof,
        "damping": lambda m, s: s.vibration.damping,
        "damping_at_amplitude": lambda m, s: s.vibration.damping_at_amplitude,
        "damping_average": lambda m, s: s.vibration.damping_average,
    },
    modes=(
        ("elastic_period", MODE, lambda m, modes: _periods(modes[0]), "s", _ELASTIC_PERIOD),
        ("period", MODE, lambda m, modes: _periods(modes[1]), "s", _PERIOD_LABEL),
    ),
    steps=(),
    rounds=(
        ("device_yield_force", STOREY, lambda m, r: m.of_device(r.sizing.size), "N", _DEVICE),
        ("share", ONE, lambda m, r: r.sizing.share, "1", "yield forces over storey shears, sums over the storeys"),
        ("period", ONE, lambda m, r: r.sizing.vibration.period, "s", _PERIOD),
        ("damping_equivalent", ONE, lambda m, r: r.sizing.vibration.damping, "1", _DAMPING),
        ("objective", ONE, _objective, "1", _least),
    ),
    identity=("device_yield_force",),
    estimate=(
        *DEVICE_DEMANDS,
        ("device_ductility", PLACE, lambda m, r: r.dampers["ductility"], "1", _DEVICE_DUCTILITY),
        ("device_core_strain", PLACE, lambda m, r: r.dampers.get("core_strain"), "1", _DEVICE_CORE_STRAIN),
    ),
    demand=STROKE,
    bounds={"stiffness_ratio": "forces of the dampers over those of the design", "damping": _DAMPING},
)


def store_curve(group: Group, model: HystereticModel, sizing: HystereticSizing) -> None:
    """Add damping, period and largest drift of the first mode over the share of the storey shears."""
    shares = np.geomspace(_CURVE_START, LARGEST_SHARE, _CURVE_POINTS)
    unit = sizing.size / sizing.share
    found = [vibration_of(model, share * unit) for share in shares.tolist()]
    coordinate(group, "curve_share", shares, "1", "yield forces over storey shears, sums over the storeys")
    add = group.add
    add("curve_damping", ("curve_share",), [math.nan if v is None else v.damping for v in found], "1", _DAMPING)
    add("curve_period", ("curve_share",), [math.nan if v is None else v.period for v in found], "s", _PERIOD)
    action = model.action
    if action is not None:
        drift = [math.nan if v is None else float(model.drift(v, action).max()) for v in found]
        label = "largest storey drift over height estimated by the response spectrum"
        add("curve_storey_drift", ("curve_share",), drift, "1", label)
