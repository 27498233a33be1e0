"""Sizing by modal strain energy: properties, stiffness, modes with dampers, until frequencies agree (thesis 5.3.4)."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from edesign.damper.sizing import in_series
from edesign.project.dampers.designs import StrainEnergyDesign
from edesign.study.design.elastomer.distribution import distribute
from edesign.study.design.elastomer.frequency_consistent import at_consistent_frequency
from edesign.study.design.elastomer.material import Moduli
from edesign.study.design.elastomer.model import ElastomerModel, ElastomerSizing
from edesign.study.design.elastomer.strain_consistent import at_consistent_strain, start_strain


def size_by_strain_energy(
    model: ElastomerModel,
    spec: StrainEnergyDesign,
    target: float,
    area_factor: float = 1.0,
    thickness_factor: float = 1.0,
    given: np.ndarray | None = None,
) -> ElastomerSizing:
    """Find the dampers of a target damping, at the frequency and, if it is followed, the strain that they have.

    Args:
        target: damping ratio to be added (nan for the least area).
        area_factor: on areas and with them on stiffnesses.
        thickness_factor: on thickness and area, which leaves the stiffness as it is.
        given: storage stiffness k_D of the dampers of each storey, (s,) N/m; None: it is found.

    Raises:
        InputError: no damper reaches the target.
        AnalysisError: no stiffness of dampers does what is wanted, or the frame is unstable.

    Source: thesis 5.3.4, steps 5 and 6, Eqs. 5.6, 5.9 and 5.14.
    """
    thickness = thickness_factor * model.thickness

    def solve(strain: float) -> ElastomerSizing:
        wanted: np.ndarray | None = None

        def k_D(moduli: Moduli) -> np.ndarray:
            nonlocal wanted
            wanted = distribute(model, spec, moduli, target, thickness, wanted) if given is None else given
            return area_factor * wanted

        start, elastomer = model.bare.first_frequency, model.material(strain)
        found = at_consistent_frequency(model, elastomer, k_D, start, braces=spec.counts_braces)
        last = found.last
        return ElastomerSizing(
            target=target,
            size=last.stiffness,
            iterations=found.iterations,
            reason=found.reason,
            moduli=last.moduli,
            frequency=last.next_frequency,
            thickness=thickness,
            area=model.areas(last.stiffness, thickness, last.moduli.G_storage),
            strain=strain,
        )

    def reached(found: ElastomerSizing) -> float:
        return model.share * model.estimated_strain(found.size, found.moduli.loss_factor, thickness)

    at = at_consistent_strain(model, solve, lambda found: found.moduli, reached, start_strain(model, thickness))
    reason, damping = at.found.reason or at.reason, _reached(model, spec, at.found)
    return replace(at.found, reached=damping, reason=reason, strain=at.strain, strain_steps=at.steps)


def _reached(model: ElastomerModel, spec: StrainEnergyDesign, found: ElastomerSizing) -> float:
    """The damping that answers the target: of the first mode, or the least of the storeys, each by itself (Eq. 5.9)."""
    if math.isnan(found.target):
        return math.nan
    if spec.target_in == "first_mode":
        return model.first_damping(model.of(found, spec.counts_braces))
    stiffness = found.size * (1.0 + 1.0j * found.moduli.loss_factor)
    if spec.counts_braces and model.brace is not None:
        stiffness = in_series(stiffness, model.brace)
    return float(np.min(0.5 * stiffness.imag / (model.building.designed_stiffness + stiffness.real)))
