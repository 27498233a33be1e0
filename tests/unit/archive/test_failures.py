"""Kill, full disk, missing permission, foreign and damaged files: what is kept, and what the user reads."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
from collections.abc import Callable, Mapping
from pathlib import Path

import h5py
import numpy as np
import pytest
from limited import limited
from unit.archive.archive_samples import history_group

from edesign.archive.dataset import Group
from edesign.archive.owner import check_owner
from edesign.archive.pieces import find_pieces
from edesign.archive.reader import open_archive, read_archive
from edesign.archive.writer import ArchiveWriter, partial_path, renew_root
from edesign.errors import ArchiveError

IDENTITY = ("project_checksum", "edesign_version")


def root(checksum: str = "abc", version: str = "1") -> Group:
    return Group(attributes={"project_checksum": checksum, "edesign_version": version})


def python(code: str, *arguments: str) -> subprocess.Popen[str]:
    """Start a Python process that can import the samples."""
    return subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(code), *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={
            **os.environ,
            "PYTHONPATH": os.pathsep.join([str(Path(__file__).parents[2]), str(Path(__file__).parents[3]), *sys.path]),
        },
    )


def interrupted(path: Path) -> None:
    """Leave a partial file with two finished groups and one that failed."""
    with ArchiveWriter(path, root(), IDENTITY) as writer:
        writer.write("analyses/a", history_group(seed=1))
        writer.write("analyses/b", history_group(seed=2))
        failed = history_group(seed=3)
        failed.attributes["status"] = "failed"
        writer.write("analyses/c", failed)


def completed(path: str, attributes: object) -> bool:
    return isinstance(attributes, dict) and attributes["status"] == "completed"


def test_resume_keeps_what_the_caller_accepts(tmp_path: Path) -> None:
    path = tmp_path / "a.h5"
    interrupted(path)
    with ArchiveWriter(path, root(), IDENTITY, reuse=completed) as writer:
        assert writer.kept == ("analyses/a", "analyses/b")
        writer.write("analyses/c", history_group(seed=3))
        writer.finish()
    with open_archive(path) as archive:
        for seed, name in enumerate("abc", start=1):
            found = archive.group(f"analyses/{name}").variables["displacement"].values
            assert (found == history_group(seed=seed).variables["displacement"].values).all()


@pytest.mark.parametrize(
    ("new", "word"), [(root(checksum="xyz"), "project checksum"), (root(version="2"), "edesign version")]
)
def test_another_project_or_version_starts_afresh_and_says_so(tmp_path: Path, new: Group, word: str) -> None:
    interrupted(tmp_path / "a.h5")
    with ArchiveWriter(tmp_path / "a.h5", new, IDENTITY, reuse=completed) as writer:
        assert writer.kept == () and f"({word} differs)" in writer.note and "starting afresh" in writer.note


def test_fresh_discards_the_partial_file(tmp_path: Path) -> None:
    interrupted(tmp_path / "a.h5")
    with ArchiveWriter(tmp_path / "a.h5", root(), IDENTITY, reuse=None) as writer:
        assert writer.kept == () and "as asked" in writer.note
    with open_archive(partial_path(tmp_path / "a.h5")) as archive:
        assert archive.names("analyses") == []


@pytest.mark.parametrize("damage", ["flipped", "zeros"])
def test_a_damaged_partial_file_starts_afresh_and_says_so(tmp_path: Path, damage: str) -> None:
    path = tmp_path / "a.h5"
    interrupted(path)
    partial = partial_path(path)
    content = bytearray(partial.read_bytes())
    content[len(content) // 2] ^= 1
    partial.write_bytes({"flipped": content, "zeros": bytes(4096)}[damage])
    with ArchiveWriter(path, root(), IDENTITY, reuse=completed) as writer:
        assert writer.kept == () and "damaged" in writer.note
        writer.write("analyses/a", history_group())
        writer.finish()
    with open_archive(path) as archive:
        assert archive.names("analyses") == ["a"]


def test_a_kill_leaves_all_but_what_was_being_written(tmp_path: Path) -> None:
    """At whatever byte it falls: what is whole is read and reused, and the rest is neither damage nor in the way."""
    path = tmp_path / "a.h5"
    interrupted(path)
    content = partial_path(path).read_bytes()
    ends = {place: stop for place, (_, stop) in find_pieces(content).places.items() if place}
    for cut in np.random.default_rng(1).integers(min(ends.values()) + 500, len(content), 12):
        partial_path(path).write_bytes(content[:cut])
        whole = [place for place, stop in ends.items() if cut > stop + 200]  # the line behind it has 120 bytes or so
        with open_archive(partial_path(path)) as archive:
            assert [f"analyses/{name}" for name in archive.names("analyses")] == whole
        with ArchiveWriter(path, root(), IDENTITY, reuse=completed) as writer:
            assert list(writer.kept) == [place for place in whole if place != "analyses/c"]
            writer.write("analyses/d", history_group(seed=4))
        with open_archive(partial_path(path)) as archive:
            assert [f"analyses/{name}" for name in archive.names("analyses")] == [*writer.kept, "analyses/d"]


def test_a_kill_while_the_groups_are_joined_loses_nothing(tmp_path: Path) -> None:
    """What it left beside the archive is replaced; a file of another kind there is not."""
    path = tmp_path / "a.h5"
    interrupted(path)
    aside = tmp_path / "a.h5.joining"
    aside.write_bytes(bytes(5000))  # reserved, and nothing written
    with ArchiveWriter(path, root(), IDENTITY, reuse=completed) as writer:
        assert writer.kept == ("analyses/a", "analyses/b")
        writer.finish()
    assert [item.name for item in tmp_path.iterdir()] == ["a.h5"]
    aside.write_text("notes", encoding="utf-8")
    with pytest.raises(ArchiveError, match=r"a\.h5\.joining: .*E-FILE-07"):
        ArchiveWriter(path, root())


def test_no_space_for_the_joined_archive_keeps_the_groups(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "a.h5"
    interrupted(path)

    def full(descriptor: int, start: int, size: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "posix_fallocate", full)
    with ArchiveWriter(path, root(), IDENTITY, reuse=completed) as writer:
        with pytest.raises(ArchiveError, match=r"a\.h5: .* the disk is full.*E-FILE-06"):
            writer.finish()
    assert [item.name for item in tmp_path.iterdir()] == ["a.h5.partial"]
    with ArchiveWriter(path, root(), IDENTITY, reuse=completed) as writer:
        assert writer.kept == ("analyses/a", "analyses/b")


@pytest.mark.parametrize("reuse", [None, completed])
def test_a_file_of_another_kind_at_the_place_of_the_partial_file_is_left(
    tmp_path: Path, reuse: Callable[[str, Mapping[str, object]], bool] | None
) -> None:
    path = tmp_path / "a.h5"
    partial_path(path).write_bytes(b"hello" * 99)
    with pytest.raises(ArchiveError, match=r"a\.h5\.partial: .*E-FILE-07"):
        ArchiveWriter(path, root(), IDENTITY, reuse=reuse)
    assert partial_path(path).read_bytes() == b"hello" * 99


def test_a_partial_file_that_another_program_made_is_left(tmp_path: Path) -> None:
    path = tmp_path / "a.h5"
    with h5py.File(partial_path(path), "w") as file:
        file["measured"] = [1.0, 2.0]
    before = partial_path(path).read_bytes()
    with pytest.raises(ArchiveError, match=r"a\.h5\.partial: .*E-FILE-07"):
        check_owner(path, root())
    assert partial_path(path).read_bytes() == before


def test_two_runs_on_one_archive_exclude_each_other(tmp_path: Path) -> None:
    with ArchiveWriter(tmp_path / "a.h5", root()), pytest.raises(ArchiveError, match=r"a\.h5\.partial: .*E-ARCH-04"):
        ArchiveWriter(tmp_path / "a.h5", root())


KILLED = """
    import sys
    from unit.archive.archive_samples import history_group
    from edesign.archive.dataset import Group
    from edesign.archive.writer import ArchiveWriter
    with ArchiveWriter(sys.argv[1], Group(attributes={"project_checksum": "abc", "edesign_version": "1"})) as writer:
        for i in range(10**6):
            writer.write(f"analyses/a{i:06d}", history_group(2000, seed=i))
            print(i, flush=True)
"""


@pytest.mark.parametrize("after", [1, 4, 9])
def test_kill_minus_nine_keeps_every_finished_group(tmp_path: Path, after: int) -> None:
    path = tmp_path / "a.h5"
    process = python(KILLED, str(path))
    assert process.stdout is not None
    with limited(process):
        for _ in range(after):
            assert process.stdout.readline(), process.stderr and process.stderr.read()
    process.send_signal(signal.SIGKILL)
    reported = after + len(process.stdout.read().split())  # `communicate` would lose what `readline` has read ahead
    assert process.wait() == -signal.SIGKILL
    assert not path.exists()  # nothing under the final name
    with open_archive(partial_path(path)) as archive:
        assert not archive.complete and archive.attributes["complete"] == 0
        names = archive.names("analyses")
        assert len(names) in (reported, reported + 1)  # the kill may fall between the commit and its report
        for i, name in enumerate(names):
            found = archive.group(f"analyses/{name}").variables["displacement"].values
            assert (found == history_group(2000, seed=i).variables["displacement"].values).all()
    with ArchiveWriter(path, root(), IDENTITY, reuse=completed) as writer:
        assert len(writer.kept) == len(names)


FULL = """
    import resource, sys
    from unit.archive.archive_samples import history_group
    from edesign.archive.dataset import Group
    from edesign.archive.writer import ArchiveWriter
    from edesign.errors import ArchiveError
    resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[2]), int(sys.argv[2])))
    written = 0
    root = Group(attributes={"project_checksum": "abc", "edesign_version": "1"})
    try:
        with ArchiveWriter(sys.argv[1], root) as writer:
            while written < 100:
                writer.write(f"analyses/a{written}", history_group(2000, seed=written))
                written += 1
            writer.finish()
    except ArchiveError as error:
        print(written)
        print(error)
        sys.exit(error.exit_code)
"""


def test_full_disk_is_a_clear_error_and_keeps_what_was_written(tmp_path: Path) -> None:
    """RLIMIT_FSIZE stands for the full disk; a plain HDF5 file ends in a segmentation fault here."""
    pytest.importorskip("resource")
    path = tmp_path / "a.h5"
    process = python(FULL, str(path), "300000")
    output, errors = process.communicate(timeout=60)
    assert process.returncode == 4 and errors == ""
    count, message = output.splitlines()
    assert int(count) >= 2  # about 50 kB each
    assert message == f"{path}: cannot write the archive: the file would exceed the allowed size [E-FILE-06]"
    assert not path.exists()
    with ArchiveWriter(path, root(), IDENTITY, reuse=completed) as writer:
        assert len(writer.kept) == int(count)


def test_disk_full_from_the_start_leaves_no_file(tmp_path: Path) -> None:
    pytest.importorskip("resource")
    process = python(FULL, str(tmp_path / "a.h5"), "100")
    output, _ = process.communicate(timeout=60)
    assert process.returncode == 4 and output.startswith("0\n")
    assert list(tmp_path.iterdir()) == []


def test_missing_folder_and_folder_in_the_way(tmp_path: Path) -> None:
    with pytest.raises(ArchiveError, match=r"nowhere .*E-FILE-06"):
        ArchiveWriter(tmp_path / "nowhere" / "a.h5", root())
    with pytest.raises(ArchiveError, match="folder .E-FILE-06"):
        ArchiveWriter(tmp_path, root())


def test_no_permission(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    if os.geteuid() == 0:  # root may write everywhere: let the system call refuse
        monkeypatch.setattr(os, "open", lambda *_: (_ for _ in ()).throw(PermissionError(13, "Permission denied")))
    else:
        tmp_path.chmod(0o500)
    with pytest.raises(ArchiveError, match="no permission .E-FILE-06"):
        ArchiveWriter(tmp_path / "a.h5", root())


def test_reader_names_what_is_wrong(tmp_path: Path) -> None:
    with pytest.raises(ArchiveError, match=r"a\.h5: no such archive \[E-ARCH-01\]$"):
        open_archive(tmp_path / "a.h5")
    interrupted(tmp_path / "a.h5")
    with pytest.raises(ArchiveError, match=r"a\.h5: .*a\.h5\.partial.*E-ARCH-01"):
        open_archive(tmp_path / "a.h5")
    with pytest.raises(ArchiveError, match="folder.*E-ARCH-01"):
        open_archive(tmp_path)
    (tmp_path / "text.h5").write_text("hello")
    with pytest.raises(ArchiveError, match=r"text\.h5: .*E-FILE-05"):
        open_archive(tmp_path / "text.h5")
    with h5py.File(tmp_path / "foreign.h5", "w") as foreign:
        foreign.attrs["x"] = 1
    with pytest.raises(ArchiveError, match=r"foreign\.h5: .*E-ARCH-02"):
        open_archive(tmp_path / "foreign.h5")
    with open_archive(partial_path(tmp_path / "a.h5")) as archive:
        with pytest.raises(ArchiveError, match="analyses/d.*: a, b, c.*E-ARCH-07"):
            archive.group("analyses/d")


def test_a_file_of_another_kind_is_left_as_it_is(tmp_path: Path) -> None:
    (tmp_path / "project.yaml").write_text("edesign: 1\n")
    with pytest.raises(ArchiveError, match=r"project\.yaml: .*E-FILE-07"):
        ArchiveWriter(tmp_path / "project.yaml", root())
    assert [item.name for item in tmp_path.iterdir()] == ["project.yaml"]
    (tmp_path / "a.h5").touch()  # what `mktemp` leaves
    with ArchiveWriter(tmp_path / "a.h5", root()) as writer:
        writer.finish()
    with ArchiveWriter(tmp_path / "a.h5", root()) as writer:  # an older archive
        writer.finish()
    if Path("/dev/zero").exists():
        with pytest.raises(ArchiveError, match="not a regular file.*E-FILE-06"):
            ArchiveWriter("/dev/zero", root())


@pytest.mark.slow
def test_a_partial_archive_is_read_while_its_run_writes(tmp_path: Path) -> None:
    """Every group that is listed is whole, and none counts as damaged, however the readings fall between the writes."""
    path = tmp_path / "a.h5"
    process = python(KILLED.replace("print", "time.sleep(0.05); print").replace("sys", "sys, time", 1), str(path))
    assert process.stdout is not None
    counts = []
    try:
        with limited(process):
            process.stdout.readline()
        for _ in range(6):
            found, damage = read_archive(
                partial_path(path),
                lambda archive: {name: archive.group(f"analyses/{name}") for name in archive.names("analyses")},
            )
            assert damage == ""
            for name, group in found.items():
                right = history_group(2000, seed=int(name[1:])).variables["displacement"].values
                assert (group.variables["displacement"].values == right).all()
            counts.append(len(found))
    finally:
        process.kill()
        process.communicate()
    assert counts == sorted(counts) and counts[-1] > counts[0]


def test_a_head_that_cannot_be_renewed_leaves_the_archive_as_it_was(tmp_path: Path) -> None:
    """An archive of an earlier layout is none whose copy the writer goes on with."""
    path = tmp_path / "run.h5"
    path.write_bytes((Path(__file__).parent / "layout_2" / "project.h5").read_bytes())
    before = path.read_bytes()
    with pytest.raises(ArchiveError, match=r"run\.h5: .*E-ARCH-02"):
        renew_root(path, Group(attributes={"title": "another"}), {}, {"status": "completed"})
    assert path.read_bytes() == before
    assert [item.name for item in tmp_path.iterdir()] == ["run.h5"]
