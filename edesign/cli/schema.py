"""`edesign schema`: JSON Schemas of the YAML files, with which editors complete and check them."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from edesign.cli.shared.complete import kind_names
from edesign.schema.kinds import KINDS, kind_named
from edesign.schema.write import kinds_table, schema_text, write_schemas


def schema(
    kind: Annotated[
        str | None,
        typer.Argument(
            help="A kind of file, such as `project`; without it all of them.",
            show_default=False,
            autocompletion=kind_names,
        ),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", metavar="FOLDER", help="Write KIND.schema.json into this folder."),
    ] = None,
) -> None:
    """Print or write the JSON Schema of a kind of YAML file; without a kind list them, or write all."""
    if kind is None and output is None:
        print(kinds_table())
        return
    chosen = list(KINDS.values()) if kind is None else [kind_named(kind)]
    if output is None:
        print(schema_text(chosen[0]), end="")
        return

    written = write_schemas(chosen, output, combined=kind is None)
    print(f"{len(written)} written to {output}: {', '.join(path.name for path in written)}")
    print(f"First line of a file that an editor checks with one: # yaml-language-server: $schema={written[-1]}")
