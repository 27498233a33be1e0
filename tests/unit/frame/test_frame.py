"""What a project's frame becomes in the core's model; the names follow the grid."""

from __future__ import annotations

import pytest
from unit.frame.recording_model import built, project

from edesign.core import Bilinear, Elastic, MenegottoPinto
from edesign.errors import InputError
from edesign.frame.frame import build_frame
from edesign.frame.hinges import NO_WEB


def test_nodes_and_members_of_the_grid() -> None:
    frame, model = built()
    assert list(frame.nodes) == ["A0", "B0", "C0", "A1", "B1", "C1", "A2", "B2", "C2"]
    assert [call[1:3] for call in model.get("node")][3:6] == [(0.0, 4.0), (6.0, 4.0), (13.5, 4.0)]
    assert [m.name for m in frame.of_kind("column")] == ["C_A_1", "C_B_1", "C_C_1", "C_A_2", "C_B_2", "C_C_2"]
    assert [m.name for m in frame.of_kind("beam")] == ["B_1_1", "B_2_1", "B_1_2", "B_2_2"]
    column, beam = frame.members["C_B_2"], frame.members["B_2_1"]
    assert (column.start, column.end) == ("B1", "B2") and (beam.start, beam.end) == ("B1", "C1")
    call = model.get("element")[column.element]
    assert call[:3] == ("C_B_2", frame.nodes["B1"], frame.nodes["B2"])
    assert call[-1] == {"points": 5, "geometry": "p_delta", "release": (False, False), "breaks": (), "web": NO_WEB}
    assert model.get("element")[beam.element][-1]["geometry"] == "linear"
    assert column.fibres is not None and column.fibres.size == 24
    assert column.outer == (0, 23) and column.points == 5 and column.length == 3.0
    assert (column.section, column.material, beam.bar) == ("HEB260", "S275", None)
    assert [(floor.number, floor.level) for floor in frame.floors] == [(1, 4.0), (2, 7.0)]
    assert frame.floors[1].movers[0] == tuple(((1.0, frame.nodes[name], 0),) for name in ("A2", "B2", "C2"))
    assert frame.floors[0].nodes == ("A1", "B1", "C1") and frame.control == frame.nodes["A2"]
    upper, lower = frame.nodes["B2"], frame.nodes["B1"]
    assert frame.storeys[1].drifts[0][1].ratio == ((1.0 / 3.0, upper, 0), (-1.0 / 3.0, lower, 0))
    assert [at for _, kind, at, _ in frame.storeys[1].shear[0]] == [m.element for m in frame.of_kind("column")[3:]]


def test_each_section_and_material_is_made_once() -> None:
    _, model = built()
    assert len(model.get("fibre_section")) == 2
    assert [call[0] for call in model.get("material")] == [Bilinear(E=210e9, fy=275e6, b=0.01)]
    y, area, material, _ = model.get("fibre_section")[0]
    assert y.size == area.size == 160 and material == 0


def test_supports() -> None:
    frame, model = built(("B: pinned", "B: pinned, C: roller"))
    fixed = {call[0]: call[-1] for call in model.get("fix")}
    assert fixed == {
        frame.nodes["A0"]: {"ux": True, "uy": True, "rz": True},
        frame.nodes["B0"]: {"ux": True, "uy": True, "rz": False},
        frame.nodes["C0"]: {"ux": False, "uy": True, "rz": False},
    }
    assert frame.supports == {"A0": (True, True, True), "B0": (True, True, False), "C0": (False, True, False)}


def test_diaphragms_tie_a_floor_to_its_first_node() -> None:
    frame, model = built(("supports:", "diaphragms: 2\n  supports:"))
    ties = [(call[0], call[1], call[-1]) for call in model.get("tie")]
    only_x = {"ux": True, "uy": False, "rz": False}
    assert ties == [(frame.nodes[name], frame.nodes["A2"], only_x) for name in ("B2", "C2")]


def test_missing_members_take_their_nodes_and_supports_along() -> None:
    gone = "missing: {columns: [{lines: C, storeys: all}, {lines: A, storeys: 2}], beams: [{bays: all, floors: 2}]}"
    frame, model = built(
        ("  columns: [", f"  {gone}\n  columns: ["),
        ("    - {floors: 2, bays: 2, G: 4 kN/m}\n", ""),
        ("  nodes: [{lines: A, floors: 2, G: 50 kN}]\n", ""),
    )
    assert list(frame.nodes) == ["A0", "B0", "A1", "B1", "C1", "B2"]
    assert list(frame.members) == ["C_A_1", "C_B_1", "C_B_2", "B_1_1", "B_2_1"]
    assert list(frame.supports) == ["A0", "B0"]
    assert frame.control == frame.nodes["B2"] and len(frame.storeys[1].drifts[0]) == 1
    assert len(model.get("fix")) == 2


def test_a_load_on_a_place_without_members_is_an_error_that_names_it() -> None:
    gone = "missing: {columns: [{lines: A, storeys: 2}], beams: [{bays: 1, floors: 2}]}"
    changes = (("  columns: [", f"  {gone}\n  columns: ["),)
    with pytest.raises(InputError, match="A2"):
        built(*changes)


def test_releases_and_pin_ended_joints() -> None:
    """A column holds the joint of hinged beams; where nothing holds a joint its rotation is fixed."""
    hinges = "releases: [{beams: {bays: 2, floors: 1}, ends: both}, {columns: {lines: C, storeys: 1-2}, ends: both},"
    hinges += " {beams: {bays: 2, floors: 2}, ends: end}, {beams: {bays: 1, floors: 1}, ends: start}]"
    frame, model = built(("  columns: [", f"  {hinges}\n  columns: ["))
    release = {call[0]: call[-1]["release"] for call in model.get("element")}
    assert release["B_2_1"] == release["C_C_1"] == release["C_C_2"] == (True, True)
    assert release["B_2_2"] == (False, True) and release["B_1_1"] == (True, False)
    assert release["C_A_1"] == (False, False)
    loose = {call[0] for call in model.get("fix") if call[-1]["rz"]}
    assert loose == {frame.nodes[name] for name in ("A0", "C0", "C1", "C2")}


def test_beams_about_the_weak_axis() -> None:
    """I_z of IPE 360 is 1043 cm4 (EN 10365); 16 fibres across a flange leave 1/256, its fillets some 0.5 %."""
    frame, model = built(("section: IPE360, material: S275", "section: IPE360, material: S275, axis: weak"))
    y, area, *_ = model.get("fibre_section")[1]
    assert float(area @ y**2) == pytest.approx(1043e-8, rel=0.01)
    layers = frame.members["B_1_1"].fibres
    assert layers is not None and layers.max() < 0.085


def test_braces() -> None:
    cross = "braces: [{bays: 2, storeys: 1, kind: cross, section: rod, material: weak},"
    cross += " {bays: 1, storeys: 2, kind: falling, section: girder, material: weak}]"
    frame, model = built(("  columns: [", f"  {cross}\n  columns: ["))
    ends = {m.name: (m.start, m.end) for m in frame.of_kind("brace")}
    assert ends == {"D_2_1_r": ("B0", "C1"), "D_2_1_f": ("B1", "C0"), "D_1_2_f": ("A2", "B1")}
    laws = [call[0] for call in model.get("material")]
    calls = {call[0]: call for call in model.get("element")}
    rod, girder = calls["D_2_1_r"], calls["D_1_2_f"]
    assert laws[rod[3]] == Elastic(E=200e9) and rod[4] == pytest.approx(20e-4)  # an elastic section stays elastic
    assert laws[girder[3]] == MenegottoPinto(E=200e9, fy=235e6, b=0.02, R0=20.0, cR1=0.925, cR2=0.15)
    assert girder[4] == pytest.approx(2 * 0.18 * 0.014 + 0.372 * 0.009)


def test_elastic_members_get_exact_stiffness() -> None:
    frame, model = built(
        ("section: HEB260, material: S275", "section: stiff, material: S275"),
        ("section: IPE360, material: S275", "section: girder, material: soft"),
    )
    (ea, ei, _), (girder_ea, girder_ei, _) = model.get("elastic_section")
    assert (ea, ei) == pytest.approx((210e9 * 0.1, 210e9 * 1e-3), rel=1e-14)
    assert girder_ea == pytest.approx(70e9 * (2 * 0.18 * 0.014 + 0.372 * 0.009), rel=1e-12)
    assert girder_ei == pytest.approx(70e9 * (0.18 * 0.4**3 - 0.171 * 0.372**3) / 12, rel=1e-12)
    assert all(member.fibres is None for member in frame.members.values())


def test_gravity_loads_of_the_combination() -> None:
    """G + 0.5 Q: 20 + 5 kN/m, and 4 kN/m more on one beam; local y of a beam points upwards."""
    frame, model = built()
    loads = {call[1]: call[-1] for call in model.get("uniform_load")}
    element = {name: member.element for name, member in frame.members.items()}
    assert loads[element["B_1_1"]] == {"axial": 0.0, "transverse": -25e3}
    assert loads[element["B_2_2"]] == {"axial": 0.0, "transverse": pytest.approx(-29e3)}
    assert len(loads) == 4
    assert [call[:-1] for call in model.get("nodal_load")] == [(frame.gravity, frame.nodes["A2"], 0.0, -50e3, 0.0)]


def test_an_unknown_section_says_where_and_what_is_near() -> None:
    unchecked = project().model_copy(deep=True)
    run = unchecked.frame.columns[0].model_copy(update={"section": "HEB261"})
    changed = unchecked.model_copy(update={"frame": unchecked.frame.model_copy(update={"columns": (run,)})})
    changed.frame.__dict__.pop("members", None)
    changed.frame.__dict__.pop("column_at", None)
    with pytest.raises(InputError, match=r"section HEB261: .*near it .*`HEB260`"):
        build_frame(changed)
