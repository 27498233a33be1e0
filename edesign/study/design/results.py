"""A design as variables of the archive."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from edesign.archive.dataset import Group
from edesign.project.designs import Design
from edesign.study.design.bounds import Bound, governing
from edesign.study.design.building import Building
from edesign.study.design.damping import modal_damping
from edesign.study.design.estimate import Action, estimate
from edesign.study.design.loop import Round
from edesign.study.design.sizing import Sizing, total_area
from edesign.study.recording import coordinate

MODES = 3
ASSEMBLIES = ("dampers", "dampers_and_braces")
_WAYS = (
    ("damping_strain_energy", "strain_energy", "by Eq. 5.6 with the modes of the frame with dampers"),
    ("damping_frequencies", "frequencies", "by Eq. 5.8 from the frequencies without and with dampers"),
    ("damping_complex", "complex", "of free vibration with complex stiffness"),
)


def store_sizing(group: Group, building: Building, spec: Design, sizing: Sizing) -> None:
    """Add the dampers of each storey, the elastomer, and the modes without and with them."""
    coordinate(group, "storey", building.storeys, "1", "storey with dampers")
    coordinate(group, "frame_storey", np.arange(1, building.heights.size + 1), "1", "storey of the frame")
    add = group.add
    add("storey_stiffness", ("storey",), building.designed_stiffness, "N/m", "stiffness of the storey without dampers")
    label = "stiffness of the storey: shear over drift under the loads of the first mode, without dampers"
    add("computed_storey_stiffness", ("frame_storey",), building.computed_stiffness, "N/m", label)
    label = "horizontal storage stiffness of the dampers of the storey, without braces"
    add("damper_stiffness", ("storey",), sizing.stiffness, "N/m", label)
    add("layer_area", ("storey",), sizing.area, "m^2", "area of one layer of elastomer")
    ratio = sizing.area / building.prototype.layer_area
    add("area_ratio", ("storey",), ratio, "1", "area of a layer over that of the prototype, A_D/A_P")
    if sizing.brace is not None:
        label = "horizontal stiffness of the braces of the storey"
        add("brace_stiffness", ("storey",), sizing.brace, "N/m", label)
    group.attributes |= {
        "layers": building.layers,
        "number": spec.number,
        "places": int(building.place_storey.size),
        "layer_thickness_m": sizing.thickness,
        "total_layer_area_m2": total_area(building, spec, sizing.area),
        "G_storage_Pa": sizing.moduli.G_storage,
        "loss_factor": sizing.moduli.loss_factor,
        "frequency_Hz": sizing.frequency,
    }
    _store_modes(group, building, sizing)


def store_iterations(group: Group, rounds: Sequence[Round]) -> None:
    """Add the iterations of all rounds, one after the other."""
    rows = [(r.number, item) for r in rounds for item in r.sizing.iterations]
    coordinate(group, "iteration", np.arange(1, len(rows) + 1), "1", "number of the iteration, of all rounds")
    add = group.add
    add("iteration_round", ("iteration",), [number for number, _ in rows], "1", "round that the iteration belongs to")
    columns = (
        ("iteration_frequency", [i.frequency for _, i in rows], "Hz", "frequency at which properties were taken"),
        ("iteration_next_frequency", [i.next_frequency for _, i in rows], "Hz", "first frequency with these dampers"),
        ("iteration_G_storage", [i.moduli.G_storage for _, i in rows], "Pa", "storage modulus"),
        ("iteration_loss_factor", [i.moduli.loss_factor for _, i in rows], "1", "loss factor"),
        ("iteration_damping", [i.damping for _, i in rows], "1", "added damping ratio of the first mode, Eq. 5.6"),
    )
    for name, values, unit, label in columns:
        add(name, ("iteration",), np.array(values, dtype=float), unit, label)
    stiffness = np.array([item.stiffness for _, item in rows])
    add("iteration_damper_stiffness", ("iteration", "storey"), stiffness, "N/m", "stiffness of the dampers")
    for name in rows[0][1].values:
        unit = "N" if name.endswith("base_shear") else "1"
        values = [item.values[name] for _, item in rows]
        add(f"iteration_{name}", ("iteration",), values, unit, f"{name.replace('_', ' ')} under lateral forces")


def store_rounds(group: Group, building: Building, rounds: Sequence[Round], changed: str) -> None:
    """Add the rounds of sizing and verification."""
    coordinate(group, "round", [r.number for r in rounds], "1", "round of sizing and verification")
    add = group.add
    add("round_changed", ("round",), [r.changed for r in rounds], "1", f"what is changed: {changed}")
    add("round_target", ("round",), [r.sizing.target for r in rounds], "1", "target damping ratio, or beta")
    areas = np.array([r.sizing.area for r in rounds])
    add("round_layer_area", ("round", "storey"), areas, "m^2", "area of one layer")
    add("round_layer_thickness", ("round",), [r.sizing.thickness for r in rounds], "m", "thickness of a layer")
    bare = building.frame.modes()
    damping = [modal_damping(building.frame, bare, r.sizing.complex_stiffness(building)) for r in rounds]
    periods = [2.0 * math.pi / float(d.omega[0]) for d in damping]
    add("round_period", ("round",), periods, "s", "first period with dampers and braces")
    for name, way, label in _WAYS:
        values = [float(getattr(d, way)[0]) for d in damping]
        add(f"round_{name}", ("round",), values, "1", f"added damping ratio of the first mode, with braces, {label}")
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


def store_estimate(group: Group, building: Building, sizing: Sizing, action: Action) -> None:
    """Add the response that the spectrum estimates, without and with dampers."""
    brace = None if sizing.brace is None else building.at_places(sizing.brace)
    stiffness = sizing.complex_stiffness(building)
    with_dampers = estimate(building, action, stiffness, brace, sizing.thickness)
    without = estimate(building, action, 0.0 * stiffness, None, sizing.thickness)
    label = "storey drift over height estimated by the response spectrum"
    group.add("estimated_storey_drift", ("frame_storey",), with_dampers.drift, "1", f"{label}, with dampers")
    group.add("estimated_bare_storey_drift", ("frame_storey",), without.drift, "1", f"{label}, without dampers")
    strain = _of_storeys(building, with_dampers.damper_strain)
    group.add("estimated_damper_strain", ("storey",), strain, "1", "estimated shear strain of the layers")
    force = _of_storeys(building, with_dampers.damper_force)
    group.add("estimated_damper_force", ("storey",), force, "N", "estimated force of the dampers of a place")


def store_bounds(group: Group, building: Building, found: Sequence[Bound]) -> None:
    """Add the response with the bounds of the properties, and which of them governs each quantity."""
    coordinate(group, "bound", [b.name for b in found], "", "bound of the properties of the dampers")
    add = group.add
    temperatures = [math.nan if b.temperature_C is None else b.temperature_C for b in found]
    add("bound_factor", ("bound",), [b.factor for b in found], "1", "property modification factor")
    add("bound_temperature", ("bound",), temperatures, "degC", "temperature of the dampers; nan: that of the design")
    label = "storage stiffness of the dampers over that of the design"
    add("bound_stiffness_ratio", ("bound",), [b.stiffness_ratio for b in found], "1", label)
    periods = [2.0 * math.pi / float(b.damping.omega[0]) for b in found]
    add("bound_period", ("bound",), periods, "s", "first period with dampers and braces")
    damping = [float(b.damping.strain_energy[0]) for b in found]
    add("bound_damping", ("bound",), damping, "1", "added damping ratio of the first mode, Eq. 5.6")
    responses = [b.response for b in found]
    across = ("bound", "frame_storey")
    add("bound_storey_drift", across, [r.drift for r in responses], "1", "estimated storey drift over height")
    add("bound_column_shear", across, [r.storey_shear for r in responses], "N", "estimated shear of columns")
    roof = [r.roof_displacement for r in responses]
    add("bound_roof_displacement", ("bound",), roof, "m", "estimated displacement of the roof")
    add(
        "bound_base_shear", ("bound",), [r.base_shear for r in responses], "N", "estimated shear of columns and dampers"
    )
    forces = [_of_storeys(building, r.damper_force) for r in responses]
    add("bound_damper_force", ("bound", "storey"), forces, "N", "estimated force of the dampers of a place")
    strains = [_of_storeys(building, r.damper_strain) for r in responses]
    add("bound_damper_strain", ("bound", "storey"), strains, "1", "estimated shear strain of the layers")
    group.attributes["governing"] = governing(tuple(found))


def _store_modes(group: Group, building: Building, sizing: Sizing) -> None:
    bare = building.frame.modes()
    count = min(MODES, bare.omega.size)
    coordinate(group, "mode", np.arange(1, count + 1), "1", "number of the mode")
    label = "with the storage stiffness of the dampers alone, or with their braces in series"
    coordinate(group, "assembly", list(ASSEMBLIES), "", label)
    group.add("bare_period", ("mode",), 2.0 * np.pi / bare.omega[:count], "s", "natural period without dampers")
    found = [
        modal_damping(building.frame, bare, sizing.complex_stiffness(building, braces)) for braces in (False, True)
    ]
    periods = [2.0 * np.pi / damping.omega[:count] for damping in found]
    group.add("period", ("assembly", "mode"), periods, "s", "natural period with dampers")
    for name, way, label in _WAYS:
        values = [getattr(damping, way)[:count] for damping in found]
        group.add(name, ("assembly", "mode"), values, "1", f"added damping ratio {label}")


def _of_storeys(building: Building, of_places: np.ndarray) -> np.ndarray:
    """The largest of the places of each storey."""
    return np.array([of_places[building.place_storey == i].max() for i in range(building.storeys.size)])
