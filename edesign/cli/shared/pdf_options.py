"""Options of the commands that write a report as a PDF."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated

import typer

from edesign.errors import InputError
from edesign.report.pdf.paper import PAPERS, PrintOptions


class PaperName(StrEnum):
    """Sheets that a PDF may have; `edesign.report.pdf.paper.PAPERS` has their sizes."""

    A4 = "A4"
    LETTER = "Letter"


PaperOption = Annotated[
    PaperName | None,
    typer.Option("--paper", case_sensitive=False, help="Sheet of the PDF; A4 if not said.", show_default=False),
]
AppendixOption = Annotated[
    bool, typer.Option("--appendix", help="Print in the PDF, as appendices, what the HTML page folds away.")
]


def print_options(pdf: bool, paper: PaperName | None, appendix: bool) -> PrintOptions:
    """Return how a PDF is printed.

    Args:
        pdf: whether there will be one.
        paper: the option `--paper`; None: A4.
        appendix: the option `--appendix`, which prints folded parts as appendices.

    Returns:
        The sheet, and whether appendices are printed.

    Raises:
        InputError: options of a PDF without one.
    """
    if not pdf and (paper or appendix):
        named = " and ".join(name for name, said in (("--paper", paper), ("--appendix", appendix)) if said)
        raise InputError(f"{named}: only a PDF has sheets; say --pdf too [E-CLI-01]")
    return PrintOptions(PAPERS[paper or PaperName.A4], appendix)
