"""The loads of a SAP2000 model in three dimensions as entries of a building file."""

from __future__ import annotations

from collections import defaultdict

from edesign.exchange.sap2000.grid import Grid
from edesign.exchange.sap2000.model import FrameLoad, FramePoint, Row, Sap2000Model
from edesign.exchange.sap2000.read_loads import GENTLE
from edesign.exchange.sap2000.taken_loads import TakenLoads
from edesign.exchange.sap2000.written import number_text, quantity
from edesign.project.building.names import BeamPlace, ColumnLine
from edesign.project.notation.axes import PLAIN_AXES

_G = ""
"""The category of permanent loads."""


class SpaceLoads:
    """Loads by their places in the building, downwards.

    Args:
        model: in SI.
        grid: on which its frames stand.

    Raises:
        InputError: a load is of a kind that buildings do not have.
    """

    def __init__(self, model: Sap2000Model, grid: Grid, taken: TakenLoads) -> None:
        self._model, self._grid = model, grid
        self.left_out: list[str] = []
        self._kinds = dict.fromkeys(taken.permanent, _G) | taken.category
        self._placed = {placed.frame.name: placed for placed in grid.placed}
        self._uniform: dict[BeamPlace, dict[str, list[float]]] = defaultdict(lambda: defaultdict(lambda: [0.0, 0.0]))
        self._points: dict[BeamPlace, dict[tuple[str, float], float]] = defaultdict(lambda: defaultdict(float))
        self._nodes: dict[tuple[ColumnLine, int], dict[str, float]] = defaultdict(lambda: defaultdict(float))
        self._at_base = 0.0
        self.self_weight = self._has_self_weight(taken)
        for name, category in taken.category.items():
            if name != f"Q_{category}":
                self.left_out.append(f"load pattern {name} is taken as category {category} of EN 1991-1-1: check it")
        for load in model.joint_loads:
            if load.pattern in self._kinds:
                if any(value for n, value in enumerate(load.forces) if n != 2):
                    raise self._refuse(
                        load.row,
                        f"joint {load.joint} has a horizontal force or a moment; buildings have vertical loads"
                        " [E-SAP-25]",
                    )
                self._on_joint(load.joint, self._kinds[load.pattern], -load.forces[2])
        for on_part in model.frame_loads:
            if on_part.pattern in self._kinds:
                self._distributed(on_part)
        for point in model.frame_points:
            if point.pattern in self._kinds:
                self._point(point)
        if self._at_base:
            self.left_out.append(
                f"{self._at_base / 1e3:.6g} kN on joints at the base, which go to the supports at once"
            )

    def _has_self_weight(self, taken: TakenLoads) -> bool:
        own = {name: pattern for name, pattern in self._model.patterns.items() if pattern.self_weight}
        own = {name: pattern for name, pattern in own.items() if name in self._kinds}
        multiple = sum(pattern.self_weight for pattern in own.values())
        if own and (multiple != 1.0 or not set(own) <= set(taken.permanent)):
            row = next(iter(own.values())).row
            raise self._refuse(
                row,
                f"the self weight counts {multiple:g} times, or in a pattern of variable loads; it belongs once to G"
                " [E-SAP-25]",
            )
        return bool(own)

    def _refuse(self, row: Row | None, why: str) -> Exception:
        return row.error(why) if row else ValueError(why)

    def _on_joint(self, joint: str, kind: str, down: float) -> None:
        if down == 0.0:
            return
        if joint in self._grid.middles:
            start, end = (self._grid.point(end) for end in self._grid.middles[joint])
            self._points[beam_place(start, end)][kind, 0.5] += down
        elif joint not in self._grid.points:
            raise self._model.error("joint", joint, "it has a load, and no member ends there [E-SAP-26]")
        else:
            i, j, floor = self._grid.points[joint]
            if floor == 0:
                self._at_base += abs(down)
            else:
                self._nodes[ColumnLine(i, j, PLAIN_AXES), floor][kind] += down

    def _distributed(self, load: FrameLoad) -> None:
        placed, kind = self._placed[load.frame], self._kinds[load.pattern]
        uniform = load.start < GENTLE and load.end > 1.0 - GENTLE and load.at_start == load.at_end
        if max(abs(load.along[0]), abs(load.along[1])) > GENTLE or not uniform:
            raise self._refuse(
                load.row,
                f"{placed.kind} {load.frame} has a load that is not vertical and uniform, as those of buildings are"
                " [E-SAP-25]",
            )
        down = -load.along[2] * load.at_start
        if placed.kind == "beam":
            on = self._uniform[beam_place(placed.start, placed.end)][kind]
            for half in (placed.half - 1,) if placed.half else (0, 1):
                on[half] += down
            return
        half_load = 0.5 * down * self._model.length(placed.frame)
        for joint in (placed.frame.i, placed.frame.j):
            self._on_joint(joint, kind, half_load)

    def _point(self, load: FramePoint) -> None:
        placed, kind = self._placed[load.frame], self._kinds[load.pattern]
        if placed.kind != "beam" or max(abs(load.along[0]), abs(load.along[1])) > GENTLE:
            raise self._refuse(
                load.row, f"{placed.kind} {load.frame} has a force; buildings have vertical ones on beams [E-SAP-25]"
            )
        down, share = -load.along[2] * load.force, placed.share_of_beam(load.at)
        if share in (0.0, 1.0):
            self._on_joint(placed.frame.i if load.at == 0.0 else placed.frame.j, kind, down)
        else:
            self._points[beam_place(placed.start, placed.end)][kind, round(share, 12)] += down

    def beam_texts(self) -> dict[BeamPlace, tuple[str, ...]]:
        """Return the loads of each beam as entries.

        Raises:
            InputError: the halves of a beam that braces meet have different loads.
        """
        found: dict[BeamPlace, list[str]] = defaultdict(list)
        for place, kinds in self._uniform.items():
            for kind, (first, second) in kinds.items():
                if abs(first - second) > GENTLE * max(abs(first), abs(second)):
                    raise self._refuse_place(place)
                if first:
                    found[place].append(_entry(kind, first, "kN/m"))
        for place, points in self._points.items():
            of_kind: dict[tuple[str, str], list[float]] = defaultdict(list)
            for (kind, at), force in points.items():
                if force:
                    of_kind[kind, quantity(force, "kN")].append(at)
            for (kind, text), places in of_kind.items():
                listed = ", ".join(map(number_text, sorted(places)))
                key, category = ("G", "") if kind == _G else ("Q", f", category: {kind}")
                found[place].append(f"points: [{{at: [{listed}], {key}: {text}}}]{category}")
        return {place: tuple(loads) for place, loads in found.items()}

    def _refuse_place(self, place: BeamPlace) -> Exception:
        frame = next(p.frame for p in self._grid.placed if p.kind == "beam" and beam_place(p.start, p.end) == place)
        return self._model.error(
            "frame", frame.name, "the halves of a beam that braces meet have different loads [E-SAP-20]"
        )

    def node_texts(self) -> list[str]:
        """Return the loads on nodes as entries."""
        merged: dict[tuple[str, int], list[ColumnLine]] = defaultdict(list)
        for (line, floor), kinds in self._nodes.items():
            for kind, force in kinds.items():
                if force:
                    merged[_entry(kind, force, "kN"), floor].append(line)
        return [
            f"at: [{', '.join(map(str, sorted(lines)))}], floors: {floor}, {load}"
            for (load, floor), lines in merged.items()
        ]


def _entry(kind: str, value: float, unit: str) -> str:
    return f"G: {quantity(value, unit)}" if kind == _G else f"Q: {quantity(value, unit)}, category: {kind}"


def beam_place(start: tuple[int, int, int], end: tuple[int, int, int]) -> BeamPlace:
    """Return the place of a beam between two points of the grid."""
    low, high = min(start, end), max(start, end)
    if low[0] != high[0]:
        return BeamPlace("x", low[1], low[0] + 1, low[2], PLAIN_AXES)
    return BeamPlace("y", low[0], low[1] + 1, low[2], PLAIN_AXES)
