"""`edesign design`: the sections of a building chosen, and what is worth knowing of the choice."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.codes.ec8.steel.concentric_braces import HOMOGENEITY
from edesign.codes.rule_check import RuleCheck, first_of_largest
from edesign.errors import InputError
from edesign.one_thread import one_thread
from edesign.project.building.building import Building
from edesign.project.notation.printed_unit import told_apart
from edesign.project.reading.values import KeyPath
from edesign.space.designed import ElasticDesign
from edesign.space.elastic_design import ElasticAnalysis, elastic_design
from edesign.space.selection.evaluate import HOMOGENEOUS, LINKS, Choice, Evaluation, Evaluator, axis_of
from edesign.space.selection.groups import Group, groups_of
from edesign.space.selection.search import Found, Listener, Search, column_order
from edesign.space.structure.design_block import design_of

_SHOWN = 6
"""Sections of a list that a line of progress names."""


@dataclass(frozen=True)
class Governing:
    """The check of members of a group that is used most.

    Attributes:
        utilisation: effect over resistance.
        check, clause: its name and clause.
        member: name.
        combination: of actions.
    """

    utilisation: float
    check: str
    clause: str
    member: str
    combination: str

    def __str__(self) -> str:
        if math.isinf(self.utilisation):
            return (
                f"{self.check} ({self.clause}): no resistance is left to {self.member} in {self.combination}, as it is "
                "of class 4 under its forces, or N or V is beyond what it bears alone"
            )
        return f"{self.check} {self.utilisation:.3g} ({self.clause}) of {self.member} in {self.combination}"


@dataclass(frozen=True)
class GroupChoice:
    """Choice of a section for a group.

    Attributes:
        group: with its list.
        before, after: sections.
        mass: of its members with the section chosen, kg.
        governing: its most used check.
        held_by: what the next lighter section would break, in words.
    """

    group: Group
    before: str
    after: str
    mass: float
    governing: Governing
    held_by: str


@dataclass(frozen=True)
class Selection:
    """A building with chosen sections.

    Attributes:
        building: with the sections chosen; its text is that of the file but for the sections.
        design: its elastic design.
        groups: in the order of the file's members.
        mass_before, mass: of steel, kg.
        cost: what was to be least: the mass, or its price.
        evaluations: designs that were analysed.
        certified: whether no single and no double exchange of sections is lighter and meets the checks; with wishes
            those of groups that they bind together count as one.
        starts: how many starts of the search met all checks.
        splices: columns with another section than the column below them.
        doublers: web panels that need a supplementary plate.
        free: what was found without the wishes `same_depth` and `most_sections`; None: the file has none.
        not_met: rules that the design does not meet: those left out by the file, and those that no section changes.
    """

    building: Building
    design: ElasticDesign
    groups: tuple[GroupChoice, ...]
    mass_before: float
    mass: float
    cost: float
    evaluations: int
    certified: bool
    starts: int
    splices: int
    doublers: int
    free: Found | None
    not_met: tuple[RuleCheck, ...]


def select_sections(building: Building, progress: Listener = lambda line: None, workers: int = 1) -> Selection:
    """Choose sections from the lists of `design.select` that meet all checks with the least mass of steel, or price.

    Args:
        building: from `load_building`, with the blocks that `elastic_design` needs.
        progress: takes lines of progress.
        workers: processes that analyse at the same time, this one among them; the choice does not depend on them.

    Raises:
        InputError: a list is wrong, or none of its sections meet all checks; the message says which check stands in
            the way.
        CoreError: the structure is a mechanism.
    """
    with one_thread():
        analysis = ElasticAnalysis(building)
        groups = groups_of(analysis)
        for line in _left_out(groups):
            progress(line)
        select = design_of(building).select
        evaluate = Evaluator(analysis, groups, workers)
        order = column_order(analysis.frame, groups) if select.columns_not_larger_above else []
        before = _sections(analysis, groups)
        search = Search(evaluate, order, select.evaluations, progress)
        try:
            search.lightest()
        except InputError as error:
            raise InputError(f"{building.where('design', 'select')}: design.select: {error}") from error
        given, free = {"sections of the file": _nearest(analysis, groups)}, None
        for line in _replaced(groups, before, search.repaired(given["sections of the file"])):
            progress(line)
        try:
            if evaluate.wishes.bind:
                progress("without the wishes:")
                without = Search(evaluate, order, select.evaluations, progress, evaluate.wishes.free)
                free = without.run(select.starts, given)
                given["choice without the wishes"] = free.best.choice
                progress("with the wishes:")
            found = search.run(select.starts, given)
        finally:
            evaluate.close()
        if not found.best.met:
            raise InputError(_in_the_way(building, evaluate, found))
        return _selection(evaluate, order, found, before, free)


def _left_out(groups: Iterable[Group]) -> Iterator[str]:
    """Yield a line for the groups of a kind from whose lists sections are left out, which are mostly the same."""
    of_kind: dict[str, list[Group]] = {}
    for group in groups:
        if group.left_out:
            of_kind.setdefault(group.kind, []).append(group)
    for alike in of_kind.values():
        common = tuple(name for name in alike[0].left_out if all(name in group.left_out for group in alike))
        own: dict[tuple[str, ...], list[str]] = {}
        for group in alike:
            own.setdefault(tuple(name for name in group.left_out if name not in common), []).append(group.name)
        parts = [f"{_named([group.name for group in alike])} {_shown(common)}"] if common else []
        also = "also " if common else ""
        parts += [f"{_named(names)} {also}{_shown(more)}" for more, names in own.items() if more]
        yield f"left out for their class, thickness or slenderness: of {'; of '.join(parts)}"


def _named(groups: Sequence[str]) -> str:
    return f"group {groups[0]}" if len(groups) == 1 else f"groups {', '.join(groups)}"


def _shown(sections: Sequence[str]) -> str:
    more = len(sections) - _SHOWN
    return ", ".join(sections[:_SHOWN]) + (f" and {more} more" if more > 0 else "")


def _sections(analysis: ElasticAnalysis, groups: Sequence[Group]) -> dict[str, str]:
    """The sections of the file by group."""
    given = {member.group: member.section for member in analysis.frame.members}
    return {group.name: given[group.name] for group in groups}


def _nearest(analysis: ElasticAnalysis, groups: Sequence[Group]) -> Choice:
    """The sections of the file as numbers in the lists, the nearest ones where they are on none."""
    given = {member.group: analysis.frame.section(member.section) for member in analysis.frame.members}
    return tuple(group.nearest(given[group.name]) for group in groups)


def _replaced(groups: Sequence[Group], before: Mapping[str, str], start: Choice | None) -> Iterator[str]:
    """Yield a line that says where the search does not begin with the sections of the file."""
    if start is None:
        yield "the sections of the file are no start: the lists have no order of columns or no wish granted near them"
        return
    taken = [(group, group.sections[number]) for group, number in zip(groups, start, strict=True)]
    changed = [f"{of.name} {name} for {before[of.name]}" for of, name in taken if name != before[of.name]]
    if changed:
        yield f"start from the sections of the file, but for what its lists and wishes exclude: {', '.join(changed)}"


def _selection(
    evaluate: Evaluator,
    order: Sequence[tuple[int, int]],
    found: Found,
    before: dict[str, str],
    free: Found | None,
) -> Selection:
    building, choice = evaluate.analysis.building, found.best.choice
    limits = [_held_by(evaluate, order, choice, number) for number in range(len(choice))]
    sections = evaluate.sections(choice)
    designed = with_sections(building, sections)
    design = elastic_design(designed)
    rows = []
    for group, number, held_by in zip(evaluate.groups, choice, limits, strict=True):
        governing = governing_check(design, group.name)
        rows.append(
            GroupChoice(group, before[group.name], sections[group.name], group.mass[number], governing, held_by)
        )
    return Selection(
        building=designed,
        design=design,
        groups=tuple(rows),
        mass_before=evaluate.analysis.sections.steel_mass(),
        mass=found.best.mass,
        cost=found.best.cost,
        evaluations=evaluate.count,
        certified=found.certified,
        starts=found.starts,
        splices=evaluate.wishes.splices(choice),
        doublers=found.best.doublers,
        free=free,
        not_met=tuple(rule for rule in design.criteria if rule.passed is False),
    )


def with_sections(building: Building, sections: dict[str, str]) -> Building:
    """Return what the file would be with other sections of its groups.

    Args:
        building: from `load_building`.
    """
    changes: dict[KeyPath, str] = {
        (kind, number, "section"): sections[run.group]
        for kind in ("columns", "beams", "braces")
        for number, run in enumerate(getattr(building, kind))
        if sections.get(run.group, run.section) != run.section
    }
    return building.with_values(changes) if changes else building


def governing_check(design: ElasticDesign, group: str) -> Governing:
    """Return the most used check of the members of a group."""
    numbers = [number for number, member in enumerate(design.frame.members) if member.group == group]
    of = design.members.utilisation[numbers]
    of = np.where(np.isnan(of), -1.0, of)
    place, check = np.unravel_index(first_of_largest(of), of.shape)
    member = numbers[int(place)]
    row = int(design.members.combination[member, check]) - 1
    return Governing(
        utilisation=float(of[place, check]),
        check=design.members.checks[check],
        clause=design.members.clauses[check],
        member=design.frame.members[member].name,
        combination=design.members.rows[row].name if row >= 0 else "",
    )


def _held_by(evaluate: Evaluator, order: Sequence[tuple[int, int]], choice: Choice, number: int) -> str:
    """What the next lighter section of a group would break."""
    if choice[number] == 0:
        return "the lightest of its list"
    lower = tuple(k - (place == number) for place, k in enumerate(choice))
    group = evaluate.groups[number]
    for upper, below in order:
        if below == number and evaluate.groups[upper].area[choice[upper]] > group.area[lower[number]]:
            return f"{evaluate.groups[upper].name} above it, which must not be larger"
    if not evaluate.wishes.met(lower):
        return f"a wish: {group.sections[lower[number]]} alone is not allowed"
    broken = _broken(evaluate, evaluate.design(lower))
    return broken[0] if broken else "nothing alone: its list goes on below, but a lighter design was not found"


def _broken(evaluate: Evaluator, design: ElasticDesign, each: bool = False) -> list[str]:
    """The checks that a design does not meet, in words: the worst groups, then rules for the building.

    `each`: with Omega of each group of diagonals or links where it differs too much.
    """
    rules = [
        f"{rule.text}{f' ({rule.detail})' if rule.detail else ''}: "
        f"{', limit '.join(told_apart(rule.value, rule.required, lambda of, digits: f'{of:.{digits}g}'))} "
        f"({rule.reference}){_of_diagonals(design, rule) if each else ''}"
        for rule in evaluate.broken(design)
    ]
    checks = [(group, governing_check(design, group.name)) for group in evaluate.groups]
    failing = sorted((pair for pair in checks if pair[1].utilisation > 1.0), key=lambda pair: -pair[1].utilisation)
    return [*(f"{group.name}: {check}" for group, check in failing), *rules]


def _of_diagonals(design: ElasticDesign, rule: RuleCheck) -> str:
    """Omega of the groups of diagonals or links where it differs too much, with the member that has it."""
    if rule.clause not in (HOMOGENEOUS, LINKS[2]):
        return ""
    found, apart = [], []
    for Omega in (of for axis, of in design.overstrength.items() if axis_of(rule) == axis):
        of_groups: dict[str, list[tuple[float, str]]] = {}
        for number, ratio in zip(Omega.members, Omega.ratios, strict=True):
            member = design.frame.members[number]
            of_groups.setdefault(member.group, []).append((float(ratio), member.name))
        for group, of in of_groups.items():
            (least, name), (most, _) = min(of), max(of)
            found.append(f"{least:.2f} of {group} {name}")
            apart += [f"{group} ({least:.2f} to {most:.2f})"] if most > (1.0 + HOMOGENEITY) * least else []
    text = f"; Omega is {', '.join(found)}"
    return f"{text}; no section makes it alike within {', '.join(apart)}: smaller groups do" if apart else text


def _in_the_way(building: Building, evaluate: Evaluator, found: Found) -> str:
    where = f"{building.where('design', 'select')}: design.select"
    best, allowed = found.best, design_of(building).select.evaluations
    design = evaluate.design(best.choice)
    sections = evaluate.sections(best.choice)
    concerned = evaluate.in_the_way(design)
    heaviest = [
        f"{group.name} has {group.sections[-1]}, the heaviest of its list"
        for place, (group, number) in enumerate(zip(evaluate.groups, best.choice, strict=True))
        if number == len(group.sections) - 1 and place in concerned
    ]
    lines = [
        f"{where}: the search found no sections of the lists that meet all checks ({evaluate.count} designs analysed), "
        f"which is no proof that there are none; the nearest, {best.mass / 1e3:.1f} t of steel, are "
        f"{', '.join(f'{name} {of}' for name, of in sections.items())}",
        *(f"in the way: {text}" for text in _broken(evaluate, design, each=True)),
        *heaviest,
        *_nearer(evaluate, best),
        "its evaluations are used up; allow more by `evaluations` [E-SPACE-07]"
        if evaluate.count >= allowed
        else "give longer lists, more groups, or leave a rule for the building out by `leave_out` [E-SPACE-07]",
    ]
    return "\n  ".join(lines)


def _nearer(evaluate: Evaluator, best: Evaluation) -> list[str]:
    """Say if the sections of the file, which the lists exclude, miss the checks by less than the nearest ones."""
    design = evaluate.analysis.design(least_sway=True)
    excess, _ = evaluate.excess(design)
    if excess >= best.excess:
        return []
    broken = "; ".join(_broken(evaluate, design)) or "none is missed"
    return [
        f"the sections of the file are nearer, but its lists or wishes exclude some: checks are missed by {excess:.3g} "
        f"in sum, by the nearest by {best.excess:.3g}; of the file: {broken}"
    ]
