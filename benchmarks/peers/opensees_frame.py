"""The peer frame in OpenSeesPy: periods, pushover and time history, for verification and for timing.

Written for openseespy 3.7.1. Fibres at one depth of a section are one fibre here too (24 in an
I section instead of 160): the section is the same in plane bending, and OpenSees is the faster for it.

Settings nearest to the known values of the 4-bay thesis frame (`known_ground_motion`, the defaults of ModelOptions,
SolverOptions(test="EnergyIncr", tolerance=1e-8)): all printed digits but one, the unscaled base shear, 1322.65 for
1322.7 kN. The periods fix the gravity load. g, the leading zero, the line and the test were picked among some 25
combinations because they come nearest, and others come as near, so they are no proof of what was used:

- gravity G + 0.3 Q = 25.88 kN/m on the beams before and during the earthquake (T1 under gravity 2.81497 s; with G alone
  2.80734 s, with G + Q 2.83304 s; without loads 2.74857 s);
- masses horizontal only (vertical ones as well change the base shear by 0.2 to 0.6 %), no rotational mass;
- no rigid diaphragm: ux of the nodes of a floor differ, so peaks belong to a line. The known ones are the middle line's
  (roof displacements of the outer lines differ by 0.2 %, roof accelerations by up to 3 %);
- Rayleigh factors from modes 1 and 2 under gravity (from the unloaded frame: roof displacement 0.2 % smaller);
- base shear is the sum of the base nodes' horizontal reactions to the members' forces, without their Rayleigh forces
  (with them 0.01 to 0.1 % more);
- g = 9.81 m/s2 for the record's unit, one zero before the record's first value;
- Steel01 with b = 0 and ElasticPP give the same digits. The test and its tolerance decide which steps are halved, and
  so move peaks by up to 0.1 %.

bays  peak g   T1 s     T1 gravity s  roof m   base shear kN  drift %  roof acceleration m/s2  roof at the end m
4     0.2808   2.74857  2.81497       0.34009  1322.65        1.3826   3.8873                  0.05777
4     0.414                           0.37110  1443.30        1.8371   4.5865                  0.07746
3     0.2808   2.77071  2.83710       0.34111  1021.48        1.3941   3.8937                  0.08611
3     0.414                           0.36406  1131.44        1.8324   4.5989                  0.09763

What to know of OpenSees when comparing:

- `rayleigh(a0, a1, 0, 0)` multiplies the tangent of the trial state, geometric stiffness of P-Delta included (checked
  on a cantilever: C = a1 (K_elastic - P/L); when fibres yield the damping force drops within that step, and it
  opposes no motion but drives it where the tangent is negative). The third factor takes the elastic stiffness without
  geometric part, the fourth the tangent of the last committed state;
- with elastic-perfectly-plastic fibres plain Newton fails in a few steps of a strong history (4 to 14 of 5372, more
  with a tighter test), which the fallbacks then take; halved steps change the answer a little, see above;
- EnergyIncr is in J and NormDispIncr in m and rad: both change their meaning with the units;
- `analyze(n, dt)` stops at the first failing step with the last committed state; `getTime` says which one;
- relative displacements, velocities and accelerations are reported; total acceleration = nodeAccel + ground;
- there is one domain per process: every function here wipes it.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import openseespy.opensees as ops
from numpy.typing import NDArray

from benchmarks.peers.frame_data import MENEGOTTO_PINTO, ISection, PeerFrame
from benchmarks.peers.opensees_steps import SolverOptions, Stepper, equations, rayleigh_factors

Array = NDArray[np.float64]

G_STANDARD = 9.80665  # m/s2
G_KNOWN = 9.81  # m/s2, of the known values
GRAVITY_PATTERN, PUSH_PATTERN, QUAKE_PATTERN = 1, 2, 3
GRAVITY_SERIES, PUSH_SERIES, QUAKE_SERIES = 1, 2, 3
STEEL = 1


@dataclass(frozen=True)
class ModelOptions:
    """What the text of a frame leaves open; the defaults are the ones of the known values.

    steel: "Steel01", "Steel02" or "ElasticPP"; vertical_mass: the mass acts vertically too; diaphragm: nodes of a
    floor share ux; column_geometry, beam_geometry: "Linear", "PDelta" or "Corotational"; element_iterations,
    element_tolerance: internal iteration of the force-based element.
    """

    steel: str = "Steel01"
    vertical_mass: bool = False
    diaphragm: bool = False
    column_geometry: str = "PDelta"
    beam_geometry: str = "Linear"
    element_iterations: int = 10
    element_tolerance: float = 1e-12


def _nothing() -> Array:
    return np.zeros(0)


@dataclass
class HistoryResult:
    """Peaks and cost of a time history. All peaks are absolute values; relative to the ground where not said otherwise.

    status: "completed" or "failed"; steps: of the record's step done; roof_displacement: m; residual: m, signed, last
    value; interstorey_drift: ratio; base_shear: N, from the members' forces; base_shear_damped: N, with their Rayleigh
    forces; roof_acceleration: total, m/s2. The scalars are those of the middle line; the *_by_line arrays, (n_lines,),
    have all. storey_drifts: (n_storeys,), middle line. iterations: of all accepted steps (0 if not sampled); fallbacks:
    steps in which the first algorithm failed; smallest_step: s; cpu_s: s, of the calls that integrate; time, roof:
    (steps,), s and m, if asked for.
    """

    status: str = "completed"
    steps: int = 0
    roof_displacement: float = 0.0
    interstorey_drift: float = 0.0
    base_shear: float = 0.0
    base_shear_damped: float = 0.0
    roof_acceleration: float = 0.0
    residual: float = 0.0
    iterations: int = 0
    fallbacks: int = 0
    smallest_step: float = 0.0
    cpu_s: float = 0.0
    roof_displacement_by_line: Array = field(default_factory=_nothing)
    interstorey_drift_by_line: Array = field(default_factory=_nothing)
    roof_acceleration_by_line: Array = field(default_factory=_nothing)
    residual_by_line: Array = field(default_factory=_nothing)
    storey_drifts: Array = field(default_factory=_nothing)
    time: Array = field(default_factory=_nothing)
    roof: Array = field(default_factory=_nothing)


def node_tag(frame: PeerFrame, line: int, floor: int) -> int:
    """Tag of the node of a line (from 0) at a floor (0 is the base)."""
    return 1 + line + floor * frame.n_lines


def build(frame: PeerFrame, options: ModelOptions | None = None) -> None:
    """Build the frame in OpenSees' one domain, which is wiped first; no loads yet."""
    options = options or ModelOptions()
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    for floor, y in enumerate(frame.y):
        for line, x in enumerate(frame.x):
            ops.node(node_tag(frame, line, floor), x, y)
    for line in range(frame.n_lines):
        ops.fix(node_tag(frame, line, 0), 1, 1, 1)
    for floor in range(1, frame.n_storeys + 1):
        for line, mass in enumerate(frame.masses):
            ops.mass(node_tag(frame, line, floor), mass, mass if options.vertical_mass else 0.0, 0.0)
            if options.diaphragm and line:
                ops.equalDOF(node_tag(frame, 0, floor), node_tag(frame, line, floor), 1)
    _steel(frame, options.steel)
    sections = {s: i + 1 for i, s in enumerate(dict.fromkeys((*frame.columns, *frame.beams)))}
    for section, tag in sections.items():
        _fibre_section(frame, section, tag)
        ops.beamIntegration("Lobatto", tag, tag, frame.points)
    ops.geomTransf(options.column_geometry, 1)
    ops.geomTransf(options.beam_geometry, 2)
    accuracy = ("-iter", options.element_iterations, options.element_tolerance)
    tag = 0
    for storey in range(frame.n_storeys):
        for line in range(frame.n_lines):
            tag += 1
            ends = node_tag(frame, line, storey), node_tag(frame, line, storey + 1)
            ops.element("forceBeamColumn", tag, *ends, 1, sections[frame.columns[storey]], *accuracy)
    for storey in range(frame.n_storeys):
        for bay in range(frame.n_bays):
            tag += 1
            ends = node_tag(frame, bay, storey + 1), node_tag(frame, bay + 1, storey + 1)
            ops.element("forceBeamColumn", tag, *ends, 2, sections[frame.beams[storey]], *accuracy)


def _steel(frame: PeerFrame, kind: str) -> None:
    if kind == "ElasticPP":
        if frame.hardening:
            raise ValueError("ElasticPP has no hardening")
        ops.uniaxialMaterial("ElasticPP", STEEL, frame.E, frame.fy / frame.E)
    else:
        curve = MENEGOTTO_PINTO if kind == "Steel02" else ()
        ops.uniaxialMaterial(kind, STEEL, frame.fy, frame.E, frame.hardening, *curve)


def _fibre_section(frame: PeerFrame, section: ISection, tag: int) -> None:
    ops.section("Fiber", tag)
    for y, area in zip(*section.layers(frame.flange_fibres[1], frame.web_fibres[1]), strict=True):
        ops.fiber(y, 0.0, area, STEEL)


def apply_gravity(frame: PeerFrame, solver: SolverOptions, steps: int = 10) -> None:
    """Load all beams by the frame's gravity load in `steps` steps, then keep it constant and set the time to zero."""
    ops.timeSeries("Linear", GRAVITY_SERIES)
    ops.pattern("Plain", GRAVITY_PATTERN, GRAVITY_SERIES)
    first = frame.n_storeys * frame.n_lines + 1
    for tag in range(first, frame.n_members + 1):
        ops.eleLoad("-ele", tag, "-type", "-beamUniform", -frame.gravity)
    equations(solver)
    ops.algorithm("Newton")
    ops.integrator("LoadControl", 1.0 / steps)
    ops.analysis("Static")
    if ops.analyze(steps) != 0:
        raise RuntimeError(f"{frame.title}: gravity did not converge")
    ops.loadConst("-time", 0.0)
    ops.wipeAnalysis()


def _omega(n: int) -> Array:
    return np.sqrt(np.array(ops.eigen(n), dtype=float))


def periods(
    frame: PeerFrame, n: int = 3, options: ModelOptions | None = None, solver: SolverOptions | None = None
) -> tuple[Array, Array]:
    """Periods without loads and under gravity, (n,) and (n,), s."""
    build(frame, options)
    bare = 2.0 * np.pi / _omega(n)
    ops.wipeAnalysis()
    apply_gravity(frame, solver or SolverOptions())
    loaded = 2.0 * np.pi / _omega(n)
    ops.wipe()
    return bare, loaded


def pushover(
    frame: PeerFrame,
    roof_drift: float = 0.02,
    steps: int = 200,
    options: ModelOptions | None = None,
    solver: SolverOptions | None = None,
    modes_under_gravity: bool = True,
) -> tuple[Array, Array]:
    """Pushover to a roof drift by displacement control under nodal loads mass * first mode shape, after gravity.

    Returns roof displacement, (steps + 1,), m, and base shear (sum of the bases' horizontal reactions, gravity's sum is
    zero), (steps + 1,), N. Raises RuntimeError when a step fails even in 256 parts.
    """
    solver = solver or SolverOptions()
    build(frame, options)
    shape = np.zeros(0)
    if not modes_under_gravity:
        shape = _first_shape(frame)
    apply_gravity(frame, solver)
    if modes_under_gravity:
        shape = _first_shape(frame)
    loads = shape * np.array(frame.masses)
    loads /= loads.sum()
    ops.timeSeries("Linear", PUSH_SERIES)
    ops.pattern("Plain", PUSH_PATTERN, PUSH_SERIES)
    for floor in range(1, frame.n_storeys + 1):
        for line in range(frame.n_lines):
            ops.load(node_tag(frame, line, floor), float(loads[floor - 1, line]), 0.0, 0.0)
    equations(solver)
    ops.algorithm("Newton")
    roof = node_tag(frame, frame.n_lines // 2, frame.n_storeys)
    start = ops.nodeDisp(roof, 1)
    step = roof_drift * frame.height / steps
    ops.integrator("DisplacementControl", roof, 1, step)
    ops.analysis("Static")

    def advance(size: float, parts: int) -> bool:
        ops.integrator("DisplacementControl", roof, 1, size)
        if ops.analyze(1) == 0:
            return True
        return parts < 256 and all(advance(0.5 * size, 2 * parts) for _ in range(2))

    displacement, shear = np.zeros(steps + 1), np.zeros(steps + 1)
    displacement[0] = start
    for i in range(1, steps + 1):
        if not advance(step, 1):
            raise RuntimeError(f"{frame.title}: pushover stops at {displacement[i - 1]:.4f} m")
        displacement[i] = ops.nodeDisp(roof, 1)
        shear[i] = -_base_reaction(frame)
    ops.wipe()
    return displacement, shear


def _first_shape(frame: PeerFrame) -> Array:
    """Horizontal first mode shape of the present state, (n_storeys, n_lines)."""
    _omega(1)
    ops.wipeAnalysis()
    return np.array(
        [
            [ops.nodeEigenvector(node_tag(frame, line, floor), 1, 1) for line in range(frame.n_lines)]
            for floor in range(1, frame.n_storeys + 1)
        ]
    )


def _base_reaction(frame: PeerFrame, *what: str) -> float:
    ops.reactions(*what)
    return float(sum(ops.nodeReaction(node_tag(frame, line, 0), 1) for line in range(frame.n_lines)))


def prepare_history(
    frame: PeerFrame,
    ground_acceleration: Array,
    dt: float,
    options: ModelOptions | None = None,
    solver: SolverOptions | None = None,
    damping: float = 0.02,
    damping_after_gravity: bool = True,
) -> None:
    """Build, load by gravity, damp, and set up Newmark's average acceleration.

    ground_acceleration: (n,), m/s2, every dt (s), the first value at the time zero; damping: ratio in modes 1 and 2.
    """
    solver = solver or SolverOptions()
    build(frame, options)
    omega = np.zeros(0)
    if not damping_after_gravity:
        omega = _omega(2)
        ops.wipeAnalysis()
    apply_gravity(frame, solver)
    if damping_after_gravity:
        omega = _omega(2)
        ops.wipeAnalysis()
    a0, a1 = rayleigh_factors(omega, damping)
    ops.rayleigh(a0, a1, 0.0, 0.0)
    ops.timeSeries("Path", QUAKE_SERIES, "-dt", dt, "-values", *(float(a) for a in ground_acceleration))
    ops.pattern("UniformExcitation", QUAKE_PATTERN, 1, "-accel", QUAKE_SERIES)
    equations(solver)
    ops.algorithm(*solver.algorithm)
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")


def history(
    frame: PeerFrame,
    ground_acceleration: Array,
    dt: float,
    options: ModelOptions | None = None,
    solver: SolverOptions | None = None,
    damping: float = 0.02,
    damping_after_gravity: bool = True,
    free_vibration: float = 0.0,
    keep_history: bool = False,
    steps: int | None = None,
) -> HistoryResult:
    """Time history under a ground acceleration, every step sampled (outside the timed calls).

    ground_acceleration: (n,), m/s2, every dt (s); free_vibration: s, appended; steps: stop after so many.
    """
    prepare_history(frame, ground_acceleration, dt, options, solver, damping, damping_after_gravity)
    total = _n_steps(ground_acceleration, dt, free_vibration, steps)
    stepper = Stepper(dt, (solver or SolverOptions()).algorithm)
    result = HistoryResult()
    nodes = [[node_tag(frame, line, floor) for line in range(frame.n_lines)] for floor in range(frame.n_storeys + 1)]
    heights = np.array(frame.storey_heights)[:, None]
    times, roof = np.zeros(total), np.zeros((total, frame.n_lines))
    drifts, accelerations = np.zeros((frame.n_storeys, frame.n_lines)), np.zeros(frame.n_lines)
    for i in range(total):
        if not stepper.step():
            result.status = "failed"
            break
        result.steps = i + 1
        u = np.array([[ops.nodeDisp(n, 1) for n in floor] for floor in nodes])
        times[i], roof[i] = ops.getTime(), u[-1]
        np.maximum(drifts, np.abs(np.diff(u, axis=0)) / heights, out=drifts)
        ground = ground_acceleration[i + 1] if i + 1 < len(ground_acceleration) else 0.0
        total_acceleration = np.array([ops.nodeAccel(n, 1) for n in nodes[-1]]) + ground
        np.maximum(accelerations, np.abs(total_acceleration), out=accelerations)
        result.base_shear = max(result.base_shear, abs(_base_reaction(frame)))
        result.base_shear_damped = max(result.base_shear_damped, abs(_base_reaction(frame, "-dynamic")))
    middle = frame.n_lines // 2
    roof = roof[: result.steps]
    result.roof_displacement_by_line = np.max(np.abs(roof), axis=0, initial=0.0)
    result.interstorey_drift_by_line = drifts.max(axis=0)
    result.roof_acceleration_by_line = accelerations
    result.residual_by_line = roof[-1].copy() if len(roof) else np.zeros(frame.n_lines)
    result.roof_displacement = float(result.roof_displacement_by_line[middle])
    result.interstorey_drift = float(result.interstorey_drift_by_line[middle])
    result.roof_acceleration = float(accelerations[middle])
    result.residual = float(result.residual_by_line[middle])
    result.storey_drifts = drifts[:, middle].copy()
    if keep_history:
        result.time, result.roof = times[: result.steps], roof[:, middle].copy()
    _account(result, stepper)
    return result


def benchmark_history(
    frame: PeerFrame,
    ground_acceleration: Array,
    dt: float,
    options: ModelOptions | None = None,
    solver: SolverOptions | None = None,
    damping: float = 0.02,
    free_vibration: float = 0.0,
    steps: int | None = None,
) -> HistoryResult:
    """The same history without any sampling: one call integrates until the end or a step that needs fallbacks.

    Returns a result with status, steps, fallbacks, cpu_s and the last roof displacement (residual) only.
    """
    prepare_history(frame, ground_acceleration, dt, options, solver, damping)
    total = _n_steps(ground_acceleration, dt, free_vibration, steps)
    stepper = Stepper(dt, (solver or SolverOptions()).algorithm)
    result = HistoryResult()
    while result.steps < total:
        if stepper.run(total - result.steps, dt):
            result.steps = total
            break
        result.steps = round(ops.getTime() / dt)
        if not stepper.rescue():
            result.status = "failed"
            break
        result.steps += 1
    result.residual = ops.nodeDisp(node_tag(frame, frame.n_lines // 2, frame.n_storeys), 1)
    _account(result, stepper)
    result.iterations = 0
    return result


def _n_steps(ground_acceleration: Array, dt: float, free_vibration: float, steps: int | None) -> int:
    total = len(ground_acceleration) - 1 + round(free_vibration / dt)
    return total if steps is None else min(steps, total)


def _account(result: HistoryResult, stepper: Stepper) -> None:
    result.iterations, result.fallbacks = stepper.iterations, stepper.fallbacks
    result.smallest_step, result.cpu_s = stepper.smallest_step, stepper.cpu_s
    ops.wipe()


def read_at2(path: str, g: float = G_STANDARD) -> tuple[Array, float]:
    """Acceleration (n,), m/s2, and step, s, of a PEER AT2 file; g: m/s2."""
    with open(path, encoding="latin-1") as file:
        header = [next(file) for _ in range(4)]
        values = np.array(file.read().split(), dtype=float)
    return values * g, float(header[3].upper().split("DT=")[1].split()[0].rstrip(","))


def known_ground_motion(path: str, pga_g: float | None = None) -> tuple[Array, float]:
    """Ground motion (n + 1,), m/s2, and step, s, as used for the known values.

    path: AT2 file; pga_g: peak to scale to, in g, unscaled if None.
    """
    acceleration, dt = read_at2(path, G_KNOWN)
    if pga_g is not None:
        acceleration *= pga_g * G_KNOWN / float(np.max(np.abs(acceleration)))
    return np.concatenate(([0.0], acceleration)), dt
