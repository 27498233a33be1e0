"""The foundry: its units are those that edesign reads, its floors those of its noise, its first campaigns stay."""

from __future__ import annotations

import numpy as np
import pytest
import yaml

from blind.laboratories import CATEGORIES
from blind.laboratories.foundry.generate import ROUND, SHARES, plan
from blind.laboratories.foundry.laws import ALL, declare, draw_law, si, yaml_parameters
from blind.laboratories.foundry.noise import measured
from edesign.damper.laws import LAWS
from edesign.damper.parameters import read_parameters


@pytest.mark.parametrize("law", ALL)
def test_edesign_reads_the_parameters_of_the_truth(law: str) -> None:
    rng = np.random.default_rng(7)
    declared = declare(law, draw_law(law, rng, 120.0, 30.0, 4.0), rng, 120.0)
    written = yaml.safe_load("parameters:\n" + yaml_parameters(law, declared))["parameters"]
    read, reported = read_parameters(LAWS[law], written), si(law, declared)
    # six digits are written; those of an exponent make c of m and s another by 1e-6 ln(1000)
    assert {name: read[name] for name in reported} == pytest.approx(reported, rel=2e-5)


@pytest.mark.parametrize(("law", "of_displacement"), [("friction", True), ("zener", False)])
def test_floors_are_those_of_the_noise(law: str, of_displacement: bool) -> None:
    """Along a straight line of slope k the noise of the displacement is k times itself as a force."""
    k, su, sf = 2.0, 0.01, 0.05
    u = np.linspace(-100.0, 100.0, 2001)  # steps of 0.1 mm, ten times the noise
    noise = {"F": sf, "U": su, "qF": 1e-6, "qU": 1e-6}
    tests = [{"cut": 0.0, "use": "validate"}, {"cut": 0.0, "use": "fit"}]
    result = [(np.arange(u.size) * 0.01, u, k * u)] * 2
    records, force, displacement = measured(np.random.default_rng(3), law, tests, result, noise, 100.0)
    power = k**2 * np.mean(u**2)
    # a variance of 2001 samples has a standard error of 3 %, the mean slope of the ends misses two of them
    assert force == pytest.approx(sf**2 / power, rel=0.1)
    assert displacement == pytest.approx(k**2 * su**2 / power if of_displacement else 0.0, rel=2e-3)
    assert np.std(records[1][1] - u) == pytest.approx(su, rel=0.1)


def test_the_first_campaigns_are_the_same_however_many() -> None:
    many = plan(5, 3 * ROUND)
    assert plan(5, 7) == many[:7] and plan(6, 7) != many[:7]
    assert {category for category, _, _ in many} <= set(CATEGORIES)
    kinds = [category.split("_")[0] for category, _, _ in many]
    assert {kind: kinds.count(kind) for kind in SHARES} == {"one": 30, "two": 15, "clean": 9, "unlisted": 6}
    for category, law, names in many:
        assert len(names) == {"one": 1, "two": 2, "clean": 0, "unlisted": 1}[category.split("_")[0]]
        assert category == "unlisted" or category.endswith("F") == (law in ("kelvin_voigt", "mgmm"))
