"""What the docstring of a model says of it and of its keys: the only place where keys are described."""

from __future__ import annotations

import inspect
import re
from functools import cache

from pydantic import BaseModel

_ENTRY = re.compile(r"([A-Za-z_]\w*): (.*)")
_SECTION = re.compile(r"(Attributes|Source|Raises|Returns|Args):(.*)")


@cache
def of_model(model: type[BaseModel]) -> str:
    """Return the description of a model, the first paragraph of its docstring."""
    origin = model.__pydantic_generic_metadata__["origin"] or model
    text = inspect.cleandoc(origin.__doc__ or "")
    return " ".join(text.split("\n\n")[0].split())


@cache
def of_keys(model: type[BaseModel]) -> dict[str, str]:
    """Return the descriptions of the fields of a model by their names, those of its bases included."""
    found: dict[str, str] = {}
    for base in reversed(model.__mro__):
        if issubclass(base, BaseModel) and base is not BaseModel and base.__doc__:
            found.update(_attributes(inspect.cleandoc(base.__doc__)))
    return found


def _attributes(text: str) -> dict[str, str]:
    found: dict[str, str] = {}
    inside, name = False, ""
    for line in text.splitlines():
        if not line.startswith(" ") and line.strip():
            section = _SECTION.fullmatch(line)
            inside, name = bool(section and section[1] == "Attributes"), ""
            continue
        if not inside or not line.strip():
            continue
        entry = _ENTRY.fullmatch(line.strip()) if len(line) - len(line.lstrip()) == 4 else None
        if entry:
            name = entry[1]
            found[name] = entry[2]
        elif name:
            found[name] += f" {line.strip()}"
    return {name: _sentence(said) for name, said in found.items()}


def _sentence(text: str) -> str:
    """The text with a capital letter, unless it begins with a symbol, and a full stop."""
    first = re.split(r"[\s,;:]", text, maxsplit=1)[0]
    start = text[0].upper() + text[1:] if re.fullmatch(r"[a-z][a-z'-]+|a", first) else text
    return start if start.endswith((".", "?", "!")) else f"{start}."
