"""The ground motion that a history applies: its record scaled, resampled, followed by zeros; and the vertical one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from edesign.archive.dataset import Group
from edesign.errors import InputError
from edesign.frame.masses import STILL_BEAMS
from edesign.ground_motion.record import Record
from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.project.analysis_file import AnalysisFile
from edesign.study.motions.motions import Motion, level_factor

MOST_STEPS = 10_000_000  # a day of motion at 0.01 s; the motion, and what is kept over time, has 8 bytes of each step


@dataclass(frozen=True)
class GroundMotion:
    """The applied ground motion: horizontal and vertical records with one time step and one length.

    Attributes:
        horizontal: along x, with its free vibration.
        vertical: upwards; None: there is none.
        factor: between the vertical record as it was read and what is applied.
        across: along y of a building; None: there is none.
    """

    horizontal: Record
    vertical: Record | None = None
    factor: float = 0.0
    across: Record | None = None

    @property
    def samples(self) -> np.ndarray | None:
        """Vertical accelerations, (n,) m/s2; None without vertical motion."""
        return None if self.vertical is None else self.vertical.acceleration

    def store(self, group: Group, every: int, still: Sequence[str]) -> None:
        """Add the vertical motion, and the beams that it does not bend, to the group of a history.

        Args:
            group: of the history, with its times.
            every: one step in so many is kept over time.
        """
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
    record: Record,
    factor: float,
    vertical: Motion | None,
) -> GroundMotion:
    """Return the ground motion that a history applies.

    The shorter of both motions is continued by zeros; the free vibration follows the end of the longer.

    Args:
        project: the validated project, with its integration.
        record: horizontal, before its scaling.
        vertical: the other record made ready, if the history has one for its vertical motion.

    Raises:
        InputError: the vertical record could not be fitted, or is zero throughout and is to be scaled to a peak.
    """
    assert project.integration is not None, "who runs a history asks for it"
    step = project.integration.time_step or record.time_step
    given = spec.vertical
    if given is None:
        return GroundMotion(input_motion(record, factor, step, spec.free_vibration))
    if given.record is None:
        assert given.ratio is not None
        both = given.ratio * factor
        horizontal, upwards = (input_motion(record, scale, step, spec.free_vibration) for scale in (factor, both))
        return GroundMotion(horizontal, upwards, both)
    assert vertical is not None
    other = vertical.record
    if vertical.match is not None:
        own = level_factor(project, given.record, spec.level)
    elif given.pga is not None:
        if other.pga == 0.0:
            place = project.where("records", given.record)
            raise InputError(
                f"{place}: records.{given.record}: the record is zero throughout; it has no peak to scale [E-HIST-01]"
            )
        own = given.pga / other.pga
    else:
        own = factor if given.scale is None else given.scale
    last = max(record.duration, other.duration) + spec.free_vibration
    horizontal = input_motion(record, factor, step, last - record.duration)
    upwards = input_motion(other, own, step, last - other.duration)
    missing = horizontal.acceleration.size - upwards.acceleration.size  # of one step, by rounding of durations
    if missing > 0:
        upwards = upwards.with_zeros(missing * upwards.time_step)
    elif missing < 0:
        horizontal = horizontal.with_zeros(-missing * horizontal.time_step)
    return GroundMotion(horizontal, upwards, own)


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
        grid = project.grid
        delays = spec.wave_passage.delays_of({line: grid.line_place(line)[0] for line in grid.lines})
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
