"""The base of all models of the project file: nothing unknown, nothing converted silently, nothing changed later."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict
from pydantic_core import PydanticCustomError

TAG = "?"
"""First character of the tags of alternatives, so that they are told apart from keys in the path of a problem."""


class Model(BaseModel):
    """A mapping of the project file; after reading, all its dimensional values are floats in SI."""

    model_config = ConfigDict(
        extra="forbid", frozen=True, strict=True, allow_inf_nan=False, populate_by_name=True, defer_build=True
    )


def _whole_number(value: Any) -> Any:
    if isinstance(value, bool):  # Python takes true for 1
        raise PydanticCustomError("literal_error", "", {"expected": "1"})
    return value


FormatVersion = Annotated[Literal[1], BeforeValidator(_whole_number)]
"""Version of a file format."""


def by_key(key: str) -> Callable[[Any], str]:
    """Return the discriminator that chooses the model by the value of `key`; the tags are `?key=value`."""

    def choose(value: Any) -> str:
        chosen = value.get(key, "") if isinstance(value, Mapping) else getattr(value, key, "")
        return f"{TAG}{key}={chosen}"

    return choose


def keys_in(value: Any) -> Collection[str]:
    """Return the keys of a mapping or the fields of a model, for discriminators; none of anything else."""
    if isinstance(value, Mapping):
        return value.keys()
    return type(value).model_fields if isinstance(value, BaseModel) else ()


def by_shape(value: Any) -> str:
    """Return the tag of a mapping (`?mapping`) or of anything else (`?plain`), for discriminators."""
    return TAG + ("mapping" if isinstance(value, (Mapping, BaseModel)) else "plain")


def plain_or_list(value: Any) -> str:
    """Return the tag of a list (`?list`) or of anything else (`?plain`), for discriminators."""
    return TAG + ("list" if isinstance(value, (list, tuple)) else "plain")


def refuse(message: str, *at: str | int) -> PydanticCustomError:
    """Return the problem of a value as an error to be raised in a validator.

    Args:
        message: what was seen and what is allowed.
        at: path from the validated value down to the culprit, e.g. the index in a list.
    """
    return PydanticCustomError("project", "{message}", {"message": message, "at": at})
