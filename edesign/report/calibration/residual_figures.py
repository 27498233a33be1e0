"""What the residual of all tests depends on, before and after a calibration."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from edesign.calibration.residual.curves import FreeCurve, plainest
from edesign.calibration.residual.pool import Dependence
from edesign.calibration.residual.series import Residual, Stage
from edesign.calibration.residual.shape import NEARLY, WORTH_TELLING
from edesign.report.calibration.view import COLOURS, View, excess
from edesign.report.drawing.style import grid_figure, legend_below, new_figure, styled

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_PANELS = 6
_LEAST = 0.01  # share of the squared residual that is worth a panel
_SCALES = {"m": (1e3, "mm"), "m/s": (1e3, "mm/s"), "degC": (1.0, "°C")}
_CELLS = 20  # of a map each way; even: no cell lies across zero
_LEVELS = 11  # of colour
_FULL = 98.0  # percentile of the map's values at the end of the colours


def dependence_figures(view: View) -> Iterator[tuple[str, str, Figure]]:
    """Residual against the six things that explain most of it; nothing where it depends on nothing."""
    shown = telling_dependences(view)
    if not shown:
        return
    first = shown[0]["declared"]
    after = f", {_share(shown[0]['corrected'])} after" if "corrected" in view.stages else ""
    caption = (
        "Residual against what explains most of it, means of bins over all tests: a slope or a step is what the law "
        f"lacks, a flat line at zero is nothing. Alone the {first.driver} explains {_share(first)} of the squared "
        f"residual as declared{after}; the titles give it for each. As a "
        "force: in per cent of the rms force of a test; as a factor: of the predicted force."
    )
    yield "dependences", caption, _dependences_figure(view, shown)


def telling_dependences(view: View) -> list[dict[Stage, Dependence]]:
    """The same dependence at each stage, strongest first; of each driver the action that explains more."""
    every = view.dependences
    by_driver: dict[str, int] = {}
    for i, one in enumerate(every["declared"]):
        best = by_driver.get(one.driver)
        if best is None or excess(one) > excess(every["declared"][best]):
            by_driver[one.driver] = i
    ranked = sorted(by_driver.values(), key=lambda i: -excess(every["declared"][i]))
    ranked = [i for i in ranked[:_PANELS] if excess(every["declared"][i]) >= _LEAST]
    return [{stage: found[i] for stage, found in every.items()} for i in ranked]


def _share(one: Dependence) -> str:
    return f"{100.0 * excess(one):.0f} %"


@styled
def _dependences_figure(view: View, shown: list[dict[Stage, Dependence]]) -> Figure:
    figure, cells = grid_figure(len(shown), 3, 2.55, 2.1)
    for axis, stages in zip(cells, shown, strict=True):
        for stage, one in stages.items():
            scale, unit = _SCALES.get(one.unit, (1.0, one.unit))
            order = np.argsort(one.centre)
            x, y = scale * one.centre[order], 100.0 * one.mean[order]
            axis.plot(x, y, "o-", ms=2.6, lw=0.9, color=COLOURS[stage], label=view.stages[stage])
        first = stages["declared"]
        axis.axhline(0.0, color="#111111", lw=0.5, zorder=0.9)
        if first.driver == "test order":
            names = {one.order: one.name for one in view.residuals("declared")}
            axis.set_xticks(list(names), list(names.values()), rotation=90.0, fontsize=6.0)
        axis.set_xlabel(f"{first.driver}{f' ({unit})' if unit else ''}")
        axis.set_ylabel("as a force (%)" if first.action == "force" else "as a factor (%)")
        axis.set_title("explains " + " → ".join(_share(one) for one in stages.values()), fontsize=7.5, loc="left")
    legend_below(figure, *cells[0].get_legend_handles_labels(), 2)
    return figure


def curve_figures(view: View) -> Iterator[tuple[str, str, Figure]]:
    """Smooth functions of displacement and velocity in what is left; nothing where none takes much of it."""
    every = {one.of: one for one in view.calibration.unexplained_curves}
    best = plainest(list(every.values()), NEARLY)
    if best is None or best.share < WORTH_TELLING:
        return
    shown = [every["displacement"], every["velocity"], *([best] if len(best.curves) > 1 else [])]
    factor = " The factor of a product has a mean square of 1." if best.of == "product" else ""
    caption = (
        "What is left as a smooth function of the displacement alone and of the velocity alone, whatever its equation, "
        "found in the fitted tests, with its 95 % band. The titles say how much of what is left in the validation "
        f"tests it takes: by chance none. No law file carries such a curve.{factor}"
    )
    yield "curves", caption, _curves_figure(shown)


@styled
def _curves_figure(shown: list[FreeCurve]) -> Figure:
    panels = [(found, curve) for found in shown for curve in found.curves]
    figure, cells = grid_figure(len(panels), 2, 3.4, 2.3)
    for axis, (found, curve) in zip(cells, panels, strict=True):
        alone, factor = len(found.curves) == 1, found.of == "product" and curve.driver == "velocity"
        scale = 1.0 if factor else 1e-3
        x, (low, high) = 1e3 * curve.at, curve.band
        axis.fill_between(x, scale * low, scale * high, color=COLOURS["corrected"], alpha=0.25, lw=0.0)
        axis.plot(x, scale * curve.value, lw=1.1, color=COLOURS["corrected"])
        axis.axhline(0.0, color="#111111", lw=0.5, zorder=0.9)
        axis.set_xlabel(f"{curve.driver} (mm{'/s' if curve.driver == 'velocity' else ''})")
        axis.set_ylabel("factor" if factor else "force (kN)")
        what = f"{curve.driver} alone" if alone else f"{found.of}, {curve.driver}"
        axis.set_title(f"{what}: takes {100.0 * found.share:.0f} %", fontsize=7.5, loc="left")
    return figure


def map_figures(view: View) -> Iterator[tuple[str, str, Figure]]:
    """Mean residual over displacement and velocity."""
    if not view.residuals("declared"):
        return
    caption = (
        "Mean residual over displacement and velocity, all tests together, in per cent of the rms force of each. "
        "Red: more force was measured than predicted. One colour on each side is an error of stiffness (left and "
        "right) or damping (above and below); corners alone are an error at large motion."
    )
    yield "map", caption, _maps_figure(view, {stage: residual_map(view.residuals(stage)) for stage in view.stages})


@styled
def _maps_figure(view: View, maps: dict[Stage, ResidualMap]) -> Figure:
    from matplotlib import colormaps
    from matplotlib.colors import BoundaryNorm

    figure, (axes,) = new_figure(1, len(maps), 1.2 + 3.3 * len(maps), 3.0)
    before = np.abs(maps["declared"].mean)
    largest = float(f"{max(100.0 * float(np.nanpercentile(before, _FULL)), 1e-9):.2g}")
    norm = BoundaryNorm(np.linspace(-largest, largest, _LEVELS + 1), _LEVELS)
    colours = colormaps["RdBu_r"].resampled(_LEVELS).with_extremes(under="#053061", over="#67001f")
    for axis, (stage, found) in zip(axes, maps.items(), strict=True):
        edges = 1e3 * found.displacement, 1e3 * found.velocity
        mesh = axis.pcolormesh(*edges, 100.0 * np.ma.masked_invalid(found.mean.T), cmap=colours, norm=norm)
        axis.set_title(view.stages[stage], fontsize=8.0, loc="left")
        axis.set_xlabel("displacement (mm)")
    axes[0].set_ylabel("velocity (mm/s)")
    for axis in axes[1:]:
        axis.tick_params(labelleft=False)
    bar = figure.colorbar(mesh, ax=axes, extend="both", format="%.3g", ticks=largest * np.linspace(-1.0, 1.0, 5))
    bar.set_label("residual (%)")
    return figure


@dataclass(frozen=True)
class ResidualMap:
    """Mean residual of each cell.

    Attributes:
        displacement: (d + 1,) edges, m.
        velocity: (v + 1,) edges, m/s, closer where it is small: tests of all frequencies fill the map.
        mean: (d, v) of the rms force of the tests; nan in cells without samples.
    """

    displacement: np.ndarray
    velocity: np.ndarray
    mean: np.ndarray


def residual_map(tests: Sequence[Residual]) -> ResidualMap:
    """Mean residual over displacement and velocity, each test over its own rms force."""
    u, v = (np.concatenate([getattr(test, name) for test in tests]) for name in ("displacement", "velocity"))
    error = np.concatenate([test.residual / test.rms_force for test in tests])
    even = np.linspace(-1.0, 1.0, _CELLS + 1)
    edges = (even * _reach(u), even * np.abs(even) * _reach(v))
    count = np.histogram2d(u, v, edges)[0]
    total = np.histogram2d(u, v, edges, weights=error)[0]
    mean = np.divide(total, count, out=np.full_like(total, np.nan), where=count > 0.0)
    return ResidualMap(*edges, mean)


def _reach(values: np.ndarray) -> float:
    return max(float(np.max(np.abs(values))) * (1.0 + 1e-12), float(np.finfo(float).tiny))
