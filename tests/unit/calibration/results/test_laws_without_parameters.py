"""A campaign that names a law and no parameters: these are fitted first, and nothing is missing where it is right."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from kelvin_voigt_campaign import C, K, campaign

from edesign.calibration import calibrate
from edesign.calibration.run import with_fitted_law
from edesign.damper.testing.campaign_blocks import LawChoice


def test_the_right_law_without_parameters_is_fitted_and_nothing_is_missing(tmp_path: Path) -> None:
    named = campaign(tmp_path, tests=4)
    assert with_fitted_law(named) is named  # parameters that are declared are kept
    found = calibrate(replace(named, law=LawChoice("kelvin_voigt")), threads=1)
    assert (found.verdict, found.effects, found.other_law) == ("none", (), None)
    assert found.fitted_first
    # noise of 60 N on 3200 samples of some 10 kN: 1e-4 of a stiffness; ten times that
    assert found.parameters["declared"]["k"].value == pytest.approx(K, rel=1e-3)
    assert found.parameters["declared"]["c"].value == pytest.approx(C, rel=1e-2)
