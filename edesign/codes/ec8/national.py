"""Nationally determined parameters of EN 1998-1:2004: one data file a country, beside the recommended values.

The files hold also those of EN 1990 and EN 1993-1-1 that the design of a steel building in an earthquake needs.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from importlib import resources
from typing import Any

import yaml

from edesign.codes.ec8.action.parameters import HorizontalParameters, VerticalParameters, horizontal_of, vertical_of
from edesign.codes.names import unknown
from edesign.codes.quantities import STANDARD_GRAVITY
from edesign.errors import InputError

_RECOMMENDED = "recommended"
_WHOLE = ("zones", "zone_spectra", "horizontal", "vertical")


@dataclass(frozen=True)
class Parameter:
    """A nationally determined parameter.

    Attributes:
        name: key in the data file.
        value: a number, or a table as it stands in the file.
        unit: of the value; empty where it has none.
        clause: that allows the choice, of EN 1998-1 unless it names another standard.
        source: where the value stands.
        origin: the country, "recommended", or "file" of a value that the user states.
    """

    name: str
    value: Any
    unit: str
    clause: str
    source: str
    origin: str


@dataclass(frozen=True)
class Psi:
    """Factors of a variable action: psi_0 combination, psi_1 frequent, psi_2 quasi-permanent value (EN 1990, 4.1.3)."""

    psi_0: float
    psi_1: float
    psi_2: float


@dataclass(frozen=True)
class ActionFactors:
    """Partial factors of actions for buildings (EN 1990, Table A1.2(B)).

    Attributes:
        G_sup, G_inf: gamma_G of unfavourable and of favourable permanent actions.
        Q: gamma_Q of unfavourable variable actions; favourable ones do not count.
        xi: reduces gamma_G,sup in Eq. 6.10b.
        G2_sup, G2_inf: of permanent actions that are not structural, where the code has factors of their own.
    """

    G_sup: float = 1.35
    G_inf: float = 1.0
    Q: float = 1.5
    xi: float = 0.85
    G2_sup: float | None = None
    G2_inf: float | None = None


@dataclass(frozen=True)
class NationalParameters:
    """The parameters of a country; what its data file does not state is the recommended value.

    Attributes:
        country: None for the recommended values throughout.
        parameters: by name; each says where it comes from.
    """

    country: str | None
    parameters: Mapping[str, Parameter]

    def with_values(self, stated: Mapping[str, Any], spectrum_type: int) -> NationalParameters:
        """Return these parameters with values of the user; of a table the entries given replace those there.

        Args:
            stated: values by the names of the data files; that of `vertical` is a row of the table.
            spectrum_type: 1 or 2, of that row.
        """
        changed = dict(self.parameters)
        for name, value in stated.items():
            known = changed[name]
            if name == "vertical":
                value = {spectrum_type: {**known.value[spectrum_type], **value}}
            if isinstance(known.value, Mapping):
                value = {**known.value, **value}
            changed[name] = replace(known, value=value, source="stated by the user", origin="file")
        return replace(self, parameters=changed)

    @property
    def reference_probability(self) -> float:
        """Reference probability of exceedance P_NCR in 50 years."""
        return float(self.parameters["reference_probability"].value)

    @property
    def reference_return_period(self) -> float:
        """Reference return period T_NCR, years."""
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
    def gamma_ov(self) -> float:
        """Material overstrength factor of steel."""
        return float(self.parameters["material_overstrength"].value)

    @property
    def gamma_pb(self) -> float:
        """Share of N_pl,Rd that a V bracing keeps in compression after buckling."""
        return float(self.parameters["post_buckling"].value)

    @property
    def low_ductility_q(self) -> float:
        """Upper limit of q for ductility class low."""
        return float(self.parameters["low_ductility_q"].value)

    @property
    def phi(self) -> Mapping[str, float]:
        """Factor phi of Table 4.2: `roof`, storeys with `correlated` or `independent` occupancies, `other`."""
        return {name: float(value) for name, value in self.parameters["phi"].value.items()}

    @property
    def psi(self) -> Mapping[str, Psi]:
        """Factors psi by category of the variable action (EN 1990, Table A1.1)."""
        return {name: Psi(*map(float, values)) for name, values in self.parameters["psi"].value.items()}

    @property
    def action_factors(self) -> ActionFactors:
        """Partial factors of actions (EN 1990, Table A1.2(B))."""
        return ActionFactors(**self.parameters["action_factors"].value)

    @property
    def gamma_M(self) -> Mapping[str, float]:
        """Partial factors of resistance by name: `M0`, `M1`, `M2` (EN 1993-1-1, 6.1)."""
        return {name: float(value) for name, value in self.parameters["resistance_factors"].value.items()}

    @property
    def zones(self) -> Mapping[str, float]:
        """Reference peak ground acceleration a_gR by zone, m/s2; empty where none are known."""
        if "zones" not in self.parameters:
            return {}
        zones = self.parameters["zones"]
        unit = STANDARD_GRAVITY if zones.unit == "g" else 1.0
        return {name: float(value) * unit for name, value in zones.value.items()}

    def a_gR(self, zone: str) -> float:
        """Return the reference peak ground acceleration of a zone, m/s2.

        Args:
            zone: its name; `3` is `Z3`.

        Raises:
            InputError: there is no such zone.
        """
        return self.zones[self._zone(zone)]

    def check_spectrum_type(self, zone: str, spectrum_type: int) -> None:
        """Check that a zone takes a type of spectrum; where the country leaves the choice open, any will do.

        Args:
            spectrum_type: 1 or 2.

        Raises:
            InputError: there is no such zone, or it takes the other type.
        """
        if "zone_spectra" not in self.parameters:
            return
        fixed = self.parameters["zone_spectra"].value[self._zone(zone)]
        if spectrum_type != fixed:
            raise InputError(
                f"zone {zone} of {self.country} takes spectrum type {fixed}, not {spectrum_type} [E-EC8-02]"
            )

    def gamma_I(self, importance_class: str) -> float:
        """Return the importance factor of a class, 4.2.5(5)P.

        Args:
            importance_class: I to IV.

        Raises:
            InputError: there is no such class.
        """
        return self._of_class("importance_factors", importance_class)

    def nu(self, importance_class: str) -> float:
        """Return the reduction factor nu of displacements for damage limitation, 4.4.3.2(2).

        Args:
            importance_class: I to IV.

        Raises:
            InputError: there is no such importance class.
        """
        return self._of_class("displacement_reduction", importance_class)

    def horizontal(self, spectrum_type: int, ground: str) -> HorizontalParameters:
        """Return the parameters of a horizontal spectrum.

        Args:
            spectrum_type: 1 or 2.
            ground: ground type, A to E.

        Raises:
            InputError: no such type or ground.
        """
        return horizontal_of(self.parameters["horizontal"].value, spectrum_type, ground)

    def vertical(self, spectrum_type: int) -> VerticalParameters:
        """Return the parameters of the vertical spectrum.

        Args:
            spectrum_type: 1 or 2.

        Raises:
            InputError: no such type.
        """
        return vertical_of(self.parameters["vertical"].value, spectrum_type)

    def _zone(self, zone: str) -> str:
        zones = self.zones
        if not zones:
            raise InputError("the recommended values have no zones: name a country, or give a_gR [E-EC8-02]")
        for name in (zone, f"Z{zone}", zone.upper()):
            if name in zones:
                return name
        raise unknown(f"zone in {self.country}", zone, zones)

    def _of_class(self, name: str, importance_class: str) -> float:
        values = self.parameters[name].value
        if importance_class not in values:
            raise unknown("importance class", importance_class, values)
        return float(values[importance_class])


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


def parameters_of_file(country: str, entries: Mapping[str, Mapping[str, Any]]) -> NationalParameters:
    """Return the parameters of a country from the entries of a file of the user; the rest is as recommended.

    Of a table by class, occupancy or category the entries given count; tables of zones and spectra count as a whole.

    Args:
        country: its name, for messages.
        entries: value, unit, clause and source by name, as in the files of the package, and checked.
    """
    recommended, stated = _read(_RECOMMENDED), _parameters(entries, country)
    for name, parameter in stated.items():
        if name not in _WHOLE and isinstance(parameter.value, Mapping):
            stated[name] = replace(parameter, value={**recommended[name].value, **parameter.value})
    return NationalParameters(country, {**recommended, **stated})


def data_text(name: str) -> str:
    """Return the text of a data file of the package, such as that of "greece".

    Args:
        name: of the file without its ending.
    """
    return resources.files("edesign.codes.ec8").joinpath(f"data/{name}.yaml").read_text(encoding="utf-8")


def _read(name: str) -> dict[str, Parameter]:
    return _parameters(yaml.safe_load(data_text(name)), name)


def _parameters(entries: Mapping[str, Mapping[str, Any]], origin: str) -> dict[str, Parameter]:
    return {
        key: Parameter(key, entry["value"], entry.get("unit", ""), str(entry["clause"]), entry["source"], origin)
        for key, entry in entries.items()
    }
