"""Complex modes of a frame with linear dashpots and springs in series: nothing is approximated."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from edesign.errors import AnalysisError
from edesign.study.design.condensed import CondensedFrame, LinearModes

_REAL = 1e-9  # of the largest eigenvalue: imaginary parts below it are rounding of two modes that do not oscillate
_STILL = 1e-9  # of the largest displacement of a floor: at the roof, along which the mode does not move
_ALIKE = 0.5
"""Share of the first mode without dampers in the kinetic energy: at most one mode has more. In a building it is the
effective mass of a guided mode along the design over that without dampers."""


@dataclass(frozen=True)
class FirstVibration:
    """The first mode with dashpots; of a building what stands for it along the direction, as `Lead`.

    Attributes:
        omega: rad/s.
        damping: ratio.
        roof: displacement of the roof, 1, or where it does not move anything.
        storeys: drift of each storey, complex (f,), for a roof displacement of 1 (see `LinearModes`).
        dashpots: amplitude of the deformation of each dashpot without its spring, likewise, (d,).
    """

    omega: float
    damping: float
    roof: complex
    storeys: np.ndarray
    dashpots: np.ndarray


@dataclass(frozen=True)
class DashpotModes:
    """Free vibrations exp(s t) that oscillate, in rising order of abs(s).

    Attributes:
        omega: abs(s), (n,) rad/s.
        damping: -Re(s) / abs(s), (n,).
        told: indices of the modes that results tell of, as `CondensedFrame.told_modes`.
        first: the vibration that is most like the first mode without dampers; None: that does not oscillate.
    """

    omega: np.ndarray
    damping: np.ndarray
    told: np.ndarray
    first: FirstVibration | None

    @property
    def first_omega(self) -> float:
        """Circular frequency of the first mode, rad/s; nan where the mode does not oscillate."""
        return np.nan if self.first is None else self.first.omega

    @property
    def first_damping(self) -> float:
        """Damping ratio of the first mode; 1 where the mode does not oscillate."""
        return 1.0 if self.first is None else self.first.damping


def dashpot_modes(
    frame: CondensedFrame, bare: LinearModes, dashpots: np.ndarray, flexibility: np.ndarray
) -> DashpotModes:
    """Return the complex modes of the frame with a linear dashpot and a spring in series at each place.

    With q of the modes without dampers and g the velocities of the dashpots: q'' + Omega^2 q + D' c g = 0 and
    (C0 + 1/k) c g' + g = D q', where C0 is the flexibility between the places that the masses do not share. All modes
    without dampers are there, so this is exact.

    Args:
        dashpots: c, (d,) N s/m.
        flexibility: 1/k of the springs in series, (d,) m/N; 0: rigid.

    Raises:
        AnalysisError: an eigenvalue is not finite.

    Source: state space of non-classical damping, Veletsos and Ventura (1986), EESD 14(2); a dashpot with a spring in
        series is thesis Eq. 2.25.
    """
    n, d = bare.omega.size, dashpots.size
    D = bare.dampers.T
    share = D / bare.omega**2
    C0 = frame.C - share @ D.T
    forces = D.T * dashpots
    right = np.zeros((2 * n + d, 2 * n + d))
    right[:n, n : 2 * n] = np.eye(n)
    right[n : 2 * n, :n] = -np.diag(bare.omega**2)
    right[n : 2 * n, 2 * n :] = -forces
    right[2 * n :, n : 2 * n] = D
    right[2 * n :, 2 * n :] = -np.eye(d)
    left = np.eye(2 * n + d)
    left[2 * n :, 2 * n :] = (C0 + np.diag(flexibility)) * dashpots
    inverse, vectors = scipy.linalg.eig(np.linalg.solve(right, left))
    if not np.all(np.isfinite(inverse)):
        raise AnalysisError("complex modes: an eigenvalue is not finite [E-DESIGN-02]")
    oscillates = _oscillates(inverse)
    oscillates = oscillates[np.argsort(-np.abs(inverse[oscillates]), kind="stable")]
    s, shapes = 1.0 / inverse[oscillates], vectors[:, oscillates].T
    q = shapes[:, :n]
    energy = np.sum(np.abs(q) ** 2, axis=1)
    told = frame.told_modes(np.abs(q @ bare.participation) / np.sqrt(energy))
    omega, damping = np.abs(s), -s.real / np.abs(s)

    def vibration(states: np.ndarray, i: int, s: complex, omega: float, damping: float) -> FirstVibration:
        """That of row i of states that vibrate with exp(s t)."""
        q, velocity = states[:, :n], states[:, 2 * n :]
        floors = q @ bare.floors - (velocity * dashpots) @ (frame.floor_B - bare.floors.T @ share.T).T
        roof = floors[:, -1:]
        roof = np.where(np.abs(roof) > _STILL * np.abs(floors).max(axis=1, keepdims=True), roof, 1.0)
        floors /= roof
        storeys = np.diff(floors, axis=1, prepend=0.0)
        if frame.plan is not None:
            own = frame.plan.storey_B - bare.storeys.T @ share.T
            storeys = (q @ bare.storeys - (velocity * dashpots) @ own.T) / roof
        return FirstVibration(omega, damping, floors[i, -1], storeys[i], np.abs(velocity[i] / s / roof[i]))

    if frame.plan is None:
        likeness = np.abs(q[:, bare.first]) ** 2 / energy
        if not s.size or likeness.max() <= _ALIKE:
            return DashpotModes(omega, damping, told, None)
        at = int(np.argmax(likeness))
        return DashpotModes(omega, damping, told, vibration(shapes, at, s[at], float(omega[at]), float(damping[at])))
    led = _guided(frame, bare, right, left)
    if led is None:
        return DashpotModes(omega, damping, told, None)
    of_s, state = led
    parts, rest = _shares(vectors, oscillates, state, n)
    whole = parts.sum()
    mean_omega = float(parts @ omega / whole)
    mean_damping = float((parts @ damping + rest) / (whole + rest))  # what does not oscillate is damped critically
    turned = of_s**2 * np.linalg.solve(right, left @ np.linalg.solve(right, left @ state))  # under its inertia forces
    return DashpotModes(omega, damping, told, vibration(turned[None], 0, of_s, mean_omega, mean_damping))


def _oscillates(inverse: np.ndarray) -> np.ndarray:
    """Indices of eigenvalues 1/s of vibrations that oscillate, one of each pair."""
    return np.flatnonzero(inverse.imag < -_REAL * np.abs(inverse).max())


def _guided(
    frame: CondensedFrame, bare: LinearModes, right: np.ndarray, left: np.ndarray
) -> tuple[complex, np.ndarray] | None:
    """The s and state x of right x = s left x of the guided building (see `Lead`); None: it does not oscillate."""
    assert frame.plan is not None, "a plane frame is guided as it is"
    n = bare.omega.size
    guides = (bare.masses * np.sqrt(frame.mass)) @ frame.plan.guides
    free = scipy.linalg.qr(guides)[0][:, guides.shape[1] :]
    into = scipy.linalg.block_diag(free, free, np.eye(len(right) - 2 * n))
    own_right, own_left = into.T @ right @ into, into.T @ left @ into
    inverse, vectors = scipy.linalg.eig(np.linalg.solve(own_right, own_left))
    oscillates = _oscillates(inverse)
    q = free @ vectors[: free.shape[1], oscillates]
    likeness = np.abs(bare.participation @ q) ** 2 / np.sum(np.abs(q) ** 2, axis=0) / bare.lead.participation**2
    if not likeness.size or likeness.max() <= _ALIKE:
        return None
    at = oscillates[int(np.argmax(likeness))]
    return complex(1.0 / inverse[at]), into @ vectors[:, at]


def _shares(vectors: np.ndarray, oscillates: np.ndarray, state: np.ndarray, n: int) -> tuple[np.ndarray, float]:
    """How the vibrations of vectors (columns) share a state: each of those that oscillate, and all others together.

    The state is the sum of vibrations. A part is the size of what one and its conjugate have of the n modal
    displacements of the state, along these: without dashpots that is `Lead.share`. Where two vibrations coincide
    both parts grow without limit, alike, so that means by them are continuous.
    """
    own, mirrored = np.linalg.lstsq(vectors, np.column_stack([state, state.conj()]))[0].T
    along = state[:n].conj() / np.sum(np.abs(state[:n]) ** 2)
    parts = ((along @ vectors[:n]) * own + ((along.conj() @ vectors[:n]) * mirrored).conj())[oscillates]
    return np.abs(parts), float(abs(1.0 - parts.sum()))
