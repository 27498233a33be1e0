"""What a file looks like that no reader of records knows, and what to do with it."""

from __future__ import annotations

import re
from collections.abc import Sequence

from edesign.tables.labview import is_labview

_NUMBER = re.compile(r"\s*[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[EeDd][-+]?[0-9]{1,3})?(?:\s*[,;]\s*|\s+|$|(?=[-+]))")
_FIRST_LINES = 400  # of a file, within which its numbers begin
_RUN = 3  # lines of nothing but numbers that are data


def describe_text(lines: Sequence[str]) -> str:
    """Return what a text looks like: how many lines of header it has, and how its numbers stand below them."""
    if is_labview(lines):
        return "it is a LabVIEW measurement, as tests of dampers are; write the columns of a record as CSV"
    counts = [_numbers(line) for line in lines[:_FIRST_LINES]]
    for i in range(len(counts) - _RUN + 1):
        run = counts[i : i + _RUN]
        if min(run) > 0 and (len(set(run)) == 1 or i + _RUN == len(counts)):
            break
    else:
        return "it has no lines of numbers"
    header, width = i, counts[i]
    above = f"{header} lines of text" if header > 1 else "one line of text" if header else "no text"
    numbers = f"{width} numbers" if width > 1 else "one number"
    return (
        f"it has {above}, then lines of {numbers}. If these are accelerations alone, declare a table: `format: table`, "
        f"`table: {{skip: {header}}}`, `acceleration_unit`, `time_step` and `layout`; "
        "`edesign inspect` prints how it is read"
    )


def _numbers(line: str) -> int:
    """How many numbers a line has; 0 if it has anything else."""
    text = line.strip()
    words = _NUMBER.findall(text)
    return len(words) if words and not _NUMBER.sub("", text) else 0
