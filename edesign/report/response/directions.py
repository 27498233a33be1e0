"""Figures of plane frames, drawn of a building in each direction, or of each of its plane frames."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial, wraps
from typing import TYPE_CHECKING

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.directions import views
from edesign.report.archived import archived_building

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Figures = Callable[[Archive], Iterator[tuple[str, str, "Figure"]]]


def in_each_direction(figures: Figures) -> Figures:
    """Return a function that draws figures of a plane frame; of a building it draws them along x, then along y.

    Args:
        figures: gives name, caption and figure of what an archive of a plane frame has.
    """

    @wraps(figures)
    def drawn(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
        for direction, seen in by_direction(archive).items():
            for name, caption, figure in figures(seen):
                if direction:
                    name, caption = f"{name}_{direction}", f"Along {direction}: {caption}"
                yield name, caption, figure

    return drawn


def by_direction(archive: Archive) -> dict[str, Archive]:
    """Return an archive as readers of plane frames see it, by direction; of a plane frame itself, by "".

    Args:
        archive: open; each result stays open as long as it.
    """
    about = archive.attributes
    if not (about.get("building_file") and about.get("planned")):
        return {"": archive}
    strong = strong_axes(archive)
    return {direction: archive.seen_through(partial(_along, direction, strong)) for direction in ("x", "y")}


def strong_axes(archive: Archive) -> dict[str, str]:
    """Return the direction in whose planes each column of a building bends about its local y, by name."""
    building = archived_building(archive)
    if building is None:
        return {}
    return {str(name): str(getattr(run, "strong", "")) for name, run in building.grid.members.items() if name[0] == "C"}


def _along(direction: str, strong: dict[str, str], group: Group) -> Group:
    return views(group, strong).get(direction, group)
