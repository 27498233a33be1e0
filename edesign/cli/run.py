"""`edesign run`: the analyses of a project into an archive."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def run(
    project: Annotated[Path, typer.Argument(help="The project file.", show_default=False)],
    archive: Annotated[
        Path | None, typer.Option("--archive", "-a", help="Where to write; by default what the project says.")
    ] = None,
    only: Annotated[
        list[str] | None,
        typer.Option(
            "--only", "-o", metavar="NAME", help="Run this analysis only; may be repeated. Written to its own archive."
        ),
    ] = None,
    fresh: Annotated[bool, typer.Option("--fresh", help="Discard the results of an interrupted run.")] = False,
    workers: Annotated[int, typer.Option("--workers", "-w", min=1, help="Analyses that run at the same time.")] = 1,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress and no summary.")] = False,
) -> None:
    """Run the analyses of a project, archive them, and print a summary.

    A run that was interrupted goes on where it stopped when it is called again.
    """
    from edesign.building.project_file import load_project
    from edesign.cli.progress import listener
    from edesign.errors import AnalysisError
    from edesign.report.tables import overview
    from edesign.report.text import print_tables
    from edesign.study.run import run_project

    loaded = load_project(project)
    with listener(quiet) as listen:
        summary = run_project(loaded, archive, listen, workers, only or (), fresh)
    if not quiet:
        print_tables(overview(summary.archive))
        typer.echo(f"archive: {summary.archive} ({summary.seconds:.1f} s)")
    if summary.failed:
        reasons = "".join(f"\n  {outcome.name}: {outcome.reason}" for outcome in summary.failed)
        raise AnalysisError(
            f"{len(summary.failed)} of {len(summary.outcomes)} analyses failed; all are in {summary.archive}{reasons}"
        )
