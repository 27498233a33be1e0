"""What designs of all methods archive alike: storeys, modes, iterations, rounds with verdicts, estimates, bounds."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from edesign.archive.dataset import Group
from edesign.study.design.bounds import Bound, governing
from edesign.study.design.building import Building
from edesign.study.design.condensed import LinearModes
from edesign.study.design.estimate import FrameEstimate
from edesign.study.design.loop import Round
from edesign.study.design.verification import store_outcomes
from edesign.study.results.recording import coordinate

MODES = 3


Column = tuple[str, Callable[[Any], float], str, str]
"""Name of a variable, its value for one item, its unit and what it is."""
Demand = tuple[str, Callable[[Any], np.ndarray], str, str]
"""The same of what dampers have to bear at their places, (d,)."""

STROKE: Demand = ("damper_stroke", lambda r: r.damper_stroke, "m", "estimated stroke of the dampers")


def store_storeys(group: Group, building: Building, number: int, brace: np.ndarray | None) -> None:
    """Add the storeys of the frame and those with dampers, their stiffness, and how many dampers there are.

    Args:
        group: of the design.
        building: the frame with its places.
        number: of dampers side by side at a place.
        brace: stiffness of the braces of each storey with dampers, (s,) N/m; None: rigid.
    """
    group.attributes |= {"number": number, "places": int(building.place_storey.size)}
    coordinate(group, "storey", building.storeys, "1", "storey with dampers")
    coordinate(group, "frame_storey", np.arange(1, building.heights.size + 1), "1", "storey of the frame")
    add = group.add
    add("storey_stiffness", ("storey",), building.designed_stiffness, "N/m", "stiffness of the storey without dampers")
    label = "stiffness of the storey: shear over drift under the loads of the first mode, without dampers"
    add("computed_storey_stiffness", ("frame_storey",), building.computed_stiffness, "N/m", label)
    if brace is not None:
        label = "horizontal stiffness of the braces of the storey"
        add("brace_stiffness", ("storey",), brace, "N/m", label)


def store_bare_modes(group: Group, bare: LinearModes, known: int) -> int:
    """Add the axis of modes and the periods without dampers; return how many modes are archived.

    Args:
        group: of the design.
        bare: modes without dampers.
        known: how many are known with dampers.
    """
    count = min(MODES, bare.omega.size, known)
    coordinate(group, "mode", np.arange(1, count + 1), "1", "number of the mode")
    group.add("bare_period", ("mode",), 2.0 * np.pi / bare.omega[:count], "s", "natural period without dampers")
    return count


def store_iterations(group: Group, rounds: Sequence[Round[Any]], columns: Sequence[Column]) -> list[Any]:
    """Add the iterations of all rounds, one after the other, and return them.

    Args:
        group: of the design.
        rounds: all.
        columns: of an iteration, each a variable `iteration_NAME`.
    """
    rows = [(r.number, item) for r in rounds for item in r.sizing.iterations]
    coordinate(group, "iteration", np.arange(1, len(rows) + 1), "1", "number of the iteration, of all rounds")
    numbers = [number for number, _ in rows]
    group.add("iteration_round", ("iteration",), numbers, "1", "round that the iteration belongs to")
    items = [item for _, item in rows]
    for name, of, unit, label in columns:
        group.add(f"iteration_{name}", ("iteration",), np.array([of(item) for item in items], dtype=float), unit, label)
    return items


def store_rounds(group: Group, rounds: Sequence[Round[Any]], changed: str, columns: Sequence[Column]) -> None:
    """Add the rounds of sizing and verification, and their verdicts.

    Args:
        group: of the design.
        rounds: all.
        changed: what they change, for people.
        columns: of a sizing, each a variable `round_NAME`.
    """
    _store_verdicts(group, rounds, changed)
    for name, of, unit, label in columns:
        group.add(f"round_{name}", ("round",), [of(r.sizing) for r in rounds], unit, label)


def _store_verdicts(group: Group, rounds: Sequence[Round[Any]], changed: str) -> None:
    """Add what each round of sizing and verification changed and aimed at, and its verdicts.

    Args:
        group: of the design.
        rounds: all.
        changed: what they change, for people.
    """
    coordinate(group, "round", [r.number for r in rounds], "1", "round of sizing and verification")
    add = group.add
    add("round_changed", ("round",), [r.changed for r in rounds], "1", f"what is changed: {changed}")
    add("round_target", ("round",), [r.sizing.target for r in rounds], "1", "target: damping ratio, beta, or share")
    met = [r.outcome.met if r.outcome is not None else False for r in rounds]
    add("round_met", ("round",), np.array(met, dtype=int), "1", "1: all criteria met, or no verification asked for")
    store_outcomes(group, "round", [r.number for r in rounds], [r.outcome for r in rounds])
    drifts = [() if r.outcome is None else r.outcome.drift for r in rounds]
    storeys = max(map(len, drifts))
    if storeys:
        rows = [drift or (math.nan,) * storeys for drift in drifts]
        label = "storey drift over height, mean of the histories of the round; nan: none was completed"
        add("round_history_drift", ("round", "frame_storey"), rows, "1", label)


def store_drifts(group: Group, building: Building, with_dampers: FrameEstimate, without: FrameEstimate) -> None:
    """Add the storey drifts that the spectrum estimates, without and with dampers, and the estimated forces.

    Args:
        group: of the design.
        building: the frame with its places.
        with_dampers: the estimated response with dampers.
        without: the estimated response without dampers.
    """
    label = "storey drift over height estimated by the response spectrum"
    group.add("estimated_storey_drift", ("frame_storey",), with_dampers.drift, "1", f"{label}, with dampers")
    group.add("estimated_bare_storey_drift", ("frame_storey",), without.drift, "1", f"{label}, without dampers")
    label = "estimated shear of the columns, without dampers"
    group.add("estimated_column_shear", ("frame_storey",), with_dampers.storey_shear, "N", f"{label}' forces")
    force = of_storeys(building, with_dampers.damper_force)
    group.add("estimated_damper_force", ("storey",), force, "N", "estimated force of the dampers of a place")


def store_devices(group: Group, building: Building, number: int, found: FrameEstimate, stroke: np.ndarray) -> None:
    """Add the estimated force and stroke of one damper of each storey.

    Args:
        group: of the design.
        building: the frame with its places.
        number: of dampers side by side at a place.
        found: response with the force of all dampers of a place.
        stroke: of the dampers at their places, without braces, (d,) m.
    """
    force = of_storeys(building, found.damper_force) / number
    group.add("estimated_device_force", ("storey",), force, "N", "estimated force of one damper")
    label = "estimated stroke of a damper, without its brace"
    group.add("estimated_device_stroke", ("storey",), of_storeys(building, stroke), "m", label)


def store_bounds(
    group: Group,
    building: Building,
    found: tuple[Bound[Any], ...],
    labels: tuple[str, str],
    demand: Demand,
) -> None:
    """Add the estimated response with each bound of the properties, and the bound that governs each quantity.

    Args:
        group: of the design.
        building: the frame with its places.
        found: the bounds.
        labels: what the ratio of each to the design is of, and what its damping is, for people.
        demand: of the dampers by the method, at the places of a response, a variable `bound_NAME`.
    """
    ratio, damping = labels
    coordinate(group, "bound", [b.name for b in found], "", "bound of the properties of the dampers")
    add = group.add
    temperatures = [math.nan if b.temperature_C is None else b.temperature_C for b in found]
    add("bound_factor", ("bound",), [b.factor for b in found], "1", "property modification factor")
    add("bound_temperature", ("bound",), temperatures, "degC", "temperature of the dampers; nan: that of the design")
    add("bound_stiffness_ratio", ("bound",), [b.stiffness_ratio for b in found], "1", ratio)
    add("bound_period", ("bound",), [b.period for b in found], "s", "first period with dampers and braces")
    add("bound_damping", ("bound",), [b.damping for b in found], "1", damping)
    responses = [b.response for b in found]
    across = ("bound", "frame_storey")
    add("bound_storey_drift", across, [r.drift for r in responses], "1", "estimated storey drift over height")
    add("bound_column_shear", across, [r.storey_shear for r in responses], "N", "estimated shear of columns")
    roof = [r.roof_displacement for r in responses]
    add("bound_roof_displacement", ("bound",), roof, "m", "estimated displacement of the roof")
    add(
        "bound_base_shear", ("bound",), [r.base_shear for r in responses], "N", "estimated shear of columns and dampers"
    )
    forces = [of_storeys(building, r.damper_force) for r in responses]
    add("bound_damper_force", ("bound", "storey"), forces, "N", "estimated force of the dampers of a place")
    name, of, unit, label = demand
    demands = [of_storeys(building, of(r)) for r in responses]
    group.add(f"bound_{name}", ("bound", "storey"), demands, unit, label)
    group.attributes["governing"] = governing(found, {name: lambda r: float(of(r).max())})


def of_storeys(building: Building, of_places: np.ndarray) -> np.ndarray:
    """Return the largest value of the places of each storey with dampers, (s,).

    Args:
        building: the frame with its places.
        of_places: a value of each place, (d,).
    """
    return np.array([of_places[building.place_storey == i].max() for i in range(building.storeys.size)])
