"""`edesign rts identify` and `judge`: what a laboratory asks after it has measured."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from edesign.archive.files import check_own_yaml, write_yaml
from edesign.cli.rts.tests_file import load_tests
from edesign.errors import AnalysisError, InputError
from edesign.one_thread import one_thread
from edesign.project.substructure.rts_file import RtsFile
from edesign.report.substructure.identified_rig_tables import identified_rig_tables
from edesign.report.substructure.judgement_tables import judgement_data, judgement_tables
from edesign.report.tables.text import print_tables
from edesign.substructure.judgement.judge import Judgement
from edesign.substructure.judgement.judge import judge as judged
from edesign.substructure.judgement.record_campaign import CHANNELS, Displacement, write_record_campaign
from edesign.substructure.rig.identified import rig_data, rig_file_text
from edesign.substructure.rig.identify import identify as find

Json = Annotated[bool, typer.Option("--json", help="Print JSON in SI units instead of tables.")]


def identify(
    record: Annotated[
        Path,
        typer.Argument(help="CSV with time, command and displacement of the rig alone or loaded.", show_default=False),
    ],
    order: Annotated[
        int | None, typer.Option("--order", min=0, max=2, help="Of the rig; what the record asks for if not said.")
    ] = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="Write a rig file (rig.yaml) for `rig: {file: ...}`.")
    ] = None,
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace a file that is not of this record.")] = False,
    as_json: Json = False,
) -> None:
    """Find delay, order, gain and noise of a rig in a measured command and displacement."""
    if output is not None:
        check_own_yaml(output, record, overwrite)
    with one_thread():
        found = find(record, order)
    if output is not None:
        write_yaml(rig_file_text(found), output, record)
    if as_json:
        print(json.dumps(rig_data(found), indent=2, allow_nan=False, ensure_ascii=False))
        return
    print_tables(identified_rig_tables(found))
    if output is not None:
        print(f"written: {output}")


def judge(
    records: Annotated[
        list[Path],
        typer.Argument(metavar="CSV...", help="With time, target, displacement, and force.", show_default=False),
    ],
    rts: Annotated[
        Path | None, typer.Option("--rts", help="File of the tests: judges the response of the structure too.")
    ] = None,
    test: Annotated[
        list[str] | None, typer.Option("--test", metavar="NAME", help="Of each CSV in turn, if its name does not say.")
    ] = None,
    campaign: Annotated[
        Path | None, typer.Option("--campaign", metavar="DIR", help="Write them as a campaign for `edesign calibrate`.")
    ] = None,
    displacement: Annotated[
        str, typer.Option("--displacement", help="Of the campaign: target or encoder.")
    ] = "encoder",
    check: Annotated[bool, typer.Option("--check", help="Exit with 3 if a criterion is not met.")] = False,
    as_json: Json = False,
) -> None:
    """Judge measured substructure tests: tracking, error of the response, force against the law."""
    chosen, file = _displacement(displacement), _read(rts, test, campaign)
    if test and len(test) != len(records):
        raise InputError(
            f"--test: {len(test)} for {len(records)} CSVs; one for each of them, in their order, or none [E-CLI-05]"
        )
    names: list[str | None] = [*test] if test else [None] * len(records)
    with one_thread():
        found = [judged(one, file, name) for one, name in zip(records, names, strict=True)]
    written = _write_campaign(found, file, campaign, chosen)
    if as_json:
        data = [judgement_data(one) for one in found]
        print(json.dumps(data, indent=2, allow_nan=False, ensure_ascii=False))
    else:
        print_tables([table for one in found for table in judgement_tables(one)])
        if written is not None:
            print(f"written: {written}")
    bad = [one for one in found if one.good is not True and (one.test is None or one.response is not None)]
    if check and bad:
        raise AnalysisError("; ".join(f"{one.source}: {one.verdict}" for one in bad) + " [E-RUN-03]")


def _displacement(name: str) -> Displacement:
    chosen = next((one for one in CHANNELS if one == name), None)
    if chosen is None:
        raise InputError(f"--displacement: `{name}` is none of {', '.join(CHANNELS)} [E-CLI-04]")
    return chosen


def _read(rts: Path | None, test: list[str] | None, campaign: Path | None) -> RtsFile | None:
    if rts is not None:
        return load_tests(rts)
    for option, value in (("--test", test), ("--campaign", campaign)):
        if value:
            raise InputError(f"{option}: only with --rts, which says law and specimen [E-CLI-01]")
    return None


def _write_campaign(
    found: list[Judgement], file: RtsFile | None, folder: Path | None, chosen: Displacement
) -> Path | None:
    if folder is None or file is None:
        return None
    return write_record_campaign(found, file, folder, chosen).path
