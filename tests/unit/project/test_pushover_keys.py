"""Keys of pushovers that are wrong: the place, what was seen, what is allowed."""

from __future__ import annotations

import pytest
from building_examples import ANALYSED, building
from messages import says
from unit.study.frames import project
from unit.study.test_target_displacements import HAZARD, PORTAL

from edesign.project import ProjectError
from edesign.project.analysis.analyses import PushoverAnalysis
from edesign.study.check.advice import pattern_warnings
from edesign.study.plan.plan import make_plan, pushover_parts

HEAD = PORTAL.partition("analyses:")[0].replace("mass: 1 t", "mass: 10 t")
WITH = HEAD + HAZARD.replace("@a@", "1 g")


def text(pushover: str, head: str = WITH) -> str:
    return f"{head}analyses:\n  - {{name: push, kind: pushover, {pushover}}}\n"


def plan(pushover: str) -> list[str]:
    return [task.name for task in make_plan(project(text(pushover)))]


def test_what_pushovers_stand_for() -> None:
    assert plan("pattern: uniform, roof_drift: 1 %") == ["push"]
    assert plan("pattern: [uniform, {modes: 2}, {mode: 2}, {floors: [1]}], roof_drift: 1 %") == [
        "push.uniform",
        "push.modes_2",
        "push.mode_2",
        "push.floors",
    ]
    assert plan("pattern: uniform, direction: both, targets: [n2, asce41], levels: MCE") == [
        "push.right",
        "push.right.n2.MCE",
        "push.right.asce41.MCE",
        "push.left",
        "push.left.n2.MCE",
        "push.left.asce41.MCE",
    ]
    assert plan("pattern: {floors: [1]}, targets: fema356") == ["push", "push.fema356.DBE", "push.fema356.MCE"]


def test_accidental_eccentricity_is_missed() -> None:
    """EN 1998-1, 4.3.3.4.2.2(2)P, asks for it with targets of the N2 method; plane frames have none."""

    def missed(more: str) -> list[str]:
        pushover = "[first_mode, {floors: [1, 2]}], direction: all, roof_drift: 2 %"
        whole = building(ANALYSED, (pushover, f"[uniform, first_mode], direction: x, {more}"))
        return pattern_warnings([one for one in whole.analyses if isinstance(one, PushoverAnalysis)])

    (said,) = missed("targets: n2")
    assert says(said, "4.3.3.4.2.2(2)P `eccentricity`")
    assert missed("targets: n2, eccentricity: [0, +y]") == missed("targets: fema356") == []


def test_what_pushovers_of_buildings_stand_for() -> None:
    """Directions and positions are in the names where there are several."""

    def names(direction: str) -> list[str]:
        whole = building(ANALYSED, ("[first_mode, {floors: [1, 2]}], direction: all", f"uniform, {direction}"))
        (spec,) = (one for one in whole.analyses if isinstance(one, PushoverAnalysis))
        return [part.name for part in pushover_parts(spec, ("DBE",))]

    assert names("direction: x+") == ["push"]
    assert names("direction: y") == ["push.y+", "push.y-"]
    assert names("direction: x-, eccentricity: +y") == ["push"]
    assert names("direction: x+, eccentricity: [0, +x+y], targets: n2") == [
        "push.0",
        "push.0.n2.DBE",
        "push.+x+y",
        "push.+x+y.n2.DBE",
    ]
    both = [f"push.{way}.{at}" for way in ("x+", "x-", "y+", "y-") for at in ("+x+y", "-x-y")]
    assert names("direction: all, eccentricity: [+x+y, -x-y]") == both


@pytest.mark.parametrize(
    ("pushover", "head", "message"),
    [
        ("pattern: uniform", WITH, "analyses[0].roof_drift `targets` E-KEY-02"),
        ("pattern: unifrom, roof_drift: 1 %", WITH, "analyses[0].pattern `uniform` E-VALUE-03"),
        ("pattern: [], roof_drift: 1 %", WITH, "analyses[0].pattern E-VALUE-01"),
        ("pattern: [uniform, uniform], roof_drift: 1 %", WITH, "analyses[0].pattern[1] E-NAME-02"),
        ("pattern: {mode: 1, modes: 2}, roof_drift: 1 %", WITH, "analyses[0].pattern `floors` E-VALUE-01"),
        ("pattern: {}, roof_drift: 1 %", WITH, "analyses[0].pattern `floors` E-VALUE-01"),
        ("pattern: {mode: 0}, roof_drift: 1 %", WITH, "analyses[0].pattern.mode E-VALUE-02"),
        ("pattern: {modes: 1}, roof_drift: 1 %", WITH, "analyses[0].pattern.modes E-VALUE-02"),
        ("pattern: {shape: 1}, roof_drift: 1 %", WITH, "analyses[0].pattern.shape E-KEY-01"),
        ("pattern: {floors: [1, 2]}, roof_drift: 1 %", WITH, "analyses[0].pattern E-VALUE-04"),
        ("pattern: {floors: [0]}, roof_drift: 1 %", WITH, "analyses[0].pattern E-VALUE-04"),
        ("pattern: {floors: [-1]}, roof_drift: 1 %", WITH, "floors[0]"),
        ("pattern: {modes: 2}, roof_drift: 1 %", HEAD, "analyses[0].pattern `hazard` E-HAZ-05"),
        ("pattern: {mode: 2}, targets: n2", WITH, "analyses[0].pattern E-PUSH-03"),
        ("pattern: uniform, targets: n2", HEAD, "analyses[0].targets `hazard` `levels` E-HAZ-05"),
        ("pattern: uniform, targets: asce42", WITH, "analyses[0].targets `asce41` E-VALUE-03"),
        ("pattern: uniform, targets: [n2, n2]", WITH, "analyses[0].targets[1] E-NAME-02"),
        ("pattern: uniform, targets: n2, levels: DBF", WITH, "analyses[0].levels `DBE` E-NAME-01"),
        ("pattern: uniform, targets: n2, site_class: D", WITH, "analyses[0].site_class `asce41` E-PUSH-03"),
        ("pattern: uniform, roof_drift: 1 %, levels: DBE", WITH, "analyses[0].levels E-PUSH-03"),
        ("pattern: uniform, roof_drift: 1 %, damping: 10 %", WITH, "analyses[0].damping E-PUSH-03"),
        ("pattern: uniform, roof_drift: 1 %, direction: up", WITH, "analyses[0].direction E-VALUE-03"),
        ("pattern: uniform, targets: n2, damping: 5", WITH, "damping"),
        ("pattern: uniform, roof_drift: 1e-300", WITH, "analyses[0].roof_drift 1e-06 E-VALUE-02"),
        ("pattern: uniform, roof_drift: 60 %", WITH, "analyses[0].roof_drift 31.2 E-VALUE-02"),
    ],
)
def test_wrong_keys(pushover: str, head: str, message: str) -> None:
    written = text(pushover, head)
    place = written[: written.index("- {name")].count("\n") + 1
    with pytest.raises(ProjectError) as caught:
        project(written)
    line = str(caught.value).splitlines()[0]
    assert says(line, message)
    assert line.startswith(f"project.yaml:{place}:")


@pytest.mark.parametrize(
    ("pattern", "missing"),
    [
        ("uniform", "a modal one such as `first_mode` is missing"),
        ("first_mode", "`uniform` is missing"),
        ("[uniform, triangular]", ""),
        ("{floors: [1]}", "`uniform` and a modal one such as `first_mode` is missing"),
    ],
)
def test_patterns_that_en_1998_asks_for(pattern: str, missing: str) -> None:
    found = pattern_warnings(project(text(f"pattern: {pattern}, targets: [n2, asce41]")).analyses)
    assert [line.partition("; ")[2] for line in found] == ([missing] if missing else [])
    assert pattern_warnings(project(text(f"pattern: {pattern}, targets: asce41")).analyses) == []
