"""`edesign inspect`: what a table of numbers is read as, and the YAML that reads it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from edesign.errors import InputError
from edesign.file_kinds.kinds import TABLE
from edesign.file_kinds.recognise import kind_of
from edesign.ground_motion.formats.read import FORMATS, component_labels, format_by_marks
from edesign.report.inspection.account import quoted
from edesign.report.inspection.tables import table_account
from edesign.report.tables.text import print_tables
from edesign.report.tables.visible import visible
from edesign.tables.matlab import is_matlab_file

_READ_BY = {
    "test of a damper": "a campaign file",
    "property table": "a study file",
    "record": "a project or suite file",
}


def inspect(
    file: Annotated[
        Path,
        typer.Argument(
            help="An export of a test machine, a property table, or a record.", metavar="FILE", show_default=False
        ),
    ],
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON instead of tables.")] = False,
) -> None:
    """Print what a table of numbers is read as, and the YAML that reads it."""
    kind = kind_of(file)
    if kind is not None and kind != TABLE:
        raise InputError(f"{file}: this is {kind.described}, no table of numbers; {kind.use} [E-FILE-05]")
    marked = file.is_file() and file.stat().st_size and not is_matlab_file(file)
    found = format_by_marks(file) if marked else None
    if found is not None:
        labels = component_labels(file, found)
        unit = ", acceleration_unit: ?" if found == "sac" else ""
        entry = "records:\n" + "".join(
            f"  NAME{i if len(labels) > 1 else ''}: {{file: {quoted(file.name)}{unit}"
            + (f", component: {quoted(label)}" if len(labels) > 1 else "")
            + "}\n"
            for i, label in enumerate(labels or ("",), 1)
        )
        if as_json:
            print(json.dumps({"path": str(file), "taken_for": "record", "format": found, "yaml": entry}, indent=2))
            return
        choice = f" --component {quoted(labels[0])}" if len(labels) > 1 else ""
        choice += " --unit UNIT" if found == "sac" else ""
        drawn = f"{file}: a record, {FORMATS[found]}; `edesign spectrum {file}{choice}` draws it."
        print(visible(f"{drawn}\n\n{entry}"), end="")
        return
    account = table_account(file)
    if as_json:
        print(json.dumps(account.data(), indent=2, ensure_ascii=False, allow_nan=False))
        return
    print_tables(account.tables())
    print(f"\nIn {_READ_BY[account.taken_for]}:\n")
    print(visible(account.yaml), end="")
    if account.questions:
        print("\nSay what stands as ? above:")
        for question in account.questions:
            print(visible(f"- {question}"))
