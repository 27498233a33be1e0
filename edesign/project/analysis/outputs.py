"""What is kept beside the envelopes, and where."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from edesign.project.notation.selections import ALL_NUMBERS, SELECTED_NUMBERS, Numbers, NumberSelection, parse_numbers
from edesign.project.notation.written import Written, words_or
from edesign.project.reading.base import Model, refuse

HistoryKind = Literal["floors", "storeys", "energy", "dampers", "supports", "motion"]
Edge = Literal["top", "bottom"]


def _layers(value: object) -> object:
    if value in ("top", "bottom"):
        return value
    if isinstance(value, str) and value.isalpha() and value != "all":
        raise refuse(
            f"`{value}` is no selection of layers; write `top`, `bottom`, `all`, `3`, `1-4` or `[1, 24]` [E-VALUE-01]"
        )
    return parse_numbers(value)


class SectionOutput(Model):
    """Forces and deformations of a member's sections; points count from 1 at the start of the member.

    Attributes:
        member: name of a column or beam with fibres, such as `C_A_1`.
        points: integration points, counted from 1 at the start of the member.
    """

    member: str
    points: Numbers = ALL_NUMBERS


class FibreOutput(Model):
    """Stress and strain of layers of fibres; layers count from 1 at the bottom of the section.

    Attributes:
        member: name of a column or beam with fibres, such as `C_A_1`.
        points: integration points, counted from 1 at the start of the member.
        layers: layers of fibres, counted from 1 at the bottom of the section.
    """

    member: str
    points: Numbers = ALL_NUMBERS
    layers: Annotated[NumberSelection | Edge, Written(_layers, words_or(SELECTED_NUMBERS, "top", "bottom"))] = (
        ALL_NUMBERS
    )


class Outputs(Model):
    """The archive and the histories in it; envelopes, energies' ends and statistics are always kept.

    Attributes:
        archive: file of the archive, relative to the project file; without the key the name of the project file with
            .h5.
        histories: what is kept over time.
        every: one step in so many is kept.
        members: members whose end forces are kept over time.
        sections: sections whose forces and deformations are kept over time.
        fibres: fibres whose stresses and strains are kept over time.
    """

    archive: Annotated[str, Field(min_length=1)] | None = None
    histories: tuple[HistoryKind, ...] = ("floors", "storeys", "energy")
    every: Annotated[int, Field(ge=1)] = 1
    members: tuple[str, ...] = ()
    sections: tuple[SectionOutput, ...] = ()
    fibres: tuple[FibreOutput, ...] = ()
