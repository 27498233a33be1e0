"""Displacement histories that a rig is commanded to follow, with their velocity and acceleration."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import scipy

from edesign.damper.testing import signals
from edesign.damper.testing.measured_files import read_displacement
from edesign.errors import InputError
from edesign.project.substructure.checks_tests import MOST_STEPS
from edesign.project.substructure.programme import Command, CommandInFile, RandomCommand, SineCommand

REST = 1.0
"""Between sines that are not joined, s: the longest memory of the rigs, filters and windows of a file by default."""


def command_motion(command: Command, step: float, folder: Path) -> np.ndarray:
    """Return displacement (m), velocity and acceleration at main steps, (n, 3).

    Derivatives are those of the sines, or of the cubic spline through the samples.

    Args:
        step: main step, s.
        folder: that a CSV file is relative to.

    Raises:
        InputError: the command cannot be made, its file cannot be read, or the file does not begin at rest.
    """
    if isinstance(command, SineCommand):
        return _sines(command, step)
    if isinstance(command, RandomCommand):
        _, u = signals.random(
            command.duration, command.band, command.seed, peak=command.displacement, sampling_rate=1.0 / step
        )
        return _differentiated(u, step)
    if isinstance(command, CommandInFile):
        t, given = read_displacement(folder / command.file)
        if t[-1] - t[0] > MOST_STEPS * step:
            raise InputError(
                f"{folder / command.file}: {t[-1] - t[0]:.4g} s are more than {MOST_STEPS} main steps of "
                f"{1e3 * step:.4g} ms; is the unit of the time right? [E-RTS-01]"
            )
        times = np.arange(0.0, t[-1] - t[0] + 0.5 * step, step)
        u = scipy.interpolate.CubicSpline(t - t[0], given)(np.minimum(times, t[-1] - t[0]))
        if command.displacement is not None:
            u *= command.displacement / np.max(np.abs(u))
        _begins_at_rest(u, folder / command.file)
        return _differentiated(u, step)
    t = np.arange(0.0, command.duration + 0.5 * step, step)
    low, high = command.band
    rate = (high - low) / command.duration  # of the frequency, Hz/s
    phase = 2.0 * np.pi * (low * t + 0.5 * rate * t**2)
    omega = 2.0 * np.pi * (low + rate * t)
    return command.displacement * np.column_stack(
        [np.sin(phase), omega * np.cos(phase), 2.0 * np.pi * rate * np.cos(phase) - omega**2 * np.sin(phase)]
    )


def _begins_at_rest(u: np.ndarray, path: Path) -> None:
    """Refuse a command that would make the rig, which rests at 0, jump faster than the command itself ever moves."""
    fastest = float(np.max(np.abs(np.diff(u)), initial=0.0))
    if abs(u[0]) > fastest:
        raise InputError(
            f"{path}: the command begins at {1e3 * u[0]:.4g} mm, and the rig at 0: it would jump there in one main "
            f"step, in which the command itself moves {1e3 * fastest:.3g} mm at most; let the file begin at rest, by a "
            "ramp from 0 [E-RTS-02]"
        )


def _sines(command: SineCommand, step: float) -> np.ndarray:
    pieces = [np.zeros((1, 3))]
    for i, frequency in enumerate(command.frequency):
        if i > 0 and not command.joined:
            pieces.append(np.zeros((round(REST / step), 3)))
        count = round(command.cycles / frequency / step)
        omega = 2.0 * np.pi * command.cycles / (count * step)  # whole steps in all cycles together
        phase = omega * step * np.arange(1, count + 1)
        pieces.append(np.column_stack([np.sin(phase), omega * np.cos(phase), -(omega**2) * np.sin(phase)]))
    return command.displacement * np.concatenate(pieces)


def _differentiated(u: np.ndarray, step: float) -> np.ndarray:
    spline = scipy.interpolate.CubicSpline(step * np.arange(u.size), u)
    t = step * np.arange(u.size)
    return np.column_stack([u, spline(t, 1), spline(t, 2)])
