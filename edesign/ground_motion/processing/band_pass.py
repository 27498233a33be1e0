"""Acausal Butterworth filters with zero pads."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy  # its signal is loaded with the first filter: that takes a second

from edesign.errors import InputError
from edesign.ground_motion.processing.length import pad
from edesign.ground_motion.record import Record

_PAD_CYCLES = 1.5  # each pad is this times order / lowest corner frequency


def band_pass(record: Record, low: float | None, high: float | None, order: int = 4, keep_pads: bool = True) -> Record:
    """Filter forwards and backwards: no phase is shifted, and the gain is that of one pass squared.

    A low-cut and a high-cut filter of the same order follow each other; at its corner each halves the amplitude. Zeros
    are put at both ends first, 1.5 order / f seconds each with f the lowest corner, in which the response of the filter
    before and after the motion finds room. Without them, velocity and displacement of the filtered record drift.

    Args:
        record: the record; taper it before, or remove its offset, if it does not begin and end near zero.
        low: corner of the low-cut filter, Hz, or None for none.
        high: corner of the high-cut filter, Hz, or None for none.
        order: of the Butterworth filter of one pass, 1 to 10.
        keep_pads: whether the pads stay; without them what is left no longer fits its own velocity and displacement.

    Raises:
        InputError: no corner, a corner that is not between zero and the Nyquist frequency, corners not in order, or an
            order out of range.

    Source: Converse & Brady (1992), USGS OFR 92-296A (pads); Boore (2005), Bull. Seism. Soc. Am. 95, 745-750 (that they
        must stay); Boore & Bommer (2005), Soil Dyn. Earthq. Eng. 25, 93-115.
    """
    nyquist = 0.5 / record.time_step
    corners = [f for f in (low, high) if f is not None]
    if not corners:
        raise InputError(f"{record.name}: a filter needs a low or a high corner frequency [E-MOTION-01]")
    for f in corners:
        if not 0.0 < f < nyquist:
            raise InputError(
                f"{record.name}: a corner frequency must lie between 0 and the Nyquist frequency {nyquist:g} Hz, "
                f"not {f:g} Hz [E-MOTION-01]"
            )
    if low is not None and high is not None and low >= high:
        raise InputError(
            f"{record.name}: the low corner {low:g} Hz must be below the high corner {high:g} Hz [E-MOTION-01]"
        )
    if not 1 <= order <= 10:
        raise InputError(f"{record.name}: the order of the filter must be from 1 to 10, not {order} [E-VALUE-02]")
    length = _PAD_CYCLES * order / min(corners)
    padded = pad(record, length, length)
    sections = []
    for corner, kind in ((low, "highpass"), (high, "lowpass")):
        if corner is not None:
            sections.append(scipy.signal.butter(order, corner / nyquist, kind, output="sos"))
    samples = scipy.signal.sosfiltfilt(np.vstack(sections), padded.acceleration, padtype=None, padlen=0)
    band = " to ".join(f"{f:.6g} Hz" if f is not None else "open" for f in (low, high))
    done = f"acausal Butterworth filter of order {order} (two passes), {band}"
    if keep_pads:
        return replace(padded, acceleration=samples, source=f"{padded.source}; {done}")
    front = (padded.acceleration.size - record.acceleration.size) // 2
    kept = samples[front : front + record.acceleration.size]
    return replace(record, acceleration=kept, source=f"{record.source}; {done}, its zero pads removed again")
