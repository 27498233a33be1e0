"""What stands in the computer: a project without the devices in the laboratory, or a shear building in one line."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag

from edesign.project.analysis.damping import ModeNumber, NoDamping
from edesign.project.notation.several import Names
from edesign.project.notation.units import PositiveMass, PositiveRatio, PositiveStiffness
from edesign.project.reading.base import Model, by_key, keys_in

Text = Annotated[str, Field(min_length=1)]


class ProjectStructure(Model):
    """A project of which one device stands in the laboratory.

    Its history `analysis` gives record, scale and free vibration of tests that say none, and is what they are
    compared with. `frame`: linear about its state under gravity, or with all that yields in it.
    """

    project: Text
    physical: Names
    analysis: Text | None = None
    frame: Literal["linear", "nonlinear"] = "linear"


class ShearRayleigh(Model):
    """Damping proportional to mass and stiffness, with `ratio` of critical in both `modes`."""

    kind: Literal["rayleigh"]
    ratio: PositiveRatio
    modes: Annotated[tuple[ModeNumber, ...], Field(min_length=2, max_length=2)] = (1, 2)


class ShearModal(Model):
    """`ratio` of critical in each of the first `modes` modes, nothing in the others; None: in all of them."""

    kind: Literal["modal"]
    ratio: PositiveRatio
    modes: ModeNumber | None = None


ShearDamping = Annotated[
    Annotated[NoDamping, Tag("?kind=none")]
    | Annotated[ShearRayleigh, Tag("?kind=rayleigh")]
    | Annotated[ShearModal, Tag("?kind=modal")],
    Discriminator(by_key("kind")),
]


class ShearBuilding(Model):
    """Floors on storeys, from the bottom: kg and N/m. The specimen stands in one storey, beside its stiffness.

    Modes, damping and stiffnesses are those of the structure without the specimen.
    """

    masses: Annotated[tuple[PositiveMass, ...], Field(min_length=1, max_length=200)]
    stiffnesses: Annotated[tuple[PositiveStiffness, ...], Field(min_length=1, max_length=200)]
    damping: ShearDamping = NoDamping(kind="none")
    storey: Annotated[int, Field(ge=1)] = 1


def _which(value: Any) -> str:
    keys = keys_in(value)
    return "?project" if "project" in keys or "physical" in keys or "analysis" in keys else "?shear"


Structure = Annotated[
    Annotated[ProjectStructure, Tag("?project")] | Annotated[ShearBuilding, Tag("?shear")], Discriminator(_which)
]
