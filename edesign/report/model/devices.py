"""Dampers and tuned masses of a plane frame or of a frame of a building on a sheet: where they act, laws and sizes."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.dampers import DamperBetween, DamperRun, Dampers, TunedLiquid, TunedMass
from edesign.project.notation import names
from edesign.project.notation.frames import frames_of_line
from edesign.report.drawing.frame_drawing import DamperDrawing
from edesign.report.drawing.style import TARGET
from edesign.report.model.boxes import Spot
from edesign.report.model.elevation import Grid
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


@dataclass(frozen=True)
class DevicesOnSheet:
    """Dampers and tuned masses of a plane frame, or those of a building that one of its frames shows.

    Attributes:
        project: with the frame or the building.
        place: where metres of the frame are on the sheet.
        drawing: gives the lines of a damper in the frame by its name; None: it does not stand there.
        frame: name of the frame of the building, such as X1; "" of a plane frame.
    """

    project: AnalysisFile
    place: Grid
    drawing: Callable[[str], DamperDrawing | None]
    frame: str = ""

    @property
    def _dampers(self) -> Dampers:
        dampers = self.project.dampers
        return dampers if dampers is not None else Dampers.model_construct()

    def _drawings(self, run: DamperRun | DamperBetween) -> Iterator[tuple[str, DamperDrawing]]:
        """Name and lines of each damper of a run that stands in the frame."""
        if isinstance(run, DamperBetween):
            found = [names.damper_between_name(*run.nodes)]
        else:
            places = self.project.grid.bay_places(run)
            found = [name for at in places for name in self.project.grid.damper_names(run.kind, at)]
        for name in found:
            drawing = self.drawing(name)
            if drawing is not None:
                yield name, drawing

    @cached_property
    def _runs(self) -> list[DamperRun | DamperBetween]:
        """The runs with a damper in the frame."""
        return [run for run in self._dampers.devices if any(self._drawings(run))]

    @property
    def _attachments(self) -> list[TunedMass | TunedLiquid]:
        """The tuned masses and tanks that move along the frame and stand in it, or at the centre of mass."""
        along = [one for one in self._dampers.attachments if one.direction in (None, self.frame[:1].lower())]
        return [one for one in along if one.at is None or self.frame in frames_of_line(one.at)]

    @property
    def look(self) -> tuple[object, ...]:
        """What distinguishes it from others: where dampers of each run stand, and tuned masses."""
        runs = enumerate(self._dampers.devices)
        places = ((i, drawing) for i, run in runs for _, drawing in self._drawings(run))
        return (*places, *map(repr, self._attachments))

    def draw(self, sheet: Sheet, design: str = "", tested: Collection[str] = ()) -> list[Entry]:
        """Draw dampers and tuned masses; sizes that change over the height are for `draw_sizes`.

        Args:
            design: name of a design of which no sizes are known; "": they are known.
            tested: names of the dampers that stand in a laboratory.

        Returns:
            Of the legend.
        """
        found: list[Entry] = []
        colors = law_colors(self.project)
        for name, color in colors.items():
            runs = [_run_words(self.project, run, design) for run in self._runs if run.law == name]
            if not runs and self.frame:
                continue
            said, sign = law_words(name, self._dampers.laws[name]), _sign(color) if runs else None
            if len(runs) == 1:
                found.append(Entry(f"{said}; {runs[0]}", sign))
            else:
                found += [Entry(said), *(Entry(f"{name} {words}", sign) for words in runs)]
        for run in self._runs:
            for name, drawing in self._drawings(run):
                at = _draw(sheet, self.place, run.kind, drawing, colors.get(run.law, TARGET))
                if name in tested:
                    _mark(sheet, *at)
        if tested:
            words = f"in the laboratory: {', '.join(tested)}"
            found.append(Entry(words, lambda on, x, y: _mark(on, x + 0.14, y)))
        _tuned(sheet, self.place, self._attachments)
        if self._attachments:
            words = "tuned mass or liquid damper"
            found.append(Entry(words, lambda on, x, y: _mass_sign(on, x + 0.14, y - 0.1), 0.24))
        return found

    def draw_sizes(self, sheet: Sheet) -> list[str]:
        """Write the sizes that change over the height beside their storeys; return those for which there is no room."""
        left_out, levels = [], self.place.ys
        rows: dict[int, list[tuple[str, str]]] = {}
        colors = law_colors(self.project)
        changing = [run for run in self._runs if isinstance(run, DamperRun) and _changes(run)]
        for run in changing:
            for index, storey in enumerate(run.storeys.numbers(1, len(levels) - 1)):
                text = _storey_words(self.project, run, index, len(changing) > 1)
                rows.setdefault(storey, []).append((text, colors[run.law]))
        x = sheet.right + COLUMN
        for storey, texts in rows.items():
            middle = 0.5 * self.place.up * (levels[storey - 1] + levels[storey])
            for i, (text, color) in enumerate(texts):
                y = middle + ROW * (0.5 * (len(texts) - 1) - i)
                if not sheet.place([Spot(x, y, "left")], text, color=color):
                    left_out.append(f"storey {storey}: {text}")
        if rows:
            sheet.text(Spot(x, self.place.top + 0.2, "left", "bottom"), "dampers at each place", SMALLEST)
        return left_out


def _stiffness(run: DamperRun) -> object:
    """What changes with the storeys of braces: their stiffness or section."""
    return getattr(run.brace, "stiffness", getattr(run.brace, "section", None))


def _changes(run: DamperRun) -> bool:
    return any(isinstance(value, tuple) for value in (run.layer_area, run.scale, _stiffness(run)))


def _storey_words(project: AnalysisFile, run: DamperRun, index: int, several: bool) -> str:
    brace = brace_words(run, index) if isinstance(_stiffness(run), tuple) else ""
    size = ", ".join(part for part in (device_size(project, run, index), brace) if part)
    return f"{run.law}, {chosen('bay', run.bays)}: {size}" if several else size


def _run_words(project: AnalysisFile, run: DamperRun | DamperBetween, design: str) -> str:
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


# --- signs


def _mark(sheet: Sheet, x: float, y: float) -> None:
    """A ring around what stands in a laboratory."""
    sheet.dots([(x, y)], 20.0, "none", TARGET, mew=1.2, zorder=3.0)


def _draw(sheet: Sheet, place: Grid, kind: str, drawing: DamperDrawing, color: str) -> Point:
    """Draw a damper with what holds it: braces to the apex of a chevron, else a line with the damper in its middle.

    Returns:
        Where the damper is.
    """
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


def _tuned(sheet: Sheet, place: Grid, attachments: Sequence[TunedMass | TunedLiquid]) -> None:
    """Tuned masses and tanks above their floors, beside each other."""
    count: dict[int, int] = {}
    for item in attachments:
        number = count[item.floor] = count.get(item.floor, 0) + 1
        y = place.up * place.ys[item.floor]
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
