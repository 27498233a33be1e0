"""Run a project or a study: every analysis of the plan, each into the archive as soon as it is finished."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from pathlib import Path

from edesign.project.analysis.analyses import BuildingHistory
from edesign.project.analysis_file import AnalysisFile
from edesign.project.building.building import Building
from edesign.project.study.study import Study
from edesign.study.check.advice import project_warnings, study_warnings, unjudged
from edesign.study.check.check import check_inputs, check_study_inputs
from edesign.study.plan.choosing import study_with_choices, with_choices
from edesign.study.plan.plan import make_plan
from edesign.study.plan.study_plan import make_study_plan, verifying_histories, wanted_designs
from edesign.study.plan.variants import variant_strain
from edesign.study.results.kinds import DESIGNS
from edesign.study.results.provenance import root_group, study_root_group
from edesign.study.run.backends import make_backend
from edesign.study.run.building import archive_design, archived_warnings
from edesign.study.run.incremental import study_stripes
from edesign.study.run.outcome import Outcome, RunSummary
from edesign.study.run.progress import Listener, silent
from edesign.study.run.run_plan import run_plan
from edesign.study.run.state import Job, Prepared, RunState
from edesign.study.run.study_designs import study_designs

__all__ = ["Outcome", "RunSummary", "default_archive_path", "run_project", "run_study"]


def run_project(
    project: AnalysisFile,
    archive_path: str | os.PathLike[str] | None = None,
    *,
    progress: Listener | None = None,
    workers: int = 1,
    only: Sequence[str] = (),
    fresh: bool = False,
    backend: str = "threads",
    scheduler: str | None = None,
    overwrite: bool = False,
) -> RunSummary:
    """Run the analyses of a project or a building, and archive them; those of a building beside its design.

    An analysis that fails is archived as failed with its reason, and the run goes on. Results of an interrupted run
    of the same project, inputs and versions are reused. Results depend neither on `backend` nor on `workers`.

    Args:
        project: from `load_project` or `load_building`.
        archive_path: the archive; by default what the project says, with the names appended if `only` selects some.
        progress: called with a `Progress` at every step worth a line, from one thread at a time.
        workers: number of analyses that run at the same time.
        only: names of the analyses to run; all if empty.
        fresh: True discards the results of an interrupted run.
        backend: "serial", "threads", or "dask".
        scheduler: address of a dask scheduler, such as tcp://host:8786; None: a cluster on this machine.
        overwrite: True replaces the archive of another project too; that of this project is replaced anyway.

    Returns:
        Where the archive is and how each analysis ended.

    Raises:
        InputError: an unknown name in `only`, a record that cannot be read, a frame that cannot be built.
        ArchiveError: the archive cannot be written, or is that of another project; what was archived before stays in
            the partial file.
        Interrupted: stopped by the user (Ctrl-C) or by SIGTERM; finished analyses stay in the partial file.
    """
    path = Path(archive_path) if archive_path is not None else default_archive_path(project, only)
    project = with_choices(project.afresh(), None if fresh else path)
    plan = make_plan(project, only)
    recordings = check_inputs(project, [task.spec for task in plan])
    checksums = {name: found.record.checksum for name, found in recordings.items()}
    root = root_group(project, [task.name for task in plan], checksums)
    warnings = archived_warnings(project) if isinstance(project, Building) else []
    warnings += project_warnings(project, {name: item.record for name, item in recordings.items()})

    def prepare(run: RunState) -> Prepared:
        if isinstance(project, Building) and not only:
            archive_design(project, path, run)
        return lambda task: (project, task.spec)

    job = Job(project.path, project, plan, recordings, root, tuple(warnings), prepare)
    with make_backend(backend, workers, scheduler) as made:
        return run_plan(job, path, progress or silent, made, workers, fresh, overwrite)


def run_study(
    study: Study,
    archive_path: str | os.PathLike[str] | None = None,
    *,
    progress: Listener | None = None,
    workers: int = 1,
    only: Sequence[str] = (),
    fresh: bool = False,
    backend: str = "threads",
    scheduler: str | None = None,
    overwrite: bool = False,
) -> RunSummary:
    """Make the designs of a study, run its analyses, and archive all of it; otherwise as `run_project`.

    A design that fails is archived with its history, and the analyses of its variants fail with its reason.

    Args:
        study: from `load_study`.
        archive_path: the archive; by default what the study says, with the names appended if `only` selects some.
        progress: called with a `Progress` at every step worth a line, from one thread at a time.
        workers: number of designs or analyses that run at the same time.
        only: names of the analyses to run; all if empty.
        fresh: True discards the results of an interrupted run.
        backend: "serial", "threads", or "dask".
        scheduler: address of a dask scheduler, such as tcp://host:8786; None: a cluster on this machine.
        overwrite: True replaces the archive of another study too; that of this study is replaced anyway.

    Raises:
        InputError, ArchiveError, Interrupted: as `run_project`.
    """
    path = Path(archive_path) if archive_path is not None else default_archive_path(study, only)
    study = study_with_choices(study.afresh(), None if fresh else path)
    plan = make_study_plan(study, only)
    recordings = check_study_inputs(study, plan)
    checksums = {name: found.record.checksum for name, found in recordings.items()}
    root = study_root_group(study, [task.name for task in plan], checksums)
    resumable = tuple(f"{DESIGNS}/{name}" for name in study.designs)
    warnings = study_warnings(study, plan, {name: item.record for name, item in recordings.items()})
    warnings += [] if only else unjudged(study, plan)

    def prepare(run: RunState) -> Prepared:
        frames = study_designs(study, run)
        return frames if run.stopped() else study_stripes(study, run, frames)

    strains = {name: variant_strain(study, name) for name in study.variants}
    shaken = [task.spec for task in plan if isinstance(task.spec, BuildingHistory)]
    for name in wanted_designs(study, plan) if study.base.structure == "building" else ():
        shaken += [spec for spec in verifying_histories(study, name, 1) if isinstance(spec, BuildingHistory)]
    # pairs are fitted by the angles of the histories
    base = study.base.model_copy(update={"analyses": tuple(shaken)}) if shaken else study.base
    job = Job(study.path, base, plan, recordings, root, tuple(warnings), prepare, resumable, strains)
    with make_backend(backend, workers, scheduler) as made:
        return run_plan(job, path, progress or silent, made, workers, fresh, overwrite)


def default_archive_path(source: AnalysisFile | Study, only: Sequence[str] = ()) -> Path:
    """Return the path of the archive of a run, as the file gives it.

    A run of some analyses alone has an archive of its own beside the full one.

    Args:
        only: names of the analyses to which the run is restricted; empty: all.
    """
    path = source.archive_path
    if not only:
        return path
    asked = re.sub(r"[^\w.+-]", "_", "+".join(only))  # names that do not exist, which the plan refuses, may be paths
    return path.with_name(f"{path.stem}.{asked[:80]}{path.suffix}")
