"""How a design of viscous dampers came about, and what it put into each storey."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.dataset import Group
from edesign.report.design.storeys import heights_axes
from edesign.report.design.viscous_tables import kilonewtons
from edesign.report.drawing.captions import file_name, plain
from edesign.report.drawing.style import AFTER, legend_above, new_figure, some_of, styled

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def viscous_figures(name: str, group: Group) -> Iterator[tuple[str, str, Figure]]:
    """Yield the dampers of a design over the height, and its iterations.

    Args:
        name: name of the design.
        group: of the design.

    Yields:
        Name of the file, caption and figure.
    """
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
    figure, left, right = heights_axes(group)
    storeys, coefficient = np.asarray(group.coords["storey"].values), group.variables["device_coefficient"]
    left.barh(storeys, 1e-3 * coefficient.values, 0.6, color=AFTER)
    left.set_xlabel(f"c of a damper ({kilonewtons(coefficient.unit)})")
    if right is not None:
        right.set_xlim(left=0.0)
        legend_above(right)
    return figure


@styled
def viscous_iterations_figure(group: Group) -> Figure:
    """Draw the amplitude after each iteration, and the sum of its coefficients.

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
