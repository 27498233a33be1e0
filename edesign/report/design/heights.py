"""A design over the height of the frame: what its dampers are in each storey, and the drifts that are estimated."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.dataset import Group
from edesign.report.design.storeys import first_mode
from edesign.report.design.viscous_tables import kilonewtons
from edesign.report.drawing.captions import plain
from edesign.report.drawing.style import (
    AFTER,
    BEFORE,
    MEAN,
    TARGET,
    VARIANTS,
    legend_above,
    new_figure,
    some_of,
    styled,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_BARS = {  # label of the abscissa, and its scale; variables over (storey,), their labels and colours
    "layer_area": (
        "stiffness (MN/m)",
        1e-6,
        (
            ("storey_stiffness", "frame", BEFORE),
            ("damper_stiffness", "dampers", AFTER),
            ("brace_stiffness", "braces", VARIANTS[2]),
        ),
    ),
    "device_coefficient": ("c of a damper ({unit})", 1e-3, (("device_coefficient", "", AFTER),)),
    "device_yield_force": (
        "of the storey (kN)",
        1e-3,
        (("storey_shear", "shear", BEFORE), ("yield_force", "yield force", AFTER)),
    ),
}
"""What is drawn of the dampers, by the variable that has their size."""


def size_of(group: Group) -> str | None:
    """Return the variable that has the size of the dampers of a design; None: it has none."""
    return next((name for name in _BARS if name in group.variables and "storey_stiffness" in group.variables), None)


def heights_caption(group: Group) -> str:
    """Return what the figure shows, after the name of the design."""
    size = size_of(group)
    if size == "layer_area":
        total = float(np.sum(_along(group, "damper_stiffness")) / np.sum(_along(group, "storey_stiffness")))
        return (
            "stiffness of dampers and storeys, and area of a layer of elastomer. "
            f"The dampers have {plain(100.0 * total)} % of the stiffness of their storeys."
        )
    damping = plain(100.0 * float(str(group.attributes["damping"])))
    if size == "device_coefficient":
        return (
            "damping coefficient of a damper of each storey, and its drift estimated by the response spectrum. "
            f"The {first_mode(group)} has {damping} % of added damping."
        )
    share = plain(100.0 * float(str(group.attributes["share"])))
    given = group.attributes["shear_of"] == "given"
    shear = "given shear of each storey" if given else "shear of each storey without dampers"
    return (
        f"{shear}, yield force of its dampers, and its drift. The dampers have {share} % of the shears; the "
        f"{first_mode(group)} has {damping} % of added damping."
    )


@styled
def heights_figure(group: Group) -> Figure:
    """Draw the dampers of each storey, and beside them the area of their layers, or estimated drifts if there are any.

    Args:
        group: of a design, with variables over (storey,), and over (frame_storey,) where a level is given; where there
            are rounds of a verification of layers, round_layer_area over (round, storey).
    """
    size = size_of(group)
    assert size is not None
    layers = size == "layer_area"
    beside = _areas if layers else _drifts if "estimated_storey_drift" in group.variables else None
    figure, (axes,) = new_figure(1, 2 if beside else 1, 6.3 if beside else 3.2, 3.4 if layers else 3.0)
    every = np.asarray(group.coords["storey" if layers else "frame_storey"].values)
    axes[0].set_ylabel("storey")
    for axis in axes:
        axis.grid(axis="y", visible=axis is not axes[0] and not layers)
        axis.set_yticks(some_of(every))
        axis.set_ylim(every[0] - 0.6, every[-1] + 0.6)
    _bars(axes[0], group, size)
    if beside is not None:
        beside(axes[1], group)
        axes[1].set_xlim(left=0.0)
        axes[1].tick_params(labelleft=False)
    return figure


def _bars(axis: Axes, group: Group, size: str) -> None:
    """Draw stiffness, coefficient or force of each storey, side by side."""
    label, scale, known = _BARS[size]
    parts = [part for part in known if part[0] in group.variables]
    storeys, thick = np.asarray(group.coords["storey"].values), 0.8 / len(parts)
    for i, (name, part, color) in enumerate(parts):
        height = 0.9 * thick if len(parts) > 1 else 0.6
        axis.barh(storeys + 0.4 - (i + 0.5) * thick, scale * _along(group, name), height, color=color, label=part)
    axis.set_xlabel(label.format(unit=kilonewtons(group.variables[parts[0][0]].unit).name))
    if len(parts) > 1:
        legend_above(axis)


def _areas(axis: Axes, group: Group) -> None:
    """Draw the area of a layer that was chosen, and those of each round."""
    storeys = np.asarray(group.coords["storey"].values)
    axis.barh(storeys, _along(group, "layer_area"), 0.6, color=AFTER, label="chosen")
    if "round_layer_area" in group.variables:
        for k, areas in enumerate(group.variables["round_layer_area"].values):
            axis.plot(areas, storeys, color=MEAN, lw=0.6, marker=".", ms=3.0, label=None if k else "each round")
    axis.set_xlabel("area of a layer (m²)")
    legend_above(axis)


def _drifts(axis: Axes, group: Group) -> None:
    """Draw the drifts that the spectrum estimates without and with dampers, and those at which dampers yield."""
    every = np.asarray(group.coords["frame_storey"].values)
    for label, key, color in (
        ("without dampers", "estimated_bare_storey_drift", BEFORE),
        ("with dampers", "estimated_storey_drift", AFTER),
    ):
        axis.plot(100.0 * _along(group, key), every, color=color, marker="o", ms=3.5, label=label)
    yields = "yield_drift" in group.variables
    if yields:
        storeys = group.coords["storey"].values
        axis.plot(100.0 * _along(group, "yield_drift"), storeys, color=TARGET, ls="--", label="at yield")
    axis.set_xlabel("estimated drift (%)")
    legend_above(axis, 3 if yields else 2)


def _along(group: Group, name: str) -> np.ndarray:
    return np.asarray(group.variables[name].values, dtype=float)
