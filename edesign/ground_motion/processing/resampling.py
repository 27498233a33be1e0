"""Resampling that keeps the frequencies which both steps can carry, and removes the others."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import scipy  # its signal is loaded with the first filter: that takes a second

from edesign.errors import InputError
from edesign.ground_motion.record import Record

PASSED = 0.9
"""Part of the lower of the two Nyquist frequencies that passes unchanged; the filter falls from there to it."""

_ATTENUATION = 100.0  # dB beyond the lower Nyquist frequency; the ripple below PASSED is as small, 1e-5
_LARGEST = 1000  # of the whole numbers in the ratio of the steps: the filter has about 130 times as many taps
_TOLERANCE = 1e-9


def resample_band_limited(record: Record, time_step: float) -> Record:
    """Return the record at another step, as a band-limited signal: interpolated by a filter that is flat and steep.

    Unlike `Record.resampled`, which draws straight lines, this neither lowers high frequencies when the step gets
    smaller nor folds them back as low ones when it gets larger. What lies above PASSED times the lower Nyquist
    frequency is lost. The motion is taken as zero before and after the record; the sample at time zero stays there.

    Args:
        time_step: the new step, s; its ratio to the old one must be that of whole numbers up to 1000.

    Raises:
        InputError: the step is not greater than zero, longer than the record, or no such ratio.

    Source: Oppenheim & Schafer, Discrete-Time Signal Processing, chapter 4 (change of rate by a rational factor) and
        7 (Kaiser window).
    """
    last = record.last_sample(time_step)
    if time_step == record.time_step:
        return record
    exact = record.time_step / time_step
    ratio = Fraction(exact).limit_denominator(_LARGEST)
    if max(ratio.numerator, ratio.denominator) > _LARGEST or abs(float(ratio) - exact) > _TOLERANCE * exact:
        raise InputError(
            f"{record.name}: the steps {record.time_step:g} s and {time_step:g} s are not in a ratio of whole numbers "
            f"up to {_LARGEST} [E-MOTION-03]"
        )
    samples = scipy.signal.resample_poly(record.acceleration, ratio.numerator, ratio.denominator, window=_filter(ratio))
    nyquist = 0.5 / max(record.time_step, time_step)
    done = f"resampled to {time_step:.9g} s as a band-limited signal (kept up to {PASSED * nyquist:.4g} Hz)"
    return replace(record, acceleration=samples[: last + 1], time_step=time_step, source=f"{record.source}; {done}")


def _filter(ratio: Fraction) -> np.ndarray:
    """Symmetric low-pass filter at the common rate of both steps, whose Nyquist frequency is 1 here."""
    lower = 1.0 / max(ratio.numerator, ratio.denominator)
    width = (1.0 - PASSED) * lower
    taps, beta = scipy.signal.kaiserord(_ATTENUATION, width)
    return scipy.signal.firwin(taps | 1, lower - width / 2.0, window=("kaiser", beta))
