"""The summary of a file of any kind but those that are run."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from edesign.errors import InputError
from edesign.file_kinds.kinds import (
    ARCHIVE,
    CAMPAIGN_OR_PROGRAMME,
    LAW,
    NATIONAL,
    PROPERTY_CAMPAIGN,
    REFERENCE,
    RIG,
    STRUCTURE,
    STRUCTURE_CAMPAIGN,
    SUITE,
    TABLE,
    FileKind,
)
from edesign.file_kinds.recognise import head_of
from edesign.ground_motion.catalogue.folder import ENDINGS
from edesign.ground_motion.formats.read import format_by_marks
from edesign.report.check.damper_files import law_summary, property_campaign_summary, tests_summary
from edesign.report.check.other_files import (
    archive_summary,
    national_summary,
    reference_summary,
    result_summary,
    rig_summary,
    structure_campaign_summary,
    suite_summary,
)
from edesign.report.check.tables_of_numbers import record_summary, table_summary

Summary = dict[str, str]
YAML_ENDINGS = (".yaml", ".yml")
"""Of files whose faults are reported by line and column, whatever a stray character makes of their kind."""
_HEAD = 4096  # bytes, in which a file that is no text shows it

SUMMARIES: dict[FileKind, Callable[[Path], Summary]] = {
    ARCHIVE: archive_summary,
    TABLE: table_summary,
    SUITE: suite_summary,
    REFERENCE: reference_summary,
    RIG: rig_summary,
    LAW: law_summary,
    STRUCTURE_CAMPAIGN: structure_campaign_summary,
    PROPERTY_CAMPAIGN: property_campaign_summary,
    CAMPAIGN_OR_PROGRAMME: tests_summary,
    NATIONAL: national_summary,
}


def summary_of(path: Path, kind: FileKind | None) -> Summary | None:
    """Return a description of a file, text by label; `warnings` has one line for each.

    Args:
        kind: of it by its content; None: none that is known.

    Returns:
        None if it is none of the files that are described here.

    Raises:
        InputError: the file is wrong.
        ArchiveError: an archive cannot be read.
    """
    if kind == STRUCTURE:
        raise InputError(
            f"{path}: this is {STRUCTURE.described}, which has no tests; {STRUCTURE.use}, whose file can be checked"
            " [E-FILE-05]"
        )
    if kind in SUMMARIES:
        return SUMMARIES[kind](path)
    if kind is None and path.suffix.lower() == ".json":
        return result_summary(path)
    ending = path.suffix.lower()
    if kind is None and ending not in YAML_ENDINGS and (ending in ENDINGS or _is_recording(path)):
        return record_summary(path)
    return None


def _is_recording(path: Path) -> bool:
    """Whether a file of no known kind is a record by its content, or at least no text, which its reader reports."""
    head = (head_of(path) or b"")[:_HEAD]
    return bool(head.strip()) and (b"\0" in head or format_by_marks(path) is not None)
