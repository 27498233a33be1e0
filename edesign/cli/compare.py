"""`edesign compare`: an archive beside reference values."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from edesign.archive.files import check_csv
from edesign.archive.reader import DamagedArchive, read_archive
from edesign.errors import AnalysisError, InputError
from edesign.file_kinds.kinds import ARCHIVE, REFERENCE, TABLE, YAML_KINDS
from edesign.file_kinds.recognise import kind_of, refuse_kind
from edesign.project.study.reference_loader import load_reference
from edesign.report.comparison.compare import compare as compare_archive
from edesign.report.comparison.files import comparison_data, write_comparison
from edesign.report.comparison.tables import block_tables
from edesign.report.comparison.variants import variant_tables
from edesign.report.tables.text import print_tables


def compare(
    archive: Annotated[Path, typer.Argument(help="The archive, complete or partial.", show_default=False)],
    reference: Annotated[
        Path, typer.Argument(help="The reference file, such as projects/thesis_10_storey/reference.yaml.")
    ],
    csv: Annotated[Path | None, typer.Option("--csv", metavar="FILE", help="Write a line for each value.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON instead of tables.")] = False,
    bars: Annotated[bool, typer.Option("--bars", help="Show the bar of each value, and whether it holds.")] = False,
    variants: Annotated[
        str | None,
        typer.Option(
            "--variants", metavar="NAME", help="Put every variant of the archive beside this one of the reference."
        ),
    ] = None,
    check: Annotated[
        bool, typer.Option("--check", help="Exit code 3 if a value is not within its bar, or missing where one is set.")
    ] = False,
) -> None:
    """Print each printed value of a reference beside the one of an archive, with its difference."""
    others = {"--csv": csv is not None, "--json": as_json, "--bars": bars, "--check": check}
    if variants is not None and any(others.values()):
        given = ", ".join(option for option, is_given in others.items() if is_given)
        raise InputError(
            f"{given}: --variants prints its tables and takes no other options; leave one of them out [E-CLI-02]"
        )
    _check_kinds(archive, reference)
    if csv is not None:
        check_csv(csv)
    loaded = load_reference(reference)
    if variants is not None:
        tables, damage = read_archive(archive, lambda opened: variant_tables(opened, loaded, variants))
        print_tables(tables)
        if damage:
            raise DamagedArchive(f"{damage} [E-ARCH-03]")
        return
    comparison, damage = read_archive(archive, lambda opened: compare_archive(opened, loaded))
    if csv is not None:
        write_comparison(comparison, csv)
    if as_json:
        print(json.dumps(comparison_data(comparison), indent=2, allow_nan=False, ensure_ascii=False))
    else:
        print_tables(block_tables(comparison, bars))
    if damage:
        raise DamagedArchive(f"{damage} [E-ARCH-03]")
    if check and comparison.outside:
        outside, barred = len(comparison.outside), sum(cell.within is not None for cell in comparison.cells)
        which = "value is not within its bar" if barred == 1 else "values are not within their bars"
        raise AnalysisError(f"{outside} of {barred} {which} [E-RUN-04]")


def _check_kinds(archive: Path, reference: Path) -> None:
    """Say what the command needs to who names two archives, or both files in the other order."""
    first, second = kind_of(archive), kind_of(reference)
    if second == ARCHIVE and first == REFERENCE:
        raise InputError(f"{archive}: the archive comes first: `edesign compare {reference} {archive}` [E-CLI-05]")
    refuse_kind(archive, first, "archive", TABLE, *YAML_KINDS)
    if second == ARCHIVE:
        raise InputError(
            f"{reference}: this is {ARCHIVE.described}, and two archives are not compared; the second file is a "
            "reference file of printed values, which begins with `edesign_reference: 1` "
            "(docs/reference/reference_files.md) [E-FILE-05]"
        )
