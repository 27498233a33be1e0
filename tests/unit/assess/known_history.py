"""A history of two storeys (4 m and 3 m) whose measures can be read off."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group, Variable


def axis(name: str, values: object, unit: str = "1") -> dict[str, Variable]:
    return {name: Variable((name,), np.asarray(values), unit, name)}


def known_history(kind: str = "history", status: str = "completed") -> Group:
    group = Group(coords={**axis("floor", [1, 2]), **axis("storey", [1, 2])})
    group.coords |= {
        **axis("beam", ["B_1_1", "B_1_2"], ""),
        **axis("column", ["C_A_1", "C_B_1"], ""),
        **axis("end", ["start", "end"], ""),
    }

    def add(name: str, dim: tuple[str, ...], lowest: object, highest: object, unit: str) -> None:
        for end, values in (("min", lowest), ("max", highest)):
            group.add(f"{name}_{end}", dim, values, unit, f"{name} {end}")

    add("floor_displacement", ("floor",), [-0.04, -0.21], [0.05, 0.14], "m")
    add("storey_drift", ("storey",), [-0.010, -0.057], [0.0125, 0.03], "1")
    add("storey_shear", ("storey",), [-2e5, -1e5], [3e5, 0.5e5], "N")
    add("base_shear", (), -2e5, 3e5, "N")
    if kind == "history":
        add("floor_acceleration", ("floor",), [-7.0, -4.0], [3.0, 5.0], "m/s^2")
        add("floor_relative_acceleration", ("floor",), [-7.5, -6.0], [3.5, 5.5], "m/s^2")
        group.add("floor_displacement_final", ("floor",), [0.01, -0.03], "m", "floor displacement at the end")
        group.add("storey_drift_final", ("storey",), [0.0025, -0.0133], "1", "storey drift at the end")
        if status == "completed":
            group.add("residual_roof_displacement", (), -0.02, "m", "residual roof displacement")
            group.add("residual_storey_drift", ("storey",), [-0.0025, -0.0033], "1", "residual storey drift")
    add("beam_plastic_rotation", ("beam", "end"), [[-0.011, 0.0], [0.0, 0.0]], [[0.0, 0.0], [0.004, 0.0]], "rad")
    add("column_plastic_rotation", ("column", "end"), [[0.0, 0.0], [0.0, -0.001]], [[0.002, 0.0], [0.0, 0.0]], "rad")
    add("column_axial_force", ("column",), [-9e5, -8e5], [1e5, -2e5], "N")
    statistics = {"steps": 2000, "iterations": 4100, "refactorisations": 30, "fallbacks": 1, "cpu_s": 0.31}
    group.attributes = {
        "kind": kind,
        "status": status,
        "reason": "" if status == "completed" else "step 1500: no convergence",
        "height": 7.0,
        "record": "el_centro" if kind == "history" else None,
        "statistics": {**statistics, "energy_error": 2.5e-9},
        "events": [{"time": 2.5, "step": 250, "rung": "halved step", "detail": "4 substeps"}],
    }
    return group


def known_modes() -> Group:
    group = Group(coords=axis("mode", [1, 2]))
    group.add("period", ("mode",), [0.8, 0.25], "s", "period")
    group.add("effective_mass_ratio_x", ("mode",), [0.85, 0.15], "1", "effective modal mass ratio")
    group.attributes = {"kind": "modal", "status": "completed", "reason": ""}
    return group
