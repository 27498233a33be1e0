"""Damper laws that are rate equations without closed form, against SciPy's Radau at 1e-10, the equations written anew.

Between reversals of the deformation, found here as roots of its velocity, the equations are smooth; Radau starts anew
at each.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest
from scipy.integrate import simpson, solve_ivp
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq

from edesign.damper.damper import Damper
from edesign.damper.laws import law

END = 1.5  # s
TIME = np.linspace(0.0, END, 301)
State = np.ndarray


def u(t: np.ndarray | float) -> np.ndarray | float:
    """Deformation (m): grows, reverses inside and beyond earlier extremes."""
    return 0.02 * np.sin(2 * np.pi * 0.8 * t) * (0.4 + 0.3 * t) + 0.004 * np.sin(2 * np.pi * 2.3 * t)


def v(t: np.ndarray | float) -> np.ndarray | float:
    """Its velocity (m/s)."""
    a, b = 2 * np.pi * 0.8, 2 * np.pi * 2.3
    return 0.02 * (a * np.cos(a * t) * (0.4 + 0.3 * t) + 0.3 * np.sin(a * t)) + 0.004 * b * np.cos(b * t)


GRID = np.linspace(0.0, END, 4001)
REVERSALS = [brentq(v, a, b, xtol=1e-14) for a, b in zip(GRID, GRID[1:], strict=False) if v(a) * v(b) < 0]


def radau(rate: Callable[[float, State], State], y0: list[float]) -> np.ndarray:
    """States (n, samples) at TIME."""
    result = np.empty((len(y0), TIME.size))
    result[:, 0] = y = np.array(y0)
    edges = [0.0, *REVERSALS, END]
    for start, stop in zip(edges, edges[1:], strict=False):
        inside = (start < TIME) & (stop >= TIME)
        at = np.append(TIME[inside], [stop] if stop < END else [])
        found = solve_ivp(rate, (start, stop), y, "Radau", t_eval=at, rtol=1e-10, atol=1e-13)
        assert found.success
        result[:, inside], y = found.y[:, : np.count_nonzero(inside)], found.y[:, -1]
    return result


def extremes(t: float) -> float:
    """u_max of thesis Eq. 2.71 at instant t: extremes lie at zero, at reversals or at t."""
    values = [0.0, float(u(t)), *(float(u(r)) for r in REVERSALS if r < t)]
    return 0.5 * (max(values) - min(values))


BOUC_WEN = {"Y": 0.004, "alpha": 0.05, "A": 1.1, "beta": 0.3, "gamma": 0.6}


@cache
def hysteresis(n: float) -> np.ndarray:
    """z at TIME."""
    p = BOUC_WEN

    def rate(t: float, z: State) -> State:
        w = float(v(t))
        return (p["A"] * w - p["gamma"] * abs(w) * z * abs(z) ** (n - 1) - p["beta"] * w * abs(z) ** n) / p["Y"]

    return radau(rate, [0.0])[0]


def check(name: str, parameters: dict[str, float], expected: np.ndarray, brace: float = 0.0) -> None:
    """1e-6 of the peak."""
    force = Damper(law(name), parameters, brace).force(TIME, u(TIME), v(TIME))
    peak = np.max(np.abs(expected))
    # the path between samples is the cubic through u and v: off by h^4/384 u'''' < 1e-9 m, or 1e-7 of Y
    np.testing.assert_allclose(force, expected, atol=1e-6 * peak, rtol=0)


def test_history_has_reversals_inside_and_beyond_extremes() -> None:
    """Otherwise the other tests here would say little."""
    assert len(REVERSALS) >= 4
    assert extremes(END) > 2 * extremes(REVERSALS[0])


@pytest.mark.parametrize("n", [1.0, 2.0, 7.5])
def test_bouc_wen(n: float) -> None:
    """Thesis Eqs. 2.67 and 2.68."""
    fy = 2e5
    expected = BOUC_WEN["alpha"] * fy / BOUC_WEN["Y"] * u(TIME) + (1 - BOUC_WEN["alpha"]) * fy * hysteresis(n)
    check("bouc_wen", {"Fy": fy, "n": n, **BOUC_WEN}, expected)


@pytest.mark.parametrize("dashpot", [0.0, 4e4])
def test_modified_bouc_wen(dashpot: float) -> None:
    """Thesis Eqs. 2.69 to 2.71."""
    k1, k2, u_ref, alpha_d = 3e7, 2e7, 0.015, 0.6
    k = k1 * np.exp(-np.array([extremes(t) for t in TIME]) / u_ref) + k2
    alpha, y = BOUC_WEN["alpha"], BOUC_WEN["Y"]
    expected = k * (alpha * u(TIME) + (1 - alpha) * y * hysteresis(2.0))
    expected += dashpot * np.abs(v(TIME)) ** alpha_d * np.sign(v(TIME))
    own = {"k1": k1, "k2": k2, "u_ref": u_ref, "C": dashpot, "alpha_d": alpha_d}
    check("modified_bouc_wen", {**own, **BOUC_WEN, "n": 2.0}, expected)


@pytest.mark.parametrize("alpha", [0.3, pytest.param(1.3, marks=pytest.mark.slow)])
def test_maxwell_power(alpha: float) -> None:
    """A brace only joins the spring: 1/k + 1/k_b."""
    c, k, brace = 4e5, 6e7, 1.5e8
    joined = 1 / (1 / k + 1 / brace)

    def rate(t: float, f: State) -> State:
        return joined * (float(v(t)) - np.sign(f) * (np.abs(f) / c) ** (1 / alpha))

    check("maxwell_power", {"c": c, "alpha": alpha, "k": k}, radau(rate, [0.0])[0], brace)


def test_braced_modified_bouc_wen() -> None:
    """The device's own deformation is integrated here too, its extremes as variables that grow with it."""
    k1, k2, u_ref, dashpot, brace = 3e7, 2e7, 0.015, 6e5, 2e8
    alpha, y = BOUC_WEN["alpha"], BOUC_WEN["Y"]
    p = BOUC_WEN

    def rate(t: float, s: State) -> State:
        x, z, largest, smallest = s
        k = k1 * np.exp(-0.5 * (max(largest, x) - min(smallest, x)) / u_ref) + k2
        w = (brace * (float(u(t)) - x) - k * (alpha * x + (1 - alpha) * y * z)) / dashpot
        grow = w if x >= largest - 1e-12 and w > 0 else 0.0
        fall = w if x <= smallest + 1e-12 and w < 0 else 0.0
        slope = p["A"] - (p["gamma"] * np.sign(w * z) + p["beta"]) * abs(z) ** 2
        return np.array([w, slope * w / y, grow, fall])

    time = TIME[:121]
    state, x = np.zeros(4), [0.0]
    for start, stop in zip(time, time[1:], strict=False):  # short pieces: the switches fall inside some of them
        state = solve_ivp(rate, (start, stop), state, "Radau", rtol=1e-8, atol=1e-12, max_step=2.5e-3).y[:, -1]
        state[2], state[3] = max(state[2], state[0]), min(state[3], state[0])
        x.append(state[0])
    own = {"k1": k1, "k2": k2, "u_ref": u_ref, "C": dashpot, "alpha_d": 1.0}
    force = Damper(law("modified_bouc_wen"), {**own, **p, "n": 2.0}, brace).force(time, u(time), v(time))
    expected = brace * (u(time) - np.array(x))
    # extremes here are those at the ends of the pieces and of the solver's steps, at worst w' dt^2 / 8 short
    np.testing.assert_allclose(force, expected, atol=1e-4 * np.max(np.abs(expected)), rtol=0)


@cache
def earthquake() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """2.5 s at 200 Hz: deformation (m) and velocity (m/s) of a 0.8 s oscillator under noise that swells."""
    rng = np.random.default_rng(7)
    time = np.arange(0.0, 2.5, 0.005)
    swell = np.minimum(1.0, time)
    omega, zeta = 2 * np.pi / 0.8, 0.05
    ground = CubicSpline(time, swell * rng.normal(0.0, 8.0, time.size))
    found = solve_ivp(
        lambda t, y: [y[1], -2 * zeta * omega * y[1] - omega**2 * y[0] - float(ground(t))],
        (0.0, time[-1]),
        [0.0, 0.0],
        t_eval=time,
        max_step=0.005,
    )
    return time, found.y[0], found.y[1]


CASES = (
    [("bouc_wen", {"Fy": 2e5, **BOUC_WEN, "n": n, "beta": b}) for n in (1.0, 1.5, 2.0, 12.0) for b in (-0.4, 0.6, 1.5)]
    + [("maxwell_power", {"c": 4e5, "alpha": a, "k": k}) for a in (0.15, 0.35, 1.0, 1.5, 2.0) for k in (1e6, 6e7, 1e9)]
    + [
        ("modified_bouc_wen", {**BOUC_WEN, "k1": 3e7, "k2": 2e7, "u_ref": 0.015, "C": c, "alpha_d": 0.4, "n": n})
        for c in (0.0, 1e5)
        for n in (1.0, 1.5)
    ]
)


# every second of the parameters, the other ones are slow
@pytest.mark.parametrize(
    ("name", "parameters"), [pytest.param(*case, marks=[pytest.mark.slow] * (i % 2)) for i, case in enumerate(CASES)]
)
def test_steps_agree_with_sundials_in_an_earthquake(name: str, parameters: dict[str, float]) -> None:
    """SUNDIALS at 1e-11: at 1e-9 it misses 1.5e-6 once, behind a stiff spring."""
    time, deformation, velocity = earthquake()
    core = Damper(law(name), parameters).core
    by_sundials = core.force(time, deformation, velocity, "ode", 1e-11)
    own = core.force(time, deformation, velocity)
    np.testing.assert_allclose(own, by_sundials, atol=3e-7 * np.max(np.abs(by_sundials)), rtol=0)


@pytest.mark.parametrize("alpha", [0.15, 0.5, 1.0, 1.6])
@pytest.mark.parametrize("k", [1e6, 1e8])
def test_spring_gives_back_what_the_dashpot_leaves(alpha: float, k: float) -> None:
    """Work = F^2 / 2k + the integral of F w, w = sgn F (|F| / c)^(1 / alpha), by Simpson's rule on fine samples."""
    c, fine = 4e5, np.linspace(0.0, END, 60001)
    force = Damper(law("maxwell_power"), {"c": c, "alpha": alpha, "k": k}).force(fine, u(fine), v(fine))
    dissipated = simpson(np.abs(force) * (np.abs(force) / c) ** (1 / alpha), x=fine)
    # the first force is that of a velocity that begins with a jump, and the dashpot's speed has kinks at rest
    assert simpson(force * v(fine), x=fine) == pytest.approx(dissipated + force[-1] ** 2 / (2 * k), rel=1e-6)
