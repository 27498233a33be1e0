"""Dampers with a brace in series, k_b (u - x) = F(x) with their own deformation x, against solutions without edesign.

References: scipy's DOP853 and Radau, a Runge-Kutta method with small steps where extremes are remembered, return
mapping and Masing's rule by hand, and laws whose brace only changes their parameters. Maxwell's power law and the
modified Bouc-Wen law with braces are in test_verify_ode_laws.py.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from damper_examples import EXAMPLES
from damper_motions import Motion
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from edesign.core import CoreDamper
from edesign.damper.laws import LAWS

Array = np.ndarray
BRACE = 60e6  # N/m, about seven times the dampers
DURATION = 1.6  # s
MOTION = Motion(12e-3, 11, DURATION)
RATES = (100, 200, 400)  # samples a second; frames take steps of 0.01 s or less


def damper(name: str, brace: float = BRACE, **changes: float) -> CoreDamper:
    values = LAWS[name].complete(EXAMPLES[name] | changes)
    return CoreDamper(name, list(values.values()), brace)


def times(rate: float) -> Array:
    return np.arange(round(DURATION * rate) + 1) / rate


def force(name: str, rate: float, **changes: float) -> Array:
    t = times(rate)
    return damper(name, **changes).force(t, MOTION.u(t), MOTION.v(t))


def errors(name: str, exact: Callable[[Array], Array], **changes: float) -> Array:
    """Largest error over the largest force at RATES."""
    found = []
    for rate in RATES:
        expected = exact(times(rate))
        found.append(np.max(np.abs(force(name, rate, **changes) - expected)) / np.max(np.abs(expected)))
    return np.array(found)


def order(found: Array) -> Array:
    return np.log2(found[:-1] / found[1:])


def test_the_motion_turns_and_grows() -> None:
    """Otherwise the other tests here would say little."""
    turns = np.array([MOTION.u(t) for t in MOTION.turns()])
    assert turns.size >= 4 and np.max(np.abs(turns)) > 6e-3


# ---- laws that depend on speed: collocation of order 3


def test_zener() -> None:
    """q' (1 + k1 / (k_b + k0)) = k1 k_b / (k_b + k0) v - k1/c1 q, F = k_b (u - x), x = (k_b u - q) / (k_b + k0)."""
    p = EXAMPLES["zener"]
    stiff = BRACE + p["k0"]

    def rate(t: float, q: Array) -> Array:
        return (p["k1"] * BRACE / stiff * MOTION.v(t) - p["k1"] / p["c1"] * q) / (1.0 + p["k1"] / stiff)

    fine = solve_ivp(
        rate, (0.0, DURATION), [0.0], "DOP853", rtol=1e-11, atol=1e-4, max_step=0.01, dense_output=True
    ).sol
    found = errors("zener", lambda t: BRACE * (MOTION.u(t) - (BRACE * MOTION.u(t) - fine(t)[0]) / stiff))
    assert found[0] < 1e-5
    np.testing.assert_allclose(order(found), 3.0, atol=0.2)


def test_fractional_zener() -> None:
    """F = k_b (u - x) put in: the same law with k0 / r, (a + b k0 / k_b) / r and b, where r = 1 + k0 / k_b."""
    p = EXAMPLES["fractional_zener"]
    r = 1.0 + p["k0"] / BRACE
    values = (p["k0"] / r, (p["a"] + p["b"] * p["k0"] / BRACE) / r, p["b"], p["alpha"])
    soft = CoreDamper("fractional_zener", values)
    found = errors("fractional_zener", lambda t: soft.force(t, MOTION.u(t), MOTION.v(t)))
    assert order(found)[0] > 2.0
    assert found[0] < 1e-4 and found[-1] < 2e-5  # two sums of exponentials stand for the power of time, 1e-5 each


@pytest.fixture(scope="module")
def braced_mgmm() -> tuple[Array, Array]:
    """Time and force of the MGMM with its brace by Runge-Kutta's classical method: Eq. 4.29 with F = k_b (u - x) and
    F' = k_b (v - w) is an equation for w = x', monotone in w, that Newton's method solves."""
    p = EXAMPLES["mgmm"]
    tau, alpha = p["c1"] / p["k1"], p["alpha"]
    n = round(DURATION * 10_000)
    h = DURATION / n
    at = np.arange(2 * n + 1) * 0.5 * h
    us, vs = MOTION.u(at), MOTION.v(at)
    largest = [0.0, 0.0, 0.0, 0.0]  # of x, -x, w, -w

    def speed(i: int, x: float, w: float) -> float:
        softened = p["k_a"] * np.exp(-0.5 * (max(largest[0], x) + max(largest[1], -x)) / p["u_ref"]) + p["k_b"]
        right = BRACE * (us[i] - x) + tau * BRACE * vs[i] - (p["k0"] + softened) * x

        def left(w: float) -> float:
            fall = 0.5 * (max(largest[2], w) + max(largest[3], -w)) / p["v_ref"]
            c = tau * p["k0"] + p["c1"] + p["c_a"] * np.exp(-fall) + p["c_b"] + tau * BRACE
            return c * w + p["c_NL"] * abs(w) ** alpha * np.sign(w)

        for _ in range(60):  # secant in s = |w|^alpha sgn w, which is smooth at rest
            residual = left(w) - right
            if abs(residual) < 1e-7:
                return w
            d = 1e-7 * abs(w) + 1e-14
            step = residual * d / (left(w + d) - left(w))
            w = -0.1 * w if w * (w - step) < 0.0 and abs(w) > 1e-12 else w - step
        return float(brentq(lambda w: left(w) - right, -1.0, 1.0, xtol=1e-16))

    x, w, xs = 0.0, 0.0, [0.0]
    for i in range(0, 2 * n, 2):
        a = speed(i, x, w)
        b = speed(i + 1, x + 0.5 * h * a, a)
        c = speed(i + 1, x + 0.5 * h * b, b)
        d = speed(i + 2, x + h * c, c)
        x += h / 6.0 * (a + 2.0 * b + 2.0 * c + d)
        w = speed(i + 2, x, d)
        largest = [max(m, now) for m, now in zip(largest, (x, -x, w, -w), strict=True)]
        xs.append(x)
    return at[::2], BRACE * (us[::2] - np.array(xs))


def test_mgmm(braced_mgmm: tuple[Array, Array]) -> None:
    t, exact = braced_mgmm
    found = errors("mgmm", lambda at: exact[np.rint(at / t[1]).astype(int)])
    # |v|^alpha where the damper stops and the softening where it goes on further are kinks: between order 1 and 2
    assert found[0] < 6e-4 and found[-1] < 1e-4
    assert np.all(order(found) > 0.8)


def test_asymptote() -> None:
    """x and the hysteretic force from one stop of the damper to the next: F_h' = P'(x) w (1 + kappa (e/e0)^n)."""
    p = LAWS["asymptote"].complete(EXAMPLES["asymptote"])

    def polynomial(x: float) -> float:
        return p["k1"] * x + p["k2"] * x * abs(x) + p["k3"] * x**3

    def speed(t: float, y: Array) -> float:
        return (BRACE * (float(MOTION.u(t)) - y[0]) - y[1]) / p["c"]

    pieces: list[Callable[[Array], Array]] = []
    stops = [0.0]
    y, s = np.zeros(2), float(np.sign(MOTION.u(1e-3)))
    while stops[-1] < DURATION:
        e0 = s * p["f0"] + polynomial(y[0]) - y[1]

        def rate(t: float, y: Array, s: float = s, e0: float = e0) -> list[float]:
            w = speed(t, y)
            e = s * p["f0"] + polynomial(y[0]) - y[1]
            rise = p["k1"] + 2.0 * p["k2"] * abs(y[0]) + 3.0 * p["k3"] * y[0] ** 2
            return [w, rise * w * (1.0 + p["kappa"] * max(e / e0, 0.0) ** p["n"])]

        def turned(t: float, y: Array, s: float = s, start: float = stops[-1]) -> float:
            return s * speed(t, y) if t > start + 1e-6 else 1.0

        turned.terminal = True  # type: ignore[attr-defined]
        turned.direction = -1  # type: ignore[attr-defined]
        piece = solve_ivp(
            rate, (stops[-1], DURATION), y, "Radau", rtol=1e-9, atol=[1e-12, 1e-3], events=turned, dense_output=True
        )
        pieces.append(piece.sol)
        stops.append(float(piece.t[-1]))
        y, s = piece.y[:, -1], -s
    assert len(stops) > 5

    def exact(t: Array) -> Array:
        which = np.clip(np.searchsorted(stops, t, side="right") - 1, 0, len(pieces) - 1)
        x = np.array([pieces[i](at)[0] for i, at in zip(which, t, strict=True)])
        return BRACE * (MOTION.u(t) - x)

    found = errors("asymptote", exact)
    assert found[0] < 5e-4 and found[-1] < 2e-5  # the tangent jumps where the damper turns inside a step
    assert np.log2(found[0] / found[-1]) > 4.0


# ---- laws that do not: exact at every turn of the path


def pieces() -> list[tuple[float, float]]:
    return MOTION.pieces()


def test_bouc_wen() -> None:
    """w = k_b v / (k_b + alpha k + (1 - alpha) Fy dz/dx), from one turn of the path to the next."""
    p = EXAMPLES["bouc_wen"]
    k = p["Fy"] / p["Y"]

    def rate(t: float, y: Array) -> list[float]:
        x, z = y
        del x
        v = float(MOTION.v(t))
        slope = (p["A"] - (p["gamma"] * np.sign(v * z) + p["beta"]) * abs(z) ** p["n"]) / p["Y"]
        w = BRACE * v / (BRACE + p["alpha"] * k + (1.0 - p["alpha"]) * p["Fy"] * slope)
        return [w, slope * w]

    y, found = np.zeros(2), []
    for start, end in pieces():
        found.append(solve_ivp(rate, (start, end), y, "DOP853", rtol=1e-10, atol=1e-12, dense_output=True))
        y = found[-1].y[:, -1]
    starts = [start for start, _ in pieces()]

    def exact(t: Array) -> Array:
        which = np.searchsorted(starts, t, side="right") - 1
        return BRACE * (MOTION.u(t) - np.array([found[i].sol(at)[0] for i, at in zip(which, t, strict=True)]))

    # relative tolerance 1e-6 of SUNDIALS, and the cubic between samples at the lowest rate
    assert errors("bouc_wen", exact)[-1] < 1e-5


@pytest.mark.parametrize(
    ("name", "k", "fy", "b"), [("elastic_plastic", 50e6, 100e3, 0.03), ("friction", 100e6, 0.3 * 330e3, 0.0)]
)
def test_plastic(name: str, k: float, fy: float, b: float) -> None:
    """Return mapping (Simo & Hughes 1998, 1.4) of slider, kinematic hardening b k / (1 - b) and both springs in series.

    It is exact over a monotone way, so it is taken at every turn and sample.
    """
    together, hardening = k * BRACE / (k + BRACE), b * k / (1.0 - b)

    def exact(t: Array) -> Array:
        every = np.union1d(t, MOTION.turns())
        plastic, values = 0.0, []
        for u in MOTION.u(every):
            over = together * (u - plastic) - hardening * plastic
            if abs(over) > fy:
                plastic += np.sign(over) * (abs(over) - fy) / (together + hardening)
            values.append(together * (u - plastic))
        return np.array(values)[np.searchsorted(every, t)]

    found = errors(name, exact)
    assert found[-1] < 1e-7


def test_ramberg_osgood() -> None:
    """Masing's rule on growing cycles: half the skeleton from each turn, until the skeleton itself is met again."""
    p = EXAMPLES["ramberg_osgood"]

    def skeleton(u: float) -> float:
        if u == 0.0:
            return 0.0

        def missing(f: float) -> float:
            return f / p["k"] * (1.0 + p["a"] * (f / p["Fy"]) ** (p["n"] - 1.0)) + f / BRACE - abs(u)

        return float(np.sign(u) * brentq(missing, 0.0, p["k"] * abs(u), xtol=1e-6, rtol=1e-14))

    omega = 4.0 * np.pi
    t = times(400)
    u, v = 6e-3 * t * np.sin(omega * t), 6e-3 * (np.sin(omega * t) + omega * t * np.cos(omega * t))
    expected, turn = np.array([skeleton(now) for now in u]), 0.0
    for i in np.arange(1, t.size):
        if v[i - 1] * v[i] <= 0.0 and i > 1:  # tan(omega t) = -omega t
            at = brentq(lambda t: np.sin(omega * t) + omega * t * np.cos(omega * t), t[i - 1], t[i], xtol=1e-15)
            turn = 6e-3 * at * np.sin(omega * at)
        if turn != 0.0 and u[i] * np.sign(turn) > -abs(turn):
            expected[i] = skeleton(turn) - 2.0 * skeleton(0.5 * (turn - u[i]))
    found = damper("ramberg_osgood").force(t, u, v)
    peak = np.max(np.abs(expected))
    assert peak > 1.2 * p["Fy"]  # well beyond the elastic part
    np.testing.assert_allclose(found, expected, atol=1e-6 * peak, rtol=0)  # the cubic at the turns


# ---- tangents


ODE_LAWS = ("maxwell_power", "bouc_wen", "modified_bouc_wen")  # with a brace SUNDIALS integrates them


@pytest.mark.parametrize("name", LAWS)
def test_tangent(name: str) -> None:
    """Central differences of the force at the end of a step, to the deformation and to the velocity there, from states
    in the middle of a motion; as shares of the brace's stiffness."""
    one = damper(name)
    h = 0.005
    d = 1e-7 if name in ODE_LAWS else 1e-9  # m; these carry their tolerance of 1e-10 of the force
    state, checked = one.start(), 0
    for step in range(round(0.9 / h)):
        start, end = ((float(MOTION.u(t)), float(MOTION.v(t))) for t in (step * h, (step + 1) * h))
        following, _, slope = one.step(state, h, start, end)
        if step > 50 and step % 9 == 0:
            checked += 1

            def at(du: float, dv: float, state: Array = state, start=start, end=end) -> float:  # type: ignore[no-untyped-def]
                return one.step(state, h, start, (end[0] + du, end[1] + dv), tolerance=1e-10)[1]

            by_u = (at(d, 0.0) - at(-d, 0.0)) / (2.0 * d)
            by_v = (at(0.0, d / h) - at(0.0, -d / h)) / (2.0 * d / h)
            # where |v|^alpha or a new extreme lies near, the difference itself is off by 1e-4 of the force's slope
            assert slope[0] == pytest.approx(by_u, abs=1e-4 * BRACE), step
            assert slope[1] == pytest.approx(by_v, abs=1e-4 * BRACE * h), step
        state = following
    assert checked >= 12
