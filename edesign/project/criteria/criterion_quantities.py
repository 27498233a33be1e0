"""The archived quantities that criteria may limit: of floors, storeys, members, dampers, supports, or the frame."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from edesign.project.analysis.outputs import HistoryKind
from edesign.project.criteria.measures import MULTIPLE, RATIO
from edesign.project.notation.quantities import ACCELERATION, ENERGY, FORCE, LENGTH, MOMENT, ROTATION, VELOCITY, Kind

Place = Literal["floor", "storey", "column", "beam", "brace", "member", "damper", "isolator", "support", "frame"]
Side = Literal["tension", "compression"]
EnergyTerm = Literal["kinetic", "damping", "elastic", "hysteretic", "p_delta", "dampers"]

SELECTIONS: dict[Place, tuple[str, ...]] = {
    "floor": ("floors",),
    "storey": ("storeys",),
    "column": ("storeys", "members"),
    "beam": ("storeys", "members"),
    "brace": ("storeys", "members"),
    "member": ("storeys", "members"),
    "damper": ("storeys", "dampers"),
    "isolator": ("lines",),
    "support": ("lines",),
    "frame": (),
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


QUANTITIES: dict[str, ArchivedQuantity] = {
    "floor_displacement": ArchivedQuantity(LENGTH, "floor", "horizontal, relative to the ground"),
    "residual_floor_displacement": ArchivedQuantity(LENGTH, "floor", "mean over the last fundamental period"),
    "floor_acceleration": ArchivedQuantity(ACCELERATION, "floor", "horizontal, total"),
    "floor_relative_acceleration": ArchivedQuantity(ACCELERATION, "floor", "horizontal, relative to the ground"),
    "floor_spectral_acceleration": ArchivedQuantity(
        ACCELERATION,
        "floor",
        "largest total acceleration of an oscillator of `frequency` and `damping` on the floor",
        own=("frequency", "damping"),
        kept="floors",
        over_time="floor_acceleration",
    ),
    "storey_drift": ArchivedQuantity(RATIO, "storey", "drift ratio of the worst column line"),
    "residual_storey_drift": ArchivedQuantity(
        RATIO, "storey", "mean over the last fundamental period and over the column lines"
    ),
    "storey_shear": ArchivedQuantity(FORCE, "storey", "of the columns and braces, without dampers"),
    "storey_damper_force": ArchivedQuantity(
        FORCE, "storey", "horizontal, of the dampers of the storey together", of_dampers=True
    ),
    "column_axial_force": ArchivedQuantity(FORCE, "column", "gravity included", sides=True),
    "column_plastic_rotation": ArchivedQuantity(ROTATION, "column", "of the worse end"),
    "beam_plastic_rotation": ArchivedQuantity(ROTATION, "beam", "of the worse end", bends=True),
    "brace_axial_force": ArchivedQuantity(FORCE, "brace", "gravity included", sides=True),
    "member_axial_force": ArchivedQuantity(FORCE, "member", "of columns and beams, of the worse end"),
    "member_shear_force": ArchivedQuantity(FORCE, "member", "of columns and beams, of the worse end", bends=True),
    "member_bending_moment": ArchivedQuantity(MOMENT, "member", "of columns and beams, of the worse end", bends=True),
    "damper_force": ArchivedQuantity(FORCE, "damper", "of all that stand at its place"),
    "damper_deformation": ArchivedQuantity(LENGTH, "damper", "its stroke, without its brace"),
    "damper_velocity": ArchivedQuantity(
        VELOCITY, "damper", "of its deformation, without its brace", kept="dampers", over_time="damper_deformation"
    ),
    "damper_strain": ArchivedQuantity(RATIO, "damper", "shear strain of its layers"),
    "core_strain": ArchivedQuantity(RATIO, "damper", "of the steel core of a buckling-restrained brace", sides=True),
    "core_ductility": ArchivedQuantity(
        MULTIPLE, "damper", "deformation of a buckling-restrained brace over its yield deformation", sides=True
    ),
    "cumulative_ductility": ArchivedQuantity(
        MULTIPLE, "damper", "plastic deformations of a buckling-restrained brace, summed, over its yield deformation"
    ),
    "damper_work": ArchivedQuantity(ENERGY, "damper", "done on it and its brace until the end"),
    "support_vertical_reaction": ArchivedQuantity(FORCE, "support", "gravity included", sides=True, kept="supports"),
    "support_horizontal_reaction": ArchivedQuantity(FORCE, "support", "gravity included", kept="supports"),
    "support_moment": ArchivedQuantity(MOMENT, "support", "gravity included", kept="supports"),
    "isolator_axial_force": ArchivedQuantity(FORCE, "isolator", "gravity included", sides=True, isolated=True),
    "base_displacement": ArchivedQuantity(
        LENGTH, "frame", "horizontal, of an isolated base, relative to the ground", isolated=True
    ),
    "residual_base_displacement": ArchivedQuantity(
        LENGTH, "frame", "of an isolated base, mean over the last fundamental period", isolated=True
    ),
    "base_acceleration": ArchivedQuantity(
        ACCELERATION, "frame", "horizontal, total, of an isolated base", isolated=True
    ),
    "base_shear": ArchivedQuantity(FORCE, "frame", "sum of the horizontal reactions, those of dampers included"),
    "overturning_moment": ArchivedQuantity(
        MOMENT,
        "frame",
        "of all reactions about the middle of the base, gravity and couples of dampers included",
        kept="supports",
    ),
    "energy_share": ArchivedQuantity(
        RATIO,
        "frame",
        "energy of `term` at the end over the energy put in, both since the start of the record",
        own=("term",),
    ),
}
"""What a criterion may limit, by the name that it has in the archive."""


def keys_of(name: str) -> tuple[str, ...]:
    """Return the keys of a criterion that say where, and of what, a quantity is taken."""
    quantity = QUANTITIES[name]
    return (*SELECTIONS[quantity.place], *(("side",) if quantity.sides else ()), *quantity.own)
