"""What a residual may depend on: a value at each sample of a test."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from edesign.calibration.residual.motion import Motion
from edesign.calibration.residual.record import Residual

Driver = Callable[[Residual, Motion], np.ndarray]
_STILL = 0.01  # of the largest speed: no sign of the velocity below it


def _sign(test: Residual, motion: Motion) -> np.ndarray:
    speed = np.abs(test.velocity)
    return np.where(speed > _STILL * np.max(speed), np.sign(test.velocity), 0.0)


def _energy(test: Residual, motion: Motion) -> np.ndarray:
    work = 0.5 * (test.measured[1:] + test.measured[:-1]) * np.diff(test.displacement)
    return np.concatenate(([0.0], np.cumsum(work)))


def _path(test: Residual, motion: Motion) -> np.ndarray:
    return np.concatenate(([0.0], np.cumsum(np.abs(np.diff(test.displacement)))))


DRIVERS: dict[str, tuple[str, Driver]] = {
    "displacement": ("m", lambda test, motion: test.displacement),
    "velocity": ("m/s", lambda test, motion: test.velocity),
    "sign of velocity": ("", _sign),
    "cycle": ("", lambda test, motion: motion.half_cycles.number // 2 + 1.0),
    "amplitude": ("m", lambda test, motion: motion.half_cycles.amplitude),
    "frequency": ("Hz", lambda test, motion: motion.half_cycles.frequency),
    "temperature": ("degC", lambda test, motion: test.temperature),
    "dissipated energy": ("J", _energy),
    "path": ("m", _path),
    "time": ("s", lambda test, motion: test.time - test.time[0]),
    "test order": ("", lambda test, motion: np.full(test.time.size, float(test.order))),
}
"""Unit and values (n,) by name. Cycles, energy, path and time count from the beginning of each test."""
