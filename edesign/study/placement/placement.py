"""One placement of a study: candidates, search with histories, certificate, everything kept."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from edesign.archive.dataset import Group
from edesign.assess.sets import HistorySet
from edesign.codes.device_factors import NONE, DeviceFactors
from edesign.errors import AnalysisError, InputError
from edesign.ground_motion.hazard import rules_in_force
from edesign.project.actions.hazard import UserHazard
from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.dampers import Dampers
from edesign.project.dampers.placement import PlacementDesign
from edesign.project.reading.words import counted
from edesign.study.design.beside import NOTHING_BESIDE, Standing
from edesign.study.design.design import DesignResult
from edesign.study.design.estimate import action_of
from edesign.study.design.loop import RoundOutcome
from edesign.study.design.verification import Judge, judged
from edesign.study.placement.braces import BraceAt, ItemBraces, store_braces
from edesign.study.placement.candidates import Candidates, make_candidates
from edesign.study.placement.certificate import certify
from edesign.study.placement.estimate import LayoutEstimates
from edesign.study.placement.knowledge import Knowledge
from edesign.study.placement.results import kept_outcomes, store_placement
from edesign.study.placement.search import chosen_of, search
from edesign.study.placement.space import Layout

RespondInTurn = Callable[[Sequence[tuple[int, Dampers]]], Iterator[Mapping[str, Group]]]
"""Runs the histories of several dampers with their numbers (from 1), and yields those of each in the same order."""

_EXACT = 1_000_000  # layouts that are told to the last one
MOST_POSITIONS = 120
"""Of which pairs with eight items make half a million layouts nearby, all of which a certificate looks at."""


def run_placement(
    project: AnalysisFile,
    name: str,
    spec: PlacementDesign,
    per_layout: int,
    respond: RespondInTurn,
    judge: Judge,
    resume: Group | None = None,
    progress: Callable[[str], None] = lambda text: None,
    keep: Callable[[Group], None] = lambda group: None,
    beside: Standing = NOTHING_BESIDE,
    factors: DeviceFactors = NONE,
) -> DesignResult:
    """Search for the layout of least cost with which histories meet the criteria.

    Args:
        project: with the laws; checked by `check_placement_design`.
        name: of the design.
        per_layout: histories that judge one layout.
        respond: runs the histories of layouts, one after the other.
        resume: what an earlier run kept; its layouts are not analysed again.
        progress: called with what goes on.
        keep: given the group after each layout, for `resume`.

    Returns:
        The dampers of the chosen layout, the archived group and the status.

    Raises:
        InputError: a law or the hazard is wrong, or the frame cannot be built.
    """
    bays = "; ".join(map(str, spec.candidates))
    about: dict[str, Any] = {"method": spec.method, "kind": spec.kind, "bays": bays, "state": spec.state}
    if spec.beside:
        about["beside"] = list(spec.beside)
    try:
        braces = ItemBraces(project, name, spec, factors)
        candidates = braced(project, name, braces, beside)
        level = spec.level or (spec.verify.levels or ("",))[0]
        estimates = LayoutEstimates(candidates, action_of(_orderable(project), level, spec.inherent_damping))
    except AnalysisError as error:
        before = project.dampers
        assert before is not None, "check_placement_design wants the laws"
        group = Group(attributes=about | {"status": "failed", "reason": str(error)})
        return DesignResult(before.model_copy(update={"devices": ()}), group, "failed", str(error))
    progress(extent(candidates, per_layout))
    known = kept_outcomes(resume)
    budget = spec.verify.budget // per_layout
    about |= {"histories_of_a_layout": per_layout, "budget": spec.verify.budget}

    def analyse(wanted: Sequence[tuple[int, Layout]]) -> Iterator[RoundOutcome]:
        new = [(number, layout) for number, layout in wanted if layout not in known]
        results = respond([(number, candidates.dampers(layout)) for number, layout in new])
        for number, layout in wanted:
            if layout in known:
                yield known[layout]
                continue
            outcome = judged(next(results), judge)
            progress(f"layout {number} of at most {budget}, {_said(candidates, layout)}: {_judged(outcome)}")
            yield outcome

    def dampers_of(layout: Layout) -> Dampers:
        return candidates.dampers(layout, estimates.amplitudes(layout))

    def interrupted(knowledge: Knowledge) -> None:
        if knowledge.analysed[-1].layout in known:
            return
        group = Group(attributes=about | {"status": "interrupted", "reason": "the design is not complete"})
        store_placement(group, candidates, knowledge, dampers_of(chosen_of(knowledge).layout))
        keep(group)

    knowledge = search(candidates.space, analyse, estimates, budget, spec.monotone, interrupted)
    chosen, proof = chosen_of(knowledge), certify(knowledge, spec.monotone)
    reason = "" if chosen.outcome.met else f"{proof.sentence}; the nearest misses: {chosen.outcome.misses}"
    uses: list[BraceAt] = []
    rules, number, levels = rules_in_force(project.hazard), len(knowledge.analysed), spec.verify.levels or ("",)
    held = level if level in levels else levels[0]
    while any(candidates.devices[option, at].brace_bar for at, option in candidates.equipped(chosen.layout).items()):
        number += 1
        progress(f"layout {chosen.number} again, for the forces in its braces")
        groups = next(respond([(number, candidates.dampers(chosen.layout))]))
        at_level = {key: one for key, one in groups.items() if str(one.attributes.get("level") or "") == held}
        uses = braces.uses(candidates, chosen.layout, HistorySet("", held, at_level), rules, estimates.frequency)
        outcome = judged(groups, judge)
        if chosen.outcome.met and not outcome.met:
            reason = f"with braces that hold its dampers it misses: {outcome.misses}"
        try:
            if not braces.grow(uses):
                break
        except InputError as error:
            reason = str(error)
            break
        candidates = make_candidates(project, name, braces.spec(), beside)
        estimates = LayoutEstimates(candidates, action_of(_orderable(project), level, spec.inherent_damping))
    status = "failed" if reason else "completed"
    group = Group(attributes=about | {"status": status, "reason": reason})
    dampers = dampers_of(chosen.layout)
    store_placement(group, candidates, knowledge, dampers, proof)
    store_braces(group, uses, {"brace_level": held})
    return DesignResult(dampers, group, status, reason)


def braced(project: AnalysisFile, name: str, braces: ItemBraces, beside: Standing) -> Candidates:
    """Return the candidates, with the lightest sections of braces that are chosen; errors as `make_candidates`."""
    candidates = make_candidates(project, name, braces.spec(), beside)
    return make_candidates(project, name, braces.spec(), beside) if braces.begin(candidates) else candidates


def _orderable(project: AnalysisFile) -> AnalysisFile:
    """The project with a spectrum of any damping: where a table has one alone, eta of EN 1998-1 is enough to order."""
    hazard = project.hazard
    if not isinstance(hazard, UserHazard) or hazard.damping_correction is not None:
        return project
    return project.model_copy(update={"hazard": hazard.model_copy(update={"damping_correction": "ec8"})})


def extent(candidates: Candidates, per_layout: int) -> str:
    """Return how many layouts there are, and how many histories their search runs at most, in words.

    Args:
        per_layout: number of histories that judge one layout.
    """
    layouts, positions = candidates.space.size, len(candidates.space.positions)
    most = min(candidates.spec.verify.budget // per_layout, layouts)
    count = f"{layouts}" if layouts < _EXACT else f"{float(layouts):.2g}"
    return (
        f"{counted(positions, 'position')}, {count} layouts; at most {most} are analysed, by {most * per_layout} "
        f"histories ({per_layout} each)"
    )


def check_placement(
    project: AnalysisFile, name: str, spec: PlacementDesign, per_layout: int, beside: Standing = NOTHING_BESIDE
) -> str:
    """Build the frame with all candidate places, so that errors show before the first analysis.

    Args:
        project: the project with the laws, as for `run_placement`.
        name: name of the design.
        per_layout: number of histories that judge one layout.

    Returns:
        `extent`; empty where the frame is unstable.

    Raises:
        InputError: a law or the hazard is wrong, the frame cannot be built, there are too many positions, the limits
            leave no dampers, or the budget is not enough for one layout.
    """
    try:
        candidates = braced(project, name, ItemBraces(project, name, spec, NONE), beside)
    except AnalysisError:
        return ""  # `run_placement` keeps the reason
    space = candidates.space
    positions = len(space.positions)
    if spec.verify.budget < per_layout:
        message = f"{spec.verify.budget} histories are not enough for one layout, which takes {per_layout} [E-PLACE-02]"
        raise InputError(f"designs.{name}.verify.budget: {message}")
    if positions > MOST_POSITIONS:
        message = (
            f"{positions} positions are more than {MOST_POSITIONS}; take `limits`, or fewer bays and storeys"
            " [E-PLACE-02]"
        )
        raise InputError(f"designs.{name}: {message}")
    if space.size == 1:
        lowest = [at for at in space.positions if at.below is None]
        fewest = min(len(at.places) * space.numbers[option] for at in lowest for option in at.options)
        message = f"{spec.limits.most_dampers} are fewer than the smallest layout takes, {fewest} [E-PLACE-02]"
        raise InputError(f"designs.{name}.limits.most_dampers: {message}")
    return extent(candidates, per_layout)


def _said(candidates: Candidates, layout: Layout) -> str:
    """The dampers of a layout and their cost, for people."""
    space, names = candidates.space, list(candidates.spec.catalogue)
    equipped = list(candidates.equipped(layout).values())
    parts = [f"{equipped.count(i)} x {name}" for i, name in enumerate(names, start=1) if i in equipped]
    return f"{' + '.join(parts) or 'no dampers'}, cost {space.prices.value(space.cost(layout)):.6g}"


def _judged(outcome: RoundOutcome) -> str:
    return f"{'met' if outcome.met else 'missed'}, worst ratio {outcome.demand:.3f}"
