"""The recordings that a command line names: a suite file, or record files."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from edesign.cli.shared.hazard_options import quantity
from edesign.errors import InputError
from edesign.ground_motion.formats.read import detect, names_components, read_record_file
from edesign.ground_motion.formats.units import ACCELERATION_UNITS
from edesign.ground_motion.record import Record
from edesign.ground_motion.sources import Found, find_suite
from edesign.ground_motion.suite import TAKEN, load_suite
from edesign.project.notation.quantities import TIME
from edesign.project.reading.problems import unknown_name
from edesign.project.records.suite_names import is_suite_name, suite_file, suite_names

LONGEST_NAME = 64  # as in suites

Inputs = Annotated[
    list[Path],
    typer.Argument(
        help="A suite file (.yaml), a suite by its name, or record files.", metavar="SUITE_OR_FILES", show_default=False
    ),
]
Folder = Annotated[
    list[Path] | None,
    typer.Option("--folder", metavar="DIR", help="Your recordings of a suite, PEER file names; may be repeated."),
]
Unit = Annotated[str | None, typer.Option("--unit", help="Of tables of text (.csv, .txt): g, m/s^2, cm/s^2, mm/s^2.")]
TimeStep = Annotated[str | None, typer.Option("--time-step", help="Of tables without a column of times: `0.01s`.")]
Layout = Annotated[
    str | None,
    typer.Option("--layout", help="Of tables: columns (a line is one instant), or rows (several samples a line)."),
]
Component = Annotated[
    str | None, typer.Option("--component", help="Which one of files that hold several: number, orientation or name.")
]
Column = Annotated[
    str | None, typer.Option("--column", help="Of tables with several: that of the acceleration, header or number.")
]
TimeColumn = Annotated[
    str | None, typer.Option("--time-column", help="Beside --column: that of the times in s, header or number.")
]
NoSimulatedRecords = Annotated[
    bool, typer.Option("--no-simulated-records", help="Refuse simulated motions in place of missing recordings.")
]


@dataclass(frozen=True)
class Reading:
    """How record files are read, by options of the command line; the step in s."""

    unit: str | None = None
    time_step: float | None = None
    layout: str | None = None
    component: str | None = None
    column: int | str | None = None
    time_column: int | str | None = None

    @classmethod
    def of(
        cls,
        unit: str | None,
        time_step: str | None,
        layout: str | None,
        component: str | None,
        column: str | None = None,
        time_column: str | None = None,
    ) -> Reading:
        """Return the options as they are written on the command line.

        Raises:
            InputError: the time step is none.
        """
        if time_column is not None and column is None:
            raise InputError("--time-column: only with --column, which names the acceleration [E-CLI-01]")
        step = quantity(time_step, TIME, "--time-step") if time_step else None
        return cls(unit, step, layout, component, _header_or_number(column), _header_or_number(time_column))


def read_inputs(
    inputs: Sequence[Path], folders: Sequence[Path], simulated_records: bool, reading: Reading
) -> tuple[str, dict[str, Found]]:
    """Return the name of the whole, and its recordings by name.

    Raises:
        InputError: a file cannot be read, two have the same name, a recording is found nowhere, or an option does not
            belong to what is read.
    """
    inputs = [suite_file(Path(), str(path)) if not path.exists() else path for path in inputs]
    for path in inputs:
        if not path.exists() and not _is_suite(path) and is_suite_name(str(path)):
            raise InputError(unknown_name("suite", str(path), suite_names(), f"; and there is no file {path}"))
    if any(_is_suite(path) for path in inputs):
        if len(inputs) > 1:
            raise InputError(f"{inputs[0]}: one suite file, or record files; not both, and not two suites [E-CLI-05]")
        if reading != Reading():
            raise InputError(
                "--unit, --time-step, --layout, --component, --column: only for record files; a suite file says these "
                "itself [E-CLI-01]"
            )
        name = _name(inputs[0])
        suite = load_suite(inputs[0]).horizontal()
        found = find_suite(suite, folders, simulated_records)
        return name, {entry.id: item for entry, item in zip(suite.records, found, strict=True)}
    if folders:
        raise InputError("--folder: only with a suite file, whose recordings are looked for there [E-CLI-01]")
    if not simulated_records:
        raise InputError("--no-simulated-records: only with a suite file [E-CLI-01]")
    return "records", _files(inputs, reading)


def _is_suite(path: Path) -> bool:
    """Return whether a path is meant to be a suite file."""
    return path.suffix.lower() in (".yaml", ".yml")


def _files(inputs: Sequence[Path], reading: Reading) -> dict[str, Found]:
    recordings: dict[str, Found] = {}
    for path in inputs:
        name = _name(path)
        if name.lower() in map(str.lower, recordings):  # names of files, and some systems do not distinguish a from A
            raise InputError(f"{path}: another of the files is called {name} too; rename one of them [E-FILE-09]")
        record = _record(path, name, reading)
        twin = next((other for other, item in recordings.items() if item.record.checksum == record.checksum), None)
        if twin is not None:
            raise InputError(
                f"{path}: the same recording as {recordings[twin].detail}; leave one of them out [E-FILE-09]"
            )
        recordings[name] = Found(record, "file", str(path))
    of_tables = (reading.unit, reading.time_step, reading.layout, reading.column)
    declared = {detect(path) for path in inputs} & {"table", "sac"}
    if any(option is not None for option in of_tables) and not declared:
        raise InputError(
            "--unit, --time-step, --layout, --column: only for tables of text; these files say all this themselves"
            " [E-CLI-01]"
        )
    if reading.component is not None and not any(names_components(detect(path)) for path in inputs):
        tables = any(detect(path) == "table" for path in inputs)
        instead = "columns of tables are chosen by --column" if tables else "these hold one"
        raise InputError(f"--component: only for files that name their components; {instead} [E-CLI-01]")
    return recordings


def _record(path: Path, name: str, reading: Reading) -> Record:
    """Read a file with those of the options that belong to its format."""
    found = detect(path)
    if found == "sac":
        return read_record_file(path, acceleration_unit=reading.unit, component=reading.component, name=name)
    if names_components(found):
        return read_record_file(path, file_format=found, component=reading.component, name=name)
    if found != "table":
        return read_record_file(path, file_format=found, name=name)
    if reading.unit is None:
        raise InputError(
            f"{path}: a table does not say the unit of its accelerations; declare it: --unit "
            f"{', '.join(ACCELERATION_UNITS)} [E-CLI-03]"
        )
    return read_record_file(
        path,
        acceleration_unit=reading.unit,
        time_step=reading.time_step,
        layout=reading.layout,  # type: ignore[arg-type]
        acceleration_column=reading.column,
        time_column=reading.time_column,
        name=name,
    )


def _header_or_number(column: str | None) -> int | str | None:
    return int(column) if column is not None and column.isdecimal() else column


def _name(path: Path) -> str:
    """The name of a file without its suffix, which results and their files bear.

    Raises:
        InputError: it cannot stand in an archive.
    """
    name = path.name.removesuffix(path.suffix)
    if name in TAKEN:
        raise InputError(f"{path}: `{name}` has a meaning of its own in archives; rename the file [E-FILE-10]")
    if len(name) > LONGEST_NAME or not re.search(r"\w", name) or not name.isprintable():
        raise InputError(
            f"{path}: results are named as the file, so its name needs a letter or digit, no control characters, and "
            f"at most {LONGEST_NAME} characters; rename the file [E-FILE-10]"
        )
    return name
