"""Simulated records: their statistics against the model, the published program SMSIM, and real records.

SMSIM 6.0 (Boore 2005, revised 2015), western North America, one corner frequency, M 6, R 20 km: what it prints for its
distributed parameter file, by random vibration theory, not by simulation.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from shared_records import SHARED, needs_recordings
from support.messages import says

from edesign.errors import InputError
from edesign.ground_motion.formats.read import read_record_file
from edesign.ground_motion.intensity import measures
from edesign.ground_motion.response_spectrum import psa
from edesign.ground_motion.simulation import SINGLE_CORNER, Crust, simulate
from edesign.ground_motion.simulation.fourier_spectrum import fourier_amplitude

# period (s), 5 % pseudo-acceleration (cm/s2)
SMSIM_PSA = [
    (0.05, 129.1),
    (0.1, 191.9),
    (0.2, 189.7),
    (0.5, 115.5),
    (1.0, 61.32),
    (2.0, 25.01),
    (4.0, 6.883),
    (6, 2.745),
]


def fourier(record_seeds: range, frequency: np.ndarray, time_step: float, crust: Crust = SINGLE_CORNER) -> np.ndarray:
    """Squared Fourier amplitudes of simulations (M 6, R 20 km, rock), shape (records, frequencies)."""
    rows = []
    for seed in record_seeds:
        record = simulate(6.0, 20e3, None, seed, time_step, crust)
        size = 2**14 if time_step > 0.007 else 2**15  # the same length in seconds
        transform = time_step * np.abs(np.fft.rfft(record.acceleration, size))
        rows.append(np.interp(frequency, np.fft.rfftfreq(size, time_step), transform**2))
    return np.array(rows)


def test_response_spectrum_of_smsim() -> None:
    """Its random vibration theory was fitted to simulations within 3 %; the mean of 100 has an error of 1 to 3 %."""
    period, expected = np.array(SMSIM_PSA).T
    records = [simulate(6.0, 20e3, None, seed, 0.005, SINGLE_CORNER) for seed in range(100)]
    spectra = 100.0 * np.array([psa(record.acceleration, record.time_step, period) for record in records])
    error = np.std(spectra, axis=0) / math.sqrt(len(records)) / expected
    print(
        "\nperiod (s)", period, "\nmean / SMSIM", (np.mean(spectra, axis=0) / expected).round(3), "+-", error.round(3)
    )
    assert np.all(error < 0.04)
    assert np.all(np.abs(np.mean(spectra, axis=0) / expected - 1.0) < 0.03 + 2.5 * error)


def test_spectra_of_many_records_converge_to_the_model() -> None:
    """The squared amplitude of Gaussian noise has a scatter of 1, the mean of N of 1 / sqrt(N); no bias is left."""
    frequency = np.arange(0.5, 30.0, 0.2)  # wider than the window resolves, so nearly independent
    model = fourier_amplitude(frequency, 6.0, 20e3, None, SINGLE_CORNER) ** 2
    ratio = fourier(range(256), frequency, 0.01) / model
    for count in (16, 64, 256):
        means = ratio.reshape(256 // count, count, -1).mean(axis=1)
        assert np.std(means - 1.0) * math.sqrt(count) == pytest.approx(1.0, abs=0.1)
    assert abs(np.mean(ratio) - 1.0) < 4.0 / math.sqrt(ratio.size)


def test_low_frequencies_of_many_records() -> None:
    """Down to 0.15 Hz, three times the low-cut corner, where the filter takes 2.4 % of the square; 300 records: 6 %."""
    frequency = np.array([0.15, 0.2, 0.3])
    model = fourier_amplitude(frequency, 6.0, 20e3, None, SINGLE_CORNER) ** 2
    ratio = fourier(range(300), frequency, 0.01).mean(axis=0) / model
    assert np.all(np.abs(ratio - 1.0) < 3.0 * 0.06)


def test_spectrum_does_not_depend_on_the_time_step() -> None:
    """Mean over bands of 100 records each at two steps, below 45 Hz; every band has 20 frequencies: scatter 3 %."""
    frequency = np.concatenate([np.linspace(low, 1.5 * low, 20) for low in (1.0, 5.0, 15.0, 30.0)])
    coarse = fourier(range(100), frequency, 0.01).mean(axis=0).reshape(4, 20).mean(axis=1)
    fine = fourier(range(1000, 1100), frequency, 0.005).mean(axis=0).reshape(4, 20).mean(axis=1)
    np.testing.assert_allclose(coarse / fine, 1.0, atol=0.15)


def test_seeds() -> None:
    one, again, other = (simulate(6.5, 12e3, 360.0, seed) for seed in (123, 123, 124))
    assert one.checksum == again.checksum and np.array_equal(one.acceleration, again.acceleration)
    assert abs(np.corrcoef(one.acceleration, other.acceleration)[0, 1]) < 0.15
    expected = "simulated record: Boore (2003) stochastic point source, M 6.5, R 12 km, v_S30 360 m/s, seed 123"
    assert one.source == expected and one.name == "simulated M 6.5, R 12 km, v_S30 360 m/s, seed 123"
    assert simulate(6.5, 12e3, None, 1, name="station").name == "station"


@pytest.mark.parametrize(("magnitude", "distance"), [(4.0, 10e3), (6.5, 70.0), (7.36, 114.62e3), (8.0, 300e3)])
@pytest.mark.parametrize("time_step", [0.005, 0.02])
def test_the_ground_comes_to_rest_where_it_was(magnitude: float, distance: float, time_step: float) -> None:
    """Exact integration of the polygon; the rest comes from integrating samples of a smooth curve."""
    for seed in range(3):
        record = simulate(magnitude, distance, 360.0, seed, time_step)
        found = measures(record)
        assert abs(found.end_velocity) < 1e-5 * found.pgv
        assert abs(found.end_displacement) < 1e-4 * found.pgd
        count = round(5.0 / time_step)
        for part in (record.acceleration[:count], record.acceleration[-count:]):
            assert np.max(np.abs(part)) < 0.02 * record.pga  # quiet before and after
        assert np.argmax(np.abs(record.acceleration)) * time_step > 10.0


# thesis Table 5.6: file, magnitude, closest distance (km); v_S30 (m/s) of the station in the NGA-West2 flat file
REAL = [
    ("RSN6_IMPVALL.I_I-ELC180.AT2", 6.95, 6.09, 213.0),
    ("RSN7_NWCALIF.C_C-FRN045.AT2", 6.6, 91.15, 219.0),
    ("RSN9_BORREGO_B-ELC000.AT2", 6.5, 56.88, 213.0),
    ("RSN20_NCALIF.FH_H-FRN044.AT2", 6.5, 26.72, 219.0),
    ("RSN171_IMPVALL.H_H-EMO000.AT2", 6.53, 0.07, 265.0),
    ("RSN182_IMPVALL.H_H-E07140.AT2", 6.53, 0.56, 211.0),
    ("RSN723_SUPER.B_B-PTS225.AT2", 6.54, 0.95, 349.0),
    ("RSN183_IMPVALL.H_H-E08140.AT2", 6.53, 3.86, 206.0),
    ("RSN165_IMPVALL.H_H-CHI012.time_acc.csv", 6.53, 7.29, 242.0),
    ("RSN170_IMPVALL.H_H-ECC002.time_acc.csv", 6.53, 7.31, 192.0),
    ("RSN161_IMPVALL.H_H-BRA225.AT2", 6.53, 8.54, 209.0),
    ("RSN36_BORREGO_A-ELC180.AT2", 6.63, 45.12, 213.0),
    ("RSN140_TABAS_FER-L1.AT2", 7.35, 89.76, 303.0),
]


@needs_recordings
def test_real_records_as_a_set() -> None:
    """Plausibility, not proof: 13 components of 8 earthquakes, each against the median of 12 simulations.

    Records of one magnitude, distance and ground scatter by exp(0.6) or so about any model, and six of them share one
    earthquake: the median of the set is good to about exp(0.25), so a factor of 2 at any period, 1.4 over all.
    """
    period = np.geomspace(0.1, 2.0, 14)
    spectra, durations, peaks = [], [], []
    for name, magnitude, distance, v_s30 in REAL:
        unit = "g" if name.endswith(".csv") else None
        record = read_record_file(SHARED / name, acceleration_unit=unit)
        simulated = [simulate(magnitude, 1e3 * distance, v_s30, seed) for seed in range(12)]
        middle = np.median([psa(s.acceleration, s.time_step, period) for s in simulated], axis=0)
        spectra.append(psa(record.acceleration, record.time_step, period) / middle)
        durations.append(measures(record).duration_5_95 / np.median([measures(s).duration_5_95 for s in simulated]))
        peaks.append(record.pga / np.median([s.pga for s in simulated]))
    ratio = np.median(spectra, axis=0)
    print("\nperiod (s)", period.round(2), "\nrecord / simulation, median", ratio.round(2))
    print(f"all {np.median(spectra):.2f}, scatter {np.std(np.log(spectra)):.2f}, peak {np.median(peaks):.2f}, ", end="")
    print(f"significant duration {np.median(durations):.2f}")
    assert np.all((ratio > 0.5) & (ratio < 2.0))
    assert 0.7 < np.median(spectra) < 1.4
    assert 0.7 < np.median(peaks) < 1.4
    assert 0.7 < np.median(durations) < 1.6


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((3.9, 10e3, None, 1), "magnitude 3.9 4 to 8"),
        ((math.nan, 10e3, None, 1), "magnitude nan"),
        ((6.5, 301e3, None, 1), "distance 301 0 to 300 km"),
        ((6.5, -1.0, None, 1), "distance -0.001 km"),
        ((6.5, 10e3, 150.0, 1), "v_S30 150 180 to 1500 m/s"),
        ((6.5, 10e3, None, -1), "seed `-1`"),
        ((6.5, 10e3, None, 1.5), "seed `1.5`"),
        ((6.5, 10e3, None, 1, 0.05), "time step 0.05 0.001 to 0.02 s"),
    ],
)
def test_outside_the_range(arguments: tuple, message: str) -> None:
    with pytest.raises(InputError) as caught:
        simulate(*arguments)
    assert says(str(caught.value), f"{message} E-SIM-01")
