"""JSON Schemas (draft 2020-12) of YAML files, out of the pydantic models that read them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from pydantic import BaseModel
from pydantic.json_schema import GenerateJsonSchema

from edesign.file_kinds.kinds import FileKind
from edesign.project.notation.quantities import Kind
from edesign.project.notation.units import parse_quantity
from edesign.project.notation.written import OF_ONE, SHARED, Json
from edesign.schema.descriptions import of_keys, of_model
from edesign.schema.kinds import KINDS, model_of
from edesign.schema.laws import add_laws

DIALECT = "https://json-schema.org/draft/2020-12/schema"
COMBINED = "edesign.schema.json"
"""The schema that finds out by itself of which kind a file is."""
_PROPER = {
    "Asce": "ASCE 7",
    "Asce7": "ASCE 7",
    "Ats": "ATS",
    "Caughey": "Caughey",
    "EC8": "EC 8",
    "Eurocode8": "Eurocode 8",
    "Fema": "FEMA",
    "Ntc": "NTC",
    "P695": "P-695",
    "Pi": "PI",
    "Rayleigh": "Rayleigh",
    "Rts": "RTS",
}
_YEAR = 365.25 * 86400.0


def file_name(kind: FileKind) -> str:
    """Return the file name of the schema of a kind."""
    return f"{kind.schema}.schema.json"


def schema_of(kind: FileKind) -> Json:
    """Return the JSON Schema of a kind of YAML file.

    Args:
        kind: one of `KINDS`.

    Returns:
        The schema as plain data: every key with its description, type, unit and default.
    """
    schema = _of_model(model_of(kind))
    add_laws(schema, _of_model)
    if kind.needed:
        schema["required"] = sorted({*schema.get("required", ()), *kind.needed})
    _share_quantities(schema)
    title = f"edesign {kind.titled}"
    return {"$schema": DIALECT, "title": title, **{key: of for key, of in schema.items() if key != "title"}}


def _of_model(model: type[BaseModel]) -> Json:
    return model.model_json_schema(schema_generator=_Generator)


def combined_schema() -> Json:
    """Return the schema that chooses the kind of a file by the keys of its outermost mapping.

    It refers to the schemas of the kinds by their file names, so that it stands in one folder with them.
    """
    otherwise: Any = {
        "type": "object",
        "anyOf": [{"required": list(kind.keys)} for kind in KINDS.values()],
        "description": "The kind of a file is known by its first keys: `edesign: 1` begins a project file.",
    }
    for kind in reversed(KINDS.values()):
        known: Json = {"type": "object", "required": list(kind.keys)}
        if kind.without:
            known["not"] = {"anyOf": [{"required": [key]} for key in kind.without]}
        if kind.entries:
            name, key = kind.entries
            known["properties"] = {name: {"type": "array", "contains": {"type": "object", "required": [key]}}}
        otherwise = {"if": known, "then": {"$ref": file_name(kind)}, "else": otherwise}
    return {"$schema": DIALECT, "title": "YAML file of edesign", **otherwise}


class _Generator(GenerateJsonSchema):
    """Schemas of what stands in files: no null, alternatives with titles, defaults as people write them."""

    def model_field_schema(self, schema: Any) -> Json:
        """A key without a value is refused, so that null is no alternative; in lists it may be one."""
        stripped: Any = {**schema, "schema": _without_null(schema["schema"])}
        return super().model_field_schema(stripped)

    def tagged_union_schema(self, schema: Any) -> Json:
        """Alternatives that keys distinguish; no discriminator, which JSON Schema does not have."""
        chosen = [self.generate_inner(choice) for choice in schema["choices"].values()]
        different = [one for i, one in enumerate(chosen) if one not in chosen[:i]]
        return different[0] if len(different) == 1 else {"anyOf": different}

    def default_schema(self, schema: Any) -> Json:
        """The default as it would be written; a block with the defaults of its own keys is `{}`."""
        found = self.generate_inner(schema["schema"])
        default = self.get_default_value(schema)
        written = _as_written(default, found)
        return found if written is None else {**found, "default": written}

    def field_title_should_be_set(self, schema: Any) -> bool:
        """Keys speak for themselves."""
        return False

    def model_schema(self, schema: Any) -> Json:
        """A block with its description, and those of its keys."""
        found = super().model_schema(schema)
        model: type[BaseModel] = schema["cls"]
        found["title"] = _words((model.__pydantic_generic_metadata__["origin"] or model).__name__)
        found["description"] = of_model(model)
        said = of_keys(model)
        for name, info in model.model_fields.items():
            entry = found.get("properties", {}).get(info.alias or name)
            if entry is not None and name in said:
                entry["description"] = said[name]
        return found


def _without_null(schema: Any) -> Any:
    if schema["type"] == "nullable":
        return _without_null(schema["schema"])
    if schema["type"] == "default" or schema["type"].startswith("function-"):
        return {**schema, "schema": _without_null(schema["schema"])} if "schema" in schema else schema
    return schema


def _as_written(value: Any, schema: Json) -> Any:
    """Return a value of a model as a YAML file would have it.

    Args:
        value: SI; of a default.
        schema: of the value, for its unit.

    Returns:
        Text, number, list or mapping; None where nothing is worth showing.
    """
    if value is None or isinstance(value, (bool, str)):
        return value
    if isinstance(value, (int, float)):
        if OF_ONE in schema:
            return schema[OF_ONE]
        units = {part["x-unit"]: part for part in [schema, *schema.get("anyOf", ())] if "x-unit" in part}
        ratio = any("x-ratio" in part for part in (schema, *schema.get("anyOf", ())))
        if units and not ratio:
            return _with_unit(float(value), next(iter(units.values())))
        return value if isinstance(value, int) else float(f"{value:.6g}")
    if isinstance(value, BaseModel):
        return {key: _as_written(getattr(value, key), {}) for key in sorted(value.model_fields_set)}
    if isinstance(value, (list, tuple)):
        if any(isinstance(one, BaseModel) for one in value):
            return "all" if not any(_as_written(one, {}) for one in value) else None
        inner: Json = next((one for one in (schema, *schema.get("anyOf", ())) if one.get("type") == "array"), {})
        parts = inner.get("prefixItems") or [inner.get("items") or {}] * len(value)
        return [_as_written(one, part) for one, part in zip(value, parts, strict=False)]
    if isinstance(value, dict):
        return {key: _as_written(of, {}) for key, of in value.items()}
    if hasattr(value, "items") and not value.items:  # a selection of all
        return "all"
    return str(value) if "object at" not in str(value) else None


def _with_unit(value: float, part: Json) -> str:
    """A number in the unit of the example of its quantity."""
    unit = part["examples"][0].split(" ", 1)[1]
    if part["x-unit"] == "s" and value >= _YEAR:
        return f"{value / _YEAR:g} years"
    one = parse_quantity(f"1 {unit}", Kind(part["title"], part["x-unit"], part["examples"][0]))
    return f"{value / one:.10g} {unit}"


def _words(name: str) -> str:
    """The name of a class in words: EqualBays -> Equal bays, HHTIntegration -> HHT integration."""
    words = re.findall(r"[A-Z]+[0-9]*(?![a-z])|[A-Z][a-z]+[0-9]*", name)
    known = [_PROPER.get(word) or (word if word.isupper() else word.lower()) for word in words]
    return " ".join([known[0][0].upper() + known[0][1:], *known[1:]])


def _share_quantities(schema: Json) -> None:
    """Put the schemas of quantities and other texts, which many keys have, into the definitions."""
    shared: dict[str, Json] = {}
    for parent, key in list(_places(schema)):
        found = parent[key]
        if not isinstance(found, dict) or SHARED not in found:
            continue
        own = {name: found[name] for name in ("description", "default") if name in found}
        whole = {"title": found[SHARED], **found}
        whole = {name: of for name, of in whole.items() if name not in own and not name.startswith("x-")}
        name = re.sub(r"\W+", "_", whole["title"].translate(_SIGNS)).strip("_")
        while shared.get(name, whole) != whole:
            name += "_"
        shared[name] = whole
        parent[key] = {"$ref": f"#/$defs/{name}", **own}
    schema.setdefault("$defs", {}).update(dict(sorted(shared.items())))
    for parent, key in list(_places(schema)):
        if isinstance(key, str) and key.startswith("x-"):
            del parent[key]
        elif key == "patternProperties" and "additionalProperties" not in parent:
            parent["additionalProperties"] = False


_SIGNS = {ord(">"): "above", ord("≥"): "from", ord("<"): "below", ord("≤"): "to"}


def _places(node: Any) -> Iterator[tuple[Any, Any]]:
    """Every place below a node, the innermost first."""
    for key, child in list(node.items()) if isinstance(node, dict) else enumerate(node):
        if isinstance(child, (dict, list)):
            yield from _places(child)
        yield node, key
