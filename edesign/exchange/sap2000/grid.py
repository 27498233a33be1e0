"""The grid of column lines and floors that a model stands on, and the place of each of its frames."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from edesign.errors import InputError
from edesign.exchange.sap2000.model import FrameObject, Sap2000Model
from edesign.project.reading.problems import listed

Point = tuple[int, int, int]
"""Numbers of the grid lines across X and Y, and of the floor, from 0."""
Kind = Literal["column", "beam", "brace"]
_STEEPEST = 0.2  # of braces: width over height, or the reverse; steeper ones are columns or beams askew
TOLERANCE = 1e-3
"""Distance in m within which coordinates are one: that of SAP2000 for merging joints, in a model in metres."""


@dataclass(frozen=True)
class Placed:
    """A frame on the grid.

    Attributes:
        start, end: its points; of a beam or its half those of the whole beam, and of a brace those of the bay.
        half: of a beam that braces meet in the middle 1 or 2, else 0.
        middle: of a brace whose end is in the middle of a beam which end that is, else "".
        reversed: whether it runs from `end` to `start` in the model.
    """

    frame: FrameObject
    kind: Kind
    start: Point
    end: Point
    half: int = 0
    middle: Literal["", "start", "end"] = ""
    reversed: bool = False

    @property
    def along(self) -> Literal["x", "y"]:
        """The direction of a beam, or of the bay of a brace."""
        return "x" if self.start[0] != self.end[0] else "y"

    def share_of_beam(self, share: float) -> float:
        """Return a place along the frame as a share of its whole beam, from the end with the smaller coordinate.

        Args:
            share: of the length of the frame, from the end at which it begins in the model.
        """
        share = 1.0 - share if self.reversed else share
        return share if not self.half else 0.5 * (self.half - 1) + 0.5 * share


class Grid:
    """The grid of a model, and its frames on it.

    Args:
        model: in SI.

    Raises:
        InputError: a frame does not stand on a grid of column lines and floors.
    """

    def __init__(self, model: Sap2000Model) -> None:
        self.model = model
        self._used = {joint for frame in model.frames.values() for joint in (frame.i, frame.j)}
        self._frames_at: dict[str, list[FrameObject]] = defaultdict(list)
        for frame in model.frames.values():
            self._frames_at[frame.i].append(frame)
            self._frames_at[frame.j].append(frame)
        self._check_slopes()
        self.middles = self._find_middles()
        on_lines = [model.joints[joint] for joint in self._used if joint not in self.middles]
        self.x, self.y, self.z = (_levels(values) for values in zip(*on_lines, strict=True))
        self.placed = [self._place(frame) for frame in model.frames.values()]
        self._check_joints_between()

    @cached_property
    def is_plane(self) -> bool:
        """Whether all joints are in one vertical plane."""
        return min(len(self.x), len(self.y)) == 1

    @property
    def plane(self) -> Literal["x", "y"]:
        """The horizontal direction of a plane frame."""
        return "x" if len(self.y) == 1 else "y"

    @cached_property
    def points(self) -> dict[str, Point]:
        """The points of all joints on column lines."""
        return {joint: self.point(joint) for joint in self._used if joint not in self.middles}

    def point(self, joint: str) -> Point:
        """Return the point of a joint on a column line."""
        x, y, z = self.model.joints[joint]
        return _nearest(self.x, x), _nearest(self.y, y), _nearest(self.z, z)

    def is_used(self, joint: str) -> bool:
        """Whether a frame ends at a joint."""
        return joint in self._used

    def frames_at(self, joint: str) -> list[FrameObject]:
        """Return the frames that end at a joint."""
        return self._frames_at[joint]

    def _check_slopes(self) -> None:
        """Refuse frames that are nearly upright or level, which would make lines and floors of their own."""
        for frame in self.model.frames.values():
            dx, dy, dz = np.abs(np.subtract(self.model.joints[frame.j], self.model.joints[frame.i]))
            plan = float(np.hypot(dx, dy))
            if TOLERANCE <= plan < _STEEPEST * dz:
                raise self._refuse(
                    frame, f"it is inclined: its ends are {plan:.4g} m apart in plan; columns are upright [E-SAP-16]"
                )
            if TOLERANCE <= dz < _STEEPEST * plan:
                raise self._refuse(
                    frame, f"it slopes: its ends differ by {dz:.4g} m in height; beams are level [E-SAP-16]"
                )

    def _find_middles(self) -> dict[str, tuple[str, str]]:
        """Joints in the middle of beams that braces meet, with the joints at the ends of the beam, in rising order."""
        found = {}
        for joint in sorted(self._used):
            frames = self._frames_at[joint]
            kinds = [_kind(self.model, frame) for frame in frames]
            beams = [frame for frame, kind in zip(frames, kinds, strict=True) if kind == "beam"]
            if "column" in kinds or len(beams) != 2 or "brace" not in kinds:
                continue
            here = np.array(self.model.joints[joint])
            ends = [frame.j if frame.i == joint else frame.i for frame in beams]
            arms = [np.subtract(self.model.joints[end], here) for end in ends]
            if np.linalg.norm(arms[0] + arms[1]) < TOLERANCE:
                ends.sort(key=lambda end: self.model.joints[end])
                found[joint] = (ends[0], ends[1])
        return found

    def _place(self, frame: FrameObject) -> Placed:
        kind = _kind(self.model, frame)
        ends = [frame.i, frame.j]
        if kind == "beam" and (met := [joint for joint in ends if joint in self.middles]):
            if len(met) == 2:
                raise self._refuse(frame, "it stands between two beams' middles [E-SAP-18]")
            start, end = (self.point(joint) for joint in self.middles[met[0]])
            other = frame.j if frame.i == met[0] else frame.i
            half = 1 if other == self.middles[met[0]][0] else 2
            backwards = (frame.i == met[0]) == (half == 1)
            self._check_bay(frame, start, end)
            return Placed(frame, kind, start, end, half, reversed=backwards)
        if kind == "brace":
            return self._place_brace(frame)
        points = sorted((self.point(joint), joint) for joint in ends)
        (start, first), (end, _) = points
        if kind == "column":
            if end[2] != start[2] + 1:
                raise self._refuse(
                    frame,
                    f"it goes from floor {start[2]} to floor {end[2]}; divide it where other members have joints"
                    " [E-SAP-17]",
                )
        else:
            self._check_bay(frame, start, end)
        return Placed(frame, kind, start, end, reversed=first != frame.i)

    def _check_bay(self, frame: FrameObject, start: Point, end: Point) -> None:
        steps = [abs(a - b) for a, b in zip(start, end, strict=True)]
        if steps[2]:
            raise self._refuse(frame, "it is neither level nor a brace [E-SAP-16]")
        if sum(step > 0 for step in steps) != 1:
            raise self._refuse(frame, "it runs across the grid, neither along X nor along Y [E-SAP-16]")
        if sum(steps) > 1:
            raise self._refuse(frame, "it spans over a column line; divide it there, or take the line out [E-SAP-17]")

    def _place_brace(self, frame: FrameObject) -> Placed:
        low, high = sorted((frame.i, frame.j), key=lambda joint: self.model.joints[joint][2])
        if low in self.middles and high in self.middles:
            raise self._refuse(frame, "both of its ends are in the middle of beams [E-SAP-18]")
        if low in self.middles or high in self.middles:
            middle = low if low in self.middles else high
            other = self.point(high if low in self.middles else low)
            ends = [self.point(joint) for joint in self.middles[middle]]
            far = [end for end in ends if end[:2] != other[:2]]
            step = 1 if low in self.middles else -1
            if len(far) != 1 or other[2] != far[0][2] + step:
                raise self._refuse(
                    frame, "it does not stand between the lower or upper corners of the bay and its beam [E-SAP-18]"
                )
            corner = (far[0][0], far[0][1], far[0][2])
            at: Literal["start", "end"] = "start" if low in self.middles else "end"
            start, end = (corner, other) if low in self.middles else (other, corner)
            return Placed(frame, "brace", start, end, middle=at, reversed=frame.i != low)
        start, end = self.point(low), self.point(high)
        plan = [abs(a - b) for a, b in zip(start[:2], end[:2], strict=True)]
        if sorted(plan) != [0, 1] or end[2] != start[2] + 1:
            raise self._refuse(
                frame, "it is inclined, and not a brace between the corners of a bay of one storey [E-SAP-18]"
            )
        return Placed(frame, "brace", start, end, reversed=frame.i != low)

    def _check_joints_between(self) -> None:
        """Refuse frames with joints between their ends, where SAP2000 would divide them."""
        joints = sorted(self._used)
        places = np.array([self.model.joints[joint] for joint in joints])
        for frame in self.model.frames.values():
            start = np.array(self.model.joints[frame.i])
            axis = np.array(self.model.joints[frame.j]) - start
            length = float(np.linalg.norm(axis))
            along = (places - start) @ axis / length
            inside = (along > TOLERANCE) & (along < length - TOLERANCE)
            near = inside & (np.linalg.norm(places - start - np.outer(along, axis / length), axis=1) < TOLERANCE)
            if near.any():
                names = listed([joints[k] for k in np.flatnonzero(near)])
                raise self._refuse(frame, f"joint {names} lies on it; divide the frame there [E-SAP-17]")

    def _refuse(self, frame: FrameObject, why: str) -> InputError:
        return self.model.error("frame", frame.name, why)


def _kind(model: Sap2000Model, frame: FrameObject) -> Kind:
    dx, dy, dz = np.abs(np.subtract(model.joints[frame.j], model.joints[frame.i]))
    if max(dx, dy) < TOLERANCE:
        return "column"
    return "beam" if dz < TOLERANCE else "brace"


def _levels(values: Iterable[float]) -> list[float]:
    """Different values in rising order; those within the tolerance are one."""
    found: list[float] = []
    for value in sorted(values):
        if not found or value - found[-1] > TOLERANCE:
            found.append(value)
    return found


def _nearest(levels: Sequence[float], value: float) -> int:
    return int(np.argmin(np.abs(np.asarray(levels) - value)))
