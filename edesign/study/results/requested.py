"""The histories that a project asks for beyond floors and storeys: member ends, sections, fibres."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group
from edesign.errors import InputError
from edesign.frame.frame_model import Bending, FrameModel, Member
from edesign.project.analysis.outputs import FibreOutput
from edesign.project.analysis_file import AnalysisFile
from edesign.project.notation.selections import NumberSelection
from edesign.study.results.braces import recorded_braces
from edesign.study.results.members import member_forces, plastic_rotation
from edesign.study.results.recording import Quantity, Terms, by_axis, coordinate


def requested_quantities(project: AnalysisFile, frame: FrameModel, group: Group) -> list[Quantity]:
    """Return the quantities of `outputs.members`, `sections` and `fibres`, and add their coordinates to the group.

    Args:
        group: of the history.

    Raises:
        InputError: a member, point or layer does not exist, or the member is elastic and has no sections.
    """
    found = []
    outputs = project.outputs
    if outputs.members:
        members = [_member(project, frame, name, ("outputs", "members", i)) for i, name in enumerate(outputs.members)]
        coordinate(group, "recorded_member", [member.name for member in members], "", "member whose ends are recorded")
        found += member_forces(frame, members, "recorded_member", history=True)
        found += recorded_braces(members, group)
        found += _rotations(frame, members)
    if outputs.sections:
        found += _sections(project, frame, group)
    if outputs.fibres:
        found += _fibres(project, frame, group)
    return found


def _rotations(frame: FrameModel, members: list[Member]) -> list[Quantity]:
    """Rotations of the ends of members, anticlockwise as the moments on them; braces have none.

    The plastic part is there if at least one of the members can yield.
    """
    dims = by_axis(frame, "recorded_member", "end")
    shape = (len(members), 2, len(frame.bending))[: len(dims)]
    ends = [(member, end, bending) for member in members for end in (0, 1) for bending in frame.bending]
    chord = tuple(() if of[0].kind == "brace" else chord_rotation(frame, *of) for of in ends)
    plastic = tuple(() if of[0].kind == "brace" else plastic_rotation(*of) for of in ends)
    parts = (
        ("chord", chord, "chord rotation: rotation of the node against the line between the member's ends"),
        ("plastic", plastic, "plastic rotation of the member's end: chord rotation less its elastic part"),
    )
    way = "anticlockwise" if frame.model.dimension == 2 else "about the local axis"
    return [
        Quantity(f"member_{part}_rotation", dims, shape, cells, "rad", f"{label}, {way}", history=True, keep=())
        for part, cells, label in parts
        if any(cells)
    ]


def chord_rotation(frame: FrameModel, member: Member, end: int, bending: Bending) -> Terms:
    """Return the rotation of the node at a member's end against its chord; with hinges inside, of small rotations.

    Args:
        end: 0 for its start, 1 for its end.
    """
    inside: Terms = ((1.0, "deformation", member.element, bending.chord[end]),)
    if len(member.parts) == 1:
        return inside + tuple((1.0, "deformation", s.element, 0) for s in member.springs_about(end, bending))
    if member.axes:
        return _chord_rotation_in_space(frame, member, end, bending)
    nodes = [frame.nodes[member.start], frame.nodes[member.end]]
    (x0, y0), (x1, y1) = (frame.places[name] for name in (member.start, member.end))
    length = ((x1 - x0) ** 2 + (y1 - y0) ** 2) ** 0.5
    across = (-(y1 - y0) / length**2, (x1 - x0) / length**2)
    turned = tuple(
        (sign * share, "displacement", node, degree)
        for node, sign in zip(nodes, (1.0, -1.0), strict=True)
        for degree, share in enumerate(across)
        if share
    )
    return ((1.0, "displacement", nodes[end], 2), *turned)


def _chord_rotation_in_space(frame: FrameModel, member: Member, end: int, bending: Bending) -> Terms:
    """About y: y r + z (u_j - u_i) / L; about z: z r - y (u_j - u_i) / L."""
    _, y, z = member.axes
    about, across, sign = (y, z, 1.0) if bending.axis == "y" else (z, y, -1.0)
    nodes = frame.nodes[member.start], frame.nodes[member.end]
    turned = [(part, "displacement", nodes[end], 3 + at) for at, part in enumerate(about) if part]
    for node, way in zip(nodes, (-sign, sign), strict=True):
        turned += [(way * part / member.length, "displacement", node, at) for at, part in enumerate(across) if part]
    return tuple(turned)


def _sections(project: AnalysisFile, frame: FrameModel, group: Group) -> list[Quantity]:
    places = {}  # by label, so that what is asked for twice is kept once
    for i, asked in enumerate(project.outputs.sections):
        member = _fibre_member(project, frame, asked.member, ("outputs", "sections", i))
        for point in asked.points.numbers(1, member.points):
            places[f"{member.name}:{point}"] = (member, point)
    coordinate(group, "section", list(places), "", "section as member:point, from its start")
    bends = (1,) if frame.model.dimension == 2 else (2, 1)  # M; in space M_y, M_z, which are components 2 and 1
    quantities = (
        ("section_axial_force", "section_force", (0,), "N", "axial force of the section, positive in tension"),
        ("section_moment", "section_force", bends, "N*m", "bending moment of the section"),
        ("section_strain", "section_deformation", (0,), "1", "strain at the section's centroid"),
        ("section_curvature", "section_deformation", bends, "1/m", "curvature of the section"),
    )
    found = []
    for name, kind, components, unit, label in quantities:
        dims = ("section",) if components == (0,) else by_axis(frame, "section")
        cells = tuple(
            ((1.0, kind, member.element, (1 + len(bends)) * (point - 1) + at),)
            for member, point in places.values()
            for at in components
        )
        shape = (len(places), len(components))[: len(dims)]
        found.append(Quantity(name, dims, shape, cells, unit, label, history=True, keep=()))
    return found


def _fibres(project: AnalysisFile, frame: FrameModel, group: Group) -> list[Quantity]:
    places = {}  # by label, so that what is asked for twice is kept once
    for i, asked in enumerate(project.outputs.fibres):
        keys = ("outputs", "fibres", i)
        member = _fibre_member(project, frame, asked.member, keys)
        assert member.fibres is not None
        count = len(member.fibres)
        layers = _layers(project, asked, count, keys)
        for point in asked.points.numbers(1, member.points):
            for layer in layers:
                place = (member.element, (point - 1) * count + layer - 1)
                places[f"{member.name}:{point}:{layer}"] = (*place, member.fibres[layer - 1])
    at_places = np.array([place for _, _, place in places.values()])
    if frame.model.dimension == 2:
        coordinate(group, "fibre", list(places), "", "layer of fibres as member:point:layer, layers from the bottom")
        group.add("fibre_depth", ("fibre",), at_places, "m", "height of the layer above the section's centroid")
    else:
        coordinate(group, "fibre", list(places), "", "fibre as member:point:fibre, by local y, then z")
        for i, axis in enumerate("yz"):
            group.add(f"fibre_{axis}", ("fibre",), at_places[:, i], "m", f"local {axis} of the fibre from the centroid")
    return [
        Quantity(
            name,
            ("fibre",),
            (len(places),),
            tuple(((1.0, name, element, at),) for element, at, _ in places.values()),
            unit,
            f"{what} of the {'layer' if frame.model.dimension == 2 else 'fibre'}, positive in tension",
            history=True,
            keep=(),
        )
        for name, unit, what in (("fibre_stress", "Pa", "stress"), ("fibre_strain", "1", "strain"))
    ]


def _layers(project: AnalysisFile, asked: FibreOutput, last: int, keys: tuple[str | int, ...]) -> tuple[int, ...]:
    if not isinstance(asked.layers, NumberSelection):
        return (last,) if asked.layers == "top" else (1,)
    highest = max((b for _, b in asked.layers.ranges), default=1)
    if highest > last:
        where = project.where(*keys, "layers")
        raise InputError(
            f"{where}: {asked.member} has {last} layers of fibres, there is no layer {highest} [E-NAME-01]"
        )
    return asked.layers.numbers(1, last)


def _member(project: AnalysisFile, frame: FrameModel, name: str, keys: tuple[str | int, ...]) -> Member:
    if name not in frame.members:
        raise InputError(f"{project.where(*keys)}: there is no member `{name}` in this frame [E-NAME-01]")
    return frame.members[name]


def _fibre_member(project: AnalysisFile, frame: FrameModel, name: str, keys: tuple[str | int, ...]) -> Member:
    member = _member(project, frame, name, keys)
    if member.fibres is None:
        raise InputError(
            f"{project.where(*keys)}: `{name}` stays elastic, so it has no sections and fibres to record [E-HIST-04]"
        )
    return member
