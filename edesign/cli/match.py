"""`edesign match`: recordings fitted to a spectrum, checked against the code."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from edesign.archive.files import check_folder, make_folder
from edesign.cli.shared import hazard_options as action
from edesign.cli.shared import recordings as source
from edesign.cli.shared.progress import listener
from edesign.cli.shared.workers import DEFAULT, Workers
from edesign.errors import AnalysisError, InputError
from edesign.ground_motion.formats.write import write_csv
from edesign.ground_motion.hazard import elastic_spectrum
from edesign.ground_motion.matching import MatchOptions
from edesign.input_files import spare_inputs
from edesign.optional_stages import optional
from edesign.project.notation.quantities import TIME
from edesign.report.archive.figures import draw_figures
from edesign.report.drawing.style import check_format
from edesign.report.ground_motion.record_tables import choice_table, record_tables
from edesign.report.tables.text import print_tables
from edesign.study.run.match import choose_recordings, match_records


def match(
    inputs: source.Inputs,
    project: action.ProjectFile = None,
    level: action.LevelName = None,
    code: action.Code = None,
    values: action.Values = None,
    country: action.Country = None,
    zone: action.Zone = None,
    a_gr: action.GroundAcceleration = None,
    ground: action.Ground = None,
    spectrum_type: action.SpectrumType = None,
    damping: action.Damping = None,
    gamma: action.Importance = None,
    method: Annotated[
        str, typer.Option("--method", "-m", help="wavelets (time domain), frequency (Fourier), or scale (one factor).")
    ] = "wavelets",
    periods: Annotated[tuple[str, str], typer.Option("--periods", metavar="FROM TO", help="Band of the fit.")] = (
        "0.05s",
        "6s",
    ),
    scale_bounds: Annotated[
        tuple[float, float], typer.Option("--scale-bounds", metavar="LEAST MOST", help="Bounds of the constant factor.")
    ] = (0.1, 10.0),
    t1: Annotated[
        str | None, typer.Option("--t1", help="Fundamental period for the criterion on 0.2 T1 to 2 T1: `2.65s`.")
    ] = None,
    select: Annotated[
        int | None, typer.Option("--select", "-k", metavar="K", min=1, help="Fit only the best K recordings.")
    ] = None,
    max_per_event: Annotated[
        int | None, typer.Option("--max-per-event", metavar="N", min=1, help="Of --select: so many of one earthquake.")
    ] = None,
    folder: source.Folder = None,
    no_simulated_records: source.NoSimulatedRecords = False,
    unit: source.Unit = None,
    time_step: source.TimeStep = None,
    layout: source.Layout = None,
    component: source.Component = None,
    column: source.Column = None,
    time_column: source.TimeColumn = None,
    archive: Annotated[
        Path | None, typer.Option("--archive", "-a", help="Where to write; NAME_matched.h5 here by default.")
    ] = None,
    csv: Annotated[
        Path | None, typer.Option("--csv", metavar="DIR", help="Write each matched record as time_s,acceleration_m_s2.")
    ] = None,
    figures: Annotated[Path | None, typer.Option("--figures", metavar="DIR", help="Draw spectra and records.")] = None,
    figure_format: Annotated[str, typer.Option("--format", help="Of the figures: svg, png, pdf.")] = "svg",
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace the archive of something else than these recordings.")
    ] = False,
    workers: Workers = DEFAULT,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress and no tables.")] = False,
) -> None:
    """Fit recordings to the elastic spectrum, check them against the code, archive originals and results.

    The spectrum is that of a project's `hazard`, or given by --ground, --a-gr and the like.
    """
    check_format(figure_format)
    if max_per_event is not None and select is None:
        raise InputError("--max-per-event: only with --select, which chooses the recordings [E-CLI-01]")
    for place in (csv, figures):
        if place is not None:
            check_folder(place)
    loaded = action.load(project)
    options = {"code": code, "country": country, "zone": zone, "a_gR": a_gr, "ground": ground}
    options |= {"spectrum": spectrum_type, "damping": damping, "gamma": gamma}
    hazard, level = action.hazard(loaded, options, level, values)
    target = elastic_spectrum(hazard, level)
    band = (action.quantity(periods[0], TIME, "--periods"), action.quantity(periods[1], TIME, "--periods"))
    settings = MatchOptions(method=method, periods=band, scale_bounds=scale_bounds, damping=hazard.damping)  # type: ignore[arg-type]
    reading = source.Reading.of(unit, time_step, layout, component, column, time_column)
    name, found = source.read_inputs(inputs, folder or [], not no_simulated_records, reading)
    period = action.fundamental_period(loaded, t1)
    tables = []
    if select is not None:
        if period is None:
            raise InputError("--select: the criteria need the fundamental period; give --t1, or --project [E-CLI-03]")
        choice = choose_recordings(found, target, settings, period, select, max_per_event)
        found = choice.recordings
        simulated = [name for name, item in found.items() if item.origin == "simulated"]
        tables = [choice_table(choice.facts, simulated)]
    if csv is not None:
        spare_inputs(*(csv / f"{name}.csv" for name in found))
    path = archive or Path(f"{name}_matched.h5")
    with listener(quiet) as listen:
        summary = match_records(
            found,
            target,
            settings,
            path,
            period,
            name,
            f"{name} fitted to {target.label}",
            workers,
            listen,
            inputs[0],
            overwrite,
        )
    kept = f"the results are in {summary.archive}"
    if csv is not None:
        with optional("the CSV files", kept):
            make_folder(csv)
            for motion in summary.motions.values():
                if not motion.failure:
                    write_csv(motion.record, csv / f"{motion.name}.csv")
    if not quiet:
        with optional("the tables", kept):
            print_tables([*tables, *record_tables(summary.archive)])
        print(f"archive: {summary.archive} ({summary.seconds:.1f} s)")
    if figures is not None:
        with optional("the figures", kept):
            draw_figures(summary.archive, figures, figure_format)
    if summary.failed:
        reasons = "".join(f"\n  {motion.failure}" for motion in summary.failed)
        raise AnalysisError(
            f"{len(summary.failed)} of {len(summary.motions)} recordings could not be fitted{reasons} [E-RUN-01]"
        )
