"""Frequency evaluation index of Guo et al.: amplitude, phase, equivalent frequency and delay."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from edesign.substructure.indicators.channels import channel, time_step
from edesign.substructure.indicators.undetermined import LEAST_EXPLAINED, Undetermined, moving


@dataclass(frozen=True)
class FrequencyIndex:
    """Frequency evaluation index.

    Attributes:
        amplitude: measured over target, 1.
        phase: rad; below zero if the measured channel is late.
        delay: -phase / (2 pi equivalent frequency), s; above zero if the measured channel is late.
    """

    amplitude: float
    phase: float
    delay: float


def frequency_index(target: ArrayLike, measured: ArrayLike, step: float) -> FrequencyIndex:
    """Return the mean of measured over target in the frequency domain, weighted by the target's squared amplitude.

    FEI = sum(O / I |I|^2) / sum |I|^2; amplitude |FEI|, phase arg FEI, frequency sum(|I|^2 f) / sum |I|^2. I and O are
    the Fourier transforms of target and measured channel. The mean of a channel (f = 0) is left out: it is no motion.
    The phase is that of the right quadrant where the paper has an arc tangent.

    A delay tau turns each frequency by another angle, so the amplitude of a band comes out less than 1. It is short by
    half the variance of omega tau: 0.4 % for 10 ms and white noise to 5 Hz. The record is taken as periodic: a motion
    that does not begin and end at rest leaks between frequencies.

    Args:
        target: x_t (n,), m.
        measured: x_m (n,), m.
        step: s.

    Raises:
        InputError: lengths that differ, NaN, a step out of range.
        Undetermined: a constant channel; a measured channel that does not follow the target.

    Source: Guo, Chen, Xu & Sanchez (2014), A frequency response analysis approach for quantitative assessment of
    actuator tracking for real-time hybrid simulation, Smart Materials and Structures 23; exponent 2; formula as in
    public code.
    """
    x_t = channel("target", target)
    x_m = channel("measured", measured, x_t.size)
    moving("target", float(np.ptp(x_t)))
    moving("measured", float(np.ptp(x_m)))
    frequency = equivalent_frequency(x_t, step)
    i, o = np.fft.rfft(x_t - np.mean(x_t))[1:], np.fft.rfft(x_m - np.mean(x_m))[1:]
    weight, product = float(np.sum(np.abs(i) ** 2)), complex(np.sum(o * np.conj(i)))
    explained = abs(product) ** 2 / (weight * float(np.sum(np.abs(o) ** 2)))
    if explained < LEAST_EXPLAINED:
        raise Undetermined(f"the measured channel does not follow the target ({explained:.0%} of its variance at best)")
    phase = math.atan2(product.imag, product.real)
    return FrequencyIndex(abs(product) / weight, phase, -phase / (2.0 * math.pi * frequency))


def equivalent_frequency(target: ArrayLike, step: float) -> float:
    """Return the mean frequency of a target, Hz, weighted by squared Fourier amplitude; source: as `frequency_index`.

    Args:
        target: x_t (n,), m.
        step: s.

    Raises:
        InputError: NaN, a step out of range.
        Undetermined: the target is constant.
    """
    x_t = channel("target", target)
    moving("target", float(np.ptp(x_t)))
    power = np.abs(np.fft.rfft(x_t - np.mean(x_t))) ** 2
    frequencies = np.arange(power.size) / (x_t.size * time_step(step))
    return float(np.sum(power * frequencies) / np.sum(power))
