"""Buildings and columns in three dimensions that edesign and its peers are compared on."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from benchmarks.peers.building_data import PROJECTS, PeerBuilding, PeerMember, peer_building, peer_section
from edesign.frame.building_file import load_building
from edesign.frame.sections.building_sections import BuildingSections
from edesign.frame.sections.profiles import profile_names
from edesign.project.building.loader import parse_building
from edesign.space.structure.geometry import space_frame

Array = NDArray[np.float64]

IRREGULAR = """
edesign_building: 1
title: Two storeys, eccentric masses, columns turned
plan: {x: [6 m, 4.5 m], y: [5 m, 4 m]}
storeys: [4 m, 3.2 m]
setbacks: [{floors: 2, bays: {x: 1, y: all}}]
supports: {default: fixed, C3: pinned}
columns:
  - {section: HEB220, material: S275, strong: x}
  - {at: [A2, B1, B3, C2], section: HEB220, material: S275, strong: y}
beams:
  - {along: x, section: IPE300, material: S275}
  - {along: y, section: IPE270, material: S275}
  - {along: y, frames: C, section: IPE270, material: S275, ends: pinned}
  - {along: x, frames: 3, bays: 2, section: IPE300, material: S275, ends: {start: rigid, end: pinned}}
materials: {S275: {E: 210 GPa, fy: 275 MPa}}
loads:
  areas: [{floors: all, G: 5 kN/m^2, spans: x, secondary_beams: 1}]
masses:
  given:
    - {floors: 1, at: [A, B, C1], mass: 8 t}
    - {floors: 1, at: [C2, C3], mass: 20 t}
    - {floors: 2, at: [A1, A2, B1, B2], mass: 8 t}
    - {floors: 2, at: [A3, B3], mass: 16 t}
"""


def thesis_building(storeys: int = 10) -> PeerBuilding:
    """The ten-storey building of the thesis: 570 members, columns and beams in fibres.

    With another number of storeys its sections change at the same shares of the height. Loads and masses of more
    storeys are lighter, so that the columns bear what they do in ten.
    """
    path = PROJECTS / "thesis_building" / "building.yaml"
    lower, middle, share = round(0.4 * storeys), round(0.7 * storeys), min(1.0, 10 / storeys)
    text = path.read_text()
    for old, new in {
        "count: 10,": f"count: {storeys},",
        "1-4": f"1-{lower}",
        "5-7": f"{lower + 1}-{middle}",
        "8-10": f"{middle + 1}-{storeys}",
        "4.5 kN/m^2": f"{4.5 * share:.6g} kN/m^2",
        "2 kN/m^2": f"{2.0 * share:.6g} kN/m^2",
        "1.2 kN/m": f"{1.2 * share:.6g} kN/m",
    }.items():
        text = text.replace(old, new)
    building = parse_building(text, path, profiles=BuildingSections())
    return peer_building(building, space_frame(building))


def office_building() -> PeerBuilding:
    """The designed office building of six storeys with a setback; the diagonals of its crosses have half their area."""
    building = load_building(PROJECTS / "office_6_storeys" / "designed.yaml")
    return peer_building(building, space_frame(building))


def irregular_building() -> PeerBuilding:
    """Two storeys with a setback, masses beside the centre, columns turned, beams and a foot on hinges."""
    building = parse_building(IRREGULAR, profiles=profile_names())
    return replace(peer_building(building, space_frame(building)), damped_modes=(1, 2))


def spiral_column(axial: float = 0.3, members: int = 1) -> PeerBuilding:
    """A cantilever of HEB300, 3 m high, under an axial force that is a share of N_pl; its web is along x."""
    section = peer_section("HEB300", E=210e9, fy=275e6, nu=0.3)
    coordinates, fixed = np.zeros((members + 1, 3)), np.zeros((members + 1, 6), dtype=bool)
    coordinates[:, 2] = np.linspace(0.0, 3.0, members + 1)
    fixed[0] = True
    nodal, mass = np.zeros((members + 1, 6)), np.zeros((members + 1, 6))
    nodal[-1, 2] = -axial * section.area * section.fy
    mass[-1, 2] = 1.0  # edesign moves supports in histories alone; with steps of 1 s it hardly counts
    names = (f"part {k + 1}" for k in range(members))
    return PeerBuilding(
        title=f"column HEB300, {axial:g} N_pl, spiral",
        names=tuple(f"node {k}" for k in range(members + 1)),
        coordinates=coordinates,
        fixed=fixed,
        diaphragms=(),
        masters=np.zeros((0, 3)),
        mass=mass,
        sections=(section,),
        members=tuple(PeerMember(name, "column", k, k + 1, 0, (1.0, 0.0, 0.0)) for k, name in enumerate(names)),
        nodal=nodal,
        uniform=np.zeros((members, 3)),
        points=(),
    )


def spiral(radius: float = 0.09, turns: int = 3, steps: int = 600) -> Array:
    """A path of the head along x and y that winds outwards to a radius, (steps + 1, 2), m."""
    share = np.arange(steps + 1) / steps
    return (
        radius
        * share[:, None]
        * np.stack([np.cos(2.0 * np.pi * turns * share), np.sin(2.0 * np.pi * turns * share)], -1)
    )
