"""Values that no clause has: each is refused by a sentence that says the value and what is allowed."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from edesign.codes.asce7.damping_devices import smallest_property_factor
from edesign.codes.asce7.spectrum import damping_coefficient
from edesign.codes.ec3.lateral_torsional import slenderness
from edesign.codes.ec3.materials import thickness_step
from edesign.codes.ec3.moment_factors import linear_moment_factor_a
from edesign.codes.ec8.action.design import DesignSpectrum
from edesign.codes.ec8.action.importance import factor_of_probability
from edesign.codes.ec8.analysis.lateral_force import lateral_forces
from edesign.codes.ec8.analysis.target_displacement import equivalent_oscillator
from edesign.codes.ec8.steel.moment_frames import rotation_capacity
from edesign.codes.fema356.steel import COMPACT
from edesign.codes.ntc2018 import NtcDesignSpectrum, NtcSpectrum, Site
from edesign.errors import InputError

CORNERS = (0.2, 0.6, 2.0)
NAN = float("nan")


@pytest.mark.parametrize(
    ("clause", "said"),
    [
        (lambda: smallest_property_factor(ageing=1.2), "ageing is 1.2; .*E-VALUE-02"),
        (lambda: smallest_property_factor(test=0.0), "test is 0; .*E-VALUE-02"),
        (lambda: damping_coefficient(5.0), "not 5 .E-VALUE-02"),
        (lambda: slenderness(1e-3, 275e6, 0.0), "M_cr: 0 .*E-VALUE-02"),
        (lambda: thickness_step("S275", 0.02, "en10025-9"), "`en10025-9`.*E-NAME-01"),  # type: ignore
        (lambda: linear_moment_factor_a(1.5, 1e5, 1e6), "psi: 1.5 .*E-VALUE-02"),
        (lambda: DesignSpectrum(3.0, 1.2, CORNERS, q=0.9), "q .* 0.9 .*E-VALUE-02"),
        (lambda: DesignSpectrum(3.0, 1.2, CORNERS, q=NAN), "q .* nan .*E-VALUE-02"),
        (lambda: DesignSpectrum(3.0, 1.2, CORNERS, q=4.0, beta=-0.2), "beta .* -0.2 .*E-VALUE-02"),
        (lambda: NtcDesignSpectrum(NtcSpectrum(2.5, 2.5, 0.3, Site("C")), q=0.5), "q .* 0.5 .*E-VALUE-02"),
        (lambda: Site("F"), "`F`.*E-NAME-01"),
        (lambda: factor_of_probability(0.02, k=1e-3), "k = 0.001 .*E-EC8-03"),
        (lambda: lateral_forces(1e5, np.ones(2), np.array([1.0, -1.0])), "E-EC8-06"),
        (lambda: rotation_capacity("highest", 4.0), "`highest`.*E-NAME-01"),
        (
            lambda: equivalent_oscillator(np.array([-3.0, 1.0]), np.array([1e4, 1e4])),
            "E-EC8-06",
        ),
        (lambda: COMPACT.allowed("OP"), "`OP`.*E-NAME-01"),
    ],
)
def test_a_value_that_no_clause_has_is_refused(clause: Callable[[], object], said: str) -> None:
    with pytest.raises(InputError, match=said):
        clause()
