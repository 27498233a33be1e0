"""A placement as variables of the archive: the catalogue, all analysed layouts with their verdicts, the chosen one."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group
from edesign.project.dampers.dampers import Dampers
from edesign.project.notation.grid import BayPlace
from edesign.project.project import Project
from edesign.study.design.device_text import devices_text
from edesign.study.design.loop import RoundOutcome
from edesign.study.design.verification import store_outcomes, stored_outcomes
from edesign.study.placement.candidates import Candidates
from edesign.study.placement.certificate import Certificate
from edesign.study.placement.knowledge import Analysed, Knowledge
from edesign.study.placement.search import chosen_of
from edesign.study.placement.space import Layout
from edesign.study.results.recording import coordinate

_LARGEST_WHOLE = 2**63 - 1
_COUNTS = (
    "layouts",
    "cheaper",
    "cheaper_analysed",
    "cheaper_ruled_out",
    "nearby",
    "nearby_analysed",
    "nearby_ruled_out",
    "same_cost",
    "same_cost_analysed",
    "harmed_by_more",
)
"""What the certificate counts, attributes of the archive."""


def store_placement(
    group: Group, candidates: Candidates, knowledge: Knowledge, dampers: Dampers, proof: Certificate | None = None
) -> None:
    """Add the layouts, the chosen one and its proof to the group of a placement.

    Args:
        group: of the design.
        candidates: that it chose from.
        proof: of the chosen layout; None: the search is not over.
    """
    chosen = chosen_of(knowledge)
    _store_catalogue(group, candidates, chosen.layout)
    _store_layouts(group, candidates, knowledge)
    _store_chosen(group, candidates, chosen)
    group.attributes |= {"warnings": [], "devices": devices_text(dampers)}
    if proof is None:
        return
    counts = {key: getattr(proof, key) for key in _COUNTS}
    group.attributes |= {"proof": proof.proof, "certificate": proof.sentence}
    known = {key: value for key, value in counts.items() if value is not None}
    group.attributes |= {key: value if value <= _LARGEST_WHOLE else float(value) for key, value in known.items()}


def kept_outcomes(resume: Group | None) -> dict[Layout, RoundOutcome]:
    """Return the outcomes of the layouts that an earlier run kept; empty without one."""
    if resume is None or "criterion_unit" not in resume.variables:
        return {}
    layouts = resume.variables["layout_option"].values.tolist()
    outcomes = stored_outcomes(resume, range(1, len(layouts) + 1))
    return {tuple(layout): outcome for layout, outcome in zip(layouts, outcomes, strict=True)}


def _store_catalogue(group: Group, candidates: Candidates, chosen: Layout) -> None:
    spec, space = candidates.spec, candidates.space
    items = spec.catalogue.values()
    equipped = list(candidates.equipped(chosen).values())
    places = [equipped.count(i) for i in range(1, len(items) + 1)]
    coordinate(group, "item", list(spec.catalogue), "", "item of the catalogue")
    add = group.add
    add("item_law", ("item",), [item.law for item in items], "", "law of its dampers")
    add("item_number", ("item",), [item.number for item in items], "1", "dampers in a place")
    add("item_cost", ("item",), [item.cost for item in items], "1", "cost of one damper")
    at_place = [space.prices.value(cost) for cost in space.prices.items[1:]]
    add("item_place_cost", ("item",), at_place, "1", "cost of a place with it")
    add("item_places", ("item",), places, "1", "places of the chosen layout with it")
    group.attributes |= {f"cost_of_{key}": getattr(spec.costs, key) for key in ("place", "storey", "bay")}


def _store_layouts(group: Group, candidates: Candidates, knowledge: Knowledge) -> None:
    space, analysed = candidates.space, knowledge.analysed
    coordinate(group, "layout", [one.number for one in analysed], "1", "layout in the order of analysis")
    names = ["+".join(map(_place_name, at.places)) for at in space.positions]
    coordinate(group, "position", names, "", "places that are equipped alike, BAY.STOREY or FRAME.BAY.STOREY")
    add = group.add
    options = np.array([one.layout for one in analysed], dtype=int)
    add("layout_option", ("layout", "position"), options, "1", "number of the item of the catalogue, 0: empty")
    costs = [space.prices.value(one.cost) for one in analysed]
    add("layout_cost", ("layout",), costs, "1", "cost, in the currency of the file")
    dampers = [space.dampers(one.layout) for one in analysed]
    add("layout_dampers", ("layout",), dampers, "1", "number of dampers")
    ratios = [one.outcome.demand for one in analysed]
    add("layout_demand", ("layout",), ratios, "1", "worst ratio of demand to limit of all criteria")
    met = np.array([one.outcome.met for one in analysed], dtype=int)
    add("layout_met", ("layout",), met, "1", "1: all criteria met")
    store_outcomes(group, "layout", [one.number for one in analysed], [one.outcome for one in analysed])


def _place_name(place: BayPlace) -> str:
    named = f"{place.bay}.{place.storey}"
    return f"{place.frame}.{named}" if place.frame else named


def _store_chosen(group: Group, candidates: Candidates, chosen: Analysed) -> None:
    space, project = candidates.space, candidates.project
    bays = list(dict.fromkeys((place.frame, place.bay) for at in space.positions for place in at.places))
    if project.structure == "building":
        coordinate(group, "bay", [f"{frame}.{bay}" for frame, bay in bays], "", "bay of a plane frame, FRAME.BAY")
    else:
        bays = [("", bay) for bay in range(1, len(project.widths()) + 1)]
        there = project.frame.bays_in_building if isinstance(project, Project) else {}
        numbers = [bay for _, bay in bays]
        named = ["{}.{}".format(*there[bay]) if bay in there else str(bay) for bay in numbers]
        label = "bay of the frame, of a frame of a building FRAME.BAY"
        coordinate(group, "bay", named if there else numbers, "" if there else "1", label)
    coordinate(group, "storey", range(1, project.grid.n_storeys + 1), "1", f"storey of the {project.structure}")
    at = np.full((project.grid.n_storeys, len(bays)), -1)
    for position in space.positions:
        for place in position.places:
            at[place.storey - 1, bays.index((place.frame, place.bay))] = 0
    equipped = candidates.equipped(chosen.layout)
    for place, option in equipped.items():
        at[place.storey - 1, bays.index((place.frame, place.bay))] = option
    label = "number of the item of the catalogue, 0: empty, -1: no candidate"
    group.add("placement", ("storey", "bay"), at, "1", label)
    names = [
        (name, option)
        for place, option in equipped.items()
        for name in candidates.project.grid.damper_names(candidates.kind(option, place), place)
    ]
    if names:
        coordinate(group, "damper", [name for name, _ in names], "", "name of the damper")
        label = "number of the item of the catalogue"
        group.add("damper_item", ("damper",), [option for _, option in names], "1", label)
    group.attributes |= {
        "chosen_layout": chosen.number,
        "cost": space.prices.value(chosen.cost),
        "dampers": space.dampers(chosen.layout),
        "demand": chosen.outcome.demand,
        "histories": len(group.coords["layout"].values) * int(group.attributes["histories_of_a_layout"]),
    }
