"""Limits of the study of an extracted frame: those of the building's design."""

from __future__ import annotations

import pytest
from building_examples import SMALL, building

from edesign.space.extract.study_limits import study_limits


@pytest.mark.parametrize(("importance", "nu"), [("II", 0.5), ("IV", 0.4)])
def test_the_drift_is_the_limit_over_nu_of_the_importance_class(importance: str, nu: float) -> None:
    """Source: EN 1998-1:2004, 4.4.3.2(1) b, and its (2) Note: 0.4 in classes III and IV, 0.5 in I and II."""
    found = study_limits(building(SMALL.replace("{probability: 10 %}", f"{{importance_class: {importance}}}")))
    assert found.drift == pytest.approx(0.0075 / nu, rel=1e-12)
    assert f"nu = {nu:g}" in found.drift_is
