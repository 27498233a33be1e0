"""Dampers and tuned masses of a plane frame on a sheet: where they act, their laws and sizes."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass, field

from edesign.project.dampers.dampers import DamperBetween, DamperRun, TunedMass
from edesign.project.frame.frame import Frame
from edesign.project.notation import names
from edesign.project.project import Project
from edesign.report.drawing.frame_drawing import damper_drawing
from edesign.report.drawing.style import TARGET
from edesign.report.model.boxes import Spot
from edesign.report.model.elevation import Elevation
from edesign.report.model.sheet import SMALLEST, Entry, Point, Sheet
from edesign.report.model.words import brace_words, chosen, device_size, law_colors, law_words, short

LONG, HIGH = 0.2, 0.085  # of the sign of a damper, inches
UNDER = 0.075  # of a damper on a chevron, below the beam
COLUMN = 0.25  # from the drawing to the sizes beside it
ROW = 0.125  # height of a line of them
TUNED = "#7b3f98"
KINDS = {
    "chevron": "on a chevron brace",
    "chevron_braces": "in place of the braces of a chevron",
    "rising": "along the diagonal, rising",
    "falling": "along the diagonal, falling",
    "storey": "horizontal, between floors",
}


@dataclass
class Drawn:
    """Legend and remarks on dampers that were drawn.

    Attributes:
        entries: of the legend.
        left_out: sizes for which there is no room, in words.
    """

    entries: list[Entry] = field(default_factory=list)
    left_out: list[str] = field(default_factory=list)


def draw_devices(
    sheet: Sheet, place: Elevation, project: Project, design: str = "", tested: Collection[str] = ()
) -> Drawn:
    """Draw the dampers of a project and its tuned masses; sizes that change over the height are for `draw_sizes`.

    Args:
        place: where metres of the frame are on the sheet.
        design: name of a design of which no sizes are known; "": they are known.
        tested: names of the dampers that stand in a laboratory.

    Returns:
        What the legend and the title say of the dampers.
    """
    found, frame, dampers = Drawn(), project.frame, project.dampers
    if dampers is None:
        return found
    colors = law_colors(project)
    for name, color in colors.items():
        runs = [_run_words(project, run, design) for run in dampers.devices if run.law == name]
        said, sign = law_words(name, dampers.laws[name]), _sign(color) if runs else None
        if len(runs) == 1:
            found.entries.append(Entry(f"{said}; {runs[0]}", sign))
        else:
            found.entries += [Entry(said), *(Entry(f"{name} {words}", sign) for words in runs)]
    for run in dampers.devices:
        for kind, name in _places(frame, run):
            at = _draw(sheet, place, kind, name, colors.get(run.law, TARGET))
            if name in tested and at is not None:
                _mark(sheet, *at)
    if tested:
        found.entries.append(Entry(f"in the laboratory: {', '.join(tested)}", lambda on, x, y: _mark(on, x + 0.14, y)))
    _tuned(sheet, place, project)
    if dampers.attachments:
        words = "tuned mass or liquid damper"
        found.entries.append(Entry(words, lambda on, x, y: _mass_sign(on, x + 0.14, y - 0.1), 0.24))
    return found


def draw_sizes(sheet: Sheet, place: Elevation, project: Project) -> list[str]:
    """Write the sizes that change over the height beside their storeys; return those for which there is no room.

    Args:
        place: where metres of the frame are on the sheet.
    """
    left_out, frame = [], project.frame
    rows: dict[int, list[tuple[str, str]]] = {}
    colors = law_colors(project)
    runs = project.dampers.devices if project.dampers is not None else ()
    for run in runs:
        if isinstance(run, DamperRun) and _changes(run):
            for index, storey in enumerate(run.storeys.numbers(1, frame.n_storeys)):
                several = sum(isinstance(one, DamperRun) and _changes(one) for one in runs) > 1
                rows.setdefault(storey, []).append((_storey_words(project, run, index, several), colors[run.law]))
    x = sheet.right + COLUMN
    for storey, texts in rows.items():
        middle = 0.5 * place.up * (frame.levels[storey - 1] + frame.levels[storey])
        for i, (text, color) in enumerate(texts):
            y = middle + ROW * (0.5 * (len(texts) - 1) - i)
            if not sheet.place([Spot(x, y, "left")], text, color=color):
                left_out.append(f"storey {storey}: {text}")
    if rows:
        sheet.text(Spot(x, place.top + 0.2, "left", "bottom"), "dampers at each place", SMALLEST)
    return left_out


def _stiffness(run: DamperRun) -> object:
    return getattr(run.brace, "stiffness", None)


def _changes(run: DamperRun) -> bool:
    return any(isinstance(value, tuple) for value in (run.layer_area, run.scale, _stiffness(run)))


def _storey_words(project: Project, run: DamperRun, index: int, several: bool) -> str:
    brace = brace_words(run, index) if isinstance(_stiffness(run), tuple) else ""
    size = ", ".join(part for part in (device_size(project, run, index), brace) if part)
    return f"{run.law}, {chosen('bay', run.bays)}: {size}" if several else size


def _run_words(project: Project, run: DamperRun | DamperBetween, design: str) -> str:
    """How and where the dampers of a run stand, and their size if it is one over the height."""
    if isinstance(run, DamperBetween):
        parts = [f"between {run.nodes[0]} and {run.nodes[1]}"]
    else:
        where = f"{chosen('bay', run.bays)}, {chosen('storey', run.storeys)}"
        parts = [f"{KINDS[run.kind]}, {where}"]
    if design:
        parts.append(f"sizes by the design {design}")
    elif isinstance(run, DamperRun) and _changes(run):
        parts.append("sizes beside the storeys")
        parts += [brace_words(run)] if run.brace != "rigid" and not isinstance(_stiffness(run), tuple) else []
    else:
        parts += [part for part in (device_size(project, run), brace_words(run)) if part]
    parts += [f"strain limit {100.0 * run.strain_limit:g} %"] if run.strain_limit is not None else []
    parts += ["carries gravity loads"] if run.carries_gravity else []
    return "; ".join(parts)


def _places(frame: Frame, run: DamperRun | DamperBetween) -> Iterator[tuple[str, str]]:
    """Kind and name of each damper of a run."""
    if isinstance(run, DamperBetween):
        yield "nodes", names.damper_between_name(*run.nodes)
        return
    for storey in run.storeys.numbers(1, frame.n_storeys):
        for bay in run.bays.numbers(1, frame.n_bays):
            for name in names.damper_names(run.kind, bay, storey):
                yield run.kind, name


# --- signs


def _mark(sheet: Sheet, x: float, y: float) -> None:
    """A ring around what stands in a laboratory."""
    sheet.dots([(x, y)], 20.0, "none", TARGET, mew=1.2, zorder=3.0)


def _draw(sheet: Sheet, place: Elevation, kind: str, name: str, color: str) -> Point | None:
    """Draw a damper with what holds it: braces to the apex of a chevron, else a line with the damper in its middle.

    Returns:
        Where the damper is; None if the frame has no such place.
    """
    drawing = damper_drawing(place.frame, name)
    if drawing is None:
        return None
    lines = [(place.at(*start), place.at(*end)) for start, end in drawing.braces]
    x, y = place.at(*drawing.at)
    if kind == "chevron":
        apex = (x, y - UNDER - 0.5 * HIGH)
        sheet.lines([(start, apex) for start, _ in lines], color, 0.9)
        _box(sheet, (x, y - UNDER), 0.0, color)
        return x, y - UNDER
    if kind == "storey":
        sheet.lines(lines, color, 0.9)
        _box(sheet, (x, y), 0.0, color)
    else:
        sheet.lines(lines, color, 0.9)
        (start, end), *_ = lines
        _box(sheet, (x, y), math.atan2(end[1] - start[1], end[0] - start[0]), color)
    return x, y


def _box(sheet: Sheet, at: Point, turned: float, color: str) -> None:
    """A damper: a rectangle along the direction of its force."""
    c, s = math.cos(turned), math.sin(turned)
    corners = [(0.5 * LONG * a, 0.5 * HIGH * b) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    sheet.shape([(at[0] + c * u - s * v, at[1] + s * u + c * v) for u, v in corners], color, "white", 0.5, zorder=2.5)
    sheet.block(*at, LONG, LONG if turned else HIGH)


def _sign(color: str) -> Callable[[Sheet, float, float], None]:
    def draw(sheet: Sheet, x: float, y: float) -> None:
        sheet.line((x, y), (x + 0.3, y), color=color, width=0.9)
        _box(sheet, (x + 0.15, y), 0.0, color)

    return draw


def _tuned(sheet: Sheet, place: Elevation, project: Project) -> None:
    """Tuned masses and tanks above their floors, beside each other."""
    frame = place.frame
    assert project.dampers is not None
    count: dict[int, int] = {}
    for item in project.dampers.attachments:
        number = count[item.floor] = count.get(item.floor, 0) + 1
        y = place.up * frame.levels[item.floor]
        x = 0.3 + 0.9 * (number - 1)
        _mass_sign(sheet, x, y)
        if isinstance(item, TunedMass):
            text = f"{short(item.mass / 1e3)} t, {short(item.frequency)} Hz, {100.0 * item.damping:g} %"
        else:
            tank = f"{item.length:g} m × {item.width:g} m, water {item.depth:g} m, {100.0 * item.damping:g} %"
            text = f"{item.number} tank{'s' * (item.number > 1)} {tank}"
        spots: Sequence[Spot] = [Spot(x + 0.12, y + 0.15 + lift, "left") for lift in (0.0, 0.12, 0.24)]
        sheet.place(spots, text, color=TUNED)


def _mass_sign(sheet: Sheet, x: float, y: float) -> None:
    sheet.line((x - 0.05, y), (x - 0.05, y + 0.03), (x - 0.08, y + 0.05), (x - 0.02, y + 0.07), (x - 0.05, y + 0.09))
    sheet.line((x + 0.05, y), (x + 0.05, y + 0.09), color=TUNED)
    sheet.shape([(x - 0.09, y + 0.09), (x + 0.09, y + 0.09), (x + 0.09, y + 0.2), (x - 0.09, y + 0.2)], TUNED, TUNED)
    sheet.block(x, y + 0.1, 0.2, 0.2)
