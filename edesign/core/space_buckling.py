"""Buckling shapes of space frames, sought among given shapes and what axial forces make of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from edesign.core.space import SpaceModel

SETTLED = 0.02
"""Residual of a shape over its size at which it counts as found. A critical factor lies so near to its factor; where
others are further away, it is much nearer: by the square of this over their distance (Kato & Temple)."""
ROUNDING = 1e-10
"""Square of a new shape over that of the largest one, below which it is rounding of shapes that are there."""

SLOW = 8
"""Rounds after which no more are made of a frame that does not stand, as a wanted shape has a factor below 1. Where
members buckle long before a storey sways, hundreds of shapes stand between, and rounds go on without end. Shapes of
frames that stand settle in two or three."""


@dataclass(frozen=True)
class BucklingShapes:
    """Shapes in rising order of their factors, of which each is K-orthogonal to the others, with the strain energy 1/2.

    Attributes:
        factor: (r,) critical factors of the axial forces; infinite where these stabilise.
        of_start: (r, k) how much of each start shape there is in it. The squares add up to the share of its strain
            energy that start shapes have.
    """

    factor: np.ndarray
    of_start: np.ndarray


def buckling_shapes(
    model: SpaceModel,
    axial: np.ndarray,
    start: np.ndarray,
    wanted: Callable[[BucklingShapes], list[int]],
    exact_below: float,
) -> BucklingShapes:
    """Return the buckling shapes that Ritz's method finds among start shapes phi, A phi, and A^n of wanted ones.

    A = K^-1 (-K_G) gives the deflections that the axial forces cause by way of a shape; those of members between their
    nodes are in it (P-small-delta). Shapes that no start shape has a share in, such as of a column on hinges, are not
    found. Shapes are added until the residuals of the wanted ones are below `SETTLED` of their size. A wanted shape
    whose residual proves a factor of `exact_below` or more may be left before; its factor is then the least that the
    residual allows. So are, after `SLOW` rounds, those of a frame of which a wanted shape has a factor below 1.

    Args:
        axial: (m,) N, tension positive.
        start: (k, n_equations) K-orthonormal shapes.
        exact_below: factors from here on need not be exact.

    Raises:
        CoreError: a force is not finite.

    Source: Parlett (1998), The Symmetric Eigenvalue Problem, chapters 11 and 13: Ritz values, their residuals, Krylov
    spaces of blocks.
    """
    k = len(start)
    basis = _Basis(model, axial, 2 * k)
    given = np.zeros((k, basis.V.shape[1]))
    given[:, : model.n_equations] = start
    basis.append(given)
    rounds = 0
    while True:
        inverse, shapes = np.linalg.eigh(basis.T)
        inverse, shapes = inverse[::-1], shapes[:, ::-1]
        factor = np.divide(1.0, inverse, out=np.full(inverse.size, np.inf), where=inverse > 0.0)
        found = BucklingShapes(factor, shapes[:k].T)
        decide = np.array(wanted(found), dtype=int)
        asked = decide if rounds else np.arange(k)
        of, size = shapes[:, asked].T, inverse[asked]
        images = of @ basis.G_V
        moved = basis.deflections(images)
        gram = images @ moved.T - np.diag(size**2)
        rest = np.sqrt(np.maximum(np.diag(gram), 0.0))
        counts, unsettled = size + rest > 1.0 / exact_below, rest > SETTLED * np.abs(size)
        if not rounds:  # whatever may have a small factor
            counts[decide] = True
        counts &= unsettled
        if rounds >= SLOW and (size[~unsettled] > 1.0).any():
            counts[:] = False  # the frame does not stand: its further factors need not be exact
        residuals = moved[counts] - size[counts, None] * (of[counts] @ basis.V)
        if not basis.append_orthogonal(residuals, gram[np.ix_(counts, counts)]):
            proved = np.isin(asked, decide) & unsettled
            factor[asked[proved]] = 1.0 / (size + rest)[proved]
            return found
        rounds += 1


class _Basis:
    """K-orthonormal shapes V that grow, with their images -K_G V and T = V (-K_G) V; `room`: for how many at first."""

    def __init__(self, model: SpaceModel, axial: np.ndarray, room: int) -> None:
        self._model, self._axial = model, axial
        self._rows = np.empty((2, room, model.shape_length(axial)))
        self.V = self.G_V = self._rows[0, :0]
        self.T = np.zeros((0, 0))

    def append(self, shapes: np.ndarray) -> None:
        """Add shapes that are K-orthonormal to all."""
        old, count = len(self.V), len(self.V) + len(shapes)
        if count > self._rows.shape[1]:
            self._rows = np.concatenate([self._rows, np.empty_like(self._rows)], axis=1)
        self._rows[0, old:count] = shapes
        self._model.geometric(self._axial, shapes, self._rows[1, old:count])
        self.V, self.G_V = self._rows[:, :count]
        T, across = np.empty((count, count)), self.V @ self.G_V[old:].T
        T[:old, :old], T[:, old:], T[old:, :old] = self.T, across, across[:old].T
        self.T = 0.5 * (T + T.T)

    def append_orthogonal(self, shapes: np.ndarray, gram: np.ndarray) -> bool:
        """Add shapes that are K-orthogonal to all, as Ritz's method leaves residuals; say whether there was any.

        `gram`: products of the shapes with K.
        """
        if not len(shapes):
            return False
        squares, turned = np.linalg.eigh(0.5 * (gram + gram.T))
        new = squares > ROUNDING * squares[-1]
        self.append((turned[:, new] / np.sqrt(squares[new])).T @ shapes)
        return bool(new.any())

    def deflections(self, forces: np.ndarray) -> np.ndarray:
        """Return K^-1 times forces on equations and bows."""
        moved = forces.copy()
        n = self._model.n_equations
        moved[:, :n] = self._model.solve(forces[:, :n])
        return moved
