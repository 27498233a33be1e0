"""What makes a design of viscous dampers implausible although the procedure gives it, a sentence each."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from edesign.project.dampers.designs import DriftAmplitude, RoofAmplitude
from edesign.study.design.estimate import FrameEstimate
from edesign.study.design.plausibility import beyond_the_optimum, spread
from edesign.study.design.results import of_storeys
from edesign.study.design.viscous.model import ViscousModel
from edesign.study.design.viscous.sizing import ViscousSizing

LARGEST_FORCE = 8e6
"""N, of one fluid viscous damper: the end of the standard sizes of Taylor Devices (250 to 8000 kN)."""
LEAST_SHARE = 0.03
"""Of the largest force: the least and the largest standard size are 250 and 8000 kN, which is about this share."""


def viscous_warnings(model: ViscousModel, sizing: ViscousSizing, found: FrameEstimate | None) -> Iterator[str]:
    """Yield one sentence for each implausible property of a design of viscous dampers.

    Args:
        found: response that the spectrum estimates; None: there is no level.
    """
    building, vibration, spec = model.building, sizing.vibration, model.spec
    pushed = np.abs(vibration.stiffness(vibration.omega))  # force over drift, with the spring in series
    ratio = np.bincount(building.place_storey, pushed * building.cosine**2) / building.designed_stiffness
    if ratio.max() > 1.0:
        yield (
            f"the dampers of storey {building.storeys[int(ratio.argmax())]} push {ratio.max():.3g} times as hard as "
            "its columns (omega c_eq over k_S, with braces): they hold the storey rather than damp it; 2 is the "
            "critical damping of a storey by itself"
        )
    weight = vibration.linear / model.at_places(sizing.size)

    def damping(share: float) -> float:
        coefficient = share * sizing.size
        return model.modes(weight * model.at_places(coefficient), coefficient).first_damping

    yield from beyond_the_optimum(damping, "coefficients")
    if found is None:
        return
    force = of_storeys(building, found.damper_force) / spec.number
    if force.max() > LARGEST_FORCE:
        yield (
            f"one damper of storey {building.storeys[int(force.argmax())]} has an estimated force of "
            f"{1e-3 * force.max():.4g} kN; standard sizes end at {1e-3 * LARGEST_FORCE:g} kN (Taylor Devices), so "
            f"take more places or a larger `number` than {spec.number}"
        )
    weak = force < LEAST_SHARE * force.max()
    if weak.any():
        storeys = ", ".join(str(building.storeys[i]) for i in np.flatnonzero(weak))
        yield (
            f"the dampers of storey {storeys} have less than {100 * LEAST_SHARE:g} % of the strongest one's force, "
            f"{1e-3 * force.min():.3g} kN at least: they do next to nothing; leave these storeys out by `storeys`, or "
            "take another `distribution`"
        )
    yield from _amplitude(model, sizing)


def _amplitude(model: ViscousModel, sizing: ViscousSizing) -> Iterator[str]:
    """What a given amplitude misses where the spectrum says another one."""
    vibration, alpha, action = sizing.vibration, model.dashpot.alpha, model.action
    if not isinstance(model.spec.amplitude, (RoofAmplitude, DriftAmplitude)) or action is None or alpha == 1.0:
        return
    reached = model.roof(vibration.modes, action)
    ratio = (reached / vibration.roof) ** (alpha - 1.0)
    low, high, source = spread(model.spec.bounds)
    if not low <= ratio <= high:
        yield (
            f"the dampers count at a roof amplitude of {1e3 * vibration.roof:.4g} mm, but the first mode reaches "
            f"{1e3 * reached:.4g} mm at {model.spec.level}: there c_eq is {ratio:.3g} times what the design counts on, "
            f"outside {low:g} to {high:g} ({source}); `amplitude: spectrum` follows the amplitude"
        )
