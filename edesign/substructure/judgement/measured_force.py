"""The numerical part of a test run again with a force that was measured, open loop."""

from __future__ import annotations

import numpy as np

from edesign.core.substructure import Recursion


def response_to_force(part: Recursion, force: np.ndarray, ground: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the target and the other outputs of a numerical part under a known force of the specimen.

    Args:
        part: recursion of a main step.
        force: (n,) N of the specimen at main steps.
        ground: (n,) ground acceleration at main steps, m/s2.

    Returns:
        Target (n,) m; displacements of all degrees (n, n_degrees) m. Both are zero at the first step, at rest.
    """
    before = np.concatenate([[0.0], force[:-1]])
    ahead = np.append(ground[1:], ground[-1])
    inputs = np.column_stack([force, before, ground, ahead])
    driven, direct = inputs @ part.B.T, inputs @ part.D.T
    outputs = np.zeros((force.size, len(part.C)))
    state = np.zeros(len(part.A))
    for k in range(force.size - 1):
        outputs[k + 1] = part.C @ state + direct[k]
        state = part.A @ state + driven[k]
    return outputs[:, 0].copy(), outputs[:, 3:].copy()
