"""An isolated base in a building file: what is read, and what is refused where."""

from __future__ import annotations

from pathlib import Path

import pytest
from building_examples import ISOLATED, building
from messages import says

from edesign.errors import InputError
from edesign.exchange.formats import find_format
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project.building import parse_building
from edesign.project.dampers.device_names import names_of_dampers
from edesign.project.reading.problems import FileProblems
from edesign.study.analysis.structure import make_frame
from edesign.study.check.summary import check_project

BASE = "base: {G: 5 kN/m^2, beams: {section: HEB300, material: S275}}"


def test_what_is_read() -> None:
    whole = building(ISOLATED)
    isolation = whole.isolation
    assert isolation is not None and whole.dampers is not None
    assert isolation.isolators[0].under(("A1", "B1", "C3"), whole.grid) == ("A1", "C3")
    assert isolation.beside[0].axes == ("x",) and isolation.isolators[1].axes == ("x", "y")
    named = names_of_dampers(whole.grid, whole.dampers)
    frame = make_frame(whole, dampers=True)
    assert frame.isolated is not None
    assert {device.name for device in frame.devices} == set(named)
    assert {"I_A1_x", "I_A1_y", "I_B2_y", "G_C3_x"} <= set(named) and len(named) == 2 * 9 + 2
    assert [isolator.name for isolator in frame.isolated.isolators][:2] == ["I_A1", "I_A2"]
    assert check_project(whole)["dampers"] == (
        "6 isolators `lead`, 3 isolators `dish`, 2 dampers `oil` at the base, mass of the base 50.99 t"
    )
    assert frame.mass == pytest.approx(sum(make_frame(whole).masses.values()) + 5e3 * 100.0 / 9.80665, rel=1e-9)


@pytest.mark.parametrize(
    ("old", "new", "place", "message"),
    [
        ("      - {at: B, law: dish}\n", "", "isolators", "`B1` `B2` `B3` `ux: free, uy: free` E-ISOL-01"),
        ("{at: B, law: dish}", "{at: A1-B3, law: dish}", "isolators[1].at", "E-ISOL-04"),
        ("{at: B, law: dish}", "{at: [B, D4], law: dish}", "isolators[1].at[1]", "C3 E-NAME-01"),
        ("law: dish}", "law: dsh}", "isolators[1].law", "`dish` E-NAME-01"),
        ("law: dish}", "law: oil}", "isolators[1].law", "viscous_power E-ISOL-05"),
        ("law: dish}", "law: worn}", "isolators[1].law", "effects E-ISOL-05"),
        ("law: dish}", "law: dish, weight: varying}", "isolators[1].weight", "`vertical` E-KEY-02"),
        ("law: dish}", "law: dish, vertical: free}", "isolators[1].vertical", "E-KEY-03"),
        ("direction: x, law", "law", "beside[0].direction", "E-KEY-02"),
        (BASE, "base: {rotation: fixed}", "base", "E-MODAL-02"),
        (BASE, "base: {mass: 50 t}", "base", "`beams` E-ISOL-02"),
        (BASE, f"{BASE[:-1]}, rotation: free}}", "base.rotation", "E-KEY-03"),
        (BASE, "base: {G: 5 kN/m^2, Q: 1 kN/m^2, rotation: free}", "base.category", "E-KEY-02"),
        (BASE, BASE.replace("material: S275", "material: S27"), "base.beams.material", "`S275` E-NAME-01"),
        (BASE, BASE.replace("HEB300", "HEB301"), "base.beams.section", "`HEB300` E-NAME-01"),
    ],
)
def test_refused_at_its_place(old: str, new: str, place: str, message: str) -> None:
    assert ISOLATED.count(old) == 1, old
    with pytest.raises(FileProblems) as caught:
        parse_building(ISOLATED.replace(old, new), "building.yaml", BuildingSections())
    said = f"dampers.isolation.{place}: {message}"
    lines = [one for one in str(caught.value).splitlines() if says(one, said)]
    assert len(lines) == 1, str(caught.value)
    assert lines[0].startswith("building.yaml:")


def test_a_floor_that_the_ground_holds_above_isolators_is_refused() -> None:
    with pytest.raises(FileProblems, match=r"restrained_floors: the ground holds a floor above .*E-ISOL-01"):
        building(ISOLATED.replace("columns: [", "restrained_floors: [{floors: 1}]\ncolumns: [", 1))


def test_a_footing_below_an_isolator_is_refused() -> None:
    soil = "soils: {sand: {density: 1900 kg/m^3, shear_wave_velocity: 180 m/s, poisson: 0.3, damping: 5 %}}\n"
    footing = "supports: {A1: {footing: {soil: sand, length: 2 m, width: 2 m, embedment: 0.5 m}}}\n"
    with pytest.raises(FileProblems, match=r"dampers\.isolation\.isolators: line A1 .*E-ISOL-01"):
        building(ISOLATED.replace("columns: [", soil + footing + "columns: [", 1))


def test_what_else_does_not_go_with_it() -> None:
    push = "{name: push, kind: pushover, pattern: uniform, direction: x, roof_drift: 2 %}"
    gravity = "{name: gravity, kind: gravity}"
    with pytest.raises(FileProblems, match=r"analyses\[0\]\.kind.*E-ISOL-03"):
        building(ISOLATED.replace(gravity, push))
    assert building(ISOLATED.replace(gravity, push.replace("}", ", dampers: false}"))).analyses[0].kind == "pushover"


def test_laws_that_are_known_late() -> None:
    """A law of a file is not known to the checks: the model refuses it where it is used."""
    whole = building(ISOLATED)
    assert whole.dampers is not None and whole.isolation is not None
    one, other = whole.isolation.isolators
    late = whole.isolation.model_copy(update={"isolators": (one, other.model_copy(update={"law": "oil"}))})
    whole = whole.with_dampers(whole.dampers.model_copy(update={"isolation": late}))
    with pytest.raises(InputError, match=r"isolators\[1\].*one direction alone.*E-ISOL-05"):
        make_frame(whole, dampers=True)


def test_isolators_that_opensees_lacks() -> None:
    """A pendulum under its weight of gravity; friction alone, or the weight of the moment, it has."""

    def translated(law: str) -> str:
        script = Path("model.py")
        return find_format(script).translate(building(ISOLATED.replace("law: dish}", law)), script, False).files[script]

    with pytest.raises(InputError, match=r"dampers\.laws\.dish: I_B1_x: .*`weight: varying`.*E-OPS-01"):
        translated("law: dish}")
    assert translated("law: dish, weight: varying, vertical: 400 kN/mm}").count('"singleFPBearing"') == 3
    assert translated("law: lead}").count('"elastomericBearingPlasticity"') == 9
