"""Pairs of effects worth a fit: what two signatures could explain together, where one alone hides the other."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from edesign.calibrate.fit import Fitted
from edesign.calibrate.search.screening import Screen, Signature

_DEPENDENT = 1e-10  # of the squared size of the columns: below it they tell the same


def likely_pairs(fitted: Fitted, signatures: Sequence[Signature], most: int) -> list[tuple[Signature, Signature]]:
    """Pairs of two effects that could explain most, in the forms that suit best, the best first."""
    gains = joint_gains(fitted, signatures)
    best: dict[frozenset[str], tuple[Signature, Signature]] = {}
    for i, j in sorted(gains, key=lambda pair: -gains[pair]):
        a, b = signatures[i], signatures[j]
        if a.candidate.name != b.candidate.name:
            best.setdefault(frozenset((a.candidate.name, b.candidate.name)), (a, b))
    return list(best.values())[:most]


def joint_gains(fitted: Fitted, signatures: Sequence[Signature]) -> dict[tuple[int, int], float]:
    """Reduction of chi2 that every two of some effects could bring, linear about their starts."""
    if not signatures:
        return {}
    whole = Screen(fitted)
    residual = whole.free(whole.residual)
    columns = [
        signature.columns / np.maximum(np.linalg.norm(signature.columns, axis=0), 1e-300) for signature in signatures
    ]
    ends = np.cumsum([0, *(own.shape[1] for own in columns)])
    all_ = np.hstack(columns)
    products, with_residual = all_.T @ all_, all_.T @ residual
    found = {}
    for i, j in itertools.combinations(range(len(columns)), 2):
        own = np.r_[ends[i] : ends[i + 1], ends[j] : ends[j + 1]]
        share = np.linalg.lstsq(products[np.ix_(own, own)], with_residual[own], rcond=_DEPENDENT)[0]
        found[i, j] = float(share @ with_residual[own])
    return found
