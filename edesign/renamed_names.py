"""Keys of files and options of commands that have a new name: the old one still reads, and a note names the new one.

A file with old names means the same as one with new names: its tree has the new ones. A command prints the notes at its
end; outside of a command a note is a `FutureWarning`.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from typing import NamedTuple

ANY = "*"
"""In a place: any name, or any item of a list."""


class Renamed(NamedTuple):
    """A key with a new name.

    Attributes:
        place: key path of the mapping with the key.
        old: name in files of earlier versions.
        new: name that models and schemas have.
    """

    place: tuple[str, ...]
    old: str
    new: str


KEYS = (
    Renamed(("records", ANY), "stand_in", "simulated"),
    Renamed(("records", ANY), "stand_ins", "simulated_records"),
    Renamed(("records", ANY, "from"), "stand_ins", "simulated_records"),
    Renamed(("records", ANY, "from", ANY), "stand_ins", "simulated_records"),
)

OPTIONS = {"--no-stand-ins": "--no-simulated-records"}
"""New names of options by their old ones."""

_OLD = {key.old for key in KEYS}
_noted: ContextVar[list[str] | None] = ContextVar("_noted", default=None)


def current_name(keys: Sequence[str | int], name: str) -> str:
    """Return the name that a key has now; an old one is noted.

    Args:
        keys: key path of the mapping with the key.
    """
    if name not in _OLD:
        return name
    for place, old, new in KEYS:
        if name == old and len(keys) == len(place) and all(b in (ANY, a) for a, b in zip(keys, place, strict=True)):
            _note(f"the key `{old}` of `{place[0]}` is now called `{new}`; the old name still reads")
            return new
    return name


def current_option(word: str) -> str:
    """Return the name that an option has now; an old one is noted.

    Args:
        word: of the command line.
    """
    if word not in OPTIONS:
        return word
    _note(f"the option {word} is now called {OPTIONS[word]}; the old name still reads")
    return OPTIONS[word]


@contextmanager
def noting_renamed() -> Iterator[Sequence[str]]:
    """Note old names inside, each once, in the list that is yielded."""
    found: list[str] = []
    token = _noted.set(found)
    try:
        yield found
    finally:
        _noted.reset(token)


def _note(message: str) -> None:
    found = _noted.get()
    if found is None:
        warnings.warn(FutureWarning(message), stacklevel=3)
    elif message not in found:
        found.append(message)
