"""`edesign spectrum`: the spectra of the code, and of records beside them."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from edesign.archive.files import check_csv, check_file
from edesign.cli.shared import hazard_options as action
from edesign.cli.shared import recordings as source
from edesign.errors import InputError
from edesign.ground_motion.hazard import code_spectra
from edesign.ground_motion.sources import Found
from edesign.optional_stages import optional
from edesign.project.notation.quantities import TIME
from edesign.report.drawing.style import check_figure_name
from edesign.report.ground_motion.spectrum_table import draw_spectra, record_notes, spectrum_table, write_table
from edesign.report.tables.text import print_tables


def spectrum(
    inputs: Annotated[
        list[Path] | None,
        typer.Argument(help="Records to draw beside it: a suite file or record files.", metavar="[SUITE_OR_FILES]"),
    ] = None,
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
    q: Annotated[
        float | None, typer.Option("--q", help="Behaviour factor for the design spectrum; the project's if not said.")
    ] = None,
    vertical: Annotated[bool, typer.Option("--vertical", help="The vertical component.")] = False,
    periods: Annotated[tuple[str, str], typer.Option("--periods", metavar="FROM TO", help="Range of periods.")] = (
        "0.02s",
        "4s",
    ),
    points: Annotated[
        int, typer.Option("--points", min=2, max=100_000, help="Periods of the table, evenly in log T.")
    ] = 24,
    folder: source.Folder = None,
    no_simulated_records: source.NoSimulatedRecords = False,
    unit: source.Unit = None,
    time_step: source.TimeStep = None,
    layout: source.Layout = None,
    component: source.Component = None,
    column: source.Column = None,
    time_column: source.TimeColumn = None,
    csv: Annotated[Path | None, typer.Option("--csv", metavar="FILE", help="Write the table.")] = None,
    figure: Annotated[Path | None, typer.Option("--figure", metavar="FILE", help="Draw: .svg, .png or .pdf.")] = None,
) -> None:
    """Print the elastic spectrum (acceleration, velocity, displacement), and those of records beside it.

    The spectrum is that of a project's `hazard`, or given by --ground, --a-gr and the like.
    """
    if figure is not None:
        check_figure_name(figure)
        check_file(figure)
    if csv is not None:
        check_csv(csv)
    loaded = action.load(project)
    options = {"code": code, "country": country, "zone": zone, "a_gR": a_gr, "ground": ground}
    options |= {"spectrum": spectrum_type, "damping": damping, "gamma": gamma}
    hazard, level = action.hazard(loaded, options, level, values)
    first, last = (action.quantity(text, TIME, "--periods") for text in periods)
    if first >= last:
        raise InputError(f"--periods: the shorter period stands first, not {first:g} s before {last:g} s [E-CLI-04]")
    reading = source.Reading.of(unit, time_step, layout, component, column, time_column)
    found: dict[str, Found] = {}
    if inputs:
        _, found = source.read_inputs(inputs, folder or [], not no_simulated_records, reading)
    records = {name: item.record for name, item in found.items()}
    elastic, design = code_spectra(hazard, level, vertical, q)
    grid = np.geomspace(first, last, points)
    table = spectrum_table(elastic, records, grid, None if design is None else design.acceleration(grid))
    table.notes = ([] if design is None else [f"Sd: {design.label}"]) + record_notes(found)
    if csv is not None:
        write_table(table, csv)
    print_tables([table])
    if figure is not None:
        with optional("the figure", "the table stands"):
            draw_spectra(elastic, records, (first, last), figure, design)
