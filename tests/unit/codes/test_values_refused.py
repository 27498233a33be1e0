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
from edesign.codes.ec8.design import DesignSpectrum
from edesign.codes.ec8.importance import factor_of_probability
from edesign.codes.ec8.lateral_force import lateral_forces
from edesign.codes.ec8.moment_frames import rotation_capacity
from edesign.codes.ec8.target_displacement import equivalent_oscillator
from edesign.codes.fema356.steel import COMPACT
from edesign.codes.ntc2018 import NtcDesignSpectrum, NtcSpectrum, Site
from edesign.errors import InputError

CORNERS = (0.2, 0.6, 2.0)
NAN = float("nan")


@pytest.mark.parametrize(
    ("clause", "said"),
    [
        (lambda: smallest_property_factor(ageing=1.2), "ageing is 1.2; greater than 0 and at most 1"),
        (lambda: smallest_property_factor(test=0.0), "test is 0; greater than 0"),
        (lambda: damping_coefficient(5.0), "between 0 and 1, such as 0.05 for 5 %, not 5"),
        (lambda: slenderness(1e-3, 275e6, 0.0), "M_cr: 0 is not greater than zero"),
        (lambda: thickness_step("S275", 0.02, "en10025-9"), "no table of steels `en10025-9`"),  # type: ignore
        (lambda: linear_moment_factor_a(1.5, 1e5, 1e6), "psi: 1.5 is not between -1 and 1"),
        (lambda: DesignSpectrum(3.0, 1.2, CORNERS, q=0.9), "q must be at least 1, not 0.9"),
        (lambda: DesignSpectrum(3.0, 1.2, CORNERS, q=NAN), "q must be at least 1, not nan"),
        (lambda: DesignSpectrum(3.0, 1.2, CORNERS, q=4.0, beta=-0.2), "beta must be at least 0, not -0.2"),
        (lambda: NtcDesignSpectrum(NtcSpectrum(2.5, 2.5, 0.3, Site("C")), q=0.5), "q must be at least 1, not 0.5"),
        (lambda: Site("F"), "no category of subsoil `F`"),
        (lambda: factor_of_probability(0.02, k=1e-3), "with the exponent k = 0.001 .* is generally of the order of 3"),
        (lambda: lateral_forces(1e5, np.ones(2), np.array([1.0, -1.0])), "the masses have no displacement"),
        (lambda: rotation_capacity("highest", 4.0), "no ductility class `highest`"),
        (
            lambda: equivalent_oscillator(np.array([-3.0, 1.0]), np.array([1e4, 1e4])),
            "the lateral forces act against the displacement of the roof",
        ),
        (lambda: COMPACT.allowed("OP"), "no performance level `OP`"),
    ],
)
def test_a_value_that_no_clause_has_is_refused(clause: Callable[[], object], said: str) -> None:
    with pytest.raises(InputError, match=said):
        clause()
