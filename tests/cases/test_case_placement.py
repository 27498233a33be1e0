"""The case `placement`: a search as a user runs it, and the dampers that it finds written by hand."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
import pytest
import yaml
from cases.conftest import HERE, copied_study

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.frame.project_file import load_project, load_study
from edesign.frame.sections.steel_section import steel_section
from edesign.project.dampers.placement import PlacementDesign
from edesign.report.archive.document import page_text
from edesign.report.archive.study_tables import study_tables
from edesign.report.assessment.verdict_data import study_verdicts
from edesign.study.check.summary import check_study
from edesign.study.placement.candidates import make_candidates
from edesign.study.run.run import run_study

CASE = HERE / "placement"
PLACE, COST = 0.5, {1: 1.0, 2: 1.6}  # of study.yaml
Results = Callable[[str, str], Group]
study_in = partial(copied_study, "placement")


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return run_study(load_study(study_in(tmp_path_factory.mktemp("placement")))).archive


def test_devices_are_those_of_the_project(archive: Path) -> None:
    with open_archive(archive) as opened:
        about = opened.group_attributes("designs/placed")
    (device,) = yaml.safe_load(str(about["devices"]))["devices"]
    expected = load_project(CASE / "project.yaml").dampers
    assert expected is not None and (about["status"], about["proof"]) == ("completed", "optimal")
    (by_hand,) = expected.devices
    assert (device["storeys"], str(device["bays"]), device["scale"]) == ("1-2", "1", by_hand.scale)
    assert device["brace"] == {"stiffness": "60000000.0 N/m"} and device["design_deformation"] == "0.015 m"


def test_histories_of_the_chosen_layout_are_those_of_the_dampers_written_by_hand(
    archive: Path, results_of: Results
) -> None:
    """The same frame, dampers, motion and scheme: to rounding of the deformations that are kept."""
    with open_archive(archive) as opened:
        searched, design = opened.group("analyses/damped.DBE.motion"), opened.group("designs/placed")
    by_hand = results_of("placement", "DBE")
    for name in ("storey_drift_max", "storey_drift_min", "damper_force_max", "floor_acceleration_max"):
        np.testing.assert_array_equal(searched.variables[name].values, by_hand.variables[name].values)
    drift = max(np.abs(by_hand.variables[f"storey_drift_{side}"].values).max() for side in ("max", "min"))
    chosen = int(str(design.attributes["chosen_layout"])) - 1
    drifts = design.variables["verdict_value"].values[:, design.coords["criterion"].values.tolist().index("drift, DBE")]
    assert drifts[chosen] == drift <= 0.013


def test_costs_by_hand_and_every_cheaper_layout_misses(archive: Path) -> None:
    with open_archive(archive) as opened:
        design = opened.group("designs/placed")
    options, cost, met = (design.variables[f"layout_{key}"].values for key in ("option", "cost", "met"))
    by_hand = [sum(COST[i] + PLACE for i in row if i) for row in options.tolist()]
    np.testing.assert_allclose(cost, by_hand, rtol=1e-12)
    assert design.attributes["cost"] == cost[met == 1].min() == pytest.approx(4.2)
    cheaper = [row for row in np.ndindex(3, 3, 3) if sum(COST[i] + PLACE for i in row if i) < 4.2 - 1e-9]
    analysed = {tuple(row): bool(m) for row, m in zip(options.tolist(), met, strict=True)}
    assert design.attributes["cheaper"] == len(cheaper) and not any(analysed[row] for row in cheaper)


def test_tables_and_report(archive: Path) -> None:
    with open_archive(archive) as opened:
        tables = {table.title: table for table in study_tables(opened)}
    layout = tables["Design placed: placement, completed"]
    assert layout.texts == [["3", "-", ""], ["2", "large", ""], ["1", "large", ""]]
    assert any(note.startswith("certificate: optimal: each cheaper layout (") for note in layout.notes)
    order = tables["Devices to order"].texts
    assert order == [
        ["small", "oil", "0", "0", "1", "0"],
        ["large", "oil", "2", "2", "1.6", "3.2"],
        ["each place", "", "2", "", "0.5", "1"],
    ]
    assert "Cost against worst ratio" in page_text(archive)


def test_a_placement_beside_a_design_has_its_dampers_in_all_histories(tmp_path: Path) -> None:
    """The histories that judged the chosen layout are those of the variant with both; less is left to be bought."""
    path = study_in(tmp_path)
    text = path.read_text(encoding="utf-8")
    first = "first: {method: viscous, law: oil, kind: chevron, bays: 2, storeys: 1, damping: 4 %, level: DBE}"
    text = text.replace("designs:\n", f"designs:\n  {first}\n").replace("bays: 1\n", "bays: 1\n    beside: first\n")
    path.write_text(text.replace("{design: placed}", "{design: [first, placed]}"), encoding="utf-8")
    assert "placed: 3 positions" in check_study(load_study(path))["placements"]
    with open_archive(run_study(load_study(path)).archive) as opened:
        design, damped = opened.group("designs/placed"), opened.group("analyses/damped.DBE.motion")
        tables = {table.title: table for table in study_tables(opened)}
    chosen = int(str(design.attributes["chosen_layout"])) - 1
    column = design.coords["criterion"].values.tolist().index("drift, DBE")
    drift = max(np.abs(damped.variables[f"storey_drift_{side}"].values).max() for side in ("max", "min"))
    assert design.variables["verdict_value"].values[chosen, column] == drift
    assert design.attributes["cost"] < 4.2 and design.attributes["beside"] == ["first"]
    assert (
        "beside the dampers of first, which stand in the frame" in tables["Design placed: placement, completed"].notes
    )


def test_check_and_run_say_how_many_layouts_there_are(tmp_path: Path) -> None:
    study = load_study(study_in(tmp_path))
    said = check_study(study)["placements"]
    assert re.fullmatch(
        r"placed: \d+ positions, \d+ layouts; at most \d+ are analysed, by \d+ histories \(1 each\)", said
    )
    spec = study.designs["placed"]
    assert isinstance(spec, PlacementDesign)
    space = make_candidates(study.base, "placed", spec).space
    most = min(spec.verify.budget, space.size)
    assert f"{len(space.positions)} positions, {space.size} layouts; at most {most} are" in said
    lines: list[str] = []
    run_study(study, progress=lambda report: lines.append(str(report)))
    assert any(said.removeprefix("placed: ") in line for line in lines)


def test_workers_change_nothing(archive: Path, tmp_path: Path) -> None:
    found = run_study(load_study(study_in(tmp_path)), workers=2).archive
    with open_archive(found) as one, open_archive(archive) as other:
        a, b = one.group("designs/placed"), other.group("designs/placed")
    assert a.attributes == b.attributes
    for name, variable in a.variables.items():
        assert variable.values.tobytes() == b.variables[name].values.tobytes()


def test_what_cannot_be_met_fails_with_its_reason(tmp_path: Path) -> None:
    path = study_in(tmp_path, ("most: 1.3 %", "most: 0.4 %"), ("budget: 60", "budget: 20"))
    summary = run_study(load_study(path))
    with open_archive(summary.archive) as opened:
        about = opened.group_attributes("designs/placed")
    assert about["status"] == "failed" and str(about["reason"]).startswith("none meets the criteria if more dampers")
    assert "; the nearest misses: drift, DBE (1.09 %, limit 0.4 %)" in str(about["reason"])
    damped = {outcome.name: outcome for outcome in summary.outcomes}["damped.DBE.motion"]
    assert damped.status == "failed" and "its design `placed` failed: none meets" in damped.reason
    assert "placement, failed" in page_text(summary.archive)


def test_frame_that_needs_no_dampers_gets_none(tmp_path: Path) -> None:
    path = study_in(tmp_path, ("most: 1.3 %", "most: 5 %"), ("most: 0.8 g", "most: 5 g"))
    found = run_study(load_study(path)).archive
    with open_archive(found) as opened:
        about = opened.group_attributes("designs/placed")
    assert (about["cost"], about["dampers"], about["certificate"]) == (0.0, 0, "optimal: no layout is cheaper")
    assert about["devices"] == "devices: []\n" and "placement, completed" in page_text(found)


def test_histories_choose_the_braces_of_items(tmp_path: Path) -> None:
    """One section for an item: the lightest of the lists that holds N_Ed = F / (2 cos) at every place, by hand."""
    lists = "SHS60x3, SHS80x3.2, SHS80x5, SHS100x4, SHS100x6.3, SHS120x5, SHS120x8, SHS140x6.3, SHS160x8"
    brace = f"{{choose: [{lists}], material: S275, overstrength: 1.2}}"
    path = study_in(tmp_path)
    text = path.read_text(encoding="utf-8").replace("{stiffness: 60 kN/mm}", brace)
    path.write_text(text, encoding="utf-8")
    said: list[str] = []
    with open_archive(run_study(load_study(path), progress=lambda one: said.append(one.message)).archive) as opened:
        design, damped = opened.group("designs/placed"), opened.group("analyses/damped.DBE.motion")
        verdicts = {one.name: one for one in study_verdicts(opened) if one.variant == "damped"}
    assert any("again, for the forces in its braces" in line for line in said)
    names = damped.coords["damper"].values.tolist()
    v, own = design.variables, [names.index(name) for name in design.coords["braced"].values]
    peaks = np.maximum(damped.variables["damper_force_max"].values, -damped.variables["damper_force_min"].values)[own]
    height = np.array([4.0, 3.3, 3.3])[v["braced_storey"].values - 1]
    length = np.hypot(3.0, height)
    N_Ed = 1.2 * peaks * length / (2.0 * 3.0)
    assert v["braced_force"].values == pytest.approx(N_Ed) and np.all(N_Ed <= v["braced_resistance"].values)
    (section,) = set(v["braced_section"].values.tolist())
    lighter = lists.split(", ")[: lists.split(", ").index(section)]
    E, fy = 210e9, 275e6

    def resistance(name: str, L: float) -> float:
        of = steel_section(name)
        slenderness = math.sqrt(of.A * fy / (math.pi**2 * E * of.I_z / L**2))
        phi = 0.5 * (1.0 + 0.21 * (slenderness - 0.2) + slenderness**2)  # curve a
        return of.A * fy / (phi + math.sqrt(phi**2 - slenderness**2)) if slenderness <= 2.0 else 0.0

    assert v["braced_resistance"].values == pytest.approx([resistance(section, L) for L in length], rel=1e-6)
    line = {name: steel_section(name).A for name in lists.split(", ")}
    assert all(
        any(resistance(name, L) < need for L, need in zip(length, N_Ed, strict=True))
        for name in lighter
        if line[name] < line[section]
    )
    judged = verdicts["braces of placed"]
    assert judged.answer == "met" and judged.value == pytest.approx(np.max(N_Ed / v["braced_resistance"].values))
