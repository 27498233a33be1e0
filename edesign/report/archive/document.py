"""The report of an archive: its sections in order, rendered and written."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path

from edesign._version import __version__
from edesign.archive.files import check_file, write_text
from edesign.archive.reader import Archive, DamagedArchive, open_archive, read_archive, refuse_calibration
from edesign.errors import ArchiveError, InputError
from edesign.report.archive.kinds import kind_of
from edesign.report.archived import input_checksum
from edesign.report.html.render import Cover, Page, render
from edesign.report.page.cover_facts import cover_lines
from edesign.report.page.source import Source
from edesign.report.page.words import in_words

PAGE_SUFFIXES = (".html", ".htm")


def default_page_path(archive: str | os.PathLike[str]) -> Path:
    """Return the path of the page of an archive: beside it, `NAME.html`, also of `NAME.h5.partial`."""
    path = Path(archive)
    return path.with_name(path.name.removesuffix(".partial")).with_suffix(".html")


def write_page(
    archive: str | os.PathLike[str],
    path: str | os.PathLike[str] | None = None,
    progress: Callable[[str], None] = lambda line: None,
) -> Path:
    """Write the report of an archive as one HTML page without other files.

    Args:
        archive: complete or partial, of `edesign run` or `edesign match`.
        path: the page, whole or not at all; by default beside the archive.
        progress: called with a line for each section and figure.

    Returns:
        The page.

    Raises:
        InputError: the page has another ending than that of a page.
        ArchiveError: the archive cannot be read, or the page cannot be written.
        DamagedArchive: the archive is damaged; the page shows what can be read.
    """
    path = default_page_path(archive) if path is None else Path(path)
    check_page_path(path)
    page, damage = read_archive(archive, lambda opened: page_of(opened, progress))
    write_html(page, path)
    if damage:
        raise DamagedArchive(f"{damage}\n  {path} shows what can be read [E-ARCH-03]")
    return path


def write_html(page: Page, path: Path) -> Path:
    """Write a report as one HTML page without other files.

    Args:
        path: the file, whole or not at all.

    Returns:
        The file.

    Raises:
        InputError: it has another ending than that of a page.
        ArchiveError: it cannot be written.
    """
    check_page_path(path)
    write_text(render(page.cover, page.sections), path)
    return path


def check_page_path(path: Path, suffixes: Sequence[str] = PAGE_SUFFIXES, what: str = "a page") -> None:
    """Check that a report can be written, never over an archive or a file of the user.

    Args:
        suffixes: how its name may end.
        what: the report is, for the message.

    Raises:
        InputError: its name has another ending.
        ArchiveError: it cannot be written.
    """
    if path.suffix.lower() not in suffixes:
        raise InputError(f"{path}: the name of {what} ends in {' or '.join(suffixes)} [E-FILE-08]")
    if not path.parent.is_dir():
        raise ArchiveError(f"{path}: cannot be written: the folder {path.parent} does not exist [E-FILE-06]")
    check_file(path)


def page_text(archive: str | os.PathLike[str] | Archive, progress: Callable[[str], None] = lambda line: None) -> str:
    """Return the report of an archive as HTML.

    Args:
        archive: path or open, complete or partial, of `edesign run` or `edesign match`.
        progress: called with a line for each section and figure.

    Raises:
        ArchiveError: the archive cannot be read.
    """
    page = page_of(archive, progress)
    return render(page.cover, page.sections)


def page_of(
    archive: str | os.PathLike[str] | Archive,
    progress: Callable[[str], None] = lambda line: None,
    tables_only: bool = False,
) -> Page:
    """Return the report of an archive, path or open, as data.

    Args:
        archive: complete or partial, of `edesign run` or `edesign match`.
        progress: called with a line for each section and figure.
        tables_only: draw no figures, which takes a fraction of the time, and leave names of the archive as they are.

    Raises:
        ArchiveError: the archive cannot be read.
    """
    if not isinstance(archive, Archive):
        with open_archive(archive) as opened:
            return page_of(opened, progress, tables_only)
    if not tables_only:
        refuse_calibration(archive)  # its own report has the name that this one would take
    source = Source(archive, progress, figures=not tables_only)
    shown = kind_of(archive).sections(source)
    if not tables_only:
        shown = [in_words(section, source.words) for section in shown]
    return Page(_cover(source), tuple(shown))


def _cover(source: Source) -> Cover:
    about, kind = source.attributes, kind_of(source.archive)
    date = str(source.provenance.get("created", ""))[:10]
    who = f"edesign {about.get('edesign_version', '')}"
    warnings = [source.archive.damage_in_short()]
    if not source.archive.complete:
        warnings.append(f"The run goes on or was interrupted: {kind.unfinished(source)}")
    return Cover(
        title=str(about.get("title") or source.archive.path.stem),
        kind=kind.report,
        about=" · ".join(part for part in (date, who, source.archive.path.name) if part),
        origin=" · ".join(part for part in (who, date) if part),
        created=str(source.provenance.get("created", "")),
        banner=" ".join(filter(None, warnings)),
        footer=f"Made by edesign {__version__} from {source.archive.path.name}, input SHA-256 "
        f"{input_checksum(about)[:16]}. "
        "All numbers are computed from the archive.",
        document=cover_lines(about.get("document")),
    )
