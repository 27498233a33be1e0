"""Diagrams of axial force, shear and moment of a plane frame: their extremes over the time of the governing history."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.members import VariantMembers
from edesign.project.frame.frame import Frame
from edesign.project.notation.names import member_kind, storey_of
from edesign.project.project import Project
from edesign.report.archived import archived_project, archived_study
from edesign.report.drawing.captions import at_level, file_name
from edesign.report.drawing.frame_drawing import FrameElevation
from edesign.report.model.diagrams import COLORS, QUANTITIES, Along, Quantity, draw_diagram
from edesign.report.model.elevation import Elevation
from edesign.report.model.figures import Named
from edesign.report.model.sheet import Sheet, on_sheet
from edesign.report.response.histories import History, histories, names_of

_ENDS = np.array([0.0, 1.0])
_INSIDE = ("member_moment_inside_min", "member_moment_inside_max")
_USES = ("section_use_max", "member_use_max", "brace_use_max")


def force_envelopes(archive: Archive) -> Iterator[Named]:
    """Yield N, V and M of the frame of each variant, as extremes over the history with its most used member.

    Yields:
        Name of the file, caption and figure; none of buildings, and of archives without moments inside members.
    """
    project = archived_project(archive)
    if not isinstance(project, Project):
        return
    of = VariantMembers(project, archived_study(archive)).project
    for variant, (history, group, member, use) in _governing(archive).items():
        frame = of(variant).with_halves(names_of(group, "member")).frame
        whose = f"Variant {variant}, " if variant else ""
        for quantity in QUANTITIES:
            members = dict(_along(frame, group, quantity))
            between = " Between the ends it is drawn straight, as under uniform loads." * (quantity.symbol == "V")
            said = (
                f"{whose}{quantity.symbol}: {quantity.words}, in {quantity.unit}. Extremes over time under "
                f"{history.motion}{at_level(history.level)}, which has the most used member ({member}, {use:.2f}). "
                f"Written is the largest value of each section in a storey, {COLORS}.{between}"
            )
            said = said[0].upper() + said[1:]
            draw = partial(_draw, frame=frame, members=members, quantity=quantity)
            yield file_name("envelope", *filter(None, (variant,)), quantity.symbol), said, on_sheet(draw)


def _governing(archive: Archive) -> dict[str, tuple[History, Group, str, float]]:
    """The history at the variant's own temperature with the largest use of a member, that member and its use."""
    found: dict[str, tuple[History, Group, str, float]] = {}
    for history in histories(archive):
        if not history.completed or history.temperature is not None:
            continue
        group = history.read(archive)
        if _INSIDE[0] not in group.variables:
            continue
        member, use = _most_used(group)
        if use > found.get(history.variant, (None, None, "", 0.0))[3]:
            found[history.variant] = history, group, member, use
    return found


def _most_used(group: Group) -> tuple[str, float]:
    worst = ("", 0.0)
    for name in _USES:
        if name in group.variables:
            values = np.asarray(group.variables[name].values, dtype=float)
            values = values.reshape(len(values), -1).max(axis=1)
            at = int(np.argmax(values))
            worst = max(
                worst,
                (names_of(group, "brace" if name.startswith("brace") else "member")[at], values[at]),
                key=lambda one: one[1],
            )
    return worst[0], float(worst[1])


def _along(frame: Frame, group: Group, quantity: Quantity) -> Iterator[tuple[str, Along]]:
    """The extremes of a quantity along columns and beams, and N of braces, with places in the frame, m.

    Forces of the archive act on the ends of members; those inside are the same at the end, and opposite at the start.
    """
    lines = FrameElevation(frame).lines

    def placed(name: str, low: np.ndarray, high: np.ndarray, stations: np.ndarray = _ENDS) -> tuple[str, Along]:
        start, end = (np.asarray(point) for point in lines[name])
        way = (end - start) / max(float(np.hypot(*(end - start))), 1e-9)
        left = np.array([-way[1], way[0]])
        return name, Along(start, end, -left if quantity.symbol == "M" else left, stations, low, high)

    if quantity.symbol == "M":
        stations = np.asarray(group.coords["station"].values, dtype=float)
        lows, highs = (np.asarray(group.variables[name].values, dtype=float) for name in _INSIDE)
    else:
        of = {"N": "axial", "V": "shear"}[quantity.symbol]
        stations = _ENDS
        low, high = (
            np.asarray(group.variables[f"member_{of}_force_{end}"].values, dtype=float) for end in ("min", "max")
        )
        lows, highs = np.column_stack((-high[:, 0], low[:, 1])), np.column_stack((-low[:, 0], high[:, 1]))
    for name, least, most in zip(names_of(group, "member"), lows, highs, strict=True):
        if name in lines:
            yield placed(name, least, most, stations)
    if quantity.symbol == "N" and "brace_axial_force_max" in group.variables:
        both = (group.variables[f"brace_axial_force_{end}"].values for end in ("min", "max"))
        for name, least, most in zip(names_of(group, "brace"), *both, strict=True):
            if name in lines:
                yield placed(name, np.full(2, least), np.full(2, most))


def _draw(sheet: Sheet, frame: Frame, members: Mapping[str, Along], quantity: Quantity) -> None:
    alike = {
        name: (member_kind(name), getattr(frame.members[name], "section", ""), storey_of(name)) for name in members
    }
    draw_diagram(sheet, Elevation.of_frame(frame), members, alike, quantity)
