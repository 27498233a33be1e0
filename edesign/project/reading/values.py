"""Other values in a file that was read: in its text, so that text, checksum and values stay together.

`changed_text` edits the text; `first_difference` finds what a model has that its text does not say.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from itertools import zip_longest
from typing import Any

from pydantic import BaseModel

from edesign.errors import InputError
from edesign.project.reading.problems import Keys, Problems, did_you_mean, keys_text, listed
from edesign.project.reading.yaml_edit import set_value, yaml_text
from edesign.project.reading.yaml_nodes import Node, parse

KeyPath = str | Keys
"""A place in a file as messages name it, `frame.columns[0].section`, or its keys one by one."""

_NO_PLACE = "`{}` is no place in a file; one is written like `frame.columns[0].section` [E-VALUE-01]"
_STEP = re.compile(r"\[([0-9]+)\]|\.?([^.\[\]]+)")


def changed_text(text: str, model: BaseModel, values: Mapping[KeyPath, Any], problems: Problems) -> str:
    """Return the text of a file with other values in it.

    Args:
        model: what the text says, for the names that are allowed.
        values: new values by their places; a key that is missing is written.
        problems: collects places that do not exist, and values that cannot stand in a file; its tree is the text's.

    Raises:
        InputError: a value cannot be changed where it is.
    """
    root = problems.root
    for path, value in values.items():
        keys = _keys(path, root) if isinstance(path, str) else tuple(path)
        if keys is None or (message := _missing(model, root, keys)):
            problems.at_key(keys or (), _NO_PLACE.format(path) if keys is None else message)
            continue
        try:
            wanted = _with(root.plain(), keys, parse(yaml_text(value))[0].plain())
            text = set_value(text, root, keys, value)
        except TypeError as error:
            problems.at_value(keys, f"{error}; give text such as `100 GPa`, a number, a list or a mapping [E-VALUE-01]")
            continue
        root, faults = parse(text)
        if faults or root.plain() != wanted:  # rather than run other values than were asked for
            raise InputError(
                f"{keys_text(keys)}: the value cannot be changed where it stands; change the file [E-EDIT-01]"
            )
    return text


def wrong_place(path: str, model: BaseModel, root: Node) -> str:
    """Return why no value can be written at a place of a file, "" if one can.

    Args:
        path: of the place, as messages name it.
        model: what the file says.
        root: its tree.
    """
    keys = _keys(path, root)
    return _NO_PLACE.format(path) if keys is None else _missing(model, root, keys)


def first_difference(model: Any, said: Any, keys: Keys = ()) -> tuple[Keys, Any, Any] | None:
    """Return place, value of the model and value of its text where they first differ, None if they do not.

    Args:
        model: a model, or a part of one.
        said: the part of another model that the text makes.
        keys: key path of both.
    """
    if type(model) is type(said) and not isinstance(model, (str, bytes)):
        parts = _parts(model, said)
        if parts is not None:
            differences = (first_difference(mine, other, (*keys, key)) for key, mine, other in parts)
            return next((found for found in differences if found), None)
    same = type(model) is type(said) and model == said
    return None if same else (keys, model, said)


_ABSENT = object()


def _parts(model: Any, said: Any) -> Iterator[tuple[str | int, Any, Any]] | None:
    """Key, and value of each of two things of one type; None of what has no parts."""
    if isinstance(model, BaseModel):
        return (
            (info.alias or name, getattr(model, name, _ABSENT), getattr(said, name, _ABSENT))
            for name, info in type(model).model_fields.items()
        )
    if is_dataclass(model):
        return ((item.name, getattr(model, item.name), getattr(said, item.name)) for item in fields(model))
    if isinstance(model, Mapping):
        return ((key, model.get(key, _ABSENT), said.get(key, _ABSENT)) for key in dict.fromkeys([*said, *model]))
    if isinstance(model, (list, tuple)):
        return ((i, mine, other) for i, (mine, other) in enumerate(zip_longest(model, said, fillvalue=_ABSENT)))
    return None


def shown(value: Any) -> str:
    """Return a value of a model for messages."""
    if value is _ABSENT:
        return "nothing"
    return f"`{value}`" if isinstance(value, (str, int, float)) else f"another {type(value).__name__.lower()}"


def _keys(path: str, root: Node) -> Keys | None:
    """The keys of a path; a name with points in it is taken whole where there is one. None: it is no path."""
    keys: list[str | int] = []
    node: Node | None = root
    rest = path.strip()
    while rest:
        names = node.entries if node is not None and node.entries is not None else {}
        bare = rest.removeprefix(".") if keys else rest
        fits = [name for name in names if bare == name or (bare.startswith(name) and bare[len(name)] in ".[")]
        match = _STEP.match(rest)
        if fits:
            key: str | int = max(fits, key=len)
            rest = bare[len(str(key)) :]
        elif match and (keys or not rest.startswith((".", "["))):
            key = int(match[1]) if match[1] else match[2]
            rest = rest[match.end() :]
        else:
            return None
        keys.append(key)
        node = node.child(key) if node is not None else None
    return tuple(keys) or None


def _missing(model: Any, root: Node, keys: Keys) -> str:
    """Why a value cannot be written at a place, "" if it can."""
    node, value = root, model
    for depth, key in enumerate(keys):
        below = node.child(key)
        if below is not None:
            node, value = below, _part(value, key)
            continue
        at = keys_text(keys[:depth]) or "the file"
        if isinstance(key, int):
            if node.items is None:
                return f"{at} is no list [E-NAME-01]"
            return f"there is no item {key}; {at} has {len(node.items)}, from 0 [E-NAME-01]"
        if node.items is not None:
            return f"{at} is a list; its items are {at}[0] to [{len(node.items) - 1}] [E-NAME-01]"
        if node.entries is None and node.text:
            return f"{at} is the value `{node.text}`, which has no `{key}` [E-NAME-01]"
        if message := _unknown(value, key, last=depth == len(keys) - 1):
            return message
        if any(not isinstance(part, str) for part in keys[depth:]):
            return f"{at} has no `{key}` yet; give it as a whole [E-NAME-01]"
        return ""
    return ""


def _unknown(value: Any, key: str, last: bool) -> str:
    """Why a key that is not written cannot be; a model knows its keys, and a mapping of names may get a new one."""
    if isinstance(value, BaseModel):
        allowed = [info.alias or name for name, info in type(value).model_fields.items()]
        if key not in allowed:
            return f"unknown key{did_you_mean(key, allowed)} (allowed here: {listed(allowed, 40)}) [E-KEY-01]"
    if isinstance(value, Mapping) and not last:
        known = f"{did_you_mean(key, value)} (there are: {listed(value)})"
        return f"there is no `{key}`{known}; give a new one as a whole [E-NAME-01]"
    return ""


def _part(value: Any, key: str | int) -> Any:
    """The part of a model at a key, None where the model is not built like its text."""
    if isinstance(value, BaseModel):
        names = [name for name, info in type(value).model_fields.items() if key in (name, info.alias)]
        return getattr(value, names[0], None) if names else None
    if isinstance(value, Mapping):
        return value.get(key)
    if isinstance(value, (list, tuple)) and isinstance(key, int) and key < len(value):
        return value[key]
    return None


def _with(plain: Any, keys: Keys, value: Any) -> Any:
    """Plain data with another value at a key path."""
    if not keys:
        return value
    if isinstance(keys[0], int):
        return (*plain[: keys[0]], _with(plain[keys[0]], keys[1:], value), *plain[keys[0] + 1 :])
    return {**(plain or {}), keys[0]: _with((plain or {}).get(keys[0]), keys[1:], value)}
