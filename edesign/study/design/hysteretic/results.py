"""A design of hysteretic dampers as variables of the archive."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from edesign.archive.dataset import Group
from edesign.project.dampers.designs import HYSTERETIC_TARGETS, Optimum
from edesign.study.design.bounds import Bound
from edesign.study.design.building import Building
from edesign.study.design.estimate import FrameEstimate
from edesign.study.design.hysteretic.estimate import HystereticEstimate, hysteretic_estimate
from edesign.study.design.hysteretic.model import HystereticFrame
from edesign.study.design.hysteretic.sizing import LARGEST_SHARE, HystereticSizing, damping_curve
from edesign.study.design.loop import Round
from edesign.study.design.optimum import objective
from edesign.study.design.results import (
    MODES,
    STROKE,
    of_storeys,
    store_bounds,
    store_devices,
    store_drifts,
    store_rounds,
    store_storeys,
)
from edesign.study.results.recording import coordinate

_DAMPING = "added equivalent damping ratio of the first mode, secant stiffness and loops with braces"
_CURVE_POINTS, _CURVE_START = 25, 0.01  # shares of the storey shears, in geometric steps up to the largest


def store_hysteretic_sizing(group: Group, frame: HystereticFrame, sizing: HystereticSizing, device: np.ndarray) -> None:
    """Add the dampers of each storey and the modes without and with them.

    Args:
        group: of the design.
        frame: with its dampers' law.
        sizing: the dampers.
        device: yield or slip force of one damper in each storey with dampers, (s,) N.
    """
    building, vibration, loop, number = frame.building, sizing.vibration, frame.loop, frame.spec.number
    store_storeys(group, building, number, sizing.brace)
    add = group.add
    without = "elastic shear of the storey without dampers"
    label = {
        "spectrum": f"{without}, CQC of the response spectrum",
        "first_mode": f"{without}, first mode",
        "given": "shear of the storey, given",
    }[frame.shear_of]
    add("storey_shear", ("storey",), frame.shears, "N", label)
    add("yield_force", ("storey",), sizing.yield_force, "N", "yield force of all dampers of the storey along its drift")
    label = "yield force of the dampers of the storey over its shear"
    add("shear_share", ("storey",), sizing.yield_force / frame.shears, "1", label)
    add("device_yield_force", ("storey",), device, "N", "yield or slip force of one damper")
    scale = device / loop.yield_force
    add("device_scale", ("storey",), scale, "1", "yield force of one damper over that of its law")
    at_places, restrained = frame.scale(sizing.yield_force), building.law.restrained
    stiffness = of_storeys(building, frame.stiffness(at_places)) / number
    add("device_stiffness", ("storey",), stiffness, "N/m", "initial stiffness of one damper, the largest of the storey")
    yields = of_storeys(building, frame.yield_deformation)
    label = "deformation at which it yields, the largest of the storey"
    add("device_yield_deformation", ("storey",), yields, "m", label)
    if restrained is not None:
        add("device_core_area", ("storey",), scale * restrained.area, "m^2", "area of the steel core, A_sc")
        label = "adjusted strength in tension, omega R_y F_ysc A_sc"
        add("device_adjusted_tension", ("storey",), scale * restrained.adjusted_tension, "N", label)
        label = "adjusted strength in compression, beta omega R_y F_ysc A_sc"
        add("device_adjusted_compression", ("storey",), scale * restrained.adjusted_compression, "N", label)
    devices = number * np.bincount(building.place_storey)
    add("device_count", ("storey",), devices, "1", "number of dampers in the storey")
    label = "drift over height at which dampers and braces yield, their feet held"
    add("yield_drift", ("storey",), frame.yield_drift(sizing.yield_force), "1", label)
    label = "deformation of the dampers at the amplitude of the design, first mode"
    stroke = of_storeys(building, vibration.secants.stroke)
    add("design_stroke", ("storey",), stroke, "m", label)
    label = "that deformation over the one at which they yield"
    ductility = of_storeys(building, vibration.secants.stroke / frame.yield_deformation)
    add("design_ductility", ("storey",), ductility, "1", label)
    core = frame.core_strain(vibration.secants.stroke)
    if core is not None:
        strain = of_storeys(building, core)
        add("design_core_strain", ("storey",), strain, "1", "strain of the steel core at that amplitude")
    secant = of_storeys(building, vibration.stiffness) / number
    add("device_secant_stiffness", ("storey",), secant, "N/m", "secant stiffness of one damper with its brace")
    group.attributes |= {
        "number": number,
        "places": int(building.place_storey.size),
        "hardening": loop.hardening,
        "target": next(key for key in HYSTERETIC_TARGETS if getattr(frame.spec, key) is not None),
        "share": sizing.share,
        "shear_of": frame.shear_of,
        "equivalent_damping": frame.spec.equivalent_damping,
        "roof_displacement_m": vibration.roof,
        "damping": vibration.damping,
        "damping_at_amplitude": vibration.damping_at_amplitude,
        "damping_average": vibration.damping_average,
    }
    elastic = frame.elastic_modes(sizing.yield_force)
    count = min(MODES, frame.bare.omega.size)
    coordinate(group, "mode", np.arange(1, count + 1), "1", "number of the mode")
    for name, modes, label in (
        ("bare_period", frame.bare, "natural period without dampers"),
        ("elastic_period", elastic, "natural period with dampers that do not yield, and braces"),
        ("period", vibration.modes, "natural period with the secants of dampers and braces"),
    ):
        add(name, ("mode",), 2.0 * np.pi / modes.omega[:count], "s", label)


def store_hysteretic_curve(group: Group, frame: HystereticFrame, sizing: HystereticSizing) -> None:
    """Add damping, period and largest drift of the first mode over the share of the storey shears.

    Args:
        group: of the design.
        frame: the frame of the design.
        sizing: the dampers of the design.
    """
    shares = np.geomspace(_CURVE_START, LARGEST_SHARE, _CURVE_POINTS)
    found = damping_curve(frame, sizing.yield_force / sizing.share, shares)
    coordinate(group, "curve_share", shares, "1", "yield forces over storey shears, sums over the storeys")
    add = group.add
    damping = [math.nan if v is None else v.damping for v in found]
    add("curve_damping", ("curve_share",), damping, "1", _DAMPING)
    periods = [math.nan if v is None else v.period for v in found]
    add("curve_period", ("curve_share",), periods, "s", "first period with the secants of dampers and braces")
    if frame.action is not None:
        unit, drift = sizing.yield_force / sizing.share, []
        for share, v in zip(shares, found, strict=True):
            estimate = None if v is None else hysteretic_estimate(frame, share * unit, v, frame.action)
            drift.append(math.nan if estimate is None else float(estimate.drift.max()))
        label = "largest storey drift over height estimated by the response spectrum"
        add("curve_storey_drift", ("curve_share",), drift, "1", label)


def store_hysteretic_rounds(
    group: Group, rounds: Sequence[Round[HystereticSizing]], devices: Sequence[np.ndarray], changed: str
) -> None:
    """Add the rounds of sizing and verification.

    Args:
        group: of the design, with its dampers.
        rounds: all.
        devices: yield force of one damper in each storey with dampers, (s,) N, of each round.
        changed: what the rounds change, for people.
    """
    store_rounds(group, rounds, changed, ())
    add = group.add
    add("round_device_yield_force", ("round", "storey"), np.array(devices), "N", "yield or slip force of one damper")
    shares = [r.sizing.share for r in rounds]
    add("round_share", ("round",), shares, "1", "yield forces over storey shears, sums over the storeys")
    periods = [r.sizing.vibration.period for r in rounds]
    add("round_period", ("round",), periods, "s", "first period with the secants of dampers and braces")
    damping = [r.sizing.vibration.damping for r in rounds]
    add("round_damping_equivalent", ("round",), damping, "1", _DAMPING)


def store_objectives(group: Group, rounds: Sequence[Round[HystereticSizing]], optimum: Optimum) -> None:
    """Add the objective of each round to the group of a design.

    Args:
        group: of the design.
        rounds: all rounds in their order.
        optimum: says what is minimised.
    """
    found = [math.nan if r.outcome is None else objective(r.outcome, optimum.least) for r in rounds]
    label = {"worst": "largest", "mean": "mean"}[optimum.least]
    group.add("round_objective", ("round",), found, "1", f"{label} demand over limit of the criteria: made least")


def store_hysteretic_estimate(
    group: Group, building: Building, number: int, found: HystereticEstimate, bare: FrameEstimate
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
    add = group.add
    ductility = of_storeys(building, found.ductility)
    add("estimated_device_ductility", ("storey",), ductility, "1", "that stroke over the deformation at yield")
    if found.core_strain is not None:
        strain = of_storeys(building, found.core_strain)
        add("estimated_device_core_strain", ("storey",), strain, "1", "strain of the steel core at that stroke")


def store_hysteretic_bounds(group: Group, building: Building, found: tuple[Bound[HystereticEstimate], ...]) -> None:
    """Add the estimated response with each bound of the forces, and the bound that governs each quantity.

    Args:
        group: of the design.
        building: the frame with its places.
        found: the response with lower, nominal and upper forces.
    """
    labels = ("forces of the dampers over those of the design", _DAMPING)
    store_bounds(group, building, found, labels, STROKE)
