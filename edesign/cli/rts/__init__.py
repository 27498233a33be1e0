"""`edesign rts ...`: real-time substructure tests, virtual and real."""

from __future__ import annotations

import typer

from edesign.cli.rts.after import identify, judge
from edesign.cli.rts.before import check, export, serve
from edesign.cli.rts.run import run

app = typer.Typer(
    name="rts",
    help="Real-time substructure tests: will one be stable, how wrong, and how good was it.",
    no_args_is_help=True,
    context_settings={"help_option_names": ["-h", "--help"]},
)
for command in (check, run, export, serve, identify, judge):
    app.command()(command)
