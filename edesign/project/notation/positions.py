"""Places along a member: `2.4 m` from its start, or a share of its length, `1/3`, `0.25` or `30 %`.

Lengths of rigid ends are written alike.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import Field
from pydantic_core import PydanticCustomError

from edesign.project.notation.quantities import LENGTH
from edesign.project.notation.several import several
from edesign.project.notation.units import parse_quantity, parse_ratio
from edesign.project.notation.written import Written, either, one_or_list, quantity, ratio, text
from edesign.project.reading.base import refuse

_FRACTION = re.compile(r"\s*([0-9]{1,6})\s*/\s*([0-9]{1,6})\s*")


@dataclass(frozen=True)
class Position:
    """A place along a member, from its start.

    Attributes:
        value: m, or a share of the member's length.
        is_share: which of both it is.
    """

    value: float
    is_share: bool

    def share(self, length: float) -> float:
        """Return the position as a share of the length, which is in m."""
        return self.value if self.is_share else self.value / length

    def along(self, length: float) -> float:
        """Return the position in m along a length in m."""
        return self.value * length if self.is_share else self.value

    def __str__(self) -> str:
        return f"{100.0 * self.value:.3g} %" if self.is_share else f"{self.value:g} m"


def parse_position(value: Any) -> Position:
    """Read a place along a member.

    Raises:
        PydanticCustomError: neither a length that is not negative nor a share from 0 to 1.
    """
    if isinstance(value, Position):
        return value
    if isinstance(value, str) and (parts := _FRACTION.fullmatch(value)):
        above, below = int(parts[1]), int(parts[2])
        if above > below or below == 0:
            raise refuse(f"`{value}` is no share of a length: it lies between 0 and 1, for example `1/3` [E-VALUE-02]")
        return Position(above / below, True)
    try:
        return Position(parse_ratio(value, 0.0, 1.0), True)
    except PydanticCustomError:
        if isinstance(value, (int, float)):  # a bare number is a share
            raise
    try:
        return Position(parse_quantity(value, LENGTH, "not negative"), False)
    except PydanticCustomError as error:
        raise refuse(f"this is no share of a length, such as `1/3`, `0.25` or `30 %`, and {error}") from None


_SHARE = text("share of the length", r"[0-9]{1,6}\s*/\s*[0-9]{1,6}", "1/3")
Place = Annotated[Position, Written(parse_position, either(ratio(0.0, 1.0), _SHARE, quantity(LENGTH, "not negative")))]
Places = Annotated[tuple[Place, ...], Field(min_length=1), Written(several, one_or_list)]
"""One place, or a list of them."""
