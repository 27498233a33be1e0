"""Blind campaigns: drawn from a seed, written in the form edesign reads, the truth outside of the folder."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import yaml

from blind import law
from blind.campaign import LARGEST, SMALLEST, SMALLEST_OF_TWO, Campaign, make
from blind.effects import EFFECTS
from blind.generate import generate
from blind.plan import KINDS, UNLISTED, Planned, plan
from blind.programme import programme
from blind.refit import left_after_refit
from blind.size import nrms
from blind.write import campaign_file, truth_path, write
from edesign.damper.laws import law as edesign_law
from edesign.damper.parameters import read_parameters
from edesign.damper.testing.campaign import load_campaign


@pytest.fixture(scope="module")
def one() -> Campaign:
    return make(Planned(3, "one", (("friction", 1),)), seed=24)


def test_campaign_is_the_seeds_alone(one: Campaign) -> None:
    again, other = make(one.planned, 24), make(one.planned, 25)
    assert all(np.array_equal(a, b) for a, b in zip(one.force, again.force, strict=True))
    assert all(np.array_equal(a, b) for a, b in zip(one.displacement, again.displacement, strict=True))
    assert one.true == again.true and one.hidden[0].alone == again.hidden[0].alone
    assert one.tests[0].title != other.tests[0].title or one.true != other.true


def test_shares_and_floors(one: Campaign) -> None:
    """Sizes in their range; the floor is the noise that was added, 0.1 to 1 % of the root mean square."""
    assert SMALLEST <= one.hidden[0].alone <= 1.03 * LARGEST
    assert one.joint == pytest.approx(one.hidden[0].alone, rel=1e-3)
    assert 1e-7 < one.floor < 1e-3
    assert one.floor_with_law >= 0.5 * one.floor
    two = make(Planned(7, "two", (("lag", 1), ("one_sided", 0))), seed=24)
    assert [hidden.effect.name for hidden in two.hidden] == ["lag", "one_sided"]
    assert all(hidden.alone >= 0.97 * SMALLEST_OF_TWO for hidden in two.hidden)
    clean = make(Planned(4, "clean"), seed=24)
    assert clean.joint == 0.0 and clean.hidden == () and clean.after_refit is None


def test_edesign_reads_what_is_written(one: Campaign, tmp_path: Path) -> None:
    folder = tmp_path / "c003"
    read = load_campaign(write(one, folder))
    assert [test.use for test in read.tests] == [test.use for test in one.tests]
    for i, test in enumerate(read.tests):
        assert test.force is not None
        assert test.time == pytest.approx(one.time[i], rel=1e-8)
        assert 1e3 * test.displacement == pytest.approx(one.displacement[i], rel=1e-8)
        assert 1e-3 * test.force == pytest.approx(one.force[i], rel=1e-8)
        assert test.temperature_C == one.tests[i].temperature
    assert read.specimen.layers == 2 and read.specimen.layer_area == pytest.approx(0.0414)
    assert not list(folder.glob("*truth*"))
    truth = json.loads(truth_path(folder).read_text())
    assert truth["effects"][0]["name"] == "friction"
    assert truth["noise_floor"] == one.floor


def test_the_floor_is_the_error_of_the_true_law_fed_with_what_is_recorded() -> None:
    candidates = (make(Planned(number, "clean"), seed=2) for number in range(1, 30))
    one = next(c for c in candidates if c.temperature is not None and c.noise.displacement == 0.0)
    assert one.temperature is not None
    error = power = 0.0
    for i, test in enumerate(one.tests):
        if test.use == "validate":
            at = law.at_temperature(one.true, float(np.mean(one.temperature[i])))
            predicted = law.force(at, one.displacement[i], test.h * test.every)
            error += float(np.sum((one.force[i] - predicted) ** 2))
            power += float(np.sum(one.force[i] ** 2))
    # the generator's law has a step of 0.5 ms or less, this one that of the record: 3e-4 of the force, squared
    assert one.floor_with_law == pytest.approx(error / power, rel=0.05, abs=3e-7)
    assert one.floor_with_law > 1.2 * one.floor  # the thermometer of this one is off by enough


def test_tests_that_cannot_show_an_effect_are_drawn_again() -> None:
    # the first draw of this one has no size at which the cycles soften it enough
    planned = next(p for p in plan(35, seed=8) if p.number == 35)
    assert planned.effects[0][0] == "mullins"
    made = make(planned, seed=8)
    assert 0.9 * SMALLEST <= made.hidden[0].alone <= 1.1 * LARGEST  # as the search for a size is exact


def test_declared_parameters_keep_their_units() -> None:
    """A mapping is read as the numbers in kN, mm and s that were drawn; with the name, as Table 4.2."""
    seen = set()
    for number in range(1, 9):
        campaign = make(Planned(number, "clean"), seed=2)
        if (campaign.declared is None) in seen:
            continue
        seen.add(campaign.declared is None)
        given = yaml.safe_load(campaign_file(campaign))["law"]["parameters"]
        values = read_parameters(edesign_law("mgmm"), given)
        right = campaign.declared or law.TABLE_4_2
        assert values["k_a"] == pytest.approx(1e6 * right["k_a"])
        assert values["c_b"] == pytest.approx(1e6 * right["c_b"])
        assert values["v_ref"] == pytest.approx(1e-3 * right["v_ref"])
        assert values["c_NL"] == pytest.approx(1e3 * right["c_NL"] * 1e3 ** right["alpha"])
        spread = np.array([campaign.true[name] / right[name] - 1.0 for name in right])
        assert np.abs(spread).max() <= 0.15
    assert seen == {True, False}


def test_programmes_hold_what_a_calibration_needs() -> None:
    for seed in range(8):
        tests = programme(np.random.default_rng(seed), temperatures=seed % 2 == 0)
        uses = [test.use for test in tests]
        assert 6 <= len(tests) <= 14 and uses.count("fit") >= 4 and uses.count("validate") >= 2
        for test in tests:
            assert 12.0 < test.t[-1] < 21.0 and 200.0 <= 1.0 / (test.h * test.every) <= 1000.0
            assert np.abs(test.x).max() <= 0.5 * law.THICKNESS_MM * 1.001
            assert np.abs(test.v).max() < 400.0
            assert test.x[0] == 0.0 and abs(test.x[-1]) < 1e-6
        if seed % 2 == 0:
            assert len({test.temperature for test in tests if test.use == "fit"}) >= 3


def test_refit_takes_what_is_another_law_and_leaves_what_is_not() -> None:
    """Forces 10 % larger are other moduli: next to nothing is left. A constant force is no law's: all of it is."""
    tests = programme(np.random.default_rng(1), temperatures=False)
    x = [test.x for test in tests]
    force = [law.force(law.TABLE_4_2, test.x, test.h) for test in tests]
    assert left_after_refit(law.TABLE_4_2, tests, x, [1.1 * f for f in force]) < 1e-5
    offset = [f + 2.0 for f in force]
    at = [i for i, test in enumerate(tests) if test.use == "validate"]
    all_of_it = nrms([np.full(tests[i].n, 2.0) for i in at], [offset[i] for i in at])
    assert left_after_refit(law.TABLE_4_2, tests, x, offset) == pytest.approx(all_of_it, rel=0.1)


def test_plan_is_the_same_for_more_campaigns() -> None:
    few, many = plan(23, 5), plan(92, 5)
    assert few == many[:23]
    assert [sum(p.kind == kind for p in many) for kind in KINDS] == [12, 60, 12, 8]
    ones = [p.effects[0] for p in many if p.kind == "one"]
    assert all(sum(name == other for other, _ in ones) == 3 for name in EFFECTS)
    assert len(set(ones)) == 60  # three forms of each
    assert all(len(p.effects) == 2 and p.effects[0][0] != p.effects[1][0] for p in many if p.kind == "two")
    assert all(p.effects[0][0] in UNLISTED for p in many if p.kind == "unlisted")


def test_plan_of_some_only() -> None:
    some = plan(10, 5, ["one", "two"], ["lag", "play"])
    assert {p.kind for p in some} <= {"one", "two"}
    assert all({name for name, _ in p.effects} & {"lag", "play"} for p in some)


def test_generation_is_not_repeated(tmp_path: Path) -> None:
    clean = Planned(1, "clean")
    place = generate(clean, 3, tmp_path)
    before = (place / "campaign.yaml").stat().st_mtime_ns
    assert generate(clean, 3, tmp_path) == place
    assert (place / "campaign.yaml").stat().st_mtime_ns == before
    (tmp_path / "c001.outcome.json").write_text("{}")
    generate(clean, 4, tmp_path)  # another one: what was run is void
    assert (place / "campaign.yaml").stat().st_mtime_ns != before
    assert not (tmp_path / "c001.outcome.json").exists()
