"""Shapes of effects that are found with their sizes: equations and motions by numpy alone, nothing of edesign.

Elastic-plastic friction, softening that fades slower than exponentially, contact with a power on both sides, a limit of
the force, a current on which yield and viscous force depend, and steel as another law. The law is a spring beside a
dashpot, declared 10 % off, where nothing else is said.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from edesign.calibration import calibrate
from edesign.calibration.results.result import Calibration
from edesign.damper.testing.campaign import load_campaign

K, C, NOISE, RATE = 4.0, 0.15, 0.05, 100.0  # kN/mm, kN s/mm, kN, Hz
TESTS = ((4.0, 0.5), (8.0, 0.5), (12.0, 0.5), (6.0, 1.0), (10.0, 1.0), (9.0, 0.8), (11.0, 0.7))  # mm, Hz
VALIDATED = 5, 6
HEAD = """\
specimen: {name: S, layers: 1, layer_area: 1000 mm^2, layer_thickness: 100 mm}
law: {type: kelvin_voigt, parameters: {k: 4.4 kN/mm, c: 0.135 kN*s/mm}}
tests:
"""
Force = Callable[[np.ndarray, np.ndarray, float], np.ndarray]
"""Force (n,) kN of a deformation mm, its velocity mm/s and the path before the test mm, at twenty steps a sample."""


def law(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    return K * u + C * v


def slides(u: np.ndarray, v: np.ndarray, gone: float) -> np.ndarray:
    """A spring of 6 kN/mm that slips at 3 kN, beside the law."""
    force = np.zeros_like(u)
    for i, du in enumerate(np.diff(u)):
        force[i + 1] = min(max(force[i] + 6.0 * du, -3.0), 3.0)
    return law(u, v) + force


def fades(u: np.ndarray, v: np.ndarray, gone: float) -> np.ndarray:
    """The damper loses 30 % of its force; that goes by Kohlrausch's function of the path, power 0.45."""
    path = gone + np.concatenate(([0.0], np.cumsum(np.abs(np.diff(u)))))
    return (0.7 + 0.3 * np.exp(-((path / 400.0) ** 0.45))) * law(u, v)


def touches(u: np.ndarray, v: np.ndarray, gone: float) -> np.ndarray:
    """Hertz beyond 5 mm to both sides."""
    return law(u, v) + 1.2 * np.maximum(np.abs(u) - 5.0, 0.0) ** 1.5 * np.sign(u)


def limited(u: np.ndarray, v: np.ndarray, gone: float) -> np.ndarray:
    """No more than 30 kN to either side."""
    return np.clip(law(u, v), -30.0, 30.0)


def limited_to_one_side(u: np.ndarray, v: np.ndarray, gone: float) -> np.ndarray:
    """No more than 30 kN of tension; beyond that a quarter is left."""
    force = law(u, v)
    return np.where(force > 30.0, 30.0 + 0.25 * (force - 30.0), force)


def steel(u: np.ndarray, v: np.ndarray, gone: float) -> np.ndarray:
    """Steel that gains 15 kN along its plastic path, and has a backstress of 30 kN (Euler's steps)."""
    p = s = x = 0.0
    force = np.zeros_like(u)
    for i, deformation in enumerate(u):
        side = 1.0 if 40.0 * (deformation - p) > x else -1.0
        over = side * (40.0 * (deformation - p) - x) - 50.0 - 15.0 * (1.0 - np.exp(-0.02 * s))
        if over > 0.0:
            way = over / (40.0 + 15.0 - side * 0.5 * x + 0.3 * np.exp(-0.02 * s))
            x, p, s = x + (side * 15.0 - 0.5 * x) * way, p + side * way, s + way
        force[i] = 40.0 * (deformation - p)
    return force


def magnetic(u: np.ndarray, v: np.ndarray, current: float) -> np.ndarray:
    """A fluid in a field: 10 kN that slip and 0.1 kN s/mm at 1.25 A, 8 kN and 0.05 kN s/mm more over 1.5 A."""
    x = (current - 1.25) / 1.5
    yields, force = 10.0 + 8.0 * x, np.zeros_like(u)
    for i, du in enumerate(np.diff(u)):
        force[i + 1] = min(max(force[i] + 2.0 * yields * du, -yields), yields)
    return force + (0.1 + 0.05 * x) * v


def calibrated(
    folder: Path, force: Force, head: str = HEAD, currents: tuple[float, ...] = (0.0,) * len(TESTS)
) -> Calibration:
    """Calibrate with tests of a force, which is given the path before or, where there are any, the current in A."""
    random, rows, gone = np.random.default_rng(7), "", 0.0
    for number, (amplitude, frequency) in enumerate(TESTS):
        t = np.arange(0.0, 10.0, 0.05 / RATE)
        w, rise = 2.0 * np.pi * frequency, 0.5 - 0.5 * np.cos(np.pi * np.clip(np.minimum(t, 10.0 - t) / 2.0, 0.0, 1.0))
        u = amplitude * rise * np.sin(w * t)
        total = force(u, np.gradient(u, t), currents[number] or gone)
        gone += float(np.sum(np.abs(np.diff(u))))
        read = total[::20] + NOISE * random.standard_normal(t[::20].size)
        lines = [f"{a:.2f},{b:.6f},{c:.6f}" for a, b, c in zip(t[::20], u[::20], read, strict=True)]
        text = "\n".join(["time_s,displacement_mm,force_kN", *lines, ""])
        (folder / f"test_{number}.csv").write_text(text, encoding="utf-8")
        use = "validate" if number in VALIDATED else "fit"
        current = f"conditions: {{I: {currents[number]}}}"
        rows += f"  - {{file: test_{number}.csv, temperature: 20 degC, use: {use}, {current}}}\n"
    path = folder / "campaign.yaml"
    path.write_text(head + rows, encoding="utf-8")
    return calibrate(load_campaign(path), threads=1)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("force", "name", "sizes"),
    [
        (slides, "friction", {"F_c": (3e3, 0.03), "x0": (0.5e-3, 0.1)}),
        (fades, "degradation", {"d": (0.3, 0.05), "s0": (0.4, 0.1), "q": (0.45, 0.05)}),
        (touches, "hardening", {"u0": (5e-3, 0.1), "n": (1.5, 0.1)}),
        (limited, "limit", {"F_l": (30e3, 0.01)}),
        (limited_to_one_side, "limit", {"s": (0.75, 0.03), "F_l": (30e3, 0.01)}),
    ],
)
def test_a_shape_is_found_alone_with_its_size(
    tmp_path: Path, force: Force, name: str, sizes: dict[str, tuple[float, float]]
) -> None:
    found = calibrated(tmp_path, force)
    assert [effect.name for effect in found.effects] == [name] and found.verdict == "explained"
    values = found.effects[0].parameters
    for parameter, (true, share) in sizes.items():
        assert values[parameter].value == pytest.approx(true, rel=share)
    law_now = found.parameters["corrected"]
    assert law_now["k"].value == pytest.approx(1e6 * K, rel=0.03) and law_now["c"].value == pytest.approx(
        1e6 * C, rel=0.03
    )


@pytest.mark.slow
def test_steel_that_hardens_in_both_ways_is_another_law_than_the_declared_one(tmp_path: Path) -> None:
    """Each test has a fresh specimen in the law's equation: it begins without a past."""
    declared = HEAD.replace(
        "kelvin_voigt, parameters: {k: 4.4 kN/mm, c: 0.135 kN*s/mm}",
        "elastic_plastic, parameters: {k: 38 kN/mm, Fy: 70 kN, b: 0.02}",
    )
    found = calibrated(tmp_path, steel, declared)
    assert found.other_law is not None and found.other_law.law == "chaboche"


@pytest.mark.slow
def test_yield_and_viscous_force_go_with_a_current_each_by_its_own_share(tmp_path: Path) -> None:
    declared = HEAD.replace(
        "kelvin_voigt, parameters: {k: 4.4 kN/mm, c: 0.135 kN*s/mm}",
        "elastic_plastic, parameters: {k: 18 kN/mm, Fy: 11 kN, b: 0.001}",
    )
    currents = 0.5, 1.0, 1.5, 2.0, 0.8, 1.2, 1.8
    found = calibrated(tmp_path, magnetic, declared, currents)
    assert [effect.label for effect in found.effects] == ["condition.factor_and_dashpot_of_I"]
    assert found.verdict == "explained"
    away = (np.mean(currents[:5]) - 1.25) / 1.5  # of the tests fitted to, whose range is 1.5 A too
    values = {name: one.value for name, one in found.effects[0].parameters.items()}
    assert values["b"] == pytest.approx(8.0 / (10.0 + 8.0 * away), rel=0.01)
    assert values["b_v"] == pytest.approx(0.05 / (0.1 + 0.05 * away), rel=0.02) and values["alpha"] == pytest.approx(
        1.0, abs=0.02
    )
    assert [one.label for one in found.law_file.effects] == ["velocity_exponent.dashpot"]
