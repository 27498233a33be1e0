"""Whether the records suit the histories: how much they are scaled."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping

from edesign.ground_motion.plausibility import unusual_scales
from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.project.analysis_file import AnalysisFile
from edesign.project.records.records import record_of
from edesign.study.motions.applied import scale_factor
from edesign.study.motions.motions import AnyMotion
from edesign.study.plan.plan import Task


def scale_warnings(
    project: AnalysisFile,
    tasks: Iterable[Task],
    motions: Mapping[str, AnyMotion],
    scales: Mapping[str, float] | None = None,
) -> dict[str, list[str]]:
    """Return one sentence for each unusual factor on records, by record of the project.

    The factor is that of all scaling between the recording and the ground of a history: of the fit, of the suite, and
    of the history (its level, `scale` or `pga`). Histories of incremental studies are left out: they scale on purpose,
    from small intensities to collapse, and their result is the intensity, not the response at a factor.

    Args:
        motions: recordings made ready, by reference; those that could not be fitted are left out.
        scales: factor of the fit by reference where it is not made yet; that of the motion by default.
    """
    scales = scales or {reference: motion.scale for reference, motion in motions.items()}
    factors: dict[tuple[str, str], dict[str, float]] = defaultdict(dict)
    histories = [task for task in tasks if isinstance(task.spec, HistoryAnalysis)]
    for task in histories:
        motion = motions.get(task.record or "")
        if task.stripe is not None or motion is None or motion.failure or not motion.record.pga:
            continue
        spec = task.spec
        assert isinstance(spec, HistoryAnalysis)
        name, _, member = spec.record.partition("/")
        label = spec.level or (task.entry if spec.pga is not None or spec.scale is not None else "")
        factors[name, label][member or name] = scales[spec.record] * scale_factor(project, spec, motion.record)
    used = {record_of(task.record or "") for task in histories}
    for reference, motion in motions.items():  # of those that only designs are verified with, the fit
        name, _, member = reference.partition("/")
        if name not in used and not motion.failure:
            factors[name, ""][member or name] = scales[reference]
    found: dict[str, list[str]] = defaultdict(list)
    for (name, label), of in factors.items():
        simulated = {key for key in of if _motion(motions, name, key).found.origin == "simulated"}
        prefix = "" if label in ("", name) else f"{label}: "
        found[name] += [f"{prefix}{text}" for text in unusual_scales(of, simulated)]
    return {name: list(dict.fromkeys(texts)) for name, texts in found.items() if texts}


def _motion(motions: Mapping[str, AnyMotion], name: str, member: str) -> AnyMotion:
    return motions[f"{name}/{member}"] if f"{name}/{member}" in motions else motions[name]
