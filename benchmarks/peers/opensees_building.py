"""A building in three dimensions in OpenSeesPy: gravity, then histories under two components.

Written for openseespy 3.7.1. What to know of OpenSees when comparing:

- `rigidDiaphragm` leaves nodes out, with a warning, whose z differs from the master's in the last digit;
- its force-based element knows no releases. A hinge is an elastic section of hardly any flexural stiffness at the end
  point of the element: Gauss-Lobatto integration sees there the moment of that end alone. Elastic beams with releases
  in their place, which do not yield, would save 15 % of the time of the thesis building;
- its rules of integration miss the kink of a moment under a force inside a member. `UserDefined` ones, made of
  Gauss-Lobatto rules between the forces, do not. An element has 10 points at most, and 11 crash it;
- the third factor of `rayleigh` takes stiffnesses without loads and without geometric part. Trusses have damping only
  with `-doRayleigh`;
- trusses are linear or corotational; there is no P-Delta for them;
- SparseSYM finds no equilibrium of buildings with rigid floors. Of the others SparseGeneral is the fastest, and
  KrylovNewton costs three quarters of Newton's method;
- its Steel02 forgets the curve that a small unloading has left.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
import openseespy.opensees as ops
from numpy.typing import NDArray

from benchmarks.peers.building_data import BuildingHistory, PeerBuilding, PeerMember, PeerSection
from benchmarks.peers.frame_data import MENEGOTTO_PINTO
from benchmarks.peers.opensees_steps import SolverOptions, Stepper, equations, rayleigh_factors

Array = NDArray[np.float64]

GRAVITY, QUAKE = 1, (2, 3)
STEEL = {"elastic": "Elastic", "bilinear": "Steel01", "menegotto_pinto": "Steel02"}
GEOMETRY = {"linear": "Linear", "p_delta": "PDelta", "corotational": "Corotational"}
RELEASED = 1e-9  # of the flexural stiffness, at the point of a force-based member that is a hinge
FASTEST = SolverOptions(
    system="SparseGeneral",
    test="NormUnbalance",
    tolerance=1e-7,
    algorithm=("KrylovNewton",),
    norm=0,
    constraints="Transformation",
)
"""The fastest of those that were tried; the tolerance is that of edesign."""


@dataclass(frozen=True)
class BuildingOptions:
    """What the numbers of a building leave open.

    solver: the tolerance of NormUnbalance is relative to the largest force of a member; element_iterations,
    element_tolerance: internal iteration of the force-based element, the latter in J.
    """

    solver: SolverOptions = field(default_factory=lambda: FASTEST)
    element_iterations: int = 10
    element_tolerance: float = 1e-8

    def solver_at(self, force: float) -> SolverOptions:
        """The solver with its tolerance in N, where forces are as large as this one (N)."""
        absolute = self.solver.test != "NormUnbalance"
        return self.solver if absolute else replace(self.solver, tolerance=self.solver.tolerance * force)


class Rule(NamedTuple):
    """What a rule of integration depends on: section, hinges, places of forces inside, points of each piece."""

    section: int
    pins: tuple[bool, bool, bool, bool]
    breaks: tuple[float, ...]
    points: int

    @classmethod
    def of(cls, building: PeerBuilding, number: int) -> Rule:
        """The rule of a member."""
        member, breaks = building.members[number], building.breaks.get(number, ())
        return cls(member.section, member.pins, breaks, building.points_of_pieces(number))


def build(building: PeerBuilding, options: BuildingOptions) -> None:
    """Build the building in OpenSees' one domain, which is wiped first; no loads yet."""
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    for node, place in enumerate((*building.coordinates, *building.masters)):
        ops.node(node, *map(float, place))
        if building.mass[node].any():
            ops.mass(node, *map(float, building.mass[node]))
    for node in building.supports:
        ops.fix(node, *map(int, building.fixed[node]))
    for floor, nodes in enumerate(building.diaphragms):
        master = building.n_nodes + floor
        ops.fix(master, 0, 0, 1, 1, 1, 0)
        ops.rigidDiaphragm(3, master, *map(int, nodes))
    for tag, section in enumerate(building.sections):
        _material(building, tag, section)
        ops.section("Fiber", tag, "-GJ", section.GJ)
        for y, z, area in zip(section.fibres.y, section.fibres.z, section.fibres.area, strict=True):
            ops.fiber(float(y), float(z), float(area), tag)
        ops.beamIntegration("Lobatto", tag, tag, building.stations)
    made: dict[Rule, int] = {}
    for tag, member in enumerate(building.members):
        _member(building, tag, member, options, made)


def _material(building: PeerBuilding, tag: int, section: PeerSection) -> None:
    if building.steel == "elastic":
        ops.uniaxialMaterial("Elastic", tag, section.E)
    else:
        curve = MENEGOTTO_PINTO if building.steel == "menegotto_pinto" else ()
        ops.uniaxialMaterial(STEEL[building.steel], tag, section.fy, section.E, building.hardening, *curve)


def _member(
    building: PeerBuilding,
    tag: int,
    member: PeerMember,
    options: BuildingOptions,
    made: dict[Rule, int],
) -> None:
    section, ends = building.sections[member.section], (member.start, member.end)
    if member.bar:
        kind = "corotTruss" if building.geometry == "corotational" else "Truss"
        ops.element(kind, tag, *ends, member.share * section.area, member.section, "-doRayleigh", 1)
        return
    ops.geomTransf(GEOMETRY[building.geometry], tag, *member.web)
    rule, integration = Rule.of(building, tag), member.section
    if any(rule.pins) or rule.breaks:
        if rule not in made:
            made[rule] = _integration(building, rule, len(building.sections) + 3 * len(made))
        integration = made[rule]
    accuracy = "-iter", options.element_iterations, options.element_tolerance
    ops.element("forceBeamColumn", tag, *ends, tag, integration, *accuracy)


def _integration(building: PeerBuilding, rule: Rule, tag: int) -> int:
    """Integration of a member on hinges or with forces inside; two more tags than its own are taken."""
    section, n = building.sections[rule.section], rule.points
    ends = np.array([0.0, *rule.breaks, 1.0])
    pieces = np.diff(ends)
    last = np.polynomial.legendre.Legendre.basis(n - 1)
    inner = np.concatenate(([-1.0], np.sort(last.deriv().roots().real), [1.0]))
    weight = 1.0 / (n * (n - 1) * last(inner) ** 2)
    count = len(pieces) * (n - 1) + 1
    places, weights = np.zeros(count), np.zeros(count)
    for k, piece in enumerate(pieces):  # pieces share the points where they meet
        of = slice(k * (n - 1), (k + 1) * (n - 1) + 1)
        places[of] = ends[k] + 0.5 * (inner + 1.0) * piece
        weights[of] += piece * weight
    f = section.fibres
    area, I_y, I_z = float(f.area.sum()), float(f.area @ f.z**2), float(f.area @ f.y**2)
    tags = [rule.section] * count
    for end, place in ((0, 0), (1, count - 1)):
        pin_y, pin_z = rule.pins[2 * end : 2 * end + 2]
        if pin_y or pin_z:
            tags[place] = tag + 1 + end
            soft = I_z * (RELEASED if pin_z else 1.0), I_y * (RELEASED if pin_y else 1.0)
            ops.section("Elastic", tags[place], section.E, area, *soft, section.GJ, 1.0)
    ops.beamIntegration("UserDefined", tag, count, *tags, *places.tolist(), *weights.tolist())
    return tag


def apply_gravity(building: PeerBuilding, options: BuildingOptions, steps: int = 10) -> None:
    """Apply the gravity loads in `steps` steps, then keep them constant and set the time to zero."""
    ops.timeSeries("Linear", GRAVITY)
    ops.pattern("Plain", GRAVITY, GRAVITY)
    for node in np.flatnonzero(building.nodal.any(axis=1)):
        ops.load(int(node), *map(float, building.nodal[node]))
    for tag in np.flatnonzero(building.uniform.any(axis=1)):
        x, y, z = map(float, building.uniform[tag])
        ops.eleLoad("-ele", int(tag), "-type", "-beamUniform", y, z, x)
    for load in building.points:
        x, y, z = load.force
        ops.eleLoad("-ele", load.member, "-type", "-beamPoint", y, z, load.position, x)
    equations(options.solver_at(building.weight / len(building.supports)))
    ops.algorithm("Newton")
    ops.integrator("LoadControl", 1.0 / steps)
    ops.analysis("Static")
    if ops.analyze(steps) != 0:
        raise RuntimeError(f"{building.title}: gravity did not converge")
    ops.loadConst("-time", 0.0)
    ops.wipeAnalysis()


def largest_force(building: PeerBuilding) -> float:
    """Largest force or moment of a member in the present state, N or N m."""
    names = ("axialForce" if member.bar else "localForces" for member in building.members)
    return max(float(np.abs(ops.eleResponse(tag, name)).max()) for tag, name in enumerate(names))


def periods(count: int) -> Array:
    """Longest periods of the present state, (count,) s."""
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system("BandGeneral")
    found = np.array(ops.eigen("-genBandArpack", count), dtype=float)
    ops.wipeAnalysis()
    return np.asarray(2.0 * np.pi / np.sqrt(found))


def prepare_history(
    building: PeerBuilding, motion: tuple[Array, Array], dt: float, options: BuildingOptions
) -> BuildingHistory:
    """Build, load by gravity, damp, and set up Newmark's average acceleration; what is known until then."""
    build(building, options)
    count = max(building.damped_modes)
    result = BuildingHistory(bare=periods(count))
    apply_gravity(building, options)
    result.loaded = periods(count)
    omega = [2.0 * np.pi / float(result.loaded[mode - 1]) for mode in building.damped_modes]
    result.rayleigh = rayleigh_factors(omega, building.damping)
    a0, a1 = result.rayleigh
    ops.rayleigh(
        a0, *(a1 if kind == building.damping_stiffness else 0.0 for kind in ("current", "initial", "committed"))
    )
    for direction, (tag, values) in enumerate(zip(QUAKE, motion, strict=True), start=1):
        ops.timeSeries("Path", tag, "-dt", dt, "-values", *map(float, values))
        ops.pattern("UniformExcitation", tag, direction, "-accel", tag)
    equations(options.solver_at(largest_force(building)))
    ops.algorithm(*options.solver.algorithm)
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    return result


def history(
    building: PeerBuilding, motion: tuple[Array, Array], dt: float, options: BuildingOptions | None = None
) -> BuildingHistory:
    """Time history under two components after gravity, every step sampled outside the timed calls.

    motion: along x and y, (n,) each, m/s2, every dt (s), the first values at the time 0.
    """
    options = options or BuildingOptions()
    result = prepare_history(building, motion, dt, options)
    stepper, ground = Stepper(dt, options.solver.algorithm), np.transpose(motion)
    rows = [_row(building, ground[0])]
    while len(rows) < len(ground) and stepper.step():
        rows.append(_row(building, ground[len(rows)]))
    result.steps = len(rows) - 1
    result.status = "completed" if len(rows) == len(ground) else "failed"
    parts = (np.array([row[part] for row in rows]) for part in range(4))
    result.floors, result.accelerations, result.base_shear, result.column = parts
    result.cpu_s = stepper.cpu_s
    iterations = stepper.iterations / max(1, result.steps)
    result.cost = f"{iterations:.2f} iterations a step, {stepper.fallbacks} fallbacks"
    ops.wipe()
    return result


def _row(building: PeerBuilding, ground: Array) -> tuple[Array, Array, Array, Array]:
    masters = range(building.n_nodes, building.n_nodes + building.n_floors)
    floors = np.array([ops.nodeDisp(node) for node in masters])[:, [0, 1, 5]]
    accelerations = np.array([ops.nodeAccel(node)[:2] for node in masters]) + ground
    ops.reactions()
    shear = np.sum([ops.nodeReaction(node)[:2] for node in building.supports], axis=0)
    column = np.array(ops.eleResponse(building.watched, "localForces"))[[0, 4, 5]]
    return floors, accelerations, shear, column


def imposed_path(column: PeerBuilding, path: Array, options: BuildingOptions | None = None) -> Array:
    """Forces of a column's head along x and y that move it on a path after gravity, and its uz, (n, 3), N and m.

    path: (n, 2), m, from rest at 0.
    """
    options = options or BuildingOptions()
    build(column, options)
    apply_gravity(column, options)
    head, rows = column.n_nodes - 1, []
    for axis, tag in enumerate(QUAKE):
        # the last value twice: behind its last time a series is 0, and times are sums
        ops.timeSeries("Path", tag, "-dt", 1.0, "-values", *map(float, path[:, axis]), float(path[-1, axis]))
        ops.pattern("Plain", tag, tag)
        ops.sp(head, axis + 1, 1.0)
    equations(options.solver_at(largest_force(column)))
    ops.algorithm("Newton")
    ops.integrator("LoadControl", 1.0)
    ops.analysis("Static")
    for step in range(len(path)):
        if step and ops.analyze(1) != 0:
            raise RuntimeError(f"{column.title}: no equilibrium at {step} of {len(path) - 1} steps")
        ops.reactions()
        rows.append((*ops.nodeReaction(head)[:2], ops.nodeDisp(head, 3)))
    ops.wipe()
    return np.array(rows)
