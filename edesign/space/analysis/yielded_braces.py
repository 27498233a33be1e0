"""Beams that chevrons or V braces meet, when the brace in tension yields and the one in compression has buckled.

Source: EN 1998-1:2004, 6.7.4(2). Such a beam carries the loads of gravity without the braces, and the unbalanced
vertical force of the braces beside them. The code says nothing of the ends of the beam: they are what they are in the
model, hinges or joints to columns and other beams. The unbalanced horizontal force goes through the beam to the floor,
as `bracing` says.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from edesign.codes.ec3.cross_section import axial_resistance
from edesign.codes.ec8.concentric_braces import post_buckling_forces
from edesign.codes.en1990.combinations import Combination
from edesign.core.space import SpaceModel
from edesign.project.building.building import Building
from edesign.project.building.design import Design
from edesign.space.analysis.bracing import Bracing
from edesign.space.analysis.effects import Effects
from edesign.space.analysis.response import nodal_case, static_cases
from edesign.space.checks.capacity import by_section
from edesign.space.structure.design_block import design_of
from edesign.space.structure.frame import SpaceFrame

CASES = ("braces+", "braces-")
"""Braces at N_pl,Rd and gamma_pb N_pl,Rd, those in tension that rise along the axis, and those that fall."""


def yielded_combinations(seismic: Combination, bracing: Bracing, design: Design) -> tuple[Combination, ...]:
    """Return the combinations for beams beside buckled braces; none without such beams, or in ductility class low.

    Args:
        seismic: a combination with the seismic action, whose loads of gravity count.
        bracing: of the building.
    """
    if not bracing.halves.size or design.ductility_class == "low":
        return ()
    gravity = " + ".join(
        name if factor == 1.0 else f"{factor:g} {name}" for name, factor in seismic.static.items() if factor != 0.0
    )
    return tuple(
        replace(seismic, name=f"{gravity} + {case}", static={**seismic.static, case: 1.0}, seismic=(0.0, 0.0, 0.0))
        for case in CASES
    )


def with_yielded_braces(
    effects: Effects, model: SpaceModel, frame: SpaceFrame, bracing: Bracing, building: Building, gamma_pb: float
) -> Effects:
    """Return the effects with those of the yielded braces on the beams that they meet, as two more static cases.

    Args:
        effects: of all actions.
        model: in which braces carry nothing.
        frame: with its sections.
        bracing: of the building.
        building: with its materials and the block `design`.
        gamma_pb: share of N_pl,Rd that a buckled brace keeps.
    """
    gamma_M0 = design_of(building).partial_factors.M0
    N_pl = by_section(frame, building.materials, lambda of, steel: axial_resistance(of.A, steel.fy, gamma_M0))
    start, end = frame.ends
    braces = bracing.braces
    sine = (frame.coordinates[end[braces], 2] - frame.coordinates[start[braces], 2]) / frame.length[braces]
    cases, axial = [], []
    for name, in_tension in zip(CASES, bracing.in_tension, strict=True):
        force = post_buckling_forces(N_pl[braces], in_tension, gamma_pb)
        force = np.where(in_tension | frame.in_compression[braces], force, 0.0)
        upwards = np.zeros(len(frame.node_names))
        np.add.at(upwards, start[braces], force * sine)
        np.add.at(upwards, end[braces], -force * sine)
        nodal = np.zeros((len(frame.node_names), 6))
        nodal[bracing.middles, 2] = upwards[bracing.middles]
        cases.append(nodal_case(frame, name, nodal))
        axial.append(bracing.to_collectors @ force)
    internal = np.zeros((len(CASES), *effects.static.shape[1:]))
    internal[:, bracing.halves] = static_cases(model, tuple(cases)).internal[:, bracing.halves]
    collected = np.zeros(internal.shape[:3])
    collected[:, bracing.collectors] = np.reshape(axial, (len(CASES), bracing.collectors.size, internal.shape[2]))
    internal[..., 0][:, bracing.halves] += collected[:, bracing.halves]
    return Effects((*effects.cases, *CASES), np.concatenate([effects.static, internal]), effects.seismic)
