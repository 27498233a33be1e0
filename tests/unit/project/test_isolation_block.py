"""An isolated base in a project file: what is read, and what is refused where."""

from __future__ import annotations

from pathlib import Path

import pytest
from messages import says

from edesign.errors import InputError
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project.loader import parse_project
from edesign.project.project import Project
from edesign.project.reading.problems import ProjectError
from edesign.study.check.summary import check_project

CASE = Path(__file__).parents[2] / "cases" / "isolated_frame" / "project.yaml"
ISOLATOR = "- {lines: all, law: pendulum, vertical: {stiffness: 1500 kN/mm, uplift: true}}"
BASE = "base: {G: 36 kN/m, Q: 12 kN/m, beams: {section: grid, material: concrete}}"


def project(*changes: tuple[str, str]) -> Project:
    text = CASE.read_text(encoding="utf-8")
    for old, new in changes:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return parse_project(text, CASE, BuildingSections())


def test_what_is_read() -> None:
    read = project()
    isolation = read.isolation
    assert isolation is not None and read.dampers is not None
    assert isolation.design_displacement == pytest.approx(0.2)
    assert [str(item.lines) for item in isolation.beside] == ["[A, D]", "A"]
    assert read.dampers.used_laws == {"pendulum", "oil", "moat"}
    assert not read.dampers.none


@pytest.mark.parametrize(
    ("old", "new", "place", "message"),
    [
        (ISOLATOR, "- {lines: A-C, law: pendulum}", "isolators", "`D` E-ISOL-01"),
        (ISOLATOR, f"{ISOLATOR}\n      - {{lines: B, law: pendulum}}", "isolators[1].lines", "E-ISOL-04"),
        (ISOLATOR, "- {lines: A-F, law: pendulum}", "isolators[0].lines", "E-NAME-01"),
        (ISOLATOR, "- {lines: all, law: pendlum}", "isolators[0].law", "`pendulum` E-NAME-01"),
        (ISOLATOR, "- {lines: all, law: pendulum, vertical: free}", "isolators[0].vertical", "E-KEY-03"),
        (ISOLATOR, "- {lines: all, law: pendulum, scale: 2}", "isolators[0].scale", "E-KEY-03"),
        (ISOLATOR, "- {lines: all, law: oil, weight: law}", "isolators[0].weight", "E-KEY-03"),
        (ISOLATOR, "- {lines: all, law: pendulum, layers: 3}", "isolators[0].layers", "`prototype` E-DAMPER-03"),
        (ISOLATOR, "- {lines: all, law: pendulum, weight: varying}", "isolators[0].weight", "`vertical` E-KEY-02"),
        ("law: oil}", "law: ol}", "beside[0].law", "`oil` E-NAME-01"),
        (BASE, "base: {rotation: fixed}", "base", "E-MODAL-02"),
        (BASE, "base: {G: 36 kN/m}", "base", "`beams` E-ISOL-02"),
        (
            BASE,
            "base: {G: 36 kN/m, rotation: free, beams: {section: IPE500, material: S355}}",
            "base.rotation",
            "E-KEY-03",
        ),
        (
            BASE,
            "base: {G: 36 kN/m, beams: {section: IPE500, material: S35}}",
            "base.beams.material",
            "`S355` E-NAME-01",
        ),
        (
            BASE,
            "base: {G: 36 kN/m, beams: {section: IPE5000, material: S355}}",
            "base.beams.section",
            "`IPE500` E-NAME-01",
        ),
        ("design_displacement: 200 mm", "design_displacement: 0 mm", "design_displacement", "E-VALUE-02"),
    ],
)
def test_refused_at_its_place(old: str, new: str, place: str, message: str) -> None:
    with pytest.raises(ProjectError) as caught:
        project((old, new))
    said = f"dampers.isolation.{place}: {message}"
    [line] = [one for one in str(caught.value).splitlines() if says(one, said)]
    assert line.startswith(f"{CASE}:")


def test_what_else_does_not_go_with_it() -> None:
    gravity = "{name: gravity, kind: gravity, variant: isolated}"
    push = "{name: push, kind: pushover, pattern: uniform, roof_drift: 2 %}"
    with pytest.raises(ProjectError, match=r"analyses\[2\]\.kind.*E-ISOL-03"):
        project((gravity, push))
    assert project((gravity, push.replace("}", ", dampers: false}"))).analyses[2].kind == "pushover"
    with pytest.raises(ProjectError, match=r"frame\.leaning_column.*E-FRAME-04"):
        project(("  diaphragms: all", "  diaphragms: all\n  leaning_column: {G: 100 kN}"))
    strained = "kind: modal, modes: 3, damper_strain: 50 %, variant: isolated"
    with pytest.raises(ProjectError, match=r"analyses\[0\]\.damper_strain.*E-DAMPER-01"):
        project(("kind: modal, modes: 3, variant: isolated", strained))


def test_isolators_without_stiffness_at_rest() -> None:
    with pytest.raises(InputError, match=r" A0\.ux.*isolators.*E-CORE-06"):
        check_project(project((ISOLATOR, "- {lines: all, law: oil}")))


def test_check_describes_the_isolation() -> None:
    reported = check_project(project())
    assert "4 isolators `pendulum`, 2 dampers `oil`, 1 damper `moat`" in reported["dampers"]
    assert reported["mass"].endswith("; of the base 76.72 t")
    assert reported["period"].endswith("under gravity, on its isolators at 200 mm")
