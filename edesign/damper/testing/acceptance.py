"""Acceptance of devices by their tests: criteria of ASCE/SEI 7, EN 15129 and NTC 2018 on the cycles of each run.

The limits are those of the standards as the project knows them; a laboratory may set its own in `acceptance`. Which of
them were compared with a text is said in docs/how_to/damper_tests.md.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from edesign.damper.testing.device_cycles import LEAST_CYCLES, Run
from edesign.project.notation.units import PositiveRatio
from edesign.project.reading.base import Model

Device = Literal["viscous", "viscoelastic", "hysteretic", "elastomeric_isolator"]
Standard = Literal["asce_7", "en_15129", "ntc_2018"]
STANDARDS: dict[Standard, str] = {"asce_7": "ASCE/SEI 7-16", "en_15129": "EN 15129", "ntc_2018": "NTC 2018"}
Reference = Literal["mean", "third", "first", "least", "design"]
"""What values of cycles are compared with: the mean of the run, its third or first cycle, the largest of its values
(so that the least is a share of it), or what the law of the campaign gives in the same motion."""

GIVES_ENERGY = "W is below zero, as of no damper; is the sign of force or displacement reversed (key `reversed`)?"
"""Why no criterion judges a run: its cycles may agree with each other as well as those of a good damper."""

_LEAST = 1e-3  # of the largest force: a force at zero displacement below it is what noise leaves of an elastic device


class Acceptance(Model):
    """Limits by which a device is accepted.

    Attributes:
        device: kind of the device, which decides on the clauses.
        standards: standards that are applied.
        from_mean: deviation of a cycle from the mean of its test that is allowed, ASCE 7.
        from_third: deviation of a cycle from the third one that is allowed, EN 15129 and NTC 2018.
        from_first: change from the first cycle that is allowed, isolators by ASCE 7.
        from_design: deviation from the law of the campaign that is allowed, EN 15129 and NTC 2018; without the key 20 %
            for isolators, 15 % for all else, but 10 % for the damping of hysteretic devices by NTC 2018.
        least_share: least value over the largest one, from the second cycle to the tenth, isolators by EN 15129.
    """

    device: Device = "viscoelastic"
    standards: Annotated[tuple[Standard, ...], Field(min_length=1)] = ("asce_7", "en_15129")
    from_mean: PositiveRatio = 0.15
    from_third: PositiveRatio = 0.10
    from_first: PositiveRatio = 0.20
    from_design: PositiveRatio | None = None
    least_share: PositiveRatio = 0.70

    @property
    def from_third_by(self) -> tuple[str, ...]:
        """Standards with the clauses that compare cycles with the third one, of this device."""
        found = (one for one in self.criteria if one.reference == "third")
        return tuple(dict.fromkeys(f"{STANDARDS[one.standard]}, {one.clause}" for one in found))

    @property
    def criteria(self) -> tuple[AcceptanceCriterion, ...]:
        """Criteria that are applied, in the order of the standards."""
        makers: dict[Standard, Callable[[Acceptance], list[AcceptanceCriterion]]] = {
            "asce_7": _asce,
            "en_15129": _en,
            "ntc_2018": _ntc,
        }
        return tuple(criterion for standard in self.standards for criterion in makers[standard](self))


@dataclass(frozen=True)
class Quantity:
    """Quantity of a cycle that is compared: its name for people, and its value in each cycle of a run (n,), SI."""

    name: str
    of: Callable[[Run], np.ndarray]


STIFFNESS = Quantity("effective stiffness k'", lambda run: run.storage_stiffness)
DAMPING = Quantity("effective damping xi", lambda run: run.damping_ratio)
ENERGY = Quantity("energy of a cycle W", lambda run: run.loops.work)
PEAKS = (
    Quantity("largest force", lambda run: run.loops.largest),
    Quantity("smallest force", lambda run: run.loops.smallest),
)
AT_ZERO = (
    Quantity("largest force at zero displacement", lambda run: run.loops.at_zero_rising),
    Quantity("smallest force at zero displacement", lambda run: run.loops.at_zero_falling),
)
AT_EXTREMES = (
    Quantity("force at the largest displacement", lambda run: run.loops.at_highest),
    Quantity("force at the smallest displacement", lambda run: run.loops.at_lowest),
)


@dataclass(frozen=True)
class AcceptanceCriterion:
    """A limit on a quantity.

    Attributes:
        standard, clause: where it stands.
        quantity: what is limited.
        reference: what each cycle is compared with.
        limit: of the deviation, or of the least share.
        cycles: first and last cycle that count, from 1; the last one at most.
        fall_only: whether the quantity may rise by any amount.
    """

    standard: Standard
    clause: str
    quantity: Quantity
    reference: Reference
    limit: float
    cycles: tuple[int, int] = (1, 10**6)
    fall_only: bool = False


@dataclass(frozen=True)
class Judged:
    """A criterion on a run.

    Attributes:
        run: the run.
        criterion: the criterion.
        cycle: the worst, from 1; None: it was not judged.
        value: deviation of that cycle, or its share; nan: it was not judged.
        met: whether the criterion is met; None: it was not judged.
        why: it was not.
    """

    run: Run
    criterion: AcceptanceCriterion
    cycle: int | None
    value: float
    met: bool | None
    why: str = ""


def _asce(asked: Acceptance) -> list[AcceptanceCriterion]:
    """Device adequacy of ASCE/SEI 7-16: 18.6.1.4 of dampers, 17.8.4 of isolators."""
    limit = asked.from_mean
    if asked.device == "elastomeric_isolator":
        return [
            AcceptanceCriterion("asce_7", "17.8.4", STIFFNESS, "first", asked.from_first),
            AcceptanceCriterion("asce_7", "17.8.4", DAMPING, "first", asked.from_first, fall_only=True),
        ]
    quantities = {
        "viscous": (*AT_ZERO, ENERGY),
        "viscoelastic": (STIFFNESS, *AT_ZERO, ENERGY),
        "hysteretic": (*AT_ZERO, *AT_EXTREMES, ENERGY),
    }[asked.device]
    return [AcceptanceCriterion("asce_7", "18.6.1.4", quantity, "mean", limit) for quantity in quantities]


def _en(asked: Acceptance) -> list[AcceptanceCriterion]:
    """EN 15129: clause 6 of displacement dependent devices, 7 of velocity dependent ones, 8.2 of isolators."""
    isolator = asked.device == "elastomeric_isolator"
    design = asked.from_design or (0.20 if isolator else 0.15)
    if asked.device == "viscous":
        return [
            AcceptanceCriterion("en_15129", "7", one, "design", design, (LEAST_CYCLES,) * 2) for one in (*PEAKS, ENERGY)
        ]
    clause = "8.2" if isolator else "6"
    criteria = [
        AcceptanceCriterion("en_15129", clause, one, "design", design, (LEAST_CYCLES,) * 2)
        for one in (STIFFNESS, DAMPING)
    ]
    if isolator:
        repeated = [
            AcceptanceCriterion("en_15129", clause, one, "least", asked.least_share, (2, 10))
            for one in (STIFFNESS, DAMPING)
        ]
    else:
        repeated = [
            AcceptanceCriterion("en_15129", clause, one, "third", asked.from_third, (2, 10**6))
            for one in (STIFFNESS, DAMPING)
        ]
    return [*repeated, *criteria]


def _ntc(asked: Acceptance) -> list[AcceptanceCriterion]:
    """Device by NTC 2018: 11.9.4 of linear devices, 11.9.5 of others, 11.9.6 of viscous ones, 11.9.7 of isolators.

    Source: D.M. 17 January 2018, Eq. 11.9.3 to 11.9.7 and Tab. 11.9.I to 11.9.IV, column of the supply.
    """
    third, design = asked.from_third, asked.from_design

    def repeated(clause: str, *quantities: Quantity) -> list[AcceptanceCriterion]:
        return [AcceptanceCriterion("ntc_2018", clause, one, "third", third, (2, 10**6)) for one in quantities]

    def designed(clause: str, quantity: Quantity, limit: float, fall_only: bool = False) -> AcceptanceCriterion:
        return AcceptanceCriterion(
            "ntc_2018", clause, quantity, "design", design or limit, (LEAST_CYCLES,) * 2, fall_only
        )

    if asked.device == "viscous":
        criteria = [designed("11.9.6", one, 0.15) for one in PEAKS]
        return [*repeated("11.9.6", ENERGY), *criteria, designed("11.9.6", ENERGY, 0.15, fall_only=True)]
    if asked.device == "elastomeric_isolator":
        return [designed("11.9.7", one, 0.20) for one in (STIFFNESS, DAMPING)]
    if asked.device == "hysteretic":  # whose K_2, the stiffness beyond yielding, is not found
        criteria = [designed("11.9.5", STIFFNESS, 0.15), designed("11.9.5", DAMPING, 0.10)]
        return [*repeated("11.9.5", DAMPING), *criteria]
    return [*repeated("11.9.4", STIFFNESS, DAMPING), *(designed("11.9.4", one, 0.15) for one in (STIFFNESS, DAMPING))]


def judge(runs: Sequence[Run], designs: Sequence[Run | None], asked: Acceptance) -> tuple[Judged, ...]:
    """Judge runs by all criteria.

    Args:
        runs: of the device.
        designs: the same runs as designed; None: not known.
        asked: criteria and limits.
    """
    return tuple(
        _judged(run, design, criterion)
        for run, design in zip(runs, designs, strict=True)
        for criterion in asked.criteria
    )


def _judged(run: Run, design: Run | None, criterion: AcceptanceCriterion) -> Judged:
    first, last = criterion.cycles
    values = criterion.quantity.of(run)
    part = values[first - 1 : last]
    if run.gives_energy:
        return Judged(run, criterion, None, np.nan, None, GIVES_ENERGY)
    if not np.all(np.isfinite(values)):
        return Judged(run, criterion, None, np.nan, None, "the device stores nothing")
    if criterion.reference == "least":
        if np.max(part) <= 0.0:  # a share of negative numbers is above 1 where the device softens
            return Judged(run, criterion, None, np.nan, None, "it is negative")
        value = float(np.min(part) / np.max(part))
        return Judged(run, criterion, first + int(np.argmin(part)), value, value >= criterion.limit)
    if criterion.reference == "design":
        if design is None:
            return Judged(run, criterion, None, np.nan, None, "the campaign has no law with parameters")
        reference = criterion.quantity.of(design)[first - 1 : last]
        if not np.all(np.isfinite(reference)):
            return Judged(run, criterion, None, np.nan, None, "the law stores nothing")
    else:
        reference = {"mean": np.mean(values), "third": values[LEAST_CYCLES - 1], "first": values[0]}[
            criterion.reference
        ]
    if np.min(np.abs(reference)) < _LEAST * np.max(np.abs([run.loops.largest, run.loops.smallest])) and (
        criterion.quantity in AT_ZERO
    ):
        return Judged(run, criterion, None, np.nan, None, "the force there is nearly none")
    deviation = part / reference - 1.0
    worst = int(np.argmin(deviation) if criterion.fall_only else np.argmax(np.abs(deviation)))
    value = float(deviation[worst])
    met = value >= -criterion.limit if criterion.fall_only else abs(value) <= criterion.limit
    return Judged(run, criterion, first + worst, value, met)
