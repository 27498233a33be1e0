"""A linear frame reduced exactly to its masses, floors and damper places, for any stiffness of the dampers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
import scipy

from edesign.core.modes import UNSTABLE
from edesign.errors import AnalysisError
from edesign.frame.devices import Device
from edesign.frame.frame_model import FrameModel, Sum
from edesign.study.analysis.leading_mode import clusters
from edesign.study.analysis.structure import Structure

TOLD = 3
"""Modes that results of designs tell of."""


@dataclass(frozen=True)
class Lead:
    """The vibration along the direction of a frame: the first mode of a plane frame, of a building what stands for it.

    Torsion or nearly equal periods couple modes of a building, and any of them may lead as dampers are added. So no
    mode is chosen. The building is guided: each floor moves along the direction as one. Its guided mode v, with most
    mass along the direction, is regular. The true modes share its motion, and any value is their mean by these shares.

    Attributes:
        share: (n,) of each mode i in v: (v' M phi_i)^2, in sum 1; of one storey its effective mass over the whole.
        shape: (m,) displacements of the masses in v, generalised mass 1.
        loads: (m,) inertia forces of v, N.
        floors, storeys, dampers: as those of `LinearModes`, under these loads; floors turn and move across freely.
        participation: of v, sqrt(kg).

    Source: modal expansion of inertia forces, Chopra, Dynamics of Structures, 12.8; docs/how_to/damper_design.md.
    """

    share: np.ndarray
    shape: np.ndarray
    loads: np.ndarray
    floors: np.ndarray
    storeys: np.ndarray
    dampers: np.ndarray
    participation: float

    def mean(self, of: Callable[[int], float]) -> float:
        """Return the mean of a value of the modes by their shares.

        Args:
            of: the value of the mode of an index.
        """
        return sum(float(self.share[i]) * of(int(i)) for i in np.flatnonzero(self.share))


@dataclass(frozen=True)
class LinearModes:
    """Natural modes with dampers, in rising order of frequency.

    Attributes:
        omega: (n,) rad/s.
        masses: (n, m) displacements of the masses, generalised mass 1.
        floors: (n, floors) horizontal displacement of each floor.
        storeys: (n, floors) drift of each storey, m; of a building at the centre of mass of the floor above.
        dampers: (n, devices) deformation of each damper with its brace.
        participation: (n,) for ground motion in the direction of the frame, sqrt(kg).
        lines: (n, l) drift ratios on the column lines of a building; (n, 0) of a plane frame.
        first: index of the mode that leads in the direction of the frame; of a plane frame the first.
        told: indices of the modes that results tell of, as `told_modes`.
        lead: what a design calls the first mode.
        beside: (n, c) deformation of each damper of other designs, with its brace.
        beside_damping: (n,) damping ratio that these add to each mode, by modal strain energy.
    """

    omega: np.ndarray
    masses: np.ndarray
    floors: np.ndarray
    storeys: np.ndarray
    dampers: np.ndarray
    participation: np.ndarray
    lines: np.ndarray
    first: int
    told: np.ndarray
    lead: Lead
    beside: np.ndarray
    beside_damping: np.ndarray

    @property
    def first_beside_damping(self) -> float:
        """Damping ratio that dampers of other designs add to the vibration along the direction."""
        return self.lead.mean(lambda i: float(self.beside_damping[i]))

    @property
    def first_omega(self) -> float:
        """Circular frequency of the vibration along the direction, rad/s."""
        return self.lead.mean(lambda i: float(self.omega[i]))

    @property
    def first_frequency(self) -> float:
        """Frequency of the vibration along the direction, Hz."""
        return self.first_omega / (2.0 * np.pi)


@dataclass(frozen=True)
class InPlan:
    """What a building has beside a plane frame, with l column lines of its storeys.

    Attributes:
        ground: (3, m) how each mass moves with a ground that moves by 1 along x, by 1 along y, and turns by 1 about
            the vertical through the centre of all masses.
        storey_of: (l,) index of the storey of each line.
        line_A: (l, m), line_B: (l, d), drift ratio on each line, 1/N.
        storey_A: (f, m), storey_B: (f, d), drift of each storey at the centre of mass of the floor above, m/N.
        guides: (m, h) orthonormal, what guided floors have none of: any motion but that along the direction of the
            whole floor as one, in displacements times the root of the mass.
    """

    ground: np.ndarray
    storey_of: np.ndarray
    line_A: np.ndarray
    line_B: np.ndarray
    storey_A: np.ndarray
    storey_B: np.ndarray
    guides: np.ndarray


@dataclass(frozen=True)
class DampersBeside:
    """Dampers of other designs in the frame (c), whose storage stiffness is part of it.

    Attributes:
        stiffness: complex, of each with its brace, (c,) N/m.
        storey: number of the storey of each, (c,).
        pull: (c,) as that of `Building`.
        B: (c, m), C: (c, d), deformation of each by loads on the masses and by forces of the dampers, m/N.
    """

    stiffness: np.ndarray
    storey: np.ndarray
    pull: np.ndarray
    B: np.ndarray
    C: np.ndarray


@dataclass(frozen=True)
class CondensedFrame:
    """Flexibilities of the frame without dampers between masses (m), floors (f) and dampers (d).

    With dampers of (complex) stiffness k the flexibility between the masses is A - B' (1 + k C)^-1 k B, which is
    Woodbury's identity for (K + D' k D)^-1: nothing is approximated. Where the frame is a mechanism without them, the
    flexibilities are those with dampers of a reference stiffness, and k is what they have beyond it.

    Attributes:
        mass: (m,) kg.
        influence: (m,) 1 where a mass moves in the direction of the frame.
        floor_of: (m,) index of the floor of each mass, -1: none.
        A: (m, m), B: (d, m), C: (d, d), m/N.
        floor_A: (f, m), floor_B: (f, d), m/N.
        plan: of a building; None of a plane frame.
        reference: (d,) stiffness of the dampers that the flexibilities contain, N/m; None: nothing.
        beside: dampers of other designs; None: there are none.
    """

    mass: np.ndarray
    influence: np.ndarray
    floor_of: np.ndarray
    A: np.ndarray
    B: np.ndarray
    C: np.ndarray
    floor_A: np.ndarray
    floor_B: np.ndarray
    plan: InPlan | None = None
    reference: np.ndarray | None = None
    beside: DampersBeside | None = None

    @property
    def standing(self) -> np.ndarray:
        """Stiffness of the dampers with which the frame is called bare, (d,) N/m: none, or that of `reference`."""
        return np.zeros(self.n_devices) if self.reference is None else self.reference

    @property
    def n_devices(self) -> int:
        """The number of dampers."""
        return self.C.shape[0]

    def at_floors(self, forces: np.ndarray) -> np.ndarray:
        """Return the horizontal forces of the floors, (..., f) N, from those on the masses.

        Args:
            forces: forces on the masses in the direction of the frame, (..., m) N.
        """
        here = (self.influence > 0.0) & (self.floor_of >= 0)
        rows = [np.bincount(self.floor_of[here], row[here], self.floor_A.shape[0]) for row in np.atleast_2d(forces)]
        return np.reshape(rows, (*forces.shape[:-1], self.floor_A.shape[0]))

    def modes(self, stiffness: np.ndarray | None = None) -> LinearModes:
        """Return all natural modes of the frame with dampers of a storage stiffness.

        Args:
            stiffness: storage stiffness of the dampers, (d,) N/m; None: without dampers, or with their `reference`.

        Raises:
            AnalysisError: a squared frequency is not positive.
        """
        flexibility, forces, dampers = self._with(self.standing if stiffness is None else stiffness)
        root = np.sqrt(self.mass)
        inverse, vectors = scipy.linalg.eigh(root[:, None] * flexibility * root)
        if inverse[0] <= 0.0:
            raise AnalysisError(f"modes: {UNSTABLE} [E-DESIGN-02]")
        omega = 1.0 / np.sqrt(inverse[::-1])
        shapes = vectors[:, ::-1].T / root
        if self.plan is not None:
            shapes = self._turned(omega, shapes)
        shapes *= np.where(shapes @ (self.mass * self.influence) < 0.0, -1.0, 1.0)[:, None]
        loads = omega[:, None] ** 2 * self.mass * shapes
        participation = shapes @ (self.mass * self.influence)
        to_floors, told = self._at_floors(forces), self.told_modes(participation)
        floors, lines, deformations = loads @ to_floors.T, loads @ self._at_lines(forces).T, loads @ dampers.T
        if self.plan is None:
            storeys, first, share = np.diff(floors, axis=1, prepend=0.0), 0, np.eye(1, omega.size)[0]
            of_first = (shapes[0], loads[0], floors[0], storeys[0], deformations[0], float(participation[0]))
            lead = Lead(share, *of_first)
        else:
            to_storeys = self.plan.storey_A - self.plan.storey_B @ forces
            storeys, first = loads @ to_storeys.T, int(np.argmax(participation**2))
            guided_omega, shape = self._guided(root[:, None] * flexibility * root)
            share, inertia = (shapes @ (self.mass * shape)) ** 2, guided_omega**2 * self.mass * shape
            led = (to_floors @ inertia, to_storeys @ inertia, dampers @ inertia)
            lead = Lead(share, shape, inertia, *led, float(shape @ (self.mass * self.influence)))
        beside, damping = np.zeros((omega.size, 0)), np.zeros(omega.size)
        if self.beside is not None:
            beside = loads @ (self.beside.B - self.beside.C @ forces).T
            damping = 0.5 * (beside**2 @ self.beside.stiffness.imag) / omega**2  # thesis Eq. 5.6
        found = (omega, shapes, floors, storeys, deformations, participation, lines, first, told, lead)
        return LinearModes(*found, beside, damping)

    def _guided(self, flexibility: np.ndarray) -> tuple[float, np.ndarray]:
        """Circular frequency and shape (m,) of the guided mode with most mass along the direction.

        Args:
            flexibility: times the roots of the masses, (m, m).
        """
        assert self.plan is not None, "a plane frame is guided as it is"
        guides, root = self.plan.guides, np.sqrt(self.mass)
        pushed = flexibility @ guides
        held = flexibility - pushed @ np.linalg.solve(guides.T @ pushed, pushed.T)
        inverse, vectors = scipy.linalg.eigh(0.5 * (held + held.T))
        count = self.mass.size - guides.shape[1]  # the others do not move
        omega = 1.0 / np.sqrt(inverse[::-1][:count])
        shapes = self._turned(omega, vectors[:, ::-1].T[:count] / root)
        participation = shapes @ (self.mass * self.influence)
        at = int(np.argmax(participation**2))
        return float(omega[at]), shapes[at] * (-1.0 if participation[at] < 0.0 else 1.0)

    def told_modes(self, participation: np.ndarray) -> np.ndarray:
        """Return the indices of the modes that results tell of: all of a plane frame.

        Of a building they are those with most effective mass in the direction of the frame, most first: as dampers are
        added, modes along the direction, across it and in turns pass each other.

        Args:
            participation: of modes in rising order of frequency, with generalised masses of 1, (n,).
        """
        if self.plan is None:
            return np.arange(participation.size)
        return np.argsort(-np.abs(participation), kind="stable")[:TOLD]

    def mass_ratios(self, modes: LinearModes) -> np.ndarray:
        """Return the effective masses of the modes of a building along x, along y and in turns, over the whole, (n, 3).

        Source: Chopra, Dynamics of Structures, 13.3.
        """
        assert self.plan is not None, "a plane frame has one direction"
        ground = self.mass * self.plan.ground
        whole = np.sum(ground * self.plan.ground, axis=1)
        return np.asarray((modes.masses @ ground.T) ** 2 / whole)

    def _turned(self, omega: np.ndarray, shapes: np.ndarray) -> np.ndarray:
        """Modes of one frequency turned so that one of them has all of their mass in the direction of the frame."""
        shapes = shapes.copy()
        for cluster in clusters(omega):
            participation = shapes[cluster] @ (self.mass * self.influence)
            size = float(np.linalg.norm(participation))
            if cluster.size > 1 and size > 0.0:
                turn, _ = np.linalg.qr(np.column_stack([participation / size, np.eye(cluster.size)]))
                shapes[cluster] = turn.T @ shapes[cluster]
        return shapes

    def complex_modes(self, stiffness: np.ndarray, like: LinearModes | None = None) -> tuple[np.ndarray, np.ndarray]:
        """Return frequencies and damping ratios of free vibrations with dampers of a complex stiffness.

        Free vibrations exp(i omega t) of M u'' + (K + D' (k' + i k'') D) u = 0, with k' and k'' whatever the frequency;
        the ratio is Im(omega) / |omega|.

        Args:
            stiffness: complex stiffness of the dampers, (d,) N/m.
            like: modes in whose order they are wanted; None: in rising order of frequency.

        Returns:
            |omega| in rad/s, and the damping ratios, (m,) each.

        Raises:
            AnalysisError: an eigenvalue is not finite.

        Source: structural damping, e.g. Clough and Penzien (1993), Dynamics of Structures, 3-7 and 12-4.
        """
        flexibility, _, _ = self._with(np.asarray(stiffness, dtype=complex))
        root = np.sqrt(self.mass)
        matrix = root[:, None] * flexibility * root
        inverse, vectors = (scipy.linalg.eigvals(matrix), None) if like is None else scipy.linalg.eig(matrix)
        if not np.all(np.isfinite(inverse)) or np.any(np.abs(inverse) == 0.0):
            raise AnalysisError(f"complex modes: {UNSTABLE} [E-DESIGN-02]")
        omega = np.sqrt(1.0 / inverse)
        order = np.argsort(np.abs(omega))
        if like is not None and vectors is not None:
            order = alike(like.masses * root, vectors.T)
        return np.abs(omega)[order], (omega.imag / np.abs(omega))[order]

    def static(self, loads: np.ndarray, stiffness: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return displacements of the floors and drift ratios on the lines of a building under static loads.

        Args:
            loads: loads on the masses, (m,) N.
            stiffness: stiffness of the dampers, (d,) N/m.

        Returns:
            Displacements of the floors (f,) m, and drift ratios on the lines (l,), none of a plane frame.
        """
        _, forces, _ = self._with(stiffness)
        return self._at_floors(forces) @ loads, self._at_lines(forces) @ loads

    def _at_floors(self, forces: np.ndarray) -> np.ndarray:
        """Displacements of the floors (f, m) by loads on the masses, with forces (d, m) of the dampers."""
        return self.floor_A - self.floor_B @ forces

    def _at_lines(self, forces: np.ndarray) -> np.ndarray:
        """Drift ratios on the lines of a building (l, m) likewise."""
        if self.plan is None:
            return np.zeros((0, self.mass.size), forces.dtype)
        return self.plan.line_A - self.plan.line_B @ forces

    def _with(self, stiffness: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """With dampers and loads on the masses: displacements of these, forces and deformations of the dampers.

        The forces are those beyond what the dampers have by their `reference`.
        """
        k = np.asarray(stiffness) - self.standing
        dampers = np.linalg.solve(np.eye(k.size) + self.C * k, self.B)  # deformation by loads on the masses
        forces = k[:, None] * dampers
        flexibility = self.A - self.B.T @ forces
        return 0.5 * (flexibility + flexibility.T), forces, dampers


def alike(wanted: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """Return the order of vectors in which each is like another one, (n,).

    Args:
        wanted: orthonormal, (n, m).
        vectors: real or complex, (n, m).
    """
    size = np.linalg.norm(vectors, axis=1)
    _, order = scipy.optimize.linear_sum_assignment(-np.abs(wanted @ vectors.T) / size)
    return np.asarray(order)


def condense(
    structure: Structure,
    direction: int = 0,
    beside: Mapping[str, complex] = MappingProxyType({}),
    reference: np.ndarray | None = None,
) -> CondensedFrame:
    """Reduce a structure in its present state, with its dampers' places but without their stiffness.

    Args:
        structure: the frame and its analysis, under gravity or not.
        direction: index of that of the ground motion and of the floors; masses of all directions are in the result.
        beside: complex stiffness, N/m, by name, of dampers that are not its own places but stand in it.
        reference: stiffness of its own dampers that the flexibilities shall contain, (d,) N/m; None: nothing.

    Returns:
        The flexibilities between masses, floors and dampers.

    Raises:
        AnalysisError: nothing has a mass, or the stiffness is singular.
    """
    analysis, frame = structure.analysis, structure.frame
    mass = analysis.masses()
    heavy = np.flatnonzero(mass > 0.0)
    if heavy.size == 0:
        raise AnalysisError("the frame has no masses [E-MODAL-02]")
    n = mass.size
    across = analysis.equations[:, frame.directions[direction].degree]
    floor_rows = np.zeros((len(frame.floors), n))
    floor_at = np.full(n, -1)
    for row, floor in enumerate(frame.floors):
        movers = analysis.along(floor.movers[direction]).toarray()
        moving = movers[movers.any(axis=1)]
        for mover in moving:
            floor_rows[row] += mover / len(moving)
            floor_at[mover != 0.0] = row
    influence = np.zeros(n)
    influence[across[across >= 0]] = 1.0
    every = analysis.damper_directions().toarray()
    own, others = ([d for d in frame.devices if (d.name in beside) == apart] for apart in (False, True))
    directions, theirs = (every[[device.number for device in devices]] for devices in (own, others))
    stiffness = analysis.stiffness()
    complex_stiffness = np.array([beside[device.name] for device in others], dtype=complex)
    for rows, k in ((theirs, complex_stiffness.real), (directions, reference)):
        if k is not None and k.size:
            sparse = scipy.sparse.csc_matrix(rows)
            stiffness = (stiffness + sparse.T @ scipy.sparse.diags(k) @ sparse).tocsc()
    space = frame.model.dimension == 3
    lines = [(i, at.ratio) for i, storey in enumerate(frame.storeys) for at in storey.drifts[direction] if space]
    unit = np.zeros((n, heavy.size))
    unit[heavy, np.arange(heavy.size)] = 1.0
    try:
        solver = scipy.sparse.linalg.splu(stiffness)
    except RuntimeError as error:
        raise AnalysisError(f"the stiffness of the frame is singular: {error} [E-GRAV-01]") from error
    by_masses, by_dampers = solver.solve(unit), solver.solve(np.ascontiguousarray(directions.T))
    plan = None
    if space:
        ratios = np.array([np.asarray(analysis.along([ratio]).toarray())[0] for _, ratio in lines]).reshape(-1, n)
        ground = _ground(structure, n)[:, heavy]
        storeys = _storey_rows(structure, floor_rows, direction)
        on_lines = (np.array([i for i, _ in lines]), ratios @ by_masses, ratios @ by_dampers)
        guides = _guides(structure, ground, heavy, direction)
        plan = InPlan(ground, *on_lines, storeys @ by_masses, storeys @ by_dampers, guides)
    stands = None
    if others:
        numbers = np.array([device.storey for device in others])
        pulls = np.array([pull(frame, device, frame.directions[direction].degree) for device in others])
        stands = DampersBeside(complex_stiffness, numbers, pulls, theirs @ by_masses, theirs @ by_dampers)
    return CondensedFrame(
        mass[heavy],
        influence[heavy],
        floor_at[heavy],
        by_masses[heavy],
        directions @ by_masses,
        directions @ by_dampers,
        floor_rows @ by_masses,
        floor_rows @ by_dampers,
        plan,
        reference,
        stands,
    )


def pull(frame: FrameModel, device: Device, across: int) -> float:
    """Return what the deformation of a damper grows by as the floor above it moves by 1.

    Args:
        across: degree of the core along which the floor moves.
    """
    above = {frame.nodes[name] for name in frame.floors[device.storey - 1].nodes}
    return sum(c for c, node, degree in device.terms if degree == across and node in above)


def _storey_rows(structure: Structure, floor_rows: np.ndarray, direction: int) -> np.ndarray:
    """Drifts of the storeys of a building at the centres of mass of the floors above, (f, n), by those of the floors.

    A floor below that turns moves there by its lever: -theta y along x, theta x along y.
    """
    frame, found = structure.frame, np.diff(floor_rows, axis=0, prepend=0.0)
    across = 1 - direction
    centres = [_centre(frame, floor.movers[direction][0])[across] for floor in frame.floors]
    for i, below in enumerate(frame.floors[:-1]):
        if below.turn:
            lever = (centres[i + 1] - centres[i]) * (-1.0 if direction == 0 else 1.0)
            found[i + 1] -= lever * np.asarray(structure.analysis.along([below.turn]).toarray())[0]
    return found


def _centre(frame: FrameModel, mover: Sum) -> np.ndarray:
    """The place in plan that a displacement is of, (2,) m: that of its nodes in the mean."""
    return np.sum(
        [share * np.array(frame.places[frame.model.node_names[node]][:2]) for share, node, _ in mover], axis=0
    )


def _ground(structure: Structure, n: int) -> np.ndarray:
    """How each degree with mass moves with a ground that moves along x, along y, or turns, (3, n)."""
    frame, equations = structure.frame, structure.analysis.equations
    mass = np.array(list(frame.masses.values()))
    plan = np.array([frame.places[name][:2] for name in frame.masses])
    found = np.zeros((3, n))
    for name, (x, y) in zip(frame.masses, plan - np.average(plan, axis=0, weights=mass), strict=True):
        moves = ((1.0, 0.0, -y), (0.0, 1.0, x), (0.0, 0.0, float(name in frame.turning)))
        for equation, of_ground in zip(equations[frame.nodes[name]][[0, 1, 5]].tolist(), moves, strict=True):
            if equation >= 0:  # the ground holds the others
                found[:, equation] = of_ground
    return found


def _guides(structure: Structure, ground: np.ndarray, heavy: np.ndarray, direction: int) -> np.ndarray:
    """The `guides` of a building, (m, h).

    Args:
        ground: as of `InPlan`, (3, m).
        heavy: equations with mass, (m,).
    """
    frame, equations = structure.frame, structure.analysis.equations
    root = np.sqrt(structure.analysis.masses()[heavy])
    found = [np.empty((heavy.size, 0))]
    for floor in frame.floors:
        here = np.isin(heavy, equations[[frame.nodes[name] for name in floor.nodes]][:, [0, 1, 5]])
        along = (ground[direction] * root)[here]
        if not along.any():
            continue
        others = np.zeros((heavy.size, along.size - 1))
        others[here] = scipy.linalg.qr(along[:, None])[0][:, 1:]
        found.append(others)
    return np.hstack(found)
