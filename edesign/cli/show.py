"""`edesign show`: what an archive holds."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Annotated

import typer

from edesign.archive.files import check_csv, check_folder
from edesign.archive.reader import Archive, DamagedArchive, read_archive, refuse_calibration
from edesign.cli.shared.complete import archived_names
from edesign.errors import InputError
from edesign.optional_stages import optional
from edesign.project.reading.problems import unknown_name
from edesign.report.archive.figures import draw_figures
from edesign.report.archive.loaded_member import loaded_member_data, loaded_member_tables
from edesign.report.archive.summary import summarise
from edesign.report.archive.tables import details, overview, short_tables
from edesign.report.assessment.verdict_data import write_verdicts
from edesign.report.building.checks import member_data, member_tables
from edesign.report.building.results import building_results, has_members
from edesign.report.drawing.style import check_format
from edesign.report.inputs.designed_dampers import DESIGNS
from edesign.report.tables.table import Table
from edesign.report.tables.text import PAPER, print_tables


def show(
    archive: Annotated[Path, typer.Argument(help="The archive, complete or partial.", show_default=False)],
    whole: Annotated[
        bool, typer.Option("--all", help="All tables, not only verdicts, means and what governs.")
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON in SI units instead of tables.")] = False,
    analysis: Annotated[
        str | None,
        typer.Option(
            "--analysis", "-n", metavar="NAME", help="Details of one analysis only.", autocompletion=archived_names
        ),
    ] = None,
    member: Annotated[
        str | None,
        typer.Option(
            "--member",
            "-m",
            metavar="NAME",
            help="A member: its checks in a building's design, or under histories, one as a worked calculation.",
        ),
    ] = None,
    devices: Annotated[
        str | None,
        typer.Option("--devices", metavar="DESIGN", help="The devices that a design found, for a project's `dampers`."),
    ] = None,
    csv: Annotated[
        Path | None, typer.Option("--csv", metavar="FILE", help="Write the verdicts on the criteria of a study.")
    ] = None,
    figures: Annotated[
        Path | None,
        typer.Option("--figures", metavar="DIR", help="Draw records, their spectra, loops of dampers, and buildings."),
    ] = None,
    figure_format: Annotated[str, typer.Option("--format", help="Of the figures: svg, png, pdf.")] = "svg",
) -> None:
    """Print what an archive holds: verdicts, means of the response and what governs; with --all every table."""

    def read(opened: Archive) -> Callable[[], None]:
        refuse_calibration(opened)
        if as_json:
            found = {"member": _data(opened, member, analysis)} if member is not None else summarise(opened, analysis)
            text = json.dumps(found, indent=2, allow_nan=False, ensure_ascii=False)
            return lambda: print(text)
        if member is not None:
            worked = _tables(opened, member, analysis)
            return lambda: print_tables(worked)
        if analysis is None and not whole:
            short = short_tables(opened)
            return lambda: print_tables(short, widest=PAPER)
        tables = details(opened, analysis) if analysis is not None else overview(opened)
        return lambda: print_tables(tables)

    check_format(figure_format)
    if devices is not None:
        print(read_archive(archive, lambda opened: _devices(opened, devices))[0], end="")
        return
    if csv is not None:
        check_csv(csv)
        read_archive(archive, lambda opened: write_verdicts(opened, csv))
    if figures is not None:
        check_folder(figures)
    print_found, damage = read_archive(archive, read)
    print_found()
    if figures is not None:
        drawn: tuple[Path, ...] | None = None
        with optional("the figures", "what the archive holds is printed above"):
            drawn, damage = read_archive(archive, lambda opened: draw_figures(opened, figures, figure_format))
        if drawn == ():
            nothing = "nothing to draw: no record is fitted or of a suite, and no history of dampers was kept"
            print(nothing, file=sys.stderr, flush=True)
    if damage:
        raise DamagedArchive(f"{damage} [E-ARCH-03]")


def _tables(opened: Archive, member: str, analysis: str | None) -> list[Table]:
    """The checks of a member in the design of a building, and under the forces of analyses, as far as there are any."""
    if analysis is not None or not has_members(opened):
        return loaded_member_tables(opened, member, analysis)
    try:
        found = member_tables(building_results(opened), member)
    except InputError:
        with suppress(InputError):  # halves of beams that dampers meet are in analyses alone
            return loaded_member_tables(opened, member)
        raise
    with suppress(InputError):
        found += loaded_member_tables(opened, member)
    return found


def _data(opened: Archive, member: str, analysis: str | None) -> dict[str, object]:
    """What `_tables` shows, in SI."""
    if analysis is not None or not has_members(opened):
        return loaded_member_data(opened, member, analysis)
    found = member_data(building_results(opened), member)
    with suppress(InputError):
        found["analyses"] = loaded_member_data(opened, member)
    return found


def _devices(opened: Archive, design: str) -> str:
    """The devices that a design found, as YAML.

    Raises:
        InputError: there is no such design, or it found none.
    """
    names = opened.names(DESIGNS)
    if design not in names:
        raise InputError(f"{opened.path}: --devices: {unknown_name('design', design, names)}")
    attributes = opened.group_attributes(f"{DESIGNS}/{design}")
    if attributes.get("status") != "completed" or "devices" not in attributes:
        raise InputError(f"{opened.path}: --devices: the design `{design}` found no devices [E-ARCH-08]")
    return str(attributes["devices"])
