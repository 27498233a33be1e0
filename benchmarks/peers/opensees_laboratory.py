"""The one-storey system of the thesis' section 6.2.5 in OpenSeesPy, its damper in the laboratory of `serve`.

A process of its own: OpenSeesPy's genericClient waits for answers without letting other threads run.
"""

from __future__ import annotations

import json
import math
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from edesign.frame.project_file import load_project
from edesign.ground_motion.project_records import find_recordings

ROOT = Path(__file__).parents[2]
PROJECT = ROOT / "projects/thesis_one_storey/project.yaml"
SCALE = 0.18
MASS, STIFFNESS, RATIO = 143.26e3, 22.6e6, 0.02  # kg, N/m, of critical damping
STEP = 1e-3  # s
INTEGRATORS = {"NewmarkExplicit": (0.5,), "AlphaOS": (1.0,), "Newmark": (0.5, 0.25)}
"""With gamma, with alpha, with gamma and beta; the last one iterates."""


@dataclass(frozen=True)
class GroundMotion:
    """Ground acceleration.

    Attributes:
        acceleration: (n,) m/s2, straight between the samples.
        dt: s.
    """

    acceleration: np.ndarray
    dt: float


def el_centro() -> GroundMotion:
    """Return El Centro 1940 of the project, scaled so that the damper stays below 50 % strain."""
    record = find_recordings(load_project(PROJECT), ["el_centro"])["el_centro"].record
    return GroundMotion(SCALE * record.acceleration, record.time_step)


def start_client(
    port: int, motion: GroundMotion, folder: Path, *, integrator: str = "NewmarkExplicit"
) -> subprocess.Popen[str]:
    """Start OpenSeesPy in a process of its own; its output is what `run` prints.

    Args:
        port: of the server, on this machine.
        motion: of the ground.
        folder: for a file of the ground motion.
        integrator: of OpenSees, one of INTEGRATORS.
    """
    values = folder / "acceleration.txt"
    np.savetxt(values, motion.acceleration)
    command = [sys.executable, "-m", "benchmarks.peers.opensees_laboratory", str(port), str(values)]
    command += [repr(motion.dt), str(motion.acceleration.size - 1), integrator]
    return subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def run(port: int, values: str, dt: float, intervals: int, integrator: str) -> dict[str, float]:
    """Analyse the system under a ground motion.

    Returns:
        Peak displacement, m (NaN if the laboratory ended the test, or the analysis failed), number of steps, and mean,
        median, 99 % and longest of their durations, s, the connection included.
    """
    import openseespy.opensees as ops

    omega = math.sqrt(STIFFNESS / MASS)
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    for node in (1, 2):
        ops.node(node, 0.0)
    ops.fix(1, 1)
    ops.mass(2, MASS)
    ops.uniaxialMaterial("Elastic", 1, STIFFNESS)
    ops.element("zeroLength", 1, 1, 2, "-mat", 1, "-dir", 1)
    ops.element("genericClient", 2, "-node", 2, "-dof", 1, "-server", port)
    ops.rayleigh(2.0 * RATIO * omega, 0.0, 0.0, 0.0)
    ops.timeSeries("Path", 1, "-dt", dt, "-filePath", values)
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("BandGeneral")
    ops.test("NormUnbalance", 1e-3, 20)  # N
    ops.algorithm("Newton" if integrator == "Newmark" else "Linear")
    ops.integrator(integrator, *INTEGRATORS[integrator])
    ops.analysis("Transient")
    peak, durations = 0.0, np.empty(round(intervals * dt / STEP))
    print("begun", flush=True)
    for i in range(durations.size):
        before = time.perf_counter()
        failed = ops.analyze(1, STEP) != 0
        durations[i] = time.perf_counter() - before
        displacement = abs(ops.nodeDisp(2, 1))
        if failed or not math.isfinite(displacement):
            peak = math.nan
            break
        peak = max(peak, displacement)
    ops.wipe()
    done = durations[: i + 1]
    figures = zip(("p50", "p99", "longest"), np.quantile(done, (0.5, 0.99, 1.0)), strict=True)
    return {"peak": peak, "steps": float(i + 1), "mean": float(np.mean(done))} | {k: float(v) for k, v in figures}


if __name__ == "__main__":
    port, values, dt, intervals, integrator = sys.argv[1:]
    print(json.dumps(run(int(port), values, float(dt), int(intervals), integrator)))
