"""The law file of a calibration: the damper that is read back makes the force that the loop predicted."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from edesign.calibrate.dampers import carried
from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.effects import MODULES, degradation
from edesign.calibrate.dampers.left import Left
from edesign.calibrate.dampers.library import candidate_of
from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial
from edesign.calibrate.fit import Model, fit
from edesign.calibrate.problem import Candidate, PredictionError
from edesign.calibrate.result import Calibration, Errors, Estimate, Series
from edesign.calibrate.write import law_text
from edesign.damper.amendment_kinds import placed_form
from edesign.damper.damper import Damper
from edesign.damper.law_file import read_law_file, resolve
from edesign.damper.laws import law
from edesign.damper.parameters import read_parameters
from edesign.damper.testing.campaign import Campaign
from edesign.damper.testing.campaign_blocks import LawChoice
from edesign.damper.thesis_tables import PROTOTYPE

MGMM = read_parameters(law("mgmm"), "thesis_table_4_2")
ROUNDING = 1e-6  # of the peak; effects by work: the loop's sweeps over all steps end at 1e-6 of its state
CAMPAIGN = Campaign(PROTOTYPE, LawChoice("mgmm", "thesis_table_4_2"), (), Path("campaign.yaml"))
BESIDE: list[Form] = [kind() for module in MODULES for kind in module.FORMS if kind.amendment]
FORMS = [*BESIDE, *(form.within() for form in BESIDE if form.may_be_inside)]


@cache
def problem(dt: float = 0.01) -> DamperProblem:
    """Five tests from rest, at 20 to 31 degC: sines that grow and fall, with no sample but the first at
    zero to rounding, where one side, and a power of the velocity, are what rounding makes of them."""
    tests = []
    for order, (frequency, amplitude, warm) in enumerate(
        (
            *((0.617, 9e-3, 26.0), (1.913, 4e-3, 20.0), (0.811, 6e-3, 22.0)),
            *((1.513, 7e-3, 24.0), (1.137, 12e-3, 31.0)),
        )
    ):
        t = np.arange(round(4.9 / dt) + 1) * dt
        w, b = 2.0 * np.pi * frequency, 2.0 * np.pi / 5.0
        size, rate, bend = 0.5 * (1.0 - np.cos(b * t)), 0.5 * b * np.sin(b * t), 0.5 * b * b * np.cos(b * t)
        u = amplitude * size * np.sin(w * t)
        v = amplitude * (size * w * np.cos(w * t) + rate * np.sin(w * t))
        a = amplitude * ((bend - size * w * w) * np.sin(w * t) + 2.0 * rate * w * np.cos(w * t))
        motion = Motion(t, u, v, a)
        force = Damper(law("mgmm"), MGMM).force(t, u, v)
        tests.append(
            Trial(f"t{order}", "validate" if order == 1 else "fit", order, motion, force, np.full(t.size, warm))
        )
    return DamperProblem(law("mgmm"), MGMM, tuple(tests), Sizes.of(tests), fineness=0.0)


def predicted(of: DamperProblem, parts: list[tuple[Candidate, np.ndarray]], order: int) -> np.ndarray:
    force = of.predict(of.declared, parts, ("fit", "validate"))[order]
    assert force is not None
    return force


def calibration(of: DamperProblem, candidate: Candidate, values: tuple[float, ...]) -> Calibration:
    """As the loop returns it with this effect."""
    model = Model(of, (1.0,) * len(of.trials), (candidate,), held=True)
    final = fit(model, model.coordinates(parts=[(candidate, np.array(values))]), most_steps=0)
    bare = replace(model, effects=())
    alone = fit(bare, bare.coordinates())
    series = tuple(
        Series(t.name, t.name, t.use, t.order, *(t.motion.time, t.motion.displacement, t.motion.velocity), t.force, {},
               t.temperature, 1.0)
        for t in of.trials
    )  # fmt: skip
    stages = ("declared", "refit", "corrected")
    return Calibration(
        title="c",
        law="mgmm",
        errors={stage: Errors(0.0, 0.0, {}) for stage in stages},
        noise_floor=0.0,
        noise_floor_fit=0.0,
        effects=(),
        verdict="explained",
        unexplained_share=0.0,
        unexplained_shape="",
        next_test=None,
        refused=(),
        parameters={
            stage: {u.name: Estimate(float(x), 0.0, u.unit) for u, x in zip(of.base, of.declared, strict=True)}
            for stage in stages
        },
        law_held=True,
        series=series,
        seconds=0.0,
        carried=carried.carried_law(final, alone, of, of, 0.0),
    )


def difference(form: Form, folder: Path, of: DamperProblem) -> tuple[float, float]:
    """Of the law file's force from the loop's, and of that from the law's alone, over the peak."""
    candidate = candidate_of(form, of.sizes, Left())
    assert candidate is not None
    values = candidate.starts[0]
    order = (
        len(of.trials) - 1 if form.name == "ageing" else 0
    )  # a law file has the specimen aged, else as it was at first
    path = folder / "law.yaml"
    path.write_text(law_text(calibration(of, candidate, values), CAMPAIGN), encoding="utf-8")
    trial = of.trials[order]
    found = resolve(*read_law_file(path), float(trial.temperature[0]))
    carried, placement = placed_form(form.name, getattr(form, "amendment_form", form.form))
    assert [(one.kind.name, one.placement) for one in found.amendments] == [(f"{form.name}.{carried}", placement)]
    damper = Damper(found.law, found.values, amendments=found.amendments, temperature_C=found.temperature_C)
    force = damper.force(trial.motion.time, trial.motion.displacement, trial.motion.velocity)
    expected = predicted(of, [(candidate, np.array(values))], order)
    peak = np.max(np.abs(expected))
    plain = predicted(of, [], order)
    return float(np.max(np.abs(force - expected)) / peak), float(np.max(np.abs(expected - plain)) / peak)


@pytest.mark.parametrize("form", FORMS, ids=lambda form: f"{form.name}.{form.form}")
def test_the_law_file_makes_the_force_that_the_loop_predicted(form: Form, tmp_path: Path) -> None:
    error, change = difference(form, tmp_path, problem())
    assert change > 2e-2
    if not (form.inside and type(form).parallel is not Form.parallel):
        assert error < ROUNDING
        return
    # a force inside is a cubic between samples in the loop, and linear over a step in the core: of second order
    finer, _ = difference(form, tmp_path, problem(0.005))
    print(form.name, form.form, error, finer)
    assert error < 2e-3 and finer < 0.5 * error


def test_a_form_that_law_files_lack_is_fitted_again_in_one_that_they_have(tmp_path: Path) -> None:
    # the force falls with the work done in its life without end; law files know a fall that ends
    form = degradation.Work()
    candidate = candidate_of(form, problem().sizes, Left())
    assert candidate is not None
    values = (0.2, 1.0)
    forces = [predicted(problem(), [(candidate, np.array(values))], i) for i in range(5)]
    trials = tuple(replace(trial, force=force) for trial, force in zip(problem().trials, forces, strict=True))
    of = replace(problem(), trials=trials)
    found = calibration(of, candidate, values).carried
    assert found is not None and found.replaced == ("degradation.work",)
    (effect,) = found.effects
    assert (effect.name, effect.form) == ("degradation", "energy")
    # a straight line as the beginning of 1 - exp(-x): d/E0 is its slope
    slope = 0.2 / candidate.effect[1]["W"]
    assert effect.values["d"] / effect.values["E0"] == pytest.approx(slope, rel=0.1)
    plain = of.predict(of.declared, [], ("validate",))[1]
    assert plain is not None
    assert 0.0 < found.validate < 1e-2 * float(np.sum((plain - forces[1]) ** 2) / np.sum(forces[1] ** 2))
    text = law_text(calibration(of, candidate, values), CAMPAIGN)
    assert (
        "# not carried: degradation.work: law files cannot carry this form; fitted as degradation.energy inst" in text
    )
    path = tmp_path / "law.yaml"
    path.write_text(text, encoding="utf-8")
    assert [one.kind.name for one in resolve(*read_law_file(path), 20.0).amendments] == ["degradation.energy"]


def test_where_the_rest_has_no_prediction_the_law_is_as_declared(monkeypatch: pytest.MonkeyPatch) -> None:
    candidate = candidate_of(degradation.Work(), problem().sizes, Left())
    assert candidate is not None

    def none(*_: object) -> None:
        raise PredictionError("the state is not finite")

    monkeypatch.setattr(carried, "_in_known_forms", none)
    found = calibration(problem(), candidate, (0.2, 1.0)).carried
    assert found is not None and found.effects == () and found.replaced == ("degradation.work",)
    declared = problem().predict(problem().declared, [], ("validate",))[1]
    measured = problem().measured[1]
    assert declared is not None
    assert found.validate == pytest.approx(float(np.sum((declared - measured) ** 2) / np.sum(measured**2)))
