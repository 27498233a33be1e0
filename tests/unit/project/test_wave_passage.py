"""Keys of wave passage: what is wrong is reported at its place; delays follow from velocity and direction."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from messages import says

from edesign.errors import InputError
from edesign.ground_motion.record import Record
from edesign.project import Problem, parse_project
from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.project.analysis.wave_passage import WavePassage
from edesign.study.motions.applied import check_motion

Broken = Callable[..., list[Problem]]

SHAKE = "record: el_centro, pga: 0.2 g"
WRONG = {
    "neither": ("«wave_passage: {}", "wave_passage", "`velocity` `delays` E-KEY-03"),
    "both": ("«wave_passage: {velocity: 300 m/s, delays: {A: 1 s}}", "wave_passage", "E-KEY-03"),
    "no such line": ("wave_passage: {delays: {«K: 0.1 s}}", "wave_passage.delays.K", "E-NAME-01"),
    "nobody is late": ("«wave_passage: {delays: {A: 0 s}}", "wave_passage", "E-KEY-03"),
    "direction of delays": (
        "wave_passage: {delays: {B: 0.1 s}, «direction: left}",
        "wave_passage.direction",
        "E-KEY-03",
    ),  # fmt: skip # noqa: E501
    "velocity of a length": ("wave_passage: {velocity: «300 m}", "wave_passage.velocity", "length E-UNIT-02"),
    "early": ("wave_passage: {delays: {B: «-0.1 s}}", "wave_passage.delays.B", "E-VALUE-02"),
    "unknown direction": (
        "wave_passage: {velocity: 300 m/s, direction: «up}",
        "wave_passage.direction",
        "`right` E-VALUE-03",
    ),
    "empty": ("wave_passage: {delays: «{}}", "wave_passage.delays", "E-VALUE-01"),
}


@pytest.mark.parametrize(("entry", "key", "said"), WRONG.values(), ids=WRONG.keys())
def test_a_wrong_wave(broken: Broken, entry: str, key: str, said: str) -> None:
    problems = broken((SHAKE, f"{SHAKE}, {entry}"))
    assert len(problems) == 1
    assert f"analyses[1].{key}" in str(problems[0]) and says(str(problems[0]), said)


def test_a_leaning_column_has_no_place(broken: Broken) -> None:
    problems = broken(
        ("  missing:", "  leaning_column: {G: 100 kN}\n  missing:"),
        (SHAKE, f"{SHAKE}, «wave_passage: {{velocity: 300 m/s}}"),
    )
    assert says(str(problems[0]), "analyses[1].wave_passage E-FRAME-04")


def test_delays_of_lines(small: str) -> None:
    project = parse_project(small.replace(SHAKE, f"{SHAKE}, wave_passage: {{velocity: 300 m/s}}"))
    shake = project.analyses[1]
    assert isinstance(shake, HistoryAnalysis) and shake.wave_passage is not None
    assert shake.wave_passage.delays_of(project.grid) == pytest.approx({"A": 0.0, "B": 0.02, "C": 0.045})
    left = WavePassage(velocity="300 m/s", direction="left")  # type: ignore[arg-type]
    assert left.delays_of(project.grid) == pytest.approx({"A": 0.045, "B": 0.025, "C": 0.0})


def test_a_wave_that_comes_after_the_end_is_refused(small: str) -> None:
    project = parse_project(small.replace(SHAKE, f"{SHAKE}, wave_passage: {{velocity: 1 m/s}}"))
    shake = project.analyses[1]
    assert isinstance(shake, HistoryAnalysis)
    record = Record("made", np.array([0.0, 1.0, 0.0]), 4.0, "made here")
    with pytest.raises(InputError, match="8 s.* C .*13.5 s.*E-HIST-03"):
        check_motion(project, shake, record)
