"""A member under the forces of analyses, followed by hand from its archive."""

from __future__ import annotations

from pathlib import Path

import pytest

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.assess.member_uses import loaded_members
from edesign.assess.sets import HistorySet
from edesign.codes.ec8.action.accelerograms import SET_RULES
from edesign.errors import InputError
from edesign.project import load_project
from edesign.report.archive.loaded_member import loaded_member_data, loaded_member_tables
from edesign.report.archive.tables import overview
from edesign.study.results.recording import coordinate
from edesign.study.run.run import run_project

FRAME = """\
edesign: 1
title: A braced bay
frame:
  bays: [6 m]
  storeys: [4 m]
  columns: [{storeys: all, section: HEB200, material: S275}]
  beams: [{floors: all, section: IPE300, material: S275}]
  braces: [{bays: 1, storeys: all, kind: rising, section: SHS80x5, material: S275}]
materials: {S275: {law: bilinear, E: 210 GPa, fy: 275 MPa, hardening: 0.01}}
loads: {beams: [{floors: all, G: 30 kN/m, Q: 0 kN/m}], gravity: {G: 1, Q: 0.3}}
masses: {directions: horizontal, given: [{lines: all, floors: all, mass: 20 t}]}
design: {}
analyses:
  - {name: gravity, kind: gravity}
  - {name: push, kind: pushover, pattern: uniform, roof_drift: 0.2 %}
"""


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("loaded")
    (folder / "frame.yaml").write_text(FRAME)
    run_project(load_project(folder / "frame.yaml"))
    return folder / "frame.h5"


def test_a_calculation_leads_to_the_archived_use(archive: Path) -> None:
    with open_archive(archive) as opened:
        for name in ("C_A_1", "B_1_1", "D_1_1_r"):
            uses, forces, worked = loaded_member_tables(opened, name)
            assert [row[0] for row in uses.texts] == ["gravity", "push"]
            assert len(forces.rows) == 7 and worked.rows and worked.texts[-1][0] == "utilisation"
            largest = max(float(value) for value in uses.column("largest"))  # type: ignore[arg-type]
            data = loaded_member_data(opened, name, "gravity")
            assert data["analysis"] == "gravity" and float(str(data["utilisation"])) <= largest
            classes = [row[-1] for row in worked.texts if row[0] == "class"]
            assert classes in (
                [],
                ["1"],
            )  # c/t of HEB200 8.4 and 14.9, of IPE300 4.9 and 35, within 9 and 33 to 72 epsilon
            last = data["calculation"][-1]  # type: ignore[index]
            assert last["value"] == pytest.approx(data["utilisation"], rel=1e-6)


def test_the_beam_of_a_gravity_analysis_by_hand(archive: Path) -> None:
    """Moment at the middle: q L2/8 less those at both ends; the forces stand along the beam."""
    with open_archive(archive) as opened:
        forces = loaded_member_data(opened, "B_1_1", "gravity")["forces"]
    assert isinstance(forces, dict)
    M = forces["M_y"]
    assert M[3] == pytest.approx(30e3 * 36.0 / 8.0 + 0.5 * (M[0] + M[-1]), rel=1e-9)
    assert forces["V_z"][-1] - forces["V_z"][0] == pytest.approx(30e3 * 6.0, rel=1e-6)  # on faces to the end


@pytest.mark.parametrize("design", [True, False])
def test_forces_along_a_beam_are_of_one_step(design: bool, tmp_path: Path) -> None:
    """Pushed sidewards, its ends have their largest use in different steps; between them M' = -V holds in each."""
    left_out = ("  braces", "none" if design else "design")
    lines = [line for line in FRAME.splitlines(keepends=True) if not line.startswith(left_out)]
    (tmp_path / "frame.yaml").write_text("".join(lines))
    run_project(load_project(tmp_path / "frame.yaml"))
    with open_archive(tmp_path / "frame.h5") as opened:
        when = opened.group("analyses/push").variables["section_use_at"].values
        beam = opened.group("analyses/push").coords["member"].values.tolist().index("B_1_1")
        forces = loaded_member_data(opened, "B_1_1", "push")["forces"]
        shown = loaded_member_tables(opened, "B_1_1", "push")[1]
    assert isinstance(forces, dict) and when[beam, 0] != when[beam, 1]
    M, V = forces["M_y"], forces["V_z"]
    if design:  # buckling has its largest use in the step of the section at the end
        assert M[0] - M[-1] == pytest.approx(0.5 * (V[0] + V[-1]) * 6.0, abs=1.0)  # kept in single precision
    else:
        assert len(M) == 1 and forces["x_over_L"] == [1.0] and shown.notes[-1].startswith("The other end has")


def test_one_brace_of_a_cross_takes_the_force_of_both(tmp_path: Path) -> None:
    """SHS80x5, 14.7 cm2 by the catalogue: N_pl,Rd = 14.7 x 27.5 = 404 kN; use x N_pl,Rd is the force that is told."""
    text = FRAME.replace("kind: rising", "kind: cross, compression: false")
    (tmp_path / "frame.yaml").write_text(text)
    run_project(load_project(tmp_path / "frame.yaml"))
    with open_archive(tmp_path / "frame.h5") as opened:
        pushed = opened.group("analyses/push")
        uses, forces, worked = loaded_member_tables(opened, "D_1_1_r", "push")
        (row,) = (one for one in loaded_members(HistorySet("", "", {"push": pushed}), SET_RULES) if "_r" in one.name)
    both = 2.0 * float(pushed.variables["brace_axial_force_max"].values[0])
    assert row.N == pytest.approx(both, rel=1e-9) and row.use * 404e3 == pytest.approx(both, rel=5e-3)
    assert uses.column("tension") == [0.0] and float(str(forces.column("N")[0])) == pytest.approx(row.N)
    assert worked.rows


def test_a_beam_that_dampers_halve_in_a_variant(archive: Path, tmp_path: Path) -> None:
    """Beside its uses it is told where it is two halves; with a half where the beam is whole."""
    with open_archive(archive) as opened, ArchiveWriter(tmp_path / "both.h5", opened.view()) as writer:
        whole = opened.group("analyses/gravity")
        whole.attributes["variant"] = "bare"
        writer.write("analyses/bare.gravity", whole)
        halves = opened.group("analyses/gravity")
        halved = Group(attributes=halves.attributes | {"variant": "brb"})
        coordinate(halved, "member", ["C_A_1", "B_1_1_1", "B_1_1_2"], "", "member")
        writer.write("analyses/brb.gravity", halved)
        writer.finish()
    with open_archive(tmp_path / "both.h5") as opened:
        (uses, *_) = loaded_member_tables(opened, "B_1_1")
    assert " ".join(uses.notes).endswith("In brb it is B_1_1_1 and B_1_1_2.")


def test_names_that_are_not_there(archive: Path) -> None:
    with open_archive(archive) as opened, pytest.raises(InputError, match=r"no member is named 'C_A_2'; did you mean"):
        loaded_member_tables(opened, "C_A_2")


def test_projects_without_histories_have_no_tables_of_uses(archive: Path) -> None:
    assert not [table for table in overview(archive) if table.name in ("member_use", "support_forces")]
