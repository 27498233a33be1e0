"""YAML text to a tree that knows the line and column of everything in it.

The rules are those of YAML 1.2's core schema, so that `1e-5` is a number and `no`, `1:30` and `2020-01-01` are text.
Keys that come twice are refused, and so are anchors, aliases and tags: what stands in a project file is what it means.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import yaml

from edesign.project.reading.limits import YAML_ADVICE, YAML_BYTES, YAML_DEPTH, YAML_VALUES, megabytes
from edesign.renamed_names import current_name
from edesign.yaml_parser import quick_parser

_INTEGER = re.compile(r"[-+]?[0-9]+")
_FLOAT = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")
_CONSTANTS: dict[str, Any] = {"": None, "null": None, "~": None, "true": True, "false": False}


class Mark(NamedTuple):
    """A place in the text; both count from 1."""

    line: int
    column: int


class Fault(NamedTuple):
    """An error in the YAML itself."""

    mark: Mark
    keys: tuple[str | int, ...]
    message: str


@dataclass
class Node:
    """A value in the file: a scalar (value), a list (items) or a mapping (entries).

    Attributes:
        mark: where the value begins.
        span: where it stands: index of its first character in the text, and of the one after its last.
        flow: whether it is written in brackets or braces.
        text: the scalar as written.
        key_marks: where each key of a mapping stands.
    """

    mark: Mark
    span: tuple[int, int] = (0, 0)
    flow: bool = False
    value: Any = None
    text: str = ""
    items: list[Node] | None = None
    entries: dict[str, Node] | None = None
    key_marks: dict[str, Mark] = field(default_factory=dict)

    def plain(self) -> Any:
        """Return the value as Python data: dict, tuple, str, int, float, bool or None."""
        if self.entries is not None:
            return {key: child.plain() for key, child in self.entries.items()}
        if self.items is not None:
            return tuple(child.plain() for child in self.items)
        return self.value

    def child(self, key: str | int) -> Node | None:
        """Return the value under a key or index, None where there is none."""
        if self.entries is not None and isinstance(key, str):
            return self.entries.get(key)
        if self.items is not None and isinstance(key, int) and 0 <= key < len(self.items):
            return self.items[key]
        return None


def parse(text: str) -> tuple[Node, list[Fault]]:
    """Read YAML text.

    Returns:
        The tree (of duplicated keys the first, of renamed ones the new name), and all faults found; after a syntax
        fault, and of text beyond the limits of `edesign.project.reading.limits`, the tree is empty.
    """
    if message := _too_large(text):
        return Node(Mark(1, 1), entries={}), [Fault(Mark(1, 1), (), message)]
    quick = quick_parser(text)
    if quick is not None:
        reader = _Reader(text, quick)
        try:
            return reader.document(), reader.faults
        except yaml.YAMLError:
            pass  # the other parser says what is wrong
    reader = _Reader(text, yaml.SafeLoader)
    try:
        return reader.document(), reader.faults
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        place = Mark(mark.line + 1, mark.column + 1) if mark else Mark(1, 1)
        said = ", ".join(part for part in (error.context, error.problem) if part)
        return Node(Mark(1, 1), entries={}), [
            Fault(place, (), f"this is not valid YAML: {said}{_hint(said, text, error)} [E-FILE-04]")
        ]
    except yaml.reader.ReaderError as error:
        before = text[: error.position]
        place = Mark(before.count("\n") + 1, len(before) - before.rfind("\n"))
        return Node(Mark(1, 1), entries={}), [Fault(place, (), f"this is not valid YAML: {error.reason} [E-FILE-04]")]


def find(root: Node, keys: Sequence[str | int]) -> Node:
    """Return the node at a key path, or the deepest one on the way to it.

    Args:
        root: of the tree.
        keys: keys and indices from the root.
    """
    node = root
    for key in keys:
        below = node.child(key)
        if below is None:
            break
        node = below
    return node


class _Reader:
    """Builds the tree from PyYAML's events, which carry the marks."""

    def __init__(self, text: str, loader: Any) -> None:
        self.events: Iterator[Any] = iter(yaml.parse(text, Loader=loader))
        self._quick = loader is not yaml.SafeLoader
        self.faults: list[Fault] = []

    def document(self) -> Node:
        root: Node | None = None
        for event in self.events:
            if isinstance(event, yaml.DocumentStartEvent):
                if root is not None:
                    self.faults.append(
                        Fault(_mark(event), (), "a second document begins; a project is one document [E-FILE-04]")
                    )
                    return root
                root = self.node(next(self.events), ())
        return root or Node(Mark(1, 1))

    def node(self, event: Any, keys: tuple[str | int, ...]) -> Node:
        mark = _mark(event)
        if len(keys) > YAML_DEPTH:
            raise yaml.MarkedYAMLError(problem=f"nested deeper than {YAML_DEPTH} levels", problem_mark=event.start_mark)
        self._plain_only(event, keys, mark)
        if isinstance(event, yaml.SequenceStartEvent):
            return self._list(event, keys)
        if isinstance(event, yaml.MappingStartEvent):
            return self._mapping(event, keys)
        node = Node(mark, (event.start_mark.index, event.end_mark.index))
        if isinstance(event, yaml.ScalarEvent):
            if self._quick and _ends_elsewhere(event):
                raise yaml.YAMLError("for the other parser")
            node.value, node.text = _scalar(event), event.value
        return node

    def _list(self, start: Any, keys: tuple[str | int, ...]) -> Node:
        items: list[Node] = []
        while not isinstance(event := next(self.events), yaml.SequenceEndEvent):
            items.append(self.node(event, (*keys, len(items))))
        return Node(_mark(start), _span(start, event, items), bool(start.flow_style), items=items)

    def _mapping(self, start: Any, keys: tuple[str | int, ...]) -> Node:
        node = Node(_mark(start), flow=bool(start.flow_style), entries={})
        last: list[Node] = []
        entries = node.entries
        assert entries is not None
        while not isinstance(event := next(self.events), yaml.MappingEndEvent):
            if not isinstance(event, (yaml.ScalarEvent, yaml.AliasEvent)):
                raise yaml.MarkedYAMLError(problem="a list or mapping is used as a key", problem_mark=event.start_mark)
            self._plain_only(event, keys, _mark(event))
            key = current_name(keys, event.value) if isinstance(event, yaml.ScalarEvent) else f"*{event.anchor}"
            place = _mark(event)
            child = self.node(next(self.events), (*keys, key))
            last = [child]
            if key in entries:
                first = node.key_marks[key]
                message = (
                    f"the key comes twice; it stands already in line {first.line}, column {first.column} [E-KEY-04]"
                )
                self.faults.append(Fault(place, (*keys, key), message))
                continue
            entries[key] = child
            node.key_marks[key] = place
        node.span = _span(start, event, last)
        return node

    def _plain_only(self, event: Any, keys: tuple[str | int, ...], mark: Mark) -> None:
        if isinstance(event, yaml.AliasEvent):
            self.faults.append(
                Fault(mark, keys, f"the alias `*{event.anchor}` is not allowed; write the value out [E-FILE-04]")
            )
            return
        if getattr(event, "anchor", None):
            self.faults.append(
                Fault(mark, keys, f"the anchor `&{event.anchor}` is not allowed; write the value alone [E-FILE-04]")
            )
        if getattr(event, "tag", None):
            self.faults.append(
                Fault(mark, keys, f"the tag `{event.tag}` is not allowed; write the value alone [E-FILE-04]")
            )


def _ends_elsewhere(event: Any) -> bool:
    """Whether libyaml may see the place or the end of a scalar elsewhere: of nothing, or of plain text over lines."""
    return not event.style and (not event.value or event.start_mark.line != event.end_mark.line)


def _mark(event: Any) -> Mark:
    return Mark(event.start_mark.line + 1, event.start_mark.column + 1)


def _span(start: Any, end: Any, children: Sequence[Node]) -> tuple[int, int]:
    """Where a list or mapping stands; the end event of one without brackets comes after the comments below it."""
    if start.flow_style or not children:
        return start.start_mark.index, end.end_mark.index
    return start.start_mark.index, children[-1].span[1]


def _too_large(text: str) -> str:
    """What is said of text beyond the limits, "" if it is not; each value follows one of the signs that are counted."""
    if len(text) > YAML_BYTES:
        return (
            f"the text has {megabytes(len(text))}; at most {megabytes(YAML_BYTES)} are read: {YAML_ADVICE} [E-FILE-02]"
        )
    values = 1 + sum(text.count(sign) for sign in (",", "[", ":", "- ", "-\t", "-\n", "-\r"))
    if values <= YAML_VALUES:
        return ""
    return f"the file has about {values} values; at most {YAML_VALUES} are read: {YAML_ADVICE} [E-FILE-02]"


def _scalar(event: Any) -> Any:
    text = str(event.value)
    if not event.implicit[0] or event.style:
        return text
    if text in _CONSTANTS:
        return _CONSTANTS[text]
    if _INTEGER.fullmatch(text):
        return int(text) if len(text) < 300 else text
    return float(text) if _FLOAT.fullmatch(text) else text


def _hint(said: str, text: str, error: yaml.MarkedYAMLError) -> str:
    lines = text.splitlines()
    for mark in (error.context_mark, error.problem_mark):
        if mark is not None and mark.line < len(lines) and "\u00a0" in lines[mark.line]:
            return f" (line {mark.line + 1} has a no-break space, as text from a web page may; write a space)"
    if "'\\t'" in said:
        return " (indent with spaces, not tabs)"
    if "mapping values are not allowed" in said:
        return " (a `:` followed by a space inside text needs quotes around the text)"
    if "could not find expected ':'" in said:
        return " (a key and its value are written `key: value`, with a space behind the colon)"
    return ""
