"""A small building, and the history of one that was never analysed: its motion is a formula."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from edesign.archive.dataset import Group, Variable
from edesign.archive.writer import ArchiveWriter
from edesign.project.building import load_building
from edesign.project.building.building import Building
from edesign.study.results.provenance import root_group

TEXT = """\
edesign_building: 1
title: Two storeys with a terrace
plan: {x: [6 m, 5 m], y: [4 m, 4 m]}
storeys: [4 m, 3 m]
setbacks: [{floors: 2, bays: {x: 1, y: all}}]
supports: {default: fixed, C1: pinned}
columns: [{storeys: all, section: HEB260, material: S275, strong: x}]
beams:
  - {along: x, section: IPE360, material: S275}
  - {along: y, section: IPE300, material: S275}
  - {along: y, frames: [C], section: IPE300, material: S275, ends: {start: pinned}}
braces:
  - {along: y, frames: [A], bays: 1, storeys: 1, kind: chevron, section: SHS120x5, material: S275}
materials: {S275: {fy: 275 MPa}}
loads: {areas: [{floors: all, G: 5 kN/m^2, Q: 2 kN/m^2, category: B, spans: x}]}
masses: {from_loads: {G: 1.0, Q: 0.3}}
"""
DAMPERS = ("VX_1_1_1", "RY_C_1_1", "N_B1.0_B2.1", "FX_9_1_1")  # the last one in a frame that is not there
CENTRE = np.array((5.0, 4.0))  # about which floors turn, m; neither a node nor their middle
STEP, PICTURES = 0.04, 120


def small_building(folder: Path) -> Building:
    """Write the file of the building and load it."""
    path = folder / "building.yaml"
    path.write_text(TEXT, encoding="utf-8")
    return load_building(path)


def formula(nodes: dict[str, tuple[float, ...]], time: np.ndarray) -> np.ndarray:
    """Displacements and rotations of nodes, (times, nodes, 6) m and rad: floors are rigid in plan."""
    x, y, z = np.array(list(nodes.values())).T
    share, t = z / 7.0, time[:, np.newaxis]
    ux, uy, turn = 0.06 * np.sin(5.0 * t) * share, 0.03 * np.cos(4.0 * t) * share, 4e-3 * np.sin(3.0 * t) * share
    up = -2e-3 * share * (1.0 + np.sin(2.0 * t) * x / 11.0)
    about_y = 8e-3 * np.sin(5.0 * t) * (z > 0.0)
    about_x = -4e-3 * np.cos(4.0 * t) * (z > 0.0) * y / 8.0
    parts = (ux - turn * (y - CENTRE[1]), uy + turn * (x - CENTRE[0]), up, about_x, about_y, turn)
    return np.stack([np.broadcast_to(part, (len(time), len(x))) for part in parts], axis=-1)


def moving_group(building: Building, motion: bool = True) -> Group:
    """The history by the names of archives.

    Args:
        motion: whether nodes and plastic rotations were kept.
    """
    time = STEP * np.arange(PICTURES)
    nodes, layout = dict(building.layout.nodes), building.layout
    moved = formula(nodes, time)
    corner = {name: i for i, name in enumerate(nodes)}
    group = Group(attributes={"kind": "history", "status": "completed", "level": "DBE", "record": "wave", "reason": ""})

    def along(name: str, values: object) -> None:
        group.coords[name] = Variable((name,), np.asarray(values), "", name)

    members = {kind: [m for m in layout.members if m[0] == kind[0].upper()] for kind in ("column", "beam")}
    points = [(floor, line) for floor in (1, 2) for line in ("A1", "B1", "A3", "B3")]
    along("time", time)
    along("floor", [1, 2])
    along("storey", [1, 2])
    along("direction", ["x", "y"])
    along("end", ["start", "end"])
    along("axis", ["y", "z"])
    along("damper", list(DAMPERS))
    along("point", [f"{line}.{floor}" for floor, line in points])
    along("column", members["column"])
    along("beam", members["beam"])
    centre = {f"m{level}": (*CENTRE, level) for level in (4.0, 7.0)}
    floors = formula(centre, time)
    drift = np.diff(np.concatenate((np.zeros((len(time), 1, 2)), floors[..., :2]), axis=1), axis=1) / [[4.0], [3.0]]
    wave = np.sin(7.0 * time)[:, np.newaxis]

    def add(name: str, dims: tuple[str, ...], values: np.ndarray) -> None:
        group.add(name, dims, values.astype(np.float32) if dims[:1] == ("time",) else values, "", name)

    add("ground_acceleration", ("time", "direction"), wave * [[3.0, 2.0]])
    add("storey_height", ("storey",), np.array([4.0, 3.0]))
    add("floor_displacement", ("time", "floor", "direction"), floors[..., :2])
    add("floor_rotation", ("time", "floor"), floors[..., 5])
    there = [corner[f"{line}.{floor}"] for floor, line in points]
    add("point_displacement", ("time", "point", "direction"), moved[:, there, :2])
    add("storey_drift", ("time", "storey", "direction"), drift)
    for which in ("max", "min"):
        add(f"storey_drift_{which}", ("storey", "direction"), getattr(drift, which)(axis=0))
    strokes = wave * [[0.010, -0.020, 0.005, 0.0]]
    add("damper_deformation", ("time", "damper"), strokes)
    add("damper_force", ("time", "damper"), 1e6 * strokes)
    for kind, names in members.items():
        rotation = np.zeros((len(time), len(names), 2, 2))
        if kind == "beam":  # BX_1_1_1 rotates most, about its strong axis; BX_2_1_1 about its weak one
            rotation[:, names.index("BX_1_1_1"), 0, 0] = 0.012 * wave[:, 0] * time / time[-1]
            rotation[:, names.index("BX_2_1_1"), 1, 1] = -0.003 * wave[:, 0]
        for which in ("max", "min"):
            add(f"{kind}_plastic_rotation_{which}", (kind, "end", "axis"), getattr(rotation, which)(axis=0))
        if motion:
            add(f"{kind}_plastic_rotation", ("motion_time", kind, "end", "axis"), rotation)
    if motion:
        along("motion_time", time)
        along("node", list(nodes))
        along("node_degree", ["ux", "uy", "uz", "rx", "ry", "rz"])
        add("node_displacement", ("motion_time", "node", "node_degree"), moved)
    return group


def moving_archive(folder: Path, motion: bool = True) -> Path:
    """Write an archive of the building with its history; arguments as `moving_group`."""
    building = small_building(folder)
    writer = ArchiveWriter(folder / "building.h5", root_group(building, ["shake"], {}))
    writer.write("analyses/shake", moving_group(building, motion))
    return Path(writer.finish({"status": "completed"}))
