"""The placement of dampers against all layouts of small frames by brute force, and against a sequential search.

Histories of the brute force are run here one layout at a time, with devices, costs and drifts of the test's own; the
search is given the same histories, so that any difference is of the search.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest
from design_examples import design
from placement_examples import RECORDS, EveryLayout, Item, sequential_search, small_project

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.assess.verdicts import judge
from edesign.project.criteria.criteria import MeasureCriterion
from edesign.project.dampers.dampers import Dampers
from edesign.project.dampers.placement import PlacementDesign
from edesign.project.notation.grid import BayPlace
from edesign.study.design.design import DesignResult
from edesign.study.placement.placement import RespondInTurn, run_placement

PLACE_COST = 0.5
FRAMES: dict[str, tuple[str, str, tuple[Item, ...]]] = {
    "viscous": ("[6 m]", "[4 m, 3.3 m, 3.3 m]", (Item("oil", 1.0, scale=40.0), Item("oil", 1.6, scale=80.0))),
    "linear": ("[6 m, 5 m]", "[4 m, 3.3 m, 3.3 m]", (Item("linear", 1.0, scale=150.0),)),
    "elastomer": (
        "[6 m]",
        "[4 m, 3.3 m, 3.3 m]",
        (Item("rubber", 1.0, layer_area=0.08), Item("rubber", 1.9, layer_area=0.2)),
    ),
    "friction": ("[6 m]", "[4 m, 3.3 m, 3.3 m]", (Item("slip", 1.0, scale=80.0), Item("slip", 1.4, scale=200.0))),
}


def places_of(every: EveryLayout) -> list[BayPlace]:
    """All bays and storeys."""
    bays, storeys = len(every.project.widths()), every.project.grid.n_storeys
    return [BayPlace("", *at) for at in itertools.product(range(1, bays + 1), range(1, storeys + 1))]


def placed(
    every: EveryLayout,
    limit: float,
    budget: int,
    respond: RespondInTurn | None = None,
    resume: Group | None = None,
    keep: Callable[[Group], None] = lambda group: None,
) -> DesignResult:
    """The search with the histories of `every`, or others."""
    catalogue = ", ".join(f"i{i}: {item.text}" for i, item in enumerate(every.items, start=1))
    verify = f"records: [{', '.join(RECORDS)}], levels: DBE, criteria: drift, budget: {budget * len(RECORDS)}"
    text = (
        f"method: placement, kind: {every.kind}, bays: all, catalogue: {{{catalogue}}}, "
        f"costs: {{place: {PLACE_COST}}}, verify: {{{verify}}}"
    )
    spec = design(text, every.project)
    assert isinstance(spec, PlacementDesign)
    criterion = MeasureCriterion(name="drift", measure="interstorey_drift", most=limit, statistic="mean")

    def verdicts(histories: dict[str, Group]) -> object:
        return judge((criterion,), (), histories, every.project)

    asked = every.respond if respond is None else respond
    return run_placement(
        every.project,
        "tried",
        spec,
        len(RECORDS),
        asked,
        verdicts,  # type: ignore[arg-type]
        resume,
        keep=keep,
    )


@pytest.fixture(scope="module", params=list(FRAMES))
def every(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> EveryLayout:
    bays, storeys, items = FRAMES[request.param]
    return EveryLayout(small_project(tmp_path_factory.mktemp(request.param), bays, storeys), items)


def test_least_cost_is_that_of_brute_force(every: EveryLayout) -> None:
    """For limits all over the range of the drifts; with half the budget the certificate claims what is true."""
    places = places_of(every)
    table = {layout: (every.cost(layout, PLACE_COST), every.drift(layout)) for layout in every.layouts(places)}
    drifts = np.sort([drift for _, drift in table.values()])
    for share in (0.02, 0.2, 0.6):
        limit = float(drifts[int(share * len(drifts))]) * (1.0 + 1e-9)
        cost, drift = min(pair for pair in table.values() if pair[1] <= limit)
        result = placed(every, limit, len(table))
        about = result.group.attributes
        assert result.status == "completed" and about["proof"] == "optimal"
        assert table[every.equipped(result.dampers)] == (about["cost"], pytest.approx(drift, rel=1e-12))
        assert about["cost"] == cost and about["demand"] == pytest.approx(drift / limit, rel=1e-9)
        assert about["layouts"] == len(table) and about["histories"] <= len(RECORDS) * len(table)
        assert about["cheaper"] == sum(one < cost for one, _ in table.values())
        quick = placed(every, limit, len(table) // 2).group.attributes
        if quick["proof"] == "optimal":
            assert quick["cost"] == cost
    nothing = placed(every, 0.9 * float(drifts[0]), len(table))
    assert nothing.status == "failed" and f"each layout ({len(table)}) was analysed" in nothing.reason


def test_never_dearer_than_a_sequential_search(every: EveryLayout) -> None:
    """SSSA puts equal dampers one by one where the drift is largest; with each size of the catalogue."""
    places = places_of(every)
    for option in range(1, len(every.items) + 1):
        full = tuple((place, option) for place in places)
        limit = 0.5 * (every.drift(()) + every.drift(full))
        equipped = sequential_search(every, places, option, limit)
        found = placed(every, limit, 60).group.attributes
        if equipped is not None:
            assert found["status"] == "completed" and found["cost"] <= every.cost(equipped, PLACE_COST)


@dataclass
class Stopped:
    """Histories of layouts up to one, at which the user stops the run."""

    every: EveryLayout
    stop_at: int | None = None
    asked: list[int] = field(default_factory=list)

    def respond(self, wanted: Sequence[tuple[int, Dampers]]) -> Iterator[Mapping[str, Group]]:
        for number, dampers in wanted:
            if number == self.stop_at:
                raise KeyboardInterrupt
            self.asked.append(number)
            yield from self.every.respond([(number, dampers)])


def test_interrupted_search_goes_on_to_the_same_last_bit(every: EveryLayout, tmp_path: Path) -> None:
    limit = 0.7 * every.drift(())
    whole = placed(every, limit, 20)
    done = whole.group.coords["layout"].values.size // 2
    assert done > 1
    kept: list[Group] = []
    with pytest.raises(KeyboardInterrupt):
        placed(every, limit, 20, Stopped(every, done + 1).respond, keep=kept.append)
    assert kept[-1].coords["layout"].values.tolist() == list(range(1, done + 1))
    assert kept[-1].attributes["status"] == "interrupted" and "certificate" not in kept[-1].attributes
    with ArchiveWriter(tmp_path / "a.h5", Group()) as writer:
        writer.write("designs/tried", kept[-1])
        path = writer.finish({"status": "interrupted"})
    with open_archive(path) as archive:
        read = archive.group("designs/tried")
    again = Stopped(every)
    resumed = placed(every, limit, 20, again.respond, read)
    assert again.asked == whole.group.coords["layout"].values.tolist()[done:]
    assert resumed.group.attributes == whole.group.attributes and resumed.dampers == whole.dampers
    for name, variable in whole.group.variables.items():
        assert variable.values.tobytes() == resumed.group.variables[name].values.tobytes(), name
