"""The sheet of a printed report, and what is printed on it."""

from __future__ import annotations

from dataclasses import dataclass

MARGIN_TOP, MARGIN_BOTTOM, MARGIN_SIDE = 62.0, 57.0, 51.0
"""Around what is printed, points; above and below stand the lines of head and foot."""


@dataclass(frozen=True)
class Paper:
    """A sheet.

    Attributes:
        name: as CSS knows it.
        width, height: points (1/72 inch), upright.
    """

    name: str
    width: float
    height: float

    @property
    def line(self) -> float:
        """Width for text on an upright sheet, points."""
        return self.width - 2.0 * MARGIN_SIDE

    @property
    def column(self) -> float:
        """Height for text on an upright sheet, points."""
        return self.height - MARGIN_TOP - MARGIN_BOTTOM

    @property
    def long_line(self) -> float:
        """Width for text on a sheet that lies on its long side, points."""
        return self.height - 2.0 * MARGIN_SIDE


PAPERS = {
    "A4": Paper("A4", 595.28, 841.89),
    "Letter": Paper("letter", 612.0, 792.0),
}
"""By the names of the command line: ISO 216, and ANSI/ASME Y14.1 size A."""


@dataclass(frozen=True)
class PrintOptions:
    """How a report is printed.

    Attributes:
        paper: the sheet.
        appendix: whether what the page folds away is printed too, behind the sections.
    """

    paper: Paper = PAPERS["A4"]
    appendix: bool = False
