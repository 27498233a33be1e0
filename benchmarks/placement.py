"""The search for a placement of dampers: histories and time that it takes on frames of six and ten storeys.

Usage: python -m benchmarks.placement [WORKERS]
"""

from __future__ import annotations

import os
import sys
import tempfile
import time
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from edesign.archive.reader import open_archive  # noqa: E402
from edesign.frame.project_file import load_study  # noqa: E402
from edesign.study.run.run import run_study  # noqa: E402

ROOT = Path(__file__).resolve().parents[1]
MOTION = ROOT / "tests" / "cases" / "records" / "motion.csv"
SIX = """\
edesign: 1
title: Six storeys
frame:
  bays: [6 m, 6 m, 6 m]
  storeys: {count: 6, height: 3.5 m}
  diaphragms: all
  columns:
    - {storeys: 1-3, section: HEB300, material: S275}
    - {storeys: 4-6, section: HEB260, material: S275}
  beams: [{floors: all, section: IPE360, material: S275}]
materials:
  S275: {law: bilinear, E: 210 GPa, fy: 275 MPa, hardening: 1 %}
loads:
  beams: [{floors: all, G: 24 kN/m, Q: 10 kN/m}]
masses: {from_loads: {}, directions: horizontal}
hazard:
  code: ec8-2004
  a_gR: 0.3 g
  ground: B
  spectrum: 1
  levels: {DBE: {probability: 10 %}}
dampers:
  laws:
    oil: {type: viscous_power, parameters: {c: 1 kN*(s/m)^0.35, alpha: 0.35}}
damping: {kind: rayleigh, ratio: 3 %}
integration: {method: newmark, time_step: 0.01 s}
records:
  motion: {file: @motion@, acceleration_unit: m/s^2, match: {method: scale, periods: [0.3 s, 2 s]}}
analyses: [{name: modes, kind: modal, modes: 3}]
"""
STUDY = """\
edesign_study: 1
title: Placement
project: @project@
designs:
  placed:
    method: placement
    kind: chevron
    bays: @bays@
    catalogue: {@catalogue@}
    costs: {place: 0.5}
    limits: {@limits@}
    verify: {records: @records@, levels: DBE, criteria: drift, budget: @budget@}
variants: {damped: {design: placed}}
histories: [{variants: damped, levels: DBE, records: @records@}]
criteria: [{name: drift, measure: interstorey_drift, levels: DBE, most: @most@}]
"""
OIL = (
    "small: {law: oil, scale: 150, cost: 1, brace: {stiffness: 100 kN/mm}}, "
    "large: {law: oil, scale: 300, cost: 1.6, brace: {stiffness: 100 kN/mm}}"
)
RUBBER = (
    "small: {law: elastomer, layer_area: 0.3 m^2, layer_thickness: 70 mm, cost: 1, brace: {stiffness: 150 kN/mm}}, "
    "large: {law: elastomer, layer_area: 0.6 m^2, layer_thickness: 70 mm, cost: 1.6, brace: {stiffness: 150 kN/mm}}"
)
THESIS = ROOT / "projects" / "thesis_10_storey" / "project.yaml"
SHORT = "[table_5_6/ImperialValley1940_I-ELC180, table_5_6/Tabas1978_FER-L1]"
CASES = {
    "six storeys, middle bay": ("six", "2", OIL, "", "motion", "200", "0.85 %"),
    "six storeys, outer bays alike": ("six", "[1, 3]", OIL, "mirrored: true", "motion", "200", "0.8 %"),
    "six storeys, three bays": ("six", "all", OIL, "", "motion", "400", "0.8 %"),
    "thesis, outer bays alike": ("thesis", "[1, 3]", RUBBER, "mirrored: true", SHORT, "400", "1.5 %"),
}


def main() -> None:
    """Print the table."""
    workers = int(sys.argv[1]) if len(sys.argv) > 1 else 2
    print(f"{'case':32}{'layouts':>14}{'histories':>10}{'cost':>8}{'ratio':>7}{'s':>8}  certificate")
    for name, case in CASES.items():
        with tempfile.TemporaryDirectory() as folder:
            print(f"{name:32}{_row(Path(folder), case, workers)}", flush=True)


def _row(folder: Path, case: tuple[str, ...], workers: int) -> str:
    project, bays, catalogue, limits, records, budget, most = case
    (folder / "six.yaml").write_text(SIX.replace("@motion@", str(MOTION)), encoding="utf-8")
    text = STUDY.replace("@project@", str(THESIS) if project == "thesis" else "six.yaml")
    for key, value in (("bays", bays), ("catalogue", catalogue), ("limits", limits), ("most", most)):
        text = text.replace(f"@{key}@", value)
    text = text.replace("@records@", records).replace("@budget@", budget)
    (folder / "study.yaml").write_text(text, encoding="utf-8")
    start = time.perf_counter()
    archive = run_study(load_study(folder / "study.yaml"), folder / "study.h5", workers=workers).archive
    spent = time.perf_counter() - start
    with open_archive(archive) as opened:
        about = opened.group_attributes("designs/placed")
    numbers = f"{about['layouts']:>14}{about['histories']:>10}{about['cost']:>8.4g}{about['demand']:>7.3f}{spent:>8.0f}"
    return f"{numbers}  {about['certificate']}"


if __name__ == "__main__":
    main()
