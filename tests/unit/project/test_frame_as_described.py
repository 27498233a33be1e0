"""Frames as engineers describe them: wrong loads, rigid ends and dampings are reported with place, marked by `«`."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from messages import says

from edesign.project import Problem, ProjectError, parse_project
from edesign.project.notation.positions import Position, parse_position

Broken = Callable[..., list[Problem]]
LOADS = "loads:\n  beams:\n"
DAMPING = "damping: {kind: rayleigh, ratio: 2 %}"
POINT = "    - {floors: 1, points: [{at: %s, G: 5 kN}]}\n"
PART = "    - {floors: 1, partial: [{start: %s, end: %s, G: %s}]}\n"

ONE_PROBLEM = {
    "area load on a beam": (("G: 20 kN/m", "G: «20 kN/m2"), "loads.beams[0].G", "`loads.floors` E-VALUE-01"),
    "load on a beam as a force": (("G: 20 kN/m", "G: «20 kN"), "loads.beams[0].G", "force E-UNIT-02"),
    "beyond the beam": ((LOADS, LOADS + POINT % "«7 m"), "loads.beams[0].points[0].at", "B_1_1, 6 m E-LOAD-02"),
    "beyond, in a list": (
        (LOADS, LOADS + POINT % "[1 m, «7 m]"),
        "loads.beams[0].points[0].at[1]",
        "B_1_1, 6 m E-LOAD-02",
    ),
    "at an end": ((LOADS, LOADS + POINT % "«0"), "loads.beams[0].points[0].at", "E-LOAD-02"),
    "no share": ((LOADS, LOADS + POINT % "«4/3"), "loads.beams[0].points[0].at", "E-VALUE-02"),
    "no place": ((LOADS, LOADS + POINT % "«middle"), "loads.beams[0].points[0].at", "`0.25` E-VALUE-01"),
    "no part": (
        (LOADS, LOADS + PART % ("4 m", "«50 %", "2 kN/m")),
        "loads.beams[0].partial[0].end",
        "`start` E-VALUE-04",
    ),
    "three values": (
        (LOADS, LOADS + PART % ("1 m", "2 m", "«[1 kN/m, 2 kN/m, 3 kN/m]")),
        "loads.beams[0].partial[0].G",
        "E-VALUE-04",
    ),
    "wrong second value": (
        (LOADS, LOADS + PART % ("1 m", "2 m", "[1 kN/m, «2 kN]")),
        "loads.beams[0].partial[0].G[1]",
        "force E-UNIT-02",
    ),
    "too many places": (
        (LOADS, "loads:\n  «beams:\n" + POINT % f"[{', '.join(f'{k}/40' for k in range(1, 17))}]"),
        "loads.beams",
        "14 E-LOAD-02",
    ),
    "no width": (
        (LOADS, "loads:\n  floors: [«{floors: 1, G: 5 kN/m2}]\n  beams:\n"),
        "loads.floors[0].width",
        "E-KEY-02",
    ),
    "line load on a floor": (
        (LOADS, "loads:\n  floors: [{floors: 1, G: «5 kN/m, width: 3 m}]\n  beams:\n"),
        "loads.floors[0].G",
        "E-UNIT-02",
    ),
    "no such column": (
        (LOADS, "loads:\n  columns: [{lines: «D, storeys: 1, G: 5 kN/m}]\n  beams:\n"),
        "loads.columns[0].lines",
        "E-NAME-01",
    ),
    "leaning without load": (
        ("sections:\n", "  «leaning_column: {}\nsections:\n"),
        "frame.leaning_column",
        "`G` `Q` E-LOAD-02",
    ),
    "leaning upwards": (
        ("sections:\n", "  leaning_column: {G: «-5 kN}\nsections:\n"),
        "frame.leaning_column.G",
        "E-VALUE-02",
    ),
    "leaning floors": (
        ("sections:\n", "  leaning_column: {G: «[1 MN, 1 MN]}\nsections:\n"),
        "frame.leaning_column.G",
        "E-VALUE-04",
    ),
    "leaning on linear columns": (
        ("sections:\n", "  «leaning_column: {G: 1 MN}\nelements: {geometry: {columns: linear}}\nsections:\n"),
        "frame.leaning_column",
        "`p_delta` `corotational` E-FRAME-04",
    ),
    "rigid end of five": (
        ("sections:\n", "elements: {rigid_ends: {beams: «5}}\nsections:\n"),
        "elements.rigid_ends.beams",
        "E-VALUE-02",
    ),
    "rigid braces": (
        ("sections:\n", "elements: {rigid_ends: {«braces: 1}}\nsections:\n"),
        "elements.rigid_ends.braces",
        "`columns` `beams` E-KEY-01",
    ),
    "modes and periods": (
        (DAMPING, "damping: {kind: rayleigh, ratio: 2 %, modes: [1, 3], «periods: [1 s, 0.3 s]}"),
        "damping.periods",
        "E-KEY-03",
    ),
    "one period twice": (
        (DAMPING, "damping: {kind: rayleigh, ratio: 2 %, periods: «[1 s, 1000 ms]}"),
        "damping.periods",
        "E-VALUE-04",
    ),
    "modes of many ratios": (
        (DAMPING, "damping: {kind: modal, ratio: [2 %, 3 %], modes: «3}"),
        "damping.modes",
        "E-KEY-03",
    ),
    "modal without modes": ((DAMPING, "«damping: {kind: modal, ratio: 2 %}"), "damping.modes", "E-KEY-02"),
    "wrong one of many": ((DAMPING, "damping: {kind: modal, ratio: [2 %, «120 %]}"), "damping.ratio[1]", "E-VALUE-02"),
    "mode and period": (
        (DAMPING, "damping: {kind: mass_proportional, ratio: 2 %, mode: 2, «period: 1 s}"),
        "damping.period",
        "E-KEY-03",
    ),
    "caughey of nothing": ((DAMPING, "«damping: {kind: caughey, ratio: 2 %}"), "damping", "`modes` `periods` E-KEY-03"),
    "caughey of one": (
        (DAMPING, "damping: {kind: caughey, ratio: 2 %, modes: «[1]}"),
        "damping.modes",
        "2 to 8 E-VALUE-04",
    ),
    "caughey twice": (
        (DAMPING, "damping: {kind: caughey, ratio: 2 %, modes: [1, 2, «1]}"),
        "damping.modes[2]",
        "E-NAME-02",
    ),
    "caughey of other ratios": (
        (DAMPING, "damping: {kind: caughey, ratio: «[2 %, 3 %], modes: [1, 2, 4]}"),
        "damping.ratio",
        "E-VALUE-04",
    ),
    "unknown damping": ((DAMPING, "damping: {kind: «caughy, ratio: 2 %}"), "damping.kind", "`caughey` E-VALUE-03"),
    "vertical of nothing": (
        ("pga: 0.2 g", "pga: 0.2 g, «vertical: {}"),
        "analyses[1].vertical",
        "`ratio` `record` E-KEY-03",
    ),
    "vertical that is none": (
        ("pga: 0.2 g", "pga: 0.2 g, vertical: {ratio: «-0 %}"),
        "analyses[1].vertical.ratio",
        "E-VALUE-02",
    ),
    "vertical beyond numbers": (
        ("pga: 0.2 g", "pga: 0.2 g, vertical: {ratio: «-2.0e+12}"),
        "analyses[1].vertical.ratio",
        "`-2000000000000.0` -1e+12 1e+12 E-VALUE-02",
    ),
    "vertical of no record": (
        ("pga: 0.2 g", "pga: 0.2 g, vertical: {record: «el_cetro}"),
        "analyses[1].vertical.record",
        "`el_centro` E-NAME-01",
    ),
    "vertical with two scales": (
        ("pga: 0.2 g", "pga: 0.2 g, vertical: {record: el_centro, pga: 0.1 g, «scale: 2}"),
        "analyses[1].vertical.scale",
        "E-KEY-03",
    ),
    "ratio with a scale": (
        ("pga: 0.2 g", "pga: 0.2 g, vertical: {ratio: 0.9, «scale: 2}"),
        "analyses[1].vertical.scale",
        "E-KEY-03",
    ),
}


@pytest.mark.parametrize(("change", "key", "said"), ONE_PROBLEM.values(), ids=ONE_PROBLEM)
def test_one_problem_is_reported_with_its_place(broken: Broken, change: tuple[str, str], key: str, said: str) -> None:
    (problem,) = broken(change)
    assert problem.keys_text == key
    assert says(problem.message, said)


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("1/3", Position(1 / 3, True)),
        ("30 %", Position(0.3, True)),
        (0.25, Position(0.25, True)),
        (1, Position(1.0, True)),
        ("2.4 m", Position(2.4, False)),
        ("240 cm", Position(2.4, False)),
    ],
)
def test_places_along_a_beam(text: object, place: Position) -> None:
    found = parse_position(text)
    assert found.is_share == place.is_share
    assert found.value == pytest.approx(place.value, rel=1e-15)


def test_vertical_motion_needs_masses_that_it_moves(small: str) -> None:
    text = small.replace("masses:\n", "masses:\n  directions: horizontal\n").replace(
        "pga: 0.2 g", "pga: 0.2 g, vertical: {ratio: 0.9}"
    )
    with pytest.raises(ProjectError, match=r"analyses\[1\].vertical.*E-VERT-01"):
        parse_project(text)
