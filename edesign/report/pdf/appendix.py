"""What of a page is printed: folded parts in appendices, or not at all."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from edesign.report.html.section import Folded, Heading, Part, Section

LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"


@dataclass(frozen=True)
class Printed:
    """A page as it is printed.

    Attributes:
        sections: with nothing folded in them; those of which nothing is left are out.
        appendices: one for each section that had folded parts, in their order.
        left_out: the titles of sections that have more than what is printed, with how many parts.
    """

    sections: tuple[Section, ...]
    appendices: tuple[Section, ...] = ()
    left_out: tuple[str, ...] = ()


def printed(sections: Iterable[Section], appendix: bool) -> Printed:
    """Return the sections without their folded parts, which become appendices.

    Args:
        sections: of the page.
        appendix: whether to print the folded parts as appendices.
    """
    kept, appendices, left_out = [], [], []
    for section in sections:
        folded = [part for part in section.parts if isinstance(part, Folded)]
        shown = replace(section, parts=_unfolded(section.parts))
        if shown:
            kept.append(shown)
        if folded and appendix:
            appendices.append(_appendix(section, folded))
        elif folded:
            left_out.append(f"{section.title} ({len(folded)})")
    return Printed(tuple(kept), tuple(appendices), tuple(left_out))


def appendix_number(index: int) -> str:
    """Return the letter of an appendix: A to Z, then A1 to Z1 and on.

    Args:
        index: from 0.
    """
    round_, letter = divmod(index, len(LETTERS))
    return f"{LETTERS[letter]}{round_ or ''}"


def _unfolded(parts: Sequence[Part]) -> tuple[Part, ...]:
    """Parts without the folded ones, and without the headings that have nothing left below them."""
    left = [part for part in parts if not isinstance(part, Folded)]
    return tuple(
        part
        for i, part in enumerate(left)
        if not (isinstance(part, Heading) and (i + 1 == len(left) or isinstance(left[i + 1], Heading)))
    )


def _appendix(section: Section, folded: Sequence[Folded]) -> Section:
    parts: list[Part] = []
    for part in folded:
        parts += [Heading(part.summary)]
        parts += [replace(part, summary="")] if part.text else part.parts
    return Section(f"appendix-{section.id}", section.title, (), tuple(parts))
