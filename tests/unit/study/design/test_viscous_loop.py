"""The loop of a design of viscous dampers with histories that are made up; interruption, failure, wrong laws."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from design_examples import MadeVerdict, design, shear_project

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.errors import InputError
from edesign.project.dampers.dampers import DamperRun, Dampers
from edesign.project.project import Project
from edesign.study.design.design import DesignResult, run_design

LAWS = "\ndampers: {laws: {oil: {type: viscous_power, parameters: {c: 1 kN*(s/m)^0.5, alpha: 0.5}@}}}\n"
TEXT = "method: viscous, law: oil, kind: storey, bays: 1, state: initial, level: DBE, damping: 8 %"
VERIFY = ", verify: {records: shake, levels: DBE, criteria: drift, change: @}"


def run(text: str, histories: Histories | None = None, resume: Group | None = None) -> DesignResult:
    project = shear_project(2, LAWS.replace("@", ""))
    made = () if histories is None else (histories.respond, histories.judge)
    return run_design(project, "tried", design(text, project), Path("."), *made, resume=resume)


class Histories:
    """The drift falls with the scale of the dampers of the first storey; `rounds` that were asked for."""

    def __init__(self, stiffest: float = 1.0) -> None:
        self.rounds: list[int] = []
        self.stiffest = stiffest

    def respond(self, dampers: Dampers, number: int) -> Mapping[str, Group]:
        self.rounds.append(number)
        (run,) = dampers.devices
        assert isinstance(run, DamperRun) and isinstance(run.scale, tuple)
        drift = self.stiffest * 0.02 / (1.0 + run.scale[0] / 400.0)
        group = Group(attributes={"drift": drift, "level": "DBE"})
        peaks = drift * np.array([1.0, 1.0 / (1.0 + run.scale[1] / 1000.0)])
        group.add("storey_drift_max", ("storey",), peaks, "1", "peak")
        group.add("storey_drift_min", ("storey",), -0.9 * peaks, "1", "peak")
        return {"only": group}

    def judge(self, groups: Mapping[str, Group]) -> list[MadeVerdict]:
        return [MadeVerdict(float(str(groups["only"].attributes["drift"])))]


@pytest.mark.parametrize("change", ["target", "coefficient", "coefficient of each storey"])
def test_finished_rounds_of_an_archive_are_not_run_again(tmp_path: Path, change: str) -> None:
    text = TEXT + VERIFY.replace("@", change.split()[0])
    if change.endswith("storey"):
        text = text.replace("damping: 8 %", "distribution: least_coefficient, drift: 1.5 %")
    whole = run(text, Histories())
    assert whole.status == "completed" and whole.group.coords["round"].values.size > 1
    with ArchiveWriter(tmp_path / "a.h5", Group()) as writer:
        writer.write("designs/tried", whole.group)
        path = writer.finish({"status": "completed"})
    with open_archive(path) as archive:
        read = archive.group("designs/tried")
    histories = Histories()
    again = run(text, histories, read)
    assert histories.rounds == []
    for name, variable in whole.group.variables.items():
        assert variable.values.tobytes() == again.group.variables[name].values.tobytes(), name
    other = Histories()
    run(text.replace("8 %", "9 %").replace("drift: 1.5 %", "drift: 1.6 %"), other, read)
    assert other.rounds[0] == 1


def test_a_drift_that_no_damping_meets_is_reported() -> None:
    result = run(TEXT + VERIFY.replace("@", "coefficient"), Histories(stiffest=100.0))
    assert result.status == "failed" and "even the largest value, 10, misses: drift" in result.reason


def test_least_coefficients_that_do_not_exist_are_reported() -> None:
    least = TEXT.replace("damping: 8 %", "distribution: least_coefficient, drift: @ %")
    result = run(least.replace("@", "0.1"))
    assert result.status == "failed" and "still leave an estimated drift of" in result.reason
    result = run(least.replace("@", "9"))
    assert result.status == "failed" and "stays below 9 % without dampers" in result.reason


def test_linear_dampers_need_no_amplitude() -> None:
    project: Project = shear_project(2, LAWS.replace("@", "").replace("^0.5", "^1").replace("alpha: 0.5", "alpha: 1"))
    result = run_design(project, "tried", design(TEXT.replace("level: DBE, ", ""), project), Path("."))
    assert result.status == "completed" and "design_stroke" not in result.group.variables
    (device,) = result.dampers.devices
    assert isinstance(device, DamperRun) and device.design_deformation is None
    np.testing.assert_allclose(result.group.attributes["law_damping_strain_energy"], 0.08, rtol=1e-3)


def test_a_law_with_effects_is_refused() -> None:
    effect = ", effects: [{name: payne, form: whole, parameters: {d: 0.2, a0: 3 mm, m: 1, tau_a: 5 s}}]"
    project = shear_project(2, LAWS.replace("@", effect))
    with pytest.raises(InputError, match="designs.tried.law.*E-DESIGN-03"):
        run_design(project, "tried", design(TEXT, project), Path("."))
