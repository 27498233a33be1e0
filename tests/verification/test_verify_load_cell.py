"""Errors of a load cell are found alone, by its own generator: powers of the force, and a sum of play operators."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from kelvin_voigt_campaign import C, K, campaign

from edesign.calibration import calibrate
from edesign.calibration.dampers.effects.load_cell import rayleigh
from edesign.calibration.write import calibration_json

RANGE = 22e3  # N


def plays(force: np.ndarray, number: int = 400) -> np.ndarray:
    """Rayleigh's loops as a sum of play operators whose half widths are evenly spread (Prandtl and Ishlinskii)."""
    most = 1.2 * float(np.max(np.abs(force)))
    half = (np.arange(number) + 0.5) * most / number
    state, found = np.zeros(number), np.empty(force.size)
    for i, one in enumerate(force):
        state = np.clip(state, one - half, one + half)
        found[i] = 2.0 * float(np.sum(state)) * most / number
    return found


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_loops_of_any_force_are_those_of_play_operators(seed: int) -> None:
    random = np.random.default_rng(seed)
    force = np.convolve(np.cumsum(random.standard_normal(1500)), np.ones(9) / 9.0, "valid")
    force = np.round(force) if seed == 3 else force  # with values that return exactly, and rests
    expected = plays(force, 4000)
    assert np.max(np.abs(rayleigh(force) - expected)) < 1e-5 * np.max(np.abs(expected))


@pytest.mark.parametrize(
    ("label", "reads", "value"),
    [
        ("linearity.odd", lambda f: f + 0.04 * f * np.abs(f) / RANGE, 0.04),
        ("linearity.even", lambda f: f - 0.02 * f**2 / RANGE, -0.02),
        ("reversibility.rayleigh", lambda f: f + 0.03 * plays(f) / RANGE, 0.03),
    ],
    ids=["odd", "even", "hysteresis"],
)
def test_it_is_found_alone(tmp_path: Path, label: str, reads: Callable[[np.ndarray], np.ndarray], value: float) -> None:
    whole = campaign(tmp_path, lambda t, u, v, a, order: reads(K * u + C * v))
    found = calibrate(whole, threads=1)
    assert found.verdict == "explained" and [one.label for one in found.effects] == [label]
    (effect,) = found.effects
    assert effect.kind == "instrument"
    (size,) = effect.parameters.values()
    fitted = max(float(np.max(np.abs(one.measured))) for one in found.series if one.use == "fit")
    assert size.value == pytest.approx(value * fitted / RANGE, rel=0.05)
    for name, true in (("k", K), ("c", C)):
        estimate = found.parameters["corrected"][name]
        assert estimate.value == pytest.approx(true, rel=2e-3)


@pytest.mark.parametrize(("share", "label"), [(1.0, "limit.range"), (0.8, "limit.force")])
def test_a_flat_force_is_the_end_of_a_range_and_one_that_goes_on_is_a_valve(
    tmp_path: Path, share: float, label: str
) -> None:
    """Noise comes after the end, as of a converter behind an amplifier: no two samples are equal."""
    end = 14e3  # N

    def hidden(t: np.ndarray, u: np.ndarray, v: np.ndarray, a: np.ndarray, order: int) -> np.ndarray:
        force = K * u + C * v
        return force - share * (force - np.clip(force, -end, end))

    found = calibrate(campaign(tmp_path, hidden), threads=1)
    assert found.verdict == "explained" and [one.label for one in found.effects] == [label]
    (effect,) = found.effects
    assert effect.parameters["F_l"].value == pytest.approx(end, rel=2e-3)
    (written,) = calibration_json(found)["effects"]
    assert (effect.kind, bool(written["may_be"])) == (("instrument", True) if share == 1.0 else ("damper", False))
    assert share == 1.0 or effect.parameters["s"].value == pytest.approx(share, abs=0.01)
