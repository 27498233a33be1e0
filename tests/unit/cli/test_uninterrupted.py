"""Ctrl-C while a library works that an exception would break: it waits, and nothing else is lost."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from edesign.stopping import uninterrupted

WORK = """
import signal, sys, threading
from edesign.cli.shared import stages
from edesign.stopping import uninterrupted

def work(progress):
    with uninterrupted():
        signal.raise_signal(signal.SIGINT)  # Python hands it to the main thread
        pressed.wait(1.0)
        print("whole", flush=True)
    pressed.wait()  # what goes on in a library, and asks nobody

pressed = threading.Event()
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell in the background has it ignored
try:
    stages.in_stages(work)
except KeyboardInterrupt:
    print("interrupted", flush=True)
    stages.end_with(130)
print("not here")
"""


def test_ctrl_c_comes_behind_what_is_not_to_be_interrupted() -> None:
    done = []
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt), uninterrupted():
            os.kill(os.getpid(), signal.SIGINT)
            done.append("whole")
        assert done == ["whole"]
        assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    finally:
        signal.signal(signal.SIGINT, before)


def test_a_request_to_stop_comes_behind_it_too() -> None:
    """The handler that was there before is asked, whatever it does."""
    asked = threading.Event()
    before = signal.signal(signal.SIGINT, lambda number, frame: asked.set())
    try:
        with uninterrupted():
            os.kill(os.getpid(), signal.SIGINT)
            assert not asked.is_set()
        assert asked.is_set()
    finally:
        signal.signal(signal.SIGINT, before)


def test_the_process_ends_behind_it_with_work_that_goes_on(tmp_path: Path) -> None:
    (tmp_path / "work.py").write_text(WORK, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, str(tmp_path / "work.py")], capture_output=True, text=True, timeout=60, check=False
    )
    assert (done.returncode, done.stdout.split()) == (130, ["whole", "interrupted"]), done.stderr
