"""Both components of a pair matched to a spectrum: the combined spectrum is the target, and their ratio is kept.

Combined spectra are formed here, of motions that are turned here one degree at a time.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from edesign.codes.ec8 import ElasticSpectrum, national_parameters
from edesign.ground_motion.intensity import displacement, velocity
from edesign.ground_motion.matching import MatchOptions, match_record
from edesign.ground_motion.pair_matching import PairMatch, match_pair, on_one_axis
from edesign.ground_motion.record import Record
from edesign.ground_motion.response_spectrum import psa
from edesign.ground_motion.simulation import simulate
from edesign.project.records.records import CombinedSpectrum

TARGET = ElasticSpectrum(3.0, national_parameters().horizontal(1, "C"))
BAND = (0.2, 2.0)
T = np.geomspace(*BAND, 60)


def components() -> tuple[Record, Record]:
    """Two simulated motions, the second one weaker and of longer periods: their ratio changes with the period."""
    first, second = simulate(6.5, 15e3, 300.0, 11, name="a"), simulate(6.9, 40e3, 250.0, 12, name="b")
    size = min(first.acceleration.size, second.acceleration.size)
    step = first.time_step
    return Record("a", first.acceleration[:size], step, "a"), Record("b", second.acceleration[:size], step, "b")


@cache
def matched(method: str, spectrum: CombinedSpectrum | None) -> PairMatch:
    return match_pair(*components(), TARGET, MatchOptions(method, BAND), spectrum)  # type: ignore[arg-type]


def spectra(records: tuple[Record, Record]) -> np.ndarray:
    return np.array([psa(record.acceleration, record.time_step, T) for record in records])


def combined(records: tuple[Record, Record], spectrum: str) -> np.ndarray:
    first, second = spectra(records)
    if spectrum == "geometric_mean":
        return np.sqrt(first * second)
    if spectrum == "srss":
        return np.sqrt(0.5 * (first**2 + second**2))  # of two components that have the target: the target
    a, b = (record.acceleration for record in records)
    turned = [np.cos(x) * a + np.sin(x) * b for x in np.radians(np.arange(180.0))]
    every = [psa(motion, records[0].time_step, T) for motion in turned]
    return np.asarray(np.median(every, axis=0) if spectrum == "rotd50" else np.max(every, axis=0))


@pytest.mark.parametrize(
    ("method", "spectrum", "rms"),
    [  # of the products of two spectra as near as single records are matched, of rotated ones some per cent
        ("wavelets", "geometric_mean", 0.015),
        ("wavelets", "rotd100", 0.035),
        ("frequency", "srss", 0.02),
        ("frequency", "rotd50", 0.035),
        ("frequency", "rotd100", 0.035),
    ],
)
def test_the_combined_spectrum_is_the_target_and_the_ratio_is_kept(
    method: str, spectrum: CombinedSpectrum, rms: float
) -> None:
    found = matched(method, spectrum)
    error = combined(found.records, spectrum) / TARGET.acceleration(T) - 1.0
    assert np.sqrt(np.mean(error**2)) < rms
    before, after = (one[0] / one[1] for one in (spectra(components()), spectra(found.records)))
    assert np.ptp(np.log(before)) > 0.5  # the ratio of the components differs by 65 % over the band, and stays
    assert np.sqrt(np.mean(np.log(after / before) ** 2)) < 0.06  # both components are off by 3 to 4 % each
    assert found.fit is not None and found.fit.misfit.rms == pytest.approx(np.sqrt(np.mean(error**2)), abs=0.005)
    for record in found.records:  # as of single matched records
        assert abs(velocity(record.acceleration, record.time_step)[-1]) < 1e-6
        assert abs(displacement(record.acceleration, record.time_step)[-1]) < 1e-6


def test_with_scale_both_components_have_one_factor() -> None:
    found = matched("scale", "rotd100")
    first, second = components()
    assert found.fit is not None
    for record, match in zip((first, second), found.matches, strict=True):
        assert np.array_equal(match.matched.acceleration, found.fit.factor * record.acceleration)
    ratio = TARGET.acceleration(T) / combined((first, second), "rotd100")
    # least squares of logarithms at 100 periods, here at 60
    assert found.fit.factor == pytest.approx(np.exp(np.mean(np.log(ratio))), rel=2e-3)


def test_without_a_combined_spectrum_each_component_is_matched_as_alone() -> None:
    found, options = matched("frequency", None), MatchOptions("frequency", BAND)
    assert found.fit is None
    for record, match in zip(components(), found.matches, strict=True):
        alone = match_record(record, TARGET, options)
        assert np.array_equal(match.matched.acceleration, alone.matched.acceleration) and match.scale == alone.scale
    assert np.sqrt(np.mean((spectra(found.records) / TARGET.acceleration(T) - 1.0) ** 2)) < 0.04


def test_on_one_axis_each_sample_stays_at_its_time() -> None:
    """Time 0 of both is at index 3 afterwards."""
    first, second = Record("a", np.array([1.0, 2.0, 3.0]), 0.5, "a"), Record("b", np.array([4.0, 5.0]), 0.5, "b")
    one, other = on_one_axis([(first, 0.5), (second, 1.5)])
    assert one.acceleration.tolist() == [0.0, 0.0, 1.0, 2.0, 3.0]
    assert other.acceleration.tolist() == [4.0, 5.0, 0.0, 0.0, 0.0]
    assert on_one_axis([(first, 0.0), (first, 0.0)]) == [first, first]
