"""What a structural effect is: a plug-in that changes the building, adds links to storeys, or acts on channels."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from edesign.calibrate.problem import Kind
from edesign.calibrate.structure.building import Building
from edesign.calibrate.structure.links import Link
from edesign.calibrate.structure.record import Channel
from edesign.calibrate.unknown import Unknown

Values = Mapping[str, float]
"""Parameters by name, SI."""


@dataclass(frozen=True)
class Setting:
    """What bounds and starts of effects follow from.

    Attributes:
        building: as declared, with a linear isolation layer.
        drift: (n,) m, typical largest drift of each storey: measured where displacements are, else of the declared
            building.
        period: of its first mode, s.
        step: of sampling, s.
        measures: kinds of the channels.
    """

    building: Building
    drift: np.ndarray
    period: float
    step: float
    measures: frozenset[str]

    @property
    def shear(self) -> float:
        """Typical largest force of storey 0, N."""
        return float(self.building.stiffness[0] * self.drift[0])


class StructuralEffect:
    """One form of an effect.

    Attributes:
        name: of the effect, shared by its forms.
        form: how it acts.
        kind: structure or instrument.
        title: for people.
        signature: what it leaves in the residual of a model without it, for people.
        source: paper, book.
        remembers: whether a test changes the next.
        usual: size of its first parameter, from where that does nothing, that is usual; more is an exception.
        amendment: name and form by which a law file of the isolation layer carries it; "" if it cannot.
    """

    name: ClassVar[str]
    form: str
    kind: ClassVar[Kind] = "structure"
    title: str
    signature: ClassVar[str]
    source: ClassVar[str]
    remembers: ClassVar[bool] = False
    usual: ClassVar[float] = math.inf
    amendment: ClassVar[str] = ""

    @property
    def fixed(self) -> Values:
        """Numbers of the form that are not searched, by name, SI."""
        return {}

    def unknowns(self, setting: Setting) -> tuple[Unknown, ...]:
        """Parameters with bounds that suit a building."""
        raise NotImplementedError

    def starts(self, setting: Setting) -> tuple[tuple[float, ...], ...]:
        """Values (SI) to start from; () if the building or its channels cannot show the effect."""
        raise NotImplementedError

    def building(self, p: Values, building: Building) -> Building:
        """The building with the effect."""
        return building

    def links(self, p: Values, building: Building) -> Sequence[Link]:
        """Links beside its storeys."""
        return ()

    def channels(self, p: Values, step: float, channels: Sequence[Channel], values: np.ndarray) -> np.ndarray:
        """What the instruments make of the true values (t, channels)."""
        return values
