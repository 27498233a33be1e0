"""Response spectra: what is refused, in which words, and what must not change a result by a bit."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from benchmarks.peers.scipy_spectrum import noise_motion
from edesign.errors import InputError
from edesign.ground_motion.response_spectrum import psa, response_spectra, rotated_spectra

STEP = 0.01
MOTION = noise_motion(1500, STEP)
OTHER = noise_motion(1500, STEP, seed=2)
PERIODS = np.concatenate(([0.0, 1e-4, 1e-3], np.geomspace(0.01, 8.0, 70)))

WITH_NAN = MOTION.copy()
WITH_NAN[41] = np.nan
BAD: list[tuple[dict[str, Any], str]] = [
    ({"acceleration": []}, r"at least two samples is needed, not an array of shape \(0,\)"),
    ({"acceleration": [1.0]}, r"at least two samples is needed, not an array of shape \(1,\)"),
    ({"acceleration": np.zeros((2, 5))}, r"one row .* not an array of shape \(2, 5\)"),
    ({"acceleration": WITH_NAN}, "sample 42 is nan, not a finite number"),
    ({"acceleration": [0.0, 1.0, -np.inf]}, "sample 3 is -inf, not a finite number"),
    ({"time_step": 0.0}, "time step must be greater than zero, not 0 s"),
    ({"time_step": -0.01}, "time step must be greater than zero, not -0.01 s"),
    ({"time_step": np.nan}, "time step must be greater than zero, not nan s"),
    ({"periods": [0.1, -0.2]}, "a period must be zero or greater, not -0.2 s"),
    ({"periods": [np.inf]}, "a period must be zero or greater, not inf s"),
    ({"periods": []}, r"periods: one row is needed, not an array of shape \(0,\)"),
    ({"damping": -0.05}, "at least 0 and below 1 .of critical., not -0.05"),
    ({"damping": 5.0}, "at least 0 and below 1 .of critical., not 5"),
    ({"damping": 1.0}, "at least 0 and below 1 .of critical., not 1"),
    ({"damping": np.nan}, "at least 0 and below 1 .of critical., not nan"),
    ({"threads": 0}, "number of threads must be at least 1, not 0"),
]


@pytest.mark.parametrize(("change", "message"), BAD)
def test_bad_input_is_named_with_its_value(change: dict[str, Any], message: str) -> None:
    arguments = {"acceleration": MOTION, "time_step": STEP, "periods": [0.1, 1.0]} | change
    with pytest.raises(InputError, match=message):
        psa(**arguments)
    if "damping" in arguments:
        arguments["dampings"] = [0.02, arguments.pop("damping")]
    with pytest.raises(InputError, match=message):
        response_spectra(**arguments)


def test_rotated_spectra_want_components_of_one_length() -> None:
    with pytest.raises(InputError, match="E-SPEC-01"):
        rotated_spectra(MOTION, OTHER[:-1], STEP, [1.0])
    with pytest.raises(InputError, match="E-SPEC-02"):
        rotated_spectra(MOTION, OTHER, STEP, [1.0], percentiles=(50, 101))
    with pytest.raises(InputError, match="E-SPEC-02"):
        psa(MOTION, STEP, [1.0], damping=[0.02, 0.05])  # type: ignore[arg-type]


def test_period_zero_is_the_ground() -> None:
    spectra = response_spectra(MOTION, STEP, PERIODS, (0.02, 0.05))
    pga = np.max(np.abs(MOTION))
    assert np.all(spectra.sa[:, 0] == pga) and np.all(spectra.psa[:, 0] == pga)
    assert np.all(spectra.sd[:, 0] == 0.0) and np.all(spectra.sv[:, 0] == 0.0)
    assert psa(MOTION, STEP, [0.0])[0] == pga
    turned = [np.max(np.abs(np.cos(x) * MOTION + np.sin(x) * OTHER)) for x in np.radians(np.arange(180))]
    rotated = rotated_spectra(MOTION, OTHER, STEP, [0.0], percentiles=(0, 50, 100))
    np.testing.assert_allclose(rotated[:, 0], [min(turned), np.median(turned), max(turned)], rtol=1e-12)


def test_pseudo_spectra_follow_from_displacement() -> None:
    spectra = response_spectra(MOTION, STEP, PERIODS, (0.0, 0.05))
    omega = 2.0 * np.pi / PERIODS[1:]
    np.testing.assert_allclose(spectra.psa[:, 1:], omega**2 * spectra.sd[:, 1:], rtol=1e-14)
    np.testing.assert_allclose(spectra.psa[0, 3:], spectra.sa[0, 3:], rtol=1e-12)  # undamped: the same
    assert np.array_equal(psa(MOTION, STEP, PERIODS, 0.05), spectra.psa[1])


@pytest.mark.parametrize("threads", [2, 3])
def test_threads_do_not_change_a_bit(threads: int) -> None:
    one = response_spectra(MOTION, STEP, PERIODS, (0.01, 0.05, 0.3))
    several = response_spectra(MOTION, STEP, PERIODS, (0.01, 0.05, 0.3), threads=threads)
    for kind in ("sd", "sv", "sa"):
        assert np.array_equal(getattr(one, kind), getattr(several, kind))
    first = rotated_spectra(MOTION, OTHER, STEP, PERIODS)
    assert np.array_equal(first, rotated_spectra(MOTION, OTHER, STEP, PERIODS, threads=threads))


def test_company_and_order_of_periods_do_not_change_a_bit() -> None:
    together = psa(MOTION, STEP, PERIODS)
    assert np.array_equal(psa(MOTION, STEP, PERIODS[::-1])[::-1], together)
    assert np.array_equal([psa(MOTION, STEP, [period])[0] for period in PERIODS[::5]], together[::5])


def test_arguments_are_not_changed() -> None:
    motion, periods = MOTION.copy(), PERIODS.copy()
    psa(motion, STEP, periods)
    rotated_spectra(motion, OTHER, STEP, periods)
    assert np.array_equal(motion, MOTION) and np.array_equal(periods, PERIODS)
