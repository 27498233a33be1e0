"""Where an effect of a structure acts: on the building, beside its storeys, in its channels."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.calibration.form import Form, Values
from edesign.calibration.structures.building import Building
from edesign.calibration.structures.record import Channel
from edesign.calibration.structures.response import Link
from edesign.calibration.structures.sizes import StructureSizes


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


Mechanism = ChangedBuilding | Links | ChangedChannels


@dataclass(frozen=True, eq=False)
class StructureForm(Form[Mechanism, StructureSizes]):
    """A form of an effect of a structure or of its instruments."""
