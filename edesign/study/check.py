"""What is checked before a run, and by `edesign check`: records, the frame, its first period."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from edesign.archive.dataset import Group
from edesign.building.frame import build_frame
from edesign.core import CoreError
from edesign.errors import AnalysisError, InputError
from edesign.ground_motion.project_records import read_record
from edesign.project.analyses import Analysis, HistoryAnalysis, ModalAnalysis
from edesign.project.damping import ModalDamping, RayleighDamping
from edesign.project.problems import keys_text
from edesign.project.project import Project
from edesign.study import analyses
from edesign.study.advice import advice
from edesign.study.history import check_motion
from edesign.study.requested import requested_quantities
from edesign.study.structure import make_structure


def check_inputs(project: Project, records: Iterable[str], specs: Iterable[Analysis] = ()) -> dict[str, str]:
    """Read records, build the frame and look for the outputs, so that what is wrong shows before the first analysis.

    Args:
        project: from `load_project`.
        records: names of the records that are needed.
        specs: the analyses that will run.

    Returns:
        SHA-256 of the samples of each record, by name.

    Raises:
        InputError: a record cannot be read or applied, the frame cannot be built, is a mechanism or has parts that are
            not connected, an output does not exist in it, or it has fewer modes than are asked for.
    """
    specs = tuple(specs)
    found = {name: read_record(project, name) for name in sorted(set(records))}
    for spec in specs:
        if isinstance(spec, HistoryAnalysis):
            check_motion(project, spec, found[spec.record])
    frame = build_frame(project)
    requested_quantities(project, frame, Group())
    try:
        structure = make_structure(project, frame)
    except CoreError as error:
        raise InputError(f"{project.where('frame')}: frame: {error}") from error
    _check_modes(project, specs, int(np.count_nonzero(structure.analysis.masses())))
    return {name: record.checksum for name, record in found.items()}


def _check_modes(project: Project, specs: tuple[Analysis, ...], most: int) -> None:
    """Check that no more modes are asked for than there are degrees of freedom with mass."""
    wanted: list[tuple[tuple[str | int, ...], int]] = [
        (("analyses", i, "modes"), spec.modes)
        for i, spec in enumerate(project.analyses)
        if spec in specs and isinstance(spec, ModalAnalysis)
    ]
    damping = project.damping
    if any(isinstance(spec, HistoryAnalysis) for spec in specs):
        if isinstance(damping, RayleighDamping):
            wanted.append((("damping", "modes"), max(damping.modes)))
        elif isinstance(damping, ModalDamping):
            wanted.append((("damping", "modes"), damping.modes))
    for keys, count in wanted:
        if count > most:
            raise InputError(
                f"{project.where(*keys)}: {keys_text(keys)}: there is no mode {count}; "
                f"the frame has {most} degrees of freedom with mass"
            )


def check_project(project: Project) -> dict[str, str]:
    """Check what a run would meet, and describe the project in a few lines.

    Args:
        project: from `load_project`.

    Returns:
        Text by label: title, frame, members, period (first period under gravity), records, analyses, archive;
        and notes, if something is allowed but may not be meant.

    Raises:
        InputError: a record cannot be read, or the frame cannot be built or is unstable.
        AnalysisError: the first period cannot be found.
    """
    check_inputs(project, project.records, project.analyses)
    period = _first_period(project)
    notes = advice(project, period)
    return {
        "title": project.title,
        "frame": _frame(project),
        "members": _members(project),
        "period": f"T1 = {period:.4f} s under gravity" if period is not None else "no masses",
        "records": ", ".join(project.records) or "none",
        "analyses": ", ".join(f"{spec.name} ({spec.kind})" for spec in project.analyses),
        "archive": str(project.archive_path),
        **({"notes": "; ".join(notes)} if notes else {}),
    }


def _frame(project: Project) -> str:
    frame = project.frame
    width = frame.x[-1] - frame.x[0]
    return (
        f"{_count(frame.n_storeys, 'storey')}, {frame.height:g} m high; "
        f"{_count(frame.n_bays, 'bay')}, {width:g} m wide; {_count(len(frame.nodes), 'node')}"
    )


def _members(project: Project) -> str:
    frame = project.frame
    counts = [_count(len(frame.column_at), "column"), _count(len(frame.beam_at), "beam")]
    if frame.brace_at:
        counts.append(_count(len(frame.brace_at), "brace"))
    return ", ".join(counts)


def _first_period(project: Project) -> float | None:
    if project.masses is None:
        return None
    group = analyses.run_analysis(project, ModalAnalysis(name="check", kind="modal", modes=1))
    if group.attributes.get("status") != "completed":
        raise AnalysisError(f"{project.path}: the first period cannot be found: {group.attributes.get('reason')}")
    return float(group.variables["period"].values[0])


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"
