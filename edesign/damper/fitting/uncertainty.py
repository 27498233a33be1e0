"""Standard errors and correlation of fitted parameters, for white noise and for errors that hang together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from edesign.damper.fitting.loading import Loading

BLOCKS = 10  # of a test at most
LOOSE = 1e3
"""Condition of unit columns from which a combination of parameters is not told."""
_SMALLEST = 1e-9  # singular value, of the largest: what is below comes from errors of differences


@dataclass(frozen=True)
class Uncertainty:
    """Uncertainty of the n unknowns at the solution, as the data give it.

    Attributes:
        white: standard errors (n,) if errors of samples are independent, each test with its own variance.
        robust: standard errors (n,) with errors that hang together within blocks of tests.
        correlation: (n, n), robust where there are blocks enough, else of white noise.
        condition: of the derivatives with columns of unit length.
        loose: share (n,) of each unknown's variance that combinations have which the data do not tell (see LOOSE).
        blocks: how many.
    """

    white: np.ndarray
    robust: np.ndarray
    correlation: np.ndarray
    condition: float
    loose: np.ndarray
    blocks: int


def blocks_of(loadings: Sequence[Loading]) -> tuple[np.ndarray, np.ndarray]:
    """Return test and block of every sample: each test in at most ten blocks of one cycle or more.

    Errors of a model repeat with the cycles of the test, so shorter blocks would take them for independent.

    Args:
        loadings: of the tests.

    Returns:
        Number of the test and number of the block, (m,) each.
    """
    tests, blocks, first = [], [], 0
    for i, loading in enumerate(loadings):
        cycles = loading.frequency * float(loading.time[-1] - loading.time[0])
        count = min(BLOCKS, max(1, int(cycles)), loading.time.size)
        tests.append(np.full(loading.time.size, i))
        blocks.append(first + np.arange(loading.time.size) * count // loading.time.size)
        first += count
    return np.concatenate(tests), np.concatenate(blocks)


def uncertainty(
    jacobian: np.ndarray,
    residual: np.ndarray,
    tests: np.ndarray,
    blocks: np.ndarray,
    slopes: np.ndarray,
    loss_weight: np.ndarray | None = None,
) -> Uncertainty:
    """Return covariances at a solution of least squares.

    Args:
        jacobian: (m, n) derivatives of the residual to the coordinates.
        residual: (m,).
        tests: (m,) number of the test of every sample.
        blocks: (m,) number of the block of every sample.
        slopes: (n, n) derivatives of the unknowns to the coordinates.
        loss_weight: (m,) derivative of the loss; None: 1.

    Returns:
        Covariances of the unknowns, and what they rest on.

    Source: White (1980) with clusters: H^-1 (sum over blocks of g g^T) H^-1 with g = J_b^T r_b, times G / (G - n).
    """
    root = np.ones_like(residual) if loss_weight is None else np.sqrt(loss_weight)
    samples, n = jacobian.shape
    length = np.linalg.norm(jacobian, axis=0)
    length[length == 0.0] = 1.0
    # J = U S V^T: the covariance is V S^-1 (U^T C U) S^-1 V^T with C that of the errors, which is free of cancellation
    left, singular, vectors = np.linalg.svd(root[:, None] * jacobian / length, full_matrices=False)
    largest = max(float(singular[0]), 1e-300)
    error = root * residual
    middle_white = np.zeros((n, n))
    for i in np.unique(tests):
        part = tests == i
        middle_white += np.mean(error[part] ** 2) * samples / (samples - n) * left[part].T @ left[part]
    sums = np.zeros((int(blocks.max()) + 1, n))
    np.add.at(sums, blocks, left * error[:, None])
    count = sums.shape[0]
    spread = slopes / length @ (vectors.T / np.maximum(singular, _SMALLEST * largest))
    white = spread @ middle_white @ spread.T
    chosen, robust_error = white, np.full(n, np.nan)
    if count > 2 * n:
        chosen = spread @ (sums.T @ sums * count / (count - n)) @ spread.T
        robust_error = np.sqrt(np.diag(chosen))
    own = np.sqrt(np.maximum(np.diag(chosen), 1e-300))
    correlation = np.clip(chosen / np.outer(own, own), -1.0, 1.0)
    np.fill_diagonal(correlation, 1.0)
    loose = np.sum(spread[:, singular < largest / LOOSE] ** 2, axis=1)
    return Uncertainty(
        white=np.sqrt(np.diag(white)),
        robust=robust_error,
        correlation=correlation,
        condition=largest / max(float(singular[-1]), 1e-300),
        loose=loose / np.maximum(np.sum(spread**2, axis=1), 1e-300),
        blocks=count,
    )
