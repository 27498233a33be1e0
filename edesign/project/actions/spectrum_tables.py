"""Tables of spectra: in the project file, or in a file that it names."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import Discriminator, Field, Tag

from edesign.project.notation.units import Duration, PositiveAcceleration, PositiveTime
from edesign.project.reading.base import Model, keys_in


class _Table(Model):
    """What a table may say beside its ordinates: T_C, the end of the branch of constant acceleration, s."""

    corner_period: PositiveTime | None = None


class SpectrumValues(_Table):
    """Periods from 0 on (s) and pseudo-accelerations (m/s2), one for each."""

    periods: Annotated[tuple[Duration, ...], Field(min_length=2)]
    accelerations: Annotated[tuple[PositiveAcceleration, ...], Field(min_length=2)]


class SpectrumFile(_Table):
    """A CSV file; its first column is the period, `column` the header of the ordinates (None: the second column)."""

    file: Annotated[str, Field(min_length=1)]
    column: Annotated[str, Field(min_length=1)] | None = None


def _which(value: Any) -> str:
    keys = keys_in(value)
    return "?values" if "periods" in keys or "accelerations" in keys else "?file"


SpectrumTable = Annotated[
    Annotated[SpectrumValues, Tag("?values")] | Annotated[SpectrumFile, Tag("?file")], Discriminator(_which)
]
