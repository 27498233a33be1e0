"""The declared laws, stepped by rules of this laboratory's own.

A path is taken as straight between two moments of a fine grid. Branches and sliders follow such a path exactly; z of
Bouc-Wen by a step of Runge and Kutta; a power-law dashpot with a spring by the implicit midpoint. All are of order 2.
Forces come in three parts: of springs, of dashpots, of sliders, so that an effect may take hold of one of them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numba
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

STATES = 48
BRANCHES = 34  # of the springpot
SLOWEST, FASTEST = 1e-3, 1e5  # 1/s


@dataclass(frozen=True)
class Law:
    """A law: its number in the kernel, its parameters with units, those that a refit leaves alone."""

    kind: int
    names: tuple[str, ...]
    units: tuple[str, ...]
    held: tuple[str, ...] = ()

    @property
    def free(self) -> tuple[int, ...]:
        """Places of the parameters that a refit may change."""
        return tuple(i for i, name in enumerate(self.names) if name not in self.held)


LAWS = {
    "kelvin_voigt": Law(0, ("k", "c"), ("kN/mm", "kN*s/mm")),
    "zener": Law(1, ("k0", "k1", "c1"), ("kN/mm", "kN/mm", "kN*s/mm")),
    "maxwell": Law(2, ("c0", "lambda"), ("kN*s/mm", "s")),
    "generalised_maxwell": Law(3, ("k0", "k1", "c1", "k2", "c2"), ("kN/mm", "kN/mm", "kN*s/mm", "kN/mm", "kN*s/mm")),
    "viscous": Law(4, ("c",), ("kN*s/mm",)),
    "viscous_power": Law(5, ("c", "alpha"), ("kN*(s/mm)^alpha", "")),
    "asymmetric_viscous": Law(6, ("c_plus", "c_minus", "alpha"), ("kN*(s/mm)^alpha", "kN*(s/mm)^alpha", "")),
    "bilinear_oil": Law(7, ("c", "F_r", "p"), ("kN*s/mm", "kN", "")),
    "maxwell_power": Law(8, ("c", "alpha", "k"), ("kN*(s/mm)^alpha", "", "kN/mm")),
    "friction": Law(9, ("mu", "N", "k"), ("", "kN", "kN/mm"), held=("N",)),
    "elastic_plastic": Law(10, ("k", "Fy", "b"), ("kN/mm", "kN", "")),
    "lead_rubber": Law(11, ("Q", "K_d", "Y"), ("kN", "kN/mm", "mm")),
    "friction_pendulum": Law(
        12, ("W", "R", "f_slow", "f_fast", "a", "Y"), ("kN", "mm", "", "", "s/mm", "mm"), held=("W",)
    ),
    "self_centring": Law(13, ("k", "Fy", "b", "beta"), ("kN/mm", "kN", "", "")),
    "bouc_wen": Law(
        14, ("Fy", "Y", "alpha", "A", "beta", "gamma", "n"), ("kN", "mm", "", "", "", "", ""), held=("A", "gamma")
    ),
    "modified_bouc_wen": Law(
        15,
        ("k1", "k2", "u_ref", "Y", "alpha", "A", "beta", "gamma", "n", "C", "alpha_d"),
        ("kN/mm", "kN/mm", "mm", "mm", "", "", "", "", "", "kN*(s/mm)^alpha_d", ""),
        held=("A", "gamma"),
    ),
    "mgmm": Law(
        16,
        ("k1", "c1", "k0", "c_NL", "alpha", "k_a", "k_b", "u_ref", "c_a", "c_b", "v_ref"),
        (
            *("kN/mm", "kN*s/mm", "kN/mm", "kN*(s/mm)^alpha", "", "kN/mm", "kN/mm", "mm", "kN*s/mm", "kN*s/mm"),
            "mm/s",
        ),
        held=("k0", "c_b"),
    ),
    "fractional_kelvin": Law(17, ("k0", "c", "alpha"), ("kN/mm", "s^alpha", "")),
}
REMEMBER = ("mgmm",)
"""Laws whose memory of extremes may last from test to test: a campaign can say so of this one alone."""


def run(name: str, values: Array, dt: float, u: Array, v: Array, before: Array | None = None) -> tuple[Array, Array]:
    """Forces of a path on a grid of even steps.

    Args:
        name: of the law.
        values: its parameters.
        dt: step, s.
        u: deformation, mm.
        v: velocity, mm/s.
        before: state of the specimen before the test; None: virgin.

    Returns:
        Parts of the force (springs, dashpots, sliders), kN, and the state at the end.
    """
    state = np.zeros(STATES) if before is None else before.copy()
    law = LAWS[name]
    parts = np.empty((3, len(u)))
    _run(law.kind, values, _prepared(law.kind, values, dt), dt, u, v, state, parts)
    return parts, state


def run_in_series(
    name: str, values: Array, dt: float, x: Array, stiffness: float, gap: float, slips_at: float
) -> tuple[Array, Array]:
    """Forces of a law behind a connection: a spring with a gap that slides at a force.

    Returns:
        Force at the ends of the steps, kN, and the deformation of the law.
    """
    law = LAWS[name]
    force, u = np.zeros(len(x)), np.zeros(len(x))
    half = _prepared(law.kind, values, 0.5 * dt)
    _series(law.kind, values, half, dt, x, stiffness, gap, slips_at, force, u)
    return force, u


def memory(name: str, state: Array) -> Array:
    """What is left of a state after a long rest: the extremes alone."""
    kept = np.zeros(STATES)
    if name in REMEMBER:
        kept[1:5] = state[1:5]
    return kept


def _prepared(kind: int, p: Array, dt: float) -> Array:
    """Factors of branches in one step: how much remains, and how much a deformation adds."""
    if kind == 17:
        z = np.exp(np.linspace(np.log(SLOWEST), np.log(FASTEST), BRANCHES))
        width = np.full(BRANCHES, np.log(z[1] / z[0]))
        width[[0, -1]] *= 0.5
        weight = width * np.sin(np.pi * p[2]) / np.pi * z ** p[2]
        tails = np.sin(np.pi * p[2]) / np.pi * np.array([SLOWEST ** p[2] / p[2], FASTEST ** (p[2] - 1) / (1 - p[2])])
        return np.concatenate([np.exp(-z * dt), -np.expm1(-z * dt) / (z * dt), weight, tails])
    rates = {1: ((1, 2),), 3: ((1, 2), (3, 4))}.get(kind, ())
    factors: list[float] = []
    for k, c in rates:
        tau = p[c] / p[k]
        factors += [np.exp(-dt / tau), -p[c] * np.expm1(-dt / tau) / dt]
    if kind == 2:
        factors += [np.exp(-dt / p[1]), -p[0] * np.expm1(-dt / p[1]) / dt]
    if kind == 16:
        ratio = dt * p[0] / p[1]
        e = np.exp(-ratio)
        factors += [e, (1 - e) / ratio - e, 1 - (1 - e) / ratio]
    return np.array([*factors, 0.0])


@numba.njit(cache=True)
def _power(v: float, alpha: float) -> float:
    if v == 0.0:
        return 0.0
    return abs(v) ** alpha if v > 0 else -(abs(v) ** alpha)


@numba.njit(cache=True)
def _rate(z: float, sign: float, a: float, beta: float, gamma: float, n: float) -> float:
    size = abs(z) ** n
    return a - size * (beta + (gamma if z * sign > 0 else -gamma))


@numba.njit(cache=True)
def _bend(z: float, du: float, a: float, beta: float, gamma: float, n: float, y: float) -> float:
    """z of Bouc-Wen after a deformation."""
    sign = 1.0 if du >= 0 else -1.0
    h = du / y
    one = _rate(z, sign, a, beta, gamma, n)
    two = _rate(z + 0.5 * h * one, sign, a, beta, gamma, n)
    three = _rate(z + 0.5 * h * two, sign, a, beta, gamma, n)
    four = _rate(z + h * three, sign, a, beta, gamma, n)
    return z + h * (one + 2 * two + 2 * three + four) / 6


@numba.njit(cache=True)
def _extremes(s: Array, u: float, v: float) -> None:
    s[1], s[2] = max(s[1], u), min(s[2], u)
    s[3], s[4] = max(s[3], v), min(s[4], v)


@numba.njit(cache=True)
def _clip(x: float, bound: float) -> float:
    return min(max(x, -bound), bound)


@numba.njit(cache=True)
def _softened(p: Array, s: Array, u: float, v: float) -> float:
    """The right side of the MGMM."""
    k = p[5] * np.exp(-0.5 * (s[1] - s[2]) / p[7]) + p[6]
    c = p[8] * np.exp(-0.5 * (s[3] - s[4]) / p[10]) + p[9]
    return (p[2] + k) * u + (p[1] / p[0] * p[2] + p[1] + c) * v + p[3] * _power(v, p[4])


@numba.njit(cache=True)
def _step(kind: int, p: Array, f: Array, s: Array, u: float, v: float, du: float, dt: float, out: Array) -> None:
    """One step of a law along a straight path du that ends at u with velocity v."""
    out[0] = out[1] = out[2] = 0.0
    if kind == 0:
        out[0], out[1] = p[0] * u, p[1] * v
    elif kind == 1:
        s[0] = f[0] * s[0] + f[1] * du
        out[0], out[1] = p[0] * u, s[0]
    elif kind == 2:
        s[0] = f[0] * s[0] + f[1] * du
        out[1] = s[0]
    elif kind == 3:
        s[0] = f[0] * s[0] + f[1] * du
        s[1] = f[2] * s[1] + f[3] * du
        out[0], out[1] = p[0] * u, s[0] + s[1]
    elif kind == 4:
        out[1] = p[0] * v
    elif kind == 5:
        out[1] = p[0] * _power(v, p[1])
    elif kind == 6:
        out[1] = (p[0] if v > 0 else p[1]) * _power(v, p[2])
    elif kind == 7:
        force = p[0] * v
        if abs(force) > p[1]:
            force = np.sign(force) * (p[1] + p[2] * (abs(force) - p[1]))
        out[1] = force
    elif kind == 8:
        if dt > 0:
            s[0] = _fluid(p, s[0], du / dt, dt)
        out[1] = s[0]
    elif kind == 9:
        s[0] = _clip(s[0] + p[2] * du, p[0] * p[1])
        out[2] = s[0]
    elif kind == 10:
        s[0] = _clip(s[0] + (1 - p[2]) * p[0] * du, (1 - p[2]) * p[1])
        out[0], out[2] = p[2] * p[0] * u, s[0]
    elif kind == 11:
        s[0] = _clip(s[0] + du / p[2], 1.0)
        out[0], out[2] = p[1] * u, p[0] * s[0]
    elif kind == 12:
        mu = p[3] - (p[3] - p[2]) * np.exp(-p[4] * abs(v))
        stiffness, first = p[2] * p[0] / p[5], 0.0
        if s[1] * v < 0:  # it turned within the step, at the friction of rest
            first = 0.5 * dt * s[1] * s[1] / (s[1] - v)
            s[0] = _clip(s[0] + stiffness * first, p[2] * p[0])
        s[0] = _clip(s[0] + stiffness * (du - first), mu * p[0])
        s[1] = v
        out[0], out[2] = p[0] / p[1] * u, s[0]
    elif kind == 13:
        side = 1.0 if u >= 0 else -1.0
        x = side * u
        plastic = max(side * s[0], 0.0)
        top = (1 - p[2]) * p[1] + p[2] * p[0] * x
        force = min(max(p[0] * (x - plastic), top - (1 - p[2]) * p[3] * p[1]), top)
        plastic = max(x - force / p[0], 0.0)
        s[0] = side * plastic
        out[2] = side * p[0] * (x - plastic)
    elif kind == 14:
        s[0] = _bend(s[0], du, p[3], p[4], p[5], p[6], p[1])
        out[0], out[2] = p[2] * p[0] / p[1] * u, (1 - p[2]) * p[0] * s[0]
    elif kind == 15:
        _extremes(s, u, v)
        s[0] = _bend(s[0], du, p[5], p[6], p[7], p[8], p[3])
        k = p[0] * np.exp(-0.5 * (s[1] - s[2]) / p[2]) + p[1]
        out[0], out[1], out[2] = k * p[4] * u, p[9] * _power(v, p[10]), k * (1 - p[4]) * p[3] * s[0]
    elif kind == 16:
        _extremes(s, u, v)
        right = _softened(p, s, u, v)
        s[0] = f[0] * s[0] + f[1] * s[5] + f[2] * right
        s[5] = right
        out[2] = s[0]
    else:
        total = f[3 * BRANCHES] * u + f[3 * BRANCHES + 1] * v
        for i in range(BRANCHES):
            s[i] = f[i] * s[i] + f[BRANCHES + i] * du
            total += f[2 * BRANCHES + i] * s[i]
        out[0], out[1] = p[0] * u, p[0] * p[1] * total


@numba.njit(cache=True)
def _fluid(p: Array, force: float, v: float, dt: float) -> float:
    """A power-law dashpot with a spring: implicit midpoint, by Newton between bounds."""
    c, alpha, k = p[0], p[1], p[2]
    low, high = force - 0.5 * dt * k * abs(v) - abs(force), force + 0.5 * dt * k * abs(v) + abs(force)
    middle = force
    for _ in range(60):
        flow = _power(middle / c, 1 / alpha)
        error = middle - force - 0.5 * dt * k * (v - flow)
        if error > 0:
            high = middle
        else:
            low = middle
        slope = 1 + 0.5 * dt * k * abs(middle / c) ** (1 / alpha - 1) / (alpha * c)
        new = middle - error / slope
        if not low <= new <= high:
            new = 0.5 * (low + high)
        if abs(new - middle) <= 1e-13 * c:
            middle = new
            break
        middle = new
    return 2 * middle - force


@numba.njit(cache=True)
def _run(kind: int, p: Array, f: Array, dt: float, u: Array, v: Array, s: Array, parts: Array) -> None:
    out = np.zeros(3)
    if kind == 16:
        _extremes(s, u[0], v[0])
        s[5] = _softened(p, s, u[0], v[0])
        s[0] = s[5]
        parts[:, 0] = 0.0
        parts[2, 0] = s[0]
    else:
        _step(kind, p, f, s, u[0], v[0], 0.0, 0.0, out)
        parts[:, 0] = out
    for i in range(1, len(u)):
        _step(kind, p, f, s, u[i], v[i], u[i] - u[i - 1], dt, out)
        parts[:, i] = out


@numba.njit(cache=True)
def _connection(elongation: float, stiffness: float, gap: float, slips_at: float) -> float:
    if abs(elongation) <= 0.5 * gap:
        return 0.0
    return _clip(stiffness * (elongation - np.sign(elongation) * 0.5 * gap), slips_at)


@numba.njit(cache=True)
def _series(
    kind: int,
    p: Array,
    f: Array,
    dt: float,
    x: Array,
    stiffness: float,
    gap: float,
    slips_at: float,
    force: Array,
    u: Array,
) -> None:
    """Equilibrium in the middle of each step between connection and law: its velocity is found by false position."""
    s, trial, out = np.zeros(STATES), np.zeros(STATES), np.zeros(3)
    slid, scale = 0.0, slips_at
    last = 0.0
    h = 0.5 * dt
    middle_before = 0.0
    for i in range(1, len(x)):
        middle = 0.5 * (x[i] + x[i - 1])
        reach = 2 * abs(x[i] - x[i - 1]) / dt + abs(last) + 1e-6
        low, high = last - reach, last + reach
        low_error = high_error = 0.0
        for which in range(2):
            for _ in range(60):
                w = high if which else low
                trial[:] = s
                _step(kind, p, f, trial, u[i - 1] + h * w, w, h * w, h, out)
                error = _connection(middle - u[i - 1] - h * w - slid, stiffness, gap, slips_at) - out.sum()
                if which:
                    high_error = error
                    if error <= 0:
                        break
                    high += reach
                else:
                    low_error = error
                    if error >= 0:
                        break
                    low -= reach
                reach *= 2
        w, side = last, 0
        for _ in range(100):
            span = high_error - low_error
            w = 0.5 * (low + high) if span == 0 else (low * high_error - high * low_error) / span
            trial[:] = s
            _step(kind, p, f, trial, u[i - 1] + h * w, w, h * w, h, out)
            error = _connection(middle - u[i - 1] - h * w - slid, stiffness, gap, slips_at) - out.sum()
            if abs(error) <= 1e-9 * scale or high - low <= 1e-12 * (abs(low) + abs(high)):
                break
            if error > 0:
                low, low_error = w, error
                if side == 1:
                    high_error *= 0.5
                side = 1
            else:
                high, high_error = w, error
                if side == -1:
                    low_error *= 0.5
                side = -1
        now = out.sum()
        bound = slips_at / stiffness + 0.5 * gap
        stretched = middle - u[i - 1] - h * w - slid
        if abs(stretched) > bound:
            slid += stretched - np.sign(stretched) * bound
        _step(kind, p, f, trial, u[i - 1] + dt * w, w, h * w, h, out)
        s[:] = trial
        u[i] = u[i - 1] + dt * w
        force[i - 1] = 0.5 * (now + middle_before)
        middle_before, last = now, w
    force[len(x) - 1] = middle_before
