"""Tables of spectra: in the project file, or in a file that it names."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from edesign.project.notation.units import Duration, PositiveAcceleration, PositiveTime
from edesign.project.reading.base import Model
from edesign.project.reading.one_of import OneOf


class _Table(Model):
    """What a table may say beside its ordinates.

    Attributes:
        corner_period: end T_C of the branch of constant acceleration; without the key it is not known.
    """

    corner_period: PositiveTime | None = None


class SpectrumValues(_Table):
    """A table of periods and pseudo-accelerations, one for each.

    Attributes:
        periods: periods, rising from 0 s.
        accelerations: pseudo-acceleration at each period; the first is the peak ground acceleration.
    """

    periods: Annotated[tuple[Duration, ...], Field(min_length=2)]
    accelerations: Annotated[tuple[PositiveAcceleration, ...], Field(min_length=2)]


class SpectrumFile(_Table):
    """A table of periods and pseudo-accelerations in a CSV file.

    Attributes:
        file: CSV file, relative to the project file; its first column is the period in s.
        column: header of the ordinates; without the key the second column.
    """

    file: Annotated[str, Field(min_length=1)]
    column: Annotated[str, Field(min_length=1)] | None = None


SpectrumTable = Annotated[
    SpectrumValues | SpectrumFile,
    OneOf(otherwise=SpectrumValues, periods=SpectrumValues, file=SpectrumFile, column=SpectrumFile),
]
