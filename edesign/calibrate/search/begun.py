"""Forms of effects beside each other: begun alike, one begun where another stands, and which may stand together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from edesign.calibrate.fit import Fitted
from edesign.calibrate.problem import Candidate, Part
from edesign.calibrate.search.screening import Signature


def others_than(effects: Sequence[Candidate], effect: Candidate) -> tuple[Candidate, ...]:
    """Effects of a model without one. Forms are told by their labels: models fitted before, or in another process, may
    have the same form with starts of its own.
    """
    return tuple(other for other in effects if other.label != effect.label)


def begun_from(fitted: Fitted, effect: Candidate, signature: Signature) -> Signature | None:
    """Another form of an effect begun where this one is; None: it has not all of its parameters, or the model has no
    such effect.
    """
    known = next((part for part in fitted.parts if part[0].label == effect.label), None)
    other = signature.candidate
    if known is None or not {u.name for u in known[0].unknowns} <= {u.name for u in other.unknowns}:
        return None
    parts = [part for part in fitted.parts if part[0].label != effect.label]
    own = _values_of(other, known)
    return replace(signature, start=signature.model.coordinates(fitted.base, [*parts, (other, own)]))


def begun_at(effect: Candidate, known: Part) -> Part | None:
    """A form that has some of the parameters of another, at their values; None: it has others, or all of them."""
    if not {u.name for u in effect.unknowns} < {u.name for u in known[0].unknowns}:
        return None
    return effect, _values_of(effect, known)


def begin_alike(candidate: Candidate, other: Candidate) -> bool:
    """Whether two candidates of one form have the same unknowns and starts."""
    return candidate.starts == other.starts and candidate.unknowns == other.unknowns


def _values_of(effect: Candidate, known: Part) -> np.ndarray:
    """Values of a form's parameters: those of another form where it has them, else usual ones."""
    values = {unknown.name: float(value) for unknown, value in zip(known[0].unknowns, known[1], strict=True)}
    return np.array([values.get(unknown.name, unknown.size) for unknown in effect.unknowns])


def may_join(candidate: Candidate, others: Sequence[Candidate]) -> bool:
    """Whether a form may stand beside others: a second one of the same effect may, to follow its shape more closely,
    unless a finer form does.
    """
    alike = [other for other in others if other.name == candidate.name]
    return len(alike) < 2 and all(other.label != candidate.label and not other.finer for other in alike)
