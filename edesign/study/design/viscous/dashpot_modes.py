"""Complex modes of a frame with linear dashpots and springs in series: nothing is approximated."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from edesign.errors import AnalysisError
from edesign.study.design.condensed import CondensedFrame, LinearModes

_REAL = 1e-9  # of an eigenvalue: imaginary parts below it are rounding of two modes that do not oscillate
_STILL = 1e-9  # of the largest displacement of a floor: at the roof, along which the mode does not move
_ALIKE = 0.5
"""Share of the first mode without dampers in the kinetic energy: at most one mode has more. In a building it is the
effective mass along the design over that of the leading mode without dampers."""


@dataclass(frozen=True)
class DashpotModes:
    """Free vibrations exp(s t) that oscillate, in rising order of abs(s).

    Attributes:
        omega: abs(s), (n,) rad/s.
        damping: -Re(s) / abs(s), (n,).
        first: index of the mode most like the first mode without dampers, of a building of the one that leads along the
            direction; None: that does not oscillate.
        like: index of the mode whose shape is most like that of the first mode without dampers; None: none is.
        floors: horizontal displacement of each floor, complex (n, f), in modes of roof displacement 1.
        storeys: drift of each storey, likewise (see `LinearModes`).
        dashpots: amplitude of the deformation of each dashpot without its spring, likewise, (n, d).
        told: indices of the modes that results tell of, as `CondensedFrame.told_modes`.
    """

    omega: np.ndarray
    damping: np.ndarray
    first: int | None
    like: int | None
    floors: np.ndarray
    storeys: np.ndarray
    dashpots: np.ndarray
    told: np.ndarray

    @property
    def first_omega(self) -> float:
        """Circular frequency of the first mode, rad/s; nan where the mode does not oscillate."""
        return np.nan if self.first is None else float(self.omega[self.first])

    @property
    def first_damping(self) -> float:
        """Damping ratio of the first mode; 1 where the mode does not oscillate."""
        return 1.0 if self.first is None else float(self.damping[self.first])


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
    oscillates = np.flatnonzero(inverse.imag < -_REAL * np.abs(inverse))
    oscillates = oscillates[np.argsort(-np.abs(inverse[oscillates]), kind="stable")]
    s, shapes = 1.0 / inverse[oscillates], vectors[:, oscillates].T
    q, velocity = shapes[:, :n], shapes[:, 2 * n :]
    floors = q @ bare.floors - (velocity * dashpots) @ (frame.floor_B - bare.floors.T @ share.T).T
    energy = np.sum(np.abs(q) ** 2, axis=1)
    participation = np.abs(q @ bare.participation) / np.sqrt(energy)
    likeness = np.abs(q[:, bare.first]) ** 2 / energy
    like = int(np.argmax(likeness)) if s.size else None
    if frame.plan is not None:  # modes of nearly one frequency mix as dampers are added
        likeness = (participation / bare.participation[bare.first]) ** 2
    first = int(np.argmax(likeness)) if s.size and likeness.max() > _ALIKE else None
    roof = floors[:, -1:]
    roof = np.where(np.abs(roof) > _STILL * np.abs(floors).max(axis=1, keepdims=True), roof, 1.0)
    floors /= roof
    storeys = np.diff(floors, axis=1, prepend=0.0)
    if frame.plan is not None:
        own = frame.plan.storey_B - bare.storeys.T @ share.T
        storeys = (q @ bare.storeys - (velocity * dashpots) @ own.T) / roof
    dashpot, told = np.abs(velocity / s[:, None] / roof), frame.told_modes(participation)
    return DashpotModes(np.abs(s), -s.real / np.abs(s), first, like, floors, storeys, dashpot, told)
