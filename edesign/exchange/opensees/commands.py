"""Commands of OpenSees, printed as Python or as Tcl: both texts say one thing."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

INDENT = "    "


@dataclass(frozen=True)
class File:
    """The name of a file beside the script."""

    name: str


@dataclass(frozen=True)
class Name:
    """The name of a function or procedure of the script."""

    name: str


Word = str | int | float | File
Value = str | int | float | Name | tuple["Value", ...]
"""Data of the script."""


@dataclass(frozen=True)
class Command:
    """A command with its words.

    Attributes:
        name: of the command; "": the line is a comment.
        words: arguments in order; words such as `-dt` are text.
        comment: after it.
        body: commands that stand in braces after it in Tcl, and follow it in Python: fibres of a section, loads of a
            pattern.
    """

    name: str
    words: tuple[Word, ...] = ()
    comment: str = ""
    body: tuple[Command, ...] = ()


@dataclass(frozen=True)
class Block:
    """Commands under one name: a function in Python, a procedure in Tcl."""

    name: str
    purpose: str
    commands: tuple[Command, ...]


def command(name: str, *words: Word, comment: str = "", body: Iterable[Command] = ()) -> Command:
    """Return a command of OpenSees; numbers of numpy become those of Python."""
    return Command(name, tuple(_plain(word) for word in words), comment, tuple(body))


def heading(text: str) -> Command:
    """Return a line that is a comment."""
    return Command("", comment=text)


def python_lines(commands: Iterable[Command], depth: int = 1) -> list[str]:
    """Return commands as calls of OpenSeesPy, imported as `ops`."""
    lines = []
    for item in commands:
        words = ", ".join(_python_word(word) for word in item.words)
        text = f"ops.{item.name}({words})" if item.name else ""
        lines.append(_line(depth, text, item.comment, "  # " if text else "# "))
        lines += python_lines(item.body, depth)
    return lines


def tcl_lines(commands: Iterable[Command], depth: int = 1) -> list[str]:
    """Return commands in the language of OpenSees."""
    lines = []
    for item in commands:
        words = [item.name, *map(_tcl_word, item.words), *(["{"] if item.body else [])]
        text = " ".join(words) if item.name else ""
        lines.append(_line(depth, text, tcl_comment(item.comment), "  ;# " if text else "# "))
        if item.body:
            lines += [*tcl_lines(item.body, depth + 1), f"{INDENT * depth}}}"]
    return lines


def python_block(block: Block) -> list[str]:
    """Return a block as a function."""
    return ["", "", f"def {block.name}():", f'{INDENT}"""{block.purpose}"""', *python_lines(block.commands)]


def tcl_block(block: Block) -> list[str]:
    """Return a block as a procedure; it finds the files beside the script."""
    lines = ["", f"# {block.purpose}", f"proc {block.name} {{}} {{", f"{INDENT}global HERE"]
    return [*lines, *tcl_lines(block.commands), "}"]


def flat(commands: Sequence[Command]) -> list[tuple[Word, ...]]:
    """Return name and words of all commands in the order in which they take effect."""
    found: list[tuple[Word, ...]] = []
    for item in commands:
        if item.name:
            found.append((item.name, *item.words))
        found += flat(item.body)
    return found


def one_line(text: str) -> str:
    """Return text that can stand in a comment of one line, in ASCII."""
    return " ".join(text.encode("ascii", "backslashreplace").decode().split())


def tcl_comment(text: str) -> str:
    """Return text that can stand in a comment of Tcl, which counts braces and joins lines at backslashes."""
    return one_line(text).translate(str.maketrans("{}\\", "()/"))


def _plain(word: Word) -> Word:
    if isinstance(word, (str, File)):
        return word
    return int(word) if isinstance(word, int) or not hasattr(word, "is_integer") else float(word)


def _line(depth: int, text: str, comment: str, mark: str) -> str:
    shown = mark + one_line(comment) if comment else ""
    return f"{INDENT * depth}{text}{shown}" if text or shown else ""


def _python_word(word: Word) -> str:
    if isinstance(word, File):
        return f'os.path.join(HERE, "{word.name}")'
    return f'"{word}"' if isinstance(word, str) else repr(word)


def _tcl_word(word: Word) -> str:
    if isinstance(word, File):
        return f'[file join $HERE "{word.name}"]'
    return word if isinstance(word, str) else repr(word)
