"""The loads of a plane frame of SAP2000 as the text of a project file."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from edesign.exchange.sap2000.grid import Grid, Placed
from edesign.exchange.sap2000.model import FrameLoad, FramePoint, Row, Sap2000Model, Vector
from edesign.exchange.sap2000.read_loads import GENTLE, frame_weight
from edesign.exchange.sap2000.taken_loads import TakenLoads
from edesign.exchange.sap2000.written import number_text, quantity
from edesign.project.notation.names import line_name
from edesign.space.extract.selections import runs

_PERMANENT, _VARIABLE = 0, 1
Pair = tuple[float, float]
"""Of G and of Q."""


@dataclass
class _OnBeam:
    """Loads on a beam, downwards: uniform on each half, points, and parts, by places as shares of the beam."""

    halves: list[list[float]] = field(default_factory=lambda: [[0.0, 0.0], [0.0, 0.0]])
    points: dict[float, list[float]] = field(default_factory=lambda: defaultdict(lambda: [0.0, 0.0]))
    parts: list[tuple[float, float, int, float, float]] = field(default_factory=list)


class PlaneLoads:
    """Loads by their places in the plane.

    Args:
        model: in SI.
        grid: on which its frames stand.
        across: 0 of a frame in the plane X-Z, 1 in Y-Z.

    Raises:
        InputError: a load is of a kind that projects do not have.
    """

    def __init__(self, model: Sap2000Model, grid: Grid, taken: TakenLoads, across: int) -> None:
        self._model, self._grid, self._across = model, grid, across
        self.left_out: list[str] = []
        self._at_base = 0.0
        self._beams: dict[tuple[int, int], _OnBeam] = defaultdict(_OnBeam)
        self._columns: dict[tuple[int, int], list[float]] = defaultdict(lambda: [0.0, 0.0])
        self._nodes: dict[tuple[int, int], list[float]] = defaultdict(lambda: [0.0, 0.0])
        self._placed = {placed.frame.name: placed for placed in grid.placed}
        self.gravity = self._gravity(taken)
        self._add_all()
        if self._at_base:
            self.left_out.append(
                f"{self._at_base / 1e3:.6g} kN on joints at the base, which go to the supports at once: "
                "reactions of the project lack them"
            )

    def _gravity(self, taken: TakenLoads) -> Pair:
        """Factors of G and Q, and how much each pattern counts in them."""
        self._weights: dict[str, tuple[int, float]] = {}
        case = self._model.gravity
        if case is None:
            self.left_out.append("there is no case of the gravity loads before the modes: G counts fully, Q with 0.3")
        factors = []
        for kind, patterns, default in ((_PERMANENT, taken.permanent, 1.0), (_VARIABLE, taken.variable, 0.3)):
            own = [default if case is None else case.factors.get(name, 0.0) for name in patterns]
            alike = len(set(own)) <= 1
            factors.append(own[0] if own and alike else 1.0 if own else default)
            for name, factor in zip(patterns, own, strict=True):
                self._weights[name] = kind, 1.0 if alike else factor
            if not alike:
                self.left_out.append(f"the loads of {', '.join(patterns)} are multiplied by their factors in the case")
        return factors[0], factors[1]

    def _add_all(self) -> None:
        for load in self._model.joint_loads:
            if load.pattern in self._weights:
                kind, weight = self._weights[load.pattern]
                sideways = [value for n, value in enumerate(load.forces) if n != 2]
                if any(sideways) and weight:
                    raise self._refuse(
                        load.row,
                        f"joint {load.joint} has a horizontal force or a moment; gravity loads of projects have none"
                        " [E-SAP-25]",
                    )
                self._on_joint(load.joint, kind, -weight * load.forces[2])
        for on_part in self._model.frame_loads:
            if on_part.pattern in self._weights:
                self._distributed(on_part)
        for point in self._model.frame_points:
            if point.pattern in self._weights:
                self._point(point)
        for name, pattern in self._model.patterns.items():
            if pattern.self_weight and name in self._weights:
                kind, weight = self._weights[name]
                for frame in self._model.frames.values():
                    q = weight * pattern.self_weight * frame_weight(self._model, frame.name) / self._model.length(frame)
                    self._along(self._placed[frame.name], kind, q)

    def _refuse(self, row: Row | None, why: str) -> Exception:
        return row.error(why) if row else ValueError(why)

    def _on_joint(self, joint: str, kind: int, down: float) -> None:
        if down == 0.0:
            return
        if joint in self._grid.middles:
            start, end = (self._grid.point(end) for end in self._grid.middles[joint])
            place = min(start[self._across], end[self._across]) + 1, start[2]
            self._beams[place].points[0.5][kind] += down
        elif joint not in self._grid.points:
            raise self._model.error("joint", joint, "it has a load, and no member ends there [E-SAP-26]")
        else:
            point = self._grid.points[joint]
            if point[2] == 0:
                self._at_base += abs(down)
            else:
                self._nodes[point[self._across], point[2]][kind] += down

    def _along(self, placed: Placed, kind: int, down: float) -> None:
        """Add a uniform load downwards, N/m.

        The ends of columns and braces carry halves, which is exact for the axial forces at their ends and for all
        displacements of nodes.
        """
        if placed.kind == "beam":
            on = self._beams[placed.start[self._across] + 1, placed.start[2]]
            for half in (placed.half - 1,) if placed.half else (0, 1):
                on.halves[half][kind] += down
            return
        half_weight = 0.5 * down * self._model.length(placed.frame)
        for joint in (placed.frame.i, placed.frame.j):
            self._on_joint(joint, kind, half_weight)

    def _distributed(self, load: FrameLoad) -> None:
        placed, (kind, weight) = self._placed[load.frame], self._weights[load.pattern]
        down, right = -load.along[2] * weight, load.along[self._across] * weight
        uniform = load.start < GENTLE and load.end > 1.0 - GENTLE and load.at_start == load.at_end
        self._check_plane(load.row, load.frame, load.along)
        if down and placed.kind != "beam":
            if not uniform:
                raise self._refuse(
                    load.row,
                    f"{placed.kind} {load.frame} has a vertical load on a part of it; projects have these on beams"
                    " [E-SAP-25]",
                )
            self._along(placed, kind, down * load.at_start)
        elif down and uniform:
            self._along(placed, kind, down * load.at_start)
        elif down:
            begin, end = placed.share_of_beam(load.start), placed.share_of_beam(load.end)
            values = (load.at_start * down, load.at_end * down)
            part = (begin, end, kind, *values) if begin < end else (end, begin, kind, values[1], values[0])
            self._beams[placed.start[self._across] + 1, placed.start[2]].parts.append(part)
        if abs(right) > GENTLE:
            if placed.kind != "column" or not uniform:
                raise self._refuse(
                    load.row,
                    f"{placed.kind} {load.frame} has a horizontal load; projects have uniform ones on columns"
                    " [E-SAP-25]",
                )
            self._columns[placed.start[self._across], placed.end[2]][kind] += right * load.at_start

    def _point(self, load: FramePoint) -> None:
        placed, (kind, weight) = self._placed[load.frame], self._weights[load.pattern]
        self._check_plane(load.row, load.frame, load.along)
        if placed.kind != "beam" or abs(load.along[self._across]) > GENTLE:
            raise self._refuse(
                load.row, f"{placed.kind} {load.frame} has a force; projects have vertical ones on beams [E-SAP-25]"
            )
        down = -load.along[2] * load.force * weight
        at = placed.share_of_beam(load.at)
        place = placed.start[self._across] + 1, placed.start[2]
        if at in (0.0, 1.0):
            self._on_joint(placed.frame.i if load.at == 0.0 else placed.frame.j, kind, down)
        else:
            self._beams[place].points[at][kind] += down

    def _check_plane(self, row: Row | None, frame: str, along: Vector) -> None:
        if abs(along[1 - self._across]) > GENTLE:
            raise self._refuse(row, f"frame {frame} has a load across the plane of the frame [E-SAP-25]")

    # --- text

    def text(self, lines: Sequence[int], bays: Sequence[int], storeys: int) -> list[str]:
        """Return the block `loads` of a project file."""
        beams = {place: tuple(_beam_texts(on)) for place, on in self._beams.items()}
        columns = {place: _pair(values, "kN/m") for place, values in self._columns.items() if any(values)}
        nodes = {place: _pair(values, "kN") for place, values in self._nodes.items() if any(values)}
        text = []
        for at, floors, loads in runs(beams, bays, storeys, str):
            text += [f"    - {{bays: {at}, floors: {floors}, {load}}}" for load in loads]
        text = ["  beams:", *text] if text else []
        for key, places, along, name, where in (
            ("columns", columns, lines, line_name, "storeys"),
            ("nodes", nodes, lines, line_name, "floors"),
        ):
            found = list(runs(places, along, storeys, name))
            text += [f"  {key}:"] if found else []
            text += [f"    - {{lines: {at}, {where}: {levels}, {load}}}" for at, levels, load in found]
        G, Q = (number_text(factor) for factor in self.gravity)
        return ["loads:", *text, f"  gravity: {{G: {G}, Q: {Q}}}", ""]


def _pair(values: Sequence[float], unit: str) -> str:
    return f"G: {quantity(values[0], unit)}, Q: {quantity(values[1], unit)}"


def _beam_texts(on: _OnBeam) -> Iterator[str]:
    """The loads of a beam as entries."""
    first, second = on.halves
    if first == second:
        if any(first):
            yield _pair(first, "kN/m")
    else:
        for begin, values in ((0, first), (0.5, second)):
            if any(values):
                yield f"partial: [{{start: {begin}, end: {begin + 0.5}, {_pair(values, 'kN/m')}}}]"
    for begin, end, kind, at_begin, at_end in on.parts:
        key = "GQ"[kind]
        both = f"[{quantity(at_begin, 'kN/m')}, {quantity(at_end, 'kN/m')}]"
        yield f"partial: [{{start: {number_text(begin)}, end: {number_text(end)}, {key}: {both}}}]"
    points = [
        f"{{at: {number_text(at)}, {_pair(values, 'kN')}}}" for at, values in sorted(on.points.items()) if any(values)
    ]
    if points:
        yield f"points: [{', '.join(points)}]"
