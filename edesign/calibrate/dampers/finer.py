"""Finer forms of effects that were found: another curve of the softening, dashpots with one of their own, heat that was
there before a test. They are no candidates of a search, as each may take for its own what other effects do; each holds
the form it is finer than as a special case.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.left import Left
from edesign.calibrate.dampers.library import candidate_of
from edesign.calibrate.dampers.trial import Sizes, Values
from edesign.calibrate.problem import Candidate, Part
from edesign.calibrate.unknown import Unknown

_CURVE, _MOST = 3.0, 30.0  # of a softening s that is not much more than its square: usual, largest
_SHARE = Unknown("l", "", -3.0, 10.0, 1.0)  # of dashpots in a softening


def finer(part: Part, sizes: Sizes, splits: bool) -> tuple[Part, ...]:
    """Finer forms of an effect, with the values of their parameters at which they do what it does.

    Args:
        part: the effect with its values, SI.
        sizes: of the campaign.
        splits: whether springs and dashpots of the law can be told apart.
    """
    candidate, values = part
    form: Form = candidate.effect[0]
    known = {unknown.name: float(v) for unknown, v in zip(candidate.unknowns, values, strict=True)}
    found = []
    if splits and (other := shared(form)) is not None:
        found.append((other, {**known, "l": known.get("loss", 1.0)}))
    if (other := shaped(form, splits)) is not None:
        found.append((other, _as_shaped(known)))
    found += [(other, known) for other in form.finer()]
    return tuple(own for form, known in found if (own := _part(form, known, sizes)) is not None)


def _part(form: Form, known: Mapping[str, float], sizes: Sizes) -> Part | None:
    candidate: Candidate | None = candidate_of(form, sizes, Left())
    if candidate is None:
        return None
    begun = {unknown.name: v for unknown, v in zip(candidate.unknowns, candidate.starts[0], strict=True)}
    return replace(candidate, finer=True), np.array([{**begun, **known}[u.name] for u in candidate.unknowns])


def shared(form: Form) -> Form | None:
    """A factor 1 + s of which dashpots have a share of their own: 1 + l s; None: the form is no such factor."""
    if not _may_be_shaped(form):
        return None

    def dashpot_factor(p: Values, motion: object, factor: np.ndarray | float) -> np.ndarray | float:
        return 1.0 + p["l"] * (factor - 1.0)

    sides = {"spares_loss": True, "dashpot_factor": dashpot_factor}
    return _more(form, "shared", "dashpots by a share of it", (_SHARE,), (1.0,), **sides)


def shaped(form: Form, splits: bool) -> Form | None:
    """A factor 1 + s of another curve: springs 1 + s + s2 s^2, dashpots 1 + l s + l2 s^2; None: the form is no such
    factor, or has a curve.

    Phenomenological: the first two terms of any course of the softening with its state.
    """
    if not _may_be_shaped(form):
        return None

    def curve(name: str) -> Unknown:
        return Unknown(name, "", -_MOST, _MOST, _CURVE)

    def spring_factor(p: Values, factor: np.ndarray | float) -> np.ndarray | float:
        s = factor - 1.0
        return 1.0 + s + p["s2"] * s**2

    def dashpot_factor(p: Values, motion: object, factor: np.ndarray | float) -> np.ndarray | float:
        s = factor - 1.0
        return 1.0 + p["l"] * s + p["l2"] * s**2

    more = (curve("s2"), *((_SHARE, curve("l2")) if splits else ()))
    sides = {"spares_loss": splits, "spring_factor": spring_factor, "dashpot_factor": dashpot_factor}
    return _more(form, "shaped", "along a curve of its own", more, (0.0, 1.0, 0.0)[: len(more)], **sides)


def _may_be_shaped(form: Form) -> bool:
    if form.kind != "damper" or type(form).factor is Form.factor or not form.may_be_shaped:
        return False
    return not (type(form).spares_loss or form.spares_springs)  # dashpots of their own already


def _more(
    form: Form, ending: str, title: str, more: tuple[Unknown, ...], begun: tuple[float, ...], **sides: Any
) -> Form:
    """A variant with more parameters, begun where they do nothing."""
    plain = type(form)()
    own_unknowns, own_starts = plain.unknowns, plain.starts

    def unknowns(sizes: Sizes) -> tuple[Unknown, ...]:
        own = own_unknowns(sizes)
        return (*own, *more) if own else ()

    def starts(sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((*row, *begun) for row in own_starts(sizes))

    nested: dict[str, Any] = {"simpler": lambda p: ((plain, p),)}
    return plain.variant(ending, title, may_be_shaped=False, unknowns=unknowns, starts=starts, **nested, **sides)


def _as_shaped(known: Mapping[str, float]) -> dict[str, float]:
    """Values of the form `shaped` of those of the plain one, or of the one with the exponent `loss` of the dashpots."""
    loss = known.get("loss", 1.0)
    return {**known, "l": loss, "l2": 0.5 * loss * (loss - 1.0)}
