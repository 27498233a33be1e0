"""`edesign sheet`: a laboratory's sheet of a device, cycle by cycle, and whether it is accepted."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated, get_args

import typer
from pydantic_core import PydanticCustomError

from edesign.archive.csv_files import write_csv_file
from edesign.archive.files import check_csv
from edesign.cli.shared.pdf_options import PaperOption, print_options
from edesign.damper.damper import Damper
from edesign.damper.laws import law
from edesign.damper.parameters import read_parameters
from edesign.damper.testing.acceptance import Acceptance, Device, judge
from edesign.damper.testing.campaign import load_campaign, notes_of, short_names
from edesign.damper.testing.device_cycles import Run, predicted_runs, runs_of
from edesign.damper.testing.measured_files import read_test
from edesign.damper.testing.measured_histories import DamperTest
from edesign.errors import EdesignError, InputError
from edesign.file_kinds.kinds import ARCHIVE, YAML_KINDS
from edesign.file_kinds.recognise import kind_of, refuse_kind
from edesign.optional_stages import earlier, optional
from edesign.project.document import Document
from edesign.project.notation.temperature import parse_temperature
from edesign.project.reading.problems import did_you_mean
from edesign.report.archive.document import check_page_path, write_html
from edesign.report.check.damper_files import force_warnings
from edesign.report.damper import sheet_tables as tables
from edesign.report.page.sheet import sheet_page
from edesign.report.pdf.document import check_pdf, write_page_as_pdf
from edesign.report.tables.text import print_tables


def sheet(
    inputs: Annotated[
        list[Path],
        typer.Argument(
            help="A campaign (.yaml), or test files (.csv).", metavar="CAMPAIGN_OR_TESTS", show_default=False
        ),
    ],
    device: Annotated[
        str | None,
        typer.Option("--device", help="viscous, viscoelastic, hysteretic, elastomeric_isolator.", show_default=False),
    ] = None,
    temperature: Annotated[
        str | None, typer.Option("--temperature", help="Ambient, of test files without a column of it: `20 degC`.")
    ] = None,
    per_cycle: Annotated[bool, typer.Option("--per-cycle", help="Print the sheet of each cycle too.")] = False,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="FILE", help="Write all cycles as CSV.")
    ] = None,
    page: Annotated[
        Path | None, typer.Option("--page", metavar="FILE", help="Write the sheet as an HTML page.")
    ] = None,
    pdf: Annotated[Path | None, typer.Option("--pdf", metavar="FILE", help="Write the sheet as a PDF.")] = None,
    paper: PaperOption = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON in SI units instead of tables.")] = False,
) -> None:
    """Print stiffness, damping, energy and forces of each test of a device, and whether standards accept it."""
    options = print_options(pdf is not None, paper, appendix=False)
    if output is not None:
        check_csv(output)
    if page is not None:
        check_page_path(page)
    if pdf is not None:
        check_pdf(pdf)
    title, tests, asked, damper, document, notes = _read(inputs, device, temperature)
    runs: list[Run] = []
    designs: list[Run | None] = []
    for test in tests:
        try:
            found = runs_of(test)
        except InputError as error:
            notes.append(str(error))
            continue
        runs += found
        notes += [f"{test.name}: {warning}" for warning in force_warnings(test)]
        designs += _designs(test, found, damper, notes)
    if not runs:
        raise InputError("\n".join(notes))
    judged = judge(runs, designs, asked)
    if output is not None:
        headers, rows = tables.csv_rows(runs)
        write_csv_file(headers, rows, output, digits=7)
    if as_json:
        print(json.dumps(tables.sheet_json(runs, judged, notes), indent=1, allow_nan=False, ensure_ascii=False))
    else:
        each = [tables.cycles_table(run, runs) for run in runs] if per_cycle else []
        own = tables.tests_table(runs)
        own.notes += notes
        print_tables([own, *each, tables.acceptance_table(judged, runs)])
        print(tables.verdict_text(judged, runs))
    if output is not None:
        _print_path(output, as_json)
    if page is None and pdf is None:
        return
    with optional("the report", "the sheet stands"):
        report = sheet_page(title, tests, runs, judged, asked, notes, document, designs)
        if page is not None:
            with optional(str(page), f"the sheet stands{earlier(page)}"):
                write_html(report, page)
                _print_path(page, as_json)
        if pdf is not None:
            with optional(str(pdf), f"the sheet stands{earlier(pdf)}"):
                write_page_as_pdf(report, pdf, options=options)
                _print_path(pdf, as_json)


def _print_path(path: Path, as_json: bool) -> None:
    """Say which file was written, unless JSON alone is asked for."""
    if not as_json:
        print(f"written: {path}")


def _designs(test: DamperTest, found: tuple[Run, ...], damper: Damper | None, notes: list[str]) -> list[Run | None]:
    """The runs of a test as the law gives them; none where it cannot."""
    if damper is None:
        return [None] * len(found)
    try:
        return list(predicted_runs(test, damper))
    except EdesignError as error:
        notes.append(f"{test.name}: the law gives no force: {error}")
        return [None] * len(found)


def _read(
    inputs: list[Path], device: str | None, temperature: str | None
) -> tuple[str, tuple[DamperTest, ...], Acceptance, Damper | None, Document, list[str]]:
    """Title, tests, what is asked, the damper of the campaign's law, the cover, and what the reader says."""
    if not any(path.suffix.lower() in (".yaml", ".yml") for path in inputs):
        tests = _tests(inputs, temperature)
        return inputs[0].stem, tests, _with_device(Acceptance(), device), None, Document(), list(notes_of(tests))
    if len(inputs) > 1:
        raise InputError(f"{inputs[0]}: one campaign, or test files; not both, and not two campaigns [E-CLI-05]")
    campaign = load_campaign(inputs[0])
    if temperature is not None:
        raise InputError("--temperature: the campaign says this; leave the option out [E-CLI-02]")
    damper = None
    if campaign.law is not None and campaign.law.parameters is not None:
        chosen = law(campaign.law.type)
        damper = Damper(chosen, read_parameters(chosen, campaign.law.parameters))
    title = campaign.label
    return (
        title,
        campaign.tests,
        _with_device(campaign.acceptance, device),
        damper,
        campaign.document,
        list(campaign.notes),
    )


def _tests(inputs: list[Path], temperature: str | None) -> tuple[DamperTest, ...]:
    for i, path in enumerate(inputs):
        refuse_kind(path, kind_of(path), "test file or campaign file", ARCHIVE, *YAML_KINDS)
        if path in inputs[:i]:
            raise InputError(f"{path}: the file is named twice [E-FILE-09]")
    celsius = None
    if temperature is not None:
        try:
            celsius = parse_temperature(temperature)
        except PydanticCustomError as error:
            raise InputError(f"--temperature: {error.message()}") from None
    names = zip(inputs, short_names(inputs), strict=True)
    return tuple(
        read_test(path, temperature_C=celsius, name=name, unsaid='say --temperature "20 degC"') for path, name in names
    )


def _with_device(asked: Acceptance, device: str | None) -> Acceptance:
    if device is None:
        return asked
    known = get_args(Device)
    if device not in known:
        raise InputError(
            f"--device: `{device}` is unknown{did_you_mean(device, known)} (allowed: {', '.join(known)}) [E-CLI-04]"
        )
    return asked.model_copy(update={"device": device})
