"""Effects of damper laws by their definitions (docs/reference/laws/effects.md), on samples; examples of each."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from math import exp, log
from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicHermiteSpline
from scipy.special import erf

from edesign.core.damper import Placement
from edesign.damper.effects import LAW_EFFECTS, LawEffect

EXAMPLES: dict[tuple[str, str], dict[str, float]] = {
    ("payne", "whole"): {"d": 0.3, "a0": 3e-3, "m": 1.2, "tau_a": 3.0},
    ("payne", "elastic"): {"k": 2e6, "a0": 3e-3, "m": 0.8, "tau_a": 1.0},
    ("mullins", "path"): {"m": 0.4, "s0": 0.03, "q": 1.2},
    ("mullins", "maximum"): {"m": 0.3, "r": 3e-3, "beta": 0.4, "recovery": 0.5},
    ("mullins", "elastic"): {"k": 1.5e6, "s0": 0.04, "q": 1.4},
    ("degradation", "energy"): {"d": 0.25, "E0": 300.0},
    ("self_heating", "rate"): {"beta": 3e-4, "tau_h": 20.0},
    ("temperature_law", "exponential"): {"b": 0.02, "T0": 20.0},
    ("temperature_law", "wlf"): {"b": 0.03, "c": 0.01, "T0": 20.0},
    ("temperature_law", "transition"): {"d": 0.3, "Tc": 28.0, "w": 4.0, "T0": 20.0},
    ("ageing", "linear"): {"rate": -0.01, "n": 7.0},
    ("hardening", "power"): {"k": 1.2e6, "p": 3.5, "r": 6e-3},
    ("hardening", "threshold"): {"k": 3e6, "u0": 3.3e-3},
    ("one_sided", "factor"): {"b": 0.15, "side": -1.0},
    ("one_sided", "force"): {"b": 0.2, "side": 1.0},
    ("one_sided", "valve"): {"b": 0.2, "v0": 3e-3, "side": -1.0},
    ("one_sided", "spring"): {"k": 2e6, "u0": 1.7e-3, "side": -1.0},
    ("one_sided", "contact"): {"k": 4e6, "u0": 1.2e-3, "n": 1.6, "side": 1.0, "r": 3e-3},
    ("one_sided", "even"): {"k": 8e5, "n": 2.1, "r": 5e-3},
    ("relaxation_branch", "maxwell"): {"k": 2e6, "tau": 0.2},
    ("velocity_exponent", "dashpot"): {"c": 8e3, "alpha": 0.4},
    ("payne", "network"): {"d": 0.3, "s0": 0.01, "tau": 2.0},
    ("mullins", "damage"): {"m": 0.25, "r": 4e-3, "p": 1.4, "recovery": 0.2},
    ("velocity_exponent", "flow"): {"f": 1.5e3, "v0": 4e-3},
    ("degradation", "path"): {"d": 0.2, "s0": 0.1, "q": 1.1},
    ("ageing", "logarithmic"): {"rate": -0.03, "n": 7.0, "n0": 0.4},
    ("payne", "exponential"): {"d": 0.25, "a0": 4e-3, "m": 1.3, "tau_a": 2.0},
    ("hardening", "exponential"): {"k": 1e6, "u0": 7e-3},
    ("gas_spring", "polytropic"): {"P": 4e3, "c": -40.0, "n": 1.2},
    ("hardening", "saturating"): {"k": 3e6, "u0": 2e-3},
    ("velocity_exponent", "position"): {"c": 1.1e4, "alpha": 0.6, "q": 1.3, "r": 5e-3},
    ("hysteresis", "stretch"): {"F_y": 3e3, "Y": 8e-4, "n": 1.2, "r": 5e-3},
    ("hysteresis", "bouc_wen"): {"k": 2e6, "beta": -220.0, "gamma": 160.0},
    ("pinching", "slip"): {"d": 0.4, "w": 0.3},
    ("limit", "force"): {"s": 0.7, "F_l": 1e4},
    ("friction", "coulomb"): {"F_c": 1.2e3, "v0": 2e-3},
    ("friction", "presliding"): {"F_c": 1.5e3, "x0": 8e-4},
    ("friction", "stribeck"): {"F_c": 1e3, "s": 0.7, "v_s": 2e-2},
    ("friction", "loaded"): {"mu": 0.1, "F_c": 8e2, "v0": 2e-3},
}
PLACED: list[tuple[str, str, Placement]] = [
    (*of, place) for of, kind in LAW_EFFECTS.items() for place in kind.placements
]
"""All equations at all their placements."""


def example(name: str, form: str, placement: Placement = "whole") -> LawEffect:
    """An effect that changes forces of some ten kN at some mm visibly."""
    return LawEffect(name, form, EXAMPLES[name, form], placement)


def springs_of(name: str, values: Mapping[str, float]) -> tuple[str, dict[str, float]]:
    """The law, and its parameters, of what springs carry of the force of a law."""
    if name != "mgmm":
        return "kelvin_voigt", {"k": next(iter(values.values())), "c": 0.0}
    # tau = c1/k1 of a branch that is all but nothing, and k0 beside k_b, where it brings no tau k0 v
    branch = {key: 1e-12 * values[key] for key in ("k1", "c1")}
    return name, {
        **values,
        **branch,
        "k0": 0.0,
        "k_b": values["k0"] + values["k_b"],
        "c_NL": 0.0,
        "c_a": 0.0,
        "c_b": 0.0,
    }


def with_effects(
    effects: Sequence[LawEffect],
    law_force: np.ndarray,
    time: np.ndarray,
    u: np.ndarray,
    v: np.ndarray,
    temperature_C: float | None = None,
    tau: float = 0.0,
    springs: np.ndarray | None = None,
) -> np.ndarray:
    """Force (n,) N of a law with effects, of the law's own force (n,) N, all by the definitions.

    tau: of a law that relaxes all of its forces, s, for those inside it and on its sides; it has been held before the
    first sample. springs: what these carry of the force (n,) N.
    """
    carried = {"springs": np.zeros_like(u) if springs is None else springs}
    carried["dashpots"] = law_force - carried["springs"]
    given = [_values(one, time, u, v, temperature_C) for one in effects]
    count = [0.0] * len(effects)
    inside: list[_Relaxing | None] = [None] * len(effects)
    sides: dict[str, _Relaxing | None] = {"springs": None, "dashpots": None}
    found = np.empty_like(u)
    for i in range(u.size):
        h = time[i] - time[i - 1] if i else 0.0
        phi = {"whole": 1.0, "springs": 1.0, "dashpots": 1.0}
        beside = 0.0
        for k, one in enumerate(effects):
            values = given[k]
            value = _counted(one, count[k]) if values is None else float(values[i])
            if one.definition.name == "one_sided.force":
                value = 1.0 + one.values["b"] * (one.values["side"] * law_force[i] > 0.0)
            elif one.definition.name == "friction.loaded":
                p = one.values
                value = (p["F_c"] + p["mu"] * abs(law_force[i])) * np.tanh(v[i] / p["v0"])
            if one.definition.name == "limit.force":
                over = max(abs(law_force[i]) - one.values["F_l"], 0.0) * (one.values["side"] * law_force[i] >= 0.0)
                value = 1.0 - one.values["s"] * over / max(abs(law_force[i]), 1e-300)
            if one.placement == "inside" and one.definition.is_factor:
                inside[k] = _relaxed(inside[k], value - 1.0, law_force[i], h, tau)
                beside += inside[k].q
            elif one.placement == "inside":
                held = 0.0 if one.name in ("velocity_exponent", "friction") else value
                inside[k] = _relaxed(inside[k], value, 1.0, h, tau, held)
                beside += inside[k].q
            elif one.definition.is_factor:
                phi[one.placement] *= value
            else:
                beside += value
        law = law_force[i]
        for side, force in carried.items():
            less = phi[side] - 1.0
            if tau == 0.0:
                law += less * force[i]
                continue
            sides[side] = _relaxed(sides[side], less, force[i], h, tau)
            law += sides[side].q
        found[i] = phi["whole"] * law + beside
        if i:
            work = 0.5 * (found[i - 1] + found[i]) * (u[i] - u[i - 1])
            count = [_after(one, state, h, work) for one, state in zip(effects, count, strict=True)]
    return found


class _Relaxing(NamedTuple):
    """What relaxes, q, of a factor less 1 and a force at the end of a step."""

    q: float
    factor: float
    force: float


def _relaxed(
    last: _Relaxing | None, factor: float, force: float, h: float, tau: float, held: float | None = None
) -> _Relaxing:
    """Q + tau Q' = factor (F + tau F') = g, both linear over the step: of a quadratic of time the particular solution
    is g - tau g' + tau^2 g'', and the rest fades. held: Q at the first sample.
    """
    if last is None:
        return _Relaxing(factor * force if held is None else held, factor, force)
    change, rate = (factor - last.factor) / h, (force - last.force) / h
    everything = last.force + tau * rate
    g = (last.factor * everything, last.factor * rate + change * everything, change * rate)
    first, slope = g[0] - tau * g[1] + 2.0 * tau**2 * g[2], g[1] - 2.0 * tau * g[2]
    steady = first + h * (slope + h * g[2])
    return _Relaxing(steady + (last.q - first) * exp(-h / tau), factor, force)


def _counted(one: LawEffect, state: float) -> float:
    """The factor of what counts work, after what it has counted."""
    p = one.values
    return (
        exp(-state)
        if one.name == "self_heating"
        else 1.0 - p["d"] * (1.0 - exp(-((max(state, 0.0) / p["E0"]) ** p["q"])))
    )


def _after(one: LawEffect, state: float, h: float, work: float) -> float:
    """What has been counted after a step; it acts from the next sample on."""
    p = one.values
    return state * exp(-h / p["tau_h"]) + p["beta"] * work if one.name == "self_heating" else state + work


def _values(
    one: LawEffect, time: np.ndarray, u: np.ndarray, v: np.ndarray, temperature_C: float | None
) -> np.ndarray | None:
    """The factor or force (n,) of an effect; None: it counts work."""
    h, du, p = np.diff(time), np.diff(u), one.values
    path = np.concatenate(([0.0], np.cumsum(np.abs(du))))
    largest = np.maximum.accumulate(np.abs(u))
    ones = np.ones_like(u)
    match one.definition.name:
        case "payne.whole":
            ratio = (_envelope(p, h, u) / p["a0"]) ** p["m"]
            return 1.0 - p["d"] * ratio / (1.0 + ratio)
        case "payne.exponential":
            return 1.0 - p["d"] * (1.0 - np.exp(-((_envelope(p, h, u) / p["a0"]) ** p["m"])))
        case "payne.elastic":
            ratio = (_envelope(p, h, u) / p["a0"]) ** p["m"]
            return -p["k"] * ratio / (1.0 + ratio) * u
        case "payne.network":
            return 1.0 - p["d"] * _network(p, h, du)
        case "mullins.path":
            return 1.0 + p["m"] * np.exp(-((path / p["s0"]) ** p["q"]))
        case "mullins.maximum":
            return np.asarray(1.0 - p["m"] * erf((largest**2 - u**2) / (p["r"] ** 2 + p["beta"] * largest**2)))
        case "mullins.damage":
            return 1.0 - p["m"] * (1.0 - np.exp(-((largest / p["r"]) ** p["p"])))
        case "mullins.elastic":
            return p["k"] * np.exp(-((path / p["s0"]) ** p["q"])) * u
        case "temperature_law.exponential":
            return ones if temperature_C is None else ones * exp(-p["b"] * (temperature_C - p["T0"]))
        case "temperature_law.wlf":
            w = 0.0 if temperature_C is None else temperature_C - p["T0"]
            return ones * exp(-p["b"] * w / (1.0 + p["c"] * w))
        case "temperature_law.transition":
            at = [1.0 / (1.0 + exp(-(degrees - p["Tc"]) / p["w"])) for degrees in (temperature_C or p["T0"], p["T0"])]
            return ones * (1.0 - p["d"] * (at[0] - at[1]))
        case "ageing.linear":
            return ones * (1.0 + p["rate"] * p["n"])
        case "ageing.logarithmic":
            return ones * (1.0 + p["rate"] * log(1.0 + p["n"] / p["n0"]))
        case "degradation.path":
            return 1.0 - p["d"] * (1.0 - np.exp(-((path / p["s0"]) ** p["q"])))
        case "hardening.power":
            return p["k"] * u * (np.abs(u) / p["r"]) ** (p["p"] - 1.0)
        case "hardening.exponential":
            return p["k"] * u * (np.exp((u / p["u0"]) ** 2) - 1.0)
        case "hardening.threshold":
            return p["k"] * np.maximum(np.abs(u) - p["u0"], 0.0) * np.sign(u)
        case "one_sided.factor":
            return np.where(p["side"] * u > 0.0, 1.0 + p["b"], 1.0)
        case "one_sided.force" | "friction.loaded" | "limit.force":  # of the law's force
            return ones
        case "one_sided.valve":
            return 1.0 + p["b"] * np.maximum(np.tanh(p["side"] * v / p["v0"]), 0.0)
        case "one_sided.spring":
            return p["k"] * np.maximum(p["side"] * u - p["u0"], 0.0) * p["side"]
        case "one_sided.contact":
            x = np.maximum(p["side"] * u - p["u0"], 0.0)
            return p["side"] * p["k"] * x * (x / p["r"]) ** (p["n"] - 1.0)
        case "one_sided.even":
            return p["k"] * p["r"] * (np.abs(u) / p["r"]) ** p["n"]
        case "gas_spring.polytropic":
            room = 1.0 - p["c"] * u
            least = np.maximum(room, 0.05)
            return p["P"] * least ** -p["n"] * (1.0 + p["n"] * (least - room) / least)
        case "relaxation_branch.maxwell":
            return _branch(p, h, v)
        case "velocity_exponent.dashpot":
            return p["c"] * np.abs(v) ** p["alpha"] * np.sign(v)
        case "velocity_exponent.flow":
            return p["f"] * np.arcsinh(v / p["v0"])
        case "friction.coulomb":
            return p["F_c"] * np.tanh(v / p["v0"])
        case "friction.stribeck":
            return p["F_c"] * (1.0 + p["s"] * np.exp(-((v / p["v_s"]) ** 2))) * np.tanh(10.0 * v / p["v_s"])
        case "friction.presliding":
            return p["F_c"] * _dahl(p["x0"], h, u, v)
        case "hardening.saturating":
            return p["k"] * p["u0"] * np.tanh(u / p["u0"])
        case "velocity_exponent.position":
            return p["c"] * (np.abs(u) / p["r"]) ** p["q"] * np.abs(v) ** p["alpha"] * np.sign(v)
        case "hysteresis.stretch":
            return p["F_y"] * (np.abs(u) / p["r"]) ** p["n"] * _dahl(p["Y"], h, u, v)
        case "hysteresis.bouc_wen":
            return p["k"] * _along(lambda z, way: _bouc_wen(p, z, way), h, u, v)
        case "pinching.slip":
            return 1.0 - p["d"] * np.exp(-((u / (p["w"] * np.maximum(largest, 1e-300))) ** 2))
        case "degradation.energy" | "self_heating.rate":
            return None
    raise KeyError(one.definition.name)


def _envelope(p: Mapping[str, float], h: np.ndarray, u: np.ndarray) -> np.ndarray:
    a = np.empty_like(u)
    a[0] = abs(u[0])
    for i, step in enumerate(h):
        a[i + 1] = max(abs(u[i + 1]), a[i] * exp(-step / p["tau_a"]))
    return a


def _dahl(x0: float, h: np.ndarray, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """z/x0, z' = v - |v| z/x0: exponential over the ways."""
    return _along(lambda z, way: np.sign(way) + (z - np.sign(way)) * exp(-abs(way) / x0), h, u, v)


def _bouc_wen(p: Mapping[str, float], z: float, way: float) -> float:
    """z' = v - gamma |v| z - beta v |z| by the exponentials of its two sides, joined where z is zero."""
    sign, left = -1.0 if way < 0.0 else 1.0, abs(way)
    y, out, back = sign * z, p["gamma"] + p["beta"], p["gamma"] - p["beta"]
    if y < 0.0:
        to_zero = log(1.0 - back * y) / back
        if left <= to_zero:
            return sign * ((y - 1.0 / back) * exp(-back * left) + 1.0 / back)
        y, left = 0.0, left - to_zero
    return sign * ((y - 1.0 / out) * exp(-out * left) + 1.0 / out)


def _along(go: Callable[[float, float], float], h: np.ndarray, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """A state (n,) that follows the ways between the turns of the cubics between samples."""
    z = np.zeros_like(u)
    for i, step in enumerate(h):
        cubic = CubicHermiteSpline([0.0, step], u[i : i + 2], v[i : i + 2])
        turns = [s for s in cubic.derivative().roots(extrapolate=False) if 0.0 < s < step]
        now = z[i]
        for way in np.diff(cubic([0.0, *sorted(turns), step])):
            now = go(now, way)
        z[i + 1] = now
    return z


def _network(p: Mapping[str, float], h: np.ndarray, du: np.ndarray) -> np.ndarray:
    """x' = (1 - x) |v|/s0 - x/tau, |v| constant over a step."""
    x = np.zeros(h.size + 1)
    for i, step in enumerate(h):
        breaks, heals = abs(du[i]) / step / p["s0"], 1.0 / p["tau"]
        steady = breaks / (breaks + heals)
        x[i + 1] = steady + (x[i] - steady) * exp(-(breaks + heals) * step)
    return x


def _branch(p: Mapping[str, float], h: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Q' + Q/tau = k v: the particular solution of a linear velocity is k tau (v - tau v')."""
    k, tau = p["k"], p["tau"]
    q = np.zeros_like(v)
    for i, step in enumerate(h):
        slope = (v[i + 1] - v[i]) / step
        q[i + 1] = exp(-step / tau) * (q[i] - k * tau * (v[i] - tau * slope)) + k * tau * (v[i + 1] - tau * slope)
    return q
