"""A design of dampers of elastomer as variables of the archive."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from edesign.archive.dataset import Group
from edesign.study.design.elastomer.model import ElastomerModel, ElastomerSizing
from edesign.study.design.loop import Round
from edesign.study.design.results import DEVICE_COUNT, ONE, PLACE, STOREY, Column, Results, store_rows
from edesign.study.results.recording import coordinate

ASSEMBLIES = ("dampers", "dampers_and_braces")
_ASSEMBLIES = "with the storage stiffness of the dampers alone, or with their braces in series"
_BOTH = ("assembly", "mode")
_WAYS = (
    ("damping_strain_energy", "strain_energy", "by Eq. 5.6 with the modes of the frame with dampers"),
    ("damping_frequencies", "frequencies", "by Eq. 5.8 from the frequencies without and with dampers"),
    ("damping_complex", "complex", "of free vibration with complex stiffness"),
)
_DAMPER_STIFFNESS = "horizontal storage stiffness of the dampers of the storey, without braces"
_HISTORY_STRAIN = "effective strain of the layers, mean of the histories"
_PERIOD = "first period with dampers and braces"
_AREA_RATIO = "area of a layer over that of the prototype, A_D/A_P"


def _of_first(model: ElastomerModel, one: Round[ElastomerSizing], what: str) -> float:
    """A value of the first mode with the dampers of a round."""
    found = model.modal_damping(one.sizing)
    return found.lead.mean(getattr(found, what).__getitem__)


_STRAIN_STEPS: tuple[Column, ...] = (
    ("round", ONE, lambda m, row: row[0], "1", "round that the step belongs to"),
    ("taken", ONE, lambda m, row: row[1].strain, "1", "strain at which properties were taken"),
    ("reached", ONE, lambda m, row: row[1].reached, "1", "effective strain of these dampers"),
    ("G_storage", ONE, lambda m, row: row[1].moduli.G_storage, "Pa", "storage modulus"),
    ("loss_factor", ONE, lambda m, row: row[1].moduli.loss_factor, "1", "loss factor"),
)
_STRAIN: Column = (
    "damper_strain",
    PLACE,
    lambda m, r: r.dampers["strain"],
    "1",
    "estimated shear strain of the layers",
)

ELASTOMER = Results(
    storeys=(
        ("damper_stiffness", STOREY, lambda m, s: s.size, "N/m", _DAMPER_STIFFNESS),
        ("layer_area", STOREY, lambda m, s: s.area, "m^2", "area of one layer of elastomer"),
        ("area_ratio", STOREY, lambda m, s: s.area / m.building.law.layer_area, "1", _AREA_RATIO),
        DEVICE_COUNT,
    ),
    facts={
        "layers": lambda m, s: m.layers,
        "layer_thickness_m": lambda m, s: s.thickness,
        "total_layer_area_m2": lambda m, s: m.total_area(s.area),
        "prototypes": lambda m, s: m.total_area(s.area) / (m.building.law.layers * m.building.law.layer_area),
        "G_storage_Pa": lambda m, s: s.moduli.G_storage,
        "loss_factor": lambda m, s: s.moduli.loss_factor,
        "strain": lambda m, s: s.strain,
        "frequency_Hz": lambda m, s: s.frequency,
    },
    assemblies=(ASSEMBLIES, _ASSEMBLIES),
    modes=(
        (
            "period",
            _BOTH,
            lambda m, found: [2.0 * np.pi / d.omega[d.told] for d in found],
            "s",
            "natural period with dampers",
        ),
        *(
            (
                name,
                _BOTH,
                lambda m, found, way=way: [getattr(d, way)[d.told] for d in found],
                "1",
                f"added damping ratio {label}",
            )
            for name, way, label in _WAYS
        ),
    ),
    steps=(
        ("frequency", ONE, lambda m, i: i.frequency, "Hz", "frequency at which properties were taken"),
        ("next_frequency", ONE, lambda m, i: i.next_frequency, "Hz", "first frequency with these dampers"),
        ("G_storage", ONE, lambda m, i: i.moduli.G_storage, "Pa", "storage modulus"),
        ("loss_factor", ONE, lambda m, i: i.moduli.loss_factor, "1", "loss factor"),
        ("damping", ONE, lambda m, i: i.damping, "1", "added damping ratio of the first mode, Eq. 5.6"),
        ("damper_stiffness", STOREY, lambda m, i: i.stiffness, "N/m", "stiffness of the dampers"),
    ),
    rounds=(
        ("layer_thickness", ONE, lambda m, r: r.sizing.thickness, "m", "thickness of a layer"),
        ("strain", ONE, lambda m, r: r.sizing.strain, "1", "strain at which properties were taken"),
        ("history_strain", ONE, lambda m, r: None if r.outcome is None else r.outcome.strain, "1", _HISTORY_STRAIN),
        ("layer_area", STOREY, lambda m, r: r.sizing.area, "m^2", "area of one layer"),
        ("period", ONE, lambda m, r: 2.0 * math.pi / _of_first(m, r, "omega"), "s", _PERIOD),
        *(
            (
                name,
                ONE,
                lambda m, r, way=way: _of_first(m, r, way),
                "1",
                f"added damping ratio of the first mode, with braces, {label}",
            )
            for name, way, label in _WAYS
        ),
    ),
    identity=("strain", "layer_thickness", "layer_area"),
    estimate=(_STRAIN,),
    demand=_STRAIN,
    bounds={
        "stiffness_ratio": "storage stiffness of the dampers over that of the design",
        "damping": "added damping ratio of the first mode, Eq. 5.6",
    },
)


def store_steps(group: Group, model: ElastomerModel, rounds: Sequence[Round[ElastomerSizing]]) -> None:
    """Add what no other method has of its iterations: lateral forces, and steps of the strain."""
    steps = [step for r in rounds for step in r.sizing.iterations]
    for name in steps[0].values:
        unit = "N" if name.endswith("base_shear") else "1"
        values = [step.values[name] for step in steps]
        group.add(f"iteration_{name}", ("iteration",), values, unit, f"{name.replace('_', ' ')} under lateral forces")
    rows = [(r.number, step) for r in rounds for step in r.sizing.strain_steps]
    if rows:
        coordinate(group, "strain_step", np.arange(1, len(rows) + 1), "1", "number of the step, of all rounds")
        store_rows(group, model, "strain_step", _STRAIN_STEPS, rows)
