"""What all YAML files of edesign share: reading the text, and checking it against a model."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from edesign.errors import InputError
from edesign.file_kinds.kinds import ARCHIVE, PACKED, PAGE, PDF, PICTURE, RECORDING, SAP2000, TABLE, WORKBOOK
from edesign.file_kinds.recognise import kind_of_keys
from edesign.project.reading.explain import explain
from edesign.project.reading.file_bytes import read_file
from edesign.project.reading.limits import YAML_ADVICE, YAML_BYTES
from edesign.project.reading.problems import Keys, Problem, Problems, keys_text
from edesign.project.reading.yaml_nodes import Mark, Node, parse

M = TypeVar("M", bound=BaseModel)
_FOREIGN = (RECORDING, SAP2000, PDF, PICTURE, PAGE, WORKBOOK, PACKED)


def read_yaml_text(path: Path, what: str) -> str:
    """Read a YAML file.

    Args:
        what: it is, for messages: "project file".

    Raises:
        InputError: missing, a folder, unreadable, too large, or not UTF-8.
    """
    return yaml_text(read_yaml_file(path, what), path)


def read_yaml_file(path: Path, what: str) -> bytes:
    """Read the content of a YAML file; arguments and errors as `read_yaml_text`."""
    return read_file(path, what, YAML_BYTES, YAML_ADVICE, refused=(ARCHIVE, TABLE, *_FOREIGN))


def yaml_text(data: bytes, path: Path) -> str:
    """Return the text of a YAML file.

    Args:
        path: for messages.

    Raises:
        InputError: its content is not UTF-8.
    """
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        raise InputError(
            f"{path}:{line}: the file is not UTF-8 text (byte 0x{data[error.start]:02x}) [E-FILE-03]"
        ) from None


def check_model(text: str, model: type[M], what: str, begins: str, hint: str = "") -> tuple[M | None, Problems]:
    """Check YAML text against a model.

    Args:
        model: what it has to satisfy.
        what: it is, for messages: "project file".
        begins: the first line of such a file: "edesign: 1".
        hint: what to do about an empty file.

    Returns:
        The model, None if it is not satisfied; the problems found, which know the tree (`root`) of the file.
    """
    root, faults = parse(text)
    problems = Problems(root)
    for fault in faults:
        problems.add(fault.mark, fault.keys, fault.message)
    if root.entries is None and not root.items and not root.text:
        problems.at_value((), f"the {what} is empty{hint} [E-FILE-05]")
    elif root.entries is None:
        problems.at_value((), f"a {what} is a mapping that begins with `{begins}` [E-FILE-05]")
    if not root.entries:
        return None, problems
    faulty = {fault.keys for fault in faults}
    empty = {keys_text(keys): keys for keys in _empty_keys(root) if keys not in faulty}
    for keys in empty.values():
        problems.at_key(keys, "the key is empty; give it a value, or leave it out [E-KEY-02]")
    reported = len(problems.found)
    try:
        return model.model_validate(_without(root, set(empty.values()))), problems
    except ValidationError as error:
        explain(error, model, problems)
        echoes = [problem for problem in problems.found[reported:] if problem.keys_text in empty]  # that it is missing
        problems.found = [problem for problem in problems.found if problem not in echoes]
        problems.found = _without_echoes(problems.found, {fault.mark for fault in faults})
        _tell_other_kind(problems, what, begins)
        return None, problems


def _empty_keys(node: Node, keys: Keys = ()) -> Iterator[Keys]:
    """Keys of mappings without a value, `buckling:` or `buckling: null`: what is meant by them cannot be known."""
    for key, child in (node.entries or {}).items():
        if child.value is None and child.entries is None and child.items is None:
            yield (*keys, key)
        yield from _empty_keys(child, (*keys, key))
    for i, child in enumerate(node.items or ()):
        yield from _empty_keys(child, (*keys, i))


def _without(node: Node, left_out: set[Keys], keys: Keys = ()) -> Any:
    """The plain data of a node without some keys below it."""
    if node.entries is not None:
        return {
            key: _without(child, left_out, (*keys, key))
            for key, child in node.entries.items()
            if (*keys, key) not in left_out
        }
    if node.items is not None:
        return tuple(_without(child, left_out, (*keys, i)) for i, child in enumerate(node.items))
    return node.value


def _tell_other_kind(problems: Problems, what: str, begins: str) -> None:
    """Keep only the problem that a file is of another kind, if the whole file is."""
    entries = problems.root.entries or {}
    kind = kind_of_keys(entries)
    if kind is None or kind.name == what or what in kind.name.split(" or "):
        return
    if what.removesuffix(" file") in kind.name:  # a campaign or programme
        return
    problems.found = []
    key = next(key for key in entries if key in kind.keys)
    problems.at_key((key,), f"this is a {kind.name}; a {what} begins with `{begins}`; {kind.use} [E-FILE-05]")


def _without_echoes(found: list[Problem], faulty: set[Mark]) -> list[Problem]:
    """Keep the first problem at a place where the YAML itself is at fault: the others only follow from it."""
    kept: list[Problem] = []
    for problem in found:
        if problem.mark not in faulty or all(problem.mark != other.mark for other in kept):
            kept.append(problem)
    return kept
