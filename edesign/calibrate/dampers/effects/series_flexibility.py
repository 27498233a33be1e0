"""Flexibility of the rig between the displacement transducer and the specimen."""

from __future__ import annotations

from typing import ClassVar

from edesign.calibrate.dampers.effect import Form, Series
from edesign.calibrate.dampers.trial import Sizes, Values
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown


class Linear(Form):
    """A spring in series: the specimen deforms by u - F / stiffness."""

    name: ClassVar[str] = "series_flexibility"
    form: ClassVar[str] = "linear"
    kind: ClassVar[Kind] = "rig"
    title: ClassVar[str] = "flexible parts of the rig in series with the specimen"
    signature: ClassVar[str] = (
        "forces too small where the specimen is stiffest (fast, cold), in proportion to the square of its stiffness"
    )
    source: ClassVar[str] = "two springs in series"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        k = sizes.stiffness
        return (Unknown("stiffness", "N/m", 1.5 * k, 1e4 * k, 20.0 * k, logarithmic=True),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        # its force goes with 1 / stiffness: searches from too flexible are short, from too stiff they jump
        return ((20.0 * sizes.stiffness,),)

    def series(self, p: Values) -> Series:
        return p["stiffness"], 0.0


FORMS = (Linear,)
