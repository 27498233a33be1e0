"""What a search for a placement has proved, found from the layouts it analysed alone."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from edesign.study.placement.knowledge import Knowledge
from edesign.study.placement.search import chosen_of
from edesign.study.placement.space import Layout

Proof = Literal["optimal", "optimal_if_monotone", "local", "local_if_monotone", "none"]


@dataclass(frozen=True)
class Certificate:
    """The proof about the chosen layout.

    Attributes:
        proof: `optimal`: every cheaper layout was analysed and missed a criterion; `local`: every cheaper one that
            differs in one or two positions; `if_monotone`: those not analysed have nowhere more dampers than one that
            missed. Where no layout meets the criteria, all layouts stand for the cheaper ones.
        layouts: in the space.
        cheaper: of them; None: too many to be listed.
        cheaper_analysed: of these.
        cheaper_ruled_out: those that were not analysed and have nowhere more than one that missed.
        nearby, nearby_analysed, nearby_ruled_out: the same of those that differ in one or two positions.
        same_cost: other layouts of the same cost; None: not listed.
        same_cost_analysed: of them.
        harmed_by_more: layouts that missed and have nowhere less than one that met.
        met: whether the chosen layout meets the criteria.
    """

    proof: Proof
    layouts: int
    cheaper: int | None
    cheaper_analysed: int
    cheaper_ruled_out: int
    nearby: int
    nearby_analysed: int
    nearby_ruled_out: int
    same_cost: int | None
    same_cost_analysed: int
    harmed_by_more: int
    met: bool

    @property
    def sentence(self) -> str:
        """The proof in words."""
        each = "each layout" if not self.met else "each cheaper layout"
        count = self.layouts if not self.met else self.cheaper
        if self.proof == "optimal":
            text = f"optimal: {each} ({count}) was analysed and misses a criterion"
            if self.met and count == 0:
                text = "optimal: no layout is cheaper"
        elif self.proof == "optimal_if_monotone":
            text = (
                f"optimal if more dampers never harm: {each} ({count}) was analysed and misses a criterion "
                f"({self.cheaper_analysed}), or has nowhere more than one that misses ({self.cheaper_ruled_out})"
            )
        elif self.proof == "none":
            text = "not searched further: the budget is spent; layouts nearby were not all analysed"
        else:
            rest = f", or has nowhere more than one that misses ({self.nearby_ruled_out})"
            assumed = self.proof == "local_if_monotone"
            text = (
                f"local{' if more dampers never harm' if assumed else ''}: {each} that differs in one or two positions "
                f"({self.nearby}) was analysed and misses a criterion ({self.nearby_analysed}){rest if assumed else ''}"
            )
        if not self.met:
            text = text.replace("optimal", "none meets the criteria", 1)
        if self.harmed_by_more:
            text += f"; in {self.harmed_by_more} layouts analysed more dampers did harm"
        return text


def certify(knowledge: Knowledge, monotone: bool) -> Certificate:
    """Return the proof about the layout that a search chose.

    Args:
        knowledge: all that was analysed.
        monotone: whether the design assumes that more dampers never harm; where histories showed the contrary it is
            not taken for granted.
    """
    space, best, chosen = knowledge.space, knowledge.best, chosen_of(knowledge)
    bound = None if best is None else best.cost - 1
    harmed_by_more = knowledge.harmed_by_more()
    allowed = monotone and not harmed_by_more
    listed = space.listed(bound)
    cheaper = None if listed is None else [tuple(row) for row in listed.tolist()]
    near = [one for one in space.neighbours(chosen.layout) if bound is None or space.cost(one) <= bound]
    same_cost = None
    if best is not None and cheaper is not None:
        up_to = space.listed(best.cost)
        same = [] if up_to is None else [tuple(row) for row in up_to.tolist() if space.cost(tuple(row)) == best.cost]
        same_cost = None if up_to is None else [one for one in same if one != chosen.layout]
    all_counts = (0, 0) if cheaper is None else _counts(knowledge, cheaper, allowed)
    count = None if cheaper is None else len(cheaper)
    if best is None:  # whatever there is of it, a miss of the fullest layout rules out all the rest
        count = space.size
        if allowed and any(space.above_all(one.layout) for one in knowledge.analysed):
            all_counts = (len(knowledge.analysed), space.size - len(knowledge.analysed))
    near_counts = _counts(knowledge, near, allowed)
    return Certificate(
        _proof(count, all_counts, len(near), near_counts),
        space.size,
        count,
        *all_counts,
        len(near),
        *near_counts,
        None if same_cost is None else len(same_cost),
        0 if same_cost is None else sum(one in knowledge for one in same_cost),
        harmed_by_more,
        best is not None,
    )


def _proof(cheaper: int | None, all_counts: tuple[int, int], near: int, near_counts: tuple[int, int]) -> Proof:
    if cheaper is not None and sum(all_counts) == cheaper:
        return "optimal_if_monotone" if all_counts[1] else "optimal"
    if sum(near_counts) == near:
        return "local_if_monotone" if near_counts[1] else "local"
    return "none"


def _counts(knowledge: Knowledge, layouts: list[Layout], monotone: bool) -> tuple[int, int]:
    """How many of some layouts were analysed, and how many of the others have nowhere more than one that missed."""
    left = [one for one in layouts if one not in knowledge]
    if not (monotone and left):
        return len(layouts) - len(left), 0
    out = knowledge.space.below_some(np.array(left, dtype=np.int8), knowledge.missed)
    return len(layouts) - len(left), int(np.count_nonzero(out))
