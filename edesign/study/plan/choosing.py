"""The records that a project has chosen for it: made once, before anything runs."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from edesign.codes.motion_sets import DAMPING
from edesign.core import CoreError
from edesign.errors import EdesignError, InputError
from edesign.ground_motion.hazard import checked_hazard
from edesign.ground_motion.record_choice import EarlierChoice, RecordChoice, choose
from edesign.one_thread import one_thread
from edesign.project.analysis_file import File
from edesign.project.records.records import ChosenRecords
from edesign.project.study.study import Study
from edesign.study.analysis.modal import fundamental_period
from edesign.study.motions.motions import target_spectrum
from edesign.study.results.kinds import RECORDS
from edesign.study.results.provenance import code_checksum


def with_choices(project: File, archive: Path | None = None) -> File:
    """Return the project with its records chosen; the project itself if it has none to choose.

    Args:
        project: from `load_project`.
        archive: of an earlier run, whose choice is taken where nothing has changed that it depends on.

    Raises:
        InputError: a record cannot be chosen, or the frame, whose T_1 is needed, cannot be built.
        AnalysisError: T_1 cannot be found.
    """
    wanted = {name: spec for name, spec in project.records.items() if isinstance(spec, ChosenRecords)}
    if not wanted:
        return project
    project.check_unchanged()
    checked_hazard(project)

    @cache
    def period() -> float | None:
        try:
            return max(fundamental_period(project) or (), default=None)  # of a building the longer one
        except CoreError as error:
            raise InputError(f"{project.where(project.grid_key)}: {project.grid_key}: {error}") from error

    choices: dict[str, RecordChoice] = {}
    with one_thread():
        for name, spec in wanted.items():
            T_1 = spec.T_1 if spec.T_1 is not None else period()
            assert T_1 is not None  # a frame without masses needs the key, which was checked
            try:
                target = target_spectrum(project, name).with_damping(DAMPING)
                choices[name] = choose(spec, project.path, target, T_1, _earlier(archive, name, spec.choose))
            except InputError as error:
                raise InputError(f"{project.where('records', name)}: records.{name}: {error}") from error
    return project.with_choices(choices)


def study_with_choices(study: Study, archive: Path | None = None) -> Study:
    """Return the study with the records of its project chosen; otherwise as `with_choices`.

    They are chosen once, for T_1 of the bare frame, so that all variants are under the same motions.
    """
    base = with_choices(study.base, archive)
    return study if base is study.base else study.model_copy().set_base(base)


def _earlier(archive: Path | None, name: str, count: int) -> EarlierChoice | None:
    """The choice in an archive; None where there is no archive, or none that can be read, or no choice in it."""
    if archive is None or not archive.is_file():
        return None
    from edesign.archive.reader import open_archive  # it loads h5py, which a first run does not need yet

    try:
        with open_archive(archive) as opened:
            if opened.attributes.get("code_checksum") != code_checksum():
                return None  # another program may choose otherwise
            place = f"{RECORDS}/{name}"
            choice = opened.group_attributes(place).get("choice") if opened.has(place) else None
    except EdesignError:
        return None
    factors = choice.get("factors") if isinstance(choice, dict) else None
    if not isinstance(choice, dict) or not isinstance(factors, dict) or len(factors) != count:
        return None
    return EarlierChoice(str(choice.get("checksum")), tuple(factors), choice.get("exhaustive") is True)
