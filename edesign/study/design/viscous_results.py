"""A design of viscous dampers as variables of the archive."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from edesign.archive.dataset import Group
from edesign.study.design.bounds import Bound, governing
from edesign.study.design.building import Building
from edesign.study.design.loop import Round
from edesign.study.design.results import (
    MODES,
    of_storeys,
    store_bound_responses,
    store_drifts,
    store_storeys,
    store_verdicts,
)
from edesign.study.design.viscous import ViscousSizing
from edesign.study.design.viscous_estimate import ViscousEstimate
from edesign.study.design.viscous_frame import ViscousFrame
from edesign.study.recording import coordinate

_DAMPING = "added damping ratio of the first mode, complex eigenvalue with linear dashpots and braces"


def coefficient_unit(alpha: float) -> str:
    """Unit of damping coefficients, e.g. N*(s/m)^0.35."""
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
    store_storeys(group, building, sizing.brace)
    add, unit = group.add, coefficient_unit(dashpot.alpha)
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
        "number": number,
        "places": int(building.place_storey.size),
        "frequency_Hz": vibration.omega / (2.0 * math.pi),
        "damping": vibration.modes.first_damping,
        "damping_fema356": sizing.formula,
    }
    modes, bare = vibration.modes, frame.bare
    count = min(MODES, bare.omega.size, modes.omega.size)
    coordinate(group, "mode", np.arange(1, count + 1), "1", "number of the mode")
    add("bare_period", ("mode",), 2.0 * np.pi / bare.omega[:count], "s", "natural period without dampers")
    label = "2 pi over the size of the complex eigenvalue with dampers and braces"
    add("period", ("mode",), 2.0 * np.pi / modes.omega[:count], "s", label)
    label = "added damping ratio, complex eigenvalue with linear dashpots and braces"
    add("damping_complex", ("mode",), modes.damping[:count], "1", label)


def store_viscous_iterations(group: Group, rounds: Sequence[Round[ViscousSizing]]) -> None:
    """Add the iterations of all rounds, one after the other."""
    rows = [(r.number, item) for r in rounds for item in r.sizing.iterations]
    coordinate(group, "iteration", np.arange(1, len(rows) + 1), "1", "number of the iteration, of all rounds")
    add = group.add
    add("iteration_round", ("iteration",), [number for number, _ in rows], "1", "round that the iteration belongs to")
    steps = [step for _, step in rows]
    columns = (
        ("iteration_frequency", [s.vibration.omega / (2.0 * math.pi) for s in steps], "Hz", "first frequency"),
        ("iteration_roof_displacement", [s.vibration.roof for s in steps], "m", "amplitude of the first mode"),
        ("iteration_damping", [s.vibration.modes.first_damping for s in steps], "1", _DAMPING),
        ("iteration_difference", [s.difference for s in steps], "1", "of the linear dashpots from the next ones"),
    )
    for name, values, unit, label in columns:
        add(name, ("iteration",), np.array(values, dtype=float), unit, label)
    coefficient = np.array([s.coefficient for s in steps])
    unit = group.variables["damping_coefficient"].unit
    label = "damping coefficient of all dampers of the storey along its drift"
    add("iteration_coefficient", ("iteration", "storey"), coefficient, unit, label)


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
    store_verdicts(group, rounds, changed)
    unit = group.variables["device_coefficient"].unit
    label = "damping coefficient c of one damper"
    group.add("round_device_coefficient", ("round", "storey"), np.array(devices), unit, label)
    periods = [2.0 * math.pi / r.sizing.vibration.omega for r in rounds]
    group.add("round_period", ("round",), periods, "s", "first period with dampers and braces")
    damping = [r.sizing.vibration.modes.first_damping for r in rounds]
    group.add("round_damping_complex", ("round",), damping, "1", _DAMPING)


def store_viscous_estimate(
    group: Group, building: Building, number: int, found: ViscousEstimate, bare: ViscousEstimate
) -> None:
    """Add the response that the spectrum estimates, with (`found`) and without dampers (`bare`).

    Forces are of all dampers of a place; those of one are divided by their `number`.
    """
    store_drifts(group, building, found, bare)
    add = group.add
    force = of_storeys(building, found.damper_force) / number
    add("estimated_device_force", ("storey",), force, "N", "estimated force of one damper")
    stroke = of_storeys(building, found.damper_stroke)
    add("estimated_device_stroke", ("storey",), stroke, "m", "estimated stroke of a damper, without its brace")
    velocity = of_storeys(building, found.damper_velocity)
    add("estimated_device_velocity", ("storey",), velocity, "m/s", "estimated pseudo velocity of a damper")


def store_viscous_bounds(group: Group, building: Building, found: tuple[Bound[ViscousEstimate], ...]) -> None:
    """Add the response with the bounds of the coefficients, and which of them governs each quantity."""
    label = "coefficients of the dampers over those of the design"
    store_bound_responses(group, building, found, label, _DAMPING)
    strokes = [of_storeys(building, b.response.damper_stroke) for b in found]
    group.add("bound_damper_stroke", ("bound", "storey"), strokes, "m", "estimated stroke of the dampers")
    group.attributes["governing"] = governing(found, {"damper_stroke": lambda r: float(r.damper_stroke.max())})
