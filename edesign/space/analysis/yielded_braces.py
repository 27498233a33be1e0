"""What braces that yield bring to beams and columns.

Beams that chevrons or V braces meet: the brace in tension yields and the one in compression has buckled.
Buckling-restrained braces: all of a direction have their adjusted strengths.

A beam that braces meet carries the loads of gravity without the braces, and the unbalanced vertical force of the braces
beside them. The codes say nothing of the ends of the beam: they are what they are in the model, hinges or joints to
columns and other beams. The unbalanced horizontal force goes through the beam to the floor, as `bracing` says.

Source: EN 1998-1:2004, 6.7.4(2); AISC 341-16, F4.3 and F4.4a.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace

import numpy as np

from edesign.codes.ec3.cross_section import axial_resistance
from edesign.codes.ec8.steel.concentric_braces import post_buckling_forces
from edesign.codes.en1990.combinations import Combination
from edesign.core.space import SpaceModel
from edesign.project.building.building import Building
from edesign.project.building.design import Design
from edesign.space.analysis.bracing import Bracing
from edesign.space.analysis.effects import Effects
from edesign.space.analysis.response import nodal_case, static_cases
from edesign.space.checks.capacity import by_section
from edesign.space.structure.design_block import design_of
from edesign.space.structure.frame import AXES, Axis, SpaceFrame
from edesign.space.structure.restrained import RestrainedBraces

CASES = ("braces+", "braces-")
"""Braces at N_pl,Rd and gamma_pb N_pl,Rd, those in tension that rise along the axis, and those that fall."""


def yielded_combinations(
    seismic: Combination, bracing: Bracing, design: Design, restrained: Collection[int] = ()
) -> tuple[Combination, ...]:
    """Return the combinations for beams beside buckled braces; none without such beams, or in ductility class low.

    Args:
        seismic: a combination with the seismic action, whose loads of gravity count.
        bracing: of the building.
        restrained: numbers of the buckling-restrained braces, which do not buckle.
    """
    if not bracing.halves.size or set(bracing.braces.tolist()) <= set(restrained) or design.ductility_class == "low":
        return ()
    gravity = " + ".join(
        name if factor == 1.0 else f"{factor:g} {name}" for name, factor in seismic.static.items() if factor != 0.0
    )
    return tuple(
        replace(seismic, name=f"{gravity} + {case}", static={**seismic.static, case: 1.0}, seismic=(0.0, 0.0, 0.0))
        for case in CASES
    )


def with_yielded_braces(
    effects: Effects,
    model: SpaceModel,
    frame: SpaceFrame,
    bracing: Bracing,
    building: Building,
    gamma_pb: float,
    restrained: Collection[int] = (),
) -> Effects:
    """Return the effects with those of the yielded braces on the beams that they meet, as two more static cases.

    Args:
        effects: of all actions.
        model: in which braces carry nothing.
        frame: with its sections.
        bracing: of the building.
        building: with its materials and the block `design`.
        gamma_pb: share of N_pl,Rd that a buckled brace keeps.
        restrained: numbers of the buckling-restrained braces, which have cases of their own.
    """
    gamma_M0 = design_of(building).partial_factors.M0
    N_pl = by_section(frame, building.materials, lambda of, steel: axial_resistance(of.A, steel.fy, gamma_M0))
    braces = bracing.braces
    forces = {}
    for name, in_tension in zip(CASES, bracing.in_tension, strict=True):
        force = post_buckling_forces(N_pl[braces], in_tension, gamma_pb)
        force = np.where(in_tension | frame.in_compression[braces], force, 0.0)
        forces[name] = np.where(np.isin(braces, list(restrained)), 0.0, force)
    return _with_forces(effects, model, frame, bracing, forces, bracing.halves)


def restrained_case(axis: Axis, sense: int) -> str:
    """Return the name of the case of all buckling-restrained braces of an axis at adjusted strength, such as `BRB x+`.

    Args:
        sense: number of the sense of the action in `SENSES`.
    """
    return f"BRB {axis}{'+-'[sense]}"


def with_restrained_braces(
    effects: Effects, model: SpaceModel, frame: SpaceFrame, bracing: Bracing, restrained: RestrainedBraces
) -> Effects:
    """Return the effects with those of all buckling-restrained braces at adjusted strength, two cases for each axis.

    Columns have what the braces above bring to their lines, collectors what the floor brings to the braces, and beams
    that braces meet the unbalanced force of both. That columns bend with the drift of the storeys is in the amplified
    combinations, and not here (F4.3, exception a).

    Args:
        effects: of all actions.
        model: in which braces carry nothing.
        frame: with its sections.
        bracing: of the building.

    Source: AISC 341-16, F4.3 and F4.4a.
    """
    tension, compression = np.zeros((2, bracing.braces.size))
    places = np.searchsorted(bracing.braces, restrained.numbers)
    tension[places], compression[places] = restrained.tension, restrained.compression
    forces = {}
    for number, axis in enumerate(AXES):
        along = (bracing.axis == number) & (tension > 0.0)
        for sense, in_tension in enumerate(bracing.in_tension):
            force = np.where(along, np.where(in_tension, tension, -compression), 0.0)
            if along.any():
                forces[restrained_case(axis, sense)] = force
    return _with_forces(effects, model, frame, bracing, forces, bracing.collectors, columns=True)


def _with_forces(
    effects: Effects,
    model: SpaceModel,
    frame: SpaceFrame,
    bracing: Bracing,
    forces: Mapping[str, np.ndarray],
    collectors: np.ndarray,
    columns: bool = False,
) -> Effects:
    """Return the effects with those of given forces of all braces, a static case each, (b,) N by name.

    Args:
        collectors: numbers of the beams that have axial forces of them.
        columns: whether columns have axial forces of them.
    """
    start, end = frame.ends
    braces = bracing.braces
    sine = (frame.coordinates[end[braces], 2] - frame.coordinates[start[braces], 2]) / frame.length[braces]
    cases, axial = [], []
    for name, force in forces.items():
        upwards = np.zeros(len(frame.node_names))
        np.add.at(upwards, start[braces], force * sine)
        np.add.at(upwards, end[braces], -force * sine)
        nodal = np.zeros((len(frame.node_names), 6))
        nodal[bracing.middles, 2] = upwards[bracing.middles]
        cases.append(nodal_case(frame, name, nodal))
        axial.append(bracing.to_collectors @ force)
    internal = np.zeros((len(cases), *effects.static.shape[1:]))
    if bracing.halves.size:
        internal[:, bracing.halves] = static_cases(model, tuple(cases)).internal[:, bracing.halves]
    collected = np.zeros(internal.shape[:3])
    collected[:, bracing.collectors] = np.reshape(axial, (len(cases), bracing.collectors.size, internal.shape[2]))
    N = internal[..., 0]
    N[:, collectors] += collected[:, collectors]
    if columns:
        N[:, bracing.columns] += (np.array([*forces.values()]) @ bracing.to_columns.T)[:, :, None]
    return Effects((*effects.cases, *forces), np.concatenate([effects.static, internal]), effects.seismic)
