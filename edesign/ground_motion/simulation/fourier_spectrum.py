"""Fourier amplitude spectrum of the ground acceleration: source, path and site."""

from __future__ import annotations

import math

import numpy as np

from edesign.ground_motion.simulation.distance import effective_distance
from edesign.ground_motion.simulation.parameters import Crust
from edesign.ground_motion.simulation.site import site_factor
from edesign.ground_motion.simulation.source import source
from edesign.project.notation.units import STANDARD_GRAVITY


def spreading(distance: float, crust: Crust) -> float:
    """Return the geometrical spreading Z(R), 1 at 1 km.

    Args:
        distance: point-source distance, m.
        crust: parameters of the crust.

    Source: Boore (2003), Eq. 9.
    """
    factor = 1.0
    for index, (start, exponent) in enumerate(crust.spreading):
        if index > 0 and distance <= start:
            break
        last = index + 1 == len(crust.spreading)
        end = distance if last else min(distance, crust.spreading[index + 1][0])
        factor *= (end / start) ** exponent
    return factor


def path(frequency: np.ndarray, distance: float, crust: Crust) -> np.ndarray:
    """Return spreading and anelastic attenuation on the path.

    Args:
        frequency: (n,) Hz, above zero.
        distance: point-source distance, m.
        crust: parameters of the crust.

    Returns:
        In the shape of `frequency`, dimensionless.

    Source: Boore (2003), path effects.
    """
    q_one, exponent = crust.quality
    attenuation = np.exp(-math.pi * frequency ** (1.0 - exponent) * distance / (q_one * crust.path_velocity))
    return np.asarray(spreading(distance, crust) * attenuation)


def rock(frequency: np.ndarray, crust: Crust) -> np.ndarray:
    """Return amplification and diminution by the crust's reference rock.

    Args:
        frequency: (n,) Hz, above zero.
        crust: parameters of the crust.

    Returns:
        In the shape of `frequency`, dimensionless.

    Source: Boore & Joyner (1997, BSSA 87, 327-341), Boore (2016); Anderson & Hough (1984) for kappa.
    """
    table, amplification = np.array(crust.rock_amplification).T
    amplified = np.exp(np.interp(frequency, table, np.log(amplification)))  # between points as SMSIM does
    return np.asarray(amplified * np.exp(-math.pi * crust.kappa * frequency))


def fourier_amplitude(
    frequency: np.ndarray, magnitude: float, distance: float, v_s30: float | None, crust: Crust
) -> np.ndarray:
    """Return the Fourier amplitude of one horizontal component of the ground acceleration.

    Args:
        frequency: shape (n,), Hz; zero gives zero.
        magnitude: moment magnitude.
        distance: closest distance to the rupture, m.
        v_s30: of the site, m/s; None is the crust's reference rock.
        crust: whose source, path and site are taken.

    Returns:
        Shape (n,), m/s.

    Source: Boore (2003).
    """
    frequency = np.asarray(frequency, dtype=float)
    point = effective_distance(magnitude, distance, crust)

    def on_rock(f: np.ndarray) -> np.ndarray:
        return source(f, magnitude, crust) * path(f, point, crust) * rock(f, crust)

    amplitude = np.zeros_like(frequency)
    positive = frequency > 0.0
    amplitude[positive] = on_rock(frequency[positive])
    if v_s30 is not None:
        at_5_hz = float(on_rock(np.array([5.0]))[0]) / STANDARD_GRAVITY
        amplitude[positive] *= site_factor(frequency[positive], v_s30, crust.rock_velocity, at_5_hz)
    return amplitude
