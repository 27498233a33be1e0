"""What a section of the page is made of: data only, the template says how it looks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from edesign.optional_stages import optional
from edesign.report.tables.table import Table


@dataclass(frozen=True)
class Picture:
    """A figure as inline SVG.

    Attributes:
        name: unique on the page; its anchor.
        caption: below the figure.
        svg: the element, safe to be written as it is.
        width: in points, at which its type has the size it was drawn for.
    """

    name: str
    caption: str
    svg: str
    width: float


@dataclass(frozen=True)
class Folded:
    """Parts, or a file to the letter, that are shown on demand.

    Attributes:
        summary: what there is.
        parts: tables and pictures.
        text: preformatted text.
    """

    summary: str
    parts: tuple[Table | Picture, ...] = ()
    text: str = ""


@dataclass(frozen=True)
class Facts:
    """Names and their values, one below the other.

    Attributes:
        rows: name and text.
        formulas: whether the texts have symbols of the codes.
    """

    rows: tuple[tuple[str, str], ...]
    formulas: bool = False


@dataclass(frozen=True)
class Warnings:
    """Warnings that a reader must see, such as analyses that failed."""

    title: str
    items: tuple[str, ...]


@dataclass(frozen=True)
class Headline:
    """A result that stands out: a number with its unit, its meaning, and its source."""

    value: str
    label: str
    detail: str = ""
    state: str = ""  # good, bad, or nothing


@dataclass(frozen=True)
class Headlines:
    """A row of results that stand out."""

    items: tuple[Headline, ...]


@dataclass(frozen=True)
class Heading:
    """A title inside a section."""

    text: str


@dataclass(frozen=True)
class Viewer:
    """A picture that moves in the page; on paper, and where no program runs, it is the still.

    Attributes:
        still: one picture of it.
        data: JSON for `viewer.js`, without `<`.
        in_space: whether it is of a building, for `viewer_of_buildings.js`.
    """

    still: Picture
    data: str
    in_space: bool = False


Part = Table | Picture | Folded | Facts | Warnings | Headlines | Heading | Viewer


@dataclass(frozen=True)
class Section:
    """A section of the page.

    Attributes:
        id: anchor, letters and hyphens.
        title: of the section and in the table of contents.
        intro: paragraphs above its parts.
        parts: in the order in which they are shown.
        notes: lines below.
        aside: whether its figures are of single records or members, which a printed report has in an appendix.
    """

    id: str
    title: str
    intro: tuple[str, ...] = ()
    parts: tuple[Part, ...] = field(default=())
    notes: tuple[str, ...] = ()
    aside: bool = False

    def __bool__(self) -> bool:
        """Whether there is anything in it."""
        return bool(self.parts)


def made(name: str, make: Callable[[], Section]) -> Section:
    """Return a section; where it cannot be made, one that says why.

    Args:
        name: of the section, for people, and for its anchor where it cannot be made.
    """
    words = name.strip("_").replace("_", " ")
    with optional(f"the section `{words}` of the report") as attempt:
        return make()
    assert attempt.failure is not None
    warning = Warnings("This section could not be made", (attempt.failure.reason,))
    return Section(words.replace(" ", "-"), words[:1].upper() + words[1:], (), (warning,))
