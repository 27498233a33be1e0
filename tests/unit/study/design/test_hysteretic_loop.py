"""The rounds of a design of hysteretic dampers with histories that are made up: optimum, interruption, wrong laws."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
import pytest
from design_examples import MadeVerdict, design, shear_project

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.errors import InputError
from edesign.project.dampers.dampers import DamperRun, Dampers
from edesign.study.design.design import DesignResult, run_design

LAWS = "\ndampers: {laws: {pad: {type: friction, parameters: {mu: 0.5, N: 2 kN, k: 2 kN/mm}@}}}\n"
TEXT = "method: hysteretic, law: pad, kind: storey, bays: 1, state: initial, level: DBE, inherent_damping: 3 %, @"
VERIFY = ", verify: {records: shake, levels: DBE, criteria: drift, change: @}"
RANGE = (0.05, 0.8)
OPTIMUM = TEXT.replace("@", "optimum: {range: [5 %, 80 %]}, verify: {records: shake, criteria: drift, rounds: @}")
LIMIT = MadeVerdict.limit


class Histories:
    """The drift is a function of the share that the first storey's dampers have; `rounds` that were asked for."""

    def __init__(self, drift: Callable[[float], float]) -> None:
        self.rounds: list[int] = []
        self.drift = drift

    def respond(self, dampers: Dampers, number: int) -> Mapping[str, Group]:
        self.rounds.append(number)
        (run,) = dampers.devices
        assert isinstance(run, DamperRun) and isinstance(run.scale, tuple)
        return {"only": Group(attributes={"drift": self.drift(run.scale[0] * 1e3 / SHEAR)})}

    def judge(self, groups: Mapping[str, Group]) -> list[MadeVerdict]:
        return [MadeVerdict(float(str(groups["only"].attributes["drift"])))]


def run(text: str, histories: Histories | None = None, resume: Group | None = None) -> DesignResult:
    project = shear_project(2, LAWS.replace("@", ""))
    made = () if histories is None else (histories.respond, histories.judge)
    return run_design(project, "tried", design(text, project), Path("."), *made, resume=resume)


SHEAR = float(run(TEXT.replace("@", "shear_share: 20 %")).group.variables["storey_shear"].values[0])


def valley(share: float) -> float:
    """Least at a share of 23 %."""
    return 0.009 + 0.004 * math.log(share / 0.23) ** 2


def read_again(group: Group, folder: Path) -> Group:
    with ArchiveWriter(folder / "a.h5", Group()) as writer:
        writer.write("designs/tried", group)
        path = writer.finish({"status": "completed"})
    with open_archive(path) as archive:
        return archive.group("designs/tried")


def test_optimum_is_found_by_golden_sections() -> None:
    result = run(OPTIMUM.replace("@", "30"), Histories(valley))
    group = result.group
    assert result.status == "completed"
    shares = group.variables["round_share"].values
    np.testing.assert_allclose(shares[:5], np.geomspace(*RANGE, 5), rtol=1e-9)
    chosen = int(str(group.attributes["chosen_round"])) - 1
    assert shares[chosen] == pytest.approx(0.23, rel=0.05)  # the width of the bracket, `precision`
    objective = group.variables["round_objective"].values
    np.testing.assert_allclose(objective, [valley(share) / LIMIT for share in shares], rtol=1e-9)
    assert objective[chosen] == objective.min()
    # beyond the scan each round keeps 0.618 of a bracket of two steps of it or less
    assert shares.size <= 5 + math.ceil(math.log(0.5 * math.log(16.0) / math.log(1.05)) / math.log(1.618)) + 1
    assert (
        len(group.attributes["warnings"]) == 1 and "of the least are all tried from" in group.attributes["warnings"][0]
    )


@pytest.mark.parametrize(
    ("drift", "said"),
    [
        (lambda share: 0.01 * share, "the least lies at the lower end of the range, 0.05"),
        (lambda share: 0.02 / (1.0 + share), "the least lies at the upper end of the range, 0.8"),
        (lambda share: 0.009 + 1e-5 * math.log(share / 0.2) ** 2, "the curve is flat: from 0.9"),
        (lambda share: 0.02 + valley(share), "criteria that are not met even at the least: drift"),
        (lambda share: 0.008 + 1e-3 * math.cos(4.5 * math.log(share / 0.05)), "the curve has 2 valleys"),
    ],
)
def test_warnings_about_an_optimum(drift: Callable[[float], float], said: str) -> None:
    result = run(OPTIMUM.replace("@", "12"), Histories(drift))
    assert result.status == "completed"
    assert any(said in warning for warning in result.group.attributes["warnings"]), result.group.attributes["warnings"]


def test_an_optimum_without_values_fails() -> None:
    result = run(OPTIMUM.replace("@", "6"), Histories(lambda share: math.nan))
    assert result.status == "failed" and "no round has a value of each criterion" in result.reason
    assert result.group.coords["round"].values.size == 5


@pytest.mark.parametrize(
    "text",
    [
        OPTIMUM.replace("@", "9"),
        TEXT.replace("@", "shear_share: 8 %") + VERIFY.replace("@", "target"),
        TEXT.replace("@", "damping: 3 %") + VERIFY.replace("@", "yield_force"),
    ],
)
def test_finished_rounds_of_an_archive_are_not_run_again(tmp_path: Path, text: str) -> None:
    whole = run(text, Histories(valley))
    assert whole.status == "completed" and whole.group.coords["round"].values.size > 1
    read = read_again(whole.group, tmp_path)
    histories = Histories(valley)
    again = run(text, histories, read)
    assert histories.rounds == []
    for name, variable in whole.group.variables.items():
        assert variable.values.tobytes() == again.group.variables[name].values.tobytes(), name
    other = Histories(valley)
    run(text.replace("[5 %", "[6 %").replace("8 %,", "9 %,").replace("3 %,", "4 %,"), other, read)
    assert other.rounds[0] == 1


def test_a_drift_that_no_share_meets_is_reported() -> None:
    text = TEXT.replace("@", "shear_share: 30 %") + VERIFY.replace("@", "target")
    result = run(text, Histories(lambda share: 1.0 / (1.0 + share)))
    assert result.status == "failed" and "even the largest value, 1, misses: drift" in result.reason


def test_a_law_with_effects_is_refused() -> None:
    effect = ", effects: [{name: payne, form: whole, parameters: {d: 0.2, a0: 3 mm, m: 1, tau_a: 5 s}}]"
    project = shear_project(2, LAWS.replace("@", effect))
    with pytest.raises(InputError, match="designs.tried.law.*E-DESIGN-03"):
        run_design(project, "tried", design(TEXT.replace("@", "shear_share: 20 %"), project), Path("."))
