"""The report of an archive as a PDF with numbered pages, laid out by WeasyPrint."""

from __future__ import annotations

import logging
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from importlib import resources
from pathlib import Path
from typing import Any

from edesign.archive.files import write_whole
from edesign.archive.reader import DamagedArchive, read_archive
from edesign.errors import InputError
from edesign.report.archive.document import check_page_path, default_page_path, page_of
from edesign.report.html.render import Page, fill_template
from edesign.report.html.section import Folded, Part, Section
from edesign.report.page.step import Step, part_of
from edesign.report.pdf.appendix import appendix_number, printed
from edesign.report.pdf.fit import begins_wide, fit_table, picture_size, upright
from edesign.report.pdf.fonts import font_faces, fonts_folder
from edesign.report.pdf.paper import MARGIN_BOTTOM, MARGIN_SIDE, MARGIN_TOP, Paper, PrintOptions
from edesign.report.pdf.texts import begun_at_left
from edesign.report.tables.table import Table
from edesign.report.tables.visible import visible

PDF_SUFFIXES = (".pdf",)
NO_EXTRA = (
    "a PDF needs the package weasyprint: pip install 'edesign[pdf]'; or print the HTML page from a browser [E-CLI-06]"
)
NO_PANGO = (
    "a PDF needs the library Pango of the system, which weasyprint lays text out with "
    "(Debian, Ubuntu: apt-get install libpango-1.0-0 libpangoft2-1.0-0 libharfbuzz-subset0; "
    "Fedora: dnf install pango; macOS: brew install pango); or print the HTML page from a browser "
    "[E-CLI-06]"
)
HEADED = ("Project number", "Revision")  # of the document, in the head of each page
DEFAULTS = PrintOptions()
OF_PAGE, WRITTEN = 0.7, 0.8
"""Usual shares of the time: of sections and figures in that of a PDF, and of the layout in that of its sheets."""


def write_pdf(
    archive: str | os.PathLike[str],
    path: Path | None = None,
    progress: Callable[[str], None] = lambda line: None,
    options: PrintOptions = DEFAULTS,
) -> Path:
    """Write the report of an archive as a PDF.

    Args:
        archive: complete or partial, of `edesign run` or `edesign match`.
        path: the PDF, whole or not at all; by default beside the archive.
        progress: called with a line for each section and figure.
        options: the sheet, and whether appendices are printed.

    Returns:
        The PDF.

    Raises:
        InputError: the file has another ending than `.pdf`, or WeasyPrint or its libraries are missing.
        ArchiveError: the archive cannot be read, or the PDF cannot be written.
        DamagedArchive: the archive is damaged; the PDF shows what can be read.
    """
    path = default_page_path(archive).with_suffix(".pdf") if path is None else path
    check_pdf(path)
    page, damage = read_archive(archive, lambda opened: page_of(opened, part_of(progress, 0.0, OF_PAGE)))
    write_page_as_pdf(page, path, part_of(progress, OF_PAGE, 1.0), options)
    if damage:
        raise DamagedArchive(f"{damage}\n  {path} shows what can be read [E-ARCH-03]")
    return path


def write_page_as_pdf(
    page: Page, path: Path, progress: Callable[[str], None] = lambda line: None, options: PrintOptions = DEFAULTS
) -> Path:
    """Write a page of any report as a PDF; arguments and errors as `write_pdf`."""
    check_pdf(path)
    progress(Step("laying out the sheets of the PDF", 0.0))
    text = print_text(page, options)
    with _sheets_told(progress):
        content = _laid_out(text)
    write_whole(path, lambda part: part.write_bytes(content))
    return path


def check_pdf(path: Path) -> None:
    """Check that a PDF can be made and written, before anything is computed.

    Raises:
        InputError: the file has another ending than `.pdf`, or WeasyPrint or its libraries are missing.
        ArchiveError: it cannot be written.
    """
    check_page_path(path, PDF_SUFFIXES, "a PDF")
    check_pdf_engine()


def check_pdf_engine() -> None:
    """Check that a PDF can be made.

    Raises:
        InputError: WeasyPrint or its libraries are missing.
    """
    _engine()


def print_text(page: Page, options: PrintOptions = DEFAULTS) -> str:
    """Return the HTML that is laid out: the page without folded parts, with tables and figures sized for the sheet.

    Args:
        options: paper and appendices.
    """
    paper = options.paper
    shown = printed([_upright(section, paper) for section in page.sections], options.appendix)
    document = dict(page.cover.document)
    named = [f"{name} {document[name]}" for name in HEADED if name in document]
    clients = [document["Client"]] if "Client" in document else []  # last: a long one is cut
    css = resources.files("edesign.report.pdf").joinpath("print.css").read_text(encoding="utf-8")
    sheet = (
        f"@page {{ size: {paper.width}pt {paper.height}pt; margin: {MARGIN_TOP}pt {MARGIN_SIDE}pt {MARGIN_BOTTOM}pt }}"
    )
    sheet += f" @page wide {{ size: {paper.height}pt {paper.width}pt }}"
    layout = {
        "appendices": shown.appendices,
        "appendix_number": appendix_number,
        "left_out": shown.left_out,
        "head": " · ".join([*named, page.cover.kind, *clients]),
        "table_fit": partial(fit_table, paper=paper),
        "begins_wide": partial(begins_wide, paper=paper),
        "picture_size": partial(picture_size, paper=paper),
    }
    text = fill_template(page.cover, shown.sections, f"{font_faces()}\n{sheet}\n{css}", layout)
    return visible(begun_at_left(text))


def _upright(section: Section, paper: Paper) -> Section:
    """A section whose tables of numbers stand on upright sheets."""
    parts: list[Part] = []
    for part in section.parts:
        if isinstance(part, Folded):
            inside = [
                one for item in part.parts for one in (upright(item, paper) if isinstance(item, Table) else [item])
            ]
            parts.append(replace(part, parts=tuple(inside)))
        else:
            parts += upright(part, paper) if isinstance(part, Table) else [part]
    return replace(section, parts=tuple(parts))


def _laid_out(text: str) -> bytes:
    weasyprint, fetcher = _engine()
    content = weasyprint.HTML(string=text, url_fetcher=fetcher).write_pdf()
    assert isinstance(content, bytes)
    return content


@contextmanager
def _sheets_told(progress: Callable[[str], None]) -> Iterator[None]:
    """Tell the sheets that WeasyPrint lays out; how many there will be, nobody knows before."""

    class Told(logging.Handler):
        def emit(self, record: logging.LogRecord) -> None:
            if record.args and "Creating layout" in record.msg:
                progress(f"laying out the PDF: sheet {record.getMessage().rpartition(' ')[2]}")
            elif "Creating PDF" in record.msg:
                progress(Step("writing the sheets of the PDF", WRITTEN))

    logger, told = logging.getLogger("weasyprint.progress"), Told()
    before = logger.level, logger.propagate
    logger.addHandler(told)
    logger.setLevel(logging.INFO)
    logger.propagate = False
    try:
        yield
    finally:
        logger.removeHandler(told)
        logger.level, logger.propagate = before


def _engine() -> tuple[Any, Callable[..., Any]]:
    """WeasyPrint, and what it may read: the fonts, and nothing of the network."""
    try:
        import weasyprint
        from weasyprint.urls import URLFetcher
    except ImportError as error:
        raise InputError(NO_EXTRA) from error
    except OSError as error:  # a library that cffi does not find
        raise InputError(f"{NO_PANGO}\n  {str(error).partition(chr(10))[0]}") from error

    allowed = {(fonts_folder() / name).as_uri() for name in os.listdir(fonts_folder())}

    class Fonts(URLFetcher):
        def fetch(self, url: str, headers: Any = None) -> Any:
            if url not in allowed:
                raise ValueError(f"{url} is no font of the report")
            return super().fetch(url, headers)

    return weasyprint, Fonts(allowed_protocols=["file"])
