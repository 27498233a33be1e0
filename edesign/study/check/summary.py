"""What `edesign check` says of a project or a study: what there is in it, and what may not be meant."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from edesign.errors import AnalysisError, split_code
from edesign.frame.isolation import base_masses
from edesign.frame.masses import node_masses
from edesign.ground_motion.project_records import find_recordings, references
from edesign.ground_motion.record_choice import RecordChoice, choice_lines
from edesign.ground_motion.sources import Found
from edesign.one_thread import one_thread
from edesign.project.analysis_file import AnalysisFile
from edesign.project.building.building import Building
from edesign.project.dampers.device_names import devices_by_name
from edesign.project.dampers.placement import PlacementDesign
from edesign.project.project import Project
from edesign.project.reading.words import counted
from edesign.project.records.pairs import InSpace
from edesign.project.records.records import RecordSet, record_of
from edesign.project.study.study import Study
from edesign.space.check import check_building
from edesign.space.nonlinear.isolation import base_mass
from edesign.study.analysis.dampers import (
    device_laws,
    laws_that_stand,
    with_restrained_braces,
    without_dampers_in_modes,
)
from edesign.study.analysis.modal import fundamental_period
from edesign.study.analysis.structure import make_frame
from edesign.study.check.advice import (
    named_record_warnings,
    project_warnings,
    study_warnings,
    unbuckled_members,
    unjudged,
)
from edesign.study.check.check import check_inputs, check_study_inputs, checked_structure, standing_beside
from edesign.study.check.criteria_inputs import too_few_motions
from edesign.study.check.histories import histories_text
from edesign.study.check.plausibility import sizes
from edesign.study.check.suitability import scale_warnings
from edesign.study.design.beside import Standing
from edesign.study.design.design import check_sizing, first_warnings
from edesign.study.motions.motions import Motion, expected_scale
from edesign.study.placement.placement import check_placement
from edesign.study.plan.choosing import study_with_choices, with_choices
from edesign.study.plan.device_factors import factors_in_force
from edesign.study.plan.plan import Task, make_plan
from edesign.study.plan.study_plan import histories_of_a_round, make_study_plan, wanted_designs

ORIGINS = {"file": "from files", "package": "from packages", "simulated": "simulated"}


@one_thread()
def check_project(project: AnalysisFile) -> dict[str, str]:
    """Check the inputs of a project or a building, and describe it in a few lines.

    Args:
        project: from `load_project` or `load_building`.

    Returns:
        Text by label: title, frame, members, period (first period under gravity), records, analyses, histories,
        archive; of a building what `check_building` says, and the last five if it has analyses; and warnings, one a
        line, if something is allowed but may not be meant.

    Raises:
        InputError: a record cannot be read, or the frame cannot be built or is unstable.
        AnalysisError: the first period cannot be found.
    """
    if isinstance(project, Building) and not project.analyses:
        if project.design is None:
            checked_structure(project)
        return _warnings_last(_described(project), [])
    project = with_choices(project.afresh(), project.archive_path)
    plan = make_plan(project)
    found = check_inputs(project, [task.spec for task in plan])
    unused = [name for name in project.records if all(name != record_of(key) for key in found)]
    others = find_recordings(project, [key for name in unused for key in references(project, name)])
    periods = _periods(project)
    recorded = {name: item.record for name, item in found.items()}
    warnings = [*project_warnings(project, recorded), *named_record_warnings(recorded), *_scales(project, plan, found)]
    warnings += unbuckled_members(project, plan)
    warnings += _failed_choices(project, found)
    facts = {
        **_described(project),
        "period": f"{_shown(periods)} {_standing(project)}" if periods is not None else "no masses",
        "records": _records(project, {**found, **others}),
        **_choices(project),
        "analyses": ", ".join(f"{spec.name} ({spec.kind})" for spec in project.analyses),
        **histories_text(project, plan, found),
        "archive": str(project.archive_path),
    }
    return _warnings_last(facts, warnings)


def _described(project: AnalysisFile) -> dict[str, str]:
    """The title, and what there is without analyses."""
    if isinstance(project, Building):
        dampers = {} if project.dampers is None else {"dampers": _building_dampers(project)}
        return {**check_building(project), **dampers}
    assert isinstance(project, Project)
    return {
        "title": project.title,
        "frame": _frame(project),
        **_mass(project),
        "members": _members(project),
        **({"dampers": _dampers(project)} if project.dampers is not None else {}),
    }


def _warnings_last(facts: dict[str, str], warnings: Sequence[str]) -> dict[str, str]:
    """The facts, then their warnings and others, one a line."""
    own = facts.pop("warnings", "").splitlines()
    found = [*own, *warnings]
    return {**facts, **({"warnings": "\n".join(found)} if found else {})}


@one_thread()
def check_study(study: Study) -> dict[str, str]:
    """Check the inputs of a study, and describe it in a few lines.

    Args:
        study: from `load_study`.

    Returns:
        Text by label: title, project, frame, records, designs, variants, analyses, histories, criteria, archive; and
        warnings, one a line.

    Raises:
        InputError: a record cannot be read, or the frame cannot be built or is unstable.
        AnalysisError: the first period cannot be found.
    """
    study = study_with_choices(study.afresh(), study.archive_path)
    plan = make_study_plan(study)
    found = check_study_inputs(study, plan)
    periods = _periods(study.base)
    entries = Counter(task.entry for task in plan)
    recorded = {name: item.record for name, item in found.items()}
    warnings = [*study_warnings(study, plan, recorded), *named_record_warnings(recorded), *unjudged(study, plan)]
    warnings += [*_scales(study.base, plan, found), *_failed_choices(study.base, found)]
    warnings += unbuckled_members(study.base, plan, study.designs)
    placements, factors = [], factors_in_force(study, study.hazard)
    sized: dict[str, Standing | None] = {}
    for name in wanted_designs(study, plan):
        design = study.designs[name]
        beside = standing_beside(study, name, sized)
        if beside is not None and isinstance(design, PlacementDesign):  # whose dampers are known after histories alone
            extent = check_placement(study.base, name, design, histories_of_a_round(study, name), beside)
            placements += [f"{name}: {extent}"] if extent else []
        elif beside is not None and not isinstance(design, PlacementDesign):
            warnings += first_warnings(study.base, name, design, study.folder, factors, beside)
            if any(name in study.beside(other) for other in study.designs):
                sized[name] = check_sizing(study.base, name, design, study.folder, factors, beside)
        warnings += [f"design {name}: {text}" for text in too_few_motions(study, name)]
    return {
        "title": study.title,
        "project": str(study.base.path),
        **_structure(study.base),
        "period": f"{_shown(periods)} of the {_bare(study.base)} {_standing(study.base)}"
        if periods is not None
        else "no masses",
        "records": _records(study.base, found),
        **_choices(study.base),
        "designs": ", ".join(f"{name} ({spec.method})" for name, spec in study.designs.items()) or "none",
        **({"placements": "\n".join(placements)} if placements else {}),
        "variants": ", ".join(study.variants),
        "analyses": ", ".join(f"{name} ({count})" if count > 1 else name for name, count in entries.items()),
        **histories_text(study.base, plan, found),
        "criteria": str(len(study.criteria) + len(study.objectives)),
        "archive": str(study.archive_path),
        **({"warnings": "\n".join(warnings)} if warnings else {}),
    }


def _structure(base: AnalysisFile) -> dict[str, str]:
    """What a plane frame or a building consists of, and its masses."""
    if isinstance(base, Building):
        said = check_building(base)
        return {label: said[label] for label in ("plan", "storeys", "members", "loads", "masses")}
    assert isinstance(base, Project)
    return {"frame": _frame(base), **_mass(base)}


def _bare(base: AnalysisFile) -> str:
    return f"{'bare ' * (base.isolation is None)}{base.structure}"


def _shown(periods: Sequence[float]) -> str:
    """First periods for people: `T1 = 0.8123 s`, of a building with its directions."""
    along = [
        f"{period:.4f} s{f' along {axis}' * (len(periods) > 1)}" for axis, period in zip("xy", periods, strict=False)
    ]
    return f"T1 = {' and '.join(along)}"


def _periods(project: AnalysisFile) -> tuple[float, ...] | None:
    """The first periods; where there is none, the sizes in which a slip of a unit shows stand in the message.

    Raises:
        AnalysisError: the first period cannot be found.
    """
    try:
        return fundamental_period(project)
    except AnalysisError as error:
        if not isinstance(project, Project):
            raise
        sentence, code = split_code(str(error))
        raise AnalysisError(f"{sentence}. A unit may be wrong: {sizes(project)}{code}") from error


def _scales(project: AnalysisFile, plan: Sequence[Task], found: Mapping[str, Found]) -> list[str]:
    """What is unusual about the factors on the records, before they are fitted."""
    motions = {reference: Motion(reference, item) for reference, item in found.items()}
    scales = {reference: expected_scale(project, reference, found) for reference in found}
    warnings = scale_warnings(project, plan, motions, scales)
    return [f"records {name}: {text}" for name, texts in warnings.items() for text in texts]


def _dampers(project: AnalysisFile) -> str:
    """How many dampers there are of each law, and the tuned masses."""
    frame = make_frame(project, dampers=True)
    of_base = frame.isolated.isolators if frame.isolated is not None else ()
    carrying = {device.number for device in of_base}
    carrying |= {other for device in of_base for other in (device.across,) if other is not None}
    isolators = Counter(device.law for device in of_base)
    laws = Counter(device.law for device in frame.devices if device.number not in carrying)
    parts = [f"{counted(count, 'isolator')} `{name}`" for name, count in isolators.items()]
    parts += [f"{counted(count, 'damper')} `{name}`" for name, count in laws.items()]
    parts += [counted(len(frame.attached), "tuned mass")] if frame.attached else []
    return ", ".join(parts) or "none"


def _building_dampers(building: Building) -> str:
    """How many dampers of each law a building has, whether it can be built or not, and the tuned masses."""
    device_laws(building)
    laws = Counter(device.law for device, _ in devices_by_name(building.grid, building.dampers).values())
    parts = []
    if building.isolation is not None:
        isolation, bases = building.isolation, [str(line) for line in building.layout.node_lines[0]]
        for what, items in (("isolator", isolation.isolators), ("damper", isolation.beside)):
            of_base = Counter(item.law for item in items for _ in item.under(bases, building.grid))
            parts += [
                f"{counted(count, what)} `{name}`{' at the base' * (what == 'damper')}"
                for name, count in of_base.items()
            ]
        parts.append(f"mass of the base {base_mass(building) / 1e3:.4g} t")
    parts += [f"{counted(count, 'damper')} `{name}`" for name, count in laws.items()]
    masses = building.dampers.attachments if building.dampers is not None else ()
    return ", ".join([*parts, *([counted(len(masses), "tuned mass")] if masses else [])]) or "none"


def _records(project: AnalysisFile, found: Mapping[str, Found]) -> str:
    """The records, and of suites how many of their recordings are real."""
    texts = []
    for name in project.records:
        origins = Counter(item.origin for key, item in found.items() if record_of(key) == name)
        of = ", ".join(f"{count} {ORIGINS[origin]}" for origin, count in origins.items())
        texts.append(f"{name} ({of})" if of and isinstance(project.records[name], RecordSet | InSpace) else name)
    return ", ".join(texts) or "none"


def _failed_choices(project: AnalysisFile, found: Mapping[str, Found]) -> list[str]:
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


def _choices(project: AnalysisFile) -> dict[str, str]:
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
        f"{counted(frame.n_storeys, 'storey')}, {frame.height:g} m high; "
        f"{counted(frame.n_bays, 'bay')}, {width:g} m wide; {counted(len(frame.nodes), 'node')}"
    )


def _mass(project: Project) -> dict[str, str]:
    """The mass of the frame and of each floor, in which a wrong unit or a missing load shows first."""
    of_node = node_masses(project)
    if not of_node:
        return {}
    grid = project.grid
    of_floor = dict.fromkeys(range(1, grid.n_storeys + 1), 0.0)
    for name, mass in of_node.items():
        level = grid.nodes[name][-1]
        of_floor[min(of_floor, key=lambda floor: abs(grid.levels[floor] - level))] += mass
    floors = ", ".join(f"{mass / 1e3:.4g}" for mass in of_floor.values())
    base = "" if project.isolation is None else f"; of the base {sum(base_masses(project).values()) / 1e3:.4g} t"
    return {"mass": f"{sum(of_node.values()) / 1e3:.4g} t; of the floors from the lowest: {floors} t{base}"}


def _standing(project: AnalysisFile) -> str:
    """How the frame stands whose period is printed."""
    isolation = project.isolation
    braced = with_restrained_braces(project, laws_that_stand(project))
    braces = ", with its buckling-restrained braces" if braced else ""
    if without_dampers_in_modes(project):
        braces += f", without its {'other ' * braced}dampers"
    if isolation is None:
        return f"under gravity{braces}"
    return f"under gravity{braces}, on its isolators at {1e3 * isolation.design_displacement:g} mm"


def _members(project: Project) -> str:
    frame = project.frame
    counts = [counted(len(frame.column_at), "column"), counted(len(frame.beam_at), "beam")]
    if frame.brace_at:
        counts.append(counted(len(frame.brace_at), "brace"))
    return ", ".join(counts)
