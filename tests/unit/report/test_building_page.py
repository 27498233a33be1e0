"""The report of a building: its sections, its figures, and how formulas are set."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from building_examples import SMALL

from edesign.archive.dataset import Group, Variable
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.frame.building_file import load_building
from edesign.report.archive.document import page_text
from edesign.report.archive.figures import all_figures
from edesign.report.building.checks import idle_sway, member_tables, worked_table, worked_worst
from edesign.report.building.figures.curves import mode_shapes
from edesign.report.building.figures.plans import _alike, _runs
from edesign.report.building.results import BuildingResults
from edesign.report.building.tables.all import remarks
from edesign.report.building.tables.basis import floors_table, joints_table, overstrength_table
from edesign.report.building.tables.other import other_tables
from edesign.report.html.render import formula
from edesign.report.tables.cell import Quantity
from edesign.report.tables.unit import KN
from edesign.space.designed import ElasticDesign
from edesign.study.run.building import run_building

OPEN = SMALL.replace("storeys: [4 m, 3 m]", "storeys: [4 m, 3 m]\ndiaphragms: none")


@pytest.fixture(scope="module")
def ran(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, ElasticDesign]:
    folder = tmp_path_factory.mktemp("page")
    (folder / "small.yaml").write_text(SMALL, encoding="utf-8")
    found = run_building(load_building(folder / "small.yaml"))
    (folder / "small.yaml").unlink()  # the archive is enough
    return found


@pytest.fixture
def results(ran: tuple[Path, ElasticDesign]) -> Iterator[BuildingResults]:
    with open_archive(ran[0]) as archive:
        yield BuildingResults(archive)


def test_the_page_has_all_sections_and_figures(ran: tuple[Path, ElasticDesign]) -> None:
    page = page_text(ran[0])
    anchors = re.findall(r'<section id="([a-z-]+)"', page)
    expected = (
        "building model assumptions warnings structure action natural-modes storeys members steel checks capacity"
    )
    assert anchors == [*expected.split(), "foundations", "others", "combinations", "provenance"]
    figures = re.findall(r'<figure class="picture" id="figure-([A-Za-z0-9_]+)"', page)
    assert figures[0].startswith("model_")
    assert {"plan_1", "building_spectra", "building_modes", "building_storeys", "elevation_X2"} <= set(figures)
    assert page.count("<details>") >= len(set(member.group for member in ran[1].frame.members))
    assert "<sub>b,y,Rd</sub>" in page and "could not be drawn" not in page


def test_a_building_without_rigid_floors_has_its_modes_drawn(tmp_path: Path) -> None:
    (tmp_path / "open.yaml").write_text(OPEN, encoding="utf-8")
    with open_archive(run_building(load_building(tmp_path / "open.yaml"))[0]) as archive:
        assert [name for name, _, _ in mode_shapes(archive)] == ["building_modes"]
        assert any("accidental torsion is left out" in text for text in remarks(BuildingResults(archive)))


def test_loads_of_the_floors_are_those_of_the_file(results: BuildingResults) -> None:
    """G of 4 kN/m2 on 100 m2 and the steel; Q of 2 kN/m2: what `edesign check` says of this building."""
    table = floors_table(results)
    row = dict(zip(table.headers, table.texts[0], strict=True))
    assert (row["floor"], row["Q [kN]"]) == ("2", "200.0") and float(row["G [kN]"]) == pytest.approx(430.9, abs=0.1)
    *floors, whole = table.column("G")
    assert whole == Quantity(pytest.approx(sum(floors), rel=1e-12), KN, 5, beside=True)  # type: ignore[arg-type]


def test_the_least_overstrength_is_omega(results: BuildingResults, ran: tuple[Path, ElasticDesign]) -> None:
    rows = overstrength_table(results).rows
    for column, axis in ((1, "x"), (4, "y")):
        least = min(row[column] for row in rows if row[column] is not None)  # type: ignore[type-var]
        assert least == pytest.approx(ran[1].overstrength[axis].Omega, rel=1e-12)  # type: ignore[index]


def test_the_weakest_joint_of_a_floor(results: BuildingResults, ran: tuple[Path, ElasticDesign]) -> None:
    rows = {(row[0], row[1]): row for row in joints_table(results).rows}
    asked = [joint for joint in ran[1].joints if not joint.exempt]
    worst = min(asked, key=lambda joint: joint.ratio)
    assert rows[1, "x"][5] == pytest.approx(worst.ratio, rel=1e-12)
    assert rows[2, "x"][6] == "exempt"


def test_a_worked_check_ends_with_what_the_table_says(results: BuildingResults) -> None:
    for worst, found in worked_worst(results):
        assert found.steps[-1].value == pytest.approx(worst.utilisation, rel=1e-9)
        assert (found.member, found.check, found.number) == (worst.member, worst.name, worst.combination)
    checks, effects, calculation = member_tables(results, "C_B2_1")
    assert len(checks.rows) == len({row[0] for row in checks.rows}) > 8
    assert [row[0] for row in effects.rows] == ["G", "Q", "E_x", "E_y"]  # an earthquake governs: no sway acts in it
    sway = [row["name"] for row in results.rows("combinations", "combination")].index("1.35 G + 1.5 Q + S_x") + 1
    assert (idle_sway(results, sway), idle_sway(results, 1)) == ({"S_y"}, {"S_x", "S_y"})
    assert "S: sway imperfections; those of other combinations are left out." in effects.notes
    assert calculation.rows[-1][0] == "utilisation"


def test_a_calculation_that_misses_the_utilisation_is_not_shown(results: BuildingResults) -> None:
    utilisation = results.group("members").variables["utilisation"]
    results.group("members").variables["utilisation"] = replace(utilisation, values=1.001 * utilisation.values)
    worked = worked_worst(results)
    assert worked
    for _, found in worked:
        assert not found.steps
        assert "no worked calculation of this check" in worked_table(found).notes[1]


def test_groups_without_a_table_of_their_own_have_one(results: BuildingResults, tmp_path: Path) -> None:
    (panels,) = other_tables(results)
    assert panels.title == "Web panels of columns"
    assert panels.headers[:4] == ["panel", "node", "direction", "shear V_wp,Ed [kN]"]
    assert not any("_doubled" in text for text in (*panels.headers, *panels.notes))
    group = Group(coords={"panel": Variable(("panel",), np.array(["A1.1", "A2.1"]), "", "panel")})
    group.add("V_wp_Ed", ("panel",), np.array([2.0e5, np.inf]), "N", "shear of the panel")
    group.add("field", ("panel", "panel"), np.zeros((2, 2)), "1", "some field")
    with ArchiveWriter(tmp_path / "other.h5", Group(attributes={"kind": "building"})) as writer:
        writer.write("building", Group())
        writer.write("building/panels", group)
        writer.finish({"status": "completed"})
    with open_archive(tmp_path / "other.h5") as archive:
        panels, more = other_tables(BuildingResults(archive))
    assert panels.headers == ["panel", "shear V_wp,Ed [kN]"] and panels.texts == [["A1.1", "200.0"], ["A2.1", "-"]]
    assert more.notes == ["field, by panel, panel: some field"]


def test_figures_are_drawn_as_files(results: BuildingResults) -> None:
    names = [name for name, _, _ in all_figures(results.archive)]
    first = names.index("building_spectra")  # the model stands before
    assert "plan_1" in names[:first] and all(name.startswith(("model_", "plan_")) for name in names[:first])
    assert names[first : first + 3] == ["building_spectra", "building_modes", "building_storeys"]
    assert {name.partition("_")[0] for name in names[first + 3 :]} == {"elevation", "forces"}


def test_plans_of_storeys_that_are_alike_are_one(results: BuildingResults) -> None:
    assert [storeys for storeys, _ in _alike(results)] == [[1, 2]]
    assert _runs([1, 2, 3, 5, 7, 8]) == "1-3, 5, 7-8"


def test_spectra_of_the_archive_are_those_of_the_design(
    results: BuildingResults, ran: tuple[Path, ElasticDesign]
) -> None:
    period = results.values("spectrum", "period")
    for axis in ("x", "y"):
        own = ran[1].response[axis].spectrum.acceleration(period)
        assert np.array_equal(results.values("spectrum", f"design_{axis}"), own)
    assert {0.15, 0.5, 2.0} <= set(period.round(9))  # corners on ground B


@pytest.mark.parametrize(
    ("text", "html"),
    [
        ("chi_y A f_y / gamma_M1", "χ<sub>y</sub> A f<sub>y</sub> / γ<sub>M1</sub>"),
        ("sqrt(A f_y / N_cr,T)", "√(A f<sub>y</sub> / N<sub>cr,T</sub>)"),
        ("lambda_y <= 0.2", "λ̄<sub>y</sub> ≤ 0.2"),
        ("F_b = m lambda", "F<sub>b</sub> = m λ"),
        ("pi^2 E I_z / L_LT^2", "π<sup>2</sup> E I<sub>z</sub> / L<sub>LT</sub><sup>2</sup>"),
        ("0.5 x 2 +- 3 <= 1", "0.5 × 2 ± 3 ≤ 1"),
        ("mass x [%]", "mass x [%]"),
        ("slenderness of DY_A_3_8_f, C_A4_1", "slenderness of DY_A_3_8_f, C_A4_1"),
        ("12.5 cm4", "12.5 cm⁴"),
        ("<b> & theta", "&lt;b&gt; &amp; θ"),
        ("-", "–"),
        ("F = k0 u + c1 |v|^alpha_d", "F = k<sub>0</sub> u + c<sub>1</sub> |v|<sup>α<sub>d</sub></sup>"),
        ("(|F| / Fy)^(-1/(n-1))", "(|F| / F<sub>y</sub>)<sup>−1/(n-1)</sup>"),
        ("node c1.2, A1, k1_left", "node c1.2, A1, k1_left"),
    ],
)
def test_formulas_are_set_in_the_symbols_of_the_codes(text: str, html: str) -> None:
    assert formula(text) == html
