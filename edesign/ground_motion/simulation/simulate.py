"""Simulated record in place of a recording: noise of the right length with the right spectrum."""

from __future__ import annotations

import math

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.record import Record
from edesign.ground_motion.simulation.duration import ground_motion_duration
from edesign.ground_motion.simulation.fourier_spectrum import fourier_amplitude
from edesign.ground_motion.simulation.low_cut import PAD, between_rests, low_cut
from edesign.ground_motion.simulation.parameters import WESTERN_NORTH_AMERICA, Crust
from edesign.ground_motion.simulation.site import V_S30_RANGE
from edesign.ground_motion.simulation.window import saragoni_hart, window_length
from edesign.ground_motion.transform_length import transform_length

_MAGNITUDES = (4.0, 8.0)
_LARGEST_DISTANCE = 300.0e3  # m
_TIME_STEPS = (0.001, 0.02)  # s; at 0.02 s kappa has left 6 % of the amplitude at the Nyquist frequency
_QUIET = 10.0  # s before and after the window


def simulate(
    magnitude: float,
    distance: float,
    v_s30: float | None,
    seed: int,
    time_step: float = 0.01,
    crust: Crust = WESTERN_NORTH_AMERICA,
    name: str = "",
) -> Record:
    """Simulate one horizontal component of the ground acceleration by the stochastic point-source method.

    The record has 10 s of quiet before and after the strong part, and its velocity and displacement end at zero. Equal
    arguments give the same samples bit for bit with the same numpy on the same kind of processor; another
    seed gives another record of the same spectrum and duration.

    Args:
        magnitude: moment magnitude, 4 to 8.
        distance: closest distance to the rupture in metres, up to 300e3.
        v_s30: mean shear velocity of the upper 30 m at the site, m/s, 180 to 1500; None: the reference rock of `crust`.
        seed: of the random numbers, not negative.
        time_step: s, 0.001 to 0.02.
        name: of the record; made from the arguments if empty.

    Raises:
        InputError: an argument is outside the range of validity.

    Source: Boore (2003, Pure and Applied Geophysics 160, 635-676), section "Time-domain simulation".
    """
    _check(magnitude, distance, v_s30, seed, time_step)
    strong = window_length(ground_motion_duration(magnitude, distance, crust))
    window = saragoni_hart(np.arange(math.ceil(strong / time_step)) * time_step, strong)
    pad, quiet = round(PAD / time_step), round(_QUIET / time_step)
    count = transform_length(window.size + 2 * pad)

    noise = np.zeros(count)
    noise[pad : pad + window.size] = window * np.random.Generator(np.random.PCG64(seed)).standard_normal(window.size)
    spectrum = np.fft.rfft(noise)
    # by Parseval: the mean square of the two-sided spectrum becomes 1
    spectrum /= math.sqrt(count * np.mean(noise**2))

    frequency = np.fft.rfftfreq(count, time_step)
    amplitude = fourier_amplitude(frequency, magnitude, distance, v_s30, crust) * low_cut(frequency)
    spectrum *= amplitude / time_step
    kept = slice(pad - quiet, pad + window.size + quiet)
    acceleration = between_rests(spectrum, count, time_step, kept, quiet)

    ground = crust.rock_velocity if v_s30 is None else v_s30
    event = f"M {magnitude:g}, R {distance / 1e3:g} km, v_S30 {ground:g} m/s, seed {seed}"
    return Record(
        name or f"simulated {event}",
        acceleration,
        time_step,
        f"simulated record: Boore (2003) stochastic point source, {event}",
    )


def _check(magnitude: float, distance: float, v_s30: float | None, seed: int, time_step: float) -> None:
    def beyond(what: str, value: object, allowed: str) -> InputError:
        return InputError(f"simulated ground motion: {what} {value} is out of range: {allowed} [E-SIM-01]")

    low, high = _MAGNITUDES
    if not low <= magnitude <= high:
        raise beyond("the magnitude", f"{magnitude:g}", f"{low:g} to {high:g}")
    if not 0.0 <= distance <= _LARGEST_DISTANCE:
        raise beyond("the distance", f"{distance / 1e3:g} km", f"0 to {_LARGEST_DISTANCE / 1e3:g} km")
    low, high = V_S30_RANGE
    if v_s30 is not None and not low <= v_s30 <= high:
        raise beyond("v_S30", f"{v_s30:g} m/s", f"{low:g} to {high:g} m/s, the range of the data behind the site term")
    low, high = _TIME_STEPS
    if not low <= time_step <= high:
        raise beyond("the time step", f"{time_step:g} s", f"{low:g} to {high:g} s")
    if isinstance(seed, bool) or not isinstance(seed, (int, np.integer)) or seed < 0:
        raise beyond("the seed", f"`{seed}`", "a whole number, 0 or greater")
