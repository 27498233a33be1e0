"""Which forms of effects a campaign can show: by its tests, their uses and their temperatures."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from damper_problems import problem

from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.dampers.sizes import Sizes
from edesign.damper.testing.measured_histories import Use


def labels(tests: DamperProblem, name: str) -> set[str]:
    """Labels of an effect's forms that are sought in tests."""
    known = replace(tests, typical=Sizes.of(tests.experiments))
    return {one.label for one in known.effects if one.name == name}


def test_a_gain_that_changes_has_a_form_for_each_place_that_fitted_tests_determine() -> None:
    tests = problem(tests=7)
    uses: tuple[Use, ...] = ("fit", "validate", "validate", "fit", "fit", "validate", "fit")
    tests = tests.with_experiments([replace(one, use=use) for one, use in zip(tests.experiments, uses, strict=True)])
    # a gain in the first test alone, or in the last one, is that of one test
    reported = ("from_test_5", "of_test_1", "of_test_4", "of_test_5", "of_test_7")
    places = {f"gain.{channel}_{place}" for channel in ("force", "displacement") for place in reported}
    assert labels(tests, "gain") == {"gain.force", "gain.displacement", *places}
    by_label = {one.label: one for one in replace(tests, typical=Sizes.of(tests.experiments)).effects}
    assert [one.form for one in by_label["gain.force_of_test_1"].confounded] == [
        "force_of_test_1",  # tests that are not fitted to may be before or after the change
        *(f"force_to_test_{last}" for last in (2, 3)),
    ]
    assert [one.form for one in by_label["gain.force_of_test_7"].confounded] == [
        "force_of_test_7",
        "force_from_test_6",
    ]
    assert by_label["gain.force_of_test_4"].confounded == ()
    assert [by_label[f"gain.force_of_test_{k}"].tests for k in (1, 4, 5, 7)] == [(0,), (1,), (2,), (3,)]
    assert by_label["gain.force_from_test_5"].tests == (2, 3)
    assert by_label["gain.force_of_test_4"].log_prior == -np.log(4.0)
    assert by_label["gain.force_from_test_5"].log_prior == by_label["gain.force"].log_prior == 0.0


def test_a_place_that_fitted_tests_leave_open_is_one_of_those_that_others_separate() -> None:
    tests = problem(tests=6)
    uses: tuple[Use, ...] = ("fit", "fit", "validate", "validate", "fit", "fit")
    tests = tests.with_experiments([replace(one, use=use) for one, use in zip(tests.experiments, uses, strict=True)])
    tests = replace(tests, typical=Sizes.of(tests.experiments))
    by_label = {one.label: one for one in tests.effects}
    assert by_label["gain.force_of_test_2"].confounded == ()
    reported = by_label["gain.force_from_test_3_to_5"].confounded
    assert [one.label for one in reported] == [f"gain.force_from_test_{first}" for first in (3, 4, 5)]
    values = np.array([[*tests.declared.values(), 0.1]])
    for first, one in zip((3, 4, 5), reported, strict=True):
        (forces,) = tests.model((one,), ("fit", "validate")).forces(values)
        ratios = [float(np.max(f) / np.max(test.force)) for f, test in zip(forces, tests.experiments, strict=True)]
        assert ratios == pytest.approx([1.1 if order >= first else 1.0 for order in range(1, 7)], abs=1e-3)


def test_three_tests_show_nothing_that_changes_between_them_alone() -> None:
    """A line through three levels has one more to show how tests scatter. One of three may be wrong, one of two not."""
    tests = problem(tests=4)
    uses: tuple[Use, ...] = ("fit", "fit", "fit", "validate")
    three = tests.with_experiments([replace(one, use=use) for one, use in zip(tests.experiments, uses, strict=True)])
    of_one = {f"gain.{channel}_of_test_{k}" for channel in ("force", "displacement") for k in (1, 2, 3)}
    assert labels(three, "ageing") == set() and labels(three, "gain") == {"gain.force", "gain.displacement", *of_one}
    two = tests.with_experiments(
        [replace(one, use="fit" if i < 2 else "validate") for i, one in enumerate(tests.experiments)]
    )
    assert labels(two, "gain") == {"gain.force", "gain.displacement"} and labels(two, "clock") == set()
    four = tests.with_experiments([replace(one, use="fit") for one in tests.experiments])
    assert "ageing.linear" in labels(four, "ageing") and "gain.force_from_test_3" in labels(four, "gain")


@pytest.mark.parametrize(
    ("degrees", "shown"),
    [
        ((20.0, 20.3, 19.6), False),  # readings of one temperature
        ((20.0, 21.9, 20.0), False),
        ((20.0, 22.1, 20.0), True),
        ((20.0, 20.0, 20.0, 40.0), False),  # the last test validates
    ],
)
def test_laws_of_the_temperature_need_tests_at_several(degrees: tuple[float, ...], shown: bool) -> None:
    tests = problem(tests=4, degrees=degrees)
    assert bool(labels(tests, "temperature_law")) == shown


def test_three_temperatures_determine_no_width_of_a_transition() -> None:
    """Depth, middle and width are three numbers beside the force at the reference."""
    for degrees, names in (((20.0, 30.0, 20.4, 35.0, 30.5), ["d", "Tc"]), ((20.0, 30.0, 25.0, 35.0), ["d", "Tc", "w"])):
        tests = problem(tests=6, degrees=degrees)
        (transition,) = (one for one in tests.effects if one.label == "temperature_law.transition")
        assert [one.name for one in transition.parameters] == names
        if "w" in names:  # no transition is sharper than a thermometer sees, which may be 0.2 K off either way
            assert transition.parameters[2].lower > 0.4
