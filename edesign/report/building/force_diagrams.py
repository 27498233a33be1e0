"""Diagrams of axial force, shear and moment of the plane frames of a building, under the combination that governs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from edesign.archive.reader import Archive
from edesign.codes.rule_check import first_of_largest
from edesign.report.building.check_table import check_words
from edesign.report.building.checks import forces_along, governing
from edesign.report.building.elevations import different_frames, frames_of, grid_lines, largest_use
from edesign.report.building.results import BuildingResults
from edesign.report.drawing.captions import plain
from edesign.report.drawing.style import AFTER, VARIANTS
from edesign.report.model.boxes import Spot
from edesign.report.model.elevation import Grid, draw_axes
from edesign.report.model.figures import Named
from edesign.report.model.sheet import FAINT, INK, SMALLEST, Sheet, on_sheet

HIGHEST = 0.36  # ordinate of the largest value, of the smaller one of a bay and a storey
UNSEEN = 0.02  # of the largest value, below which none is written
BAND, STEADY = "#cfdcec", VARIANTS[1]


@dataclass(frozen=True)
class Quantity:
    """What a diagram shows.

    Attributes:
        symbol, words: for the name of the file and the caption.
        unit: of the values that are written.
        signed: whether they are written with their sign.
    """

    symbol: str
    words: str
    unit: str
    signed: bool = False


QUANTITIES = (
    Quantity("N", "axial force, tension positive", "kN", signed=True),
    Quantity("V", "shear in the plane of the frame", "kN"),
    Quantity("M", "moment in the plane of the frame, on the side in tension", "kNm"),
)


def force_diagrams(archive: Archive) -> Iterator[Named]:
    """Yield diagrams of N, V and M of each plane frame that differs, under the combination of its most used member.

    Yields:
        Name of the file, caption and figure.
    """
    results = BuildingResults(archive)
    use, frames = largest_use(results), frames_of(results)
    for frame, alike in different_frames(results):
        members = np.array(frames[frame])
        worst = int(members[first_of_largest(use[members])])
        check = governing(results, worst)
        combination = int(results.values("members", "combination")[worst, check])
        if not combination:
            continue
        name = str(results.values("members", "member")[worst])
        of = f"{check_words(str(results.values('members', 'check')[check]))} of {name}, {use[worst]:.2f}"
        under = f"combination {combination}: {results.values('combinations', 'name')[combination - 1]}"
        others = f" As frames {', '.join(alike)}, which are used less." if alike else ""
        for quantity in QUANTITIES:
            said = (
                f"Frame {frame}, {quantity.symbol}: {quantity.words}, in {quantity.unit}. Under {under}, which governs "
                f"{of}. Line: without the seismic action; band: with it in both senses. Written is the "
                f"largest value of each section in a storey.{others}"
            )
            draw = partial(_draw, results=results, frame=frame, combination=combination - 1, quantity=quantity)
            yield f"forces_{frame}_{quantity.symbol}", said, on_sheet(draw)


@dataclass(frozen=True)
class Along:
    """A quantity along a member on a sheet.

    Attributes:
        start, end: of the member, inches.
        side: to which positive values are drawn, of length 1, (2,).
        stations: places as fractions of the length, (n,).
        steady, alternating: without the seismic action, and how much that adds in both senses, (n,) N or N m.
    """

    start: np.ndarray
    end: np.ndarray
    side: np.ndarray
    stations: np.ndarray
    steady: np.ndarray
    alternating: np.ndarray

    @property
    def low(self) -> np.ndarray:
        """The least values, (n,)."""
        return self.steady - self.alternating

    @property
    def high(self) -> np.ndarray:
        """The largest values, (n,)."""
        return self.steady + self.alternating

    def at(self, values: np.ndarray, scale: float) -> np.ndarray:
        """Return where values are drawn, (n, 2) inches.

        Args:
            values: (n,).
        """
        base = self.start + self.stations[:, None] * (self.end - self.start)
        return np.asarray(base + scale * values[:, None] * self.side)


def along_of(results: BuildingResults, member: int, combination: int, axis: int, symbol: str) -> Along:
    """Return a quantity of a member in the plane of a frame, with places in metres of the frame.

    M_y stretches the side of local z and M_z that against local y: V_z = dM_y/dx, V_y = -dM_z/dx.

    Args:
        member: number of the member, from 0.
        combination: number of the combination, from 0.
        axis: along which the frame stands, 0 for x, 1 for y.
        symbol: N, V or M.
    """
    start, end, web = (results.values("members", name)[member] for name in ("start", "end", "web"))
    plane = [axis, 2]
    in_plane = float(np.hypot(*web[plane])) > np.sqrt(0.5)
    way = (end - start) / np.linalg.norm(end - start)
    local = web if in_plane else np.cross(web, way)
    names = {"N": ("N", "N"), "V": ("V_z", "V_y"), "M": ("M_y", "M_z")}[symbol]
    which = [str(of) for of in results.values("forces", "force")].index(names[0 if in_plane else 1])
    side = local[plane]
    if symbol == "N":
        side = np.array([-way[2], way[axis]])  # upwards of beams, to the left of columns
    elif symbol == "M" and not in_plane:
        side = -side
    forces = forces_along(results, member, combination)
    return Along(
        start[plane],
        end[plane],
        side / max(float(np.hypot(*side)), 1e-9),
        np.asarray(forces.stations),
        np.asarray(forces.steady)[:, which],
        np.asarray(forces.alternating)[:, which],
    )


def _draw(sheet: Sheet, results: BuildingResults, frame: str, combination: int, quantity: Quantity) -> None:
    members = np.array(frames_of(results)[frame])
    axis = 0 if frame.startswith("X") else 1
    lines = grid_lines(results)[axis]
    levels = np.unique(results.values("nodes", "position")[:, 2].round(6))
    grid = Grid.of([name for name, _ in lines], [place for _, place in lines], levels.tolist())
    scaled = np.array([grid.across, grid.up])
    found = {int(n): _on_sheet(along_of(results, int(n), combination, axis, quantity.symbol), scaled) for n in members}
    largest = max((float(np.abs([one.low, one.high]).max()) for one in found.values()), default=0.0)
    bay, storey = (float(np.diff(places).min()) for places in ([scaled[0] * x for x in grid.xs], scaled[1] * levels))
    scale = HIGHEST * min(bay, storey) / largest if largest else 0.0
    values = (one.at(side, scale) for one in found.values() for side in (one.low, one.high))
    draw_axes(sheet, grid, dimensions=False, beside=-min((float(at[:, 0].min()) for at in values), default=0.0))
    sheet.lines([np.array((one.start, one.end)) for one in found.values()], FAINT, 1.0)
    shown = [one for one in found.values() if np.abs([one.low, one.high]).max() > 1e-6 * largest]
    bands = [one for one in shown if one.alternating.any()]
    sheet.shapes([[*one.at(one.low, scale), *one.at(one.high, scale)[::-1]] for one in bands], BAND, AFTER, 0.3, 1.2)
    plain_ones = [one for one in shown if not one.alternating.any()]
    zero = [[*one.at(0.0 * one.steady, scale), *one.at(one.steady, scale)[::-1]] for one in plain_ones]
    sheet.shapes(zero, BAND, AFTER, 0.3, 1.2)
    sheet.lines([one.at(one.steady, scale) for one in shown], STEADY, 0.8)
    sheet.lines([np.array((one.start, one.end)) for one in found.values()], INK, 0.7)
    keys = list(zip(*(results.values("members", name).tolist() for name in ("kind", "section", "storey")), strict=True))
    for key in dict.fromkeys(keys[n] for n in found):
        alike = [n for n in found if keys[n] == key]
        alike.sort(key=lambda n: -float(np.abs([found[n].low, found[n].high]).max().round(3)))
        for n in alike:
            one = found[n]
            extreme = one.high if np.abs(one.high).max() >= np.abs(one.low).max() else one.low
            value = float(extreme[np.argmax(np.abs(extreme))])
            if abs(value) < UNSEEN * largest or largest == 0.0:
                break
            texts = [plain((one if quantity.signed else abs(one)) / 1e3) for one in extreme.tolist()]
            text = texts[int(np.argmax(np.abs(extreme)))]
            equal = [place for place, other in enumerate(texts) if other == text]
            if sheet.place(_spots(one, equal, float(scale * value)), text, (SMALLEST,)):
                break


def _on_sheet(one: Along, scaled: np.ndarray) -> Along:
    """A quantity with the places of its member in inches; the side stays that in the frame."""
    return Along(one.start * scaled, one.end * scaled, one.side, one.stations, one.steady, one.alternating)


def _spots(one: Along, places: Sequence[int], ordinate: float) -> list[Spot]:
    """Spots of a value beside the ends of its ordinates, those of the middle first, and a little inwards of a joint."""
    way = one.end - one.start
    length = float(np.hypot(*way))
    way = way / max(length, 1e-9)
    middle = 0.5 * (one.stations[0] + one.stations[-1])
    found = []
    for place in sorted(places, key=lambda n: abs(one.stations[n] - middle)):
        share = float(one.stations[place])
        inwards = 0.0 if abs(share - middle) < 0.4 else np.sign(middle - share)
        for along in (0.0, 0.08, 0.16) if inwards else (0.0,):
            at = one.start + (share * length + inwards * along) * way
            found += _beside(at, at + ordinate * one.side, way, float(np.sign(ordinate)) * one.side)
    return found


def _beside(axis: np.ndarray, at: np.ndarray, way: np.ndarray, outwards: np.ndarray) -> list[Spot]:
    """Spots at the end of an ordinate, farther out first, and at the other side of the axis of the member."""
    if min(abs(way)) > 0.1:  # a brace: along it
        turned = float(np.degrees(np.arctan2(way[1], way[0])))
        up = 1.0 if abs(turned) < 90.0 else -1.0
        turned -= 0.0 if up > 0.0 else np.copysign(180.0, turned)
        side = up * np.array([-way[1], way[0]])
        far = max(0.02, abs(float((at - axis) @ side)) + 0.02)
        return [
            Spot(*(axis + sign * far * side), "center", va, turned) for sign, va in ((1.0, "bottom"), (-1.0, "top"))
        ]
    if abs(outwards[0]) > abs(outwards[1]):
        spots = [
            Spot(x + 0.03 * sign, at[1], ha) for x in (at[0], axis[0]) for sign, ha in ((1.0, "left"), (-1.0, "right"))
        ]
        return spots if outwards[0] > 0.0 else [spots[1], spots[0], spots[3], spots[2]]
    spots = [
        Spot(at[0], y + 0.02 * sign, "center", va)
        for y in (at[1], axis[1])
        for sign, va in ((1.0, "bottom"), (-1.0, "top"))
    ]
    return spots if outwards[1] > 0.0 else [spots[1], spots[0], spots[3], spots[2]]
