"""Global ductility: strong columns, weak beams, EN 1998-1:2004, 4.4.2.3."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.quantities import check_not_negative

LEAST_RATIO = 1.3
"""sum M_Rc / sum M_Rb. Source: EN 1998-1:2004, 4.4.2.3(4), Eq. 4.29."""


def strength_ratio(M_Rc: ArrayLike, M_Rb: ArrayLike) -> np.ndarray:
    """Return sum M_Rc / sum M_Rb of joints, at least 1.3 where the rule holds; infinite without beams.

    It is asked in each vertical plane of frames and for both senses of the beam moments.

    Args:
        M_Rc: (..., n_columns) resistances of the columns above and below, each the least within the range of axial
            forces of the seismic design situation, N m; 0 where there is no column.
        M_Rb: (..., n_beams) resistances of the beams on both sides, N m; 0 where there is none or it is pinned.

    Returns:
        Dimensionless, in the shape of the arguments.

    Raises:
        InputError: a resistance is negative.

    Source: EN 1998-1:2004, 4.4.2.3(4), Eq. 4.29, and (5).
    """
    check_not_negative(M_Rc=M_Rc, M_Rb=M_Rb)
    columns = np.asarray(M_Rc, dtype=float).sum(axis=-1)
    beams = np.asarray(M_Rb, dtype=float).sum(axis=-1)
    columns, beams = np.broadcast_arrays(columns, beams)
    return np.divide(columns, beams, out=np.full(columns.shape, np.inf), where=beams > 0.0)


def is_exempt(floor: int, floors: int, frame_in_plane: bool = True) -> bool:
    """Return whether a joint need not satisfy the rule.

    Args:
        floor: of the joint, 1 at the bottom.
        floors: of the building.
        frame_in_plane: the structure resists by frames in the plane of the joint; otherwise nothing is asked in it.

    Source: EN 1998-1:2004, 4.4.2.3(4): buildings of two or more storeys; (5): planes of frames; (6): not at the top.
    """
    return floors < 2 or floor >= floors or not frame_in_plane
