"""The simplified design procedure of Fan and Lee: the least damper stiffness with which static forces meet a drift."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from edesign.codes.ec8.analysis.lateral_force import base_shear, is_applicable, lateral_forces
from edesign.project.checks.designs import design_warnings
from edesign.project.dampers.designs import SimplifiedDesign
from edesign.study.design.building import Building
from edesign.study.design.condensed import LinearModes
from edesign.study.design.elastomer.frequency_consistent import agreed, at_consistent_frequency
from edesign.study.design.elastomer.material import Elastomer, Material
from edesign.study.design.elastomer.model import ElastomerModel, ElastomerSizing, Iteration
from edesign.study.design.elastomer.strain_consistent import AtStrain, at_consistent_strain, start_strain
from edesign.study.design.estimate import Action

_ROUNDING = 1e-9  # of the number of steps of beta


@dataclass(frozen=True)
class StaticResponse:
    """Response of the frame under the equivalent lateral forces.

    Attributes:
        at: k_D of the dampers of each storey, with the elastomer's properties at the first frequency.
        drift: of all storeys over height, (f,).
        base_shear: N.
    """

    at: Iteration
    drift: np.ndarray
    base_shear: float


def size_simplified(
    model: ElastomerModel,
    spec: SimplifiedDesign,
    least: float,
    area_factor: float = 1.0,
    thickness_factor: float = 1.0,
) -> ElastomerSizing:
    """Find the least beta of the range whose drifts under lateral forces stay below the target.

    Args:
        model: of the dampers; at the low end of temperatures they are stiffer.
        least: lowest beta to be tried.
        area_factor: on areas and with them on stiffnesses, after beta is chosen.
        thickness_factor: on thickness and area.

    Source: thesis 5.3.4, steps 2 to 9, after Fan (1998) and Lee (2003); EN 1998-1:2004, 4.3.3.2, for the forces.
    """
    assert spec.drift is not None, "check_design wants it"
    k_S = model.building.designed_stiffness
    thickness = thickness_factor * model.thickness
    start = start_strain(model, thickness)
    cold = None if spec.low_temperature is None else model.material_at(spec.low_temperature)

    def respond(elastomer: Material, k_D: Callable[[float], np.ndarray]) -> AtStrain[StaticResponse]:
        """The response at a strain, or at the one that is reached, with k_D (s,) at a strain."""

        def solve(strain: float) -> StaticResponse:
            return static_response(model, spec, elastomer(strain), k_D(strain))

        def reached(found: StaticResponse) -> float:
            return model.share * model.estimated_strain(found.at.stiffness, found.at.moduli.loss_factor, thickness)

        return at_consistent_strain(model, solve, lambda found: found.at.moduli, reached, start)

    iterations: list[Iteration] = []
    betas = [least, *(beta for beta in _betas(spec) if beta > least)]
    reason = ""
    for beta in betas:
        wanted = beta * k_S
        at = respond(model.material, partial(_same, wanted))
        step = at.found.at
        values = _values(beta, at.found, "")
        if cold is not None:
            of_modulus = wanted / step.moduli.G_storage
            at_low = respond(cold, partial(_stiffness, cold, step.next_frequency, of_modulus)).found
            values |= _values(beta, at_low, "low_temperature_")
        iterations.append(replace(step, frequency=step.next_frequency, values=values))
        if static_drift(iterations[-1]) <= spec.drift:
            break
    else:
        drifts = [static_drift(step) for step in iterations]
        if spec.verify is None:
            reason = _beyond(spec, betas[-1], min(drifts))
        else:  # histories decide, from the beta that the estimate likes best
            beta = betas[int(np.argmin(drifts))]
            wanted = beta * k_S
            at = respond(model.material, partial(_same, wanted))
    stiffness = area_factor * wanted
    if area_factor != 1.0:
        at = respond(model.material, partial(_same, stiffness))
    step = at.found.at
    return ElastomerSizing(
        target=beta,
        size=stiffness,
        iterations=tuple(iterations),
        reason=reason or at.reason,
        moduli=step.moduli,
        frequency=step.next_frequency,
        thickness=thickness,
        area=model.areas(stiffness, thickness, step.moduli.G_storage),
        strain=at.strain,
        strain_steps=at.steps,
    )


def _beyond(spec: SimplifiedDesign, largest: float, least_drift: float) -> str:
    assert spec.drift is not None, "check_design wants it"
    return (
        f"by the lateral forces no beta up to {largest:g} meets the drift of {100.0 * spec.drift:.4g} %; the least "
        f"that was found is {100.0 * least_drift:.4g} %; this is an estimate: with `verify` histories decide"
    )


def _same(k_D: np.ndarray, strain: float) -> np.ndarray:
    """Stiffness (s,) N/m that is given whatever the strain; the area follows."""
    return k_D


def _stiffness(elastomer: Material, frequency: float, of_modulus: np.ndarray, strain: float) -> np.ndarray:
    """Stiffness (s,) N/m of dampers of an area, given as their stiffness for a modulus of 1 Pa, at a strain."""
    return elastomer(strain)(frequency).G_storage * of_modulus


def static_drift(step: Iteration) -> float:
    """Return the largest storey drift over height under the lateral forces, at whatever temperature."""
    return max(step.values["drift"], step.values.get("low_temperature_drift", 0.0))


def static_response(
    model: ElastomerModel, spec: SimplifiedDesign, elastomer: Elastomer, k_D: np.ndarray
) -> StaticResponse:
    """Return the drifts under the lateral forces of the spectrum reduced for the added damping.

    Args:
        elastomer: its properties; the loss factor follows the frequency, k_D is given.
        k_D: storage stiffness of the dampers of each storey, (s,) N/m.

    Source: EN 1998-1:2004, 4.3.3.2.2 and 4.3.3.2.3, with the elastic spectrum of 3.2.2.2 for inherent and added damping
        (displacements of the elastic structure, as 4.3.4 has them).
    """
    building, action = model.building, model.action
    assert action is not None, "check_design wants a level"
    frame = building.frame
    at = agreed(at_consistent_frequency(model, elastomer, lambda moduli: k_D, model.bare.first_frequency))
    frequency, added = at.last.next_frequency, at.last.damping
    spectrum = action.spectrum.with_damping(min(action.inherent_damping + at.modes.first_beside_damping + added, 1.0))
    corner = spectrum.corners["T_C"]
    across = frame.influence > 0.0
    mass = np.where(across, frame.mass, 0.0)
    period = 1.0 / frequency
    F_b = base_shear(float(spectrum.acceleration(period)), float(mass.sum()), period, corner, building.heights.size)
    loads = lateral_forces(F_b, mass, _shape(building, spec, at.modes))
    drift = building.largest_drifts(*frame.static(loads, at.stiffness.real))
    return StaticResponse(at.last, drift, F_b)


def simplified_warnings(spec: SimplifiedDesign, action: Action, sizing: ElastomerSizing) -> list[str]:
    """Return one sentence for each property outside the recommendations of the simplified procedure.

    Args:
        action: spectrum, and damping ratio of the frame without dampers.
    """
    found = design_warnings(spec)
    period = 1.0 / sizing.frequency
    if not is_applicable(period, action.spectrum.corners["T_C"]):
        found.append(
            f"the first period of {period:.3g} s is longer than the lateral force method allows "
            "(EN 1998-1, 4.3.3.2.1(2): 4 T_C and 2 s); verify the design by histories"
        )
    return found


def _shape(building: Building, spec: SimplifiedDesign, modes: LinearModes) -> np.ndarray:
    frame = building.frame
    if spec.forces == "first_mode":
        return np.where(frame.influence > 0.0, modes.lead.shape, 0.0)
    levels = np.concatenate([np.cumsum(building.heights), [0.0]])  # a mass of no floor (-1) stands at no height
    return levels[frame.floor_of]


def _betas(spec: SimplifiedDesign) -> list[float]:
    low, high = spec.beta
    steps = math.floor((high - low) / spec.beta_step * (1.0 + _ROUNDING))
    return [low + i * spec.beta_step for i in range(steps + 1)]


def _values(beta: float, found: StaticResponse, prefix: str) -> dict[str, float]:
    return {
        "beta": beta,
        f"{prefix}drift": float(found.drift.max()),
        f"{prefix}base_shear": found.base_shear,
        f"{prefix}damping": found.at.damping,
    }
