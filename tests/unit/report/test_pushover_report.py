"""Pushovers of a study, from the plan to verdicts, tables, figures and the page."""

from __future__ import annotations

from pathlib import Path

import pytest

from edesign import load_study, run_study
from edesign.archive.reader import open_archive
from edesign.report.archive.document import page_text
from edesign.report.archive.figures import all_figures
from edesign.report.archive.summary import summarise
from edesign.report.archive.tables import details, overview

PROJECT = """\
edesign: 1
title: Two storeys
frame:
  bays: [6 m]
  storeys: [3.5 m, 3 m]
  columns: [{storeys: all, section: HEB300, material: S275}]
  beams: [{floors: all, section: IPE360, material: S275}]
materials: {S275: {law: bilinear, E: 210 GPa, fy: 275 MPa, hardening: 1 %}}
loads: {beams: [{floors: all, G: 25 kN/m, Q: 10 kN/m}]}
masses: {from_loads: {G: 1, Q: 0.3}}
hazard:
  code: ec8-2004
  a_gR: 0.36 g
  ground: C
  spectrum: 1
  levels: {DBE: {probability: 10 %}, MCE: {probability: 2 %}}
dampers:
  laws: {rubber: {type: kelvin_voigt, parameters: {k: 2 kN/mm, c: 1 kN*s/mm}}}
  devices: [{kind: storey, bays: 1, storeys: all, law: rubber}]
analyses: [{name: gravity, kind: gravity}]
"""
STUDY = """\
edesign_study: 1
title: Pushovers
project: project.yaml
variants: {bare: {dampers: none}, damped: {dampers: project}}
pushovers:
  - {variants: bare, pattern: [first_mode, uniform], direction: both, targets: [n2, asce41, fema356], steps: 30}
  - {name: spring, variants: damped, pattern: uniform, targets: n2, levels: DBE, steps: 30}
  - {name: wet, variants: damped, pattern: uniform, roof_drift: 0.5 %, targets: n2, damping: 20 %, steps: 30}
criteria:
  - {name: drift, measure: interstorey_drift, most: 1 %, levels: DBE}
  - {name: life, performance: LS, levels: MCE, variants: bare}
objectives: [k]
"""


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("pushovers")
    (folder / "project.yaml").write_text(PROJECT, encoding="utf-8")
    (folder / "study.yaml").write_text(STUDY, encoding="utf-8")
    return run_study(load_study(folder / "study.yaml")).archive


def test_plan_and_ends(archive: Path) -> None:
    """2 x (modes, gravity), 4 pushes with 6 targets each, 1 with one, 1 with two; the short curve ends before MCE."""
    found = {item["name"]: item for item in summarise(archive)["analyses"]}
    assert len(found) == 4 + 4 * 7 + 2 + 3
    assert [name for name, item in found.items() if item["status"] != "completed"] == ["damped.wet.n2.MCE"]
    assert "beyond the end of the capacity curve at 0.0324" in found["damped.wet.n2.MCE"]["reason"]
    assert found["bare.push.uniform.left.n2.DBE"]["level"] == "DBE"


def test_dampers_do_not_damp_unless_it_is_said(archive: Path) -> None:
    """The spectrum of 20 % is sqrt(10/25) of that of 5 %; dampers add springs, which shorten T*."""
    with open_archive(archive) as opened:
        bare, spring, wet = (
            opened.group(f"analyses/{name}.n2.DBE")
            for name in ("bare.push.uniform.right", "damped.spring", "damped.wet")
        )
    assert [w["kind"] for w in spring.attributes["warnings"]] == ["damper_couple", "target_damping"]
    assert [w["kind"] for w in wet.attributes["warnings"]] == ["damper_couple", "target_range"]
    assert (spring.attributes["spectrum_damping"], wet.attributes["spectrum_damping"]) == (0.05, 0.2)
    assert wet.variables["n2_S_e"].values == pytest.approx(spring.variables["n2_S_e"].values * 0.4**0.5, rel=1e-6)
    assert spring.variables["n2_T"].values < bare.variables["n2_T"].values


def test_verdicts_are_of_the_worst_pattern_and_direction(archive: Path) -> None:
    tables = {table.title: table for table in overview(archive)}
    rows = {(row[0], row[1]): row for row in tables["Criteria"].texts}
    assert list(rows) == [
        ("drift", "bare by N2"),
        ("drift", "bare by ASCE 41"),
        ("drift", "bare by FEMA 356"),
        ("drift", "damped by N2"),
        ("life", "bare by N2"),
        ("life", "bare by ASCE 41"),
        ("life", "bare by FEMA 356"),
    ]
    drifts = [
        item["measures"]["interstorey_drift"]
        for item in summarise(archive)["analyses"]
        if item["name"].startswith("bare.push") and item["name"].endswith("n2.DBE")
    ]
    assert rows["drift", "bare by N2"][4] == f"{100 * max(drifts):.4g} %" and len(drifts) == 4
    governs = {(row[0], row[1]): row for row in tables["What governs the criteria"].texts}
    assert governs["drift", "bare by N2"][5] == "maximum"
    title = next(title for title in tables if title.startswith("Rehabilitation"))
    failed = [row for row in tables[title].texts if row[1] == "damped by N2"]
    assert [row[3] for row in failed] == ["not met", "not met"]  # its target at MCE is not reached


def test_tables_of_one_analysis(archive: Path) -> None:
    with open_archive(archive) as opened:
        d_t = float(opened.group("analyses/bare.push.uniform.right.asce41.MCE").variables["asce41_d_t"].values)
    (table,) = (t for t in details(archive, "bare.push.uniform.right.asce41.MCE") if t.title.endswith("ASCE 41"))
    assert table.texts[0][:2] == ["bare.push.uniform.right", "MCE"] and table.texts[0][-1] == f"{1e3 * d_t:#.4g}"
    (events,) = (t for t in details(archive, "bare.push.uniform.right") if t.title.startswith("Events"))
    assert [row[1] for row in events.rows][:2] == ["first yield of a beam", "first hinge in a beam"]


def test_figures_and_page(archive: Path) -> None:
    with open_archive(archive) as opened:
        figures = {name: figure for name, _, figure in all_figures(opened)}
    assert {"capacity_curves", "n2_bare", "n2_damped", "target_hinges_asce41_MCE"} <= set(figures)
    panels = {axis.get_title(loc="left"): axis for axis in figures["capacity_curves"].axes if axis.get_visible()}
    assert set(panels) == {"push, first mode", "push, uniform", "spring", "wet"}  # a panel for each pattern
    assert len([axis for axis in figures["n2_bare"].axes if axis.get_visible()]) == 4
    page = page_text(archive)
    assert 'id="pushover"' in page and "Response at the target displacements" in page
    assert "could not" not in page
