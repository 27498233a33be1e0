"""The first section: what was asked, what was found, what governs, and what failed by name."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from edesign.assess.measures import located_measure
from edesign.assess.sets import HistorySet
from edesign.assess.statistics import Statistics
from edesign.report.assessment.change_tables import changes_in_short
from edesign.report.assessment.measure_columns import ROUNDING
from edesign.report.assessment.measure_tables import missing_notes
from edesign.report.drawing.captions import at_level, plain, record_label
from edesign.report.html.section import Headline, Headlines, Part, Section, Warnings
from edesign.report.page.sections.incremental import incremental_summary, incremental_tiles
from edesign.report.page.sections.verdicts import verdict_tiles
from edesign.report.page.sections.warnings import warning_table
from edesign.report.page.source import Source
from edesign.report.tables.table import Table, number, whole

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
GOVERNING = (
    ("drift, mean [%]", "drift, largest [%]", "interstorey_drift", 0.01),
    ("residual drift, mean [%]", "residual drift, largest [%]", RESIDUAL, 0.01),
)
MEMBERS = (
    ("beam rotation, largest [mrad]", "beam_plastic_rotation_rad", 1e-3),
    ("column rotation, largest [mrad]", "column_plastic_rotation_rad", 1e-3),
    ("damper strain, largest [%]", "damper_strain", 0.01),
)
NAMED = 20
"""Failed analyses that are named at once; the others are in the table of all analyses."""


def summary(source: Source) -> Section:
    """Return the section with the main results for readers who read nothing else."""
    parts: list[Part] = [*_failures(source.entries), *_doubts(source)]
    rows = (
        verdict_tiles(source.verdicts, source.study),
        _tiles(source.statistics),
        *map(incremental_tiles, source.incremental),
    )
    parts += [Headlines(tiles) for tiles in rows if tiles]
    tables = (governing_table(source.statistics), changes_in_short([found for found, _ in source.statistics]))
    parts += [table for table in tables if table.rows]
    return Section("summary", "Summary", (_asked(source),), tuple(parts))


def governing_table(sets: Sequence[Measured]) -> Table:
    """Return for each variant and level the mean and the largest drift, and where the largest values occur.

    Every statistic says of how many histories it is: those that did not complete have no peak.
    """
    members = [column for column in MEMBERS if any(found[column[1]].count for _, found in sets)]
    headers = [header for mean, largest, _, _ in GOVERNING for header in (mean, largest)]
    columns = ("variant", "level", "histories", *headers, "storey", "record")
    table = Table(
        "Governing response", (*columns, *(header for header, _, _ in members)), left=2, name="governing_response"
    )
    for histories, found in sets:
        values = [value for _, _, measure, unit in GOVERNING for value in _pair(found[measure], unit)]
        name = [histories.variant or "-", histories.level or "-"]
        count = f"{len(histories.completed)} of {len(histories.histories)}"
        places = [_located(histories, found[measure], measure, unit) for _, measure, unit in members]
        table.rows.append([*name, count, *values, *_governs(histories, found["interstorey_drift"]), *places])
    if table.rows:
        table.notes.append(
            "Largest: over all storeys or members and completed histories; mean: over the completed histories, of the "
            "largest storey of each. Storey and record are those of the largest drift."
        )
        table.notes += missing_notes([histories for histories, _ in sets])
    return table


def _pair(found: Statistics, unit: float) -> tuple[str, str]:
    return number(found.mean, 3, unit, negligible=ROUNDING), number(found.maximum, 3, unit, negligible=ROUNDING)


def _governs(histories: HistorySet, drift: Statistics) -> tuple[str, str]:
    if not drift.governing:
        return "-", "-"
    group = histories.histories[drift.governing]
    place = located_measure(group, "interstorey_drift")
    storey = "-" if place is None or place.storey is None else whole(place.storey)
    return storey, record_label(str(group.attributes.get("record") or drift.governing))


def _located(histories: HistorySet, found: Statistics, measure: str, unit: float) -> str:
    """The largest value with the member that has it."""
    place = located_measure(histories.histories[found.governing], measure) if found.governing else None
    if place is None:
        return "-"
    value = number(place.value, 3, unit, negligible=ROUNDING)
    return value if value == "0" or not place.member else f"{value} ({place.member})"


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
        return " ".join(scaled) or "Ground motions fitted to a spectrum; no frame was analysed."
    done = sum(item["status"] == "completed" for item in entries)
    kinds = {kind: sum(item["kind"] == kind for item in entries) for kind in dict.fromkeys(i["kind"] for i in entries)}
    counted = ", ".join(f"{count} {_plural(str(kind), count)}" for kind, count in kinds.items() if kind)
    found = [f"{done} of {len(entries)} analyses were completed ({counted})."]
    if sets:
        variants = _listed(found.variant for found in sets)
        levels = _listed(found.level for found in sets)
        records = {str(g.attributes.get("record")) for one in sets for g in one.histories.values()}
        frame = f"The frame ({variants})" if variants else "The frame"
        some = " and without a level" if levels and any(not one.level for one in sets) else ""
        motions = f"{len(records)} ground motion{'s' * (len(records) > 1)}{at_level(levels)}{some}"
        found.insert(0, f"{frame} was subjected to {motions}.")
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


def _doubts(source: Source) -> list[Part]:
    """How much is doubtful; the list has a section of its own."""
    count = len(warning_table(source).rows)
    if not count:
        return []
    told, what = ("1 warning stands", "it applies") if count == 1 else (f"{count} warnings stand", "they apply")
    return [Warnings("Read the warnings", (f"{told} in the section Warnings, with what {what} to.",))]


def _failures(entries: Sequence[dict[str, Any]]) -> list[Part]:
    failed = [item for item in entries if item["status"] == "failed"]
    if not failed:
        return []
    lines = [f"{item['name']}: {item['reason'] or 'no reason is known'}" for item in failed[:NAMED]]
    more = len(failed) - len(lines)
    lines += [f"and {more} more, see the table of all analyses"] if more else []
    return [Warnings(f"{len(failed)} of {len(entries)} analyses failed", tuple(lines))]
