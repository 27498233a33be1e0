"""A design of hysteretic dampers with other yield forces: damping over their share, the optimum."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.dataset import Group
from edesign.report.drawing.captions import file_name
from edesign.report.drawing.style import AFTER, MEAN, TARGET, VARIANTS, legend_above, new_figure, styled
from edesign.report.response.histories import names_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def hysteretic_figures(name: str, group: Group) -> Iterator[tuple[str, str, Figure]]:
    """Yield the effect of other yield forces in a design of hysteretic dampers.

    Yields:
        Name of the file, caption and figure.
    """
    if "curve_share" in group.coords:
        caption = (
            f"Design {name}: added damping of the first mode, and largest drift by the response spectrum, with other "
            f"forces in the same distribution. The dot is the design."
        )
        yield file_name("design", name, "shares"), caption, shares_figure(group)
    if "round_objective" in group.variables:
        count = group.coords["round"].values.size
        caption = f"Design {name}: {count} rounds of histories; the least value is the design."
        yield file_name("design", name, "optimum"), caption, optimum_figure(group)


@styled
def shares_figure(group: Group) -> Figure:
    """Draw damping and drift over the share of the storey shears.

    Args:
        group: of a design, with curve_damping and, where a level is given, curve_storey_drift over (curve_share,).
    """
    estimated = "curve_storey_drift" in group.variables
    figure, (axes,) = new_figure(1, 2 if estimated else 1, 6.3 if estimated else 3.2, 2.4)
    shares, chosen = 100.0 * group.coords["curve_share"].values, 100.0 * float(str(group.attributes["share"]))
    axes[0].plot(shares, 100.0 * group.variables["curve_damping"].values, color=AFTER)
    axes[0].plot(chosen, 100.0 * float(str(group.attributes["damping"])), color=TARGET, marker="o", ms=4.5)
    axes[0].set_ylabel("added damping (%)")
    if estimated:
        axes[1].plot(shares, 100.0 * group.variables["curve_storey_drift"].values, color=AFTER)
        drift = 100.0 * float(group.variables["estimated_storey_drift"].values.max())
        axes[1].plot(chosen, drift, color=TARGET, marker="o", ms=4.5)
        axes[1].set_ylabel("estimated drift (%)")
    for axis in axes:
        axis.set_xlabel("yield forces over storey shears (%)")
        axis.set_ylim(bottom=0.0)
        axis.set_xlim(left=0.0)
    return figure


@styled
def optimum_figure(group: Group) -> Figure:
    """Draw the objective and each criterion over the share of the storey shears.

    Args:
        group: of a design, with round_share, round_objective over (round,), and verdicts.
    """
    figure, ((axis,),) = new_figure(1, 1, 6.3, 2.8)
    shares = 100.0 * group.variables["round_share"].values
    order = np.argsort(shares)
    values, limits = (group.variables[f"verdict_{part}"].values for part in ("value", "limit"))
    for i, name in enumerate(names_of(group, "criterion")):
        color = VARIANTS[(0, 2, 3, 5)[i % 4]]
        axis.plot(shares[order], (values / limits)[order, i], color=color, lw=0.8, ls="--", marker=".", label=name)
    objective = np.asarray(group.variables["round_objective"].values)
    axis.plot(shares[order], objective[order], color=MEAN, marker="o", ms=3.5, label="made least")
    chosen = int(str(group.attributes["chosen_round"])) - 1
    axis.plot(shares[chosen], objective[chosen], color=TARGET, marker="o", ms=6.0, ls="none", label="chosen")
    axis.set_xlim(left=0.0)
    axis.set_xlabel("yield forces over storey shears (%)")
    axis.set_ylabel("value / limit")
    axis.set_ylim(bottom=0.0)
    legend_above(axis, 4)
    return figure
