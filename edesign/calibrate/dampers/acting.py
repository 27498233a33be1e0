"""What the parts of a model make of the law's force in a test: factors, and forces beside it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from edesign.calibrate.dampers.effect import BESIDE, DASHPOTS, Form, Memory
from edesign.calibrate.dampers.inside import relaxed_factor, relaxed_force
from edesign.calibrate.dampers.trial import Motion, Trial, Values
from edesign.calibrate.problem import Part

_MOVED = 1e-3  # of the largest deformation, by which differences for springs are taken


@dataclass
class Acting:
    """A part in one prediction of the campaign: its form, parameters and fixed numbers, what it remembers."""

    form: Form
    p: Values
    memory: Memory

    @staticmethod
    def of(part: Part) -> Acting:
        """With nothing to remember yet."""
        candidate, values = part
        form, fixed = candidate.effect
        p: dict[str, Any] = {u.name: float(v) for u, v in zip(candidate.unknowns, values, strict=True)}
        return Acting(form, {**p, **fixed}, {})


@dataclass(frozen=True)
class LawForce:
    """Force of a law in a test, and what it would be.

    Attributes:
        whole: (n,) N.
        relaxes: time in which the law relaxes all its forces, s; None: it does not.
        springs: (n,) N without dashpots; itself where the law cannot be told apart.
        powerless: (n,) N without the dashpot of a power of the velocity.
        at_rate: (n,) N with a gamma_T that is so many times as large.
    """

    whole: np.ndarray
    relaxes: float | None
    springs: Callable[[], np.ndarray]
    powerless: Callable[[], np.ndarray]
    at_rate: Callable[[float], np.ndarray]


@dataclass
class Changed:
    """What parts make of the law's force: factors of all of it, of its springs, its dashpots and that of a power of the
    velocity, and forces beside it.
    """

    factor: np.ndarray | float = 1.0
    springs: np.ndarray | float = 1.0
    dashpots: np.ndarray | float = 1.0
    power: np.ndarray | float = 1.0
    parallel: np.ndarray | float = 0.0
    splits: bool = False

    @property
    def still(self) -> bool:
        """Whether they do the same whatever the motion."""
        return isinstance(self.factor, float) and isinstance(self.parallel, float)

    def sides(self, law: LawForce) -> list[tuple[np.ndarray | float, np.ndarray]]:
        """Parts (n,) N of the law's force that have factors of their own, and these: they add (factor - 1) of them."""
        found: list[tuple[np.ndarray | float, np.ndarray]] = []
        if self.splits:
            springs = law.springs()
            found += [(self.springs, springs), (self.dashpots, law.whole - springs)]
        if not isinstance(self.power, float):
            found.append((self.power, law.whole - law.powerless()))
        return found


def changed_by(acting: Sequence[Acting], trial: Trial, motion: Motion, law: LawForce) -> Changed:
    """What parts make of the law's force; what they do to its springs and dashpots apart stands beside it.

    What acts inside the law comes through its relaxation; what counts work counts that of the whole specimen.
    """
    law_force, relaxes = law.whole, law.relaxes
    found = Changed()
    inside: np.ndarray | float | None = None
    for part in acting:
        form = part.form
        beside = form.parallel(part.p, trial, motion, part.memory)
        if beside is not None and form.inside and relaxes is not None:
            inside = beside if inside is None else inside + beside
        elif beside is not None:
            found.parallel = found.parallel + beside
        if not form.counts_work:
            factor = form.factor(part.p, trial, motion, law_force, part.memory)
            _multiply(found, part, motion, law_force, factor, relaxes)
    if inside is not None and relaxes is not None:
        found.parallel = found.parallel + relaxed_force(motion, np.broadcast_to(inside, law_force.shape), relaxes)
    for part in acting:
        if part.form.counts_work:
            part.memory[BESIDE] = found.parallel
            if part.form.spares_loss:
                part.memory[DASHPOTS] = found.factor * found.dashpots * (law_force - law.springs())
            factor = part.form.factor(part.p, trial, motion, found.factor * _of_sides(law, found), part.memory)
            _multiply(found, part, motion, law_force, factor, relaxes)
            heated = part.form.heated(part.p, motion, law.at_rate, part.memory)
            found.parallel = found.parallel if heated is None else found.parallel + heated
    found.parallel = found.parallel + found.factor * _beside_of_sides(motion, law, found)
    return found


def _of_sides(law: LawForce, changed: Changed) -> np.ndarray:
    """Force (n,) N of the law with the factors of its sides; they are slow beside its relaxation, which is left out."""
    return sum(((own - 1.0) * side for own, side in changed.sides(law)), start=law.whole)


def _beside_of_sides(motion: Motion, law: LawForce, changed: Changed) -> np.ndarray | float:
    """What factors of springs and dashpots apart add to the law's force (n,) N, inside its relaxation if it has one."""
    sides = changed.sides(law)
    if law.relaxes is None:
        return sum(((own - 1.0) * side for own, side in sides), start=0.0)
    relaxed = (relaxed_factor(motion, np.broadcast_to(own, side.shape), side, law.relaxes) for own, side in sides)
    return sum(relaxed, start=0.0)


def _multiply(
    found: Changed,
    part: Acting,
    motion: Motion,
    law_force: np.ndarray,
    factor: np.ndarray | float | None,
    relaxes: float | None,
) -> None:
    """Take a factor (n,) of a part where it acts."""
    form = part.form
    if factor is None:
        return
    if form.inside and relaxes is not None:
        whole = np.broadcast_to(factor, law_force.shape)
        found.parallel = found.parallel + relaxed_factor(motion, whole, law_force, relaxes)
    elif form.of_power:
        found.power = found.power * factor
    elif form.spares_loss:
        found.springs = found.springs * form.spring_factor(part.p, factor)
        found.dashpots = found.dashpots * form.dashpot_factor(part.p, motion, factor)
        found.splits = True
    else:
        found.factor = found.factor * form.spring_factor(part.p, factor)


def spring_beside(acting: Sequence[Acting], trial: Trial, motion: Motion, beside: np.ndarray | float) -> np.ndarray:
    """Stiffness (n,) N/m, at least 0, with which forces (n,) N beside the law go with the deformation: that of springs
    among the parts at each deformation, and of the rest on average.
    """
    u = motion.displacement
    step = _MOVED * max(float(np.max(np.abs(u))), 1e-300)
    here, further = (_elastic_force(trial, one, acting) for one in (motion, replace(motion, displacement=u + step)))
    swing = u - u.mean()
    rest = float(swing @ (beside - here)) / max(float(swing @ swing), 1e-300)
    return np.maximum((further - here) / step + rest, 0.0)


def _elastic_force(trial: Trial, motion: Motion, acting: Sequence[Acting]) -> np.ndarray:
    """Force (n,) N of the springs among parts."""
    total = np.zeros_like(motion.displacement)
    for part in acting:
        force = part.form.parallel(part.p, trial, motion, {}) if part.form.elastic else None
        total = total if force is None else total + force
    return total
