"""`edesign laws`: the damper laws and their parameters."""

from __future__ import annotations

from typing import Annotated

import typer

from edesign.cli.shared.complete import law_names
from edesign.damper.laws import law
from edesign.report.damper.law_table import law_table, laws_table
from edesign.report.tables.text import print_tables


def laws(
    name: Annotated[
        str | None,
        typer.Argument(
            help="One law: its parameters, equation and source.", show_default=False, autocompletion=law_names
        ),
    ] = None,
) -> None:
    """Print the damper laws, or one law's parameters with unit, bounds and default."""
    print_tables([laws_table() if name is None else law_table(law(name))])
