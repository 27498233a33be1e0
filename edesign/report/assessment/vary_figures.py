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
from edesign.report.drawing.style import MEAN, RECORDS, grid_figure, legend_label, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def vary_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the measures against each value that a study varies.

    Yields:
        Name of the file, caption and figure.
    """
    study = archived_study(archive)
    if study is None or not study.vary:
        return
    for sweep in sweeps(study, history_sets(read_histories(archive))):
        if len(sweep.values) > 1 and sweep.measures:
            caption = f"Response by {sweep.title}: each record, and the mean over those that were completed."
            yield file_name("vary", sweep.vary.name, sweep.of, sweep.level), caption, vary_figure(sweep)


@styled
def vary_figure(sweep: Sweep) -> Figure:
    """Draw a panel for each measure: a line for each record, and their mean.

    Values without a unit in common stand side by side in their order.
    """
    figure, cells = grid_figure(len(sweep.measures), 2, 3.1, 2.1)
    known = sweep.numbers
    places = known[0] if known is not None else tuple(float(i) for i in range(len(sweep.values)))
    unit = known[1] if known is not None else ""
    label = f"{sweep.quantity} [{unit}]" if unit else sweep.quantity
    records: dict[str, None] = {}
    for found in sweep.sets:
        records |= dict.fromkeys(str(group.attributes.get("record")) for group in found.completed.values())
    for here, measure in zip(cells, sweep.measures, strict=False):
        title, shown, factor = measure_title(measure)
        for i, record in enumerate(records):
            values = [_of(found, record, measure) for found in sweep.sets]
            _line(here, places, values, factor, color=RECORDS, linewidth=0.8, label="" if i else "records")
        means = [measure_statistics(found)[measure].mean for found in sweep.sets]
        _line(here, places, means, factor, color=MEAN, linewidth=1.8, marker="o", markersize=3.5, label="mean")
        here.set_ylabel(f"{title} [{shown}]" if shown else title)
        here.set_ylim(bottom=0.0)
        here.set_xlabel(legend_label(label))
        if known is None:
            here.set_xticks(places, [legend_label(value) for value in sweep.values])
    handles, labels = cells[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=2)
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
