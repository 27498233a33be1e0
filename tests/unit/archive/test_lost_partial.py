"""A partial file that is deleted, replaced or moved while a run goes on: nothing that was computed is lost."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest
from unit.archive.archive_samples import history_group

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter, partial_path
from edesign.errors import ArchiveError

ROOT = Group(attributes={"project_checksum": "abc"})


def begun(path: Path) -> ArchiveWriter:
    """A run that has finished one analysis."""
    path.parent.mkdir(exist_ok=True)
    writer = ArchiveWriter(path, ROOT)
    writer.write("analyses/a", history_group(seed=1))
    return writer


def same(path: Path, names: list[str]) -> bool:
    """Whether an archive has the analyses of these names, with what was written."""
    with open_archive(path) as archive:
        found = [
            archive.group(f"analyses/{name}").variables["displacement"].values for name in archive.names("analyses")
        ]
        right = [history_group(seed=ord(name) - 96).variables["displacement"].values for name in names]
        return archive.names("analyses") == names and all((a == b).all() for a, b in zip(found, right, strict=True))


@pytest.mark.parametrize("with_folder", [False, True])
@pytest.mark.parametrize("at_the_end", [False, True])
def test_a_deleted_file_is_written_again(tmp_path: Path, with_folder: bool, at_the_end: bool) -> None:
    path, reported = tmp_path / "results" / "a.h5", []
    with begun(path) as writer:
        writer.on_rewrite = reported.append
        if at_the_end:
            writer.write("analyses/b", history_group(seed=2))
        if with_folder:
            shutil.rmtree(path.parent)
        else:
            partial_path(path).unlink()
        if not at_the_end:
            writer.write("analyses/b", history_group(seed=2))
            assert same(partial_path(path), ["a", "b"])
        writer.finish()
    assert reported == ["a.h5.partial was deleted during the run, and was written again"]
    assert same(path, ["a", "b"]) and [item.name for item in path.parent.iterdir()] == ["a.h5"]


def test_what_is_written_again_excludes_other_runs(tmp_path: Path) -> None:
    path = tmp_path / "a.h5"
    with begun(path) as writer:
        partial_path(path).unlink()
        writer.write("analyses/b", history_group(seed=2))
        with pytest.raises(ArchiveError, match="E-ARCH-04"):
            ArchiveWriter(path, ROOT)


@pytest.mark.parametrize("at_the_end", [False, True])
def test_another_file_in_its_place_is_left_as_it_is(tmp_path: Path, at_the_end: bool) -> None:
    """Such as that of another run, which began once the file was deleted: what this one has is kept beside it."""
    path = tmp_path / "a.h5"
    writer = begun(path)
    partial_path(path).unlink()
    partial_path(path).write_bytes(b"other")
    with pytest.raises(ArchiveError, match=r"a\.h5\.partial: another file .*E-ARCH-06"):
        writer.finish() if at_the_end else writer.write("analyses/b", history_group(seed=2))
    assert partial_path(path).read_bytes() == b"other" and not path.exists()
    assert writer.partial == tmp_path / "a.h5.1.partial" and same(writer.partial, ["a"] if at_the_end else ["a", "b"])
    writer.discard()
    assert partial_path(path).read_bytes() == b"other"


@pytest.mark.skipif(not Path("/proc/self/fd").is_dir(), reason="this system does not say where an open file is")
def test_a_folder_that_was_renamed_keeps_the_file(tmp_path: Path) -> None:
    path = tmp_path / "results" / "a.h5"
    writer = begun(path)
    path.parent.rename(tmp_path / "elsewhere")
    with pytest.raises(ArchiveError, match=r"the folder .*results .*E-ARCH-06"):
        writer.write("analyses/b", history_group(seed=2))
    assert writer.partial == tmp_path / "elsewhere" / "a.h5.partial" and same(writer.partial, ["a", "b"])
    with ArchiveWriter(tmp_path / "elsewhere" / "a.h5", ROOT, reuse=lambda *_: True) as again:
        assert again.kept == ("analyses/a", "analyses/b")


def test_no_space_to_write_it_again_is_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "a.h5"
    writer = begun(path)
    partial_path(path).unlink()
    real = os.open

    def full(target: object, flags: int, *mode: int) -> int:
        if flags & os.O_EXCL:
            raise OSError(28, "No space left on device")
        return real(target, flags, *mode)  # type: ignore[arg-type]

    monkeypatch.setattr(os, "open", full)
    with pytest.raises(ArchiveError, match="the disk is full.*E-FILE-06"):
        writer.write("analyses/b", history_group(seed=2))
    assert list(tmp_path.iterdir()) == []


def test_a_name_that_another_kind_of_file_took_meanwhile_is_left(tmp_path: Path) -> None:
    path = tmp_path / "a.h5"
    with begun(path) as writer:
        path.write_text("notes", encoding="utf-8")
        with pytest.raises(ArchiveError, match="E-FILE-07"):
            writer.finish()
    assert path.read_text(encoding="utf-8") == "notes" and same(partial_path(path), ["a"])
