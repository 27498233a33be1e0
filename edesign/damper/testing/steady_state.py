"""Properties that a law predicts for steady sinusoidal tests: the rows of a property table (Eqs. 3.1-3.4)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from edesign.damper.damper import Damper
from edesign.damper.temperature import REFERENCE_C, TemperatureModel
from edesign.errors import InputError

if TYPE_CHECKING:
    from edesign.damper.testing.specimen import Specimen

CYCLES = (5, 15)
"""First and last full cycle that is averaged, counted from 1 after the ramp (thesis 3.3)."""
SAMPLES = 200
"""Samples a cycle; the largest stress between two is missed by (pi / SAMPLES)^2 / 2 = 1.2e-4 at most."""


@dataclass(frozen=True)
class PropertyRows:
    """Properties of steady sinusoidal tests, one row for each, predicted or measured.

    Attributes:
        strain: amplitude, dimensionless, shape (n,).
        frequency: shape (n,), Hz.
        temperature_C: shape (n,), degC.
        G_storage: storage modulus G', shape (n,), Pa.
        G_eq: equivalent modulus, shape (n,), Pa.
        G_loss: loss modulus G'', shape (n,), Pa.
        loss_factor: n = G''/G', shape (n,).
        warnings: of the temperature law.
    """

    strain: np.ndarray
    frequency: np.ndarray
    temperature_C: np.ndarray
    G_storage: np.ndarray
    G_eq: np.ndarray
    G_loss: np.ndarray
    loss_factor: np.ndarray
    warnings: tuple[str, ...] = ()


def predict(
    damper: Damper,
    specimen: Specimen,
    strain: ArrayLike,
    frequency: ArrayLike,
    temperature_C: ArrayLike = REFERENCE_C,
    temperature_model: TemperatureModel | None = None,
    cycles: tuple[int, int] = CYCLES,
    samples: int = SAMPLES,
) -> PropertyRows:
    """Simulate steady sinusoidal tests and take their properties as from a measured one.

    Each row begins at rest: one cycle in which the amplitude grows smoothly, then full cycles; the means of the
    cycles named are taken.

    Args:
        damper: the law with its parameters at the reference temperature.
        specimen: the layers that make strain and stress of deformation and force.
        strain: amplitude, dimensionless; strain, frequency and temperature are broadcast against each other.
        frequency: Hz.
        temperature_C: degC.
        temperature_model: how the parameters change with temperature (see `temperature.at`).
        cycles: first and last full cycle that is averaged.
        samples: a cycle, a multiple of 4, so that the largest strain is a sample.

    Raises:
        InputError: amplitude or frequency not greater than zero, or a temperature that the model does not reach.

    Source: thesis Eqs. 3.1-3.4, protocol of sections 3.2 and 3.3.
    """
    rows = np.broadcast_arrays(*(np.atleast_1d(np.asarray(x, dtype=float)) for x in (strain, frequency, temperature_C)))
    gamma, f, temperature = (np.ascontiguousarray(row).ravel() for row in rows)
    if not (np.all(gamma > 0.0) and np.all(f > 0.0)):
        raise InputError("strain amplitudes and frequencies must be greater than zero [E-PROPS-03]")
    if samples % 4 or samples < 8 or not 1 <= cycles[0] <= cycles[1]:
        raise ValueError(f"{samples} samples, cycles {cycles}")
    shape = unit_motion(cycles[1], samples)
    at_temperature, warnings = _dampers(damper, temperature, temperature_model)
    G_storage, G_eq, G_loss = (np.empty(gamma.size) for _ in range(3))
    for i in range(gamma.size):
        amplitude = gamma[i] * specimen.layer_thickness
        time, u, v = shape[0] / f[i], amplitude * shape[1], amplitude * f[i] * shape[2]
        force = at_temperature[temperature[i]].force(time, u, v)
        G_storage[i], G_eq[i], G_loss[i] = force_amplitudes(force, shape[2], cycles, samples) / (
            specimen.area * gamma[i]
        )
    with np.errstate(divide="ignore", invalid="ignore"):  # a dashpot stores nothing
        loss_factor = G_loss / G_storage
    return PropertyRows(gamma, f, temperature, G_storage, G_eq, G_loss, loss_factor, warnings)


def _dampers(
    damper: Damper, temperature: np.ndarray, model: TemperatureModel | None
) -> tuple[dict[float, Damper], tuple[str, ...]]:
    """The damper at each temperature, and all warnings once."""
    found: dict[float, Damper] = {}
    warnings: list[str] = []
    for T in np.unique(temperature).tolist():
        found[T], more = damper.at(T, model)
        warnings += more
    return found, tuple(dict.fromkeys(warnings))


def unit_motion(cycles: int, samples: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return time in cycles, deformation over amplitude, and its rate to that time, (n,) each.

    The motion is a ramp of one cycle, then full cycles. The envelope is 10 s^3 - 15 s^4 + 6 s^5; with it neither
    deformation nor velocity is larger in the ramp than after it, which counts for laws that remember the largest ones.
    """
    n = np.arange((cycles + 1) * samples + 1)
    angle = 2.0 * np.pi * (n % samples) / samples
    sine, cosine = np.sin(angle), np.cos(angle)
    sine[n % (samples // 2) == 0] = 0.0
    cosine[(n + samples // 4) % (samples // 2) == 0] = 0.0  # at rest at the reversals, to the last bit
    time = n / samples
    s = np.minimum(time, 1.0)
    envelope, slope = s**3 * (10.0 - s * (15.0 - 6.0 * s)), 30.0 * (s * (1.0 - s)) ** 2
    return time, envelope * sine, 2.0 * np.pi * envelope * cosine + slope * sine


def force_amplitudes(force: np.ndarray, rate: np.ndarray, cycles: tuple[int, int], samples: int) -> np.ndarray:
    """Return mean force amplitudes of cycles: in phase with the deformation, largest, and of the energy dissipated.

    Energy: pi G'' gamma^2 = closed integral of tau d gamma, here as the sum over the samples of stress times rate,
    which is exact to rounding for smooth periodic forces.

    Args:
        force: (n,) N under `unit_motion`.
        rate: (n,) of `unit_motion`.
        cycles: first and last full cycle that is averaged.

    Returns:
        (3,) N.
    """
    first, count = cycles[0] * samples, cycles[1] - cycles[0] + 1  # the ramp is cycle 0
    loops = force[first : first + count * samples].reshape(count, samples)
    in_phase = 0.5 * (loops[:, samples // 4] - loops[:, 3 * samples // 4])
    largest = 0.5 * (loops.max(axis=1) - loops.min(axis=1))
    energy = loops @ rate[first : first + samples] / samples
    return np.array([in_phase.mean(), largest.mean(), energy.mean() / np.pi])
