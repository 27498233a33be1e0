"""What leans on a plane frame: the masses and gravity loads of parallel frames that resist nothing themselves."""

from __future__ import annotations

from collections.abc import Callable

from edesign.space.extract.plane_frame import AtNodes, PlaneFrame, parallel_frames


def leaning_shares(frame: PlaneFrame) -> dict[int, dict[int, float]]:
    """Return what share of each frame without resistance leans on a frame, by floor and number of the former.

    A floor carries its mass to the two nearest frames that resist and reach up to it, by the lever rule; beyond the
    last of them to that one. So the shares of all frames that resist make the whole, and their mass has the centre of
    the floor's.
    """
    frames = parallel_frames(frame)
    place = frame.building.coordinates("y" if frame.along == "x" else "x")
    found: dict[int, dict[int, float]] = {}
    for floor in range(1, frame.top + 1):
        firm = [other.number for other in frames if other.resists and other.top >= floor]
        loose = [other.number for other in frames if not other.resists and other.top >= floor]
        shares = {number: _share(place, firm, number, frame.number) for number in loose}
        found[floor] = {number: share for number, share in shares.items() if share > 0.0}
    return {floor: shares for floor, shares in found.items() if shares}


def _share(place: tuple[float, ...], firm: list[int], loose: int, number: int) -> float:
    """The share of one loose frame that leans on a firm one."""
    before, after = [n for n in firm if n < loose][-1:], [n for n in firm if n > loose][:1]
    if not (before and after):
        return 1.0 if number in before + after else 0.0
    lever = (place[loose] - place[before[0]]) / (place[after[0]] - place[before[0]])
    return {before[0]: 1.0 - lever, after[0]: lever}.get(number, 0.0)


def leaning(frame: PlaneFrame, values: Callable[[PlaneFrame], AtNodes]) -> dict[int, float]:
    """Return what leans on a frame at each floor.

    Args:
        values: of the nodes of a frame, for instance its masses.
    """
    shares = leaning_shares(frame)
    found = dict.fromkeys(shares, 0.0)
    for other in parallel_frames(frame):
        if any(other.number in at_floor for at_floor in shares.values()):
            for (_, floor), value in values(other).items():
                if share := shares.get(floor, {}).get(other.number):
                    found[floor] += share * value
    return found
