"""Write edesign/keys.py: the blocks of projects, studies and buildings as typed mappings, out of the models."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from edesign.schema.build import schema_of
from edesign.schema.kinds import KINDS

FILE = Path(__file__).resolve().parents[1] / "edesign" / "keys.py"
_KINDS = ("project", "study", "building")
_VALUE = "Value"
_HEAD = '''\
"""The blocks of projects, studies and buildings made in Python, for editors and type checkers.

`keys.ColumnRun(storeys="all", section="HEB240", material="S275")` is the mapping with these keys. A type checker
finds keys that a file does not have. Written by tools/python_keys.py out of the models.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal, TypedDict

Value = str | float | Sequence[Any]
"""Text with its unit, number in SI, or a list of these."""

# fmt: off
# ruff: noqa: E501, UP013
'''


def text() -> str:
    """Return the module."""
    found: dict[str, dict[str, str]] = {}
    for kind in _KINDS:
        schema = schema_of(KINDS[kind])
        defs = schema["$defs"]
        names = {}
        for name, of in defs.items():
            if "properties" in of and name[0].isupper():
                other = name in found and set(found[name]) != set(of["properties"])
                names[name] = f"{kind.title()}{name}" if other else name
        for name, known in names.items():
            keys = {key: _type(node, defs, names) for key, node in defs[name]["properties"].items()}
            found.setdefault(known, keys)
    return _HEAD + "".join(_declared(name, keys) for name, keys in sorted(found.items()))


def _declared(name: str, keys: Mapping[str, str]) -> str:
    """A typed mapping in lines of up to 120 characters."""
    items = [f'"{key}": {of if of == "Any" else repr(of)}' for key, of in keys.items()]
    lines = [f'{name} = TypedDict("{name}", {{']
    for item, end in zip(items, [*[", "] * (len(items) - 1), "}, total=False)"], strict=True):
        if len(lines[-1]) + len(item) + len(end) > 120:
            lines[-1] = lines[-1].rstrip()
            lines.append("    ")
        lines[-1] += item + end
    return "\n".join(lines) + "\n"


def _type(node: Any, defs: Mapping[str, Any], names: Mapping[str, str]) -> str:
    """The type of a value: the keys that it has, or the one text that it may be; `Any` of others."""
    parts = list(dict.fromkeys(_parts(node, defs, names)))
    keyed = [part for part in parts if part != _VALUE and not part.startswith("Literal")]
    if "Any" in parts or (not keyed and len(parts) != 1) or parts == [_VALUE]:
        return "Any"
    return " | ".join([*keyed, *([_VALUE] if len(keyed) < len(parts) else [])]) if keyed else parts[0]


def _parts(node: Any, defs: Mapping[str, Any], names: Mapping[str, str]) -> Iterator[str]:
    """The types of the forms of a value."""
    if not isinstance(node, dict):
        yield "Any"
    elif "$ref" in node:
        name = node["$ref"].rpartition("/")[2]
        if name in names:
            yield names[name]
        elif "properties" in defs[name]:  # of a law, or a measure with its limit, which their readers check
            yield "Any"
        else:
            yield from _parts(defs[name], defs, names)
    elif alternatives := node.get("anyOf", node.get("oneOf")):
        for one in alternatives:
            yield from _parts(one, defs, names)
    elif isinstance(node.get("const"), str):
        yield f'Literal["{node["const"]}"]'
    elif node.get("type") in ("array", "object"):
        listed = node["type"] == "array"
        below = None if "prefixItems" in node else node.get("items" if listed else "additionalProperties")
        of = _type(below, defs, names)
        if of == "Any":
            yield _VALUE if listed else "Any"
        else:
            yield f"Sequence[{of}]" if listed else f"Mapping[str, {of}]"
    else:
        yield _VALUE


if __name__ == "__main__":
    FILE.write_text(text(), encoding="utf-8")
