"""Dampers in series with a rig that has stiffness and play, against scipy's integration of both together.

References: the differential equations of rig and damper, solved from one corner of the rig to the next (events of
solve_ivp); the modified generalised Maxwell model by Runge-Kutta's classical method with small steps, as it remembers
extremes. No code of edesign is in them.
"""

from __future__ import annotations

import numpy as np
import pytest
from damper_examples import EXAMPLES
from damper_motions import Motion
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from series_history import force_in_series

from edesign.core.damper import CoreDamper
from edesign.core.errors import CoreError
from edesign.damper.laws import LAWS

Array = np.ndarray
STIFFNESS, PLAY = 60e6, 1e-3  # N/m, m
DURATION = 1.6  # s
MOTION = Motion(12e-3, 11, DURATION)


def damper(name: str) -> CoreDamper:
    return CoreDamper(name, list(LAWS[name].complete(EXAMPLES[name]).values()))


def found(name: str, rate: int, **options: float | Array) -> tuple[Array, Array, Array]:
    t = np.arange(round(DURATION * rate) + 1) / rate
    force, own = force_in_series(damper(name), t, MOTION.u(t), MOTION.v(t), STIFFNESS, **options)  # type: ignore[arg-type]
    return t, force, own


def carried(e: Array | float) -> Array:
    return STIFFNESS * np.sign(e) * np.maximum(np.abs(e) - 0.5 * PLAY, 0.0)


def zener_with_play() -> tuple[list[float], list]:  # type: ignore[type-arg]
    """q' = k1 w - k1/c1 q of the branch; force k0 x + q. Within the play k0 x + q = 0 gives w = k1/c1 q / (k0 + k1);
    beyond, K (v - w) = k0 w + q'."""
    p, g = EXAMPLES["zener"], 0.5 * PLAY
    y, side, now = np.zeros(2), 0, 0.0  # x and q
    ends, pieces = [0.0], []
    while now < DURATION:

        def rate(t: float, y: Array, side: int = side) -> list[float]:
            loose = p["k1"] / p["c1"] * y[1]
            w = (STIFFNESS * abs(side) * float(MOTION.v(t)) + loose) / (STIFFNESS * abs(side) + p["k0"] + p["k1"])
            return [w, p["k1"] * w - loose]

        def meets(t: float, y: Array, side: int = side) -> float:
            return abs(float(MOTION.u(t)) - y[0]) - g

        def parts(t: float, y: Array, side: int = side) -> float:
            return side * (p["k0"] * y[0] + y[1])

        event = parts if side else meets
        event.terminal, event.direction = True, -1 if side else 1  # type: ignore[attr-defined]
        piece = solve_ivp(
            rate, (now, DURATION), y, "DOP853", rtol=1e-10, atol=1e-9, max_step=2e-3, events=event, dense_output=True
        )
        now, y = float(piece.t[-1]), piece.y[:, -1]
        side = 0 if side else int(np.sign(MOTION.u(now) - y[0]))
        ends.append(now)
        pieces.append(piece.sol)
    return ends, pieces


def test_zener_with_play() -> None:
    ends, pieces = zener_with_play()
    assert len(pieces) > 8  # the pins meet and part often
    errors = []
    for rate in (125, 1000):
        t, force, own = found("zener", rate, play=PLAY)
        which = np.clip(np.searchsorted(ends, t, side="right") - 1, 0, len(pieces) - 1)
        x = np.array([pieces[i](at)[0] for i, at in zip(which, t, strict=True)])
        expected = carried(MOTION.u(t) - x)
        peak = np.max(np.abs(expected))
        loose = np.abs(MOTION.u(t) - x) < 0.45 * PLAY  # pins that are clearly apart
        assert np.any(loose) and np.all(force[loose] == 0.0)
        errors.append(np.max(np.abs(force - expected)) / peak)
        np.testing.assert_allclose(own, x, atol=3e-3 * np.max(np.abs(x)), rtol=0)
    # between order 1, where the pins meet inside a step, and 2
    assert errors[0] < 1e-3 and errors[1] < 3e-5


@pytest.fixture(scope="module")
def mgmm_with_play() -> tuple[Array, Array]:
    """Time and force. Eq. 4.29, tau F' = G(x, w) - F, in three states of the rig: beyond the play F = K (|e| - g) and
    K (v - w) tau = G - F is monotone in w; within it G(x, w) = 0 is."""
    p, g = EXAMPLES["mgmm"], 0.5 * PLAY
    tau, alpha = p["c1"] / p["k1"], p["alpha"]
    h = 5e-5
    n = round(DURATION / h)
    at = np.arange(2 * n + 1) * 0.5 * h
    us, vs = MOTION.u(at), MOTION.v(at)
    largest = [0.0, 0.0, 0.0, 0.0]  # of x, -x, w, -w

    def speed(i: int, x: float, w: float) -> float:
        e = us[i] - x
        together = abs(e) > g
        k = p["k0"] + p["k_b"] + p["k_a"] * np.exp(-0.5 * (max(largest[0], x) + max(largest[1], -x)) / p["u_ref"])
        force = STIFFNESS * (e - np.copysign(g, e)) if together else 0.0
        right = force - k * x + (tau * STIFFNESS * vs[i] if together else 0.0)
        rig = tau * STIFFNESS if together else 0.0

        def missing(s: float) -> float:  # s = |w|^alpha sgn w, in which it is smooth at rest
            w = np.sign(s) * abs(s) ** (1.0 / alpha)
            fall = 0.5 * (max(largest[2], w) + max(largest[3], -w)) / p["v_ref"]
            c = tau * p["k0"] + p["c1"] + p["c_a"] * np.exp(-fall) + p["c_b"] + rig
            return float(c * w + p["c_NL"] * s - right)

        s = np.sign(w) * abs(w) ** alpha
        d = 1e-6 * max(abs(s), 1e-3)
        for _ in range(20):
            residual = missing(s)
            if abs(residual) < 1e-6:
                break
            s -= residual * d / (missing(s + d) - residual)
        else:
            s = brentq(missing, -2.0, 2.0, xtol=1e-15)
        return float(np.sign(s) * abs(s) ** (1.0 / alpha))

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
    return at[::2], carried(us[::2] - np.array(xs))


def test_mgmm_with_play(mgmm_with_play: tuple[Array, Array]) -> None:
    at, exact = mgmm_with_play
    errors = []
    for rate in (125, 1000):
        t, force, _ = found("mgmm", rate, play=PLAY)
        expected = exact[np.rint(t / at[1]).astype(int)]
        errors.append(np.sqrt(np.sum((force - expected) ** 2) / np.sum(expected**2)))
        assert np.max(np.abs(force - expected)) < 0.015 * np.max(np.abs(expected))
        assert np.all(force[np.abs(expected) > 0.02 * np.max(np.abs(expected))] != 0.0)
    # the reference itself is good to 1e-4: it meets the corners between its steps
    assert errors[0] < 4e-3 and errors[1] < 4e-4  # order 1 where the damper stops and where the pins meet


def test_rigid_rig_without_play() -> None:
    """A rig a hundred thousand times stiffer than the damper changes its force by about that share."""
    t, _, _ = found("mgmm", 250)
    force, own = force_in_series(damper("mgmm"), t, MOTION.u(t), MOTION.v(t), 1e12)
    plain = damper("mgmm").force(t, MOTION.u(t), MOTION.v(t))
    np.testing.assert_allclose(force, plain, atol=1e-4 * np.max(np.abs(plain)), rtol=0)
    np.testing.assert_allclose(own, MOTION.u(t) - force / 1e12, atol=1e-12, rtol=0)


def test_factor_and_added_force() -> None:
    """A factor on all forces is a damper with all its linear parameters times that; an added force passes through."""
    p, k = EXAMPLES["zener"], EXAMPLES["zener"]["k0"]
    t, force, own = found("zener", 250, play=PLAY, factor=np.full(round(DURATION * 250) + 1, 0.6))
    scaled = CoreDamper("zener", [0.6 * value for value in p.values()])
    expected = force_in_series(scaled, t, MOTION.u(t), MOTION.v(t), STIFFNESS, PLAY)
    np.testing.assert_allclose(force, expected[0], atol=1e-8 * np.max(np.abs(force)), rtol=0)
    np.testing.assert_allclose(own, expected[1], atol=1e-10, rtol=0)
    # held still for long, 3 kN beside it: k0 x + 3 kN = K (-x - g), x below zero
    x = -(3e3 + STIFFNESS * 0.5 * PLAY) / (STIFFNESS + k) if 3e3 > k * 0.5 * PLAY else -3e3 / k
    still = force_in_series(damper("zener"), [0.0, 1.0], [0.0, 0.0], [0.0, 0.0], STIFFNESS, PLAY, added=[3e3, 3e3])
    np.testing.assert_allclose(still[1], x, rtol=1e-6)


def test_spring_beside() -> None:
    """A spring beside a Zener model is a stiffer k0, behind a rig with play too; one that changes is not."""
    p = EXAMPLES["zener"]
    t, force, own = found("zener", 250, play=PLAY, spring=np.full(round(DURATION * 250) + 1, 0.7 * p["k0"]))
    stiffer = CoreDamper("zener", [{**p, "k0": 1.7 * p["k0"]}[name] for name in p])
    expected = force_in_series(stiffer, t, MOTION.u(t), MOTION.v(t), STIFFNESS, PLAY)
    np.testing.assert_allclose(force, expected[0], atol=1e-8 * np.max(np.abs(force)), rtol=0)
    np.testing.assert_allclose(own, expected[1], atol=1e-10, rtol=0)
    _, growing, _ = found("zener", 250, play=PLAY, spring=np.linspace(0.0, 1.4, t.size) * p["k0"])
    assert np.max(np.abs(growing - force)) > 0.05 * np.max(np.abs(force))


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"stiffness": 0.0}, "stiffness = 0"),
        ({"stiffness": np.inf}, "stiffness = inf"),
        ({"play": -1e-3}, "play = -0.001"),
        ({"factor": [1.0, -0.5, 1.0]}, "sample 2 of 3"),
        ({"added": [0.0, np.nan, 0.0]}, "sample 2 of 3"),
        ({"spring": [0.0, 0.0, -1.0]}, "sample 3 of 3"),
    ],
)
def test_refusals(options: dict, words: str) -> None:  # type: ignore[type-arg]
    values = {"stiffness": 1e7} | options
    with pytest.raises(CoreError, match=words):
        force_in_series(damper("zener"), [0.0, 0.1, 0.2], [0.0, 1e-3, 0.0], [0.0, 0.0, 0.0], **values)


def test_a_rig_that_stiffens_balances_and_closes_on_a_spring() -> None:
    # an elastic specimen k and a rig K z (1 + cubic z^2), z beyond half the play: the stretch is the root of a cubic
    k, stiffness, cubic, play = 4e6, 2e7, 1.0 / 2e-4**2, 1e-4
    t = np.linspace(0.0, 2.0, 401)
    u, v = 4e-3 * np.sin(np.pi * t), 4e-3 * np.pi * np.cos(np.pi * t)
    spring = CoreDamper("kelvin_voigt", [k, 1e-3])
    force, own = force_in_series(spring, t, u, v, stiffness, play, cubic=cubic)
    expected = np.zeros_like(u)
    for i in np.flatnonzero(np.abs(u) > play / 2):
        size = abs(u[i]) - play / 2
        roots = np.roots([stiffness * cubic, 0.0, stiffness + k, -k * size])
        z = float(roots[np.abs(roots.imag) < 1e-9 * np.abs(roots.real).max()].real[0])
        expected[i] = np.sign(u[i]) * stiffness * z * (1.0 + cubic * z**2)
    # balances are kept to 1e-8 of the largest force, 12 kN; the dashpot that the law needs, 1e-3 N s/m, gives 1e-5 N
    assert force == pytest.approx(expected, abs=1e-3)
    assert force == pytest.approx(k * own, abs=1e-3)


@pytest.mark.parametrize("power", [1.5, 4.0])
def test_bodies_in_contact_before_a_dashpot_and_a_spring(power: float) -> None:
    # k u_d + c u_d' = K e |e/e_r|^(n-1), e = u - u_d: a differential equation for the stretch by SciPy (Radau)
    k, c, stiffness, reached = 4e6, 4e5, 2e7, 5e-4
    frequency, amplitude = 2.0 * np.pi * 0.7, 6e-3

    def moves(time: np.ndarray | float) -> tuple[np.ndarray | float, np.ndarray | float]:
        return amplitude * np.sin(frequency * time), amplitude * frequency * np.cos(frequency * time)

    def carried(e: np.ndarray | float) -> np.ndarray | float:
        return stiffness * e * np.abs(e / reached) ** (power - 1.0)

    def rate(time: float, own: np.ndarray) -> np.ndarray:
        return np.asarray((carried(moves(time)[0] - own) - k * own) / c)

    t = np.linspace(0.0, 3.0, 1201)
    known = solve_ivp(rate, (0.0, 3.0), [0.0], method="Radau", t_eval=t, rtol=1e-10, atol=1e-13)
    expected = carried(moves(t)[0] - known.y[0])
    worst = []
    for every in (2, 1):
        u, v = moves(t[::every])
        force, own = force_in_series(
            CoreDamper("kelvin_voigt", (k, c)), t[::every], u, v, stiffness, cubic=1.0 / reached**2, power=power
        )
        np.testing.assert_allclose(force, carried(u - own), rtol=1e-9, atol=1e-6)
        later = t[::every] > 0.5  # at first the velocity jumps
        worst.append(float(np.max(np.abs(force - expected[::every])[later]) / np.max(np.abs(expected))))
    assert worst[1] < 1.5e-3
    assert worst[0] > 3.0 * worst[1]  # second order, as before a bare dashpot: a quarter


@pytest.mark.parametrize("given", [{"power": 0.9}, {"power": 1.5}, {"power": 1.5, "cubic": 1.0, "play": 1e-3}])
def test_a_power_is_one_or_more_and_has_a_cubic_part_and_no_play(given: dict[str, float]) -> None:
    spring = CoreDamper("kelvin_voigt", (1e6, 0.0))
    with pytest.raises(CoreError, match="power = "):
        force_in_series(spring, [0.0, 1.0], [0.0, 1e-3], [1e-3, 1e-3], 1e7, **given)
