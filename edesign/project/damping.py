"""Inherent damping of the frame."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Discriminator, Field, Tag

from edesign.project.base import Model, by_key
from edesign.project.units import PositiveRatio

ModeNumber = Annotated[int, Field(ge=1)]
State = Literal["gravity", "initial"]
"""The state whose frequencies count: under the gravity combination, or unloaded."""


class NoDamping(Model):
    """No inherent damping."""

    kind: Literal["none"]


class RayleighDamping(Model):
    """Damping proportional to mass and stiffness, with `ratio` of critical in both `modes`."""

    kind: Literal["rayleigh"]
    ratio: PositiveRatio
    modes: tuple[ModeNumber, ModeNumber] = (1, 2)
    stiffness: Literal["initial", "committed", "current"] = "current"
    state: State = "gravity"


class ModalDamping(Model):
    """`ratio` of critical in each of the first `modes` modes, nothing in the others."""

    kind: Literal["modal"]
    ratio: PositiveRatio
    modes: ModeNumber
    state: State = "gravity"


Damping = Annotated[
    Annotated[NoDamping, Tag("?kind=none")]
    | Annotated[RayleighDamping, Tag("?kind=rayleigh")]
    | Annotated[ModalDamping, Tag("?kind=modal")],
    Discriminator(by_key("kind")),
]
