"""Verdicts on the criteria of a study as plain data: for JSON, and as a CSV file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from edesign.archive.csv_files import Cell, write_csv_file
from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.judged_designs import brace_verdicts, brace_warnings, damping_verdicts
from edesign.assess.raised_devices import RaisedDevices
from edesign.assess.requirement import DEMAND_OVER_CAPACITY
from edesign.assess.sets import HistorySet, history_sets
from edesign.assess.verdicts import Verdict, judge
from edesign.errors import InputError
from edesign.project.criteria.criteria import Objectives
from edesign.project.study.study import Study
from edesign.report.archived import archived_study
from edesign.report.assessment.tables import read_judged
from edesign.study.plan.device_factors import raised_devices
from edesign.study.results.kinds import DESIGNS


def study_verdicts(archive: Archive) -> tuple[Verdict, ...]:
    """Return all verdicts on the study that an archive is of, () where it is of none; see `verdicts_of`.

    Raises:
        ArchiveError: the archive cannot be read.
        InputError: the study that it holds is not one of this version.
    """
    study = archived_study(archive)
    return () if study is None else verdicts_of(archive, study, read_judged(archive))


def verdicts_of(
    archive: Archive, study: Study, judged: Mapping[str, Group], objectives: Objectives = ()
) -> tuple[Verdict, ...]:
    """Return the verdicts on the criteria of a study, on objectives, and on the damping and the braces of its designs.

    Args:
        study: that the archive holds.
        judged: histories and states at target displacements, by name.
        objectives: of the study; none where they are told apart.
    """
    found = judge(study.criteria, objectives, judged, study.base, study)
    designs = read_designs(archive)
    braces = brace_verdicts(designs, history_sets(judged), study, _raised(designs, study))
    return (*found, *damping_verdicts(designs, study), *braces)


def warnings_of_braces(archive: Archive, study: Study | None, sets: Sequence[HistorySet]) -> list[str]:
    """Return a sentence for each design, variant and level whose histories its braces do not hold.

    Args:
        study: that the archive holds; None: it is of a project, or cannot be read.
    """
    if study is None:
        return []
    designs = read_designs(archive)
    return brace_warnings(designs, sets, study, _raised(designs, study))


def _raised(designs: Mapping[str, Group], study: Study) -> dict[str, RaisedDevices]:
    """The factors of the code, of each design whose braces have sections."""
    return {name: raised_devices(study, name) for name, of in designs.items() if "brace_section" in of.variables}


def read_designs(archive: Archive) -> dict[str, Group]:
    """Return the designs of an archive by name."""
    return {name: archive.group(f"{DESIGNS}/{name}") for name in archive.names(DESIGNS)}


def verdict_entry(verdict: Verdict) -> dict[str, Cell]:
    """Return a verdict by the headers of its columns; values are in the SI unit beside them."""
    return {
        "criterion": verdict.name,
        "requirement": verdict.requirement,
        "variant": verdict.variant,
        "level": verdict.level,
        "verdict": verdict.answer,
        "statistic": verdict.statistic,
        "value": verdict.value,
        "limit": verdict.limit,
        "unit": "1" if verdict.unit == DEMAND_OVER_CAPACITY else verdict.unit,
        "demand_over_capacity": verdict.ratio,
        "governing_place": verdict.place,
        "governing_history": verdict.governing_history,
        "histories": verdict.count,
        "missing": len(verdict.missing),
        "remark": verdict.remark,
    }


def write_verdicts(archive: Archive, path: Path) -> None:
    """Write the verdicts on the criteria of a study as CSV.

    Raises:
        InputError: the archive has no criteria.
        ArchiveError: the file cannot be written.
    """
    entries = [verdict_entry(verdict) for verdict in study_verdicts(archive)]
    if not entries:
        raise InputError(
            f"{archive.path}: there are no criteria in this archive, so no CSV file of verdicts [E-ARCH-08]"
        )
    write_csv_file(list(entries[0]), [list(entry.values()) for entry in entries], path)
