"""Ordinates of spectra as a table, a CSV file and a figure."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from edesign.archive.csv_files import write_csv_file
from edesign.codes.spectrum import DesignOrdinates, Spectrum
from edesign.ground_motion.plausibility import doubts
from edesign.ground_motion.record import Record
from edesign.ground_motion.response_spectrum import psa
from edesign.ground_motion.sources import Found
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.report.drawing.style import check_figure_name, save
from edesign.report.ground_motion.spectra_figure import spectra_figure
from edesign.report.tables.table import Table, formatted

DRAWN = 400  # periods of a figure
Column = tuple[str, np.ndarray]  # header with its unit, values in it


def spectrum_columns(
    elastic: Spectrum, records: Mapping[str, Record], periods: np.ndarray, design: np.ndarray | None = None
) -> list[Column]:
    """Return the columns of a table of spectra.

    Args:
        elastic: of the code.
        records: by name; their pseudo-accelerations at the damping of `elastic` follow.
        periods: shape (n,), s.
        design: ordinates of the design spectrum, shape (n,), m/s2.
    """
    acceleration = elastic.acceleration(periods)
    omega = 2.0 * np.pi / periods
    columns = [
        ("T [s]", periods),
        ("Se [g]", acceleration / STANDARD_GRAVITY),
        ("Se [m/s2]", acceleration),
        ("Sv [m/s]", acceleration / omega),
        ("SDe [m]", elastic.displacement(periods)),
    ]
    if design is not None:
        columns.append(("Sd [g]", design / STANDARD_GRAVITY))
    for name, record in records.items():
        ordinates = psa(record.acceleration, record.time_step, periods, elastic.damping)
        columns.append((f"{name} [g]", ordinates / STANDARD_GRAVITY))
    return columns


def spectrum_table(title: str, columns: list[Column]) -> Table:
    """Return the columns as a table for people.

    Args:
        title: title of the table.
        columns: as `spectrum_columns` gives them.
    """
    rows = [[formatted(value, ".4g") for value in row] for row in zip(*(values for _, values in columns), strict=True)]
    return Table(title, [header for header, _ in columns], rows, left=0)


def record_notes(recordings: Mapping[str, Found]) -> list[str]:
    """Return a line on each recording that is simulated, or about which there are doubts."""
    notes = [f"{name}: simulated, {found.detail}" for name, found in recordings.items() if found.origin == "stand-in"]
    return notes + [f"{name}: {doubt}" for name, found in recordings.items() for doubt in doubts(found.record)]


def write_columns(columns: list[Column], path: Path) -> None:
    """Write the columns as CSV, all digits.

    Args:
        columns: as `spectrum_columns` gives them.
        path: the file to be written.

    Raises:
        ArchiveError: it cannot be written.
    """
    write_csv_file([header for header, _ in columns], zip(*(v.tolist() for _, v in columns), strict=True), path)


def draw_spectra(
    elastic: Spectrum,
    records: Mapping[str, Record],
    band: tuple[float, float],
    path: Path,
    design: DesignOrdinates | None = None,
) -> None:
    """Draw the spectra of the code and those of records.

    Args:
        elastic: of the code.
        records: by name.
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
