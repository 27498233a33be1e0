"""`edesign report`: an archive as one HTML page, or as a PDF."""

from __future__ import annotations

import sys
import time
from pathlib import Path
from typing import Annotated

import typer

from edesign.cli.shared.pdf_options import AppendixOption, PaperOption, print_options
from edesign.cli.shared.progress import remaining
from edesign.cli.shared.streams import LOG_EVERY, progress_line
from edesign.report.archive.document import write_page
from edesign.report.page.step import Step
from edesign.report.pdf.document import write_pdf

LINE_AFTER = 1.0  # s between lines on how far it is, on a terminal
EARLIEST = 0.05  # share of the work, from which the time that is left is told


def report(
    archive: Annotated[Path, typer.Argument(help="The archive, complete or partial.", show_default=False)],
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", metavar="FILE", help="The page or PDF; by default beside the archive."),
    ] = None,
    pdf: Annotated[
        bool, typer.Option("--pdf", help="A PDF with numbered pages in place of the HTML page.", show_default=False)
    ] = False,
    paper: PaperOption = None,
    appendix: AppendixOption = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress.")] = False,
) -> None:
    """Write the report of an archive as one HTML page that opens offline and can be mailed, or as a PDF."""
    progress = (lambda line: None) if quiet else PageProgress()
    pdf = pdf or (output is not None and output.suffix.lower() == ".pdf")
    options = print_options(pdf, paper, appendix)
    if pdf:
        written = write_pdf(archive, output, progress, options)
    else:
        written = write_page(archive, output, progress)
    print(f"report: {written} ({written.stat().st_size / 1e6:.1f} MB)")


class PageProgress:
    """A listener that prints progress on standard error, elsewhere than on a terminal once a minute at most."""

    def __init__(self) -> None:
        self._every = LINE_AFTER if sys.stderr.isatty() else LOG_EVERY
        self._begin = self._last = time.monotonic()

    def __call__(self, line: str) -> None:
        """Print a line if one is due, with the share that is done and the time that is left where they are known."""
        now = time.monotonic()
        if now - self._last >= self._every:
            self._last = now
            share = line.share if isinstance(line, Step) else 0.0
            left = (now - self._begin) * (1.0 - share) / share if share >= EARLIEST else None
            progress_line(f"{line}: {share:.0%}{remaining(left, ', about ')}" if share else line)
