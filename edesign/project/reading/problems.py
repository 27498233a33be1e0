"""Problems of a YAML file, each with its place, all reported at once."""

from __future__ import annotations

import difflib
import os.path
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from edesign.errors import InputError
from edesign.project.reading.yaml_nodes import Mark, Node, find

Keys = tuple[str | int, ...]

_CLOSE = 0.6  # likeness of close names (difflib's documentation): of two letters both, of four all but one
_LONGEST_NAME = 200  # characters; comparing names takes the square of them
MOST_SHOWN = 100
"""Problems of a file in its message, some screens full; the mistake that the others come from is among the first."""


class FileProblems(InputError):
    """A YAML file is wrong; the message lists the problems found, at most the first of very many.

    Attributes:
        problems: the problems in the order of the file.
    """

    def __init__(self, path: Path, problems: Sequence[Problem]) -> None:
        self.path = path
        self.problems = tuple(sorted(set(problems), key=lambda p: (p.mark, p.keys_text, p.message)))
        lines = [f"{path}:{p.mark.line}:{p.mark.column}: {p}" for p in self.problems[:MOST_SHOWN]]
        if (count := len(self.problems)) > 1:
            more = f", of which the first {MOST_SHOWN} are shown" if count > MOST_SHOWN else ""
            lines.append(f"{count} problems in {path}{more}")
        super().__init__("\n".join(lines))


class ProjectError(FileProblems):
    """A project file is wrong."""


@dataclass(frozen=True)
class Problem:
    """A problem of one key or value."""

    mark: Mark
    keys_text: str
    message: str

    def __str__(self) -> str:
        return f"{self.keys_text}: {self.message}" if self.keys_text else self.message


class Problems:
    """Collects what is wrong in one file: problems are added by key paths, which become lines and columns."""

    def __init__(self, root: Node) -> None:
        self.root = root
        self.found: list[Problem] = []

    def at_value(self, keys: Keys, message: str) -> None:
        """Add a problem of the value at a key path, or of the nearest part that exists if the value is a default.

        Args:
            message: what is wrong.
        """
        self.add(self.node(keys).mark, keys, message)

    def at_item(self, keys: Keys, i: int, message: str) -> None:
        """Add a problem of one of several names at a key path; a single name need not be in a list.

        Args:
            i: index of the name.
            message: what is wrong.
        """
        self.at_value((*keys, i) if self.node(keys).items is not None else keys, message)

    def at_key(self, keys: Keys, message: str) -> None:
        """Add a problem of a key itself: it is unknown, or a key below it is missing.

        Args:
            message: what is wrong.
        """
        self.add(self._key_mark(keys), keys, message)

    def under(self, keys: Keys, missing: str, message: str) -> None:
        """Add a problem of a missing key, at the place of the mapping that needs it.

        Args:
            message: what is wrong.
        """
        self.add(self._key_mark(keys), (*keys, missing), message)

    def add(self, mark: Mark, keys: Keys, message: str) -> None:
        """Add a problem at a place.

        Args:
            mark: line and column.
            message: what is wrong.
        """
        self.found.append(Problem(mark, keys_text(keys), message))

    def node(self, keys: Keys) -> Node:
        """Return the node at a key path, or the deepest one on the way to it."""
        return find(self.root, keys)

    def _key_mark(self, keys: Keys) -> Mark:
        node, mark = self.root, Mark(1, 1)
        for key in keys:
            below = node.child(key)
            if below is None:
                break
            mark = node.key_marks[key] if isinstance(key, str) else below.mark
            node = below
        return mark


def keys_text(keys: Iterable[str | int]) -> str:
    """Return a key path for people: analyses[2].record; lists count from 0."""
    text = ""
    for key in keys:
        text += f"[{key}]" if isinstance(key, int) else f".{key}" if text else key
    return text


def did_you_mean(seen: str, allowed: Iterable[str]) -> str:
    """Return `; did you mean ...?` with the nearest allowed name, or "".

    Args:
        allowed: the known names.
    """
    name = nearest(seen, allowed)
    return f"; did you mean `{name}`?" if name else ""


def nearest(seen: str, allowed: Iterable[str]) -> str:
    """Return the allowed name that is most like an unknown one, "" if none is.

    Args:
        allowed: the known names.
    """
    if len(seen) > _LONGEST_NAME:
        return ""
    names = {name.lower(): name for name in allowed}
    close = difflib.get_close_matches(seen.lower(), names, n=20, cutoff=_CLOSE)
    if not close:
        begun = [name for name in names if seen and name.startswith(seen.lower())]  # ec8 of ec8-2004
        return names[begun[0]] if len(begun) == 1 else ""
    likeness = [difflib.SequenceMatcher(None, name, seen.lower()).ratio() for name in close]
    # of equally near names the one that begins alike: HEB205 is HEB200 rather than HEB320
    best = [name for name, value in zip(close, likeness, strict=True) if value == max(likeness)]
    return names[max(best, key=lambda name: len(os.path.commonprefix([name, seen.lower()])))]


def listed(names: Iterable[object], most: int = 12) -> str:
    """Return names in backquotes with commas.

    Args:
        names: in their order.
        most: number of names that are written; the others are counted.
    """
    names = list(names)
    text = ", ".join(f"`{name}`" for name in names[:most])
    return text + (f" and {len(names) - most} more" if len(names) > most else "") if names else "none"


def as_seen(value: Any) -> str:
    """Return a value of a file as messages show it."""
    if value is None:
        return "nothing"
    if isinstance(value, Mapping):
        return "a mapping"
    if isinstance(value, (tuple, list)):
        return "a list"
    return f"`{str(value).lower() if isinstance(value, bool) else value}`"


def unknown_name(what: str, seen: str, allowed: Iterable[str], advice: str = "") -> str:
    """Return the message for a name that is not defined.

    Args:
        what: kind of the name, such as "record".
        allowed: the known names.
        advice: a clause after them, with its semicolon.
    """
    allowed = list(allowed)
    hint = did_you_mean(seen, allowed)
    several = "criteria" if what == "criterion" else f"{what[:-1]}ies" if what.endswith("y") else f"{what}s"
    known = "" if hint and len(allowed) > 30 else f" ({several} here: {listed(allowed)})"
    return f"there is no {what} `{seen}`{hint}{known}{advice} [E-NAME-01]"
