"""What a refit of the law's own parameters leaves of an effect: some effects look like another law."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from blind import law
from blind.effects.base import Histories
from blind.law import Parameters
from blind.programme import Trial
from blind.size import nrms

STEPS = 3
FARTHEST = 0.7  # of a logarithm, in one step
FREE = ("c1", "c_NL", "alpha", "k_a", "k_b", "u_ref", "c_a", "c_b", "v_ref")  # the others only enter with these


def left_after_refit(p: Parameters, tests: Sequence[Trial], x: Histories, force: Histories) -> float:
    """NRMS on the tests to validate after a fit of the parameters to the others (Gauss-Newton in logarithms).

    Args:
        p: true parameters at 20 degC, from which it starts.
        tests: all of a campaign.
        x: displacements as recorded (n,) mm, at all steps.
        force: likewise (n,) kN.
    """
    samples = [(t, u[:: t.every], f[:: t.every]) for t, u, f in zip(tests, x, force, strict=True)]
    # fed with samples only, the law errs a little: that is not the effect's doing
    bias = [
        _force(p, t, u) - _fine(p, t, y)[:: t.every] for t, u, y in zip(tests, (s[1] for s in samples), x, strict=True)
    ]
    corrected = [(t, u, f + b) for (t, u, f), b in zip(samples, bias, strict=True)]
    fits = [sample for sample in corrected if sample[0].use == "fit"]
    others = [sample for sample in corrected if sample[0].use != "fit"]
    q, best = dict(p), _error(p, fits)
    for _ in range(STEPS):
        base = np.concatenate([_force(q, t, u) for t, u, _ in fits])
        error = np.concatenate([f for _, _, f in fits]) - base
        slopes = [
            (np.concatenate([_force({**q, name: 1.01 * q[name]}, t, u) for t, u, _ in fits]) - base) / np.log(1.01)
            for name in FREE
        ]
        matrix = np.array(slopes) @ np.array(slopes).T
        matrix[np.diag_indices_from(matrix)] *= 1.0 + 1e-4
        step = np.clip(np.linalg.solve(matrix, np.array(slopes) @ error), -FARTHEST, FARTHEST)
        for _ in range(4):
            tried = {**q, **{name: q[name] * float(np.exp(s)) for name, s in zip(FREE, step, strict=True)}}
            value = _error(tried, fits)
            if value < best:
                q, best = tried, value
                break
            step = 0.3 * step
        else:
            break
    return _error(q, others)


def _force(p: Parameters, test: Trial, u: np.ndarray) -> np.ndarray:
    return law.force(law.at_temperature(p, test.temperature), u, test.h * test.every)


def _fine(p: Parameters, test: Trial, u: np.ndarray) -> np.ndarray:
    return law.force(law.at_temperature(p, test.temperature), u, test.h)


def _error(p: Parameters, samples: Sequence[tuple[Trial, np.ndarray, np.ndarray]]) -> float:
    return nrms([_force(p, t, u) - f for t, u, f in samples], [f for _, _, f in samples])
