"""Compensators as a file of substructure tests describes them."""

from __future__ import annotations

import numpy as np

from edesign.core.compensator import AdaptiveTimeSeries, Compensator, LiveDelay
from edesign.project.substructure import compensators as kinds
from edesign.substructure.compensation import compensators
from edesign.substructure.rig.rigs import RigTransfer


def compensator_of(described: kinds.Compensator, step: float, rig: RigTransfer) -> Compensator:
    """Return a compensator of a file.

    Args:
        step: main step, s.
        rig: whose series `model_feedforward` takes where the file states none.

    Raises:
        InputError: it cannot look back so far.
    """
    match described:
        case kinds.NoCompensator():
            return compensators.none()
        case kinds.PolynomialCompensator(order=order, delay=delay):
            spacing = step if described.spacing == "step" else None
            return compensators.polynomial(order, delay, step, spacing)
        case kinds.LeastSquaresPolynomialCompensator():
            return compensators.least_squares_polynomial(described.order, described.points, described.delay, step)
        case kinds.LinearAccelerationCompensator():
            return compensators.linear_acceleration(described.delay, step)
        case kinds.InverseCompensator():
            return compensators.inverse(described.delay, step)
        case kinds.PhaseLeadCompensator():
            return compensators.phase_lead(described.lead, described.lag, step)
        case kinds.FixedAlphaCompensator():
            return compensators.fixed_alpha(described.alpha, step)
        case kinds.ModelFeedforwardCompensator():
            return compensators.fixed_alpha(described.alpha or rig.inverse_series(2), step)
        case kinds.SmithCompensator():
            return compensators.smith(described.delay, described.gain, described.stiffness, described.damping, step)
        case kinds.PiPhaseLeadCompensator():
            return compensators.pi_phase_lead(
                described.proportional, described.integral, described.lead, described.lag, step
            )
        case kinds.LiveDelayCompensator():
            least, largest = described.limits
            return LiveDelay(described.order, described.delay, least, largest, described.share, described.threshold)
        case kinds.AtsCompensator():
            adaptive = _adaptive(described, step)
            return compensators.ats(described.window, described.every, step, adaptive)
        case kinds.ModifiedAtsCompensator():
            return compensators.modified_ats(described.forgetting, _adaptive(described, step))


def _adaptive(described: kinds.AtsCompensator | kinds.ModifiedAtsCompensator, step: float) -> AdaptiveTimeSeries:
    limits, rates, filtered = described.limits, described.rates, described.filter
    none = np.zeros((0, 5))
    return AdaptiveTimeSeries(
        initial=described.initial,
        least=(limits.a0[0], limits.a1[0], limits.a2[0]),
        largest=(limits.a0[1], limits.a1[1], limits.a2[1]),
        rate=(rates.a0, rates.a1, rates.a2),
        threshold=described.threshold,
        sections=none if filtered is None else compensators.butterworth(filtered.order, filtered.cutoff, step),
        differences=described.derivatives == "differences",
    )
