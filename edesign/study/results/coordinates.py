"""Coordinates of the results of a frame: floors, storeys, dampers, members and their ends."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group
from edesign.frame.frame_model import FrameModel, Member
from edesign.study.results.recording import coordinate
from edesign.study.results.storeys import line_coordinates


def coordinates(group: Group, frame: FrameModel) -> None:
    """Add floors, storeys, members and member ends to a group.

    Args:
        group: of an analysis.
    """
    direction_coordinate(group, frame)
    storeys = [storey.number for storey in frame.storeys]
    coordinate(group, "floor", storeys, "1", "floor, the highest is the roof")
    coordinate(group, "storey", storeys, "1", "storey below the floor of the same number")
    if frame.devices:
        coordinate(group, "damper", [device.name for device in frame.devices], "", "name of the damper")
        storeys_of = [device.storey for device in frame.devices]
        group.add("damper_storey", ("damper",), storeys_of, "1", "storey of the damper, 0: of none")
        if frame.model.dimension == 3:
            frames, kinds = ([getattr(one, name) for one in frame.devices] for name in ("frame", "stands"))
            group.add("damper_frame", ("damper",), frames, "", "plane frame that the damper stands in, empty: in none")
            group.add("damper_stands", ("damper",), kinds, "", "how the damper stands, as `kind` in the file")
        for name, unit, label in (
            ("layer_thickness", "m", "thickness of a layer, nan: the damper has none"),
            ("tested_strain", "1", "largest shear strain in the tests of its law, nan: not known"),
            ("strain_limit", "1", "largest shear strain that its layers are meant for, nan: none is said"),
        ):
            values = [getattr(device, name) for device in frame.devices]
            if any(values):
                known = [np.nan if value is None else value for value in values]
                group.add(f"damper_{name}", ("damper",), known, unit, label)
        _restrained_coordinates(group, frame)
    if frame.attached:
        coordinate(group, "tuned_mass", list(frame.attached), "", "name of the tuned mass: T_floor_number")
    if frame.isolated is not None:
        isolators = [isolator.name for isolator in frame.isolated.isolators]
        coordinate(group, "isolator", isolators, "", "name of the isolator")
        group.attributes["isolated"] = True
    for kind in ("column", "beam", "brace"):
        found = [member.name for member in frame.of_kind(kind)]
        if found:
            coordinate(group, kind, found, "", f"name of the {kind}")
    coordinate(group, "member", [member.name for member in bending_members(frame)], "", "name of the column or beam")
    coordinate(group, "end", ["start", "end"], "", "end of the member: the start is below or at the left")
    if frame.model.dimension == 3:
        axes = [bending.axis for bending in frame.bending]
        coordinate(group, "axis", axes, "", "local axis of the member, y of the strong one; EN 1993-1-1, 1.7")
        _local_axes(group, frame)
        line_coordinates(group, frame)
    rigid = [member.rigid_ends for member in bending_members(frame)]
    if any(map(any, rigid)):
        label = "length of the rigid end; forces and rotations of the end are those where it begins to bend"
        group.add("rigid_end", ("member", "end"), rigid, "m", label)
    group.add(
        "floor_level", ("floor",), [floor.level for floor in frame.floors], "m", "level of the floor above the base"
    )
    group.add("storey_height", ("storey",), [storey.height for storey in frame.storeys], "m", "height of the storey")


def _local_axes(group: Group, frame: FrameModel) -> None:
    """Add unit vectors along the local axes y and z of each member with bending, in space."""
    coordinate(group, "component", ["x", "y", "z"], "", "component along an axis of the building, z upwards")
    for number, (axis, where) in enumerate((("y", "at right angles to its web"), ("z", "along its web")), 1):
        vectors = [member.axes[number] for member in bending_members(frame) if member.axes is not None]
        label = f"unit vector of local axis {axis} of the column or beam, {where}; local x from its start to its end"
        group.add(f"member_axis_{axis}", ("member", "component"), np.reshape(vectors, (-1, 3)), "1", label)


def direction_coordinate(group: Group, frame: FrameModel) -> None:
    """Add the directions in which floors move to a group; a plane frame has one without a name.

    Args:
        group: of an analysis.
    """
    if frame.directions[0].name:
        coordinate(group, "direction", [direction.name for direction in frame.directions], "", "horizontal direction")


RESTRAINED = (
    ("length", "length", "m", "length of the buckling-restrained brace between work points"),
    ("yield_force", "yield_force", "N", "yield force of its core, F_ysc A_sc"),
    ("yield_deformation", "yield_deformation", "m", "its yield deformation"),
    ("tested_core_strain", "tested_strain", "1", "strain of its core up to which omega and beta are known"),
    ("adjusted_tension", "adjusted_tension", "N", "its adjusted strength in tension, omega R_y F_ysc A_sc"),
    (
        "adjusted_compression",
        "adjusted_compression",
        "N",
        "its adjusted strength in compression, beta omega R_y F_ysc A_sc",
    ),
)
"""Variables of buckling-restrained braces, without `damper_`: name, attribute of `RestrainedBrace`, unit, meaning."""


def _restrained_coordinates(group: Group, frame: FrameModel) -> None:
    """Add what the manufacturer's values say of buckling-restrained braces; nan of other dampers."""
    braces = [device.restrained for device in frame.devices]
    if not any(braces):
        return
    for name, attribute, unit, label in RESTRAINED:
        values = [np.nan if brace is None else getattr(brace, attribute) for brace in braces]
        group.add(f"damper_{name}", ("damper",), values, unit, f"{label}; nan: the damper is another")


def bending_members(frame: FrameModel) -> list[Member]:
    """Return the members with bending, columns before beams."""
    return [*frame.of_kind("column"), *frame.of_kind("beam")]
