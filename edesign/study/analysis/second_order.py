"""The part that vertical loads have in the slope of a capacity curve."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from edesign.core import Response
from edesign.frame.frame_model import FrameModel
from edesign.study.analysis.lateral_patterns import by_floor
from edesign.study.results.recording import Quantity

if TYPE_CHECKING:
    from edesign.study.analysis.push import Push


def second_order_slope(push: Push, forces: np.ndarray, first: float, last: float) -> float | None:
    """Return the slope of a capacity curve that is due to vertical loads between two displacements, N/m.

    Virtual work: with du_j of the floors and dD_i of the storeys between the two states as the virtual
    displacements, the loads P_i above storey i of height h_i take sum P_i dD_i^2 / h_i / sum s_j du_j from the
    base shear, whose shares at the floors are s_j. So the slope is exact however the frame has moved. In a building
    each column has its part of P_i, that of its axial force under gravity, and drifts both ways; beside the centres
    of mass the s_j have moments, which do work on the turns of the floors.

    Args:
        forces: shares of the floors in the base shear, from the lowest.
        first: displacement of the control node since gravity at which the part of the curve begins, m.
        last: displacement of the control node since gravity at which it ends, m.

    Returns:
        None where the lateral forces do no work between the two.
    """

    def between(values: np.ndarray) -> np.ndarray:
        found = [np.diff(np.interp((first, last), push.displacement, one))[0] for one in push.sign * values.T]
        return np.array(found)

    frame = push.frame
    du = between(push.floors)
    h = np.array([storey.height for storey in frame.storeys])
    above = np.cumsum([floor.gravity for floor in frame.floors[::-1]])[::-1]
    moved = float(forces @ du)
    if frame.directions[0].name:
        moved += float(by_floor(frame, push.moments) @ between(push.turned))
        squares = push.line_shares @ between(push.line_drifts) ** 2 * h**2
    else:
        squares = np.diff(du, prepend=0.0) ** 2
    return float(-np.sum(above * squares / h) / moved / (last - first)) if moved > 0.0 else None


def column_forces(frame: FrameModel) -> list[Quantity]:
    """Return the axial forces of the columns of a building, to be recorded under gravity, N; else nothing."""
    columns = frame.of_kind("column")
    if frame.model.dimension == 2 or not columns:
        return []
    cells = tuple(((1.0, "axial_force", column.element, 0),) for column in columns)
    return [Quantity("carried", ("column",), (len(cells),), cells, "N", "axial force of the column", keep=("final",))]


def line_shares(frame: FrameModel, gravity: Response) -> np.ndarray:
    """Return what part of the loads above a storey stands on its column lines, (storeys, drifts of all lines).

    Drifts are those of `line_drifts`, both ways. Of a storey without columns all lines have the same part.

    Args:
        gravity: response under it, with `column_forces`; of a plane frame anything.
    """
    forces: dict[str, float] = {}
    for quantity in column_forces(frame):
        at_end = (column.end for column in frame.of_kind("column"))
        forces = dict(zip(at_end, np.maximum(-quantity.extreme(gravity, "final"), 0.0).tolist(), strict=True))
    rows = []
    for storey in frame.storeys:
        cells = []
        for other in frame.storeys:
            for lines in other.drifts:
                parts = np.array([forces.get(f"{at.line}.{other.number}", 0.0) for at in lines])
                parts = parts / parts.sum() if parts.any() else np.full(len(lines), 1.0 / len(lines))
                cells.append(parts if other is storey else np.zeros(len(lines)))
        rows.append(np.concatenate(cells))
    return np.array(rows)
