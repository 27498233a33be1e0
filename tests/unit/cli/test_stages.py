"""Work in stages: what a user sees of it, and that Ctrl-C ends the wait for it at once."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time

import pytest

from edesign import stopping
from edesign.cli.shared import stages
from edesign.cli.shared.stages import ProgressLine, in_stages
from edesign.errors import InputError
from edesign.stopping import Stopped


def test_on_a_terminal_a_stage_that_lasts_has_a_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    monkeypatch.setattr(stages, "LINE_AFTER", 0.2)  # three looks are enough to see the line once

    def work(progress: ProgressLine) -> int:
        progress("quick")
        progress("long")
        time.sleep(0.5)
        return 7

    assert in_stages(work) == 7
    assert capsys.readouterr().err == "long ...\n"
    assert in_stages(work, quiet=True) == 7
    assert capsys.readouterr().err == ""


def test_elsewhere_each_stage_has_a_line_whatever_the_speed(capsys: pytest.CaptureFixture[str]) -> None:
    def work(progress: ProgressLine) -> int:
        for stage in ("one", "two", "three"):
            progress(stage)
        return 7

    assert in_stages(work) == 7
    assert capsys.readouterr().err == "one ...\ntwo ...\nthree ...\n"
    assert in_stages(work, quiet=True) == 7
    assert capsys.readouterr().err == ""


def test_errors_of_the_work_are_those_of_the_caller() -> None:
    def work(progress: ProgressLine) -> None:
        raise InputError("wrong [E-VALUE-01]")

    with pytest.raises(InputError, match="wrong"):
        in_stages(work)


def test_ctrl_c_ends_the_wait_and_the_work_at_its_next_stage() -> None:
    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell that starts tests behind may ignore it
    begun, goes_on, ended = threading.Event(), threading.Event(), threading.Event()

    def work(progress: ProgressLine) -> None:
        progress("first")
        begun.set()
        goes_on.wait(10.0)  # stands for a call that cannot be interrupted
        try:
            progress("second")
        except Stopped:
            ended.set()
            raise

    def interrupt() -> None:
        begun.wait(10.0)
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=interrupt, daemon=True).start()
    try:
        with pytest.raises(KeyboardInterrupt):
            in_stages(work)
        stopping._whole.release()  # it is kept for a process that ends, and this one writes in threads yet
    finally:
        signal.signal(signal.SIGINT, before)
    assert not ended.is_set()
    goes_on.set()
    assert ended.wait(10.0)
