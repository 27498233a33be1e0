"""What analyses in OpenSeesPy share: solvers, tests, Rayleigh factors, and steps with fallbacks."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import openseespy.opensees as ops
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class SolverOptions:
    """Equation solver, convergence test and numberer, by the names OpenSees gives them.

    system: BandGeneral | UmfPack | SparseGeneral | ProfileSPD | BandSPD | SparseSYM (the last three need a positive
    definite tangent); test: NormDispIncr | EnergyIncr | NormUnbalance...; tolerance: in the unit of the test
    (m and rad, J, N and Nm); max_iterations: of one attempt; algorithm: name and arguments, tried first in histories;
    norm: 0 the largest value, 2 the root of the sum of the squares; constraints: Plain, or Transformation where floors
    are rigid.
    """

    system: str = "BandGeneral"
    test: str = "NormDispIncr"
    tolerance: float = 1e-6
    max_iterations: int = 25
    numberer: str = "RCM"
    algorithm: tuple[str | float, ...] = ("Newton",)
    norm: int = 2
    constraints: str = "Plain"


def equations(solver: SolverOptions) -> None:
    """Set up the equations and the test of convergence of an analysis."""
    ops.constraints(solver.constraints)
    ops.numberer(solver.numberer)
    ops.system(solver.system)
    ops.test(solver.test, solver.tolerance, solver.max_iterations, 0, solver.norm)


def rayleigh_factors(omega: Sequence[float] | Array, ratio: float) -> tuple[float, float]:
    """Mass and stiffness factor (1/s, s) that give `ratio` at the circular frequencies omega[0], omega[1] (rad/s)."""
    w1, w2 = float(omega[0]), float(omega[1])
    return 2.0 * ratio * w1 * w2 / (w1 + w2), 2.0 * ratio / (w1 + w2)


class Stepper:
    """Advances the domain and keeps count; the fallbacks are Newton, KrylovNewton, two half steps, down to dt/256."""

    def __init__(self, dt: float, algorithm: tuple[str | float, ...] = ("Newton",), smallest: int = 256) -> None:
        self.dt, self.algorithm, self.smallest = dt, algorithm, smallest
        self.algorithms: tuple[tuple[str | float, ...], ...] = (("Newton",), ("KrylovNewton",))
        self.iterations = self.fallbacks = 0
        self.smallest_step = dt
        self.cpu_s = 0.0

    def run(self, n: int, dt: float) -> bool:
        start = time.process_time()
        status = ops.analyze(n, dt)
        self.cpu_s += time.process_time() - start
        return bool(status == 0)

    def one(self, dt: float, parts: int = 1, failed: tuple[str | float, ...] | None = None) -> bool:
        """One step of dt by the fallbacks; `failed`: one that has already failed at this dt."""
        for algorithm in self.algorithms:
            if algorithm == failed:
                continue
            ops.algorithm(*algorithm)
            if self.run(1, dt):
                self.smallest_step = min(self.smallest_step, dt)
                self.iterations += ops.testIter()
                return True
        return parts < self.smallest and all(self.one(0.5 * dt, 2 * parts) for _ in range(2))

    def rescue(self) -> bool:
        """One step of the record after the first algorithm has failed."""
        self.fallbacks += 1
        done = self.one(self.dt, failed=self.algorithm)
        ops.algorithm(*self.algorithm)
        return done

    def step(self) -> bool:
        """One step of the record."""
        if self.run(1, self.dt):
            self.iterations += ops.testIter()
            return True
        return self.rescue()
