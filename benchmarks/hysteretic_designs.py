"""Designs of hysteretic dampers for the thesis' 10-storey frame: what each target, distribution and law leads to.

Usage: python -m benchmarks.hysteretic_designs
"""

from __future__ import annotations

import os
import time
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from benchmarks.damper_designs import FILE, Designs  # noqa: E402
from edesign.errors import EdesignError  # noqa: E402
from edesign.frame.project_file import load_project  # noqa: E402
from edesign.one_thread import one_thread  # noqa: E402
from edesign.project.dampers.dampers import DamperLaw, Dampers  # noqa: E402
from edesign.project.project import Project  # noqa: E402
from edesign.project.reading.yaml_file import check_model  # noqa: E402
from edesign.study.design.design import run_design  # noqa: E402

LAWS = {
    "friction": DamperLaw(type="friction", parameters={"mu": 0.3, "N": "100 kN", "k": "60 kN/mm"}),
    "steel": DamperLaw(type="elastic_plastic", parameters={"k": "50 kN/mm", "Fy": "100 kN", "b": 0.02}),
}
COMMON = "method: hysteretic, kind: chevron, bays: [1, 3], level: DBE"
DESIGNS = {
    "10 %, storey_shear": f"{COMMON}, damping: 10 %",
    "10 %, storey_stiffness": f"{COMMON}, damping: 10 %, distribution: storey_stiffness",
    "10 %, strain_energy": f"{COMMON}, damping: 10 %, distribution: strain_energy",
    "10 %, uniform": f"{COMMON}, damping: 10 %, distribution: uniform",
    "10 %, braces 5 k_S": f"{COMMON}, damping: 10 %, brace: {{ratio: 5}}",
    "10 % average, braces 5 k_S": f"{COMMON}, damping: 10 %, brace: {{ratio: 5}}, equivalent_damping: average",
    "share 15 %, braces 5 k_S": f"{COMMON}, shear_share: 15 %, brace: {{ratio: 5}}",
    "share 30 %, braces 5 k_S": f"{COMMON}, shear_share: 30 %, brace: {{ratio: 5}}",
}


def main() -> None:
    """Print the table."""
    project = load_project(FILE)
    columns = ("share", "damping", "average", "T secant", "sum F_y", "drift", "force", "stroke", "ms")
    print(f"{'design':29}{'law':10}" + "".join(f"{column:>9}" for column in columns))
    for name, text in DESIGNS.items():
        for law in LAWS:
            try:
                with one_thread():
                    cells = "".join(f"{value:9.4g}" for value in _row(project, text, law))
            except EdesignError as error:
                cells = f" {error}"
            print(f"{name:29}{law:10}{cells}")


def _row(project: Project, text: str, law: str) -> tuple[float, ...]:
    """Share, damping by two ways (%), period (s), sum of F_y (MN), drift (%), force (kN), stroke (mm), ms."""
    with_law = project.model_copy(update={"dampers": Dampers(laws=LAWS)})
    designs, problems = check_model(f"designs: {{tried: {{{text}, law: {law}}}}}", Designs, "study file", "")
    assert designs is not None, problems.found
    start = time.perf_counter()
    result = run_design(with_law, "tried", designs.designs["tried"], Path("."))
    spent = 1e3 * (time.perf_counter() - start)
    about = {key: 100.0 * float(str(result.group.attributes[key])) for key in WAYS}
    values = {name: variable.values for name, variable in result.group.variables.items()}
    total = 1e-6 * float(values["device_yield_force"] @ values["device_count"])
    drift = 100.0 * float(values["estimated_storey_drift"].max())
    device = (float(values[f"estimated_device_{key}"].max()) for key in ("force", "stroke"))
    force, stroke = device
    return (*about.values(), float(values["period"][0]), total, drift, force / 1e3, 1e3 * stroke, spent)


WAYS = ("share", "damping_at_amplitude", "damping_average")


if __name__ == "__main__":
    main()
