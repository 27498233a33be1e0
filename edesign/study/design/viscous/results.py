"""A design of viscous dampers as variables of the archive."""

from __future__ import annotations

import math

import numpy as np

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
from edesign.study.design.viscous.model import ViscousModel

_DAMPING = "added damping ratio of the first mode, complex eigenvalue with linear dashpots and braces"
_COEFFICIENT = "damping coefficient of all dampers of the storey along its drift"
_LINEAR = "linear dashpot of the energy of one damper at the amplitude of the design"
_DEVICE = "damping coefficient c of one damper"


def _unit(model: ViscousModel) -> str:
    """The unit of damping coefficients, e.g. N*(s/m)^0.35."""
    alpha = model.dashpot.alpha
    return "N*s/m" if alpha == 1.0 else f"N*(s/m)^{alpha:g}"


_DEVICE_SCALE = "coefficient of one damper over that of its law"
_PERIOD = "2 pi over the size of the complex eigenvalue with dampers and braces"
_DAMPING_COMPLEX = "added damping ratio, complex eigenvalue with linear dashpots and braces"

VISCOUS = Results(
    storeys=(
        ("damping_coefficient", STOREY, lambda m, s: s.size, _unit, _COEFFICIENT),
        ("device_coefficient", STOREY, lambda m, s: m.of_device(s.size), _unit, _DEVICE),
        ("device_scale", STOREY, lambda m, s: m.of_device(s.size) / m.dashpot.c, "1", _DEVICE_SCALE),
        DEVICE_COUNT,
        ("device_linear_dashpot", PLACE, lambda m, s: s.vibration.linear / m.spec.number, "N*s/m", _LINEAR),
        (
            "device_spring",
            STOREY,
            lambda m, s: (
                m.dashpot.spring * m.of_device(s.size) / m.dashpot.c if math.isfinite(m.dashpot.spring) else None
            ),
            "N/m",
            "stiffness in series that belongs to one damper",
        ),
        (
            "design_stroke",
            PLACE,
            lambda m, s: s.vibration.stroke if math.isfinite(s.vibration.roof) else None,
            "m",
            "amplitude of the dampers at which they count, first mode",
        ),
    ),
    facts={
        "roof_displacement_m": lambda m, s: s.vibration.roof if math.isfinite(s.vibration.roof) else None,
        "alpha": lambda m, s: m.dashpot.alpha,
        "frequency_Hz": lambda m, s: s.vibration.omega / (2.0 * math.pi),
        "damping": lambda m, s: s.vibration.modes.first_damping,
        "damping_fema356": lambda m, s: s.formula,
    },
    modes=(
        ("period", MODE, lambda m, modes: 2.0 * np.pi / modes.omega[modes.told], "s", _PERIOD),
        ("damping_complex", MODE, lambda m, modes: modes.damping[modes.told], "1", _DAMPING_COMPLEX),
    ),
    steps=(
        ("frequency", ONE, lambda m, i: i.vibration.omega / (2.0 * math.pi), "Hz", "first frequency"),
        ("roof_displacement", ONE, lambda m, i: i.vibration.roof, "m", "amplitude of the first mode"),
        ("damping", ONE, lambda m, i: i.vibration.modes.first_damping, "1", _DAMPING),
        ("difference", ONE, lambda m, i: i.difference, "1", "of the linear dashpots from the next ones"),
        ("coefficient", STOREY, lambda m, i: i.vibration.coefficient, _unit, _COEFFICIENT),
    ),
    rounds=(
        (
            "period",
            ONE,
            lambda m, r: 2.0 * math.pi / r.sizing.vibration.omega,
            "s",
            "first period with dampers and braces",
        ),
        ("damping_complex", ONE, lambda m, r: r.sizing.vibration.modes.first_damping, "1", _DAMPING),
        ("device_coefficient", STOREY, lambda m, r: m.of_device(r.sizing.size), _unit, _DEVICE),
    ),
    identity=("device_coefficient",),
    estimate=(
        *DEVICE_DEMANDS,
        ("device_velocity", PLACE, lambda m, r: r.dampers["velocity"], "m/s", "estimated pseudo velocity of a damper"),
    ),
    demand=STROKE,
    bounds={"stiffness_ratio": "coefficients of the dampers over those of the design", "damping": _DAMPING},
)
