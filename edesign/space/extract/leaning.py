"""What leans on a plane frame: the masses and gravity loads of parallel frames that resist nothing themselves."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable

from edesign.space.extract.plane_frame import AtNodes, PlaneFrame, parallel_frames


def leaning_shares(frame: PlaneFrame) -> dict[int, float]:
    """Return what share of each frame without resistance leans on a frame, by the number of the former.

    A floor carries its mass to the two nearest frames that resist, by the lever rule; beyond the last of them to that
    one. So the shares of all frames that resist make the whole, and their mass has the centre of the building's.

    Args:
        frame: of a building.
    """
    frames = parallel_frames(frame)
    place = frame.building.coordinates("y" if frame.along == "x" else "x")
    firm = [other.number for other in frames if other.resists]
    shares: dict[int, float] = {}
    for other in frames:
        if other.resists or frame.number not in firm:
            continue
        before = [n for n in firm if n < other.number][-1:]
        after = [n for n in firm if n > other.number][:1]
        if not (before and after):
            share = 1.0 if frame.number in before + after else 0.0
        else:
            lever = (place[other.number] - place[before[0]]) / (place[after[0]] - place[before[0]])
            share = {before[0]: 1.0 - lever, after[0]: lever}.get(frame.number, 0.0)
        if share > 0.0:
            shares[other.number] = share
    return shares


def leaning(frame: PlaneFrame, values: Callable[[PlaneFrame], AtNodes]) -> dict[int, float]:
    """Return what leans on a frame at each floor.

    Args:
        frame: of a building.
        values: of the nodes of a frame, for instance its masses.
    """
    frames = parallel_frames(frame)
    found: dict[int, float] = defaultdict(float)
    for number, share in leaning_shares(frame).items():
        for (_, floor), value in values(frames[number]).items():
            found[floor] += share * value
    return dict(found)
