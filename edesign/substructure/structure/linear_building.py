"""Floors and storeys of a linear numerical part: their response by the motion of its degrees, as histories have it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from edesign.archive.dataset import Group
from edesign.core import Response
from edesign.frame.frame_model import FrameModel
from edesign.study.analysis.history_results import store_residuals
from edesign.study.results.coordinates import coordinates
from edesign.study.results.floors import floor_accelerations, floor_displacements, floor_relative_accelerations
from edesign.study.results.recording import SINGLE, Quantity, Terms, coordinate, store, store_run
from edesign.study.results.storeys import line_drifts, store_drift_extremes, storey_drifts

ACROSS = 0


@dataclass(frozen=True, eq=False)
class LinearBuilding:
    """Floors and storeys of a linear numerical part of n degrees.

    Attributes:
        floors: displacement of each floor; terms of all quantities are of horizontal motions of nodes.
        accelerations: of each floor, total and relative to the ground.
        drift: of each storey: its drift ratio, or the displacement between its floors where heights are not known.
        line_drifts: drift ratios on all column lines; None: there are no lines.
        rows: (nodes, n) horizontal displacement of each node by those of the degrees.
        frame: names of floors and storeys; None: the building is given by masses and stiffnesses.
        period: fundamental, with nothing in the specimen's place, s.
    """

    floors: Quantity
    accelerations: tuple[Quantity, Quantity]
    drift: Quantity
    line_drifts: Quantity | None
    rows: np.ndarray
    frame: FrameModel | None
    period: float

    @property
    def floor_rows(self) -> np.ndarray:
        """Displacement of each floor by those of the degrees, (floors, n); accelerations relative to the ground too."""
        return self._matrix(self.floors)

    def drifts(self, displacements: np.ndarray) -> np.ndarray:
        """Return the drifts of the storeys (nt, storeys).

        Args:
            displacements: (nt, n) of the degrees, m.
        """
        return displacements @ self._matrix(self.drift).T

    def group(
        self,
        time: np.ndarray,
        displacements: np.ndarray,
        accelerations: np.ndarray,
        ground: np.ndarray,
        histories: bool,
        failed: str = "",
    ) -> Group:
        """Return the response as the group of a history.

        Args:
            time: (nt,) s, at a constant step.
            displacements: (nt, n) of the degrees, m.
            accelerations: (nt, floors) relative to the ground, m/s2.
            ground: (nt,) its acceleration, m/s2.
            histories: whether `quantities` are kept over time.
            failed: why the history did not come to its end.
        """
        drifts = self.drifts(displacements)
        floors = displacements @ self.floor_rows.T
        total, relative = self.accelerations
        quantities = [
            (replace(self.floors, history=histories), floors),
            (replace(self.drift, history=histories), drifts),
            (replace(total, history=histories), accelerations + ground[:, None]),
            (relative, accelerations),
        ]
        if self.line_drifts is not None:
            quantities.append((self.line_drifts, displacements @ self._matrix(self.line_drifts).T))
        response = _response(time, quantities, failed)
        group = Group(attributes={"fundamental_period_s": self.period})
        if self.frame is not None:
            coordinates(group, self.frame)
            group.attributes["height"] = self.frame.floors[-1].level
        else:
            count = floors.shape[1]
            coordinate(group, "floor", np.arange(1, count + 1), "1", "floor, the highest is the roof")
            coordinate(group, "storey", np.arange(1, count + 1), "1", "storey below the floor of the same number")
        coordinate(group, "time", time, "s", "time from the start of the record")
        group.add("ground_acceleration", ("time",), ground, "m/s^2", "ground acceleration as applied")
        store(group, [quantity for quantity, _ in quantities], response, "time", SINGLE)
        if self.frame is not None and self.line_drifts is not None:
            store_drift_extremes(group, self.frame, self.line_drifts, response)
        if not failed and time.size > 1:
            ratios = drifts if self.frame is not None else None
            store_residuals(group, floors, ratios, float(time[1] - time[0]), min(self.period, float(time[-1])))
        store_run(group, response, "time", "s")
        return group

    def _matrix(self, quantity: Quantity) -> np.ndarray:
        """(components, n) of a quantity of horizontal displacements."""
        found = np.zeros((len(quantity.cells), self.rows.shape[1]))
        for i, terms in enumerate(quantity.cells):
            for factor, _, node, _ in terms:
                found[i] += factor * self.rows[node]
        return found


def building_of_frame(frame: FrameModel, rows: np.ndarray, period: float) -> LinearBuilding:
    """Return the floors and storeys of a frame: the quantities of its histories.

    Args:
        rows: see `LinearBuilding`.
        period: fundamental, s.
    """
    return LinearBuilding(
        floor_displacements(frame, history=True),
        (floor_accelerations(frame, history=True), floor_relative_accelerations(frame)),
        storey_drifts(frame, history=True),
        line_drifts(frame),
        rows,
        frame,
        period,
    )


def building_of_floors(count: int, period: float) -> LinearBuilding:
    """Return the floors and storeys of a shear building, whose degrees are their displacements.

    Args:
        period: fundamental, s.
    """
    floors = tuple(((1.0, "displacement", i, ACROSS),) for i in range(count))
    below = ((), *(((-1.0, "displacement", i, ACROSS),) for i in range(count - 1)))
    storeys = tuple((*own, *other) for own, other in zip(floors, below, strict=True))

    def of(name: str, dim: str, cells: tuple[Terms, ...], unit: str, label: str, *keep: str) -> Quantity:
        return Quantity(name, (dim,), (count,), cells, unit, label, history=unit == "m", keep=keep)

    label, relative = "horizontal acceleration of the floor", "floor_relative_acceleration"
    between = "displacement of the floor above the storey less that of the floor below"
    return LinearBuilding(
        of("floor_displacement", "floor", floors, "m", "displacement of the floor", "max", "min", "final"),
        (
            of("floor_acceleration", "floor", floors, "m/s^2", f"total {label}", "max", "min"),
            of(relative, "floor", floors, "m/s^2", f"{label} relative to the ground", "max", "min"),
        ),
        of("storey_displacement", "storey", storeys, "m", between, "max", "min", "final"),
        None,
        np.eye(count),
        None,
        period,
    )


def _response(time: np.ndarray, quantities: Sequence[tuple[Quantity, np.ndarray]], failed: str) -> Response:
    """Values of quantities as the core records them."""
    columns = {key: values[:, i] for quantity, values in quantities for i, key in quantity.keys.items()}

    def each(value: Callable[[np.ndarray], float]) -> dict[str, float]:
        return {key: float(value(column)) for key, column in columns.items()}

    return Response(
        status="failed" if failed else "completed",
        reason=failed,
        time=time,
        values=columns,
        maximum=each(np.max),
        minimum=each(np.min),
        final=each(lambda column: column[-1]),
        time_of_maximum=each(lambda column: time[np.argmax(column)]),
        time_of_minimum=each(lambda column: time[np.argmin(column)]),
        energy={},
    )
