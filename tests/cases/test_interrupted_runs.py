"""Ctrl-C, full disks, closed streams and a second run: what is printed, and that nothing finished is lost."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from cases.small_frame import command, edesign, environment, write
from limited import limited

LONG = (  # an analysis that takes long enough to be interrupted, and little memory
    ("[4 m, 3 m]", "{count: 12, height: 3 m}"),
    ("time_step: 0.01 s", "time_step: 1e-4 s"),
    ("pga: 0.3 g", "pga: 0.3 g, free_vibration: 60 s"),
    ("{members: [C_A_1]}", "{histories: []}"),
)


def start(path: Path) -> subprocess.Popen[str]:
    """Start a run and wait until the last analysis has begun."""
    process = subprocess.Popen(
        command("run", path), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment()
    )
    assert process.stderr is not None
    with limited(process):
        for line in process.stderr:
            if line.startswith("[2/3]"):  # its end: the last one begins
                return process
        raise AssertionError("the last analysis did not begin")


@pytest.mark.parametrize("number", [signal.SIGINT, pytest.param(signal.SIGTERM, marks=pytest.mark.slow)])
def test_an_interrupted_run_says_what_it_kept_and_goes_on_from_there(tmp_path: Path, number: signal.Signals) -> None:
    path = write(tmp_path, *LONG)
    process = start(path)
    with limited(process):
        process.send_signal(number)
        _, errors = process.communicate(timeout=30)
    partial = tmp_path / "project.h5.partial"
    assert process.returncode == 130 and "Traceback" not in errors
    assert f"interrupted: 2 of 3 analyses are finished and kept in {partial}" in errors
    assert not (tmp_path / "project.h5").exists()

    shown = edesign("show", partial, "--json")
    statuses = {item["name"]: item["status"] for item in json.loads(shown.stdout)["analyses"]}
    assert statuses == {"modes": "completed", "push": "completed", "shake": "not run"}
    hint = edesign("show", tmp_path / "project.h5")
    assert hint.returncode == 4 and f"an incomplete one is there: {partial}" in hint.stderr

    again = start(path)  # reaches the third analysis at once, and with the results of the first two
    again.kill()
    _, errors = again.communicate(timeout=30)
    assert json.loads(edesign("show", partial, "--json").stdout)["analyses"][1]["status"] == "completed"


@pytest.mark.slow
def test_a_second_run_of_the_same_archive_is_refused(tmp_path: Path) -> None:
    path = write(tmp_path, *LONG)
    process = start(path)
    try:
        second = edesign("run", path)
        assert second.returncode == 4 and "E-ARCH-04" in second.stderr
    finally:
        process.kill()
        process.communicate(timeout=30)
    assert process.returncode == -signal.SIGKILL
    third = edesign("run", path, "--only", "push", "--archive", tmp_path / "other.h5")
    assert third.returncode == 0, third.stderr


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="no resource limits")
def test_a_disk_that_fills_up_is_reported_with_what_was_kept(tmp_path: Path) -> None:
    """A limit on the size of files stands for the full disk: the history does not fit, what came before does."""
    import resource

    path = write(tmp_path, ("pga: 0.3 g", "pga: 0.3 g, free_vibration: 200 s"))
    limit = 400_000  # bytes: modes and push need about half of them, 20 000 steps many times as many

    def limited() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    call = edesign("run", path, preexec_fn=limited)
    partial = tmp_path / "project.h5.partial"
    assert call.returncode == 4 and "Traceback" not in call.stderr
    assert f"; 2 of 3 analyses are finished and kept in {partial} [E-FILE-06]" in call.stderr
    assert not (tmp_path / "project.h5").exists()
    shown = json.loads(edesign("show", partial, "--json").stdout)["analyses"]
    assert [item["status"] for item in shown] == ["completed", "completed", "not run"]
    again = edesign("run", path)  # with space again
    assert again.returncode == 0 and "2 of 3 analyses are reused" in again.stderr


@pytest.mark.skipif(not Path("/dev/full").is_char_device(), reason="no device that is always full")
def test_output_that_cannot_be_written(tmp_path: Path) -> None:
    path = write(tmp_path)
    with Path("/dev/full").open("w") as full:
        shown = edesign("check", path, stdout=full)
        assert shown.returncode == 4
        assert shown.stderr == "edesign: the output cannot be written: No space left on device\n"
        # a log on a full disk does not stop a run
        call = subprocess.run(
            command("run", path), stdout=subprocess.PIPE, stderr=full, check=False, timeout=60, env=environment()
        )
    assert call.returncode == 0 and (tmp_path / "project.h5").exists()


@pytest.mark.slow
def test_a_process_without_streams_runs(tmp_path: Path) -> None:
    path = write(tmp_path)
    words = " ".join(f"'{word}'" for word in command("run", path))
    assert subprocess.run(["sh", "-c", f"{words} >&- 2>&-"], check=False, env=environment(), timeout=60).returncode == 0
    assert (tmp_path / "project.h5").exists()


@pytest.mark.slow
def test_a_folder_that_may_not_be_written(tmp_path: Path) -> None:
    path = write(tmp_path)
    if os.geteuid() != 0:
        target = tmp_path / "closed"
        target.mkdir(mode=0o500)
    else:  # root may write everywhere but in the file systems of the kernel
        closed = [folder for folder in ("/proc", "/sys") if os.path.ismount(folder)]
        if not closed:
            pytest.skip("no folder that root cannot write")
        target = Path(closed[0])
    call = edesign("run", path, "--archive", target / "a.h5")
    assert call.returncode == 4 and call.stdout == ""
    assert f"{target / 'a.h5'}: cannot write the archive: " in call.stderr and "Traceback" not in call.stderr
    assert "[1/3]" not in call.stderr  # before anything ran
    missing = edesign("run", path, "--archive", tmp_path / "nowhere" / "a.h5")
    assert missing.returncode == 4 and f"the folder {tmp_path / 'nowhere'} does not exist" in missing.stderr
