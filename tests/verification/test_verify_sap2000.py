"""Models as SAP2000's text: a solver makes of the tables alone what edesign computes, and they come back whole."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from verification.sap2000_solver import Solved
from verification.structures import channel

from edesign.core import Analysis
from edesign.exchange.formats import find_format
from edesign.exchange.sap2000.translate import take_model
from edesign.frame.building_file import load_building
from edesign.frame.frame import build_frame
from edesign.frame.project_file import load_project
from edesign.project.building.building import Building
from edesign.project.project import Project
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.model import space_model
from edesign.study.analysis.dampers import device_laws

OWN = 1e-8
"""Two solutions of one linear system: 1e-16 times its condition, 1e7 with columns that are much stiffer along than
across."""
BACK = 1e-9
"""Files that come back have twelve digits."""

FRAME = """\
edesign: 1
title: Two bays, two storeys
frame:
  bays: [6 m, 5 m]
  storeys: [4 m, 3 m]
  supports: {default: fixed, B: pinned, C: {horizontal: fixed, vertical: 300 MN/m, rotation: 20 MN*m/rad}}
  diaphragms: 1
  columns:
    - {storeys: all, section: HEB300, material: S275}
    - {lines: B, storeys: 2, section: HEB300, material: S275, axis: weak}
  beams: [{floors: all, section: IPE400, material: S275}]
  braces:
    - {bays: 2, storeys: 1, kind: chevron, section: SHS120x8, material: S275}
    - {bays: 1, storeys: 2, kind: rising, section: own, material: S275, compression: false}
  releases: [{beams: {bays: 1, floors: 2}, ends: start}, {columns: {lines: A, storeys: 2}, ends: end}]
sections: {own: {area: 12 cm^2}}
materials: {S275: {law: bilinear, E: 210 GPa, fy: 275 MPa}}
fibres: {fillets: true}
loads:
  beams:
    - {floors: all, G: 20 kN/m, Q: 8 kN/m}
    - {floors: 1, points: [{at: [1/3], G: 30 kN}], partial: [{start: 1 m, end: 3 m, G: [2 kN/m, 6 kN/m]}]}
  columns: [{lines: A, storeys: all, G: 1.5 kN/m}]
  nodes: [{lines: B, floors: 2, G: 40 kN}]
  gravity: {G: 1.0, Q: 0.0}
masses: {from_loads: {G: 1.0, Q: 0.3}}
elements: {geometry: {columns: linear}}
analyses: [{name: gravity, kind: gravity}]
"""
BUILDING = """\
edesign_building: 1
title: Two storeys with a setback
plan: {x: [6 m, 4 m], y: [5 m, 5 m]}
storeys: [4 m, 3 m]
setbacks: [{floors: 2, bays: [{x: 1, y: all}]}]
supports: {default: fixed, C: pinned, A1: {rx: 50 MN*m/rad, ry: 80 MN*m/rad}}
columns:
  - {section: HEB240, material: S275, strong: x}
  - {at: B, section: HEB240, material: S275, strong: y}
beams:
  - {along: x, section: IPE300, material: S275}
  - {along: y, section: IPE270, material: S275, ends: pinned}
  - {along: x, frames: 2, section: IPE300, material: S275, ends: {start: 40 MN*m/rad, end: rigid}}
braces:
  - {along: y, frames: [A, C], bays: 1, storeys: 1, kind: chevron, section: SHS120x8, material: S275}
  - {along: y, frames: [A, B], bays: 1, storeys: 2, kind: cross, section: SHS100x5, material: S235}
materials: {S275: {fy: 275 MPa}, S235: {fy: 235 MPa}}
loads:
  areas:
    - {floors: 1, G: 4 kN/m^2, Q: 2 kN/m^2, category: B, spans: x, secondary_beams: 2}
    - {floors: 2, G: 3 kN/m^2, Q: 1 kN/m^2, category: H, spans: two_way}
  perimeter: [{floors: 1, G: 1.2 kN/m}]
  nodes: [{at: B2, floors: 1, G: 20 kN}]
masses: {from_loads: {G: 1.0, Q: {B: 0.3, H: 0}}}
"""


def frame_results(project: Project) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray], np.ndarray]:
    """Displacements (ux, uy) of the nodes and reactions (ux, uy, rz) under the gravity loads, and periods unloaded."""
    periods = Analysis(build_frame(project).model).modes(4).period
    built = build_frame(project)
    channels = [channel("displacement", n, k, f"{name} {k}") for name, n in built.nodes.items() for k in (0, 1)]
    from edesign.core.response import Channel

    channels += [Channel(f"{name} r{k}", built.reaction(name, k)) for name in built.supports for k in (0, 1, 2)]
    found = Analysis(built.model, tolerance=1e-12).static(built.gravity, channels=channels)
    last = {name: float(found.values[name][-1]) for name in (c.name for c in channels)}
    return (
        {name: np.array([last[f"{name} 0"], last[f"{name} 1"]]) for name in built.nodes},
        {name: np.array([last[f"{name} r{k}"] for k in (0, 1, 2)]) for name in built.supports},
        periods,
    )


def building_results(building: Building) -> tuple[dict[str, dict[str, np.ndarray]], dict[str, np.ndarray], np.ndarray]:
    """Displacements of the nodes by load case, reactions of the first, and periods."""
    space = space_frame(building)
    model = space_model(space, building.materials)
    from edesign.core.space import Points

    found, reactions = {}, {}
    for name, case in space.cases.items():
        points = Points(np.zeros(len(case.point_member), int), case.point_member, case.point_position, case.point_force)
        static = model.static(case.nodal[None], case.uniform[None], points)
        found[name] = dict(zip(space.node_names, static.displacements[0], strict=True))
        reactions = reactions or dict(zip(space.node_names, static.reactions[0], strict=True))
    return found, reactions, model.modes(space.node_mass).period


def close(found: np.ndarray, wanted: np.ndarray, share: float) -> None:
    """Values alike within a share of the largest one of their kind."""
    assert np.abs(np.subtract(found, wanted)).max() <= share * np.abs(wanted).max()


@pytest.fixture()
def project(tmp_path: Path) -> Project:
    (tmp_path / "frame.yaml").write_text(FRAME)
    return load_project(tmp_path / "frame.yaml")


@pytest.fixture()
def building(tmp_path: Path) -> Building:
    (tmp_path / "building.yaml").write_text(BUILDING)
    return load_building(tmp_path / "building.yaml")


def test_the_tables_of_a_frame_alone_give_its_results(tmp_path: Path) -> None:
    """Of elastic steel: fibres of sections that may yield have a second moment of area of their own, 0.1 % less."""
    (tmp_path / "frame.yaml").write_text(
        FRAME.replace("law: bilinear, E: 210 GPa, fy: 275 MPa", "law: elastic, E: 210 GPa")
    )
    project = load_project(tmp_path / "frame.yaml")
    text = find_format(tmp_path / "x.s2k").translate(project, tmp_path / "x.s2k").files[tmp_path / "x.s2k"]
    solved = Solved(text)
    displacements, reactions, periods = frame_results(project)
    of_tables = solved.displacements("G")
    close([of_tables[n][[0, 2]] for n in displacements], np.array(list(displacements.values())), OWN)
    found = solved.reactions("G")
    close([found[n][[0, 2]] for n in ("A0", "B0")], [reactions[n][:2] / 1e3 for n in ("A0", "B0")], OWN)
    assert found["A0"][4] == pytest.approx(-reactions["A0"][2] / 1e3, rel=OWN)  # about Y, which points into the plane
    close(solved.periods()[:4], periods, OWN)


def test_the_tables_of_a_building_alone_give_its_results(building: Building, tmp_path: Path) -> None:
    text = find_format(tmp_path / "x.s2k").translate(building, tmp_path / "x.s2k").files[tmp_path / "x.s2k"]
    solved = Solved(text)
    cases, reactions, periods = building_results(building)
    assert set(cases) == {"G", "self_weight", "Q_B", "Q_H"}
    for name, displacements in cases.items():
        of_tables = solved.displacements(name)
        close([of_tables[n][:3] for n in displacements], [u[:3] for u in displacements.values()], OWN)
    found = solved.reactions(next(iter(cases)))
    close([found[n][:3] for n in ("B1.0", "C2.0")], [reactions[n][:3] / 1e3 for n in ("B1.0", "C2.0")], OWN)
    close(solved.periods(), periods, OWN)


def test_a_frame_comes_back_whole(project: Project, tmp_path: Path) -> None:
    path = tmp_path / "x.s2k"
    path.write_text(find_format(path).translate(project, path).files[path], newline="")
    taken = take_model(path, tmp_path / "back.yaml")
    (tmp_path / "back.yaml").write_text(taken.text)
    assert taken.kind == "project"
    for found, wanted in zip(frame_results(load_project(tmp_path / "back.yaml")), frame_results(project), strict=True):
        if isinstance(found, dict):
            assert set(found) == set(wanted)
            found, wanted = ([values[name] for name in sorted(values)] for values in (found, wanted))
        close(np.array(found), np.array(wanted), BACK)


def test_a_building_comes_back_whole(building: Building, tmp_path: Path) -> None:
    path = tmp_path / "x.s2k"
    path.write_text(find_format(path).translate(building, path).files[path], newline="")
    taken = take_model(path, tmp_path / "back.yaml")
    (tmp_path / "back.yaml").write_text(taken.text)
    assert taken.kind == "building"
    back, first = building_results(load_building(tmp_path / "back.yaml")), building_results(building)
    assert set(back[0]) == set(first[0])
    for case in first[0]:
        close(*(np.array([r[0][case][n] for n in sorted(first[0][case])]) for r in (back, first)), BACK)
    close(back[2], first[2], BACK)
    # what a second translation writes is the same text, but for digits: the names are those of the grid
    again = find_format(path).translate(load_building(tmp_path / "back.yaml"), path).files[path]
    assert again.count("\r\n") == path.read_bytes().count(b"\r\n")


DAMPERS = """\
dampers:
  laws:
    fluid: {type: viscous_power, parameters: {c: 400 kN*(s/m)^0.5, alpha: 0.5}}
    oil: {type: maxwell, parameters: {c0: 900 kN*s/m, lambda: 0.02 s}}
    elastomer: {type: kelvin_voigt, parameters: {k: 5 kN/mm, c: 300 kN*s/m}}
  devices:
    - {kind: rising, bays: 1, storeys: 1, law: fluid, scale: 1.5, brace: {stiffness: 200 kN/mm}}
    - {kind: falling, bays: 2, storeys: 2, law: oil, number: 2, brace: {stiffness: 90 kN/mm}}
    - {kind: nodes, nodes: [B1, A2], law: elastomer}
"""


def test_dampers_become_links_and_dampers_again(tmp_path: Path) -> None:
    """Springs in series: 1 / k = lambda / c0 + 1 / brace, with 2 x 45 MN/m = 90 MN/m beside the brace of 90 MN/m."""
    (tmp_path / "frame.yaml").write_text(FRAME.replace("analyses:", f"{DAMPERS}analyses:"))
    path = tmp_path / "x.s2k"
    made = find_format(path).translate(load_project(tmp_path / "frame.yaml"), path)
    path.write_text(made.files[path], newline="")
    # a spring of SAP2000 without dashpot in series carries gravity loads, which dampers of edesign are set in under
    assert [text for text in made.left_out if text.startswith(("dampers set in", "stiffness of dampers"))] == [
        "stiffness of dampers in the modes: links with dashpots in series have none there",
        "dampers set in under the gravity loads: the links N_B1_A2 carry a share of these",
    ]
    links = {r["Link"]: r for r in Solved(path.read_text()).t["LINK PROPERTY DEFINITIONS 04 - DAMPER"]}
    power, maxwell = links.values()
    assert [float(power[k]) for k in ("TransK", "TransC", "CExp")] == pytest.approx([2e5, 600.0, 0.5], rel=1e-12)
    assert [float(maxwell[k]) for k in ("TransK", "TransC", "CExp")] == pytest.approx([4.5e4, 1800.0, 1.0], rel=1e-12)
    (linear,) = Solved(path.read_text()).t["LINK PROPERTY DEFINITIONS 02 - LINEAR"]
    assert [float(linear[k]) for k in ("TransKE", "TransCE")] == pytest.approx([5e3, 300.0], rel=1e-12)
    (tmp_path / "back.yaml").write_text(take_model(path, tmp_path / "back.yaml").text)
    back = load_project(tmp_path / "back.yaml")
    built = build_frame(back, laws=device_laws(back))
    found = {device.values.law: device.values.values for device in built.devices}
    assert found["kelvin_voigt"] == pytest.approx((5e6, 3e5), rel=1e-11)
    of_power = {device.values.values for device in built.devices if device.values.law == "maxwell_power"}
    np.testing.assert_allclose(sorted(of_power), [(6e5, 0.5, 2e8), (1.8e6, 1.0, 4.5e7)], rtol=1e-11)


def test_spectra_are_functions_in_g(building: Building, tmp_path: Path) -> None:
    """EN 1998-1, Table 3.2, ground B: S = 1.2, T_B = 0.15, T_C = 0.5, T_D = 2 s; plateau 2.5 S a_g, S a_g at 0 s."""
    hazard = "hazard: {code: ec8-2004, a_gR: 2.4 m/s^2, ground: B, spectrum: 1, levels: {DBE: {gamma_I: 1.0}}}\n"
    (tmp_path / "building.yaml").write_text(BUILDING + hazard)
    path = tmp_path / "x.s2k"
    text = find_format(path).translate(load_building(tmp_path / "building.yaml"), path).files[path]
    rows = Solved(text).t["FUNCTION - RESPONSE SPECTRUM - USER"]
    assert {r["Name"] for r in rows} == {"DBE"} and rows[0]["FuncDamp"] == "0.05"
    T, a = np.array([[float(r["Period"]), float(r["Accel"])] for r in rows]).T
    top = 2.5 * 1.2 * 2.4 / 9.80665
    assert a[0] == pytest.approx(top / 2.5, rel=1e-12) and a.max() == pytest.approx(top, rel=1e-12)
    # between the points a program interpolates linearly: within 0.1 % of the falling branches
    for period, wanted in ((0.3, top), (0.777, top * 0.5 / 0.777), (3.21, top * 0.5 * 2.0 / 3.21**2)):
        assert np.interp(period, T, a) == pytest.approx(wanted, rel=1e-3)
