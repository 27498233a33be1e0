"""A problem of the loop that is linear in everything, so that numpy's least squares knows all answers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from edesign.calibrate.evidence import Judged
from edesign.calibrate.fit import Model, fit
from edesign.calibrate.problem import Candidate, Kind, Part, Piece, Point, Use
from edesign.calibrate.unknown import Unknown


@dataclass(eq=False)
class LinearProblem:
    """Tests y = A b + sum of effects' columns times their parameters + noise.

    Attributes:
        matrices: (n_i, p) of each test.
        columns: of each effect (n_i,) of each test, by its name, or name.form.
        measured: (n_i,) of each test.
        own: of an effect, by its name, columns (n_i, k) of each test whose share is its own.
    """

    matrices: Sequence[np.ndarray]
    columns: dict[str, Sequence[np.ndarray]]
    measured: tuple[np.ndarray, ...]
    uses: tuple[Use, ...]
    names: tuple[str, ...] = ()
    base: tuple[Unknown, ...] = ()
    declared: np.ndarray = field(default_factory=lambda: np.empty(0))
    doubts: tuple[np.ndarray, ...] = ()
    weights: tuple[np.ndarray, ...] = ()
    fine: tuple[
        str, ...
    ] = ()  # columns that are finer forms of effects found, no candidates; name.form_more: of a form
    own: dict[str, Sequence[np.ndarray]] = field(default_factory=dict)
    instruments: tuple[str, ...] = ()  # effects of the measurement; the others are the damper's

    def __post_init__(self) -> None:
        count = self.matrices[0].shape[1]
        self.names = tuple(f"test {i}" for i in range(len(self.matrices)))
        self.base = tuple(Unknown(f"b{j}", "", -1e6, 1e6, 1.0) for j in range(count))
        self.declared = np.ones(count)

    def candidates(self, residuals: Sequence[np.ndarray]) -> tuple[Candidate, ...]:
        return tuple(
            Candidate(
                name, form or "only", self.kind(name), (Unknown("a", "", -1e6, 1e6, 1.0),), ((0.1,),), name + dot + form
            )
            for name, dot, form in (key.partition(".") for key in self.columns if key not in self.fine)
        )

    def kind(self, name: str) -> Kind:
        return "instrument" if name in self.instruments else "damper"

    @property
    def certain(self) -> LinearProblem:
        return replace(self, doubts=()) if self.doubts else self

    @property
    def coarse(self) -> LinearProblem:
        return self

    @property
    def rough(self) -> LinearProblem:
        return self

    def finer(self, part: Part) -> tuple[Part, ...]:
        candidate, values = part
        keys = [key for key in self.fine if key.split(".")[0] == candidate.name and key != candidate.effect]
        keys = [key for key in keys if "_" not in key or key.startswith(candidate.effect + "_")]
        return tuple((replace(candidate, form=key.split(".")[1], effect=key, finer=True), values) for key in keys)

    def elsewhere(self, part: Part) -> tuple[Candidate, ...]:
        """Forms whose columns are those of the effect in all tests that are fitted to."""
        given, fitted = self.columns[part[0].effect], [i for i, use in enumerate(self.uses) if use == "fit"]
        others = [key for key in self.columns if key.split(".")[0] == part[0].name and key != part[0].effect]
        same = [key for key in others if all(np.array_equal(self.columns[key][i], given[i]) for i in fitted)]
        return tuple(replace(part[0], form=key.partition(".")[2] or "only", effect=key) for key in same)

    def simpler(self, part: Part) -> tuple[Part, ...]:
        """There are none."""
        return ()

    def predict(self, base: np.ndarray, parts: Sequence[Part], uses: Sequence[Use]) -> list[np.ndarray | None]:
        found: list[np.ndarray | None] = []
        for i, (matrix, use) in enumerate(zip(self.matrices, self.uses, strict=True)):
            value = matrix @ base
            for candidate, values in parts:
                value = value + values[0] * self.columns[candidate.effect][i]
            found.append(value if use in uses else None)
        return found

    def nuisance(
        self, base: np.ndarray, parts: Sequence[Part], index: int, about: Point | None = None
    ) -> np.ndarray | None:
        columns = [self.own[candidate.name][index] for candidate, _ in parts if candidate.name in self.own]
        if not columns:
            return None
        weight = self.weight(index)
        return np.linalg.qr(np.hstack(columns) * (1.0 if weight is None else weight[:, np.newaxis]))[0]

    def judged(self, index: int) -> tuple[Piece, ...]:
        return (Piece(self.names[index], slice(None)),)

    def weight(self, index: int) -> np.ndarray | None:
        return self.weights[index] if self.weights else None

    def doubt(self, parts: Sequence[Part], index: int) -> np.ndarray | None:
        return self.doubts[index] if self.doubts else None

    def left(self, residuals: Sequence[np.ndarray], noise: Sequence[float]) -> float:
        return sum(float(r @ r) for r in residuals) / sum(r.size for r in residuals)


def linear(seed: int = 1, hidden: dict[str, float] | None = None, noise: float = 1.0, tests: int = 6) -> LinearProblem:
    """Six tests of 200 values with three parameters and effects x, y, z; `hidden` ones are in the data."""
    random = np.random.default_rng(seed)
    matrices = [random.standard_normal((200, 3)) for _ in range(tests)]
    columns = {name: [random.standard_normal(200) for _ in range(tests)] for name in "xyz"}
    truth = np.array([1.1, 0.8, 1.3])
    measured = []
    for i, matrix in enumerate(matrices):
        value = matrix @ truth + noise * random.standard_normal(200)
        for name, size in (hidden or {}).items():
            value = value + size * columns[name][i]
        measured.append(value)
    uses: tuple[Use, ...] = ("fit",) * (tests - 1) + ("validate",)
    return LinearProblem(matrices, columns, tuple(measured), uses)


def model_of(problem: LinearProblem, noise: float = 1.0) -> Model:
    """The model without effects."""
    return Model(problem, (noise,) * len(problem.names))


def of_labels(problem: LinearProblem, *labels: str) -> Judged:
    """The model with effects, fitted."""
    by_label = {c.label: c for c in problem.candidates([])}
    model = replace(model_of(problem), effects=tuple(by_label[label] for label in labels))
    return Judged(fit(model, model.coordinates()))
