"""Response spectra beside pyrotd, and the values that PEER published for two records of NGA-West2.

The PEER values (5 % and 2 % damping, 0.01 to 20 s, two components and RotD50) are test data of pyrotd: set
EDESIGN_PYROTD_DATA to its folder tests/data (https://github.com/arkottke/pyrotd).
"""

from __future__ import annotations

import gzip
import json
import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from benchmarks.peers.scipy_spectrum import noise_motion
from edesign.ground_motion.formats.at2 import read_at2
from edesign.ground_motion.response_spectrum import psa, rotated_spectra
from edesign.project.notation.units import STANDARD_GRAVITY

pytestmark = pytest.mark.peer
DATA = os.environ.get("EDESIGN_PYROTD_DATA")
PERIODS = np.geomspace(0.02, 1.5, 25)


def followed_by_rest(motion: np.ndarray, damping: float) -> np.ndarray:
    """pyrotd's motion repeats: in a rest of 2 s / damping the slowest oscillator calms down to exp(-8)."""
    return np.append(motion, np.zeros(int(2.0 / damping / 0.005)))


@pytest.fixture
def pyrotd(monkeypatch: pytest.MonkeyPatch) -> Any:
    """The package, without its pool of processes."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYTHONWARNINGS", "ignore")
        module = pytest.importorskip("pyrotd", reason="pyrotd is not installed")
    monkeypatch.setattr(module, "processes", 1)
    return module


@pytest.mark.filterwarnings("ignore:pkg_resources")
@pytest.mark.parametrize("damping", [0.02, 0.05, 0.2])
def test_pyrotd(pyrotd: Any, damping: float) -> None:
    """Within 0.1 %: pyrotd works in the frequency domain, here up to 60 times the oscillator's frequency."""
    motion = noise_motion(4000, 0.005)
    theirs = pyrotd.calc_spec_accels(
        0.005, followed_by_rest(motion, damping), 1.0 / PERIODS, damping, max_freq_ratio=60
    )
    np.testing.assert_allclose(psa(motion, 0.005, PERIODS, damping), theirs.spec_accel, rtol=1e-3)


@pytest.mark.filterwarnings("ignore:pkg_resources")
def test_pyrotd_rotated(pyrotd: Any) -> None:
    """RotD0, RotD50 and RotD100 within 0.1 %."""
    first, second = noise_motion(4000, 0.005), noise_motion(4000, 0.005, seed=2)
    periods = PERIODS[2::6]
    theirs = pyrotd.calc_rotated_spec_accels(
        0.005,
        followed_by_rest(first, 0.05),
        followed_by_rest(second, 0.05),
        1.0 / periods,
        percentiles=[0, 50, 100],
        max_freq_ratio=60,
        method="rigorous",
    )
    expected = np.reshape(theirs.spec_accel, (periods.size, 3)).T
    np.testing.assert_allclose(
        rotated_spectra(first, second, 0.005, periods, percentiles=(0, 50, 100)), expected, rtol=1e-3
    )


def compare_with_peer(periods: np.ndarray, ours: np.ndarray, published: list[float]) -> None:
    """From 0.5 s on within 0.1 %; below, PEER takes the largest sample, which may miss 5 % with ten a period."""
    ratio = ours / STANDARD_GRAVITY / np.array(published) - 1.0
    assert np.max(np.abs(ratio[periods >= 0.5])) < 1e-3
    assert np.median(np.abs(ratio)) < 1.5e-3
    assert -1e-3 < np.min(ratio) and np.max(ratio) < 0.035


@pytest.mark.skipif(not DATA, reason="EDESIGN_PYROTD_DATA does not name pyrotd's folder tests/data")
def test_peer_nga_west2() -> None:
    """Both components and RotD50 at all 111 periods."""
    folder = Path(DATA or "")
    with gzip.open(folder / "peer_nga_west2.json.gz") as stream:
        recordings = json.load(stream)
    assert recordings
    for recording in recordings:
        periods = np.array(recording["period"])
        first, second = (read_at2(folder / name) for name in recording["fnames"])
        step = first.time_step
        for spectrum in recording["spectra"]:
            damping = spectrum["damping"]
            for key, record in (("h1", first), ("h2", second)):
                if key in spectrum:
                    compare_with_peer(periods, psa(record.acceleration, step, periods, damping), spectrum[key])
            pair = first.acceleration, second.acceleration
            rotated = rotated_spectra(*pair, step, periods, damping, percentiles=(50,))[0]
            compare_with_peer(periods, rotated, spectrum["rotd50"])
