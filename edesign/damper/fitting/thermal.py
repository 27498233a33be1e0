"""Unknowns of the temperature: gamma_T of each temperature, or the two of Ferry's shift."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from edesign.damper.law import Law, Parameter
from edesign.damper.temperature import REFERENCE_C, FerryShift, GammaT, TemperatureModel, at
from edesign.errors import InputError

ThermalKind = Literal["gamma", "ferry"]

_FERRY = (
    Parameter("p1", "slope of Ferry's shift", "", default=3.0),
    Parameter("p2", "curvature of Ferry's shift, K", "", default=100.0),
)
_FERRY_AWAY = 2  # temperatures besides the reference that two unknowns need


@dataclass(frozen=True)
class Thermal:
    """Treatment of tests at several temperatures in a fit.

    Attributes:
        kind: "gamma": gamma_T of each temperature besides the reference (Eq. 4.34); "ferry": p1 and p2 (Eq. 4.33);
            None: one set of parameters at all temperatures.
        reference_C: temperature at which the law's parameters hold, degC.
        temperatures: those of the tests, ascending, degC.
    """

    kind: ThermalKind | None
    reference_C: float
    temperatures: tuple[float, ...]

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """The unknowns, with start values as defaults."""
        if self.kind == "ferry":
            return _FERRY
        if self.kind == "gamma":
            return tuple(
                Parameter(gamma_name(t), f"gamma_T at {t:g} degC", "", lower=0.05, upper=20.0, default=1.0)
                for t in self.temperatures
                if t != self.reference_C
            )
        return ()

    def model(self, values: Mapping[str, float]) -> TemperatureModel | None:
        """Return the temperature law of values of the unknowns; None where they have none.

        Args:
            values: parameters by name, SI.
        """
        if self.kind == "ferry":
            return FerryShift(values["p1"], values["p2"], self.reference_C)
        if self.kind == "gamma":
            return GammaT(tuple((t, self._gamma(values, t)) for t in self.temperatures))
        return None

    def at(self, law: Law, values: Mapping[str, float], temperature_C: float) -> dict[str, float]:
        """Return the parameters of the law at a temperature.

        Args:
            values: of law and temperature together, SI.
            temperature_C: degC.
        """
        own = {name: value for name, value in values.items() if name not in self._names}
        if self.kind is None or temperature_C == self.reference_C:
            return own
        return at(law, own, temperature_C, self.model(values))[0]

    def _gamma(self, values: Mapping[str, float], temperature_C: float) -> float:
        """gamma_T; exactly 1 only at the reference, which GammaT knows by that."""
        if temperature_C == self.reference_C:
            return 1.0
        gamma = values[gamma_name(temperature_C)]
        return gamma if gamma != 1.0 else math.nextafter(1.0, 2.0)

    @property
    def _names(self) -> frozenset[str]:
        return frozenset(parameter.name for parameter in self.parameters)


def gamma_name(temperature_C: float) -> str:
    """Return the name of the unknown of a temperature: gamma_25.

    Args:
        temperature_C: degC.
    """
    return f"gamma_{temperature_C:g}"


def thermal(
    law: Law, kind: ThermalKind | None, temperatures: Sequence[float], reference_C: float | None = None
) -> Thermal:
    """Return the unknowns for tests at these temperatures.

    Args:
        kind: see Thermal.
        temperatures: of the tests, degC.
        reference_C: degC; None: 20 degC if a test has it, else the lowest of the tests.

    Raises:
        InputError: the kind is not made for the law, or the tests cannot determine its unknowns.
    """
    known = tuple(sorted(set(temperatures)))
    reference = reference_C if reference_C is not None else REFERENCE_C if REFERENCE_C in known else known[0]
    if kind is None:
        return Thermal(None, reference, known)
    if kind not in ("gamma", "ferry"):
        raise InputError(f"temperature: `{kind}` is unknown (gamma, ferry) [E-FIT-05]")
    shown = ", ".join(f"{t:g}" for t in known)
    if len(known) < 2:
        raise InputError(
            f"temperature: all tests are at {shown} degC; an effect of temperature cannot be fitted [E-FIT-05]"
        )
    if reference not in known:
        raise InputError(
            f"temperature: no test is at the reference of {reference:g} degC (they are at {shown}) [E-FIT-05]"
        )
    if kind == "ferry" and len(known) - 1 < _FERRY_AWAY:
        raise InputError(
            f"temperature: Ferry's p1 and p2 need tests at three temperatures; they are at {shown} degC [E-FIT-05]"
        )
    found = Thermal(kind, reference, known)
    example = found.model({p.name: p.default or 1.0 for p in found.parameters})
    if example is not None and law.name not in example.laws:
        raise InputError(
            f"temperature: `{kind}` is not made for law {law.name} (it is for: {', '.join(example.laws)}) [E-FIT-05]"
        )
    return found
