"""Whatever is wrong with soils and footings is reported with line, column and key."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from messages import says

from edesign.errors import InputError
from edesign.frame.frame import build_frame
from edesign.frame.sections.profiles import profile_names
from edesign.project import Problem, parse_project
from edesign.project.frame.foundations import FootingSupport
from edesign.study.check.check import check_inputs

Broken = Callable[..., list[Problem]]

SOIL = "{density: 1900 kg/m^3, shear_wave_velocity: 200 m/s, poisson: 0.4, damping: 3 %}"
AT = "analyses:\n"
FOOTINGS = {
    "no such soil": ("{soil: «cly, length: 2 m, width: 2 m}", "soil", "`clay` E-NAME-01"),
    "no length": ("{soil: clay, width: 2 m}", "length", "E-KEY-02"),
    "length in tons": ("{soil: clay, length: «2 t, width: 2 m}", "length", "mass E-UNIT-02"),
    "unknown key": ("{soil: clay, length: 2 m, width: 2 m, «widht: 2 m}", "widht", "`width` E-KEY-01"),
    "unknown formula": ("{soil: clay, length: 2 m, width: 2 m, formula: «gazeta}", "formula", "`gazetas` E-VALUE-03"),
    "walls above ground": (
        "{soil: clay, length: 2 m, width: 2 m, embedment: 1 m, wall_contact: «1.5 m}",
        "wall_contact",
        "E-VALUE-04",
    ),
    "bearing without uplift": (
        "{soil: clay, length: 2 m, width: 2 m, «bearing_resistance: 300 kPa}",
        "bearing_resistance",
        "`uplift: true` E-FRAME-06",
    ),
    "density of nothing": ("{soil: clay, length: 2 m, width: 2 m, «density: 2.4 t/m^3}", "density", "E-MODAL-02"),
    "sides below zero": ("{soil: clay, length: «-2 m, width: 2 m}", "length", "E-VALUE-02"),
}
SOILS = {
    "no stiffness": ("«{density: 1900 kg/m^3, poisson: 0.4, damping: 3 %}", "", "`shear_wave_velocity` E-KEY-03"),
    "two stiffnesses": (
        "«{density: 1900 kg/m^3, poisson: 0.4, damping: 3 %, shear_modulus: 60 MPa, shear_wave_velocity: 200 m/s}",
        "",
        "E-KEY-03",
    ),
    "no damping": ("«{density: 1900 kg/m^3, poisson: 0.4, shear_modulus: 60 MPa}", "", "`damping` E-KEY-02"),
    "poisson": (
        "{density: 1900 kg/m^3, poisson: «0.6, shear_modulus: 60 MPa, damping: 3 %}",
        "poisson",
        "0.5 E-VALUE-02",
    ),
    "code": (
        "{density: 1900 kg/m^3, poisson: 0.4, shear_modulus: 60 MPa, strain: {code: «ec8}}",
        "strain.code",
        "`en1998_5` E-VALUE-03",
    ),
    "critical": (
        "{density: 1900 kg/m^3, poisson: 0.4, shear_modulus: 60 MPa, damping: «100 %}",
        "damping",
        "E-VALUE-02",
    ),
}


@pytest.mark.parametrize(("entry", "key", "said"), FOOTINGS.values(), ids=FOOTINGS.keys())
def test_a_wrong_footing(broken: Broken, entry: str, key: str, said: str) -> None:
    problems = broken(
        ("B: pinned", f"B: {{«footing: {entry}}}" if "E-KEY-02" in said else f"B: {{footing: {entry}}}"),
        (AT, f"soils: {{clay: {SOIL}}}\n{AT}"),
    )
    assert len(problems) == 1
    assert f"frame.supports.B.footing.{key}" in str(problems[0]) and says(str(problems[0]), said)


@pytest.mark.parametrize(("entry", "key", "said"), SOILS.values(), ids=SOILS.keys())
def test_a_wrong_soil(broken: Broken, entry: str, key: str, said: str) -> None:
    problems = broken((AT, f"soils:\n  clay: {entry}\n{AT}"))
    assert len(problems) == 1
    assert f"soils.clay{'.' * bool(key)}{key}" in str(problems[0]) and says(str(problems[0]), said)


def test_a_footing_beside_springs_is_refused(broken: Broken) -> None:
    entry = "B: {footing: {soil: clay, length: 2 m, width: 2 m}, «rotation: fixed}"
    problems = broken(("B: pinned", entry), (AT, f"soils: {{clay: {SOIL}}}\n{AT}"))
    assert "frame.supports.B.rotation" in str(problems[0])


def test_footings_are_read_in_si(small: str) -> None:
    footing = "B: {footing: {soil: clay, length: 2 m, width: 180 cm, embedment: 1 m}}"
    project = parse_project(small.replace("B: pinned", footing).replace(AT, f"soils: {{clay: {SOIL}}}\n{AT}"))
    support = project.frame.support("B")
    assert isinstance(support, FootingSupport)
    assert (support.footing.width, support.footing.contact) == (1.8, 1.0)
    assert list(project.frame.footings) == ["B"]


def test_a_soil_beyond_the_table_is_reported_at_its_place(small: str) -> None:
    soil = SOIL.replace("damping: 3 %", "strain: {code: en1998_5, acceleration: 0.4 g}")
    text = small.replace("B: pinned", "B: {footing: {soil: clay, length: 2 m, width: 2 m}}")
    project = parse_project(text.replace(AT, f"soils: {{clay: {soil}}}\n{AT}"), profiles=profile_names())
    with pytest.raises(InputError, match=r"project.yaml:\d+:\d+: soils.clay.strain.* 0.3 g.*E-EC8-05"):
        build_frame(project)


@pytest.mark.parametrize("sides", ["length: 1e200 m, width: 2 m", "length: 2 m, width: 1e-200 m"])
def test_absurd_sides_are_reported_at_their_place(small: str, sides: str) -> None:
    text = small.replace("B: pinned", f"B: {{footing: {{soil: clay, {sides}}}}}")
    said = r"project.yaml:6:\d+: frame.supports.B.footing.\w+: .* is beyond what a length can be"
    with pytest.raises(InputError, match=said):
        parse_project(text.replace(AT, f"soils: {{clay: {SOIL}}}\n{AT}"), profiles=profile_names())


def test_a_mechanism_on_footings_is_reported_at_its_place(small: str) -> None:
    """A soil so soft that nothing holds the column bases: the period that footings are taken at is not found."""
    soil = SOIL.replace("200 m/s", "1e-6 m/s")
    text = small.replace("{default: fixed, B: pinned}", "{default: {footing: {soil: clay, length: 2 m, width: 2 m}}}")
    project = parse_project(text.replace(AT, f"soils: {{clay: {soil}}}\n{AT}"), profiles=profile_names())
    with pytest.raises(InputError, match=r"project.yaml:\d+:\d+: frame.*E-CORE-06"):
        check_inputs(project, [])
