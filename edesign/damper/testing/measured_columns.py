"""What a campaign file says of how the files of its tests are read."""

from __future__ import annotations

from typing import Any, Literal

from edesign.damper.testing.campaign_blocks import Text
from edesign.damper.testing.measured_files import DisplacementZero, TestReading
from edesign.project.notation.table_format import TableFormat
from edesign.project.notation.units import PositiveTime
from edesign.project.reading.base import Model
from edesign.project.records.record_tables import Column
from edesign.tables.columns import Chosen


class TestColumns(Model):
    """Columns of a test file, by header or by number from 1; with them, no other column is read.

    Attributes:
        time: column of time; without the key `time_step` is needed.
        displacement: column of displacement.
        force: column of force.
        temperature: column of temperature.
    """

    __test__ = False  # no test of pytest

    time: Column | None = None
    displacement: Column
    force: Column | None = None
    temperature: Column | None = None


class TestUnits(Model):
    """Units of the columns of a test file, also with a number: `kN/10`, `5 mm`.

    Attributes:
        time: unit of time.
        displacement: unit of displacement.
        force: unit of force.
        temperature: unit of temperature.
    """

    __test__ = False  # no test of pytest

    time: Text | None = None
    displacement: Text | None = None
    force: Text | None = None
    temperature: Text | None = None


class ReadingKeys(Model):
    """Keys of a campaign file on how all tests, or one, are read.

    Attributes:
        table: how the table stands in its file, where the file does not show it.
        columns: columns of the table; without the key found by their headers.
        units: units of the columns; without the key those of the headers.
        reversed: quantities that have the other sign in the file.
        time_step: time step of a table without a column of time.
        displacement_zero: what counts as no displacement: the transducer's zero, the first sample, or the rest before.
    """

    table: TableFormat | None = None
    columns: TestColumns | None = None
    units: TestUnits | None = None
    reversed: tuple[Literal["displacement", "force"], ...] | None = None
    time_step: PositiveTime | None = None
    displacement_zero: DisplacementZero | None = None


def reading_of(entry: ReadingKeys, file: ReadingKeys) -> TestReading:
    """Return what is said of how a test is read: by its entry, or by the file for all of them."""

    def of(key: str) -> Any:
        own = getattr(entry, key)
        return getattr(file, key) if own is None else own

    chosen = Chosen(
        {} if of("columns") is None else of("columns").model_dump(exclude_none=True),
        {} if of("units") is None else of("units").model_dump(exclude_none=True),
        of("reversed") or (),
    )
    return TestReading(of("table"), chosen, of("time_step"), of("displacement_zero") or "as_recorded")
