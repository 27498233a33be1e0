"""Who a report is for, who made and checked it, and which revision it is: what stands on its cover."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import date
from typing import Annotated

from pydantic import AfterValidator, Field

from edesign.project.reading.base import Model, refuse

LONGEST = 200
"""Characters of a line of the cover."""


def _one_line(value: str) -> str:
    if not value.strip():
        raise refuse("the text is empty [E-VALUE-01]")
    if len(value.splitlines()) > 1:
        raise refuse("the text has several lines; this key takes one, `notes` takes more [E-VALUE-01]")
    return value


def _calendar_date(value: str) -> str:
    try:
        written = date.fromisoformat(value).isoformat() == value
    except ValueError:
        written = False
    if not written:
        raise refuse(f"`{value}` is no date; write year, month and day, such as 2026-03-31 [E-VALUE-01]")
    return value


Line = Annotated[str, Field(max_length=LONGEST, json_schema_extra={"pattern": r"\S"}), AfterValidator(_one_line)]
Date = Annotated[
    str, Field(json_schema_extra={"pattern": "^[0-9]{4}-[0-9]{2}-[0-9]{2}$"}), AfterValidator(_calendar_date)
]


class Document(Model):
    """The lines of a report's cover beside its title.

    Attributes:
        client: for whom the report is.
        project_number: number of the project in the office, in quotes.
        author: who made the report.
        checker: who checked it.
        revision: revision of the document, in quotes where it is a number.
        date: date of the document, year-month-day; the moment of the run stands in the archive.
        notes: what else stands on the cover, on several lines if need be.
    """

    client: Line | None = None
    project_number: Line | None = None
    author: Line | None = None
    checker: Line | None = None
    revision: Line | None = None
    date: Date | None = None
    notes: Annotated[str, Field(min_length=1, max_length=20 * LONGEST)] | None = None

    def over(self, other: Document) -> Document:
        """Return the document with the keys of another one where this one has none."""
        return other.model_copy(update=dict(self.said))

    @property
    def said(self) -> Mapping[str, str]:
        """Return the keys that are given with their texts, in the order of the cover."""
        return {key: value for key in type(self).model_fields if (value := getattr(self, key)) is not None}
