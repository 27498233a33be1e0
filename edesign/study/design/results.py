"""What designs of all methods archive in the same way: rounds with their verdicts, estimates, bounds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from edesign.archive.dataset import Group
from edesign.study.design.bounds import Bound
from edesign.study.design.building import Building
from edesign.study.design.estimate import FrameEstimate
from edesign.study.design.loop import Round
from edesign.study.recording import coordinate

MODES = 3


def store_storeys(group: Group, building: Building, brace: np.ndarray | None) -> None:
    """Add the storeys of the frame and those with dampers, their stiffness and that of their braces, (s,) N/m."""
    coordinate(group, "storey", building.storeys, "1", "storey with dampers")
    coordinate(group, "frame_storey", np.arange(1, building.heights.size + 1), "1", "storey of the frame")
    add = group.add
    add("storey_stiffness", ("storey",), building.designed_stiffness, "N/m", "stiffness of the storey without dampers")
    label = "stiffness of the storey: shear over drift under the loads of the first mode, without dampers"
    add("computed_storey_stiffness", ("frame_storey",), building.computed_stiffness, "N/m", label)
    if brace is not None:
        label = "horizontal stiffness of the braces of the storey"
        add("brace_stiffness", ("storey",), brace, "N/m", label)


def store_verdicts(group: Group, rounds: Sequence[Round[Any]], changed: str) -> None:
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
    verified = [r for r in rounds if r.outcome is not None]
    met = [r.outcome.met if r.outcome is not None else False for r in rounds]
    add("round_met", ("round",), np.array(met, dtype=int), "1", "1: all criteria met, or no verification asked for")
    if not verified:
        return
    failed = [0 if r.outcome is None else len(r.outcome.failed) for r in rounds]
    add("round_failed_histories", ("round",), failed, "1", "histories that were not completed")
    first = verified[0].outcome
    assert first is not None
    names = [verdict.name for verdict in first.verdicts]
    if not names:
        return
    coordinate(group, "criterion", names, "", "name of the criterion")
    for part, label in (("value", "value that is judged"), ("limit", "its limit"), ("met", "1: met")):
        rows = np.full((len(rounds), len(names)), np.nan)
        for i, r in enumerate(rounds):
            if r.outcome is not None:
                rows[i] = [float(getattr(verdict, part)) for verdict in r.outcome.verdicts]
        add(f"verdict_{part}", ("round", "criterion"), rows, "1", f"{label}, in the unit of the criterion")
    group.attributes["failed_histories"] = {
        str(r.number): list(r.outcome.failed) for r in rounds if r.outcome is not None and r.outcome.failed
    }


def store_drifts(group: Group, building: Building, with_dampers: FrameEstimate, without: FrameEstimate) -> None:
    """Add the drifts that the spectrum estimates, without and with dampers, and the forces of these."""
    label = "storey drift over height estimated by the response spectrum"
    group.add("estimated_storey_drift", ("frame_storey",), with_dampers.drift, "1", f"{label}, with dampers")
    group.add("estimated_bare_storey_drift", ("frame_storey",), without.drift, "1", f"{label}, without dampers")
    force = of_storeys(building, with_dampers.damper_force)
    group.add("estimated_damper_force", ("storey",), force, "N", "estimated force of the dampers of a place")


def store_bound_responses(
    group: Group, building: Building, found: Sequence[Bound[Any]], ratio: str, damping: str
) -> None:
    """Add the response with the bounds of the properties.

    Args:
        group: of the design.
        building: the frame with its places.
        found: the bounds.
        ratio: what the ratio of each to the design is of, for people.
        damping: what its damping is, for people.
    """
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


def of_storeys(building: Building, of_places: np.ndarray) -> np.ndarray:
    """The largest of the places (d,) of each storey with dampers, (s,)."""
    return np.array([of_places[building.place_storey == i].max() for i in range(building.storeys.size)])
