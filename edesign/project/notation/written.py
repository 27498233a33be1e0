"""What may stand in a file where a value is read: a validator, and the JSON schema of what it takes.

Schemas are asked for by `edesign schema` alone, so all that they cost is inside the functions that make them.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

from pydantic_core import core_schema

from edesign.project.notation.quantities import Kind
from edesign.project.notation.unit_patterns import unit_pattern
from edesign.project.reading.words import a

Json = dict[str, Any]
Inner = Callable[[], Json]
SchemaMaker = Callable[[Inner], Json]
"""Makes a JSON schema; takes what makes that of the value after reading."""

SHARED = "x-shared"
"""Key of a schema that many keys share, with its title; no part of what is written."""
OF_ONE = "x-one"
"""Key of the schema of a unit that is kept as its factor to SI: the unit whose factor is 1."""
NUMBER = r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
_NOT_ZERO = r"(?!\+?0*\.?0*(?:[eE][-+]?[0-9]+)?\s*(?:[A-Za-zµμ°%/]|$))"
_SIGNS = {"any": ("", ""), "positive": (" > 0", rf"(?!-){_NOT_ZERO}"), "not negative": (" ≥ 0", "(?!-)")}


@dataclass(frozen=True, eq=False)
class Written:
    """Metadata of a type whose values are written otherwise than they are kept.

    Attributes:
        read: reads what stands in the file; a validator before that of the type.
        schema: makes the JSON schema of what it reads.
    """

    read: Callable[[Any], Any]
    schema: SchemaMaker

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> core_schema.CoreSchema:
        return core_schema.no_info_before_validator_function(self.read, handler(source))

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> Json:
        return self.schema(lambda: handler(schema["schema"]))


def _titled(title: str) -> Json:
    """A title, which pydantic takes from values of mappings, and a name under which many keys share the schema."""
    return {"title": title, SHARED: title}


def quantity(kind: Kind, sign: Literal["any", "positive", "not negative"] = "any") -> SchemaMaker:
    """Return the maker of the schema of a quantity with its unit.

    Args:
        kind: the physical quantity.
        sign: the sign that the value may have.
    """

    def make(_inner: Inner) -> Json:
        bound, ahead = _SIGNS[sign]
        return {
            "type": "string",
            **_titled(f"{kind.name}{bound}"),
            "pattern": rf"^\s*{ahead}{NUMBER}\s*(?:{unit_pattern(kind)})\s*$",
            "patternErrorMessage": f"{a(kind.name)}{bound} with its unit is needed, for example `{kind.example}`",
            "examples": [kind.example],
            "x-unit": kind.unit,
        }

    return make


def ratio(low: float, high: float, low_allowed: bool = True, high_allowed: bool = True) -> SchemaMaker:
    """Return the maker of the schema of a number between two bounds, or of a percentage.

    Args:
        low: lower bound.
        high: upper bound.
        low_allowed: whether the lower bound itself is allowed.
        high_allowed: whether the upper bound itself is allowed.
    """

    def make(_inner: Inner) -> Json:
        number: Json = {"type": "number"}
        bounds = []
        if math.isfinite(low):
            number["minimum" if low_allowed else "exclusiveMinimum"] = low
            bounds.append(f"{'≥' if low_allowed else '>'} {low:g}")
        if math.isfinite(high):
            number["maximum" if high_allowed else "exclusiveMaximum"] = high
            bounds.append(f"{'≤' if high_allowed else '<'} {high:g}")
        title = f"ratio {', '.join(bounds)}".strip()
        ahead = "(?!-)" + ("" if low_allowed else _NOT_ZERO) if low >= 0.0 else ""
        percent = {
            "type": "string",
            "pattern": rf"^\s*{ahead}{NUMBER}\s*%?\s*$",
            "patternErrorMessage": f"a {title} is needed, a plain number or a percentage such as `2 %`",
        }
        return {**_titled(title), "anyOf": [number, percent], "x-ratio": True}

    return make


def text(title: str, pattern: str, *examples: str) -> SchemaMaker:
    """Return the maker of the schema of a text of a pattern.

    Args:
        pattern: regular expression of the text.
        *examples: texts that match.
    """
    return lambda _: {
        "type": "string",
        **_titled(title),
        "pattern": rf"^\s*(?:{pattern})\s*$",
        "patternErrorMessage": f"{title} is written like {', '.join(f'`{one}`' for one in examples)}",
        "examples": list(examples),
    }


def words_or(other: SchemaMaker, *words: str) -> SchemaMaker:
    """Return the maker of the schema of one of some words, or of something else."""
    return lambda inner: {"anyOf": [{"enum": list(words)}, other(inner)]}


def either(*makers: SchemaMaker) -> SchemaMaker:
    """Return the maker of the schema of one of several things."""
    return lambda inner: {"anyOf": [make(inner) for make in makers]}


def given(schema: Json) -> SchemaMaker:
    """Return the maker of a given schema."""
    return lambda _: dict(schema)


def as_kept(inner: Inner) -> Json:
    """Return the schema of the value after reading, which is only checked further."""
    return inner()


def one_or_list(inner: Inner) -> Json:
    """Return the schema of one item, or of a list of items."""
    whole = inner()
    return {"anyOf": [whole["items"], whole]}


def one_or_list_of(make: SchemaMaker) -> SchemaMaker:
    """Return the maker of the schema of one value of a kind, or of a list of one and more."""

    def both(inner: Inner) -> Json:
        one = make(inner)
        return {"anyOf": [one, {"type": "array", "items": one, "minItems": 1}]}

    return both


def items(*makers: SchemaMaker, fewest: int | None = None) -> SchemaMaker:
    """Return the maker of the schema of a list whose items have schemas of their own."""
    return lambda inner: {
        "type": "array",
        "prefixItems": [make(inner) for make in makers],
        "items": False,
        "minItems": len(makers) if fewest is None else fewest,
        "maxItems": len(makers),
    }
