"""`edesign inspect`: what a table of numbers is read as, and the YAML that reads it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer


def inspect(
    file: Annotated[
        Path, typer.Argument(help="An export of a test machine, or a record.", metavar="FILE", show_default=False)
    ],
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON instead of tables.")] = False,
) -> None:
    """Print what a table of numbers is read as, and the YAML that reads it."""
    from edesign.errors import InputError
    from edesign.file_kinds import TABLE, kind_of
    from edesign.ground_motion.read import FORMATS, detect
    from edesign.report.inspection.account import quoted
    from edesign.report.inspection.damper_test import damper_test_account
    from edesign.report.inspection.record import record_account
    from edesign.report.tables.text import print_tables
    from edesign.report.tables.visible import visible

    kind = kind_of(file)
    if kind is not None and kind != TABLE:
        raise InputError(f"{file}: this is {kind.described}, no table of numbers; {kind.use}")
    account = damper_test_account(file)
    if account is None:
        found = detect(file)
        if found != "table":
            entry = f"records:\n  NAME: {{file: {quoted(file.name)}}}\n"
            if as_json:
                print(json.dumps({"path": str(file), "taken_for": "record", "format": found, "yaml": entry}, indent=2))
                return
            print(
                visible(f"{file}: a record, {FORMATS[found]}; `edesign spectrum {file}` draws it.\n\n{entry}"), end=""
            )
            return
        account = record_account(file)
    if as_json:
        print(json.dumps(account.data(), indent=2, ensure_ascii=False, allow_nan=False))
        return
    print_tables(account.tables())
    where = "a campaign file" if account.taken_for.startswith("test") else "a project or suite file"
    print(f"\nIn {where}:\n")
    print(visible(account.yaml), end="")
    if account.questions:
        print("\nSay what stands as ? above:")
        for question in account.questions:
            print(visible(f"- {question}"))
