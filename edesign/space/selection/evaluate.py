"""Whether a building with some sections meets its checks, and by how much it misses them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial

import numpy as np

from edesign.codes.ec3.imperfections import AMPLIFICATION
from edesign.codes.ec8.steel.concentric_braces import FEW_STOREYS, HOMOGENEITY, SLENDERNESS
from edesign.codes.ec8.verification.second_order import AMPLIFIED
from edesign.codes.ec8.verification.strong_column import LEAST_RATIO
from edesign.codes.rule_check import RuleCheck
from edesign.project.building.building import Building
from edesign.project.building.design import RESTRAINED
from edesign.space.analysis.deflections import LIMITED
from edesign.space.analysis.lateral import SWAY_LIMITED
from edesign.space.analysis.sway import STABLE
from edesign.space.checks.rules import brace_slenderness
from edesign.space.designed import ElasticDesign
from edesign.space.elastic_design import ElasticAnalysis
from edesign.space.selection.ahead import Ahead
from edesign.space.selection.groups import Group
from edesign.space.selection.wishes import wishes_of
from edesign.space.structure.design_block import MOMENT_FRAME, design_of, left_out, rules_of, system_of
from edesign.space.structure.frame import AXES, Axis

THETA, DRIFT, JOINTS, HOMOGENEOUS, SYMMETRIC = "4.4.2.2(3)", "4.4.3.2(1)", "4.4.2.3(4)", "6.7.3(8)", "6.7.1(3)"
SLENDER = ("6.7.3(1)", "6.7.3(2)", "6.7.3(3)")
CLASS, COLUMN_BASES, PANELS, TORSION = "6.5.3(2)", "6.6.3(4)", "6.6.3(6)", "4.2.3.2(6)"
LINKS = ("6.8.2(4)", "6.8.2(6)", "6.8.2(7)", "6.8.2(10)")
STRAINED = "AISC 341-16, F4.2"
GRADUAL, NTC_ALONE = "4.2.3.3(3)", ("NTC 2018, 7.5.3.2", "NTC 2018, 7.5.5")

RULES = (CLASS, COLUMN_BASES, SYMMETRIC, STRAINED, TORSION, GRADUAL, *NTC_ALONE)
"""Clauses that are used as far as their criteria say."""
FINITE = 1e6
"""What counts for an infinite utilisation, as of class 4 sections, so that sums stay numbers."""
Choice = tuple[int, ...]
"""Number of the section of each group in its list."""


@dataclass(frozen=True)
class Evaluation:
    """Evaluation of one choice of sections.

    Attributes:
        choice: of the sections.
        mass: of steel, kg.
        cost: what is to be least: the mass, or the price with that of splices and doublers.
        met: whether all checks are met that sections can change and that are not left out.
        excess: sum of max(u - 1, 0) over members, storeys, joints and diagonals.
        worst: the largest u.
        doublers: web panels that need a supplementary plate.
        logs: (n,) log u of the checks of each group, and of each storey, joint and panel; then, for each direction
            where they must be alike, log Omega of the diagonals.
    """

    choice: Choice
    mass: float
    cost: float
    met: bool
    excess: float
    worst: float
    doublers: int = 0
    logs: np.ndarray = field(default_factory=lambda: np.zeros(0), compare=False, repr=False)


class OutOfEvaluations(Exception):
    """Error: the evaluations that the file allows are used up."""


class Evaluator:
    """Evaluates choices of sections; each once.

    Args:
        workers: processes that analyse at the same time, this one among them.

    Attributes:
        budget: how many choices may be asked for; None: any number.
        searched: clauses for the whole building that count.
        wishes: of the file.
        alike: how many diagonals must have like Omega, by direction.
    """

    def __init__(self, analysis: ElasticAnalysis, groups: Sequence[Group], workers: int = 1) -> None:
        self.analysis = analysis
        self.groups = tuple(groups)
        self.budget: int | None = None
        self._asked: set[Choice] = set()
        self._known: dict[Choice, Evaluation] = {}
        self._last: tuple[Choice, ElasticDesign] | None = None
        design = design_of(analysis.building)
        self.searched = searched_clauses(analysis) - left_out(design)
        self.wishes = wishes_of(design.select, analysis.frame, groups)
        many = analysis.frame.n_floors > FEW_STOREYS or bool(rules_of(design).clauses)
        self.alike = {  # how many diagonals must have like Omega
            axis: analysis.dissipative[axis].size
            for axis in AXES
            if many and HOMOGENEOUS in self.searched and system_of(design, axis).type != MOMENT_FRAME
        }
        self._each = design.select.prices_each
        names = [group.name for group in groups]
        self._group_of_members = np.array([names.index(member.group) for member in analysis.frame.members])
        self._ahead = Ahead(self._evaluated, partial(_evaluated_by, analysis.building, self.groups), workers)

    @property
    def count(self) -> int:
        """Number of choices that were asked for, each counted once."""
        return len(self._asked)

    def close(self) -> None:
        """End the other processes."""
        self._ahead.close()

    def expect(self, choices: Iterable[Choice]) -> None:
        """Foretell what will be asked for next, so that other processes begin with it; it counts when it is asked for.

        Args:
            choices: in their order.
        """
        self._ahead.expect(choice for choice in choices if choice not in self._known)

    def mass(self, choice: Choice) -> float:
        """Return the mass of steel, kg.

        Args:
            choice: number of the section of each group.
        """
        return math.fsum(group.mass[number] for group, number in zip(self.groups, choice, strict=True))

    def cost(self, choice: Choice) -> float:
        """Return what is to be least: the mass of steel in kg, or its price with that of splices, without doublers.

        Which panels need a doubler is known after an analysis; a cost is then larger, never smaller.

        Args:
            choice: number of the section of each group.
        """
        steel = math.fsum(group.cost[number] for group, number in zip(self.groups, choice, strict=True))
        return steel if self._each.splice is None else steel + self._each.splice * self.wishes.splices(choice)

    def sections(self, choice: Choice) -> dict[str, str]:
        """Return the section of each group."""
        return {group.name: group.sections[number] for group, number in zip(self.groups, choice, strict=True)}

    def known(self, choice: Choice) -> Evaluation | None:
        """Return what was found for a choice; None if it was not asked for."""
        return self._known.get(choice)

    @property
    def prices_doublers(self) -> bool:
        """Whether a doubler has a price."""
        return self._each.doubler is not None

    def all_known(self) -> tuple[Evaluation, ...]:
        """Return all that was found so far."""
        return tuple(self._known.values())

    def __call__(self, choice: Choice) -> Evaluation:
        """Return what a full analysis finds for a choice."""
        if choice not in self._known:
            self._count(choice)
            self._known[choice] = self._ahead(choice)
        return self._known[choice]

    def design(self, choice: Choice) -> ElasticDesign:
        """Return the whole design of a choice.

        Args:
            choice: number of the section of each group.

        Raises:
            OutOfEvaluations: the budget is used up.
        """
        self._count(choice)
        return self._design(choice)

    def under_frozen_forces(self, design: ElasticDesign, choice: Choice) -> np.ndarray:
        """Return the largest utilisation of the members of each group under the forces of another design, (n_groups,).

        Args:
            design: that gives the forces.
            choice: of the sections.
        """
        frame = self.analysis.sections.frame_with(self.sections(choice))
        frame = frame.with_sections(frame.members, design.frame.cases, frame.node_mass)  # loads are frozen too
        of_members = self.analysis.members.under_frozen_forces(frame, design.effects, design.members)
        found = np.zeros(len(self.groups))
        np.maximum.at(found, self._group_of_members, of_members)
        return found

    def broken(self, design: ElasticDesign) -> list[RuleCheck]:
        """Return the rules for the building that a design does not meet and that the selection looks at."""
        return [rule for rule in design.criteria if rule.passed is False and rule.clause in self.searched]

    def excess(self, design: ElasticDesign) -> tuple[float, float]:
        """Return the sum of max(u - 1, 0) over members, storeys, joints, diagonals of a design, and the largest u."""
        over = [np.minimum(values, FINITE) for values in utilisations(design, self.searched).values()]
        every = np.concatenate(over)
        return float(np.maximum(every - 1.0, 0.0).sum()), float(every.max())

    def in_the_way(self, design: ElasticDesign) -> set[int]:
        """Return the groups that have to do with what a design does not meet: their own checks, or broken rules."""
        found = {int(self._group_of_members[n]) for n in np.flatnonzero((design.members.utilisation > 1.0).any(axis=1))}
        for rule in self.broken(design):
            axes = [axis for axis in AXES if axis_of(rule) in (axis, None)]
            resisting = {int(self._group_of_members[n]) for axis in axes for n in self.analysis.dissipative[axis]}
            columns = {place for place, group in enumerate(self.groups) if group.kind == "column"}
            if rule.clause in (JOINTS, PANELS):
                found |= self.weak_columns(design)
            elif rule.clause in (CLASS, HOMOGENEOUS, SYMMETRIC, *SLENDER, *NTC_ALONE):
                found |= resisting
            elif rule.clause == COLUMN_BASES:
                found |= columns
            elif rule.clause == LIMITED:
                found |= {place for place, group in enumerate(self.groups) if group.kind == "beam"}
            else:  # drifts, second-order effects and regularity: all that stiffens the direction
                found |= resisting | columns
        return found

    def weak_columns(self, design: ElasticDesign) -> set[int]:
        """Return the groups of columns below joints where columns or web panels are too weak for the beams."""
        nodes: set[str] = set()
        if JOINTS in self.searched:
            nodes |= {joint.node for joint in design.joints if not joint.passed}
        if PANELS in self.searched:
            plates = design_of(design.building).members.doubler_plates
            nodes |= {panel.node for panel in design.panels if panel.utilisation(plates) > 1.0}
        names = design.frame.node_names
        return {
            int(self._group_of_members[number])
            for number, member in enumerate(design.frame.members)
            if member.kind == "column" and names[member.end] in nodes
        }

    def _count(self, choice: Choice) -> None:
        if choice not in self._asked and self.budget is not None and self.count >= self.budget:
            raise OutOfEvaluations
        self._asked.add(choice)

    def _design(self, choice: Choice) -> ElasticDesign:
        if self._last is None or self._last[0] != choice:
            self._last = choice, self.analysis.design(self.sections(choice), least_sway=True)
        return self._last[1]

    def _evaluated(self, choice: Choice) -> Evaluation:
        design = self._design(choice)
        excess, worst = self.excess(design)
        met = not bool((design.members.utilisation > 1.0).any()) and not self.broken(design)
        doublers = sum(panel.doubler > 0.0 for panel in design.panels)
        cost = self.cost(choice) + (self._each.doubler or 0.0) * doublers
        return Evaluation(choice, self.mass(choice), cost, met, excess, worst, doublers, self._logs(design))

    def _logs(self, design: ElasticDesign) -> np.ndarray:
        use = dict(utilisations(design, self.searched))
        of_members = np.nan_to_num(use.pop("members"), nan=0.0)
        of_checks = np.nan_to_num(design.members.utilisation, nan=0.0)
        of_groups = np.zeros((len(self.groups), of_checks.shape[1]))
        np.maximum.at(of_groups, self._group_of_members, of_checks)
        parts = [of_groups.ravel(), np.array([of_members.max()])]
        for name, values in use.items():
            if not name.startswith(HOMOGENEOUS):
                parts.append(np.array([values.max(initial=0.0)]) if name in RULES else values)
        parts += [design.overstrength[axis].ratios for axis in self.alike]
        return np.log(np.clip(np.concatenate(parts), 1.0 / FINITE, FINITE)).astype(np.float32)


def _evaluated_by(building: Building, groups: Sequence[Group]) -> Callable[[Choice], Evaluation]:
    """Return the evaluation of choices in another process, which begins with the sections of the file as this one."""
    return Evaluator(ElasticAnalysis(building), groups)._evaluated


def axis_of(rule: RuleCheck) -> Axis | None:
    """Return the direction that a rule for the building names; None if it names none."""
    return next((axis for axis in AXES if f"direction {axis}" in rule.text), None)


def searched_clauses(analysis: ElasticAnalysis) -> frozenset[str]:
    """Return the clauses for the whole building that sections can change.

    The symmetry of diagonals is one of them where those of a storey are of several groups; all others (q, modes) are
    those of the file whatever its sections.
    """
    found = {CLASS, COLUMN_BASES, PANELS, TORSION, THETA, DRIFT, JOINTS, HOMOGENEOUS, STABLE, STRAINED}
    found |= {*SLENDER, *LINKS}
    if rules_of(design_of(analysis.building)).changes is not None:
        found |= {GRADUAL, *NTC_ALONE}
    limits = design_of(analysis.building).serviceability
    if limits.beams.total is not None or limits.beams.live is not None:
        found.add(LIMITED)
    if limits.sway.storey is not None or limits.sway.building is not None:
        found.add(SWAY_LIMITED)
    restrained = {run.group for run in analysis.building.braces if run.law is not None}
    of_storeys: dict[tuple[str, int], set[str]] = {}
    for axis in AXES:
        for number in analysis.dissipative[axis]:
            member = analysis.frame.members[number]
            if member.kind == "brace" and member.group not in restrained:
                of_storeys.setdefault((axis, member.storey), set()).add(member.group)
    if any(len(groups) > 1 for groups in of_storeys.values()):
        found.add(SYMMETRIC)
    return frozenset(found)


def utilisations(design: ElasticDesign, clauses: frozenset[str]) -> Mapping[str, np.ndarray]:
    """Return how far each limit is used, by clause: members, storeys, joints and diagonals one by one; 1 is the limit.

    Args:
        clauses: for the whole building that count beside the checks of members.
    """
    found = {"members": np.nanmax(design.members.utilisation, axis=1, initial=0.0)}
    block = design_of(design.building)
    for name, limit in (("total", block.serviceability.beams.total), ("live", block.serviceability.beams.live)):
        if limit is not None:
            found[f"{LIMITED} {name}"] = getattr(design.deflections, name) / design.deflections.span / limit
    of, sway = design.lateral, block.serviceability.sway
    if sway.storey is not None:
        found[f"{SWAY_LIMITED} storey"] = (of.combined / of.height / sway.storey).ravel()
    if sway.building is not None:
        found[f"{SWAY_LIMITED} building"] = of.top / of.total_height / sway.building
    for number, axis in enumerate(AXES):
        if block.imperfections == "sway":
            found[f"{STABLE} {axis}"] = AMPLIFICATION / design.sway.alpha_cr[:, [number, 2]].ravel()
        storeys = design.storeys[axis]
        found[f"{THETA} {axis}"] = storeys.theta / AMPLIFIED
        if storeys.limit is not None:
            found[f"{DRIFT} {axis}"] = storeys.reduced / storeys.limit
        plates = block.members.doubler_plates
        panels = [panel.utilisation(plates) for panel in design.panels if panel.axis == axis]
        found[f"{PANELS} {axis}"] = np.minimum(np.array(panels), FINITE)
        asked = [joint.ratio for joint in design.joints if joint.axis == axis and not joint.exempt]
        found[f"{JOINTS} {axis}"] = LEAST_RATIO / np.maximum(np.array(asked), LEAST_RATIO / FINITE)
        Omega = design.overstrength[axis]
        if linked := [link for link in design.links if link.axis == axis]:
            found[f"{LINKS[0]} V{axis}"] = np.array([link.shear_use for link in linked])
            found[f"{LINKS[0]} M{axis}"] = np.array([link.moment_use for link in linked])
            found[f"{LINKS[1]} {axis}"] = np.array([link.e / max(link.longest, 1e-3 * link.e) for link in linked])
            found[f"{LINKS[2]} {axis}"] = Omega.ratios / Omega.Omega / (1.0 + HOMOGENEITY)
            found[f"{LINKS[3]} {axis}"] = np.array([link.theta_p / link.theta_pR for link in linked])
            continue
        if system_of(block, axis).type in (MOMENT_FRAME, RESTRAINED) or not Omega.members.size:
            continue
        many = design.frame.n_floors > FEW_STOREYS
        if many:
            steep = brace_slenderness(design.building, design.frame, Omega.members)
            found[f"{SLENDER[1]} {axis}"] = steep / SLENDERNESS["diagonal"][1]
        if many or rules_of(block).clauses:
            found[f"{HOMOGENEOUS} {axis}"] = Omega.ratios / Omega.Omega / (1.0 + HOMOGENEITY)
    for clause in RULES:
        rules = [rule for rule in design.criteria if rule.clause == clause and rule.passed is not None]
        found[clause] = np.array([rule.utilisation for rule in rules])
    counted = {"members", *clauses}
    return {name: of for name, of in found.items() if name in counted or name.rsplit(" ", 1)[0] in counted}
