"""All figures of an archive, in the order of a report, and as files."""

from __future__ import annotations

import os
from collections.abc import Iterator
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING

from edesign.archive.files import make_folder
from edesign.archive.reader import Archive, open_archive
from edesign.errors import EdesignError
from edesign.optional_stages import optional
from edesign.report.archive.kinds import kind_of
from edesign.report.drawing.captions import UniqueNames
from edesign.report.drawing.style import check_format, garbage_between_figures, save

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def all_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield all figures of an archive.

    Yields:
        Name of the file, caption and figure.
    """
    return chain.from_iterable(figures(archive) for figures in kind_of(archive).figures())


def draw_figures(
    archive: str | os.PathLike[str] | Archive, folder: Path, figure_format: str = "svg"
) -> tuple[Path, ...]:
    """Draw all figures of an archive into files.

    Args:
        archive: path, or open archive, complete or partial, of `edesign match` or `edesign run`.
        folder: where the files go; made if it does not exist.
        figure_format: svg, png or pdf.

    Returns:
        The files, named as `all_figures` says, with their suffix; none where there is nothing to draw.

    Raises:
        ArchiveError: the archive cannot be read, or a figure cannot be written.
        InputError: the format is unknown, or the archive's project cannot be read by this version.
    """
    if not isinstance(archive, Archive):
        with open_archive(archive) as opened:
            return draw_figures(opened, folder, figure_format)
    suffix = check_format(figure_format)
    written: list[Path] = []
    unique = UniqueNames()
    with garbage_between_figures() as collect:
        for figures in kind_of(archive).figures():
            with optional(figures.__name__.replace("_", " "), passing=(EdesignError,)):
                for name, _, figure in figures(archive):
                    if not written:
                        make_folder(folder)
                    path = folder / f"{unique(name)}.{suffix}"
                    save(figure, path)
                    written.append(path)
                    del figure
                    collect()
    return tuple(written)
