"""A design of dampers of elastomer as variables of the archive."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from edesign.archive.dataset import Group
from edesign.project.dampers.designs import ElastomerDesign
from edesign.study.design.bounds import Bound, governing
from edesign.study.design.building import Building
from edesign.study.design.damping import modal_damping
from edesign.study.design.estimate import Action, Estimate, estimate
from edesign.study.design.loop import Round
from edesign.study.design.results import (
    MODES,
    of_storeys,
    store_bound_responses,
    store_drifts,
    store_storeys,
    store_verdicts,
)
from edesign.study.design.sizing import Sizing, layers, total_area
from edesign.study.recording import coordinate

ASSEMBLIES = ("dampers", "dampers_and_braces")
_WAYS = (
    ("damping_strain_energy", "strain_energy", "by Eq. 5.6 with the modes of the frame with dampers"),
    ("damping_frequencies", "frequencies", "by Eq. 5.8 from the frequencies without and with dampers"),
    ("damping_complex", "complex", "of free vibration with complex stiffness"),
)


def store_sizing(group: Group, building: Building, spec: ElastomerDesign, sizing: Sizing) -> None:
    """Add the dampers of each storey, the elastomer, and the modes without and with them."""
    store_storeys(group, building, sizing.brace)
    add = group.add
    label = "horizontal storage stiffness of the dampers of the storey, without braces"
    add("damper_stiffness", ("storey",), sizing.stiffness, "N/m", label)
    add("layer_area", ("storey",), sizing.area, "m^2", "area of one layer of elastomer")
    assert building.law.layer_area is not None, "the elastomer wants a prototype"
    ratio = sizing.area / building.law.layer_area
    add("area_ratio", ("storey",), ratio, "1", "area of a layer over that of the prototype, A_D/A_P")
    group.attributes |= {
        "layers": layers(building, spec),
        "number": spec.number,
        "places": int(building.place_storey.size),
        "layer_thickness_m": sizing.thickness,
        "total_layer_area_m2": total_area(building, spec, sizing.area),
        "G_storage_Pa": sizing.moduli.G_storage,
        "loss_factor": sizing.moduli.loss_factor,
        "frequency_Hz": sizing.frequency,
    }
    _store_modes(group, building, sizing)


def store_iterations(group: Group, rounds: Sequence[Round[Sizing]]) -> None:
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


def store_rounds(group: Group, building: Building, rounds: Sequence[Round[Sizing]], changed: str) -> None:
    """Add the rounds of sizing and verification."""
    store_verdicts(group, rounds, changed)
    add = group.add
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


def store_estimate(group: Group, building: Building, sizing: Sizing, action: Action) -> None:
    """Add the response that the spectrum estimates, without and with dampers."""
    brace = None if sizing.brace is None else building.at_places(sizing.brace)
    stiffness = sizing.complex_stiffness(building)
    with_dampers = estimate(building, action, stiffness, brace, sizing.thickness)
    without = estimate(building, action, 0.0 * stiffness, None, sizing.thickness)
    store_drifts(group, building, with_dampers, without)
    strain = of_storeys(building, with_dampers.damper_strain)
    group.add("estimated_damper_strain", ("storey",), strain, "1", "estimated shear strain of the layers")


def store_bounds(group: Group, building: Building, found: tuple[Bound[Estimate], ...]) -> None:
    """Add the response with the bounds of the properties, and which of them governs each quantity."""
    label = "storage stiffness of the dampers over that of the design"
    store_bound_responses(group, building, found, label, "added damping ratio of the first mode, Eq. 5.6")
    strains = [of_storeys(building, b.response.damper_strain) for b in found]
    group.add("bound_damper_strain", ("bound", "storey"), strains, "1", "estimated shear strain of the layers")
    group.attributes["governing"] = governing(found, {"damper_strain": lambda r: float(r.damper_strain.max())})


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
