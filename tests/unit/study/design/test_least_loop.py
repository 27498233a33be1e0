"""Searches of designs whose estimate fails: the histories go on, and what cannot be sized is left out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from design_examples import MadeVerdict, design, shear_project

from edesign.archive.dataset import Group
from edesign.errors import AnalysisError
from edesign.project.dampers.dampers import Dampers
from edesign.study.design.design import first_warnings, run_design
from edesign.study.design.fully_stressed import StoreySizes, search_fully_stressed
from edesign.study.design.loop import RoundOutcome, RoundVerdict
from edesign.study.design.optimum import search_optimum

LIMIT = 0.01
SIZES = StoreySizes(np.array([0.1, 0.1]), np.ones(2), 0.1, 1e-3, 20.0, np.array([1, 3]))


@dataclass(frozen=True)
class Made:
    """Dampers of two storeys."""

    x: np.ndarray
    target: float = np.nan
    reason: str = ""


def outcome(*drifts: float) -> RoundOutcome:
    value = max(drifts)
    return RoundOutcome((RoundVerdict("drift", value, LIMIT, value <= LIMIT),), drift=drifts)


def test_a_storey_without_dampers_cannot_be_helped_by_itself() -> None:
    """The middle storey of three has none and governs: dampers below it grow, as its drift falls with theirs.

    Drifts 0.02 / sqrt(1 + 10 x1), of the third 0.001: 1 + 10 x1 = 4, and the third keeps the least dampers.
    """

    def verify(made: Made, number: int, changed: float) -> RoundOutcome:
        drift = 0.02 / np.sqrt(1.0 + 10.0 * made.x[0])
        return outcome(0.8 * drift, drift, 0.001)

    found = search_fully_stressed(Made(SIZES.first), Made, verify, SIZES, 30, 0.01)
    assert found.reason == "" and found.chosen.sizing.x[1] < 1.1 * SIZES.least
    # within the precision of the sum, and the step of the precision from dampers that are not enough
    assert 0.3 <= found.chosen.sizing.x[0] <= 0.3 * 1.01**2


def test_dampers_that_change_nothing_end_at_the_largest() -> None:
    found = search_fully_stressed(
        Made(SIZES.first), Made, lambda made, number, changed: outcome(0.02, 0.01, 0.02), SIZES, 100, 0.05
    )
    assert "even the largest dampers of the storeys that drift too far miss: drift (2 %" in found.reason
    assert np.array_equal(found.chosen.sizing.x, [SIZES.most, SIZES.most])


def test_dampers_that_cannot_be_sized_end_the_search_with_the_reason() -> None:
    def make(x: np.ndarray) -> Made:
        if x[0] > 0.5:
            raise AnalysisError("the first mode does not oscillate [E-DESIGN-05]")
        return Made(x)

    args = (lambda made, number, changed: outcome(0.02, 0.01, 0.02), SIZES, 100, 0.05)
    found = search_fully_stressed(Made(SIZES.first), make, *args)
    assert found.reason.endswith("beyond them the first mode does not oscillate [E-DESIGN-05]")
    assert 0.47 < found.chosen.sizing.x[0] <= 0.5  # within the precision of 5 %


def test_a_value_of_an_optimum_that_cannot_be_sized_is_left_out() -> None:
    """Least of (ln x - ln 0.3)^2 between 0.05 and 1, of which the lowest cannot be sized."""

    def make(value: float) -> Made:
        if value < 0.1:
            raise AnalysisError("amplitude and secants did not agree [E-DESIGN-05]")
        return Made(np.array([value]))

    def verify(made: Made, number: int, changed: float) -> RoundOutcome:
        return outcome(LIMIT * (1.0 + float(np.log(made.x[0] / 0.3)) ** 2))

    found = search_optimum(make, verify, (0.05, 1.0), "worst", 20, 0.02)
    assert found.chosen.changed == pytest.approx(0.3, rel=0.02)
    with pytest.raises(AnalysisError, match="did not agree"):
        search_optimum(lambda value: make(0.01), verify, (0.05, 1.0), "worst", 20, 0.02)


@pytest.mark.parametrize("drift", [0.009, 0.011])
def test_simplified_dampers_beyond_the_range_are_judged_by_histories(drift: float) -> None:
    """No beta meets 0.1 % by the lateral forces: without histories that is a failure, with them they decide."""
    project = shear_project(2)
    text = (
        "method: simplified, law: rubber, kind: storey, bays: 1, level: DBE, drift: 0.1 %, strain: 20 %, "
        "layer_thickness: 10 mm, properties: {G_storage: 1 MPa, loss_factor: 0.35}"
    )
    alone = run_design(project, "tried", design(text, project), Path("."))
    assert alone.status == "failed" and "an estimate: with `verify` histories decide" in alone.reason
    spec = design(f"{text}, verify: {{records: shake, levels: DBE, criteria: drift}}", project)
    (reported,) = [one for one in first_warnings(project, "tried", spec, Path(".")) if "estimated drift" in one]
    assert "that is an estimate, and histories decide" in reported

    def respond(dampers: Dampers, number: int) -> Mapping[str, Group]:
        return {"only": Group()}

    found = run_design(project, "tried", spec, Path("."), respond, lambda groups: [MadeVerdict(drift)])
    assert found.status == ("completed" if drift < LIMIT else "failed")
    assert "estimate" not in found.reason and ("drift (1.1 %, limit 1 %)" in found.reason) == (drift > LIMIT)
