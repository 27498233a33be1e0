"""Laws of springs and dashpots against their differential equations as printed, integrated by scipy; closed forms."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicHermiteSpline

from edesign.core.damper import CoreDamper
from edesign.core.errors import CoreError
from edesign.damper.damper import Damper
from edesign.damper.laws import law

K0, K1, C1, C0, LAMBDA = 3.0e6, 8.0e6, 5.0e5, 4.0e5, 0.04
BRANCHES = ((5.0e6, 2.0e3), (8.0e6, 5.0e5), (2.0e6, 9.0e6))  # relaxation times 0.4 ms, 62 ms, 4.5 s


def path(seed: int = 1) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A random smooth path, 2 s in steps of 20 ms, that starts with a velocity."""
    random = np.random.default_rng(seed)
    time = np.arange(101) * 0.02
    frequency, phase = random.uniform(0.2, 8.0, 6), random.uniform(0.0, 2.0 * np.pi, 6)
    angle = 2.0 * np.pi * np.outer(time, frequency) + phase
    u = 0.01 * (np.sin(angle) - np.sin(phase)).sum(axis=1)
    return time, u, 0.01 * (2.0 * np.pi * frequency * np.cos(angle)).sum(axis=1)


Rate = Callable[[np.ndarray, float, float], np.ndarray]


def integrate(rate: Rate, start: list[float], time: np.ndarray, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """y at the samples from y' = rate(y, u, v), (n, len(start)), the deformation as the core sees it."""
    deformation = CubicHermiteSpline(time, u, v)
    velocity = deformation.derivative()
    values = [np.array(start)]
    for begin, end in zip(time[:-1], time[1:], strict=True):
        found = solve_ivp(
            lambda t, y: rate(y, float(deformation(t)), float(velocity(t))),
            (begin, end),
            values[-1],
            method="LSODA",
            rtol=1e-11,
            atol=1e-6,
        )
        values.append(found.y[:, -1])
    return np.array(values)


def close(found: np.ndarray, expected: np.ndarray) -> None:
    """1e-9 of the largest force: the integrator's error in a hundred intervals."""
    assert np.max(np.abs(found - expected)) < 1e-9 * np.max(np.abs(expected))


def test_zener() -> None:
    """F + c1/k1 F' = k0 u + (k0 + k1) c1/k1 v."""
    time, u, v = path()
    ratio = K1 / C1
    expected = integrate(lambda force, x, speed: ratio * (K0 * x - force) + (K0 + K1) * speed, [0.0], time, u, v)
    close(CoreDamper("zener", [K0, K1, C1]).force(time, u, v), expected[:, 0])


def test_maxwell() -> None:
    """F + lambda F' = c0 v."""
    time, u, v = path(2)
    expected = integrate(lambda force, x, speed: (C0 * speed - force) / LAMBDA, [0.0], time, u, v)
    close(CoreDamper("maxwell", [C0, LAMBDA]).force(time, u, v), expected[:, 0])


def test_generalised_maxwell() -> None:
    """F = k0 u + sum F_i, F_i + c_i/k_i F_i' = c_i v; through names and defaults too."""
    time, u, v = path(3)
    k, c = np.array(BRANCHES).T
    branches = integrate(lambda force, x, speed: k * speed - k / c * force, [0.0, 0.0, 0.0], time, u, v)
    values = {"k0": K0} | {f"{key}{i}": value[i - 1] for i in (1, 2, 3) for key, value in (("k", k), ("c", c))}
    close(Damper(law("generalised_maxwell"), values).force(time, u, v), K0 * u + branches.sum(axis=1))


@pytest.mark.parametrize(
    ("name", "values", "stiffness", "damping"),
    [
        ("kelvin_voigt", [K0, C0], K0, C0),
        ("viscous", [C0], 0.0, C0),
        ("linearised", [K0, 0.15, 12.0], K0, 2.0 * 0.15 * K0 / 12.0),
    ],
)
def test_spring_beside_dashpot(name: str, values: list[float], stiffness: float, damping: float) -> None:
    time, u, v = path(4)
    close(CoreDamper(name, values).force(time, u, v), stiffness * u + damping * v)


def test_linearised_device_has_its_damping_ratio() -> None:
    """A cycle at omega takes 4 pi zeta of the strain energy (thesis Eq. 2.64)."""
    phase = np.linspace(0.0, 2.0 * np.pi, 2001)
    force = CoreDamper("linearised", [K0, 0.15, 12.0]).force(phase / 12.0, np.sin(phase), 12.0 * np.cos(phase))
    work = np.trapezoid(force * np.cos(phase), phase)
    assert work == pytest.approx(4.0 * np.pi * 0.15 * 0.5 * K0, rel=1e-9)


def test_held_from_the_beginning() -> None:
    """A first deformation was there for long: only springs push back. A first velocity meets dashpots alone at once."""
    time, u = np.array([0.0, 0.1]), np.array([0.02, 0.02])
    assert CoreDamper("zener", [K0, K1, C1]).force(time, u, 0.0 * u)[0] == pytest.approx(K0 * 0.02, rel=1e-6)
    assert CoreDamper("maxwell", [C0, LAMBDA]).force(time, u, 0.0 * u)[0] == pytest.approx(0.0, abs=1e-6 * C0)
    v = np.array([0.3, 0.3])
    assert CoreDamper("zener", [K0, K1, C1]).force(time, u, v)[0] == pytest.approx(K0 * 0.02, rel=1e-6)
    assert CoreDamper("kelvin_voigt", [K0, C0]).force(time, u, v)[0] == pytest.approx(K0 * 0.02 + C0 * 0.3, rel=1e-9)


LAWS = {
    "zener": [K0, K1, C1],
    "maxwell": [C0, LAMBDA],
    "generalised_maxwell": [K0, *(value for branch in BRANCHES for value in branch)],
    "fractional_kelvin": [K0, 0.3, 0.4],
    "fractional_zener": [K0, 0.05, 0.8, 0.6],
    "fractional_maxwell": [C0, 0.1, 0.7],
}


@pytest.mark.parametrize("name", LAWS)
def test_series_by_an_independent_integrator(name: str) -> None:
    """The same equations through SUNDIALS, at 1e-9."""
    time, u, v = (values[:26] for values in path(5))
    damper = CoreDamper(name, LAWS[name])
    exact, integrated = damper.force(time, u, v), damper.force(time, u, v, method="ode", tolerance=1e-9)
    assert np.max(np.abs(exact - integrated)) < 1e-6 * np.max(np.abs(exact))


@pytest.mark.parametrize(
    ("name", "values", "part"),
    [
        ("kelvin_voigt", [-1.0, C0], "k = -1"),
        ("kelvin_voigt", [K0, -2.0], "c = -2"),
        ("kelvin_voigt", [K0], "number of parameters = 1"),
        ("zener", [K0, 0.0, C1], "k1 = 0"),
        ("zener", [K0, K1, 0.0], "c1 = 0"),
        ("zener", [-3.0, K1, C1], "k0 = -3"),
        ("zener", [K0, 1e200, 1e-200], "relaxation rate = inf"),
        ("generalised_maxwell", [K0, K1, C1, K1], "number of parameters = 4"),
        ("generalised_maxwell", [K0, K1, C1, K1, -7.0], "c2 = -7"),
        ("generalised_maxwell", [K0] + [K1, C1] * 17, "number of parameters = 35"),
        ("viscous", [0.0], "c = 0"),
        ("maxwell", [0.0, LAMBDA], "c0 = 0"),
        ("maxwell", [C0, -0.5], "lambda = -0.5"),
        ("linearised", [0.0, 0.1, 1.0], "k_eff = 0"),
        ("linearised", [K0, -0.1, 1.0], "zeta_eff = -0.1"),
        ("linearised", [K0, 0.1, 0.0], "omega = 0"),
        ("viscous_power", [0.0, 0.5], "c = 0"),
        ("viscous_power", [C0, 2.5], "alpha = 2.5"),
    ],
)
def test_refused(name: str, values: list[float], part: str) -> None:
    with pytest.raises(CoreError, match=f"{part} .*E-CORE-02"):
        CoreDamper(name, values)
