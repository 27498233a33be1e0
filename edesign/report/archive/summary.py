"""The content of an archive as plain data: what `edesign show --json` prints."""

from __future__ import annotations

import os
from typing import Any

from edesign.archive.reader import Archive, open_archive
from edesign.report.archive.kinds import kind_of
from edesign.report.archive_view import design_warnings, find, input_warnings, planned
from edesign.report.tables.number import finite
from edesign.study.results.warnings import ATTRIBUTE

OF_KINDS = ("study_file", "building_file", "building_checksum", "rts_file", "rts_checksum")
"""Of archives of one kind alone."""
ROOT = ("title", "status", "project_file", "project_checksum", "input_checksum", "edesign_version", "core_version")


def summarise(archive: str | os.PathLike[str] | Archive, analysis: str | None = None) -> dict[str, Any]:
    """Summarise an archive in SI units, ready for JSON; None stands for "not applicable" and for "not finite".

    Args:
        archive: path of the archive, complete or partial, or the open archive.
        analysis: name of one analysis; all if None.

    Returns:
        {"archive": {title, status, complete, versions, warnings ...}, "records": [...], "analyses": [{"name", "kind",
        "variant", "record", "level", "status", "reason", "warnings": [...], "measures": {...}, "statistics": {...}}]}.
        Of a study also "criteria": [{"criterion", "variant", "level", "verdict", "statistic", "value", "limit", ...}].
        Analyses that were planned and have no result have the status "not run". Warnings are sentences; those of the
        archive are about the input and about designs. Records have the attributes of their groups, and those of
        suites stand under "records" of their suite; they are left out when one analysis is asked for.

    Raises:
        ArchiveError: the archive cannot be read.
        InputError: there is no such analysis.
    """
    if not isinstance(archive, Archive):
        with open_archive(archive) as opened:
            return summarise(opened, analysis)
    names = planned(archive) if analysis is None else [find(archive, analysis)]
    about = {name: archive.attributes.get(name) for name in ROOT} | {"complete": archive.complete}
    about |= {name: archive.attributes[name] for name in OF_KINDS if name in archive.attributes}
    found, warnings = kind_of(archive).summary(archive, names, analysis is None)
    about[ATTRIBUTE] = [*input_warnings(archive), *design_warnings(archive), *warnings]
    damage = {"damage": archive.damage} if archive.damage_in_short() else {}
    return {"archive": finite(about | damage), **found}
