"""How temperatures, and temperature laws of dampers, are written in YAML."""

from __future__ import annotations

import re
from typing import Annotated, Any

from pydantic import Field, model_validator

from edesign.damper.temperature import FerryShift, GammaOf, GammaT
from edesign.errors import InputError
from edesign.project.notation.temperature import Temperature
from edesign.project.notation.units import Factor, PositiveFactor
from edesign.project.notation.written import Written, text
from edesign.project.reading.base import Model, refuse

_NUMBER = r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
_DIFFERENCE = re.compile(rf"\s*({_NUMBER})\s*(?:K|degC|°C)\s*")


def _kelvin(value: Any) -> float:
    match = _DIFFERENCE.fullmatch(value) if isinstance(value, str) else None
    if not match or not float(match[1]) > 0.0:
        raise refuse(
            f"`{value}`: a difference of temperatures greater than zero is needed, for example `50 K` [E-LAW-05]"
        )
    return float(match[1])


class Ferry(Model):
    """Ferry's shift, Eq. 4.33.

    Attributes:
        p1: parameter p1 of the shift.
        p2: parameter p2 of the shift, a difference of temperatures.
        reference: reference temperature.
    """

    p1: Factor
    p2: Annotated[float, Written(_kelvin, text("difference of temperatures", rf"{_NUMBER}\s*(?:K|degC|°C)", "50 K"))]
    reference: Temperature


class TemperatureLaw(Model):
    """Change of the parameters of a law with temperature: by gamma_T, or by Ferry's shift.

    Attributes:
        gamma_T: factor gamma_T by temperature; this key or `ferry`.
        of: what gamma_T multiplies.
        ferry: Ferry's shift of time; this key or `gamma_T`.
    """

    gamma_T: dict[Temperature, PositiveFactor] | None = Field(default=None)
    of: GammaOf = "parameters"
    ferry: Ferry | None = None

    @model_validator(mode="after")
    def _one(self) -> TemperatureLaw:
        if (self.gamma_T is None) == (self.ferry is None):
            raise refuse("one of `gamma_T` and `ferry` is needed [E-LAW-05]")
        if self.ferry is not None and "of" in self.model_fields_set:
            raise refuse("`of` is what gamma_T multiplies; leave it out beside `ferry` [E-LAW-05]", "of")
        try:
            self.model()
        except InputError as error:
            raise refuse(str(error), "gamma_T") from None
        return self

    def model(self) -> GammaT | FerryShift:
        """Return the temperature law."""
        if self.ferry is not None:
            return FerryShift(self.ferry.p1, self.ferry.p2, self.ferry.reference)
        assert self.gamma_T is not None
        return GammaT(tuple(sorted(self.gamma_T.items())), self.of)
