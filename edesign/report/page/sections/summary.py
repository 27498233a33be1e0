"""The first section: what was asked, what was found, what governs, and what failed by name."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import Any

from edesign.assess.measures import Located, located_measure
from edesign.assess.sets import HistorySet
from edesign.assess.statistics import STATISTICS, Statistics
from edesign.project.building import Building
from edesign.report.archived import archived_frame, archived_hazard
from edesign.report.assessment.change_tables import changes_in_short
from edesign.report.assessment.measure_columns import ROUNDING
from edesign.report.assessment.measure_tables import missing_notes, motion_notes
from edesign.report.drawing.captions import at_level, plain, record_label
from edesign.report.html.section import Headline, Headlines, Part, Section, Warnings
from edesign.report.page.sections.incremental import incremental_summary, incremental_tiles
from edesign.report.page.sections.verdicts import verdict_table, verdict_tiles
from edesign.report.page.sections.warnings import warning_table
from edesign.report.page.source import Source
from edesign.report.response.use_tables import use_in_short
from edesign.report.tables.cell import Quantity, Value
from edesign.report.tables.column import Column, col, count, text
from edesign.report.tables.number import significant
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import MRAD, PERCENT, Unit

Measured = tuple[HistorySet, dict[str, Statistics]]
RESIDUAL = "residual_interstorey_drift"
NO_RESIDUAL = 1e-4  # rad; 0.35 mm in a storey: what is less is less than frames are plumb, and has no tile
TILES = (  # label, measure, unit, unit in SI
    ("Interstorey drift", "interstorey_drift", "%", 0.01),
    ("Residual interstorey drift", RESIDUAL, "%", 0.01),
    ("Roof acceleration", "roof_acceleration_m_s2", "m/s2", 1.0),
    ("Base shear", "base_shear_N", "kN", 1e3),
    ("Column shear at the base", "column_base_shear_N", "kN", 1e3),
)
MEAN, MAXIMUM = STATISTICS["mean"], STATISTICS["maximum"]
NAMED = 20
"""Failed analyses that are named at once; the others are in the table of all analyses."""


def _drift(header: str, of: Callable[[Statistics], float | None], measure: str) -> Column[Measured]:
    return col(header, PERCENT, lambda one: of(one[1][measure]), 3, negligible=ROUNDING)


def _place(one: Measured, measure: str) -> Located | None:
    """The place of the largest value of a measure."""
    histories, found = one
    governing = found[measure].governing
    return located_measure(histories.histories[governing], measure) if governing else None


def _storey(one: Measured) -> int | None:
    place = _place(one, "interstorey_drift")
    return None if place is None else place.storey


def _record(one: Measured) -> str | None:
    name = one[1]["interstorey_drift"].governing
    return record_label(str(one[0].histories[name].attributes.get("record") or name)) if name else None


def _largest(header: str, unit: Unit, measure: str) -> Column[Measured]:
    """A column of the largest value with the member that has it."""

    def of(one: Measured) -> Value:
        place = _place(one, measure)
        if place is None:
            return None
        if place.member and abs(place.value) >= ROUNDING:
            return f"{significant(place.value / unit.si, 3)} ({place.member})"
        return Quantity(place.value, unit, 3, negligible=ROUNDING, beside=True)

    return replace(text(header, of, optional=True), unit=unit)


GOVERNING = TableSpec[Measured](
    "governing_response",
    "Governing response",
    (
        text("variant", lambda one: one[0].variant or None),
        text("level", lambda one: one[0].level or None),
        count("histories", lambda one: f"{len(one[0].completed)} of {len(one[0].histories)}"),
        _drift("drift, mean", MEAN, "interstorey_drift"),
        _drift("drift, largest", MAXIMUM, "interstorey_drift"),
        _drift("residual drift, mean", MEAN, RESIDUAL),
        _drift("residual drift, largest", MAXIMUM, RESIDUAL),
        count("storey", _storey),
        text("record", _record),
        _largest("beam rotation, largest", MRAD, "beam_plastic_rotation_rad"),
        _largest("column rotation, largest", MRAD, "column_plastic_rotation_rad"),
        _largest("damper strain, largest", PERCENT, "damper_strain"),
    ),
    notes=(
        "Largest: over all storeys or members and completed histories; mean: over the completed histories, of the "
        "largest storey of each. Storey and record are those of the largest drift.",
    ),
    keys=2,
)


def summary(source: Source) -> Section:
    """Return the section with the main results for readers who read nothing else."""
    parts: list[Part] = [*_failures(source.entries), *_warnings(source)]
    rows = (
        verdict_tiles(source.verdicts, source.study),
        _tiles(source.statistics),
        *map(incremental_tiles, source.incremental),
    )
    parts += [Headlines(tiles) for tiles in rows if tiles]
    verdicts = verdict_table(source.verdicts, source.study)
    sets = [found for found, _ in source.statistics]
    tables = (
        verdicts,
        governing_table(source.statistics),
        use_in_short(sets, archived_hazard(source.archive), archived_frame(source.archive)),
        changes_in_short(sets),
    )
    parts += [table for table in tables if table.rows]
    return Section("summary", "Summary", (_asked(source),), tuple(parts))


def governing_table(sets: Sequence[Measured]) -> Table:
    """Return for each variant and level the mean and the largest drift, and where the largest values occur.

    Every statistic says of how many histories it is: those that did not complete have no peak.
    """
    return GOVERNING.of(sets, notes=[*motion_notes(found := [one for one, _ in sets]), *missing_notes(found)])


def _tiles(sets: Iterable[Measured]) -> tuple[Headline, ...]:
    """Means of one variant, or of two beside each other, for each level; where one level has more, only the table."""
    levels: dict[str, list[Measured]] = {}
    for histories, found in sets:
        if " at " not in histories.variant and histories.completed:
            levels.setdefault(histories.level, []).append((histories, found))
    if any(len(beside) > 2 for beside in levels.values()):
        return ()
    tiles = []
    for level, beside in levels.items():
        for label, measure, unit, factor in TILES:
            means = [(histories.variant, found[measure]) for histories, found in beside]
            shown = [(variant, s.mean / factor, s.count) for variant, s in means if s.mean is not None]
            negligible = measure == RESIDUAL and all(value * factor < NO_RESIDUAL for _, value, _ in shown)
            if len(shown) == len(beside) and not negligible:
                tiles.append(_tile(f"{label}{at_level(level)}", unit, shown))
    return tuple(tiles)


def _tile(label: str, unit: str, shown: Sequence[tuple[str, float, int]]) -> Headline:
    values = " -> ".join(plain(value) for _, value, _ in shown)
    counts = [count for _, _, count in shown]
    of = f"mean of {counts[0]}" if len(set(counts)) == 1 else f"means of {' and '.join(map(str, counts))}"
    if counts[0] == 1 and len(set(counts)) == 1:
        of = "one record"
    detail = of
    if len(shown) == 2:
        (first, before, _), (second, after, _) = shown
        change = f", {100 * (after / before - 1):+.0f} %".replace("-", "\N{MINUS SIGN}") if before > 0.0 else ""
        detail = f"{first} -> {second}{change}; {of}"
    return Headline(f"{values}\N{NO-BREAK SPACE}{unit}", label, detail)


def _asked(source: Source) -> str:
    """What the run was to find, in a few sentences."""
    entries = [item for item in source.entries if not source.groups[item["name"]].attributes.get("incremental")]
    sets = source.sets
    scaled = [incremental_summary(one) for one in source.incremental]
    if not entries:
        return " ".join(scaled) or "Ground motions fitted to a spectrum; no structure was analysed."
    done = sum(item["status"] == "completed" for item in entries)
    kinds = {kind: sum(item["kind"] == kind for item in entries) for kind in dict.fromkeys(i["kind"] for i in entries)}
    counted = ", ".join(f"{count} {_plural(str(kind), count)}" for kind, count in kinds.items() if kind)
    found = [f"{done} of {len(entries)} analyses were completed ({counted})."]
    if sets:
        variants = _listed(found.variant for found in sets)
        levels = _listed(found.level for found in sets)
        records = {str(g.attributes.get("record")) for one in sets for g in one.histories.values()}
        whole = "The building" if isinstance(source.base, Building) else "The frame"
        subject = f"{whole} ({variants})" if variants else whole
        some = " and without a level" if levels and any(not one.level for one in sets) else ""
        motions = f"{len(records)} ground motion{'s' * (len(records) > 1)}{at_level(levels)}{some}"
        found.insert(0, f"{subject} was subjected to {motions}.")
    return " ".join([*found, *scaled])


def _plural(kind: str, count: int) -> str:
    words = {
        "history": ("history", "histories"),
        "modal": ("modal", "modal"),
        "gravity": ("gravity", "gravity"),
        "target": ("state at a target displacement", "states at target displacements"),
    }
    return words.get(kind, (kind, f"{kind}s"))[count != 1]


def _listed(names: Iterable[str]) -> str:
    found = [name for name in dict.fromkeys(names) if name]
    return found[0] if len(found) == 1 else f"{', '.join(found[:-1])} and {found[-1]}" if found else ""


def _warnings(source: Source) -> list[Part]:
    """How many warnings there are; the list has a section of its own."""
    count = len(warning_table(source).rows)
    if not count:
        return []
    counted, what = ("1 warning stands", "it applies") if count == 1 else (f"{count} warnings stand", "they apply")
    return [Warnings("Read the warnings", (f"{counted} in the section Warnings, with what {what} to.",))]


def _failures(entries: Sequence[dict[str, Any]]) -> list[Part]:
    failed = [item for item in entries if item["status"] == "failed"]
    if not failed:
        return []
    lines = [f"{item['name']}: {item['reason'] or 'no reason is known'}" for item in failed[:NAMED]]
    more = len(failed) - len(lines)
    lines += [f"and {more} more, see the table of all analyses"] if more else []
    return [Warnings(f"{len(failed)} of {len(entries)} analyses failed", tuple(lines))]
