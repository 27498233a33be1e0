"""What stands in the computer: a project without the devices in the laboratory, or a shear building in one line."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from edesign.project.analysis.damping import ModeNumber, NoDamping
from edesign.project.notation.repeated import EqualStiffnesses, Repeated, equal_values
from edesign.project.notation.several import Names
from edesign.project.notation.units import PositiveMass, PositiveRatio, PositiveStiffness
from edesign.project.reading.base import Model
from edesign.project.reading.one_of import OneOf

Text = Annotated[str, Field(min_length=1)]


class ProjectStructure(Model):
    """A project of which one device stands in the laboratory.

    Attributes:
        project: project file, relative to this file.
        physical: device of the project that stands in the laboratory, by name.
        analysis: history of the project that gives record, scale and free vibration of tests that say none.
        frame: the frame in the loop: linear about its state under gravity, or with all that yields in it.
    """

    project: Text
    physical: Names
    analysis: Text | None = None
    frame: Literal["linear", "nonlinear"] = "linear"


class ShearRayleigh(Model):
    """Damping proportional to mass and stiffness.

    Attributes:
        kind: Rayleigh damping.
        ratio: ratio of critical damping in both modes.
        modes: the two modes that have the ratio.
    """

    kind: Literal["rayleigh"]
    ratio: PositiveRatio
    modes: Annotated[tuple[ModeNumber, ...], Field(min_length=2, max_length=2)] = (1, 2)


class ShearModal(Model):
    """Damping mode by mode, nothing in the modes beyond.

    Attributes:
        kind: modal damping.
        ratio: ratio of critical damping.
        modes: how many modes are damped; without the key all.
    """

    kind: Literal["modal"]
    ratio: PositiveRatio
    modes: ModeNumber | None = None


ShearDamping = Annotated[NoDamping | ShearRayleigh | ShearModal, OneOf("kind")]


class ShearBuilding(Model):
    """A shear building whose floors stand on storeys. The specimen stands in one storey, beside its stiffness.

    Modes, damping and stiffnesses are those of the structure without the specimen.

    Attributes:
        masses: masses of the floors from the bottom.
        stiffnesses: stiffnesses of the storeys from the bottom, without the specimen.
        damping: inherent damping of the structure without the specimen.
        storey: storey in which the specimen stands.
    """

    masses: Annotated[tuple[PositiveMass, ...], Repeated(equal_values("EqualMasses", PositiveMass), most=200)]
    stiffnesses: Annotated[tuple[PositiveStiffness, ...], Repeated(EqualStiffnesses, most=200)]
    damping: ShearDamping = NoDamping(kind="none")
    storey: Annotated[int, Field(ge=1)] = 1


Structure = Annotated[
    ProjectStructure | ShearBuilding,
    OneOf(otherwise=ShearBuilding, project=ProjectStructure, physical=ProjectStructure, analysis=ProjectStructure),
]
