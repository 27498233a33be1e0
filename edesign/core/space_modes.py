"""Natural modes of space frames from the flexibility of the degrees that have mass."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class SpaceModes:
    """Natural modes in rising order of frequency, generalised mass 1.

    Attributes:
        omega: (k,) rad/s.
        period: (k,) s.
        shapes: (k, n_equations) over the equations of the model.
        floor_shapes: (k, f, 3) Ux, Uy, Rz of the masters.
        displacements: (k, n, 6) of the nodes.
        participation: (k, 3) factors for ground motion along x, along y (sqrt(kg)), about a vertical axis (m sqrt(kg)).
        effective_mass_ratio: (k, 3) effective modal masses over all mass that moves so.
        end_forces: (k, m, 12) of the members under `displacements`, N and N m.
    """

    omega: np.ndarray
    period: np.ndarray
    shapes: np.ndarray
    floor_shapes: np.ndarray
    displacements: np.ndarray
    participation: np.ndarray
    effective_mass_ratio: np.ndarray
    end_forces: np.ndarray


@dataclass(frozen=True)
class MassFactor:
    """A lumped mass matrix as B^T B; each row of B is a mass that moves along x or along y, or a moment of inertia.

    Attributes:
        b: (r, d) over the degrees that can have mass; sqrt(kg) and m sqrt(kg).
        equations: (d,) of these degrees.
        direction: (r,) 0 along x, 1 along y, 2 rotation about a vertical axis.
        size: (r,) root of the mass or moment of inertia; sqrt(kg), m sqrt(kg).
        place: (r, 2) in plan, m.
    """

    b: np.ndarray
    equations: np.ndarray
    direction: np.ndarray
    size: np.ndarray
    place: np.ndarray

    def rigid(self, origin: np.ndarray | None) -> np.ndarray:
        """Return B times rigid motions by 1 along x, along y, and about a vertical axis: (r, 3).

        The axis goes through `origin`, or without one through the centre of all masses that move.

        Args:
            origin: (2,) x and y, m; None: the centre of all masses that move.
        """
        weight = self.size**2 * (self.direction == 0)
        centre = weight @ self.place / np.sum(weight) if np.any(weight) else np.zeros(2)
        x, y = (self.place - (centre if origin is None else origin)).T
        motion = np.zeros((self.size.size, 3))
        for direction, turned in ((0, -y), (1, x)):
            motion[self.direction == direction, direction] = 1.0
            motion[:, 2] += np.where(self.direction == direction, turned, 0.0)
        motion[self.direction == 2, 2] = 1.0
        return self.size[:, None] * motion


@dataclass(frozen=True)
class MassModes:
    """Modes by the inertia forces that cause them.

    Attributes:
        omega: (k,) rad/s.
        inertia: (k, d) forces omega^2 M phi at the degrees with mass, under which the frame takes the shape phi.
        participation, effective_mass_ratio: (k, 3).
    """

    omega: np.ndarray
    inertia: np.ndarray
    participation: np.ndarray
    effective_mass_ratio: np.ndarray


def mass_factor(
    mass: np.ndarray, coordinates: np.ndarray, node_floor: np.ndarray, masters: np.ndarray, equation: np.ndarray
) -> MassFactor:
    """Return B of the mass matrix B^T B of masses at nodes that act horizontally.

    A diaphragm moves as its mass at the centre of mass and as the polar moment of inertia about that centre: rows
    sqrt(m) (1, 0, -e_y), sqrt(m) (0, 1, e_x) and sqrt(J) (0, 0, 1) over Ux, Uy, Rz, e from the master to the centre.

    Args:
        mass: (n,) kg.
        coordinates: (n, 3) m.
        node_floor: (n,) diaphragm of each node, -1: none.
        masters: (f, 2) m.
        equation: (6 n + 3 f,) equation of each degree of the nodes and of the masters, -1: restrained.

    Raises:
        ValueError: a mass is negative or not finite, or no mass can move.
    """
    wrong = np.flatnonzero(~(np.isfinite(mass) & (mass >= 0.0)))
    if wrong.size:
        raise ValueError(
            f"the mass of node {wrong[0]} is {mass[wrong[0]]:g} kg; it must be a finite number of at least 0"
        )
    n, n_floors, plan = len(mass), len(masters), coordinates[:, :2]
    on_floor, alone = np.flatnonzero(node_floor >= 0), np.flatnonzero((node_floor < 0) & (mass > 0.0))
    floor, weight = node_floor[on_floor], mass[on_floor]
    total = np.bincount(floor, weight, n_floors)
    moment = np.stack([np.bincount(floor, weight * x, n_floors) for x in plan[on_floor].T], axis=1)
    centre = moment / np.where(total > 0.0, total, 1.0)[:, None]
    polar = np.bincount(floor, weight * np.sum((plan[on_floor] - centre[floor]) ** 2, axis=1), n_floors)
    # masses at one place: what is left is rounding of their centre
    polar[polar <= total * (4.0 * np.finfo(float).eps * np.max(np.abs(plan))) ** 2] = 0.0
    U_x, U_y, R_z = equation[6 * n :].reshape(n_floors, 3).T
    root, single = np.sqrt(total), np.sqrt(mass[alone])
    e_x, e_y = (centre - masters).T
    size = np.concatenate([root, root, np.sqrt(polar), single, single])
    direction = np.repeat([0, 1, 2, 0, 1], [n_floors] * 3 + [alone.size] * 2)
    place = np.concatenate([centre] * 3 + [plan[alone]] * 2)
    own = np.concatenate([U_x, U_y, R_z, equation[6 * alone], equation[6 * alone + 1]])
    turning = np.concatenate([R_z, R_z, np.full(n_floors + 2 * alone.size, -1)])
    arm = np.concatenate([-root * e_y, root * e_x, np.zeros(n_floors + 2 * alone.size)])
    moves, turns = (own >= 0) & (size > 0.0), (turning >= 0) & (arm != 0.0)
    rows = np.flatnonzero(moves | turns)
    if not rows.size:
        raise ValueError("no mass can move: the frame has none, or supports restrain all of it")
    equations = np.unique(np.concatenate([own[moves], turning[turns]]))
    b = np.zeros((size.size, equations.size))
    b[moves, np.searchsorted(equations, own[moves])] = size[moves]
    b[turns, np.searchsorted(equations, turning[turns])] = arm[turns]
    return MassFactor(b[rows], equations, direction[rows], size[rows], place[rows])


def mass_modes(flexibility: np.ndarray, factor: MassFactor, count: int | None, origin: np.ndarray | None) -> MassModes:
    """Return the lowest modes from the flexibility F of the degrees with mass.

    B F B^T y = y / omega^2 is symmetric, and phi = omega^2 F B^T y has generalised mass 1.

    Args:
        flexibility: (d, d) displacements under a unit force at each of the degrees with mass.
        factor: the mass matrix over these degrees.
        count: how many modes; all without it.
        origin: (2,) place that rotation about a vertical axis refers to; the centre of all masses without it.

    Raises:
        ValueError: there are fewer modes than asked for.
    """
    weighted = factor.b @ flexibility @ factor.b.T
    inverse, vectors = np.linalg.eigh(0.5 * (weighted + weighted.T))
    inverse, vectors = inverse[::-1], vectors[:, ::-1]
    there = int(np.sum(inverse > inverse.size * np.finfo(float).eps * inverse[0]))
    count = there if count is None else count
    if not 0 < count <= there:
        raise ValueError(f"{count} modes are asked for; the frame has {there}")
    omega, y = 1.0 / np.sqrt(inverse[:count]), vectors[:, :count]
    y = y * np.sign(np.take_along_axis(y, np.argmax(np.abs(y), axis=0)[None], axis=0))
    rigid = factor.rigid(origin)
    participation = y.T @ rigid
    total = np.sum(rigid**2, axis=0)
    ratio = np.divide(participation**2, total, out=np.zeros_like(participation), where=total > 0.0)
    return MassModes(omega, (y.T @ factor.b) * omega[:, None] ** 2, participation, ratio)
