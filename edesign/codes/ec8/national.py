"""Nationally determined parameters of EN 1998-1:2004: one data file a country, beside the recommended values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import Any

import yaml
from scipy.constants import g

from edesign.codes.ec8.parameters import HorizontalParameters, VerticalParameters, horizontal_of, vertical_of
from edesign.codes.names import unknown
from edesign.errors import InputError

_RECOMMENDED = "recommended"


@dataclass(frozen=True)
class Parameter:
    """A nationally determined parameter.

    Attributes:
        name: key in the data file.
        value: a number, or a table as it stands in the file.
        unit: of the value; empty where it has none.
        clause: of EN 1998-1 that allows the choice.
        source: where the value stands.
        origin: the country, or "recommended".
    """

    name: str
    value: Any
    unit: str
    clause: str
    source: str
    origin: str


@dataclass(frozen=True)
class NationalParameters:
    """The parameters of a country; what its data file does not state is the recommended value.

    Attributes:
        country: None for the recommended values throughout.
        parameters: by name; each says where it comes from.
    """

    country: str | None
    parameters: Mapping[str, Parameter]

    @property
    def reference_probability(self) -> float:
        """P_NCR in 50 years."""
        return float(self.parameters["reference_probability"].value)

    @property
    def reference_return_period(self) -> float:
        """T_NCR, years."""
        return float(self.parameters["reference_return_period"].value)

    @property
    def hazard_exponent(self) -> float:
        """Exponent k of the hazard curve."""
        return float(self.parameters["hazard_exponent"].value)

    @property
    def beta(self) -> float:
        """Lower bound factor of the design spectrum."""
        return float(self.parameters["lower_bound_factor"].value)

    @property
    def zones(self) -> Mapping[str, float]:
        """Reference peak ground acceleration a_gR by zone, m/s2; empty where none are known."""
        if "zones" not in self.parameters:
            return {}
        return {name: float(value) * g for name, value in self.parameters["zones"].value.items()}

    def a_gR(self, zone: str) -> float:
        """Return the reference peak ground acceleration of a zone, m/s2; `3` is `Z3`.

        Raises:
            InputError: there is no such zone.
        """
        zones = self.zones
        if not zones:
            raise InputError("the recommended values have no zones: name a country, or give a_gR")
        for name in (zone, f"Z{zone}", zone.upper()):
            if name in zones:
                return zones[name]
        raise unknown(f"zone in {self.country}", zone, zones)

    def gamma_I(self, importance_class: str) -> float:
        """Return the importance factor of a class I to IV, 4.2.5(5)P.

        Raises:
            InputError: there is no such class.
        """
        factors = self.parameters["importance_factors"].value
        if importance_class not in factors:
            raise unknown("importance class", importance_class, factors)
        return float(factors[importance_class])

    def horizontal(self, spectrum_type: int, ground: str) -> HorizontalParameters:
        """Return the parameters of a horizontal spectrum.

        Raises:
            InputError: no such type or ground.
        """
        return horizontal_of(self.parameters["horizontal"].value, spectrum_type, ground)

    def vertical(self, spectrum_type: int) -> VerticalParameters:
        """Return the parameters of the vertical spectrum.

        Raises:
            InputError: no such type.
        """
        return vertical_of(self.parameters["vertical"].value, spectrum_type)


def countries() -> tuple[str, ...]:
    """Return the names of the countries that have a data file."""
    names = (path.name for path in resources.files("edesign.codes.ec8").joinpath("data").iterdir())
    return tuple(
        sorted(name.removesuffix(".yaml") for name in names if name.endswith(".yaml") and _RECOMMENDED not in name)
    )


@cache
def national_parameters(country: str | None = None) -> NationalParameters:
    """Return the parameters of a country, or the recommended ones.

    Args:
        country: such as "greece"; None for the recommended values.

    Raises:
        InputError: the country has no data file; the message names those that have.
    """
    parameters = _read(_RECOMMENDED)
    if country is None:
        return NationalParameters(None, parameters)
    if country not in countries():
        raise unknown("country", country, countries())
    return NationalParameters(country, {**parameters, **_read(country)})


def _read(name: str) -> dict[str, Parameter]:
    text = resources.files("edesign.codes.ec8").joinpath(f"data/{name}.yaml").read_text(encoding="utf-8")
    entries = yaml.safe_load(text)
    return {
        key: Parameter(key, entry["value"], entry.get("unit", ""), str(entry["clause"]), entry["source"], name)
        for key, entry in entries.items()
    }
