"""Softening with the path is wear, or Mullins softening without recovery: the search prefers neither."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from damper_problems import problem

from edesign.calibration.results.fit import unbounded
from edesign.calibration.results.models import Posterior
from edesign.calibration.search.search import Search
from edesign.calibration.search.settings import SETTINGS

NOISE = 10.0  # N, that of the channels of `problem`


def test_wear_with_the_path_and_softening_without_recovery_are_confounded():
    # F (1 - d (1 - exp(-s/s0))) is (1 - d) F (1 + d/(1 - d) exp(-s/s0)): the law takes the factor
    clean = problem("kelvin_voigt", 6, threads=1)
    (worn,) = (effect for effect in clean.effects if effect.label == "degradation.path")
    true = np.array([[*clean.start, 0.3, 0.3 * clean.typical.path, 1.0]])
    (forces,) = clean.model([worn], ("fit", "validate")).forces(true)
    random = np.random.default_rng(3)
    tests = zip(clean.experiments, forces, strict=True)
    noisy = [replace(one, force=force + NOISE * random.standard_normal(force.size)) for one, force in tests]
    found = Search(clean.with_experiments(noisy), SETTINGS).run()
    posterior = Posterior.of(unbounded(found.best.problem, SETTINGS), found, found.best)
    (name,) = found.best.names
    (other,) = {"degradation", "mullins"} - {name}
    # equal predictions: the odds differ by the priors of the two, which say little beside 3 000 samples
    # only one of the two leaves the law as it is declared, which speaks for that one
    assert 0.1 < posterior.indistinguishable_from(name)[other] <= 0.55
