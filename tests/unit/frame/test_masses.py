"""Nodal masses, given and from loads."""

from __future__ import annotations

import pytest
from unit.frame.recording_model import built, project

from edesign.errors import InputError
from edesign.frame.masses import node_masses

G = 9.80665  # m/s2


def test_masses_from_loads_are_tributary() -> None:
    """G + 0.2 Q = 22 kN/m on bays of 6 m and 7.5 m; 4 kN/m more in bay 2 and 50 kN on line A at floor 2."""
    expected = {
        "A1": 22e3 * 3.0,
        "B1": 22e3 * 6.75,
        "C1": 22e3 * 3.75,
        "A2": 22e3 * 3.0 + 50e3,
        "B2": 22e3 * 6.75 + 4e3 * 3.75,
        "C2": 26e3 * 3.75,
    }
    found = node_masses(project())
    assert found == pytest.approx({node: weight / G for node, weight in expected.items()}, rel=1e-13)
    assert sum(found.values()) * G == pytest.approx(2 * 22e3 * 13.5 + 4e3 * 7.5 + 50e3, rel=1e-13)


def test_given_masses() -> None:
    given = "given: [{lines: B, floors: all, mass: 29.5 t}, {lines: [A, C], floors: 2, mass: 10 t}]"
    found = node_masses(project(("{from_loads: {G: 1.0, Q: 0.2}}", f"{{{given}}}")))
    assert found == {"B1": 29500.0, "B2": 29500.0, "A2": 10000.0, "C2": 10000.0}


def test_the_directions_of_masses() -> None:
    frame, model = built()
    assert [call[:4] for call in model.get("mass")][0] == (
        frame.nodes["A1"],
        frame.masses["A1"],
        frame.masses["A1"],
        0.0,
    )
    frame, model = built(("{from_loads: {G: 1.0, Q: 0.2}}", "{from_loads: {G: 1.0}, directions: horizontal}"))
    assert all(call[2] == 0.0 and call[1] > 0.0 for call in model.get("mass"))


def test_a_project_without_masses_has_none() -> None:
    assert node_masses(project(("masses: {from_loads: {G: 1.0, Q: 0.2}}\n", ""))) == {}


def test_loads_upwards_give_no_mass() -> None:
    with pytest.raises(InputError, match="node A2 .*E-MASS-01"):
        node_masses(project(("G: 50 kN", "G: -500 kN")))
