"""When the sign of a measured force or displacement is questionable: passive devices against the same ones reversed."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.damper.history import sign_questionable

CYCLES = [0.25, 1.0, 3.0, 3.25, 10.0]
STARTS = {"at rest": 0.0, "at the largest displacement": np.pi / 2, "between": 1.0}


def motion(cycles: float, start: float) -> tuple[np.ndarray, np.ndarray]:
    """Displacement (m) and velocity (m/s) of a sine of 1 Hz and 10 mm."""
    phase = 2.0 * np.pi * np.linspace(0.0, cycles, int(400 * cycles) + 1) + start
    return 0.01 * np.sin(phase), 0.01 * 2.0 * np.pi * np.cos(phase)


def forces(u: np.ndarray, v: np.ndarray) -> dict[str, np.ndarray]:
    """Forces (N) of devices that take energy, and of a spring that gives back what it had."""
    return {
        "spring": 1e6 * u,
        "dashpot": 1e5 * v,
        "rubber": 1e6 * u + 1e6 * 0.3 / (2.0 * np.pi) * v,
        "friction": 1e4 * np.sign(v),
    }


@pytest.mark.parametrize("cycles", CYCLES)
@pytest.mark.parametrize("start", STARTS)
def test_no_sign_of_a_passive_device_is_questionable(cycles: float, start: str) -> None:
    """With a noise of the force of 2 % of its largest value, as the campaigns of the docs have."""
    u, v = motion(cycles, STARTS[start])
    for name, force in forces(u, v).items():
        noise = 0.02 * np.max(np.abs(force)) * np.random.default_rng(1).standard_normal(u.size)
        assert not sign_questionable(u, force), name
        assert not sign_questionable(u, force + noise), name


@pytest.mark.parametrize("cycles", [1.0, 3.0, 3.25, 10.0])
@pytest.mark.parametrize("start", STARTS)
def test_the_sign_of_a_reversed_channel_is_questionable(cycles: float, start: str) -> None:
    u, v = motion(cycles, STARTS[start])
    for name, force in forces(u, v).items():
        assert sign_questionable(u, -force), name
        assert sign_questionable(-u, force), name


def test_a_small_lag_of_a_channel_is_no_reversed_sign() -> None:
    """A spring whose force comes 5 ms late at 1 Hz seems to give energy: 1.8 degrees of phase."""
    phase = 2.0 * np.pi * np.linspace(0.0, 5.0, 5001)
    assert not sign_questionable(0.01 * np.sin(phase), 1e4 * np.sin(phase - 2.0 * np.pi * 0.005))


def test_nothing_is_said_of_a_force_of_zero() -> None:
    u, _ = motion(2.0, 0.0)
    assert not sign_questionable(u, np.zeros_like(u))
