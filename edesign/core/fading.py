"""Histories that fade from sample to sample, computed by the core."""

from __future__ import annotations

import numpy as np

from edesign.core._edcore import ffi, lib


def fading(decay: np.ndarray, made: np.ndarray, before: complex) -> np.ndarray:
    """Return q (n,) with q_0 = before, q_i = decay_i q_(i-1) + made_i; what is not finite is passed on.

    Args:
        decay: (n - 1,) share of q that is left after each step, real or complex.
        made: (n - 1,) contribution of each step, real or complex, in the unit of q.
        before: q of the first sample.

    Returns:
        q (n,), complex where an argument is.

    Raises:
        ValueError: they are not equally long.
    """
    if decay.shape != made.shape:
        raise ValueError(f"{decay.size} decays and {made.size} contributions")
    kind = complex if np.iscomplexobj(decay) or np.iscomplexobj(made) or isinstance(before, complex) else float
    found = np.empty(decay.size + 1, dtype=kind)
    decay, made = (np.ascontiguousarray(values, dtype=kind) for values in (decay, made))
    of = [ffi.from_buffer("double[]", values) for values in (decay, made, found)]
    if kind is float:
        lib.ed_fading(found.size, of[0], of[1], before, of[2])
    else:
        lib.ed_fading_complex(found.size, of[0], of[1], [before.real, before.imag], of[2])
    return found
