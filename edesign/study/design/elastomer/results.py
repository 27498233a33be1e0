"""A design of dampers of elastomer as variables of the archive."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from edesign.archive.dataset import Group
from edesign.project.dampers.designs import ElastomerDesign
from edesign.study.design.bounds import Bound
from edesign.study.design.building import Building
from edesign.study.design.damping import modal_damping
from edesign.study.design.elastomer.own_strain import effective_strain
from edesign.study.design.elastomer.sizing import Sizing, layers, total_area
from edesign.study.design.estimate import Action, Estimate, estimate
from edesign.study.design.loop import Round
from edesign.study.design.results import (
    Column,
    of_storeys,
    store_bare_modes,
    store_bounds,
    store_drifts,
    store_iterations,
    store_rounds,
    store_storeys,
)
from edesign.study.results.recording import coordinate

ASSEMBLIES = ("dampers", "dampers_and_braces")
_WAYS = (
    ("damping_strain_energy", "strain_energy", "by Eq. 5.6 with the modes of the frame with dampers"),
    ("damping_frequencies", "frequencies", "by Eq. 5.8 from the frequencies without and with dampers"),
    ("damping_complex", "complex", "of free vibration with complex stiffness"),
)
_STEPS: tuple[Column, ...] = (
    ("frequency", lambda i: i.frequency, "Hz", "frequency at which properties were taken"),
    ("next_frequency", lambda i: i.next_frequency, "Hz", "first frequency with these dampers"),
    ("G_storage", lambda i: i.moduli.G_storage, "Pa", "storage modulus"),
    ("loss_factor", lambda i: i.moduli.loss_factor, "1", "loss factor"),
    ("damping", lambda i: i.damping, "1", "added damping ratio of the first mode, Eq. 5.6"),
)
_ROUNDS: tuple[Column, ...] = (
    ("layer_thickness", lambda s: s.thickness, "m", "thickness of a layer"),
    ("strain", lambda s: s.strain, "1", "strain at which properties were taken"),
)


def store_elastomer_sizing(group: Group, building: Building, spec: ElastomerDesign, sizing: Sizing) -> None:
    """Add the dampers of each storey, the elastomer's properties, and the modes with and without dampers.

    Args:
        group: of the design.
        building: the frame with its places.
        spec: the design.
        sizing: the chosen dampers.
    """
    store_storeys(group, building, spec.number, sizing.brace)
    add = group.add
    label = "horizontal storage stiffness of the dampers of the storey, without braces"
    add("damper_stiffness", ("storey",), sizing.stiffness, "N/m", label)
    add("layer_area", ("storey",), sizing.area, "m^2", "area of one layer of elastomer")
    law = building.law
    assert law.layer_area is not None and law.layers is not None, "the elastomer wants a prototype"
    ratio = sizing.area / law.layer_area
    add("area_ratio", ("storey",), ratio, "1", "area of a layer over that of the prototype, A_D/A_P")
    total = total_area(building, spec, sizing.area)
    group.attributes |= {
        "layers": layers(building, spec),
        "layer_thickness_m": sizing.thickness,
        "total_layer_area_m2": total,
        "prototypes": total / (law.layers * law.layer_area),
        "G_storage_Pa": sizing.moduli.G_storage,
        "loss_factor": sizing.moduli.loss_factor,
        "strain": sizing.strain,
        "frequency_Hz": sizing.frequency,
    }
    _store_modes(group, building, sizing)


def store_elastomer_iterations(group: Group, rounds: Sequence[Round[Sizing]]) -> None:
    """Add the iterations of all rounds, one after the other, to the group of a design.

    Args:
        group: of the design.
        rounds: all rounds in their order.
    """
    steps = store_iterations(group, rounds, _STEPS)
    add = group.add
    stiffness = np.array([step.stiffness for step in steps])
    add("iteration_damper_stiffness", ("iteration", "storey"), stiffness, "N/m", "stiffness of the dampers")
    for name in steps[0].values:
        unit = "N" if name.endswith("base_shear") else "1"
        values = [step.values[name] for step in steps]
        add(f"iteration_{name}", ("iteration",), values, unit, f"{name.replace('_', ' ')} under lateral forces")


def store_strain_steps(group: Group, rounds: Sequence[Round[Sizing]]) -> None:
    """Add the steps of the strain iteration of all rounds, if the design iterates on the strain.

    Args:
        group: of the design.
        rounds: all rounds in their order.
    """
    rows = [(r.number, step) for r in rounds for step in r.sizing.strain_steps]
    if not rows:
        return
    coordinate(group, "strain_step", np.arange(1, len(rows) + 1), "1", "number of the step, of all rounds")
    columns = (
        ("round", [number for number, _ in rows], "1", "round that the step belongs to"),
        ("taken", [step.strain for _, step in rows], "1", "strain at which properties were taken"),
        ("reached", [step.reached for _, step in rows], "1", "effective strain of these dampers"),
        ("G_storage", [step.moduli.G_storage for _, step in rows], "Pa", "storage modulus"),
        ("loss_factor", [step.moduli.loss_factor for _, step in rows], "1", "loss factor"),
    )
    for name, values, unit, label in columns:
        group.add(f"strain_step_{name}", ("strain_step",), values, unit, label)


def store_elastomer_rounds(group: Group, building: Building, rounds: Sequence[Round[Sizing]], changed: str) -> None:
    """Add the rounds of sizing and verification.

    Args:
        group: of the design.
        building: the frame with its places.
        rounds: all.
        changed: what the rounds change, for people.
    """
    store_rounds(group, rounds, changed, _ROUNDS)
    add = group.add
    outcomes = [r.outcome for r in rounds]
    if any(outcomes):
        strains = [math.nan if outcome is None else outcome.strain for outcome in outcomes]
        label = "effective strain of the layers, mean of the histories"
        add("round_history_strain", ("round",), strains, "1", label)
    areas = np.array([r.sizing.area for r in rounds])
    add("round_layer_area", ("round", "storey"), areas, "m^2", "area of one layer")
    bare = building.frame.modes()
    damping = [modal_damping(building.frame, bare, r.sizing.complex_stiffness(building)) for r in rounds]
    periods = [2.0 * math.pi / float(d.omega[0]) for d in damping]
    add("round_period", ("round",), periods, "s", "first period with dampers and braces")
    for name, way, label in _WAYS:
        values = [float(getattr(d, way)[0]) for d in damping]
        add(f"round_{name}", ("round",), values, "1", f"added damping ratio of the first mode, with braces, {label}")


def store_elastomer_estimate(group: Group, building: Building, sizing: Sizing, action: Action) -> Estimate:
    """Add the response that the spectrum estimates, with and without dampers, to the group of a design.

    Args:
        group: of the design.
        building: the frame with its places.
        sizing: the chosen dampers.
        action: spectrum, and damping ratio of the frame without dampers.

    Returns:
        The estimated response with dampers.
    """
    brace = None if sizing.brace is None else building.at_places(sizing.brace)
    stiffness = sizing.complex_stiffness(building)
    with_dampers = estimate(building, action, stiffness, brace, sizing.thickness)
    without = estimate(building, action, 0.0 * stiffness, None, sizing.thickness)
    store_drifts(group, building, with_dampers, without)
    strain = of_storeys(building, with_dampers.damper_strain)
    group.add("estimated_damper_strain", ("storey",), strain, "1", "estimated shear strain of the layers")
    k_D = building.at_places(sizing.stiffness)
    group.attributes["estimated_strain"] = effective_strain(k_D, with_dampers.damper_strain)
    return with_dampers


def store_elastomer_bounds(group: Group, building: Building, found: tuple[Bound[Estimate], ...]) -> None:
    """Add the estimated response with each bound of the properties, and the bound that governs each quantity.

    Args:
        group: of the design.
        building: the frame with its places.
        found: the response with lower, nominal and upper properties.
    """
    ratio = "storage stiffness of the dampers over that of the design"
    strain = ("damper_strain", lambda r: r.damper_strain, "1", "estimated shear strain of the layers")
    store_bounds(group, building, found, (ratio, "added damping ratio of the first mode, Eq. 5.6"), strain)


def _store_modes(group: Group, building: Building, sizing: Sizing) -> None:
    bare = building.frame.modes()
    count = store_bare_modes(group, bare, bare.omega.size)
    label = "with the storage stiffness of the dampers alone, or with their braces in series"
    coordinate(group, "assembly", list(ASSEMBLIES), "", label)
    found = [
        modal_damping(building.frame, bare, sizing.complex_stiffness(building, braces)) for braces in (False, True)
    ]
    periods = [2.0 * np.pi / damping.omega[:count] for damping in found]
    group.add("period", ("assembly", "mode"), periods, "s", "natural period with dampers")
    for name, way, label in _WAYS:
        values = [getattr(damping, way)[:count] for damping in found]
        group.add(name, ("assembly", "mode"), values, "1", f"added damping ratio {label}")
