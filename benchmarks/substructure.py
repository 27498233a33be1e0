"""CPU of virtual real-time substructure tests: a main step by rig, compensator and structure, 1000 tests, both ATS.

Usage: python -m benchmarks.substructure [--tests N] [--workers N]
"""

from __future__ import annotations

import argparse
import time
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

import numpy as np

from benchmarks.timing import cpu_seconds
from edesign.core.compensator import AdaptiveTimeSeries, Compensator, run_compensator
from edesign.core.damper import LawValues
from edesign.core.frame_part import FrameNumericalPart
from edesign.core.substructure import LinearRig, Recursion, Sensors, ServoHydraulicRig, SubstructureLoop
from edesign.damper.thesis_tables import prototype_damper
from edesign.ground_motion.project_records import find_recordings
from edesign.project import parse_project
from edesign.project.analysis.damping import ModalDamping
from edesign.substructure.compensation import compensators
from edesign.substructure.rig import rigs
from edesign.substructure.structure.numerical import shear_building
from edesign.substructure.structure.project_frame import ProjectFrame
from edesign.substructure.structure.project_structure import project_part
from edesign.substructure.structure.recursion import recursion

STEP, SUB_STEPS, DURATION = 1e-3, 5, 30.0  # s, -, s
SENSORS = Sensors(displacement_noise=1e-6, force_noise=20.0)
ADAPTIVE = AdaptiveTimeSeries(
    initial=(1.00515, 0.0107, 9.45e-5),
    least=(0.7, 0.0, 0.0),
    largest=(1.3, 0.04, 8e-4),
    rate=(2.0, 0.05, 1e-3),
    threshold=1e-4,
    sections=compensators.butterworth(6, 20.0, STEP),
    differences=False,
)
LINEAR = rigs.second_order(21.4, 0.4, 4.25e-3, 0.99488).discrete(STEP / SUB_STEPS)
SERVO = ServoHydraulicRig(gain=1.0 / 6.9e-3, oil=50e6, valve_lag=2.6e-3, delay=0.8e-3)


def structure(storeys: int, accelerations: bool = False) -> Recursion:
    """A shear building of the thesis' storeys by the explicit Newmark method, with its floors' accelerations or not."""
    damping = ModalDamping(kind="modal", ratio=0.02, modes=storeys, state="initial")
    part = shear_building([143.26e3] * storeys, [22.6e6] * storeys, damping, 1)
    rows = np.eye(storeys) if accelerations else None
    return recursion(part, STEP, "newmark_explicit", "held", accelerations=rows)


def loop(
    compensator: Compensator,
    rig: LinearRig | ServoHydraulicRig,
    storeys: int,
    sub_steps: int = SUB_STEPS,
    accelerations: bool = False,
) -> SubstructureLoop:
    """A test of the thesis' damper in the first storey."""
    law = LawValues("mgmm", tuple(prototype_damper().values.values()))
    return SubstructureLoop(
        STEP,
        sub_steps,
        compensator,
        rig,
        law,
        sensors=SENSORS,
        numerical=structure(storeys, accelerations),
        unseen_delay=1,
    )


TEN_STOREYS = Path(__file__).parents[1] / "projects" / "thesis_10_storey" / "project.yaml"
YIELDS, ELASTIC = "{law: bilinear, E: 210 GPa, fy: 275 MPa, hardening: 0}", "{law: elastic, E: 210 GPa}"
DEVICES = 20  # of the thesis, side by side
QUAKE = 2.5  # times El Centro: beams and columns yield


def ten_storeys(elastic: bool, recorded: bool) -> tuple[FrameNumericalPart, np.ndarray]:
    """The thesis' frame of ten storeys without the dampers in its first one, and its ground motion."""
    text = TEN_STOREYS.read_text(encoding="utf-8")
    device = f"\ndampers:\n  devices: [{{kind: storey, bays: 2, storeys: 1, law: elastomer, number: {DEVICES}}}]\n"
    text = text.replace("\ndampers:\n", device)
    project = parse_project(text.replace(YIELDS, ELASTIC) if elastic else text, TEN_STOREYS)
    specimen = project_part(project, "S_2_1", vertical=False, estimate=True).device
    record = find_recordings(project, ["el_centro"])["el_centro"].record
    time_of_steps = np.arange(0.0, 15.0, STEP)
    motion = QUAKE * np.interp(time_of_steps, record.time, record.acceleration)
    law = LawValues("mgmm", tuple(prototype_damper().values.values()))
    frame = ProjectFrame(project, specimen, law, (float(DEVICES), 1.0))
    return frame.numerical_part("extrapolated", record=recorded), motion


def frame_loop(part: FrameNumericalPart) -> SubstructureLoop:
    """A test of the thesis' dampers in the first storey of a frame."""
    law = LawValues("mgmm", tuple(prototype_damper().values.values()))
    scales, modified = (float(DEVICES), 1.0), compensators.modified_ats(0.996, ADAPTIVE)
    return SubstructureLoop(STEP, SUB_STEPS, modified, LINEAR, law, sensors=SENSORS, numerical=part, scales=scales)


def ground(duration: float = DURATION) -> np.ndarray:
    """Noise of 0.3 m/s2 at main steps."""
    return 0.3 * np.random.default_rng(1).standard_normal(round(duration / STEP) + 1)


def main() -> None:
    """Print all of it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tests", type=int, default=1000, help="of 30 s each, with other noise (default 1000)")
    parser.add_argument("--workers", type=int, default=2, help="threads (default 2)")
    given = parser.parse_args()
    drive = ground()
    modified, ats = compensators.modified_ats(0.996, ADAPTIVE), compensators.ats(1.0, 16, STEP, ADAPTIVE)
    cases = {
        "linear rig, none": loop(compensators.none(), LINEAR, 1),
        "linear rig, modified ATS": loop(modified, LINEAR, 1),
        "linear rig, ATS": loop(ats, LINEAR, 1),
        "servo-hydraulic, 5 sub-steps": loop(modified, SERVO, 1),
        "servo-hydraulic, 50 sub-steps": loop(modified, SERVO, 1, 50),
        "linear rig, 10 storeys": loop(modified, LINEAR, 10),
        "the same, with accelerations": loop(modified, LINEAR, 10, accelerations=True),
    }
    print("MGMM as specimen, main steps of 1 ms: CPU of a step, and how many times faster than real time")
    for name, test in cases.items():
        middle, spread = cpu_seconds(lambda test=test: test.run(drive), 9)  # type: ignore[misc]
        step = middle / (len(drive) - 1)
        print(f"  {name:32s}{1e6 * step:8.2f} us{STEP / step:10.0f} x{100 * spread:6.0f} %")
    for name, elastic, recorded in (
        ("elastic frame, 10 storeys", True, False),
        ("the same, its response recorded", True, True),
        ("fibre frame, 10 storeys", False, False),
        ("the same, its response recorded", False, True),
    ):
        part, motion = ten_storeys(elastic, recorded)
        middle, spread = cpu_seconds(partial(frame_loop(part).run, motion), 3)
        step = middle / (len(motion) - 1)
        print(f"  {name:32s}{1e6 * step:8.2f} us{STEP / step:10.0f} x{100 * spread:6.0f} %")
    record = cases["linear rig, modified ATS"].run(drive)
    target = np.column_stack([record.target, record.target_velocity, record.target_acceleration])
    alone = [cpu_seconds(lambda c=c: run_compensator(c, STEP, target, record.measured), 9)[0] for c in (modified, ats)]
    each = [1e6 * one / len(target) for one in alone]
    print(f"  compensators alone: modified ATS {each[0]:.3f} us, ATS {each[1]:.3f} us, ratio {each[0] / each[1]:.2f}")
    began = time.perf_counter()
    with ThreadPoolExecutor(given.workers) as pool:
        list(pool.map(lambda seed: loop(modified, LINEAR, 1).run(drive, seed=seed).target[-1], range(given.tests)))
    spent = time.perf_counter() - began
    print(f"{given.tests} tests of {DURATION:g} s, {given.workers} threads: {spent:.1f} s")


if __name__ == "__main__":
    main()
