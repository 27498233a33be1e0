"""The steel of a building as lists, and diagrams of its internal forces: against sums by hand, and closed forms."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from building_examples import SMALL
from unit.report.figure_archive import TEXT as FRAME

from edesign.archive.reader import open_archive
from edesign.frame.building_file import load_building
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project.loader import parse_project
from edesign.report.building.figures.force_diagrams import along_of, force_diagrams
from edesign.report.building.results import BuildingResults
from edesign.report.building.tables.steel_list import (
    beside_table,
    doublers_table,
    every_member_table,
    steel_list_table,
)
from edesign.report.html.lettering import faults
from edesign.report.inputs.steel_list import steel_tables
from edesign.report.inputs.variant_frames import VariantFrames
from edesign.study.run.building import run_building

PRICED = f"{SMALL}  select: {{objective: cost, prices: {{default: 2, HEB: 3}}, prices_each: {{doubler: 100}}}}\n"


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> Iterator[BuildingResults]:
    folder = tmp_path_factory.mktemp("steel")
    (folder / "small.yaml").write_text(PRICED, encoding="utf-8")
    with open_archive(run_building(load_building(folder / "small.yaml"))[0]) as archive:
        yield BuildingResults(archive)


def test_lengths_weights_and_costs_are_those_of_a_list_by_hand(results: BuildingResults) -> None:
    """9 lines of columns, beams on 3 lines along x (6 + 4 m) and along y (2 x 5 m) on 2 floors, crosses in 2 bays.

    Weights of a metre: ArcelorMittal, Sections and Merchant Bars (HEB200 61.3, IPE300 42.2, IPE240 30.7 kg/m), and
    EN 10210-2, Table B.1 (CHS101.6x5: 11.9 kg/m); to the digits that are printed there.
    """
    table = steel_list_table(results)
    rows = {str(row[1]): row for row in table.rows if row[0] != "all"}
    crosses = 4 * np.hypot(5.0, 4.0) + 4 * np.hypot(5.0, 3.0)
    by_hand = {
        "HEB200": (18, "9 x 3.00, 9 x 4.00", 63.0, 61.3, 3.0),
        "IPE300": (12, "6 x 4.00, 6 x 6.00", 60.0, 42.2, 2.0),
        "IPE240": (12, "12 x 5.00", 60.0, 30.7, 2.0),
        "CHS101.6x5": (8, "4 x 5.83, 4 x 6.40", crosses, 11.9, 2.0),
    }
    assert rows.keys() == by_hand.keys()
    names = [column.in_files for column in table.columns]
    for section, (number, each, length, weight, price) in by_hand.items():
        row = dict(zip(names, rows[section], strict=True))
        assert (row["number"], row["each"]) == (number, each)
        assert float(row["length"]) == pytest.approx(length, abs=0.005)  # type: ignore[arg-type]  # of rounded lengths
        assert float(row["weight"]) == pytest.approx(weight, abs=0.05)  # type: ignore[arg-type]  # of the catalogues
        assert float(row["cost"]) == pytest.approx(price * length * weight, rel=1e-2)  # type: ignore[arg-type]
    whole = sum(length * weight for _, _, length, weight, _ in by_hand.values())
    assert float(table.texts[-1][names.index("mass")]) == pytest.approx(whole / 1e3, rel=1e-3)


def test_what_is_beside_the_list_by_hand(tmp_path: Path) -> None:
    """One beam IPE200 of 5 m in each of 2 x 2 bays and 2 floors: 8 x 5 m x 22.4 kg/m (ArcelorMittal) = 0.896 t."""
    secondary = "spans: x, secondary_beams: 1, secondary_section: IPE200, secondary_material: S275}]"
    (tmp_path / "small.yaml").write_text(PRICED.replace("spans: x}]", secondary), encoding="utf-8")
    with open_archive(run_building(load_building(tmp_path / "small.yaml"))[0]) as archive:
        results = BuildingResults(archive)
        table, listed = beside_table(results), steel_list_table(results)
        panels = int(np.count_nonzero(results.values("panels", "doubler")))
    beams, plates = table.rows  # no splices: one section all the way up
    assert beams[:5] == ["secondary beams", "IPE200", "S275", 8, "5.00"]
    assert beams[5] == pytest.approx(896.0, rel=5e-3)  # the area gives 22.36 kg/m
    assert float(str(beams[6])) == pytest.approx(2.0 * float(str(beams[5])))
    assert (plates[0], plates[3], plates[6]) == ("doubler plates", panels, 100.0 * panels) and panels > 0
    assert "Beside it: 8 secondary beams, 0.89" in " ".join(listed.notes)


def test_the_list_of_a_plane_frame_has_braces_of_dampers_and_doublers() -> None:
    """Two columns of 4 and 3 m, two beams of 6 m, a chevron of two braces of 5 m, a plate on both sides of floor 1.

    Weights of a metre as above; SHS120x5 by EN 10210-2, Table B.2: 17.8 kg/m. A plate of 8 mm is
    200 - 2 (15 + 18) = 134 mm wide and 300 mm high: 0.008 x 0.134 x 0.300 x 7850 = 2.52 kg.
    """
    text = FRAME.replace(
        "analyses:",
        "panel_zones: [{floors: 1, doubler: 8 mm}]\n"
        "dampers:\n  laws: {oil: {type: viscous, parameters: {c: 400 kN*s/m}}}\n"
        "  devices: [{kind: chevron, law: oil, bays: 1, storeys: 1, brace: {section: SHS120x5, material: S275}}]\n"
        "analyses:",
    )
    project = parse_project(text, Path("frame.yaml"), BuildingSections(), files=False)
    members, braces, plates = steel_tables(VariantFrames(None, project))  # type: ignore[arg-type]  # of a project
    names = [column.in_files for column in members.columns]
    found = {row[1]: dict(zip(names, row, strict=True)) for row in (*members.texts, *braces.texts)}
    for section, number, length, weight in (
        ("HEB200", 4, 14.0, 61.3), ("IPE300", 2, 12.0, 42.2), ("SHS120x5", 2, 10.0, 17.8)
    ):  # fmt: skip
        row = found[section]
        assert (int(row["number"]), float(row["length"])) == (number, length)
        assert float(row["mass"]) == pytest.approx(length * weight * 1e-3, rel=5e-3)
    plate = dict(zip([column.in_files for column in plates.columns], plates.texts[0], strict=True))
    assert (plate["column"], plate["number"], plate["at"]) == ("HEB200", "2", "A1, B1")
    assert float(plate["mass"]) == pytest.approx(2 * 2.52, rel=2e-3)


def test_sections_without_a_weight_are_named_below_the_list() -> None:
    own = "sections:\n  strip: {area: 20 cm^2, inertia: 400 cm^4}\nanalyses:"
    text = FRAME.replace("section: IPE300", "section: strip").replace("analyses:", own)
    project = parse_project(text, Path("frame.yaml"), BuildingSections(), files=False)
    (members,) = steel_tables(VariantFrames(None, project))  # type: ignore[arg-type]  # of a project
    assert {row[1] for row in members.texts} == {"HEB200", ""}
    note = "Not in the list, as no weight of steel follows from sections by area or rectangles: 2 beams of `strip`."
    assert note in " ".join(members.notes)


def test_every_member_stands_in_the_list_with_its_largest_use(results: BuildingResults) -> None:
    table = every_member_table(results)
    assert len(table.rows) == 18 + 12 + 12 + 8
    use = np.array(table.column("use"), dtype=float)
    assert use == pytest.approx(np.nan_to_num(results.values("members", "utilisation"), nan=-1.0).max(axis=1))


def test_doubler_plates_are_those_of_the_web_panels(results: BuildingResults) -> None:
    """HEB200: 200 - 2 (15 + 18) = 134 mm between the fillets; as high as the IPE300 beside it."""
    table = doublers_table(results)
    needed = int(np.count_nonzero(results.values("panels", "doubler")))
    assert sum(map(int, table.column("number"))) == needed > 0  # type: ignore[arg-type]
    assert (table.column("width"), table.column("height")) == ([pytest.approx(0.134)], [0.3])


def test_moment_of_a_pinned_beam_is_that_of_the_closed_form(results: BuildingResults) -> None:
    """BY_B_1_1 carries 5 m of the floor: 1.35 (4 x 5 + 0.301) + 1.5 (2 x 5) = 42.41 kN/m, w L2/8 with L = 5 m."""
    combination = [str(name) for name in results.values("combinations", "name")].index("1.35 G + 1.5 Q")
    member = [str(name) for name in results.values("members", "member")].index("BY_B_1_1")
    moment, shear = (along_of(results, member, combination, 1, symbol) for symbol in "MV")
    weight = results.section("IPE240").A * 7850.0 * 9.80665
    load = 1.35 * (20e3 + weight) + 1.5 * 10e3
    assert np.abs(moment.steady).max() == pytest.approx(load * 5.0**2 / 8.0, rel=1e-6)  # rounding of the archive
    assert np.abs(shear.steady[[0, -1]]) == pytest.approx(load * 5.0 / 2.0, rel=1e-6)
    drawn = moment.at(moment.steady, 1.0)
    assert drawn[3, 1] < moment.start[1] and drawn[0, 1] == pytest.approx(moment.start[1])  # below, where it is tense


def test_moments_of_columns_stand_on_the_side_in_tension(results: BuildingResults) -> None:
    """Pushed along x and along y, a column that is fixed at its base is in tension there on the side it leaves."""
    member = [str(name) for name in results.values("members", "member")].index("C_B2_1")
    cases = [str(name) for name in results.values("forces", "case")]
    for axis, case in enumerate(("S_x", "S_y")):
        forces = results.values("forces", "static")[cases.index(case), member]
        one = along_of(results, member, 0, axis, "M")
        which = 4 if abs(results.values("members", "web")[member][axis]) > 0.5 else 5
        assert one.at(forces[:, which], 1.0)[0, 0] < one.start[0]


def test_texts_of_the_diagrams_stand_apart(results: BuildingResults) -> None:
    drawn = list(force_diagrams(results.archive))
    assert {"forces_X2_N", "forces_X2_V", "forces_X2_M"} <= {name for name, _, _ in drawn}
    for name, caption, figure in drawn:
        assert not faults(figure), name
        assert "which governs" in caption
