"""Ends of members of a plane frame as the text of a project file: rigid ends, hinges, joints and panel zones."""

from __future__ import annotations

from functools import partial

from edesign.project.building.building import Building
from edesign.project.building.hinges import BuildingHinges, BuildingJoints, BuildingPanelZones
from edesign.project.reading.yaml_edit import yaml_text
from edesign.space.extract.frame_row import FrameRow
from edesign.space.extract.plane_frame import PlaneFrame
from edesign.space.extract.selections import runs, value


def ends_text(row: FrameRow) -> list[str]:
    """Return the blocks `elements`, `hinges`, `joints` and `panel_zones` of frames, as far as the building has them.

    Hinges and joints of columns turn about their strong axis, so that only columns have them that bend about it.

    Args:
        row: one frame of a building, or all of a direction.
    """
    blocks = {
        "": _rigid_ends(row),
        "hinges:": _springs(row, "hinges"),
        "joints:": [*_springs(row, "joints"), *_soft_ends(row)],
        "panel_zones:": _panel_zones(row),
    }
    return [line for name, block in blocks.items() if block for line in (*[name] * bool(name), *block, "")]


def _rigid_ends(row: FrameRow) -> list[str]:
    asked = row.building.elements.rigid_ends
    ends = {key: of for key, of in (("columns", asked.columns), ("beams", asked.beams)) if of.value}
    texts = [
        f"{key}: {value(of.value, '').strip() if of.is_share else value(of.value, 'm')}" for key, of in ends.items()
    ]
    return [f"elements: {{rigid_ends: {{{', '.join(texts)}}}}}"] if ends else []


def _springs(row: FrameRow, key: str) -> list[str]:
    building: Building = row.building
    found = []
    for i, run in enumerate(getattr(building, key)):
        found += _entries(row, run, _more(building, key, i, "beams", "columns"))
    return found


def _more(building: Building, key: str, i: int, *places: str) -> str:
    """What an entry says beside the places."""
    written = building.root.child(key)
    assert written is not None and written.items is not None
    said = written.items[i].plain()
    return yaml_text({name: what for name, what in said.items() if name not in places}).strip()[1:-1]


def _entries(row: FrameRow, run: BuildingHinges | BuildingJoints, more: str) -> list[str]:
    layout = row.building.layout
    if run.beams is not None:
        chosen = set(layout.beam_places(run.beams))
        beams = row.merged(lambda frame: {(p.bay, p.floor): True for p in frame.beams if p in chosen})
        places = runs(beams, range(1, len(row.widths) + 1), row.top, str)
        return [f"  - {{beams: {{bays: {at}, floors: {floors}}}, {more}}}" for at, floors, _ in places]
    assert run.columns is not None
    standing = set(layout.column_places(run.columns))
    columns = row.merged(
        lambda frame: {
            (i, storey): True
            for (i, storey), of in frame.columns.items()
            if (frame.lines[i], storey) in standing and of.strong == row.along
        }
    )
    places = runs(columns, range(row.n_lines), row.top, row.line_name)
    return [f"  - {{columns: {{lines: {at}, storeys: {storeys}}}, {more}}}" for at, storeys, _ in places]


def _panel_zones(row: FrameRow) -> list[str]:
    """Those that shear in the frames: where a column bends about its strong axis in them."""
    building = row.building
    found = []
    for number, run in enumerate(building.panel_zones):
        more = _more(building, "panel_zones", number, "at", "floors")
        for at, floors, _ in runs(row.merged(partial(_joints_in, run)), range(row.n_lines), row.top, row.line_name):
            found.append(f"  - {{lines: {at}, floors: {floors}{', ' * bool(more)}{more}}}")
    return found


def _joints_in(run: BuildingPanelZones, frame: PlaneFrame) -> dict[tuple[int, int], bool]:
    lines, floors = set(frame.building.lines_of(run.at)), run.floors.numbers(1, frame.top)
    return {
        (i, floor): True
        for (i, storey), of in frame.columns.items()
        for floor in (storey, storey - 1)
        if frame.lines[i] in lines and floor in floors and of.strong == frame.along
    }


def _soft_ends(row: FrameRow) -> list[str]:
    """Ends of beams with a stiffness are joints that stay elastic."""
    found = []
    for which in ("start", "end"):
        soft = row.merged(partial(_soft_in, which))
        for at, floors, stiffness in runs(soft, range(1, len(row.widths) + 1), row.top, str):
            of = value(stiffness / 1e6, "MN*m/rad")
            found.append(f"  - {{beams: {{bays: {at}, floors: {floors}}}, ends: {which}, stiffness: {of}}}")
    return found


def _soft_in(which: str, frame: PlaneFrame) -> dict[tuple[int, int], float]:
    ends = {(p.bay, p.floor): getattr(run.ends, which) for p, run in frame.beams.items()}
    return {place: end for place, end in ends.items() if isinstance(end, float)}
