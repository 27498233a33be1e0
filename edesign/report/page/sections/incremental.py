"""Incremental dynamic analysis: curves of all records, fragilities, intensities that limits are reached at."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from edesign.archive.reader import Archive
from edesign.report.incremental_figures import results_figures
from edesign.report.incremental_results import IncrementalResults, read_incremental
from edesign.report.incremental_tables import results_tables
from edesign.report.page.section import Heading, Part, Section
from edesign.report.page.source import Source

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def incremental(source: Source) -> Section:
    """What follows from the histories of each incremental study."""
    found = read_incremental(source.archive, source.groups)
    parts: list[Part] = []
    for one in found:
        parts += [Heading(one.name)] if len(found) > 1 else []
        parts += _study(source, one)
    return Section("incremental", "Incremental dynamic analysis", tuple(_asked(one) for one in found), tuple(parts))


def _study(source: Source, results: IncrementalResults) -> list[Part]:
    def incremental_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
        return results_figures(results)

    return [*source.pictures(incremental_figures), *results_tables(results)]


def _asked(results: IncrementalResults) -> str:
    """How many histories there are, and how they ended, in a sentence."""
    stripes = next(iter(next(iter(results.stripes.values())).values()))
    counts = [
        f"{variant}: " + ", ".join(f"{count} {state}" for state, count in sorted(states.items()))
        for variant, states in results.states.items()
    ]
    return (
        f"{results.name}: {len(stripes.records)} records at {stripes.intensity.size} intensities; histories of "
        + "; ".join(counts)
        + "."
    )
