"""Verdicts on the criteria of a study as plain data: for JSON, and as a CSV file."""

from __future__ import annotations

from pathlib import Path

from edesign.archive.csv_files import Cell, write_csv_file
from edesign.archive.reader import Archive
from edesign.assess.requirement import DEMAND_OVER_CAPACITY
from edesign.assess.verdicts import Verdict, judge
from edesign.errors import InputError
from edesign.report.archived import archived_study
from edesign.report.assessment.tables import read_judged


def study_verdicts(archive: Archive) -> tuple[Verdict, ...]:
    """Return the verdicts on all criteria of the study that an archive is of, () where it is of none.

    Raises:
        ArchiveError: the archive cannot be read.
        InputError: the study that it holds is not one of this version.
    """
    study = archived_study(archive)
    if study is None or not study.criteria:
        return ()
    return judge(study.criteria, (), read_judged(archive), study.base, study)


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
