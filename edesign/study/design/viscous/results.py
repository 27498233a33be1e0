"""A design of viscous dampers as variables of the archive."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from edesign.archive.dataset import Group
from edesign.study.design.bounds import Bound
from edesign.study.design.building import Building
from edesign.study.design.loop import Round
from edesign.study.design.results import (
    STROKE,
    Column,
    of_storeys,
    store_bare_modes,
    store_bounds,
    store_devices,
    store_drifts,
    store_iterations,
    store_rounds,
    store_storeys,
)
from edesign.study.design.viscous.estimate import ViscousEstimate
from edesign.study.design.viscous.model import ViscousFrame
from edesign.study.design.viscous.sizing import ViscousSizing

_DAMPING = "added damping ratio of the first mode, complex eigenvalue with linear dashpots and braces"
_STEPS: tuple[Column, ...] = (
    ("frequency", lambda s: s.vibration.omega / (2.0 * math.pi), "Hz", "first frequency"),
    ("roof_displacement", lambda s: s.vibration.roof, "m", "amplitude of the first mode"),
    ("damping", lambda s: s.vibration.modes.first_damping, "1", _DAMPING),
    ("difference", lambda s: s.difference, "1", "of the linear dashpots from the next ones"),
)
_ROUNDS: tuple[Column, ...] = (
    ("period", lambda s: 2.0 * math.pi / s.vibration.omega, "s", "first period with dampers and braces"),
    ("damping_complex", lambda s: s.vibration.modes.first_damping, "1", _DAMPING),
)


def _coefficient_unit(alpha: float) -> str:
    """Return the unit of damping coefficients, e.g. N*(s/m)^0.35."""
    return "N*s/m" if alpha == 1.0 else f"N*(s/m)^{alpha:g}"


def store_viscous_sizing(group: Group, frame: ViscousFrame, sizing: ViscousSizing, device: np.ndarray) -> None:
    """Add the dampers of each storey and the modes without and with them.

    Args:
        group: of the design.
        frame: with its dampers' law.
        sizing: the dampers.
        device: coefficient of one damper in each storey with dampers, (s,) N (s/m)^alpha.
    """
    building, vibration, dashpot, number = frame.building, sizing.vibration, frame.dashpot, frame.spec.number
    store_storeys(group, building, number, sizing.brace)
    add, unit = group.add, _coefficient_unit(dashpot.alpha)
    label = "damping coefficient of all dampers of the storey along its drift"
    add("damping_coefficient", ("storey",), sizing.coefficient, unit, label)
    add("device_coefficient", ("storey",), device, unit, "damping coefficient c of one damper")
    add("device_scale", ("storey",), device / dashpot.c, "1", "coefficient of one damper over that of its law")
    devices = number * np.bincount(building.place_storey)
    add("device_count", ("storey",), devices, "1", "number of dampers in the storey")
    linear = of_storeys(building, vibration.linear) / number
    label = "linear dashpot of the energy of one damper at the amplitude of the design"
    add("device_linear_dashpot", ("storey",), linear, "N*s/m", label)
    if math.isfinite(dashpot.spring):
        label = "stiffness in series that belongs to one damper"
        add("device_spring", ("storey",), dashpot.spring * device / dashpot.c, "N/m", label)
    if math.isfinite(vibration.roof):
        stroke = of_storeys(building, vibration.stroke)
        add("design_stroke", ("storey",), stroke, "m", "amplitude of the dampers at which they count, first mode")
        group.attributes["roof_displacement_m"] = vibration.roof
    group.attributes |= {
        "alpha": dashpot.alpha,
        "frequency_Hz": vibration.omega / (2.0 * math.pi),
        "damping": vibration.modes.first_damping,
        "damping_fema356": sizing.formula,
    }
    modes = vibration.modes
    count = store_bare_modes(group, frame.bare, modes.omega.size)
    label = "2 pi over the size of the complex eigenvalue with dampers and braces"
    add("period", ("mode",), 2.0 * np.pi / modes.omega[:count], "s", label)
    label = "added damping ratio, complex eigenvalue with linear dashpots and braces"
    add("damping_complex", ("mode",), modes.damping[:count], "1", label)


def store_viscous_iterations(group: Group, rounds: Sequence[Round[ViscousSizing]]) -> None:
    """Add the iterations of all rounds, one after the other, to the group of a design.

    Args:
        group: of the design.
        rounds: all rounds in their order.
    """
    steps = store_iterations(group, rounds, _STEPS)
    coefficient = np.array([s.coefficient for s in steps])
    unit = group.variables["damping_coefficient"].unit
    label = "damping coefficient of all dampers of the storey along its drift"
    group.add("iteration_coefficient", ("iteration", "storey"), coefficient, unit, label)


def store_viscous_rounds(
    group: Group, rounds: Sequence[Round[ViscousSizing]], devices: Sequence[np.ndarray], changed: str
) -> None:
    """Add the rounds of sizing and verification.

    Args:
        group: of the design, with its dampers.
        rounds: all.
        devices: coefficient of one damper in each storey with dampers, (s,) N (s/m)^alpha, of each round.
        changed: what the rounds change, for people.
    """
    store_rounds(group, rounds, changed, _ROUNDS)
    unit = group.variables["device_coefficient"].unit
    label = "damping coefficient c of one damper"
    group.add("round_device_coefficient", ("round", "storey"), np.array(devices), unit, label)


def store_viscous_estimate(
    group: Group, building: Building, number: int, found: ViscousEstimate, bare: ViscousEstimate
) -> None:
    """Add the response that the spectrum estimates, with and without dampers, to the group of a design.

    Forces are of all dampers of a place; those of one are divided by their `number`.

    Args:
        group: of the design.
        building: the frame with its places.
        number: of dampers side by side at a place.
        found: estimated response with dampers.
        bare: estimated response without dampers.
    """
    store_drifts(group, building, found, bare)
    store_devices(group, building, number, found, found.damper_stroke)
    velocity = of_storeys(building, found.damper_velocity)
    group.add("estimated_device_velocity", ("storey",), velocity, "m/s", "estimated pseudo velocity of a damper")


def store_viscous_bounds(group: Group, building: Building, found: tuple[Bound[ViscousEstimate], ...]) -> None:
    """Add the estimated response with each bound of the coefficients, and the bound that governs each quantity.

    Args:
        group: of the design.
        building: the frame with its places.
        found: the response with lower, nominal and upper coefficients.
    """
    labels = ("coefficients of the dampers over those of the design", _DAMPING)
    store_bounds(group, building, found, labels, STROKE)
