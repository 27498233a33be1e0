"""Damper laws and effects in schemas: their names, and the parameters that belong to each."""

from __future__ import annotations

from collections.abc import Callable

from pydantic import BaseModel

from edesign.damper.effect_forms import FORMER_FORMS, LAW_EFFECTS
from edesign.damper.law import Law, Parameter
from edesign.damper.laws import LAWS
from edesign.damper.parameters import PARAMETER_SETS, practical_unit
from edesign.damper.temperature_file import TemperatureLaw
from edesign.project.notation.quantities import AREA, ENERGY, FORCE, LENGTH, STIFFNESS, STRESS, TIME, VELOCITY, Kind
from edesign.project.notation.temperature import TEMPERATURE_TEXT
from edesign.project.notation.written import Json, quantity, ratio

_LAWS = ("Damper law", "Law description", "Law block", "Campaign law", "Virtual law")
_EFFECT = "Effect"
_KINDS = {kind.unit: kind for kind in (AREA, ENERGY, FORCE, LENGTH, STIFFNESS, STRESS, TIME, VELOCITY)}


def add_laws(schema: Json, schema_of_model: Callable[[type[BaseModel]], Json]) -> None:
    """Add the damper laws and effects with the parameters of each to a schema.

    Args:
        schema: of a file; is changed where laws stand in it.
        schema_of_model: makes the schema of a model.
    """
    blocks = [block for block in (schema, *schema.get("$defs", {}).values()) if "properties" in block]
    laws = [block for block in blocks if block.get("title") in _LAWS]
    effects = [block for block in blocks if block.get("title") == _EFFECT]
    added: dict[str, Json] = {}
    for block in laws:
        block["properties"]["type"] |= {"type": "string", "enum": list(LAWS)}
        block["allOf"] = [_law(law) for law in LAWS.values()]
        added |= {f"parameters_of_{law.name}": _parameters(law) for law in LAWS.values()}
        if "temperature_law" in block["properties"]:
            change = schema_of_model(TemperatureLaw)
            added |= change.pop("$defs", {})
            added["TemperatureLaw"] = change
            said = {key: of for key, of in block["properties"]["temperature_law"].items() if key == "description"}
            block["properties"]["temperature_law"] = {"$ref": "#/$defs/TemperatureLaw", **said}
    for block in effects:
        names = dict.fromkeys(name for name, _ in LAW_EFFECTS)
        block["properties"]["name"] |= {"enum": list(names)}
        block["properties"]["form"] |= {"enum": list(dict.fromkeys(form for _, form in (*LAW_EFFECTS, *FORMER_FORMS)))}
        block["allOf"] = [_forms(name) for name in names]
        for (name, form), kind in LAW_EFFECTS.items():
            known: Json = {"parameters": {"$ref": f"#/$defs/parameters_of_{name}_{form}"}}
            placed = {} if kind.is_factor else {"placement": {"enum": list(kind.placements)}}
            block["allOf"].append(
                {"if": _is({"name": name, "form": form}), "then": {"properties": {**known, **placed}}}
            )
            added[f"parameters_of_{name}_{form}"] = _parameters(kind)
        for (name, former), (form, placement) in FORMER_FORMS.items():
            same: Json = {
                "parameters": {"$ref": f"#/$defs/parameters_of_{name}_{form}"},
                "placement": {"const": placement},
            }
            block["allOf"].append({"if": _is({"name": name, "form": former}), "then": {"properties": same}})
    if added:
        schema.setdefault("$defs", {}).update(added)


def _is(values: dict[str, str]) -> Json:
    return {"properties": {key: {"const": value} for key, value in values.items()}, "required": list(values)}


def _law(law: Law) -> Json:
    sets = [name for name, one in PARAMETER_SETS.items() if one.law == law.name]
    own: Json = {"$ref": f"#/$defs/parameters_of_{law.name}"}
    allowed = {"anyOf": [{"enum": sets, "title": "published parameters"}, own]} if sets else own
    return {"if": _is({"type": law.name}), "then": {"properties": {"parameters": allowed}}}


def _forms(name: str) -> Json:
    forms = [form for effect, form in (*LAW_EFFECTS, *FORMER_FORMS) if effect == name]
    return {"if": _is({"name": name}), "then": {"properties": {"form": {"enum": forms}}}}


def _parameters(law: Law) -> Json:
    """The mapping of the parameters of a law or an effect."""
    own = {parameter.name for parameter in law.parameters}
    several = [parameter for parameter in law.branch if parameter.name not in own]
    found: Json = {
        "title": f"parameters of the {law.kind} {law.name}",
        "description": f"{law.title[0].upper()}{law.title[1:]}: {law.equation} ({law.source}).",
        "type": "object",
        "properties": {parameter.name: _described(parameter) for parameter in law.parameters}
        | {parameter.name: _described(parameter, _one_or_list(_value(parameter))) for parameter in several},
        "required": [parameter.name for parameter in law.parameters if parameter.default is None],
        "additionalProperties": False,
    }
    if law.branch:
        found["patternProperties"] = {
            f"^{parameter.name}[1-9][0-9]*$": _described(parameter) for parameter in law.branch
        }
    return found


def _one_or_list(value: Json) -> Json:
    return {"anyOf": [value, {"type": "array", "items": value, "minItems": 1}]}


def _described(parameter: Parameter, value: Json | None = None) -> Json:
    found = {**(_value(parameter) if value is None else value)}
    meaning = parameter.meaning[0].upper() + parameter.meaning[1:]
    found["description"] = f"{meaning}; {parameter.allowed} is allowed."
    if parameter.default is not None and not parameter.unit:
        found["default"] = parameter.default
    return found


def _value(parameter: Parameter) -> Json:
    if not parameter.unit:
        bounds = parameter.lower, parameter.upper, parameter.lower_allowed, parameter.upper_allowed
        number = ratio(*bounds)(dict)
        return number if parameter.fitted else {**number, "anyOf": [*number["anyOf"], {"type": "boolean"}]}
    if parameter.unit == "degC":
        return TEMPERATURE_TEXT(dict)
    unit = practical_unit(parameter)
    kind = _KINDS.get(parameter.unit) or Kind(parameter.meaning, parameter.unit, f"1 {unit}")
    above = parameter.lower >= 0.0
    sign = ("not negative" if parameter.lower_allowed else "positive") if above else "any"
    return quantity(kind, sign)(dict)  # type: ignore[arg-type]
