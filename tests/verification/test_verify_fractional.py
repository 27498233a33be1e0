"""Laws with fractional derivatives against their defining equations.

D^alpha is (i omega)^alpha, or s^alpha under the Laplace transform, which is inverted along a contour in the
complex plane. There are closed forms for powers of time and for alpha = 1/2.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.special import erfcx, gamma

from edesign.core.damper import CoreDamper
from edesign.core.errors import CoreError
from edesign.damper.damper import Damper
from edesign.damper.laws import law
from edesign.errors import InputError

K0, A, B, C = 2.0e6, 0.05, 0.8, 0.3
ORDERS = (0.1, 0.3, 0.5, 0.7, 0.9)
TIMES = np.logspace(-3.0, 2.0, 41)
FREQUENCIES = np.logspace(-2.0, np.log10(50.0), 25)

# Documented accuracy of the series: relaxation and ramps 1e-3, complex modulus 1e-4.
IN_TIME, IN_FREQUENCY = 1e-3, 1e-4

Modulus = Callable[[np.ndarray], np.ndarray]


def kelvin(order: float) -> tuple[CoreDamper, Modulus]:
    return CoreDamper("fractional_kelvin", [K0, C, order]), lambda s: K0 * (1.0 + C * s**order)


def zener(order: float) -> tuple[CoreDamper, Modulus]:
    return CoreDamper("fractional_zener", [K0, A, B, order]), lambda s: K0 * (1.0 + B * s**order) / (1.0 + A * s**order)


def maxwell(order: float) -> tuple[CoreDamper, Modulus]:
    return CoreDamper("fractional_maxwell", [K0, A, order]), lambda s: K0 * s / (1.0 + A * s**order)


every_law = pytest.mark.parametrize("make", [kelvin, zener, maxwell])
every_order = pytest.mark.parametrize("order", ORDERS)


def inverse_laplace(transform: Modulus, time: np.ndarray) -> np.ndarray:
    """f(t) by the midpoint rule on Talbot's contour (Trefethen, Weideman & Schmelzer 2006); 20 points."""
    n = 20
    angle = np.pi * (np.arange(n) * 2.0 + 1.0 - n) / n
    path = n * (0.5017 * angle / np.tan(0.6407 * angle) - 0.6122 + 0.2645j * angle)
    slope = n * (0.5017 / np.tan(0.6407 * angle) - 0.5017 * 0.6407 * angle / np.sin(0.6407 * angle) ** 2 + 0.2645j)
    s = path / time[:, None]
    return ((np.exp(path) * transform(s) * slope).sum(axis=1) / (1j * n)).real / time


def relaxation(damper: CoreDamper, time: np.ndarray) -> np.ndarray:
    """Force per deformation at times after a step: a ramp of 1e-6 s, the time from its middle."""
    ramp, size = 1e-6, 1e-3
    after, *_ = damper.step(damper.start(), ramp, (0.0, size / ramp), (size, size / ramp))
    return np.array([damper.step(after, t - 0.5 * ramp, (size, 0.0), (size, 0.0))[1] for t in time]) / size


def ramp_response(damper: CoreDamper, time: np.ndarray) -> np.ndarray:
    """Force under a constant velocity of 1, in one step from rest."""
    return np.array([damper.step(damper.start(), t, (0.0, 1.0), (t, 1.0))[1] for t in time])


def complex_modulus(damper: CoreDamper, frequency: float) -> complex:
    """First harmonic of the force over that of the deformation in steady cycles, 64 cubics a cycle (2e-7 off a sine).

    The equations are linear and diagonal: the factor by which a held state falls in a period shows what repeats.
    """
    period, n = 1.0 / frequency, 64
    phase = 2.0 * np.pi * np.arange(n + 1) / n
    u, v = np.sin(phase), 2.0 * np.pi * frequency * np.cos(phase)
    kept, *_ = damper.step(np.ones_like(damper.start()), period, (0.0, 0.0), (0.0, 0.0))
    state, force = damper.start(), np.zeros(n)
    for cycle in range(2):
        for i in range(n):
            state, force[i], _ = damper.step(state, period / n, (u[i], v[i]), (u[i + 1], v[i + 1]))
        if cycle == 0:
            state = state / np.where(kept < 1.0, 1.0 - kept, 1.0)  # what never falls is back at 0 by itself
    return complex(2.0j * np.mean(force * np.exp(-1j * phase[1:])))


def test_inverse_laplace() -> None:
    """The reference itself: E_1/2(-sqrt(t) / a) = exp(t / a^2) erfc(sqrt(t) / a), and powers of time."""
    root = np.sqrt(TIMES) / A
    found = inverse_laplace(lambda s: A * s**-0.5 / (1.0 + A * s**0.5), TIMES)
    np.testing.assert_allclose(found, erfcx(root), rtol=1e-9)
    np.testing.assert_allclose(inverse_laplace(lambda s: s**-0.7, TIMES), TIMES**-0.3 / gamma(0.7), rtol=1e-9)


@every_law
@every_order
def test_relaxation(make: Callable[[float], tuple[CoreDamper, Modulus]], order: float) -> None:
    damper, modulus = make(order)
    expected = inverse_laplace(lambda s: modulus(s) / s, TIMES)
    # relative to the modulus then, or to 1e-6 of the largest where hardly anything is left (Maxwell, order 0.9)
    allowed = IN_TIME * (expected + 1e-6 * expected.max())
    assert np.all(np.abs(relaxation(damper, TIMES) - expected) <= allowed)


@every_law
@every_order
def test_ramp(make: Callable[[float], tuple[CoreDamper, Modulus]], order: float) -> None:
    damper, modulus = make(order)
    expected = inverse_laplace(lambda s: modulus(s) / s**2, TIMES)
    np.testing.assert_allclose(ramp_response(damper, TIMES), expected, rtol=IN_TIME)


@every_law
@every_order
def test_complex_modulus(make: Callable[[float], tuple[CoreDamper, Modulus]], order: float) -> None:
    damper, modulus = make(order)
    found = np.array([complex_modulus(damper, frequency) for frequency in FREQUENCIES])
    expected = modulus(2j * np.pi * FREQUENCIES)
    assert np.max(np.abs(found / expected - 1.0)) < IN_FREQUENCY


def test_half_order_in_closed_form() -> None:
    """E_1/2 is an error function; its derivative and integral are too (Abramowitz & Stegun 7.1)."""
    rate = 1.0 / A
    fading = erfcx(rate * np.sqrt(TIMES))
    slope = rate / np.sqrt(np.pi * TIMES) - rate**2 * fading
    np.testing.assert_allclose(relaxation(zener(0.5)[0], TIMES), K0 * (1.0 + (B / A - 1.0) * fading), rtol=IN_TIME)
    np.testing.assert_allclose(relaxation(maxwell(0.5)[0], TIMES), K0 * slope, rtol=IN_TIME)
    integral = (fading - 1.0) / rate**2 + 2.0 * np.sqrt(TIMES / np.pi) / rate
    expected = K0 * (TIMES + (B / A - 1.0) * integral)
    np.testing.assert_allclose(ramp_response(zener(0.5)[0], TIMES), expected, rtol=IN_TIME)
    np.testing.assert_allclose(ramp_response(maxwell(0.5)[0], TIMES), K0 * (1.0 - fading), rtol=IN_TIME)


@every_order
@pytest.mark.parametrize("power", [1, 2, 3])
def test_powers_of_time(order: float, power: int) -> None:
    """D^alpha t^n = n! t^(n - alpha) / Gamma(n + 1 - alpha); the path is exact, in steps of 10 ms."""
    damper = kelvin(order)[0]
    time = np.linspace(0.0, 2.0, 201)
    found = damper.force(time, time**power, power * time ** (power - 1))
    expected = K0 * (time**power + C * gamma(power + 1) / gamma(power + 1 - order) * time ** (power - order))
    np.testing.assert_allclose(found[1:], expected[1:], rtol=IN_TIME)


@every_law
@pytest.mark.parametrize("order", [1e-3, *ORDERS, 0.999])
def test_no_energy_out_of_nothing(make: Callable[[float], tuple[CoreDamper, Modulus]], order: float) -> None:
    """Work from rest is never negative: a completely monotone modulus is passive, however inexact the series is."""
    random = np.random.default_rng(4)
    time = np.linspace(0.0, 20.0, 2001)
    frequency, phase = random.uniform(0.02, 8.0, 12), random.uniform(0.0, 2.0 * np.pi, 12)
    angle = 2.0 * np.pi * np.outer(time, frequency) + phase
    u = (np.sin(angle) - np.sin(phase)).sum(axis=1) * 1e-3
    v = (2.0 * np.pi * frequency * np.cos(angle)).sum(axis=1) * 1e-3
    power = make(order)[0].force(time, u, v) * v
    work = np.concatenate([[0.0], np.cumsum(0.5 * (power[1:] + power[:-1]))]) * 0.01
    assert work.max() > 0.0
    assert work.min() >= -1e-6 * work.max()  # the trapezoids of the first steps


@pytest.mark.parametrize("order", [0.3, 0.7])
@pytest.mark.parametrize(("make", "left"), [(kelvin, K0), (zener, K0), (maxwell, 0.0)])
def test_nothing_is_left_after_long(
    make: Callable[[float], tuple[CoreDamper, Modulus]], left: float, order: float
) -> None:
    damper, size = make(order)[0], 0.01
    force = damper.step(damper.start(), 1e8, (0.0, 0.0), (size, 0.0))[1]
    assert force == pytest.approx(left * size, abs=1e-3 * K0 * size)


def smooth() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    time = np.arange(2001) * 0.002
    return time, 0.01 * np.sin(6.0 * time) ** 2, 0.06 * np.sin(12.0 * time)


def close(found: np.ndarray, expected: np.ndarray) -> None:
    assert np.max(np.abs(found - expected)) < 1e-3 * np.max(np.abs(expected))


def test_orders_near_one_and_zero() -> None:
    """Near order 1 the laws with whole derivatives, near 0 springs (and c0 / (1 + lambda) as a dashpot)."""
    path = smooth()
    one, zero = 1.0 - 1e-5, 1e-5
    close(kelvin(one)[0].force(*path), CoreDamper("kelvin_voigt", [K0, K0 * C]).force(*path))
    branch = K0 * (B / A - 1.0)
    close(zener(one)[0].force(*path), CoreDamper("zener", [K0, branch, branch * A]).force(*path))
    close(maxwell(one)[0].force(*path), CoreDamper("maxwell", [K0, A]).force(*path))
    close(kelvin(zero)[0].force(*path), K0 * (1.0 + C) * path[1])
    close(zener(zero)[0].force(*path), K0 * (1.0 + B) / (1.0 + A) * path[1])
    close(maxwell(zero)[0].force(*path), K0 / (1.0 + A) * path[2])


@every_law
@pytest.mark.parametrize("order", [5e-324, 1e-20, 1e-16, 1e-15, 3e-15, 1e-14, 1e-13, 1e-10, 1e-6, 1e-3])
def test_orders_down_to_the_least_double(make: Callable[[float], tuple[CoreDamper, Modulus]], order: float) -> None:
    """The modulus of the equation, whose limit for order 0 is a spring (of the Maxwell law a dashpot)."""
    damper, modulus = make(order)
    found = np.array([complex_modulus(damper, frequency) for frequency in FREQUENCIES])
    expected = modulus(2j * np.pi * FREQUENCIES)
    assert (
        np.max(np.abs(found / expected - 1.0)) < 1e-6
    )  # 64 cubics a cycle are 2e-7 off; the series by 1e-4 of the order


@every_law
@pytest.mark.parametrize("less", [1e-3, 1e-6, 1e-10, 1e-13, 2.0**-53])
def test_orders_up_to_the_last_double_below_one(
    make: Callable[[float], tuple[CoreDamper, Modulus]], less: float
) -> None:
    damper, modulus = make(1.0 - less)
    found = np.array([complex_modulus(damper, frequency) for frequency in FREQUENCIES])
    expected = modulus(2j * np.pi * FREQUENCIES)
    assert np.max(np.abs(found / expected - 1.0)) < IN_FREQUENCY


@pytest.mark.parametrize("b", [0.5, 0.4])
def test_active_law_is_refused(b: float) -> None:
    """(1 + b z) / (1 + a z) has a negative loss modulus for b < a (Bagley & Torvik 1986)."""
    with pytest.raises(CoreError, match=f"b = {b:g} .* above a, .*E-CORE-02"):
        _ = Damper(law("fractional_zener"), {"k0": K0, "a": 0.5, "b": b, "alpha": 0.5}).core


@pytest.mark.parametrize("order", [0.0, 1.0, -0.5, 1.5])
@pytest.mark.parametrize(
    ("name", "others", "key"),
    [
        ("fractional_kelvin", [K0, C], "alpha"),
        ("fractional_zener", [K0, A, B], "alpha"),
        ("fractional_maxwell", [K0, A], "nu"),
    ],
)
def test_order_outside_is_refused(name: str, others: list[float], key: str, order: float) -> None:
    with pytest.raises(CoreError, match=f"{key} = {order:g} .*E-CORE-02"):
        CoreDamper(name, [*others, order])
    names = [parameter.name for parameter in law(name).parameters]
    with pytest.raises(InputError, match=f"{key} = {order:g} .*E-LAW-03"):
        Damper(law(name), dict(zip(names, [*others, order], strict=True)))
