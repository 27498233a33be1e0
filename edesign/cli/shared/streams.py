"""Standard output and error of a command: what is printed of a user's text never acts on the terminal."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any, TextIO

from edesign.report.tables.visible import visible


class VisibleStream:
    """A text stream on which control characters are written out (`visible`).

    What the stream cannot encode is written out in the same way. A `rich.console.Console`, which styles its text with
    control characters, finds the stream behind this one; what is printed on it must be `visible` beforehand.
    """

    def __init__(self, stream: TextIO) -> None:
        self.rich_proxied_file = stream  # where `Console.file` looks

    def write(self, text: str) -> int:
        """Write a text with its control characters written out."""
        shown = visible(text)
        try:
            self.rich_proxied_file.write(shown)
        except UnicodeEncodeError:  # of a locale without UTF-8; nothing of the text was written
            self.rich_proxied_file.write(_encodable(shown, self.rich_proxied_file.encoding))
        return len(text)

    def writelines(self, lines: list[str]) -> None:
        """Write several texts."""
        for line in lines:
            self.write(line)

    def __getattr__(self, name: str) -> Any:
        if name == "buffer":  # of bytes, by which text would pass unseen
            raise AttributeError(name)
        return getattr(self.rich_proxied_file, name)


LOG_EVERY = 60.0  # s: in a file or a pipe nothing is said more often of a piece of work that goes on


def progress_line(text: str) -> None:
    """Print a line of progress on standard error.

    Nobody may read it on, or the disk of a log may be full: no reason to stop the work that it reports.
    """
    with suppress(OSError):
        print(text, file=sys.stderr, flush=True)


def _encodable(text: str, encoding: str) -> str:
    def shown(character: str) -> str:
        try:
            character.encode(encoding)
        except UnicodeEncodeError:
            return json.dumps(character)[1:-1]
        return character

    return "".join(map(shown, text))


@contextmanager
def visible_streams() -> Iterator[None]:
    """Write out control characters on standard output and error until the end of the context.

    A process that was started without one of them (`>&-`) gets a place where that is lost.
    """
    before = sys.stdout, sys.stderr
    output, errors = (
        VisibleStream(open(os.devnull, "w", encoding="utf-8") if stream is None else stream) for stream in before
    )
    sys.stdout, sys.stderr = output, errors
    try:
        yield
    finally:
        if sys.stdout is output:  # or typer put something there because the reader of a pipe left
            sys.stdout = before[0] or output.rich_proxied_file
        if sys.stderr is errors:
            sys.stderr = before[1] or errors.rich_proxied_file
