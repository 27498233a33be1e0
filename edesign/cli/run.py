"""`edesign run`: the analyses of a project or study into an archive."""

from __future__ import annotations

from dataclasses import dataclass, fields
from pathlib import Path
from typing import Annotated

import typer

from edesign.archive.reader import open_archive
from edesign.cli.report import PageProgress
from edesign.cli.shared.complete import analysis_names
from edesign.cli.shared.progress import listener
from edesign.cli.shared.stages import ProgressLine, in_stages
from edesign.cli.shared.streams import progress_line
from edesign.cli.shared.workers import DEFAULT, Workers
from edesign.errors import AnalysisError, InputError
from edesign.file_kinds.kinds import BUILDING, STUDY, SUBSTRUCTURE_TESTS, FileKind
from edesign.file_kinds.recognise import kind_of
from edesign.frame.building_file import load_building
from edesign.frame.project_file import load_project, load_study
from edesign.ground_motion.project_records import with_folders
from edesign.optional_stages import earlier, optional
from edesign.report.archive.document import default_page_path, write_page
from edesign.report.archive.tables import overview, short_tables
from edesign.report.tables.text import PAPER, print_tables
from edesign.space.archived import PLACE
from edesign.space.designed import ElasticDesign
from edesign.study.run.building import run_building
from edesign.study.run.run import run_project, run_study


def run(
    project: Annotated[
        Path, typer.Argument(help="The project, study or building file, or substructure tests.", show_default=False)
    ],
    archive: Annotated[
        Path | None, typer.Option("--archive", "-a", help="Where to write; by default what the file says.")
    ] = None,
    only: Annotated[
        list[str] | None,
        typer.Option(
            "--only",
            metavar="NAME",
            help="Run this analysis only; may be repeated. Written to its own archive.",
            autocompletion=analysis_names,
        ),
    ] = None,
    folder: Annotated[
        list[Path] | None,
        typer.Option("--folder", metavar="DIR", help="More folders with your recordings of suites; may be repeated."),
    ] = None,
    fresh: Annotated[bool, typer.Option("--fresh", help="Discard the results of an interrupted run.")] = False,
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace the archive of another project.")] = False,
    workers: Workers = DEFAULT,
    backend: Annotated[
        str, typer.Option("--backend", "-b", help="What runs the analyses: serial, threads, or dask.")
    ] = "threads",
    scheduler: Annotated[
        str | None,
        typer.Option("--scheduler", metavar="ADDRESS", help="Of a dask cluster: tcp://host:8786; it implies dask."),
    ] = None,
    report: Annotated[
        bool, typer.Option("--report", help="Write the report too, one HTML page beside the archive.")
    ] = False,
    check: Annotated[bool, typer.Option("--check", help="Exit with 3 if a check of a building is not met.")] = False,
    whole: Annotated[
        bool, typer.Option("--all", help="Print all tables, not only verdicts, means and what governs.")
    ] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress and no summary.")] = False,
) -> None:
    """Run the analyses of a project or study, or design checks of a building, archive them, and print a summary.

    A run that was interrupted goes on where it stopped when it is called again.
    """
    kind = kind_of(project)
    end = _End(report, whole, quiet)
    if kind == SUBSTRUCTURE_TESTS:
        if only or folder or scheduler or fresh:
            raise InputError(
                f"{project}: --only, --folder, --scheduler and --fresh are for analyses, not for substructure tests "
                "[E-CLI-01]"
            )
        from edesign.cli.rts.run import run as run_rts  # loads what no other run needs

        run_rts(project, archive, None, overwrite, check, quiet, report)
        return
    if kind == BUILDING and not load_building(project).analyses:
        if only or folder or scheduler:
            raise InputError(
                f"{project}: --only, --folder and --scheduler are for analyses, and this building has none [E-CLI-01]"
            )
        _run_building(project, archive, overwrite, end, check)
        return
    how = _How(
        archive_path=archive,
        only=tuple(only or ()),
        fresh=fresh,
        overwrite=overwrite,
        workers=workers,
        backend="dask" if scheduler else backend,
        scheduler=scheduler,
    )
    _run_analyses(project, kind, folder or [], how, end, check)


@dataclass(frozen=True)
class _How:
    """How analyses are run: arguments of `run_project` that are options of the command."""

    archive_path: Path | None
    only: tuple[str, ...]
    fresh: bool
    overwrite: bool
    workers: int
    backend: str
    scheduler: str | None


@dataclass(frozen=True)
class _End:
    """What is written and printed at the end of a run."""

    report: bool
    whole: bool
    quiet: bool


def _run_building(file: Path, archive: Path | None, overwrite: bool, end: _End, check: bool) -> None:
    def work(progress: ProgressLine) -> tuple[Path, ElasticDesign]:
        progress(f"reading {file}")
        return run_building(load_building(file), archive, overwrite, progress)

    path, design = in_stages(work, end.quiet)
    _end(path, "", end)
    if check and not design.passed:
        raise _not_met(file, path)


def _not_met(file: Path, archive: Path) -> AnalysisError:
    return AnalysisError(f"{file}: not all checks are met; all are in {archive} [E-RUN-02]")


def _run_analyses(project: Path, kind: FileKind | None, folders: list[Path], how: _How, end: _End, check: bool) -> None:
    with listener(end.quiet) as listen:
        options = {field.name: getattr(how, field.name) for field in fields(how)} | {"progress": listen}
        if kind == STUDY:
            study = load_study(project)
            summary = run_study(study.of(with_folders(study.base, folders)) if folders else study, **options)
        else:
            load = load_building if kind == BUILDING else load_project
            summary = run_project(with_folders(load(project), folders), **options)
    _end(summary.archive, f" ({summary.seconds:.1f} s)", end)
    if summary.failed:
        alike: dict[str, list[str]] = {}
        for outcome in summary.failed:
            alike.setdefault(outcome.reason, []).append(outcome.name)
        reasons = "".join(f"\n  {_shortened(names)}: {reason}" for reason, names in alike.items())
        raise AnalysisError(
            f"{len(summary.failed)} of {len(summary.outcomes)} analyses failed; all are in {summary.archive}{reasons}"
            " [E-RUN-01]"
        )
    if check and kind == BUILDING:
        with open_archive(summary.archive) as archive:
            met = not archive.has(PLACE) or archive.group_attributes(PLACE).get("passed")
        if not met:
            raise _not_met(project, summary.archive)


def _end(archive: Path, took: str, end: _End) -> None:
    """Write the report if it is asked for, then print the tables in short and where the files are."""
    page, kept = None, f"the results are in {archive}"
    if end.report:
        if not end.quiet:
            progress_line("writing the report ...")
        with optional("the report", kept + earlier(default_page_path(archive))):
            page = write_page(archive, None, (lambda line: None) if end.quiet else PageProgress())
    if end.quiet:
        return
    with optional("the tables", kept), open_archive(archive) as opened:
        if end.whole:
            print_tables(overview(opened))
        else:
            print_tables(short_tables(opened), widest=PAPER)
    print(f"archive: {archive}{took}")
    if page is not None:
        print(f"report: {page}")


def _shortened(names: list[str]) -> str:
    more = f" and {len(names) - 4} more" if len(names) > 4 else ""
    return ", ".join(names[:4]) + more
