"""Frames as engineers describe them: wrong loads, rigid ends and dampings are reported with place, marked by `«`."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from edesign.project import Problem, ProjectError, parse_project
from edesign.project.notation.positions import Position, parse_position

Broken = Callable[..., list[Problem]]
LOADS = "loads:\n  beams:\n"
DAMPING = "damping: {kind: rayleigh, ratio: 2 %}"
POINT = "    - {floors: 1, points: [{at: %s, G: 5 kN}]}\n"
PART = "    - {floors: 1, partial: [{start: %s, end: %s, G: %s}]}\n"

ONE_PROBLEM = {
    "area load on a beam": (
        ("G: 20 kN/m", "G: «20 kN/m2"),
        "loads.beams[0].G",
        "an area load, which needs a tributary width: give it under `loads.floors`",
    ),
    "load on a beam as a force": (("G: 20 kN/m", "G: «20 kN"), "loads.beams[0].G", "is a force, but"),
    "beyond the beam": (
        (LOADS, LOADS + POINT % "«7 m"),
        "loads.beams[0].points[0].at",
        "end of beam B_1_1, which is 6",
    ),
    "beyond, in a list": (
        (LOADS, LOADS + POINT % "[1 m, «7 m]"),
        "loads.beams[0].points[0].at[1]",
        "end of beam B_1_1, which is 6 m long",
    ),
    "at an end": ((LOADS, LOADS + POINT % "«0"), "loads.beams[0].points[0].at", "give a load on a node"),
    "no share": ((LOADS, LOADS + POINT % "«4/3"), "loads.beams[0].points[0].at", "between 0 and 1"),
    "no place": ((LOADS, LOADS + POINT % "«middle"), "loads.beams[0].points[0].at", "written like `1/3`, `0.25`"),
    "no part": (
        (LOADS, LOADS + PART % ("4 m", "«50 %", "2 kN/m")),
        "loads.beams[0].partial[0].end",
        "on beam B_1_1 the load ends at 50 %, not after its `start` at 4 m",
    ),
    "three values": (
        (LOADS, LOADS + PART % ("1 m", "2 m", "«[1 kN/m, 2 kN/m, 3 kN/m]")),
        "loads.beams[0].partial[0].G",
        "two are needed",
    ),
    "wrong second value": (
        (LOADS, LOADS + PART % ("1 m", "2 m", "[1 kN/m, «2 kN]")),
        "loads.beams[0].partial[0].G[1]",
        "is a force, but",
    ),
    "too many places": (
        (LOADS, "loads:\n  «beams:\n" + POINT % f"[{', '.join(f'{k}/40' for k in range(1, 17))}]"),
        "loads.beams",
        "has room for 14 places",
    ),
    "no width": (
        (LOADS, "loads:\n  floors: [«{floors: 1, G: 5 kN/m2}]\n  beams:\n"),
        "loads.floors[0].width",
        "missing",
    ),
    "line load on a floor": (
        (LOADS, "loads:\n  floors: [{floors: 1, G: «5 kN/m, width: 3 m}]\n  beams:\n"),
        "loads.floors[0].G",
        "a force per area",
    ),
    "no such column": (
        (LOADS, "loads:\n  columns: [{lines: «D, storeys: 1, G: 5 kN/m}]\n  beams:\n"),
        "loads.columns[0].lines",
        "no line D",
    ),
    "leaning without load": (
        ("sections:\n", "  «leaning_column: {}\nsections:\n"),
        "frame.leaning_column",
        "give `G` or `Q`",
    ),
    "leaning upwards": (
        ("sections:\n", "  leaning_column: {G: «-5 kN}\nsections:\n"),
        "frame.leaning_column.G",
        "must not be negative",
    ),
    "leaning floors": (
        ("sections:\n", "  leaning_column: {G: «[1 MN, 1 MN]}\nsections:\n"),
        "frame.leaning_column.G",
        "2 values, but the frame has 3 floors",
    ),
    "leaning on linear columns": (
        ("sections:\n", "  «leaning_column: {G: 1 MN}\nelements: {geometry: {columns: linear}}\nsections:\n"),
        "frame.leaning_column",
        "`p_delta` or `corotational`",
    ),
    "rigid end of five": (
        ("sections:\n", "elements: {rigid_ends: {beams: «5}}\nsections:\n"),
        "elements.rigid_ends.beams",
        "at least 0 and at most 1",
    ),
    "rigid braces": (
        ("sections:\n", "elements: {rigid_ends: {«braces: 1}}\nsections:\n"),
        "elements.rigid_ends.braces",
        "allowed here: `columns`, `beams`",
    ),
    "modes and periods": (
        (DAMPING, "damping: {kind: rayleigh, ratio: 2 %, modes: [1, 3], «periods: [1 s, 0.3 s]}"),
        "damping.periods",
        "`modes` and `periods` exclude each other",
    ),
    "one period twice": (
        (DAMPING, "damping: {kind: rayleigh, ratio: 2 %, periods: «[1 s, 1000 ms]}"),
        "damping.periods",
        "not twice 1 s",
    ),
    "modes of many ratios": (
        (DAMPING, "damping: {kind: modal, ratio: [2 %, 3 %], modes: «3}"),
        "damping.modes",
        "3 modes, but 2 ratios",
    ),
    "modal without modes": ((DAMPING, "«damping: {kind: modal, ratio: 2 %}"), "damping.modes", "how many modes"),
    "wrong one of many": ((DAMPING, "damping: {kind: modal, ratio: [2 %, «120 %]}"), "damping.ratio[1]", "at most 1"),
    "mode and period": (
        (DAMPING, "damping: {kind: mass_proportional, ratio: 2 %, mode: 2, «period: 1 s}"),
        "damping.period",
        "exclude each other",
    ),
    "caughey of nothing": (
        (DAMPING, "«damping: {kind: caughey, ratio: 2 %}"),
        "damping",
        "either `modes` or `periods`",
    ),
    "caughey of one": ((DAMPING, "damping: {kind: caughey, ratio: 2 %, modes: «[1]}"), "damping.modes", "from 2 to 8"),
    "caughey twice": (
        (DAMPING, "damping: {kind: caughey, ratio: 2 %, modes: [1, 2, «1]}"),
        "damping.modes[2]",
        "mode 1 stands here twice",
    ),
    "caughey of other ratios": (
        (DAMPING, "damping: {kind: caughey, ratio: «[2 %, 3 %], modes: [1, 2, 4]}"),
        "damping.ratio",
        "2 ratios for 3 modes",
    ),
    "unknown damping": ((DAMPING, "damping: {kind: «caughy, ratio: 2 %}"), "damping.kind", "did you mean `caughey`?"),
    "vertical of nothing": (
        ("pga: 0.2 g", "pga: 0.2 g, «vertical: {}"),
        "analyses[1].vertical",
        "either `ratio` (times the horizontal record) or `record`",
    ),
    "vertical that is none": (
        ("pga: 0.2 g", "pga: 0.2 g, vertical: {ratio: «-0 %}"),
        "analyses[1].vertical.ratio",
        "`-0 %` is out of range: a ratio above or below 0 is allowed",
    ),
    "vertical beyond numbers": (
        ("pga: 0.2 g", "pga: 0.2 g, vertical: {ratio: «-2.0e+12}"),
        "analyses[1].vertical.ratio",
        "`-2000000000000.0` is out of range: a ratio at least -1e+12 and at most 1e+12 is allowed",
    ),
    "vertical of no record": (
        ("pga: 0.2 g", "pga: 0.2 g, vertical: {record: «el_cetro}"),
        "analyses[1].vertical.record",
        "did you mean `el_centro`?",
    ),
    "vertical with two scales": (
        ("pga: 0.2 g", "pga: 0.2 g, vertical: {record: el_centro, pga: 0.1 g, «scale: 2}"),
        "analyses[1].vertical.scale",
        "exclude each other",
    ),
    "ratio with a scale": (
        ("pga: 0.2 g", "pga: 0.2 g, vertical: {ratio: 0.9, «scale: 2}"),
        "analyses[1].vertical.scale",
        "the `ratio` says the scale",
    ),
}


@pytest.mark.parametrize(("change", "key", "said"), ONE_PROBLEM.values(), ids=ONE_PROBLEM)
def test_one_problem_is_reported_with_its_place(broken: Broken, change: tuple[str, str], key: str, said: str) -> None:
    (problem,) = broken(change)
    assert problem.keys_text == key
    assert said in problem.message


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
    with pytest.raises(ProjectError, match=r"analyses\[1\].vertical: the masses resist horizontal motion alone"):
        parse_project(text)
