"""A problem of the search in a few lines of numpy: y = k u + c v of several tests, with effects beside."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from edesign.calibration.search.problem import Effect, Kind
from edesign.estimation.parameters import Parameter

Change = Callable[[np.ndarray, int, np.ndarray, np.ndarray], np.ndarray]
"""What an effect adds, of its values, the number of the test, u and v."""


def effect(
    name: str,
    form: str,
    change: Change,
    shapes: Sequence[tuple[float, Sequence[float]]] = (),
    nuisance: bool = False,
    kind: Kind = "damper",
    spread: float = 1.0,
) -> Effect:
    """Return an effect: a size N(0, spread), and positive shapes, each with its centre and its starts."""
    size = Parameter("a", "", -50.0, 50.0, 0.0, spread)
    others = [Parameter(f"s{i}", "", 1e-3, 1e3, centre, 1.5, True) for i, (centre, _) in enumerate(shapes)]
    starts = tuple((0.1, *row) for row in itertools.product(*(starts for _, starts in shapes)))
    if nuisance:
        return Effect(name, form, kind, (), ((),), False, True, change)
    return Effect(name, form, kind, (size, *others), starts, True, False, change)


CUBIC = effect("hardening", "cubic", lambda p, i, u, v: p[0] * u**3)
FIFTH = effect("hardening", "fifth", lambda p, i, u, v: p[0] * u**5)
DRAG = effect("drag", "square", lambda p, i, u, v: p[0] * v * np.abs(v))
DRY = effect("friction", "tanh", lambda p, i, u, v: p[0] * np.tanh(v / p[1]), [(0.1, (0.03, 0.3))])
GAIN = effect("gain", "from_3", lambda p, i, u, v: p[0] * (u + 0.3 * v) * (i >= 2), kind="instrument")
SIGNED = effect("offset", "constant", lambda p, i, u, v: p[0] + 0.0 * u, kind="instrument")
OWN = effect("zero", "each_own", lambda p, i, u, v: np.ones((u.size, 1)), nuisance=True, kind="instrument")
EFFECTS = (CUBIC, FIFTH, DRAG, DRY, GAIN, SIGNED, OWN)


@dataclass(frozen=True, eq=False)
class CurveProblem:
    """Tests of a spring and a dashpot.

    Attributes:
        effects: that it may lack.
        truth: effects with their values, that are in the data.
        noise: standard deviation.
        tests: number of them.
        seed: of motions and noise.
        zeros: standard deviation of a zero of each test.
        input_noise: share of the power that noise of the motion makes.
    """

    effects: tuple[Effect, ...] = EFFECTS
    truth: tuple[tuple[Effect, tuple[float, ...]], ...] = ()
    noise: float = 0.01
    tests: int = 5
    seed: int = 1
    zeros: float = 0.0
    input_noise: float = 0.0

    @cached_property
    def motions(self) -> list[tuple[np.ndarray, np.ndarray]]:
        """u and v (n,) of each test: sines of other amplitudes and rates."""
        rng = np.random.default_rng(self.seed)
        found = []
        for i in range(self.tests):
            rate, size = 1.0 + 0.6 * i, 0.4 + 0.6 * rng.random()
            t = np.linspace(0.0, 12.0, 300)
            found.append((size * np.sin(rate * t), size * rate * np.cos(rate * t)))
        return found

    @property
    def base(self) -> tuple[Parameter, ...]:
        """Stiffness and dashpot, declared 20 % off."""
        return (Parameter("k", "", 1e-3, 1e3, 0.8, 0.3, True), Parameter("c", "", 1e-3, 1e3, 0.36, 0.3, True))

    @cached_property
    def measured(self) -> tuple[np.ndarray, ...]:
        """y (n,) of each test."""
        rng = np.random.default_rng((self.seed, 1))
        values = np.array([1.0, 0.3, *(v for _, own in self.truth for v in own)])
        plain = self.forces([e for e, _ in self.truth], values)
        return tuple(y + self.noise * rng.standard_normal(y.size) + self.zeros * rng.standard_normal() for y in plain)

    @property
    def start(self) -> tuple[float, ...]:
        """What is declared."""
        return tuple(one.centre for one in self.base)

    @property
    def deviations(self) -> tuple[float, ...]:
        """Standard deviation of the noise of each test."""
        return (self.noise,) * self.tests

    @cached_property
    def sizes(self) -> tuple[float, ...]:
        """Root mean square of each test."""
        return tuple(float(np.sqrt(np.mean(y**2))) for y in self.measured)

    def forces(self, effects: Sequence[Effect], values: np.ndarray) -> list[np.ndarray]:
        """Predicted y (n,) of each test."""
        found = []
        for i, (u, v) in enumerate(self.motions):
            y, at = values[0] * u + values[1] * v, 2
            for one in effects:
                if not one.nuisance:
                    y = y + one.data(values[at : at + len(one.parameters)], i, u, v)
                at += len(one.parameters)
            found.append(y)
        return found

    def model(self, effects: Sequence[Effect]) -> CurveModel:
        """Return the model with effects."""
        return CurveModel(self, tuple(effects))


@dataclass(frozen=True, eq=False)
class CurveModel:
    """Spring and dashpot with effects."""

    problem: CurveProblem
    effects: tuple[Effect, ...]

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """Of the base, and of the effects."""
        return (*self.problem.base, *(one for effect in self.effects for one in effect.parameters))

    @property
    def measured(self) -> tuple[np.ndarray, ...]:
        """y (n,) of each test."""
        return self.problem.measured

    def predict(self, values: np.ndarray) -> list[list[np.ndarray]]:
        """Predicted y (n,) of each test, of each row."""
        return [self.problem.forces(self.effects, one) for one in values]

    def nuisance_columns(self, values: np.ndarray) -> list[np.ndarray | None]:
        """Columns (n, k) of the nuisance amplitudes of each test; None: there are none."""
        at, own = 2, list[tuple[Effect, np.ndarray]]()
        for one in self.effects:
            if one.nuisance:
                own.append((one, values[at : at + len(one.parameters)]))
            at += len(one.parameters)
        if not own:
            return [None] * self.problem.tests
        return [np.hstack([one.data(p, i, *both) for one, p in own]) for i, both in enumerate(self.problem.motions)]
