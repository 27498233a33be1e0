"""The nodes and members of a building as a space frame, with its loads and masses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from itertools import pairwise
from math import inf

import numpy as np

from edesign.codes.ec3.section import SteelSection
from edesign.errors import InputError
from edesign.frame.footings import springs_under
from edesign.frame.sections.own_section import own_section
from edesign.project.building.building import Building
from edesign.project.building.layout import Diaphragm, ways
from edesign.project.building.members import BeamRun, BraceRun, End
from edesign.project.building.names import BeamPlace, BracePlace, ColumnLine, column_name, frame_name, node_name
from edesign.project.frame.foundations import FootingSupport
from edesign.space.structure.composite import with_slabs
from edesign.space.structure.design_cases import design_cases
from edesign.space.structure.frame import NO_DIAPHRAGM, RIGID, Member, SpaceFrame
from edesign.space.structure.load_cases import load_cases
from edesign.space.structure.masses import node_masses
from edesign.space.structure.restrained import laws_of_groups

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def space_frame(building: Building, design: bool = False) -> SpaceFrame:
    """Return a building as nodes, members, load cases and masses.

    Load cases are `G`, the permanent loads of the file; `self_weight`, that of the members, if the file wants it; and
    `Q_B` and so on, the variable loads of each category. A beam that braces meet is two members with a node between
    them, or three with a seismic link inside. The lower half of the first storey has no mass. Footings are springs of
    their static stiffness.

    Args:
        building: from `load_building`.
        design: whether load cases are those of the elastic design, with its own ones and its patterns of loads.

    Raises:
        InputError: a section is not known, loads upwards would give a negative mass, a footing has no stiffness, or
            beams of one entry differ in what their slab adds.
    """
    building = with_slabs(building)
    layout = building.layout
    nodes = {name: number for number, name in enumerate(layout.nodes)}
    coordinates = np.array(list(layout.nodes.values()))
    fixed, springs = _supports(building, nodes)
    ends = {name: (nodes[start], nodes[end]) for name, (start, end) in layout.ends.items()}
    members = (*_columns(building, ends), *_beams(building, ends), *_braces(building, ends, coordinates))
    numbers: dict[Diaphragm | None, int] = {at: number for number, at in enumerate(layout.diaphragms)}
    bare = SpaceFrame(
        node_names=tuple(nodes),
        coordinates=coordinates,
        node_diaphragm=np.array([numbers.get(layout.tied.get(name), NO_DIAPHRAGM) for name in nodes]),
        levels=np.array(building.levels),
        fixed=fixed,
        springs=springs,
        members=members,
        cases={},
        node_mass=np.zeros(len(nodes)),
        own_sections=_own_sections(building),
        diaphragms=tuple(layout.diaphragms),
        held=max(building.held_floors, default=0),
    )
    loaded = replace(bare, cases=(design_cases if design else load_cases)(building, bare))
    return replace(loaded, node_mass=node_masses(building, loaded))


def _supports(building: Building, nodes: Mapping[str, int]) -> tuple[np.ndarray, np.ndarray]:
    fixed = np.zeros((len(nodes), 6), bool)
    springs = np.zeros((len(nodes), 6))
    for line in building.layout.node_lines[0]:
        node, support = nodes[node_name(line, 0)], building.support(line)
        if isinstance(support, FootingSupport):
            springs[node] = springs_under(building, str(line), inf, dimension=3).static
            continue
        for axis, restraint in enumerate(support.all()):
            fixed[node, axis] = restraint == "fixed"
            springs[node, axis] = restraint if isinstance(restraint, float) else 0.0
    for held in building.restrained_floors:
        for floor in held.floors.numbers(1, building.n_storeys):
            at = [nodes[node_name(line, floor)] for line in building.layout.node_lines[floor]]
            for axis, restraint in enumerate(held.all()):
                fixed[at, axis] = restraint == "fixed"
                springs[at, axis] = restraint / len(at) if isinstance(restraint, float) else 0.0
    return fixed, springs


Ends = Mapping[str, tuple[int, int]]
"""Numbers of the start and end node of each member, by its name."""


def _own_sections(building: Building) -> dict[str, SteelSection]:
    """Return the sections of the file by name; an error has its place in the file."""
    found = {}
    for name, own in building.sections.items():
        try:
            found[name] = own_section(name, own)
        except InputError as error:
            raise InputError(f"{building.where('sections', name)}: sections.{name}: {error}") from error
    return found


def _columns(building: Building, ends: Ends) -> list[Member]:
    return [
        Member(
            name=name,
            kind="column",
            start=ends[name][0],
            end=ends[name][1],
            section=run.section,
            material=run.material,
            group=run.group or "",
            web=X if run.strong == "x" else Y,
            storey=storey,
            frame=_frames_of(line),
        )
        for (line, storey), run in building.layout.column_at.items()
        for name in [column_name(line, storey)]
    ]


def _frames_of(line: ColumnLine) -> tuple[str, str]:
    """Return the plane frames that a column line stands in."""
    return frame_name("x", line.j, line.axes), frame_name("y", line.i, line.axes)


def _beams(building: Building, ends: Ends) -> list[Member]:
    found = []
    for place, run in building.layout.beam_at.items():
        layout = building.layout
        names, cuts = layout.beam_members(place), (0.0, *layout.cuts(place).values(), 1.0)
        for name, part in zip(names, pairwise(cuts), strict=True):
            at_start = run.ends.start if name == names[0] else "rigid"
            at_end = run.ends.end if name == names[-1] else "rigid"
            beam = _beam(place, run, name, ends[name], at_start, at_end)
            if len(names) > 1:
                link = name == layout.link_member(place)
                beam = replace(beam, beam=str(place), part=part, link=link, eccentric=place in layout.links)
            found.append(beam)
    return found


def _beam(place: BeamPlace, run: BeamRun, name: str, nodes: tuple[int, int], at_start: End, at_end: End) -> Member:
    return Member(
        name=name,
        kind="beam",
        start=nodes[0],
        end=nodes[1],
        section=run.section,
        material=run.material,
        group=run.group or "",
        web=Z,
        ends=(*_stiffness(at_start), *_stiffness(at_end)),
        stiffness_factor=run.stiffness_factor,
        storey=place.floor,
        frame=(frame_name(place.along, place.frame, place.axes),),
        bay=place.bay,
    )


def _stiffness(end: End) -> tuple[float, float]:
    """Rotational stiffness about y and z of one end."""
    if isinstance(end, float):
        return end, RIGID
    return (RIGID, RIGID) if end == "rigid" else (0.0, 0.0)


def _braces(building: Building, ends: Ends, coordinates: np.ndarray) -> list[Member]:
    stiffer = {group: law.stiffness_factor for group, law in laws_of_groups(building).items()}
    return [
        _brace(place, run, place.name(way), ends[place.name(way)], coordinates, stiffer.get(run.group or "", 1.0))
        for place, run in building.layout.brace_at.items()
        for way in ways(place, run)
    ]


def _brace(
    place: BracePlace, run: BraceRun, name: str, nodes: tuple[int, int], coordinates: np.ndarray, stiffer: float
) -> Member:
    start, end = nodes
    axis = coordinates[end] - coordinates[start]
    axis = axis / np.linalg.norm(axis)
    level = np.array(X if place.along == "x" else Y)
    web = (axis @ level) * np.array(Z) - axis[2] * level  # in the plane of the frame, at right angles to the brace
    return Member(
        name=name,
        kind="brace",
        start=start,
        end=end,
        section=run.section,
        material=run.material,
        group=run.group or "",
        web=(float(web[0]), float(web[1]), float(web[2])),
        ends=(0.0, 0.0, 0.0, 0.0),
        stiffness_factor=stiffer,
        axial_only=True,
        bracing=run.kind,
        compression=run.in_compression,
        eccentric=run.link is not None,
        storey=place.storey,
        frame=(frame_name(place.along, place.frame, place.axes),),
        bay=place.bay,
    )
