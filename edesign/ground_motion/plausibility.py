"""Warnings about a record that reads well but may not mean what it says."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping

import numpy as np

from edesign.ground_motion.intensity import velocity
from edesign.ground_motion.record import Record
from edesign.project.notation.units import STANDARD_GRAVITY

_LARGEST_PGA = 3.0 * STANDARD_GRAVITY  # m/s2; few recordings of any earthquake exceed 2 g
_SMALLEST_PGA = 0.001 * STANDARD_GRAVITY
LONGEST_STEP = 0.05
"""Time step of the slowest recorders, s; instruments sample at 50 to 1000 Hz."""
SHORTEST_STEP = 0.0005
"""Time step of the quickest recorders, s."""
_OFFSET = 0.02  # of the PGA: the median of a recorded motion is far below
_CLIPPED = 4  # equal samples in a row at the extreme
_END_VELOCITY = 0.1  # of the PGV; processed records end below 3 %

USUAL_SCALES = (1.0 / 3.0, 3.0)
"""Factors on records that practice takes for modest.

Source: FEMA P-751 (2012), NEHRP Recommended Provisions: Design Examples, 3.3.1.4: scale factors "should be modest
(usually falling between 1/3 and 3)"; beyond, the recorded event is likely inconsistent with the one that is modelled.
"""
_NAMED = 3  # of records that are scaled beyond the usual, so many are named
_ROUNDING = 1e-9  # relative: a factor of 3 as written is not beyond 3


def record_warnings(record: Record) -> tuple[str, ...]:
    """Return what looks wrong about a record or its file, one sentence each; nothing if it looks like an earthquake."""
    pga = record.pga
    if pga == 0.0:
        return (*record.remarks, "the record is zero throughout")
    found = list(record.remarks)
    shown = f"{pga / STANDARD_GRAVITY:.3g} g"
    if pga > _LARGEST_PGA:
        found.append(f"the peak is {shown}, more than earthquakes reach: is the unit right (m/s2 or cm/s2 read as g)?")
    if pga < _SMALLEST_PGA:
        found.append(f"the peak is only {shown}: is the unit right (g read as m/s2, or m/s2 as cm/s2)?")
    if record.time_step > LONGEST_STEP:
        found.append(f"the time step of {record.time_step:g} s is too coarse for frequencies above 5 Hz: is it right?")
    if record.time_step < SHORTEST_STEP:
        found.append(f"the time step of {record.time_step:g} s is shorter than that of any recorder: is it in seconds?")
    median = float(np.median(record.acceleration))
    if abs(median) > _OFFSET * pga:
        found.append(f"the samples lie around {median:.3g} m/s2, not zero: a constant offset; correct the baseline")
    run, at = _longest_run_at_extreme(record.acceleration)
    if run >= _CLIPPED:
        found.append(f"{run} equal samples in a row at the extreme, from {at * record.time_step:g} s: clipped peaks?")
    v = velocity(record.acceleration, record.time_step)
    pgv = float(np.max(np.abs(v)))
    if abs(v[-1]) > _END_VELOCITY * pgv:
        found.append(
            f"the motion ends with {v[-1]:.3g} m/s, {abs(v[-1]) / pgv:.0%} of its peak velocity: it is cut off, "
            "or needs a baseline correction"
        )
    return tuple(found)


def unusual_scales(factors: Mapping[str, float], simulated: Collection[str] = ()) -> tuple[str, ...]:
    """Return a sentence if records are scaled by more, or less, than practice takes for modest; nothing otherwise.

    Args:
        factors: on each record, by its name.
    """
    low, high = USUAL_SCALES
    beyond = {name: f for name, f in factors.items() if not low * (1.0 - _ROUNDING) <= f <= high * (1.0 + _ROUNDING)}
    if not beyond:
        return ()
    worst = sorted(beyond, key=lambda name: -abs(math.log(beyond[name])))
    named = [f"{name} by {beyond[name]:.3g}{' (simulated)' if name in simulated else ''}" for name in worst[:_NAMED]]
    more = [f"{len(beyond) - _NAMED} more"] if len(beyond) > _NAMED else []
    which = f"{len(beyond)} of {len(factors)} records are scaled" if len(factors) > 1 else "the record is scaled"
    return (
        f"{which} beyond the usual 1/3 to 3 (FEMA P-751, 3.3.1.4): {', '.join(named + more)}; such an earthquake is "
        "likely not the one that is meant",
    )


def _longest_run_at_extreme(acceleration: np.ndarray) -> tuple[int, int]:
    """Length and start of the longest run of samples equal to the largest or the smallest."""
    best = (0, 0)
    for extreme in (acceleration.max(), acceleration.min()):
        hit = np.concatenate(([0], (acceleration == extreme).astype(int), [0]))
        edges = np.diff(hit)
        starts, ends = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
        longest = int(np.argmax(ends - starts))
        best = max(best, (int((ends - starts)[longest]), int(starts[longest])), key=lambda item: item[0])
    return best
