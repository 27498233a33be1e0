"""The vertical ground motion of a history, beside the horizontal one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.dataset import Group
from edesign.building.masses import STILL_BEAMS, still_beams
from edesign.errors import InputError
from edesign.ground_motion.record import Record
from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.project.project import Project
from edesign.study.motions.motions import Motion, level_factor

if TYPE_CHECKING:
    from collections.abc import Callable


@dataclass(frozen=True)
class GroundMotion:
    """The applied ground motion: horizontal and vertical record with one time step and one length.

    Attributes:
        horizontal: with its free vibration.
        vertical: upwards; None: there is none.
        factor: between the vertical record as it was read and what is applied.
    """

    horizontal: Record
    vertical: Record | None = None
    factor: float = 0.0

    @property
    def samples(self) -> np.ndarray | None:
        """Vertical accelerations, (n,) m/s2; None without vertical motion."""
        return None if self.vertical is None else self.vertical.acceleration

    def store(self, group: Group, project: Project) -> None:
        """Add the vertical motion, and the beams that it does not bend, to the group of a history.

        Args:
            group: of the history, with its times.
            project: the validated project.
        """
        if self.vertical is None:
            return
        kept = self.vertical.acceleration[:: project.outputs.every][: group.coords["time"].values.size]
        label = "vertical ground acceleration as applied, upwards"
        group.add("ground_acceleration_vertical", ("time",), kept, "m/s^2", label)
        group.attributes |= {
            "vertical_motion": self.vertical.source,
            "vertical_scale_factor": self.factor,
            "vertical_pga_m_s2": self.vertical.pga,
            STILL_BEAMS: still_beams(project),
        }


def ground_motion(
    project: Project,
    spec: HistoryAnalysis,
    record: Record,
    factor: float,
    vertical: Motion | None,
    applied: Callable[[Record, float, float], Record],
) -> GroundMotion:
    """Return the ground motion that a history applies.

    The shorter of both motions is continued by zeros; the free vibration follows the end of the longer.

    Args:
        project: the validated project.
        spec: the history.
        record: horizontal, before its scaling.
        factor: on it.
        vertical: the other record made ready, if the history has one for its vertical motion.
        applied: of a record, a factor and a time after its end (s), what the integration sees at its step.

    Raises:
        InputError: the vertical record could not be fitted, or is zero throughout and is to be scaled to a peak.
    """
    given = spec.vertical
    if given is None:
        return GroundMotion(applied(record, factor, spec.free_vibration))
    if given.record is None:
        assert given.ratio is not None
        both = given.ratio * factor
        return GroundMotion(
            applied(record, factor, spec.free_vibration), applied(record, both, spec.free_vibration), both
        )
    assert vertical is not None
    other = vertical.record
    if vertical.match is not None:
        own = level_factor(project, given.record, spec.level)
    elif given.pga is not None:
        if other.pga == 0.0:
            place = project.where("records", given.record)
            raise InputError(f"{place}: records.{given.record}: the record is zero throughout; it has no peak to scale")
        own = given.pga / other.pga
    else:
        own = factor if given.scale is None else given.scale
    last = max(record.duration, other.duration) + spec.free_vibration
    horizontal = applied(record, factor, last - record.duration)
    upwards = applied(other, own, last - other.duration)
    missing = horizontal.acceleration.size - upwards.acceleration.size  # of one step, by rounding of durations
    if missing > 0:
        upwards = upwards.with_zeros(missing * upwards.time_step)
    elif missing < 0:
        horizontal = horizontal.with_zeros(-missing * horizontal.time_step)
    return GroundMotion(horizontal, upwards, own)
