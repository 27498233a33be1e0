"""Warnings of analyses: kept with the result, printed once for analyses that are alike."""

from __future__ import annotations

from edesign.archive.dataset import Group
from edesign.study.results.warnings import AnalysisWarning, store_warnings, warning_lines, warnings_of


def warned(*warnings: AnalysisWarning) -> Group:
    group = Group()
    store_warnings(group, warnings)
    return group


def test_warnings_are_kept_with_the_analysis() -> None:
    strained, energy = AnalysisWarning("damper_strain", "V_1_1", 1.2), AnalysisWarning("energy_error", "2 %", 2.0)
    group = warned(strained)
    store_warnings(group, [energy])
    assert warnings_of(group) == [strained, energy]
    assert warnings_of(Group()) == []
    assert warnings_of(Group(attributes={"warnings": ["a sentence, as designs have them"]})) == []


def test_analyses_that_are_alike_are_reported_once_with_the_worst() -> None:
    groups = {
        "a": warned(AnalysisWarning("damper_strain", "V_1_1 to 60 %", 1.2)),
        "b": warned(
            AnalysisWarning("damper_strain", "V_1_2 to 80 %", 1.6), AnalysisWarning("energy_error", "2 %", 2.0)
        ),
        "c": warned(),
    }
    assert warning_lines(groups) == [
        "b: 2 %",
        "in 2 of 3 analyses dampers strain beyond the tests of their law, most in b: V_1_2 to 80 %",
    ]
    assert warning_lines({"c": Group()}) == []
