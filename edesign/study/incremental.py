"""Incremental dynamic analysis: each record scaled step by step, until the frame collapses."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from edesign.archive.dataset import Group
from edesign.errors import EdesignError, InputError
from edesign.ground_motion.record import Record
from edesign.project.analyses import HistoryAnalysis
from edesign.project.incremental import Incremental, LevelFactorStudy
from edesign.project.project import Project
from edesign.study.analyses import run_analysis
from edesign.study.intensity import intensity_text, level_intensity, record_intensity
from edesign.study.motions import Motion
from edesign.study.plan import labels
from edesign.study.recording import coordinate

SKIPPED = "skipped"
"""Status of a history that was not run because its record has caused collapse at a lower intensity."""


@dataclass(frozen=True)
class Chain:
    """One record at ascending intensities on one variant: histories that are run one after the other, until collapse.

    What is skipped depends on the chain alone, so that chains may be run in any order and side by side.

    Attributes:
        study: what the study file says.
        variant: name of the variant.
        record: reference of the record.
        histories: of each intensity, not yet scaled.
    """

    study: Incremental
    variant: str
    record: str
    histories: tuple[HistoryAnalysis, ...]

    @property
    def name(self) -> str:
        """The unique name of the chain, which the names of its histories begin with."""
        return f"{self.entry}.{self.record.rpartition('/')[2]}"

    @property
    def entry(self) -> str:
        """What all chains of the study and variant have in common."""
        return f"{self.variant}.{self.study.name}"

    @property
    def intensities(self) -> tuple[float, ...]:
        """The value of the intensity measure of each history."""
        return self.study.intensities


def make_chains(study: Incremental, variants: Mapping[str, bool], records: Iterable[str]) -> tuple[Chain, ...]:
    """Plan an incremental study: a chain for each record on each variant.

    Args:
        study: what the study file says.
        variants: whether each variant that is studied has dampers, by its name.
        records: references, of suites all that are taken from them.
    """
    wanted = tuple(records)
    return tuple(_chain(study, variant, dampers, record) for variant, dampers in variants.items() for record in wanted)


def chain_factors(project: Project, chain: Chain, record: Record, period: float | None) -> tuple[float, ...]:
    """Return the factor on a record for each intensity of a chain.

    Args:
        project: the validated project of the variant.
        chain: the plan.
        record: made ready, before scaling.
        period: of the spectral acceleration where the study does not give it, s.

    Raises:
        InputError: as `record_intensity`, or that of the record is zero.
    """
    study = chain.study
    unit = record_intensity(project, study, record, period)
    if unit <= 0.0:
        raise InputError(f"{chain.record}: the record has no {study.intensity} that could be scaled")
    return tuple(intensity / unit for intensity in chain.intensities)


def run_chain(
    project: Project,
    chain: Chain,
    motion: Motion,
    period: float | None = None,
    progress: Callable[[int, int], None] | None = None,
    stop: Callable[[], bool] | None = None,
) -> dict[str, Group]:
    """Run a record at ascending intensities until the frame collapses; the rest is skipped.

    A history that fails without a collapse is kept as failed, and the next intensity is tried. Extremes and residual
    values are kept, histories are not.

    Args:
        project: the validated project of the variant.
        chain: what to run.
        motion: the record made ready.
        period: of the spectral acceleration where the study does not give it, s.
        progress: called with (steps done, steps), where the steps are those of all intensities.
        stop: asked now and then; True ends the chain.

    Returns:
        Results by name of the history, in ascending order; after a stop only those that were finished. Each has the
        attributes `incremental`, `intensity` (m/s2 or a factor) and, as every history that ended so, `collapsed`.
    """
    project = project.model_copy(update={"outputs": project.outputs.model_copy(update=_NOTHING_KEPT)})
    groups: dict[str, Group] = {}
    try:
        factors = chain_factors(project, chain, motion.record, period)
    except EdesignError as error:
        factors, reason, status = (), str(error), "failed"
    else:
        reason, status = "", ""
    for i, (spec, intensity) in enumerate(zip(chain.histories, chain.intensities, strict=True)):
        if status:
            group = _not_run(project, spec, status, reason)
        else:
            scaled = spec.model_copy(update={"scale": factors[i]})
            try:
                group = run_analysis(project, scaled, _share(progress, i, len(chain.histories)), stop, motion)
            except EdesignError as error:
                group = _not_run(project, spec, "failed", str(error))
            if group.attributes["status"] == "interrupted":
                return groups
            if group.attributes.get("collapsed"):
                status, reason = SKIPPED, f"collapsed at {intensity_text(chain.study, intensity)}"
        group.attributes |= {"incremental": chain.study.name, "intensity": intensity}
        groups[spec.name] = group
    return groups


def incremental_group(project: Project, study: Incremental, periods: Mapping[str, float | None]) -> Group:
    """Return what the archive says of an incremental study beside its histories.

    Args:
        project: the validated project.
        study: what the study file says.
        periods: T1 of each of its variants, s; None where it is not needed.
    """
    group = Group()
    unit = "1" if isinstance(study, LevelFactorStudy) else "m/s^2"
    coordinate(group, "intensity", study.intensities, unit, f"intensity measure: {study.intensity}")
    coordinate(group, "variant", list(periods), "", "name of the variant")
    used = [getattr(study, "period", None) or period for period in periods.values()]
    group.add("period", ("variant",), _numbers(used), "s", "period of the spectral acceleration")
    reference = [level_intensity(project, study, period) for period in used]
    group.add("level_intensity", ("variant",), _numbers(reference), unit, "intensity of the hazard level")
    limits = {name: [limit.measure, limit.value] for name, limit in study.limits.items()}
    group.attributes |= {
        "name": study.name,
        "intensity_measure": study.intensity,
        "intensity_unit": unit,
        "level": study.level,
        "collapse_drift": study.collapse_drift,
        "limits": limits,
    }
    return group


_NOTHING_KEPT = {"histories": (), "members": (), "sections": (), "fibres": ()}


def _chain(study: Incremental, variant: str, dampers: bool, record: str) -> Chain:
    chain = Chain(study, variant, record, ())
    first = HistoryAnalysis(
        kind="history",
        name=study.name,
        variant=variant,
        dampers=dampers,
        record=record,
        level=study.level or "" if isinstance(study, LevelFactorStudy) else "",
        collapse_drift=study.collapse_drift,
    )
    each = (f"{chain.name}.{intensity_text(study, intensity)}" for intensity in study.intensities)
    end = study.free_vibration  # in s already, which a model would want with its unit
    named = tuple(first.model_copy(update={"name": name, "free_vibration": end}) for name in each)
    return replace(chain, histories=named)


def _not_run(project: Project, spec: HistoryAnalysis, status: str, reason: str) -> Group:
    about = {"status": status, "reason": reason, "height": project.frame.height}
    return Group(attributes={**labels(spec), **about})


def _share(progress: Callable[[int, int], None] | None, number: int, count: int) -> Callable[[int, int], None] | None:
    if progress is None:
        return None
    return lambda done, steps: progress(number * steps + done, count * steps)


def _numbers(values: Sequence[float | None]) -> np.ndarray:
    return np.array([np.nan if value is None else value for value in values])
