"""Variants that a study makes of others: with other values of the project, and at bounds of the dampers' properties."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from typing import Annotated, Any, Literal

from pydantic import Field

from edesign.project.criteria.measures import SHORT_NAMES
from edesign.project.notation.several import Names, ShortName, several
from edesign.project.notation.written import Written, given, one_or_list_of
from edesign.project.reading.base import Model, refuse
from edesign.project.reading.problems import as_seen, unknown_name

SHARED = ("edesign", "title", "hazard", "records", "analyses", "outputs")
"""Parts of the project that all variants of a study have in common."""

Side = Literal["lower", "upper"]


def _measures(value: Any) -> Any:
    found = several(value)
    for i, name in enumerate(found if isinstance(found, (list, tuple)) else ()):
        if not isinstance(name, str):
            raise refuse(
                f"a name of a response measure is needed, such as `interstorey_drift`, not {as_seen(name)}"
                " [E-VALUE-01]",
                i,
            )
        if name not in SHORT_NAMES:
            raise refuse(unknown_name("response measure", name, SHORT_NAMES), i)
    return found


class Vary(Model):
    """Values of the project, and what they are in turn: each makes a variant of every variant named.

    Attributes:
        name: name of the variation, for the names of its variants.
        variants: variants that are changed.
        place: place in the project file as messages write it, such as `materials.S275.fy`; this key or `grid`.
        values: what stands at the place in turn.
        grid: several places, each with its values in turn; every combination of them makes a variant.
        measures: response measures that tables and figures show; without the key the usual ones.
    """

    name: ShortName
    variants: Names
    place: Annotated[str, Field(min_length=1)] | None = None
    values: Annotated[tuple[Any, ...], Field(min_length=1)] = ()
    grid: dict[str, Annotated[tuple[Any, ...], Field(min_length=1)]] = {}
    measures: Annotated[tuple[str, ...], Written(_measures, one_or_list_of(given({"enum": sorted(SHORT_NAMES)})))] = ()

    @property
    def places(self) -> dict[str, tuple[Any, ...]]:
        """The places with their values."""
        return dict(self.grid) if self.place is None else {self.place: self.values}

    @property
    def points(self) -> Iterator[tuple[str, tuple[str | int, ...], Mapping[str, Any]]]:
        """Every combination of values: its suffix such as `c_2` or `grid_2_1`, keys below `vary`, and values by place.

        The first place changes slowest.
        """
        for numbers in product(*(range(len(values)) for values in self.places.values())):
            suffix = "_".join([self.name, *(str(number + 1) for number in numbers)])
            keys: tuple[str | int, ...] = ("grid",) if self.place is None else ("values", *numbers)
            there = zip(self.places.items(), numbers, strict=True)
            yield suffix, keys, {place: values[number] for (place, values), number in there}


@dataclass(frozen=True)
class Derived:
    """Where a variant that the file does not name comes from.

    Attributes:
        of: the variant of the file.
        keys: of what made it in the file.
        vary: name of the `vary` that made it, "" of a bound.
        values: of the project, as written, in the order of their places; none of a bound.
        bound: of the dampers' properties, "" of another value.
    """

    of: str
    keys: tuple[str | int, ...]
    vary: str = ""
    values: tuple[Any, ...] = ()
    bound: Side | Literal[""] = ""

    @property
    def said(self) -> str:
        """The values in words."""
        return ", ".join(map(str, self.values))


def derived_name(of: str, suffix: str) -> str:
    """Return the name of a variant made of another one, such as damped_c_2 or damped_upper.

    Args:
        suffix: number of the value, or the bound.
    """
    return f"{of}_{suffix}"
