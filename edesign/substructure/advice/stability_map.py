"""Where a substructure test is stable with each compensator: over frequency of the structure and delay of the rig."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from edesign.errors import InputError
from edesign.substructure.advice.expectation import LinearModel
from edesign.substructure.advice.transfers import CompensatorTransfer
from edesign.substructure.stability.stable_delays import stable_delays
from edesign.substructure.virtual_tests import VirtualLaboratory

RANGE = 5.0
"""Frequencies from a fifth to five times that of the test: beyond, it would be another structure."""
COLUMNS = 17
"""Frequencies, evenly spaced on a logarithmic scale: a factor of 1.22 from one to the next."""
BEYOND = 2.0
"""Largest delay of the map over the larger of the rig's and the critical one, so that both are in its lower half."""
ROUNDING = 1e-9
"""Of the height of the map, by which intervals may miss it."""


@dataclass(frozen=True)
class StableRegion:
    """Region in which the test is stable with a compensator.

    Attributes:
        compensator: its name.
        modelled_as: how the linear loop models it, in words.
        delays: of the rig, s; intervals (from, to) for each frequency of the map. They reach beyond the map by its
            height, so that lines can be drawn to its edges.
        stable: whether the test as it is does not grow in main steps; None: it has no recursion.
    """

    compensator: str
    modelled_as: str
    delays: tuple[tuple[tuple[float, float], ...], ...]
    stable: bool | None = None


@dataclass(frozen=True)
class StabilityMap:
    """Stable regions over frequency of the structure and delay of the rig.

    Masses are divided by a square, and dashpots by the number itself: so frequencies are multiplied by that number, and
    shapes, damping ratios, stiffness, and the specimen's share of it stay. The rig keeps its own lag; its pure delay
    changes. Compensators keep what they are set to, adaptive ones what they find in the test as it is.

    Attributes:
        mode: number of the mode whose frequency it is over: of the one that a delay makes grow first.
        amplitude: at which the law of the specimen is linearised, m.
        frequencies: (n,) of that mode with the specimen, Hz, rising.
        least, largest: delay of the map, s; the least is the rig's own lag, without a pure delay.
        frequency, delay: of the test as it is, Hz and s; the delay is that of slow motions.
        regions: of compensators in the order of the file.
        left_out: name and reason of those that have none.
    """

    mode: int
    amplitude: float
    frequencies: np.ndarray
    least: float
    largest: float
    frequency: float
    delay: float
    regions: tuple[StableRegion, ...]
    left_out: tuple[tuple[str, str], ...]

    def without_line(self, stable: bool) -> tuple[str, ...]:
        """Return compensators that have no line on the map, as the test is stable, or unstable, all over it.

        Args:
            stable: whether those are wanted with which the test is stable.
        """
        return tuple(one.compensator for one in self.regions if self._alike(one) is stable)

    def _alike(self, region: StableRegion) -> bool | None:
        """Say whether the test is stable all over the map; None: it is in one place and is not in another."""
        inside = [
            sum(max(min(end, self.largest) - max(begin, self.least), 0.0) for begin, end in column)
            for column in region.delays
        ]
        if not any(inside):
            return False
        height = (self.largest - self.least) * (1.0 - ROUNDING)
        return True if all(one >= height for one in inside) else None

    def is_stable(self, compensator: str) -> bool:
        """Say whether the test as it is does not grow with a compensator: in main steps, or else in its region."""
        region = next((one for one in self.regions if one.compensator == compensator), None)
        if region is None or region.stable is not None:
            return region is not None and bool(region.stable)
        column = region.delays[int(np.argmin(np.abs(self.frequencies - self.frequency)))]
        return any(begin <= self.delay <= end for begin, end in column)


def governing_map(laboratory: VirtualLaboratory, motions: Mapping[str, np.ndarray]) -> tuple[str, StabilityMap] | None:
    """Return the test whose critical delay is least, and its map; None: there is no loop, or no map of it.

    Args:
        motions: (n,) deformation of the damper in the direct analysis at main steps, m, of each test with a loop.

    Returns:
        Name of the test and its map, or None.

    Raises:
        InputError: as `stability_map`.
    """
    structure = laboratory.laboratory.structure
    if structure is None or not motions:
        return None
    models = {name: LinearModel.of(laboratory, motion, structure.part) for name, motion in motions.items()}
    name = min(models, key=lambda one: min(mode.critical_delay for mode in models[one].modes))
    found = stability_map(models[name], motions[name])
    return (name, found) if found is not None else None


def stability_map(model: LinearModel, motion: np.ndarray) -> StabilityMap | None:
    """Return where a test is stable; None: the rig itself is not, or neither it nor a critical delay says how far.

    Args:
        model: of the test, with a structure.
        motion: (n,) deformation of the damper at main steps, m; from which adaptive compensators learn.

    Raises:
        InputError: the structure is undamped or unstable.
    """
    if model.unstable_pole or model.part is None:
        return None
    modes = model.modes
    first = min(modes, key=lambda mode: mode.critical_delay)
    transfer = model.laboratory.laboratory.transfer
    present = transfer.low_frequency_delay
    least = present - transfer.delay
    critical = first.critical_delay if math.isfinite(first.critical_delay) else 0.0
    largest = BEYOND * max(present, critical)
    if largest <= max(least, 0.0):
        return None
    height = largest - least
    reach = (least - height - present, largest + height - present)
    columns = [_Column.of(model, ratio, first.number) for ratio in np.geomspace(1.0 / RANGE, RANGE, COLUMNS)]
    regions, left_out = [], []
    for name in model.laboratory.file.compensators:
        compensator = model.compensator(name, motion)
        if not compensator.settles:
            left_out.append((name, "unstable with the rig alone"))
            continue
        try:
            delays = tuple(_moved(_stable(column, name, compensator, *reach), present) for column in columns)
            sampled = model.sampled(name, compensator)
        except InputError as error:
            left_out.append((name, str(error)))
            continue
        stable = None if sampled is None else sampled.stable
        regions.append(StableRegion(name, compensator.modelled_as, delays, stable))
    return StabilityMap(
        first.number,
        model.linearisation.amplitude,
        np.array([column.frequency for column in columns]),
        least,
        largest,
        first.frequency,
        present,
        tuple(regions),
        tuple(left_out),
    )


@dataclass(frozen=True)
class _Column:
    """The structure at another frequency.

    Attributes:
        model: with it.
        frequency: of the mode that the map is over, Hz.
    """

    model: LinearModel
    frequency: float

    @classmethod
    def of(cls, model: LinearModel, ratio: float, mode: int) -> _Column:
        part = model.part
        assert part is not None
        scaled = replace(model, part=replace(part, mass=part.mass / ratio**2, damping=part.damping / ratio))
        return cls(scaled, scaled.whole.modes[mode - 1].frequency)


def _stable(
    column: _Column, name: str, compensator: CompensatorTransfer, least: float, largest: float
) -> tuple[tuple[float, float], ...]:
    """Further delays of the rig, s, at which the test is stable."""
    model = column.model
    loop = model.rig_delay_loop(name, compensator)
    return stable_delays(loop, least, largest, 0.5 / model.laboratory.file.loop.main_step)


def _moved(intervals: Sequence[tuple[float, float]], by: float) -> tuple[tuple[float, float], ...]:
    return tuple((begin + by, end + by) for begin, end in intervals)
