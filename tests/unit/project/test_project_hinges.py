"""Whatever is wrong with hinges, joints and springs at supports is reported with line, column and key."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from messages import says

from edesign.errors import InputError
from edesign.project import Problem, ProjectError, parse_project
from edesign.project.frame.supports import SupportSprings

Broken = Callable[..., list[Problem]]

VALUES = "{M_y: 300 kN*m, theta_p: 0.02 rad, theta_pc: 0.1 rad, theta_u: 0.3 rad}"
AT = "analyses:\n"
WRONG = {
    "moment without unit": (
        "hinges",
        "{beams: {floors: 1}, parameters: {M_y: «300, theta_p: 0.02 rad, theta_pc: 0.1 rad, theta_u: 1 rad}}",
        "parameters.M_y",
        "E-UNIT-01",
    ),  # fmt: skip # noqa: E501
    "unknown value": (
        "hinges",
        "{beams: {floors: 1}, parameters: {M_y: 1 N*m, «M_yy: 3 N*m, theta_p: 1 rad, theta_pc: 1 rad, theta_u: 2 rad}}",
        "parameters.M_yy",
        "`M_y` E-KEY-01",
    ),  # fmt: skip # noqa: E501
    "unknown set": (
        "hinges",
        "{beams: {floors: 1}, parameters: «lignos_krawinkler}",
        "parameters",
        "`lignos_krawinkler_2011` E-VALUE-03",
    ),  # fmt: skip # noqa: E501
    "beams and columns": (
        "hinges",
        f"«{{beams: {{floors: 1}}, columns: {{storeys: 1}}, parameters: {VALUES}}}",
        "",
        "hinges[0] E-KEY-03",
    ),  # fmt: skip # noqa: E501
    "no such floor": (
        "hinges",
        f"{{beams: {{floors: «9}}, parameters: {VALUES}}}",
        "beams.floors",
        "E-NAME-01",
    ),  # fmt: skip # noqa: E501
    "regression of columns": (
        "hinges",
        "{columns: {storeys: 1}, parameters: «lignos_krawinkler_2011}",
        "parameters",
        "E-KEY-03",
    ),  # fmt: skip # noqa: E501
    "reduced column": (
        "hinges",
        f"{{columns: {{storeys: 1}}, parameters: {VALUES}, «reduced_section: {{a: 1 mm, b: 1 mm, c: 1 mm}}}}",
        "reduced_section",
        "E-FRAME-05",
    ),  # fmt: skip # noqa: E501
    "weaker at capping": (
        "hinges",
        f"{{beams: {{floors: 1}}, parameters: {VALUES[:-1]}, M_c_ratio: «0.9}}}}",
        "parameters.M_c_ratio",
        "E-VALUE-02",
    ),  # fmt: skip # noqa: E501
    "ultimate too soon": (
        "hinges",
        "{beams: {floors: 1}, parameters: {M_y: 1 kN*m, theta_p: 0.02 rad, theta_pc: 0.1 rad, theta_u: «0.01 rad}}",
        "parameters.theta_u",
        "E-VALUE-04",
    ),  # fmt: skip # noqa: E501
    "hogging column": (
        "hinges",
        f"{{columns: {{storeys: 1}}, parameters: {VALUES[:-1]}, «hogging: {{M_y: 1 kN*m}}}}}}",
        "parameters.hogging",
        "E-FRAME-05",
    ),  # fmt: skip # noqa: E501
    "ultimate too soon in hogging": (
        "hinges",
        f"{{beams: {{floors: 1}}, parameters: {VALUES[:-1]}, hogging: {{theta_u: «1 mrad}}}}}}",
        "parameters.hogging.theta_u",
        "0.001 0.02 E-VALUE-04",
    ),  # fmt: skip # noqa: E501
    "plastic beyond ultimate in hogging": (
        "hinges",
        f"{{beams: {{floors: 1}}, parameters: {VALUES[:-1]}, hogging: {{theta_p: «0.5 rad}}}}}}",
        "parameters.hogging.theta_p",
        "0.3 E-VALUE-04",
    ),  # fmt: skip # noqa: E501
    "no loss": (
        "hinges",
        f"{{beams: {{floors: 1}}, parameters: {VALUES[:-1]}, M_c_ratio: 1, M_r_ratio: «1, hogging: {{D: 0.5}}}}}}",
        "parameters.M_r_ratio",
        "E-VALUE-04",
    ),  # fmt: skip # noqa: E501
    "no loss in hogging": (
        "hinges",
        f"{{beams: {{floors: 1}}, parameters: {VALUES[:-1]}, M_r_ratio: 1, hogging: {{M_c_ratio: «1}}}}}}",
        "parameters.hogging.M_c_ratio",
        "E-VALUE-04",
    ),  # fmt: skip # noqa: E501
    "no line": ("panel_zones", "{lines: «K, floors: 1}", "lines", "E-NAME-01"),
    "no thickness": ("panel_zones", "{floors: 1, doubler: «8 kN}", "doubler", "force E-UNIT-02"),
    "no stiffness": ("joints", "«{beams: {floors: 1}}", "stiffness", "E-KEY-02"),
    "joint of another dimension": (
        "joints",
        "{beams: {floors: 1}, stiffness: «3 kN/m}",
        "stiffness",
        "E-UNIT-02",
    ),  # fmt: skip # noqa: E501
    "hardening of an elastic joint": (
        "joints",
        "{beams: {floors: 1}, stiffness: 3 MN*m/rad, «hardening: 1 %}",
        "hardening",
        "E-KEY-03",
    ),  # fmt: skip # noqa: E501
}
SUPPORTS = {
    "unknown direction": ("{«turning: fixed}", "turning", "`rotation` E-KEY-01"),
    "neither word nor stiffness": ("{rotation: «loose}", "rotation", "`fixed` `free` E-VALUE-01"),
    "translation in moments": ("{vertical: «3 MN*m/rad}", "vertical", "E-UNIT-02"),
    "uplift that hardens": (
        "{vertical: {stiffness: 3 kN/mm, resistance: 1 kN, uplift: true, «hardening: 1 %}}",
        "vertical.hardening",
        "E-FRAME-06",
    ),  # fmt: skip # noqa: E501
    "elastic that hardens": (
        "{rotation: {stiffness: 3 MN*m/rad, «hardening: 1 %}}",
        "rotation.hardening",
        "E-KEY-03",
    ),  # fmt: skip # noqa: E501
}


@pytest.mark.parametrize(("what", "entry", "key", "said"), WRONG.values(), ids=WRONG.keys())
def test_a_wrong_hinge_or_joint(broken: Broken, what: str, entry: str, key: str, said: str) -> None:
    problems = broken((AT, f"{what}:\n  - {entry}\n{AT}"))
    assert len(problems) == 1
    assert str(problems[0]).count(f"{what}[0]{'.' * bool(key)}{key}") and says(str(problems[0]), said)


@pytest.mark.parametrize(("entry", "key", "said"), SUPPORTS.values(), ids=SUPPORTS.keys())
def test_a_wrong_spring_at_a_support(broken: Broken, entry: str, key: str, said: str) -> None:
    problems = broken(("B: pinned", f"B: {entry}"))
    assert len(problems) == 1
    assert f"frame.supports.B.{key}" in str(problems[0]) and says(str(problems[0]), said)


def test_a_released_end_has_no_hinge(small: str) -> None:
    release = "  releases: [{beams: {floors: 1}, ends: end}]\n  columns:"
    text = small.replace("  columns:", release, 1).replace(
        AT, f"hinges: [{{beams: {{floors: 1}}, parameters: {VALUES}}}]\n{AT}"
    )
    with pytest.raises(ProjectError, match=r"hinges\[0\].* B_1_1 .*E-FRAME-05"):
        parse_project(text)
    parse_project(text.replace(f"parameters: {VALUES}", f"ends: start, parameters: {VALUES}"))


@pytest.mark.parametrize(
    ("rigid", "entry"),
    [
        ("beams: 1", f"hinges: [{{«beams: {{floors: 1}}, ends: start, parameters: {VALUES}}}]"),
        ("columns: 0.2 m", "joints: [{«columns: {storeys: 1}, stiffness: 60 MN*m/rad}]"),
        ("columns: 50 %", "panel_zones: [«{floors: all}]"),
    ],
)
def test_members_with_rigid_ends_have_nothing_else_there(broken: Broken, rigid: str, entry: str) -> None:
    problems = broken((AT, f"elements: {{rigid_ends: {{{rigid}}}}}\n{entry}\n{AT}"))
    assert says(str(problems[0]), "`elements: rigid_ends E-KEY-03")


def test_supports_are_read_in_si(small: str) -> None:
    springs = "{rotation: 2 MN*m/rad, vertical: {stiffness: 3 kN/mm, uplift: true}, horizontal: free}"
    support = parse_project(small.replace("B: pinned", f"B: {springs}")).frame.support("B")
    assert isinstance(support, SupportSprings)
    assert support.rotation == 2e6 and support.horizontal == "free"
    assert not isinstance(support.vertical, (str, float)) and support.vertical.stiffness == 3e6


@pytest.mark.parametrize(
    ("hinges", "said"),
    [
        ("distance: 4 m", "E-HINGE-01"),
        ("reduced_section: {a: 0.1 m, b: 0.2 m, c: 0.2 m}", "E-HINGE-03"),
    ],
)
def test_hinges_that_do_not_fit_their_member(small: str, hinges: str, said: str) -> None:
    from edesign.frame.frame import build_frame
    from edesign.frame.sections.profiles import profile_names

    entry = f"hinges: [{{beams: {{floors: 1}}, parameters: lignos_krawinkler_2011, {hinges}}}]\n{AT}"
    project = parse_project(small.replace(AT, entry), profiles=profile_names())
    with pytest.raises(InputError, match=said):
        build_frame(project)
