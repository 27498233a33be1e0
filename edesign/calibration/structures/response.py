"""Response of a shear building to base motion: exact between samples but for what dampers of the core do in it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm

from edesign.calibration.structures.building import System
from edesign.core import CoreError
from edesign.core.damper import CoreDamper, EffectValues
from edesign.core.fading import fading
from edesign.core.linked import LinkedTest, linked_histories
from edesign.estimation.model import PredictionError

_SHORT, _SHORT_OF_ROUGH = (
    0.2,
    0.02,
)  # k h^2 / (6 m) of a step h with a link of tangent stiffness k: forces linear in it are good to 2e-3
_MOST_PARTS = 64
_BOUNDLESS = 1e4  # m and m/s
_WELL_CONDITIONED = 1e8  # eigenvectors beyond it (critical damping) lose half of the digits
_NOTHING = (0.0, 0.0)
"""Of a Kelvin-Voigt law that carries nothing, for effects that stand alone."""


@dataclass(frozen=True)
class Link:
    """A non-linear force between the two floors of a storey.

    Attributes:
        storey: it stands in; 0 is the lowest storey or the isolation layer.
        stiffest: bound of its tangent stiffness, N/m, by which steps are divided.
        law: of the core.
        values: its parameters in the order of the core, SI.
        effects: beside or on it.
    """

    storey: int
    stiffest: float
    law: str
    values: tuple[float, ...]
    effects: tuple[EffectValues, ...] = ()

    @staticmethod
    def alone(storey: int, stiffest: float, effect: str, *values: float) -> Link:
        """Return a link that an effect of the core makes without a law.

        Args:
            storey: it stands in.
            stiffest: bound of its tangent stiffness, N/m.
            values: its parameters in the order of the core, SI.
        """
        return Link(storey, stiffest, "kelvin_voigt", _NOTHING, (EffectValues(effect, values),))

    @staticmethod
    def breaking(storey: int, stiffness: float, distance: float) -> Link:
        """Return a spring k exp(-(M/d)^2) u, M the largest deformation ever.

        Args:
            storey: it stands in.
            stiffness: k, N/m.
            distance: d, m.
        """
        broken = EffectValues("mullins.damage", (1.0, distance, 2.0, 0.0))
        return Link(storey, stiffness, "kelvin_voigt", (stiffness, 0.0), (broken,))

    @property
    def remembers(self) -> bool:
        """Whether one test changes it in the next."""
        return any(one.name.partition(".")[0] in ("mullins", "degradation") for one in self.effects)


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


def respond(
    system: System,
    motions: Sequence[tuple[np.ndarray, float]],
    links: Sequence[Link] = (),
    every: int = 1,
    rough: bool = False,
) -> list[Response]:
    """Return the responses to base motions in their order, each from rest.

    The linear part is exact for motions, and forces of links, that are linear between samples. All samples of motions
    count, whatever samples of the response are wanted.

    Args:
        system: its equations.
        motions: acceleration (t,) m/s2 and its step, s.
        links: non-linear forces of storeys; some remember what they do from one test to the next.
        every: the response at one of so many samples of a motion is wanted, from the first one on.
        rough: whether forces of links may be linear over several samples of the motion, up to the next wanted one: good
            enough for differences of responses.

    Raises:
        PredictionError: there is none for such links.
    """
    n = system.masses.size
    rows = system.drifts[[link.storey for link in links], :]
    if not links:
        states = [_without_links(system, *one, every) for one in motions]
        found = [(x, np.zeros((len(x), 0))) for x in states]
    else:
        parts = [_parts(system, rows, links, step, every, rough) for _, step in motions]
        try:
            dampers = [CoreDamper(one.law, one.values, effects=one.effects) for one in links]
            tests = [_linked(system, rows, *one, every, p) for one, p in zip(motions, parts, strict=True)]
            states, forces = linked_histories(dampers, _seen(rows), tests, any(one.remembers for one in links))
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


def _linked(system: System, rows: np.ndarray, ground: np.ndarray, step: float, every: int, parts: int) -> LinkedTest:
    """Return a test for the core, with the time between wanted samples cut into parts."""
    together, finer = max(every // parts, 1), max(parts // every, 1)
    last = (ground.size - 1) // every * every
    if finer > 1:
        ground = np.interp(np.arange(last * finer + 1) / finer, np.arange(ground.size), ground)
    power, pushed = _pushed(system, ground[: last * finer + 1], step / finer, together)
    of_links = -rows.T / system.masses[:, np.newaxis]
    _, b0, b1 = transition(system, of_links, together * step / finer)
    return LinkedTest(pushed, together * step / finer, power, (b0, b1))


def _pushed(system: System, ground: np.ndarray, step: float, together: int) -> tuple[np.ndarray, np.ndarray]:
    """Return A (2n, 2n) of so many steps together, and what the ground adds to the state in each of them (t, 2n)."""
    a, b0, b1 = transition(system, -np.ones((system.masses.size, 1)), step)
    shares = np.zeros((together + 1, len(a)))  # of each sample of the ground within
    power = np.eye(len(a))
    for k in range(together, 0, -1):
        shares[k] += power @ b1[:, 0]
        shares[k - 1] += power @ b0[:, 0]
        power = power @ a
    return power, np.lib.stride_tricks.sliding_window_view(ground, together + 1)[::together] @ shares


def _without_links(system: System, ground: np.ndarray, step: float, every: int) -> np.ndarray:
    """Return states (t, 2n) without links: one recursion a complex mode, from wanted sample to wanted sample."""
    a, pushed = _pushed(system, ground[: (ground.size - 1) // every * every + 1], step, every)
    values, vectors = np.linalg.eig(a)
    if np.linalg.cond(vectors) > _WELL_CONDITIONED:
        nothing = np.zeros((len(a), 0))
        test = LinkedTest(pushed, every * step, a, (nothing, nothing))
        return linked_histories((), nothing.T, (test,))[0][0]
    kept = np.flatnonzero(values.imag >= 0.0)  # the conjugates follow
    made = pushed @ np.linalg.inv(vectors)[kept].T
    modal = np.zeros((kept.size, len(pushed) + 1), dtype=complex)
    for row, j, of_mode in zip(modal, kept, made.T, strict=True):
        row[:] = fading(np.full(of_mode.size, values[j]), of_mode, 0.0)
    shapes = vectors[:, kept] * np.where(values[kept].imag > 0.0, 2.0, 1.0)
    return np.asarray((modal.real.T @ shapes.real.T) - (modal.imag.T @ shapes.imag.T))


def _parts(system: System, rows: np.ndarray, links: Sequence[Link], step: float, every: int, rough: bool) -> int:
    """Return into how many parts the time between wanted samples is cut, so that links are nearly linear in them.

    A step of the motion is one part or several; of what may be rough a part may also be several steps.
    """
    inverse = rows @ (rows / system.masses).T
    stiffest = np.abs([link.stiffest for link in links])
    square = float(np.max(np.abs(inverse) @ stiffest)) * step**2 / 6.0
    finer = math.sqrt(square / _SHORT)
    if not finer <= _MOST_PARTS:
        raise PredictionError(f"a link is so stiff that a step of {step:g} s needs {finer:.0f} parts")
    if not rough:
        return every * max(1, math.ceil(finer))
    least = math.sqrt(square / _SHORT_OF_ROUGH)
    fewer = (parts for parts in range(1, every) if every % parts == 0 and parts >= every * least)
    return next(fewer, every * max(1, math.ceil(finer)))
