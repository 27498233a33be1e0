"""A virtual test with one compensator: outcome, errors against the direct analysis, and the warnings about it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from edesign.archive.dataset import Group
from edesign.core.compensator import AdaptiveTimeSeries, Compensator, LiveDelay
from edesign.core.substructure import LinearRig, LoopRecord, Sensors
from edesign.project.substructure.programme import CommandTest, RtsTest
from edesign.substructure.computed_structure import ComputedStructure, Direct
from edesign.substructure.drive import Drive
from edesign.substructure.indicators import Tracking, tracking
from edesign.substructure.indicators.response_error import peak_error, response_error
from edesign.substructure.met_limits import MetLimit, met_limits

DIVERGED = 10.0
"""Times the largest direct deformation, or given target, at which a test counts as unstable: its loop feeds itself.

A file accepts errors of the response up to 100 %, which is twice the deformation. Whatever is beyond that is no result,
and a decade leaves room for a stable loop that is merely bad, such as 176 % at 30 ms in the thesis' storey."""


@dataclass(frozen=True)
class VirtualTest:
    """Result of a test with one compensator.

    Attributes:
        test, compensator: their names.
        kind: of the test.
        time: (n,) s; shorter than asked for if the test was ended.
        record: of the loop; None: the specimen's law failed.
        building: response of the numerical part as the group of a history; None: there is none.
        tracking: how well the rig followed; None for a test that did not reach its end.
        response_error: root mean square of the error of `LoopRecord.response` over the deformation of the direct
            analysis; NaN without a structure.
        peak_error: relative error of its largest magnitude.
        building_error: as `response_error`, of the drift of the storey where it is largest.
        alpha: (3,) means of the adaptive coefficients between the first and the last motion above the threshold; NaN of
            other compensators.
        estimated_delay: mean over the same time of the delay that an adaptive compensator estimates, s: alpha_1 over
            alpha_0 (thesis Eq. 6.15), or that of a live delay; NaN of other compensators.
        outcome: `done`, `unstable`, `saturated` or `failed`.
        reason: why, if it is not done.
        saturated: limits of rig and sensors that it met.
        warnings: about the run, in sentences.
    """

    test: str
    compensator: str
    kind: str
    time: np.ndarray
    record: LoopRecord | None
    building: Group | None
    tracking: Tracking | None
    response_error: float
    peak_error: float
    building_error: float
    alpha: np.ndarray
    estimated_delay: float
    outcome: str
    reason: str
    saturated: tuple[MetLimit, ...]
    warnings: tuple[str, ...] = ()


def judged(
    computed: ComputedStructure,
    test: CommandTest | RtsTest,
    named: tuple[str, Compensator],
    drive: Drive,
    direct: Direct | None,
    record: LoopRecord,
) -> VirtualTest:
    """Return a run of the loop with what is found of it.

    Args:
        named: name of the compensator, and what it is.
        direct: analysis of the structure; None: there is none.
    """
    count, tracked, group = len(record.target), None, None
    response = peak = of_building = np.nan
    outcome, reason = _outcome(computed, drive, direct, record)
    drift = np.zeros((count, 0))
    if direct is not None:
        group, drift = computed.building(drive, record, reason)
        if group.attributes["status"] != "completed" and outcome == "done":
            outcome, reason = "failed", f"the numerical part: {group.attributes['reason']}"
    if outcome == "done":
        step, applied = computed.file.loop.main_step, record.applied_force
        tracked = tracking(record.target, record.measured, step, record.force, applied=applied)
    if outcome == "done" and direct is not None:
        response = response_error(record.response, direct.deformation)
        peak = peak_error(record.response, direct.deformation)
        of_building = _largest_error(drift, direct.drift)
    return VirtualTest(
        test=test.name,
        compensator=named[0],
        kind=test.kind,
        time=drive.time[:count],
        record=record,
        building=group,
        tracking=tracked,
        response_error=response,
        peak_error=peak,
        building_error=of_building,
        alpha=_mean_alpha(record, named[1]),
        estimated_delay=_estimated_delay(record, named[1]),
        outcome=outcome,
        reason=reason,
        saturated=met_limits(record, drive.time),
        warnings=tuple(_warnings(computed, test, named, drive, direct, record)),
    )


def failed(test: CommandTest | RtsTest, compensator: str, reason: str) -> VirtualTest:
    """Return a run whose loop could not be run to an end, with the reason.

    Args:
        reason: for people.
    """
    return VirtualTest(
        test=test.name,
        compensator=compensator,
        kind=test.kind,
        time=np.zeros(0),
        record=None,
        building=None,
        tracking=None,
        response_error=np.nan,
        peak_error=np.nan,
        building_error=np.nan,
        alpha=np.full(3, np.nan),
        estimated_delay=np.nan,
        outcome="failed",
        reason=reason,
        saturated=(),
    )


def without_result(run: VirtualTest, outcome: str, reason: str) -> VirtualTest:
    """Return a run with another outcome, and without indicators, which would be no result.

    Args:
        reason: for people.
    """
    nan = np.nan
    return replace(
        run, outcome=outcome, reason=reason, tracking=None, response_error=nan, peak_error=nan, building_error=nan
    )


def _outcome(computed: ComputedStructure, drive: Drive, direct: Direct | None, record: LoopRecord) -> tuple[str, str]:
    """How a run ended, and why it gives no result."""
    if record.aborted:
        what = "largest target" if direct is None else "direct deformation"
        return (
            "unstable",
            f"diverged: {DIVERGED:g} times the {what} after {drive.time[len(record.target) - 1]:.4g} s",
        )
    weak = [one for one in met_limits(record, drive.time) if one.name == "force"]
    if weak and isinstance(computed.laboratory.rig, LinearRig):
        needed, limit = np.max(np.abs(record.true_force)), computed.laboratory.limits.force
        return "saturated", (
            f"the specimen took {1e-3 * needed:.4g} kN, and the actuator has {1e-3 * limit:.4g} kN{weak[0].times}. "
            f"A rig of the kind {computed.file.plant.kind} has no balance of forces, so the actuator would have moved "
            "less than here"
        )
    return "done", ""


def _warnings(
    computed: ComputedStructure,
    test: CommandTest | RtsTest,
    named: tuple[str, Compensator],
    drive: Drive,
    direct: Direct | None,
    record: LoopRecord,
) -> Iterator[str]:
    """The warnings about a run."""
    motion, force = (drive.wanted, record.true_force) if direct is None else (direct.deformation, direct.force)
    yield from computed.step_warnings(test.name, drive)
    yield from lost_in_noise(test.name, computed.laboratory.sensors, _largest(motion), _largest(force))
    compensator, of = named
    if isinstance(of, (AdaptiveTimeSeries, LiveDelay)) and not np.any(np.ptp(record.alpha, axis=0)):
        largest = _largest(record.measured)
        why = (
            f": the measured displacement stayed at {1e3 * largest:.3g} mm and below, and its threshold is "
            f"{1e3 * of.threshold:.3g} mm"
            if largest <= of.threshold
            else ""
        )
        yield f'test {test.name}: "{compensator}" never adapted, and kept what it began with{why}'


def lost_in_noise(test: str, sensors: Sensors, deformation: float, force: float) -> Iterator[str]:
    """Yield a warning for each channel whose noise, or step of its converter, is not below the motion of a test.

    Args:
        sensors: of the laboratory.
        deformation: largest of the specimen, m; 0: it has none.
        force: largest of the specimen, N; 0: it has none.
    """
    for channel, largest, noise, quantisation, scale, unit in (
        ("displacement", deformation, sensors.displacement_noise, sensors.displacement_quantisation, 1e3, "mm"),
        ("force", force, sensors.force_noise, sensors.force_quantisation, 1e-3, "kN"),
    ):
        for what, size in (("the noise", noise), ("a step of the converter", quantisation)):
            if 0.0 < largest <= size:
                yield (
                    f"test {test}: {what} of the {channel}, {scale * size:.3g} {unit}, is not below the largest "
                    f"{channel} of the specimen, {scale * largest:.3g} {unit}"
                )


def _largest_error(found: np.ndarray, direct: np.ndarray) -> float:
    """Root mean square error over that of the direct analysis, of the column where it is largest; NaN: none moves."""
    errors = [response_error(one, other) for one, other in zip(found.T, direct.T, strict=True)]
    return max((error for error in errors if not np.isnan(error)), default=np.nan)


def _largest(values: np.ndarray) -> float:
    return float(np.max(np.abs(values)))


def _adapting(record: LoopRecord, compensator: Compensator) -> np.ndarray:
    """Coefficients (n, 3) from the first to the last displacement above the threshold, not at rest."""
    moving = np.flatnonzero(np.abs(record.measured) > getattr(compensator, "threshold", np.inf))
    return record.alpha[moving[0] : moving[-1] + 1] if moving.size else record.alpha[:0]


def _mean_alpha(record: LoopRecord, compensator: Compensator) -> np.ndarray:
    found = _adapting(record, compensator)
    if not isinstance(compensator, AdaptiveTimeSeries) or not len(found):
        return np.full(3, np.nan)
    return np.asarray(np.mean(found, axis=0))


def _estimated_delay(record: LoopRecord, compensator: Compensator) -> float:
    found = _adapting(record, compensator)
    if not isinstance(compensator, (AdaptiveTimeSeries, LiveDelay)) or not len(found):
        return np.nan
    delay = found[:, 0] if isinstance(compensator, LiveDelay) else found[:, 1] / found[:, 0]
    return float(np.mean(delay))
