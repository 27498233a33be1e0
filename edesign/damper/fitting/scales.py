"""Sizes of force, deformation and velocity in a campaign: they make every parameter of a law a number about one."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

_POWER = re.compile(r"(.+)\^([A-Za-z_]\w*)")  # N*(s/m)^alpha, s^nu: another parameter is the exponent


@dataclass(frozen=True)
class Scales:
    """Sizes to measure parameters in.

    Attributes:
        force: N.
        deformation: m.
        velocity: m/s.
    """

    force: float
    deformation: float
    velocity: float

    @property
    def time(self) -> float:
        """Deformation over velocity, s: one over the circular frequency of a sine."""
        return self.deformation / self.velocity

    def of(self, unit: str, values: Mapping[str, float]) -> float:
        """Return the size of a quantity.

        Args:
            unit: of a parameter, as in edesign.damper.laws.
            values: parameters of the law, for exponents in the unit.
        """
        power = _POWER.fullmatch(unit)
        if power:
            exponent = values[power[2]]
            return self.force * self.velocity**-exponent if unit.startswith("N") else self.time**exponent
        return {
            "": 1.0,
            "N": self.force,
            "N/m": self.force / self.deformation,
            "N/m^2": self.force / self.deformation**2,
            "N/m^3": self.force / self.deformation**3,
            "N*s/m": self.force / self.velocity,
            "Pa": self.force / self.deformation**2,
            "m": self.deformation,
            "1/m": 1.0 / self.deformation,
            "m^2": self.deformation**2,
            "m/s": self.velocity,
            "s/m": 1.0 / self.velocity,
            "s": self.time,
            "rad/s": 1.0 / self.time,
        }[unit]


def exponent_in(unit: str) -> str | None:
    """Return the name of the parameter that is an exponent in a unit; None without one.

    Args:
        unit: of another parameter.
    """
    power = _POWER.fullmatch(unit)
    return power[2] if power else None
