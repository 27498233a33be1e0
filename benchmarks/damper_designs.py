"""Designs of the dampers of the thesis' 10-storey frame: what each method and each choice leads to.

Usage: python -m benchmarks.damper_designs
"""

from __future__ import annotations

import os
import time
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np  # noqa: E402

from edesign.archive.dataset import Group  # noqa: E402
from edesign.frame.project_file import load_project  # noqa: E402
from edesign.project.dampers.designs import Design  # noqa: E402
from edesign.project.project import Project  # noqa: E402
from edesign.project.reading.base import Model  # noqa: E402
from edesign.project.reading.yaml_file import check_model  # noqa: E402
from edesign.study.design.design import run_design  # noqa: E402

FILE = Path(__file__).resolve().parents[1] / "projects" / "thesis_10_storey" / "project.yaml"
STOREYS = ", ".join(f"{k} kN/m" for k in (51776, 26820, 22744, 20863, 16934, 15144, 14515, 12776, 11591, 9592))
COMMON = "law: elastomer, bays: [1, 3], strain: 20 %, layer_thickness: 70 mm"
BRACED = f"method: strain_energy, {COMMON}, brace: {{ratio: 7}}"
MODE = f"{BRACED}, braces_in_target: false"
ENERGY = f"{MODE}, target_in: storeys"
FIXED = "properties: {G_storage: 1.06 MPa, loss_factor: 0.3535}"
DESIGNS = {
    "Table 5.7 stiffness, floor to floor": f"{ENERGY}, kind: storey, state: initial, damping: 10 %, {FIXED}, "
    f"storey_stiffness: [{STOREYS}]",
    "Table 5.7 stiffness, chevrons": f"{ENERGY}, kind: chevron, state: initial, damping: 10 %, {FIXED}, "
    f"storey_stiffness: [{STOREYS}]",
    "computed stiffness, no gravity": f"{ENERGY}, kind: chevron, state: initial, damping: 10 %, {FIXED}",
    "computed stiffness": f"{ENERGY}, kind: chevron, damping: 10 %, {FIXED}",
    "measured properties, 0.25-0.5 Hz": f"{ENERGY}, kind: chevron, damping: 10 %, "
    "properties: {table: thesis_appendix_a}, frequency: [0.25 Hz, 0.5 Hz]",
    "measured properties, followed": f"{ENERGY}, kind: chevron, damping: 10 %, "
    "properties: {table: thesis_appendix_a}",
    "properties of the law": f"{ENERGY}, kind: chevron, damping: 10 %, properties: law",
    "8 % with braces": f"{BRACED}, kind: chevron, damping: 8 %, braces_in_target: true, target_in: storeys, {FIXED}",
    "10 % in the first mode": f"{MODE}, kind: chevron, damping: 10 %, {FIXED}",
    "uniform": f"{MODE}, kind: chevron, damping: 10 %, distribution: uniform, {FIXED}",
    "by strain energy": f"{MODE}, kind: chevron, damping: 10 %, distribution: strain_energy, {FIXED}",
    "10.6 % as the storeys, drift 1.35 %": f"{ENERGY}, kind: chevron, damping: 10.6 %, level: DBE, {FIXED}",
    "least area, drift 1.35 %": f"{BRACED}, kind: chevron, distribution: least_area, level: DBE, drift: 1.35 %, "
    f"{FIXED}",
    "simplified, drift 1.5 %": f"method: simplified, {COMMON}, kind: chevron, alpha: 15, level: DBE, drift: 1.5 %, "
    f"{FIXED}",
}


class Designs(Model):
    designs: dict[str, Design]


def main() -> None:
    """Print the table."""
    project = load_project(FILE)
    columns = ("G'", "n", "f", "T1", "5.6", "5.8", "complex", "braced", "law", "A_1", "area", "drift", "ms")
    units = ("MPa", "", "Hz", "s", "%", "%", "%", "%", "%", "m2", "m2", "%", "")
    print(f"{'':36s}" + "".join(f"{c:>8s}" for c in columns))
    print(f"{'':36s}" + "".join(f"{u:>8s}" for u in units))
    for name, entry in DESIGNS.items():
        print(f"{name:36s}{row(project, entry)}", flush=True)


def row(project: Project, entry: str) -> str:
    """The results of a design."""
    read, problems = check_model(f"designs: {{tried: {{{entry}}}}}", Designs, "study file", "designs:")
    assert read is not None, problems.found
    start = time.perf_counter()
    result = run_design(project, "tried", read.designs["tried"], FILE.parent)
    ms = 1e3 * (time.perf_counter() - start)
    return f"  {result.reason}" if "period" not in result.group.variables else cells(result.group, ms)


def cells(group: Group, ms: float) -> str:
    """One line of the table."""
    v, a = group.variables, group.attributes
    damping = [100.0 * float(v[f"damping_{w}"].values[0, 0]) for w in ("strain_energy", "frequencies", "complex")]
    braced = 100.0 * float(v["damping_strain_energy"].values[1, 0])
    drift = 100.0 * float(np.max(v["estimated_storey_drift"].values)) if "estimated_storey_drift" in v else np.nan
    numbers = (
        (1e-6 * a["G_storage_Pa"], 3), (a["loss_factor"], 4), (a["frequency_Hz"], 3),
        (float(v["period"].values[1, 0]), 3), *((d, 2) for d in damping), (braced, 2),
        (100.0 * a["law_damping_strain_energy"], 2), (float(v["layer_area"].values[0]), 3),
        (a["total_layer_area_m2"], 2), (drift, 2), (ms, 0),
    )  # fmt: skip
    return "".join(f"{value:8.{digits}f}" for value, digits in numbers)


if __name__ == "__main__":
    main()
