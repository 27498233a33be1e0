"""The last fit of a calibration, to all samples: thermometers are believed where the tests say so, and only there.

Reference: the parameters and temperatures with which the forces were made (thesis Table 4.2, gamma_T of Table 4.4).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from edesign.calibrate.dampers.full_rate import at_full_rate
from edesign.calibrate.dampers.prepare import damper_problem, thinned
from edesign.calibrate.evidence import Judged
from edesign.calibrate.fit import Model, fit
from edesign.calibrate.outcome import Outcome
from edesign.calibrate.search.selection import Selection
from edesign.damper.damper import Damper
from edesign.damper.laws import law
from edesign.damper.parameters import read_parameters
from edesign.damper.testing.campaign import write_campaign
from edesign.damper.testing.campaign_blocks import LawChoice
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.specimen import Specimen

NOISE = 20.0  # N, of forces of some 20 kN
TEMPERATURES = (20.0, 22.5, 25.0, 27.5, 30.0, 33.0, 24.0, 29.0)


def _found(folder: Path, thermometer: float) -> tuple[Selection, Outcome]:
    """The law refitted, of tests whose thermometer was wrong by so many kelvin, one way and the other."""
    mgmm = law("mgmm")
    true = read_parameters(mgmm, "thesis_table_4_2")
    random = np.random.default_rng(4)
    tests = []
    for i, temperature in enumerate(TEMPERATURES):
        t = np.arange(0.0, 6.0, 1.0 / 250.0)
        w = 2.0 * np.pi * (0.6, 1.5, 1.0, 2.0, 0.8, 1.2, 1.0, 1.5)[i]
        u = (5e-3, 3e-3, 8e-3, 4e-3, 6e-3, 7e-3, 5e-3, 4e-3)[i] * (1.0 - np.exp(-2.0 * t)) * np.sin(w * t)
        force = Damper(mgmm, true).at(temperature)[0].force(t, u) + NOISE * random.standard_normal(t.size)
        use = "fit" if i < 6 else "validate"
        tests.append(DamperTest(f"test_{i + 1:02d}", t, u, force, temperature + (-1) ** i * thermometer, use=use))
    folder.mkdir()
    written = write_campaign(folder, Specimen("S", 2, 0.0414, 0.012), tests, LawChoice("mgmm", "thesis_table_4_2"))
    problem = damper_problem(written)
    noise = (NOISE,) * len(tests)
    model = Model(thinned(problem), noise)
    refit = Judged(fit(model, model.coordinates()))
    found = at_full_rate(Selection(refit, refit, refit, ()), problem, refit.fitted.model.noise)
    return found, Outcome.of(problem, noise, found)


def test_what_the_thermometers_say_is_believed_where_nothing_speaks_against_it(tmp_path: Path) -> None:
    found, outcome = _found(tmp_path / "right", 0.0)
    assert found.final.fitted.model.problem.thermometer == 0.0  # type: ignore[attr-defined]
    # the power of 3000 samples of noise scatters by 2.6 %: four times that; parameters of 9000 samples add a thousandth
    assert outcome.errors["corrected"].validate == pytest.approx(outcome.floors["validate"], rel=0.1)


def test_thermometers_that_are_wrong_are_not_believed(tmp_path: Path) -> None:
    found, outcome = _found(tmp_path / "wrong", 0.3)
    assert found.final.fitted.model.problem.thermometer == 0.2  # type: ignore[attr-defined]
