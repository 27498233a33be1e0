"""What is checked before a run, and by `edesign check`: records, the frame, its first period."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from edesign.archive.dataset import Group
from edesign.building.damping import modal_ratios, modes_needed
from edesign.building.isolation import base_masses
from edesign.building.masses import node_masses
from edesign.core import CoreError
from edesign.errors import InputError
from edesign.ground_motion.hazard import checked_hazard
from edesign.ground_motion.project_records import find_recordings, references
from edesign.ground_motion.record_choice import RecordChoice, choice_lines
from edesign.ground_motion.sources import Found
from edesign.one_thread import one_thread
from edesign.project.analysis.analyses import HistoryAnalysis, ModalAnalysis, PlannedAnalysis, PushoverAnalysis
from edesign.project.analysis.damping import CaugheyDamping, MassDamping, StiffnessDamping
from edesign.project.analysis.outputs import Outputs
from edesign.project.analysis.pushover import GivenPattern, Pushover
from edesign.project.dampers.placement import PlacementDesign
from edesign.project.project import Project
from edesign.project.reading.problems import keys_text
from edesign.project.records.records import RecordSet, record_of
from edesign.project.study.study import Study
from edesign.study.advice import project_warnings, record_warnings, study_warnings, unjudged
from edesign.study.choosing import study_with_choices, with_choices
from edesign.study.criteria import check_criteria_inputs
from edesign.study.dampers import device_laws
from edesign.study.design.design import check_sizing, first_warnings
from edesign.study.history import check_motion
from edesign.study.intensity import check_hazard_curves
from edesign.study.modal import fundamental_period, mode_count
from edesign.study.motions import Motion, check_fits, expected_scale
from edesign.study.placement.placement import check_placement
from edesign.study.plan import Task, make_plan
from edesign.study.requested import requested_quantities
from edesign.study.spectrum_reach import check_incremental_reach, check_project_reach, check_pushover_reach
from edesign.study.structure import frame_alone, make_frame, make_structure
from edesign.study.study_plan import make_study_plan, recordings
from edesign.study.suitability import scale_warnings
from edesign.study.variants import variant_warnings

ORIGINS = {"file": "from files", "package": "from packages", "stand-in": "simulated"}


def check_inputs(project: Project, specs: Iterable[PlannedAnalysis]) -> dict[str, Found]:
    """Read records, build the frame and look for the outputs, so that what is wrong shows before the first analysis.

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


def _check_inputs(project: Project, specs: Iterable[PlannedAnalysis]) -> dict[str, Found]:
    specs = tuple(specs)
    if project.hazard is not None:
        checked_hazard(project)
    histories = [spec for spec in specs if isinstance(spec, HistoryAnalysis)]
    wanted = {record_of(spec.record) for spec in histories}
    wanted |= {spec.vertical.record for spec in histories if spec.vertical is not None and spec.vertical.record}
    names = [name for name in project.records if name in wanted]
    found = find_recordings(project, [reference for name in names for reference in references(project, name)])
    for spec in histories:
        check_motion(project, spec, found[spec.record].record)
    check_fits(project, found)
    _check_frame(project, specs)
    check_project_reach(project, specs)
    return found


def _check_frame(project: Project, specs: tuple[PlannedAnalysis, ...]) -> None:
    """Build a frame with its dampers and its outputs, and look for mechanisms and modes."""
    try:
        frame = make_frame(project, dampers=True)  # with footings, at the first period of a frame that must stand
        requested_quantities(project, frame, Group())
        structure = make_structure(project, frame)
    except CoreError as error:
        laws = device_laws(project)
        runs = project.dampers.devices if project.dampers is not None else ()
        idle = any(laws[run.law].restrained and not run.carries_gravity for run in runs)
        hint = "; a frame that stands by its buckling-restrained braces needs `carries_gravity: true` with them"
        raise InputError(f"{project.where('frame')}: frame: {error}{hint if idle else ''}") from error
    _check_modes(project, specs, int(np.count_nonzero(structure.analysis.masses())))
    if any(isinstance(spec, HistoryAnalysis) for spec in specs):
        _check_series(project)


def check_study_inputs(study: Study, plan: Sequence[Task]) -> dict[str, Found]:
    """Check what a study needs before its first analysis; otherwise as `check_inputs`.

    Args:
        study: from `load_study`.
        plan: of the study.

    Raises:
        InputError: also if no damper reaches the target of a design, a law has no parameters at a temperature, or the
            intensities of a hazard curve do not rise.
    """
    study.check_unchanged()
    study.base.check_unchanged()
    references = [task.record for task in plan if task.record is not None]
    designs = wanted_designs(study, plan)
    verified = [item for name in designs for item in verification_records(study, name)]
    histories = [
        HistoryAnalysis(kind="history", name="verification", record=reference)
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
    for name in designs:
        try:
            spec = study.designs[name]
            if isinstance(spec, PlacementDesign):
                check_placement(study.base, name, spec, histories_of_a_round(study, name))
            else:
                check_sizing(study.base, name, spec, study.folder)
        except InputError as error:
            raise InputError(f"{study.where('designs', name)}: {error}") from error
    variant_warnings(study, plan)
    check_criteria_inputs(study, found)
    return found


def wanted_designs(study: Study, plan: Sequence[Task]) -> tuple[str, ...]:
    """Names of the designs that the variants of a plan have, in the order of the file."""
    wanted = {study.variants[task.variant].design for task in plan}
    return tuple(name for name in study.designs if name in wanted)


def verification_records(study: Study, name: str) -> tuple[str, ...]:
    """References of the recordings that a design of a study is verified with."""
    verify = study.designs[name].verify
    return recordings(study, verify.records, ("designs", name, "verify", "records")) if verify is not None else ()


def histories_of_a_round(study: Study, name: str) -> int:
    """How many histories one round of a design's verification takes: its recordings at all its levels."""
    verify = study.designs[name].verify
    return len(verification_records(study, name)) * len(verify.levels or ("",)) if verify is not None else 0


def _check_modes(project: Project, specs: tuple[PlannedAnalysis, ...], most: int) -> None:
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


def _check_series(project: Project) -> None:
    """Check that Caughey damping gives no mode a negative ratio."""
    damping = project.damping
    if not isinstance(damping, CaugheyDamping):
        return
    alone = frame_alone(project)
    if damping.state == "gravity":
        alone.apply_gravity()
    try:
        modal_ratios(damping, alone.modes(int(np.count_nonzero(alone.analysis.masses()))).omega)
    except InputError as error:
        raise InputError(f"{project.where('damping')}: damping: {error}") from error


def _no_mode(count: int, most: int) -> str:
    return f"there is no mode {count}; the frame has {most} degrees of freedom with mass"


@one_thread()
def check_project(project: Project) -> dict[str, str]:
    """Check what a run would meet, and describe the project in a few lines.

    Args:
        project: from `load_project`.

    Returns:
        Text by label: title, frame, members, period (first period under gravity), records, analyses, archive;
        and warnings, one a line, if something is allowed but may not be meant.

    Raises:
        InputError: a record cannot be read, or the frame cannot be built or is unstable.
        AnalysisError: the first period cannot be found.
    """
    project = with_choices(project.afresh(), project.archive_path)
    plan = make_plan(project)
    found = check_inputs(project, [task.spec for task in plan])
    unused = [name for name in project.records if all(name != record_of(key) for key in found)]
    others = find_recordings(project, [key for name in unused for key in references(project, name)])
    period = fundamental_period(project)
    recorded = {name: item.record for name, item in found.items()}
    warnings = [*project_warnings(project, recorded), *record_warnings(recorded), *_scales(project, plan, found)]
    warnings += _failed_choices(project, found)
    return {
        "title": project.title,
        "frame": _frame(project),
        **_mass(project),
        "members": _members(project),
        **({"dampers": _dampers(project)} if project.dampers is not None else {}),
        "period": f"T1 = {period:.4f} s {_standing(project)}" if period is not None else "no masses",
        "records": _records(project, {**found, **others}),
        **_choices(project),
        "analyses": ", ".join(f"{spec.name} ({spec.kind})" for spec in project.analyses),
        "archive": str(project.archive_path),
        **({"warnings": "\n".join(warnings)} if warnings else {}),
    }


@one_thread()
def check_study(study: Study) -> dict[str, str]:
    """Check what a run of a study would meet, and describe it in a few lines.

    Args:
        study: from `load_study`.

    Returns:
        Text by label: title, project, frame, records, designs, variants, analyses, criteria, archive; and
        warnings, one a line.

    Raises:
        InputError: a record cannot be read, or the frame cannot be built or is unstable.
        AnalysisError: the first period cannot be found.
    """
    study = study_with_choices(study.afresh(), study.archive_path)
    plan = make_study_plan(study)
    found = check_study_inputs(study, plan)
    period = fundamental_period(study.base)
    entries = Counter(task.entry for task in plan)
    recorded = {name: item.record for name, item in found.items()}
    warnings = [*study_warnings(study, plan, recorded), *record_warnings(recorded), *unjudged(study, plan)]
    warnings += [*_scales(study.base, plan, found), *_failed_choices(study.base, found)]
    for name in wanted_designs(study, plan):
        design = study.designs[name]
        if not isinstance(design, PlacementDesign):  # whose dampers are known after histories alone
            warnings += first_warnings(study.base, name, design, study.folder)
    return {
        "title": study.title,
        "project": str(study.base.path),
        "frame": _frame(study.base),
        **_mass(study.base),
        "period": f"T1 = {period:.4f} s of the {'bare ' * (study.base.isolation is None)}frame {_standing(study.base)}"
        if period is not None
        else "no masses",
        "records": _records(study.base, found),
        **_choices(study.base),
        "designs": ", ".join(f"{name} ({spec.method})" for name, spec in study.designs.items()) or "none",
        "variants": ", ".join(study.variants),
        "analyses": ", ".join(f"{name} ({count})" if count > 1 else name for name, count in entries.items()),
        "criteria": str(len(study.criteria) + len(study.objectives)),
        "archive": str(study.archive_path),
        **({"warnings": "\n".join(warnings)} if warnings else {}),
    }


def _scales(project: Project, plan: Sequence[Task], found: Mapping[str, Found]) -> list[str]:
    """What is unusual about the factors on the records, before they are fitted."""
    motions = {reference: Motion(reference, item) for reference, item in found.items()}
    scales = {reference: expected_scale(project, reference, found) for reference in found}
    warnings = scale_warnings(project, plan, motions, scales)
    return [f"records {name}: {text}" for name, texts in warnings.items() for text in texts]


def _dampers(project: Project) -> str:
    """How many dampers there are of each law, and the tuned masses."""
    frame = make_frame(project, dampers=True)
    laws = Counter(device.law for device in frame.devices)
    isolators = Counter(device.law for device in frame.isolated.isolators) if frame.isolated is not None else Counter()
    parts = [f"{_count(count, 'isolator')} `{name}`" for name, count in isolators.items()]
    parts += [f"{_count(count, 'damper')} `{name}`" for name, count in (laws - isolators).items()]
    parts += [_count(len(frame.attached), "tuned mass")] if frame.attached else []
    return ", ".join(parts) or "none"


def _records(project: Project, found: Mapping[str, Found]) -> str:
    """The records, and of suites how many of their recordings are real."""
    texts = []
    for name in project.records:
        origins = Counter(item.origin for key, item in found.items() if record_of(key) == name)
        of = ", ".join(f"{count} {ORIGINS[origin]}" for origin, count in origins.items())
        texts.append(f"{name} ({of})" if of and isinstance(project.records[name], RecordSet) else name)
    return ", ".join(texts) or "none"


def _failed_choices(project: Project, found: Mapping[str, Found]) -> list[str]:
    """What the chosen records that are used miss of what the code asks of a set, where they are scaled only."""
    texts = []
    for name in dict.fromkeys(map(record_of, found)):
        choice, match = project.record_choice(name), project.records[name].match
        if isinstance(choice, RecordChoice) and (match is None or match.method == "scale"):
            texts += [
                f"records {name}: not met: {one['clause']}, {one['text']}: {one['value']:.3g}"
                for one in choice.facts()["not_met"]
            ]
    return texts


def _choices(project: Project) -> dict[str, str]:
    """How the records were chosen that are, and what was left out of the choice."""
    lines = []
    for name in project.records:
        choice = project.record_choice(name)
        if not isinstance(choice, RecordChoice):
            continue
        lines.append(f"{name}: the best {len(choice.factors)} of {choice.compared}")
        lines += [f"  {line}" for line in choice_lines(choice.facts())]
        lines += [f"  {recording} x {factor:.3f}" for recording, factor in choice.factors.items()]
        lines += [f"  left out: {refusal.name}: {refusal.reason}" for refusal in choice.refused]
    return {"chosen": "\n".join(lines)} if lines else {}


def _frame(project: Project) -> str:
    frame = project.frame
    width = frame.x[-1] - frame.x[0]
    return (
        f"{_count(frame.n_storeys, 'storey')}, {frame.height:g} m high; "
        f"{_count(frame.n_bays, 'bay')}, {width:g} m wide; {_count(len(frame.nodes), 'node')}"
    )


def _mass(project: Project) -> dict[str, str]:
    """The mass of the frame and of each floor, in which a wrong unit or a missing load shows first."""
    of_node = node_masses(project)
    if not of_node:
        return {}
    of_floor = dict.fromkeys(range(1, project.frame.n_storeys + 1), 0.0)
    for name, mass in of_node.items():
        level = project.frame.nodes[name][1]
        of_floor[min(of_floor, key=lambda floor: abs(project.frame.y[floor] - level))] += mass
    floors = ", ".join(f"{mass / 1e3:.4g}" for mass in of_floor.values())
    base = "" if project.isolation is None else f"; of the base {sum(base_masses(project).values()) / 1e3:.4g} t"
    return {"mass": f"{sum(of_node.values()) / 1e3:.4g} t; of the floors from the lowest: {floors} t{base}"}


def _standing(project: Project) -> str:
    """How the frame stands whose period is told."""
    isolation = project.isolation
    braced = any(law.restrained for law in device_laws(project).values())
    braces = ", with its buckling-restrained braces" if braced else ""
    if isolation is None:
        return f"under gravity{braces}"
    return f"under gravity{braces}, on its isolators at {1e3 * isolation.design_displacement:g} mm"


def _members(project: Project) -> str:
    frame = project.frame
    counts = [_count(len(frame.column_at), "column"), _count(len(frame.beam_at), "beam")]
    if frame.brace_at:
        counts.append(_count(len(frame.brace_at), "brace"))
    return ", ".join(counts)


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}" if number == 1 else f"{number} {noun}{'es' if noun.endswith('ss') else 's'}"
