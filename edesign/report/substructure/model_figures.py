"""The model of substructure tests as figures: the loop, and the structure with what stands in the laboratory."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from edesign.project.substructure.rts_file import RtsFile
from edesign.project.substructure.structure import ProjectStructure, ShearBuilding
from edesign.report.drawing.style import TARGET
from edesign.report.model.boxes import Spot
from edesign.report.model.figures import Named, geometry_figure, has_loads, loads_and_masses
from edesign.report.model.sheet import INK, SMALLEST, SOFT, TEXT, Entry, Sheet, on_sheet, unwritten
from edesign.report.model.supports import SIGNS
from edesign.report.model.words import short
from edesign.report.substructure.diagram import loop_diagram
from edesign.report.substructure.file import described_tests
from edesign.report.substructure.results import SubstructureResults

STOREY, FLOOR = 0.45, 0.5  # height of a storey, and half the width of a floor, inches
MOST = 20
"""Storeys from which all are drawn lower, so that they stay on a page."""


def substructure_model_figures(file: RtsFile, heading: Sequence[str] = ()) -> Iterator[Named]:
    """Yield the loop of substructure tests and their structure.

    Args:
        file: from `load_rts_file`.
        heading: lines above each drawing but the loop; (): none.

    Yields:
        Name of the file, caption and figure.
    """
    caption = "The loop of the tests. Blue blocks are computed each main step, ochre ones stand in the laboratory."
    yield "model", caption, loop_diagram(described_tests(file), None)
    yield from structure_figures(file, heading)


def structure_figures(file: RtsFile, heading: Sequence[str] = ()) -> Iterator[Named]:
    """Give the structure of substructure tests alone; none where targets are given. Arguments as above."""
    structure = file.structure
    if isinstance(structure, ProjectStructure) and file.project is not None:
        caption = f"The structure of the tests; in the laboratory: {', '.join(structure.physical)}."
        above = (*heading, caption.rstrip(".")) if heading else ()
        yield "model_structure", caption, geometry_figure(file.project, above, structure.physical)
        if has_loads(file.project):
            yield loads_and_masses(file.project, heading)
    elif isinstance(structure, ShearBuilding):
        caption = f"The structure of the tests; the specimen stands in storey {structure.storey}."
        above = (*heading, caption.rstrip(".")) if heading else ()
        yield "model_structure", caption, on_sheet(lambda sheet: _shear_building(sheet, structure), above)


def tested_structures(results: SubstructureResults) -> Iterator[Named]:
    """Yield the structure of archived tests; none if their file cannot be read."""
    if results.described.file is not None:
        yield from structure_figures(results.described.file)


def _shear_building(sheet: Sheet, building: ShearBuilding) -> None:
    """Floors on columns, with masses and stiffnesses beside them."""
    count = len(building.masses)
    high = STOREY if count <= MOST else STOREY * MOST / count
    sheet.lines([((x, 0.0), (x, count * high)) for x in (-FLOOR, FLOOR)], INK, 1.3)
    for x in (-FLOOR, FLOOR):
        SIGNS["fixed"](sheet, x, 0.0)
    left_out = []
    for storey, (mass, stiffness) in enumerate(zip(building.masses, building.stiffnesses, strict=True), start=1):
        y = storey * high
        sheet.line((-FLOOR, y), (FLOOR, y), width=3.0)
        for spot, text in (
            (Spot(FLOOR + 0.15, y, "left"), f"{short(mass / 1e3)} t"),
            (Spot(FLOOR + 0.85, y - 0.5 * high, "left"), f"{short(stiffness / 1e6)} kN/mm"),
            (Spot(-FLOOR - 0.15, y, "right"), str(storey)),
        ):
            if not sheet.place([spot], text, (TEXT,)):
                left_out.append(f"storey {storey}: {text}")
    middle = (building.storey - 0.5) * high
    sheet.line((-FLOOR, middle - 0.4 * high), (0.0, middle), (FLOOR, middle), color=TARGET, width=1.0)
    sheet.dots([(0.0, middle)], 7.0, TARGET, TARGET, marker="s")
    top = count * high + 0.12
    heads = ((-FLOOR - 0.15, "right", "floor"), (FLOOR + 0.15, "left", "mass"), (FLOOR + 0.85, "left", "stiffness"))
    for x, ha, text in heads:
        sheet.text(Spot(x, top, ha, "bottom"), text, SMALLEST, SOFT)

    def sign(on: Sheet, x: float, y: float) -> None:
        on.dots([(x + 0.14, y)], 7.0, TARGET, TARGET, marker="s")

    sheet.legend([Entry("specimen, in the laboratory", sign), *unwritten(left_out)], 4.0)
