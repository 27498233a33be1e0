"""What is checked before a run: records, frames with their dampers and modes, designs of a study."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from edesign.archive.dataset import Group
from edesign.core import CoreError
from edesign.errors import AnalysisError, InputError
from edesign.frame.damping import modal_ratios, modes_needed
from edesign.ground_motion.hazard import checked_hazard
from edesign.ground_motion.pairs import find_pairs, first_components
from edesign.ground_motion.project_records import find_recordings, references
from edesign.ground_motion.sources import Found
from edesign.project.analysis.analyses import (
    BuildingHistory,
    HistoryAnalysis,
    ModalAnalysis,
    PlannedAnalysis,
    PushoverAnalysis,
)
from edesign.project.analysis.damping import CaugheyDamping, MassDamping, StiffnessDamping
from edesign.project.analysis.outputs import Outputs
from edesign.project.analysis.pushover import GivenPattern, Pushover
from edesign.project.analysis_file import AnalysisFile
from edesign.project.building.building import Building
from edesign.project.dampers.placement import PlacementDesign
from edesign.project.reading.problems import keys_text
from edesign.project.records.pairs import InSpace
from edesign.project.records.records import record_of
from edesign.project.study.study import Study
from edesign.space.file_places import place_and_motion
from edesign.space.nonlinear.stability import softest_motion
from edesign.study.analysis.dampers import device_laws
from edesign.study.analysis.intensity import check_hazard_curves
from edesign.study.analysis.modal import mode_count
from edesign.study.analysis.structure import Structure, frame_alone, make_frame, make_structure
from edesign.study.check.criteria_inputs import check_criteria_inputs
from edesign.study.check.spectrum_reach import check_incremental_reach, check_project_reach, check_pushover_reach
from edesign.study.design.beside import Standing, standing_of
from edesign.study.design.design import check_sizing
from edesign.study.motions.applied import check_motion
from edesign.study.motions.motions import check_fits
from edesign.study.motions.pairs import check_pair_fits
from edesign.study.placement.placement import check_placement
from edesign.study.plan.device_factors import factors_in_force
from edesign.study.plan.plan import Task
from edesign.study.plan.study_plan import histories_of_a_round, verification_records, wanted_designs
from edesign.study.plan.variants import variant_warnings
from edesign.study.results.requested import requested_quantities


def check_inputs(project: AnalysisFile, specs: Iterable[PlannedAnalysis]) -> dict[str, Found]:
    """Check the inputs of analyses before the first one starts: records, frame, outputs and modes.

    Args:
        project: from `load_project`.
        specs: the analyses that will run, those of suites in their parts.

    Returns:
        The recordings that they need, by reference, those of a suite all together.

    Raises:
        InputError: the values are not those of the text, a record cannot be read, applied or fitted to the spectrum,
            the frame cannot be built, is a mechanism or has parts that are not connected, an output does not exist in
            it, or it has fewer modes than are asked for.
    """
    project.check_unchanged()
    return _check_inputs(project, specs)


def _check_inputs(project: AnalysisFile, specs: Iterable[PlannedAnalysis]) -> dict[str, Found]:
    specs = tuple(specs)
    if project.hazard is not None:
        checked_hazard(project)
    histories = [spec for spec in specs if isinstance(spec, HistoryAnalysis)]
    wanted = {record_of(spec.record) for spec in histories}
    wanted |= {spec.vertical.record for spec in histories if spec.vertical is not None and spec.vertical.record}
    names = [name for name in project.records if name in wanted]
    found = find_recordings(project, [reference for name in names for reference in references(project, name)])
    acting = found | first_components(project, found)
    for spec in histories:
        check_motion(project, spec, acting[spec.record].record)
    check_fits(project, found)
    for name in names:
        if isinstance(project.records[name], InSpace):
            check_pair_fits(project, name, find_pairs(project, name, found))
    _check_frame(project, specs)
    check_project_reach(project, specs)
    return found


def _check_frame(project: AnalysisFile, specs: tuple[PlannedAnalysis, ...]) -> None:
    """Build a frame with its dampers and its outputs, and look for mechanisms and modes."""
    structure = checked_structure(project)
    if isinstance(project, Building):
        _check_standing(project, structure)
    _check_modes(project, specs, structure.most_modes)
    if any(isinstance(spec, HistoryAnalysis) for spec in specs):
        _check_series(project)


def checked_structure(project: AnalysisFile) -> Structure:
    """Build a frame with its dampers and its outputs, and look for mechanisms.

    Args:
        project: from `load_project` or `load_building`.

    Raises:
        InputError: the frame cannot be built, is a mechanism or has parts that are not connected, or an output does not
            exist in it.
    """
    try:
        frame = make_frame(project, dampers=True)  # with footings, at the first period of a frame that must stand
        requested_quantities(project, frame, Group())
        return make_structure(project, frame)
    except CoreError as error:
        laws = device_laws(project)
        runs = project.dampers.devices if project.dampers is not None else ()
        restrained = any(law.restrained for law in laws.values())
        where = f"{project.where(project.grid_key)}: {project.grid_key}"
        if isinstance(project, Building):
            where = place_and_motion(project, str(error))
        if restrained and not any(run.carries_gravity for run in runs):
            need = "`carries_gravity: true`"
            if not runs:
                need += " and a place in `dampers.devices`, of any first size where a design finds theirs"
            raise InputError(f"{where}: braces that it stands by need {need}: {error}") from error
        raise InputError(f"{where}: {error}") from error


def _check_standing(building: Building, structure: Structure) -> None:
    """Check that a building is stable under its gravity loads, with which all else begins, and say what moves if not.

    One that is too weak for them is told by its analyses.
    """
    try:
        structure.apply_gravity()
    except AnalysisError as error:
        if building.masses is None or "unstable" not in str(error):
            return
        frame = make_frame(building, dampers=True)
        modes = make_structure(building, frame).modes(1)
        keys = ("supports",) if building.root.child("supports") is not None else (building.grid_key,)
        raise InputError(
            f"{building.where(*keys)}: {keys_text(keys)}: {softest_motion(frame, modes)}, with a period of "
            f"{modes.period[0]:.3g} s before it is loaded: {error}"
        ) from error


def check_study_inputs(study: Study, plan: Sequence[Task]) -> dict[str, Found]:
    """Check the inputs of a study before its first analysis; otherwise as `check_inputs`.

    Args:
        study: from `load_study`.

    Raises:
        InputError: also if no damper reaches the target of a design, a law has no parameters at a temperature, or the
            intensities of a hazard curve do not rise.
    """
    study.check_unchanged()
    study.base.check_unchanged()
    references = [task.record for task in plan if task.record is not None]
    designs = wanted_designs(study, plan)
    verified = [item for name in designs for item in verification_records(study, name)]
    kind = BuildingHistory if study.base.structure == "building" else HistoryAnalysis
    histories = [
        kind(kind="history", name="verification", record=reference)
        for reference in dict.fromkeys(verified)
        if reference not in references
    ]
    details = study.outputs.details
    members = details.members if details is not None else ()
    base = study.base.model_copy(update={"outputs": Outputs(histories=(), members=members)})
    specs = (*(task.spec for task in plan), *histories)
    found = _check_inputs(base, specs)
    check_hazard_curves(study)
    check_incremental_reach(study)
    for i, pushed in enumerate(study.pushovers):
        check_pushover_reach(study.base, pushed, study.where("pushovers", i, "pattern"), ("pushovers", i, "pattern"))
    for name, variant in study.variants.items():
        if variant.values:
            try:
                _check_frame(study.project_of(name).model_copy(update={"outputs": base.outputs}), specs)
            except InputError as error:
                source = study.derived.get(name)
                keys = source.keys if source is not None else ("variants", name, "values")
                raise InputError(f"{study.where(*keys)}: {keys_text(keys)}: {error}") from error
    _check_study_modes(study)
    _check_designs(study, designs)
    variant_warnings(study, plan)
    check_criteria_inputs(study, found)
    return found


def _check_study_modes(study: Study) -> None:
    """Check that a study asks for no more modes than there are degrees of freedom with mass."""
    wanted: list[tuple[tuple[str | int, ...], int]] = []
    if study.modal.modes is not None:
        wanted.append((("modal", "modes"), study.modal.modes))
    for i, item in enumerate(study.pushovers):
        wanted += [(("pushovers", i, "pattern"), count) for count in _pattern_modes(item)]
    if wanted:
        most = mode_count(study.base)
        for keys, count in wanted:
            if count > most:
                raise InputError(f"{study.where(*keys)}: {keys_text(keys)}: {_no_mode(count, most)}")


def _check_designs(study: Study, names: Sequence[str]) -> None:
    """Size designs once; a placement builds the frame with all its candidates."""
    sized: dict[str, Standing | None] = {}
    for name in names:
        try:
            spec = study.designs[name]
            beside = standing_beside(study, name, sized)
            if beside is None:
                continue
            if isinstance(spec, PlacementDesign):
                check_placement(study.base, name, spec, histories_of_a_round(study, name), beside)
            else:
                factors = factors_in_force(study, study.hazard)
                sized[name] = check_sizing(study.base, name, spec, study.folder, factors, beside)
        except InputError as error:
            raise InputError(f"{study.where('designs', name)}: {error}") from error


def standing_beside(study: Study, name: str, sized: Mapping[str, Standing | None]) -> Standing | None:
    """Return the dampers beside which a design is sized; None: the sizing of one of them does not converge.

    Args:
        sized: of the designs above it that are not placements.
    """
    found = [sized.get(other) for other in study.beside(name)]
    known = [one for one in found if one is not None]
    return standing_of(known) if len(known) == len(found) else None


def _check_modes(project: AnalysisFile, specs: tuple[PlannedAnalysis, ...], most: int) -> None:
    """Check that no more modes are asked for than there are degrees of freedom with mass."""
    wanted: list[tuple[tuple[str | int, ...], int]] = [
        (("analyses", i, "modes"), spec.modes)
        for i, spec in enumerate(project.analyses)
        if spec in specs and isinstance(spec, ModalAnalysis)
    ]
    for i, spec in enumerate(project.analyses):
        if isinstance(spec, PushoverAnalysis):
            wanted += [(("analyses", i, "pattern"), count) for count in _pattern_modes(spec)]
    damping = project.damping
    if any(isinstance(spec, HistoryAnalysis) for spec in specs):
        key = "mode" if isinstance(damping, (MassDamping, StiffnessDamping)) else "modes"
        wanted.append((("damping", key), modes_needed(damping, 0)))
    for keys, count in wanted:
        if count > most:
            raise InputError(f"{project.where(*keys)}: {keys_text(keys)}: {_no_mode(count, most)}")


def _pattern_modes(pushover: Pushover) -> list[int]:
    """How many modes the patterns of a pushover need."""
    given = [pattern for pattern in pushover.pattern if isinstance(pattern, GivenPattern)]
    return [count for pattern in given if (count := pattern.mode or pattern.modes) is not None]


def _check_series(project: AnalysisFile) -> None:
    """Check that Caughey damping gives no mode a negative ratio."""
    damping = project.damping
    if not isinstance(damping, CaugheyDamping):
        return
    alone = frame_alone(project)
    if damping.state == "gravity":
        alone.apply_gravity()
    try:
        modal_ratios(damping, alone.modes(alone.most_modes).omega)
    except InputError as error:
        raise InputError(f"{project.where('damping')}: damping: {error}") from error


def _no_mode(count: int, most: int) -> str:
    return f"there is no mode {count}; the frame has {most} degrees of freedom with mass [E-MODAL-03]"
