"""Wavelets that leave the ground at rest, and the closed form of an oscillator's response to them."""

from __future__ import annotations

import numpy as np
import scipy

REACH = 4.0
"""Half of a wavelet's length, in widths: beyond it the envelope is below exp(-16), 1e-7 of its largest value."""
NEGLIGIBLE = 1e-7
"""Of the wavelet: constants k and free vibrations smaller than that are left out."""


def wavelet_pair(time: np.ndarray, period: np.ndarray, width: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the accelerations of the even and the odd wavelet, about 1 in size.

        even = exp(-(t/w)^2) (cos qt - k),    odd = exp(-(t/w)^2) (sin qt - k qt),    k = exp(-(qw/2)^2), q = 2 pi / T

    Without k these are the cosine and the sine under a Gaussian envelope. With k the velocity and the displacement at
    the end are zero, exactly and for any width: the integrals of the acceleration and of its first moment vanish.

    Args:
        time: from the wavelet's centre, s; the three arrays are broadcast together.
        period: T, s.
        width: w, the time in which the envelope falls to 1/e, s.

    Source: Al Atik & Abrahamson (2010), Earthquake Spectra 26(3), 601-617, for the tapered cosine (without k); the
    constant k is that of the admissible Morlet wavelet, Torrence & Compo (1998), Bull. Am. Meteorol. Soc. 79(1).
    """
    phase = 2.0 * np.pi / period * time
    k = offset(period, width)
    envelope = np.exp(-((time / width) ** 2))
    return envelope * (np.cos(phase) - k), envelope * (np.sin(phase) - k * phase)


def wavelet(time: np.ndarray, period: float, width: float, even: float, odd: float) -> np.ndarray:
    """Return the pair of one wavelet with amplitudes, as `wavelet_pair`, in one cosine.

    Args:
        time: from the centre, s.
        period: s.
        width: s.
    """
    phase = 2.0 * np.pi / period * time
    wave = np.hypot(even, odd) * np.cos(phase - np.arctan2(odd, even))
    k = float(offset(period, width))
    if k > 1e-15:
        wave -= k * (even + odd * phase)
    return np.asarray(np.exp(-((time / width) ** 2)) * wave)


def offset(period: np.ndarray | float, width: np.ndarray | float) -> np.ndarray:
    """Return the constant k of `wavelet_pair`.

    Args:
        period: s.
        width: of the wavelet, s.
    """
    return np.asarray(np.exp(-((np.pi * width / period) ** 2)))


def oscillator_response(
    oscillator: np.ndarray, damping: float, time: np.ndarray, period: np.ndarray, width: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the pseudo acceleration of oscillators under the even and the odd wavelet.

    It is omega^2 times minus the displacement. The oscillator's impulse response is the imaginary part of an
    exponential with a complex rate, the wavelet consists of Gaussians times exponentials: each integral is a Faddeeva
    function (a complementary error function), and once the wavelet is over, free vibration.

    Args:
        oscillator: natural period, s; all arrays have the same shape (m,).
        damping: ratio of critical.
        time: from the wavelet's centre to the moment asked for, s.
        period: of the wavelet, s.
        width: of the wavelet, s.

    Returns:
        Under the even and under the odd wavelet, (m,) each, in the unit of the wavelets.
    """
    natural = 2.0 * np.pi / oscillator
    damped = natural * np.sqrt(1.0 - damping**2)
    rate = -damping * natural + 1j * damped
    q = 2.0 * np.pi / period
    forward, backward = _convolution(rate, q, width, time), _convolution(rate, -q, width, time)
    even, odd = 0.5 * (forward + backward).imag, 0.5 * (backward - forward).real
    k = offset(period, width)
    at = np.flatnonzero(k > NEGLIGIBLE)
    if at.size:
        r, w, t = rate[at], width[at], time[at]
        constant = _convolution(r, np.zeros(at.size), w, t)
        linear = -0.5 * w**2 * (r * constant + np.exp(-((t / w) ** 2)))
        even[at] -= k[at] * constant.imag
        odd[at] -= k[at] * q[at] * linear.imag
    gain = natural**2 / damped
    return gain * even, gain * odd


def _convolution(rate: np.ndarray, q: np.ndarray, width: np.ndarray, time: np.ndarray) -> np.ndarray:
    """Integral of exp(rate (time - s)) exp(-(s/width)^2) exp(i q s) over s up to `time`."""
    m = 0.5 * width * (1j * q - rate)
    z = m - time / width
    total = np.zeros(time.size, dtype=complex)
    late = z.real < 0.0
    exponent = m.real**2 - m.imag**2 + rate.real * time
    at = np.flatnonzero(late & (exponent > np.log(NEGLIGIBLE)))  # erfc(-z) = 2 - erfc(z): so exponents stay negative
    total[at] = 2.0 * np.exp(rate[at] * time[at] + m[at] ** 2)
    at = np.flatnonzero(np.abs(time) < REACH * width)  # before it nothing has happened, after it vibration is free
    sign = np.where(late[at], -1.0, 1.0)
    total[at] += sign * _faddeeva(1j * sign * z[at]) * np.exp(1j * q[at] * time[at] - (time[at] / width[at]) ** 2)
    return np.asarray(0.5 * np.sqrt(np.pi) * width * total)


def _faddeeva(z: np.ndarray) -> np.ndarray:
    """w(z) for Im z >= 0; far from zero a convergent of the continued fraction, there within 3e-7.

    Source: Abramowitz & Stegun, 7.1.15; Gautschi (1970), SIAM Journal on Numerical Analysis 7(1), 187-198.
    """
    square = z * z
    far = np.abs(square) > 30.0
    value = np.empty(z.size, dtype=complex)
    value[~far] = scipy.special.wofz(z[~far])
    z, square = z[far], square[far]
    value[far] = 1j / np.sqrt(np.pi) * (square * (square - 4.5) + 2.0) / (z * (square * (square - 5.0) + 3.75))
    return value
