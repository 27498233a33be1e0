"""How a table of numbers stands in its file: what a campaign or project says where the file does not show it."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from edesign.project.reading.base import Model

Encoding = Literal["utf-8", "utf-16", "latin-1", "windows-1252", "gbk", "shift-jis"]
Delimiter = Literal["comma", "semicolon", "tab", "blanks"]
Decimal = Literal["point", "comma"]


class TableFormat(Model):
    """The form of a table of numbers in its file; keys that are left out are found from the file.

    Attributes:
        encoding: character encoding of the file.
        skip: number of lines above the headers, or above the numbers of a table without headers.
        headers: whether the columns have headers.
        units_row: whether a line of units follows the headers.
        delimiter: sign between the columns; `blanks` are any number of blanks and tabs.
        decimal: sign before the decimals of a number.
    """

    encoding: Encoding | None = None
    skip: Annotated[int, Field(ge=0)] | None = None
    headers: bool | None = None
    units_row: bool | None = None
    delimiter: Delimiter | None = None
    decimal: Decimal | None = None
