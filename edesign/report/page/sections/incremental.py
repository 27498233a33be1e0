"""Incremental dynamic analysis: curves of all records, fragilities, intensities that limits are reached at."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.reader import Archive
from edesign.report.capacity.incremental_figures import results_figures
from edesign.report.capacity.incremental_results import DRIFT, UNITS, IncrementalResults
from edesign.report.capacity.incremental_tables import results_tables
from edesign.report.drawing.captions import plain
from edesign.report.html.section import Heading, Headline, Part, Section
from edesign.report.page.source import Source

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def incremental(source: Source) -> Section:
    """Return the section on the incremental studies."""
    found = source.incremental
    parts: list[Part] = []
    for one in found:
        parts += [Heading(one.name)] if len(found) > 1 else []
        parts += _study(source, one)
    return Section("incremental", "Incremental dynamic analysis", tuple(map(incremental_summary, found)), tuple(parts))


def incremental_tiles(results: IncrementalResults) -> tuple[Headline, ...]:
    """Return the number of collapses of each variant, and the median intensity of every limit with a fragility."""
    unit, scale = UNITS[results.unit]
    label = results.label.removesuffix(f" ({unit})")
    tiles = []
    for stripes in results.stripes_of(DRIFT):
        collapsed = int(np.isposinf(stripes.values).any(axis=1).sum())
        records = f"{collapsed} of {len(stripes.records)}"
        tiles.append(Headline(records, f"Records that collapse, {results.name}", stripes.variant))
    for one in results.fragilities:
        if one.fit is None:
            continue
        value = plain(one.fit.theta / scale) + (f"\N{NO-BREAK SPACE}{unit}" if unit != "1" else "")
        detail = f"{one.variant}; dispersion {plain(one.fit.beta)}, {one.records} records"
        if one.margin is not None:
            detail += f"; {plain(one.margin)} times {results.level}"
        tiles.append(Headline(value, f"Median {label} at {one.limit}, {results.name}", detail))
    return tuple(tiles)


def _study(source: Source, results: IncrementalResults) -> list[Part]:
    def incremental_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
        return results_figures(results)

    return [*source.pictures(incremental_figures), *results_tables(results)]


def incremental_summary(results: IncrementalResults) -> str:
    """Return how many histories there are, and how they ended, in a sentence."""
    stripes = next(iter(next(iter(results.stripes.values())).values()))
    counts = [
        f"{variant}: " + ", ".join(f"{count} {state}" for state, count in sorted(states.items()))
        for variant, states in results.states.items()
    ]
    count = len(stripes.records)
    records = "1 record" if count == 1 else f"{count} records"
    return f"{results.name}: {records} at {stripes.intensity.size} intensities; histories of {'; '.join(counts)}."
