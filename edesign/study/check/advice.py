"""What is allowed in a project or a study, but may not be what its author means."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence

from edesign.errors import AnalysisError
from edesign.frame.frame_model import FrameModel
from edesign.ground_motion.hazard import objective_level
from edesign.ground_motion.plausibility import record_warnings
from edesign.ground_motion.record import Record
from edesign.ground_motion.record_choice import RecordChoice
from edesign.project.analysis.analyses import BuildingPushover, HistoryAnalysis, PushoverAnalysis, TargetAnalysis
from edesign.project.analysis.damping import RayleighDamping, StiffnessDamping
from edesign.project.analysis.pushover import Pushover, pattern_name
from edesign.project.analysis.shaking import IN_PLACE
from edesign.project.analysis_file import AnalysisFile
from edesign.project.checks.designs import design_warnings
from edesign.project.checks.placement import placement_warnings
from edesign.project.criteria.criteria import LimitCriterion
from edesign.project.dampers.device_names import laws_of_design
from edesign.project.dampers.placement import PlacementDesign
from edesign.project.frame.materials import ElasticMaterial
from edesign.project.frame.sections import ElasticSection
from edesign.project.project import Project
from edesign.project.reading.problems import listed
from edesign.project.records.chosen_records import ChosenRecords
from edesign.project.records.pairs import InSpace
from edesign.project.records.records import record_of
from edesign.project.study.study import Study
from edesign.study.analysis.buckling import slender_braces
from edesign.study.analysis.dampers import law_warnings, laws_that_stand, with_restrained_braces
from edesign.study.analysis.modal import fundamental_period
from edesign.study.analysis.structure import make_frame
from edesign.study.check.plausibility import implausible
from edesign.study.check.tuned_masses import tuned_mass_advice
from edesign.study.plan.plan import Task
from edesign.study.plan.variants import variant_warnings
from edesign.study.results.couples import couple_advice

MODAL = ("first_mode", "mode_1", "triangular")  # of lateral forces as elastic analyses have them
_COLLAPSED = 0.10  # of a drift: twice that of Collapse Prevention (FEMA 356, Table C1-3)
STEPS_A_PERIOD = 10  # Bathe (2014), 9.4.4: the trapezoidal rule lengthens a period by 3 % at ten steps


def project_warnings(project: AnalysisFile, records: Mapping[str, Record]) -> list[str]:
    """Return one sentence for each warning about the input of a project, without those about its records.

    Args:
        records: as recorded, those that its histories use, by reference.

    Raises:
        InputError: the frame cannot be built, or a law has no parameters at its temperature.
    """
    pushed = [spec for spec in project.analyses if isinstance(spec, PushoverAnalysis)]
    vertical = any(isinstance(spec, HistoryAnalysis) and spec.vertical is not None for spec in project.analyses)
    found = frame_warnings(project, records) + (_still_warnings([project]) if vertical else [])
    return [
        *_left_in_building(project),
        *found,
        *couple_advice(project),
        *law_warnings(project),
        *pattern_warnings(pushed),
        *repeated_recordings(records),
    ]


def _left_in_building(project: AnalysisFile) -> list[str]:
    """Say what the building of an extracted frame has and the frame has not."""
    without = project.frame.left_in_building if isinstance(project, Project) else ()
    if not without:
        return []
    return [f"frame.left_in_building: the building has {', '.join(without)} too; analyses of the frame are without"]


def _still_warnings(projects: Iterable[AnalysisFile]) -> list[str]:
    """Say which beams miss the vertical motion of their histories."""
    beams = list(dict.fromkeys(name for project in projects for name in make_frame(project).still))
    if not beams:
        return []
    return [
        f"vertical motion does not bend {listed(beams, 3)}: masses stand at the ends of beams. Moments and shears of "
        "these, and what goes from there to columns, are without it. A beam that is divided by column lines whose "
        "columns are `missing` has it"
    ]


def _fixed_base_period(project: Project) -> float | None:
    """T1 of an isolated frame with its base fixed, s; None if it cannot be found."""
    try:
        return max(fundamental_period(project, fixed_base=True) or (), default=None)
    except AnalysisError:
        return None  # it may sway on its isolators alone


def _damping_warnings(project: AnalysisFile, laws: Iterable[str]) -> list[str]:
    """Return the warning about damping by a stiffness matrix in a frame with buckling-restrained braces.

    Args:
        laws: of the dampers that stand in the frame, or will by a design.
    """
    if not with_restrained_braces(project, laws) or not isinstance(
        project.damping, (RayleighDamping, StiffnessDamping)
    ):
        return []
    return [
        f"damping: the stiffness that `{project.damping.kind}` is proportional to is that of the members, without "
        "buckling-restrained braces, so modes that these stiffen get less than the ratio; `modal` gives it to each mode"
    ]


def frame_warnings(project: AnalysisFile, records: Mapping[str, Record], designed: Iterable[str] = ()) -> list[str]:
    """Return the warnings about a frame and its analysis; errors as `project_warnings`.

    Args:
        records: as recorded, those that its histories use, by reference.
        designed: laws of the dampers that designs add.

    Returns:
        One sentence for each warning.
    """
    laws = [*laws_that_stand(project), *designed]
    try:
        periods = fundamental_period(project) or ()
    except AnalysisError:
        periods = ()  # the analyses will say why
    frame = make_frame(project, dampers=True)
    found, period = [], max(periods, default=None)
    if isinstance(project, Project):
        found += implausible(project, period if project.isolation is None else _fixed_base_period(project))
    found += slender_braces(frame) + _damping_warnings(project, laws)
    if isinstance(project, Project):
        found += tuned_mass_advice(project) + _staying_elastic(project, frame)
    given = project.integration.time_step if project.integration is not None else None
    if given is not None:
        passed = {name: r.time_step for name, r in records.items() if given > r.time_step * (1 + 1e-9)}
        if passed:
            shortest = min(passed.values())
            found.append(
                f"the time step of {given:g} s is longer than that of {listed(passed, 3)} "
                f"({shortest:g} s): samples between the steps are passed over"
            )
    found += _unknown_events(project, records)
    longest = given or max((record.time_step for record in records.values()), default=0.0)
    if periods and longest > min(periods) / STEPS_A_PERIOD:
        found.append(
            f"the time step of {longest:g} s is longer than 1/{STEPS_A_PERIOD} of the period T1 = {min(periods):.4g} s"
        )
    return found


def _staying_elastic(project: Project, frame: FrameModel) -> list[str]:
    """Say which members stay elastic although their material yields, and have no hinge or joint that does."""
    staying = [
        name
        for name, run in project.grid.members.items()
        if isinstance(project.sections.get(run.section), ElasticSection)
        and not isinstance(project.materials[run.material], ElasticMaterial)
        and not frame.members[name].yields
    ]
    if not staying:
        return []
    return [
        f"{listed(staying, 3)} will not yield: a section given by `area` and `inertia` stays elastic whatever its "
        "material; give plates or `rectangles` for a section that yields, or `hinges` at ends of beams and columns"
    ]


def study_warnings(study: Study, plan: Sequence[Task], records: Mapping[str, Record]) -> list[str]:
    """Return one sentence for each warning about the input of a study, without those about its records.

    Args:
        records: as recorded, those that its histories use, by reference.

    Raises:
        InputError: the frame cannot be built, or a law has no parameters at a temperature.
    """
    designed = [name for design in study.designs.values() for name in laws_of_design(design)]
    found = [*_left_in_building(study.base), *frame_warnings(study.base, records, designed)]
    for name, variant in study.variants.items():
        if variant.values and name not in study.derived:  # those of a sweep are many, between frames that are judged
            warnings = frame_warnings(study.project_of(name), records, designed)
            found += [f"variant {name}: {text}" for text in warnings if text not in found]
    moved = dict.fromkeys(task.variant for task in plan if getattr(task.spec, "vertical", None) is not None)
    found += _still_warnings(study.project_of(name) for name in moved)
    found += couple_advice(study.base, study.designs)
    made = {name for variant in study.variants.values() for name in variant.designs}
    for name, spec in study.designs.items():
        if name not in made:
            found.append(f"design {name}: no variant has it, so it is not made; write `design: {name}` at a variant")
        if isinstance(spec, PlacementDesign):
            texts = placement_warnings(spec, study.base)
        else:
            texts = design_warnings(spec)
        found += [f"design {name}: {text}" for text in texts]
    found += [*drift_limits(study), *repeated_recordings(records)]
    found += [*_equal_variants(study), *_mixed_motions(study, plan)]
    return [*found, *variant_warnings(study, plan), *pattern_warnings(study.pushovers)]


def unbuckled_members(project: AnalysisFile, plan: Sequence[Task], designs: Collection[str] = ()) -> list[str]:
    """Say that members beside dampers are checked by their sections alone, where a plane frame has no `design`.

    Args:
        plan: of the project or of a study of it.
    """
    if not isinstance(project, Project):
        return []
    shaken = any(isinstance(task.spec, HistoryAnalysis) for task in plan)
    yields = any(not isinstance(material, ElasticMaterial) for material in project.materials.values())
    if project.design is not None or not (shaken and yields and (designs or laws_that_stand(project))):
        return []
    return [
        "design: without it, histories check members under damper forces by their sections alone; `design` in "
        f"{project.path.name} adds buckling (EN 1993-1-1, 6.3)"
    ]


def _equal_variants(study: Study) -> list[str]:
    """Say which variants of the file are the same frame with the same dampers."""
    own = [name for name in study.variants if name not in study.derived]
    alike: dict[str, list[str]] = {}
    for name in own:
        said = study.variants[name].model_dump(exclude={"bounds"})  # which makes variants of their own
        said["values"] = sorted((place, repr(value)) for place, value in said["values"].items())
        alike.setdefault(repr(said), []).append(name)
    return [
        f"variants {listed(names)} are the same: each analysis of one gives the results of the other"
        for names in alike.values()
        if len(names) > 1
    ]


def _mixed_motions(study: Study, plan: Iterable[Task]) -> list[str]:
    """Say where statistics of one variant at one level are of pairs and of single components together."""
    acting: dict[tuple[str, str], dict[bool, dict[str, None]]] = {}
    for task in plan:
        if isinstance(task.spec, HistoryAnalysis) and task.spec.level and task.record is not None:
            name = record_of(task.record)
            kinds = acting.setdefault((task.variant, task.spec.level), {})
            kinds.setdefault(isinstance(study.base.records[name], InSpace), {})[name] = None
    found: dict[str, None] = {}
    for (_, level), kinds in acting.items():
        if len(kinds) == 2:
            names = f"{listed(kinds[True])} (pairs) and {listed(kinds[False])} (single components)"
            found[f"{level}: criteria and means take {names} together; give each a study of its own"] = None
    return list(found)


def pattern_warnings(pushovers: Iterable[Pushover]) -> list[str]:
    """Return what EN 1998-1, 4.3.3.4.2.2, asks for with targets of the N2 method: two load patterns, eccentricity."""
    asked = [spec for spec in pushovers if "n2" in spec.targets]
    names = [pattern_name(pattern) for spec in asked for pattern in spec.pattern]
    modal = [name for name in names if name in MODAL or name.startswith("modes_")]
    missing = ["`uniform`"] * ("uniform" not in names) + ["a modal one such as `first_mode`"] * (not modal)
    found = []
    if names and missing:
        which = " and ".join(missing)
        found.append(f"N2: EN 1998-1, 4.3.3.4.2.2(1), asks for a uniform and a modal pattern; {which} is missing")
    positions = {position for spec in asked if isinstance(spec, BuildingPushover) for position in spec.eccentricity}
    if positions == {IN_PLACE}:
        found.append("N2: EN 1998-1, 4.3.3.4.2.2(2)P, asks for accidental eccentricity; `eccentricity` is missing")
    return found


def _unknown_events(project: AnalysisFile, records: Iterable[str]) -> list[str]:
    """Return one sentence for chosen records of unknown earthquakes that a limit for each earthquake cannot count.

    Args:
        records: references of the records.
    """
    found = []
    for name in dict.fromkeys(map(record_of, records)):
        spec, choice = project.records[name], project.record_choice(name)
        if isinstance(spec, ChosenRecords) and spec.max_per_event is not None and isinstance(choice, RecordChoice):
            unknown = [key for key, candidate in choice.candidates.items() if candidate.entry.event is None]
            if unknown:
                found.append(
                    f"records {name}: the earthquake of {listed(unknown, 3)} is not known, so that `max_per_event` "
                    "counts each as one of its own; a `flatfile` can name it"
                )
    return found


def named_record_warnings(records: Mapping[str, Record]) -> list[str]:
    """Return one sentence for each warning about records."""
    return [f"record {name}: {warning}" for name, record in records.items() for warning in record_warnings(record)]


def repeated_recordings(records: Mapping[str, Record]) -> list[str]:
    """Say which recordings of a suite are the same, so that means over the suite count them more than once.

    Args:
        records: as recorded, by reference.
    """
    same: dict[tuple[str, float, bytes], list[str]] = {}
    for name, record in records.items():
        if record_of(name) != name:
            same.setdefault((record_of(name), record.time_step, record.acceleration.tobytes()), []).append(name)
    return [
        f"records {suite}: {listed(names)} are one and the same recording, which counts {len(names)} times in means"
        for (suite, _, _), names in same.items()
        if len(names) > 1
    ]


def drift_limits(study: Study) -> list[str]:
    """Say which criteria allow drifts that no frame survives, as a percentage without its sign does."""
    allowed = [(c.name, c.most) for c in study.criteria if isinstance(c, LimitCriterion) and "drift" in c.subject]
    return [
        f"criterion `{name}`: `most` allows drifts of {100.0 * most:g} %, which no frame survives; "
        f"{most:g} per cent is written `{most:g} %`"
        for name, most in allowed
        if most is not None and most > _COLLAPSED
    ]


def unjudged(study: Study, plan: Iterable[Task]) -> list[str]:
    """Return one sentence for each criterion and objective of a study for which its plan has no history.

    Criteria that designs are verified by are judged there.

    Args:
        plan: its analyses.
    """
    planned = {
        (task.variant, task.spec.level)
        for task in plan
        if isinstance(task.spec, (HistoryAnalysis, TargetAnalysis)) and task.stripe is None
    }
    verified = {
        name for design in study.designs.values() if design.verify is not None for name in design.verify.criteria
    }
    asked = [(f"criterion `{c.name}`", c.variants, c.levels) for c in study.criteria if c.name not in verified]
    for letter in study.objectives:
        level = objective_level(letter, study.base.hazard)
        asked.append((f"objective {letter}", (), () if level is None else (level,)))
    found = []
    for what, variants, levels in asked:
        if not any((not variants or v in variants) and (not levels or at in levels) for v, at in planned):
            of = f" of {listed(variants)}" if variants else ""
            at = f" at {listed(levels)}" if levels else ""
            found.append(f"{what} will not be judged: no history{of}{at} is planned")
    return found
