"""Inherent damping and time integration as data of a script."""

from __future__ import annotations

import math

from edesign.exchange.opensees.commands import Value
from edesign.frame.damping import modal_ratios, modes_needed
from edesign.project.analysis.damping import (
    CaugheyDamping,
    MassDamping,
    ModalDamping,
    NoDamping,
    RayleighDamping,
    StiffnessDamping,
)
from edesign.project.analysis.integration import GeneralisedAlphaIntegration, HHTIntegration, NewmarkIntegration
from edesign.project.analysis_file import AnalysisFile
from edesign.study.analysis.structure import frame_alone


def damping_values(project: AnalysisFile, dampers: bool) -> dict[str, Value]:
    """Return the inherent damping of histories; empty: none.

    Args:
        dampers: whether the script has dampers; modal damping is of the modes without them.
    """
    damping = project.damping
    if damping is None or isinstance(damping, NoDamping):
        return {}
    if isinstance(damping, ModalDamping | CaugheyDamping):
        alone = frame_alone(project, dampers)
        if damping.state == "gravity":
            alone.apply_gravity()
        count = modes_needed(damping, alone.most_modes)
        ratios = modal_ratios(damping, alone.modes(count).omega)
        return {"kind": "modal", "state": damping.state, "ratios": tuple(float(ratio) for ratio in ratios)}
    values: dict[str, Value] = {"kind": damping.kind, "state": damping.state, "ratio": damping.ratio}
    modes = damped_modes(project)
    given = damping.periods if isinstance(damping, RayleighDamping) else (damping.period or 0.0,)
    values |= {"modes": modes, "periods": () if modes or given is None else given}
    if modes and dampers and project.isolation is not None:
        alone = frame_alone(project)  # with isolators at the design displacement, which OpenSees has not
        if damping.state == "gravity":
            alone.apply_gravity()
        omega = alone.modes(max(modes)).omega
        values["periods"] = tuple(float(2.0 * math.pi / omega[mode - 1]) for mode in modes)
    values["stiffness"] = "initial" if isinstance(damping, MassDamping) else damping.stiffness
    return values


def damped_modes(project: AnalysisFile) -> tuple[int, ...]:
    """Return the modes that Rayleigh's damping or a part of it follows; none where periods are given, or no damping."""
    match project.damping:
        case RayleighDamping(periods=None, modes=modes):
            return modes
        case MassDamping(period=None, mode=mode) | StiffnessDamping(period=None, mode=mode):
            return (mode,)
    return ()


def integrator_words(project: AnalysisFile) -> tuple[str | float, ...]:
    """Return the integrator of histories.

    Source: OpenSees' HHT has 1 + alpha, its GeneralizedAlpha 1 - alpha_m and 1 - alpha_f of Chung & Hulbert (1993).
    """
    integration = project.integration
    match integration:
        case HHTIntegration():
            return "HHT", 1.0 + integration.alpha
        case GeneralisedAlphaIntegration():
            rho = integration.rho_inf
            return "GeneralizedAlpha", (2.0 - rho) / (1.0 + rho), 1.0 / (1.0 + rho)
        case NewmarkIntegration():
            return "Newmark", integration.gamma, integration.beta
    return "Newmark", 0.5, 0.25
