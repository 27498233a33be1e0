"""The base of all models of the project file: nothing unknown, nothing converted silently, nothing changed later."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict
from pydantic_core import PydanticCustomError


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


def refuse(message: str, *at: str | int) -> PydanticCustomError:
    """Return the problem of a value as an error to be raised in a validator.

    Args:
        message: what was seen and what is allowed.
        at: path from the validated value down to the culprit, e.g. the index in a list.
    """
    return PydanticCustomError("project", "{message}", {"message": message, "at": at})
