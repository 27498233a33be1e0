"""Windows of spectra, against those of scipy."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal.windows import blackmanharris

from edesign.calibration.signals.windows import blackman_harris


@pytest.mark.parametrize("samples", [2, 100, 101])
@pytest.mark.parametrize("periodic", [False, True])
def test_the_blackman_harris_window_is_that_of_scipy(samples: int, periodic: bool) -> None:
    np.testing.assert_allclose(
        blackman_harris(samples, periodic), blackmanharris(samples, sym=not periodic), atol=1e-14
    )
