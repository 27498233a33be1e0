"""Figures of a laboratory's sheet: force against velocity, the loops of each run, its properties over the cycles."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from edesign.damper.testing.acceptance import Acceptance
from edesign.damper.testing.device_cycles import Run
from edesign.damper.testing.measured_histories import DamperTest
from edesign.report.drawing.style import AFTER, BEFORE, MEAN, TARGET, legend_above, new_figure, styled

if TYPE_CHECKING:
    from matplotlib.figure import Figure

THIRD = 2
"""Index of the cycle by which standards judge."""


@styled
def run_figure(test: DamperTest, run: Run, asked: Acceptance) -> Figure:
    """Draw the loops of a run, the third one heavier, and the properties of its cycles over those of the third.

    The properties are k', W and the peak force; dashed lines show the deviation from the third cycle that is
    allowed, where a standard limits it.

    Args:
        test: the damper test with displacement (n,) m and force (n,) N over time.
        run: the run of the test, with the times at which its loops begin.
        asked: the acceptance criteria, with the allowed deviations.
    """
    figure, axes = new_figure(1, 2, 7.6, 3.0)
    loops, over_cycles = axes[0]
    x, force = 1e3 * test.displacement, 1e-3 * test.measured_force()
    ends = np.append(run.loops.start, run.loops.start[-1] + run.loops.period[-1])
    first, last = np.searchsorted(test.time, (ends[0], ends[-1]))
    loops.plot(x[first : last + 1], force[first : last + 1], color=BEFORE, lw=0.5)
    first, last = np.searchsorted(test.time, ends[2:4])
    loops.plot(x[first : last + 1], force[first : last + 1], color=AFTER, lw=1.1, label="cycle 3")
    loops.legend(loc="upper left")
    loops.set_xlabel("displacement (mm)")
    loops.set_ylabel("force (kN)")
    cycles = np.arange(1, run.cycles + 1)
    for values, label, mark, colour in (
        (run.storage_stiffness, "k'", "o", AFTER),
        (run.loops.work, "W", "s", "#d9822b"),
        (run.loops.largest, "F+", "^", BEFORE),
    ):
        over_cycles.plot(cycles, 100.0 * run.from_third(values), marker=mark, ms=3.5, color=colour, label=label)
    for limit in (-asked.from_third, asked.from_third) if asked.from_third_by else ():
        over_cycles.axhline(100.0 * limit, color=TARGET, lw=0.7, ls="--")
    over_cycles.set_xlabel("cycle")
    over_cycles.set_ylabel("deviation from cycle 3 (%)")
    over_cycles.set_xlim(0.5, run.cycles + 0.5)
    low, high = over_cycles.get_ylim()
    over_cycles.set_ylim(low, high + 0.15 * (high - low))  # room for the legend
    over_cycles.legend(loc="upper right", ncols=3)
    return figure


@styled
def force_velocity_figure(runs: Sequence[Run], designs: Sequence[Run | None], tolerance: float) -> Figure:
    """Draw the largest forces of the third cycle of each run against its largest velocity, beside those of the law.

    The velocity is that of a sine of the amplitude and frequency of the cycle.

    Args:
        runs: of a velocity-dependent device.
        designs: the same runs by the law; None: it gives no force.
    """
    figure, ((axis,),) = new_figure(1, 1, 4.2, 2.8)
    by_law = sorted(
        (_velocity(run), 0.5e-3 * (design.loops.largest[THIRD] - design.loops.smallest[THIRD]))
        for run, design in zip(runs, designs, strict=True)
        if design is not None
    )
    if by_law:
        v, force = np.array(by_law).T
        label = f"law +-{100.0 * tolerance:g} %"
        axis.errorbar(v, force, tolerance * force, color=AFTER, lw=0.8, capsize=4.0, marker="_", ms=9.0, label=label)
    for sign, mark, label in ((1.0, "o", "measured, F+"), (-1.0, "s", "measured, F-")):
        peaks = [run.loops.largest if sign > 0.0 else run.loops.smallest for run in runs]
        sizes = [1e-3 * sign * float(peak[THIRD]) for peak in peaks]
        velocities = [_velocity(run) for run in runs]
        axis.plot(velocities, sizes, marker=mark, ms=4.0, mfc="white", mec=MEAN, color=MEAN, ls="none", label=label)
    axis.set_xlim(left=0.0)
    axis.set_ylim(bottom=0.0)
    axis.set_xlabel("largest velocity (m/s)")
    axis.set_ylabel("largest force (kN)")
    legend_above(axis)
    return figure


def _velocity(run: Run) -> float:
    return float(2.0 * np.pi * run.frequency[THIRD] * run.loops.amplitude[THIRD])
