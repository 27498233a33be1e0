"""The seismic action at the site: by a code, or as spectra of the user."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field

from edesign.project.actions.hazard_base import Hazard, LevelName, Probability, Years
from edesign.project.actions.national import NationalValues
from edesign.project.actions.spectrum_tables import SpectrumFile, SpectrumTable
from edesign.project.notation.units import (
    PositiveAcceleration,
    PositiveFactor,
    PositiveRatio,
    PositiveTime,
    parse_ratio,
)
from edesign.project.notation.written import Written, given, ratio
from edesign.project.reading.base import Model, refuse
from edesign.project.reading.one_of import OneOf
from edesign.project.reading.problems import Keys


def _zone(value: Any) -> str:
    if isinstance(value, bool) or not isinstance(value, (int, str)) or not str(value).strip():
        raise refuse("a zone of the country is needed: its number or name, for example `3` or `Z3` [E-VALUE-01]")
    return str(value).strip()


def _spectrum_type(value: Any) -> int:
    if type(value) is not int or value not in (1, 2):  # `true` is equal to 1
        raise refuse("the type of spectrum is 1 or 2 [E-VALUE-03]")
    return value


def _behaviour_factor(value: Any) -> float:
    return parse_ratio(value, 1.0, math.inf)


BehaviourFactor = Annotated[float, Written(_behaviour_factor, ratio(1.0, math.inf))]


class SpectrumParameters(Model):
    """Values of the site that replace those of the table.

    Attributes:
        S: soil factor in place of that of the table.
        F_0: largest amplification of the spectrum at 5 % damping, in place of 2.5.
        T_B: first corner period in place of that of the table.
        T_C: second corner period in place of that of the table.
        T_D: third corner period in place of that of the table.
    """

    S: PositiveFactor | None = None
    F_0: PositiveFactor | None = None
    T_B: PositiveTime | None = None
    T_C: PositiveTime | None = None
    T_D: PositiveTime | None = None


class Level(Model):
    """A hazard level, by exactly one of its keys.

    Attributes:
        probability: probability of exceedance in 50 years.
        return_period: mean return period, at least a year.
        importance_class: importance class of the building, which gives gamma_I.
        gamma_I: importance factor itself.
    """

    probability: Probability | None = None
    return_period: Years | None = None
    importance_class: Literal["I", "II", "III", "IV"] | None = None
    gamma_I: PositiveFactor | None = None


class EC8Hazard(Hazard):
    """The action of EN 1998-1: the reference acceleration of a zone or a_gR, the shape of the spectrum, and the levels.

    Attributes:
        code: EN 1998-1:2004.
        country: country whose national parameters count, or a national data file; without the key the recommended
            values.
        zone: seismic zone of the country, which gives a_gR; this key or `a_gR`.
        a_gR: reference peak ground acceleration on ground A; this key or `zone`.
        ground: ground type (EN 1998-1, Table 3.1).
        spectrum: type of the spectrum (EN 1998-1, 3.2.2.2(2)).
        parameters: values of the site that replace those of the table of spectra.
        national: national parameters in place of those of the country.
        behaviour_factor: behaviour factor q of the design spectrum; without the key there is no design spectrum.
        k: exponent of the hazard curve, for levels by probability or return period; without the key that of the code,
            3.
        levels: hazard levels by name; each by exactly one of probability, return period, class or factor.
    """

    code: Literal["ec8-2004"]
    country: Annotated[str, Field(min_length=1)] | None = None
    zone: (
        Annotated[str, Written(_zone, given({"title": "number or name of a zone", "type": ["integer", "string"]}))]
        | None
    ) = None
    a_gR: PositiveAcceleration | None = None
    ground: Literal["A", "B", "C", "D", "E"]
    spectrum: Annotated[Literal[1, 2], BeforeValidator(_spectrum_type)]
    parameters: SpectrumParameters = SpectrumParameters()
    national: NationalValues = NationalValues()
    behaviour_factor: BehaviourFactor | None = None
    k: PositiveFactor | None = None
    levels: dict[LevelName, Level] = {}

    @property
    def q(self) -> float | None:
        """The behaviour factor of the design spectrum."""
        return self.behaviour_factor

    @property
    def country_file(self) -> str | None:
        """The file with the parameters of the country; None where it is a name."""
        return self.country if self.country is not None and self.country.endswith((".yaml", ".yml")) else None

    def files(self) -> Iterator[tuple[Keys, str]]:
        """Yield key path and name of the file of the country."""
        if self.country_file is not None:
            yield ("country",), self.country_file


class NtcLevel(Model):
    """A limit state with the values of the site on rock, from the tables of the decree.

    Attributes:
        limit_state: limit state, which gives P_VR (Table 3.2.I) and with it the return period.
        a_g: largest acceleration on rock for this return period.
        F_0: largest amplification on rock.
        T_C_star: T_C* on rock.
    """

    limit_state: Literal["SLO", "SLD", "SLV", "SLC"]
    a_g: PositiveAcceleration
    F_0: Annotated[float, Field(ge=2.2)]
    T_C_star: PositiveTime


class NtcHazard(Hazard):
    """The action of NTC 2018 (Italy), whose limit states have return periods by nominal life and class of use.

    Attributes:
        code: NTC 2018.
        nominal_life: nominal life V_N (2.4.1), at least a year.
        class_of_use: class of use, which gives C_U (Table 2.4.II).
        ground: category of the subsoil (Table 3.2.II).
        topography: topographic category (Table 3.2.III); S_T is that of the top (Table 3.2.V).
        S_T: topographic factor itself, as between the foot and the top of a slope.
        behaviour_factor: behaviour factor q of the design spectrum; without the key there is no design spectrum.
        levels: limit states by name, each with the values of the site on rock.
    """

    code: Literal["ntc-2018"]
    nominal_life: Years
    class_of_use: Literal["I", "II", "III", "IV"]
    ground: Literal["A", "B", "C", "D", "E"]
    topography: Literal["T1", "T2", "T3", "T4"] = "T1"
    S_T: Annotated[float, Field(ge=1.0, le=1.4)] | None = None
    behaviour_factor: BehaviourFactor | None = None
    levels: Annotated[dict[LevelName, NtcLevel], Field(min_length=1)]

    @property
    def own_shapes(self) -> bool:
        """Whether limit states have spectra of their own shapes: they do, with a_g, F_0 and T_C* of each."""
        return True

    @property
    def q(self) -> float | None:
        """The behaviour factor of the design spectrum."""
        return self.behaviour_factor


class AsceLevel(Model):
    """An earthquake of ASCE/SEI 7: the design earthquake, or the risk-targeted maximum considered one.

    Attributes:
        earthquake: `DE` the design earthquake, `MCE_R` 1.5 times it.
    """

    earthquake: Literal["DE", "MCE_R"]


class AsceHazard(Hazard):
    """The action of ASCE/SEI 7, the two-period spectrum of 11.4.

    Attributes:
        code: edition of ASCE/SEI 7.
        S_DS: design spectral acceleration at short periods (11.4.5; 7-22: 11.4.4).
        S_D1: design spectral acceleration at 1 s.
        T_L: long-period transition period, at least S_D1/S_DS.
        R: response modification coefficient of the reduced spectrum; without the key there is none.
        I_e: importance factor of the reduced spectrum.
        levels: earthquakes by name.
    """

    code: Literal["asce7-16", "asce7-22"]
    S_DS: PositiveAcceleration
    S_D1: PositiveAcceleration
    T_L: PositiveTime
    R: BehaviourFactor | None = None
    I_e: BehaviourFactor = 1.0
    levels: dict[LevelName, AsceLevel] = {}


class UserLevel(Model):
    """A level by a factor on the spectrum of the action, or by a table of its own; how rare it is, if known.

    Attributes:
        factor: factor on the `spectrum` of the hazard; this key or `spectrum`.
        spectrum: a table of the level's own; this key or `factor`.
        probability: probability of exceedance in 50 years, for objectives and the report.
        return_period: mean return period, for objectives and the report.
    """

    factor: PositiveFactor | None = None
    spectrum: SpectrumTable | None = None
    probability: Probability | None = None
    return_period: Years | None = None


class UserHazard(Hazard):
    """Spectra as tables of your own.

    Attributes:
        code: tables of the user.
        damping: damping ratio that the tables hold for.
        damping_correction: code by which ordinates change with damping; without the key the tables hold for their
            damping alone.
        interpolation: how ordinates lie between the rows: as a power of the period, or on a straight line.
        criteria: code whose rules a set of motions is checked against.
        spectrum: table of all levels that have a `factor`.
        levels: levels by name, each with a factor on the spectrum or a table of its own.
    """

    code: Literal["user"]
    damping: PositiveRatio
    damping_correction: Literal["ec8", "asce7"] | None = None
    interpolation: Literal["log-log", "linear"] = "log-log"
    criteria: Literal["ec8-2004", "ntc-2018", "asce7-16", "asce7-22"] = "ec8-2004"
    spectrum: SpectrumTable | None = None
    levels: dict[LevelName, UserLevel] = {}

    @property
    def at_5_percent(self) -> bool:
        """Whether the spectra are known for 5 % damping, at which codes compare sets of motions."""
        return self.damping_correction is not None or math.isclose(self.damping, 0.05, rel_tol=1e-9)

    @property
    def own_shapes(self) -> bool:
        """Whether the levels have tables of their own."""
        return self.spectrum is None

    def table(self, level: str | None) -> SpectrumTable | None:
        """Return the table of a level, the one of the action where levels are factors on it; None: it is missing."""
        return self.levels[level].spectrum if self.spectrum is None and level is not None else self.spectrum

    def tables(self) -> Iterator[tuple[Keys, SpectrumTable]]:
        """Yield key path below `hazard` and table of each spectrum."""
        if self.spectrum is not None:
            yield ("spectrum",), self.spectrum
        for name, level in self.levels.items():
            if level.spectrum is not None:
                yield ("levels", name, "spectrum"), level.spectrum

    def files(self) -> Iterator[tuple[Keys, str]]:
        """Yield key path and name of each file of a table."""
        for keys, table in self.tables():
            if isinstance(table, SpectrumFile):
                yield (*keys, "file"), table.file


AnyHazard = Annotated[EC8Hazard | NtcHazard | AsceHazard | UserHazard, OneOf("code")]
OTHER_CODES = ("ntc-2018", "asce7-16", "asce7-22", "user")
"""Codes of the seismic action that the checks of a steel building by EN 1998-1 do not know."""
