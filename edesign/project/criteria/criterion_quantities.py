"""The archived quantities that criteria may limit: of floors, storeys, members, dampers, supports, or the frame."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from edesign.project.analysis.outputs import HistoryKind
from edesign.project.criteria.measures import BENT, DIRECTED, FRAMED, MULTIPLE, ON_LINES, RATIO
from edesign.project.notation.quantities import ACCELERATION, ENERGY, FORCE, LENGTH, MOMENT, ROTATION, VELOCITY, Kind

Place = Literal[
    "floor",
    "storey",
    "column",
    "beam",
    "brace",
    "member",
    "damper",
    "isolator",
    "support",
    "frame",
    "drift_line",
    "point",
]
Side = Literal["tension", "compression"]
EnergyTerm = Literal["kinetic", "damping", "elastic", "hysteretic", "p_delta", "dampers"]

SELECTIONS: dict[Place, tuple[str, ...]] = {
    "floor": ("floors",),
    "storey": ("storeys",),
    "column": ("storeys", "members"),
    "beam": ("storeys", "members"),
    "brace": ("storeys", "members", "of"),
    "member": ("storeys", "members", "of"),
    "damper": ("storeys", "dampers"),
    "isolator": ("lines",),
    "support": ("lines",),
    "frame": (),
    "drift_line": ("storeys",),
    "point": ("floors",),
}
"""The keys of a criterion that choose among the places of a quantity."""


@dataclass(frozen=True)
class ArchivedQuantity:
    """A quantity of the archive that a criterion may limit.

    Attributes:
        kind: what its values are.
        place: what it is of.
        meaning: in words.
        sides: whether tension and compression may be distinguished; of a reaction, tension is uplift.
        own: keys of a criterion that it has beside the selection of places.
        kept: the histories that must be kept for it (`outputs: histories`); None: it is always archived.
        over_time: the variable over time that it is computed from, "" if the archive has its extremes.
        isolated: whether only an isolated base has it.
        of_dampers: whether only frames with dampers have it.
        bends: whether it shows how beams bend.
        in_space: keys of a criterion that say where in a building.
        of_buildings: whether only buildings have it.
        of_designs: whether only files with `design` have it.
    """

    kind: Kind
    place: Place
    meaning: str
    sides: bool = False
    own: tuple[str, ...] = ()
    kept: HistoryKind | None = None
    over_time: str = ""
    isolated: bool = False
    of_dampers: bool = False
    bends: bool = False
    in_space: tuple[str, ...] = ()
    of_buildings: bool = False
    of_designs: bool = False


QUANTITIES: dict[str, ArchivedQuantity] = {
    "floor_displacement": ArchivedQuantity(
        LENGTH, "floor", "horizontal, relative to the ground", in_space=("direction", "at")
    ),
    "residual_floor_displacement": ArchivedQuantity(
        LENGTH, "floor", "mean over the last fundamental period", in_space=DIRECTED
    ),
    "floor_acceleration": ArchivedQuantity(ACCELERATION, "floor", "horizontal, total", in_space=("direction", "at")),
    "floor_relative_acceleration": ArchivedQuantity(
        ACCELERATION, "floor", "horizontal, relative to the ground", in_space=DIRECTED
    ),
    "floor_spectral_acceleration": ArchivedQuantity(
        ACCELERATION,
        "floor",
        "largest total acceleration of an oscillator of `frequency` and `damping` on the floor",
        own=("frequency", "damping"),
        kept="floors",
        over_time="floor_acceleration",
        in_space=DIRECTED,
    ),
    "storey_drift": ArchivedQuantity(RATIO, "storey", "drift ratio of the worst column line", in_space=ON_LINES),
    "residual_storey_drift": ArchivedQuantity(
        RATIO, "storey", "mean over the last fundamental period and over the column lines", in_space=ON_LINES
    ),
    "line_drift": ArchivedQuantity(
        RATIO, "drift_line", "drift ratio of the storey on a column line", in_space=ON_LINES, of_buildings=True
    ),
    "residual_line_drift": ArchivedQuantity(
        RATIO,
        "drift_line",
        "on a column line, mean over the last fundamental period",
        in_space=ON_LINES,
        of_buildings=True,
    ),
    "torsional_ratio": ArchivedQuantity(
        MULTIPLE,
        "storey",
        "largest drift of the worst column line over the largest mean drift of all lines",
        in_space=DIRECTED,
        of_buildings=True,
    ),
    "point_displacement": ArchivedQuantity(
        LENGTH,
        "point",
        "horizontal, of a corner of the floor, relative to the ground",
        in_space=("direction", "at"),
        of_buildings=True,
    ),
    "point_acceleration": ArchivedQuantity(
        ACCELERATION,
        "point",
        "horizontal, total, of a corner of the floor",
        in_space=("direction", "at"),
        of_buildings=True,
    ),
    "floor_rotation": ArchivedQuantity(ROTATION, "floor", "of a rigid floor about the vertical", of_buildings=True),
    "storey_shear": ArchivedQuantity(FORCE, "storey", "of the columns and braces, without dampers", in_space=DIRECTED),
    "storey_torque": ArchivedQuantity(
        MOMENT, "storey", "of the columns and braces about the vertical", of_buildings=True
    ),
    "storey_damper_force": ArchivedQuantity(
        FORCE, "storey", "horizontal, of the dampers of the storey together", of_dampers=True, in_space=DIRECTED
    ),
    "column_axial_force": ArchivedQuantity(FORCE, "column", "gravity included", sides=True, in_space=FRAMED),
    "column_plastic_rotation": ArchivedQuantity(ROTATION, "column", "of the worse end", in_space=BENT),
    "beam_plastic_rotation": ArchivedQuantity(ROTATION, "beam", "of the worse end", bends=True, in_space=BENT),
    "brace_axial_force": ArchivedQuantity(FORCE, "brace", "gravity included", sides=True, in_space=FRAMED),
    "member_axial_force": ArchivedQuantity(FORCE, "member", "of columns and beams, of the worse end", in_space=FRAMED),
    "member_shear_force": ArchivedQuantity(
        FORCE, "member", "of columns and beams, of the worse end", bends=True, in_space=BENT
    ),
    "member_bending_moment": ArchivedQuantity(
        MOMENT, "member", "of columns and beams, of the worse end", bends=True, in_space=BENT
    ),
    "section_use": ArchivedQuantity(
        MULTIPLE,
        "member",
        "of the worse end of columns and beams: N, V and M of one step over the resistance of the section",
        in_space=FRAMED,
    ),
    "member_use": ArchivedQuantity(
        MULTIPLE,
        "member",
        "of columns and beams against buckling, by the forces of one step and the factors of `design`",
        in_space=FRAMED,
        of_designs=True,
    ),
    "brace_use": ArchivedQuantity(
        MULTIPLE,
        "brace",
        "of braces in tension and against buckling, with the factors of `design`",
        in_space=FRAMED,
        of_designs=True,
    ),
    "damper_force": ArchivedQuantity(FORCE, "damper", "of all that stand at its place", in_space=FRAMED),
    "damper_deformation": ArchivedQuantity(LENGTH, "damper", "its stroke, without its brace", in_space=FRAMED),
    "damper_velocity": ArchivedQuantity(
        VELOCITY,
        "damper",
        "of its deformation, without its brace",
        in_space=FRAMED,
    ),
    "damper_strain": ArchivedQuantity(RATIO, "damper", "shear strain of its layers", in_space=FRAMED),
    "core_strain": ArchivedQuantity(
        RATIO, "damper", "of the steel core of a buckling-restrained brace", sides=True, in_space=FRAMED
    ),
    "core_ductility": ArchivedQuantity(
        MULTIPLE,
        "damper",
        "deformation of a buckling-restrained brace over its yield deformation",
        sides=True,
        in_space=FRAMED,
    ),
    "cumulative_ductility": ArchivedQuantity(
        MULTIPLE,
        "damper",
        "plastic deformations of a buckling-restrained brace, summed, over its yield deformation",
        in_space=FRAMED,
    ),
    "damper_work": ArchivedQuantity(ENERGY, "damper", "done on it and its brace until the end", in_space=FRAMED),
    "support_vertical_reaction": ArchivedQuantity(
        FORCE, "support", "gravity included", sides=True, kept="supports", in_space=("at",)
    ),
    "support_horizontal_reaction": ArchivedQuantity(
        FORCE, "support", "gravity included", kept="supports", in_space=("direction", "at")
    ),
    "support_moment": ArchivedQuantity(MOMENT, "support", "gravity included", kept="supports", in_space=("at",)),
    "isolator_axial_force": ArchivedQuantity(
        FORCE, "isolator", "gravity included", sides=True, isolated=True, in_space=("at",)
    ),
    "isolator_displacement": ArchivedQuantity(
        LENGTH,
        "isolator",
        "horizontal, of an isolator of a building",
        isolated=True,
        in_space=("direction", "at"),
        of_buildings=True,
    ),
    "base_rotation": ArchivedQuantity(
        ROTATION, "frame", "of the isolated base of a building about the vertical", isolated=True, of_buildings=True
    ),
    "base_displacement": ArchivedQuantity(
        LENGTH, "frame", "horizontal, of an isolated base, relative to the ground", isolated=True, in_space=DIRECTED
    ),
    "residual_base_displacement": ArchivedQuantity(
        LENGTH, "frame", "of an isolated base, mean over the last fundamental period", isolated=True, in_space=DIRECTED
    ),
    "base_acceleration": ArchivedQuantity(
        ACCELERATION, "frame", "horizontal, total, of an isolated base", isolated=True, in_space=DIRECTED
    ),
    "base_shear": ArchivedQuantity(
        FORCE, "frame", "sum of the horizontal reactions, those of dampers included", in_space=DIRECTED
    ),
    "base_shear_resultant": ArchivedQuantity(
        FORCE, "frame", "of the base shears along x and y at one instant", of_buildings=True
    ),
    "overturning_moment": ArchivedQuantity(
        MOMENT,
        "frame",
        "of all reactions about the middle of the base, gravity and couples of dampers included",
        kept="supports",
        in_space=DIRECTED,
    ),
    "energy_share": ArchivedQuantity(
        RATIO,
        "frame",
        "energy of `term` at the end over the energy put in, both since the start of the record",
        own=("term",),
    ),
}
"""What a criterion may limit, by the name that it has in the archive."""


def keys_of(name: str, in_space: bool = False) -> tuple[str, ...]:
    """Return the keys of a criterion that say where, and of what, a quantity is taken.

    Args:
        in_space: of a building, whose column lines are chosen by `at`.
    """
    quantity = QUANTITIES[name]
    places = SELECTIONS[quantity.place]
    if in_space:
        places = (*(key for key in places if key not in ("lines", "of")), *quantity.in_space)
    return (*places, *(("side",) if quantity.sides else ()), *quantity.own)
