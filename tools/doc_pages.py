"""Examples of a page of the docs: files that it shows, commands that it runs, and what they print.

A page marks them by the line that opens a block:

    ```yaml title="my_frame/study.yaml"                   the whole file
    ```yaml title="my_frame/project.yaml, at the end"     lines that are added to it
    ```console                                            `$ edesign ...`, below it what is printed

A page that begins with files of the repository names them in a comment, `<!-- files: PATH PATH -->`; they are copied to
the folder first. In what is printed `...` as a line stands for any lines, at the end of a line for the rest of it.
"""

from __future__ import annotations

import io
import re
import shlex
import shutil
from collections.abc import Iterator
from contextlib import chdir, redirect_stderr, redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

BLOCK = re.compile(r'^```(?P<kind>yaml title="(?P<title>[^"]+)"|console)\n(?P<text>.*?)^```$', re.DOTALL | re.MULTILINE)
_FILES = re.compile(r"^<!-- files: (.*) -->$", re.MULTILINE)
ROOT = Path(__file__).resolve().parents[1]
ADDED = ", at the end"
DIFFERENCE = 0.02
"""Relative, of figures on a page: they are printed with 4 digits, and other machines round otherwise. Standard errors
and ends of searches react most."""


@dataclass(frozen=True)
class Step:
    """One example of a page.

    Attributes:
        kind: what is done with it.
        name: path of the file, or the command.
        text: content of the file, or what the command prints.
        line: of the page where it begins, from 1.
    """

    kind: Literal["write", "add", "run"]
    name: str
    text: str
    line: int


def steps(text: str) -> Iterator[Step]:
    """The examples of a page, in their order.

    Args:
        text: of the page.

    Returns:
        A step for each file and each command.
    """
    for block in BLOCK.finditer(text):
        line = text.count("\n", 0, block.start()) + 1
        title = block["title"]
        if title is not None:
            kind: Literal["write", "add"] = "add" if title.endswith(ADDED) else "write"
            yield Step(kind, title.removesuffix(ADDED), block["text"], line)
            continue
        for part in re.split(r"^\$ ", block["text"], flags=re.MULTILINE)[1:]:
            command, _, printed = part.partition("\n")
            yield Step("run", command, printed, line)


def follow(page: Path, folder: Path) -> Iterator[tuple[Step, str]]:
    """Do what a page says, in a folder.

    Args:
        page: the Markdown file.
        folder: where files are written and commands run.

    Returns:
        Each step once it is done, with what its command printed on standard output; "" of files.

    Raises:
        RuntimeError: a command fails; the message has what it said.
    """
    text = page.read_text(encoding="utf-8")
    for name in (name for found in _FILES.finditer(text) for name in found[1].split()):
        shutil.copy(ROOT / name, folder)
    for step in steps(text):
        path = folder / step.name
        if step.kind == "run":
            yield step, printed_by(step.name, folder)
            continue
        path.parent.mkdir(parents=True, exist_ok=True)
        before = path.read_text(encoding="utf-8") + "\n" if step.kind == "add" else ""
        path.write_text(before + step.text, encoding="utf-8")
        yield step, ""


def printed_by(command: str, folder: Path) -> str:
    """Run a command of the program and return its standard output.

    Args:
        command: `edesign ...`, as on a page.
        folder: the working directory meanwhile.

    Returns:
        What it printed.

    Raises:
        RuntimeError: it ends with another code than 0.
    """
    from edesign.cli.main import main

    words = shlex.split(command)
    if words[:1] != ["edesign"]:
        raise RuntimeError(f"`{command}` is no command of edesign")
    out, errors = io.StringIO(), io.StringIO()
    with chdir(folder), redirect_stdout(out), redirect_stderr(errors):
        code = main(words[1:])
    if code:
        raise RuntimeError(f"`{command}` ends with {code}: {errors.getvalue()}")
    return out.getvalue()


def difference(expected: str, printed: str) -> str:
    """What a page shows and a command did not print, "" if it is as shown.

    Args:
        expected: of the page, with `...`.
        printed: by the command.

    Returns:
        The first line that is missing, and what stands near it.
    """
    lines = [line for line in printed.splitlines() if line.strip()]
    at, free = 0, False
    for line in (line for line in expected.splitlines() if line.strip()):
        if line.strip() == "...":
            free = True
            continue
        found = next(
            (i for i in range(at, len(lines) if free else min(at + 1, len(lines))) if same(line, lines[i])), -1
        )
        if found < 0:
            return f"not printed: {line}\nprinted there:\n" + "\n".join(lines[at : at + 40])
        at, free = found + 1, False
    return "" if free or at == len(lines) else f"printed as well: {lines[at]}"


def same(expected: str, line: str) -> bool:
    """Whether a line of a page and a printed one agree, figures within `DIFFERENCE`."""
    wanted, found = expected.split(), line.split()
    if wanted[-1:] == ["..."]:
        wanted = wanted[:-1]
        found = found[: len(wanted)]
    return len(wanted) == len(found) and all(_same_word(*pair) for pair in zip(wanted, found, strict=True))


def _same_word(wanted: str, found: str) -> bool:
    if wanted == found or {*wanted} == {*found} == {"-"}:
        return True
    try:
        return abs(float(wanted) - float(found)) <= DIFFERENCE * abs(float(wanted))
    except ValueError:
        return False
