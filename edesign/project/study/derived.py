"""Variants that a study makes of others: with other values of the project, and at bounds of the dampers' properties."""

from __future__ import annotations

from dataclasses import dataclass
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
    """One value of the project, and what it is in turn: each makes a variant of every variant named.

    Attributes:
        name: name of the variation, for the names of its variants.
        variants: variants that are changed.
        place: place in the project file as messages write it, such as `materials.S275.fy`.
        values: what stands at the place in turn.
        measures: response measures that tables and figures show; without the key the usual ones.
    """

    name: ShortName
    variants: Names
    place: Annotated[str, Field(min_length=1)]
    values: Annotated[tuple[Any, ...], Field(min_length=1)]
    measures: Annotated[tuple[str, ...], Written(_measures, one_or_list_of(given({"enum": sorted(SHORT_NAMES)})))] = ()


@dataclass(frozen=True)
class Derived:
    """Where a variant that the file does not name comes from.

    Attributes:
        of: the variant of the file.
        keys: of what made it in the file.
        vary: name of the `vary` that made it, "" of a bound.
        value: of the project, as written; None of a bound.
        bound: of the dampers' properties, "" of another value.
    """

    of: str
    keys: tuple[str | int, ...]
    vary: str = ""
    value: Any = None
    bound: Side | Literal[""] = ""


def derived_name(of: str, suffix: str) -> str:
    """Return the name of a variant made of another one, such as damped_c_2 or damped_upper.

    Args:
        suffix: number of the value, or the bound.
    """
    return f"{of}_{suffix}"
