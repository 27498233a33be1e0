"""Steel as lists: sections with number, lengths and weight, and doubler plates; those of plane frames by variant."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.codes.ec3.section import DENSITY, SteelSection
from edesign.frame.panel_zones import panels_of
from edesign.frame.sections.own_section import section_of
from edesign.frame.sections.section_lists import family_of
from edesign.project.dampers.dampers import BraceSection, DamperRun
from edesign.project.frame.members import BeamRun, BraceRun, ColumnRun
from edesign.project.frame.sections import ElasticSection, RectangleSection
from edesign.project.notation import names
from edesign.project.project import Project
from edesign.report.drawing.frame_drawing import FrameElevation
from edesign.report.inputs.variant_frames import VariantFrames
from edesign.report.tables.cell import Quantity, Value
from edesign.report.tables.column import col, count, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.text import wrapped
from edesign.report.tables.unit import KG, MM, ONE, M, T, Unit

STEEL_LIST = TableSpec[dict[str, Value]](
    "steel_list",
    "Steel list{of}",
    (
        text("kind"),
        text("section"),
        text("steel"),
        count("number"),
        text("each [m]", "each", name="each", broken=1),
        col("length", M, form=".1f"),
        col("kg/m", Unit("kg/m"), "per_metre", name="weight", silent=True),
        col("mass", T, digits=4),
        col("cost", ONE, digits=5, optional=True),
    ),
    notes=(
        "Lengths from node to node. Connections and stiffeners are in no list; weights are the area of the section "
        "times the density of its steel.",
    ),
    keys=3,
)
DOUBLERS = TableSpec[dict[str, Value]](
    "doubler_plates",
    "Doubler plates of web panels{of}",
    (
        text("column"),
        col("thickness", MM, digits=3),
        col("width", MM, digits=3),
        col("height", MM, digits=3),
        count("number"),
        col("mass", KG, digits=4),
        text("at", broken=1),
    ),
    notes=(
        "Width between the fillets, height of the deepest beam at the joint. "
        "What a plate reaches beyond (EN 1993-1-8, 6.2.6.1(11)) is not in its mass.",
    ),
)
TOGETHER = "Thickness: of all plates of a panel together."
NAMED = 6  # joints with a doubler plate that are named in a row
OF_DAMPERS = "brace of dampers"
KINDS = ("column", "beam", "brace", OF_DAMPERS)
_NO_STEEL = (ElasticSection, RectangleSection)
"""Sections of which no weight follows: by their area, and stacks of rectangles, which may be of concrete."""

Pieces = dict[tuple[str, str, str], Counter[float]]
"""Number of members by length, m, of each kind, section and steel."""


@dataclass(frozen=True, order=True)
class Plate:
    """A doubler plate.

    Attributes:
        section: of its column.
        thickness, width, height: m.
        density: of its steel, kg/m3.
    """

    section: str
    thickness: float
    width: float
    height: float
    density: float

    @property
    def mass(self) -> float:
        """Its mass, kg."""
        return self.thickness * self.width * self.height * self.density


def plate_of(column: SteelSection, thickness: float, depth: float, density: float = DENSITY) -> Plate:
    """Return the doubler plate of a web panel: as wide as the web between the fillets, as high as its deepest beam.

    Args:
        column: an I section.
        thickness: of the plates of the panel together, m.
        depth: of the deepest beam, m.
        density: kg/m3.
    """
    width = column.h - 2.0 * (column.tf + column.r)
    return Plate(column.name, round(thickness, 6), round(width, 6), round(depth, 6), density)


def steel_list(
    pieces: Pieces,
    weights: Mapping[tuple[str, str], float],
    prices: Mapping[str, float | None],
    of: str = "",
    beside: str = "",
) -> Table:
    """Return the steel list of members, with the sum of all.

    Args:
        weights: of sections and steels, kg/m.
        prices: of a kilogram of each section; None: it has none.
        of: whose list it is, for the title.
        beside: what steel and work there is beside it.
    """
    rows: list[dict[str, Value]] = []
    masses, costs = 0.0, 0.0
    for (kind, section, steel), lengths in sorted(pieces.items(), key=lambda one: _order(*one[0])):
        metres = sum(length * number for length, number in lengths.items())
        per_metre, price = weights[section, steel], prices.get(section)
        mass = per_metre * metres
        masses, costs = masses + mass, costs + mass * (price or 0.0)
        rows.append(
            {
                "kind": kind,
                "section": section,
                "steel": steel,
                "number": lengths.total(),
                "each": ", ".join(f"{number} x {length:.2f}" for length, number in sorted(lengths.items())),
                "length": metres,
                "per_metre": per_metre,
                "mass": mass,
                "cost": None if price is None else mass * price,
            }
        )
    whole: dict[str, Value] = {"kind": "all", "number": sum(of.total() for of in pieces.values())}
    whole |= dict.fromkeys(("section", "steel", "each", "length", "per_metre"), "")
    whole |= {"mass": Quantity(masses, T, 4, beside=True), "cost": costs or None}
    return STEEL_LIST.of([*rows, whole] if rows else [], of=of, notes=wrapped(beside) if rows else [])


def doubler_plates(found: Mapping[Plate, Sequence[str]], of: str = "", notes: Sequence[str] = ()) -> Table:
    """Return the doubler plates, alike ones together; no rows where there are none.

    Args:
        found: the joints of each.
        of: whose plates they are, for the title.
        notes: what else is to be said of them.
    """
    rows: list[dict[str, Value]] = []
    for plate, nodes in sorted(found.items()):
        more = len(nodes) - NAMED
        rows.append(
            {
                "column": plate.section,
                "thickness": plate.thickness,
                "width": plate.width,
                "height": plate.height,
                "number": len(nodes),
                "mass": len(nodes) * plate.mass,
                "at": ", ".join(nodes[:NAMED]) + (f" and {more} more" if more > 0 else ""),
            }
        )
    return DOUBLERS.of(rows, of=of, notes=notes if rows else ())


def steel_tables(frames: VariantFrames) -> list[Table]:
    """Return steel list and doubler plates of plane frames, a table for variants that have the same; none of buildings.

    Raises:
        InputError: a section is unknown, or a panel zone has no I sections.
    """
    lists: dict[tuple[bool, str, str], tuple[Pieces, list[str]]] = {}
    plates: dict[str, tuple[dict[Plate, list[str]], list[str]]] = {}
    weights: dict[tuple[str, str], float] = {}
    for variant in frames.variants:
        project = frames.project(variant)
        if not isinstance(project, Project):
            return []  # the report of a design has them
        every, without = _pieces(project)
        weights |= {(section, steel): section_of(project, section).A * DENSITY for _, section, steel in every}
        for dampers in (False, True):  # apart, as variants mostly have one frame and several kinds of dampers
            pieces = {key: lengths for key, lengths in every.items() if (key[0] == OF_DAMPERS) == dampers}
            key = (dampers, _left_out(without, dampers), repr(pieces))
            lists.setdefault(key, (pieces, []))[1].append(variant)
        found = _plates(project)
        plates.setdefault(repr(found), (found, []))[1].append(variant)
    tables = []
    for dampers in (False, True):
        alike = [(note, *of) for (which, note, _), of in lists.items() if which == dampers]
        what = " of the braces of dampers" * dampers
        tables += [
            steel_list(pieces, weights, {}, f"{what}{_whose(variants, alike)}", note)
            for note, pieces, variants in alike
        ]
    tables += [
        doubler_plates(found, _whose(variants, plates.values()), (TOGETHER,)) for found, variants in plates.values()
    ]
    return [table for table in tables if table.rows]


def _whose(variants: Sequence[str], groups: Collection[object]) -> str:
    return f", {', '.join(variants)}" if len(groups) > 1 else ""


def _left_out(members: Counter[tuple[str, str]], dampers: bool) -> str:
    """Say which members are not in a list because no weight of steel follows from their section."""
    found = [
        f"{number} {kind}{'s' * (number > 1)} of `{section}`"
        for (kind, section), number in sorted(members.items())
        if (kind == OF_DAMPERS) == dampers
    ]
    if not found:
        return ""
    return f"Not in the list, as no weight of steel follows from sections by area or rectangles: {', '.join(found)}."


def _pieces(project: Project) -> tuple[Pieces, Counter[tuple[str, str]]]:
    """The members of a plane frame, from node to node, and the braces of its dampers.

    Beside them how many there are of each kind and section without a weight.
    """
    frame, found = project.frame, Pieces()
    without: Counter[tuple[str, str]] = Counter()
    members: list[tuple[str, ColumnRun | BeamRun | BraceRun, float]]
    members = [("column", run, frame.storey_heights[at[1] - 1]) for at, run in frame.column_at.items()]
    members += [("beam", run, frame.bay_widths[at[0] - 1]) for at, run in frame.beam_at.items()]
    for at, run in frame.brace_at.items():
        start, end = (np.asarray(frame.nodes[node]) for node in frame.brace_nodes(*at))
        members.append(("brace", run, float(np.hypot(*(end - start)))))
    parts = [(kind, run.section, run.material, length) for kind, run, length in members]
    for kind, section, steel, length in (*parts, *_of_dampers(project)):
        if isinstance(project.sections.get(section), _NO_STEEL):
            without[kind, section] += 1
        else:
            found.setdefault((kind, section, steel), Counter())[round(length, 3)] += 1
    return found, without


def _of_dampers(project: Project) -> Iterator[tuple[str, str, str, float]]:
    """Kind, section, steel and length of each brace that holds dampers, which is as long as the damper and it."""
    elevation = FrameElevation(project.frame)
    runs = project.dampers.devices if project.dampers is not None else ()
    for run in runs:
        if not isinstance(run, DamperRun) or not isinstance(run.brace, BraceSection):
            continue
        storeys = list(run.storeys.numbers(1, project.frame.n_storeys))
        for place in project.frame.bay_places(run):
            sections = run.brace.sections
            section = sections[storeys.index(place.storey)] if len(sections) > 1 else sections[0]
            for name in project.frame.damper_names(run.kind, place):
                drawing = elevation.damper(name)
                for start, end in drawing.braces if drawing is not None else ():
                    length = float(np.hypot(end[0] - start[0], end[1] - start[1]))
                    yield OF_DAMPERS, section, run.brace.material, length


def _plates(project: Project) -> dict[Plate, list[str]]:
    """The doubler plates that the panel zones of a plane frame have, with their joints."""
    frame, thickness = project.frame, dict[tuple[str, int], float]()
    for zones in project.panel_zones:
        for place in frame.node_places(zones.lines, zones.floors):
            thickness[place] = zones.doubler or 0.0
    panels, found = panels_of(project), dict[Plate, list[str]]()
    for (line, floor), plate in thickness.items():
        node = names.node_name(line, floor)
        if plate and node in panels:
            run = frame.column_at.get((line, floor)) or frame.column_at[line, floor + 1]
            column = section_of(project, run.section)
            found.setdefault(plate_of(column, plate, panels[node].height), []).append(node)
    return found


def _order(kind: str, section: str, steel: str) -> tuple[int, str, list[float], str]:
    """Columns, beams, braces; families by name, and in each by size."""
    sizes = [float(size) for size in re.findall(r"\d+(?:\.\d+)?", section)]
    return (KINDS.index(kind) if kind in KINDS else len(KINDS), family_of(section), sizes, section + steel)
