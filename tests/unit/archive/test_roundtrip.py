"""What is written is what is read: by this package, and by xarray with named dimensions (netCDF-4 conventions)."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest
from unit.archive.archive_samples import history_group

from edesign.archive.dataset import Group, Variable
from edesign.archive.hdf5 import CHUNK, chunk_shape
from edesign.archive.reader import DamagedArchive, open_archive
from edesign.archive.tree import Tree
from edesign.archive.writer import ArchiveWriter, partial_path
from edesign.errors import ArchiveError


def write(path: Path, groups: dict[str, Group]) -> Path:
    with ArchiveWriter(path, Group(attributes={"title": "test"})) as writer:
        for place, group in groups.items():
            writer.write(place, group)
        return writer.finish({"status": "completed"})


def test_read_back_is_bitwise_what_was_written(tmp_path: Path) -> None:
    group = history_group()
    with open_archive(write(tmp_path / "a.h5", {"analyses/el_centro": group})) as archive:
        read = archive.group("analyses/el_centro")
        assert (
            archive.complete and archive.attributes["status"] == "completed" and archive.attributes["title"] == "test"
        )
        assert archive.names("analyses") == ["el_centro"]
    assert read.coords.keys() == group.coords.keys() and read.variables.keys() == group.variables.keys()
    for name, variable in {**group.coords, **group.variables}.items():
        found = {**read.coords, **read.variables}[name]
        assert (found.dims, found.unit, found.long_name) == (variable.dims, variable.unit, variable.long_name)
        assert found.values.dtype.kind == variable.values.dtype.kind, name
        np.testing.assert_array_equal(found.values, variable.values)
    assert read.attributes.keys() == group.attributes.keys()
    for name, value in group.attributes.items():
        np.testing.assert_equal(read.attributes[name], value)


def test_a_view_of_a_closed_archive_is_no_damage(tmp_path: Path) -> None:
    with open_archive(write(tmp_path / "a.h5", {"analyses/one": history_group()})) as archive:
        view = archive.view("analyses/one")
    with pytest.raises(ArchiveError, match="after the archive was closed .E-ARCH-06") as caught:
        dict(view.variables)
    assert not isinstance(caught.value, DamagedArchive)


def test_a_view_has_what_the_group_has(tmp_path: Path) -> None:
    """Against `Archive.group`, which reads all at once; single precision is read as double in both."""
    group = history_group()
    group.add("single", ("time",), np.arange(50, dtype=np.float32) / 3, "1", "a history in single precision")
    with open_archive(write(tmp_path / "a.h5", {"analyses/one": group})) as archive:
        read, view = archive.group("analyses/one"), archive.view("analyses/one")
        np.testing.assert_equal(view.attributes, read.attributes)
        for all_read, unread in ((read.coords, view.coords), (read.variables, view.variables)):
            assert list(unread) == list(all_read)
            for name, expected in all_read.items():
                assert unread[name].dims == expected.dims
                assert unread[name].unit == expected.unit
                assert unread[name].long_name == expected.long_name
                np.testing.assert_array_equal(unread[name].values, expected.values, strict=True)


def test_a_view_reads_what_is_asked_for(tmp_path: Path) -> None:
    """Of what was left out along time nothing is read, and of the rest neither units nor long names."""
    with open_archive(write(tmp_path / "a.h5", {"analyses/one": history_group()})) as archive:
        short = archive.view("analyses/one").without("time")
        values, labels = asked(archive._tree, "values"), asked(archive._tree, "labels")
        have = {**short.coords, **short.variables}
        assert values == list(have) and "time" not in have and not labels
        first = next(iter(have))
        assert have[first].unit == have[first].unit and have[first].long_name
        assert labels == [first] and len(values) == len(have)


def asked(tree: Tree, what: str) -> list[str]:
    """Let a tree note of which variables it reads something."""
    names: list[str] = []
    read = getattr(tree, what)

    def noting(place: str, name: str) -> object:
        names.append(name)
        return read(place, name)

    setattr(tree, what, noting)
    return names


def test_a_unit_that_is_asked_for_after_the_archive_was_closed_is_no_damage(tmp_path: Path) -> None:
    with open_archive(write(tmp_path / "a.h5", {"analyses/one": history_group()})) as archive:
        variable = next(iter(archive.view("analyses/one").variables.values()))
    with pytest.raises(ArchiveError, match="after the archive was closed .E-ARCH-06") as caught:
        assert variable.unit
    assert not isinstance(caught.value, DamagedArchive)


def test_xarray_opens_it_with_named_dimensions(tmp_path: Path) -> None:
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("h5netcdf")
    group = history_group()
    path = write(tmp_path / "a.h5", {"analyses/el_centro": group})
    with xarray.open_dataset(path, group="analyses/el_centro", engine="h5netcdf") as data:
        assert data["displacement"].dims == ("time", "floor")
        assert dict(data.sizes) == {"time": 50, "floor": 3, "member": 2}
        assert data["displacement"].attrs == {"units": "m", "long_name": "floor displacement"}
        np.testing.assert_array_equal(data["displacement"].values, group.variables["displacement"].values)
        assert float(data["axial_force"].sel(member="C_A_1")) == -1.5e6
        assert data["yielded"].dtype == bool and bool(data["yielded"].sel(member="C_A_1"))
        assert str(data["note"].values) == "10 °C, ünïcode"
        assert data.attrs["status"] == "completed" and data.attrs["steps"] == 50
        # 0.07 s lies on the time axis: the coordinate really indexes the data
        assert float(data["displacement"].sel(time=0.07, floor=2, method="nearest")) == float(
            group.variables["displacement"].values[7, 1]
        )
    with xarray.open_dataset(path, engine="h5netcdf") as root:
        assert root.attrs["complete"] == 1


def test_netcdf_opens_it_with_named_dimensions(tmp_path: Path) -> None:
    netcdf = pytest.importorskip("netCDF4")
    path = write(tmp_path / "a.h5", {"analyses/el_centro": history_group(3000)})
    with netcdf.Dataset(path) as file:
        data = file["analyses/el_centro"]
        assert data["displacement"].dimensions == ("time", "floor") and data["displacement"].units == "m"
        np.testing.assert_array_equal(data["displacement"][:], history_group(3000).variables["displacement"].values)
        assert list(data["member"][:]) == ["C_A_1", "B_1_1"] and data.status == "completed"


def test_texts_have_a_fixed_length_and_numbers_a_checksum(tmp_path: Path) -> None:
    """What HDF5 checks by itself: object headers, where texts and small arrays lie, and chunks with Fletcher-32."""
    path = write(tmp_path / "a.h5", {"analyses/a": history_group(3000)})
    with h5py.File(path) as file:
        group = file["analyses/a"]
        for name, item in group.items():
            assert h5py.check_string_dtype(item.dtype) is None or h5py.check_string_dtype(item.dtype).length, name
            in_header = item.id.get_create_plist().get_layout() == h5py.h5d.COMPACT
            assert in_header or (item.fletcher32 and item.chunks), name
            for attribute in set(item.attrs) - {"DIMENSION_LIST", "REFERENCE_LIST"}:
                assert item.attrs.get_id(attribute).get_type().get_class() != h5py.h5t.VLEN
        assert group["displacement"].fletcher32 and group["displacement"].chunks == (1500, 3)
        assert group.attrs["status"] == b"completed" and group["note"][()].decode() == "10 °C, ünïcode"


def test_bytes_of_a_value(tmp_path: Path) -> None:
    """Of sines, the bytes of the mantissa are as good as random, those of sign and exponent repeat: 3 of 4, 7 of 8."""
    time = 0.01 * np.arange(6000)
    motion = 0.1 * np.sin(2.0 * np.pi * np.outer(time, np.linspace(0.4, 3.0, 20)))
    group = Group(attributes={"status": "completed"})
    group.coords["time"] = Variable(("time",), time, "s", "time")
    group.coords["floor"] = Variable(("floor",), np.arange(1, 21), "1", "floor")
    group.add("single", ("time", "floor"), motion.astype(np.float32), "m", "displacement")
    group.add("double", ("time", "floor"), motion, "m", "displacement")
    path = write(tmp_path / "a.h5", {"analyses/a": group})
    with h5py.File(path) as file:
        stored = {name: file["analyses/a"][name].id.get_storage_size() for name in ("single", "double", "time")}
        assert file["analyses/a/single"].dtype == np.float32
    assert stored["single"] < 3.25 * motion.size and stored["double"] < 7.5 * motion.size
    assert stored["time"] < 0.1 * 8 * time.size  # steps of a clock: their bytes repeat
    with open_archive(path) as archive:
        found = archive.group("analyses/a").variables
    np.testing.assert_array_equal(found["double"].values, motion)
    assert found["single"].values.dtype == float
    np.testing.assert_allclose(found["single"].values, motion, rtol=2.0**-24, atol=0.0)


def test_layouts_that_are_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Layout 2 differs from 3 only in that nothing is compressed; a later one is refused."""
    monkeypatch.setattr("edesign.archive.writer.FORMAT", 2)
    with open_archive(write(tmp_path / "a.h5", {"analyses/a": history_group()})) as archive:
        assert archive.names("analyses") == ["a"]
    monkeypatch.setattr("edesign.archive.writer.FORMAT", 4)
    path = write(tmp_path / "b.h5", {"analyses/a": history_group()})
    with pytest.raises(ArchiveError, match=r"b\.h5: .*layout 4; .* 1 to 3 .E-ARCH-02"):
        open_archive(path)


@pytest.mark.parametrize("shape", [(1025,), (20_000, 3), (1, 100_000), (2, 3, 50_000), (70_000, 1, 2)])
def test_chunks_are_even_and_of_a_good_size(shape: tuple[int, ...]) -> None:
    """No more than 64 kB, and not less than half of it; what the last chunks have too much is one row for each."""
    chunk = chunk_shape(shape, 8)
    assert 8 * np.prod(chunk) <= CHUNK + 8 * np.prod(chunk) / max(chunk)
    assert 8 * np.prod(chunk) >= min(CHUNK / 2, 8 * np.prod(shape))
    assert all(1 <= part <= length for part, length in zip(chunk, shape, strict=True))


def test_it_opens_while_xarray_has_it_open(tmp_path: Path) -> None:
    """HDF5 refuses a second opening in one process unless both ask for the same locking."""
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("h5netcdf")
    path = write(tmp_path / "a.h5", {"analyses/el_centro": history_group()})
    with xarray.open_dataset(path, group="analyses/el_centro", engine="h5netcdf"), open_archive(path) as archive:
        assert archive.names("analyses") == ["el_centro"]


def test_groups_come_in_the_order_of_the_plan(tmp_path: Path) -> None:
    groups = {}
    for order, name in enumerate(["b", "a", "c"]):
        groups[f"analyses/{name}"] = Group(attributes={"order": order})
    with open_archive(write(tmp_path / "a.h5", groups)) as archive:
        assert archive.names("analyses") == ["b", "a", "c"]


def test_long_attributes_are_kept(tmp_path: Path) -> None:
    """HDF5's older layout refuses attributes above 64 kB; events of a long run are longer."""
    events = [{"time": float(i), "rung": "halved"} for i in range(5000)]
    with open_archive(write(tmp_path / "a.h5", {"g/x": Group(attributes={"events": events})})) as archive:
        assert archive.group_attributes("g/x")["events"] == events


def test_a_dimension_needs_a_coordinate_of_the_same_length(tmp_path: Path) -> None:
    group = Group()
    group.add("u", ("time",), [1.0, 2.0], "m", "u")
    with ArchiveWriter(tmp_path / "a.h5", Group()) as writer, pytest.raises(ValueError, match="dimension time"):
        writer.write("x", group)
    wrong = history_group()
    wrong.add("u", ("floor",), [1.0, 2.0], "m", "u")
    with ArchiveWriter(tmp_path / "b.h5", Group()) as writer, pytest.raises(ValueError, match="2 values along floor"):
        writer.write("x", wrong)


def test_until_finished_only_the_partial_file_changes(tmp_path: Path) -> None:
    path = write(tmp_path / "a.h5", {"analyses/old": history_group(seed=1)})
    before = path.read_bytes()
    with ArchiveWriter(path, Group()) as writer:
        writer.write("analyses/new", history_group(seed=2))
        assert path.read_bytes() == before
        with open_archive(partial_path(path)) as running:  # a run can be looked at while it goes on
            assert not running.complete and running.names("analyses") == ["new"]
        writer.finish()
    assert not partial_path(path).exists()
    with open_archive(path) as archive:
        assert archive.complete and archive.names("analyses") == ["new"]
