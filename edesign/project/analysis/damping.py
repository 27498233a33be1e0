"""Inherent damping of the frame."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from edesign.project.notation.units import PositiveRatio, PositiveTime, UnitRatio
from edesign.project.reading.base import Model
from edesign.project.reading.one_of import OneOf

ModeNumber = Annotated[int, Field(ge=1)]
State = Literal["gravity", "initial"]
"""The state whose frequencies count: under the gravity combination, or unloaded."""
DampingStiffness = Literal["initial", "committed", "current"]


Ratios = Annotated[PositiveRatio | Annotated[tuple[UnitRatio, ...], Field(min_length=1)], OneOf()]
"""One ratio for all modes, or one for each."""


class NoDamping(Model):
    """No inherent damping.

    Attributes:
        kind: no inherent damping.
    """

    kind: Literal["none"]


class RayleighDamping(Model):
    """Damping proportional to mass and stiffness.

    Attributes:
        kind: Rayleigh damping.
        ratio: ratio of critical damping in both modes.
        modes: the two modes that have the ratio.
        periods: the two periods at which the ratio holds, in place of `modes`.
        stiffness: stiffness matrix that damping is proportional to; `committed` is that of the end of the last step.
        state: state whose frequencies count: under the gravity combination, or unloaded.
    """

    kind: Literal["rayleigh"]
    ratio: PositiveRatio
    modes: tuple[ModeNumber, ModeNumber] = (1, 2)
    periods: tuple[PositiveTime, PositiveTime] | None = None
    stiffness: DampingStiffness = "current"
    state: State = "gravity"


class MassDamping(Model):
    """Damping proportional to mass alone.

    Attributes:
        kind: damping proportional to mass.
        ratio: ratio of critical damping in the mode, or at the period.
        mode: the mode that has the ratio.
        period: the period at which the ratio holds, in place of `mode`.
        state: state whose frequencies count: under the gravity combination, or unloaded.
    """

    kind: Literal["mass_proportional"]
    ratio: PositiveRatio
    mode: ModeNumber = 1
    period: PositiveTime | None = None
    state: State = "gravity"


class StiffnessDamping(Model):
    """Damping proportional to stiffness alone.

    Attributes:
        kind: damping proportional to stiffness.
        ratio: ratio of critical damping in the mode, or at the period.
        mode: the mode that has the ratio.
        period: the period at which the ratio holds, in place of `mode`.
        stiffness: stiffness matrix that damping is proportional to; `committed` is that of the end of the last step.
        state: state whose frequencies count: under the gravity combination, or unloaded.
    """

    kind: Literal["stiffness_proportional"]
    ratio: PositiveRatio
    mode: ModeNumber = 1
    period: PositiveTime | None = None
    stiffness: DampingStiffness = "current"
    state: State = "gravity"


class ModalDamping(Model):
    """Damping mode by mode (Wilson and Penzien 1972), nothing in the modes beyond.

    Attributes:
        kind: modal damping.
        ratio: ratio of critical damping; one for all modes, or a list.
        modes: how many modes are damped; with a list of ratios as many as these.
        state: state whose modes count: under the gravity combination, or unloaded.
    """

    kind: Literal["modal"]
    ratio: Ratios
    modes: ModeNumber | None = None
    state: State = "gravity"

    @property
    def count(self) -> int:
        """The number of damped modes."""
        return len(self.ratio) if isinstance(self.ratio, tuple) else self.modes or 0


class CaugheyDamping(Model):
    """Damping of Caughey's series.

    Attributes:
        kind: Caughey's series.
        ratio: ratio of critical damping; one for all modes, or a list.
        modes: the 2 to 8 modes that have the ratios.
        periods: the 2 to 8 periods at which the ratios hold, in place of `modes`.
        state: state whose frequencies count: under the gravity combination, or unloaded.
    """

    kind: Literal["caughey"]
    ratio: Ratios
    modes: tuple[ModeNumber, ...] | None = None
    periods: tuple[PositiveTime, ...] | None = None
    state: State = "gravity"


ProportionalDamping = RayleighDamping | MassDamping | StiffnessDamping
Damping = Annotated[
    NoDamping | RayleighDamping | MassDamping | StiffnessDamping | ModalDamping | CaugheyDamping, OneOf("kind")
]


def first_ratio(damping: Damping | None) -> float:
    """Return the ratio of critical damping that is given, of several that of the lowest mode; 0 without damping."""
    if damping is None or isinstance(damping, NoDamping):
        return 0.0
    return damping.ratio[0] if isinstance(damping.ratio, tuple) else damping.ratio
