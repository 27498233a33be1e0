"""Measures of the strength and duration of a ground motion, of the polygon through its samples."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from edesign.ground_motion.arguments import checked_motion
from edesign.ground_motion.record import Record
from edesign.project.notation.units import STANDARD_GRAVITY


@dataclass(frozen=True)
class Measures:
    """Strength and duration of a ground motion.

    Attributes:
        pga: peak ground acceleration, m/s2.
        pgv: peak ground velocity, m/s.
        pgd: peak ground displacement, m.
        arias: Arias intensity, m/s.
        duration_5_95: time between 5 and 95 % of the Arias intensity, s.
        duration_5_75: time between 5 and 75 % of the Arias intensity, s.
        cav: cumulative absolute velocity, m/s.
        end_velocity: ground velocity at the last sample, m/s.
        end_displacement: ground displacement at the last sample, m.
    """

    pga: float
    pgv: float
    pgd: float
    arias: float
    duration_5_95: float
    duration_5_75: float
    cav: float
    end_velocity: float
    end_displacement: float


def velocity(acceleration: ArrayLike, time_step: float) -> np.ndarray:
    """Return the ground velocity from rest, exact for acceleration that is linear between samples.

    Args:
        acceleration: (n,) m/s2.
        time_step: s.

    Returns:
        (n,) m/s.

    Raises:
        InputError: fewer than two samples, one that is not finite, or a time step that is not positive.
    """
    a, dt = checked_motion(acceleration, time_step)
    v = np.zeros(a.size)
    np.cumsum(0.5 * dt * (a[1:] + a[:-1]), out=v[1:])
    return v


def displacement(acceleration: ArrayLike, time_step: float) -> np.ndarray:
    """Return the ground displacement from rest, exact for acceleration that is linear between samples.

    Args:
        acceleration: (n,) m/s2.
        time_step: s.

    Returns:
        (n,) m.

    Raises:
        InputError: as for `velocity`.
    """
    a, dt = checked_motion(acceleration, time_step)
    d = np.zeros(a.size)
    np.cumsum(dt * velocity(a, dt)[:-1] + dt**2 * (a[:-1] / 3.0 + a[1:] / 6.0), out=d[1:])
    return d


def husid(acceleration: ArrayLike, time_step: float) -> np.ndarray:
    """Return the share of the Arias intensity up to each sample, from 0 to 1; zero throughout where nothing moves.

    Args:
        acceleration: (n,) m/s2.
        time_step: s.

    Returns:
        (n,) without unit.

    Raises:
        InputError: as for `velocity`.

    Source: Husid (1969).
    """
    energy = _squared_integral(*checked_motion(acceleration, time_step))
    return np.asarray(energy / energy[-1]) if energy[-1] > 0.0 else energy


def measures(record: Record) -> Measures:
    """Return the intensity measures of a record.

    Integrals are those of the polygon through the samples, exactly; peaks are at samples.

    Arias intensity is pi / (2 g) times the integral of the squared acceleration, the significant durations run between
    shares of it, and cumulative absolute velocity is the integral of the absolute acceleration.

    Source: Arias (1970); Trifunac & Brady (1975), 5-95 %; Somerville et al. (1997), 5-75 %; EPRI NP-5930 (1988), CAV.
    """
    a, dt = record.acceleration, record.time_step
    energy = _squared_integral(a, dt)
    v, d = velocity(a, dt), displacement(a, dt)
    t5, t75, t95 = (_time_of_share(energy, dt, share) for share in (0.05, 0.75, 0.95))
    return Measures(
        pga=record.pga,
        pgv=float(np.max(np.abs(v))),
        pgd=float(np.max(np.abs(d))),
        arias=float(np.pi / (2.0 * STANDARD_GRAVITY) * energy[-1]),
        duration_5_95=t95 - t5,
        duration_5_75=t75 - t5,
        cav=_absolute_integral(a, dt),
        end_velocity=float(v[-1]),
        end_displacement=float(d[-1]),
    )


def _squared_integral(a: np.ndarray, dt: float) -> np.ndarray:
    """Integral of the squared polygon up to each sample."""
    energy = np.zeros(a.size)
    np.cumsum(dt / 3.0 * (a[:-1] ** 2 + a[:-1] * a[1:] + a[1:] ** 2), out=energy[1:])
    return energy


def _absolute_integral(a: np.ndarray, dt: float) -> float:
    """Integral of the absolute value of the polygon: trapezia, and two triangles where it changes sign."""
    start, end = np.abs(a[:-1]), np.abs(a[1:])
    total = start + end
    crossing = a[:-1] * a[1:] < 0.0
    triangles = np.divide(start**2 + end**2, total, out=np.zeros_like(total), where=crossing)
    return float(0.5 * dt * np.sum(np.where(crossing, triangles, total)))


def _time_of_share(energy: np.ndarray, dt: float, share: float) -> float:
    """Time at which an integral reaches a share of its end value, s; taken as linear within the step."""
    wanted = share * energy[-1]
    if wanted == 0.0:
        return 0.0
    i = int(np.searchsorted(energy, wanted))
    return float(dt * (i - 1 + (wanted - energy[i - 1]) / (energy[i] - energy[i - 1])))
