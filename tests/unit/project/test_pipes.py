"""Pipes and devices in the place of files are refused: one may be waited for without end, the other may have none."""

import os
import socket
import subprocess
import sys
from pathlib import Path

import pytest

from edesign.errors import InputError
from edesign.project.reading.file_bytes import missing, read_file

pytestmark = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes on this system")

NAMES = ("pipe.yaml", "pipe.AT2", "pipe.csv", "pipe.json", "pipe")
COMMANDS = ("inspect", "run", "sheet", "show", "fit", "records")
SECONDS = 60
"""Of processor time and of waiting, a safety net: a command ends in one, and one that waits never does."""


def start(command: str, path: Path) -> subprocess.CompletedProcess[str]:
    program = f"import resource; resource.setrlimit(resource.RLIMIT_CPU, ({SECONDS}, {SECONDS}))\n"
    program += "import sys; from edesign.cli.main import main; sys.exit(main(sys.argv[1:]))"
    words = [sys.executable, "-c", program, command, str(path)]
    return subprocess.run(words, capture_output=True, text=True, timeout=SECONDS, check=False)


@pytest.mark.parametrize(
    ("command", "name"), [*(("check", name) for name in NAMES), *((command, "pipe.yaml") for command in COMMANDS)]
)
def test_a_pipe_is_refused_whatever_it_is_called(tmp_path: Path, command: str, name: str) -> None:
    os.mkfifo(tmp_path / name)
    done = start(command, tmp_path / name)
    assert done.returncode in (2, 4) and "Traceback" not in done.stderr
    words = " ".join(done.stderr.split())
    assert "this is a pipe, and only files are read" in words or "not a regular file" in words


@pytest.mark.parametrize("device", ["/dev/zero", "/dev/urandom", "/dev/null"])
@pytest.mark.parametrize("command", ["check", "inspect"])
def test_a_device_is_refused(command: str, device: str) -> None:
    if not Path(device).exists():
        pytest.skip("no such device on this system")
    done = start(command, Path(device))
    assert done.returncode == 2 and f"{device}: this is a device, and only files are read" in done.stderr


def test_a_pipe_with_a_writer_and_a_socket_are_refused_too(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    writer = os.open(tmp_path / "pipe", os.O_RDWR)  # which does not wait for a reader
    try:
        with pytest.raises(InputError, match="E-FILE-02"):
            read_file(tmp_path / "pipe", "project file")
    finally:
        os.close(writer)
    with socket.socket(socket.AF_UNIX) as one:
        one.bind(str(tmp_path / "socket"))
        with pytest.raises(InputError, match="E-FILE-02"):
            read_file(tmp_path / "socket", "project file")


def test_a_pipe_in_the_place_of_an_output_is_refused(tmp_path: Path) -> None:
    from edesign.archive.files import check_file
    from edesign.errors import ArchiveError

    os.mkfifo(tmp_path / "result.yaml")
    with pytest.raises(ArchiveError, match="E-FILE-06"):
        check_file(tmp_path / "result.yaml")


def test_a_missing_file_is_reported_as_before(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="E-FILE-01"):
        read_file(tmp_path / "none.yaml", "project file")


def test_a_missing_file_names_the_nearest_one_of_its_kind(tmp_path: Path) -> None:
    """Only files of its ending count, and their endings make no names alike."""
    for name in ("projekt.yaml", "project.h5", "e.yaml"):
        (tmp_path / name).touch()
    found = {
        name: str(missing(tmp_path / name, "file")).partition("such file")[2]
        for name in ("project.yaml", "project.yml", "project", "nofile.yaml", "project.csv", "no/project.yaml")
    }
    said = "; did you mean `projekt.yaml`? [E-FILE-01]"
    assert found == {
        **dict.fromkeys(("project.yaml", "project.yml", "project"), said),
        **dict.fromkeys(("nofile.yaml", "project.csv"), " [E-FILE-01]"),
        "no/project.yaml": f"; the folder {tmp_path / 'no'} does not exist [E-FILE-01]",
    }
