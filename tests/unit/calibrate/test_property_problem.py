"""Property tables as problems of the loop: predictions, repeatability, files."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from edesign.calibrate.evidence import Judged
from edesign.calibrate.fit import Model, fit
from edesign.calibrate.properties.campaign import is_property_campaign, load_property_campaign
from edesign.calibrate.properties.problem import PropertyProblem, as_measured, property_problem
from edesign.calibrate.properties.repeatability import QUANTITIES, repeatability
from edesign.calibrate.properties.run import corrected_law
from edesign.damper.damper import Damper
from edesign.damper.laws import law
from edesign.damper.mgmm_steady import steady_loops, steady_moduli
from edesign.damper.testing.property_table import PropertyTable
from edesign.damper.thesis_tables import predicted
from edesign.errors import InputError

TEXT = """\
specimen: {name: prototype, layers: 2, layer_area_mm2: 41400, layer_thickness_mm: 12}
law: {type: mgmm, parameters: thesis_table_4_2}
properties: {table: thesis_appendix_a, hold_out: {temperatures: [25 degC, 35 degC], strains: [20 %, 40 %]}}
"""
BOTH = ("fit", "validate")


@pytest.fixture(scope="module")
def problem(tmp_path_factory: pytest.TempPathFactory) -> PropertyProblem:
    path = tmp_path_factory.mktemp("table") / "campaign.yaml"
    path.write_text(TEXT)
    return property_problem(load_property_campaign(path))


def _candidate(problem: PropertyProblem, label: str):
    return next(one for one in problem.candidates(()) if one.label == label)


def test_groups_and_uses(problem: PropertyProblem) -> None:
    assert len(problem.groups) == 20  # 4 temperatures x 5 strains
    assert sum(use == "fit" for use in problem.uses) == 6  # 20 and 30 degC; 10, 30 and 50 %
    fitted = np.concatenate([g.rows for g in problem.groups if g.use == "fit"])
    assert set(problem.table.temperature_C[fitted]) == {20.0, 30.0}
    assert np.allclose(sorted(set(problem.table.strain[fitted])), (0.1, 0.3, 0.5))


def test_predicts_what_the_declared_law_predicts(problem: PropertyProblem) -> None:
    """The 17.4 % of docs/results/thesis_damper_tables.md, by its own route with 15 cycles of 200 samples."""
    rows = problem.rows(problem.declared, ())
    expected = predicted()
    # 60 samples a cycle miss a largest stress by (pi/60)^2/2 = 1.4e-3 at most
    assert rows.G_eq == pytest.approx(expected.G_eq, rel=1.5e-3)
    assert rows.G_storage == pytest.approx(expected.G_storage, rel=3e-4)
    assert rows.loss_factor == pytest.approx(expected.loss_factor, rel=3e-4)


def test_branch_alone_relaxes_in_closed_form(problem: PropertyProblem) -> None:
    """`all_beside` against the Fourier series of the same arrangement, at 20 degC."""
    part = (_candidate(problem, "arrangement.all_beside"), np.empty(0))
    rows = problem.rows(problem.declared, (part,))
    here = problem.table.temperature_C == 20.0
    amplitude = problem.table.strain[here] * problem.specimen.layer_thickness
    loops = steady_loops(problem.inner.start, amplitude, problem.table.frequency[here], 512, "beside")
    G_storage, G_eq, G_loss = steady_moduli(loops) / (problem.specimen.area * problem.table.strain[here])
    # what stands beside it relaxes in 0.1 ms: (omega tau)^alpha = 0.1 of the power-law force acts at the tips at 4 Hz
    assert rows.G_storage[here] == pytest.approx(G_storage, rel=0.07)
    assert rows.G_eq[here] == pytest.approx(G_eq, rel=0.01)
    assert rows.G_loss[here] == pytest.approx(G_loss, rel=0.01)
    printed = problem.rows(problem.declared, ())
    assert np.max(np.abs(printed.G_eq[here] / G_eq - 1.0)) > 0.1


def test_reading_changes_the_largest_stress_alone(problem: PropertyProblem) -> None:
    part = (_candidate(problem, "peak_reading.share"), np.array([0.07]))
    with_it, without = problem.rows(problem.declared, (part,)), problem.rows(problem.declared, ())
    assert with_it.G_eq == pytest.approx(1.07 * without.G_eq, rel=1e-12)
    assert with_it.G_storage == pytest.approx(without.G_storage, rel=1e-12)
    assert with_it.loss_factor == pytest.approx(without.loss_factor, rel=1e-12)


def test_repeatability_of_a_smooth_table_with_noise() -> None:
    rng = np.random.default_rng(3)
    T, g, f = (a.ravel() for a in np.meshgrid((20.0, 30.0), (0.1, 0.2, 0.3, 0.4, 0.5), (0.25, 0.5, 1.0, 2.0, 4.0)))
    size = {"G_storage": 0.004, "G_eq": 0.008, "loss_factor": 0.016}
    smooth = {"G_storage": 1e6 * f**0.1 * g**-0.3, "G_eq": 1.2e6 * f**0.1 * g**-0.3, "loss_factor": 0.4 * g**-0.1}
    noisy = {name: value * np.exp(size[name] * rng.standard_normal(f.size)) for name, value in smooth.items()}
    noisy["G_eq"][7] *= 1.3  # a slip
    found = repeatability(PropertyTable(T, g, f, **noisy))
    for name in QUANTITIES:
        # 30 differences: the median absolute value scatters by 15 %; the smaller of two directions is taken
        assert 0.5 * size[name] < found[name] < 1.5 * size[name]


def test_corrected_law_predicts_as_the_loop_did(problem: PropertyProblem) -> None:
    """What a law file carries, through the core alone, against the model of the loop; readings are left out."""
    effects = tuple(
        replace(one, starts=(start,))
        for label, start in (
            ("payne.whole", (0.2, 3e-3, 1.0, 5.0)),
            ("arrangement.all_beside", ()),
            ("peak_reading.share", (0.1,)),
        )
        for one in (_candidate(problem, label),)
    )
    model = Model(problem, (0.01,) * len(problem.groups), effects, held=True)
    judged = Judged(fit(model, model.coordinates(), most_steps=0))
    found = corrected_law(problem, judged)
    assert [one.kind.name for one in found.effects] == ["payne.whole", "relaxation_branch.maxwell"]
    assert len(found.left_out) == 1 and found.left_out[0].startswith("peak_reading.share")
    row = int(np.flatnonzero((problem.table.strain == 0.3) & (problem.table.temperature_C == 20.0))[2])
    parts = judged.fitted.parts
    expected = problem.forces(judged.fitted.base, parts, BOTH)[row]
    motion = problem.inner.trials[row].motion
    force = Damper(law("mgmm"), found.values, amendments=found.effects).force(
        motion.time, motion.displacement, motion.velocity
    )
    assert force == pytest.approx(expected, abs=1e-9 * np.max(np.abs(force)))


def test_cycles_as_measured_differ_little(problem: PropertyProblem, tmp_path: Path) -> None:
    path = tmp_path / "campaign.yaml"
    path.write_text(TEXT)
    full = as_measured(load_property_campaign(path))
    few, many = problem.rows(problem.declared, ()), full.rows(full.declared, ())
    assert few.loss_factor == pytest.approx(many.loss_factor, rel=1e-3)  # beside rows that repeat to 5e-3


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("[20 %, 40 %]", "[20 %, 45 %]", "no row at 45 %"),
        ("hold_out: {temperatures: [25 degC, 35 degC], strains: [20 %, 40 %]}", "hold_out: {}", "no row is held out"),
        ("[20 %, 40 %]", "[10 %, 20 %, 30 %, 40 %, 50 %]", "are left to be fitted to"),
        ("thesis_appendix_a", "missing.csv", "there is no file"),
        ("strains:", "strain:", "strain"),
        (", parameters: thesis_table_4_2", "", "parameters"),
        ("[25 degC", "[25", "is no temperature"),
    ],
)
def test_errors_for_people(tmp_path: Path, old: str, new: str, message: str) -> None:
    assert old in TEXT
    path = tmp_path / "campaign.yaml"
    path.write_text(TEXT.replace(old, new))
    with pytest.raises(InputError) as caught:
        load_property_campaign(path)
    assert message in str(caught.value)
    assert f"{path}:" in str(caught.value)


def test_kind_of_campaign(tmp_path: Path) -> None:
    path = tmp_path / "campaign.yaml"
    path.write_text(TEXT)
    assert is_property_campaign(path)
    path.write_text(TEXT.replace("properties:", "tests:"))
    assert not is_property_campaign(path)
    assert not is_property_campaign(tmp_path / "nowhere.yaml")
