"""Tracking indicators: closed forms of sines, noise, springs and dashpots; what cannot be determined; bad channels.

Sampled at the main step of the thesis, 1 ms, unless a test says otherwise.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import asdict

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from edesign.errors import InputError
from edesign.substructure.indicators import Tracking, Undetermined, definitions, tracking
from edesign.substructure.indicators.correlation_delay import correlation_delay
from edesign.substructure.indicators.crossing_delay import crossing_delay
from edesign.substructure.indicators.frequency_index import equivalent_frequency, frequency_index
from edesign.substructure.indicators.interface_energy import energy_error, relative_energy_error
from edesign.substructure.indicators.peaks import peak_errors
from edesign.substructure.indicators.synchronisation import tracking_indicator
from edesign.substructure.indicators.tracking_error import nrms, nrms_root

STEP = 1e-3
AMPLITUDE = 5e-3


def whole_cycles(frequency: float, cycles: int, step: float = STEP) -> np.ndarray:
    """Instants of whole cycles, the last sample one step before the next cycle."""
    return np.arange(round(cycles / frequency / step)) * step


def sine(t: np.ndarray, frequency: float, delay: float = 0.0, amplitude: float = AMPLITUDE) -> np.ndarray:
    return amplitude * np.sin(2.0 * math.pi * frequency * (t - delay))


def band_noise(seed: int, band: tuple[float, float] = (0.1, 5.0), peak: float = 5.5e-3) -> Callable[..., np.ndarray]:
    """The second command of thesis 6.2.4, as a function of time: a flat band of sines, known between samples too."""
    generator = np.random.default_rng(seed)
    frequencies = np.linspace(*band, 120) + generator.uniform(-0.02, 0.02, 120)
    phases = generator.uniform(0.0, 2.0 * math.pi, 120)

    def raw(t: np.ndarray) -> np.ndarray:
        return np.sum(np.sin(2.0 * math.pi * frequencies[:, None] * t + phases[:, None]), axis=0)

    scale = peak / float(np.max(np.abs(raw(np.arange(0.0, 12.0, STEP)))))
    return lambda t: scale * raw(t)


def rms_frequency(x: np.ndarray) -> float:
    """rms velocity over rms displacement, rad/s."""
    return float(np.sqrt(np.mean(np.gradient(x, STEP) ** 2) / np.mean(x**2)))


@pytest.mark.parametrize("frequency", [0.25, 2.0, 5.0])
@pytest.mark.parametrize("delay", [0.0, 1e-3, 10.3e-3, 3.37e-3, -2.6e-3])
def test_a_late_sine_has_its_delay_by_all_three_methods(frequency: float, delay: float) -> None:
    """Crossings to 0.1 us: straight lines are off by (omega T)^2 / 24 of a sample and less, 0.04 us at 5 Hz.

    The correlation to 1/2000 of a sample: the overlap of 40 cycles changes with the lag.
    """
    t = whole_cycles(frequency, 40)
    x_t, x_m = sine(t, frequency), sine(t, frequency, delay)
    crossings = crossing_delay(x_t, x_m, STEP)
    assert crossings.mean == pytest.approx(delay, abs=1e-7)
    assert crossings.largest == pytest.approx(delay, abs=1e-7)
    assert crossings.delays.size in (78, 79, 80)  # 2 a cycle; one at either end may have no partner
    assert correlation_delay(x_t, x_m, STEP).delay == pytest.approx(delay, abs=5e-7)
    index = frequency_index(x_t, x_m, STEP)  # whole cycles: exact
    assert index.delay == pytest.approx(delay, abs=1e-12)
    assert index.phase == pytest.approx(-2.0 * math.pi * frequency * delay, abs=1e-12)
    assert equivalent_frequency(x_t, STEP) == pytest.approx(frequency, rel=1e-10)


@settings(max_examples=25, deadline=None)
@given(st.floats(0.3, 6.0), st.floats(-0.9, 0.9), st.floats(0.5, 1.5), st.floats(3.3, 20.0))
def test_delay_and_amplitude_are_separated(frequency: float, share: float, gain: float, cycles: float) -> None:
    """Up to 0.9 of a quarter period, any number of cycles.

    The correlation to 1/100 of a sample, as the overlap changes with the lag; crossings as in the test above. Peaks to
    1e-5: two parabolas of 2e-3 each that sit differently between the samples by half of one.
    """
    delay = share * 0.25 / frequency
    t = np.arange(round(cycles / frequency / STEP)) * STEP
    x_t, x_m = sine(t, frequency), gain * sine(t, frequency, delay)
    assert correlation_delay(x_t, x_m, STEP).delay == pytest.approx(delay, abs=1e-5)
    assert crossing_delay(x_t, x_m, STEP).mean == pytest.approx(delay, abs=1e-6)
    peaks = peak_errors(x_t, x_m, STEP)
    assert peaks.mean == pytest.approx(gain - 1.0, abs=1e-5)
    assert peaks.largest == pytest.approx(gain - 1.0, abs=1e-5)


def test_amplitude_of_the_frequency_index_is_exact() -> None:
    t = whole_cycles(2.0, 20)
    index = frequency_index(sine(t, 2.0), 0.976 * sine(t, 2.0, 10.3e-3), STEP)
    assert index.amplitude == pytest.approx(0.976, rel=1e-12)
    noise = band_noise(1)(t)
    assert frequency_index(noise, 1.0061 * noise, STEP).amplitude == pytest.approx(1.0061, rel=1e-12)


def test_frequency_index_of_two_sines_by_hand() -> None:
    """Amplitudes 3 and 1 at 1 and 3 Hz weigh 9 to 1; gains 1 and 0.5, delays 20 ms and none."""
    t = whole_cycles(1.0, 10)
    x_t = sine(t, 1.0, amplitude=3.0) + sine(t, 3.0, amplitude=1.0)
    x_m = sine(t, 1.0, 0.02, amplitude=3.0) + sine(t, 3.0, amplitude=0.5)
    fei = (9.0 * np.exp(-2j * math.pi * 0.02) + 0.5) / 10.0
    index = frequency_index(x_t, x_m, STEP)
    assert equivalent_frequency(x_t, STEP) == pytest.approx(1.2)
    assert index.amplitude == pytest.approx(abs(fei)) and index.phase == pytest.approx(np.angle(fei))
    assert index.delay == pytest.approx(-np.angle(fei) / (2.0 * math.pi * 1.2))


@pytest.mark.parametrize(("frequency", "delay"), [(2.09, 1.2e-3), (1.16, 1.6e-3), (5.0, 10.3e-3)])
def test_nrms_of_a_late_sine_is_twice_the_sine_of_half_its_phase(frequency: float, delay: float) -> None:
    """The root is 2 sin(omega tau / 2), about omega tau: the first two are the pairs of thesis Tables 6.3 and 6.4."""
    t = np.arange(4000) / (4000.0 * frequency)  # one whole cycle
    x_t, x_m = sine(t, frequency), sine(t, frequency, delay)
    phase = 2.0 * math.pi * frequency * delay
    assert nrms_root(x_t, x_m) == pytest.approx(2.0 * math.sin(0.5 * phase), rel=1e-10)
    assert nrms(x_t, x_m) == pytest.approx(4.0 * math.sin(0.5 * phase) ** 2, rel=1e-10)
    assert nrms_root(x_t, x_m) == pytest.approx(phase, rel=phase**2 / 20.0)  # the series has phase^2 / 24
    if frequency != 5.0:
        assert nrms_root(x_t, x_m) == pytest.approx({2.09: 1.57e-2, 1.16: 1.17e-2}[frequency], rel=0.01)  # printed


def test_nrms_of_amplitude_and_delay_together() -> None:
    """|1 - A exp(-i phi)|^2 = 1 - 2 A cos phi + A^2."""
    t = whole_cycles(2.0, 5)
    phase = 2.0 * math.pi * 2.0 * 10.3e-3
    found = tracking(sine(t, 2.0), 0.95 * sine(t, 2.0, 10.3e-3), STEP)
    assert found.nrms == pytest.approx(1.0 - 2.0 * 0.95 * math.cos(phase) + 0.95**2, rel=1e-10)
    assert found.nrms_root == pytest.approx(math.sqrt(found.nrms))
    assert found.maximum_error == pytest.approx(math.sqrt(found.nrms), rel=1e-4)  # a sine too; its peak between samples
    assert found.frequency_index_amplitude == pytest.approx(0.95, rel=1e-12)
    assert found.peak_error_mean == pytest.approx(-0.05, abs=1e-6)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_late_noise_of_five_hertz(seed: int) -> None:
    """10.3 ms as in thesis Table 6.1: NRMS_root is omega_rms tau less (omega tau)^2 / 24 of it, 0.3 % for this band."""
    t = np.arange(0.0, 12.0, STEP)
    x = band_noise(seed)
    found = tracking(x(t), x(t - 10.3e-3), STEP)
    assert found.nrms_root == pytest.approx(rms_frequency(x(t)) * 10.3e-3, rel=5e-3)
    assert found.correlation_delay == pytest.approx(10.3e-3, abs=2e-6)  # 1/500 of a sample: the ends of the record
    assert found.crossing_delay_mean == pytest.approx(10.3e-3, abs=2e-6)
    assert found.crossing_delay_largest == pytest.approx(10.3e-3, abs=2e-5)  # of the slowest crossing
    assert found.crossing_pairs > 50
    assert found.frequency_index_delay == pytest.approx(10.3e-3, abs=0.5e-3)  # does not rest at its ends: leaks
    spread = np.var(2.0 * math.pi * np.linspace(0.1, 5.0, 120) * 10.3e-3) / 2.0
    assert found.frequency_index_amplitude == pytest.approx(1.0 - spread, abs=2e-3)  # as its docstring says; leaks
    assert found.peak_error_mean == pytest.approx(0.0, abs=2e-5)


def test_encoder_noise() -> None:
    """1 um, the encoder of the thesis, and 20 um: means hold, single small half-cycles do not (trap 4 of the findings).

    The noise of a mean of 60 crossings at 20 um over 50 um a sample is 0.04 ms, more where the crossing is slow.
    """
    t = np.arange(0.0, 12.0, STEP)
    x, noise = band_noise(4), np.random.default_rng(5).standard_normal(t.size)
    fine, rough = (tracking(x(t), 1.02 * x(t - 10.3e-3) + sigma * noise, STEP) for sigma in (1e-6, 20e-6))
    assert fine.crossing_delay_mean == pytest.approx(10.3e-3, abs=0.01e-3)
    assert rough.crossing_delay_mean == pytest.approx(10.3e-3, abs=0.15e-3)
    assert fine.correlation_delay == pytest.approx(10.3e-3, abs=0.005e-3)
    assert rough.correlation_delay == pytest.approx(10.3e-3, abs=0.03e-3)
    assert fine.peak_error_mean == pytest.approx(0.02, abs=5e-4)
    assert rough.peak_error_mean == pytest.approx(0.02, abs=1e-2)
    assert rough.crossing_pairs == pytest.approx(fine.crossing_pairs, abs=2)


def test_a_quiet_start_and_rest_between_do_not_count() -> None:
    """5 s of rest with encoder noise, 8 cycles, 1 s of rest, 8 cycles: crossings of the cycles only (trap 3)."""
    t = whole_cycles(2.0, 8)
    rest, pause = np.zeros(5000), np.zeros(1000)
    cycles, late = sine(t, 2.0), sine(t, 2.0, 7.4e-3)
    late[t < 7.4e-3] = 0.0
    x_t = np.concatenate((rest, cycles, pause, cycles, pause))
    x_m = np.concatenate((rest, late, pause, late, pause)) + 1e-6 * np.random.default_rng(1).standard_normal(x_t.size)
    found = tracking(x_t, x_m, STEP)
    assert found.crossing_pairs == 2 * 15
    assert found.crossing_delay_mean == pytest.approx(7.4e-3, abs=0.02e-3)  # 1 um over 63 um a sample: 0.016 ms each
    assert found.crossing_delay_largest == pytest.approx(7.4e-3, abs=0.08e-3)
    assert found.peaks == 2 * 16
    alone = tracking(cycles, late, STEP)
    assert found.nrms_root == pytest.approx(alone.nrms_root, rel=1e-3)


def test_the_threshold_leaves_out_small_half_cycles() -> None:
    t = whole_cycles(2.0, 8)
    x = np.concatenate((0.05 * sine(t, 2.0), sine(t, 2.0)))
    assert crossing_delay(x, x, STEP).delays.size == 31
    assert crossing_delay(x, x, STEP, threshold=1e-3).delays.size == 15
    assert peak_errors(x, x, STEP, threshold=1e-3).errors.size == 16


def test_a_target_shifted_by_seconds_is_found() -> None:
    t = np.arange(0.0, 12.0, STEP)
    x = band_noise(6)
    found = tracking(x(t), x(t - 2.0), STEP)
    assert found.correlation_delay == pytest.approx(2.0, abs=1e-5)
    assert found.crossing_delay_mean == pytest.approx(2.0, abs=1e-5)


@pytest.mark.parametrize("delay", [8e-3, -8e-3])
def test_tracking_indicator_is_the_area_of_the_ellipse(delay: float) -> None:
    """pi a^2 sin(phi) a cycle, above zero if late; the polygon of N samples has sin(d) / d of it, d = 2 pi / N."""
    cycles = 5
    t = np.append(whole_cycles(2.0, cycles), cycles / 2.0)
    area = math.pi * AMPLITUDE**2 * math.sin(2.0 * math.pi * 2.0 * delay)
    d = 2.0 * math.pi * 2.0 * STEP
    indicator = tracking_indicator(sine(t, 2.0), sine(t, 2.0, delay))
    assert indicator[-1] == pytest.approx(cycles * area * math.sin(d) / d, rel=1e-9)
    assert indicator[0] == 0.0 and indicator.size == t.size
    assert tracking_indicator(sine(t, 2.0), 1.1 * sine(t, 2.0))[-1] == pytest.approx(
        0.0, abs=1e-15
    )  # no delay, no area


def test_energy_of_a_spring_and_of_a_dashpot() -> None:
    """A spring k feeds pi k a^2 sin(phi) a cycle; a dashpot c takes pi c omega a^2 and errs by 1 - cos(phi) of it.

    Sums by trapezoids have sin(d) / d of the integrals, as the area of a polygon has, d = omega T.
    """
    cycles, frequency, delay, k, c = 4, 2.0, 10e-3, 4.346e6, 1.2e5
    omega = 2.0 * math.pi * frequency
    t = np.append(whole_cycles(frequency, cycles), cycles / frequency)
    x_t, x_m = sine(t, frequency), sine(t, frequency, delay)
    polygon = math.sin(omega * STEP) / (omega * STEP)
    fed = cycles * math.pi * k * AMPLITUDE**2 * math.sin(omega * delay) * polygon
    assert energy_error(k * x_m, x_t, x_m)[-1] == pytest.approx(fed, rel=1e-9)
    viscous = c * omega * AMPLITUDE * np.cos(omega * (t - delay))
    taken = cycles * math.pi * c * omega * AMPLITUDE**2 * polygon
    assert energy_error(viscous, x_t, x_m)[-1] == pytest.approx(taken * (1.0 - math.cos(omega * delay)), rel=1e-8)
    # the force that a perfect prediction gives the structure is that of its target: nothing is fed after whole cycles
    assert energy_error(k * x_m, x_t, x_m, k * x_t)[-1] == pytest.approx(0.0, abs=1e-9 * fed)
    assert relative_energy_error(viscous, x_t, x_m) == pytest.approx(1.0 - math.cos(omega * delay), rel=1e-8)
    both = tracking(x_t, x_m, STEP, k * x_m + viscous)
    assert both.energy_error == pytest.approx(fed + taken * (1.0 - math.cos(omega * delay)), rel=1e-8)


def test_a_force_of_wrong_sign_has_no_share_of_energy() -> None:
    t = whole_cycles(2.0, 4)
    x = sine(t, 2.0)
    found = tracking(x, sine(t, 2.0, 0.01), STEP, -1e5 * np.gradient(x, STEP))
    assert math.isnan(found.relative_energy_error) and "wrong sign" in found.undetermined["relative_energy_error"]


def numbers(found: Tracking) -> dict[str, float]:
    return {name: value for name, value in asdict(found).items() if name in definitions()}


def undetermined(found: Tracking) -> set[str]:
    missing = {name for name, value in numbers(found).items() if math.isnan(value)}
    assert missing == set(found.undetermined)  # each with a reason, and no reason without
    return missing


DELAYS = {
    "crossing_delay_mean",
    "crossing_delay_largest",
    "correlation_delay",
    "correlation",
    "frequency_index_amplitude",
    "frequency_index_phase",
    "frequency_index_delay",
    "peak_error_mean",
    "peak_error_largest",
}
ENERGIES = {"energy_error", "relative_energy_error"}
SIZES = {"nrms", "nrms_root", "maximum_error"}


def test_a_good_test_determines_all() -> None:
    t = whole_cycles(2.0, 8)
    assert undetermined(tracking(sine(t, 2.0), sine(t, 2.0, 1e-3), STEP, 1e6 * sine(t, 2.0, 1e-3))) == set()
    assert undetermined(tracking(sine(t, 2.0), sine(t, 2.0), STEP)) == ENERGIES


def test_a_channel_of_zeros_or_of_one_value() -> None:
    t = whole_cycles(2.0, 8)
    x, zero = sine(t, 2.0), np.zeros(t.size)
    assert undetermined(tracking(zero, zero, STEP)) == DELAYS | ENERGIES | SIZES | {"equivalent_frequency"}
    stuck = tracking(x, np.full(t.size, 0.3e-3), STEP, x)
    assert undetermined(stuck) == DELAYS | {"relative_energy_error"}
    assert stuck.undetermined["correlation_delay"] == "the measured channel is constant"
    assert stuck.undetermined["relative_energy_error"] == "no work is done on the specimen"
    dead = tracking(x, zero, STEP, zero)
    assert dead.nrms_root == 1.0 and dead.maximum_error == 1.0 and dead.energy_error == 0.0


def test_a_reversed_and_an_unrelated_channel() -> None:
    t = np.arange(0.0, 12.0, STEP)
    x = band_noise(8)(t)
    back = tracking(x, -x, STEP)
    assert undetermined(back) - {"frequency_index_phase"} >= DELAYS - {name for name in DELAYS if "index" in name}
    assert "opposite sign" in back.undetermined["correlation_delay"]
    assert back.nrms_root == pytest.approx(2.0)
    other = tracking(x, band_noise(9)(t), STEP)
    assert undetermined(other) == DELAYS | ENERGIES
    assert "does not follow" in other.undetermined["crossing_delay_mean"]


def test_a_channel_that_stops_midway() -> None:
    """The half that is left: no delay, half of the amplitude by the frequency index, peaks down by all in that half."""
    t = whole_cycles(2.0, 40)
    x = sine(t, 2.0)
    noise = 1e-6 * np.random.default_rng(3).standard_normal(t.size)
    found = tracking(x, np.where(t < 10.0, x, 0.0) + noise, STEP)
    assert found.correlation_delay == pytest.approx(0.0, abs=2e-5)
    assert found.crossing_delay_mean == pytest.approx(0.0, abs=2e-5) and found.crossing_pairs in (39, 40)
    assert found.frequency_index_amplitude == pytest.approx(0.5, abs=1e-3)
    assert found.peak_error_mean == pytest.approx(-0.5, abs=0.01)
    assert found.peak_error_largest == pytest.approx(-1.0, abs=1e-3)


def test_no_crossing() -> None:
    """A half sine returns to rest: it has a peak and a delay, but crosses nothing."""
    t = np.arange(0.0, 1.0, STEP)
    pulse = np.where((t > 0.3) & (t < 0.8), np.sin(2.0 * math.pi * (t - 0.3)), 0.0)
    late = np.where((t > 0.31) & (t < 0.81), np.sin(2.0 * math.pi * (t - 0.31)), 0.0)
    found = tracking(pulse, late, STEP)
    assert undetermined(found) == {"crossing_delay_mean", "crossing_delay_largest"} | ENERGIES
    assert found.crossing_pairs == 0 and found.peaks == 1
    assert found.correlation_delay == pytest.approx(0.01, abs=1e-6)
    with pytest.raises(Undetermined, match="does not cross zero"):
        crossing_delay(pulse, late, STEP)


@settings(max_examples=50, deadline=None)
@given(st.lists(st.tuples(*[st.floats(-1e3, 1e3)] * 3), min_size=3, max_size=40))
def test_any_numbers_give_numbers_or_reasons(rows: list[tuple[float, float, float]]) -> None:
    target, measured, force = np.array(rows).T
    found = tracking(target, measured, STEP, force)
    undetermined(found)
    assert not any(math.isinf(value) for value in numbers(found).values())


def test_definitions_name_each_number() -> None:
    entries = definitions()
    assert set(entries) == set(asdict(tracking([0.0, 1.0, 0.0], [0.0, 1.0, 0.0], STEP))) - {"undetermined"}
    assert entries["tracking_indicator"][1] == "m2" and "6.28" in entries["nrms"][0]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"measured": [0.0, 1.0]}, "measured: 2 .*E-SIGNAL-01"),
        ({"force": [1.0] * 5}, "force: 5 .*E-SIGNAL-01"),
        ({"target": [0.0, math.nan, 1.0, math.inf]}, "target: 2 of 4 .*E-SIGNAL-02"),
        ({"measured": ["a", "b", "c", "d"]}, "measured.*'a'.*E-SIGNAL-01"),
        ({"target": [[0.0, 1.0]]}, r"target.*\(1, 2\).*E-SIGNAL-01"),
        ({"target": [0.0, 1.0]}, "target: 2 samples.*E-SIGNAL-01"),
        ({"measured": [0.0, 1e200, 0.0, 0.0]}, "measured.*E-SIGNAL-02"),
        ({"step": 0.0}, "step = 0 s.*E-VALUE-02"),
        ({"step": math.nan}, "step = nan s.*E-VALUE-02"),
        ({"threshold": -1e-4}, "threshold.*E-VALUE-02"),
    ],
)
def test_bad_channels_are_named(arguments: dict[str, object], message: str) -> None:
    good: dict[str, object] = {"target": [0.0, 1.0, 0.0, -1.0], "measured": [0.0, 1.0, 0.0, -1.0], "step": STEP}
    with pytest.raises(InputError, match=message):
        tracking(**{**good, **arguments})  # type: ignore[arg-type]
