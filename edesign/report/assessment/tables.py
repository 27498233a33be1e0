"""Tables of an assessment: measures of each record, their statistics, verdicts, performance levels, objectives."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive, open_archive
from edesign.assess.members import VariantMembers, gravity_states
from edesign.assess.sets import DAMAGED, NOT_RUN, TARGET, HistorySet, history_sets
from edesign.assess.verdicts import judge
from edesign.project.analysis_file import AnalysisFile
from edesign.project.criteria.criteria import Criterion, Objectives
from edesign.project.study.study import Study
from edesign.report.archive_view import all_results
from edesign.report.archived import archived_base, archived_study
from edesign.report.assessment.change_tables import changes_table
from edesign.report.assessment.measure_tables import record_measures_table, statistics_tables
from edesign.report.assessment.verdict_tables import objectives_table, performance_tables, verdicts_tables
from edesign.report.tables.table import Table


def assessment_tables(
    archive: str | os.PathLike[str] | Archive,
    criteria: Sequence[Criterion] = (),
    objectives: Objectives = (),
    project: AnalysisFile | None = None,
) -> list[Table]:
    """Return all tables of the assessment of an archive.

    Args:
        archive: path, or open archive, of a run of a study or of a project; complete or partial.
        criteria: the criteria of the study; without them there are no verdicts.
        objectives: the performance objectives of the study; without them there are no verdicts on them.
        project: of the frame; None: the one whose text the archive holds.

    Returns:
        Measures of each record, statistics, verdicts, performance levels, objectives; none without histories.

    Raises:
        ArchiveError: the archive cannot be read.
        InputError: the project that it holds is not one of this version.
    """
    if not isinstance(archive, Archive):
        with open_archive(archive) as opened:
            return assessment_tables(opened, criteria, objectives, project)
    histories = read_histories(archive)
    if not histories:
        return []
    project = project or archived_base(archive)
    study = archived_study(archive)
    return tables_of_histories(histories, project, criteria, objectives, study) if project is not None else []


def tables_of_histories(
    histories: Mapping[str, Group],
    project: AnalysisFile,
    criteria: Sequence[Criterion] = (),
    objectives: Objectives = (),
    study: Study | None = None,
) -> list[Table]:
    """Return the tables of histories that are at hand; see `assessment_tables`.

    Args:
        criteria: the criteria of the study.
        objectives: the performance objectives of the study.
        study: the study; None: the archive is of a project.
    """
    sets = history_sets(histories)
    if not sets:
        return []
    members = VariantMembers(project, study)
    tables = [record_measures_table(found) for found in sets]
    tables += [*statistics_tables(sets), *([changes] if (changes := changes_table(sets)).rows else [])]
    verdicts = judge(criteria, (), histories, project, study)
    if verdicts:
        tables += verdicts_tables(verdicts, project.hazard)
    tables += performance_tables(sets, members, criteria, histories)
    if objectives:
        tables.append(objectives_table(judge((), objectives, histories, project, study), objectives, project))
    return tables


def read_histories(archive: Archive, groups: Mapping[str, Group] | None = None) -> dict[str, Group]:
    """Return all histories of an archive by name, in the order of the plan.

    One that was planned and has no result belongs to the variant and level that its name begins with, as
    `damped.DBE.Tabas1978_FER-L1` does, if the archive has other histories of these.

    Args:
        archive: complete or partial.
        groups: all its analyses by name, if they have been read already.
    """
    groups = all_results(archive) if groups is None else groups
    found = {name: group for name, group in groups.items() if group.attributes.get("kind") == "history"}
    known = {_prefix(item): item for item in history_sets(found)}
    for name, group in groups.items():
        if group.attributes.get("status") not in (NOT_RUN, DAMAGED):
            continue
        for prefix, item in known.items():
            if name.startswith(prefix):
                like = next(iter(item.histories.values())).attributes
                about = {key: like.get(key) for key in ("kind", "variant", "level", "temperature_C")}
                found[name] = Group(attributes={**group.attributes, **about})
    return {name: found[name] for name in groups if name in found}


def read_judged(archive: Archive, groups: Mapping[str, Group] | None = None) -> dict[str, Group]:
    """Return all that criteria judge, by name: histories, see `read_histories`, and states at target displacements.

    Beside them are the gravity analyses, whose axial forces some standards judge columns by.

    Args:
        groups: results of analyses by name, if they are read already; None: they are read.
    """
    groups = all_results(archive) if groups is None else groups
    targets = {name: group for name, group in groups.items() if group.attributes.get("kind") == TARGET}
    found = read_histories(archive, groups) | targets
    return found | gravity_states(groups) if found else found


def _prefix(found: HistorySet) -> str:
    name = next(iter(found.histories))
    return name[: name.find(f".{found.level}.") + len(found.level) + 2] if f".{found.level}." in name else name + "."
