"""The period of an extracted frame is that of its building, whatever resists: frames, diagonals, crosses, chevrons.

The building has one bay along x, so that it is two equal frames along y, and nothing leans or twists. Members with
fibres have no shear deformation; the building is compared without its own, and in one test with it.
"""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import building

from edesign.codes.ec3 import buckling
from edesign.core.space import PROPERTIES
from edesign.errors import InputError
from edesign.frame.loads import gravity_load
from edesign.frame.masses import node_masses
from edesign.frame.sections.building_sections import BuildingSections
from edesign.frame.sections.named_section import cross_section
from edesign.frame.sections.section import CrossSection
from edesign.frame.sections.steel_section import steel_section
from edesign.project import Project, parse_project
from edesign.project.analysis.analyses import GravityAnalysis, PushoverAnalysis
from edesign.project.building import Building
from edesign.space.extract import frame_row, project_text
from edesign.space.structure import model
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.model import space_model
from edesign.study.analysis.gravity import run_gravity
from edesign.study.analysis.pushover import run_pushover
from edesign.study.analysis.structure import make_frame, make_structure

CUT = 0.5 / 256
"""Relative: 16 layers over a wall in place of the whole lower its own moment of inertia by 1/256, and a period by half
of that at most; loads and masses have six digits."""

TWO_FRAMES = """\
edesign_building: 1
title: Two equal frames along y
plan: {x: [7 m], y: [6 m, 5 m]}
storeys: [4 m, 3.5 m, 3 m]
columns: [{section: HEB240, material: S355, strong: y}]
beams:
  - {along: x, section: IPE300, material: S355}
  - {along: y, section: IPE330, material: S355, ends: pinned}
materials: {S355: {fy: 355 MPa}}
loads: {areas: [{G: 5 kN/m^2, Q: 3 kN/m^2, category: B, spans: two_way}]}
masses: {from_loads: {}}
"""
BRACED = "braces: [{along: y, frames: all, bays: 1, section: SHS120x6, material: S355, "


def two_frames(*changes: tuple[str, str], braces: str = "") -> Building:
    text = (BRACED + braces + "}]\nmaterials:") if braces else "materials:"
    return building(TWO_FRAMES, ("materials:", text), *changes)


def extracted(whole: Building, name: str = "YA") -> Project:
    return parse_project(project_text(frame_row(whole, space_frame(whole), name)), "frame.yaml", BuildingSections())


def building_period(whole: Building) -> float:
    """The longest period of the building along y, s."""
    frame = space_frame(whole)
    modes = space_model(frame, whole.materials).modes(frame.node_mass, 6)
    along_y = modes.effective_mass_ratio[:, 1] > 0.3
    return float(modes.period[np.flatnonzero(along_y)[0]])


def frame_period(project: Project) -> float:
    """The first period of the unloaded frame, s."""
    return float(make_structure(project).modes(1).period[0])


def without_shear(monkeypatch: pytest.MonkeyPatch) -> None:
    """Members of buildings do not deform in shear: a shear area of 0 stands for that."""
    whole = model.member_properties

    def rigid_in_shear(*of: object) -> np.ndarray:
        found = whole(*of)  # type: ignore[arg-type]
        found[:, [PROPERTIES.index("A_y"), PROPERTIES.index("A_z")]] = 0.0
        return found

    monkeypatch.setattr(model, "member_properties", rigid_in_shear)


RIGID = ("section: IPE330, material: S355, ends: pinned", "section: IPE330, material: S355")
WEAK = ("strong: y", "strong: x")
TUBES = ("section: HEB240, material: S355, strong: y", "section: RHS250x150x10, material: S355, strong: x")
HINGES = ("storeys: [4 m,", "supports: pinned\nstoreys: [4 m,")
V_ON_A_DIAGONAL = (
    "storeys: 2-3, kind: v}, {along: y, frames: all, bays: 1, section: CHS139.7x6, material: S355, storeys: 1, "
    "kind: rising, compression: true"
)


@pytest.mark.parametrize(
    "whole",
    [
        pytest.param(two_frames(RIGID), id="moment frame"),
        pytest.param(two_frames(RIGID, WEAK), id="moment frame, weak axis"),
        pytest.param(two_frames(RIGID, TUBES), id="moment frame, tubes turned"),
        pytest.param(two_frames(HINGES, braces="kind: cross, compression: true"), id="crosses"),
        pytest.param(two_frames(HINGES, braces="kind: cross"), id="crosses in tension alone"),
        pytest.param(two_frames(braces="kind: chevron"), id="chevrons and columns"),
        pytest.param(two_frames(HINGES, braces="kind: chevron"), id="chevrons"),
        pytest.param(two_frames(HINGES, braces=V_ON_A_DIAGONAL), id="v on a diagonal"),
        pytest.param(two_frames(HINGES, braces="kind: alternating, compression: true"), id="diagonals"),
        pytest.param(two_frames(HINGES, braces="kind: rising"), id="diagonals in tension alone"),
    ],
)
def test_the_period_of_the_frame_is_that_of_the_building(whole: Building, monkeypatch: pytest.MonkeyPatch) -> None:
    without_shear(monkeypatch)
    assert frame_period(extracted(whole)) == pytest.approx(building_period(whole), rel=CUT)


def test_what_shear_deformation_of_beams_and_columns_makes() -> None:
    """A moment frame is softer with it, a braced one is not: the braces have none."""
    moment = two_frames(RIGID)
    assert 0.95 < frame_period(extracted(moment)) / building_period(moment) < 0.99
    braced = two_frames(HINGES, braces="kind: cross")
    assert frame_period(extracted(braced)) == pytest.approx(building_period(braced), rel=CUT)


@pytest.mark.parametrize("section", ["SHS120x6", "RHS150x100x6", "CHS139.7x6"])
def test_extracted_braces_buckle_about_their_weak_axis(section: str) -> None:
    """A diagonal of 6 m by 4 m in storey 1: lambda = L / (93.9 epsilon i) with E = 210 GPa, curve a of hot tubes."""
    whole = two_frames(("section: SHS120x6", f"section: {section}"), braces="kind: cross, compression: true")
    project = extracted(whole)
    bar = next(bar for bar in make_frame(project).bars if bar.name.endswith("_1_1_r"))
    assert bar.strut is not None and bar.section == section
    shape, length = steel_section(section), np.hypot(6.0, 4.0)
    slenderness = length / shape.i_z / (93.9 * np.sqrt(235.0 / 355.0))
    assert bar.strut.slenderness == pytest.approx(slenderness, rel=5e-4)  # 93.9 has three digits
    chi = buckling.reduction_factor(bar.strut.slenderness, "a")
    assert bar.strut.resistance == pytest.approx(chi * shape.A * 355e6, rel=1e-9)


def test_diagonals_that_do_not_count_in_compression() -> None:
    """Each has half its area and no buckling resistance; the file says so by a key."""
    project = extracted(two_frames(braces="kind: cross"))
    assert not project.frame.brace_at[1, 1, "r"].compression
    frame = make_frame(project)
    assert all(bar.strut is None for bar in frame.bars if bar.kind == "brace")
    counts = extracted(two_frames(braces="kind: cross, compression: true"))
    assert all(bar.strut is not None for bar in make_frame(counts).bars)


@pytest.mark.parametrize("section", ["SHS200x10", "RHS300x200x10", "CHS168.3x8", "SHS40x4", "CFSHS100x8"])
@pytest.mark.parametrize("strong", ["x", "y"])
def test_hollow_sections_have_their_area_inertia_and_plastic_modulus(section: str, strong: str) -> None:
    column = f"section: {section}, material: S355, strong: {strong}"
    whole = two_frames(RIGID, ("section: HEB240, material: S355, strong: y", column))
    project = extracted(whole)
    run = project.frame.column_at[project.frame.lines[0], 1]
    assert run.axis == ("strong" if strong == "y" else "weak")
    shape = cross_section(project, section, run.axis)
    assert isinstance(shape, CrossSection)
    steel = steel_section(section)
    assert shape.area == pytest.approx(steel.A, rel=1e-12)
    assert shape.inertia == pytest.approx(steel.I_y if strong == "y" else steel.I_z, rel=1e-12)
    depths, areas = shape.fibres
    assert areas.sum() == pytest.approx(steel.A, rel=1e-12)
    # layers at their centroids have the first moment of the section; only one across the middle lacks some
    assert areas @ abs(depths) == pytest.approx(steel.W_pl_y if strong == "y" else steel.W_pl_z, rel=1e-3)
    # 1/256 of the walls' own is missing, and that of the corners: of the thickest cold formed ones 0.7 %
    assert areas @ depths**2 == pytest.approx(shape.inertia, rel=0.01)


def test_storeys_with_chevrons_are_in_equilibrium() -> None:
    """Pushed to 2 %: the forces on the tops of columns and braces of storey 1 are the base shear; gravity as well."""
    project = extracted(two_frames(braces="kind: chevron"))
    gravity, _, push = project.analyses
    assert isinstance(gravity, GravityAnalysis) and isinstance(push, PushoverAnalysis)
    pushed = run_pushover(project, push)
    assert pushed.attributes["status"] == "completed"
    shear, base = pushed.variables["storey_shear"].values, pushed.variables["base_shear"].values
    scale = float(np.max(np.abs(base)))
    assert shear[:, 0] == pytest.approx(base, abs=1e-5 * scale)  # equilibrium has a tolerance of 1e-7 of end forces
    reactions = run_gravity(project, gravity).variables["reaction_y_final"].values
    assert reactions.sum() == pytest.approx(gravity_load(project), rel=1e-6)


THREE_FRAMES = ("plan: {x: [7 m], ", "plan: {x: [7 m, 7 m], ")


@pytest.mark.parametrize(
    "whole",
    [
        pytest.param(two_frames(THREE_FRAMES, RIGID), id="moment frames"),
        pytest.param(
            two_frames(THREE_FRAMES, braces="kind: chevron").with_values("braces[0].frames", ["A", "C"]),
            id="chevrons in the outer frames",
        ),
        pytest.param(
            two_frames(
                THREE_FRAMES, RIGID, ("columns: [", "setbacks: [{floors: 3, bays: {x: all, y: 1}}]\ncolumns: [")
            ),
            id="moment frames with a setback",
        ),
    ],
)
def test_all_frames_of_a_direction_have_the_period_of_the_building(
    whole: Building, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The middle frame carries twice the mass of the others, and rigid floors make all move alike."""
    without_shear(monkeypatch)
    project = extracted(whole, "Y")
    assert frame_period(project) == pytest.approx(building_period(whole), rel=CUT)
    mass = float(space_frame(whole).node_mass.sum())
    assert sum(node_masses(project).values()) == pytest.approx(mass, rel=1e-5)  # six digits are written
    alone = frame_period(extracted(whole, "YA"))
    assert abs(alone / building_period(whole) - 1.0) > 10 * CUT or whole.braces


def test_only_rigid_floors_tie_frames_in_one_plane() -> None:
    loose = two_frames(RIGID, ("columns: [", "diaphragms: 1-2\ncolumns: ["))
    with pytest.raises(InputError, match="frames along y: .* floor 3 .*E-SPACE-05"):
        extracted(loose, "Y")
