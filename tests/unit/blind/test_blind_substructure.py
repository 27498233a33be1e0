"""Blind campaigns of substructure tests: rig and loop against closed forms, and what the judge makes of a result."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

from blind import law
from blind.campaign import LARGEST, SMALLEST, SMALLEST_OF_TWO
from blind.laboratory import observe, predicted
from blind.plan import Planned
from blind.refit import FREE
from blind.size import nrms
from blind.substructure.campaign import EVERY, FEWEST, STEP, make, truth_of, write_new
from blind.substructure.judge import CLOSE, judge, lag_of, summary
from blind.substructure.loop import Damper, RanAway, Storey, run
from blind.substructure.plan import RIGS, plan
from blind.substructure.rig import FADES, LONGEST, REACH, Follower, Rig, draw_rig
from blind.write import truth_path
from edesign.damper.testing.campaign import load_campaign

STIFF = Storey(mass=0.143, damping=0.072, stiffness=22.6)
"""The storey of thesis 6.2.5, 2 % damped: kN, mm, s."""


def followed(rig: Rig, target: np.ndarray, h: float = STEP) -> np.ndarray:
    follower = Follower(rig, h, 0.0)
    return np.array([0.0, *(follower.step(u) for u in target[1:].tolist())])


def test_the_damper_step_by_step_is_the_law() -> None:
    t = STEP * np.arange(4001)
    u = 5.0 * np.sin(2.0 * np.pi * 1.5 * t) * np.minimum(t, 1.0)
    damper = Damper(law.TABLE_4_2, STEP)
    np.testing.assert_allclose([0.0, *map(damper.step, u[1:].tolist())], law.force(law.TABLE_4_2, u, STEP), atol=1e-9)


def test_a_pure_delay_is_the_target_so_much_later() -> None:
    """Linear between steps; longer with the amplitude, and with time."""
    t = STEP * np.arange(4001)
    ramp = 3.0 * t
    np.testing.assert_allclose(followed(Rig(delay=0.0123), ramp), 3.0 * np.maximum(t - 0.0123, 0.0), atol=1e-12)
    np.testing.assert_allclose(followed(Rig(), ramp), ramp, atol=1e-12)
    np.testing.assert_allclose(followed(Rig(gain=0.02), ramp), ramp / 1.02, atol=1e-12)
    grown = followed(Rig(delay=0.01, growth=0.5, drift=1e-3), ramp)
    late = 0.01 * (1.0 + 0.5 * ramp / 6.0) + 1e-3 * t
    np.testing.assert_allclose(grown[100:], (ramp - 3.0 * late)[100:], atol=1e-12)


def test_a_second_order_settles_to_its_transfer_function() -> None:
    """x = |H| sin(w t + arg H), H = e^(-tau s)/(1 + 2 zeta s/w0 + s2/w0^2), to the line between steps of 0.5 ms."""
    rig = Rig(delay=0.0042, frequency=21.4, damping=0.4)
    t, w, w0 = STEP * np.arange(4001), 2.0 * np.pi * 5.0, 2.0 * np.pi * 21.4
    response = np.exp(-1j * w * rig.delay) / (1.0 + 2j * rig.damping * w / w0 - (w / w0) ** 2)
    exact = np.imag(response * np.exp(1j * w * t))
    np.testing.assert_allclose(followed(rig, np.sin(w * t))[t > 0.5], exact[t > 0.5], atol=(w * STEP) ** 2 / 4.0)
    assert rig.of_order == pytest.approx(0.4 / (np.pi * 21.4))


def test_a_storey_without_damper_swings_at_its_frequency() -> None:
    """A short push: free vibration of w = sqrt(k/m); the explicit Newmark method is second order in the step."""
    ground = np.zeros(4001)
    ground[:20] = 1e4
    nothing = {**law.TABLE_4_2, **dict.fromkeys(("k0", "c_NL", "k_a", "k_b", "c_a", "c_b", "c1"), 1e-12)}
    free = run(Storey(0.143, 0.0, 22.6), nothing, Follower(Rig(), STEP, 0.0), ground, STEP, 1e3)
    up = np.flatnonzero((free[:-1] < 0.0) & (free[1:] >= 0.0))
    crossings = STEP * (up + free[up] / (free[up] - free[up + 1]))
    assert np.mean(np.diff(crossings)) == pytest.approx(2.0 * np.pi * math.sqrt(0.143 / 22.6), rel=1e-4)


def test_a_loop_that_is_too_late_runs_away() -> None:
    """The critical delay of the thesis' storey is 32 to 40 ms (docs/how_to/rts.md); 20 ms stay, 60 ms go."""
    ground = np.zeros(8001)
    ground[:200] = 300.0
    kept = run(STIFF, law.TABLE_4_2, Follower(Rig(delay=0.020), STEP, 0.0), ground, STEP, 10.0)
    assert np.max(np.abs(kept[-2000:])) < 0.5 * np.max(np.abs(kept))
    with pytest.raises(RanAway):
        run(STIFF, law.TABLE_4_2, Follower(Rig(delay=0.060), STEP, 0.0), ground, STEP, 1.0)


def test_rigs_are_late_by_20_ms_at_most() -> None:
    rng = np.random.default_rng(1)
    for kind in RIGS:
        for _ in range(20):
            rig = draw_rig(rng, kind, 40.0)
            assert 0.0 <= rig.delay * (1.0 + rig.growth) + rig.of_order + rig.force_delay <= LONGEST + 1e-9
            assert (kind == "none") == (rig == Rig())


def test_a_campaign_is_that_of_its_seed_and_is_read(tmp_path: Path) -> None:
    planned = Planned(2, "second_order", (("friction", 0),))
    one, again = make(planned, 3), make(planned, 3)
    assert one.rig == again.rig and one.lag == again.lag
    assert all(np.array_equal(a, b) for a, b in zip(one.campaign.force, again.campaign.force, strict=True))
    assert one.lag == pytest.approx(one.rig.delay + one.rig.of_order, abs=1e-12)
    write_new(planned, 3, tmp_path / "c002")
    read = load_campaign(tmp_path / "c002" / "campaign.yaml")
    assert len(read.used_for("fit")) >= 2 and len(read.used_for("validate")) >= 1
    assert all(test.start == "at_rest" and test.displacement[0] == 0.0 for test in read.tests)
    text = yaml.safe_load((tmp_path / "c002" / "campaign.yaml").read_text(encoding="ascii"))
    assert "rig" not in json.dumps(text) and "late" not in json.dumps(text)
    truth = json.loads(truth_path(tmp_path / "c002").read_text(encoding="ascii"))
    assert truth["rig"]["frequency"] == one.rig.frequency and truth["lag"] == one.lag


def test_a_delay_that_grows_with_the_amplitude_is_judged_by_its_mean() -> None:
    """A result that is the truth has the truth's lag, whatever it is called; memories of the grid are interpolated."""
    made = make(Planned(3, "with_amplitude"), 1)
    per_amplitude = made.rig.delay * made.rig.growth / (1e-3 * REACH)
    exact = found(
        "with_amplitude", lag=(made.rig.delay, "s"), per_amplitude=(per_amplitude, "s/m"), memory=(FADES, "s")
    )
    # a straight line between memories that differ by 10^(1/4)
    assert lag_of(exact, json.loads(json.dumps(truth_of(made)))) == pytest.approx(made.lag, abs=2e-5)


@pytest.mark.parametrize(("name", "form"), [("hardening", 0), ("mullins", 0)])
def test_a_hidden_effect_shows_in_tests_to_fit_and_to_validate(name: str, form: int) -> None:
    """0.3 to 10 % of the force in all tests, 0.1 % in each kind; one that acts between tests has three to fit to."""
    made = make(Planned(53, "constant", ((name, form),)), 1)
    tests, effects = made.campaign.tests, [hidden.effect for hidden in made.campaign.hidden]
    with_it, alone = observe(made.campaign.true, tests, effects)[1], predicted(made.campaign.true, tests)
    for use in ("fit", "validate", ""):
        at = [i for i, test in enumerate(tests) if use in (test.use, "")]
        shown = nrms([(with_it[i] - alone[i])[::EVERY] for i in at], [with_it[i][::EVERY] for i in at])
        assert shown > SMALLEST and (use or shown == pytest.approx(made.campaign.joint))
    assert SMALLEST_OF_TWO * 0.9 < made.campaign.joint < LARGEST * 1.1
    assert not effects[0].memory or sum(test.use == "fit" for test in tests) >= FEWEST


def test_a_rig_that_drifts_has_three_tests_to_fit_to() -> None:
    tests = make(Planned(4, "drifting"), 1).campaign.tests  # whose first draw has two
    assert sum(test.use == "fit" for test in tests) >= FEWEST


@pytest.mark.parametrize("number", [36, 54])  # the shortest delay of seed 1, and one beside an effect
def test_the_tests_to_fit_to_give_the_delay(number: int) -> None:
    """The least standard deviation that any estimate can have (Cramer and Rao), beside a law and the size of an effect
    that are free, is below half of what the judge calls close.
    """
    made = make(plan(number, 1)[number - 1], 1)
    tests, true = made.campaign.tests, made.campaign.true
    effects = [hidden.effect for hidden in made.campaign.hidden]

    def forces(p: law.Parameters) -> np.ndarray:
        pairs = zip(tests, observe(p, tests, effects)[1], strict=True)
        return np.concatenate([force[::EVERY] for test, force in pairs if test.use == "fit"])

    force, moved = forces(true), 1e-3
    slopes = [(forces({**true, name: (1.0 + moved) * true[name]}) - force) / moved for name in FREE]
    for effect in effects:
        effect.size *= 1.0 + moved
        slopes.append((forces(true) - force) / moved)
        effect.size /= 1.0 + moved
    late = np.gradient(force, EVERY * STEP)  # dF/dt: what a delay of 1 s adds, with the other sign
    known = np.array(slopes).T / np.linalg.norm(slopes, axis=1)
    left = late - known @ np.linalg.lstsq(known, late, rcond=None)[0]
    noise = made.campaign.noise.force * np.sqrt(np.mean(force**2))
    assert noise / np.linalg.norm(left) < 0.5 * CLOSE


def test_the_plan_is_the_same_however_long() -> None:
    assert plan(40, 1)[:20] == plan(20, 1) and plan(20, 2) != plan(20, 1)
    assert {each.kind for each in plan(20, 1)} == set(RIGS)
    assert sum(each.kind == "none" for each in plan(100, 1)) == 20
    assert sum(bool(each.effects) for each in plan(100, 1)) == 50


TRUTH = {
    "number": 1,
    "kind": "constant",
    "effects": [],
    "lag": 0.01,
    "weights": [1.0, 0.0, 3.0],
    "times": [2.0, 0, 4.0],
    "memories": [0.1, 10.0],
    "amplitudes": [[0.002, 0.004], [0.0, 0.0], [0.003, 0.005]],
}


def found(form: str, **values: tuple[float, str]) -> dict[str, Any]:
    parameters = {name.replace("__", "."): {"value": value, "unit": unit} for name, (value, unit) in values.items()}
    return {"name": "lag", "kind": "instrument", "form": form, "parameters": parameters}


def test_delays_of_slow_motions_are_compared() -> None:
    assert lag_of(found("delay", lag=(10.2, "ms")), TRUTH) == pytest.approx(0.0102)
    assert lag_of(found("actuator", lag=(0.0102, "s"), f=(20.0, "Hz"), zeta=(0.5, "")), TRUTH) == pytest.approx(0.0102)
    assert lag_of(found("second_order", f=(20.0, "Hz"), zeta=(0.5, "")), TRUTH) == pytest.approx(0.5 / (20.0 * np.pi))
    both = found(
        "filter + displacement_filter", time_constant=(3.0, "ms"), displacement_filter__time_constant=(1.0, "ms")
    )
    assert lag_of(both, TRUTH) == pytest.approx(0.002)
    growing = found("growing", lag=(0.008, "s"), grown=(0.002, "s"), skew=(1e-4, ""))
    assert lag_of(growing, TRUTH) == pytest.approx(0.008 + (0.0 + 2e-4 + 3.0 * (0.002 + 4e-4)) / 4.0)
    larger = found("with_amplitude", lag=(0.008, "s"), per_amplitude=(0.5, "s/m"), memory=(1.0, "s"))
    assert lag_of(larger, TRUTH) == pytest.approx(0.008 + 0.5 * (0.003 + 3.0 * 0.004) / 4.0)
    both = {**found("growing_with_amplitude"), "parameters": {**larger["parameters"], **growing["parameters"]}}
    parts = 0.0 + 2e-4 + 3.0 * (0.002 + 4e-4) + 0.5 * (0.003 + 3.0 * 0.004)
    assert lag_of(both, TRUTH) == pytest.approx(0.008 + parts / 4.0)


def test_what_is_missed_is_reported() -> None:
    done = {"seconds": 3.0, "failure": None}
    good = judge(TRUTH, {"effects": [found("delay", lag=(10.2, "ms"))], "verdict": "explained"}, done)
    far = judge(TRUTH, {"effects": [found("delay", lag=(10.4, "ms"))], "verdict": "explained"}, done)
    alarm = judge({**TRUTH, "kind": "none", "lag": 0.0}, {"effects": [found("delay", lag=(1.0, "ms"))]}, done)
    failed = judge(TRUTH, None, {"seconds": 1.0, "failure": "exit 2"})
    text = summary([good, far, alarm, failed])
    assert (good["named"], good["close"], far["close"], alarm["named"]) == (True, True, False, True)
    assert "campaigns, failures of the program      4, 1" in text
    assert "constant, 10.00 ms: lag delay, 10.40 ms" in text and "none, 0.00 ms: lag delay, 1.00 ms" in text
    assert "constant, 10.00 ms: lag delay, 10.20 ms" not in text and "exit 2" in text
