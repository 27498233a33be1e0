"""The worst of what a quantity is at each of its places: over ends, directions and axes of members."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.envelopes import by_largest_part, of_diaphragms
from edesign.project.criteria.measures import InSpace
from edesign.project.notation.frames import frames_of_member

EVERYWHERE = InSpace()
_NAMED = ("direction", "axis")


@dataclass(frozen=True)
class Spread:
    """The largest value at each place of a quantity.

    Attributes:
        values: (n,); minus infinity where nothing is chosen.
        direction, axis: of each value, (n,); "" where a quantity has none, as in a plane frame.
    """

    values: np.ndarray
    direction: tuple[str, ...]
    axis: tuple[str, ...]


def stored_dims(group: Group, quantity: str) -> tuple[str, ...]:
    """Return the dimensions of the extremes of a quantity, of its residual, or of its history without time.

    Args:
        group: results of an analysis, as archived.
    """
    for name in (f"{quantity}_max", f"{quantity}_min", f"residual_{quantity}", f"{quantity}_final", quantity):
        if name in group.variables:
            return tuple(dim for dim in group.variables[name].dims if dim not in ("time", "step"))
    return ()


def spread(group: Group, values: np.ndarray, dims: tuple[str, ...], chosen: InSpace = EVERYWHERE) -> Spread:
    """Return the largest value at each place, and its direction and axis.

    Args:
        group: results of an analysis, as archived.
        values: along `dims`.
        dims: the places first; of what the whole structure has one of, none, or directions alone.
        chosen: direction, frames of lines, and axis that count.
    """
    values = np.asarray(values, dtype=float)
    if not dims or dims[0] in _NAMED:
        values, dims = values[np.newaxis], ("", *dims)
    if chosen.frames and dims == ("drift_line", "direction"):
        frames = np.asarray(group.variables["drift_line_frame"].values).astype(str)
        values = np.where(np.isin(frames, chosen.frames), values, -np.inf)
    labels: dict[str, list[str]] = {}
    for key in _NAMED:
        if key in dims:
            labels[key] = [str(name) for name in group.coords[key].values]
            wanted = getattr(chosen, key)
            if wanted in labels[key]:
                values = values.take([labels[key].index(wanted)], axis=dims.index(key))
                labels[key] = [wanted]
    flat = values.reshape(len(values), -1)
    at = flat.argmax(axis=1)
    indices = np.unravel_index(at, values.shape[1:]) if values.ndim > 1 else ()

    def named(key: str) -> tuple[str, ...]:
        if key not in labels:
            return ("",) * len(values)
        return tuple(labels[key][i] for i in indices[dims.index(key) - 1])

    return Spread(flat[np.arange(len(values)), at], named("direction"), named("axis"))


def line_and_number(label: str) -> tuple[str, int]:
    """Return the column line of a drift line or point, and its storey or floor: A1.3."""
    line, _, number = label.rpartition(".")
    return line, int(number)


def resultant(group: Group, quantity: str) -> tuple[np.ndarray | None, tuple[str, ...]]:
    """Return the largest resultant of a quantity in both directions, and its dimensions.

    Pushovers archive none: of them those of the steps count. Of a floor with several diaphragms the largest counts.

    Args:
        group: results of an analysis of a building, as archived.

    Returns:
        The values in the unit of the quantity; None without it.
    """
    found, dims = _resultant(group, quantity)
    of_parts, _ = _resultant(group, of_diaphragms(quantity))
    return found if found is None or of_parts is None else by_largest_part(group, found, of_parts), dims


def _resultant(group: Group, quantity: str) -> tuple[np.ndarray | None, tuple[str, ...]]:
    stored = group.variables.get(f"{quantity}_resultant_max")
    if stored is not None:
        return np.asarray(stored.values, dtype=float), stored.dims
    variable = group.variables.get(quantity)
    if variable is None or variable.dims[-1:] != ("direction",):
        return None, ()
    over_time = np.asarray(variable.values, dtype=float)
    return np.sqrt((over_time**2).sum(axis=-1)).max(axis=0), variable.dims[1:-1]


def in_frames(group: Group, dimension: str, at: int, frames: Collection[str]) -> bool:
    """Return whether a member or damper stands in one of some frames; without any in all.

    Args:
        group: results of an analysis, as archived.
        dimension: whose coordinate names it.
        at: its number along the dimension.
        frames: names of plane frames of a building.
    """
    if not frames:
        return True
    if dimension == "damper":
        return "damper_frame" in group.variables and str(group.variables["damper_frame"].values[at]) in frames
    return any(frame in frames for frame in frames_of_member(str(group.coords[dimension].values[at])))
