"""Mechanical properties of a damper from its loops: storage, equivalent and loss modulus, loss factor."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from edesign.damper.testing.cycles import Block, find_blocks
from edesign.damper.testing.loops import Loops
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.specimen import Specimen
from edesign.errors import InputError

CYCLES = (5, 15)
"""First and last of the cycles that are averaged where there are so many (thesis 3.3)."""
THIRD = 3
"""Cycle from which a test with fewer is averaged: devices are judged by it, as two are of a virgin specimen."""


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


def properties(test: DamperTest, specimen: Specimen, cycles: tuple[int, int] | None = None) -> Properties:
    """Return mean properties of a test with a steady amplitude.

    Of several blocks of cycles the longest is taken.

    Args:
        test: with measured force.
        specimen: what was tested.
        cycles: first and last, from 1 at the first of full amplitude. None: `CYCLES`, or in a shorter test from the
            third one to the last.

    Raises:
        InputError: no force, or too few cycles; the message says how many there are.

    Source: thesis 3.3, Eqs. 3.1-3.4; from the third cycle: EN 15129, 6.2 and 8.2.
    """
    force = test.varying_force()
    blocks = find_blocks(test.time, test.displacement)
    if cycles is None:
        blocks = tuple(block for block in blocks if block.steady)
    longest = max(blocks, key=lambda block: block.cycles, default=None)
    there_are = 0 if longest is None else longest.cycles
    first, last = _usual(there_are) if cycles is None else checked_range(cycles)
    if longest is None or longest.cycles < last:
        raise InputError(_too_few(test, there_are, None if cycles is None else (first, last)))
    part = longest.part(first, last)
    values = _columns(_loops(test, force, specimen), part)
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
    """Return the properties of each full cycle, whatever the amplitudes.

    Args:
        test: with measured force.
        specimen: what was tested.

    Raises:
        InputError: no force, or no two half cycles of one amplitude in succession.
    """
    force = test.varying_force()
    blocks = find_blocks(test.time, test.displacement)
    if not blocks:
        raise InputError(
            f"{test.where}: there is no full cycle: no two half cycles of one amplitude in succession [E-TEST-08]"
        )
    loops = _loops(test, force, specimen)
    columns: dict[str, list[np.ndarray]] = {}
    for number, block in enumerate(blocks, 1):
        values = _columns(loops, block)
        values["block"] = np.full(block.cycles, number)
        values["cycle"] = np.arange(1, block.cycles + 1)
        for name, column in values.items():
            columns.setdefault(name, []).append(column)
    return CycleProperties(**{name: np.concatenate(parts) for name, parts in columns.items()})


def checked_range(cycles: tuple[int, int]) -> tuple[int, int]:
    """Return the first and the last cycle after a check.

    Args:
        cycles: first and last one, from 1.

    Raises:
        InputError: they are no range from 1.
    """
    first, last = cycles
    if not 1 <= first <= last:
        raise InputError(
            f"cycles: {first} to {last} is no range; cycles are counted from 1, the first stands first [E-TEST-08]"
        )
    return first, last


def _usual(found: int) -> tuple[int, int]:
    """First and last cycle that are averaged of so many."""
    return CYCLES if found >= CYCLES[1] else (THIRD, max(found, THIRD))


def _too_few(test: DamperTest, found: int, asked: tuple[int, int] | None) -> str:
    if asked is None:
        return (
            f"{test.where}: a mean takes {THIRD} successive cycles of one amplitude and period (within 5 %) at least; "
            f"there {'is' if found == 1 else 'are'} {found} [E-TEST-08]"
        )
    first, last = asked
    text = (
        f"{test.where}: cycles {first} to {last} are asked for, which takes {last} successive cycles of one amplitude "
        f"(within 5 %); there are {found}"
    )
    fewer = f"; ask for cycles {max(1, found - (last - first))} to {found}"
    by_chance = found < THIRD  # as cycles of a random history agree
    return f"{text}{'' if by_chance else fewer} [E-TEST-08]"


def _factor(loss: float, storage: float) -> float:
    """Loss factor; inf of a device that stores nothing."""
    return loss / storage if storage != 0.0 else float("inf")


def _loops(test: DamperTest, force: np.ndarray, specimen: Specimen) -> Loops:
    return Loops(test.time, specimen.strain(test.displacement), specimen.stress(force), test.where)


def _columns(loops: Loops, block: Block) -> dict[str, np.ndarray]:
    """Columns of `CycleProperties` without block and cycle, of each cycle."""
    values = loops.of(block)
    storage, loss = values.storage, values.loss  # n = ED / (2 pi ES), ES = G' amplitude^2 / 2
    return {
        "start": values.start,
        "strain": values.amplitude,
        "frequency": 1.0 / values.period,
        "G_storage": storage,
        "G_eq": values.equivalent,
        "G_loss": loss,
        "loss_factor": np.array([_factor(float(n), float(s)) for n, s in zip(loss, storage, strict=True)]),
    }
