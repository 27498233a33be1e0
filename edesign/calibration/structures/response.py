"""Response of a shear building to base motion: exact between samples but for what dampers of the core do in it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm

from edesign.calibration.structures.building import System
from edesign.core import CoreError
from edesign.core.damper import AmendmentValues, CoreDamper
from edesign.core.fading import fading
from edesign.core.linked import LinkedTest, linked_histories
from edesign.estimation.model import PredictionError

_SHORT = 0.2  # k h^2 / (6 m) of a step h with a link of tangent stiffness k: forces linear in it are good to 2e-3
_MOST_PARTS = 64
_BOUNDLESS = 1e4  # m and m/s
_WELL_CONDITIONED = 1e8  # eigenvectors beyond it (critical damping) lose half of the digits
_NOTHING = (0.0, 0.0)
"""Of a Kelvin-Voigt law that carries nothing, for amendments that stand alone."""


@dataclass(frozen=True)
class Link:
    """A non-linear force between the two floors of a storey.

    Attributes:
        storey: it stands in; 0 is the lowest storey or the isolation layer.
        stiffest: bound of its tangent stiffness, N/m, by which steps are divided.
        law: of the core.
        values: its parameters in the order of the core, SI.
        amendments: beside or on it.
    """

    storey: int
    stiffest: float
    law: str
    values: tuple[float, ...]
    amendments: tuple[AmendmentValues, ...] = ()

    @staticmethod
    def alone(storey: int, stiffest: float, amendment: str, *values: float) -> Link:
        """Return a link that an amendment of the core makes without a law.

        Args:
            storey: it stands in.
            stiffest: bound of its tangent stiffness, N/m.
            amendment: of the core.
            values: its parameters in the order of the core, SI.
        """
        return Link(storey, stiffest, "kelvin_voigt", _NOTHING, (AmendmentValues(amendment, values),))

    @staticmethod
    def breaking(storey: int, stiffness: float, distance: float) -> Link:
        """Return a spring k exp(-(M/d)^2) u, M the largest deformation ever.

        Args:
            storey: it stands in.
            stiffness: k, N/m.
            distance: d, m.
        """
        broken = AmendmentValues("mullins.damage", (1.0, distance, 2.0, 0.0))
        return Link(storey, stiffness, "kelvin_voigt", (stiffness, 0.0), (broken,))

    @property
    def remembers(self) -> bool:
        """Whether one test changes it in the next."""
        return any(one.kind.partition(".")[0] in ("mullins", "degradation") for one in self.amendments)


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


def respond(system: System, motions: Sequence[tuple[np.ndarray, float]], links: Sequence[Link] = ()) -> list[Response]:
    """Return the responses to base motions in their order, each from rest.

    The linear part is exact for motions, and forces of links, that are linear between samples.

    Args:
        system: its equations.
        motions: acceleration (t,) m/s2 and its step, s.
        links: non-linear forces of storeys; some remember what they do from one test to the next.

    Raises:
        PredictionError: there is none for such links.
    """
    n = system.masses.size
    rows = system.drifts[[link.storey for link in links], :]
    if not links:
        found = [(_without_links(system, ground, step), np.zeros((ground.size, 0))) for ground, step in motions]
    else:
        parts = [_parts(system, rows, links, step) for _, step in motions]
        try:
            dampers = [CoreDamper(one.law, one.values, amendments=one.amendments) for one in links]
            fine = [_linked(system, rows, *one, p) for one, p in zip(motions, parts, strict=True)]
            states, forces = linked_histories(dampers, _seen(rows), fine, any(one.remembers for one in links))
        except CoreError as error:
            raise PredictionError(str(error)) from error
        found = [(x[::p], f[::p]) for x, f, p in zip(states, forces, parts, strict=True)]
    responses = []
    for state, force in found:
        if not np.max(np.abs(state)) < _BOUNDLESS:
            raise PredictionError("the response grows without bounds")
        q, v = state[:, :n], state[:, n:]
        restoring = q @ system.stiffness.T + v @ system.damping.T + force @ rows
        responses.append(Response(q, -restoring / system.masses, force))
    return responses


def transition(system: System, inputs: np.ndarray, step: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the exact step of the state x = (q, v) for inputs w that are linear in it: x1 = A x0 + B0 w0 + B1 w1.

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
    matrix[n : 2 * n, :n] = -system.stiffness / system.masses[:, np.newaxis]
    matrix[n : 2 * n, n : 2 * n] = -system.damping / system.masses[:, np.newaxis]
    matrix[n : 2 * n, 2 * n : 2 * n + w] = inputs
    matrix *= step
    matrix[2 * n : 2 * n + w, 2 * n + w :] = np.eye(w)
    power = expm(matrix)
    last = power[: 2 * n, 2 * n + w :]
    return power[: 2 * n, : 2 * n], power[: 2 * n, 2 * n : 2 * n + w] - last, last


def _seen(rows: np.ndarray) -> np.ndarray:
    """Return rows (2 links, 2n) that give deformations and velocities of links, of the state."""
    return np.vstack((np.hstack((rows, np.zeros_like(rows))), np.hstack((np.zeros_like(rows), rows))))


def _linked(system: System, rows: np.ndarray, ground: np.ndarray, step: float, parts: int) -> LinkedTest:
    """Return a test for the core, with each step cut into parts."""
    fine = np.interp(np.arange((ground.size - 1) * parts + 1) / parts, np.arange(ground.size), ground)
    inputs = np.hstack((-np.ones((system.masses.size, 1)), -rows.T / system.masses[:, np.newaxis]))
    a, b0, b1 = transition(system, inputs, step / parts)
    return LinkedTest(fine, step / parts, a, (b0[:, 0], b1[:, 0]), (b0[:, 1:], b1[:, 1:]))


def _without_links(system: System, ground: np.ndarray, step: float) -> np.ndarray:
    """Return states (t, 2n) without links: one recursion a complex mode."""
    n = system.masses.size
    a, b0, b1 = transition(system, -np.ones((n, 1)), step)
    values, vectors = np.linalg.eig(a)
    if np.linalg.cond(vectors) > _WELL_CONDITIONED:
        none = np.zeros((0, n))
        return linked_histories((), _seen(none), (_linked(system, none, ground, step, 1),))[0][0]
    left = np.linalg.solve(vectors, np.hstack((b0, b1)))
    kept = np.flatnonzero(values.imag >= 0.0)  # the conjugates follow
    modal = np.zeros((kept.size, ground.size), dtype=complex)
    for row, j in zip(modal, kept, strict=True):
        made = left[j, 0] * ground[:-1] + left[j, 1] * ground[1:]
        row[:] = fading(np.full(made.size, values[j]), made, 0.0)
    shapes = vectors[:, kept] * np.where(values[kept].imag > 0.0, 2.0, 1.0)
    return np.asarray((modal.real.T @ shapes.real.T) - (modal.imag.T @ shapes.imag.T))


def _parts(system: System, rows: np.ndarray, links: Sequence[Link], step: float) -> int:
    """Return into how many parts a step is cut, so that forces of the links are nearly linear in it."""
    inverse = rows @ (rows / system.masses).T
    stiffest = np.abs([link.stiffest for link in links])
    parts = math.sqrt(float(np.max(np.abs(inverse) @ stiffest)) * step**2 / 6.0 / _SHORT)
    if not parts <= _MOST_PARTS:
        raise PredictionError(f"a link is so stiff that a step of {step:g} s needs {parts:.0f} parts")
    return max(1, math.ceil(parts))
