"""Parameters of a law at another temperature: the factor gamma_T of the MGMM, and Ferry's shift of relaxation times."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal, Protocol

import numpy as np
import scipy

from edesign.damper.law import Law
from edesign.damper.laws import LAWS
from edesign.errors import InputError

REFERENCE_C = 20.0
"""Temperature in degC at which parameters hold where nothing else is said."""

UNIT_SPEED = 1e-3
"""1 mm/s: in Eq. 4.34 the exponent of the velocity changes with temperature but the number c_NL, made for mm/s, does
not, so the velocity in it is a multiple of this one."""

Values = dict[str, float]
Result = tuple[Values, tuple[str, ...]]


class TemperatureModel(Protocol):
    """Change of the parameters of laws with temperature."""

    @property
    def reference_C(self) -> float:
        """Temperature at which parameters are given."""

    @property
    def laws(self) -> tuple[str, ...]:
        """Names of the laws that the model is made for."""

    def shifted(self, law: Law, values: Mapping[str, float], temperature_C: float) -> Result:
        """Return parameters at a temperature, and warnings.

        Args:
            law: one of `laws`.
            values: complete parameters at the reference, SI.
            temperature_C: degC.
        """


GammaOf = Literal["parameters", "force", "by_the_letter"]
"""What gamma_T multiplies, see `GammaT`."""

SHAPES = ("alpha", "u_ref", "v_ref")
"""Parameters of the MGMM with which its force does not go in proportion."""

CHANGING = ("k1", "c1", "k0", "c_NL", "alpha", "k_a", "k_b", "u_ref", "c_a", "c_b", "v_ref")
"""Parameters of the MGMM that gamma_T multiplies."""


@dataclass(frozen=True)
class GammaT:
    """The factor gamma_T of the MGMM; linear between the temperatures of the table, and beyond it with a warning.

    Attributes:
        table: temperature in degC and gamma_T, ascending; without one Table 4.4. One gamma_T is 1: the reference.
        of: `parameters`: "all parameters change at the same rate", as the text of section 4.5 has it; `by_the_letter`:
            of Eq. 4.34, in which k_mod,T of Eq. 4.36 is multiplied by gamma_T once more; `force`: the force alone, as
            by others, so that alpha, u_ref and v_ref stay.

    Raises:
        InputError: a table that is not ascending, not positive, or without a reference.

    Source: thesis Eqs. 4.34-4.36 and Table 4.4, with c_NL for k_NL and sgn(v), which print lacks.
    """

    table: tuple[tuple[float, float], ...] = ((20.0, 1.0), (25.0, 0.935), (30.0, 0.875), (35.0, 0.820))
    of: GammaOf = "parameters"

    def __post_init__(self) -> None:
        temperatures = [temperature for temperature, _ in self.table]
        if len(set(temperatures)) < 2 or temperatures != sorted(set(temperatures)):
            raise InputError("gamma_T needs two or more temperatures, each once and ascending [E-LAW-05]")
        if not all(math.isfinite(t) and math.isfinite(gamma) and gamma > 0.0 for t, gamma in self.table):
            raise InputError("every gamma_T must be a number greater than 0 [E-LAW-05]")
        if sum(gamma == 1.0 for _, gamma in self.table) != 1:
            raise InputError(
                "gamma_T must be 1 at one temperature, the reference at which the parameters hold [E-LAW-05]"
            )

    @property
    def reference_C(self) -> float:
        """Temperature at which gamma_T is 1."""
        return next(temperature for temperature, gamma in self.table if gamma == 1.0)

    @property
    def laws(self) -> tuple[str, ...]:
        """Names of the laws: the MGMM alone."""
        return ("mgmm",)

    @property
    def _range_C(self) -> tuple[float, float]:
        """First and last temperature of the table."""
        return self.table[0][0], self.table[-1][0]

    def gamma(self, temperature_C: float) -> float:
        """Return gamma_T at a temperature.

        Args:
            temperature_C: degC.

        Raises:
            InputError: the straight line beyond the table has come to zero.
        """
        last = len(self.table) - 2
        i = next((i for i in range(last) if temperature_C <= self.table[i + 1][0]), last)
        (t0, gamma0), (t1, gamma1) = self.table[i : i + 2]
        gamma = gamma0 + (gamma1 - gamma0) * (temperature_C - t0) / (t1 - t0)
        if not gamma > 0.0:
            raise InputError(
                f"gamma_T at {temperature_C:g} degC would be {gamma:.3g}, but must be greater than 0; the table "
                f"goes from {self._range_C[0]:g} to {self._range_C[1]:g} degC [E-LAW-04]"
            )
        return gamma

    def about(self, reference_C: float) -> GammaT:
        """Return the change with temperature for parameters that hold at another reference: gamma_T / gamma_T there.

        Args:
            reference_C: degC.
        """
        gamma = self.gamma(reference_C)
        rows = {temperature: value / gamma for temperature, value in self.table} | {reference_C: 1.0}
        return replace(self, table=tuple(sorted(rows.items())))

    def shifted(self, law: Law, values: Mapping[str, float], temperature_C: float) -> Result:
        """Return MGMM parameters at a temperature: Eqs. 4.34-4.36 have the form of Eqs. 4.24-4.29 with these.

        Args:
            values: complete parameters at the reference, SI.
            temperature_C: degC.
        """
        gamma = self.gamma(temperature_C)
        low, high = self._range_C
        warnings = []
        if not low <= temperature_C <= high:
            warnings.append(
                f"gamma_T at {temperature_C:g} degC is {gamma:.3g} on a straight line beyond its table, which goes "
                f"from {low:g} to {high:g} degC"
            )
        return self.at_rate(values, gamma), tuple(warnings)

    def at_rate(self, values: Mapping[str, float], gamma: float) -> Values:
        """Return MGMM parameters with a gamma_T that is so many times as large.

        Args:
            values: parameters by name, SI.
            gamma: factor on gamma_T.
        """
        if self.of == "force":
            return {name: v * gamma if name in CHANGING and name not in SHAPES else v for name, v in values.items()}
        found = at_one_rate(values, gamma)
        if self.of == "by_the_letter":
            found["k_a"] *= gamma
            found["k_b"] *= gamma
        return found


def at_one_rate(values: Mapping[str, float], gamma: float) -> dict[str, float]:
    """Return parameters of the MGMM, SI, all multiplied by one factor: c_NL as the thesis has it, in kN (s/mm)^alpha.

    Args:
        values: parameters by name, SI.
    """
    found = dict(values)
    for name in CHANGING:
        found[name] *= gamma
    found["c_NL"] *= UNIT_SPEED ** (values["alpha"] - found["alpha"])
    return found


def passed(temperature_C: float | np.ndarray, middle: float, width: float, reference_C: float) -> float | np.ndarray:
    """Return the share of a transition over a temperature that lies beyond a reference.

    It is S(T) - S(T0) with S(T) = 1/(1 + exp(-(T - middle)/width)).

    Args:
        temperature_C: (n,) or a scalar, degC.
        middle: of the transition, degC.
        width: of the transition, degC.
        reference_C: T0, degC.

    Returns:
        The share, (n,) or a scalar.
    """
    return scipy.special.expit((temperature_C - middle) / width) - scipy.special.expit((reference_C - middle) / width)


# what is multiplied by a_T to which power (1, or the parameter of that name) in laws with relaxation times
_TIMES: dict[str, dict[str, str]] = {
    "kelvin_voigt": {"c": ""},
    "zener": {"c1": ""},
    "generalised_maxwell": {},  # every c
    "viscous": {"c": ""},
    "maxwell": {"c0": "", "lambda": ""},
    "fractional_kelvin": {"c": "alpha"},
    "fractional_zener": {"a": "alpha", "b": "alpha"},
    "fractional_maxwell": {"c0": "", "lambda": "nu"},
}
LINEAR_LAWS = tuple(_TIMES)
"""The linear viscoelastic laws: their stiffness does not change with the amplitude."""


@dataclass(frozen=True)
class FerryShift:
    """Ferry's shift a_T = exp(-p1 (T - T_ref) / (p2 + T - T_ref)) of all relaxation times.

    A law at T answers a frequency f as it does at the reference temperature to a_T f.

    Attributes:
        p1: dimensionless, at least 0.
        p2: K, greater than 0.
        reference: T_ref, degC.

    Source: thesis Eq. 4.33; Ferry (1980), Viscoelastic Properties of Polymers, chapter 11.
    """

    p1: float
    p2: float
    reference: float = REFERENCE_C

    def __post_init__(self) -> None:
        if not (math.isfinite(self.p1) and self.p1 >= 0.0):
            raise InputError(f"p1 = {self.p1:g} is out of range: at least 0 is allowed [E-LAW-03]")
        if not (math.isfinite(self.p2) and self.p2 > 0.0):
            raise InputError(f"p2 = {self.p2:g} K is out of range: greater than 0 is allowed [E-LAW-03]")

    @property
    def reference_C(self) -> float:
        """Reference temperature T_ref, degC."""
        return self.reference

    @property
    def laws(self) -> tuple[str, ...]:
        """Names of the linear viscoelastic laws."""
        return LINEAR_LAWS

    def factor(self, temperature_C: float) -> float:
        """Return the shift factor a_T at a temperature.

        Args:
            temperature_C: degC.

        Raises:
            InputError: p2 + T - T_ref is not greater than zero.
        """
        warmer = temperature_C - self.reference
        if not self.p2 + warmer > 0.0:
            raise InputError(
                f"Ferry's shift with p2 = {self.p2:g} K holds above {self.reference - self.p2:g} degC, not at "
                f"{temperature_C:g} degC [E-LAW-04]"
            )
        return math.exp(-self.p1 * warmer / (self.p2 + warmer))

    def shifted(self, law: Law, values: Mapping[str, float], temperature_C: float) -> Result:
        """Return parameters with all relaxation times multiplied by a_T; stiffnesses stay.

        Args:
            values: complete parameters at the reference, SI.
            temperature_C: degC.
        """
        a_t = self.factor(temperature_C)
        found = dict(values)
        powers = _TIMES[law.name]
        if law.branch:
            powers = {name: "" for name in values if name[0] == "c"}
        for name, power in powers.items():
            found[name] *= a_t ** (values[power] if power else 1.0)
        return found, ()


def at(
    law: Law,
    values: Mapping[str, float],
    temperature_C: float,
    model: TemperatureModel | None = None,
    reference_C: float = REFERENCE_C,
) -> tuple[dict[str, float], tuple[str, ...]]:
    """Return the parameters of a law at a temperature.

    Args:
        values: parameters by name at the reference temperature, SI units.
        temperature_C: degC.
        model: how they change; None: the table of the thesis for the MGMM, no change for other laws.
        reference_C: at which the values hold, degC; a model knows its own.

    Returns:
        All parameters at that temperature, SI units; warnings.

    Raises:
        InputError: the model is made for other laws, or does not reach that temperature.
    """
    complete = law.complete(values)
    if not math.isfinite(temperature_C) or temperature_C <= -273.15:
        raise InputError(f"{temperature_C:g} degC is no temperature [E-LAW-04]")
    warnings: tuple[str, ...] = ()
    if model is None:
        if temperature_C == reference_C:
            return complete, ()
        if law.name not in GammaT().laws:
            return complete, (
                f"law {law.name} has no temperature law here: parameters of {reference_C:g} degC are taken at "
                f"{temperature_C:g} degC",
            )
        model = GammaT() if reference_C == REFERENCE_C else GammaT().about(reference_C)
        warnings = (
            f"no temperature law is given: the published factor gamma_T of this law is taken at {temperature_C:g} degC",
        )
    if law.name not in model.laws:
        allowed = ", ".join(name for name in LAWS if name in model.laws)
        raise InputError(f"this temperature law is not made for law {law.name} (it is for: {allowed}) [E-LAW-05]")
    found, more = model.shifted(law, complete, temperature_C)
    return law.complete(found), (*warnings, *more)
