"""The text of a script: head, model, analyses, procedures."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from textwrap import wrap

from edesign.exchange.opensees.commands import Block, Name, Value, one_line, python_block, tcl_block, tcl_comment

WIDTH = 100
"""Of lines of the head."""
USE = (("lists the analyses",), ("NAME ...", "runs some of them"), ("all", "runs all"))
"""What may follow the call of a script, and what the script does then."""
SETTINGS: Mapping[str, Value] = {"TOLERANCE": 1e-8, "SMALLEST": 256}


@dataclass(frozen=True)
class Script:
    """What both texts say.

    Attributes:
        head: paragraphs of the comment at the top.
        blocks: of the model, in the order of their use.
        constants: by name, in order.
        analyses: by name, what each needs.
        dimension: of the model.
    """

    head: Sequence[str]
    blocks: Sequence[Block]
    constants: Mapping[str, Value | Mapping[str, Value]]
    analyses: Mapping[str, Mapping[str, Value]]
    dimension: int = 2


def python_text(script: Script, path: Path) -> str:
    """Return the script for OpenSeesPy."""
    lines = [*_head(script.head, f"python {path.name}"), ""]
    lines += ["import math", "import os", "import sys", "", "import openseespy.opensees as ops", ""]
    lines += ["HERE = os.path.dirname(os.path.abspath(__file__))"]
    lines += ['RESULTS = os.path.splitext(os.path.abspath(__file__))[0] + "_results"']
    parts = ["\n".join(lines)]
    for block in script.blocks:
        parts.append("\n".join(python_block(block)))
    constants = ["", ""]
    for name, value in script.constants.items():
        constants.append(f"{name} = {_python(value)}")
    constants.append("ANALYSES = {")
    for name, analysis in script.analyses.items():
        constants.append(f'    "{name}": {_python(analysis)},')
    constants += ["}", "", "", _procedures("python", script.dimension)]
    return "\n".join([*parts, *constants])


def tcl_text(script: Script, path: Path) -> str:
    """Return the script for OpenSees."""
    lines = [tcl_comment(line) for line in _head(script.head, f"OpenSees {path.name}")]
    lines += ["", "set HERE [file dirname [file normalize [info script]]]"]
    lines += ["set RESULTS [file rootname [file normalize [info script]]]_results"]
    for block in script.blocks:
        lines += tcl_block(block)
    lines.append("")
    for name, value in script.constants.items():
        lines.append(f"set {name} {_tcl(value)}")
    lines.append("set ANALYSES [dict create]")
    for name, analysis in script.analyses.items():
        lines.append(f"dict set ANALYSES {name} {_tcl(analysis)}")
    return "\n".join([*lines, "", _procedures("tcl", script.dimension)])


def _head(paragraphs: Sequence[str], run: str) -> list[str]:
    """Lines of the comment at the top; the first paragraph is one line."""
    first, *others = paragraphs
    use = [f"{' '.join((run, *words))}: {what}" for *words, what in USE]
    return [f"# {one_line(first)}", "#", *(f"# {line}".rstrip() for line in (*_wrapped(others), "", *use))]


def _wrapped(paragraphs: Sequence[str]) -> list[str]:
    lines: list[str] = []
    for paragraph in paragraphs:
        if paragraph.startswith("- "):
            lines += wrap(one_line(paragraph), WIDTH, subsequent_indent="  ", break_long_words=False)
        else:
            lines += ([""] if lines else []) + wrap(one_line(paragraph), WIDTH, break_long_words=False)
    return lines


def _procedures(language: str, dimension: int) -> str:
    """The procedures, with what is of frames in a plane or in space in the place of its name between two `@`."""
    parts = re.split(r"^@(\w+)@\n", _text(f"{'plane' if dimension == 2 else 'space'}_{language}"), flags=re.MULTILINE)
    of = {name: text.removesuffix("\n") for name, text in zip(parts[1::2], parts[2::2], strict=True)}
    return re.sub(r"@(\w+)@", lambda mark: of[mark[1]], _text(f"procedures_{language}"))


def _text(name: str) -> str:
    return files("edesign.exchange.opensees").joinpath(f"data/{name}.txt").read_text(encoding="utf-8")


def _python(value: Value | Mapping[str, Value]) -> str:
    if isinstance(value, Name):
        return value.name
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, Mapping):
        return "{" + ", ".join(f'"{key}": {_python(item)}' for key, item in value.items()) + "}"
    if isinstance(value, tuple):
        return "(" + ", ".join(map(_python, value)) + ("," if len(value) == 1 else "") + ")"
    return repr(value)


def _tcl(value: Value | Mapping[str, Value]) -> str:
    if isinstance(value, Name):
        return value.name
    if isinstance(value, Mapping):
        return "{" + " ".join(f"{key} {_tcl(item)}" for key, item in value.items()) + "}"
    if isinstance(value, tuple):
        return "{" + " ".join(map(_tcl, value)) + "}"
    return value if isinstance(value, str) else repr(value)
