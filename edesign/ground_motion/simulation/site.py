"""Ground at the site: how its v_S30 changes the Fourier spectrum on the reference rock."""

from __future__ import annotations

import numpy as np

V_S30_RANGE = (180.0, 1500.0)
"""m/s: range of the data of Bayless & Abrahamson (2019)."""

_LINEAR_LIMIT = 1000.0  # m/s: harder ground amplifies no less
_NONLINEAR_LIMIT = 760.0  # m/s: harder ground is linear
_MIDDLE = 360.0  # m/s, in the nonlinear term
_INTENSITY = (1.238, 0.846)  # ln of the peak acceleration (g) on rock over ln of the Fourier amplitude (g s) at 5 Hz

# fmt: off
# Bayless & Abrahamson (2019, BSSA 109, 2088-2105), electronic supplement: frequency (Hz), c8, f3, f4, f5
_COEFFICIENTS = np.array([
    (0.100, -0.7432, 1.0000, -0.0001, -0.02000), (0.151, -0.8563, 1.0000, -0.0001, -0.02000),
    (0.200, -0.9331, 1.0000, -0.0001, -0.02000), (0.251, -0.9955, 1.0000, -0.0001, -0.02000),
    (0.302, -1.0424, 1.0000, -0.0001, -0.02000), (0.398, -1.1034, 1.0000, -0.0008, -0.02000),
    (0.501, -1.1392, 0.9964, -0.0024, -0.01997), (0.708, -1.1510, 0.9287, -0.0085, -0.01945),
    (1.000, -1.1184, 0.7525, -0.0240, -0.01787), (1.514, -1.0199, 0.4363, -0.0782, -0.01380),
    (1.995, -0.9222, 0.2564, -0.1346, -0.01060), (2.512, -0.8253, 0.2028, -0.1956, -0.00826),
    (3.020, -0.7385, 0.2000, -0.2602, -0.00669), (3.981, -0.6015, 0.2000, -0.3726, -0.00508),
    (5.012, -0.4849, 0.2000, -0.4919, -0.00415), (6.026, -0.3864, 0.2000, -0.6061, -0.00342),
    (7.079, -0.2944, 0.2000, -0.7073, -0.00277), (7.943, -0.2260, 0.2000, -0.7727, -0.00233),
    (10.000, -0.0829, 0.2000, -0.8801, -0.00154), (12.023, 0.0391, 0.2000, -0.9443, -0.00102),
    (14.125, 0.1457, 0.2000, -0.9813, -0.00066), (15.849, 0.2224, 0.2000, -0.9949, -0.00048),
    (18.197, 0.3148, 0.2000, -0.9997, -0.00033), (19.953, 0.3768, 0.2000, -1.0000, -0.00026),
    (23.988, 0.5012, 0.2000, -1.0000, -0.00016),
])
# fmt: on


def site_factor(frequency: np.ndarray, v_s30: float, rock_velocity: float, rock_amplitude: float) -> np.ndarray:
    """Return the factor from rock to site, linear amplification and what strong shaking takes from it on soft ground.

    Args:
        frequency: shape (n,), Hz, greater than zero; beyond 0.1 to 24 Hz the values at these limits hold.
        v_s30: mean shear velocity of the upper 30 m at the site, m/s.
        rock_velocity: that of the reference rock, m/s, at least 760.
        rock_amplitude: Fourier amplitude of acceleration on the reference rock at 5 Hz, in g s.

    Returns:
        Shape (n,), dimensionless; 1 where the site is the reference rock.

    Source: Bayless & Abrahamson (2019): linear term c8 ln(v_S30 / 1000 m/s); nonlinear term of Hashash et al. (2018).
    """
    table, linear, level, strength, fading = _COEFFICIENTS.T
    log_factor = linear * np.log(min(v_s30, _LINEAR_LIMIT) / min(rock_velocity, _LINEAR_LIMIT))
    soft = np.exp(fading * (min(v_s30, _NONLINEAR_LIMIT) - _MIDDLE)) - np.exp(fading * (_NONLINEAR_LIMIT - _MIDDLE))
    rock_acceleration = np.exp(_INTENSITY[0] + _INTENSITY[1] * np.log(rock_amplitude))
    nonlinear = strength * soft * np.log((rock_acceleration + level) / level)
    # from the frequency of the largest reduction on, that reduction holds
    log_factor = log_factor + np.minimum.accumulate(nonlinear)
    return np.asarray(np.exp(np.interp(np.log(frequency), np.log(table), log_factor)))
