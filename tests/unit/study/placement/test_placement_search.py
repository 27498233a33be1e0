"""The search for a placement against all layouts of small spaces, with made-up histories."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Sequence

import numpy as np
import pytest

from edesign.project.notation.grid import BayPlace
from edesign.study.design.loop import RoundOutcome, RoundVerdict
from edesign.study.placement.certificate import certify
from edesign.study.placement.knowledge import Knowledge
from edesign.study.placement.search import search
from edesign.study.placement.space import Layout, LayoutSpace, Stack, make_positions, make_prices

Ratio = Callable[[Layout], float]


def space_of(
    bays: int = 2,
    storeys: int = 3,
    costs: Sequence[float] = (1.0, 1.7),
    shared: tuple[float, float, float] = (0.3, 0.2, 0.5),
    mirrored: bool = False,
    continuous: bool = False,
    groups: Sequence[Sequence[int]] = (),
    most: int | None = None,
) -> LayoutSpace:
    """A space whose items grow from one to the next."""
    options = range(1, len(costs) + 1)
    pairs = dict.fromkeys(tuple(sorted({bay, bays + 1 - bay})) if mirrored else (bay,) for bay in range(1, bays + 1))
    places = ([BayPlace("", bay, storey) for storey in range(1, storeys + 1) for bay in pair] for pair in pairs)
    stacks = (Stack(tuple(of_pair), bays if mirrored else None) for of_pair in places)
    positions = make_positions(stacks, options, continuous, groups, ())
    order = np.triu(np.ones((len(costs) + 1,) * 2, dtype=bool))
    return LayoutSpace(positions, make_prices(costs, [1] * len(costs), *shared), (0, *[1] * len(costs)), most, order)


def every(space: LayoutSpace) -> list[Layout]:
    """All layouts, by brute force."""
    return [one for one in itertools.product(*((0, *at.options) for at in space.positions)) if space.allowed(one)]


def falling(space: LayoutSpace, seed: int, base: float = 1.6) -> Ratio:
    """A worst ratio that falls with every damper, the more the larger it is, differently at each position."""
    share = np.random.default_rng(seed).uniform(0.05, 0.5, len(space.positions))
    return lambda layout: base / (1.0 + float(share @ np.array(layout)))


def uneven(space: LayoutSpace, seed: int) -> Ratio:
    """A worst ratio that dampers at some positions raise."""
    share = np.random.default_rng(seed).uniform(-0.15, 0.5, len(space.positions))
    return lambda layout: 1.6 / max(0.5, 1.0 + float(share @ np.array(layout)))


def run(
    space: LayoutSpace,
    ratio: Ratio,
    budget: int,
    monotone: bool = True,
    misled: bool = False,
    believed: Ratio | None = None,
) -> tuple[Knowledge, list[Layout]]:
    """Search with histories of one criterion; estimates are the truth, its contrary (`misled`), or `believed`."""
    asked: list[Layout] = []

    def analyse(wanted: Sequence[tuple[int, Layout]]) -> Iterator[RoundOutcome]:
        for number, layout in wanted:
            asked.append(layout)
            assert number == len(asked)
            yield RoundOutcome((RoundVerdict("drift", ratio(layout), 1.0, ratio(layout) <= 1.0),))

    def estimates(layout: Layout) -> np.ndarray:
        value = (believed or ratio)(layout) ** (-1.0 if misled else 1.0)
        return np.array([value, 1.0, 2.0])

    return search(space, analyse, estimates, budget, monotone), asked


def least(space: LayoutSpace, ratio: Ratio) -> tuple[int, float]:
    """Cost and ratio of the best of all layouts, by brute force."""
    return min((space.cost(one), ratio(one)) for one in every(space) if ratio(one) <= 1.0)


LIMITS: list[dict[str, object]] = [
    {},
    {"mirrored": True, "bays": 3},
    {"continuous": True},
    {"groups": [(1, 2)], "continuous": True},
    {"most": 3},
]


@pytest.mark.parametrize("limits", LIMITS)
@pytest.mark.parametrize("misled", [False, True])
def test_whole_search_finds_what_brute_force_finds(limits: dict[str, object], misled: bool) -> None:
    space = space_of(**limits)  # type: ignore[arg-type]
    for seed in range(4):
        ratio = falling(space, seed, 2.2)
        if not any(ratio(one) <= 1.0 for one in every(space)):
            continue
        found, asked = run(space, ratio, 10_000, misled=misled)
        best, proof = found.best, certify(found, True)
        assert best is not None and (best.cost, best.outcome.demand) == least(space, ratio)
        assert proof.proof == "optimal" and len(set(asked)) == len(asked)
        cheaper = [one for one in every(space) if space.cost(one) < best.cost]
        assert proof.cheaper == proof.cheaper_analysed == len(cheaper) and set(cheaper) <= set(asked)


def test_search_that_assumes_monotony_analyses_far_fewer() -> None:
    space = space_of(storeys=4)  # 3^8 layouts
    proofs = []
    for seed in range(3):
        ratio = falling(space, seed, 3.0)
        found, asked = run(space, ratio, 500)
        proof = certify(found, True)
        assert found.best is not None and found.best.cost == least(space, ratio)[0]
        assert proof.cheaper is not None and proof.cheaper == proof.cheaper_analysed + proof.cheaper_ruled_out
        assert len(asked) <= 500 < 0.08 * space.size
        proofs.append(proof.proof)
    assert set(proofs) <= {"optimal", "optimal_if_monotone"} and "optimal_if_monotone" in proofs


@pytest.mark.parametrize("seed", range(6))
def test_ratios_that_follow_no_rule_are_searched_to_the_end(seed: int) -> None:
    space = space_of()
    ratio = uneven(space, seed)
    assert any(ratio(one) <= 1.0 for one in every(space))
    found, _ = run(space, ratio, 10_000)
    proof = certify(found, True)
    assert found.best is not None and found.best.cost == least(space, ratio)[0] and proof.proof == "optimal"


def test_a_miss_of_the_fullest_layout_does_not_hide_what_meets() -> None:
    """The fullest misses, as where dampers lock a storey; what estimates say falls with every damper."""
    space = space_of(storeys=4)

    def ratio(layout: Layout) -> float:
        return 0.95 + 0.05 * abs(sum(layout) - 14)

    found, asked = run(space, ratio, 200, believed=falling(space, 1, 3.0))
    proof = certify(found, True)
    assert (2,) * 8 in asked and found.best is not None and proof.harmed_by_more
    assert sum(found.best.layout) == 13 and "more dampers did harm" in proof.sentence
    # whatever is left out of a shorter search, nothing is claimed by an assumption that histories contradict
    shorter = [certify(run(space, ratio, n, believed=falling(space, 1, 3.0))[0], True) for n in (20, 60, 120)]
    harmed = [one for one in shorter if one.harmed_by_more]
    assert harmed and not any("if_monotone" in one.proof for one in (proof, *harmed))


def test_small_budget_claims_no_more_than_it_has_seen() -> None:
    space = space_of(storeys=4)
    ratio = falling(space, 1, 3.5)
    for budget in (1, 5, 12, 40, 200):
        found, asked = run(space, ratio, budget, monotone=False)
        proof = certify(found, False)
        assert len(asked) <= budget and proof.cheaper_ruled_out == 0
        if found.best is None:
            assert proof.proof == "none" and "budget" in proof.sentence
            continue
        near = [one for one in space.neighbours(found.best.layout) if space.cost(one) < found.best.cost]
        assert (proof.proof == "local") == (set(near) <= set(asked)) and proof.proof in ("local", "none")


def test_nothing_meets() -> None:
    space = space_of(storeys=2)
    found, asked = run(space, lambda layout: 2.0 - 0.01 * sum(layout), 10_000)
    proof = certify(found, True)
    assert found.best is None and proof.proof == "optimal" and len(asked) == space.size == 81
    assert proof.sentence == "none meets the criteria: each layout (81) was analysed and misses a criterion"
    found, asked = run(space, lambda layout: 2.0 - 0.01 * sum(layout), 80)
    proof = certify(found, True)
    assert proof.proof == "optimal_if_monotone" and len(asked) < 15
    assert found.nearest_miss.layout == (2,) * 4


@pytest.mark.parametrize("limits", LIMITS)
def test_count_and_list_are_those_of_brute_force(limits: dict[str, object]) -> None:
    space = space_of(**limits)  # type: ignore[arg-type]
    layouts = every(space)
    assert space.size == len(layouts)
    listed = space.listed(None)
    assert listed is not None and sorted(map(tuple, listed.tolist())) == sorted(layouts)
    some = sorted(space.cost(one) for one in layouts)[len(layouts) // 2]
    listed = space.listed(some)
    assert listed is not None and {tuple(one) for one in listed.tolist()} == {
        one for one in layouts if space.cost(one) <= some
    }
    assert space.listed(None, len(layouts) - 1) is None
    centre = layouts[len(layouts) // 3]
    apart = [one for one in layouts if 1 <= sum(a != b for a, b in zip(one, centre, strict=True)) <= 2]
    assert sorted(space.neighbours(centre)) == sorted(apart)


def test_costs_are_exact_decimals() -> None:
    space = space_of(bays=1, storeys=3, costs=(0.1, 0.3), shared=(0.0, 0.0, 0.0))
    assert space.cost((1, 1, 1)) == space.cost((0, 2, 0)) == 3
    assert space.prices.value(3) == 0.3
    space = space_of(bays=2, storeys=2, costs=(1.0,), shared=(0.5, 10.0, 100.0))
    assert [space.prices.value(space.cost(one)) for one in ((1, 0, 0, 0), (1, 1, 0, 0), (1, 0, 1, 0))] == [
        111.5,
        123.0,
        213.0,
    ]


def test_search_is_the_same_again() -> None:
    space = space_of()
    assert run(space, falling(space, 3), 60)[1] == run(space, falling(space, 3), 60)[1]
