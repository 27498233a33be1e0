"""The results of a building as figures of plane frames read them: one direction, or one plane frame, at a time."""

from __future__ import annotations

from collections.abc import Callable, Mapping, MutableMapping

import numpy as np

from edesign.archive.dataset import Group, Unread, Variable, dims_of
from edesign.project.notation.frames import frames_of_member

_MEMBERS = ("column", "beam", "brace", "member", "recorded_member", "buckling_brace")
_OF_ALL = ("storey_", "residual_storey_", "base_shear", "overturning_moment")
"""Beginnings of the names of what a building has as a whole, the heights of its storeys apart."""


def views(group: Group, about: Mapping[str, str] | None = None) -> dict[str, Group]:
    """Return the results in each direction by its name; of a plane frame the group itself, by "".

    Variables lose the dimension `direction`. Members lose `axis`: their bending in planes along the direction is left.
    Beams and braces across it are left out, and columns stay.

    Args:
        group: results of an analysis, as archived; variables are read when they are asked for.
        about: direction in whose planes each column bends about its local y, by name, as the `strong` of its run;
            of a column that is not there the larger of both axes counts; None: as the archive says.

    Returns:
        The groups, with the attributes of the whole.
    """
    if "direction" not in group.coords:
        return {"": group}
    names = [str(name) for name in group.coords["direction"].values]
    about = strong_directions(group) if about is None else about
    return {name: _view(group, name, name.upper(), about) for name in names}


def strong_directions(group: Group) -> dict[str, str]:
    """Return the direction in whose planes each column bends about its local y, by name; of an old archive none.

    Args:
        group: results of an analysis of a building, as archived.
    """
    if "member_axis_z" not in group.variables:
        return {}
    webs = np.abs(np.asarray(group.variables["member_axis_z"].values))[:, :2].argmax(axis=1)
    names = zip(map(str, group.coords["member"].values), webs, strict=True)
    return {name: "xy"[web] for name, web in names if name[:1] == "C"}


def frame_view(group: Group, frame: str, about: Mapping[str, str] | None = None) -> Group:
    """Return the results of one plane frame of a building.

    The drift of its storeys is that of its own column lines: extremes are those of the worst one, residual drifts and
    those at the end are means. Members and dampers are its own. What the building has as a whole, such as the shear of
    a storey, is left out.

    Args:
        group: results of an analysis, as archived; variables are read when they are asked for.
        frame: its name, such as X2.
        about: as of `views`.
    """
    direction = frame[:1].lower()
    found = _view(group, direction, frame, strong_directions(group) if about is None else about)
    for name in list(found.variables):
        if name.startswith(_OF_ALL) and name != "storey_height":
            del found.variables[name]
    if "drift_line_frame" not in group.variables:
        return found
    at = [str(name) for name in group.coords["direction"].values].index(direction)
    own = np.asarray(group.variables["drift_line_frame"].values)[:, at].astype(str) == frame
    of = np.asarray(group.variables["drift_line_storey"].values)
    storeys = group.coords["storey"].values
    takes: tuple[tuple[str, str, Callable[[np.ndarray], np.floating]], ...] = (
        ("storey_drift_max", "line_drift_max", np.max),
        ("storey_drift_min", "line_drift_min", np.min),
        ("storey_drift_final", "line_drift_final", np.mean),
        ("residual_storey_drift", "residual_line_drift", np.mean),
    )
    for name, source, take in takes:
        if source in group.variables:
            stored = group.variables[source]
            lines = np.asarray(stored.values, dtype=float)[:, at]
            chosen = [lines[own & (of == storey)] for storey in storeys]
            values = [float(take(some)) if some.size else np.nan for some in chosen]
            label = f"{stored.long_name}; of the lines of frame {frame}"
            found.variables[name] = Variable(("storey",), np.array(values), stored.unit, label)
    return found


def _view(group: Group, direction: str, frames: str, about: Mapping[str, str]) -> Group:
    """One direction of a group, with members and dampers of a frame, or of all whose names begin with X or Y."""

    def within(frame: str) -> bool:
        return frame == frames or frame[:1] == frames

    at = [str(name) for name in group.coords["direction"].values].index(direction)
    axes = [str(axis) for axis in group.coords["axis"].values] if "axis" in group.coords else []
    kept: dict[str, np.ndarray] = {}
    for dimension in _MEMBERS:
        if dimension in group.coords:
            labels = [str(label) for label in group.coords[dimension].values]
            kept[dimension] = np.array(
                [i for i, label in enumerate(labels) if any(map(within, frames_of_member(label)))], int
            )
    if "damper_frame" in group.variables:
        stand = [str(frame) for frame in group.variables["damper_frame"].values]
        kept["damper"] = np.array([i for i, frame in enumerate(stand) if within(frame)], int)

    def planes(dimension: str) -> list[int | None]:
        """The axis about which each member bends in the planes of the direction; None: either."""
        found: list[int | None] = []
        for label in map(str, group.coords[dimension].values[kept[dimension]]):
            strong = direction if label[:1] != "C" else about.get(label)
            found.append(None if strong is None else axes.index("y" if strong == direction else "z"))
        return found

    def seen(variable: Variable) -> Variable:
        values, dims = np.asarray(variable.values), variable.dims
        for dimension, chosen in kept.items():
            if dimension in dims:
                values = values.take(chosen, axis=dims.index(dimension))
        if "direction" in dims:
            values = values.take(at, axis=dims.index("direction"))
            dims = tuple(dim for dim in dims if dim != "direction")
        if "axis" in dims and dims.index("axis") == len(dims) - 1:
            dimension = next((dim for dim in dims if dim in kept), "")
            if dimension:
                values, dims = _bent(values, dims.index(dimension), planes(dimension)), dims[:-1]
        return Variable(dims, values, variable.unit, variable.long_name)

    def left(dims: tuple[str, ...]) -> tuple[str, ...]:
        bends = dims[-1:] == ("axis",) and any(dim in kept for dim in dims)
        return tuple(dim for dim in dims if dim != "direction" and not (bends and dim == "axis"))

    def of(items: MutableMapping[str, Variable]) -> Unread:
        return Unread({name: left(dims) for name, dims in dims_of(items).items()}, lambda name: seen(items[name]))

    coords, variables = of(group.coords), of(group.variables)
    used = {dim for dims in dims_of(variables).values() for dim in dims}
    for dimension in {"direction", "axis"} & set(coords) - used:
        del coords[dimension]
    return Group(coords, variables, group.attributes)


def _bent(values: np.ndarray, members: int, planes: list[int | None]) -> np.ndarray:
    """Values of members about one axis each, the last one of their dimensions; the larger size where that is open."""
    turned = np.moveaxis(values, members, 0)
    found = np.empty(turned.shape[:-1], values.dtype)
    for i, plane in enumerate(planes):
        both = turned[i]
        if plane is None:
            larger = np.abs(both).argmax(axis=-1)[..., np.newaxis]
            found[i] = np.take_along_axis(both, larger, axis=-1)[..., 0]
        else:
            found[i] = both[..., plane]
    return np.moveaxis(found, 0, members)
