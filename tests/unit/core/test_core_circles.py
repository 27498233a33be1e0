"""The files of the C core stand on floors: few call each other in a circle, headers not at all, and none calls up."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from scipy.sparse.csgraph import connected_components

SOURCES = Path(__file__).parents[3] / "core_c" / "src"
LARGEST = 6  # files; it was 20 until a message of failure had a file of its own

Arrows = Mapping[str, frozenset[str]]
_COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*|\"(?:\\.|[^\"\\\n])*\"", re.DOTALL)
_DEFINED = re.compile(r"^(?!static\b|extern\b)\w[\w *]*?\b(ed_\w+)(?:\([^;{]*\)\s*\{|(?:\[\w*\])*\s*=)", re.MULTILINE)


def calls() -> Arrows:
    """The files, as `system/factors`, whose functions and tables each file names."""
    texts = {
        f"{path.parent.name}/{path.stem}": _COMMENT.sub(" ", path.read_text(encoding="utf-8"))
        for path in sorted(SOURCES.glob("*/*.c"))
    }
    owner = {word: name for name, text in texts.items() for word in _DEFINED.findall(text)}
    return {
        name: frozenset(owner[word] for word in re.findall(r"\bed_\w+\b", text) if owner.get(word, name) != name)
        for name, text in texts.items()
    }


def includes() -> Arrows:
    """The headers of the core that each header includes."""
    return {
        path.relative_to(SOURCES).as_posix(): frozenset(
            re.findall(r'^#include "(\w+/\w+\.h)"', path.read_text(encoding="utf-8"), re.MULTILINE)
        )
        for path in SOURCES.glob("*/*.h")
    }


def circles(arrows: Arrows) -> list[set[str]]:
    """Files of which each reaches each other one."""
    names = sorted(arrows)
    matrix = np.array([[to in arrows[name] for to in names] for name in names])
    _, number = connected_components(matrix, connection="strong")
    found = [{name for name, of in zip(names, number, strict=True) if of == one} for one in set(number)]
    return sorted((one for one in found if len(one) > 1), key=len)


def test_circles_are_found() -> None:
    """Of a graph drawn by hand."""
    arrows = {"a": "b", "b": "c", "c": "ad", "d": "e", "e": "", "f": "g", "g": "f"}
    assert circles({name: frozenset(to) for name, to in arrows.items()}) == [{"f", "g"}, {"a", "b", "c"}]
    assert "base/watch" in calls()["analysis/run"] and "system/fail" in calls()["system/members"]


def test_circles_of_calls_are_small() -> None:
    for circle in circles(calls()):
        assert len(circle) <= LARGEST, sorted(circle)
        assert len({name.partition("/")[0] for name in circle}) == 1, f"not in one folder: {sorted(circle)}"


def test_headers_have_no_circles() -> None:
    assert circles(includes()) == []


def test_a_system_calls_no_analysis() -> None:
    """But for `system/analysis.c`, which puts one together and takes it down."""
    up = {
        name
        for name, to in calls().items()
        if name.startswith("system/") and any(other.startswith("analysis/") for other in to)
    }
    assert up == {"system/analysis"}
