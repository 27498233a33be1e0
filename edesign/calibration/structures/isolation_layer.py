"""The isolation layer of a building on its own: its measured drift and inertia force are a damper test."""

from __future__ import annotations

import numpy as np

from edesign.calibration.structures.campaign import StructureCampaign
from edesign.damper.testing.measured_histories import DamperTest
from edesign.errors import InputError


def isolation_layer_tests(campaign: StructureCampaign, temperature_C: float = 20.0) -> tuple[DamperTest, ...]:
    """Tests of the isolation layer: displacement of the lowest floor, and F = -sum m_i a_i of all floors.

    What is above the layer needs no model, so the equation error in F is right for laws of the layer. Forces scale
    with the declared masses.

    Args:
        campaign: of an isolated building; accelerations of all floors and the displacement of the lowest are measured.
        temperature_C: of the layer.

    Raises:
        InputError: the base is fixed, or a channel is missing.
    """
    if not campaign.building.isolated:
        raise InputError(f"{campaign.path}: a building on a fixed base has no isolation layer")
    found = []
    for test in campaign.tests:
        drift = test.column("displacement", 0)
        if drift is None:
            raise InputError(f"{test.source}: the drift of the layer is needed: the displacement of floor 1")
        force = np.zeros(test.base.size)
        for floor, mass in enumerate(campaign.building.masses):
            acceleration = test.column("acceleration", floor)
            if acceleration is None:
                raise InputError(f"{test.source}: the acceleration of floor {floor + 1} is needed for the force")
            force -= mass * acceleration
        found.append(
            DamperTest(test.name, test.time, drift, force, temperature_C, None, test.title, test.use, test.source)
        )
    return tuple(found)
