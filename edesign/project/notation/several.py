"""Names in YAML files: one of them, or a list."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import Field

from edesign.project.notation.written import Written, one_or_list


def several(value: Any) -> Any:
    """Return a value as a list of one, unless it is a list."""
    return value if isinstance(value, (list, tuple)) else (value,)


Names = Annotated[tuple[str, ...], Field(min_length=1), Written(several, one_or_list)]
ShortName = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_+-]*$", max_length=24)]
"""Of which names of analyses are made, with points between them."""
