"""Beams with which a slab acts: their stiffness is multiplied, in the design, in analyses, in plane frames."""

from __future__ import annotations

import math

import numpy as np
import pytest
from building_examples import SMALL, building, changed, design_of, number_of

from edesign.core import Analysis
from edesign.core.space import PROPERTIES
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project import parse_project
from edesign.project.building import Building, BuildingError
from edesign.space.extract import frame_row, project_text
from edesign.space.nonlinear import build_building
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.model import member_properties, space_model
from edesign.study.analysis.structure import Structure, make_structure

FACTOR = "{along: x, section: IPE300, material: S275, stiffness_factor: 2.5}"
STIFF = changed(SMALL, ("{along: x, section: IPE300, material: S275}", FACTOR))
ELASTIC = ("S275: {fy: 275 MPa}", "S275: {fy: 275 MPa, law: elastic}")


def periods(of: Building) -> np.ndarray:
    """Of the model of analyses, s."""
    built = build_building(of)
    return np.asarray(2.0 * math.pi / Structure(built, Analysis(built.model)).modes(6).omega)


def elastic_periods(of: Building) -> np.ndarray:
    """Of the model of the design without shear deformation, s."""
    frame = space_frame(of)
    properties = member_properties(frame, of.materials)
    properties[:, [PROPERTIES.index("A_y"), PROPERTIES.index("A_z")]] = 0.0
    model = space_model(frame, of.materials)
    model.change_sections(np.arange(len(frame.members)), properties)
    return np.asarray(model.modes(frame.node_mass).period)


def test_the_design_and_analyses_are_as_stiff() -> None:
    """Elastic beams exactly; fibres within what 32 of them miss of the second moment of area."""
    exact = elastic_periods(building(STIFF, ELASTIC))
    assert periods(building(STIFF, ELASTIC)) == pytest.approx(exact[:6], rel=1e-9)
    assert periods(building(STIFF)) == pytest.approx(exact[:6], rel=1e-9)
    assert exact[0] < 0.9 * elastic_periods(building(SMALL))[0]


def test_a_factor_is_a_larger_second_moment_of_area() -> None:
    whole, factored = (building(text) for text in (SMALL, STIFF))
    of = [member_properties(space_frame(file), file.materials) for file in (whole, factored)]
    ratio = of[1] / np.where(of[0] == 0.0, 1.0, of[0])
    number = number_of(space_frame(whole), "BX_1_1_1")
    assert ratio[number, PROPERTIES.index("I_y")] == pytest.approx(2.5)
    ratio[[member.name.startswith("BX") for member in space_frame(whole).members], PROPERTIES.index("I_y")] /= 2.5
    assert ratio[of[0] > 0.0] == pytest.approx(1.0)


def test_the_strength_is_that_of_the_steel() -> None:
    """Fibres yield at f_y / (2.5 E); checks use the section, and the design says so."""
    built = build_building(building(STIFF))
    steel = built.members["BX_1_1_1"].steel
    assert (steel.E, steel.fy) == pytest.approx((2.5 * 210e9, 275e6))
    found = design_of(STIFF)
    (note,) = (note for note in found.notes if "stiffness_factor" in note)
    assert "`BX_1_1_1`" in note and "steel section alone" in note
    plain = design_of(SMALL)
    kinds = [of.members.members[of.members.kinds[number_of(of.frame, "BX_1_1_1")]] for of in (plain, found)]
    assert kinds[0].constants == kinds[1].constants


def test_plane_frames_taken_out_are_as_stiff() -> None:
    """All frames along x, elastic, without shear deformation. The building twists with its first mode, by 3e-5."""
    of = building(STIFF, ELASTIC)
    project = parse_project(project_text(frame_row(of, space_frame(of), "X")), "frame.yaml", BuildingSections())
    beam = project.frame.beams[0]
    assert beam.material == "S275_x2.5" and project.materials[beam.material].E == pytest.approx(2.5 * 210e9)
    frame = space_frame(of)
    model = space_model(frame, of.materials)
    along_x = np.argmax(model.modes(frame.node_mass).effective_mass_ratio[:, 0])
    assert make_structure(project).modes(1).period[0] == pytest.approx(elastic_periods(of)[along_x], rel=1e-4)


@pytest.mark.parametrize("value", ["0", "20", "1.5 m"])
def test_what_is_refused(value: str) -> None:
    with pytest.raises(BuildingError, match="stiffness_factor"):
        building(STIFF, ("stiffness_factor: 2.5", f"stiffness_factor: {value}"))
