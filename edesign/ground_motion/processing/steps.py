"""The processing that a project file describes, step by step."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from edesign.errors import InputError
from edesign.ground_motion.processing.band_pass import band_pass
from edesign.ground_motion.processing.baseline import correct_baseline, remove_drift
from edesign.ground_motion.processing.length import pad, taper, trim, trim_to_significant
from edesign.ground_motion.processing.resampling import resample_band_limited
from edesign.ground_motion.record import Record
from edesign.project.records.processing import Step

REVERSED = "; reversed"
"""What the source of a reversed record has, and that of the record as it was has not."""


def processed(record: Record, steps: Iterable[Step]) -> Record:
    """Return a record after the steps, in their order; its source says each.

    Raises:
        InputError: a step does not suit the record; the message says which.
    """
    for i, step in enumerate(steps):
        try:
            record = _one(record, step)
        except InputError as error:
            raise InputError(f"processing[{i}].{step.given[0]}: {error}") from error
    return record


def _one(record: Record, step: Step) -> Record:
    if step.baseline:
        return correct_baseline(record, step.baseline.order, step.baseline.fit)
    if step.remove_drift:
        return remove_drift(record, step.remove_drift.order)
    if step.filter:
        given = step.filter
        return band_pass(record, given.low, given.high, given.order, given.keep_pads)
    if step.trim:
        if step.trim.end > record.duration + record.time_step:
            raise InputError(
                f"{record.name}: the record ends at {record.duration:g} s, before {step.trim.end:g} s [E-MOTION-02]"
            )
        return trim(record, step.trim.start, step.trim.end, step.trim.taper)
    if step.significant:
        part = step.significant
        return trim_to_significant(record, part.bounds, part.lead, part.tail, part.taper)
    if step.taper:
        return taper(record, step.taper.start, step.taper.end)
    if step.pad:
        return pad(record, step.pad.before, step.pad.after)
    if step.resample:
        return resample_band_limited(record, step.resample.time_step)
    if step.reverse:
        return replace(record, acceleration=-record.acceleration, source=f"{record.source}{REVERSED}")
    return record
