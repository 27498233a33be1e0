"""Response measures of one analysis: the numbers that tables, JSON and performance checks compare."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.envelopes import peak, residual

MEASURES = (
    "roof_displacement_m",
    "residual_roof_displacement_m",
    "roof_drift",
    "interstorey_drift",
    "residual_interstorey_drift",
    "base_shear_N",
    "roof_acceleration_m_s2",
    "beam_plastic_rotation_rad",
    "column_plastic_rotation_rad",
    "column_axial_force_N",
    "damper_strain",
    "damper_deformation_m",
    "damper_force_N",
)
"""Names of all response measures; the unit ends the name, ratios have none."""


def response_measures(group: Group) -> dict[str, float | None]:
    """Compute the response measures of an analysis from its envelopes.

    All are absolute values, the largest over time and over floors, storeys, members and member ends. Displacements are
    relative to the ground, the acceleration is total. Residual values are means over the last fundamental period of a
    history, so that what is left of the free vibration does not count. Rotations are plastic rotations of member ends;
    the axial force is of columns, gravity included; the strain of dampers is the shear of their layers.

    Args:
        group: results of one analysis, as archived.

    Returns:
        One value in SI for each name of MEASURES; None where it does not apply: everything of a modal analysis, the
        acceleration of a static one, residual values of anything but a completed history.
    """
    floors, storeys = peak(group, "floor_displacement"), peak(group, "storey_drift")
    height = group.attributes.get("height")
    roof = _last(floors)
    found: dict[str, float | None] = dict.fromkeys(MEASURES)
    found["roof_displacement_m"] = roof
    found["residual_roof_displacement_m"] = _largest(residual(group, "roof_displacement"))
    found["roof_drift"] = roof / float(height) if roof is not None and height else None
    found["interstorey_drift"] = _largest(storeys)
    found["residual_interstorey_drift"] = _largest(residual(group, "storey_drift"))
    found["base_shear_N"] = _largest(peak(group, "base_shear"))
    found["roof_acceleration_m_s2"] = _last(peak(group, "floor_acceleration"))
    found["beam_plastic_rotation_rad"] = _largest(peak(group, "beam_plastic_rotation"))
    found["column_plastic_rotation_rad"] = _largest(peak(group, "column_plastic_rotation"))
    found["column_axial_force_N"] = _largest(peak(group, "column_axial_force"))
    found["damper_strain"] = _largest(peak(group, "damper_strain"))
    found["damper_deformation_m"] = _largest(peak(group, "damper_deformation"))
    found["damper_force_N"] = _largest(peak(group, "damper_force"))
    return found


def _largest(values: np.ndarray | None) -> float | None:
    return None if values is None or values.size == 0 else float(np.max(values))


def _last(values: np.ndarray | None) -> float | None:
    """The value of the roof: floors are stored from the bottom to the top."""
    return None if values is None or values.size == 0 else float(values[-1])
