"""`edesign fit`: damper laws fitted to tests."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any

import typer

from edesign.archive.files import check_folder, check_own_yaml, make_folder, write_text, write_yaml
from edesign.cli.shared import fit_inputs as read
from edesign.cli.shared.complete import law_names
from edesign.cli.shared.fit_inputs import FitInput
from edesign.cli.shared.streams import progress_line
from edesign.cli.shared.workers import DEFAULT, Workers
from edesign.damper.fitting import (
    CrossValidation,
    Fit,
    compare,
    cross_validate,
    fit_law,
    prediction_errors,
)
from edesign.damper.fitting.solve import Progress
from edesign.damper.fitting.write import fit_json, law_yaml
from edesign.damper.law import Law
from edesign.errors import ArchiveError, InputError, Interrupted
from edesign.input_files import spare_inputs
from edesign.optional_stages import optional
from edesign.report.damper.fit_figures import draw_fits
from edesign.report.damper.fit_tables import tables_of
from edesign.report.drawing.style import check_format
from edesign.report.tables.text import print_tables


def fit(
    source: Annotated[
        Path, typer.Argument(metavar="CAMPAIGN_OR_TABLE", help="Campaign file (.yaml), or property table (.csv).")
    ],
    law: Annotated[
        list[str] | None,
        typer.Option(
            "--law",
            help="Law to fit; more than one are compared. The campaign's if not said.",
            autocompletion=law_names,
        ),
    ] = None,
    against: Annotated[
        str | None, typer.Option("--against", help="forces (Eq. 4.32) or properties (Eqs. 4.30-4.31).")
    ] = None,
    start: Annotated[
        list[str] | None,
        typer.Option("--start", help="NAME=VALUE with unit, a set such as thesis_table_4_2, or `data`."),
    ] = None,
    fix: Annotated[
        list[str] | None, typer.Option("--fix", metavar="NAME[=VALUE]", help="Hold a parameter, not fit it.")
    ] = None,
    free: Annotated[
        list[str] | None, typer.Option("--free", metavar="NAME", help="Fit a parameter that is fixed by default.")
    ] = None,
    branches: Annotated[
        int, typer.Option("--branches", min=1, max=16, help="Maxwell branches of generalised_maxwell.")
    ] = 1,
    temperature: Annotated[
        str | None, typer.Option("--temperature", help="gamma: gamma_T of each temperature; ferry: p1 and p2.")
    ] = None,
    starts: Annotated[int, typer.Option("--starts", min=1, max=1000, help="Descents from different starts.")] = 6,
    seed: Annotated[int, typer.Option("--seed", min=0, help="Of the starts.")] = 1,
    loss: Annotated[str, typer.Option("--loss", help="linear, soft_l1, huber, cauchy.")] = "linear",
    cross_validate: Annotated[
        bool, typer.Option("--cross-validate", help="Leave each test out in turn and predict it.")
    ] = False,
    folds: Annotated[
        int | None, typer.Option("--folds", min=2, help="Of --cross-validate: so many parts instead of each test.")
    ] = None,
    layers: Annotated[int | None, typer.Option("--layers", min=1, help="Specimen of a property table.")] = None,
    layer_area: Annotated[str | None, typer.Option("--layer-area", help="Of one layer: `41400 mm^2`.")] = None,
    layer_thickness: Annotated[str | None, typer.Option("--layer-thickness", help="Of one layer: `12 mm`.")] = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="DIR", help="Write law.yaml and fit.json.")
    ] = None,
    json_output: Annotated[bool, typer.Option("--json", help="Print the fit as JSON instead of tables.")] = False,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace a law.yaml that is no fit of this campaign or table.")
    ] = False,
    figures: Annotated[
        Path | None, typer.Option("--figures", metavar="DIR", help="Draw measured and fitted loops of every test.")
    ] = None,
    figure_format: Annotated[str, typer.Option("--format", help="Of the figures: svg, png, pdf.")] = "svg",
    workers: Workers = DEFAULT,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress and no tables.")] = False,
) -> None:
    """Fit damper laws to measured forces or properties; say how sure the parameters are, and which law suffices."""
    check_format(figure_format)
    if folds is not None and not cross_validate:
        raise InputError("--folds: only with --cross-validate [E-CLI-01]")
    for name in free or []:
        if name in {text.partition("=")[0].strip() for text in fix or []}:
            raise InputError(f"--free {name}: it is fixed by --fix; leave one of them out [E-CLI-02]")
    given = read.read_input(source, against, read.read_specimen(layers, layer_area, layer_thickness))
    if given.table is not None and (cross_validate or figures is not None):
        raise InputError("--cross-validate, --figures: only with forces, not with properties [E-CLI-01]")
    for folder in (output, figures):
        if folder is not None:
            check_folder(folder)  # rather than after a long fit
    if not quiet:
        for note in given.notes:
            progress_line(f"note: {note}")
    laws = read.read_laws(law or [], given.law)
    alone = len(laws) == 1
    places = {item.name: output if alone else output / item.name for item in laws} if output is not None else {}
    for place in places.values():
        spare_inputs(place / "fit.json")
        check_own_yaml(place / "law.yaml", source, overwrite)
    options: dict[str, Any] = {"starts": starts, "seed": seed, "loss": loss, "workers": workers}
    options["temperature"] = temperature
    plans = []  # mistakes in any of them are reported before the first fit
    for item in laws:
        begin = read.read_starts(item, start or [], given.law, alone)
        own = options | {
            "fixed": read.read_fixed(item, fix or [], begin, alone),
            "fit_also": [name for name in free or [] if alone or name in {p.name for p in item.parameters}],
            "branches": branches if item.branch else 1,
        }
        plans.append((item, begin, own))
    results: dict[str, _Result] = {}
    refused: dict[str, Exception] = {}  # of several laws, those that cannot be fitted
    unwritten: list[ArchiveError] = []

    def fit_one(law: Law, begin: dict[str, float], own: dict[str, Any]) -> None:
        for result in _fit(law, given, begin, own, cross_validate, folds, quiet):
            results[law.name] = result
            if law.name in places:
                try:
                    _write(result, given, places[law.name], source)
                except ArchiveError as error:  # a full disk does not take the result of a long fit with it
                    unwritten.append(error)

    try:
        for plan in plans:
            if alone:
                fit_one(*plan)
                continue
            done = f"fitted before it: {', '.join(results)}" if results else ""
            try:
                with optional(f"the fit of {plan[0].name}", done, passing=(Exception,)):
                    fit_one(*plan)
            except Exception as error:
                if isinstance(error, Interrupted):
                    raise
                refused[plan[0].name] = error
        for name, reason in refused.items():
            if not results:
                raise reason
            with optional(f"the fit of {name}"):
                raise reason
    finally:  # an interrupt does not take what is fitted by then with it
        found = list(results.values())
        if json_output and found:
            texts = [_json(result) for result in found]
            print(json.dumps(texts[0] if alone else texts, indent=1, allow_nan=False))
        elif found and not quiet:
            with optional("the tables"):
                fits, outs = [result.fit for result in found], [result.held_out for result in found]
                comparison = compare.comparison(fits, outs) if cross_validate or not alone else None
                print_tables(tables_of(fits, comparison, [result.validated for result in found]))
            for name in () if unwritten else results if places else ():
                print(f"written: {places[name] / 'law.yaml'}, fit.json")
    if unwritten:
        raise unwritten[0]
    if figures is not None:
        where = f"; what was fitted is in {output}" if output is not None else ""
        with optional("the figures", f"the fits are printed above{where}"):
            make_folder(figures)
            draw_fits([one.fit for one in found], [*given.tests, *given.validation], figures, figure_format)


@dataclass(frozen=True)
class _Result:
    """A fit, its cross-validation, and its errors on the tests for validation."""

    fit: Fit
    held_out: CrossValidation | None
    validated: dict[str, float]


def _fit(
    law: Law,
    given: FitInput,
    begin: dict[str, float],
    options: dict[str, Any],
    out: bool,
    folds: int | None,
    quiet: bool,
) -> Iterator[_Result]:
    """Yield the fit, then what more was found about it."""
    progress = None if quiet else _progress(law.name)
    measured = given.tests if given.table is None else given.table
    found = fit_law(law, measured, begin, specimen=given.specimen, progress=progress, **options)
    result = _Result(found, None, {})
    yield result
    if given.table is not None:
        return
    low, high = found.tested.temperature_C
    for test in () if quiet else given.validation:
        if not low <= test.temperature_C <= high:
            span = f"{low:g} degC" if low == high else f"{low:g} to {high:g} degC"
            progress_line(f"note: test {test.name} is at {test.temperature_C:g} degC, those fitted at {span}")
    kept = f"{law.name} is fitted"
    if given.validation:
        with optional(f"the prediction of tests for validation by {law.name}", kept):
            result = replace(result, validated=prediction_errors(found, given.validation))
        yield result
    if out:
        with optional(f"the cross-validation of {law.name}", kept):
            held_out = cross_validate(law, given.tests, begin, folds=folds, whole=found, progress=progress, **options)
            result = replace(result, held_out=held_out)
        yield result


def _json(result: _Result) -> dict[str, Any]:
    found = fit_json(result.fit)
    if result.held_out is not None:
        found["nrms_percent_held_out"] = {name: 100.0 * value for name, value in result.held_out.nrms.items()}
    if result.validated:
        found["nrms_percent_validation"] = {name: 100.0 * value for name, value in result.validated.items()}
    return found


def _write(result: _Result, given: FitInput, folder: Path, source: Path) -> None:
    make_folder(folder)
    write_yaml(law_yaml(result.fit, given.title, given.specimen), folder / "law.yaml", source)
    write_text(json.dumps(_json(result), indent=1, allow_nan=False) + "\n", folder / "fit.json")


def _progress(name: str) -> Progress:
    """Print on standard error which start of which law is done."""

    def report(what: str, done: int, of: int) -> None:
        progress_line(f"{name}: {what} {done}/{of}")

    return report
