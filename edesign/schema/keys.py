"""The reference of the keys of a kind of file, in Markdown, out of its schema."""

from __future__ import annotations

import json
import re
from typing import Any

from edesign.file_kinds.kinds import FileKind
from edesign.project.notation.written import Json
from edesign.schema.build import schema_of
from edesign.schema.kinds import KINDS

_LAW_PARAMETERS = "parameters_of_"
_HEADER = ("| key | type | default | meaning |", "|---|---|---|---|")
_MADE = "<!-- Made from the models by `make docs-keys`; changes belong into their docstrings. -->"


def key_page(kind: FileKind) -> str:
    """Return the page of a kind of file: a table of its keys, and one of each block in it."""
    return _Page(kind).text()


def index_page() -> str:
    """Return the page that lists the pages of all kinds."""
    rows = [
        f"| [{kind.titled}]({kind.schema}.md) | {', '.join(f'`{key}`' for key in kind.keys)} "
        f"| [guide]({_guide(kind)}) | `edesign schema {kind.schema}` |"
        for kind in KINDS.values()
    ]
    return "\n".join(
        [
            _MADE,
            "",
            "# Keys of all YAML files",
            "",
            "Each page lists every key of a kind of file, with its type, unit, default and meaning. The guides",
            "explain how keys belong together. [Keys in your editor](../../how_to/editors.md) says how an editor",
            "completes and checks them while you type.",
            "",
            "| file | known by | guide | schema |",
            "|---|---|---|---|",
            *rows,
            "",
        ]
    )


def _guide(kind: FileKind) -> str:
    return (
        f"../{kind.guide.removeprefix('reference/')}" if kind.guide.startswith("reference/") else f"../../{kind.guide}"
    )


class _Page:
    """The page of a kind of file; blocks stand in the order in which keys first lead to them."""

    def __init__(self, kind: FileKind) -> None:
        self.kind = kind
        self.schema = schema_of(kind)
        self.definitions: dict[str, Json] = self.schema["$defs"]
        self.places: dict[str, list[str]] = {}
        self._visit(self.schema, "")
        self.headings = self._headings()

    def text(self) -> str:
        title = f"Keys of the {self.kind.titled}"
        lines = [_MADE, "", f"# {title}", ""]
        lines += [self.schema["description"], ""] if self.schema.get("description") else []
        lines += [
            f"The [guide]({_guide(self.kind)}) explains them; `edesign schema {self.kind.schema}` prints the schema.",
            "",
        ]
        lines += self._table(self.schema)
        for name, places in self.places.items():
            block = self.definitions[name]
            shown = [f"`{place}`" for place in places[:4]] + (["..."] if len(places) > 4 else [])
            lines += [f"## {self.headings[name]}", "", f"{block['description']} At {', '.join(shown)}.", ""]
            lines += self._table(block)
        return "\n".join(lines)

    def _visit(self, schema: Any, place: str) -> None:
        """Note the blocks below a schema with the places of their keys."""
        for key, entry in schema.get("properties", {}).items():
            for name in self._blocks(entry):
                known = name in self.places
                path = f"{place}.{key}" if place else key
                self.places.setdefault(name, [])
                if path not in self.places[name]:
                    self.places[name].append(path)
                if not known:
                    self._visit(self.definitions[name], path)

    def _blocks(self, entry: Any) -> list[str]:
        """Names of the definitions of blocks that an entry refers to, not through other blocks."""
        if isinstance(entry, list):
            return [name for one in entry for name in self._blocks(one)]
        if not isinstance(entry, dict):
            return []
        found = [
            name for key, one in entry.items() if key not in ("properties", "default") for name in self._blocks(one)
        ]
        name = str(entry.get("$ref", "")).removeprefix("#/$defs/")
        is_block = name and {"properties", "description"} <= set(self.definitions[name])
        if is_block and not name.startswith(_LAW_PARAMETERS):
            found.insert(0, name)
        return list(dict.fromkeys(found))

    def _headings(self) -> dict[str, str]:
        """Headings of the blocks, each once on the page: where titles are alike, with the key that leads there."""
        titles = {name: str(self.definitions[name]["title"]) for name in self.places}
        found: dict[str, str] = {}
        for name, title in titles.items():
            alike = list(titles.values()).count(title) > 1
            path = [key for key in self.places[name][0].split(".") if key != title.lower()]
            heading = f"{title} of {path[-1]}" if alike and path else title
            number = sum(other == heading or other.startswith(f"{heading} (") for other in found.values()) + 1
            found[name] = heading if number == 1 else f"{heading} ({number})"
        return found

    def _table(self, block: Json) -> list[str]:
        required = block.get("required", ())
        rows = [
            f"| `{key}` | {_cell(self._type(entry))} | {_cell(_default(entry, key in required))} "
            f"| {_cell(entry.get('description', ''))} |"
            for key, entry in block["properties"].items()
        ]
        return [*_HEADER, *rows, ""]

    def _type(self, entry: Any) -> str:
        """What may stand at a key, in words."""
        if entry is False or entry is True or entry == {}:
            return "anything"
        if "$ref" in entry:
            return self._reference(str(entry["$ref"]).removeprefix("#/$defs/"))
        if "const" in entry:
            return f"`{_written(entry['const'])}`"
        if "enum" in entry:
            return ", ".join(f"`{_written(one)}`" for one in entry["enum"])
        if "anyOf" in entry:
            return " or ".join(dict.fromkeys(self._type(one) for one in entry["anyOf"]))
        return self._plain(entry)

    def _reference(self, name: str) -> str:
        if name in self.headings:
            return f"[{self.headings[name]}](#{_anchor(self.headings[name])})"
        found = self.definitions[name]
        example = f" (`{found['examples'][0]}`)" if "examples" in found else ""
        return f"{found.get('title', name)}{example}"

    def _plain(self, entry: Json) -> str:
        kind = entry.get("type")
        if kind == "array":
            if "prefixItems" in entry:
                return f"[{', '.join(self._type(one) for one in entry['prefixItems'])}]"
            least = f", at least {entry['minItems']}" if entry.get("minItems", 0) > 1 else ""
            items = self._type(entry.get("items", {}))
            return f"list of: {f'({items})' if ' or ' in items else items}{least}"
        if kind == "object":
            values = [*entry.get("patternProperties", {}).values()]
            more = entry.get("additionalProperties")
            values += [more] if isinstance(more, dict) else []
            return f"mapping of names to: {self._type(values[0])}" if values else "mapping"
        if kind in ("integer", "number"):
            return _number(entry)
        if isinstance(kind, list):
            return entry.get("title") or " or ".join(kind)
        return {"string": entry.get("title") or "text", "boolean": "`true`, `false`", "null": "`null`"}.get(
            str(kind), ""
        )


def _number(entry: Json) -> str:
    what = "whole number" if entry["type"] == "integer" else "number"
    signs = {"minimum": "≥", "exclusiveMinimum": ">", "maximum": "≤", "exclusiveMaximum": "<"}
    bounds = [f"{sign} {_figure(entry[key])}" for key, sign in signs.items() if key in entry]
    return f"{what} {', '.join(bounds)}".strip()


def _figure(value: float) -> str:
    return str(int(value)) if value == int(value) else f"{value:g}"


def _default(entry: Json, required: bool) -> str:
    if required:
        return "*required*"
    if "default" not in entry or entry["default"] in ([], ""):
        return "none"
    if entry["default"] == {}:
        return "its own defaults" if "$ref" in entry else "none"
    return f"`{_written(entry['default'])}`"


def _written(value: Any) -> str:
    """A value as YAML has it in one line."""
    if isinstance(value, str):
        return value
    if isinstance(value, list):
        return f"[{', '.join(map(_written, value))}]"
    if isinstance(value, dict):
        return f"{{{', '.join(f'{key}: {_written(of)}' for key, of in value.items())}}}"
    return f"{value:g}" if isinstance(value, float) else json.dumps(value)


def _cell(text: str) -> str:
    return text.replace("|", "\\|").replace("\n", " ")


def _anchor(heading: str) -> str:
    """The anchor of a heading, as code hosts and site builders make it."""
    return re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")
