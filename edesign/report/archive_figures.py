"""All figures of an archive, as files: its records, and the dampers of its histories."""

from __future__ import annotations

import os
from itertools import chain
from pathlib import Path

from edesign.archive.files import make_folder
from edesign.archive.reader import open_archive
from edesign.errors import InputError
from edesign.project.problems import did_you_mean
from edesign.report.damper_loops import damper_figures
from edesign.report.figures import FORMATS, save
from edesign.report.record_figures import record_figures


def check_format(name: str) -> str:
    """Return the format of figures if it is one.

    Raises:
        InputError: it is none of `FORMATS`.
    """
    if name not in FORMATS:
        raise InputError(f"--format: `{name}` is unknown{did_you_mean(name, FORMATS)} (allowed: {', '.join(FORMATS)})")
    return name


def draw_figures(archive: str | os.PathLike[str], folder: Path, figure_format: str = "svg") -> tuple[Path, ...]:
    """Draw spectra of suites, histories of fitted records, and loops of the dampers of histories.

    Args:
        archive: complete or partial, of `edesign match` or `edesign run`.
        folder: where the files go; made if it does not exist.
        figure_format: svg, png or pdf.

    Returns:
        The files: SUITE_before, SUITE_after, SUITE_mean, RECORD, ANALYSIS_dampers with their suffix; none where there
        is nothing of all this.

    Raises:
        ArchiveError: the archive cannot be read, or a figure cannot be written.
        InputError: the format is unknown.
    """
    suffix = check_format(figure_format)
    written: list[Path] = []
    with open_archive(archive) as opened:
        for name, figure in chain(record_figures(opened), damper_figures(opened)):
            if not written:
                make_folder(folder)
            written.append(folder / f"{name}.{suffix}")
            save(figure, written[-1])
    return tuple(written)
