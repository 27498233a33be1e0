"""The ground motion that a history applies: its record turned, scaled, resampled, followed by zeros."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from edesign.archive.dataset import Group
from edesign.errors import InputError
from edesign.frame.masses import STILL_BEAMS
from edesign.ground_motion.pairs import turned
from edesign.ground_motion.record import Record
from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.project.analysis_file import AnalysisFile
from edesign.project.records.pairs import InSpace
from edesign.project.records.records import record_of
from edesign.study.motions.motions import AnyMotion, level_factor
from edesign.study.motions.pairs import PairMotion, along_axes

MOST_STEPS = 10_000_000  # a day of motion at 0.01 s; the motion, and what is kept over time, has 8 bytes of each step


@dataclass(frozen=True)
class GroundMotion:
    """The applied ground motion: horizontal and vertical records with one time step and one length.

    Attributes:
        horizontal: along x, with its free vibration.
        vertical: upwards; None: there is none.
        factor: between the vertical record as it was read and what is applied.
        across: along y of a building; None: there is none.
        second: what an archive says of the second component of a pair.
    """

    horizontal: Record
    vertical: Record | None = None
    factor: float = 0.0
    across: Record | None = None
    second: Mapping[str, Any] = field(default_factory=dict)

    @property
    def samples(self) -> np.ndarray | None:
        """Vertical accelerations, (n,) m/s2; None without vertical motion."""
        return None if self.vertical is None else self.vertical.acceleration

    def store(self, group: Group, every: int, still: Sequence[str]) -> None:
        """Add the second component, the vertical motion, and the beams that it does not bend, to a history's group.

        Args:
            group: of the history, with its times.
            every: one step in so many is kept over time.
        """
        group.attributes |= self.second
        if self.vertical is None:
            return
        kept = self.vertical.acceleration[::every][: group.coords["time"].values.size]
        label = "vertical ground acceleration as applied, upwards"
        group.add("ground_acceleration_vertical", ("time",), kept, "m/s^2", label)
        group.attributes |= {
            "vertical_motion": self.vertical.source,
            "vertical_scale_factor": self.factor,
            "vertical_pga_m_s2": self.vertical.pga,
            STILL_BEAMS: list(still),
        }


def ground_motion(
    project: AnalysisFile,
    spec: HistoryAnalysis,
    motion: AnyMotion,
    factor: float,
    vertical: AnyMotion | None,
) -> GroundMotion:
    """Return the ground motion that a history applies.

    Records are turned before they are resampled. The shorter of horizontal and vertical motion is continued by zeros;
    the free vibration follows the end of the longer.

    Args:
        project: the validated file, with its integration.
        spec: what it says of the history, which has one angle.
        motion: the record or the pair made ready, before the scaling of the history.
        vertical: the other record made ready, if the history has one for its vertical motion.

    Raises:
        InputError: a record could not be fitted, or the vertical one is zero throughout and is to be scaled to a peak.
    """
    assert project.integration is not None, "who runs a history asks for it"
    acting = _horizontal(project, spec, motion)
    scales = [factor] * len(acting)
    upwards = _upwards(project, spec, motion, factor, vertical)
    if upwards is not None:
        acting.append(upwards[0])
        scales.append(upwards[1])
    free = [spec.free_vibration] * len(acting)
    if vertical is not None:
        last = max(record.duration for record in acting) + spec.free_vibration
        free = [last - record.duration for record in acting]
    step = project.integration.time_step or acting[0].time_step
    applied = [
        input_motion(record, scale, step, zeros) for record, scale, zeros in zip(acting, scales, free, strict=True)
    ]
    longest = max(record.acceleration.size for record in applied)
    for i, record in enumerate(applied):
        missing = longest - record.acceleration.size  # of one step, by rounding of durations
        if missing > 0:
            applied[i] = record.with_zeros(missing * record.time_step)
    beside = applied.pop() if upwards is not None else None
    across = applied[1] if len(applied) > 1 else None
    second = _about_second(motion) if isinstance(motion, PairMotion) else {}
    return GroundMotion(applied[0], beside, 0.0 if upwards is None else upwards[1], across, second)


def _horizontal(project: AnalysisFile, spec: HistoryAnalysis, motion: AnyMotion) -> list[Record]:
    """The motions along x and, where there is one, along y, before their scaling."""
    if isinstance(motion, PairMotion):
        pair = project.records[record_of(spec.record)]
        assert isinstance(pair, InSpace), "motions of pairs are made of them"
        x, y = along_axes(pair, *motion.records[:2])
        source = f"{x.source} along x, {y.source} along y"
    elif spec.angle == 0.0:
        return [motion.record]
    else:
        x = motion.record
        y, source = replace(x, acceleration=np.zeros_like(x.acceleration)), x.source
    ax, ay = turned(x.acceleration, y.acceleration, spec.angle)
    if spec.angle != 0.0:
        source += f", turned by {math.degrees(spec.angle):g} deg"
    return [replace(x, acceleration=ax, source=source), replace(y, acceleration=ay, source=source)]


def _upwards(
    project: AnalysisFile, spec: HistoryAnalysis, motion: AnyMotion, factor: float, vertical: AnyMotion | None
) -> tuple[Record, float] | None:
    """The vertical motion and its factor; None: there is none."""
    given = spec.vertical
    if given is None:
        own = motion.records[2:] if isinstance(motion, PairMotion) else ()
        return (own[0], factor) if own else None
    if given.record is None:
        assert given.ratio is not None
        return motion.record, given.ratio * factor
    assert vertical is not None
    other = vertical.record
    if vertical.match is not None:
        return other, level_factor(project, given.record, spec.level)
    if given.pga is None:
        return other, factor if given.scale is None else given.scale
    if other.pga == 0.0:
        place = project.where("records", given.record)
        raise InputError(
            f"{place}: records.{given.record}: the record is zero throughout; it has no peak to scale [E-HIST-01]"
        )
    return other, given.pga / other.pga


def _about_second(motion: PairMotion) -> dict[str, Any]:
    """What an archive says of the second component of a pair."""
    recorded, match = motion.pair.components[1], None if motion.matches is None else motion.matches[1]
    return {
        "second_record_source": recorded.record.source,
        "second_record_checksum": recorded.record.checksum,
        "second_record_pga_m_s2": recorded.record.pga,
        "second_match_scale": None if match is None else match.scale,
    }


def scale_factor(project: AnalysisFile, spec: HistoryAnalysis, record: Record) -> float:
    """Return the factor on a record in a history: to a peak, as given, or that of its hazard level.

    Args:
        record: the record made ready.
    """
    if spec.pga is not None:
        return spec.pga / record.pga
    return level_factor(project, spec.record, spec.level) if spec.scale is None else spec.scale


def input_motion(record: Record, factor: float, time_step: float | None, free_vibration: float) -> Record:
    """Return a record as it is applied: scaled, resampled, and followed by zeros.

    Args:
        record: the record made ready.
        factor: on its accelerations.
        time_step: s; None: that of the record.
        free_vibration: duration of the zeros after the record, s.
    """
    if factor != 1.0:
        record = record.scaled(factor)
    if time_step is not None:
        record = record.resampled(time_step)
    return record.with_zeros(free_vibration)


def check_motion(project: AnalysisFile, spec: HistoryAnalysis, record: Record) -> None:
    """Check that a record can be applied as a history asks for it, without making the motion.

    Args:
        record: the record made ready.

    Raises:
        InputError: the time step is longer than the record, there are more steps than can be kept, a wave reaches a
            line after the end, or the record is zero throughout and is to be scaled to a peak; the message names the
            place in the project file.
    """
    step = project.integration.time_step if project.integration is not None else None
    where = project.where("integration", "time_step" if step is not None else "method")
    step = record.time_step if step is None else step
    if step > record.duration:
        raise InputError(
            f"{where}: integration.time_step: {step:g} s is longer than the record {spec.record} "
            f"({record.duration:g} s) [E-HIST-02]"
        )
    steps = (record.duration + spec.free_vibration) / step
    if steps > MOST_STEPS:
        raise InputError(
            f"{where}: integration.time_step: with {step:g} s the history {spec.name} has {steps:.3g} steps "
            f"({record.duration:g} s of record, {spec.free_vibration:g} s of free vibration); "
            f"{MOST_STEPS} are possible [E-HIST-02]"
        )
    if spec.wave_passage is not None:
        delays = spec.wave_passage.delays_of(project.grid)
        last = max(delays, key=lambda line: delays[line])
        if delays[last] >= record.duration + spec.free_vibration:
            raise InputError(
                f"{project.where('analyses')}: the history {spec.name} ends after "
                f"{record.duration + spec.free_vibration:g} s, and the wave reaches line {last} after "
                f"{delays[last]:.4g} s; give `free_vibration`, or another velocity [E-HIST-03]"
            )
    if spec.pga is not None and record.pga == 0.0:
        place = project.where("records", spec.record)
        raise InputError(
            f"{place}: records.{spec.record}: the record is zero throughout; it has no peak to scale [E-HIST-01]"
        )
