"""A building that can turn or slide is told before its first analysis: what moves, and the entry that lets it."""

from __future__ import annotations

import pytest
from building_examples import SMALL, building
from messages import says

from edesign.errors import AnalysisError, InputError
from edesign.project.analysis.analyses import GravityAnalysis
from edesign.space.free_motion import free_motion
from edesign.study.analysis.gravity import run_gravity
from edesign.study.check.check import check_inputs
from edesign.study.check.summary import check_project

GRAVITY = GravityAnalysis(name="gravity", kind="gravity")
HEAD = "columns: [{s"
PINNED = ("IPE300, material: S275}", "IPE300, material: S275, ends: pinned}")
ONE_BAY = (
    "frames: [A, C], bays: 1, kind: cross,",
    "frames: A, bays: 1, kind: cross, section: CHS101.6x5, material: S275}\n"
    "  - {along: x, frames: 1, bays: 1, kind: cross,",
)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        (((HEAD, "supports: {default: {ux: free}}\ncolumns: [{s"),), "supports.default: the building slides along x: "),
        (
            ((HEAD, "supports: {default: {uz: free}}\ncolumns: [{s"),),
            "supports.default: the building moves up and down: ",
        ),
        (
            ((HEAD, "supports: {default: {ux: free, uy: free, rz: free}, A1: {rz: free}}\ncolumns: [{s"),),
            "supports.default: the building turns about the vertical: ",
        ),
        (
            ((HEAD, "supports: pinned\ncolumns: [{s"), PINNED, ONE_BAY),
            "supports: floor 2 turns about the vertical, with a period of ",
        ),
    ],
    ids=["slides", "sinks", "turns", "turns under its loads"],
)
def test_what_moves_is_said_with_its_place(changes: tuple[tuple[str, str], ...], said: str) -> None:
    with pytest.raises(InputError) as error:
        check_inputs(building(SMALL[: SMALL.index("hazard:")], *changes), [GRAVITY])
    message = str(error.value)
    assert message.startswith("building.yaml:5:") and said in message and message.count("building.yaml") == 1


@pytest.mark.parametrize("end", ["hazard:", "design:"], ids=["without a design", "with a design"])
def test_check_refuses_a_mechanism_without_analyses(end: str) -> None:
    text = SMALL if end == "design:" else SMALL[: SMALL.index(end)]
    with pytest.raises(
        InputError, match=r"building\.yaml:5:21: supports\.default: the building slides along x: .*mech"
    ):
        check_project(building(text, (HEAD, "supports: {default: {ux: free}}\ncolumns: [{s")))


def test_a_floor_that_the_elastic_model_lets_turn() -> None:
    said = free_motion(building(SMALL), "it moves freely at rz of the diaphragm of A1.2 [E-CORE-06]")
    assert said == "floor 2 turns about the vertical"


def test_a_building_that_stands() -> None:
    check_inputs(building(SMALL), [GRAVITY])


def test_a_building_that_is_too_weak_is_left_to_its_analyses() -> None:
    check_inputs(building(SMALL, ("G: 4 kN/m^2", "G: 40 kN/m^2")), [GRAVITY])


def test_loads_without_equilibrium_have_their_place_and_one_code() -> None:
    """Unlike a mechanism, it is found when the loads act."""
    gravity = "analyses: [{name: gravity, kind: gravity}]\nhazard:"
    heavy = building(
        SMALL, ("G: 4 kN/m^2", "G: 24 kN/m^2"), ("fy: 275 MPa", "fy: 275 MPa, law: bilinear"), ("hazard:", gravity)
    )
    with pytest.raises(AnalysisError) as error:
        check_project(heavy)
    assert says(str(error.value), "building.yaml:13:3: loads: the first period cannot be found E-GRAV-01")
    assert run_gravity(heavy, GRAVITY).attributes["reason"] in str(error.value)
