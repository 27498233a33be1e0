"""What the loop works on: tests with measured values, a base model that predicts them, and effects it may lack.

Damper tests, property tables and records of structures are problems of one form, and one loop serves them all."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, Protocol, Self

import numpy as np

from edesign.calibrate.unknown import Unknown

Kind = Literal["damper", "rig", "instrument", "structure"]
Use = Literal["fit", "validate"]
USUAL_GAIN = 0.03
"""Error of the gain of an instrument up to which it is in its class: class 3, the coarsest of testing machines (ISO
7500-1:2018, table 2). More is a fault that is seldom there, and that too few tests cannot tell from other things.
"""


@dataclass(frozen=True)
class Candidate:
    """One form of an effect that a model may lack.

    Attributes:
        name: of the effect.
        form: how it acts; an effect may have several forms.
        kind: whose it is.
        unknowns: its parameters.
        starts: values (SI) to start from, one row each; the first start is that of a typical size.
        effect: what the problem needs to predict with it.
        slow: whether predictions with it take many times longer, and others hardly change what it does: others are
            screened without it.
        beside_motion: whether it does what no motion does: much of a residual that it takes is its own, however few of
            the samples are independent.
        finer: whether it is a finer form of one that was found (`Problem.finer`).
        doubted: whether what it does depends on a condition in doubt (`Problem.doubt`).
        between_tests: whether it acts between tests: what it does to one follows from those before it, or from its
            place among them.
        usual: size of its first parameter, from where that does nothing, that is usual; more is an exception.
    """

    name: str
    form: str
    kind: Kind
    unknowns: tuple[Unknown, ...]
    starts: tuple[tuple[float, ...], ...]
    effect: Any
    slow: bool = False
    finer: bool = False
    beside_motion: bool = False
    doubted: bool = False
    between_tests: bool = False
    usual: float = math.inf

    @property
    def label(self) -> str:
        """Name and form."""
        return f"{self.name}.{self.form}"


@dataclass(frozen=True)
class Described:
    """What people and files are told of a form of an effect.

    Attributes:
        title: for people.
        signature: what it leaves in a residual, for people.
        amendment: form by which a law file carries it; "" if it cannot.
        fixed: numbers that are not searched, by name, SI.
    """

    title: str
    signature: str
    amendment: str = ""
    fixed: Mapping[str, float] = field(default_factory=dict)


Part = tuple[Candidate, np.ndarray]
"""An effect with the values (p,) of its parameters, SI."""

Point = tuple[np.ndarray, Sequence[Part]]
"""Values (p,) of the base model, SI, and effects."""


@dataclass(frozen=True)
class Piece:
    """What is judged of a test by itself: its samples, or those of one of its channels.

    Attributes:
        name: for people.
        samples: of the test.
        louder: its noise over that of the test.
    """

    name: str
    samples: slice
    louder: float = 1.0


class Problem(Protocol):
    """What the loop works on.

    Attributes:
        names: of the tests, in the order in which they were made.
        uses: of the tests.
        base: unknowns of the base model.
        declared: their values, SI.
        measured: (n_i,) of each test, at the rate at which models are fitted.
    """

    @property
    def names(self) -> tuple[str, ...]: ...

    @property
    def uses(self) -> tuple[Use, ...]: ...

    @property
    def base(self) -> tuple[Unknown, ...]: ...

    @property
    def declared(self) -> np.ndarray: ...

    @property
    def measured(self) -> tuple[np.ndarray, ...]: ...

    def candidates(self, residuals: Sequence[np.ndarray]) -> tuple[Candidate, ...]:
        """Effects the model may lack, with starts that suit residuals (n_i,) of the tests fitted to, in the unit of
        `measured`.
        """

    @property
    def certain(self) -> Problem:
        """The same with nothing in doubt; itself if nothing is."""

    @property
    def coarse(self) -> Problem:
        """The same predicted as coarsely as will do for what effects change; itself if it is always so."""

    @property
    def rough(self) -> Problem:
        """The same predicted as coarsely as will do to put models in order; itself if it is always so."""

    def finer(self, part: Part) -> tuple[Part, ...]:
        """Finer forms of an effect that was found, with the values at which they do what it does."""

    def elsewhere(self, part: Part) -> tuple[Candidate, ...]:
        """Forms that do what a part does to the tests that are fitted to, and something else to others."""

    def simpler(self, part: Part) -> tuple[Part, ...]:
        """Nested forms, of other effects too, that do what a part does where some of its parameters are at an end; with
        the values at which they come near to it.
        """

    def predict(self, base: np.ndarray, parts: Sequence[Part], uses: Sequence[Use]) -> list[np.ndarray | None]:
        """Predicted values (n_i,) of each test used so; None for the others.

        Raises:
            PredictionError: the model has no prediction for these values.
        """

    def nuisance(
        self, base: np.ndarray, parts: Sequence[Part], index: int, about: Point | None = None
    ) -> np.ndarray | None:
        """Orthonormal columns (n_i, k), weighted, whose share is each test's own, as the phase of hum is; None: there
        are none. What a test owes to how it started may be taken as it is about other values near these: how it
        changes is a term of second order.
        """

    def judged(self, index: int) -> tuple[Piece, ...]:
        """Pieces of a test, each of which a verdict asks; samples of none depend on how the test started."""

    def weight(self, index: int) -> np.ndarray | None:
        """Factors (n_i,) of the residuals of a test that make its noise as strong at all times, and 0 of samples that
        are not judged; None: they are 1.
        """

    def doubt(self, parts: Sequence[Part], index: int) -> np.ndarray | None:
        """What a condition of a test that is known only so well may change (n_i,), in the base model as declared and
        with the parts, by one standard deviation; None: nothing.
        """

    def left(self, residuals: Sequence[np.ndarray], noise: Sequence[float]) -> float:
        """Power of the residuals of the tests fitted to, in units of their noise, over that of noise; 1 where only
        noise is left.
        """


class AlwaysFine:
    """What a problem says that is always predicted as finely, in which nothing is in doubt or a test's own."""

    def nuisance(
        self, base: np.ndarray, parts: Sequence[Part], index: int, about: Point | None = None
    ) -> np.ndarray | None:
        """Nothing is a test's own."""
        return None

    def doubt(self, parts: Sequence[Part], index: int) -> np.ndarray | None:
        """Nothing is in doubt."""
        return None

    @property
    def certain(self) -> Self:
        """Nothing is in doubt."""
        return self

    @property
    def coarse(self) -> Self:
        """It is always as fine."""
        return self

    @property
    def rough(self) -> Self:
        """It is always as fine."""
        return self

    def finer(self, part: Part) -> tuple[Part, ...]:
        """There are none."""
        return ()

    def elsewhere(self, part: Part) -> tuple[Candidate, ...]:
        """There are none."""
        return ()

    def simpler(self, part: Part) -> tuple[Part, ...]:
        """There are none."""
        return ()


class PredictionError(Exception):
    """A model cannot predict with these parameters: the search goes elsewhere."""
