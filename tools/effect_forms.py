"""Forms of effects of a calibration as rows of tables: where they act, parameters, priors in sizes of a campaign."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from edesign.calibration.dampers.effect import EffectForm
from edesign.calibration.dampers.effects import forms as damper_forms
from edesign.calibration.dampers.mechanisms import (
    CoreEffect,
    ForceChannel,
    LastingExtremes,
    LawParameters,
    MotionChannel,
    NuisanceAmplitudes,
    Placement,
    Rig,
    Thermometer,
)
from edesign.calibration.dampers.sizes import Condition, Sizes
from edesign.calibration.properties import arrangement, reading
from edesign.calibration.properties.reading import ReadingForm
from edesign.calibration.structures.building import Building, Damping, DampingKind
from edesign.calibration.structures.effect import ChangedBuilding, Links, StructureForm
from edesign.calibration.structures.effects import forms as structure_forms
from edesign.calibration.structures.record import Measure
from edesign.calibration.structures.sizes import StructureSizes
from edesign.damper.effect_forms import form_if_known
from edesign.estimation.parameters import Parameter

_USUAL = Sizes(
    force=80e3,
    displacement=0.012,
    velocity=0.09,
    acceleration=0.7,
    rms=30e3,
    duration=20.0,
    total=160.0,
    path=9.0,
    work=30e3,
    tests=8,
    period=1.3,
    fitted=(True,) * 6 + (False,) * 2,
    temperatures=(10.0, 30.0),
    levels=4,
    tones=(50.0, 120.0),
    conditions=(Condition.of("Q", (1.0, 2.0, 3.0), (1.0, 2.0, 3.0)),),
)
"""Of a campaign that shows all effects."""

_SYMBOLS = {
    **{"F": "force", "u": "displacement", "v": "velocity", "a": "acceleration", "D": "duration", "S": "path"},
    **{"W": "work", "T": "period", "N": "tests"},
}
_STRUCTURE_SYMBOLS = ("K", "d", "T", "dt", "H")
_SIDES = ("_positive", "_negative")
_NEAR = 1e-9  # relative: of a number that is a product of powers
_STEP = 1e-3


def _structure(isolated: bool, kind: DampingKind) -> StructureSizes:
    stiffness, heights = np.full(3, 3e8), np.array([3.0, 6.0, 9.0])
    building = Building(np.full(3, 4e5), stiffness, Damping(kind, 0.03), np.zeros(3), isolated, heights)
    measures: frozenset[Measure] = frozenset(("acceleration", "displacement"))
    return StructureSizes(building, np.full(3, 0.02), 0.7, 0.005, measures, refit=False)


@dataclass(frozen=True)
class Row:
    """A form of an effect, with all its placements and sides.

    Attributes:
        form: of the code; the first of those that differ in placement, side, or number alone.
        name: of the form.
        where: placements, or what it acts on.
        parameters: of the form, with the text of their priors.
        fixed: numbers that the campaign fixes, by name.
    """

    form: EffectForm | StructureForm | ReadingForm
    name: str
    where: tuple[str, ...]
    parameters: tuple[tuple[Parameter, str, str], ...]
    fixed: Mapping[str, str]

    @property
    def title(self) -> str:
        """What it is, of whatever side or number; with a size below zero too, where that is another thing."""
        both = (self.form.title, *(f"negative: {words.title}" for words in (self.form.negative,) if words))
        return re.sub(r"(storey|floor|test) \d+$", r"\1 N", "; ".join(both).replace("the positive side", "one side"))

    @property
    def laws(self) -> tuple[str, ...]:
        """Names of the laws that it is made for; (): all."""
        return getattr(self.form, "laws", ())

    @property
    def law_file(self) -> str:
        """What a law file calls it; "" if none carries it."""
        form = self.form.twin or self.form if isinstance(self.form, EffectForm) else None
        if form is None or form.kind != "damper":
            return ""
        kinds = [one.equation.split(".") for one in form.core_effects if form.name != "condition" or one.own]
        if any(isinstance(mechanism, LawParameters) for mechanism in self.form.mechanisms):
            return "key `temperature_law`" if self.form.name == "temperature_law" else ""
        if not kinds or any(kind != kinds[0] for kind in kinds):
            return ""
        name, form = (self.form.name, self.name) if kinds[0] == ["constant"] else kinds[0]
        return f"{name}.{form}" if form_if_known(name, form) else ""


def damper_rows() -> list[Row]:
    """Forms of effects of damper tests, in the order of the code."""
    found = [_row(form, _USUAL, _of_dampers, _SYMBOLS) for form in damper_forms(_USUAL)]
    return _merged(found)


def structure_rows() -> list[Row]:
    """Forms of effects of structures, in the order of the code."""
    rows: dict[str, Row] = {}
    for isolated, kind in ((False, "rayleigh"), (False, "modal"), (True, "modal")):
        sizes = _structure(isolated, kind)
        for form in structure_forms(sizes):
            rows.setdefault(f"{form.name}.{form.form}", _row(form, sizes, _of_structures, _STRUCTURE_SYMBOLS))
    names = list(dict.fromkeys(row.form.name for row in rows.values()))
    return _merged(sorted(rows.values(), key=lambda row: names.index(row.form.name)))


def table_rows() -> list[Row]:
    """Forms of effects that tables of moduli alone show."""
    every: tuple[EffectForm | ReadingForm, ...] = (*arrangement.FORMS, *reading.FORMS)
    return [_row(form, _USUAL, _of_dampers, _SYMBOLS) for form in every]


def _row(
    form: Any, sizes: Any, of: Callable[[Any, str, float], Any], symbols: Sequence[str] | Mapping[str, str]
) -> Row:
    def text(number: Callable[[Any], float], unit: str) -> str:
        return _scaled(number, sizes, of, symbols, unit)

    parameters = []
    for i, one in enumerate(form.parameters(sizes)):
        centre, spread, lower, upper = (
            text(lambda s, i=i, name=name: getattr(form.parameters(s)[i], name), one.unit)  # type: ignore[misc]
            for name in ("centre", "spread", "lower", "upper")
        )
        if one.logarithmic:
            spread = f"{one.spread:.3g}"
        prior = f"{'ln ' if one.logarithmic else ''}N({centre}, {spread})"
        parameters.append((one, prior, f"{lower} to {upper}"))
    constants = form.constants
    named = {name for name in constants(sizes) if not re.fullmatch(r"f\d_\d|size|side|q_mean|q_range", name)}
    fixed = {name: text(lambda s, name=name: constants(s)[name], "") for name in sorted(named)}  # type: ignore[misc]
    base, where = _placed(form)
    return Row(form, base, where, tuple(parameters), fixed)


def _of_dampers(sizes: Sizes, symbol: str, times: float) -> Sizes:
    name = _SYMBOLS[symbol]
    return replace(sizes, **{name: getattr(sizes, name) * times})


def _of_structures(s: StructureSizes, symbol: str, times: float) -> StructureSizes:
    if symbol == "K":
        return replace(s, building=replace(s.building, stiffness=s.building.stiffness * times))
    if symbol == "H":
        return replace(s, building=replace(s.building, heights=s.building.heights * times))  # type: ignore[operator]
    name = {"d": "drift", "T": "period", "dt": "step"}[symbol]
    return replace(s, **{name: getattr(s, name) * times})


def _scaled(
    number: Callable[[Any], float], sizes: Any, of: Callable[[Any, str, float], Any], symbols: Any, unit: str
) -> str:
    """Return a number as a multiple of what it scales with, as 0.5 F/u; as it is where it scales with nothing alone."""
    value = number(sizes)
    if not value or not math.isfinite(value):
        return _digits(value)
    powers = {}
    for symbol in symbols:
        ratio = number(of(sizes, symbol, 1.0 + _STEP)) / value
        power = round(math.log(ratio) / math.log1p(_STEP)) if ratio > 0.0 else 0
        if abs(ratio - (1.0 + _STEP) ** power) > _NEAR:
            return f"{_digits(value)} {unit}".strip()
        if power:
            powers[symbol] = power
    factor = value
    for symbol, power in powers.items():
        factor /= (_size(sizes, symbol)) ** power
    over = [_power(s, p) for s, p in powers.items() if p > 0]
    under = [_power(s, -p) for s, p in powers.items() if p < 0]
    plain = over and abs(abs(factor) - 1.0) < _NEAR
    text = ("-" if factor < 0.0 else "") if plain else f"{_digits(factor)}{' ' if over else ''}"
    text += " ".join(over)
    if under:
        text += f"/{under[0]}" if len(under) == 1 else f"/({' '.join(under)})"
    return text if powers else f"{text} {unit}".strip()


def _digits(value: float) -> str:
    return f"{value:,.0f}".replace(",", " ") if 1e3 <= abs(value) < 1e6 else f"{value:.3g}"


def _size(sizes: Any, symbol: str) -> float:
    if isinstance(sizes, Sizes):
        return float(getattr(sizes, _SYMBOLS[symbol]))
    own = {"K": sizes.building.stiffness[0], "H": sizes.building.heights[-1], "d": sizes.drift[0]}
    return float({**own, "T": sizes.period, "dt": sizes.step}[symbol])


def _power(symbol: str, power: int) -> str:
    return symbol if power == 1 else f"{symbol}^{power}"


def _placed(form: EffectForm | StructureForm | ReadingForm) -> tuple[str, tuple[str, ...]]:
    """Return the name of a form without its placement, side and number, and where it acts."""
    base = re.sub(r"(from|of)_test_\d+(_to_\d+)?$", r"\1_test_k", re.sub(r"(storey|floor)_\d+$", r"\1_N", form.form))
    if isinstance(form, ReadingForm):
        return base, ("what was read",)
    if isinstance(form, StructureForm):
        kinds = {ChangedBuilding: "building", Links: "beside storeys"}
        return base, (kinds.get(type(form.mechanisms[0]), "channels"),)
    in_place = base.endswith("_in_place")
    base = base.removesuffix("_in_place")
    placements = {mechanism.placement for mechanism in form.core_effects}
    for one in Placement:
        if one in placements and base.endswith(f"_{one.value}"):
            base = base.removesuffix(f"_{one.value}")
    for side in _SIDES:
        base = base.removesuffix(side)
    where = dict.fromkeys(place for mechanism in form.mechanisms if (place := _where(mechanism)))
    return base, ("in place of gamma_T",) if in_place else tuple(where)


def _where(mechanism: object) -> str:
    if isinstance(mechanism, CoreEffect):
        return mechanism.placement.value
    if isinstance(mechanism, MotionChannel):
        return "displacement channel" if mechanism.of == "actuator" else "motion of the specimen"
    if isinstance(mechanism, ForceChannel):
        return "force channel" if mechanism.of == "channel" else "what moves with the actuator"
    others: dict[type, str] = {Rig: "in series", LawParameters: "parameters of the law", Thermometer: "temperature"}
    others[NuisanceAmplitudes] = "nuisance amplitudes"
    return "from test to test" if isinstance(mechanism, LastingExtremes) else others.get(type(mechanism), "")


def _merged(rows: Sequence[Row]) -> list[Row]:
    found: dict[tuple[str, str], Row] = {}
    for row in rows:
        key = row.form.name, row.name
        known = found.get(key)
        found[key] = row if known is None else replace(known, where=tuple(dict.fromkeys((*known.where, *row.where))))
    return list(found.values())
