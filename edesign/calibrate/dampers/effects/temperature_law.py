"""Temperature of the tests: the elastomer is softer and relaxes faster when warm."""

from __future__ import annotations

import math
from typing import Any, ClassVar

import numpy as np

from edesign.calibrate.dampers.effect import Form, Memory
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial, Values
from edesign.calibrate.problem import Kind, PredictionError
from edesign.calibrate.unknown import Unknown
from edesign.damper.fitting.scales import Scales
from edesign.damper.law import Parameter
from edesign.damper.laws import LAWS
from edesign.damper.temperature import CHANGING, REFERENCE_C, at_one_rate, passed

_LEAST_SPAN = 2.0  # K: tests at one temperature tell nothing of it, and readings of one, 0.2 K off, span up to 1 K
_SHARPEST = 1.0  # K, of a transition: no rubber has a sharper one, and readings may be off by 0.2 K
_WIDTH = 0.25  # of the temperatures' span: of a transition whose width they do not show
_TELL_WIDTH = 4  # temperatures at least: depth, middle and width beside a reference
_SLOWING = -0.015, 0.024  # 1/K: from -20 to 80 degC no fall is endless
_STEEPEST = 0.8  # 1/K: ln 10 C1/C2 with 17.44 and 51.6 K, at the glass transition (Williams, Landel & Ferry)
_LEAST_GAMMA = 0.05  # of a straight line, which ends at none
_NEAREST = 0.05  # of 1 + c w: T0 - C2, where the fall ends, comes no nearer
_BY_ARRHENIUS = {"c": 1.0 / (REFERENCE_C + 273.15)}  # E/R (1/T - 1/T0) = -b w/(1 + w/T0)
_ARRHENIUS = "Ward & Sweeney (2013), Mechanical Properties of Solid Polymers, chapter 7: activated processes"


class _Temperature(Form):
    name: ClassVar[str] = "temperature_law"
    kind: ClassVar[Kind] = "damper"
    of_temperature: ClassVar[bool] = True

    def fixed(self, sizes: Sizes) -> dict[str, float]:
        return {"T0": REFERENCE_C}

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (Unknown("b", "1/K", -_STEEPEST, _STEEPEST, 0.05),) if _shown(sizes) else ()

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.01,),) if _shown(sizes) else ()


class Exponential(_Temperature):
    """The whole force falls with temperature: F = exp(-b (T - T0)) F_law."""

    may_spare_loss: ClassVar[bool] = True
    form: ClassVar[str] = "exponential"
    title: ClassVar[str] = "softening with temperature"
    signature: ClassVar[str] = (
        "a factor of the force that goes with the temperature of the tests, stiffness and damping alike"
    )
    source: ClassVar[str] = (
        "Chang, Soong, Oh & Lai (1992), Struct. Des. Tall Build. 1; Kasai, Munshi, Lai & Maison (1993), ATC-17-1; "
        "thesis Eq. 4.34"
    )
    amendment: ClassVar[bool] = True

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        return np.asarray(np.exp(-_fall(p, trial.temperature)))


class Wlf(Exponential):
    """The fall slows down with warmth: F = exp(-b w/(1 + c w)) F_law, w = T - T0; c = 1/C2."""

    form: ClassVar[str] = "wlf"
    title: ClassVar[str] = "softening with temperature by WLF"
    source: ClassVar[str] = "Williams, Landel & Ferry (1955), J. Am. Chem. Soc. 77, 3701-3707"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        own = super().unknowns(sizes)
        return (*own, Unknown("c", "1/K", *_SLOWING, 5e-3)) if own else ()

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((b, c) for (b,) in super().starts(sizes) for c in (0.0, 0.01))


class Arrhenius(Exponential):
    """The same by an activation energy E: b = E/(R T0^2) and c = 1/T0 with T0 in kelvin, one number."""

    form: ClassVar[str] = "arrhenius"
    amendment_form: ClassVar[str] = "wlf"
    title: ClassVar[str] = "softening with temperature by Arrhenius"
    source: ClassVar[str] = _ARRHENIUS

    def fixed(self, sizes: Sizes) -> dict[str, float]:
        return {**super().fixed(sizes), **_BY_ARRHENIUS}


class Shift(_Temperature):
    """All relaxation speeds up with temperature: the law's times are multiplied by a_T = exp(-b (T - T0))."""

    form: ClassVar[str] = "shift"
    title: ClassVar[str] = "relaxation that speeds up with temperature"
    signature: ClassVar[str] = (
        "warm tests look like slower ones: damping falls with temperature, the static stiffness does not"
    )
    source: ClassVar[str] = (
        "Ferry (1980), Viscoelastic Properties of Polymers, chapter 11, near one temperature; thesis Eq. 4.33"
    )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.05,),) if _shown(sizes) else ()

    def law(self, p: Values, trial: Trial, values: dict[str, float]) -> dict[str, float]:
        # a second becomes a_T seconds: units tell which power of a_T a parameter takes
        slower = Scales(1.0, 1.0, math.exp(float(_fall(p, np.mean(trial.temperature)))))
        return {q.name: values[q.name] * slower.of(q.unit, values) for q in _parameters(values)}


class ShiftWlf(Shift):
    """The same over a wide range: a_T = exp(-b w/(1 + c w)), w = T - T0."""

    form: ClassVar[str] = "shift_wlf"
    title: ClassVar[str] = "relaxation that speeds up with temperature by WLF"
    source: ClassVar[str] = Wlf.source

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return Wlf().unknowns(sizes)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((b, c) for (b,) in super().starts(sizes) for c in (0.0, 0.01))


class ShiftArrhenius(Shift):
    """As `shift`, with an activation energy: a_T = exp(E/R (1/T - 1/T0)), absolute temperatures."""

    form: ClassVar[str] = "shift_arrhenius"
    title: ClassVar[str] = "relaxation that speeds up with temperature by Arrhenius"
    source: ClassVar[str] = _ARRHENIUS

    def fixed(self, sizes: Sizes) -> dict[str, float]:
        return {**super().fixed(sizes), **_BY_ARRHENIUS}


class ShiftOfForces(ShiftWlf):
    """As `shift_wlf`, but velocities in the law, as that at which its damping softens, stay as they are: dashpots are
    multiplied by their powers of a_T, nothing else.
    """

    form: ClassVar[str] = "shift_of_forces"
    title: ClassVar[str] = "dashpots that weaken with temperature, each by its power of the velocity"

    def law(self, p: Values, trial: Trial, values: dict[str, float]) -> dict[str, float]:
        velocities = {q.name: values[q.name] for q in _parameters(values) if q.unit == "m/s"}
        return {**super().law(p, trial, values), **velocities}


class Gamma(_Temperature):
    """The MGMM's own factor falls at another rate: all of its parameters, alpha and u_ref too, are multiplied by
    exp(-b (T - T0)) beside gamma_T. It does nothing to other laws.
    """

    form: ClassVar[str] = "gamma"
    title: ClassVar[str] = "another gamma_T of all of the law's parameters"
    signature: ClassVar[str] = (
        "a factor of the force that goes with the temperature of the tests, which soften the more with amplitude the "
        "warmer they are"
    )
    source: ClassVar[str] = "thesis section 4.5: all parameters change with temperature at the same rate"

    def law(self, p: Values, trial: Trial, values: dict[str, float]) -> dict[str, float]:
        return _at_rate(values, float(_fall(p, np.mean(trial.temperature))))


class GammaWlf(Gamma):
    """The same at a rate that changes: exp(-b w/(1 + c w)) beside gamma_T, w = T - T0."""

    form: ClassVar[str] = "gamma_wlf"
    title: ClassVar[str] = "another gamma_T of all of the law's parameters, at a changing rate"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return Wlf().unknowns(sizes)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return Wlf().starts(sizes)


class GammaLine(Gamma):
    """A gamma_T that falls in a straight line, 1 - b (T - T0), in the place of the MGMM's own."""

    in_place_of_gamma: bool = True
    of_mgmm: bool = True
    form: ClassVar[str] = "gamma_line"
    title: ClassVar[str] = "a gamma_T of all of the law's parameters that falls in a straight line"
    source: ClassVar[str] = "thesis section 4.5: gamma_T falls by as much for each degree"

    def law(self, p: Values, trial: Trial, values: dict[str, float]) -> dict[str, float]:
        gamma = 1.0 - p["b"] * (float(np.mean(trial.temperature)) - p["T0"])
        return _at_rate(values, -math.log(max(gamma, _LEAST_GAMMA)))


class Transition(_Temperature):
    """The fall over a transition: F = (1 - d (S(T) - S(T0))) F_law, S(T) = 1/(1 + exp(-(T - Tc)/w)); w is given where
    fewer than four temperatures are fitted to.
    """

    may_spare_loss: ClassVar[bool] = True
    amendment: ClassVar[bool] = True
    form: ClassVar[str] = "transition"
    title: ClassVar[str] = "softening with temperature across a transition"
    signature: ClassVar[str] = Exponential.signature
    source: ClassVar[str] = (
        "Mahieux & Reifsnider (2001), Polymer 42, 3281-3291 (modulus over transitions), with a logistic step"
    )

    def fixed(self, sizes: Sizes) -> dict[str, float]:
        own = super().fixed(sizes)
        if _tells_width(sizes):
            return own
        low, high = sizes.temperatures
        return {**own, "w": max(_WIDTH * (high - low), _SHARPEST)}

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        low, high = sizes.temperatures
        if not _shown(sizes):
            return ()
        span = high - low
        step = (Unknown("d", "", -5.0, 5.0, 0.3), Unknown("Tc", "degC", low - 2.0 * span, high + 2.0 * span, span))
        width = Unknown("w", "K", _SHARPEST, 3.0 * span, 0.2 * span, logarithmic=True)
        return (*step, width) if _tells_width(sizes) else step

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        low, high = sizes.temperatures
        span = high - low
        middles = [low + at * span for at in (0.1, 0.35, 0.6, 0.85)]
        if not _shown(sizes):
            return ()
        if not _tells_width(sizes):
            return tuple((0.1, middle) for middle in middles)
        return tuple((0.1, middle, max(w * span, _SHARPEST)) for middle in middles for w in (0.1, 0.25))

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        return np.asarray(1.0 - p["d"] * passed(trial.temperature, p["Tc"], p["w"], p["T0"]))


def _in_place(form: _Temperature) -> Form:
    """The same in the place of the MGMM's own gamma_T, which is that of another elastomer."""
    changes = {"in_place_of_gamma": True, "of_mgmm": True, "may_be_shaped": False}
    return form.variant("in_place", "in the place of the law's own", **changes)


def forms_of(sizes: Sizes) -> tuple[Form, ...]:
    """Forms in the place of gamma_T."""
    return tuple(
        _in_place(form())
        for form in (Exponential, Arrhenius, Wlf, Transition, Shift, ShiftArrhenius, ShiftWlf, ShiftOfForces)
    )


def _fall(p: Values, temperature: np.ndarray | np.floating[Any]) -> np.ndarray:
    """b w/(1 + c w) of temperatures, degC; c = 0 where a form has none."""
    warmer = temperature - p["T0"]
    return np.asarray(p["b"] * warmer / np.maximum(1.0 + p.get("c", 0.0) * warmer, _NEAREST))


def _at_rate(values: dict[str, float], fall: float) -> dict[str, float]:
    return at_one_rate(values, math.exp(-fall)) if values.keys() >= {*CHANGING} else values


def _shown(sizes: Sizes) -> bool:
    low, high = sizes.temperatures
    return high - low >= _LEAST_SPAN


def _tells_width(sizes: Sizes) -> bool:
    return sizes.levels >= _TELL_WIDTH


def _parameters(values: Values) -> tuple[Parameter, ...]:
    """Parameters with units of the law that has these names; where two laws have them, units are the same."""
    every = (law.all_parameters(values) for law in LAWS.values())
    found = next((own for own in every if {parameter.name for parameter in own} == set(values)), None)
    if found is None:
        raise PredictionError(f"no law has the parameters {', '.join(values)}")
    return found


FORMS = (
    Exponential,
    Arrhenius,
    Wlf,
    Transition,
    Shift,
    ShiftArrhenius,
    ShiftWlf,
    ShiftOfForces,
    Gamma,
    GammaWlf,
    GammaLine,
)
