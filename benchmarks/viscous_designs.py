"""Designs of viscous dampers for the thesis' 10-storey frame: what each distribution and exponent leads to.

Usage: python -m benchmarks.viscous_designs
"""

from __future__ import annotations

import os
import time
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from benchmarks.damper_designs import FILE, Designs  # noqa: E402
from edesign.frame.project_file import load_project  # noqa: E402
from edesign.project.dampers.dampers import DamperLaw, Dampers  # noqa: E402
from edesign.project.project import Project  # noqa: E402
from edesign.project.reading.yaml_file import check_model  # noqa: E402
from edesign.study.design.design import run_design  # noqa: E402

EXPONENTS = (1.0, 0.35)
COMMON = "method: viscous, law: fluid, kind: chevron, bays: [1, 3], level: DBE"
DESIGNS = {
    "storey_stiffness": f"{COMMON}, damping: 15 %, distribution: storey_stiffness",
    "storey_shear": f"{COMMON}, damping: 15 %, distribution: storey_shear",
    "strain_energy": f"{COMMON}, damping: 15 %, distribution: strain_energy",
    "uniform": f"{COMMON}, damping: 15 %, distribution: uniform",
    "storey_stiffness, braces 3 k_S": f"{COMMON}, damping: 15 %, brace: {{ratio: 3}}",
    "storey_stiffness, 7.9 %": f"{COMMON}, damping: 7.9 %",
    "least_coefficient, drift 1.35 %": f"{COMMON}, drift: 1.35 %, distribution: least_coefficient",
}


def main() -> None:
    """Print the table."""
    project = load_project(FILE)
    columns = ("alpha", "damping", "FEMA 356", "law", "sum of c", "drift", "force", "ms")
    print(f"{'design':33}" + "".join(f"{column:>10}" for column in columns))
    for name, text in DESIGNS.items():
        for alpha in EXPONENTS:
            print(f"{name:33}" + "".join(f"{value:10.4g}" for value in _row(project, text, alpha)))


def _row(project: Project, text: str, alpha: float) -> tuple[float, ...]:
    """Exponent, damping by three ways (%), sum of c of all dampers (MN (s/m)^alpha), drift (%), force (kN), ms."""
    law = DamperLaw(type="viscous_power", parameters={"c": f"1 kN*(s/m)^{alpha:g}", "alpha": alpha})
    with_law = project.model_copy(update={"dampers": Dampers(laws={"fluid": law})})
    designs, problems = check_model(f"designs: {{tried: {{{text}}}}}", Designs, "study file", "")
    assert designs is not None, problems.found
    start = time.perf_counter()
    result = run_design(with_law, "tried", designs.designs["tried"], Path("."))
    spent = 1e3 * (time.perf_counter() - start)
    about = {key: 100.0 * float(str(result.group.attributes[key])) for key in WAYS}
    values = {name: variable.values for name, variable in result.group.variables.items()}
    total = 1e-6 * float(values["device_coefficient"] @ values["device_count"])
    drift, force = 100.0 * float(values["estimated_storey_drift"].max()), float(values["estimated_device_force"].max())
    return (alpha, *about.values(), total, drift, force / 1e3, spent)


WAYS = ("damping", "damping_fema356", "law_damping_strain_energy")


if __name__ == "__main__":
    main()
