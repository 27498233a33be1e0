"""Sizing by modal strain energy: properties, stiffness, modes with dampers, until frequencies agree (thesis 5.3.4)."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from edesign.project.dampers.designs import BraceRatio, StrainEnergyDesign
from edesign.study.design.building import Building
from edesign.study.design.damping import strain_energy_damping
from edesign.study.design.elastomer.distribution import distribute
from edesign.study.design.elastomer.material import Elastomer, Material
from edesign.study.design.elastomer.own_strain import at_own_strain, reached_strain, start_strain
from edesign.study.design.elastomer.sizing import Iteration, Sizing, layer_areas, layer_thickness, place_stiffness
from edesign.study.design.estimate import Action
from edesign.study.design.relaxation import AGREEMENT, MOST_ITERATIONS


def size_by_strain_energy(
    building: Building,
    spec: StrainEnergyDesign,
    material: Material,
    action: Action | None,
    target: float,
    area_factor: float = 1.0,
    thickness_factor: float = 1.0,
    share: float = 1.0,
    given: np.ndarray | None = None,
) -> Sizing:
    """Find the dampers of a target damping, at the frequency and, if it is followed, the strain that they have.

    Args:
        building: the frame with its places.
        spec: the design.
        material: properties of the elastomer.
        action: for the distribution of least area.
        target: damping ratio to be added (nan for the least area).
        area_factor: on areas and with them on stiffnesses.
        thickness_factor: on thickness and area, which leaves the stiffness as it is.
        share: what the strain of histories is of the estimated one.
        given: storage stiffness k_D of the dampers of each storey, (s,) N/m; None: it is found.

    Raises:
        InputError: no damper reaches the target.
        AnalysisError: no stiffness of dampers does what is wanted, or the frame is unstable.

    Source: thesis 5.3.4, steps 5 and 6, Eqs. 5.6, 5.9 and 5.14.
    """
    ratio = spec.brace.ratio if isinstance(spec.brace, BraceRatio) else math.inf
    brace = None if math.isinf(ratio) else ratio * building.designed_stiffness
    in_target = brace if spec.braces_in_target else None
    thickness = thickness_factor * layer_thickness(building, spec)

    def solve(strain: float) -> Sizing:
        return _at_own_frequency(
            building, spec, material(strain), action, target, area_factor, thickness, brace, in_target, given
        )

    def reached(found: Sizing) -> float:
        assert action is not None, "check_design wants a level"
        args = (found.stiffness, found.moduli.loss_factor, brace, thickness)
        return share * reached_strain(building, action, *args)

    start = start_strain(building, spec, action, thickness)
    at = at_own_strain(spec, solve, lambda found: found.moduli, reached, start)
    reason = at.found.reason or at.reason
    return replace(at.found, reason=reason, strain=at.strain, strain_steps=at.steps)


def _at_own_frequency(
    building: Building,
    spec: StrainEnergyDesign,
    material: Elastomer,
    action: Action | None,
    target: float,
    area_factor: float,
    thickness: float,
    brace: np.ndarray | None,
    in_target: np.ndarray | None,
    given: np.ndarray | None,
) -> Sizing:
    """The dampers with properties at one strain; `brace` is of the storeys, `in_target` the same if it counts there."""
    frequency = building.frame.modes().first_frequency
    iterations: list[Iteration] = []
    reason = f"the frequencies did not agree to {AGREEMENT:g} within {MOST_ITERATIONS} iterations"
    wanted: np.ndarray | None = None
    while len(iterations) < MOST_ITERATIONS:
        moduli = material(frequency)
        if given is None:
            wanted = distribute(building, spec, moduli, target, in_target, action, brace, thickness, wanted)
        else:
            wanted = given
        stiffness = area_factor * wanted
        at_places = place_stiffness(building, stiffness, moduli.loss_factor, in_target)
        modes = building.frame.modes(at_places.real)
        before, frequency = frequency, modes.first_frequency
        damping = float(strain_energy_damping(modes, at_places)[0])
        iterations.append(Iteration(before, moduli, stiffness, frequency, damping, {}))
        if abs(frequency - before) <= AGREEMENT * frequency:
            reason = ""
            break
    area = layer_areas(building, spec, stiffness, thickness, moduli.G_storage)
    return Sizing(target, stiffness, moduli, frequency, thickness, area, brace, tuple(iterations), reason)
