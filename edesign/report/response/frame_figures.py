"""Plastic hinges on the elevation of a frame."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.acceptance import ELASTIC_ROTATION
from edesign.assess.directions import frame_view
from edesign.assess.envelopes import peak
from edesign.assess.members import VariantMembers, compressions, frame_members
from edesign.codes.fema356.drift import PERFORMANCE_LEVELS
from edesign.project.analysis_file import AnalysisFile
from edesign.project.building.building import Building
from edesign.project.project import Project
from edesign.report.archived import archived_building, archived_project, archived_study
from edesign.report.assessment.measure_columns import ROUNDING
from edesign.report.drawing.building_drawing import BuildingElevation, frame_names
from edesign.report.drawing.captions import at_level, file_name, plain
from edesign.report.drawing.frame_drawing import Elevation, FrameElevation, Line
from edesign.report.drawing.panels import arrangement
from edesign.report.drawing.style import MEAN, legend_below, styled
from edesign.report.response.directions import strong_axes
from edesign.report.response.histories import (
    History,
    by_level,
    counted,
    histories,
    missing_text,
    names_of,
    worst_counts,
    worst_of_motions,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

End = tuple[str, int]
K = TypeVar("K")
Statistic = Callable[[np.ndarray], float]

COLORS = ("#fbd9a0", "#f2994a", "#c8452f", "#5b0f2e")
SIZES = (3.0, 4.2, 5.4, 6.8)  # points; size and darkness grow together, so that grey print keeps the order
DRAWN = 1.08  # of the width and height of a frame, with the margins around it
OFFSET = 0.085  # of a hinge from the end of its member, share of a bay


@dataclass(frozen=True)
class Scale:
    """Classes of hinges: the lower limits of all but the first, in the unit of the values, and their names."""

    limits: tuple[float, ...]
    names: tuple[str, ...]

    def rank(self, value: float) -> int:
        """Return the class of a value, 0 (not drawn) to 4."""
        return int(np.searchsorted(self.limits, value, side="right"))


ROTATION = Scale(
    (0.001, 0.005, 0.010, 0.020),
    ("below 1 mrad", "1 to 5 mrad", "5 to 10 mrad", "10 to 20 mrad", "over 20 mrad"),
)
ACCEPTANCE = Scale((0.5, 1.5, 2.5, 3.5), ("elastic", "to IO", "IO to LS", "LS to CP", "over CP"))
"""Of values 0 (elastic), 1 (up to immediate occupancy), 2, 3, 4 (beyond collapse prevention)."""


@dataclass(frozen=True)
class Hinges:
    """The plastic rotations in one elevation.

    Attributes:
        title: above it.
        values: of member ends (member, 0 start or 1 end): plastic rotation (rad) or class of `ACCEPTANCE`.
        dampers: names of the dampers in the frame.
        isolated: whether it stands on isolators.
        lines: start and end of its members by name, m; None: they are those of the figure.
    """

    title: str
    values: Mapping[End, float]
    dampers: tuple[str, ...] = ()
    isolated: bool = False
    lines: Mapping[str, Line] | None = None


def frame_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the plastic rotations of every level, variants side by side.

    The mean and the largest over the records, and the class of FEMA 356 that the mean reaches.

    Yields:
        Name of the file, caption and figure.
    """
    project = archived_building(archive) or archived_project(archive)
    if project is None:
        return
    of = VariantMembers(project, archived_study(archive)).project
    if isinstance(project, Building):
        strong = strong_axes(archive)
        for name in frame_names(project):
            seen = archive.seen_through(partial(in_frame, name, strong))
            judged = {column for column, axis in strong.items() if axis == name[0].lower()}
            for level, variants in by_level(histories(seen)).items():
                elevation = _Elevation(
                    partial(BuildingElevation, name=name), BuildingElevation(project, name), name, judged
                )
                yield from _of_level(seen, level, variants, elevation, of)
    elif isinstance(project, Project):
        for level, variants in by_level(histories(archive)).items():
            yield from _of_level(archive, level, variants, _Elevation(_of_frame, FrameElevation(project.frame)), of)


def _of_frame(project: Project) -> Elevation:
    return FrameElevation(project.frame)


def in_frame(name: str, strong: Mapping[str, str], group: Group) -> Group:
    """Return an analysis of a building as its plane frame of a name has it, and what has no directions as it is."""
    return frame_view(group, name, strong) if "direction" in group.coords else group


class _Elevation(NamedTuple):
    """What is drawn of a file, of that of the archive, its name, and columns judged about their strong axis, or all."""

    of: Callable[[Any], Elevation]
    drawing: Elevation
    name: str = ""
    judged: Collection[str] | None = None

    def panel(self, file: AnalysisFile, variant: str, read: Mapping[History, Group], take: Statistic) -> Hinges:
        """Return the rotations of a variant on its own members: dampers of a design may halve its beams."""
        first = next(iter(read.values()))
        lines = self.of(file.with_halves(names_of(first, "beam"))).lines
        values = {end: float(take(of)) for end, of in _worst(read, plastic_rotations).items()}
        title = ", ".join(part for part in (variant, counted(read)) if part)
        return Hinges(title, values, tuple(names_of(first, "damper")), bool(first.attributes.get("isolated")), lines)


def _of_level(
    archive: Archive,
    level: str,
    variants: Mapping[str, Sequence[History]],
    elevation: _Elevation,
    of: Callable[[str], AnalysisFile],
) -> Iterator[tuple[str, str, Figure]]:
    read = {variant: [(h, h.read(archive)) for h in chosen if h.completed] for variant, chosen in variants.items()}
    found = {
        variant: there
        for variant, pairs in read.items()
        if (there := {history: group for history, group in pairs if plastic_rotations(group)})
    }
    least = ROTATION.limits[0] if elevation.name else 0.0  # of many frames those with a hinge that is drawn
    if not any(
        value > least
        for group in chain(*(of.values() for of in found.values()))
        for value in plastic_rotations(group).values()
    ):
        return
    missing = missing_text(history for chosen in variants.values() for history in chosen)
    counts = worst_counts(chain(*found.values()))
    where = f" in frame {elevation.name}" if elevation.name else ""
    for statistic, words, take in (("mean", "Mean", np.mean), ("max", "Largest", np.max)):
        if statistic == "max" and all(len({h.of_motion for h in there}) == 1 for there in found.values()):
            continue
        panels = [elevation.panel(of(variant), variant, there, take) for variant, there in found.items()]
        if (
            statistic == "mean"
            and not _drawn(panels)
            and _drawn([elevation.panel(of(v), v, there, np.max) for v, there in found.items()])
        ):
            continue  # the largest say more
        caption = f"{words} over the records of the peak plastic rotations of member ends{where}{at_level(level)}. "
        figure = hinge_figure(elevation.drawing, panels, ROTATION)
        said = f"{caption}{_numbers(panels)}{counts}{missing}"
        yield file_name("hinges", elevation.name, level, statistic), said, figure
    classes = []
    for variant, there in found.items():
        values = acceptance(of(variant), there)
        if elevation.judged is not None:  # Table 5-6 is of bending about the strong axis
            values = {end: value for end, value in values.items() if end[0][0] != "C" or end[0] in elevation.judged}
        classes.append(replace(elevation.panel(of(variant), variant, there, np.mean), values=values))
    if any(any(panel.values.values()) for panel in classes):
        caption = f"Mean peak plastic rotations{where}{at_level(level)} by the limits of FEMA 356, Table 5-6, primary; "
        caption += f"columns above half of P_CL are over CP from {1e3 * ELASTIC_ROTATION:g} mrad. "
        figure = hinge_figure(elevation.drawing, classes, ACCEPTANCE)
        yield (
            file_name("hinges", elevation.name, level, "acceptance"),
            f"{caption}{_counts(classes)}{counts}{missing}",
            figure,
        )


def _drawn(panels: Sequence[Hinges]) -> bool:
    """Whether a hinge is drawn in any of the elevations."""
    return any(value >= ROTATION.limits[0] for panel in panels for value in panel.values.values())


def acceptance(project: AnalysisFile, read: Mapping[History, Group]) -> dict[End, float]:
    """Return the class of `ACCEPTANCE` of each member end, by its mean peak plastic rotation and axial force.

    Members that Table 5-6 does not know are left out; a column that it makes force-controlled must stay elastic.

    Args:
        read: the histories of one variant and level; of each motion its largest rotations and forces count.
    """
    members = frame_members(project)
    rotations = _worst(read, plastic_rotations)
    compression = _worst(read, compressions)
    found: dict[End, float] = {}
    for end in rotations:
        member = members.get(end[0])
        if member is None:
            continue
        rotation = float(np.mean(rotations[end]))
        force = float(np.mean(compression.get(end[0], 0.0)))
        beyond = sum(rotation > member.allowed(level, force) for level in PERFORMANCE_LEVELS)
        found[end] = float(1 + beyond) if rotation > ELASTIC_ROTATION else 0.0
    return found


def _worst(read: Mapping[History, Group], of: Callable[[Group], Mapping[K, float]]) -> dict[K, np.ndarray]:
    """The largest values of each motion, (motions,), by place; places are those of the first history."""
    each = [of(group) for group in read.values()]
    values = worst_of_motions(read, [np.array([one.get(place, 0.0) for place in each[0]]) for one in each])
    return {place: values[:, i] for i, place in enumerate(each[0])}


def plastic_rotations(group: Group) -> dict[End, float]:
    """Return the peak plastic rotations of the ends of columns and beams of an analysis, rad."""
    found: dict[End, float] = {}
    for kind in ("column", "beam"):
        values = peak(group, f"{kind}_plastic_rotation")
        if values is not None:
            for name, ends in zip(names_of(group, kind), values, strict=True):
                found |= {(name, end): float(np.max(ends[end])) for end in (0, 1)}
    return found


@styled
def hinge_figure(frame: Elevation, panels: Sequence[Hinges], scale: Scale = ROTATION) -> Figure:
    """Draw member ends beyond the first class of a scale as circles on the frame, elevations side by side.

    Args:
        panels: at least one.
    """
    from matplotlib.lines import Line2D

    xs, ys = ([end[k] for line in frame.lines.values() for end in line] for k in (0, 1))
    arranged = arrangement(len(panels), xs, ys, DRAWN * frame.width, DRAWN * frame.height)
    figure, axes = arranged.figure()
    offset = OFFSET * frame.bay
    for axis in axes[len(panels) :]:
        axis.set_visible(False)
    for axis, panel in zip(axes, panels, strict=False):
        frame.draw(axis, panel.dampers, panel.isolated)
        arranged.scale(axis)
        lines = frame.lines if panel.lines is None else panel.lines
        for (member, end), value in panel.values.items():
            rank = scale.rank(value)
            if rank and member in lines:
                near, far = lines[member][::-1] if end else lines[member]
                share = min(offset / float(np.hypot(far[0] - near[0], far[1] - near[1])), 0.3)
                x, y = (a + share * (b - a) for a, b in zip(near, far, strict=True))
                style: Any = {"ms": SIZES[rank - 1], "mfc": COLORS[rank - 1], "mec": MEAN, "mew": 0.5}
                axis.plot(x, y, marker="o", ls="none", zorder=3, gid=f"hinge {member} {end} class {rank}", **style)
        arranged.title(axis, panel.title)
    handles = [
        Line2D([], [], marker="o", ls="none", ms=size, mfc=color, mec=MEAN, mew=0.5, label=label)
        for size, color, label in zip(SIZES, COLORS, scale.names[1:], strict=True)
    ]
    legend_below(figure, handles, most=4 if figure.get_figwidth() > 4.0 else 2)
    engine = figure.get_layout_engine()
    assert engine is not None
    engine.execute(
        figure
    )  # with equal scales an elevation fills its panel only then, and the next layout sees its title
    return figure


def _counts(panels: Sequence[Hinges]) -> str:
    texts = []
    for panel in panels:
        ranks = [ACCEPTANCE.rank(value) for value in panel.values.values()]
        counts = [f"{ranks.count(i)} {name}" for i, name in enumerate(ACCEPTANCE.names) if i in ranks]
        texts.append(f"{panel.title}: {', '.join(counts)}")
    return f"Ends of members: {'; '.join(texts)}."


def _numbers(panels: Sequence[Hinges]) -> str:
    texts = []
    for panel in panels:
        worst = max(panel.values, key=lambda end: panel.values[end])
        yielded = sum(value >= ROTATION.limits[0] for value in panel.values.values())
        largest = panel.values[worst]
        most = f", the largest is {plain(1e3 * largest)} mrad ({worst[0]})" if largest > ROUNDING else ""
        texts.append(f"{panel.title}: {yielded} of {len(panel.values)} ends rotate by more than 1 mrad{most}")
    return f"{'; '.join(texts)}."
