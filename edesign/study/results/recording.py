"""What an analysis records: quantities over floors, storeys, members, to channels of the core and back again."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from edesign.archive.dataset import Group, Variable
from edesign.core import Channel, Response
from edesign.frame.frame_model import FrameModel, Sum, Terms

SINGLE = np.float32
"""Type of what is kept over time: its rounding, 6e-8, is finer than the tolerance to which equilibrium is solved, 1e-7
of the largest force. What a history is judged by, its extremes and last values, is kept in double precision."""

_SUFFIX = {"max": "largest value", "min": "smallest value", "final": "at the end"}


@dataclass(frozen=True)
class Quantity:
    """A quantity that an analysis records for each floor, storey, member or member end.

    Attributes:
        name: of its variables; `_max`, `_min` and `_final` are appended for extremes over time and the last value.
        dims: dimensions beside time; their coordinates stand in the group.
        shape: lengths of these dimensions.
        cells: the weighted terms of each component in C order; a component without terms is zero.
        history: whether the value at every time is kept.
        keep: which of max, min, final are stored.
        tail: whether the values of the last steps are kept.
        since_start: whether the final value counts from the start of the run.
        watched: whether the run's `Watch` sees the value of every step.
    """

    name: str
    dims: tuple[str, ...]
    shape: tuple[int, ...]
    cells: tuple[Terms, ...]
    unit: str
    long_name: str
    history: bool = False
    keep: tuple[str, ...] = ("max", "min", "final")
    tail: bool = False
    since_start: bool = False
    watched: bool = False

    @property
    def keys(self) -> dict[int, str]:
        """The name of the channel of each component that has terms, by its index."""
        return {i: self._key(i) for i, terms in enumerate(self.cells) if terms}

    def channels(self) -> list[Channel]:
        """Return the channels of the components that have terms."""
        kept = self.history, self.tail, self.since_start, self.watched
        return [Channel(key, self.cells[i], *kept) for i, key in self.keys.items()]

    def values(self, response: Response) -> np.ndarray:
        """Return the values at every time that was kept, (nt, *shape)."""
        return self._columns(response.values, response.time.size)

    def last_values(self, response: Response) -> np.ndarray:
        """Return the values in the last steps, (steps, *shape)."""
        return self._columns(response.tail, max((column.size for column in response.tail.values()), default=1))

    def _columns(self, found: Mapping[str, np.ndarray], rows: int) -> np.ndarray:
        columns = np.zeros((rows, len(self.cells)))
        for i, key in self.keys.items():
            columns[:, i] = found[key]
        return columns.reshape(-1, *self.shape)

    def extreme(self, response: Response, which: str) -> np.ndarray:
        """Return an extreme over time, or the final value, (*shape,).

        Args:
            response: of the analysis.
            which: `max`, `min` or `final`.
        """
        found = {"max": response.maximum, "min": response.minimum, "final": response.final}[which]
        if which == "final" and self.since_start:
            found = {key: value - response.start.get(key, 0.0) for key, value in found.items()}
        return np.array([found[self._key(i)] if terms else 0.0 for i, terms in enumerate(self.cells)]).reshape(
            self.shape
        )

    def _key(self, i: int) -> str:
        return f"{self.name}({', '.join(self.dims)})[{i}]"  # one name may be recorded over two dimensions


def recorded(displacement: Sum, kind: str = "displacement", factor: float = 1.0) -> Terms:
    """Return a displacement, or its velocity or acceleration, as a sum of what the core records.

    Args:
        kind: what is recorded of each degree.
    """
    return tuple((factor * c, kind, node, degree) for c, node, degree in displacement)


def directed(
    frame: FrameModel, dimension: Literal["floor", "storey", ""] = ""
) -> tuple[tuple[str, ...], tuple[int, ...]]:
    """Return dimensions and shape of a quantity in each direction in which floors move.

    Args:
        dimension: "floor" or "storey" of a quantity of each of them.
    """
    dims, shape = ((dimension,), (len(frame.floors),)) if dimension else ((), ())
    if not frame.directions[0].name:
        return dims, shape
    return (*dims, "direction"), (*shape, len(frame.directions))


def by_axis(frame: FrameModel, *dimensions: str) -> tuple[str, ...]:
    """Return the dimensions of a quantity of members that bend, which in space has one value for each axis."""
    return (*dimensions, "axis") if frame.model.dimension == 3 else dimensions


def channels(quantities: Iterable[Quantity]) -> list[Channel]:
    """Return the channels of all quantities.

    Raises:
        ValueError: two quantities have the same name and dimensions (a mistake of the caller, not of the user).
    """
    found = [channel for quantity in quantities for channel in quantity.channels()]
    if len({channel.name for channel in found}) < len(found):
        raise ValueError("two recorded quantities have the same name and dimensions")
    return found


def store(
    group: Group, quantities: Iterable[Quantity], response: Response, along: str, kind: type[np.floating] = np.float64
) -> None:
    """Add the recorded values to a group.

    Args:
        group: has the coordinates of all dimensions.
        response: of the run.
        along: dimension of the histories, "time" or "step".
        kind: of the numbers of histories.
    """
    for quantity in quantities:
        if quantity.history:
            values = quantity.values(response).astype(kind, copy=False)
            group.add(quantity.name, (along, *quantity.dims), values, quantity.unit, quantity.long_name)
        for which in quantity.keep:
            label = f"{quantity.long_name}, {_SUFFIX[which]}"
            group.add(
                f"{quantity.name}_{which}", quantity.dims, quantity.extreme(response, which), quantity.unit, label
            )


def coordinate(group: Group, name: str, values: object, unit: str, long_name: str) -> None:
    """Add a coordinate to a group.

    Args:
        group: of an analysis.
        name: of the coordinate and its dimension.
        values: numbers or texts, (n,).
        unit: "1" for counts, "" for texts.
        long_name: description for readers.
    """
    group.coords[name] = Variable((name,), np.asarray(values), unit, long_name)


def store_run(group: Group, response: Response, abscissa: str = "load factor", unit: str = "1") -> None:
    """Add status, reason, statistics and the fallbacks of the solution of a run to its group.

    Args:
        group: the group of the analysis.
        abscissa: name of what the steps of the run are taken in.
        unit: unit of the abscissa.
    """
    group.attributes |= {"status": response.status, "reason": response.reason, "statistics": dict(response.statistics)}
    events = [
        {
            "time": float(str(event["time"])),
            "step": int(str(event["step"])),
            "rung": str(event["fallback"]),
            "detail": _detail(event),
        }
        for event in response.events
    ]
    group.attributes["events"] = events
    if not events:
        return
    coordinate(group, "event", np.arange(1, len(events) + 1), "1", "number of the event")
    group.add("event_time", ("event",), [event["time"] for event in events], unit, f"{abscissa} of the attempt")
    group.add("event_step", ("event",), [event["step"] for event in events], "1", "number of the step, from 1")
    group.add("event_rung", ("event",), [event["rung"] for event in events], "", "fallback that was tried")
    group.add("event_detail", ("event",), [event["detail"] for event in events], "", "outcome of the attempt")


def _detail(event: dict[str, object]) -> str:
    ended = "converged" if event.get("success") else "did not converge"
    return f"step / {2 ** int(str(event.get('halvings', 0)))}, {ended} after {event.get('iterations', 0)} iterations"
