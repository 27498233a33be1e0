"""Steps of the last fit: fine enough for what happens within a step that the samples leave. Own integration."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from edesign.calibration.dampers.from_campaign import damper_problem
from edesign.calibration.results.fit import at_full_rate, estimates, resolved, unbounded
from edesign.calibration.search.models import FittedModel
from edesign.calibration.search.settings import SETTINGS
from edesign.damper.testing.campaign import write_campaign
from edesign.damper.testing.campaign_blocks import LawChoice
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.specimen import Specimen
from edesign.estimation.noise import Noise

C, K, GAP = 4.0e5, 4.0e8, 5.0e-4  # N s/m, N/m, m: a contact builds up its force in a millisecond
STEP, STRIDE, NOISE = 1e-5, 500, 100.0  # s, of which a sample is 5 ms; N


def _force(x: np.ndarray, gap: float) -> np.ndarray:
    """A linear dashpot behind a clearance of 2 `gap` with stiff ends: implicit steps, exact for each of them."""
    found, d, share = np.zeros_like(x), 0.0, STEP * K / C
    for i, at in enumerate(x.tolist()):
        over = at - d
        over = over - gap if over > gap else over + gap if over < -gap else 0.0
        found[i] = K * over / (1.0 + share)
        d += STEP * found[i] / C
    return found


def _fitted(folder: Path, gap: float, effects: list[str]) -> FittedModel:
    t, random, tests = np.arange(0.0, 6.0, STEP), np.random.default_rng(2), []
    for order, (f, amplitude) in enumerate(((0.5, 0.02), (1.0, 0.012), (0.7, 0.016), (1.4, 0.01))):
        x = amplitude * (1.0 - np.exp(-2.0 * t)) * np.sin(2.0 * np.pi * f * t + 0.3 * np.sin(t))
        force = _force(x, gap)[::STRIDE]
        force += NOISE * random.standard_normal(force.size)
        use = "fit" if order < 3 else "validate"
        tests.append(DamperTest(f"test_{order}", t[::STRIDE], x[::STRIDE], force, 20.0, use=use))
    law = LawChoice("viscous_power", {"c": "0.4 kN*s/mm", "alpha": 1.0})
    whole = damper_problem(write_campaign(folder, Specimen("S", 2, 0.0414, 0.012), tests, law), threads=1).full_rate
    chosen = [next(one for one in whole.effects if one.label == label) for label in effects]
    starts = [C, 1.0, *([2.0 * gap, K, 1.0] if effects else [])]
    fitter = unbounded(whole, SETTINGS)
    found = fitter.fit(chosen, np.array(starts), Noise.white(whole.deviations))
    assert found is not None
    return at_full_rate(fitter, found)


def test_steps_are_cut_where_a_contact_is_shorter_than_they_are(tmp_path: Path) -> None:
    coarse = _fitted(tmp_path, GAP, ["play.gap_seated"])
    fine = resolved(coarse)
    assert fine.problem.parts > 1  # type: ignore[attr-defined]
    left = [float(np.std(np.concatenate(one.left))) / NOISE for one in (coarse, fine)]
    assert left[0] > 1.1 and left[1] < 1.02
    stiffness = [estimates(one)[3] for one in (coarse, fine)]
    assert stiffness[0].value > 1.3 * K and stiffness[0].interval[0] > K
    assert stiffness[1].value == pytest.approx(K, rel=0.02)
    for one, true in zip(estimates(fine), (C, 1.0, 2.0 * GAP, K), strict=False):
        assert one.interval[0] < true < one.interval[1]


def test_steps_are_as_they_were_where_nothing_happens_within_them(tmp_path: Path) -> None:
    found = _fitted(tmp_path, 0.0, [])
    assert resolved(found) is found
