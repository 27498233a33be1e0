"""Names of analyses and records in words: `damped.DBE.Tabas1978_FER-L1` is damped, DBE, Tabas 1978 FER-L1."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial

from edesign.archive.dataset import Group
from edesign.project.analysis.pushover import SIDES
from edesign.report.drawing.captions import record_label
from edesign.report.html.section import Facts, Folded, Headline, Headlines, Part, Picture, Section, Viewer, Warnings
from edesign.report.tables.table import Table
from edesign.report.tables.text import PAPER

_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.+/-]*")
_METHODS = {"n2": "N2", "fema356": "FEMA 356", "asce41": "ASCE/SEI 41"}
_LABEL = re.compile("[a-z]+( [a-z]+)?: ")  # a note begins, as `not met: ...`


def analysis_words(name: str, group: Group) -> str:
    """Return the words for an analysis that a program named: variant, level and record, or kind.

    A name that its author gave, without points, stays as it is.
    """
    about = group.attributes
    variant, level, record = (str(about.get(key) or "") for key in ("variant", "level", "record"))
    rest = name.removeprefix(f"{variant}.") if variant else name
    own = variant if rest != name else ""
    if "." not in name:
        return name
    end = record.rpartition("/")[2]
    before, found, after = rest.partition(end) if end else (rest, "", "")
    if about.get("kind") == "history" and (found or (own and level == rest)):
        degrees = about.get("temperature_C")
        warm = "" if degrees is None or not own else f" at {float(str(degrees)):g} °C"
        before = before.strip(".")
        parts = [f"{own}{warm}", level if level and before.endswith(level) else before]
        return ", ".join(part for part in (*parts, record_label(record), after.strip(".")) if part)
    words = [_METHODS.get(part, SIDES.get(part, part.replace("_", " "))) for part in rest.split(".")]
    return ", ".join(part for part in (own, *words) if part)


def words_of(groups: Mapping[str, Group], records: Iterable[str]) -> dict[str, str]:
    """Return the words for analyses and records named by a program; words that would become alike are left out.

    Args:
        records: references of records, such as suite/recording.
    """
    found = {name: analysis_words(name, group) for name, group in groups.items()}
    count = Counter(found.values())
    found = {name: words for name, words in found.items() if words != name and count[words] == 1}
    for reference in records:
        for name in (reference, reference.rpartition("/")[2]):
            if name not in groups and record_label(name) != name:
                found.setdefault(name, record_label(name))
    return found


def in_words(section: Section, words: Mapping[str, str]) -> Section:
    """Return a section whose texts have words in place of names; verbatim files and drawings stay."""
    say = partial(_said, words)
    return replace(
        section,
        intro=tuple(map(say, section.intro)),
        parts=tuple(_part(part, say) for part in section.parts),
        notes=tuple(map(say, section.notes)),
    )


def _said(words: Mapping[str, str], text: str) -> str:
    return _NAME.sub(lambda found: _word(words, found[0]), text)


def _word(words: Mapping[str, str], name: str) -> str:
    if name in words:
        return words[name]
    plain = name.rstrip(".")  # at the end of a sentence
    return words[plain] + name[len(plain) :] if plain in words else name


def _part(part: Part, say: Callable[[str], str]) -> Part:
    if isinstance(part, Table):
        return _table(part, say)
    if isinstance(part, Picture):
        return replace(part, caption=say(part.caption))
    if isinstance(part, Viewer):
        return replace(part, still=replace(part.still, caption=say(part.still.caption)))
    if isinstance(part, Folded):
        inside = tuple(found for one in part.parts if isinstance(found := _part(one, say), Table | Picture))
        return replace(part, summary=say(part.summary), parts=inside)
    if isinstance(part, Facts):
        return replace(part, rows=tuple((name, say(text)) for name, text in part.rows))
    if isinstance(part, Warnings):
        return replace(part, items=tuple(map(say, part.items)))
    if isinstance(part, Headlines):
        return Headlines(tuple(_tile(tile, say) for tile in part.items))
    return part


def _table(table: Table, say: Callable[[str], str]) -> Table:
    return table if table.names_kept else replace(table, notes=_joined(table.notes)).in_words(say)


def _joined(notes: Sequence[str]) -> list[str]:
    """Notes that were broken into lines of a terminal, each as one again: the next word did not fit a line.

    One that begins with what it is of, `not met: ...`, is a note of its own.
    """
    found: list[str] = []
    last = ""
    for note in notes:
        word = note.partition(" ")[0]
        if (
            last
            and not last.endswith(".")
            and not _LABEL.match(note)
            and len(last) <= PAPER < len(last) + 1 + len(word)
        ):
            found[-1] += f" {note}"
        else:
            found.append(note)
        last = note
    return found


def _tile(tile: Headline, say: Callable[[str], str]) -> Headline:
    return replace(tile, label=say(tile.label), detail=say(tile.detail))
