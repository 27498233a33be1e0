"""The same history at two temperatures of the dampers."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from edesign.archive.reader import Archive
from edesign.report.drawing.captions import at_level, file_name
from edesign.report.drawing.style import AFTER, VARIANTS
from edesign.report.response.directions import in_each_direction
from edesign.report.response.histories import by_temperature, histories, missing_text, with_results
from edesign.report.response.response_figures import GROUND, ROWS, Series, numbers, response_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

COLORS = (AFTER, VARIANTS[0], VARIANTS[3], VARIANTS[2])
"""From the variant's own temperature to further ones."""


@in_each_direction
def temperature_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the histories that differ in temperature alone, overlaid.

    Yields:
        Name of the file, caption and figure.
    """
    for (variant, level, record), chosen in by_temperature(histories(archive)).items():
        series = [
            Series(history.temperature_label, group, COLORS[i % len(COLORS)])
            for i, (history, group) in enumerate(with_results(archive, chosen, GROUND.variable))
            if any(row.variable in group.variables for row in ROWS)
        ]
        if len(series) > 1:
            who = f"{variant} under " if variant else ""
            about = f"Temperature of the dampers: {who}{chosen[0].motion}{at_level(level)}. "
            name = file_name("temperature", variant, level, record)
            yield name, f"{about}{numbers(series)}{missing_text(chosen)}", response_figure(series)
