"""Time history analysis: gravity, then a scaled record, then free vibration."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from edesign.archive.dataset import Group
from edesign.core import HHT, GeneralisedAlpha, Integrator, Modes, Newmark
from edesign.errors import InputError
from edesign.frame.damping import modal_ratios, modes_needed, proportional_factors
from edesign.ground_motion.project_records import find_recordings, references
from edesign.ground_motion.record import Record
from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.project.analysis.damping import CaugheyDamping, MassDamping, ModalDamping, NoDamping
from edesign.project.analysis.integration import HHTIntegration, Integration, NewmarkIntegration
from edesign.project.analysis_file import AnalysisFile
from edesign.project.records.records import record_of
from edesign.study.analysis.history_results import HistoryResults
from edesign.study.analysis.isolators import isolator_warnings
from edesign.study.analysis.modal import fundamental_period
from edesign.study.analysis.residual import period_steps
from edesign.study.analysis.structure import IN_PLACE, Structure, frame_alone, make_structure
from edesign.study.analysis.wave_passage import DelayedSupports
from edesign.study.motions.applied import ground_motion, scale_factor
from edesign.study.motions.motions import AnyMotion, project_motions
from edesign.study.results.warnings import store_warnings


def run_history(
    project: AnalysisFile,
    spec: HistoryAnalysis,
    progress: Callable[[int, int], None] | None = None,
    stop: Callable[[], bool] | None = None,
    motion: AnyMotion | None = None,
    vertical: AnyMotion | None = None,
) -> Group:
    """Compute the response of a frame or building under gravity to a record, and to its vertical motion if it has one.

    Args:
        progress: called with (steps done, steps).
        stop: asked now and then; True ends the history.
        motion: the record made ready; None reads it here.
        vertical: likewise the other record of its vertical motion, if it has one.

    Returns:
        The results; `status` says whether the history was completed.

    Raises:
        InputError: the record cannot be read, or a requested output does not exist.
        AnalysisError: no equilibrium under gravity, or no modes for the damping.
        CoreError: the frame is a mechanism.
    """
    if project.integration is None:
        raise InputError(f"{project.path}: the history {spec.name} needs `integration` [E-KEY-02]")
    motion = motion or _motion(project, spec.record)
    factor = scale_factor(project, spec, motion.record)
    if spec.vertical is not None and spec.vertical.record is not None:
        vertical = vertical or _motion(project, spec.vertical.record)
    both = ground_motion(project, spec, motion, factor, vertical)
    ground = both.horizontal
    eccentricity = spec.eccentricity_with(project.accidental_torsion)
    structure = make_structure(project, dampers=spec.dampers, eccentricity=eccentricity)
    late = DelayedSupports(spec, structure.frame, both)
    results = HistoryResults(project, structure.frame, spec.collapse_drift)
    period = load_and_damp(project, structure, eccentricity)
    response = structure.analysis.history(
        ground.acceleration,
        ground.time_step,
        method=integrator(project.integration),
        channels=results.channels,
        progress=progress,
        stop=stop,
        limits=results.limits,
        every=project.outputs.every,
        tail=period_steps(ground.time_step, period),
        energies=results.energies,
        vertical=both.samples,
        along_y=both.across.acceleration if both.across is not None else None,
        supports=late.motions,
        watch=results.watch,
    )
    across = np.zeros_like(ground.acceleration) if both.across is None else both.across.acceleration
    samples = (ground.acceleration, across)[: len(structure.frame.directions)]
    group = results.group(response, samples, ground.time_step, period, project.outputs.every)
    group.attributes |= _provenance(motion, factor, ground, spec)
    both.store(group, project.outputs.every, structure.frame.still)
    late.store(group, structure.frame)
    if response.status == "completed":
        store_warnings(group, isolator_warnings(project, group, structure.frame))
    return group


def _motion(project: AnalysisFile, reference: str) -> AnyMotion:
    """The record made ready for one history alone; those of a suite depend on each other."""
    recordings = find_recordings(project, references(project, record_of(reference)))
    return project_motions(project, recordings, lambda: fundamental_period(project))[reference]


def integrator(integration: Integration) -> Integrator:
    """Return the integrator of the core for the integration method of a project."""
    if isinstance(integration, NewmarkIntegration):
        return Newmark(integration.gamma, integration.beta)
    if isinstance(integration, HHTIntegration):
        return HHT(integration.alpha)
    return GeneralisedAlpha(integration.rho_inf)


def load_and_damp(project: AnalysisFile, structure: Structure, eccentricity: tuple[float, float] = IN_PLACE) -> float:
    """Apply gravity, install the dampers, and set the inherent damping of a history.

    Inherent damping is that of the modes of the frame alone: tuned masses would split the first of them.

    Args:
        eccentricity: with which the masses of a building were built.

    Returns:
        The fundamental period under gravity, s.
    """
    alone = frame_alone(project, eccentricity=eccentricity) if structure.frame.attached else structure
    damping = None if isinstance(project.damping, NoDamping) else project.damping
    count = modes_needed(damping, alone.most_modes)
    modes: Modes | None = None
    initial = count > 0 and damping is not None and damping.state == "initial"
    if initial:
        modes = alone.modes(count)
    structure.apply_gravity()
    if alone is not structure:
        alone.apply_gravity()
    structure.install_dampers()
    under_gravity = alone.modes(max(1, 0 if initial else count))
    modes = modes or under_gravity
    if isinstance(damping, (ModalDamping, CaugheyDamping)):
        # tuned masses have the last equations
        more = structure.analysis.n_equations - modes.equations.shape[1]
        padded = replace(modes, equations=np.pad(modes.equations, ((0, 0), (0, more))))
        structure.analysis.modal_damping(padded, modal_ratios(damping, modes.omega))
    elif damping is not None:
        a0, a1 = proportional_factors(damping, modes.omega)
        structure.analysis.rayleigh(a0, a1, "initial" if isinstance(damping, MassDamping) else damping.stiffness)
    return float(under_gravity.period[0])


def _provenance(motion: AnyMotion, factor: float, ground: Record, spec: HistoryAnalysis) -> dict[str, object]:
    recorded = motion.found.record
    return {
        "record_origin": motion.found.origin,
        "record_source": recorded.source,
        "record_checksum": recorded.checksum,
        "record_pga_m_s2": recorded.pga,
        "record_time_step_s": recorded.time_step,
        "record_samples": int(recorded.acceleration.size),
        "match_method": motion.match.method if motion.match else None,
        "match_scale": motion.match.scale if motion.match else None,
        "scale_factor": float(factor),
        "input_motion": ground.source,
        "input_pga_m_s2": ground.pga,
        "time_step_s": ground.time_step,
        "free_vibration_s": spec.free_vibration,
    }
