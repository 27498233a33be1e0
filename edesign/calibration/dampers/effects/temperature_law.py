"""Temperature of the tests: the elastomer is softer and relaxes faster when warm."""

from __future__ import annotations

import math
from dataclasses import replace

from edesign.calibration.dampers.effect import EffectForm, placed, renamed
from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.mechanisms import CoreEffect, LawParameters, Placement
from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.form import Rows, Values, Words, shape, size
from edesign.damper.fitting.scales import Scales
from edesign.damper.law import Law
from edesign.damper.temperature import REFERENCE_C, at_one_rate, passed
from edesign.estimation.parameters import Parameter

_LEAST_SPAN = 2.0  # K: tests at one temperature say nothing of it, and readings of one, 0.2 K off, span up to 1 K
_SHARPEST = 1.0  # K, of a transition: no rubber has a sharper one, and readings may be off by 0.2 K
_WIDTH = 0.25  # of the temperatures' span: of a transition whose width they do not show
_TELL_WIDTH = 4  # temperatures at least: depth, middle and width beside a reference
_SLOWING = -0.015, 0.024  # 1/K: from -20 to 80 degC no fall is endless
_STEEPEST = 0.8  # 1/K: ln 10 C1/C2 with 17.44 and 51.6 K, at the glass transition (Williams, Landel & Ferry)
_USUAL = 0.1  # 1/K, at most: standard deviation of a fall
_NEAREST = 0.05  # of 1 + c w: T0 - C2, where the fall ends, comes no nearer
_FACTOR = "a factor of the force that depends on the temperature of the tests, stiffness and damping alike"
_FASTER = "warm tests look like slower ones: damping falls with temperature, the static stiffness does not"
_SLOWER = "warm tests look like faster ones: damping grows with temperature, the static stiffness does not"
_SOFTER = "a factor of the force that depends on temperature; warmer tests soften the more with amplitude"
_WLF = "Williams, Landel & Ferry (1955), J. Am. Chem. Soc. 77, 3701-3707"
_CHANG = (
    "Chang, Soong, Oh & Lai (1992), Struct. Des. Tall Build. 1; Kasai, Munshi, Lai & Maison (1993), ATC-17-1; thesis "
    "Eq. 4.34"
)


def _shown(s: Sizes) -> bool:
    return s.temperatures[1] - s.temperatures[0] >= _LEAST_SPAN


def _fall(s: Sizes) -> tuple[Parameter, ...]:
    reach = max(*(abs(one - REFERENCE_C) for one in s.temperatures), 1.0)
    return (size("b", "1/K", min(0.36 / reach, _USUAL), -_STEEPEST, _STEEPEST),)  # exp(-0.36) = 0.7


def _slowing(s: Sizes) -> tuple[Parameter, ...]:
    return *_fall(s), size("c", "1/K", 5e-3, *_SLOWING)


def _slowing_starts(b: float) -> Rows:
    return (b, 0.0), (b, 0.01)


def lost(p: Values, temperature_C: float) -> float:
    """Return b w/(1 + c w), w = T - T0 with T0 = `REFERENCE_C`; c = 0 where a form has none.

    Args:
        p: parameters of the form, 1/K.
        temperature_C: T, degC.
    """
    warmer = temperature_C - REFERENCE_C
    return p["b"] * warmer / max(1.0 + p.get("c", 0.0) * warmer, _NEAREST)


def _shifted(p: Values, test: Experiment, law: Law, values: dict[str, float]) -> dict[str, float]:
    # a second becomes a_T seconds: units show which power of a_T a parameter takes
    slower = Scales(1.0, 1.0, math.exp(lost(p, test.temperature)))
    return {one.name: values[one.name] * slower.of(one.unit, values) for one in law.all_parameters(values)}


def _at_rate(p: Values, test: Experiment, law: Law, values: dict[str, float]) -> dict[str, float]:
    return at_one_rate(values, math.exp(-lost(p, test.temperature)))


def _unchanged(p: Values, test: Experiment, law: Law, values: dict[str, float]) -> dict[str, float]:
    return values


_BY_FACTOR = CoreEffect("constant", factor=lambda p, test: math.exp(-lost(p, test.temperature)))

_EXPONENTIAL = EffectForm(
    "temperature_law",
    "exponential",
    "damper",
    "softening with temperature",
    _FACTOR,
    _CHANG,
    (_BY_FACTOR,),
    _fall,
    lambda s: ((0.01,),),
    shown=_shown,
    meanings={
        "b": "rate at 20 degC: 0.01 to 0.05 per K of dampers near room temperature; negative: it stiffens with warmth",
        "c": "how the rate falls with warmth: 1/C2 of WLF, 1/T0 in kelvin of Arrhenius",
    },
    negative=Words("stiffening with temperature", _FACTOR),
)
_WLF_FACTOR = replace(
    _EXPONENTIAL,
    form="wlf",
    title="softening with temperature by WLF",
    source=_WLF,
    parameters=_slowing,
    starts=lambda s: _slowing_starts(0.01),
    negative=Words("stiffening with temperature by WLF", _FACTOR),
)
_SHIFT = replace(
    _EXPONENTIAL,
    form="shift",
    title="relaxation that speeds up with temperature",
    signature=_FASTER,
    source="Ferry (1980), Viscoelastic Properties of Polymers, chapter 11, near one temperature; thesis Eq. 4.33",
    mechanisms=(LawParameters(_shifted),),
    starts=lambda s: ((0.05,),),
    negative=Words("relaxation that slows down with temperature", _SLOWER),
)
_SHIFT_WLF = replace(
    _SHIFT,
    form="shift_wlf",
    title="relaxation that speeds up with temperature by WLF",
    source=_WLF,
    parameters=_slowing,
    starts=lambda s: _slowing_starts(0.05),
    negative=Words("relaxation that slows down with temperature by WLF", _SLOWER),
)
_GAMMA = replace(
    _EXPONENTIAL,
    form="gamma",
    title="another gamma_T of all of the law's parameters",
    signature=_SOFTER,
    source="thesis section 4.5: all parameters change with temperature at the same rate",
    mechanisms=(LawParameters(_at_rate),),
    laws=("mgmm",),
    negative=None,
)
_GAMMA_WLF = replace(
    _GAMMA,
    form="gamma_wlf",
    title="another gamma_T of all of the law's parameters, at a changing rate",
    parameters=_slowing,
    starts=lambda s: _slowing_starts(0.01),
)


def _width(s: Sizes) -> dict[str, float]:
    span = s.temperatures[1] - s.temperatures[0]
    return {} if s.levels >= _TELL_WIDTH else {"w": max(_WIDTH * span, _SHARPEST)}


def _transition(s: Sizes) -> tuple[Parameter, ...]:
    low, high = s.temperatures
    span = high - low
    middle = Parameter("Tc", "degC", low - 2.0 * span, high + 2.0 * span, 0.5 * (low + high), span)
    width = shape("w", "K", max(0.2 * span, _SHARPEST), 0.9 * _SHARPEST, 3.0 * span, spread=0.7)
    return size("d", "", 0.5, -5.0, 5.0), middle, *(() if _width(s) else (width,))


def _transition_starts(s: Sizes) -> Rows:
    low, high = s.temperatures
    widths = () if _width(s) else (max(0.2 * (high - low), _SHARPEST),)
    return tuple((0.1, low + at * (high - low), *widths) for at in (0.1, 0.35, 0.6, 0.85))


_TRANSITION = replace(
    _EXPONENTIAL,
    form="transition",
    title="softening with temperature across a transition",
    source="Mahieux & Reifsnider (2001), Polymer 42, 3281-3291 (modulus over transitions), with a logistic step",
    mechanisms=(
        CoreEffect(
            "constant",
            factor=lambda p, test: 1.0 - p["d"] * float(passed(test.temperature, p["Tc"], p["w"], REFERENCE_C)),
        ),
    ),
    parameters=_transition,
    starts=_transition_starts,
    constants=_width,
    negative=Words("stiffening with temperature across a transition", _FACTOR),
)


def _in_place(form: EffectForm) -> EffectForm:
    """Return the form in the place of the MGMM's own gamma_T, which is that of another elastomer."""
    mechanisms = tuple(
        replace(mechanism, in_place_of_gamma=True) if isinstance(mechanism, LawParameters) else mechanism
        for mechanism in form.mechanisms
    )
    if not any(isinstance(mechanism, LawParameters) for mechanism in mechanisms):
        mechanisms = (*mechanisms, LawParameters(_unchanged, in_place_of_gamma=True))
    return replace(
        renamed(form, f"{form.form}_in_place", "{}, in the place of the law's own"),
        mechanisms=mechanisms,
        laws=("mgmm",),
        proportional=False,
    )


FORMS = (
    *placed(_EXPONENTIAL, Placement.WHOLE, Placement.SPRINGS, Placement.DASHPOTS),
    _WLF_FACTOR,
    _TRANSITION,
    _SHIFT,
    _SHIFT_WLF,
    _GAMMA,
    _GAMMA_WLF,
    *map(_in_place, (_EXPONENTIAL, _WLF_FACTOR, _SHIFT)),
)
