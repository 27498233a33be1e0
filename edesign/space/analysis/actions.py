"""The load cases of a building as actions of EN 1990: permanent and variable ones, with their factors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from edesign.codes.ec8.national import ActionFactors, NationalParameters, Psi
from edesign.codes.en1990.actions import PERMANENT
from edesign.project.building.building import Building
from edesign.project.building.design import Design
from edesign.space.structure.frame import LoadCase, SpaceFrame
from edesign.space.structure.masses import psi_2


def with_joined_cases(frame: SpaceFrame) -> SpaceFrame:
    """Return the frame with its permanent cases as one, `G`, and a single category of use as `Q`."""
    permanent = [case for case in frame.cases.values() if case.category == PERMANENT]
    variable = [case for case in frame.cases.values() if case.category != PERMANENT]
    cases = {"G": _sum("G", permanent)} | {case.name: case for case in variable}
    if len(variable) == 1:
        cases = {"G": cases["G"], "Q": replace(variable[0], name="Q")}
    return frame.with_sections(frame.members, cases, frame.node_mass)


def _sum(name: str, cases: Sequence[LoadCase]) -> LoadCase:
    return LoadCase(
        name,
        PERMANENT,
        nodal=np.sum([case.nodal for case in cases], axis=0),
        uniform=np.sum([case.uniform for case in cases], axis=0),
        point_member=np.concatenate([case.point_member for case in cases]),
        point_position=np.concatenate([case.point_position for case in cases]),
        point_force=np.concatenate([case.point_force for case in cases]),
    )


def action_factors_of(design: Design, national: NationalParameters) -> ActionFactors:
    """Return the national partial factors with gamma_G and gamma_Q of the file."""
    return replace(national.action_factors, G_sup=design.partial_factors.G, Q=design.partial_factors.Q)


def psi_of(building: Building, national: NationalParameters) -> dict[str, Psi]:
    """Return the national psi factors; psi_2 is that of the masses where the file gives it."""
    psi = dict(national.psi)
    masses = building.masses
    if masses is not None and masses.from_loads is not None:
        for category in {load.category for load in building.loads.items if load.category is not None}:
            known = psi[category]
            psi[category] = Psi(known.psi_0, known.psi_1, psi_2(building, category))
    return psi
