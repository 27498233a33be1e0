"""Diagrams of axial force, shear and moment of the plane frames of a building, under the combination that governs."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from edesign.archive.reader import Archive
from edesign.codes.rule_check import first_of_largest
from edesign.report.building.checks import forces_along, governing
from edesign.report.building.figures.elevations import different_frames, frames_of, grid_lines, largest_use
from edesign.report.building.results import BuildingResults
from edesign.report.building.tables.checks import check_words
from edesign.report.model.diagrams import COLORS, QUANTITIES, Along, Quantity, draw_diagram
from edesign.report.model.elevation import Grid
from edesign.report.model.figures import Named
from edesign.report.model.sheet import Sheet, on_sheet


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
                f"largest value of each section in a storey, {COLORS}.{others}"
            )
            draw = partial(_draw, results=results, frame=frame, combination=combination - 1, quantity=quantity)
            yield f"forces_{frame}_{quantity.symbol}", said, on_sheet(draw)


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
    steady, alternating = (np.asarray(of)[:, which] for of in (forces.steady, forces.alternating))
    low, high = steady - alternating, steady + alternating
    side = side / max(float(np.hypot(*side)), 1e-9)
    return Along(start[plane], end[plane], side, np.asarray(forces.stations), low, high, steady)


def _draw(sheet: Sheet, results: BuildingResults, frame: str, combination: int, quantity: Quantity) -> None:
    axis = 0 if frame.startswith("X") else 1
    lines = grid_lines(results)[axis]
    levels = np.unique(results.values("nodes", "position")[:, 2].round(6))
    grid = Grid.of([name for name, _ in lines], [place for _, place in lines], levels.tolist())
    columns = (results.values("members", name).tolist() for name in ("member", "kind", "section", "storey"))
    about = list(zip(*columns, strict=True))
    numbers = [int(n) for n in frames_of(results)[frame]]
    members = {about[n][0]: along_of(results, n, combination, axis, quantity.symbol) for n in numbers}
    draw_diagram(sheet, grid, members, {about[n][0]: about[n][1:] for n in numbers}, quantity)
