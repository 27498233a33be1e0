"""Mechanical properties of a damper from its loops: storage, equivalent and loss modulus, loss factor."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from edesign.damper.cycles import Block, find_blocks
from edesign.damper.history import spline_velocity
from edesign.damper.local_fit import noise, peak, value_at_reversal
from edesign.damper.measured_histories import DamperTest
from edesign.damper.specimen import Specimen
from edesign.errors import InputError

CYCLES = (5, 15)
"""First and last of the cycles that are averaged (thesis 3.3)."""
LEAST_SAMPLES = 12  # a cycle


@dataclass(frozen=True)
class Properties:
    """Mean properties over cycles of one amplitude.

    Attributes:
        strain: amplitude of the shear strain.
        frequency: Hz.
        temperature_C: ambient.
        G_storage: G', Pa.
        G_eq: equivalent shear modulus, Pa.
        G_loss: G'' = n G', Pa.
        loss_factor: n; inf if nothing is stored.
        cycles: first and last of the cycles, from 1 at the first of full amplitude.
    """

    strain: float
    frequency: float
    temperature_C: float
    G_storage: float
    G_eq: float
    G_loss: float
    loss_factor: float
    cycles: tuple[int, int]


@dataclass(frozen=True)
class CycleProperties:
    """Properties of each full cycle of a test, (n,) each.

    Attributes:
        block: from 1; cycles of one amplitude in succession are a block.
        cycle: from 1 in each block.
        start: s.
        strain, frequency, G_storage, G_eq, G_loss, loss_factor: as in `Properties`.
    """

    block: np.ndarray
    cycle: np.ndarray
    start: np.ndarray
    strain: np.ndarray
    frequency: np.ndarray
    G_storage: np.ndarray
    G_eq: np.ndarray
    G_loss: np.ndarray
    loss_factor: np.ndarray


def properties(test: DamperTest, specimen: Specimen, cycles: tuple[int, int] = CYCLES) -> Properties:
    """Mean properties of a test with a steady amplitude.

    Of several blocks of cycles the longest is taken.

    Args:
        test: with measured force.
        specimen: what was tested.
        cycles: first and last, from 1 at the first of full amplitude.

    Raises:
        InputError: no force, or too few cycles; the message says how many there are.

    Source: thesis 3.3, Eqs. 3.1-3.4.
    """
    first, last = checked_range(cycles)
    force = test.varying_force()
    blocks = find_blocks(test.time, test.displacement)
    longest = max(blocks, key=lambda block: block.cycles, default=None)
    if longest is None or longest.cycles < last:
        raise InputError(_too_few(test, 0 if longest is None else longest.cycles, first, last))
    part = Block(longest.bounds[first - 1 : last + 1], longest.amplitude, longest.rising)
    values = _Loops(test, force, specimen).of(part)
    storage, equivalent, loss = (float(np.mean(values[name])) for name in ("G_storage", "G_eq", "G_loss"))
    return Properties(
        float(np.mean(values["strain"])),
        float(part.cycles / (part.bounds[-1] - part.bounds[0])),
        test.temperature_C,
        storage,
        equivalent,
        loss,
        _factor(loss, storage),
        (first, last),
    )


def cycle_properties(test: DamperTest, specimen: Specimen) -> CycleProperties:
    """Properties of each full cycle, whatever the amplitudes.

    Args:
        test: with measured force.
        specimen: what was tested.

    Raises:
        InputError: no force, or no two half cycles of one amplitude in succession.
    """
    force = test.varying_force()
    blocks = find_blocks(test.time, test.displacement)
    if not blocks:
        raise InputError(f"{test.where}: there is no full cycle: no two half cycles of one amplitude in succession")
    loops = _Loops(test, force, specimen)
    columns: dict[str, list[np.ndarray]] = {}
    for number, block in enumerate(blocks, 1):
        values = loops.of(block)
        values["block"] = np.full(block.cycles, number)
        values["cycle"] = np.arange(1, block.cycles + 1)
        for name, column in values.items():
            columns.setdefault(name, []).append(column)
    return CycleProperties(**{name: np.concatenate(parts) for name, parts in columns.items()})


def checked_range(cycles: tuple[int, int]) -> tuple[int, int]:
    """First and last cycle.

    Raises:
        InputError: they are no range from 1.
    """
    first, last = cycles
    if not 1 <= first <= last:
        raise InputError(f"cycles: {first} to {last} is no range; cycles are counted from 1, the first stands first")
    return first, last


def _too_few(test: DamperTest, found: int, first: int, last: int) -> str:
    text = (
        f"{test.where}: cycles {first} to {last} are asked for, which takes {last} successive cycles of one amplitude "
        f"(within 5 %); there are {found}"
    )
    few = 3  # fewer agree by chance in a random history
    return f"{text}; ask for cycles {max(1, found - (last - first))} to {found}" if found >= few else text


def _factor(loss: float, storage: float) -> float:
    """Loss factor; inf of a device that stores nothing."""
    return loss / storage if storage != 0.0 else float("inf")


class _Loops:
    """Loops of one test."""

    def __init__(self, test: DamperTest, force: np.ndarray, specimen: Specimen) -> None:
        self.time, self.where = test.time, test.where
        self.strain, self.stress = specimen.strain(test.displacement), specimen.stress(force)
        self.strain_noise, self.stress_noise = noise(self.strain), noise(self.stress)
        # area of a loop: of the spline through stress times strain rate, so that cycles may begin between samples
        rate = spline_velocity(self.time, self.strain)
        self.work = scipy.interpolate.CubicSpline(self.time, self.stress * rate).antiderivative()

    def of(self, block: Block) -> dict[str, np.ndarray]:
        """Columns of `CycleProperties` without block and cycle, of each cycle."""
        rows = [self._cycle(*block.bounds[i : i + 2]) for i in range(block.cycles)]
        return {name: np.array([row[name] for row in rows]) for name in rows[0]}

    def _cycle(self, start: float, end: float) -> dict[str, float]:
        inside = slice(int(np.searchsorted(self.time, start)), int(np.searchsorted(self.time, end)))
        if inside.stop - inside.start < LEAST_SAMPLES:
            raise InputError(
                f"{self.where}: the cycle at {start:g} s has {inside.stop - inside.start} samples; "
                f"at least {LEAST_SAMPLES} are needed"
            )
        omega, bounds = 2.0 * np.pi / (end - start), (start, end)
        t, gamma, tau = self.time, self.strain, self.stress
        high, low = (self._extreme(sign * gamma, inside, omega, bounds, self.strain_noise) for sign in (1.0, -1.0))
        at_high, at_low = (value_at_reversal(t, tau, e[0], omega, self.stress_noise).value for e in (high, low))
        largest, smallest = (self._extreme(s * tau, inside, omega, None, self.stress_noise)[1] for s in (1.0, -1.0))
        span = high[1] + low[1]  # gamma_max - gamma_min: the low one is that of -gamma
        storage = (at_high - at_low) / span
        dissipated = float(self.work(end) - self.work(start))
        amplitude = 0.5 * span
        loss = dissipated / (np.pi * amplitude**2)  # = n G' with n = ED / (2 pi ES), ES = G' amplitude^2 / 2
        return {
            "start": start,
            "strain": amplitude,
            "frequency": 1.0 / (end - start),
            "G_storage": storage,
            "G_eq": (largest + smallest) / span,
            "G_loss": loss,
            "loss_factor": _factor(loss, storage),
        }

    def _extreme(
        self, values: np.ndarray, inside: slice, omega: float, within: tuple[float, float] | None, spread: float
    ) -> tuple[float, float]:
        at = float(self.time[inside.start + int(np.argmax(values[inside]))])
        found = peak(self.time, values, at, omega, within or (-np.inf, np.inf), spread)
        return found.time, found.value
