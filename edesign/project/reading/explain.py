"""What pydantic found, in words for people and with the place in the file."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from types import UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel, Tag, ValidationError
from pydantic_core import ErrorDetails

from edesign.project.reading.one_of import LIST, MAPPING, PLAIN, TAG, with_tags
from edesign.project.reading.problems import Keys, Problems, as_seen, did_you_mean, listed, nearest

_VERSIONS = (("edesign",), ("edesign_building",), ("edesign_suite",), ("edesign_rts",))
"""Keys whose value is the version of a file format."""


def explain(error: ValidationError, model: type[BaseModel], problems: Problems) -> None:
    """Turn all errors of a validation into problems.

    A misspelt key is reported once: what follows from it, such as the key that is missing, is not.

    Args:
        error: as raised by `model.model_validate` on the plain data of the file.
    """
    details = error.errors(include_url=False)
    meant = {detail["loc"]: key for detail in details if (key := _meant(detail, model, problems))}
    missing = {(*loc[:-1], key) for loc, key in meant.items()}
    otherwise = {loc[:-1] for loc, key in meant.items() if key not in _allowed_keys(_model_at(model, loc[:-1]))}
    for detail in details:
        loc = detail["loc"]
        follows = (detail["type"] == "missing" and loc in missing) or loc[:-1] in otherwise
        if loc in meant or not follows:
            _explain_one(detail, model, problems, meant.get(loc, ""))


def _meant(detail: ErrorDetails, model: type[BaseModel], problems: Problems) -> str:
    """The key that an unknown one was probably meant to be, of the alternatives of its mapping too; "" of others."""
    if detail["type"] != "extra_forbidden":
        return ""
    loc = detail["loc"]
    allowed = _allowed_keys(_model_at(model, loc[:-1]))
    given = problems.node(_keys(loc[:-1], problems)).entries or {}
    others = [key for key in _keys_of_alternatives(model, loc[:-1]) if key not in allowed]
    if loc[-1] in others:  # it is spelt right, and belongs to another alternative
        return ""
    return nearest(str(loc[-1]), allowed) or nearest(str(loc[-1]), (key for key in others if key not in given))


def _explain_one(detail: ErrorDetails, model: type[BaseModel], problems: Problems, meant: str) -> None:
    kind, context, loc = detail["type"], detail.get("ctx", {}), detail["loc"]
    keys = _keys(loc, problems)
    if kind == "missing":
        key = str(keys[-1])
        example = _example(_model_at(model, loc[:-1]), key)
        problems.under(keys[:-1], key, f"this key is missing{example} [E-KEY-02]")
    elif kind == "extra_forbidden":
        allowed = _allowed_keys(_model_at(model, loc[:-1]))
        hint = f"; did you mean `{meant}`?" if meant else ""
        problems.at_key(keys, f"unknown key{hint} (allowed here: {listed(allowed, 40)}) [E-KEY-01]")
    elif kind == "union_tag_invalid":
        _wrong_choice(keys, detail["input"], context, problems)
    elif kind == "too_short" and len(detail["input"]) >= context["min_length"]:
        return  # pydantic counts good items only, and the bad ones have their own problems
    elif kind == "project":
        problems.at_value((*keys, *context["at"]), _as_written(context["message"], detail["input"], context["at"]))
    elif kind == "tuple_type" and loc[-1] == LIST:
        other = _other_shape(model, loc) or "a mapping"
        problems.at_value(keys, f"a list, or {other}, is needed here, not {as_seen(detail['input'])} [E-VALUE-01]")
    elif kind == "literal_error" and keys in _VERSIONS and str(detail["input"]) == "1":
        problems.at_value(keys, "the format is the number 1; write it without quotes [E-FILE-05]")
    elif kind == "literal_error" and keys in _VERSIONS:
        problems.at_value(
            keys, f"format {as_seen(detail['input'])} is unknown to this version of edesign, which reads 1 [E-FILE-05]"
        )
    elif loc and loc[-1] == "[key]":
        most = context.get("max_length", 64)
        problems.at_key(
            keys, f"a name is made of letters, digits and `_`, `-`, `+`, `.`, at most {most} of them [E-NAME-03]"
        )
    elif kind == "literal_error":
        allowed = re.findall(r"'([^']*)'", str(context["expected"])) or [str(context["expected"])]
        other = f", or {shape}" if loc[-1] == PLAIN and (shape := _other_shape(model, loc)) else ""
        hint = did_you_mean(str(detail["input"]), allowed)
        problems.at_value(
            keys, f"{as_seen(detail['input'])} is unknown{hint} (allowed: {listed(allowed)}{other}) [E-VALUE-03]"
        )
    elif kind == "tuple_type" and _of_mappings(model, loc):
        seen = as_seen(detail["input"])
        problems.at_value(
            keys, f"a list of mappings, each `- {{key: value}}` on its line, is needed here, not {seen} [E-VALUE-01]"
        )
    else:
        problems.at_value(keys, _message(kind, detail, context))


def _of_mappings(model: type[BaseModel], loc: tuple[int | str, ...]) -> bool:
    """Whether the items of a list are mappings."""
    annotation = _bare(_annotation_at(model, loc))
    return any(_is_model(_bare(one)) for item in get_args(annotation) for one in _alternatives(item))


def _as_written(message: str, value: Any, at: Keys) -> str:
    """A message with a value as the file has it, `true` or a list, in place of what Python prints."""
    for key in at:
        if not isinstance(value, (Mapping, list, tuple)):
            break
        value = value[key]  # type: ignore[index]
    return message.replace(f"`{value}`", as_seen(value)) if value is None or not isinstance(value, str) else message


def _other_shape(model: type[BaseModel], loc: tuple[int | str, ...]) -> str:
    """What may stand as a mapping where something plain does, "" if nothing may."""
    annotation = _annotation_at(model, (*loc[:-1], MAPPING))
    keys = _allowed_keys(next((kind for kind in _alternatives(annotation) if _is_model(kind)), None))
    if keys:
        return f"a mapping of {listed(keys)}"
    return "a mapping `name: value`" if get_origin(_bare(annotation)) is dict else ""


def _wrong_choice(keys: Keys, value: Any, context: Mapping[str, Any], problems: Problems) -> None:
    """The value of the key that chooses between alternatives is missing or unknown."""
    if not isinstance(value, Mapping):
        problems.at_value(keys, f"a mapping is needed here, not {as_seen(value)} [E-VALUE-01]")
        return
    key, _, seen = str(context["tag"]).lstrip(TAG).partition("=")
    tags = [tag.strip(" '").lstrip(TAG) for tag in str(context["expected_tags"]).split(",")]
    allowed = [tag.partition("=")[2] for tag in tags if tag.startswith(f"{key}=")]
    if key in value:
        hint = did_you_mean(seen, allowed)
        problems.at_value(
            (*keys, key), f"{as_seen(value[key])} is unknown{hint} (allowed: {listed(allowed)}) [E-VALUE-03]"
        )
    elif misspelt := nearest(key, value):
        problems.at_key(
            (*keys, misspelt), f"unknown key; did you mean `{key}`? (allowed for it: {listed(allowed)}) [E-KEY-01]"
        )
    else:
        problems.under(keys, key, f"this key is missing; allowed: {listed(allowed)} [E-KEY-02]")


def _message(kind: str, detail: ErrorDetails, context: Mapping[str, Any]) -> str:
    seen = as_seen(detail["input"])
    if kind == "tuple_type" and isinstance(detail["input"], str):
        return f"a list is needed here: `[{detail['input']}]`, not {seen} [E-VALUE-01]"
    if kind in _WORDS:
        return f"{_WORDS[kind](context)} is needed here, not {seen} [E-VALUE-01]"
    if kind in _LIMITS:
        return (
            f"{seen} is out of range: it must be {_LIMITS[kind]} {_number(next(iter(context.values())))} [E-VALUE-02]"
        )
    if kind == "too_short":
        what = "mapping" if isinstance(detail["input"], Mapping) else "list"
        return (
            f"the {what} is empty [E-VALUE-01]"
            if context.get("actual_length") == 0
            else f"{context['min_length']} items are needed [E-VALUE-01]"
        )
    if kind == "too_long":
        return f"too many items: {context['max_length']} are needed [E-VALUE-01]"
    if kind == "string_too_short":
        return "the text is empty [E-VALUE-01]"
    if kind == "string_too_long":
        return f"the text is longer than {context['max_length']} characters [E-VALUE-01]"
    if kind == "string_pattern_mismatch":
        signs = ", ".join(f"`{sign}`" for sign in "_-+." if sign in context["pattern"])  # only names have a pattern
        return f"{seen} is no name: a letter or digit begins it, letters, digits and {signs} may follow [E-NAME-03]"
    return f"{seen}: {detail['msg']}"


def _number(limit: Any) -> str:
    return f"{limit:.4g}" if isinstance(limit, float) else str(limit)


_WORDS: dict[str, Callable[[Mapping[str, Any]], str]] = {
    "int_type": lambda c: "a whole number",
    "int_from_float": lambda c: "a whole number",
    "float_type": lambda c: "a plain number",
    "finite_number": lambda c: "a finite number",
    "bool_type": lambda c: "`true` or `false`",
    "string_type": lambda c: "text (put quotes around text that looks like a number)",
    "tuple_type": lambda c: "a list such as `[a, b]`",
    "dict_type": lambda c: "a mapping (`key: value`)",
    "model_type": lambda c: "a mapping (`key: value`)",
    "model_attributes_type": lambda c: "a mapping (`key: value`)",
}
_LIMITS = {
    "greater_than": "greater than",
    "greater_than_equal": "at least",
    "less_than": "less than",
    "less_than_equal": "at most",
}


def _keys(loc: tuple[int | str, ...], problems: Problems) -> Keys:
    """The path in the file: without the tags of alternatives and the names of validators."""
    keys: list[str | int] = []
    node = problems.root
    for position, part in enumerate(loc):
        below = node.child(part) if not _is_tag(part) else None
        if below is not None:
            keys.append(part)
            node = below
        elif position == len(loc) - 1 and not _is_tag(part) and isinstance(part, str) and node.entries is not None:
            keys.append(part)  # a missing key
    return tuple(keys)


def _is_tag(part: str | int) -> bool:
    return isinstance(part, str) and (part.startswith(TAG) or part == "[key]")


def _model_at(model: type[BaseModel], loc: tuple[int | str, ...]) -> type[BaseModel] | None:
    """The model that was validated at a location of pydantic's errors."""
    return next((kind for kind in _alternatives(_annotation_at(model, loc)) if _is_model(kind)), None)


def _annotation_at(model: type[BaseModel], loc: tuple[int | str, ...]) -> Any:
    annotation: Any = model
    for part in loc:
        annotation = _step(annotation, part)
    return annotation


def _keys_of_alternatives(model: type[BaseModel], loc: tuple[int | str, ...]) -> list[str]:
    """Keys of all alternatives of the mapping at a location."""
    if not (loc and _is_tag(loc[-1])):
        return []
    kinds = map(_bare, _alternatives(_annotation_at(model, loc[:-1])))
    return [key for kind in kinds if _is_model(kind) for key in _allowed_keys(kind)]


def _step(annotation: Any, part: str | int) -> Any:
    for kind in _alternatives(annotation):
        if isinstance(part, str) and part.startswith(TAG):
            if part in [tag.tag for tag in getattr(kind, "__metadata__", ()) if isinstance(tag, Tag)]:
                return kind
        elif _is_model(bare := _bare(kind)) and isinstance(part, str) and (named := _named(bare, part)):
            field = bare.model_fields[named]
            return with_tags(field.annotation, field.metadata)
        elif get_origin(bare) is tuple and isinstance(part, int):
            return get_args(with_tags(bare, getattr(kind, "__metadata__", ())))[0]
        elif get_origin(bare) is dict:
            return get_args(bare)[1]
    return None


def _alternatives(annotation: Any) -> list[Any]:
    bare = with_tags(_bare(annotation), getattr(annotation, "__metadata__", ()))
    if get_origin(bare) is Union or get_origin(bare) is UnionType:
        return [inner for kind in get_args(bare) for inner in ([kind] if _has_tag(kind) else _alternatives(kind))]
    return [bare]


def _has_tag(kind: Any) -> bool:
    return any(isinstance(item, Tag) for item in getattr(kind, "__metadata__", ()))


def _bare(annotation: Any) -> Any:
    while get_origin(annotation) is Annotated:
        annotation = get_args(annotation)[0]
    return annotation


def _is_model(kind: Any) -> bool:
    return isinstance(kind, type) and issubclass(kind, BaseModel)


def _allowed_keys(model: type[BaseModel] | None) -> list[str]:
    return [info.alias or name for name, info in model.model_fields.items()] if model else []


def _named(model: type[BaseModel], key: str) -> str | None:
    """The field of a key, which the file may write otherwise: `from` is no name in Python."""
    return next((name for name, info in model.model_fields.items() if key in (name, info.alias)), None)


def _example(model: type[BaseModel] | None, key: str) -> str:
    """`; allowed: ...` where the missing key takes one of a few values."""
    named = _named(model, key) if model else None
    field = model.model_fields[named] if model and named else None
    annotation = _bare(field.annotation) if field else None
    return f"; allowed: {listed(get_args(annotation))}" if get_origin(annotation) is Literal else ""
