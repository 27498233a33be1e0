"""Expected errors of `rts check` against runs of the loop, for laws from linear to friction and two kinds of rigs."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from benchmarks.expected_errors import LAWS, RIGS, compared
from edesign.archive.dataset import Group
from edesign.project.substructure import parse_rts_file
from edesign.substructure.advice.expectation import EFFECTIVE_AMPLITUDE, LinearModel
from edesign.substructure.advice.unstable_runs import AGREES
from edesign.substructure.sized_damper import SizedDamper
from edesign.substructure.virtual_tests import Direct, VirtualLaboratory

LINEAR = 0.03
"""Relative, of a linear damper. Left out: the ramps of the rig, and the acceleration by differences that a compensator
gets here; both are proportional to the square of the frequency times the step of 1 ms, 1e-3 at 5 Hz."""
ELASTOMER = 1.33
"""Factor. Beside its motion of 4.45 mm the thesis' damper has a loss stiffness k'' + A/2 dk''/dA of 1.65 kN/mm, 0.756
of that of the motion itself, 2.18 kN/mm; and an error at resonance follows the inverse of the damping, 1/0.756."""
FAST = ("Kelvin-Voigt", "MGMM", "viscous, power 0.3", "friction")
SLOW = [pytest.param(law, marks=pytest.mark.slow) for law in LAWS if law not in FAST]


@pytest.mark.parametrize("rig", RIGS)
@pytest.mark.parametrize("law", [*FAST, *SLOW])
def test_expected_errors_are_those_of_runs(law: str, rig: str) -> None:
    """Within the factor that an error beside a large motion may differ by, see AGREES."""
    for one in compared(law, rig):
        ratio = one.found / one.expected
        if law == "Kelvin-Voigt":
            assert ratio == pytest.approx(1.0, abs=LINEAR), one
            assert one.nonlinear < 0.05
        else:
            factor = ELASTOMER if law == "MGMM" else AGREES
            assert 1.0 / factor < ratio < factor, one


def test_the_share_that_is_not_linear_of_friction_in_a_sine() -> None:
    """The first harmonic of a square wave has 4/pi of its size, and 8/pi^2 of its mean square.

    At 0.65 of the amplitude the equivalent dashpot is 1/0.65 as large: 1 + 8/pi^2 (1/0.65^2 - 2/0.65) is left.
    """
    text = (
        "edesign_rts: 1\nstructure: {masses: [100 t], stiffnesses: [60 kN/mm], damping: {kind: modal, ratio: 5 %}}\n"
        "specimen: {law: {type: friction, parameters: {mu: 0.3, N: 10 kN, k: 1000 kN/mm}}}\n"
        "rig: {kind: ideal}\ncompensators: {none: {kind: none}}\n"
    )
    laboratory = VirtualLaboratory(parse_rts_file(text, Path("rts.yaml")))
    omega, time = 2.0 * np.pi * 2.0, np.arange(0.0, 20.0, 1e-3)
    motion = 5e-3 * np.sin(omega * time)
    damper = SizedDamper(laboratory.damper.values, laboratory.damper.scales)
    force = damper.force(time, motion, 5e-3 * omega * np.cos(omega * time))
    model = LinearModel.of(laboratory, motion, laboratory.laboratory.structure.part)  # type: ignore[union-attr]
    direct = Direct(motion, force, np.zeros((time.size, 0)), Group())
    left = math.sqrt(1.0 + 8.0 / math.pi**2 * (1.0 / EFFECTIVE_AMPLITUDE**2 - 2.0 / EFFECTIVE_AMPLITUDE))
    # it sticks for the 6 um of its own deformation, 2 acos(1 - 2 x 3/5000) of a half-cycle's pi: 2 %
    assert model.nonlinear_share(direct) == pytest.approx(left, rel=0.03)
