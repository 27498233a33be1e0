"""Forces and plastic rotations of members, and forces of the leaning column."""

from __future__ import annotations

from edesign.frame.frame_model import Bending, FrameModel, Member
from edesign.study.results.recording import Quantity, Terms, by_axis

_PLANE_FORCES = (
    ("axial_force", "N", "force on the member's end along its axis, from start to end"),
    ("shear_force", "N", "force on the member's end across its axis, to the left of it"),
    ("bending_moment", "N*m", "moment on the member's end, anticlockwise"),
)
_SPACE_FORCES = (
    ("axial_force", "N", "force on the member's end along local x, from start to end"),
    ("shear_force", "N", "force on the member's end that goes with bending about the axis: along local z with y"),
    ("bending_moment", "N*m", "moment on the member's end about the local axis"),
    ("torque", "N*m", "moment on the member's end about local x"),
)

_EXTREMES = ("max", "min")


def member_forces(frame: FrameModel, members: list[Member], dim: str, history: bool) -> list[Quantity]:
    """Return the forces on both ends of members, in the axes of the member, as quantities to be recorded.

    Args:
        members: columns, beams or braces.
        dim: the dimension whose coordinate lists them.
        history: whether histories are kept, instead of extremes.
    """
    found = []
    for name, unit, label in _SPACE_FORCES if frame.model.dimension == 3 else _PLANE_FORCES:
        dims: tuple[str, ...] = (dim, "end")
        axes = 1
        if name in ("shear_force", "bending_moment"):
            dims, axes = by_axis(frame, *dims), len(frame.bending)
        shape = (len(members), 2, axes)[: len(dims)]
        cells = tuple(terms for m in members for end in (0, 1) for terms in _end_force(m, end, name, axes))
        found.append(Quantity(f"member_{name}", dims, shape, cells, unit, label, history, () if history else _EXTREMES))
    return found


def _end_force(member: Member, end: int, name: str, axes: int) -> list[Terms]:
    """A force on the end of a member, about each axis; bars have none across their axis."""
    if name == "axial_force":
        of = [member.axial]
    elif name == "torque":
        of = [] if member.torque is None else [member.torque]
    else:
        of = [bending.shear if name == "shear_force" else bending.moment for bending in member.bending]
    return [((1.0, "end_force", member.at_end(end), at[end]),) for at in of] or [()] * axes


def axial_forces(frame: FrameModel) -> list[Quantity]:
    """Return the axial forces of columns and of braces, positive in tension, N."""
    found = []
    for kind in ("column", "brace"):
        members = frame.of_kind(kind)
        cells = tuple(((1.0, "axial_force", member.element, 0),) for member in members)
        if members:
            name = f"axial force of the {kind}, positive in tension"
            found.append(Quantity(f"{kind}_axial_force", (kind,), (len(cells),), cells, "N", name))
    return found


def leaning_column_forces(frame: FrameModel) -> list[Quantity]:
    """Return the axial forces of the leaning column and its pull on the floors, N; none without one."""
    if frame.leaning is None:
        return []
    elements = frame.leaning.elements
    parts = (
        ("axial_force", "axial_force", 0, "axial force of the leaning column in the storey, positive in tension"),
        (
            "shear",
            "global_force",
            3,
            "horizontal force on the upper end of the leaning column in the storey: minus what the frame's columns and "
            "braces take for it",
        ),
    )
    return [
        Quantity(
            f"leaning_column_{name}",
            ("storey",),
            (len(elements),),
            tuple(((1.0, kind, element, at),) for element in elements),
            "N",
            label,
        )
        for name, kind, at, label in parts
    ]


def plastic_rotations(frame: FrameModel, history: bool = False) -> list[Quantity]:
    """Return the plastic rotations of the ends of columns and beams, rad; members that stay elastic have none.

    Args:
        history: whether they are kept over time.
    """
    found = []
    for kind in ("column", "beam"):
        members = frame.of_kind(kind)
        cells = tuple(plastic_rotation(m, end, bending) for m in members for end in (0, 1) for bending in m.bending)
        if members:
            name = f"plastic rotation of the end of the {kind}: chord rotation less its elastic part"
            dims = by_axis(frame, kind, "end")
            shape = (len(members), 2, len(frame.bending))[: len(dims)]
            found.append(Quantity(f"{kind}_plastic_rotation", dims, shape, cells, "rad", name, history))
    return found


def plastic_rotation(member: Member, end: int, bending: Bending) -> Terms:
    """Return the plastic rotation of a member's end as a sum of those of its fibres, hinges and joints.

    Args:
        end: 0 for its start, 1 for its end.
    """
    of_end = member.springs_about(end, bending)
    springs: Terms = tuple((1.0, "plastic_rotation", s.element, 0) for s in of_end if s.yields)
    if member.fibres is None:
        return springs
    return ((1.0, "plastic_rotation", member.element, bending.plastic[end]), *springs)
