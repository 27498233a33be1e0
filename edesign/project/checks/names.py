"""Checks of lists of names: each is there, and comes once."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from edesign.project.analysis_file import AnalysisFile
from edesign.project.reading.problems import Keys, Problems, unknown_name
from edesign.project.records.records import record_of

ALL = "all"
"""What stands for all variants."""


def check_names(problems: Problems, keys: Keys, what: str, given: Sequence[str], known: Collection[str]) -> None:
    """Check that names are defined.

    Args:
        keys: of the names; a single one may stand there without a list.
        what: they are, for messages: "variant".
        known: those that there are.
    """
    for i, name in enumerate(given):
        if name not in known:
            problems.at_item(keys, i, unknown_name(what, name, known))
        elif name in given[:i]:
            problems.at_item(keys, i, f"`{name}` comes twice [E-NAME-02]")


def check_records(problems: Problems, keys: Keys, given: Sequence[str], project: AnalysisFile) -> None:
    """Check references of records, RECORD or SUITE/RECORDING; recordings are found when the suite is read.

    Args:
        project: the file, which has no schema problems.
    """
    for i, reference in enumerate(given):
        if record_of(reference) not in project.records:
            problems.at_item(keys, i, unknown_name("record", record_of(reference), project.records))
        elif reference in given[:i]:
            problems.at_item(keys, i, f"`{reference}` comes twice [E-NAME-02]")
