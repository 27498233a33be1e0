"""Tables of dampers from an archived run."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.archive.dataset import Group, Variable
from edesign.assess.measures import response_measures
from edesign.report.response.damper_results import (
    amplitude_notes,
    damper_stiffness_table,
    dampers_table,
    each_damper_table,
)


@pytest.fixture
def group() -> Group:
    """Two dampers; the second deforms most, and both together take 30 of 40 kJ."""
    found = Group()
    found.coords["damper"] = Variable(("damper",), np.array(["V_1_1", "V_1_2"]), "", "name")
    found.coords["energy_term"] = Variable(("energy_term",), np.array(["input", "dampers"]), "", "term")
    found.add("damper_storey", ("damper",), [1, 2], "1", "storey")
    for name, largest, smallest in (
        ("damper_force", [50e3, 20e3], [-60e3, -10e3]),
        ("damper_deformation", [2e-3, 9e-3], [-1e-3, -3e-3]),
        ("damper_strain", [0.02, 0.09], [-0.01, -0.03]),
    ):
        found.add(f"{name}_max", ("damper",), largest, "1", name)
        found.add(f"{name}_min", ("damper",), smallest, "1", name)
    found.add("damper_work_final", ("damper",), [10e3, 20e3], "J", "work")
    found.add("energy_final", ("energy_term",), [40e3, 30e3], "J", "energy")
    found.add("energy_before", ("energy_term",), [50e3, 0.0], "J", "energy that gravity has put in")
    return found


def test_the_table_of_analyses_has_the_largest_of_all_dampers(group):
    table = dampers_table({"damped": group, "bare": Group()})
    assert table.texts == [["damped", "9.000", "9.000", "60.00", "V_1_2", "30.00", "75.00"]]


def test_every_damper_has_its_row(group):
    table = each_damper_table("damped", group)
    assert table.texts[0] == ["V_1_1", "1", "2.000", "2.000", "60.00", "10.00"]
    assert table.texts[1][:2] == ["V_1_2", "2"]


def test_frames_without_dampers_have_no_tables():
    empty = Group()
    assert not each_damper_table("bare", empty).rows
    assert not damper_stiffness_table("bare", empty).rows
    assert not dampers_table({"bare": empty}).rows


def test_measures_take_the_largest_of_both_signs(group):
    measures = response_measures(group)
    assert measures["damper_force_N"] == 60e3
    assert measures["damper_deformation_m"] == 9e-3
    assert measures["damper_strain"] == 0.09


def test_stiffness_in_modes():
    found = Group(attributes={"damper_frequency_Hz": 2.0})
    found.coords["damper"] = Variable(("damper",), np.array(["V_1_1"]), "", "name")
    found.add("damper_storage_stiffness", ("damper",), [7.1e6], "N/m", "stiffness")
    found.add("damper_loss_factor", ("damper",), [0.35], "1", "loss factor")
    found.add("damper_amplitude", ("damper",), [0.02], "m", "amplitude")
    table = damper_stiffness_table("modes", found)
    assert table.texts == [["V_1_1", "7.100", "0.3500", "20.00"]]
    assert "2 Hz" in table.notes[0] and amplitude_notes(found) == []
    found.add("damper_loss_factor", ("damper",), [np.nan], "1", "of a dashpot there is none")
    assert damper_stiffness_table("modes", found).rows[0][2] is None
    found.attributes["dampers_in_small_vibrations"] = ["V_1_1"]
    assert amplitude_notes(found) == ["1 of 1 dampers count in small vibrations: no `design_deformation` is given"]
