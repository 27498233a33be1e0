"""A form of an effect of a structure: its parameters with priors, its starts, and where it acts."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from edesign.calibration.dampers.acts import Values
from edesign.calibration.dampers.effect import FormInCampaign, Rows
from edesign.calibration.search.problem import Kind
from edesign.calibration.structures.building import Building
from edesign.calibration.structures.record import Channel
from edesign.calibration.structures.response import Link
from edesign.calibration.structures.sizes import StructureSizes
from edesign.estimation.parameters import Parameter


@dataclass(frozen=True)
class ChangedBuilding:
    """Another building than the declared one.

    Attributes:
        change: the building of that which would have been.
    """

    change: Callable[[Values, Building], Building]


@dataclass(frozen=True)
class Links:
    """Non-linear forces beside storeys.

    Attributes:
        of: the links beside a building; of a size of zero they carry nothing.
    """

    of: Callable[[Values, Building], Sequence[Link]]


@dataclass(frozen=True)
class ChangedChannels:
    """What the instruments make of the true motion.

    Attributes:
        change: values (t, channels) SI of the true ones, with the step (s) and what is measured.
        over_time: whether a value depends on those before and after it.
    """

    change: Callable[[Values, float, Sequence[Channel], np.ndarray], np.ndarray]
    over_time: bool = False


Act = ChangedBuilding | Links | ChangedChannels


@dataclass(frozen=True, eq=False)
class StructureForm:
    """A form of an effect.

    Attributes:
        name: of the effect, shared by its forms.
        form: how it acts.
        kind: what it belongs to: structure, instrument.
        title: for people.
        signature: what it leaves in the residual of a model without it, for people.
        source: paper, book.
        act: where it acts.
        parameters: with priors that suit a structure; the first is its size, zero of which is nothing.
        starts: values, SI, to start from: a grid over what acts non-linearly, at a typical size.
        constants: numbers that the structure fixes, SI; they are in the values of the act too.
        shown: whether a structure and its channels can show it.
        meanings: of its parameters by name, for people.
    """

    name: str
    form: str
    kind: Kind
    title: str
    signature: str
    source: str
    act: Act
    parameters: Callable[[StructureSizes], tuple[Parameter, ...]]
    starts: Callable[[StructureSizes], Rows]
    constants: Callable[[StructureSizes], Values] = field(default=lambda _: {})
    shown: Callable[[StructureSizes], bool] = field(default=lambda _: True)
    meanings: Mapping[str, str] = field(default_factory=dict)

    @property
    def label(self) -> str:
        """Name and form."""
        return f"{self.name}.{self.form}"


@dataclass(frozen=True, eq=False)
class FormInStructure(FormInCampaign):
    """A form with the numbers that a structure fixes."""

    form: StructureForm  # type: ignore[assignment]
