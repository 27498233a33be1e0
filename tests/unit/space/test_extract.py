"""Plane frames of a building as project files: what falls to them, and that they are read and analysed."""

from __future__ import annotations

import re
from pathlib import Path
from typing import get_args

import numpy as np
import pytest
from building_examples import ANALYSED, DAMPED, IRREGULAR, SMALL, building

from edesign.errors import InputError
from edesign.frame.building_file import load_building
from edesign.frame.loads import beam_loads, gravity_load, node_loads
from edesign.frame.masses import node_masses
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project import Project, parse_project
from edesign.project.actions.loads import Combination
from edesign.project.building import Building
from edesign.project.building.members import CHEVRONS, BraceKind
from edesign.project.frame.hinges import HingeValues
from edesign.project.notation.names import node_name
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.space.elastic_design import elastic_design
from edesign.space.extract import elastic_use, frame_row, project_text
from edesign.space.extract.selections import runs
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.masses import gravity_factor
from edesign.study.analysis.modal import fundamental_period
from edesign.study.check.summary import check_project

THESIS = Path(__file__).parents[3] / "projects" / "thesis_building"
DIGITS = 1e-5  # of values that are written with six digits
G, Q = Combination(G=1.0, Q=0.0), Combination(G=0.0, Q=1.0)


def extracted(whole: Building, name: str) -> Project:
    return parse_project(project_text(frame_row(whole, space_frame(whole), name)), "frame.yaml", BuildingSections())


@pytest.fixture(scope="module")
def thesis() -> Building:
    return load_building(THESIS / "table_5_2.yaml")


def test_the_interior_frame_of_the_thesis(thesis: Building) -> None:
    """Section 5.3.2 of the thesis: Q 9.6 kN/m; G 23 kN/m; 29.5 t on interior nodes.

    Two thirds of 7.2 m of floor are 21.6 kN/m, and 77.6 kg/m of IPE450 make 22.36. The thesis has 0.6 kN/m and 1 t a
    node more: what two secondary beams a bay weigh (about 36 kg/m), which Table 5.1 does not have.
    """
    project = extracted(thesis, "X2")
    mean_Q, mean_G = (beam_loads(project, factors)["BX_2_2_3"].total(7.2) / 7.2 for factors in (Q, G))
    assert mean_Q == pytest.approx(9.6e3, rel=DIGITS)
    assert mean_G == pytest.approx(22.36e3, rel=1e-3)  # mass of tables: three digits
    mass = node_masses(project)["C2.3"]
    members = 7.2 * (77.6 + 57.1) + 3.5 * 171.1
    assert mass == pytest.approx(51.84e3 * 5.1 / STANDARD_GRAVITY + members, rel=1e-3)
    secondary = 2.0 * 7.2 * 36.1  # IPE270
    assert mass + secondary == pytest.approx(29.5e3, rel=0.02)
    assert mean_G + 2.0 * 36.1 * STANDARD_GRAVITY == pytest.approx(23e3, rel=0.02)
    assert project.frame.column_at["E2", 6].section == "HEB360"
    assert project.frame.released == {f"BX_2_2_{floor}": (True, True) for floor in range(1, 11)}
    assert project.hazard is not None and list(project.hazard.levels) == ["DBE"]


def test_loads_of_secondary_beams_act_at_their_places(thesis: Building) -> None:
    """Two bring 4.5 and 2 kN/m2 of 2.4 m by 7.2 m each to the third points; along the beam there is its weight."""
    project = extracted(thesis, "X2")
    for factors, load in ((G, 4.5e3), (Q, 2.0e3)):
        (first, second) = beam_loads(project, factors)["BX_2_2_3"].points
        assert first == pytest.approx((1.0 / 3.0, load * 2.4 * 7.2), rel=DIGITS)
        assert second == pytest.approx((2.0 / 3.0, load * 2.4 * 7.2), rel=DIGITS)
    assert beam_loads(project, G)["BX_2_2_3"].uniform == pytest.approx(77.6 * STANDARD_GRAVITY, rel=1e-3)


def test_loads_of_a_beam_in_two_halves_act_at_their_places() -> None:
    """Chevrons halve the beam of 5 m: 8 kN at 1 m, in the middle and at 4 m are at 0.4, 1.0 and 0.6 of the halves."""
    loaded = (
        "  self_weight: false\n  beams: [{along: y, frames: A, floors: 1, points: [{at: [1 m, 50 %, 4 m], G: 8 kN}]}]"
    )
    chevrons = SMALL.replace("kind: cross", "kind: chevron").replace("concentric_diagonal", "concentric_v")
    whole = building(chevrons, ("  areas:", f"{loaded}\n  areas:"))
    project = extracted(whole, "YA")
    points = {name: load.points for name, load in beam_loads(project, G).items() if load.points}
    whole_beam, halves = points.pop("BY_A_2_1"), [points[name] for name in sorted(points)]
    assert [at for at, _ in whole_beam] == pytest.approx([0.2, 0.5, 0.8], rel=DIGITS)
    assert [at for half in halves for at, _ in half] == pytest.approx([0.4, 1.0, 0.6], rel=DIGITS)
    assert all(force == pytest.approx(8e3, rel=DIGITS) for half in (whole_beam, *halves) for _, force in half)
    # beams along x carry nothing, so that the node has no load if the force in the middle counts once
    assert node_loads(project, G).get("A1.1", 0.0) == pytest.approx(0.0, abs=1.0)


def test_frames_along_x_make_the_building(thesis: Building) -> None:
    """All four resist, so that their masses and loads are those of the building."""
    frame = space_frame(thesis)
    projects = [extracted(thesis, f"X{i}") for i in range(1, 5)]
    mass = sum(sum(node_masses(project).values()) for project in projects)
    assert mass == pytest.approx(frame.node_mass.sum(), rel=DIGITS)
    weight = sum(gravity_load(project) for project in projects)
    assert weight == pytest.approx(frame.node_mass.sum() * STANDARD_GRAVITY, rel=DIGITS)


def test_a_braced_end_frame_carries_half_of_the_building(thesis: Building) -> None:
    """Frames YB to YD lean on YA and YE by halves, and the period of YA is then that of the thesis' mode 2."""
    project = extracted(thesis, "YA")
    half = 0.5 * space_frame(thesis).node_mass.sum()
    assert sum(node_masses(project).values()) == pytest.approx(half, rel=DIGITS)
    assert project.frame.released["C_L_4"] == (True, True)
    assert "B_4_4" not in project.frame.members
    # Table 5.3: 0.973 s; braces weigh 0.8 % of a floor, P-Delta and rigid columns at their bases are within the rest
    assert fundamental_period(project) == pytest.approx((0.973412,), rel=0.015)


def test_a_small_frame_by_hand() -> None:
    """X2 of 5 m on either side: nodes B 4 kN/m2 x 25 m2; the floor spans along x and brings nothing to its beams."""
    project = extracted(building(SMALL, ("  areas:", "  self_weight: false\n  areas:")), "X2")
    assert beam_loads(project, G) == {} == beam_loads(project, Q)
    assert node_loads(project, G)["B2.1"] == pytest.approx(100e3, rel=DIGITS)
    assert node_loads(project, Q)["A2.2"] == pytest.approx(30e3, rel=DIGITS)
    assert node_masses(project)["C2.2"] == pytest.approx((40e3 + 0.3 * 20e3) / STANDARD_GRAVITY, rel=DIGITS)


def test_a_frame_that_leans_and_the_lever_rule() -> None:
    """YB at 6 m of 10 m: 0.4 of it lean on YA, 0.6 on YC, and both frames make the whole."""
    whole = building(SMALL)
    frame = space_frame(whole)
    first, last = (frame_row(whole, frame, name) for name in ("YA", "YC"))
    assert "by the lever rule, at floor 1 0.4 of YB" in project_text(first) and "0.6 of YB" in project_text(last)
    mass = sum(sum(node_masses(extracted(whole, name)).values()) for name in ("YA", "YC"))
    assert mass == pytest.approx(frame.node_mass.sum(), rel=DIGITS)
    with pytest.raises(InputError, match="frame YB: .*`YA`, `YC` .E-SPACE-05"):
        project_text(frame_row(whole, frame, "YB"))
    named = building(SMALL.replace("S275", "leaning"))
    assert extracted(named, "YA").frame.column_at["L", 1].material == "leaning_columns"
    loose = building(SMALL, ("columns: [", "diaphragms: none\ncolumns: ["))
    assert "Not all floors are diaphragms" in project_text(frame_row(loose, space_frame(loose), "YA"))


def test_live_loads_of_several_categories_count_by_their_psi_2() -> None:
    """Two floors: B with 0.3 on the first, snow with 0 on the second. Q of B stays the characteristic value."""
    areas = (
        "areas: [{floors: 1, G: 4 kN/m^2, Q: 2 kN/m^2, category: B, spans: x}, {floors: 2, G: 3 kN/m^2, Q: 1 kN/m^2, "
    )
    text = SMALL.replace("areas: [{G: 4 kN/m^2, Q: 2 kN/m^2, ", areas).replace(
        "category: B, spans: x}]\nm", "category: snow, spans: x}]\nm"
    )
    project = extracted(building(text, ("from_loads: {}", "from_loads: {Q: {B: 0.3, snow: 0}}")), "X2")
    assert project.loads.gravity == Combination(G=1.0, Q=0.3)
    loads = node_loads(project, Q)
    assert loads["B2.1"] == pytest.approx(50e3, rel=DIGITS) and "B2.2" not in loads


def test_what_the_building_says_of_its_analyses() -> None:
    """Law of the steel, masses that resist vertical motion, and other factors of the gravity loads than psi_2."""
    whole = building(ANALYSED, ("spans: x}]", "spans: x}]\n  gravity: {G: 1.1, Q: 0.24}"))
    project = extracted(whole, "X2")
    assert project.materials["S275"] == whole.steels["S275"]
    assert project.masses is not None and project.masses.directions == "both"
    assert project.loads.gravity == Combination(G=1.1, Q=0.24)


def test_a_frame_says_that_it_lacks_dampers_and_isolators() -> None:
    isolation = (
        "dampers: {laws: {pad: {type: kelvin_voigt, parameters: {k: 1 kN/mm, c: 1 kN*s/m}}}, isolation: {isolators: "
        "[{law: pad}], base: {mass: 20 t, rotation: fixed}, design_displacement: 0.1 m}}\n"
    )

    def head(text: str) -> str:
        whole = building(text)
        return project_text(frame_row(whole, space_frame(whole), "X2"))

    assert "# The building has dampers, tuned masses too, which are not in this file." in head(DAMPED)
    said = "# The frame stands on its supports. The building has isolators too, which are not in this file."
    assert said in head(SMALL + isolation)
    assert "ampers" not in head(SMALL) and "left_in_building" not in head(SMALL)
    wind = "cases: {w: {category: wind, floors: [{floors: 1, x: 10 kN}]}}"
    frame = extracted(building(SMALL, ("loads:\n", f"loads:\n  {wind}\n")), "X2").frame
    assert frame.left_in_building == ("own load cases (w)",)


def test_gravity_loads_of_analyses() -> None:
    """EN 1990, Eq. 6.12b and Table A1.1: psi_2 of offices 0.3, of snow 0; what the file says goes before."""
    of_country, said = building(SMALL), building(SMALL, ("from_loads: {}", "from_loads: {Q: {B: 0.2, snow: 0.1}}"))
    other = building(SMALL, ("spans: x}]", "spans: x}]\n  gravity: {G: 0.9, Q: {B: 0.5}}"))
    for whole, factors in ((of_country, (1.0, 0.3, 0.0)), (said, (1.0, 0.2, 0.1))):
        assert tuple(gravity_factor(whole, category) for category in ("permanent", "B", "snow")) == factors
    assert tuple(gravity_factor(other, category) for category in ("permanent", "B")) == (0.9, 0.5)


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("X1", "11:7: frame X1: .* D1 .*E-SPACE-04"),
        ("X4", " .*`X4`; .* X1 to X3 and YA to YD.*E-NAME-01"),
        ("B2", " .*`B2`.*E-NAME-01"),
        ("", " .*``.*E-NAME-01"),
    ],
)
def test_what_a_project_file_cannot_say(name: str, said: str) -> None:
    whole = building(IRREGULAR)
    with pytest.raises(InputError) as caught:
        project_text(frame_row(whole, space_frame(whole), name))
    assert re.match(f"building.yaml:{said}", str(caught.value))


ENDS = """\
hinges:
  - {beams: {along: x, frames: [1, 2], bays: 2}, parameters: {M_y: 0.2 MN*m, theta_p: 0.02 rad, theta_pc: 0.1 rad,
     theta_u: 0.2 rad, hogging: {M_y: 0.1 MN*m}}}
joints:
  - {columns: {at: A, storeys: 1}, ends: start, stiffness: 30 MN*m/rad, resistance: 90 kN*m}
"""


def test_ends_of_members_are_carried() -> None:
    """Joints of columns turn about their strong axis, so that frames along y have none of them."""
    soft = SMALL.replace("IPE240, material: S275, ends: pinned", "IPE240, material: S275, ends: {end: 20 MN*m/rad}")
    whole = building(soft + ENDS)
    along_x, along_y = extracted(whole, "X1"), extracted(whole, "YA")
    (hinges,) = along_x.hinges
    assert list(along_x.frame.members_in(hinges.beams, None)) == [("BX_1_2_1",) * 2, ("BX_1_2_2",) * 2]
    assert isinstance(hinges.parameters, HingeValues)
    assert (hinges.parameters.M_y, hinges.parameters.hogging.M_y) == (0.2e6, 0.1e6)
    (joint,) = along_x.joints
    assert list(along_x.frame.members_in(None, joint.columns)) == [("C_A1_1",) * 2] and joint.ends == "start"
    (soft_end,) = along_y.joints
    assert soft_end.ends == "end" and soft_end.stiffness == 20e6 and not along_y.hinges
    stiff = building(SMALL + "elements: {rigid_ends: {columns: 0.2 m, beams: 40 %}}\n")
    assert extracted(stiff, "X1").elements.rigid_ends == stiff.elements.rigid_ends
    panels = building(SMALL + "panel_zones: [{at: [A1, B2], floors: 1, doubler: 8 mm}]\n")
    (zones,) = extracted(panels, "X1").panel_zones
    assert str(zones.lines) == "A1" and zones.doubler == 0.008 and not extracted(panels, "YA").panel_zones


def test_a_frame_with_setbacks() -> None:
    """YD stands in the first storey whole, and in the second up to line 2."""
    fixed = IRREGULAR.replace("D1: {uz: 400 MN/m, rx: 30 MN*m/rad, ry: free}", "D1: {ry: free}")
    project = extracted(building(fixed), "YD")
    assert set(project.frame.column_at) == {("D1", 1), ("D2", 1), ("D3", 1), ("D1", 2), ("D2", 2)}
    assert {(bay, floor) for bay, floor in project.frame.beam_at} == {(1, 1), (2, 1), (1, 2)}
    assert project.frame.support("D1") == "fixed" and project.frame.support("D2") == "pinned"
    assert node_name("D3", 2) not in project.frame.nodes and project.frame.n_storeys == 2


def test_a_frame_without_a_member_where_others_end() -> None:
    """The column and the beams of X2 at B2.2 are missing; beams of YB meet there."""
    gone = "missing: {columns: [{at: B2, storeys: 2}], beams: [{along: x, frames: 2, floors: 2}]}\nmaterials: {"
    whole = building(SMALL, ("materials: {", gone))
    with pytest.raises(InputError, match="frame X2: .*`B2.2`.*E-SPACE-05"):
        project_text(frame_row(whole, space_frame(whole), "X2"))


def test_runs_say_where_each_value_stands() -> None:
    values = {(i, s): "a" if i < 3 or s == 2 else "b" for i in range(4) for s in range(1, 4)}
    assert runs(values, range(4), 3, "ABCD".__getitem__) == [
        ("A-C", "[1, 3]", "a"),
        ("D", "[1, 3]", "b"),
        ("all", "2", "a"),
    ]


def test_use_of_the_elastic_design_goes_with_the_frame() -> None:
    """Columns of a bracing along y have 0.3 x 1.1 gamma_ov Omega_y of what E_y brings them (6.7.4(1), 4.3.3.5.1(3))."""
    whole = building(SMALL)
    design = elastic_design(whole)
    found = elastic_use(whole, "x")
    text = project_text(frame_row(whole, space_frame(whole), "X1"), elastic=found)
    read = parse_project(text, "frame.yaml", BuildingSections())
    assert read.design is not None
    of_frame = read.design.elastic_use
    assert set(of_frame) == set(read.frame.members)
    number = {member.name: at for at, member in enumerate(design.frame.members)}
    for name, of in of_frame.items():
        assert of.use == pytest.approx(np.nanmax(design.members.utilisation[number[name]]), rel=1e-3)  # four digits
    braced = {name: of.across for name, of in of_frame.items() if of.across is not None}
    assert {name: across.frames for name, across in braced.items()} == {
        f"C_{line}1_{storey}": (f"Y{line}",) for line in "AC" for storey in (1, 2)
    }
    factor = 0.3 * min(1.1 * 1.25 * max(design.overstrength["y"].Omega, 1.0), design.q["y"])
    for name, across in braced.items():
        N = design.effects.seismic[1, number[name], :, 0].max()
        assert across.N == pytest.approx(factor * N, rel=1e-3)
        assert across.N > 1e3
        of = design.foundations
        at = of.nodes.index(name.removeprefix("C_").removesuffix("_1") + ".0") if name.endswith("_1") else None
        V = None if at is None else 0.3 * of.factor[1, at] * of.seismic[1, at, 2]  # 4.4.2.6(4): gamma_Rd Omega E_F,E
        assert across.V == (None if V is None else pytest.approx(V, rel=1e-3))


@pytest.mark.parametrize("kind", get_args(BraceKind))
def test_frames_on_braces_of_every_kind_pass_their_checks(kind: str) -> None:
    """A use in the elastic design belongs to a member of the frame, where braces halve beams and where they do not."""
    system = "concentric_v" if kind in CHEVRONS else "concentric_diagonal"
    storeys = "storeys: 2, kind: v" if kind == "v" else f"kind: {kind}"  # a V stands on a beam
    whole = building(SMALL.replace("kind: cross", storeys).replace("concentric_diagonal", system))
    text = project_text(frame_row(whole, space_frame(whole), "YA"), elastic=elastic_use(whole, "y"))
    read = parse_project(text, "frame.yaml", BuildingSections())
    assert "frame" in check_project(read)
    assert read.design is not None
    named = {name for name in read.design.elastic_use if name[0] == "D"}
    assert named == {name for name in read.frame.members if name[0] == "D"} != set()


def test_buildings_without_a_design_have_no_use_in_it() -> None:
    assert elastic_use(building(SMALL[: SMALL.index("design:")]), "x") == {}
