"""Progress as a user reads it: lines off a terminal, bars on one."""

from __future__ import annotations

import io
import sys

import pytest

from edesign.cli import report
from edesign.cli.shared import progress
from edesign.cli.shared.progress import PlainLines, duration, listener, remaining
from edesign.report.page.step import Step
from edesign.study.run.progress import Progress


@pytest.mark.parametrize(
    ("seconds", "text"),
    [
        (0.0, "0 s"),
        (0.0423, "0.042 s"),
        (1.24, "1.2 s"),
        (9.94, "9.9 s"),
        (9.96, "10 s"),
        (99.4, "99 s"),
        (99.6, "1 min 40 s"),
        (125.2, "2 min 5 s"),
        (3599.6, "1 h 0 min"),
        (4820.0, "1 h 20 min"),
    ],
)
def test_times_have_the_digits_that_matter(seconds: float, text: str) -> None:
    assert duration(seconds) == text


@pytest.mark.parametrize(
    ("seconds", "text"),
    [
        (None, ""),
        (0.4, ""),
        (7.4, "7 s left"),
        (23.4, "25 s left"),
        (118.0, "2 min left"),
        (290.0, "5 min left"),
        (5000.0, "1 h 23 min left"),
    ],
)
def test_an_estimate_has_no_more_digits_than_it_is_worth(seconds: float | None, text: str) -> None:
    assert remaining(seconds) == text


def test_lines_carry_place_time_and_what_is_left(capsys: pytest.CaptureFixture[str]) -> None:
    lines = PlainLines()
    for place, seconds in ((11, 2.4), (12, 1.2)):
        lines(Progress("start", f"h{place}", place, 24))
        lines(Progress("end", f"h{place}", place, 24, 1.0, "completed", seconds))
    lines(Progress("end", "matching", 0, 24, 1.0, "2 of 2 records", 3.0))
    # 2 of 24 are done: 22 of 1.8 s are left
    assert capsys.readouterr().err.splitlines() == [
        "[11/24] h11: completed (2.4 s); 4% done, about 55 s left",
        "[12/24] h12: completed (1.2 s); 8% done, about 40 s left",
        "matching: 2 of 2 records (3 s)",
    ]


def test_a_log_has_at_most_one_line_a_minute_of_an_analysis_that_goes_on(capsys: pytest.CaptureFixture[str]) -> None:
    """Of 300 s with a report each 5 s: at 60 s, 120 s, 180 s, 240 s, and the end."""
    now = 0.0
    lines = PlainLines(lambda: now)
    lines(Progress("start", "long", 1, 1))
    for step in range(1, 60):
        now = 5.0 * step
        lines(Progress("advance", "long", 1, 1, step / 60))
    now = 300.0
    lines(Progress("end", "long", 1, 1, 1.0, "completed", now))
    said = capsys.readouterr().err.splitlines()
    assert said[:2] == ["[1/1] long: 20%, about 4 min left", "[1/1] long: 40%, about 3 min left"]
    assert (len(said), said[-1]) == (5, "[1/1] long: completed (5 min 0 s)")


class Terminal(io.StringIO):
    """A stream that says it is a terminal."""

    def isatty(self) -> bool:
        return True


@pytest.mark.parametrize("count", [1, 80])
def test_a_terminal_gets_one_bar_for_the_run_and_one_for_each_analysis(
    count: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "120")
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    with listener() as listen:
        listen(Progress("start", "first", 1, count))
        if count > 1:
            listen(Progress("end", "first", 1, count, 1.0, "completed", 30.0))
            listen(Progress("start", "second", 2, count))
    shown = terminal.getvalue()
    if count == 1:
        assert "[1/1] first" in shown and "analyses" not in shown  # its own bar says it all
    else:
        assert "[1/80] first: completed (30 s)" in shown and "[2/80] second" in shown
        assert "1/80 analyses" in shown and "about 39 min left" in shown  # 79 of 30 s


def test_quiet_listens_to_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    with listener(quiet=True) as listen:
        assert listen is progress.silent
        listen(Progress("note", message="unheard"))
    assert capsys.readouterr().err == ""


def test_lines_of_a_report_come_once_a_minute_and_on_a_terminal_more_often(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    lines = report.PageProgress()
    for number in range(1, 26):
        lines(f"figure {number}")
    assert capsys.readouterr().err == ""
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    monkeypatch.setattr(report, "LINE_AFTER", 0.0)
    lines = report.PageProgress()
    lines("figure 1")
    assert capsys.readouterr().err == "figure 1\n"


def test_lines_of_a_report_tell_the_share_and_the_time_that_is_left(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """After 10 s a quarter is done: 30 s are left."""
    monkeypatch.setattr(report, "LOG_EVERY", 0.0)
    clock = iter((0.0, 10.0, 20.0))
    monkeypatch.setattr(report.time, "monotonic", lambda: next(clock))
    lines = report.PageProgress()
    lines(Step("section 3 of 9, hinges", 0.25))
    lines("laying out the PDF: sheet 3")
    shown = capsys.readouterr()
    assert shown.err == "section 3 of 9, hinges: 25%, about 30 s left\nlaying out the PDF: sheet 3\n"
    assert shown.out == ""
