"""What criteria need of the histories of a study is checked before the run: motions, samples, kept histories."""

from __future__ import annotations

from pathlib import Path

import pytest

from edesign.errors import InputError
from edesign.frame.project_file import load_project, load_study
from edesign.project.dampers.device_names import names_of_dampers
from edesign.project.dampers.verification import Verify
from edesign.project.study.study_loader import parse_study
from edesign.study.analysis.structure import make_frame
from edesign.study.check.check import check_study_inputs
from edesign.study.check.criteria_inputs import kept_for_verification, too_few_motions
from edesign.study.plan.study_plan import make_study_plan

CASES = Path(__file__).parents[2] / "cases"
PATH = CASES / "any_quantity" / "study.yaml"
TEXT = PATH.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("statistic: ec8", "statistic: asce7", r"criteria\[3\].statistic.* 11 .*E-CRIT-01"),
        ("records: [whole, slow, fast]", "records: [whole, slow]", r"criteria\[3\].statistic.* 3 .*E-CRIT-01"),
        ("frequency: 5 Hz", "frequency: 60 Hz", r"criteria\[0\].frequency.* 50 Hz.*E-CRIT-03"),
        ("histories: [floors,", "every: 12, histories: [floors,", r"criteria\[0\].frequency.* 12 .*E-CRIT-03"),
    ],
)
def test_what_a_study_cannot_answer_is_refused(old: str, new: str, said: str) -> None:
    assert TEXT.count(old) == 1
    study = parse_study(TEXT.replace(old, new), PATH, load_project(CASES / "any_quantity" / "project.yaml"))
    with pytest.raises(InputError, match=said):
        check_study_inputs(study, make_study_plan(study))


def test_a_part_of_the_plan_does_not_count_as_too_few_motions() -> None:
    study = load_study(PATH)
    check_study_inputs(study, make_study_plan(study, ["damped.DBE.slow"]))


def test_a_design_that_takes_less_than_the_maximum_of_few_motions_is_reported() -> None:
    """EN 1998-1, 4.3.3.4.3(3): the mean of seven. `ec8` and the maximum are that, 84 % of three is the largest."""
    criteria = "acceleration of floor 1, displacement of the roof, drift of storey 2, residual drift, shear of storey 1"
    oil = "{method: viscous, law: fluid, kind: chevron, bays: 1, damping: 5 %, verify: {levels: DBE, records: @, "
    designs = f"designs: {{oil: {oil}criteria: [equipment, {criteria}]}}}}}}\nvariants:"

    def reported(records: str) -> list[str]:
        text = TEXT.replace("variants:\n  bare", designs.replace("@", records) + "\n  bare")
        study = parse_study(text, PATH, load_project(CASES / "any_quantity" / "project.yaml"))
        return too_few_motions(study, "oil")

    median, mean = reported("[whole, slow, fast]")
    assert median.startswith("the criterion `acceleration of floor 1` takes the median of 3 motions, fewer than 7: ")
    assert mean.startswith("the criterion `residual drift` takes the mean of 3 motions") and "`statistic: code`" in mean
    assert reported("whole") == []  # every statistic of one is its maximum


def test_a_verification_keeps_what_its_criteria_need() -> None:
    study = load_study(PATH)
    verify = Verify(records=("whole",), criteria=("equipment", "velocity", "drift of storey 2"))
    assert kept_for_verification(study, verify).histories == ("floors",)  # velocities of dampers come of every step


@pytest.mark.parametrize("path", sorted(CASES.glob("*/project.yaml")), ids=lambda path: path.parent.name)
def test_names_of_dampers_are_those_of_the_frame(path: Path) -> None:
    project = load_project(path)
    frame = make_frame(project, dampers=True)
    assert list(names_of_dampers(project.frame, project.dampers)) == [device.name for device in frame.devices]
