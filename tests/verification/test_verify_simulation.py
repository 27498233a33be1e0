"""Model of simulated ground motion: spectrum, duration, site and window by a published program, data and hand.

SMSIM 6.0 (Boore 2005, revised 2015), western North America, one corner frequency, M 6, R 20 km: what it prints for its
distributed parameter file, by random vibration theory, not by simulation.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from edesign.ground_motion.simulation import SINGLE_CORNER, WESTERN_NORTH_AMERICA, simulate
from edesign.ground_motion.simulation.distance import effective_distance, pseudo_depth
from edesign.ground_motion.simulation.duration import path_duration
from edesign.ground_motion.simulation.fourier_spectrum import fourier_amplitude, spreading
from edesign.ground_motion.simulation.site import site_factor
from edesign.ground_motion.simulation.source import corner_frequency, corners, seismic_moment, source, source_duration
from edesign.ground_motion.simulation.window import saragoni_hart

# frequency (Hz), Fourier amplitude of acceleration (cm/s)
SMSIM_FOURIER = [
    (0.05000, 0.276101),
    (0.1417, 2.06332),
    (0.4018, 9.22017),
    (1.139, 15.9564),
    (3.229, 16.3512),
    (9.153, 9.27331),
    (25.95, 1.35652),
]


def test_source_path_and_duration_of_smsim() -> None:
    """Printed with four digits."""
    assert seismic_moment(6.0) == pytest.approx(1.122e18, rel=5e-4)
    assert corner_frequency(6.0, SINGLE_CORNER) == pytest.approx(0.3560, abs=5e-5)
    assert pseudo_depth(6.0, SINGLE_CORNER) == pytest.approx(7191.0, abs=1.0)
    assert effective_distance(6.0, 20e3, SINGLE_CORNER) == pytest.approx(21.25e3, abs=5.0)
    assert source_duration(6.0, SINGLE_CORNER) == pytest.approx(2.809, abs=5e-4)
    assert path_duration(effective_distance(6.0, 20e3, SINGLE_CORNER), SINGLE_CORNER) == pytest.approx(4.651, abs=6e-4)


def test_fourier_spectrum_of_smsim() -> None:
    """It prints frequency and amplitude with four to six digits; at 26 Hz the former alone makes 1e-3."""
    frequency, amplitude = np.array(SMSIM_FOURIER).T
    np.testing.assert_allclose(
        100.0 * fourier_amplitude(frequency, 6.0, 20e3, None, SINGLE_CORNER), amplitude, rtol=2e-3
    )


def test_low_and_high_frequencies_of_the_source_by_hand() -> None:
    """M 6.5: plateau of the displacement R F V M_0 / (4 pi rho beta^3 R_0), of the acceleration times (2 pi f_c)^2."""
    moment = 10.0**18.8  # N m
    plateau = 0.55 * 2.0 * math.sqrt(0.5) * moment / (4.0 * math.pi * 2720.0 * 3500.0**3 * 1000.0)
    assert plateau == pytest.approx(3.349, abs=1e-3)  # m, at 1 km
    corner = 0.4906 * 3500.0 * (1.0e7 / moment) ** (1.0 / 3.0)
    assert corner == pytest.approx(0.2002, abs=1e-4)
    low, high = np.array([1e-3]), np.array([1e3])
    for crust in (SINGLE_CORNER, WESTERN_NORTH_AMERICA):
        assert source(low, 6.5, crust)[0] / (2e-3 * math.pi) ** 2 == pytest.approx(plateau, rel=2e-4)
        assert source(high, 6.5, crust)[0] == pytest.approx((2.0 * math.pi * corner) ** 2 * plateau, rel=1e-3)
    at_corner = source(np.array([corner]), 6.5, SINGLE_CORNER)[0]
    assert at_corner == pytest.approx(0.5 * (2.0 * math.pi * corner) ** 2 * plateau, rel=1e-3)


def test_two_corners_by_hand() -> None:
    """Atkinson & Silva (2000), M 6.5: log f_a = 2.181 - 0.496 M, log share = 0.605 - 0.255 M."""
    found = corners(6.5, WESTERN_NORTH_AMERICA)
    assert found.lower == pytest.approx(0.0906, abs=5e-5)
    assert found.upper_share == pytest.approx(0.0886, abs=5e-5)
    assert found.upper == pytest.approx(0.6065, abs=5e-4)  # sqrt((0.20018^2 - 0.91139 * 0.09057^2) / 0.08861)
    assert source_duration(6.5, WESTERN_NORTH_AMERICA) == pytest.approx(0.5 / 0.0906 + 0.5 / 0.6065, abs=0.01)


def test_spreading_and_pseudo_depth() -> None:
    assert spreading(10e3, SINGLE_CORNER) == pytest.approx(0.1)
    assert spreading(160e3, SINGLE_CORNER) == pytest.approx(0.025 * 0.5)
    assert pseudo_depth(5.0, SINGLE_CORNER) == pytest.approx(10**3.43)
    assert pseudo_depth(8.0, SINGLE_CORNER) == pytest.approx(10**4.475)
    # one smooth curve through the blend
    log_depth = np.array([math.log10(pseudo_depth(m, SINGLE_CORNER)) for m in np.arange(5.0, 8.5, 0.01)])
    slope = np.diff(log_depth) / 0.01
    assert np.all((slope > 0.2349) & (slope < 0.4301)) and np.max(np.abs(np.diff(slope))) < 1.1e-3
    near, far = (simulate(6.5, r, None, 1).pga for r in (0.0, 70.0))
    assert near == pytest.approx(far, rel=1e-3) and 1.0 < near < 6.0


def test_rock_amplification_from_the_velocity_profile() -> None:
    """Square-root impedance through the generic profiles of Boore & Joyner (1997), joined for 760 m/s by Boore (2016).

    Velocities in km/s, depths in km. The published table has three digits; below 0.1 Hz the profile must reach deeper.
    """
    depth = np.concatenate(([0.0], np.geomspace(1e-4, 8.0, 4000)))
    z = np.maximum(depth, 1e-9)
    bounds = [z <= 0.001, z <= 0.03, z <= 0.19, z <= 4.0, z > 4.0]
    rock = np.select(
        bounds, [np.full_like(z, 0.245), 2.206 * z**0.272, 3.542 * z**0.407, 2.505 * z**0.199, 2.927 * z**0.086]
    )
    upper = [2.768, 2.808, 2.847, 2.885, 2.922, 2.958, 2.993, 3.026]
    upper += [3.059, 3.091, 3.122, 3.151, 3.180, 3.208, 3.234, 3.260]
    hard = np.select(
        [z <= 0.75, z <= 2.2, z > 2.2],
        [np.interp(z, np.linspace(0.0, 0.75, 16), upper), 3.324 * z**0.067, 3.447 * z**0.0209],
    )
    weight = (1.0 / 0.760 - 1.0 / 0.618) / (1.0 / 2.780 - 1.0 / 0.618)
    velocity = 1.0 / (weight / hard + (1.0 - weight) / rock)
    compression = np.polynomial.polynomial.polyval(velocity, [0.9409, 2.0947, -0.8206, 0.2683, -0.0251])
    density = np.where(velocity < 0.3, 1.0 + 1.53 * velocity**0.85 / (0.35 + 1.889 * velocity**1.7), 0.0)
    density = np.where(velocity >= 0.3, 1.74 * compression**0.25, density)

    def integral(values: np.ndarray) -> np.ndarray:
        return np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(depth))

    time, mass = integral(1.0 / velocity), integral(density)
    amplification = np.sqrt(2.72 * 3.5 / (mass / time))
    frequency = 1.0 / (4.0 * time)
    published, expected = np.array(SINGLE_CORNER.rock_amplification).T
    ours = np.interp(np.log(published), np.log(frequency[::-1]), amplification[::-1])
    within = published > 0.09
    assert np.count_nonzero(within) == 19
    np.testing.assert_allclose(ours[within], expected[within], rtol=0.01)


@pytest.mark.parametrize(
    ("rock_amplitude", "v_s30", "expected"),
    [
        (0.0433202, 210.0, [2.6005, 3.8198, 3.8201, 2.1149, 0.9714, 0.5629, 0.3116]),
        (0.0433202, 360.0, [1.7425, 2.1790, 2.2908, 1.8230, 1.0474, 0.7303, 0.5180]),
        (0.000277482, 210.0, [2.6011, 3.8220, 4.2076, 3.2464, 1.8404, 1.0966, 0.6071]),
        (0.000277482, 1200.0, [0.8155, 0.7512, 0.7357, 0.7764, 0.8754, 0.9775, 1.1089]),
    ],
)
def test_site_factor(rock_amplitude: float, v_s30: float, expected: list[float]) -> None:
    """Bayless & Abrahamson (2019) relative to 760 m/s, values of the package pygmm 0.8.0.

    It uses all 239 frequencies of the supplement, and smooths the nonlinear term over seven of them.
    """
    frequency = np.array([0.1, 0.302, 1.0, 1.995, 5.012, 10.0, 19.953])
    np.testing.assert_allclose(site_factor(frequency, v_s30, 760.0, rock_amplitude), expected, rtol=0.02)
    np.testing.assert_allclose(site_factor(frequency, 760.0, 760.0, rock_amplitude), 1.0, rtol=1e-12)


def test_window() -> None:
    """Saragoni & Hart by Boore (2003): 1 at a fifth of the length, 5 % at its end, nothing outside."""
    time = np.linspace(-1.0, 11.0, 1201)
    window = saragoni_hart(time, 10.0)
    assert time[np.argmax(window)] == pytest.approx(2.0) and np.max(window) == pytest.approx(1.0, abs=1e-9)
    assert window[1100] == pytest.approx(0.05, rel=1e-9)
    assert np.all(window[time < 0.0] == 0.0) and np.all(window[time > 10.0 + 1e-9] == 0.0)
    # exponents by hand: b = 0.2 ln 20 / (1 + 0.2 (ln 0.2 - 1)) = 0.599146 / 0.478112 = 1.25315, c = b / 0.2
    ratio = time[200:1100] / 10.0
    np.testing.assert_allclose(window[200:1100], (math.e / 0.2 * ratio * np.exp(-ratio / 0.2)) ** 1.25315, rtol=2e-5)


def test_a_stiffer_source_shakes_more_and_another_crust_is_possible() -> None:
    """High frequencies grow with the stress drop to the power 2/3: eight times the stress, four times the source."""
    strong = replace(SINGLE_CORNER, stress_drop=8.0 * SINGLE_CORNER.stress_drop)
    high = np.array([50.0])
    assert source(high, 6.5, strong)[0] / source(high, 6.5, SINGLE_CORNER)[0] == pytest.approx(4.0, rel=1e-3)
