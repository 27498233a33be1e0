"""Files with the nationally determined parameters of a country, those of the package and those of users."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Annotated, Any, Generic, Literal, TypeVar, get_args

from pydantic import BeforeValidator, Field

from edesign.project.actions.hazard_base import Hazard
from edesign.project.actions.national import (
    ActionFactors,
    Category,
    ImportanceClass,
    Occupancy,
    Psi,
    ResistanceFactors,
    by_importance,
)
from edesign.project.notation.units import PositiveFactor, PositiveRatio, UnitRatio
from edesign.project.reading.base import Model, refuse
from edesign.project.reading.problems import FileProblems, unknown_name
from edesign.project.reading.yaml_file import check_model, read_yaml_file, yaml_text

V = TypeVar("V")
_WHAT = "national data file"
_BEGINS = "zones:"
Zone = Annotated[str, Field(min_length=1)]
Ground = Literal["A", "B", "C", "D", "E"]
FewYears = Annotated[float, Field(gt=0.0)]


def _types(value: Any) -> Any:
    return _keys(value, ("1", "2"), "type of spectrum")


def _grounds(value: Any) -> Any:
    return _keys(value, get_args(Ground), "ground type")


def _keys(value: Any, allowed: Collection[str], what: str) -> Any:
    for key in value if isinstance(value, Mapping) else ():
        if key not in allowed:
            raise refuse(unknown_name(what, key, allowed), key)
    return value


class Entry(Model, Generic[V]):
    """A parameter: its value, the clause that leaves it to the countries, where the value stands, and its unit.

    Attributes:
        value: value of the parameter.
        clause: clause that leaves the parameter to the countries.
        source: document in which the value stands.
        unit: unit of the value; empty where it has none.
    """

    value: V
    clause: Annotated[str, Field(min_length=1)]
    source: Annotated[str, Field(min_length=1)]
    unit: str = ""


class Accelerations(Entry[dict[Zone, PositiveFactor]]):
    """Reference peak ground acceleration by zone, in its unit.

    Attributes:
        unit: unit of the accelerations.
    """

    unit: Literal["g", "m/s2"]


class Corners(Model):
    """Corner periods of a spectrum, and its largest amplification.

    Attributes:
        T_B: first corner period, s.
        T_C: second corner period, s.
        T_D: third corner period, s.
        F_0: largest amplification; without the key 2.5 of a horizontal spectrum, 3.0 of a vertical one.
    """

    T_B: PositiveFactor
    T_C: PositiveFactor
    T_D: PositiveFactor
    F_0: PositiveFactor | None = None


class HorizontalRow(Corners):
    """A row of Table 3.2 or 3.3.

    Attributes:
        S: soil factor.
    """

    S: PositiveFactor


class VerticalRow(Corners):
    """A row of Table 3.4.

    Attributes:
        ratio: a_vg over a_g.
    """

    ratio: PositiveFactor


Horizontal = Annotated[
    dict[str, Annotated[dict[Ground, HorizontalRow], BeforeValidator(_grounds)]], BeforeValidator(_types)
]
Vertical = Annotated[dict[str, VerticalRow], BeforeValidator(_types)]


class NationalFile(Model):
    """The parameters of a country; what it does not state is as recommended.

    Attributes:
        zones: reference peak ground acceleration by zone (EN 1998-1, 3.2.1(2)).
        zone_spectra: type of the spectrum by zone, where it is fixed.
        reference_probability: P_NCR, probability of exceedance in 50 years of the reference action (EN 1998-1, 2.1).
        reference_return_period: T_NCR, return period of the reference action in years (EN 1998-1, 2.1).
        hazard_exponent: exponent k of the hazard curve (EN 1998-1, 2.1(4)).
        horizontal: horizontal spectra by type, then ground type (EN 1998-1, Tables 3.2 and 3.3).
        vertical: vertical spectra by type (EN 1998-1, Table 3.4).
        lower_bound_factor: lower bound beta of the design spectrum (EN 1998-1, 3.2.2.5(4)P).
        importance_factors: gamma_I by importance class (EN 1998-1, 4.2.5(5)P); class II is 1.0.
        phi: factor phi by occupancy of storeys (EN 1998-1, Table 4.2).
        displacement_reduction: reduction nu of the action by importance class (EN 1998-1, 4.4.3.2(2)).
        low_ductility_q: behaviour factor of low ductility, DCL (EN 1998-1, 6.1.2(1)).
        material_overstrength: material overstrength gamma_ov (EN 1998-1, 6.2(3)).
        post_buckling: gamma_pb, what is left of a diagonal in compression (EN 1998-1, 6.7.4(2)).
        psi: psi_0, psi_1 and psi_2 by category (EN 1990, Table A1.1).
        action_factors: partial factors of actions (EN 1990, Table A1.2(B)).
        resistance_factors: partial factors of resistance (EN 1993-1-1, 6.1).
    """

    zones: Accelerations | None = None
    zone_spectra: Entry[dict[Zone, Annotated[int, Field(ge=1, le=2)]]] | None = None
    reference_probability: Entry[PositiveRatio] | None = None
    reference_return_period: Entry[FewYears] | None = None
    hazard_exponent: Entry[PositiveFactor] | None = None
    horizontal: Entry[Horizontal] | None = None
    vertical: Entry[Vertical] | None = None
    lower_bound_factor: Entry[UnitRatio] | None = None
    importance_factors: (
        Entry[Annotated[dict[ImportanceClass, PositiveFactor], BeforeValidator(by_importance)]] | None
    ) = None
    phi: Entry[dict[Occupancy, UnitRatio]] | None = None
    displacement_reduction: Entry[dict[ImportanceClass, PositiveRatio]] | None = None
    low_ductility_q: Entry[Annotated[float, Field(ge=1.0, le=2.0)]] | None = None
    material_overstrength: Entry[Annotated[float, Field(ge=1.0)]] | None = None
    post_buckling: Entry[UnitRatio] | None = None
    psi: Entry[dict[Category, Psi]] | None = None
    action_factors: Entry[ActionFactors] | None = None
    resistance_factors: Entry[ResistanceFactors] | None = None


class NationalFileError(FileProblems):
    """A national data file is wrong."""


def read_national_file(hazard: Hazard, file: str) -> dict[str, dict[str, Any]]:
    """Read the parameters of a country from a file that a hazard names.

    Args:
        hazard: the seismic action, which keeps the content of the file.

    Returns:
        The stated parameters by name, each with its value, clause and source.

    Raises:
        InputError: the file cannot be read.
        NationalFileError: the file is wrong; the message lists all problems with file, line and column.
    """
    path = hazard.path_of(file)
    return parse_national(yaml_text(hazard.content(file, lambda path: read_yaml_file(path, _WHAT)), path), path)


def parse_national(text: str, path: Path) -> dict[str, dict[str, Any]]:
    """Check the text of a national data file; result and errors as `read_national_file`.

    Args:
        path: path of the file, for messages.
    """
    found, problems = check_model(text, NationalFile, _WHAT, _BEGINS)
    if found is None or problems.found:
        raise NationalFileError(path, problems.found)
    entries = {name: getattr(found, name) for name in NationalFile.model_fields}
    plain = {name: entry.model_dump(exclude_none=True) for name, entry in entries.items() if entry is not None}
    for name in ("horizontal", "vertical"):
        if name in plain:  # keys of a file are text; types of spectra are numbers
            plain[name]["value"] = {int(key): of for key, of in plain[name]["value"].items()}
    return plain
