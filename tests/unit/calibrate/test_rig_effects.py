"""Effects of the rig against loops over samples, textbook recursions and closed forms."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline

from edesign.calibrate.dampers.effect import Form, Series
from edesign.calibrate.dampers.effects import play
from edesign.calibrate.dampers.effects.degradation import Path as Travelled
from edesign.calibrate.dampers.effects.friction import Loaded, LuGre, Presliding, Stribeck, Tanh
from edesign.calibrate.dampers.effects.hardening import Exponential
from edesign.calibrate.dampers.effects.one_sided import ContactPositive
from edesign.calibrate.dampers.effects.payne import Whole
from edesign.calibrate.dampers.effects.play import Backlash, Gap, GapAside, GapSeated, follow
from edesign.calibrate.dampers.effects.relaxation_branch import Maxwell
from edesign.calibrate.dampers.effects.series_flexibility import CLEARANCE, CLOSES, Closing, Damped, Linear, Power
from edesign.calibrate.dampers.effects.static_offset import ConstantForce, PreShear, Tared
from edesign.calibrate.dampers.left import Left
from edesign.calibrate.dampers.library import candidate_of, candidates
from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial
from edesign.calibrate.dampers.turning_points import with_turning_points
from edesign.calibrate.evidence import Judged
from edesign.calibrate.fit import Model, fit
from edesign.calibrate.problem import PredictionError
from edesign.calibrate.search.effect_forms import EffectForms
from edesign.calibrate.search.screening import screen
from edesign.calibrate.search.workbench import Workbench
from edesign.core.damper import CoreDamper
from edesign.damper.laws import law

NO_FORCE = np.zeros(1)
AMPLITUDE = 0.01  # m
FORMS = (
    Tanh,
    Presliding,
    Stribeck,
    LuGre,
    Loaded,
    Gap,
    GapAside,
    GapSeated,
    Backlash,
    Linear,
    Damped,
    Closing,
    PreShear,
    ConstantForce,
)


def _sine(rate: float, cycles: float = 4.0, frequency: float = 1.0, phase: float = 0.0) -> Motion:
    time = np.arange(int(cycles / frequency * rate) + 1) / rate
    w = 2.0 * np.pi * frequency
    angle = w * time + phase
    u = AMPLITUDE * np.sin(angle)
    return Motion(time, u, AMPLITUDE * w * np.cos(angle), -(w**2) * u)


def _trial(motion: Motion, name: str = "a", order: int = 0) -> Trial:
    return Trial(name, "fit", order, motion, 1e7 * motion.displacement, np.full(motion.time.size, 20.0))


def _irregular() -> Motion:
    """Two sines that have many unequal reversals, none of them on a sample but by chance."""
    time = np.arange(2001) / 200.0
    w1, w2 = 2.0 * np.pi * 0.73, 2.0 * np.pi * 1.91
    u = 0.006 * np.sin(w1 * time) + 0.004 * np.sin(w2 * time + 0.4)
    v = 0.006 * w1 * np.cos(w1 * time) + 0.004 * w2 * np.cos(w2 * time + 0.4)
    a = -0.006 * w1**2 * np.sin(w1 * time) - 0.004 * w2**2 * np.sin(w2 * time + 0.4)
    return Motion(time, u, v, a)


@pytest.mark.parametrize("kind", FORMS)
def test_starts_are_complete_and_inside_the_bounds(kind: type[Form]) -> None:
    sizes = Sizes.of([_trial(_sine(100.0))])
    unknowns = kind().unknowns(sizes)
    assert kind().starts(sizes)
    for start in kind().starts(sizes):
        assert len(start) == len(unknowns)
        for value, unknown in zip(start, unknowns, strict=True):
            assert unknown.lower < value < unknown.upper
            assert unknown.value(unknown.coordinate(value)) == pytest.approx(value, rel=1e-12)


def test_turning_points_are_those_of_a_sine() -> None:
    # no sample at an extreme; the cubic through samples of 30 in a cycle misses it by (w h)^4 / 384 = 5e-6
    motion = _sine(30.0, phase=0.02)
    points, index = with_turning_points(motion)
    np.testing.assert_array_equal(points[index], motion.displacement)
    turned = np.delete(points, index)
    assert turned.size == 8
    np.testing.assert_allclose(np.abs(turned), AMPLITUDE, rtol=1e-5)
    assert np.max(np.abs(motion.displacement)) < (1.0 - 1e-3) * AMPLITUDE


def test_a_motion_without_reversal_has_no_turning_points() -> None:
    time = np.linspace(0.0, 1.0, 11)
    motion = Motion(time, 0.01 * time, np.full(11, 0.01), np.zeros(11))
    points, index = with_turning_points(motion)
    np.testing.assert_array_equal(points, motion.displacement)
    np.testing.assert_array_equal(index, np.arange(11))


def test_tanh_friction_is_coulomb_away_from_rest_and_dissipates_four_times_force_and_amplitude() -> None:
    motion = _sine(5000.0, cycles=1.0)
    force = Tanh().carriage({"F_c": 300.0, "v0": 1e-4 * 2 * np.pi * AMPLITUDE}, _trial(motion), motion, NO_FORCE)
    moving = np.abs(motion.velocity) > 0.01 * np.max(np.abs(motion.velocity))
    np.testing.assert_allclose(force[moving], 300.0 * np.sign(motion.velocity[moving]), rtol=1e-12)
    work = np.trapezoid(force * motion.velocity, motion.time)
    assert work == pytest.approx(4.0 * 300.0 * AMPLITUDE, rel=1e-4)


def test_stribeck_friction_breaks_away_at_the_larger_force() -> None:
    velocity = np.array([-1.0, -0.003, 0.0, 0.003, 1.0])
    motion = Motion(np.arange(5.0), np.zeros(5), velocity, np.zeros(5))
    force = Stribeck().carriage({"F_c": 100.0, "s": 0.5, "v_s": 0.01}, _trial(motion), motion, NO_FORCE)
    near = 100.0 * (1.0 + 0.5 * np.exp(-0.09)) * np.tanh(3.0)
    np.testing.assert_allclose(force, [-100.0, -near, 0.0, near, 100.0], rtol=1e-12)


def test_presliding_follows_its_differential_equation() -> None:
    # z' = v - |v| z / x0 by the midpoint rule on steps a hundred times finer: errors of order (w h)^2 = 1e-6
    coarse, stride = _sine(100.0, phase=0.2), 100
    fine = _sine(100.0 * stride, phase=0.2)
    x0, h = 0.002, 1.0 / (100.0 * stride)
    middle = AMPLITUDE * 2.0 * np.pi * np.cos(2.0 * np.pi * (fine.time[:-1] + 0.5 * h) + 0.2)
    z, found = 0.0, [0.0]
    for v in middle.tolist():
        half = z + 0.5 * h * (v - abs(v) * z / x0)
        z += h * (v - abs(v) * half / x0)
        found.append(z)
    force = Presliding().carriage({"F_c": 300.0, "x0": x0}, _trial(coarse), coarse, NO_FORCE)
    np.testing.assert_allclose(force, 300.0 * np.array(found)[::stride] / x0, atol=300.0 * 1e-4)


def test_presliding_dissipates_four_times_force_and_amplitude_when_it_slides_at_once() -> None:
    # steady loop between +-A: F = F_c (1 - (1 + q) exp(-way / x0)), q = tanh(A / x0); closed form of its area
    motion = _sine(2000.0, cycles=3.0)
    for x0, to_the_limit in ((1e-3 * AMPLITUDE, 1.1e-3), (0.3 * AMPLITUDE, 1.0)):
        force = Presliding().carriage({"F_c": 300.0, "x0": x0}, _trial(motion), motion, NO_FORCE)
        last = motion.time >= 2.0 - 1e-9
        work = np.trapezoid(force[last], motion.displacement[last])
        q = np.tanh(AMPLITUDE / x0)
        closed = 2.0 * 300.0 * (2.0 * AMPLITUDE - (1.0 + q) * x0 * (1.0 - np.exp(-2.0 * AMPLITUDE / x0)))
        # the trapezoidal rule over the reversal, whose x0 is passed in a few samples
        assert work == pytest.approx(closed, rel=1e-3)
        assert work == pytest.approx(4.0 * 300.0 * AMPLITUDE, rel=to_the_limit + 1e-3)


def test_presliding_does_not_know_speed() -> None:
    slow, fast = _sine(100.0, frequency=1.0), _sine(1000.0, frequency=10.0)
    p = {"F_c": 300.0, "x0": 0.001}
    forces = [Presliding().carriage(p, _trial(m), m, NO_FORCE) for m in (slow, fast)]
    np.testing.assert_allclose(forces[0], forces[1], atol=300.0 * 1e-9)


def test_lugre_without_a_rise_at_rest_is_presliding() -> None:
    motion = _irregular()
    p = {"F_c": 300.0, "x0": 0.001, "s": 0.0, "v_s": 0.01}
    forces = [form.carriage(p, _trial(motion), motion, NO_FORCE) for form in (LuGre(), Presliding())]
    np.testing.assert_allclose(forces[0], forces[1], rtol=0.0, atol=300.0 * 1e-12)


@pytest.mark.parametrize("speed", [1e-4, 0.01, 0.02, 0.5])
def test_lugre_slides_by_the_curve_of_stribeck(speed: float) -> None:
    # z' = 0 at a constant velocity: F = F_c g(v)
    time = np.linspace(0.0, 0.01 / speed, 401)
    motion = Motion(time, -speed * time, np.full(401, -speed), np.zeros(401))
    force = LuGre().carriage({"F_c": 300.0, "x0": 1e-4, "s": 0.5, "v_s": 0.02}, _trial(motion), motion, NO_FORCE)
    curve = 1.0 + 0.5 * np.exp(-((speed / 0.02) ** 2))
    assert force[0] == 0.0 and force[-1] == pytest.approx(-300.0 * curve, rel=1e-12)  # exp(-way/x0) = e^-66 at most


def test_lugre_follows_its_differential_equation() -> None:
    # z' = v - |v| z / (x0 g(v)) by the midpoint rule on steps a hundred times finer: errors of order (w h)^2 = 1e-6;
    # the form takes the mean of g over a step of 1/200 s, which g crosses in 4: of order (w h v/v_s)^2 / 12 = 2e-3
    coarse, stride = _sine(200.0, phase=0.2), 100
    h, w, p = 1.0 / (200.0 * stride), 2.0 * np.pi, {"F_c": 300.0, "x0": 0.002, "s": 0.8, "v_s": 0.02}
    middle = AMPLITUDE * w * np.cos(w * h * (np.arange((coarse.time.size - 1) * stride) + 0.5) + 0.2)
    reach = p["x0"] * (1.0 + p["s"] * np.exp(-((middle / p["v_s"]) ** 2)))
    z, found = 0.0, [0.0]
    for v, own in zip(middle.tolist(), reach.tolist(), strict=True):
        half = z + 0.5 * h * (v - abs(v) * z / own)
        z += h * (v - abs(v) * half / own)
        found.append(z)
    force = LuGre().carriage(p, _trial(coarse), coarse, NO_FORCE)
    np.testing.assert_allclose(force, 300.0 * np.array(found)[::stride] / p["x0"], atol=300.0 * 2e-3)
    assert np.max(np.abs(force)) > 1.02 * 300.0  # the rise near rest is there


def test_loaded_guides_dissipate_a_share_of_the_force_besides_their_own() -> None:
    # a spring k: 4 F_c A, and mu times the way weighted by k |u|: 4 mu k A^2 / 2
    motion, k = _sine(5000.0, cycles=1.0), 1e7
    trial, p = _trial(motion), {"F_c": 300.0, "v0": 1e-4 * 2 * np.pi * AMPLITUDE, "mu": 0.1}
    friction = Loaded().carriage(p, trial, motion, trial.force)
    work = np.trapezoid((trial.force + friction) * motion.velocity, motion.time)
    assert work == pytest.approx(4.0 * 300.0 * AMPLITUDE + 2.0 * 0.1 * k * AMPLITUDE**2, rel=1e-4)
    # against the motion on both sides of zero, by the size of the force
    moving = np.abs(motion.velocity) > 0.01 * np.max(np.abs(motion.velocity))
    expected = (300.0 + 0.1 * np.abs(trial.force)) * np.sign(motion.velocity)
    np.testing.assert_allclose(friction[moving], expected[moving], atol=1e-9 * k * AMPLITUDE)
    own = Tanh().carriage(p, trial, motion, trial.force)
    np.testing.assert_array_equal(Loaded().carriage({**p, "mu": 0.0}, trial, motion, trial.force), own)


def test_follow_is_the_textbook_play_operator() -> None:
    # w_i = min(u_i + r, max(u_i - r, w_(i-1))), w before the first: 0 (Visintin 1994, Differential Models, III.2)
    u, play = np.random.default_rng(3).normal(size=500).cumsum(), 4.0
    w, found = 0.0, []
    for value in u:
        w = min(value + 0.5 * play, max(value - 0.5 * play, w))
        found.append(w)
    np.testing.assert_array_equal(follow(u, play), found)
    assert np.max(np.abs(u - found)) == 0.5 * play


@pytest.mark.parametrize(("aside", "lost"), [(1.0, 1.0), (0.0, 0.5), (-1.0, 0.0)])
def test_pins_aside_lose_the_clearance_one_way_and_nothing_the_other(aside: float, lost: float) -> None:
    # a spring k behind a rig K pulled out: no force up to the share of the clearance, then 1/(1/k + 1/K) in series
    time = np.arange(201) / 100.0
    motion = Motion(time, 0.004 * time, np.full(201, 0.004), np.zeros(201))
    trial, play, k, rig = _trial(motion), 2e-3, 1e6, 1e8
    problem = DamperProblem(law("kelvin_voigt"), {"k": k, "c": 0.0}, (trial,), Sizes.of((trial,)))
    candidate = candidate_of(GapAside(), problem.sizes, Left())
    assert candidate is not None
    (force,) = problem.predict(problem.declared, [(candidate, np.array([play, rig, aside]))], ("fit",))
    beyond = np.maximum(motion.displacement - lost * play, 0.0)
    np.testing.assert_allclose(force, beyond / (1.0 / k + 1.0 / rig), rtol=1e-6, atol=1e-6 * k * play)


def test_backlash_of_a_sine_is_cut_and_late() -> None:
    # after the first quarter: falls only when the crest is passed by the play; crests at A - play / 2
    motion, play = _sine(30.0, phase=0.1), 0.002
    own = Backlash().specimen({"play": play}, _trial(motion), motion)
    crest = AMPLITUDE - 0.5 * play
    after = motion.time > 0.25
    rests = (motion.displacement > AMPLITUDE - play + 1e-6) & after & (motion.velocity < 0.0)
    assert rests.sum() >= 8
    np.testing.assert_allclose(own.displacement[rests], crest, rtol=1e-5)
    still = rests & np.append(rests[1:], False)  # the last of them may begin to move
    assert still.sum() >= 4
    np.testing.assert_array_equal(own.velocity[still], 0.0)
    goes = (motion.velocity < 0.0) & (motion.displacement < AMPLITUDE - play - 1e-6) & after
    np.testing.assert_allclose(own.displacement[goes], motion.displacement[goes] + 0.5 * play, rtol=1e-12)
    np.testing.assert_array_equal(own.velocity[goes], motion.velocity[goes])


@pytest.mark.parametrize("share", [0.05, 0.2, 0.41, 0.6, 0.77, 0.95])
def test_what_follows_through_backlash_is_never_faster_than_what_it_follows(share: float) -> None:
    # also between samples, wherever in a step the clearance closes: the law remembers its largest velocity
    motion = _sine(30.0, phase=0.1)
    play = share * AMPLITUDE
    own = Backlash().specimen({"play": play}, _trial(motion), motion)
    curve = CubicHermiteSpline(own.time, own.displacement, own.velocity)
    between = np.linspace(own.time[0], own.time[-1], 20 * own.time.size)
    # a cubic through 30 samples of a sine and their slopes is off by sqrt(3)/216 (2 pi/30)^3 = 7e-5 of its velocity
    assert np.max(np.abs(curve(between, 1))) < (1.0 + 1e-4) * 2.0 * np.pi * AMPLITUDE


def test_backlash_does_not_depend_on_the_rate_of_samples() -> None:
    # 24 samples in a cycle of the faster sine: extremes of the cubics miss the true ones by 1e-5 of the play
    fine = _irregular()
    play, stride = 0.0015, 4
    coarse = fine.thinned(stride)
    exact = Backlash().specimen({"play": play}, _trial(fine), fine).displacement[::stride]
    found = Backlash().specimen({"play": play}, _trial(coarse), coarse).displacement
    np.testing.assert_allclose(found, exact, atol=1e-3 * play)


def test_no_amplitude_leaves_everything_unchanged() -> None:
    motion = _irregular()
    trial = _trial(motion)
    for form, p in (
        (Tanh(), {"F_c": 0.0, "v0": 0.01}),
        (Presliding(), {"F_c": 0.0, "x0": 0.001}),
        (Stribeck(), {"F_c": 0.0, "s": 0.5, "v_s": 0.01}),
        (LuGre(), {"F_c": 0.0, "x0": 0.001, "s": 0.5, "v_s": 0.01}),
        (Loaded(), {"F_c": 0.0, "v0": 0.01, "mu": 0.0}),
    ):
        np.testing.assert_array_equal(form.carriage(p, trial, motion, trial.force), np.zeros(motion.time.size))
    assert ConstantForce().parallel({"P": 0.0}, trial, motion, {}) == 0.0
    for form, p in ((Backlash(), {"play": 0.0}), (PreShear(), {"offset": 0.0})):
        own = form.specimen(p, trial, motion)
        for name in ("time", "displacement", "velocity", "acceleration"):
            np.testing.assert_array_equal(getattr(own, name), getattr(motion, name))
    assert Gap().series({"play": 0.0, "stiffness": 1e9}) == Linear().series({"stiffness": 1e9})


def test_pre_shear_moves_the_displacement_alone() -> None:
    motion = _irregular()
    own = PreShear().specimen({"offset": 0.003}, _trial(motion), motion)
    np.testing.assert_allclose(own.displacement, motion.displacement + 0.003, rtol=1e-14)
    np.testing.assert_array_equal(own.velocity, motion.velocity)


def test_series_of_a_spring_is_two_springs() -> None:
    # on a monotone way from rest: F = k k_s / (k + k_s) (u - play / 2) beyond half the play
    time = np.linspace(0.0, 1.0, 41)
    u = 0.01 * time
    k, k_s, play = 1e7, 3e7, 0.004
    damper = CoreDamper("kelvin_voigt", (k, 0.0))
    for form, p, gap in (
        (Linear(), {"stiffness": k_s}, 0.0),
        (Gap(), {"stiffness": k_s, "play": play}, 0.5 * play),
    ):
        series = form.series(p)
        assert series is not None
        force, own = damper.force_in_series(time, u, np.full(41, 0.01), series.stiffness, series.play)
        np.testing.assert_allclose(force, k * k_s / (k + k_s) * np.maximum(u - gap, 0.0), atol=1e-6 * k * 0.01)
        np.testing.assert_allclose(force, k * own, atol=1e-6 * k * 0.01)


@pytest.mark.parametrize(
    ("form", "values", "rig", "error"),
    [
        # of what the effect does: two rounds of Newton's method for springs, two in turn for others
        (ContactPositive(), (7e6, 1e-3, 1.5), Linear(), 1e-4),
        (Exponential(), (2e5, 7e-3), Gap(), 2e-3),
        (Maxwell(), (2e6, 0.2), Linear(), 5e-3),
        (Whole(), (0.3, 4e-3, 1.0, 0.5), Linear(), 1e-3),
        (Travelled(), (0.4, 1.0), Gap(), 4e-3),
    ],
)
def test_what_acts_in_the_specimen_goes_with_the_motion_that_the_rig_leaves(
    form: Form, values: tuple[float, ...], rig: Form, error: float
) -> None:
    # balance: the force is that without a rig under the motion u - e, e the stretch of the rig under this force, in two
    # tests of which the second begins with what the specimen remembers
    stiffness, play = 3e7, 4e-4 if isinstance(rig, Gap) else 0.0
    size = Sizes.of([_trial(_irregular(), order=order) for order in range(2)])
    motions = (_irregular(), _sine(200.0))
    trials = tuple(_trial(motion, f"t{i}", i) for i, motion in enumerate(motions))
    problem = DamperProblem(law("kelvin_voigt"), {"k": 4e6, "c": 1e-3}, trials, size)
    acting, stands = (candidate_of(one, size, Left()) for one in (form, rig))
    assert acting is not None and stands is not None
    part = (acting, np.array(values))
    in_series = {"stiffness": stiffness, "play": play}
    with_rig = (stands, np.array([in_series[u.name] for u in stands.unknowns]))
    forces = problem.predict(problem.declared, [part, with_rig], ("fit",))
    plain = problem.predict(problem.declared, [with_rig], ("fit",))
    own = []
    for motion, force in zip(motions, forces, strict=True):
        stretch = force / stiffness + 0.5 * play * np.sign(force)
        own.append(motion.moved(np.where(force == 0.0, 0.0, motion.displacement - stretch)))
    within = tuple(replace(trial, motion=motion) for trial, motion in zip(trials, own, strict=True))
    balanced = replace(problem, trials=within).predict(problem.declared, [part], ("fit",))
    for force, expected, bare in zip(forces, balanced, plain, strict=True):
        done = np.linalg.norm(force - bare)
        assert done > 0.02 * np.linalg.norm(bare)
        assert np.linalg.norm(force - expected) < error * done


def test_a_seated_gap_is_crossed_under_its_force() -> None:
    # two springs in series, that of the pins 2 F_c / play to half the play, stiff beyond: by hand on a monotone way
    time = np.linspace(0.0, 1.0, 401)
    u, k, rig, play, crossing = 0.01 * time, 1e7, 3e7, 0.004, 5e3
    series = GapSeated().series({"play": play, "stiffness": rig, "F_c": crossing})
    assert series is not None
    damper = CoreDamper("kelvin_voigt", (k, 0.0))
    force, _ = damper.force_in_series(time, u, np.full(401, 0.01), series.stiffness, series.play, within=series.within)
    soft, half = 2.0 * crossing / play, 0.5 * play
    within = u / (1.0 / k + 1.0 / soft)
    beyond = (u - half + crossing / rig) / (1.0 / k + 1.0 / rig)
    np.testing.assert_allclose(force, np.where(within <= crossing, within, beyond), atol=1e-6 * k * 0.01)


def test_a_joint_is_either_a_seated_gap_or_closes() -> None:
    # one equation of all: which it is depends on the force that closes it, and on how much stiffer it is then
    sizes = Sizes.of([_trial(_irregular())])
    forms = (GapSeated(), Closing(), play.Closing())
    seated, bedded, closed = ({u.name: u for u in form.unknowns(sizes)} for form in forms)
    assert seated["F_c"].upper == bedded["F_c"].lower == closed["F_c"].lower == CLOSES * sizes.force
    assert bedded["ratio"].upper == closed["ratio"].lower == CLEARANCE
    p = {"stiffness": 3e6, "F_c": 2e3, "ratio": 5.0}
    assert forms[1].series(p) == forms[2].series(p)


def test_a_joint_that_opens_is_softer_beyond_its_force() -> None:
    # on a monotone way from rest: two springs in series up to F_c, from there on with the softer one
    time = np.linspace(0.0, 1.0, 81)
    u, k, rig, opens, ratio = 0.01 * time, 1e7, 4e7, 3e4, 0.3
    part = Closing().series({"stiffness": rig, "F_c": opens, "ratio": ratio})
    damper = CoreDamper("kelvin_voigt", (k, 0.0))
    force, _ = damper.force_in_series(time, u, np.full(81, 0.01), part.stiffness, part.play, within=part.within)
    shut = u / (1.0 / k + 1.0 / rig)
    beyond = (u + opens * (1.0 / (ratio * rig) - 1.0 / rig)) / (1.0 / k + 1.0 / (ratio * rig))
    np.testing.assert_allclose(force, np.where(shut <= opens, shut, beyond), atol=1e-6 * k * 0.01)
    assert shut[-1] > 2.0 * opens


def test_parts_of_the_rig_that_lose_work() -> None:
    # a Zener solid behind a spring and a dashpot side by side: complex stiffnesses in series, once all is steady
    k0, k1, tau, rig, t_r = 4e6, 3e6, 0.1, 4e7, 0.03
    trial = _trial(_sine(400.0, cycles=6.0))
    problem = DamperProblem(law("zener"), {"k0": k0, "k1": k1, "c1": k1 * tau}, (trial,), Sizes.of((trial,)))
    candidate = candidate_of(Damped(), problem.sizes, Left())
    assert candidate is not None
    (force,) = problem.predict(problem.declared, [(candidate, np.array([rig, t_r]))], ("fit",))
    w = 2.0j * np.pi
    specimen, parts = k0 + k1 * w * tau / (1.0 + w * tau), rig * (1.0 + w * t_r)
    turned = AMPLITUDE * np.exp(w * trial.motion.time)
    steady = trial.motion.time >= 4.0  # 40 relaxation times
    expected = (specimen * parts / (specimen + parts) * turned).imag
    rigid, lossless = (specimen * turned).imag, (specimen * rig / (specimen + rig) * turned).imag
    error, size = np.max(np.abs((force - expected)[steady])), np.max(np.abs(rigid - expected))
    # the rate of the rig is that of a backward difference of second order: (w h)^2/3 of the dashpot's share
    assert error < 2e-4 * size
    assert np.max(np.abs((lossless - expected)[steady])) > 0.1 * size


@pytest.mark.parametrize(("clearance", "found"), [(0.0, "series_flexibility.linear"), (2e-4, "play.gap")])
def test_play_without_a_clearance_is_a_flexible_rig(clearance: float, found: str) -> None:
    # a spring in a rig, as the core has it, beside noise; the form with the clearance was found
    random, k, rig = np.random.default_rng(5), 1e7, 4e7
    trials = []
    for order, share in enumerate((1.0, 0.5, 0.2, 0.8)):
        whole = _irregular()
        motion = replace(whole, displacement=share * whole.displacement, velocity=share * whole.velocity)
        one = np.ones_like(motion.time)
        force, _ = CoreDamper("kelvin_voigt", (k, 0.0)).force_in_series(
            motion.time, motion.displacement, motion.velocity, rig, clearance, one
        )
        noisy = force + 20.0 * random.standard_normal(force.size)
        trials.append(replace(_trial(motion, f"test {order}", order), force=noisy))
    sizes = Sizes.of(trials)
    problem = DamperProblem(law("kelvin_voigt"), {"k": k, "c": 0.0}, tuple(trials), sizes)
    gap = candidate_of(Gap(), sizes, Left())
    assert gap is not None
    model = Model(problem, (20.0,) * 4, (gap,), held=True)
    known = Judged(fit(model, model.coordinates(None, [(gap, np.array([max(clearance, 1e-5), rig]))])))
    forms = EffectForms(Workbench(problem, model.noise, True, 1, lambda _: None))
    (part,) = forms.plainer(known).fitted.parts
    assert part[0].label == found
    stiffness = dict(zip((u.name for u in part[0].unknowns), part[1], strict=True))["stiffness"]
    assert stiffness == pytest.approx(rig, rel=0.01)  # noise of a thousandth of the force in 8000 samples


def test_parts_in_series_share_their_force() -> None:
    # of each part the stretch under a force, by hand
    parts = (Series(4e7), Series(6e7, play=2e-3, within=2e7), Series(9e7))
    whole = Series.together(parts)

    def stretch(part: Series, force: float) -> float:
        closing = part.within * 0.5 * part.play
        if force <= closing:
            return force / part.within
        return 0.5 * part.play + (force - closing) / part.stiffness

    for force in (5e3, 20e3, 50e3):
        assert stretch(whole, force) == pytest.approx(sum(stretch(part, force) for part in parts), rel=1e-12)
    hertz = Series(4e7, bend=1e6, power=1.5)
    assert Series.together((hertz,)) is hertz
    with pytest.raises(PredictionError, match="no other one in series"):
        Series.together((hertz, parts[0]))
    # compliances 1/(s + i w c) add, those of damping up to its square: w c = 0.01 s
    lossy, w = (Series(4e7, damping=8e4), Series(6e7, damping=1.2e5), Series(9e7)), 5.0
    both = Series.together(lossy)
    compliance = sum(1.0 / (one.stiffness + 1j * w * one.damping) for one in lossy)
    assert 1.0 / (both.stiffness + 1j * w * both.damping) == pytest.approx(compliance, rel=2e-4)
    plays = Series.together((Series(4e7, play=1e-3), Series(6e7, play=2e-3)))
    assert (plays.play, plays.within) == (pytest.approx(3e-3), 0.0)


@pytest.mark.parametrize(
    ("label", "values", "springs", "dashpots"),
    [
        ("ageing.linear", (0.02,), 1.1, 1.1),  # one number for the whole test
        ("ageing.linear_loss", (0.02, 3.0), 1.1, 1.1**3),
        ("ageing.linear_of_loss", (0.02,), 1.0, 1.1),
    ],
)
def test_effects_keep_their_size_behind_a_stiff_rig(
    label: str, values: tuple[float, ...], springs: float, dashpots: float
) -> None:
    k, c = 1e7, 2e5
    trial = _trial(_sine(200.0), order=5)
    sizes = replace(Sizes.of((trial,)), tests=8)
    problem = DamperProblem(law("kelvin_voigt"), {"k": k, "c": c}, (trial,), sizes)
    found = {one.label: one for one in candidates(sizes, Left((trial,), (trial.force,)), False, True)}
    parts = [(found[label], np.array(values)), (found["series_flexibility.linear"], np.array([1e5 * k]))]
    (force,) = problem.predict(problem.declared, parts, ("fit",))
    expected = springs * k * trial.motion.displacement + dashpots * c * trial.motion.velocity
    # the rig gives by a 1e-5 of the spring; the first samples are those of a dashpot that is pulled at once
    np.testing.assert_allclose(force[5:], expected[5:], rtol=0.0, atol=1e-3 * k * AMPLITUDE)
    assert (
        np.max(np.abs(expected - k * trial.motion.displacement - c * trial.motion.velocity))
        > 0.05 * c * 2 * np.pi * AMPLITUDE
    )


@pytest.mark.parametrize("form", [Backlash(), Gap()])
def test_a_play_of_a_few_thousandths_of_the_motion_is_seen(form: Form) -> None:
    # from starts far too large, a linear step would see nothing but harm
    trial = _trial(_irregular())
    problem = DamperProblem(law("zener"), {"k0": 4e6, "k1": 3e6, "c1": 3e5}, (trial,), Sizes.of((trial,)))
    candidate = candidate_of(form, problem.sizes, Left())
    assert candidate is not None
    true = {"play": 3e-5, "stiffness": 1e9}
    part = (candidate, np.array([true[u.name] for u in candidate.unknowns]))
    (force,), (without,) = (problem.predict(problem.declared, parts, ("fit",)) for parts in ([part], []))
    measured = replace(problem, trials=(replace(trial, force=force),))
    model = Model(measured, (0.05 * float(np.std(force - without)),), held=True)
    fitted = fit(model, model.coordinates())
    (signature,) = screen(fitted, [candidate])
    assert signature.gain > 0.8 * fitted.chi2


@pytest.mark.parametrize("samples", [2, 3, 9, 12])
def test_a_test_of_a_few_samples_is_predicted_behind_a_rig(samples: int) -> None:
    time = 0.01 * np.arange(samples)
    trial = _trial(Motion(time, 0.1 * time, np.full(samples, 0.1), np.zeros(samples)))
    problem = DamperProblem(law("kelvin_voigt"), {"k": 4e6, "c": 1e-3}, (trial,), Sizes.of((trial,)))
    parts = []
    for form, values in ((ContactPositive(), (4e6, 0.0, 1.0)), (Linear(), (8e6,))):
        candidate = candidate_of(form, problem.sizes, Left())
        assert candidate is not None
        parts.append((candidate, np.array(values)))
    (force,) = problem.predict(problem.declared, parts, ("fit",))
    np.testing.assert_allclose(force, 4e6 * trial.motion.displacement, atol=1.0)  # 8 beside 8 kN/mm in series


def test_contacts_carry_half_the_largest_force_at_their_stiffness() -> None:
    sizes = Sizes.of([_trial(_irregular())])
    form = Power()
    p = {"stiffness": 5e7, "n": 1.5, **form.fixed(sizes)}
    rig = form.series(p)
    assert rig is not None and rig.play == 0.0
    stretch = p["F_r"] / p["stiffness"]
    for share in (0.25, 1.0, 2.0):  # F = F_r (e/e_r)^n
        e = share * stretch
        carried = rig.stiffness * e * (np.sqrt(rig.bend) * e) ** (rig.power - 1.0)
        assert carried == pytest.approx(p["F_r"] * share**1.5, rel=1e-12)
    assert p["F_r"] == 0.5 * sizes.force


def test_a_zero_set_by_hand_is_each_tests_own_beside_the_pre_shear() -> None:
    (finer,) = Tared().finer()
    motion = _irregular()
    assert finer.has_columns and finer.form == "pre_shear_tared_by_hand" and finer.finer() == ()
    own = finer.specimen({"offset": 1e-3}, _trial(motion), motion)
    np.testing.assert_array_equal(own.displacement, motion.displacement + 1e-3)
    np.testing.assert_array_equal(finer.columns({}, _trial(motion)), np.ones((motion.time.size, 1)))
