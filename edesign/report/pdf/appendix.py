"""What of a page is printed: folded parts and figures of single records in appendices, or not at all."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from edesign.report.html.section import Folded, Heading, Part, Picture, Section, Viewer

LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"


@dataclass(frozen=True)
class Printed:
    """A page as it is printed.

    Attributes:
        sections: with nothing folded in them; those of which nothing is left are out.
        appendices: one for each section of which parts are printed later, in their order.
        left_out: the titles of sections that have more than what is printed, with how many parts.
    """

    sections: tuple[Section, ...]
    appendices: tuple[Section, ...] = ()
    left_out: tuple[str, ...] = ()


def printed(sections: Iterable[Section], appendix: bool) -> Printed:
    """Return the sections without their folded parts and figures of single records, which become appendices.

    Args:
        sections: of the page.
        appendix: whether to print the appendices.
    """
    kept, appendices, left_out = [], [], []
    for section in sections:
        later = [part for part in section.parts if _later(part, section)]
        shown = replace(section, parts=_first(section))
        if shown:
            kept.append(shown)
        if later and appendix:
            appendices.append(_appendix(section))
        elif later:
            left_out.append(f"{section.title} ({len(later)})")
    return Printed(tuple(kept), tuple(appendices), tuple(left_out))


def _later(part: Part, section: Section) -> bool:
    """Whether a part is printed in an appendix."""
    return isinstance(part, Folded) or section.aside and isinstance(part, (Picture, Viewer))


def appendix_number(index: int) -> str:
    """Return the letter of an appendix: A to Z, then A1 to Z1 and on.

    Args:
        index: from 0.
    """
    round_, letter = divmod(index, len(LETTERS))
    return f"{LETTERS[letter]}{round_ or ''}"


def _first(section: Section) -> tuple[Part, ...]:
    """The parts that are not printed later, without the headings that have nothing left below them."""
    return _headed([part for part in section.parts if not _later(part, section)])


def _headed(parts: Sequence[Part]) -> tuple[Part, ...]:
    """Parts without headings that have nothing below them."""
    return tuple(
        part
        for i, part in enumerate(parts)
        if not (isinstance(part, Heading) and (i + 1 == len(parts) or isinstance(parts[i + 1], Heading)))
    )


def _appendix(section: Section) -> Section:
    parts: list[Part] = []
    for part in section.parts:
        if isinstance(part, Folded):
            parts += [Heading(part.summary)]
            parts += [replace(part, summary="")] if part.text else part.parts
        elif isinstance(part, Heading) or _later(part, section):
            parts.append(part)
    return Section(f"appendix-{section.id}", section.title, (), _headed(parts))
