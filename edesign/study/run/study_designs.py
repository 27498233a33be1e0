"""The designs of a study while it runs: made, verified by histories, archived; then the frames of the variants."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence

from edesign.archive.dataset import Group
from edesign.assess.verdicts import Verdict, judge
from edesign.errors import AnalysisError, EdesignError
from edesign.one_thread import one_thread
from edesign.project.analysis.analyses import HistoryAnalysis, ModalAnalysis, PlannedAnalysis
from edesign.project.analysis.outputs import Outputs
from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.dampers import Dampers
from edesign.project.dampers.placement import PlacementDesign
from edesign.project.dampers.verification import AnyVerify, LoopVerify, PlacementVerify
from edesign.project.study.study import Study
from edesign.study.analysis.modal import mode_count
from edesign.study.check.criteria_inputs import kept_for_verification, too_few_motions
from edesign.study.design.beside import standing_of
from edesign.study.design.design import DesignResult, run_design
from edesign.study.design.verification import along_design
from edesign.study.placement.placement import run_placement
from edesign.study.plan.device_factors import factors_in_force
from edesign.study.plan.plan import Task, labels
from edesign.study.plan.study_plan import histories_of_a_round, verifying_histories, wanted_designs
from edesign.study.plan.variants import together, variant_project
from edesign.study.results.kinds import DESIGNS
from edesign.study.run.analyses import analyse
from edesign.study.run.backends.call import Call
from edesign.study.run.state import Prepared, RunState


class _Lost(EdesignError):
    """The back end was lost in a round: no fault of the design, which would take it for its own."""

    def __init__(self, error: EdesignError) -> None:
        super().__init__(str(error))
        self.error = error


class Evaluated:
    """The rounds or layouts of a design whose histories have run, and how long the others take at most."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._seconds, self._histories, self._number = 0.0, 0, 0

    def counted(self, rounds: Iterator[Mapping[str, Group]]) -> Iterator[Mapping[str, Group]]:
        """Yield the histories of rounds, and count them and their time."""
        began = self._clock()
        for found in rounds:
            self._number, self._histories = self._number + 1, len(found)
            self._seconds, began = self._seconds + self._clock() - began, self._clock()
            yield found
            began = self._clock()

    def left(self, verify: AnyVerify | None) -> float | None:
        """Return the time that a search takes that goes on to its last round or history, s; None: it is not known."""
        if verify is None or not self._number:
            return None
        most = verify.rounds if isinstance(verify, LoopVerify) else 0
        if isinstance(verify, PlacementVerify):
            most = verify.budget // self._histories
        return self._seconds / self._number * max(most - self._number, 0)


def study_designs(study: Study, run: RunState) -> Prepared:
    """Make the designs that the plan needs, and return the frame of each task.

    Args:
        run: the state of the run, with its archive, back end and progress.
    """
    wanted = wanted_designs(study, run.job.tasks)
    made: dict[str, DesignResult] = {}
    for order, name in enumerate(study.designs):
        if name in wanted and not run.stopped():
            made[name] = _design(study, name, order, run, made)
    designed = {name: result.dampers for name, result in made.items()}
    outputs = study.outputs
    plain = Outputs(histories=outputs.histories, every=outputs.every)
    details = outputs.details
    whole = (
        Outputs(
            histories=tuple(dict.fromkeys((*details.histories, *outputs.histories))),
            every=outputs.every,
            members=details.members,
        )
        if details is not None
        else plain
    )
    nothing = Outputs(histories=())
    frames: dict[tuple[str, float | None, bool, bool], AnalysisFile] = {}

    def prepared(task: Task) -> tuple[AnalysisFile, PlannedAnalysis]:
        for design in study.variants[task.variant].designs:
            if made[design].status != "completed":
                raise AnalysisError(f"its design `{design}` failed: {made[design].reason} [E-DESIGN-05]")
        key = (task.variant, task.temperature_C, task.details, task.stripe is not None)
        if key not in frames:
            project = variant_project(study, task.variant, designed, task.temperature_C)
            kept = nothing if task.stripe is not None else whole if task.details else plain
            frames[key] = project.model_copy(update={"outputs": kept})
        project, spec = frames[key], task.spec
        if isinstance(spec, ModalAnalysis) and study.modal.modes is None:  # a small frame may have fewer
            spec = spec.model_copy(update={"modes": min(spec.modes, mode_count(project))})
        return project, spec

    return prepared


def _design(study: Study, name: str, order: int, run: RunState, made: Mapping[str, DesignResult]) -> DesignResult:
    """Make a design, going on from what an interrupted run left of it; every round is archived when it is known.

    Args:
        made: the designs above it.
    """
    place, spec = f"{DESIGNS}/{name}", study.designs[name]
    beside = study.beside(name)
    verify = spec.verify
    about = {"order": order, "name": name}

    evaluated = Evaluated()

    def keep(group: Group) -> None:
        run.archive(place, Group(group.coords, group.variables, {**group.attributes, **about}))

    def respond_in_turn(wanted: Sequence[tuple[int, Dampers]]) -> Iterator[Mapping[str, Group]]:
        assert verify is not None
        standing = {other: made[other].dampers for other in beside}
        all_of = [(number, together(study, (*beside, name), {**standing, name: own})) for number, own in wanted]
        return evaluated.counted(_respond(study, name, verify, all_of, run))

    def respond(dampers: Dampers, number: int) -> Mapping[str, Group]:
        return next(respond_in_turn([(number, dampers)]))

    def verdicts(histories: Mapping[str, Group]) -> tuple[Verdict, ...]:
        assert verify is not None
        # the histories of the verification are of no variant, whatever variants a criterion names
        asked = [c.model_copy(update={"variants": ()}) for c in study.criteria if c.name in verify.criteria]
        judged = {key: one for key, one in histories.items() if one.attributes["level"] in (verify.levels or ("",))}
        return judge([along_design(c, spec) for c in asked], (), judged, study.base)

    for other in beside:
        if made[other].status != "completed":
            reason = f"`{other}`, beside which it is sized, failed: {made[other].reason} [E-DESIGN-05]"
            run.note(f"design {name} failed: {reason}")
            group = Group(attributes={"status": "failed", "reason": reason})
            keep(group)
            return DesignResult(made[other].dampers, group, "failed", reason)
    resume = run.writer.read(place) if run.writer.has(place) else None
    try:
        with one_thread():
            if isinstance(spec, PlacementDesign):
                result = run_placement(
                    study.base,
                    name,
                    spec,
                    histories_of_a_round(study, name),
                    respond_in_turn,
                    verdicts,
                    resume,
                    lambda message: run.say(f"design {name}: {message}", evaluated.left(verify)),
                    keep,
                    standing_of([made[other].standing for other in beside]),
                    factors_in_force(study, study.hazard),
                )
            else:
                result = run_design(
                    study.base,
                    name,
                    spec,
                    study.folder,
                    respond if verify is not None else None,
                    verdicts if verify is not None else None,
                    resume,
                    lambda message: run.note(f"design {name}: {message}", evaluated.left(verify)),
                    keep,
                    factors_in_force(study, study.hazard),
                    standing_of([made[other].standing for other in beside]),
                )
    except _Lost as lost:
        raise lost.error from lost
    stored = result.group.attributes.get("warnings")
    result.group.attributes["warnings"] = [*(stored if isinstance(stored, list) else []), *too_few_motions(study, name)]
    keep(result.group)
    if "certificate" in result.group.attributes:
        run.note(f"design {name}: {result.group.attributes['certificate']}")
    if result.status != "completed":
        run.note(f"design {name} failed: {result.reason}")
    return result


def _respond(
    study: Study, name: str, verify: AnyVerify, wanted: Sequence[tuple[int, Dampers]], run: RunState
) -> Iterator[dict[str, Group]]:
    """The histories that rounds of a design are judged by, round by round; they are not archived.

    Rounds that are wanted together share the workers; each is yielded as soon as it and those before it are complete.
    """
    calls: list[Call] = []
    specs: dict[str, HistoryAnalysis] = {}
    keys: dict[int, list[str]] = {}
    outputs = kept_for_verification(study, verify)
    for number, dampers in wanted:
        project = study.base.with_dampers(dampers).model_copy(update={"outputs": outputs})
        for spec in verifying_histories(study, name, number):
            specs[spec.name] = spec
            keys.setdefault(number, []).append(spec.name)
            calls.append(Call(spec.name, analyse, (project, spec, run.motions[spec.record], None)))
    found: dict[str, Group] = {}
    open_rounds = list(keys.values())
    try:
        for result in run.results(calls):
            failed = Group(attributes={"status": "failed", "reason": result.reason})
            group = result.value if isinstance(result.value, Group) else failed
            group.attributes |= labels(specs[result.key])
            found[result.key] = group
            while open_rounds and all(key in found for key in open_rounds[0]):
                yield {key: found.pop(key) for key in open_rounds.pop(0)}
    except EdesignError as error:
        raise _Lost(error) from error
    if run.stopped():
        raise KeyboardInterrupt
