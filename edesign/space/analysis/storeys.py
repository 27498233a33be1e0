"""Storeys under the seismic action: second-order effects and damage limitation.

EN 1998-1:2004, 4.4.2.2 and 4.4.3.2; NTC 2018, 7.3.1, 7.3.3.3 and 7.3.6.1.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from edesign.codes.ec8.analysis.design_displacement import design_displacement
from edesign.codes.ec8.verification.drift import drift_limit, reduced_drift
from edesign.codes.ec8.verification.second_order import LARGEST, NEGLIGIBLE, drift_sensitivity
from edesign.codes.ntc2018.displacement import displacement_ductility
from edesign.codes.ntc2018.drift import limit_of_drift
from edesign.project.building.design import Design
from edesign.space.analysis.response import SeismicResponse, corner_period
from edesign.space.structure.frame import Axis


@dataclass(frozen=True)
class Storeys:
    """The storeys of a building under the seismic action in one direction; all arrays are (n_storeys,), from below.

    Attributes:
        axis: of the action.
        height: m.
        gravity: P_tot, N.
        shear: V_tot, N.
        drift: d_r, design interstorey drift, m: as `design.displacement` says; by NTC 2018 mu_d d_e.
        drift_q: q_d d_e without the cap of the elastic spectrum, m.
        theta, theta_q: interstorey drift sensitivity with either.
        amplification: factor on the effects of the action for second-order effects.
        reduced: nu d_r / h; by NTC 2018 q d_r / h under SLD or SLO.
        limit: of `reduced`; None where the file asks for none.
    """

    axis: Axis
    height: np.ndarray
    gravity: np.ndarray
    shear: np.ndarray
    drift: np.ndarray
    drift_q: np.ndarray
    theta: np.ndarray
    theta_q: np.ndarray
    amplification: np.ndarray
    reduced: np.ndarray
    limit: float | None


def storeys(
    response: SeismicResponse, height: np.ndarray, gravity: np.ndarray, design: Design, class_of_use: str = ""
) -> Storeys:
    """Return the storeys of one direction.

    theta above 0.2 asks for an analysis of second order and above 0.3 is not allowed (4.4.2.2(3), (4)). The factor
    1/(1 - theta) is applied up to 0.3 all the same, so that the other checks are of use; a theta above 0.2 fails its
    own check.

    Args:
        response: of this direction.
        height: (n_storeys,) m.
        gravity: (n_storeys,) P_tot in the seismic design situation, N.
        class_of_use: of NTC 2018, whose rules then count; the elastic drifts of the response are those of SLD or SLO.
    """
    q, kind = response.spectrum.q, design.drift.limit
    drift_q = design_displacement(response.drift, q)
    if class_of_use:
        mu_d = displacement_ductility(q, response.T_1, corner_period(response.spectrum))
        drift = design_displacement(response.drift, mu_d)
        reduced = reduced_drift(response.drift_elastic, height, 1.0)
        limit = None if kind == "none" else limit_of_drift(kind, class_of_use)
    else:
        capped = design_displacement(response.drift, q, response.drift_elastic)
        drift = capped if design.displacement == "elastic_cap" else drift_q
        reduced = reduced_drift(drift, height, design.drift.nu)
        limit = None if kind == "none" else drift_limit(kind)
    theta = drift_sensitivity(gravity, drift, response.storey_shear, height)
    counted = np.where((theta > NEGLIGIBLE) & (design.second_order == "amplify"), np.minimum(theta, LARGEST), 0.0)
    return Storeys(
        axis=response.axis,
        height=height,
        gravity=gravity,
        shear=response.storey_shear,
        drift=drift,
        drift_q=drift_q,
        theta=theta,
        theta_q=drift_sensitivity(gravity, drift_q, response.storey_shear, height),
        amplification=1.0 / (1.0 - counted),
        reduced=reduced,
        limit=limit,
    )
