"""How a design of viscous dampers came about, and what it put into each storey."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.dataset import Group
from edesign.report.captions import file_name, plain
from edesign.report.figures import AFTER, BEFORE, new_figure, some_of, styled
from edesign.report.viscous_tables import kilonewtons

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def viscous_figures(name: str, group: Group) -> Iterator[tuple[str, str, Figure]]:
    """The dampers of a design over the height, and its iterations: name of the file, caption, figure."""
    if "device_coefficient" not in group.variables:
        return
    damping = 100.0 * float(str(group.attributes["damping"]))
    caption = (
        f"Design {name}: damping coefficient of a damper of each storey, and its drift estimated by the response "
        f"spectrum. The first mode has {plain(damping)} % of added damping."
    )
    yield file_name("design", name, "heights"), caption, viscous_heights_figure(group)
    if group.coords["iteration"].values.size > 1:
        count = group.coords["iteration"].values.size
        caption = f"Design {name}: {count} iterations of the amplitude at which the dampers count."
        yield file_name("design", name, "iterations"), caption, viscous_iterations_figure(group)


@styled
def viscous_heights_figure(group: Group) -> Figure:
    """Draw the coefficient of the dampers of each storey, and the estimated drifts where there are any.

    Args:
        group: of a design: device_coefficient over (storey,), and estimated_storey_drift, estimated_bare_storey_drift
            over (frame_storey,) where a level is given.
    """
    estimated = "estimated_storey_drift" in group.variables
    figure, (axes,) = new_figure(1, 2 if estimated else 1, 6.3 if estimated else 3.2, 3.0)
    storeys, every = (np.asarray(group.coords[name].values) for name in ("storey", "frame_storey"))
    coefficient = group.variables["device_coefficient"]
    left = axes[0]
    left.barh(storeys, 1e-3 * coefficient.values, 0.6, color=AFTER)
    left.set_xlabel(f"c of a damper ({kilonewtons(coefficient.unit)})")
    left.set_ylabel("storey")
    left.grid(axis="y", visible=False)
    for axis in axes:
        axis.set_yticks(some_of(every))
        axis.set_ylim(every[0] - 0.6, every[-1] + 0.6)
    if estimated:
        right = axes[1]
        for label, key, color in (
            ("without dampers", "estimated_bare_storey_drift", BEFORE),
            ("with dampers", "estimated_storey_drift", AFTER),
        ):
            right.plot(100.0 * group.variables[key].values, every, color=color, marker="o", ms=3.5, label=label)
        right.set_xlabel("estimated drift (%)")
        right.set_xlim(left=0.0)
        right.tick_params(labelleft=False)
        right.legend(loc="lower left", bbox_to_anchor=(-0.02, 1.0), ncols=2, borderaxespad=0.2)
    return figure


@styled
def viscous_iterations_figure(group: Group) -> Figure:
    """Draw the amplitude that came out of each iteration, and the sum of its coefficients.

    Args:
        group: of a design, with iteration_roof_displacement (m) and iteration_coefficient over (iteration, storey).
    """
    figure, ((left, right),) = new_figure(1, 2, 6.3, 2.4)
    steps = np.asarray(group.coords["iteration"].values)
    left.plot(steps, 1e3 * group.variables["iteration_roof_displacement"].values, color=AFTER, marker="o", ms=3.5)
    left.set_ylabel("roof amplitude (mm)")
    coefficient = group.variables["iteration_coefficient"]
    right.plot(steps, 1e-3 * coefficient.values.sum(axis=1), color=AFTER, marker="o", ms=3.5)
    right.set_ylabel(f"c of all storeys ({kilonewtons(coefficient.unit)})")
    for axis in (left, right):
        axis.set_ylim(0.0, 1.1 * axis.get_ylim()[1])
        axis.set_xlabel("iteration")
        axis.set_xticks(some_of(steps))
    return figure
