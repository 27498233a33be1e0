"""Natural modes of a storey with a dashpot behind a spring: linear, of a power, and of no amplitude."""

from __future__ import annotations

import numpy as np
import pytest
from design_examples import shear_project

from edesign.archive.dataset import Group
from edesign.project.analysis.analyses import ModalAnalysis
from edesign.report.response.damper_results import amplitude_notes
from edesign.study.analysis.modal import run_modal
from edesign.study.results.warnings import warnings_of

C, SPRING = 2e5, 4e7  # N s/m, N/m


def modes(law: str, extra: str = "brace: {stiffness: 40 kN/mm}") -> Group:
    """Of a shear frame of one storey with a damper of this law, whose c is 200 kN (s/m)^alpha."""
    device = f"{{kind: storey, bays: 1, storeys: 1, law: tried, {extra}}}"
    text = f"dampers:\n  laws:\n    tried: {law}\n  devices: [{device}]\n"
    return run_modal(shear_project(1, text), ModalAnalysis(kind="modal", name="modes", modes=1, state="initial"))


def bare() -> float:
    """Circular frequency without dampers, rad/s."""
    spec = ModalAnalysis(kind="modal", name="modes", modes=1, state="initial", dampers=False)
    return float(run_modal(shear_project(1), spec).variables["circular_frequency"].values[0])


@pytest.mark.parametrize(
    "law",
    [
        "{type: viscous, parameters: {c: 200 kN*s/m}}",
        "{type: viscous_power, parameters: {c: 200 kN*(s/m)^1, alpha: 1}}",
    ],
)
def test_linear_dashpot_behind_a_brace_is_a_maxwell_body_whatever_the_amplitude(law: str) -> None:
    """omega^2 m = k + k_b x^2 / (1 + x^2) with x = omega c / k_b; m and k are those of the modal analysis without."""
    found = modes(law)
    omega = found.variables["circular_frequency"].values[0]
    x = omega * C / SPRING
    stiffness = found.variables["damper_storage_stiffness"].values[0]
    # a two-hundredth of the whole, whose first harmonic is exact to 1e-6
    assert stiffness == pytest.approx(SPRING * x**2 / (1.0 + x**2), rel=2e-4)
    assert omega > bare() and warnings_of(found) == []


@pytest.mark.parametrize(
    ("law", "extra"),
    [
        ("{type: viscous_power, parameters: {c: 200 kN*(s/m)^0.35, alpha: 0.35}}", "brace: {stiffness: 40 kN/mm}"),
        ("{type: maxwell_power, parameters: {c: 200 kN*(s/m)^0.35, alpha: 0.35, k: 40 kN/mm}}", "number: 1"),
        (
            "{type: asymmetric_viscous, "
            "parameters: {c_plus: 200 kN*(s/m)^0.35, c_minus: 90 kN*(s/m)^0.35, alpha: 0.35}}",
            "brace: {stiffness: 40 kN/mm}",
        ),
    ],
)
def test_dashpot_of_a_power_without_amplitude_is_left_out_and_reported(law: str, extra: str) -> None:
    """In ever smaller vibrations it is as stiff as its spring, in ever larger ones it is nothing."""
    found = modes(law, extra)
    assert found.variables["circular_frequency"].values[0] == pytest.approx(bare(), rel=1e-12)
    assert np.isnan(found.variables["damper_amplitude"].values[0])
    (warning,) = warnings_of(found)
    assert warning.kind == "damper_amplitude" and "`S_1_1` is left out of the modes" in warning.text
    assert amplitude_notes(found) == [
        "1 of 1 dampers are left out: their stiffness depends on the amplitude (alpha < 1), and "
        "no `design_deformation` is given"
    ]
    small, large = (
        modes(law, f"{extra}, design_deformation: {u}").variables["damper_storage_stiffness"].values[0]
        for u in ("0.001 mm", "1 m")
    )
    assert small == pytest.approx(SPRING, rel=1e-3) and abs(large) < 0.01 * SPRING


def test_dashpot_of_a_power_alone_has_no_stiffness_to_leave_out() -> None:
    found = modes("{type: viscous_power, parameters: {c: 200 kN*(s/m)^0.35, alpha: 0.35}}", "brace: rigid")
    assert found.variables["circular_frequency"].values[0] == pytest.approx(bare(), rel=1e-9)
    assert warnings_of(found) == [] and amplitude_notes(found) == []


def test_damper_whose_stiffness_depends_on_an_amplitude_that_is_not_given_is_noted() -> None:
    law = "{type: elastic_plastic, parameters: {k: 20 kN/mm, Fy: 100 kN, b: 0.02}}"
    found = modes(law, "brace: rigid")
    assert amplitude_notes(found) == ["1 of 1 dampers count in small vibrations: no `design_deformation` is given"]
    assert amplitude_notes(modes(law, "design_deformation: 10 mm")) == []
