"""What the loop found: the models compared, the effects adopted with their evidence, and those refused."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from edesign.calibrate.evidence import Evidence, Judged
from edesign.calibrate.problem import Candidate
from edesign.calibrate.result import Coverage, Ending

Refused = tuple[tuple[Candidate, Evidence], ...]
"""The effects that came nearest to being adopted in the last round, with the evidence."""


@dataclass(frozen=True, eq=False)
class Adopted:
    """An effect of the final model.

    Attributes:
        candidate: the form.
        values: (p,) of its parameters, SI.
        evidence: for the model with it against the model without.
        without: the model without it, fitted again.
        alike: models, by the name of the effect in its place, that the tests cannot tell from the one with it.
    """

    candidate: Candidate
    values: np.ndarray
    evidence: Evidence
    without: Judged
    alike: Mapping[str, Judged]


@dataclass(frozen=True, eq=False)
class Hypothesis:
    """An effect that the search found, and that is no part of the final model.

    Attributes:
        adopted: the effect, with the model without it.
        model: the one with it.
        why: it is none, for people.
    """

    adopted: Adopted
    model: Judged
    why: str


@dataclass(frozen=True, eq=False)
class Selection:
    """What the loop found.

    Attributes:
        declared: the model as it was declared.
        refit: the same with its parameters fitted: the rival of every effect.
        final: the model with effects.
        adopted: the effects, in the order of adoption.
        refused: what came nearest to being adopted.
        ending: how the search came to its end.
        hypotheses: effects that were found, and that the tests do not bear out.
        coverage: forms of effects that were looked at beside the final model.
    """

    declared: Judged
    refit: Judged
    final: Judged
    adopted: tuple[Adopted, ...]
    refused: Refused = ()
    ending: Ending = "complete"
    hypotheses: tuple[Hypothesis, ...] = ()
    coverage: Coverage = field(default_factory=Coverage)

    @property
    def law_held(self) -> bool:
        """Whether the law keeps its declared parameters beside the effects."""
        return self.final.fitted.model.held
