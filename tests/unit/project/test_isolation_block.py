"""An isolated base in a project file: what is read, and what is refused where."""

from __future__ import annotations

from pathlib import Path

import pytest

from edesign.building.sections.building_sections import BuildingSections
from edesign.errors import InputError
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
        (ISOLATOR, "- {lines: A-C, law: pendulum}", "isolators", "line `D` has no isolator and would hold the base"),
        (ISOLATOR, f"{ISOLATOR}\n      - {{lines: B, law: pendulum}}", "isolators[1].lines", "has an isolator already"),
        (ISOLATOR, "- {lines: A-F, law: pendulum}", "isolators[0].lines", "there is no line F"),
        (ISOLATOR, "- {lines: all, law: pendlum}", "isolators[0].law", "did you mean `pendulum`"),
        (ISOLATOR, "- {lines: all, law: pendulum, vertical: free}", "isolators[0].vertical", "carries the column"),
        (ISOLATOR, "- {lines: all, law: pendulum, scale: 2}", "isolators[0].scale", "say `weight: law`"),
        (ISOLATOR, "- {lines: all, law: oil, weight: law}", "isolators[0].weight", "need no weight"),
        (ISOLATOR, "- {lines: all, law: pendulum, layers: 3}", "isolators[0].layers", "no `prototype`"),
        (
            ISOLATOR,
            "- {lines: all, law: pendulum, weight: varying}",
            "isolators[0].weight",
            "`vertical` has a stiffness",
        ),
        ("law: oil}", "law: ol}", "beside[0].law", "did you mean `oil`"),
        (BASE, "base: {rotation: fixed}", "base", "the base has no mass"),
        (BASE, "base: {G: 36 kN/m}", "base", "how do the column bases turn? with `beams`"),
        (
            BASE,
            "base: {G: 36 kN/m, rotation: free, beams: {section: IPE500, material: S355}}",
            "base.rotation",
            "turn with the `beams`",
        ),
        (BASE, "base: {G: 36 kN/m, beams: {section: IPE500, material: S35}}", "base.beams.material", "`S355`"),
        (BASE, "base: {G: 36 kN/m, beams: {section: IPE5000, material: S355}}", "base.beams.section", "IPE5000"),
        ("design_displacement: 200 mm", "design_displacement: 0 mm", "design_displacement", "greater than zero"),
    ],
)
def test_refused_at_its_place(old: str, new: str, place: str, message: str) -> None:
    with pytest.raises(ProjectError) as caught:
        project((old, new))
    [line] = [one for one in str(caught.value).splitlines() if message in one]
    assert f"dampers.isolation.{place}: " in line
    assert line.startswith(f"{CASE}:")


def test_what_else_does_not_go_with_it() -> None:
    gravity = "{name: gravity, kind: gravity, variant: isolated}"
    push = "{name: push, kind: pushover, pattern: uniform, roof_drift: 2 %}"
    with pytest.raises(ProjectError, match=r"analyses\[2\]\.kind: a pushover of an isolated building"):
        project((gravity, push))
    assert project((gravity, push.replace("}", ", dampers: false}"))).analyses[2].kind == "pushover"
    with pytest.raises(ProjectError, match=r"frame\.leaning_column: a leaning column stands on the ground"):
        project(("  diaphragms: all", "  diaphragms: all\n  leaning_column: {G: 100 kN}"))
    strained = "kind: modal, modes: 3, damper_strain: 50 %, variant: isolated"
    with pytest.raises(ProjectError, match=r"analyses\[0\]\.damper_strain: isolators count at a deformation"):
        project(("kind: modal, modes: 3, variant: isolated", strained))


def test_isolators_without_stiffness_at_rest() -> None:
    with pytest.raises(InputError, match=r"moves freely at A0\.ux.*isolators must have a stiffness at rest"):
        check_project(project((ISOLATOR, "- {lines: all, law: oil}")))


def test_check_describes_the_isolation() -> None:
    reported = check_project(project())
    assert "4 isolators `pendulum`, 2 dampers `oil`, 1 damper `moat`" in reported["dampers"]
    assert reported["mass"].endswith("; of the base 76.72 t")
    assert reported["period"].endswith("under gravity, on its isolators at 200 mm")
