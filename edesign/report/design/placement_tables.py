"""Tables of a placement of dampers: what stands where, the devices to order, the layouts that were analysed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.sets import HistorySet
from edesign.report.response.histories import names_of
from edesign.report.tables.table import Table, formatted, number, whole

_MOST_ROWS = 12  # of the layouts on the front, the cheapest first


def placement_tables(group: Group, sets: Sequence[HistorySet], factors: Mapping[str, float]) -> list[Table]:
    """Return the tables of a placement.

    Args:
        group: designs/NAME of an archive.
        sets: histories by variant and level.
        factors: property factors of the variants that have the design, by their names.
    """
    if "placement" not in group.variables:
        about = group.attributes
        return [Table(_title(group), notes=[f"failed: {about['reason']}"] if about.get("reason") else [])]
    return [_layout(group), _order(group), _demand(group, sets, factors), _front(group)]


def front(group: Group) -> list[int]:
    """Return the layouts on the Pareto front of cost and worst ratio, ascending by cost; they count from 0."""
    costs, demands = group.variables["layout_cost"].values, group.variables["layout_demand"].values
    found: list[int] = []
    for i in np.lexsort((demands, costs)).tolist():
        if not found or demands[i] < demands[found[-1]]:
            found.append(i)
    return found


def _title(group: Group) -> str:
    about = group.attributes
    return f"Design {about.get('name', '')}: placement, {about.get('status')}"


def _layout(group: Group) -> Table:
    """What stands in each bay of each storey, from the top down."""
    about, names = group.attributes, ["-", *names_of(group, "item")]
    bays, storeys = group.coords["bay"].values, group.coords["storey"].values
    table = Table(_title(group), ("storey", *(f"bay {bay}" for bay in bays)), left=1 + len(bays))
    at = group.variables["placement"].values
    for row in reversed(range(len(storeys))):
        table.rows.append([whole(storeys[row]), *("" if option < 0 else names[option] for option in at[row])])
    table.notes.append(
        f"cost {float(about['cost']):.6g}; dampers: {about['dampers']}; worst ratio of demand to limit "
        f"{float(about['demand']):.3f}; -: empty"
    )
    if "certificate" in about and not about.get("reason"):
        table.notes.append(f"certificate: {about['certificate']}")
    if about.get("same_cost"):
        alike = f"{about['same_cost_analysed']} of {about['same_cost']}"
        table.notes.append(f"other layouts of this cost: {alike} analysed; the least worst ratio decides among them")
    if about.get("reason"):
        table.notes.append(f"failed: {about['reason']}")
    return table


def _order(group: Group) -> Table:
    """How many of each item there are, and what they cost."""
    table = Table(
        "Devices to order", ("item", "law", "places", "dampers", "cost of one", "cost"), left=2, name="devices_to_order"
    )
    values = {key: group.variables[f"item_{key}"].values for key in ("law", "places", "number", "cost")}
    for i, name in enumerate(names_of(group, "item")):
        places, count, cost = int(values["places"][i]), int(values["number"][i]), float(values["cost"][i])
        table.rows.append([name, str(values["law"][i]), whole(places), whole(places * count), formatted(cost, ".6g")])
        table.rows[-1].append(formatted(places * count * cost, ".6g"))
    at = group.variables["placement"].values > 0
    shared = {"place": int(at.sum()), "storey": int(at.any(axis=1).sum()), "bay": int(at.any(axis=0).sum())}
    for key, count in shared.items():
        cost = float(group.attributes[f"cost_of_{key}"])
        if cost:
            table.rows.append(
                [f"each {key}", "", whole(count), "", formatted(cost, ".6g"), formatted(count * cost, ".6g")]
            )
    return table


def _demand(group: Group, sets: Sequence[HistorySet], factors: Mapping[str, float]) -> Table:
    """Largest force and stroke of one damper of each item in the histories of the variants that have the design."""
    columns = ("item", "variant, level", "of", "F mean [kN]", "F max [kN]", "stroke mean [mm]", "stroke max [mm]")
    table = Table("Devices to order: largest values of one damper", columns, left=2, name="devices_to_order")
    if "damper" not in group.coords:
        return table
    of = dict(zip(names_of(group, "damper"), group.variables["damper_item"].values.tolist(), strict=True))
    for i, name in enumerate(names_of(group, "item"), start=1):
        mine = {damper for damper, item in of.items() if item == i}
        number_of = float(group.variables["item_number"].values[i - 1])
        for found in sets:
            completed = list(found.completed.values())
            if not mine or found.variant not in factors or not completed:
                continue
            force = np.array([_largest(one, "damper_force", mine) for one in completed]) / number_of
            stroke = np.array([_largest(one, "damper_deformation", mine) for one in completed])
            cells = [number(float(x), scale=unit) for v, unit in ((force, 1e3), (stroke, 1e-3)) for x in _both(v)]
            histories = f"{len(completed)}/{len(found.histories)}"
            table.rows.append([name, f"{found.variant}, {found.level}", histories, *cells])
    return table


def _both(values: np.ndarray) -> tuple[float, float]:
    return float(values.mean()), float(values.max())


def _largest(group: Group, name: str, dampers: set[str]) -> float:
    chosen = [i for i, damper in enumerate(names_of(group, "damper")) if damper in dampers]
    return float(max(np.abs(group.variables[f"{name}_{side}"].values[chosen]).max() for side in ("max", "min")))


def _front(group: Group) -> Table:
    """The analysed layouts on the Pareto front of cost and worst ratio."""
    criteria = names_of(group, "criterion") if "criterion" in group.coords else []
    columns = ("layout", "cost", "dampers", "places", "worst ratio", "met")
    table = Table(
        "Cost against worst ratio of demand to limit: no layout analysed is as cheap and better",
        columns,
        name="cost_against_demand",
    )
    if not criteria:
        return table
    values, rows = group.variables, front(group)
    names = names_of(group, "item")
    chosen = int(str(group.attributes["chosen_layout"]))
    for i in rows[:_MOST_ROWS]:
        options = values["layout_option"].values[i]
        sizes = [names_of(group, "position")[k].count("+") + 1 for k in range(len(options))]
        parts = []
        for item, name in enumerate(names, start=1):
            count = sum(size for size, option in zip(sizes, options, strict=True) if option == item)
            parts += [f"{count} {name}"] if count else []
        mark = "*" if i + 1 == chosen else ""
        cells = [f"{i + 1}{mark}", formatted(float(values["layout_cost"].values[i]), ".6g")]
        cells += [whole(float(values["layout_dampers"].values[i])), " + ".join(parts) or "none"]
        cells += [
            formatted(float(values["layout_demand"].values[i]), ".3f"),
            "yes" if values["layout_met"].values[i] else "no",
        ]
        table.rows.append(cells)
    of = group.coords["layout"].values.size
    table.notes.append(f"layout: in the order of analysis, of {of}; *: chosen")
    if len(rows) > _MOST_ROWS:
        table.notes.append(f"{len(rows) - _MOST_ROWS} dearer ones are in the archive")
    return table
