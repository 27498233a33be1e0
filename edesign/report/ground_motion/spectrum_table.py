"""Ordinates of spectra as a table, a CSV file and a figure."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from edesign.archive.csv_files import write_csv_file
from edesign.codes.spectrum import DesignOrdinates, Spectrum
from edesign.ground_motion.plausibility import record_warnings
from edesign.ground_motion.record import Record
from edesign.ground_motion.response_spectrum import psa
from edesign.ground_motion.sources import Found
from edesign.report.drawing.style import check_figure_name, save
from edesign.report.ground_motion.spectra_figure import spectra_figure
from edesign.report.tables.column import Column, col, literal
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import M_S, M_S2, G, M, S

DRAWN = 400  # periods of a figure
SPECTRUM = TableSpec[dict[str, float]](
    "spectrum",
    "{title}",
    (
        col("T", S, form=".4g"),
        col("Se", G, form=".4g"),
        col("Se", M_S2, form=".4g"),
        col("Sv", M_S, form=".4g"),
        col("SDe", M, form=".4g"),
        col("Sd", G, form=".4g", optional=True),
    ),  # and each record
    keys=0,
    named_by_title=True,
)


def spectrum_table(
    elastic: Spectrum, records: Mapping[str, Record], periods: np.ndarray, design: np.ndarray | None = None
) -> Table:
    """Return the ordinates of a spectrum of the code, and of those of records at its damping.

    Args:
        periods: shape (n,), s.
        design: ordinates of the design spectrum, shape (n,), m/s2.
    """
    acceleration = elastic.acceleration(periods)
    omega = 2.0 * np.pi / periods
    columns = {"T": periods, "Se": acceleration, "Sv": acceleration / omega, "SDe": elastic.displacement(periods)}
    columns["Sd"] = np.full(periods.shape, None) if design is None else design
    for name, record in records.items():
        columns[f"record {name}"] = psa(record.acceleration, record.time_step, periods, elastic.damping)
    rows = (dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True))
    of_records: list[Column[dict[str, float]]] = [
        col(literal(name), G, f"record {name}", form=".4g") for name in records
    ]
    return SPECTRUM.of(rows, more=of_records, title=elastic.label)


def record_notes(recordings: Mapping[str, Found]) -> list[str]:
    """Return a line on each recording that is simulated, or has warnings."""
    notes = [f"{name}: simulated, {found.detail}" for name, found in recordings.items() if found.origin == "simulated"]
    return notes + [
        f"{name}: {warning}" for name, found in recordings.items() for warning in record_warnings(found.record)
    ]


def write_table(table: Table, path: Path) -> None:
    """Write the numbers of a table as CSV, all digits, in the units that are printed.

    Args:
        table: as `spectrum_table` gives it.

    Raises:
        ArchiveError: the file cannot be written.
    """
    rows = [[column.data(value) for column, value in zip(table.columns, row, strict=True)] for row in table.rows]
    write_csv_file(table.headers, rows, path)


def draw_spectra(
    elastic: Spectrum,
    records: Mapping[str, Record],
    band: tuple[float, float],
    path: Path,
    design: DesignOrdinates | None = None,
) -> None:
    """Draw the spectra of the code and those of records.

    Args:
        band: shortest and longest period, s.
        path: the figure; its suffix says the format.
        design: the design spectrum, drawn too if it is given.

    Raises:
        InputError: the suffix is none of a figure.
        ArchiveError: it cannot be written.
    """
    check_figure_name(path)
    periods = np.geomspace(*band, DRAWN)
    spectra = {name: psa(r.acceleration, r.time_step, periods, elastic.damping) for name, r in records.items()}
    goals = {elastic.label: elastic.acceleration(periods)}
    if design is not None:
        goals[design.label] = design.acceleration(periods)
    save(spectra_figure(periods, spectra, goals, f"{100 * elastic.damping:g} % damping"), path)
