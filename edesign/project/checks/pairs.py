"""Cross checks of pairs of records for buildings: components, files, and the fit to the hazard."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from edesign.project.actions.hazard_base import Hazard
from edesign.project.checks.matching import check_compared_damping, check_matching
from edesign.project.checks.records import (
    check_component_files,
    check_components,
    check_processing,
    check_record,
    check_suite_files,
)
from edesign.project.reading.checks_files import check_file
from edesign.project.reading.problems import Keys, Problems
from edesign.project.records.pairs import OnePair, SuitePairs
from edesign.project.records.records import FileRecord


def check_pairs(
    records: Mapping[str, SuitePairs | OnePair],
    hazard: Hazard | None,
    folder: Path,
    problems: Problems,
    what: str,
) -> None:
    """Check the pairs of a file, without reading those of their files.

    Args:
        hazard: the seismic action that they are fitted to; None: there is none.
        folder: to which paths are relative.
        what: the file is, for messages; empty: its files need not be there.
    """
    for name, record in records.items():
        keys: Keys = ("records", name)
        check_matching(hazard, record.match, (*keys, "match"), problems, (*keys, "match"))
        if record.match is None and record.spectrum is not None:
            message = "this is what is compared with the spectrum of the hazard by `match` [E-SCALE-02]"
            problems.at_key((*keys, "spectrum"), message)
        if record.match is not None and record.match.component == "vertical":
            message = "a pair is fitted to the horizontal spectrum; its vertical component has the factor of both"
            problems.at_value((*keys, "match", "component"), f"{message} [E-SCALE-01]")
        if isinstance(record, SuitePairs):
            _suite(record, hazard, keys, problems)
            if what:
                check_suite_files(record, folder, keys, problems, what)
            continue
        check_components(record, keys, problems)
        if what:
            check_component_files(record, folder, keys, problems, what)
        if record.vertical is not None:
            check_record(record.vertical, (*keys, "vertical"), problems)
            if record.vertical.match is not None:
                message = "the vertical component has the factor of both others; leave this key out [E-KEY-03]"
                problems.at_key((*keys, "vertical", "match"), message)
            if what and isinstance(record.vertical, FileRecord):
                check_file(folder / record.vertical.file, (*keys, "vertical", "file"), problems, what)


def _suite(record: SuitePairs, hazard: Hazard | None, keys: Keys, problems: Problems) -> None:
    check_processing(record.processing, (*keys, "processing"), problems)
    for i, (first, last) in enumerate(record.only.ranges):
        twice = [max(first, low) for low, high in record.only.ranges[:i] if first <= high and low <= last]
        if twice:
            problems.at_item((*keys, "only"), i, f"the pair {min(twice)} stands here twice [E-NAME-02]")
    if record.match is not None:
        check_compared_damping(hazard, str(keys[-1]), problems, (*keys, "match"))
