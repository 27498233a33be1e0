"""Baker's worked example of multiple stripes: 40 records at each of eight intensities.

The counts are the example data of the fitting scripts that accompany Baker (2015), Earthquake Spectra 31(1), 579-599. A
Python version of them by others, which minimises the likelihood by Nelder and Mead's search, states the result
theta = 1.07611623, beta = 0.42923779 for these data.
"""

from __future__ import annotations

import pytest

from edesign.assess.fragility import fit_counts

INTENSITY = [0.2, 0.3, 0.4, 0.6, 0.7, 0.8, 0.9, 1.0]
COLLAPSES = [0, 0, 0, 4, 6, 13, 12, 16]


def test_median_and_dispersion() -> None:
    """1e-5: where a search that ends at 1e-4 in its arguments leaves a flat maximum."""
    fit = fit_counts(INTENSITY, [40] * 8, COLLAPSES)
    assert fit.theta == pytest.approx(1.07611623, rel=1e-5)
    assert fit.beta == pytest.approx(0.42923779, rel=1e-5)
    assert fit.count == 320
