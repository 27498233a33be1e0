"""Figures of a study's `vary`: response measures against the value of the project that was changed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from edesign.archive.reader import Archive
from edesign.assess.sets import HistorySet, history_sets, measure_statistics
from edesign.report.archived import archived_study
from edesign.report.assessment.derived_results import Sweep, sweeps
from edesign.report.assessment.measure_columns import measure_title
from edesign.report.assessment.tables import read_histories
from edesign.report.drawing.captions import file_name
from edesign.report.drawing.style import MEAN, RECORDS, VARIANTS, grid_figure, legend_below, legend_label, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LINES = ("-", "--", ":", "-.")
"""Of curves beyond the number of colours."""


def vary_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the measures against each value that a study varies.

    Yields:
        Name of the file, caption and figure.
    """
    study = archived_study(archive)
    if study is None or not study.vary:
        return
    for sweep in sweeps(study, history_sets(read_histories(archive))):
        if len(sweep.points) > 1 and sweep.measures:
            each = "the mean over the records" if len(sweep.curves) > 1 else "each record, and the mean over those"
            caption = f"Response by {sweep.title}: {each} that were completed."
            yield file_name("vary", sweep.vary.name, sweep.of, sweep.level), caption, vary_figure(sweep)


@styled
def vary_figure(sweep: Sweep) -> Figure:
    """Draw a panel for each measure: a line for each record, and their mean; of several places the means alone.

    Values of the first place without a unit in common stand side by side in their order.
    """
    figure, cells = grid_figure(len(sweep.measures), 2, 3.1, 2.1)
    known, curves, quantity = sweep.numbers, sweep.curves, sweep.quantities[0]
    values = dict.fromkeys(value for value, *_ in sweep.points)
    at = known[0] if known is not None else {value: float(i) for i, value in enumerate(values)}
    unit = known[1] if known is not None else ""
    label = f"{quantity} [{unit}]" if unit else quantity
    records: dict[str, None] = {}
    for found in sweep.sets if len(curves) == 1 else ():
        records |= dict.fromkeys(str(group.attributes.get("record")) for group in found.completed.values())
    for here, measure in zip(cells, sweep.measures, strict=False):
        title, shown, factor = measure_title(measure)
        for i, record in enumerate(records):
            of_record = [_of(found, record, measure) for found in sweep.sets]
            places = [at[value] for value, *_ in sweep.points]
            _line(here, places, of_record, factor, color=RECORDS, linewidth=0.8, label="" if i else "records")
        for number, (others, curve) in enumerate(curves.items()):
            means = [measure_statistics(found)[measure].mean for _, found in curve]
            style = {
                "color": MEAN if len(curves) == 1 else VARIANTS[number % len(VARIANTS)],
                "linestyle": _LINES[number // len(VARIANTS) % 4],
            }
            mean = legend_label(", ".join(others)) if others else "mean"
            places = [at[value] for value, _ in curve]
            _line(here, places, means, factor, **style, linewidth=1.8, marker="o", markersize=3.5, label=mean)
        here.set_ylabel(f"{title} [{shown}]" if shown else title)
        here.set_ylim(bottom=0.0)
        here.set_xlabel(legend_label(label))
        if known is None:
            here.set_xticks(list(at.values()), [legend_label(value) for value in at])
    handles, labels = cells[0].get_legend_handles_labels()
    head = legend_label(" and ".join(sweep.quantities[1:]))
    legend_below(figure, handles, labels, 3 if head else 2, head)
    return figure


def _line(here: Axes, places: Sequence[float], values: Sequence[float | None], factor: float, **style: Any) -> None:
    """A line from left to right through the values that are there."""
    there = sorted((x, value / factor) for x, value in zip(places, values, strict=True) if value is not None)
    here.plot([x for x, _ in there], [y for _, y in there], **style)


def _of(found: HistorySet, record: str, measure: str) -> float | None:
    """The measure of a record in a set."""
    for name, group in found.completed.items():
        if str(group.attributes.get("record")) == record:
            return found.measures[name][measure]
    return None
