"""The ground motions of histories in three dimensions: pairs at their levels and angles."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.hazard import factor_of_level
from edesign.ground_motion.pairs import HoldsPairs, turned
from edesign.ground_motion.record import Record
from edesign.project.records.pairs import OnePair, SuitePairs
from edesign.project.records.records import level_of_fit
from edesign.study.motions.applied import input_motion
from edesign.study.motions.pair_criteria import FirstPeriods
from edesign.study.motions.pairs import PairMotion, PairSet, along_axes, prepare_pairs


@dataclass(frozen=True)
class SpaceMotion:
    """The ground motion that a history in three dimensions applies.

    Attributes:
        name: reference of the pair.
        level: of the hazard; "" where none is said.
        angle: by which the pair is turned from x towards y, rad.
        time_step: s.
        ax: along x of the building, (n,) m/s2.
        ay: along y, (n,) m/s2.
        az: upwards, (n,) m/s2; None: there is no vertical motion.
    """

    name: str
    level: str
    angle: float
    time_step: float
    ax: np.ndarray
    ay: np.ndarray
    az: np.ndarray | None = None


def space_motions(
    file: HoldsPairs,
    levels: Sequence[str] = (),
    first_periods: FirstPeriods | None = None,
    time_step: float | None = None,
    free_vibration: float = 0.0,
    workers: int = 1,
) -> list[SpaceMotion]:
    """Return the ground motions of all pairs of a file as histories in three dimensions apply them.

    Args:
        file: with the pairs and the hazard, such as a study.
        levels: of the hazard, at which fitted pairs act; empty: all of them. Others act once.
        first_periods: of the building, for the rules of the code on the mean spectrum.
        time_step: of the analysis, s; None: that of each pair.
        free_vibration: duration of the zeros after each motion, s.
        workers: pairs that are fitted at the same time.

    Returns:
        One motion for each pair, level and angle, in this order.

    Raises:
        InputError: a pair cannot be read or fitted, or a level has a spectrum that it was not fitted to.
    """
    found: list[SpaceMotion] = []
    for name in file.records:
        pairs = prepare_pairs(file, name, first_periods, workers)
        for motion in pairs.motions:
            found += _applied(file, pairs, motion, levels, time_step, free_vibration)
    return found


def _applied(
    file: HoldsPairs,
    pairs: PairSet,
    motion: PairMotion,
    levels: Sequence[str],
    time_step: float | None,
    free_vibration: float,
) -> Iterator[SpaceMotion]:
    """The ground motions of one pair; errors as of `space_motions`."""
    try:
        records = motion.records
    except InputError as error:
        raise InputError(f"{file.where('records', pairs.name)}: records.{pairs.name}: {error}") from error
    hazard, fitted = file.hazard, pairs.target is not None
    only = level_of_fit(pairs.spec, hazard) if fitted and hazard is not None else None
    named = tuple(levels) or (tuple(hazard.levels) if fitted and hazard is not None and only is None else (only or "",))
    for level in named if fitted else named[:1]:
        if only is not None and level != only:
            raise InputError(
                f"{file.where('records', pairs.name)}: records.{pairs.name}: it is fitted to the spectrum of `{only}`, "
                f"which has another shape than that of `{level}`; match another record to it [E-SCALE-02]"
            )
        factor = factor_of_level(hazard, level) if fitted and hazard is not None and level else 1.0
        for angle in pairs.spec.angles:
            x, y, *z = (
                input_motion(record, factor, time_step, free_vibration)
                for record in _turned(pairs.spec, records, angle)
            )
            upwards = z[0].acceleration if z else None
            yield SpaceMotion(motion.pair.name, level, angle, x.time_step, x.acceleration, y.acceleration, upwards)


def _turned(spec: SuitePairs | OnePair, records: Sequence[Record], angle: float) -> tuple[Record, ...]:
    """The motions along x and y, and upwards, of a pair that is turned."""
    x, y = along_axes(spec, records[0], records[1])
    ax, ay = turned(x.acceleration, y.acceleration, angle)
    return replace(x, acceleration=ax), replace(y, acceleration=ay), *records[2:]
