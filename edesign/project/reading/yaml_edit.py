"""Changing one value in YAML text and leaving all else, comments too, as it is written."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Any

from edesign.project.reading.yaml_nodes import Node, find, parse

Keys = tuple[str | int, ...]

_BREAK = re.compile("\r\n|[\r\n\x85\u2028\u2029]")  # ends of lines in YAML


def set_value(text: str, root: Node, keys: Keys, value: Any) -> str:
    """Return YAML text with another value at a key path.

    A value that is there is replaced where it stands; one that spans several lines leaves empty lines, so that the
    places of all others stay true. A key that is missing is written behind the last one of its mapping.

    Args:
        text: the YAML text.
        root: its tree, from `parse`.
        keys: of the value; all that are missing must be keys of mappings.
        value: a text, number, truth value, None, or lists and mappings of these.

    Raises:
        TypeError: the value is of another kind.
        KeyError: an item of a list that does not exist, or a key below a text or number.
    """
    depth = _depth(root, keys)
    node, missing = find(root, keys[:depth]), keys[depth:]
    for key in reversed(missing[1:] if node.entries is not None else missing):
        if not isinstance(key, str):
            raise KeyError(key)
        value = {key: value}
    if not missing or (node.entries is None and node.items is None and not node.text):
        return _replaced(text, node, yaml_text(value))
    if node.entries is None or not isinstance(missing[0], str):
        raise KeyError(missing[0])
    return _inserted(text, node, f"{yaml_text(missing[0])}: {yaml_text(value)}")


def yaml_text(value: Any) -> str:
    """Return a value as YAML in one line, which reads back as the same value.

    Raises:
        TypeError: no text, number, truth value or None, or a list or mapping of these with texts as keys.
    """
    if value is None or isinstance(value, bool):
        return "null" if value is None else str(value).lower()
    if isinstance(value, str):
        return _scalar_text(value)
    if isinstance(value, int):
        return str(int(value))
    if isinstance(value, float) and math.isfinite(value):
        return repr(float(value))
    if isinstance(value, Mapping) and all(isinstance(key, str) for key in value):
        return "{" + ", ".join(f"{_scalar_text(key)}: {yaml_text(item)}" for key, item in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(yaml_text(item) for item in value) + "]"
    if hasattr(value, "tolist"):  # numbers and arrays of numpy
        return yaml_text(value.tolist())
    raise TypeError(f"`{value}` ({type(value).__name__}) cannot stand in a YAML file")


def _scalar_text(text: str) -> str:
    """The text as it is where YAML reads it back, as in `100 GPa`; else in quotes."""
    if text and text.isprintable() and not set(text) & set(",[]{}#:"):
        root, faults = parse(f"[{text}]")
        if not faults and root.plain() == (text,):
            return text
    letters = (f"\\{c}" if c in '"\\' else c if c.isprintable() else f"\\U{ord(c):08x}" for c in text)
    return f'"{"".join(letters)}"'


def _depth(root: Node, keys: Keys) -> int:
    """How many of the keys lead to a node."""
    node, depth = root, 0
    while depth < len(keys) and (below := node.child(keys[depth])) is not None:
        node, depth = below, depth + 1
    return depth


def _replaced(text: str, node: Node, new: str) -> str:
    start, end = node.span
    block = not node.flow and (node.entries is not None or node.items is not None)
    # a block may stand as far left as its key, where no other value may; an empty value touches the colon before it
    space = " " if block or start == end else ""
    lines = len(_BREAK.findall(text, start, end))
    return text[:start] + space + new + "\n" * lines + text[end:]


def _inserted(text: str, mapping: Node, entry: str) -> str:
    """Text with an entry behind the last one of a mapping, below it unless the mapping stands in braces."""
    assert mapping.entries is not None
    last = max((child.span[1] for child in mapping.entries.values()), default=None)
    if last is None:
        return text[: mapping.span[0] + 1] + entry + text[mapping.span[0] + 1 :]
    if mapping.flow:
        return f"{text[:last]}, {entry}{text[last:]}"
    if text[last - 1] == "\n":  # behind text in several lines
        last -= 1
    line_end = _BREAK.search(text, last)
    end = line_end.start() if line_end else len(text)
    indent = " " * (next(iter(mapping.key_marks.values())).column - 1)
    return f"{text[:end]}\n{indent}{entry}{text[end:]}"
