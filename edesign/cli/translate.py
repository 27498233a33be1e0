"""`edesign translate`: the model of a project or building for another program, or of another program for edesign."""

from __future__ import annotations

import shlex
from collections.abc import Iterable
from pathlib import Path
from typing import Annotated

import typer

from edesign.archive.files import check_file
from edesign.cli.shared.stages import ProgressLine, in_stages
from edesign.errors import InputError
from edesign.exchange import formats
from edesign.report.tables.visible import visible_line


def translate(
    source: Annotated[
        Path, typer.Argument(help="The project or building file, or SAP2000's text (.s2k).", show_default=False)
    ],
    target: Annotated[
        Path | None,
        typer.Argument(
            help=(
                "The file to write; its ending says for which program: .py OpenSeesPy, .tcl OpenSees, .s2k SAP2000; "
                ".yaml for edesign, from .s2k."
            ),
            show_default=False,
        ),
    ] = None,
    without_dampers: Annotated[
        bool, typer.Option("--without-dampers", help="Leave dampers, isolators and tuned masses out.")
    ] = False,
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace files that edesign did not write.")] = False,
    to: Annotated[str | None, typer.Option("--to", hidden=True)] = None,  # answered, as other programs have it
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress.")] = False,
) -> None:
    """Write the model of a project or building for another program, or a SAP2000 model as a file of edesign."""
    if target is None or to is not None:
        raise InputError(f"{'--to: ' if to is not None else ''}{_without_target(source)}")
    if source.suffix.lower() in formats.TAKEN:
        taken = formats.take(source, target, overwrite)
        _print_result(f"{target} written, a {taken.kind} file. Next: edesign check {target}", taken.left_out)
        return
    form = formats.find_format(target)
    check_file(target)  # rather than after the records are fitted

    def work(progress: ProgressLine) -> formats.Translation:
        progress(f"reading {source}")
        return form.translate(formats.read_source(source), target, without_dampers, progress)

    found = in_stages(work, quiet)
    formats.check_own_files(found, overwrite)
    formats.write_translation(found)
    others = len(found.files) - 1
    beside = f", and {others} file{'s' * (others > 1)} beside it" if others else ""
    _print_result(
        f"{target} written for {form.program}{beside}. Next: {form.use.format(target)}",
        found.left_out,
        found.differences,
    )


def _without_target(source: Path) -> str:
    """What to write after the source, by examples with its own name."""
    command = f"edesign translate {shlex.quote(str(source))} {shlex.quote(source.stem)}"
    if source.suffix.lower() in formats.TAKEN:
        return f"name the file to write after it: {command}.yaml [E-CLI-03]"
    examples = "".join(f"\n  {known.program + ':':<11} {command}{known.suffix}" for known in formats.FORMATS)
    return f"name the file to write after the source; its ending says for which program:{examples} [E-CLI-03]"


def _print_result(first: str, left_out: Iterable[str], differences: Iterable[str] = ()) -> None:
    print(visible_line(first))
    for sentence in left_out:
        print(visible_line(f"left out: {sentence}"))
    for sentence in differences:
        print(visible_line(f"differs: {sentence}"))
