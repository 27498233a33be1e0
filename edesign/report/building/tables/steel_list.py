"""The steel of a building as lists: sections with number, lengths and weight, doubler plates, and every member."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator

import numpy as np

from edesign.codes.ec3.section import DENSITY
from edesign.codes.rule_check import first_of_largest
from edesign.frame.sections.own_section import section_of
from edesign.frame.sections.section_lists import family_of
from edesign.project.building.design import DEFAULT_PRICE, PricesEach
from edesign.report.building.results import MET, NOT_MET, BuildingResults
from edesign.report.building.tables.checks import check_words, use
from edesign.report.inputs.steel_list import Pieces, Plate, doubler_plates, plate_of, steel_list
from edesign.report.tables.cell import Value
from edesign.report.tables.column import col, count, text, verdict
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import ONE, M, T
from edesign.space.structure.secondary_beams import secondary_beams

BESIDE = TableSpec[dict[str, Value]](
    "beside_the_steel_list",
    "Steel and work beside the steel list",
    (
        text("what"),
        text("section"),
        text("steel"),
        count("number"),
        text("each [m]", "each", name="each"),
        col("mass", T, digits=4),
        col("cost", ONE, digits=5, optional=True),
    ),
    notes=("Secondary beams with a section; splices where the section of a column changes; doubler plates of panels.",),
    keys=3,
)
EVERY_MEMBER = TableSpec[dict[str, Value]](
    "every_member",
    "All members: largest use of each, and the check that governs it",
    (
        text("member"),
        text("group"),
        text("kind"),
        text("section"),
        col("length", M, digits=4),
        col("use", ONE, digits=3),
        verdict("verdict"),
        text("check", broken=1),
        count("combination"),
        col("x / L", ONE, "x", form=".3g"),
    ),
    notes=("use: effect over resistance; combination: its number in the table of combinations; x / L: along it",),
)
_ENDS = ("start_node", "end_node", "start", "end")


def steel_list_table(results: BuildingResults) -> Table:
    """Return the sections of each kind of member with number, lengths, weight, and cost where the file has prices."""
    names = ("kind", "section", "material", "length")
    pieces: Pieces = {}
    for kind, section, steel, length in zip(*(results.values("members", name) for name in names), strict=True):
        pieces.setdefault((str(kind), str(section), str(steel)), Counter())[round(float(length), 3)] += 1
    density = _densities(results)
    weights = {(section, steel): results.section(section).A * density[steel] for _, section, steel in pieces}
    prices = {section: _price(results, section) for section, _ in weights}
    return steel_list(pieces, weights, prices, beside=_beside_in_words(results))


def beside_table(results: BuildingResults) -> Table:
    """Return what the steel list has not: secondary beams, splices of columns and doubler plates, with their cost."""
    return BESIDE.of(_beside(results))


def _beside_in_words(results: BuildingResults) -> str:
    """What there is beside the list, with mass and cost."""
    found: dict[str, list[float]] = {}
    for row in _beside(results):
        of = found.setdefault(str(row["what"]), [0.0, 0.0, 0.0])
        for i, name in enumerate(("number", "mass", "cost")):
            of[i] += float(str(row[name] or 0.0))
    texts = [
        f"{number:.0f} {what}" + (f", {mass / T.si:.4g} t" if mass else "") + (f", cost {cost:.0f}" if cost else "")
        for what, (number, mass, cost) in found.items()
    ]
    return f"Beside it: {'; '.join(texts)}." if texts else ""


def _beside(results: BuildingResults) -> list[dict[str, Value]]:
    """Rows of secondary beams, of splices of columns, and of doubler plates."""
    building, density = results.building, _densities(results)
    if building is None:
        return []
    alike: dict[tuple[str, str, float], int] = {}
    for beam in secondary_beams(building):
        key = beam.section, beam.material, beam.length
        alike[key] = alike.get(key, 0) + beam.number
    rows: list[dict[str, Value]] = []
    for (section, steel, length), number in alike.items():
        mass = section_of(building, section).A * density.get(steel, DENSITY) * length * number
        row: dict[str, Value] = {"what": "secondary beams", "section": section, "steel": steel, "number": number}
        price = _price(results, section)
        rows.append(row | {"each": f"{length:.2f}", "mass": mass, "cost": None if price is None else mass * price})
    each = building.design.select.prices_each if building.design is not None else PricesEach()
    plates = sum(plate.mass * len(nodes) for plate, nodes in _plates(results).items())
    work = (
        ("splices of columns", _splices(results), None, each.splice),
        ("doubler plates", sum(1 for _ in _doublers(results)), plates, each.doubler),
    )
    for what, number, steel_of, price in work:
        if number:
            row = {"what": what, "section": "", "steel": "", "number": number, "each": "", "mass": steel_of}
            rows.append(row | {"cost": None if price is None else number * price})
    return rows


def _splices(results: BuildingResults) -> int:
    """How many columns have another section than the column below them."""
    of = [results.values("members", name) for name in ("kind", "section", "start_node", "end_node")]
    columns = [tuple(map(str, one[1:])) for one in zip(*of, strict=True) if one[0] == "column"]
    below = {end: section for section, _, end in columns}
    return sum(below.get(start, section) != section for section, start, _ in columns)


def doublers_table(results: BuildingResults) -> Table:
    """Return the doubler plates that the web panels need, alike ones together; no rows where none is needed."""
    return doubler_plates(_plates(results), notes=("One plate a panel (EN 1998-1, 6.6.3(6)).",))


def _plates(results: BuildingResults) -> dict[Plate, list[str]]:
    """The doubler plates that the web panels need, with their joints."""
    found: dict[Plate, list[str]] = {}
    density = _densities(results)
    for node, section, steel, thickness, height in _doublers(results):
        found.setdefault(plate_of(results.section(section), thickness, height, density[steel]), []).append(node)
    return found


def every_member_table(results: BuildingResults) -> Table:
    """Return every member with the check that uses it most."""
    rows: list[dict[str, Value]] = []
    checks = [str(name) for name in results.values("members", "check")]
    for member in results.rows("members", "member"):
        ratios = np.asarray(member["utilisation"])
        governs = first_of_largest(np.nan_to_num(ratios, nan=-1.0, posinf=np.inf))
        applies, ratio = bool(member["combination"][governs]), float(ratios[governs])
        row: dict[str, Value] = {name: member[name] for name in ("member", "group", "kind", "section", "length")}
        row |= {"use": use(ratio) if applies else None, "check": check_words(checks[governs]) if applies else "none"}
        row["verdict"] = (MET if ratio <= 1.0 else NOT_MET) if applies else None
        row["combination"] = int(member["combination"][governs]) if applies else None
        row["x"] = float(member["station"][governs]) if applies and not math.isnan(ratio) else None
        rows.append(row)
    return EVERY_MEMBER.of(rows)


def _densities(results: BuildingResults) -> dict[str, float]:
    """The density of each steel, kg/m3."""
    return {
        str(name): float(density)
        for name, density in zip(*(results.values("materials", of) for of in ("material", "density")), strict=True)
    }


def _price(results: BuildingResults, section: str) -> float | None:
    """The price of a kilogram of a section; None where the file has none."""
    design = results.building.design if results.building is not None else None
    if design is None:
        return None
    prices = {name.upper(): price for name, price in design.select.prices.items()}
    return prices.get(family_of(section), prices.get(DEFAULT_PRICE.upper()))


def _doublers(results: BuildingResults) -> Iterator[tuple[str, str, str, float, float]]:
    """Joint, section and steel of its column, thickness of the plate and depth of the deepest beam, m."""
    if not results.has("panels"):
        return
    columns: dict[str, tuple[str, str]] = {}
    beams: dict[tuple[str, str], float] = {}
    members = (results.values("members", of) for of in ("kind", "section", "material", *_ENDS))
    for kind, section, steel, start, end, low, high in zip(*members, strict=True):
        if kind == "column":
            columns[str(end)] = str(section), str(steel)  # below the joint
        elif kind == "beam":
            axis = "x" if abs(high[0] - low[0]) > abs(high[1] - low[1]) else "y"
            depth = results.section(str(section)).h
            for node in (str(start), str(end)):
                beams[node, axis] = max(depth, beams.get((node, axis), 0.0))
    panels = (results.values("panels", of) for of in ("node", "axis", "doubler"))
    for node, axis, thickness in zip(*panels, strict=True):
        place = str(node), str(axis)
        if thickness > 0.0 and place[0] in columns and place in beams:
            yield place[0], *columns[place[0]], float(thickness), beams[place]
