"""Tables of a placement of dampers: what stands where, the devices to order, the layouts that were analysed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.devices import worst_of_each
from edesign.assess.sets import HistorySet
from edesign.codes.motion_sets import SetRules
from edesign.report.design.device_order import governing_notes
from edesign.report.design.storeys import heading
from edesign.report.response.histories import names_of
from edesign.report.tables.cell import Value, yes_or_no
from edesign.report.tables.column import col, count, text, verdict
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import KN, MM, ONE

Row = dict[str, Value]
_MOST_ROWS = 12  # of the layouts on the front, the cheapest first


LAYOUT = TableSpec[Row]("placement", "Design {design}", (count("storey"),), named_by_title=True)  # and each bay
DEVICES = TableSpec[Row](
    "placed_devices_to_order",
    "Devices to order",
    (
        text("item"),
        text("law"),
        count("places"),
        count("dampers", missing=""),
        col("cost of one", ONE, form=".6g"),
        col("cost", ONE, form=".6g"),
    ),
    keys=2,
    named_as="devices_to_order",
)


class _Demand(NamedTuple):
    """Largest values of one damper of an item: means over the motions, and the largest."""

    item: str
    whose: str
    of: str
    motions: int
    forces: tuple[float, float]
    strokes: tuple[float, float]


DEMAND = TableSpec[_Demand](
    "placed_devices_demand",
    "Devices to order: largest values of one damper",
    (
        text("item"),
        text("variant, level", "whose"),
        count("of"),
        col("F mean", KN, lambda row: row.forces[0]),
        col("F max", KN, lambda row: row.forces[1]),
        col("stroke mean", MM, lambda row: row.strokes[0]),
        col("stroke max", MM, lambda row: row.strokes[1]),
    ),
    keys=2,
    named_as="devices_to_order",
)
FRONT = TableSpec[Row](
    "cost_against_demand",
    "Cost against worst ratio of demand to limit: no layout analysed is as cheap and better",
    (
        text("layout"),
        col("cost", ONE, form=".6g"),
        count("dampers"),
        text("places"),
        col("worst ratio", ONE, form=".3f"),
        verdict("met"),
    ),
    notes=("layout: in the order of analysis, of {analysed}; *: chosen",),
    most=_MOST_ROWS,
    cut="{more} dearer ones are in the archive",
)


def placement_tables(
    group: Group, sets: Sequence[HistorySet], factors: Mapping[str, float], rules: SetRules
) -> list[Table]:
    """Return the tables of a placement.

    Args:
        group: designs/NAME of an archive.
        factors: property factors of the variants that have the design, by their names.
        rules: of the code in force, for statistics over motions.
    """
    if "placement" not in group.variables:
        reason = group.attributes.get("reason")
        title = f"Design {heading(group)}"
        return [Table(title, notes=[f"failed: {reason}"] if reason else [], headed=False)]
    tables = [_layout(group), DEVICES.of(_ordered(group))]
    if "damper" in group.coords:
        rows = list(_demands(group, sets, factors))
        forces = [(row.whose, row.motions, (row.forces[0], row.forces[1])) for row in rows]
        tables.append(DEMAND.of(rows, notes=governing_notes(forces, rules)))
    return [*tables, *([_front(group)] if "criterion" in group.coords else [])]


def front(group: Group) -> list[int]:
    """Return the layouts on the Pareto front of cost and worst ratio, ascending by cost; they count from 0."""
    costs, demands = group.variables["layout_cost"].values, group.variables["layout_demand"].values
    found: list[int] = []
    for i in np.lexsort((demands, costs)).tolist():
        if not found or demands[i] < demands[found[-1]]:
            found.append(i)
    return found


def _layout(group: Group) -> Table:
    """What stands in each bay of each storey, from the top down."""
    about, names = group.attributes, ["-", *names_of(group, "item")]
    bays = [f"bay {bay}" for bay in group.coords["bay"].values]
    rows: list[Row] = []
    storeys = zip(group.coords["storey"].values, group.variables["placement"].values, strict=True)
    for storey, options in reversed(list(storeys)):
        stands = ("" if option < 0 else names[option] for option in options)
        rows.append({"storey": int(storey), **dict(zip(bays, stands, strict=True))})
    notes = [
        f"cost {float(about['cost']):.6g}; dampers: {about['dampers']}; worst ratio of demand to limit "
        f"{float(about['demand']):.3f}; -: empty"
    ]
    if isinstance(beside := about.get("beside"), list):
        notes.append(f"beside the dampers of {', '.join(map(str, beside))}, which stand in the frame")
    if "braced_section" in group.variables:
        use = group.variables["braced_force"].values / group.variables["braced_resistance"].values
        sections = ", ".join(dict.fromkeys(map(str, group.variables["braced_section"].values)))
        notes.append(f"braces: {sections}; N_Ed / N_b,Rd up to {use.max():.3g} in the histories of this layout")
    if "certificate" in about and not about.get("reason"):
        notes.append(f"certificate: {about['certificate']}")
    if about.get("same_cost"):
        alike = f"{about['same_cost_analysed']} of {about['same_cost']}"
        notes.append(f"other layouts of this cost: {alike} analysed; the least worst ratio decides among them")
    if about.get("reason"):
        notes.append(f"failed: {about['reason']}")
    declared = replace(LAYOUT, keys=1 + len(bays))
    return declared.of(rows, more=[text(bay) for bay in bays], notes=notes, design=heading(group))


def _ordered(group: Group) -> Iterator[Row]:
    """How many of each item there are, and what they cost."""
    laws, places, numbers, costs = (
        group.variables[f"item_{key}"].values for key in ("law", "places", "number", "cost")
    )
    for i, name in enumerate(names_of(group, "item")):
        yield _order(name, str(laws[i]), int(places[i]), int(places[i]) * int(numbers[i]), float(costs[i]))
    stands = group.variables["placement"].values > 0
    shared = {"place": int(stands.sum()), "storey": int(stands.any(axis=1).sum()), "bay": int(stands.any(axis=0).sum())}
    for key, several in shared.items():
        if cost := float(group.attributes[f"cost_of_{key}"]):
            yield _order(f"each {key}", "", several, None, cost)


def _order(item: str, law: str, places: int, dampers: int | None, cost: float) -> Row:
    number = places if dampers is None else dampers
    row: Row = {"item": item, "law": law, "places": places, "dampers": dampers}
    return row | {"cost of one": cost, "cost": number * cost}


def _demands(group: Group, sets: Sequence[HistorySet], factors: Mapping[str, float]) -> Iterator[_Demand]:
    """Largest force and stroke of one damper of each item in the histories of the variants that have the design."""
    of = dict(zip(names_of(group, "damper"), group.variables["damper_item"].values.tolist(), strict=True))
    for i, name in enumerate(names_of(group, "item"), start=1):
        mine = {damper for damper, item in of.items() if item == i}
        number_of = float(group.variables["item_number"].values[i - 1])
        for found in sets:
            completed = list(found.completed.values())
            if not mine or found.variant not in factors or not completed:
                continue
            force, stroke = (
                worst_of_each(found, np.array([_largest(one, quantity, mine) for one in completed]))
                for quantity in ("damper_force", "damper_deformation")
            )
            yield _Demand(
                name,
                f"{found.variant}, {found.level}",
                f"{len(completed)}/{len(found.histories)}",
                len(force),
                (float(force.mean()) / number_of, float(force.max()) / number_of),
                (float(stroke.mean()), float(stroke.max())),
            )


def _largest(group: Group, name: str, dampers: set[str]) -> float:
    chosen = [i for i, damper in enumerate(names_of(group, "damper")) if damper in dampers]
    return float(max(np.abs(group.variables[f"{name}_{side}"].values[chosen]).max() for side in ("max", "min")))


def _front(group: Group) -> Table:
    """The analysed layouts on the Pareto front of cost and worst ratio."""
    rows = (_analysed(group, i) for i in front(group))
    return FRONT.of(rows, analysed=group.coords["layout"].values.size)


def _analysed(group: Group, i: int) -> Row:
    values, options = group.variables, group.variables["layout_option"].values[i]
    sizes = [position.count("+") + 1 for position in names_of(group, "position")]
    parts = []
    for item, name in enumerate(names_of(group, "item"), start=1):
        together = sum(size for size, option in zip(sizes, options, strict=True) if option == item)
        parts += [f"{together} {name}"] if together else []
    return {
        "layout": f"{i + 1}{'*' if i + 1 == int(str(group.attributes['chosen_layout'])) else ''}",
        "cost": values["layout_cost"].values[i],
        "dampers": values["layout_dampers"].values[i],
        "places": " + ".join(parts) or "none",
        "worst ratio": values["layout_demand"].values[i],
        "met": yes_or_no(bool(values["layout_met"].values[i])),
    }
