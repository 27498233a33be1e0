"""Supports of the column bases of a frame: signs of supports, footings and isolators, and what they are in words."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from itertools import groupby

from edesign.project.analysis_file import AnalysisFile
from edesign.project.building.isolation import Isolation as BuildingIsolation
from edesign.project.dampers.isolation import AnyBaseDevice, AnyIsolator, Isolation
from edesign.project.frame.foundations import Footing, FootingSupport
from edesign.project.frame.supports import (
    Horizontal,
    SupportKind,
    SupportSprings,
    Turning,
    Vertical,
    VerticalSpring,
    YieldingRotation,
    YieldingTranslation,
    support_name,
)
from edesign.project.notation import names
from edesign.project.project import Project
from edesign.report.model.boxes import Spot
from edesign.report.model.elevation import Elevation
from edesign.report.model.sheet import INK, SOFT, Entry, Sheet
from edesign.report.model.words import device_size, law_colors, short

Support = SupportKind | SupportSprings | FootingSupport
HALF = 0.085  # width of a sign, inches
GROUND = -0.22  # of an isolated base, inches below it
_WORDS = {"fixed": "fixed support", "pinned": "pinned support", "roller": "roller, free along the frame"}


def draw_supports(sheet: Sheet, place: Elevation, project: Project) -> list[Entry]:
    """Draw the supports at the column bases; return their lines of the legend.

    Args:
        place: where metres of the frame are on the sheet.
    """
    frame = project.frame
    if project.isolation is not None:
        return list(_isolated(sheet, place, project))
    bases = {line: frame.support(line) for line in frame.lines if (line, 1) in frame.column_at}
    kinds: dict[str, tuple[Support, list[str]]] = {}
    for line, support in bases.items():
        kinds.setdefault(repr(support), (support, []))[1].append(line)
    marked = sum(not isinstance(support, str) for support, _ in kinds.values()) > 1
    entries = []
    for number, (support, lines) in enumerate(kinds.values(), start=1):
        sign = SIGNS[support_name(support)]
        mark = f"S{number}" if marked and not isinstance(support, str) else ""
        for line in lines:
            x, y = place.at(frame.x[frame.lines.index(line)], 0.0)
            sign(sheet, x, y)
            if mark:
                sheet.place([Spot(x + 0.22, y - 0.08, "left"), Spot(x - 0.22, y - 0.08, "right")], mark, color=SOFT)
        where = f" ({axes(lines, frame.lines)})" if len(kinds) > 1 else ""
        label = f"{mark}: {words(support)}{where}" if mark else f"{words(support)}{where}"
        entries.append(support_entry(label, support_name(support)))
    return entries


def words(support: Support) -> str:
    """Return the kind of a support in words."""
    if isinstance(support, FootingSupport):
        return footing_words(support.footing)
    if isinstance(support, SupportSprings):
        parts = (
            f"horizontal {_translation(support.horizontal)}",
            f"vertical {_translation(support.vertical)}",
            f"rotation {_rotation(support.rotation)}",
        )
        return f"support: {', '.join(parts)}"
    return _WORDS[support]


def axes(lines: list[str] | tuple[str, ...], every: tuple[str, ...]) -> str:
    """Return names of axes in words: A-C, E.

    Args:
        every: all axes, from the left.
    """
    places = sorted(every.index(line) for line in lines)
    runs = [[at for _, at in run] for _, run in groupby(enumerate(places), key=lambda pair: pair[1] - pair[0])]
    return ", ".join(every[run[0]] if len(run) == 1 else f"{every[run[0]]}-{every[run[-1]]}" for run in runs)


def footing_words(footing: Footing) -> str:
    """Return a footing in words."""
    parts = [f"footing {footing.length:g} m × {footing.width:g} m on {footing.soil}"]
    parts += [f"embedded {footing.embedment:g} m"] if footing.embedment else []
    parts += [f"walls in contact {footing.contact:g} m"] if footing.embedment else []
    parts += [f"{footing.thickness:g} m thick"] if footing.thickness is not None else []
    parts += ["lifts off"] if footing.uplift else []
    if footing.bearing_resistance is not None:
        parts.append(f"bearing resistance {short(footing.bearing_resistance / 1e3)} kPa")
    return ", ".join(parts)


def _translation(restraint: Horizontal | Vertical) -> str:
    if isinstance(restraint, YieldingTranslation):
        parts = [f"{short(restraint.stiffness / 1e6)} MN/m"]
        parts += [f"yields at {short(restraint.resistance / 1e3)} kN"] if restraint.resistance is not None else []
        parts += ["lifts off"] if isinstance(restraint, VerticalSpring) and restraint.uplift else []
        return ", ".join(parts)
    return restraint if isinstance(restraint, str) else f"{short(restraint / 1e6)} MN/m"


def _rotation(restraint: Turning) -> str:
    if isinstance(restraint, YieldingRotation):
        limit = f", yields at {short(restraint.resistance / 1e3)} kN m" if restraint.resistance is not None else ""
        return f"{short(restraint.stiffness / 1e6)} MN m/rad{limit}"
    return restraint if isinstance(restraint, str) else f"{short(restraint / 1e6)} MN m/rad"


# --- an isolated base


def _isolated(sheet: Sheet, place: Elevation, project: Project) -> Iterator[Entry]:
    frame = project.frame
    bases = [line for line in frame.lines if names.node_name(line, 0) in frame.nodes]
    at = {line: place.across * frame.x[frame.lines.index(line)] for line in bases}
    return draw_isolation(sheet, project, at, lambda lines: axes(lines, frame.lines), "rigid along the frame")


def draw_isolation(
    sheet: Sheet,
    project: AnalysisFile,
    at: Mapping[str, float],
    words_of: Callable[[tuple[str, ...]], str],
    stiff: str,
    along: str = "",
) -> Iterator[Entry]:
    """Draw an isolated base, the isolators below it and what acts beside them; yield their lines of the legend.

    Args:
        project: frame or building with an isolation.
        at: abscissas of the column bases from the left by their lines, inches.
        stiff: what the base is without beams, in words.
        along: direction of the frame of a building, x or y; what acts beside in the other direction is left out.
    """
    isolation = project.isolation
    assert isinstance(isolation, Isolation | BuildingIsolation)
    colors = law_colors(project)
    left, right = min(at.values()), max(at.values())
    sheet.line((left, 0.0), (right, 0.0), color=SOFT, width=3.0, zorder=1.0)
    sheet.block(0.5 * (left + right), 0.0, right - left, 0.04)
    _ground(sheet, left - 0.2, right + 0.2, GROUND)
    base = isolation.base
    beams = f"beams {base.beams.section} {base.beams.material}" if base.beams is not None else stiff
    if base.rotation is not None:
        beams += f", column bases: rotation {_rotation(base.rotation)}"
    yield Entry(f"isolated base: {beams}", lambda on, x, y: on.line((x, y), (x + 0.25, y), color=SOFT, width=3.0))
    shifts: dict[str, int] = {}
    for item in (*isolation.isolators, *isolation.beside):
        color, lines = colors[item.law], item.under(tuple(at), project.grid)
        carries = isinstance(item, AnyIsolator)
        if not lines or (along and along not in item.axes):
            continue
        sign = _isolator_sign if carries else _beside_sign
        for line in lines:
            shift = 0.0
            if not carries:
                shifts[line] = shifts.get(line, 0) + 1
                shift = 0.12 * shifts[line]
            sign(sheet, at[line] + shift, 0.0, color)
        label = f"{_base_device(project, item)} ({words_of(lines)})"
        yield Entry(label, _colored(sign, color), 0.26 if carries else 0.0)


def _base_device(project: AnalysisFile, item: AnyBaseDevice) -> str:
    size = device_size(project, item)
    what = "isolator" if isinstance(item, AnyIsolator) else "beside the isolators:"
    parts = [f"{what} {item.law}{f', {size}' if size else ''}"]
    if isinstance(item, AnyIsolator):
        parts.append(f"vertical {_translation(item.vertical)}")
    return ", ".join(parts)


# --- signs: drawn with their head at x, y


def _fixed(sheet: Sheet, x: float, y: float) -> None:
    _ground(sheet, x - 0.12, x + 0.12, y)


def _pinned(sheet: Sheet, x: float, y: float) -> None:
    sheet.shape([(x, y), (x - HALF, y - 0.13), (x + HALF, y - 0.13)])
    _ground(sheet, x - 0.12, x + 0.12, y - 0.13)


def _roller(sheet: Sheet, x: float, y: float) -> None:
    sheet.shape([(x, y), (x - HALF, y - 0.11), (x + HALF, y - 0.11)])
    sheet.dots([(x - 0.045, y - 0.135), (x + 0.045, y - 0.135)], 3.2)
    _ground(sheet, x - 0.12, x + 0.12, y - 0.16)


def _springs(sheet: Sheet, x: float, y: float) -> None:
    steps = [(x + (0.045 if i % 2 else -0.045), y - 0.03 - 0.018 * i) for i in range(6)]
    sheet.line((x, y), (x, y - 0.02), *steps, (x, y - 0.14), (x, y - 0.16), width=0.7)
    _ground(sheet, x - 0.12, x + 0.12, y - 0.16)


def _footing_sign(sheet: Sheet, x: float, y: float) -> None:
    sheet.shape([(x - 0.14, y), (x + 0.14, y), (x + 0.14, y - 0.1), (x - 0.14, y - 0.1)], face="#dfe3e8")
    _ground(sheet, x - 0.2, x + 0.2, y - 0.1)


def _isolator_sign(sheet: Sheet, x: float, y: float, color: str) -> None:
    """Draw an isolator between a base at a height and the ground.

    Args:
        x: abscissa, inches.
        y: lower edge of the base, inches.
        color: colour of the lines.
    """
    for low in (0.03, 0.09, 0.15):
        box = [(x - 0.08, y - low), (x + 0.08, y - low), (x + 0.08, y - low - 0.055), (x - 0.08, y - low - 0.055)]
        sheet.shape(box, face=color, edge="white", width=0.4)


def _beside_sign(sheet: Sheet, x: float, y: float, color: str) -> None:
    sheet.dots([(x, y + 0.5 * GROUND)], 4.5, color, "white", marker="D", mew=0.4)


def _ground(sheet: Sheet, left: float, right: float, y: float) -> None:
    sheet.line((left, y), (right, y), width=1.0)
    count = max(3, round((right - left) / 0.06))
    step = (right - left) / count
    sheet.lines([((left + (i + 1) * step, y), (left + i * step, y - 0.05)) for i in range(count)], INK, 0.5)


SIGNS: dict[str, Callable[[Sheet, float, float], None]] = {
    "fixed": _fixed,
    "pinned": _pinned,
    "roller": _roller,
    "springs": _springs,
    "footing": _footing_sign,
}


def support_entry(label: str, kind: str) -> Entry:
    """Return the line of the legend of a support.

    Args:
        kind: one of `SIGNS`.
    """
    up, high = (0.025, 0.1) if kind == "fixed" else (0.075, 0.26)
    return Entry(label, lambda sheet, x, y: SIGNS[kind](sheet, x + 0.14, y + up), high)


def _colored(sign: Callable[[Sheet, float, float, str], None], color: str) -> Callable[[Sheet, float, float], None]:
    return lambda sheet, x, y: sign(sheet, x + 0.14, y + 0.11, color)
