"""The modified generalised Maxwell model as the thesis prints it (Eqs. 4.24 to 4.29), integrated as a differential
equation of the force from one kink of its right-hand side to the next: slow, accurate, and no code of edesign."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

# Table 4.2 in N, m, s; k0 in kN/mm (docs/verification/thesis_errata.md)
TABLE_4_2 = {
    "k1": 0.515e6,
    "c1": 0.0151e6,
    "k0": 0.107e6,
    "c_NL": 1.585e3 * 1e3**0.374,
    "alpha": 0.374,
    "k_a": 3.741e6,
    "k_b": 3.613e6,
    "u_ref": 7.966e-3,
    "c_a": 0.902e6,
    "c_b": 0.190e6,
    "v_ref": 13.468e-3,
}

Function = Callable[[float], float]


@dataclass(frozen=True)
class Motion:
    """Deformation, velocity and acceleration as functions of time, and times so close that each function changes its
    sign at most once between two of them; times where they are not smooth are among them."""

    u: Function
    v: Function
    a: Function
    grid: np.ndarray


def _grown(t: float, ramp: float) -> tuple[float, float, float]:
    """From 0 to 1 within `ramp`, with three continuous derivatives; with its first two derivatives."""
    x = min(t / ramp, 1.0)
    g = x**4 * (35 - 84 * x + 70 * x**2 - 20 * x**3)
    return g, 140 * (x * (1 - x)) ** 3 / ramp, 420 * (x * (1 - x)) ** 2 * (1 - 2 * x) / ramp**2


def _ramped(wave: Callable[[float], tuple[float, float, float]], ramp: float, highest: float, end: float) -> Motion:
    def u(t: float) -> float:
        return _grown(t, ramp)[0] * wave(t)[0]

    def v(t: float) -> float:
        (g, dg, _), (x, dx, _) = _grown(t, ramp), wave(t)
        return g * dx + dg * x

    def a(t: float) -> float:
        (g, dg, ddg), (x, dx, ddx) = _grown(t, ramp), wave(t)
        return g * ddx + 2 * dg * dx + ddg * x

    return Motion(u, v, a, np.union1d(np.linspace(0, end, int(np.ceil(40 * highest * end)) + 1), [min(ramp, end)]))


def sines(
    amplitude: Sequence[float], frequency: Sequence[float], phase: Sequence[float], ramp: float, end: float
) -> Motion:
    """Sum of sines (m, Hz, rad) that grows from nothing within `ramp` seconds."""
    A, w, p = np.array(amplitude), 2 * np.pi * np.array(frequency), np.array(phase)

    def wave(t: float) -> tuple[float, float, float]:
        s, c = A * np.sin(w * t + p), A * np.cos(w * t + p)
        return float(s.sum()), float((w * c).sum()), float(-(w * w * s).sum())

    return _ramped(wave, ramp, max(frequency), end)


def sweep(amplitude: float, first: float, last: float, ramp: float, end: float) -> Motion:
    """Sine of an amplitude (m) whose frequency rises evenly from `first` to `last` (Hz)."""
    rise = 2 * np.pi * (last - first) / end

    def wave(t: float) -> tuple[float, float, float]:
        w, phase = 2 * np.pi * first + rise * t, 2 * np.pi * first * t + 0.5 * rise * t * t + 0.3
        s, c = amplitude * np.sin(phase), amplitude * np.cos(phase)
        return s, w * c, rise * c - w * w * s

    return _ramped(wave, ramp, last, end)


def cubics(time: np.ndarray, deformation: np.ndarray, velocity: np.ndarray) -> Motion:
    """Cubics through deformation and velocity at the samples, as the law sees them."""
    h, u0, u1, v0, v1 = np.diff(time), deformation[:-1], deformation[1:], velocity[:-1], velocity[1:]
    c2 = 3 * (u1 - u0) / h**2 - (2 * v0 + v1) / h
    c3 = 2 * (u0 - u1) / h**3 + (v0 + v1) / h**2

    def piece(t: float) -> tuple[int, float]:
        i = min(max(int(np.searchsorted(time, t, side="right")) - 1, 0), h.size - 1)
        return i, t - time[i]

    def u(t: float) -> float:
        i, s = piece(t)
        return u0[i] + s * (v0[i] + s * (c2[i] + s * c3[i]))

    def v(t: float) -> float:
        i, s = piece(t)
        return v0[i] + s * (2 * c2[i] + s * 3 * c3[i])

    def a(t: float) -> float:
        i, s = piece(t)
        return 2 * c2[i] + 6 * c3[i] * s

    extremes = time[:-1] - c2 / (3 * c3)  # of the velocity; between them and the samples it has one zero at most
    inside = (extremes > time[:-1]) & (extremes < time[1:])
    return Motion(u, v, a, np.union1d(time, extremes[inside]))


def _zeros(f: Function, grid: np.ndarray) -> list[float]:
    values = [f(t) for t in grid]
    return [brentq(f, grid[i], grid[i + 1], xtol=1e-15) for i in range(grid.size - 1) if values[i] * values[i + 1] < 0]


def _kinks(f: Function, turns: np.ndarray) -> tuple[list[float], list[tuple[float, float]]]:
    """Times at which f passes its extremes so far, and the extremes (largest, smallest) at each of `turns`, between
    which f is monotone."""
    largest, smallest = max(0.0, f(turns[0])), min(0.0, f(turns[0]))
    times, extremes = [], [(largest, smallest)]
    for start, end in zip(turns[:-1], turns[1:], strict=True):
        for level in (largest, smallest):
            if (f(start) - level) * (f(end) - level) < 0:
                times.append(brentq(lambda t, level=level: f(t) - level, start, end, xtol=1e-15))
        largest, smallest = max(largest, f(end)), min(smallest, f(end))
        extremes.append((largest, smallest))
    return times, extremes


def force(
    p: dict[str, float], motion: Motion, times: np.ndarray, consistent: bool = False, rtol: float = 1e-10
) -> np.ndarray:
    """Force (n,) N at ascending times within the motion, from rest."""
    tau, alpha = p["c1"] / p["k1"], p["alpha"]
    grid = motion.grid[motion.grid <= times[-1]]
    grid = np.union1d(grid, [times[-1]])
    u_turns = np.union1d(_zeros(motion.v, grid), grid[[0, -1]])
    v_turns = np.union1d(np.union1d(_zeros(motion.a, grid), grid), grid[[0, -1]])
    u_kinks, u_extremes = _kinks(motion.u, u_turns)
    v_kinks, v_extremes = _kinks(motion.v, v_turns)
    edges = np.unique(np.concatenate([u_turns, v_turns, u_kinks, v_kinks, times]))
    now = {edges[0]: 0.0}
    for start, end in zip(edges[:-1], edges[1:], strict=True):
        if end - start < 1e-13:  # two kinks at once
            now[end] = now[start]
            continue
        u_most, u_least = u_extremes[int(np.searchsorted(u_turns, start, side="right")) - 1]
        v_most, v_least = v_extremes[int(np.searchsorted(v_turns, start, side="right")) - 1]
        middle = 0.5 * (start + end)
        growing = not u_least <= motion.u(middle) <= u_most

        def slope(
            t: float,
            y: np.ndarray,
            most: tuple[float, float] = (u_most, v_most),
            least: tuple[float, float] = (u_least, v_least),
            growing: bool = growing,
        ) -> list[float]:
            u, v = motion.u(t), motion.v(t)
            u_max = (max(most[0], u) + abs(min(least[0], u))) / 2  # Eq. 4.25
            v_max = (max(most[1], v) + abs(min(least[1], v))) / 2
            k_mod = p["k_a"] * np.exp(-u_max / p["u_ref"]) + p["k_b"]  # Eq. 4.24
            c_mod = p["c_a"] * np.exp(-v_max / p["v_ref"]) + p["c_b"]  # Eq. 4.26
            right = (p["k0"] + k_mod) * u + (tau * p["k0"] + p["c1"] + c_mod) * v  # Eq. 4.29
            right += p["c_NL"] * np.abs(v) ** alpha * np.sign(v)
            if consistent:
                fall = -p["k_a"] * np.exp(-u_max / p["u_ref"]) / p["u_ref"] * 0.5 * abs(v) if growing else 0.0
                right += tau * (k_mod * v + fall * u)
            return [(right - y[0]) / tau]

        solution = solve_ivp(slope, (start, end), [now[start]], "DOP853", rtol=rtol, atol=1e-5)
        if not solution.success:
            raise RuntimeError(solution.message)
        now[end] = float(solution.y[0, -1])
    return np.array([now[t] for t in times])
