"""Values of several forms, and how it is known which form one has."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Iterable, Mapping
from functools import reduce
from operator import or_
from typing import Annotated, Any, get_args, get_origin

from pydantic import BaseModel, Discriminator, GetCoreSchemaHandler, Tag

TAG = "?"
"""First character of the tags of alternatives, so that they are distinguished from keys in the path of a problem."""
MAPPING, LIST, PLAIN = f"{TAG}mapping", f"{TAG}list", f"{TAG}plain"


class Alternatives(ABC):
    """Metadata of a type that says of what forms its values, or its items, are in the file."""

    @abstractmethod
    def tagged(self, annotation: Any) -> Any:
        """Return the annotation of what stands in the file, whose alternatives have their tags."""


class OneOf(Alternatives):
    """Which alternative of a union a value is: `Annotated[A | B, OneOf("kind")]`.

    Mappings, lists and other values are distinguished by themselves. Of several models a mapping is the one of the
    first of `keys` that it has, else the one whose literal is the value of `key`, else `otherwise`.
    """

    def __init__(self, key: str = "", otherwise: Any = None, **keys: Any) -> None:
        self._key, self._otherwise, self._keys = key, otherwise, keys

    def __get_pydantic_core_schema__(self, union: Any, handler: GetCoreSchemaHandler) -> Any:
        tags = [tag for kind in get_args(union) for tag in self._tags(kind)]
        return handler(Annotated[self.tagged(union), Discriminator(lambda value: self._choose(value, tags))])

    def tagged(self, annotation: Any) -> Any:
        """Return the union of the alternatives with their tags."""
        return reduce(or_, (Annotated[kind, Tag(tag)] for kind in get_args(annotation) for tag in self._tags(kind)))

    def _tags(self, kind: Any) -> list[str]:
        bare = get_args(kind)[0] if get_origin(kind) is Annotated else kind
        if not (isinstance(bare, type) and issubclass(bare, BaseModel)):
            return [{dict: MAPPING, tuple: LIST}.get(get_origin(bare) or bare, PLAIN)]
        tags = [f"{TAG}{key}" for key, model in self._keys.items() if model is bare]
        if bare is self._otherwise or not (tags or self._key):
            return [*tags, MAPPING]
        return tags or [f"{TAG}{self._key}={value}" for value in get_args(bare.model_fields[self._key].annotation)]

    def _choose(self, value: Any, tags: Collection[str]) -> str:
        """The tag of a value; none of `tags` where its value of the key is unknown."""
        is_mapping = isinstance(value, (Mapping, BaseModel))
        given = dict(value) if is_mapping else {}
        if first := next((key for key in self._keys if key in given), ""):
            return f"{TAG}{first}"
        if self._key in given:
            return f"{TAG}{self._key}={given[self._key]}"
        shapes = (LIST, PLAIN, MAPPING) if isinstance(value, (list, tuple)) else (PLAIN, LIST, MAPPING)
        shapes = (MAPPING, PLAIN, LIST) if is_mapping else shapes
        return next((shape for shape in shapes if shape in tags), f"{TAG}{self._key}=")


def with_tags(annotation: Any, metadata: Iterable[Any]) -> Any:
    """Return an annotation whose alternatives have their tags, if its metadata distinguish them."""
    return next((one.tagged(annotation) for one in metadata if isinstance(one, Alternatives)), annotation)
