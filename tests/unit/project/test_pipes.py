"""Named pipes in the place of files: read where a program writes into them, and not waited for without end."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from edesign.cli.main import main
from edesign.errors import InputError
from edesign.project.reading import file_bytes
from edesign.project.reading.file_bytes import missing, read_file

pytestmark = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes on this system")


@pytest.fixture
def pipe(tmp_path: Path) -> Path:
    os.mkfifo(tmp_path / "pipe.yaml")
    return tmp_path / "pipe.yaml"


def test_a_pipe_without_a_writer_is_refused(
    pipe: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(file_bytes, "_PIPE_WAIT", 0.01)
    assert main(["check", str(pipe)]) == 2
    assert (
        f"{pipe}: this is a pipe into which no program writes; name the project file itself" in capsys.readouterr().err
    )


def test_a_pipe_is_read_whole_even_if_its_writer_is_slow(pipe: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with subprocess.Popen(
        [
            sys.executable,
            "-c",
            f"import time\nwith open({str(pipe)!r}, 'w') as f: time.sleep(0.3); f.write('a' * 200000)",
        ]
    ):
        monkeypatch.setattr(file_bytes, "_PIPE_WAIT", 10.0)  # for the program to start
        assert read_file(pipe, "project file") == b"a" * 200000


def test_a_writer_that_is_silent_is_waited_for(pipe: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    writer = os.open(pipe, os.O_RDWR)  # which does not wait for a reader
    monkeypatch.setattr(file_bytes, "_PIPE_WAIT", 0.0)
    try:
        with file_bytes._opened(pipe, "file") as file:
            os.write(writer, b"late")
            assert file.read(4) == b"late"
    finally:
        os.close(writer)


def test_a_writer_that_has_gone_leaves_what_it_wrote(tmp_path: Path) -> None:
    reader, writer = os.pipe()
    os.write(writer, b"word")
    os.close(writer)
    there = Path(f"/dev/fd/{reader}")
    if not there.exists():
        pytest.skip("no names of open files on this system")
    try:
        assert read_file(there, "file") == b"word"
    finally:
        os.close(reader)


def test_a_missing_file_is_told_as_before(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="there is no such project file"):
        read_file(tmp_path / "none.yaml", "project file")


def test_a_missing_file_names_the_nearest_one_of_its_kind(tmp_path: Path) -> None:
    """Only files of its ending count, and their endings make no names alike."""
    for name in ("projekt.yaml", "project.h5", "e.yaml"):
        (tmp_path / name).touch()
    found = {
        name: str(missing(tmp_path / name, "file")).partition("such file")[2]
        for name in ("project.yaml", "project.yml", "project", "nofile.yaml", "project.csv", "no/project.yaml")
    }
    said = "; did you mean `projekt.yaml`?"
    assert found == {
        **dict.fromkeys(("project.yaml", "project.yml", "project"), said),
        **dict.fromkeys(("nofile.yaml", "project.csv"), ""),
        "no/project.yaml": f"; the folder {tmp_path / 'no'} does not exist",
    }
