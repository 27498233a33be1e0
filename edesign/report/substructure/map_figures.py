"""Where substructure tests are stable: delay of the rig over frequency of the structure, a line a compensator."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from edesign.report.drawing.captions import plain
from edesign.report.drawing.style import MEAN, logarithmic, new_figure, save, styled
from edesign.report.substructure.curves import legend_of_lines
from edesign.report.substructure.results import BEST, FIRST, NONE, WITHOUT, SubstructureResults, looks
from edesign.substructure.advice.stability_map import StabilityMap, governing_map
from edesign.substructure.advice.transfers import EXACTLY
from edesign.substructure.virtual_tests import VirtualLaboratory

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ROWS, FINER = 121, 5
"""Delays at which the map is sampled, and points from one of its frequencies to the next."""
SHADED = "#eceef1"
BOX = {"boxstyle": "square,pad=0.1", "fc": "white", "ec": "none", "alpha": 0.8}
TEETH = 8.0  # points from one to the next
TO_UNSTABLE = -90.0  # degrees from a contour, which has its higher side to the left


def map_figures(results: SubstructureResults) -> Iterator[tuple[str, str, Figure]]:
    """Yield the stability map of the test that a delay makes unstable first.

    Yields:
        Name of the file, caption and figure.
    """
    laboratory = results.described.tests
    if laboratory is None:
        return
    direct = {test: results.driven(test).variables.get("direct_deformation") for test in results.tests}
    motions = {
        test: np.asarray(one.values, dtype=float)
        for test, one in direct.items()
        if one is not None and results.is_closed(test) and np.any(one.values)
    }
    found = governing_map(laboratory, motions)
    if found is not None:
        test, stability = found
        yield (
            "stability_map",
            _caption(test, stability),
            map_figure(test, stability, _kinds(laboratory), results.best(test)),
        )


def draw_map(laboratory: VirtualLaboratory, best: str | None, path: Path) -> bool:
    """Draw the stability map of tests that have not been run.

    Args:
        best: compensator that is recommended.
        path: the figure; its suffix says the format.

    Returns:
        Whether there is a map.

    Raises:
        InputError: a structure is undamped, or a record cannot be read.
        ArchiveError: the figure cannot be written.
    """
    drives = {test.name: laboratory.drives[test.name] for test in laboratory.tests}
    motions = {name: laboratory.direct(drive).deformation for name, drive in drives.items() if drive.ground is not None}
    found = governing_map(laboratory, motions)
    if found is not None:
        save(map_figure(*found, _kinds(laboratory), best), path)
    return found is not None


def _kinds(laboratory: VirtualLaboratory) -> dict[str, str]:
    return {name: one.kind for name, one in laboratory.file.compensators.items()}


def _caption(test: str, of: StabilityMap) -> str:
    adaptive = [f"{one.compensator} {one.modelled_as}" for one in of.regions if one.modelled_as != EXACTLY]
    unstable = [one.compensator for one in of.regions if not of.is_stable(one.compensator)]
    here = f" There it is unstable with {', '.join(unstable)}." if unstable else ""
    frozen = f" Adaptive ones keep what they find in this test ({'; '.join(adaptive)})." if adaptive else ""
    without = "".join(f" {one}." for one in _without_line(of))
    left = "".join(f" Not shown: {name}, {why}." for name, why in of.left_out)
    return (
        f"Stability map, {test}: delay of the rig for slow motions over the frequency of mode {of.mode} with the "
        "specimen. Teeth of a line point to where the test is unstable with this compensator. The dot is the test as "
        f"it is: {plain(of.frequency)} Hz, {plain(1e3 * of.delay)} ms.{here} Only masses change the frequency, with "
        f"m ~ 1/f²; damping ratios and the specimen's share of the stiffness stay. {_of_rig(of)} changes. "
        f"The law is linearised at {plain(1e3 * of.amplitude)} mm. "
        f"Compensators keep their settings.{frozen}{without} Lines are of the continuous loop; the verdict on the dot "
        f"counts main steps.{left}"
    )


def _without_line(of: StabilityMap) -> Iterator[str]:
    """Why compensators have no line, in sentences without a full stop."""
    for stable, what in ((True, "stable"), (False, "unstable")):
        if names := of.without_line(stable):
            yield f"No line: {what} all over the map with {', '.join(names)}"


def _of_rig(of: StabilityMap) -> str:
    if of.least <= 0.0:
        return "Of the rig its pure delay"
    return f"The rig keeps its own lag of {plain(1e3 * of.least)} ms (grey), and its pure delay"


@styled
def map_figure(test: str, of: StabilityMap, kinds: Mapping[str, str], best: str | None) -> Figure:
    """Draw a stability map.

    Args:
        kinds: of the compensators by their names.
        best: the compensator that is shown as such.
    """
    from matplotlib.patheffects import TickedStroke
    from scipy.interpolate import PchipInterpolator

    figure, ((axis,),) = new_figure(1, 1, 5.6, 3.9)
    delay = np.linspace(of.least, of.largest, ROWS)
    place = np.log(of.frequencies)
    finer = np.linspace(place[0], place[-1], FINER * (place.size - 1) + 1)
    chosen = looks(kinds, best)
    lines = []
    for region in of.regions:
        color, style = chosen[region.compensator]
        label = WITHOUT if kinds[region.compensator] == NONE else region.compensator
        lines.append((label, color, style))
        inside = np.column_stack([_distance(delay, intervals, of) for intervals in region.delays])
        inside = PchipInterpolator(place, inside, axis=1)(finer)
        width = 1.1 if color in (FIRST, BEST) else 1.9  # compensators that agree lie on each other
        for line, thick in ((style, width), ("-", 0.6)):
            edge = axis.contour(np.exp(finer), 1e3 * delay, inside, [0.0], colors=color, linestyles=line)
            edge.set(linewidth=thick, zorder=3.2 - 0.2 * width)
        edge.set(path_effects=[TickedStroke(spacing=TEETH, angle=TO_UNSTABLE, length=0.5)])
    if of.least > 0.0:
        axis.axhspan(0.0, 1e3 * of.least, color=SHADED, lw=0, zorder=0.5)
    axis.plot([of.frequency], [1e3 * of.delay], "o", color=MEAN, ms=5.0, zorder=5)
    at = (of.frequency, 1e3 * of.delay)
    axis.annotate(test, at, (0.0, -6.0), textcoords="offset points", ha="center", va="top", bbox=BOX)
    said = list(_without_line(of))
    if len(of.without_line(True)) + len(of.without_line(False)) == len(of.regions):
        axis.text(0.5, 0.5, "\n".join(said), transform=axis.transAxes, ha="center", va="center", wrap=True, bbox=BOX)
    logarithmic(axis)
    axis.set_xlim(of.frequencies[0], of.frequencies[-1])
    axis.set_ylim(0.0, 1e3 * of.largest)
    axis.set_xlabel(f"frequency of mode {of.mode} (Hz)")
    axis.set_ylabel("delay of the rig (ms)")
    legend_of_lines(figure, lines)
    return figure


def _distance(delay: np.ndarray, stable: Sequence[tuple[float, float]], of: StabilityMap) -> np.ndarray:
    """How far delays (n,) are within an interval, s; less than zero: outside. Far away it is the height of the map."""
    height = of.largest - of.least
    inside = [np.minimum(delay - begin, end - delay) for begin, end in stable]
    return np.clip(np.max([np.full(delay.size, -height), *inside], axis=0), -height, height)
