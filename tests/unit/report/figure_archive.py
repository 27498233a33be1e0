"""A small archive with known numbers, for figures: two variants under three records, one of them too much for one."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.writer import ArchiveWriter
from edesign.study.results.recording import coordinate

TEXT = """\
edesign: 1
title: Two storeys
frame:
  bays: [6 m]
  storeys: [4 m, 3 m]
  columns: [{storeys: all, section: HEB200, material: S275}]
  beams: [{floors: all, section: IPE300, material: S275}]
materials:
  S275: {law: bilinear, E: 210 GPa, fy: 275 MPa, hardening: 1 %}
analyses:
  - {name: modes, kind: modal, modes: 2}
masses:
  given: [{lines: all, floors: all, mass: 10 t}]
"""
RECORDS = ("Tabas1978_FER-L1", "ImperialValley1979_H-EMO000", "Borrego1942_B-ELC000")
TIME = np.linspace(0.0, 10.0, 101)


def history(variant: str, record: str, order: int, scale: float, **attributes: object) -> Group:
    """Two storeys; every quantity is `scale` times something simple."""
    group = Group()
    for name in ("floor", "storey"):
        coordinate(group, name, [1, 2], "1", name)
    coordinate(group, "time", TIME, "s", "time")
    coordinate(group, "column", ["C_A_1", "C_B_1", "C_A_2", "C_B_2"], "", "column")
    coordinate(group, "beam", ["B_1_1", "B_1_2"], "", "beam")
    coordinate(group, "end", ["start", "end"], "", "end")
    wave = np.sin(2.0 * np.pi * 0.3 * TIME)
    floors = scale * np.array([0.01, 0.02])
    add = group.add
    add("ground_acceleration", ("time",), 2.0 * wave, "m/s^2", "ground")
    add("floor_displacement", ("time", "floor"), np.outer(wave, floors), "m", "displacement")
    add("floor_displacement_max", ("floor",), 0.9 * floors, "m", "largest")
    add("floor_displacement_min", ("floor",), -floors, "m", "smallest")
    add("storey_drift_max", ("storey",), scale * np.array([0.01, 0.005]), "1", "largest")
    add("storey_drift_min", ("storey",), -scale * np.array([0.002, 0.001]), "1", "smallest")
    add("floor_acceleration_max", ("floor",), scale * np.array([3.0, 4.0]), "m/s^2", "largest")
    add("residual_storey_drift", ("storey",), scale * np.array([0.001, -0.002]), "1", "residual")
    add("storey_shear_max", ("storey",), scale * np.array([2e5, 1e5]), "N", "largest")
    add("base_shear", ("time",), scale * 2e5 * wave, "N", "base shear")
    rotation = scale * np.array([[0.004, 0.0], [0.006, 0.0], [0.0, 0.0], [0.0, 0.0]])
    add("column_plastic_rotation_max", ("column", "end"), rotation, "rad", "largest")
    add("beam_plastic_rotation_min", ("beam", "end"), -scale * np.array([[0.012, 0.03], [0.0, 0.0005]]), "rad", "least")
    axial = np.array([-4e5, -4e5, -2e5, -2e5])
    add("column_axial_force_max", ("column",), axial + scale * 1e5, "N", "largest")
    add("column_axial_force_min", ("column",), axial - scale * 2e5, "N", "smallest")
    coordinate(
        group, "energy_term", ["input", "kinetic", "damping", "elastic", "hysteretic", "p_delta", "dampers"], "", ""
    )
    ramp = np.linspace(0.0, scale * 1e4, TIME.size)
    terms = np.stack([ramp, 0.1 * ramp, 0.3 * ramp, 0.05 * ramp, 0.35 * ramp, 0.0 * ramp, 0.2 * ramp], axis=1)
    add("energy", ("time", "energy_term"), terms, "J", "energy")
    names = {"kind": "history", "variant": variant, "record": f"suite/{record}", "level": "DBE", "temperature_C": None}
    group.attributes |= {**names, "order": order, "status": "completed", "reason": "", "input_pga_m_s2": 2.0}
    group.attributes |= attributes
    return group


def small_archive(folder: Path, *more: tuple[str, Group]) -> Path:
    """Bare at scales 1, 2, 3 and damped at 0.5 and 0.8; the third damped history failed. `more`: path and group."""
    root = Group()
    root.add("project_text", (), np.array(TEXT), "", "project")
    with ArchiveWriter(folder / "small.h5", root) as writer:
        for i, record in enumerate(RECORDS):
            writer.write(f"analyses/bare.DBE.{record}", history("bare", record, i, 1.0 + i))
        for i, record in enumerate(RECORDS):
            group = history("damped", record, 10 + i, (0.5, 0.8, 9.0)[i])
            if i == 2:
                group.attributes |= {"status": "failed", "reason": "no equilibrium at 3 s"}
            writer.write(f"analyses/damped.DBE.{record}", group)
        for path, group in more:
            writer.write(path, group)
        return writer.finish({"status": "failed"})
