"""The tables of a study: designs, periods, statistics of the response, verdicts, what failed, what it cost."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.members import VariantMembers
from edesign.assess.sets import history_sets
from edesign.assess.verdicts import judge
from edesign.errors import EdesignError
from edesign.report.archive.project_tables import member_tables
from edesign.report.archive_view import all_results, ending, results, statistics
from edesign.report.archived import archived_study
from edesign.report.assessment.change_tables import changes_table
from edesign.report.assessment.derived_results import not_swept
from edesign.report.assessment.derived_tables import derived_tables
from edesign.report.assessment.measure_tables import statistics_tables
from edesign.report.assessment.tables import read_histories, read_judged
from edesign.report.assessment.verdict_data import verdicts_of
from edesign.report.assessment.verdict_tables import objectives_table, performance_tables, verdicts_tables
from edesign.report.capacity.incremental_tables import incremental_tables
from edesign.report.capacity.pushover_tables import target_tables
from edesign.report.design.designs_tables import designs_tables
from edesign.report.design.isolation_tables import isolation_estimate_table, isolation_statistics_table
from edesign.report.inputs.connections import connection_tables
from edesign.report.inputs.steel_list import steel_tables
from edesign.report.inputs.variant_frames import VariantFrames
from edesign.report.response.ground_tables import ground_tables
from edesign.report.tables.column import Column, col, count, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import ONE, S
from edesign.study.results.kinds import INCREMENTAL
from edesign.study.results.warnings import warning_lines
from edesign.study.run.outcome import COLLAPSED, COMPLETED, SKIPPED

EXPECTED = (COLLAPSED, SKIPPED)  # ends of histories of incremental studies that are no failures


class _Part(NamedTuple):
    """The analyses of a variant and level, or of an incremental study: their results by name, with ends and effort."""

    title: str
    groups: Mapping[str, Group]

    @property
    def endings(self) -> dict[str, dict[str, Any]]:
        return {name: ending(group) for name, group in self.groups.items()}

    def spent(self, key: str) -> list[float]:
        """The statistics of the analyses that have them."""
        found = (statistics(group)[key] for group in self.groups.values())
        return [float(value) for value in found if value is not None]

    @property
    def notes(self) -> list[str]:
        unexpected = {name: item for name, item in self.endings.items() if item["status"] not in EXPECTED}
        lines = warning_lines(self.groups)
        return [
            *(f"{name}: {item['status']}: {item['reason']}" for name, item in unexpected.items() if item["reason"]),
            *(f"{self.title}: {line}" if len(self.groups) > 1 else line for line in lines),
        ]


def _ended(status: str) -> Column[_Part]:
    return count(status, lambda part: sum(item["status"] == status for item in part.endings.values()))


def _sum(key: str) -> Callable[[_Part], float | None]:
    return lambda part: sum(found) if (found := part.spent(key)) else None


PLAN = TableSpec[_Part](
    "analyses_of_the_study",
    "Analyses",
    (
        text("analyses", "title"),
        count("planned", lambda part: len(part.groups)),
        *map(_ended, (COMPLETED, *EXPECTED)),
        count("steps", _sum("steps")),
        count("fallbacks", _sum("fallbacks")),
        col("CPU", S, _sum("cpu_s"), form=".3f"),
        col("largest energy error", ONE, lambda part: max(part.spent("energy_error"), default=None), 2),
    ),
    named_as="analyses",
)


def study_tables(archive: Archive) -> list[Table]:
    """Return the tables of a study, without those of single histories.

    Raises:
        ArchiveError: the archive cannot be read.
        InputError: the study that it holds is not one of this version.
    """
    study = archived_study(archive)
    if study is None:
        return []
    groups = all_results(archive)
    histories = read_histories(archive, groups)
    sets = history_sets(histories)
    tables: list[Table] = [
        plan_table(archive, groups),
        *designs_tables(archive, study, sets),
        *(isolation_estimate_table(name, group) for name, group in groups.items()),
        *statistics_tables(not_swept(study, sets)),
        changes_table(not_swept(study, sets)),
        isolation_statistics_table(sets),
    ]
    frames = VariantFrames(archive, study.base, study)
    try:
        tables += connection_tables(frames, study, sets, lambda name: results(archive, name), governing=True)
        tables += steel_tables(frames)
    except EdesignError as error:  # a frame that cannot be built again: the rest stands
        tables.append(
            Table("", notes=[f"no forces on connections of dampers, and no steel list: {error}"], headed=False)
        )
    tables += derived_tables(study, sets)
    tables += target_tables(study.base, groups, study)
    judged = read_judged(archive, groups)
    if verdicts := verdicts_of(archive, study, judged):
        tables += verdicts_tables(verdicts, study.base.hazard)
    if sets:
        tables += performance_tables(not_swept(study, sets), VariantMembers(study.base, study), study.criteria, groups)
    if study.objectives:
        of_objectives = judge((), study.objectives, judged, study.base, study)
        tables.append(objectives_table(of_objectives, study.objectives, study.base))
    tables += incremental_tables(archive, groups)
    tables += ground_tables(groups)
    tables += member_tables(archive, not_swept(study, sets), study.base.hazard)
    return [table for table in tables if table.rows or table.notes]


def plan_table(archive: Archive, groups: Mapping[str, Group] | None = None) -> Table:
    """Return the number of analyses of each variant and level, how many completed, and their computing time.

    Of incremental studies there is a row for each variant, with the histories that ended in collapse, and those that
    were skipped after one. Failed analyses are named with their reasons below, and warnings about the others.

    Args:
        archive: complete or partial.
        groups: all its analyses by name, if they have been read already.
    """
    stripes = _stripe_entries(archive)
    by_entry: dict[str, dict[str, Group]] = defaultdict(dict)
    for name, group in (all_results(archive) if groups is None else groups).items():
        by_entry[_entry_of(name, group, stripes)][name] = group
    parts = [_Part(title, found) for title, found in by_entry.items()]
    return PLAN.of(parts, without=() if stripes else EXPECTED, notes=[note for part in parts for note in part.notes])


def _stripe_entries(archive: Archive) -> tuple[str, ...]:
    """VARIANT.STUDY of the incremental studies, which the names of their histories begin with."""
    abouts = {name: archive.group(f"{INCREMENTAL}/{name}") for name in archive.names(INCREMENTAL)}
    return tuple(f"{variant}.{name}" for name, about in abouts.items() for variant in about.coords["variant"].values)


def _entry_of(name: str, group: Group, stripes: tuple[str, ...]) -> str:
    """What an analysis is counted with."""
    for title in stripes:
        if name.startswith(f"{title}."):
            return title
    kind, record = group.attributes.get("kind"), str(group.attributes.get("record") or "").rpartition("/")[2]
    if record and name.endswith(f".{record}"):  # names of records may have points
        return name.removesuffix(f".{record}")
    return (name.rpartition(".")[0] if kind == "history" or kind is None else name) or name
