"""Response measures of envelopes whose extremes are known: each is the largest absolute value, on either side."""

from __future__ import annotations

import pytest
from unit.assess.known_history import known_history, known_modes

from edesign.archive.dataset import Group
from edesign.assess.measures import response_measures
from edesign.assess.profile import storey_profile
from edesign.project.criteria.measures import MEASURES

KNOWN = {
    "roof_displacement_m": 0.21,  # the minimum, -0.21, is the larger side
    "residual_roof_displacement_m": 0.02,
    "final_roof_displacement_m": 0.03,
    "roof_drift": 0.21 / 7.0,
    "interstorey_drift": 0.057,
    "residual_interstorey_drift": 0.0033,
    "final_interstorey_drift": 0.0133,
    "base_shear_N": 3e5,
    "column_base_shear_N": 3e5,  # storey 1
    "roof_acceleration_m_s2": 5.0,  # of the roof, although floor 1 has 7.0
    "relative_roof_acceleration_m_s2": 6.0,
    "beam_plastic_rotation_rad": 0.011,
    "column_plastic_rotation_rad": 0.002,
    "column_axial_force_N": 9e5,  # compression
    "brace_ductility": None,  # it has none that buckle
    "brace_damage": None,
    "damper_strain": None,  # it has none
    "damper_deformation_m": None,
    "damper_force_N": None,
}


def test_measures_of_a_history() -> None:
    found = response_measures(known_history())
    assert tuple(found) == tuple(MEASURES) == tuple(KNOWN)
    assert found == {k: pytest.approx(v, rel=1e-15) if v is not None else None for k, v in KNOWN.items()}
    assert all(type(value) is float for value in found.values() if value is not None)  # JSON takes no numpy numbers


def test_what_does_not_apply_is_none() -> None:
    assert set(response_measures(known_modes()).values()) == {None}
    assert set(response_measures(Group()).values()) == {None}
    pushover = response_measures(known_history("pushover"))
    names = ("roof_displacement_m", "interstorey_drift")
    left = {f"{which}_{name}" for which in ("residual", "final") for name in names}
    none = left | {"roof_acceleration_m_s2", "relative_roof_acceleration_m_s2"}
    dampers = {"brace_ductility", "brace_damage", "damper_strain", "damper_deformation_m", "damper_force_N"}
    assert {name for name, value in pushover.items() if value is None} == none | dampers


def test_a_failed_history_has_peaks_but_no_residuals() -> None:
    found = response_measures(known_history(status="failed"))
    assert found["roof_displacement_m"] == 0.21
    assert found["residual_roof_displacement_m"] is None and found["residual_interstorey_drift"] is None
    assert found["final_roof_displacement_m"] is None and found["final_interstorey_drift"] is None


def test_profile_goes_from_the_lowest_storey_up() -> None:
    found = storey_profile(known_history())
    assert found["floor_displacement"].tolist() == [0.05, 0.21]
    assert found["storey_drift"].tolist() == [0.0125, 0.057]
    assert found["residual_storey_drift"].tolist() == [0.0025, 0.0033]
    assert found["storey_shear"].tolist() == [3e5, 1e5]
    assert found["floor_acceleration"].tolist() == [7.0, 5.0]
    assert storey_profile(known_modes()) == {}
