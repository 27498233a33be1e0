"""The tally of a run: what is done, and what is left when analyses of known length run on known workers."""

from __future__ import annotations

import csv
import heapq
from collections.abc import Iterator
from pathlib import Path

import pytest

from edesign.archive.dataset import Group
from edesign.cli.shared.progress import describe
from edesign.project.dampers.verification import LoopVerify, PlacementVerify
from edesign.study.run.pace import Pace, Work
from edesign.study.run.progress import Progress, Tally
from edesign.study.run.study_designs import Evaluated


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


@pytest.fixture(scope="module")
def measured() -> dict[str, tuple[Work, float]]:
    """Work of the analyses of projects/thesis_10_storey/study.yaml and the CPU time of each, s, as run on one core."""
    return run_of("thesis_run.csv")


def run_of(name: str) -> dict[str, tuple[Work, float]]:
    """Work and CPU time of analyses that were measured, by their names."""
    with (Path(__file__).parent / name).open(encoding="utf-8", newline="") as file:
        return {
            row["name"]: (
                Work(float(row["steps"]), row["kind"], tuple(row[key] for key in list(row)[3:-1])),
                float(row["seconds"]),
            )
            for row in csv.DictReader(file)
        }


def replayed(measured: dict[str, tuple[Work, float]], workers: int, between: float = 0.0) -> list[tuple[float, float]]:
    """Estimate and truth of the time that is left at the end of each analysis, s.

    Args:
        between: time that each worker takes between two analyses, s.
    """
    names, plan = list(measured), {name: work for name, (work, _) in measured.items()}
    now, said, running, place = 0.0, list[tuple[float, float | None]](), list[tuple[float, str]](), 0
    tally = Tally(lambda: now)

    def start(at: float) -> None:
        nonlocal place
        if place < len(names):
            name = names[place]
            place += 1
            tally(Progress("start", name, place, len(names), plan=plan))
            heapq.heappush(running, (at + measured[name][1] + between, name))

    for _ in range(workers):
        start(0.0)
    while running:
        now, name = heapq.heappop(running)
        tally(Progress("end", name, names.index(name) + 1, len(names), 1.0, "completed", measured[name][1], plan))
        said.append((now, tally.left))
        start(now)
    return [(estimate if estimate is not None else float("nan"), now - at) for at, estimate in said]


@pytest.mark.parametrize(("workers", "between"), [(1, 0.0), (2, 0.0), (4, 0.0), (1, 0.5)])
def test_the_time_left_of_a_measured_study_is_within_a_factor_of_two(
    measured: dict[str, tuple[Work, float]], workers: int, between: float
) -> None:
    """From the tenth analysis on, while a second is left: 80 histories at two levels, with and without dampers."""
    said = replayed(measured, workers, between)
    ratios = [estimate / truth for estimate, truth in said[9:] if truth > 1.0]
    assert len(ratios) > 60 and all(0.5 <= ratio <= 2.0 for ratio in ratios), ratios
    second_half = ratios[len(ratios) // 2 : -8]  # all variants and levels but one are known by then
    assert workers > 2 or all(0.7 <= ratio <= 1.4 for ratio in second_half), second_half


def test_the_time_left_of_a_building_in_space_is_within_a_factor_of_two() -> None:
    """From the tenth of 26 on: eight storeys, bare and with two pairs of designs, records of 32 to 102 s.

    Only bare ones are known by then; with dampers a step takes up to twice as long.
    """
    ratios = [estimate / truth for estimate, truth in replayed(run_of("hospital_run.csv"), 1)[9:] if truth > 1.0]
    assert len(ratios) == 16 and all(0.5 <= ratio <= 2.0 for ratio in ratios), ratios


def test_nothing_is_said_of_histories_before_one_is_known(measured: dict[str, tuple[Work, float]]) -> None:
    said = replayed(measured, 1)
    assert [estimate != estimate for estimate, _ in said[:5]] == [True, True, True, True, False]


def test_the_share_that_is_done_is_one_of_steps(measured: dict[str, tuple[Work, float]]) -> None:
    plan = {"short": Work(100.0, "history"), "long": Work(300.0, "history")}
    tally = Tally(lambda: 0.0)
    tally(Progress("start", "short", 1, 2, plan=plan))
    tally(Progress("end", "short", 1, 2, 1.0, "completed", 1.0, plan))
    assert tally.fraction == pytest.approx(0.25) and tally.left == pytest.approx(3.0)
    tally(Progress("start", "long", 2, 2, plan=plan))
    tally(Progress("advance", "long", 2, 2, 0.5, plan=plan))
    assert tally.fraction == pytest.approx(0.625)


def test_the_pace_of_what_is_new_is_that_of_its_variant_times_that_of_its_level() -> None:
    """Dampers make a step twice as long and the higher level half as long again, whatever the step."""
    pace = Pace()
    for variant, level, seconds in (("bare", "DBE", 1.0), ("bare", "MCE", 1.5), ("damped", "DBE", 2.0)):
        pace.add(Work(1000.0, "history", (variant, level)), seconds)
    assert pace.seconds(Work(2000.0, "history", ("damped", "MCE"))) == pytest.approx(6.0, rel=0.02)
    assert pace.seconds(Work(2000.0, "history", ("damped", "DBE"))) == pytest.approx(4.0)
    known = [pace.seconds(Work(1000.0, "history", ("other", level))) or 0.0 for level in ("DBE", "MCE")]
    assert known[1] / known[0] == pytest.approx(1.5, rel=0.02)
    assert pace.seconds(Work(1.0, "modal")) is None


def test_rounds_of_a_design_take_at_most_the_time_of_those_that_ran() -> None:
    """30 s and 50 s of eight rounds: 6 x 40 s are left; of layouts, 3 of 20 histories each, 4. Sizing is left out."""
    now, evaluated = [0.0], Evaluated(lambda: now[0])
    rounds, layouts = LoopVerify.model_construct(rounds=8), PlacementVerify.model_construct(budget=20)
    assert evaluated.left(rounds) is None

    def histories(seconds: float) -> Iterator[dict[str, Group]]:
        now[0] += seconds
        yield dict.fromkeys("abc", Group())

    for seconds in (30.0, 50.0):
        assert len(next(evaluated.counted(histories(seconds)))) == 3
        now[0] += 7.0
    assert (evaluated.left(rounds), evaluated.left(layouts), evaluated.left(None)) == (240.0, 160.0, None)
    assert describe(Progress("note", message="round 3", left=240.0)) == "round 3, at most about 4 min left"
