"""One plane frame of a building, or all frames of a direction side by side in one plane."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

from edesign.errors import InputError
from edesign.project.building.building import Building
from edesign.project.building.layout import DIRECTIONS
from edesign.project.building.names import Direction
from edesign.space.extract.plane_frame import PlaneFrame, parallel_frames, plane_frame
from edesign.space.structure.composite import with_slabs
from edesign.space.structure.frame import SpaceFrame

V = TypeVar("V")
LEANING_LINE = "L"
"""Line of the columns that stand for what leans on a frame; column lines of a building end in a figure."""


@dataclass(frozen=True)
class FrameRow:
    """Frames of one direction, side by side in one plane.

    Rigid floors tie the nodes of each floor, so that all frames of a direction together move as the building does
    without twisting. Lines and bays count through; the bay between two frames has no beams.

    Attributes:
        frames: one, or all of a direction that have columns.
    """

    frames: tuple[PlaneFrame, ...]

    @property
    def building(self) -> Building:
        """Building that the frames are taken from."""
        return self.frames[0].building

    @property
    def space(self) -> SpaceFrame:
        """The space frame of the building."""
        return self.frames[0].space

    @property
    def along(self) -> Direction:
        """Direction of the frames."""
        return self.frames[0].along

    @property
    def alone(self) -> PlaneFrame | None:
        """The only frame; None where there are several."""
        return self.frames[0] if len(self.frames) == 1 else None

    @property
    def name(self) -> str:
        """Name for titles: `frame X2`, `frames along x`."""
        return f"frame {self.frames[0].name}" if self.alone is not None else f"frames along {self.along}"

    @cached_property
    def top(self) -> int:
        """The highest floor that a frame reaches."""
        return max(frame.top for frame in self.frames)

    @cached_property
    def starts(self) -> tuple[int, ...]:
        """Number of the first line of each frame, from 0."""
        return tuple(i * len(self.frames[0].lines) for i in range(len(self.frames)))

    @property
    def n_lines(self) -> int:
        """Number of the lines of all frames."""
        return len(self.frames) * len(self.frames[0].lines)

    @cached_property
    def widths(self) -> tuple[float, ...]:
        """Widths of all bays, m; between two frames the distance that they have in the building."""
        own = self.building.widths(self.along)
        place = self.building.coordinates("y" if self.along == "x" else "x")
        found = list(own)
        for before, after in zip(self.frames, self.frames[1:], strict=False):
            found += [place[after.number] - place[before.number], *own]
        return tuple(found)

    def line_name(self, i: int) -> str:
        """Return the name of a line, that of its column line in the building; of one beyond them, for what leans.

        Args:
            i: number of the line, from 0, counted through.
        """
        if i == self.n_lines:
            return LEANING_LINE
        frame, own = divmod(i, len(self.frames[0].lines))
        return str(self.frames[frame].lines[own])

    def merged(self, of: Callable[[PlaneFrame], Mapping[tuple[int, int], V]]) -> dict[tuple[int, int], V]:
        """Return values of all frames by (line from 0 or bay from 1, storey or floor), counted through."""
        return {
            (start + place, level): found
            for frame, start in zip(self.frames, self.starts, strict=True)
            for (place, level), found in of(frame).items()
        }

    def check(self) -> None:
        """Check that a project file can say what the frames are.

        Raises:
            InputError: as `PlaneFrame.check`; or no rigid floor ties the frames at a floor.
        """
        for frame in self.frames:
            frame.check(alone=self.alone is not None)
        rigid = set(self.building.diaphragms.numbers(1, self.building.n_storeys))
        loose = [str(floor) for floor in range(1, self.top + 1) if floor not in rigid]
        if self.alone is None and loose:
            where = self.building.where("diaphragms")
            raise InputError(
                f"{where}: {self.name}: only rigid floors tie frames in one plane, and floor "
                f"{', '.join(loose)} is none; extract one frame, such as {self.frames[0].name} [E-SPACE-05]"
            )


def frame_row(building: Building, space: SpaceFrame, name: str) -> FrameRow:
    """Return a plane frame of a building, or all of a direction, by its name.

    Args:
        building: from `load_building`.
        name: `X2`, `YA`; `X` or `Y` for all frames along x or y.

    Raises:
        InputError: there is no such frame.
    """
    building = with_slabs(building)
    for along in DIRECTIONS:
        if name.strip().lower() == along:
            first = PlaneFrame(building, space, along, 0)
            return FrameRow(tuple(frame for frame in parallel_frames(first) if frame.columns))
    return FrameRow((plane_frame(building, space, name),))
