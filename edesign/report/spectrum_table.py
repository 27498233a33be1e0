"""Ordinates of spectra as a table, a CSV file and a figure."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from edesign.codes.spectrum import Spectrum
from edesign.errors import InputError
from edesign.ground_motion.record import Record
from edesign.ground_motion.response_spectrum import psa
from edesign.ground_motion.write import write_text
from edesign.project.units import STANDARD_GRAVITY
from edesign.report.figures import FORMATS, save
from edesign.report.spectra_figure import spectra_figure
from edesign.report.table import Table

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
    """Return the columns as a table for people."""
    rows = [[f"{value:.4g}" for value in row] for row in zip(*(values for _, values in columns), strict=True)]
    return Table(title, [header for header, _ in columns], rows, left=0)


def write_columns(columns: list[Column], path: Path) -> None:
    """Write the columns as CSV, all digits.

    Raises:
        ArchiveError: it cannot be written.
    """
    lines = [",".join(header for header, _ in columns)]
    lines += [",".join(repr(float(value)) for value in row) for row in zip(*(v for _, v in columns), strict=True)]
    write_text("\n".join(lines) + "\n", path)


def draw_spectra(elastic: Spectrum, records: Mapping[str, Record], band: tuple[float, float], path: Path) -> None:
    """Draw the spectrum of the code and those of records; the suffix of the path says the format.

    Raises:
        InputError: the suffix is none of a figure.
        ArchiveError: it cannot be written.
    """
    if path.suffix.lower().lstrip(".") not in FORMATS:
        raise InputError(f"{path}: a figure ends in {', '.join(f'.{name}' for name in FORMATS)}")
    periods = np.geomspace(*band, DRAWN)
    spectra = {name: psa(r.acceleration, r.time_step, periods, elastic.damping) for name, r in records.items()}
    target = elastic.acceleration(periods)
    save(spectra_figure(periods, spectra, target, f"{100 * elastic.damping:g} % damping", elastic.label), path)
