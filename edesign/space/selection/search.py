"""The search for the lightest sections: size under frozen forces, climb until all checks are met, descend.

What is lighter here costs less: its mass is less, or where the file gives prices its price.
No step is random; what it costs is counted in evaluations, not in seconds, so that a file gives the same sections
wherever it is run.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, permutations, zip_longest
from types import MappingProxyType

from edesign.errors import InputError
from edesign.space.designed import ElasticDesign
from edesign.space.selection.evaluate import Choice, Evaluation, Evaluator, OutOfEvaluations
from edesign.space.selection.groups import Group
from edesign.space.selection.separable import Separable
from edesign.space.selection.wishes import Exchange, Wishes
from edesign.space.structure.frame import SpaceFrame

UP = (1, 2)
"""Sizes that a group goes up in one step, among the heavier sections that are stiffer."""
DOWN = 3
"""Sizes that a group goes down at most in one step, among all lighter sections and among the stiffest of them."""
COLUMNS_ABOVE = 2
"""Sizes by which the columns of each start stand above those of the one before it."""
SILENT = 100
"""Evaluations after which the search says where it is."""
Move = tuple[tuple[int, int], ...]
"""Groups with the sizes that they go up or, negative, down."""
Listener = Callable[[str], None]


class Line(str):
    """A line of progress.

    Attributes:
        share: of the starts that are done; 0 as long as the first goes on.
    """

    share: float = 0.0


@dataclass(frozen=True)
class Found:
    """Result of a search.

    Attributes:
        best: the lightest choice that meets all checks; without one that with the least excess.
        certified: whether every single and double exchange that is lighter was analysed and misses a check.
        starts: how many of the starts came to a choice that meets all checks.
    """

    best: Evaluation
    certified: bool
    starts: int


class Search:
    """Searches the lightest sections of a building.

    Args:
        order: pairs of groups (upper, lower) of which the upper one must not be larger.
        budget: largest number of evaluations.
        progress: takes a line of progress.
        wishes: which choices are allowed; None: those of the file.
    """

    def __init__(
        self,
        evaluate: Evaluator,
        order: Sequence[tuple[int, int]],
        budget: int,
        progress: Listener = lambda line: None,
        wishes: Wishes | None = None,
    ) -> None:
        self._wishes = evaluate.wishes if wishes is None else wishes
        self._evaluate = evaluate
        self._groups = evaluate.groups
        self._order = tuple(order)
        self._budget = budget
        self._progress = progress
        self._at = ""  # the start, in words
        self._share = 0.0  # of the starts that are done
        self._told = 0  # evaluations by the last line

    def run(self, starts: int, given: Mapping[str, Choice] = MappingProxyType({})) -> Found:
        """Search from some starts.

        Args:
            starts: how many points, the first of the lightest sections.
            given: choices to start from first, by their names, such as that of the file: nothing worse is found.
        """
        best: Evaluation | None = None
        certified, fruitful = False, 0
        points = starts + len(given)
        self._evaluate.budget = self._evaluate.count + self._budget
        try:
            met: list[tuple[str, Evaluation]] = []
            for done, (name, point) in enumerate(self._points(starts, given), 1):
                self._at = name
                climbed = self._climbed(self._approached(point))
                self._share = 0.5 * done / points
                if climbed.met:
                    fruitful += 1
                    met.append((name, climbed))
                    self._said(f"all checks met with {climbed.mass / 1e3:.2f} t")
                else:
                    self._said("no choice found that meets all checks")
            for done, (name, climbed) in enumerate(sorted(met, key=lambda pair: pair[1].cost), 1):
                self._at = name
                lightest = self._descended(climbed)
                self._share = 0.5 + 0.5 * done / fruitful
                self._said(f"{lightest.mass / 1e3:.2f} t")
                if best is None or _less(lightest.cost, best.cost):
                    best, certified = lightest, True
            while (lighter := self._met(best)) is not None:  # that a start met on its way
                best = self._descended(lighter)
        except OutOfEvaluations:
            self._progress(f"the {self._budget} evaluations of design.select are used up")
            if (lighter := self._met(best)) is not None:
                best, certified = lighter, False
        finally:
            self._evaluate.budget = None
        known = [of for of in self._evaluate.all_known() if self._ordered(of.choice)] if best is None else []
        return Found(best or min(known, key=lambda of: (of.excess, of.cost, of.choice)), certified, fruitful)

    def _met(self, best: Evaluation | None) -> Evaluation | None:
        """The lightest choice found so far that meets all checks; None if it is not lighter than the best one."""
        lighter = [of for of in self._evaluate.all_known() if best is None or _less(of.cost, best.cost)]
        met = [of for of in lighter if of.met and self._ordered(of.choice)]
        return min(met, key=lambda of: (of.cost, of.worst, of.choice), default=None)

    def _said(self, what: str) -> None:
        line = Line(f"{self._at}: {what} ({self._evaluate.count} evaluations)")
        line.share = self._share
        self._told = self._evaluate.count
        self._progress(line)

    def _goes_on(self, what: str) -> None:
        """Say where the search is, if that was not said for many evaluations."""
        if self._at and self._evaluate.count >= self._told + SILENT:
            self._said(what)

    def _points(self, starts: int, given: Mapping[str, Choice]) -> Iterator[tuple[str, Evaluation]]:
        """What to climb from, each once, with its name.

        First the given choices; then what members and joints need, from the lightest; then columns above that.
        """
        seen: set[Choice] = set()
        for name, choice in given.items():
            point = self.repaired(choice)
            if point is not None and point not in seen:
                seen.add(point)
                yield name, self._evaluate(point)
        self._at = ""
        sized = self._strengthened(self._sized(self.lightest()))
        for k in range(starts):
            numbers = [
                min(number + COLUMNS_ABOVE * k * (group.kind == "column"), len(group.sections) - 1)
                for group, number in zip(self._groups, sized.choice, strict=True)
            ]
            point = self.repaired(numbers)
            if point is not None and point not in seen:
                seen.add(point)
                yield f"start {k + 1} of {starts}", self._evaluate(point)

    def lightest(self) -> Choice:
        """Return the lightest sections of the lists.

        Raises:
            InputError: the lists have only larger columns above than below, or nothing that the wishes allow.
        """
        found = self.repaired([0] * len(self._groups))
        if found is None and self._wishes.bind:
            raise InputError(
                "no sections of the lists were found that `same_depth`, `most_sections` and "
                "`columns_not_larger_above` allow together; give longer or like lists [E-SPACE-07]"
            )
        if found is None:
            raise InputError(
                "the sections of a group of columns are all larger than those of the group below it [E-SPACE-07]"
            )
        return found

    def repaired(self, numbers: Sequence[int]) -> Choice | None:
        """Make lower columns as large as those above them, and grant the wishes.

        Each grows sections alone, so that they come to an end.

        Returns:
            The choice; None where the lists do not allow it.
        """
        ordered = self._in_order(list(numbers))
        while ordered is not None and not self._wishes.met(ordered):
            raised = self._wishes.raised(ordered)
            ordered = None if raised is None else self._in_order(raised)
        return ordered

    def lighter(self, base: Choice, wide: bool = False) -> dict[Choice, Exchange]:
        """Return the exchanges of a choice that are lighter, the lightest first: single and double ones; or wide ones.

        Args:
            wide: those of more groups or more sizes, which the certificate does not speak of.
        """
        cost, found, costs = self._whole_cost(base), dict[Choice, Exchange](), dict[Choice, float]()
        for exchange in self._wide_exchanges(base) if wide else self._exchanges(base):
            numbers = list(base)
            for group, number in exchange:
                numbers[group] = number
            choice = tuple(numbers)
            if self._ordered(choice) and _less(less := self._evaluate.cost(choice), cost):
                found[choice], costs[choice] = exchange, less
        return {of: found[of] for of in sorted(found, key=lambda of: (costs[of], of))}

    def _whole_cost(self, choice: Choice) -> float:
        """What a choice costs, with doublers if it was analysed."""
        known = self._evaluate.known(choice)
        return self._evaluate.cost(choice) if known is None else known.cost

    # --- points

    def _in_order(self, numbers: list[int]) -> Choice | None:
        for _ in range(len(self._groups)):  # from storey to storey
            done = True
            for upper, lower in self._order:
                needed = self._groups[upper].area[numbers[upper]]
                if self._groups[lower].area[numbers[lower]] >= needed:
                    continue
                fits = [k for k, area in enumerate(self._groups[lower].area) if area >= needed]
                if not fits:
                    return None
                numbers[lower], done = fits[0], False
            if done:
                return tuple(numbers)
        return None

    def _ordered(self, choice: Sequence[int]) -> bool:
        return self._wishes.met(choice) and all(
            self._groups[upper].area[choice[upper]] <= self._groups[lower].area[choice[lower]]
            for upper, lower in self._order
        )

    def _moved(self, base: Choice, move: Move) -> list[int] | None:
        """The numbers of a choice after a move; None where a list ends."""
        numbers = list(base)
        for group, steps in move:
            stiffer = self._groups[group].stiffer[base[group]]
            if steps > len(stiffer) or base[group] + steps < 0:
                return None
            numbers[group] = stiffer[steps - 1] if steps > 0 else base[group] + steps
        return numbers

    def _exchanges(self, base: Choice) -> Iterator[Exchange]:
        """Exchanges that may be lighter: one group down, one down and another up, two down."""
        groups = range(len(base))
        below = [self._below(group, base[group], 1) for group in groups]
        above = [self._groups[group].stiffer[base[group]][: len(UP)] for group in groups]
        yield from (((group, k),) for group in groups for k in self._below(group, base[group], DOWN))
        yield from (
            ((one, a), (other, b)) for one, other in permutations(groups, 2) for a in below[one] for b in above[other]
        )
        yield from (
            ((one, a), (other, b)) for one, other in combinations(groups, 2) for a in below[one] for b in below[other]
        )
        if self._wishes.widen or self._evaluate.prices_doublers:
            single = [
                ((group, k),) for group in groups for k in (*self._below(group, base[group], DOWN), *above[group])
            ]
            yield from single
            yield from self._wishes.exchanges(base, single)

    def _wide_exchanges(self, base: Choice) -> Iterator[Exchange]:
        """Exchanges of more: a group down by several sizes and another up; all beams up and all columns down, or so."""
        groups = range(len(base))
        below = [self._below(group, base[group], DOWN) for group in groups]
        above = [self._groups[group].stiffer[base[group]][: len(UP)] for group in groups]
        for one, other in permutations(groups, 2):
            yield from (((one, a), (other, b)) for a in below[one] for b in above[other])
        for down, up in (("column", "beam"), ("beam", "column")):
            falling = [group for group in groups if self._groups[group].kind == down and below[group]]
            rising = [group for group in groups if self._groups[group].kind == up and above[group]]
            for size in range(DOWN):
                yield (
                    *((group, below[group][max(len(below[group]) - 1 - size, 0)]) for group in falling),
                    *((group, above[group][0]) for group in rising),
                )

    def _below(self, group: int, number: int, sizes: int) -> tuple[int, ...]:
        """The next lighter sections, and the next lighter of those that are stiffer than all lighter ones."""
        records = [k for k in self._groups[group].records if k < number]
        return tuple(dict.fromkeys([*range(max(number - sizes, 0), number), *records[-sizes:]]))

    # --- stages

    def _sized(self, point: Choice) -> Evaluation:
        """Give every group the lightest section that passes under the forces found, while that lowers the excess."""
        best: Evaluation | None = None
        while True:
            found = self._evaluate(point)
            if best is not None and (found.excess, found.cost) >= (best.excess, best.cost):
                return best
            best = found
            sized = self.repaired(self._lightest(self._evaluate.design(point), point))
            if sized is None:
                return best
            point = sized

    def _strengthened(self, point: Evaluation) -> Evaluation:
        """Raise columns below weak joints, and what then fails under the forces found, until no joint is weak.

        Without this the climb would weaken beams, which many joints at once ask for, and come back a long way.
        """
        best = point
        while weak := self._evaluate.weak_columns(self._evaluate.design(point.choice)):
            numbers = list(point.choice)
            for group in weak:
                numbers[group] = next(iter(self._groups[group].stiffer[numbers[group]]), numbers[group])
            raised = self.repaired(numbers)
            if raised is None or raised == point.choice:
                break
            grown = self.repaired(self._grown(self._evaluate.design(raised), raised))
            point = self._evaluate(raised if grown is None else grown)
            if (point.excess, point.cost) < (best.excess, best.cost):
                best = point
        return best

    def _lightest(self, design: ElasticDesign, point: Choice) -> list[int]:
        """Return for each group the lightest section, next to that of a choice, that passes under frozen forces."""
        numbers = self._grown(design, point)
        shrinking = {group for group, number in enumerate(numbers) if number == point[group]}
        while shrinking:
            shrinking = {group for group in shrinking if numbers[group] > 0}
            lower = [number - (group in shrinking) for group, number in enumerate(numbers)]
            use = self._evaluate.under_frozen_forces(design, tuple(lower))
            shrinking = {group for group in shrinking if use[group] <= 1.0}
            for group in shrinking:
                numbers[group] -= 1
        return numbers

    def _grown(self, design: ElasticDesign, point: Choice) -> list[int]:
        """Return a choice with the groups whose members fail under the forces of a design raised until they pass."""
        numbers, last = list(point), [len(group.sections) - 1 for group in self._groups]
        use = self._evaluate.under_frozen_forces(design, point)
        growing = {group for group in range(len(point)) if use[group] > 1.0 and numbers[group] < last[group]}
        while growing:
            for group in growing:
                numbers[group] += 1
            use = self._evaluate.under_frozen_forces(design, tuple(numbers))
            growing = {group for group in growing if use[group] > 1.0 and numbers[group] < last[group]}
        return numbers

    def _approached(self, base: Evaluation) -> Evaluation:
        """Move to what a model of single exchanges proposes for all groups together, as long as that is better.

        The model is made of the neighbours of the base in each group. When it has no more to propose it is made anew,
        and then, while checks are not met, of the neighbours beyond these as well; a descent looks further otherwise.
        """
        alike = self._evaluate.alike.values()
        model = Separable(base, self._groups, alike, self._evaluate.cost, self._ordered)
        sizes = 1
        while True:
            self._learnt(model, sizes)
            better: Evaluation | None = None
            while better is None and (choice := model.proposal()) is not None:
                found = self._evaluate(choice)
                if _better(found, model.base):
                    better = found
                else:
                    model.refuse(found)
            if better is not None:
                sizes = 1
                model.move(better)
                self._goes_on(f"{better.mass / 1e3:.2f} t" + ("" if better.met else ", not all checks met"))
            elif model.stale:
                model.forget()
            elif sizes < len(UP) and not model.base.met:
                sizes += 1
            else:
                return model.base

    def _learnt(self, model: Separable, sizes: int) -> None:
        """Let a model know the neighbours of its base: of each group the next lighter and the next stiffer sections."""
        base = model.base.choice
        for group, number in enumerate(base):
            for k in (*self._below(group, number, sizes), *self._groups[group].stiffer[number][:sizes]):
                if not model.knows(group, k):
                    model.learn(self._evaluate((*base[:group], k, *base[group + 1 :])), group)

    def _climbed(self, base: Evaluation) -> Evaluation:
        """Move to what lowers the excess most for its cost until all checks are met, or nothing lowers it.

        Where no move lowers it alone, each is tried with the larger sections that other groups then need: stiffer beams
        are stronger, and ask more of columns.
        """
        gains: dict[Move, float] = {}
        while not base.met:
            better = self._best_move(base, gains, self._of_move) or self._best_move(base, {}, self._of_move_with_others)
            if better is None:
                return base
            base = better
            self._goes_on(f"climbing, {base.mass / 1e3:.2f} t so far")
        return base

    def _best_move(
        self, base: Evaluation, gains: dict[Move, float], found_by: Callable[[Evaluation, Move], Evaluation | None]
    ) -> Evaluation | None:
        """The step that lowers the excess most for its cost; None if none does.

        Args:
            base: where it starts.
            gains: of earlier steps, which stand until their turn comes, so that only the best are found again; updated.
            found_by: what comes of a move.
        """
        numbers = range(len(self._groups))
        moves: list[Move] = [((group, steps),) for group in numbers for steps in (*UP, -1)]
        for kinds in (("column",), ("beam",), ("brace",), ("column", "beam")):  # all of a kind at once
            moves.append(tuple((group, 1) for group in numbers if self._groups[group].kind in kinds))
        order = sorted(moves, key=lambda move: -gains.get(move, math.inf))  # sorted keeps what is equal in order
        best: tuple[float, Evaluation] | None = None
        self._evaluate.expect(choice for move in order if (choice := self._after(base, move)) is not None)
        for move in order:
            if best is not None and best[0] >= gains.get(move, math.inf):
                break
            found = found_by(base, move)
            gains[move] = _gain(base, found)
            if found is not None and gains[move] > (best[0] if best is not None else 0.0):
                best = gains[move], found
        return None if best is None else best[1]

    def _after(self, base: Evaluation, move: Move) -> Choice | None:
        """The choice that a move leads to, with columns in order; None if there is none."""
        numbers = self._moved(base.choice, move)
        choice = None if numbers is None else self.repaired(numbers)
        return None if choice == base.choice else choice

    def _of_move(self, base: Evaluation, move: Move) -> Evaluation | None:
        choice = self._after(base, move)
        return None if choice is None else self._evaluate(choice)

    def _of_move_with_others(self, base: Evaluation, move: Move) -> Evaluation | None:
        found = self._of_move(base, move)
        if found is None:
            return None
        design = self._evaluate.design(found.choice)
        choice = self.repaired(self._grown(design, found.choice))
        return found if choice is None else self._evaluate(choice)

    def _descended(self, base: Evaluation) -> Evaluation:
        """Exchange sections as long as the building gets lighter and all checks stay met.

        First come exchanges that pass the checks of members under frozen forces and have not failed before, then all
        others: so the last round has analysed every exchange that is lighter.
        """
        failed: set[Exchange] = set()
        while True:
            every = self.lighter(base.choice)
            first = self._promising(base.choice, every | self.lighter(base.choice, wide=True), failed)
            step = self._step(first, failed, base.cost) or self._step(every, failed, base.cost)
            if step is None:
                return base
            base = step
            self._goes_on(f"{base.mass / 1e3:.2f} t so far")

    def _promising(self, base: Choice, every: dict[Choice, Exchange], failed: set[Exchange]) -> dict[Choice, Exchange]:
        """Return the exchanges, the lightest first, that have not failed and pass under the forces of a choice."""
        new = {of: exchange for of, exchange in every.items() if exchange not in failed}
        passing = self._passing(base, {pair for exchange in new.values() for pair in exchange})
        ordered = sorted(new, key=lambda of: (self._evaluate.cost(of), of))
        return {of: new[of] for of in ordered if passing.issuperset(new[of])}

    def _passing(self, base: Choice, pairs: set[tuple[int, int]]) -> set[tuple[int, int]]:
        """Return the groups with numbers of sections whose members pass under the forces of a choice."""
        design = self._evaluate.design(base)
        wanted = {group: sorted(number for of, number in pairs if of == group) for group in range(len(base))}
        found = set()
        for row in zip_longest(*wanted.values()):
            numbers = [given if wish is None else wish for wish, given in zip(row, base, strict=True)]
            use = self._evaluate.under_frozen_forces(design, tuple(numbers))
            found |= {(group, number) for group, number in enumerate(numbers) if use[group] <= 1.0}
        return found

    def _step(self, choices: Mapping[Choice, Exchange], failed: set[Exchange], cost: float) -> Evaluation | None:
        """Return the cheapest choice that meets all checks for less than a cost, of equal ones the least used.

        Args:
            choices: by rising cost without doublers.
        """
        best: Evaluation | None = None
        self._evaluate.expect(choices)
        for choice, exchange in choices.items():
            if best is not None and _less(best.cost, self._evaluate.cost(choice)):
                break
            found = self._evaluate(choice)
            if not found.met:
                failed.add(exchange)
            elif not _less(found.cost, cost):
                continue  # its doublers make up for what it saves
            elif best is None or _less(found.cost, best.cost):
                best = found
            elif not _less(best.cost, found.cost) and found.worst < best.worst:
                best = found
        return best


def _less(one: float, other: float) -> bool:
    """Say whether a cost is less by more than rounding of its sum."""
    return one < other * (1.0 - 1e-12)


def _better(found: Evaluation, base: Evaluation) -> bool:
    """Say whether a choice meets all checks for less; or, where the other one misses some, is nearer to them."""
    if base.met:
        return found.met and _less(found.cost, base.cost)
    return found.met or found.excess < base.excess * (1.0 - 1e-9)


def _gain(base: Evaluation, found: Evaluation | None) -> float:
    """Excess that a step takes away for each kg, or for each unit of the price; without limit if it needs none."""
    if found is None or found.excess >= base.excess:
        return 0.0
    less = base.excess - found.excess
    more = found.cost - base.cost
    return less / more if more > 0.0 else math.inf


def column_order(frame: SpaceFrame, groups: Sequence[Group]) -> list[tuple[int, int]]:
    """Return pairs of groups of columns, upper and lower, that stand on each other somewhere.

    Args:
        groups: of members.
    """
    numbers = {group.name: number for number, group in enumerate(groups)}
    columns = [member for member in frame.members if member.kind == "column"]
    below = {member.end: member.group for member in columns}
    pairs = {(member.group, below[member.start]) for member in columns if member.start in below}
    return sorted((numbers[upper], numbers[lower]) for upper, lower in pairs if upper != lower)
