"""Response of a shear building to base acceleration: exact between samples for its linear part."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm

from edesign.calibrate.structure.building import System
from edesign.calibrate.structure.links import Link
from edesign.core.fading import fading

_CONTRACTION = 0.2  # of the iteration for the forces of the links: nine digits in a dozen turns
_TURNS, _CLOSE = 40, 1e-8
_SMALL = 1e-6  # N
_MOST_DIVISIONS = 64
_BOUNDLESS = 1e4  # m and m/s
_WELL_CONDITIONED = 1e8  # eigenvectors beyond it (critical damping) lose half of the digits


@dataclass(frozen=True)
class Response:
    """Histories of the floors.

    Attributes:
        displacement: (t, n) m, relative to the ground.
        acceleration: (t, n) m/s2, absolute.
        forces: (t, links) N.
    """

    displacement: np.ndarray
    acceleration: np.ndarray
    forces: np.ndarray


class NoResponse(Exception):
    """A response that grows without bounds, or steps too long for a link."""


def simulate(system: System, ground: np.ndarray, step: float, links: Sequence[Link] = ()) -> Response:
    """Response from rest.

    Args:
        system: its equations.
        ground: acceleration (t,) m/s2 at equal steps, linear between them.
        step: s.
        links: non-linear forces of storeys; they remember what they do from one test to the next.

    Raises:
        NoResponse: there is none for such links.

    The linear part is integrated exactly for forces linear between samples (first-order hold); forces of links are
    found at the end of each step by iteration, and steps are divided where a link is too stiff for it.
    """
    n = system.masses.size
    rows = system.drifts[[link.storey for link in links], :]
    divisions = _divisions(system, rows, links, step)
    fine = ground
    if divisions > 1:
        at = np.arange((ground.size - 1) * divisions + 1) / divisions
        fine = np.interp(at, np.arange(ground.size), ground)
    # a state without links by filters, one with them step by step
    if links:
        state, forces = _stepwise(system, rows, links, fine, step / divisions)
        state, forces = state[::divisions], forces[::divisions]
    else:
        state, forces = _filtered(system, fine, step), np.zeros((ground.size, 0))
    if not (np.isfinite(forces).all() and np.max(np.abs(state)) < _BOUNDLESS):
        raise NoResponse("the response grows without bounds")
    q, v = state[:, :n], state[:, n:]
    restoring = q @ system.stiffness.T + v @ system.damping.T + forces @ rows
    return Response(q, -restoring / system.masses, forces)


def transition(system: System, inputs: np.ndarray, step: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Exact step of the state (q, v) for inputs that are linear in it: x1 = A x0 + B0 w0 + B1 w1.

    Args:
        system: its equations.
        inputs: (n, w) acceleration of the floors per unit of each input.
        step: s.

    Returns:
        A (2n, 2n), B0 and B1 (2n, w).

    Source: Van Loan (1978), IEEE Trans. Automatic Control 23, 395; first-order hold.
    """
    n, w = inputs.shape
    matrix = np.zeros((2 * n + 2 * w, 2 * n + 2 * w))
    matrix[:n, n : 2 * n] = np.eye(n)
    matrix[n : 2 * n, :n] = -system.stiffness / system.masses[:, None]
    matrix[n : 2 * n, n : 2 * n] = -system.damping / system.masses[:, None]
    matrix[n : 2 * n, 2 * n : 2 * n + w] = inputs
    matrix *= step
    matrix[2 * n : 2 * n + w, 2 * n + w :] = np.eye(w)
    power = expm(matrix)
    last = power[: 2 * n, 2 * n + w :]
    return power[: 2 * n, : 2 * n], power[: 2 * n, 2 * n : 2 * n + w] - last, last


def _filtered(system: System, ground: np.ndarray, step: float) -> np.ndarray:
    """States (t, 2n) without links: one recursion a complex mode."""
    n = system.masses.size
    a, b0, b1 = transition(system, -np.ones((n, 1)), step)
    values, vectors = np.linalg.eig(a)
    if np.linalg.cond(vectors) > _WELL_CONDITIONED:
        return _stepwise(system, np.zeros((0, n)), (), ground, step)[0]
    left = np.linalg.solve(vectors, np.hstack((b0, b1)))
    kept = np.flatnonzero(values.imag >= 0.0)  # the conjugates follow
    modal = np.zeros((kept.size, ground.size), dtype=complex)
    for row, j in zip(modal, kept, strict=True):
        made = left[j, 0] * ground[:-1] + left[j, 1] * ground[1:]
        row[:] = fading(np.full(made.size, values[j]), made, 0.0)
    shapes = vectors[:, kept] * np.where(values[kept].imag > 0.0, 2.0, 1.0)
    return np.asarray((modal.real.T @ shapes.real.T) - (modal.imag.T @ shapes.imag.T))


def _stepwise(
    system: System, rows: np.ndarray, links: Sequence[Link], ground: np.ndarray, step: float
) -> tuple[np.ndarray, np.ndarray]:
    """States (t, 2n) and forces of links (t, m), step by step.

    A row of `history` is the state with no force of links at the end of the step, then deformations and velocities of
    the links; the deformations make room for the forces once they are found, which the next step needs.
    """
    n, m = system.masses.size, len(links)
    inputs = np.hstack((-np.ones((n, 1)), -rows.T / system.masses[:, None]))
    a, b0, b1 = transition(system, inputs, step)
    seen = np.zeros((2 * m, 2 * n))
    seen[:m, :n], seen[m:, n:] = rows, rows
    observe = np.vstack((np.eye(2 * n), seen))
    matrix = np.zeros((2 * n + 2 * m, 2 * n + 2 * m))
    matrix[:, : 2 * n] = observe @ a
    matrix[:, 2 * n : 2 * n + m] = observe @ (a @ b1[:, 1:] + b0[:, 1:])
    drive = np.outer(ground[:-1], observe @ b0[:, 0]) + np.outer(ground[1:], observe @ b1[:, 0])
    gain = seen @ b1[:, 1:]
    by_force = [list(zip(gain[i].tolist(), gain[m + i].tolist(), strict=True)) for i in range(m)]
    history = np.zeros((ground.size, 2 * n + 2 * m))
    for link in links:
        link.begin(step)
    forces = [0.0] * m
    before = history[0]
    for row, driven in zip(history[1:], drive, strict=True):
        np.dot(matrix, before, out=row)
        row += driven
        if m == 1:
            u, v = row.item(2 * n), row.item(2 * n + 1)
            forces[0] = row[2 * n] = _link_at_end(links[0], u, v, by_force[0][0], forces[0])
        elif m:
            forces = _links_at_end(links, row[2 * n :].tolist(), by_force, forces)
            row[2 * n : 2 * n + m] = forces
        before = row
    found = history[:, 2 * n : 2 * n + m].copy()
    return history[:, : 2 * n] + found @ b1[:, 1:].T, found


def _link_at_end(link: Link, u: float, v: float, by_force: tuple[float, float], force: float) -> float:
    """Force of the only link at the end of a step; the same as `_links_at_end`, without its lists."""
    to_u, to_v = by_force
    for _ in range(_TURNS):
        last = force
        force = link.force(u + to_u * last, v + to_v * last)
        if abs(force - last) <= _CLOSE * abs(force) + _SMALL:
            link.commit(u + to_u * last, v + to_v * last)
            return force
    raise NoResponse("the force of a link does not converge")


def _links_at_end(
    links: Sequence[Link],
    free: list[float],
    by_force: Sequence[Sequence[tuple[float, float]]],
    forces: list[float],
) -> list[float]:
    """Forces of the links at the end of a step, from those at its beginning."""
    m = len(links)
    u, v = free[:m], free[m:]
    for _ in range(_TURNS):
        change = 0.0
        for i, link in enumerate(links):
            u_i, v_i = free[i], free[m + i]
            for (to_u, to_v), force in zip(by_force[i], forces, strict=True):
                u_i += to_u * force
                v_i += to_v * force
            force = link.force(u_i, v_i)
            change = max(change, abs(force - forces[i]) - _CLOSE * abs(force) - _SMALL)
            forces[i], u[i], v[i] = force, u_i, v_i
        if change <= 0.0:
            break
    else:
        raise NoResponse("forces of links do not converge")
    for i, link in enumerate(links):
        link.commit(u[i], v[i])
    return forces


def _divisions(system: System, rows: np.ndarray, links: Sequence[Link], step: float) -> int:
    """Parts of a step that make the iteration for the links' forces contract: its gain is about k h^2 / (6 m)."""
    if not links:
        return 1
    stiffest = np.abs([link.stiffest for link in links])
    inverse = rows @ (rows / system.masses).T
    largest = float(np.max(np.sum(np.abs(inverse) * stiffest, axis=1))) * step**2 / 6.0
    parts = math.sqrt(largest / _CONTRACTION)
    if not parts <= _MOST_DIVISIONS:
        raise NoResponse(f"a link is so stiff that a step of {step:g} s needs {parts:.0f} parts")
    return max(1, math.ceil(parts))
