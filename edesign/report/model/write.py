"""The drawings of a model as files: one of several pages, or one for each drawing."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from edesign._version import __version__
from edesign.archive.files import check_file, write_text, write_whole
from edesign.errors import ArchiveError, InputError
from edesign.project.reading.file_model import FileModel
from edesign.project.reading.problems import did_you_mean
from edesign.report.drawing.style import FORMATS, garbage_between_figures, in_style_of_figures, save, set_indices
from edesign.report.model.figures import Named

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PAGE = ".html"
SUFFIXES = (*(f".{name}" for name in FORMATS), PAGE)


def default_figure_path(path: Path) -> Path:
    """Return the path of the drawings of a file's model: beside it, `NAME_model.pdf`."""
    return path.with_name(f"{path.stem}_model.pdf")


def check_figure_path(path: Path) -> None:
    """Check that drawings can be written to a path.

    Raises:
        InputError: its name ends otherwise than those of drawings.
        ArchiveError: a file there cannot be written.
    """
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        near = did_you_mean(suffix, SUFFIXES) if suffix else ""
        raise InputError(f"{path}: a drawing of the model ends in {', '.join(SUFFIXES)}{near} [E-FILE-08]")
    if not path.parent.is_dir():
        raise ArchiveError(f"{path}: cannot be written: the folder {path.parent} does not exist [E-FILE-06]")
    check_file(path)


def origin(file: FileModel) -> str:
    """Return the source of drawings in words: name and checksum of a file, and the version that drew it."""
    return f"{file.path.name}, SHA-256 {file.checksum[:16]}, edesign {__version__}"


def write_drawings(drawings: Iterable[Named], path: Path, title: str, about: str) -> list[Path]:
    """Write drawings into one file of several pages, or into one file each.

    Args:
        drawings: name, caption, figure.
        path: .pdf and .html take all of them; of .svg and .png the second file is `NAME_loads`, and so on.
        title: title of an HTML page.
        about: the line below the title.

    Returns:
        The files, whole or not there at all.

    Raises:
        InputError, ArchiveError: as `check_figure_path`.
    """
    check_figure_path(path)
    suffix = path.suffix.lower()
    if suffix == ".pdf":
        _pdf(drawings, path)
        return [path]
    if suffix == PAGE:
        _page(drawings, path, title, about)
        return [path]
    written: list[Path] = []
    with garbage_between_figures() as collect:
        for name, _, figure in drawings:
            part = name.partition("_")[2]  # model_loads: loads
            written.append(path.with_name(f"{path.stem}_{part}{path.suffix}") if written else path)
            save(figure, written[-1])
            del figure
            collect()
    return written


def _pdf(drawings: Iterable[Named], path: Path) -> None:
    from matplotlib.backends.backend_pdf import PdfPages

    def write(partial: Path) -> None:
        with in_style_of_figures(), PdfPages(partial, metadata={"CreationDate": None}) as pages:
            for figure in _figures(drawings):
                set_indices(figure)
                pages.savefig(figure)

    write_whole(path, write)


def _figures(drawings: Iterable[Named]) -> Iterator[Figure]:
    for _, _, figure in drawings:
        yield figure


def _page(drawings: Iterable[Named], path: Path, title: str, about: str) -> None:
    from edesign.report.html.inline_svg import picture_of
    from edesign.report.html.render import Cover, render
    from edesign.report.html.section import Section

    pictures = tuple(picture_of(name, caption, figure) for name, caption, figure in drawings)
    section = Section("model", "The model", (), pictures)
    write_text(render(Cover(title, "Model", about, "", f"Drawn by edesign {__version__}."), [section]), path)
