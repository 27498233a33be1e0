"""Incremental dynamic analysis: curves of all records, fragilities, intensities that limits are reached at."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.incremental import COLLAPSE, Stripes, collect_stripes
from edesign.assess.limit_fragility import LimitFragility, limit_fragility
from edesign.report.captions import file_name
from edesign.report.incremental_figures import fragility_figure, ida_figure
from edesign.report.incremental_tables import UNITS, fractile_table, fragility_table
from edesign.report.measure_columns import MEASURE_ROWS
from edesign.report.page.section import Heading, Part, Section
from edesign.report.page.source import Source

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PLACE = "incremental"  # of the groups that describe the studies
DRIFT = "interstorey_drift"
LABELS = {"spectral_acceleration": "spectral acceleration", "pga": "peak ground acceleration", "level_factor": "factor"}


def incremental(source: Source) -> Section:
    """What follows from the histories of each incremental study."""
    parts: list[Part] = []
    names = source.archive.names(PLACE)
    for name in names:
        parts += [Heading(name)] if len(names) > 1 else []
        parts += _study(source, name, source.archive.group(f"{PLACE}/{name}"))
    return Section("incremental", "Incremental dynamic analysis", (), tuple(parts))


def _study(source: Source, name: str, about: Group) -> list[Part]:
    limits = {limit: (str(measure), float(value)) for limit, (measure, value) in _limits(about).items()}
    measures = list(dict.fromkeys([DRIFT, *(measure for measure, _ in limits.values())]))
    stripes = _stripes(source, name, about, measures)
    if not stripes:
        return []
    unit, level = str(about.attributes["intensity_unit"]), str(about.attributes.get("level") or "")
    fragilities = _fragilities(stripes, limits, about)
    shown, scale = UNITS[unit]
    kind = str(about.attributes["intensity_measure"])
    label = f"{LABELS.get(kind, kind)} ({shown})" if shown != "1" else LABELS.get(kind, kind)

    def figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
        for measure in measures:
            of_measure = [found[measure] for found in stripes.values()]
            title, factor = _shown(measure)
            values = {limit: value for limit, (of, value) in limits.items() if of == measure}
            caption = f"Incremental dynamic analysis {name}: {title} of each record, and fractiles over the records."
            drawn = ida_figure(of_measure, label, scale, title, factor, values)
            yield file_name("incremental", name, measure), caption, drawn
        caption = f"Fragilities of {name}: fitted curves, and the fractions of the records that were observed."
        yield file_name("fragility", name), caption, fragility_figure(fragilities, label, scale)

    tables = [fragility_table(fragilities, unit, level)]
    for measure in measures:
        values = {limit: value for limit, (of, value) in limits.items() if of == measure}
        if values:
            tables.append(fractile_table([found[measure] for found in stripes.values()], values, unit))
    return [*source.pictures(figures), *tables]


def _limits(about: Group) -> dict[str, tuple[str, float]]:
    found = about.attributes.get("limits")
    return found if isinstance(found, dict) else {}


def _stripes(source: Source, name: str, about: Group, measures: list[str]) -> dict[str, dict[str, Stripes]]:
    """By variant and measure; variants without a single result are left out."""
    found = {}
    for variant in map(str, about.coords["variant"].values):
        try:
            found[variant] = collect_stripes(source.groups, name, variant, measures)
        except KeyError:
            continue
    return found


def _fragilities(
    stripes: dict[str, dict[str, Stripes]], limits: dict[str, tuple[str, float]], about: Group
) -> list[LimitFragility]:
    """Of every limit and of collapse; each record is scaled to all intensities, so records are what is independent."""
    variants = [str(variant) for variant in about.coords["variant"].values]
    levels = about.variables["level_intensity"].values
    found = []
    for variant, of in stripes.items():
        level = float(levels[variants.index(variant)])
        at_level = level if np.isfinite(level) else None
        for limit, (measure, value) in {**limits, "collapse": (DRIFT, COLLAPSE)}.items():
            found.append(limit_fragility(of[measure], limit, value, "capacities", at_level))
    return found


def _shown(measure: str) -> tuple[str, float]:
    """A measure in words with its unit, and that in SI."""
    title, factor = next(((name, factor) for name, key, factor in MEASURE_ROWS if key == measure), (measure, 1.0))
    return title.replace("[", "(").replace("]", ")"), factor
