"""Diagrams of axial force, shear and moment along the members of a plane frame on a sheet."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from edesign.project.notation.names import member_kind
from edesign.report.drawing.captions import plain
from edesign.report.drawing.style import AFTER, TARGET, VARIANTS
from edesign.report.model.boxes import Spot
from edesign.report.model.elevation import Grid, draw_axes
from edesign.report.model.sheet import FAINT, INK, SMALLEST, Sheet

HIGHEST = 0.36  # ordinate of the largest value, of the smaller one of a bay and a storey
UNSEEN = 0.02  # of the largest value, below which none is written
INK_OF = {"beam": AFTER, "brace": TARGET}
COLORS = "those of beams in blue, of braces in red"
"""Of the values of beams and braces, which stand beside those of columns, and how captions say it."""
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


@dataclass(frozen=True)
class Along:
    """A quantity along a member on a sheet.

    Attributes:
        start, end: of the member, inches.
        side: to which positive values are drawn, of length 1, (2,).
        stations: places as fractions of the length, (n,).
        low, high: the least and the largest values, (n,) N or N m.
        steady: values of the line between them, (n,) N or N m; None: there is none.
    """

    start: np.ndarray
    end: np.ndarray
    side: np.ndarray
    stations: np.ndarray
    low: np.ndarray
    high: np.ndarray
    steady: np.ndarray | None = None

    def at(self, values: np.ndarray, scale: float) -> np.ndarray:
        """Return where values are drawn, (n, 2) inches.

        Args:
            values: (n,).
        scale: inches of a N or N m.
        """
        base = self.start + self.stations[:, None] * (self.end - self.start)
        return np.asarray(base + scale * values[:, None] * self.side)


def draw_diagram(
    sheet: Sheet, grid: Grid, members: Mapping[str, Along], alike: Mapping[str, Hashable], quantity: Quantity
) -> None:
    """Draw a quantity along all members of a frame: a band, or the area below a line, with the largest values.

    Args:
        grid: axes and levels on the sheet.
        members: by name, in the places of the frame, m.
        alike: what members have in common of which one value is written, such as their section and storey.
        quantity: what is drawn.
    """
    scaled, every = np.array([grid.across, grid.up]), list(members.values())
    found = {name: replace(one, start=one.start * scaled, end=one.end * scaled) for name, one in members.items()}
    largest = max((float(np.abs([one.low, one.high]).max()) for one in every), default=0.0)
    bay, storey = (
        float(np.diff(places).min()) for places in (scaled[0] * np.array(grid.xs), scaled[1] * np.array(grid.ys))
    )
    scale = HIGHEST * min(bay, storey) / largest if largest else 0.0
    reached = (one.at(side, scale) for one in found.values() for side in (one.low, one.high))
    draw_axes(sheet, grid, dimensions=False, beside=-min((float(at[:, 0].min()) for at in reached), default=0.0))
    sheet.lines([np.array((one.start, one.end)) for one in found.values()], FAINT, 1.0)
    shown = [one for one in found.values() if np.abs([one.low, one.high]).max() > 1e-6 * largest]
    areas = [(one, one.low if np.any(one.low != one.high) else 0.0 * one.low) for one in shown]
    bands = [[*one.at(low, scale), *one.at(one.high, scale)[::-1]] for one, low in areas]
    sheet.shapes(bands, BAND, AFTER, 0.3, 1.2)
    sheet.lines([one.at(one.steady, scale) for one in shown if one.steady is not None], STEADY, 0.8)
    sheet.lines([np.array((one.start, one.end)) for one in found.values()], INK, 0.7)
    for key in dict.fromkeys(alike[name] for name in found):
        group = [(name, one) for name, one in found.items() if alike[name] == key]
        group.sort(key=lambda pair: -float(np.abs([pair[1].low, pair[1].high]).max().round(3)))
        for name, one in group:
            extreme = one.high if np.abs(one.high).max() >= np.abs(one.low).max() else one.low
            value = float(extreme[np.argmax(np.abs(extreme))])
            if abs(value) < UNSEEN * largest or largest == 0.0:
                break
            texts = [plain((one if quantity.signed else abs(one)) / 1e3) for one in extreme.tolist()]
            text = texts[int(np.argmax(np.abs(extreme)))]
            equal = [place for place, other in enumerate(texts) if other == text]
            color = INK_OF.get(member_kind(name), INK)
            if sheet.place(_spots(one, equal, float(scale * value)), text, (SMALLEST,), color):
                break


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
        places = [(axis + sign * far * side).tolist() for sign in (1.0, -1.0)]
        return [Spot(x, y, "center", va, turned) for (x, y), va in zip(places, ("bottom", "top"), strict=True)]
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
