"""The tally of a run: what is done, and what is left when analyses of known length run on known workers."""

from __future__ import annotations

import pytest

from edesign.study.run.progress import Progress, Tally


class Run:
    """Reports analyses to a tally at times that a test chooses."""

    def __init__(self, count: int) -> None:
        self.now = 0.0
        self.count = count
        self.tally = Tally(lambda: self.now)

    def start(self, name: str) -> None:
        """An analysis begins."""
        self.tally(Progress("start", name, 1, self.count))

    def advance(self, name: str, fraction: float) -> None:
        """It goes on."""
        self.tally(Progress("advance", name, 1, self.count, fraction))

    def end(self, name: str, seconds: float) -> None:
        """It ends."""
        self.tally(Progress("end", name, 1, self.count, 1.0, "completed", seconds))


def test_nothing_is_estimated_before_something_is_known() -> None:
    run = Run(3)
    assert run.tally.left is None and run.tally.fraction == 0.0
    run.tally(Progress("note", message="continuing", count=3))
    run.tally(Progress("reuse", "a", 1, 3))  # took no time of this run
    assert (run.tally.done, run.tally.count, run.tally.left) == (1, 3, None)
    run.start("b")
    run.now = 4.0
    run.advance("b", 0.01)  # could be anything yet
    assert run.tally.left is None
    run.advance("b", 0.25)  # 16 s in all, and as long again for the third
    assert run.tally.left == pytest.approx(12.0 + 16.0)
    assert run.tally.fraction == pytest.approx(1.25 / 3)


def test_equal_analyses_one_after_the_other() -> None:
    """At the end of the k-th of ten, each of 7 s, there are (10 - k) times 7 s left."""
    run = Run(10)
    for k in range(1, 11):
        run.start(f"{k}")
        run.now += 7.0
        run.end(f"{k}", 7.0)
        assert run.tally.left == pytest.approx((10 - k) * 7.0, abs=1e-9)
    assert (run.tally.done, run.tally.fraction) == (10, 1.0)


def test_workers_share_what_is_left() -> None:
    """Twelve of 6 s on three workers, four rounds: 18 s are left after the first, 15 s in the middle of the second."""
    run = Run(12)
    for name in "abc":
        run.start(name)
    run.now = 6.0
    for name, following in zip("abc", "def", strict=True):
        run.end(name, 6.0)
        run.start(following)
    assert run.tally.left == pytest.approx(18.0)
    run.now = 9.0
    for name in "def":
        run.advance(name, 0.5)
    assert run.tally.left == pytest.approx(15.0)


def test_the_last_one_is_not_shared() -> None:
    run = Run(2)
    run.start("short")
    run.start("long")
    run.now = 2.0
    run.end("short", 2.0)
    run.advance("long", 0.1)  # 20 s in all
    assert run.tally.left == pytest.approx(18.0)


def test_quick_ones_at_the_beginning_are_forgotten() -> None:
    """Modes and gravity take no time; after eight histories they no longer count."""
    run = Run(30)
    for k in range(20):
        seconds = 0.01 if k < 12 else 5.0
        run.start(f"{k}")
        run.now += seconds
        run.end(f"{k}", seconds)
    assert run.tally.left == pytest.approx(50.0)


def test_what_is_not_in_the_plan_does_not_count() -> None:
    run = Run(4)
    run.tally(Progress("start", "matching", 0, 4))
    run.tally(Progress("advance", "matching", 0, 4, 0.5))
    run.tally(Progress("end", "matching", 0, 4, 1.0, "5 of 5 records", 60.0))
    assert (run.tally.done, run.tally.left, run.tally.fraction) == (0, None, 0.0)
