"""Strain-consistent iteration: dampers of elastomer with the properties at the strain that they reach."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.envelopes import peak
from edesign.errors import InputError
from edesign.study.design.elastomer.material import Moduli
from edesign.study.design.elastomer.model import ElastomerModel, StrainStep, effective_strain
from edesign.study.design.relaxation import AGREEMENT, MOST_ITERATIONS, Relaxation

_LARGEST_STEP = math.log(2.0)  # of ln(strain); a secant through two steps that hardly differ may point anywhere

T = TypeVar("T")


@dataclass(frozen=True)
class AtStrain(Generic[T]):
    """A result with the elastomer's properties at one strain.

    Attributes:
        found: what it is.
        strain: at which the properties were taken.
        steps: on the way to it; none where the strain was given.
        reason: why the strain is not the one that is reached; empty if it is, or was given.
    """

    found: T
    strain: float
    steps: tuple[StrainStep, ...] = ()
    reason: str = ""


def history_strain(k_D: np.ndarray, histories: Iterable[Group]) -> float:
    """Return the effective strain of dampers in histories, from the mean of the peaks of completed histories.

    Args:
        k_D: storage stiffness of the damper at each place, (d,) N/m.
        histories: with damper_strain_max and damper_strain_min over (damper,).

    Returns:
        The strain; nan if no history was completed.
    """
    peaks = [
        found
        for group in histories
        if group.attributes.get("status", "completed") == "completed"
        and (found := peak(group, "damper_strain")) is not None
    ]
    return effective_strain(k_D, np.mean(peaks, axis=0)) if peaks else math.nan


def start_strain(model: ElastomerModel, thickness: float) -> float:
    """Return the strain at which properties are first taken.

    It is the strain of the design, or that of dampers without stiffness, at most `strain_limit`.

    Args:
        thickness: of a layer, m.
    """
    spec = model.spec
    if not isinstance(spec.strain, str):
        return spec.strain
    bare = model.estimated_strain(np.full(model.building.storeys.size, 1e-9), 0.0, thickness, braces=False)
    return bare if spec.strain_limit is None else min(bare, spec.strain_limit)


def at_consistent_strain(
    model: ElastomerModel,
    solve: Callable[[float], T],
    moduli: Callable[[T], Moduli],
    reached: Callable[[T], float],
    start: float,
) -> AtStrain[T]:
    """Solve at the strain of a design, or iterate until the assumed strain is the one that is reached.

    A strain with which no dampers do what is wanted is drawn towards the last one with which they did.

    Args:
        solve: solves with the properties at a strain.
        moduli: returns the elastomer's properties of a solution.
        reached: returns the effective strain of a solution.
        start: the strain of the design, or the first trial.

    Returns:
        The solution with its strain; with a `reason` where the iteration did not converge.

    Raises:
        InputError: no strain lets the dampers do what is wanted.
    """
    if not isinstance(model.spec.strain, str):
        return AtStrain(solve(start), start)
    strain, good, relax = start, 0.0, Relaxation()
    steps: list[StrainStep] = []
    wrong: InputError | None = None
    for _ in range(MOST_ITERATIONS):
        try:
            found = solve(strain)
        except InputError as error:
            wrong = error
            strain = math.sqrt(good * strain) if good > 0.0 else 0.5 * strain
            continue
        good = strain
        steps.append(StrainStep(strain, moduli(found), reached(found)))
        if abs(steps[-1].reached - strain) <= AGREEMENT * steps[-1].reached:
            return AtStrain(found, strain, tuple(steps))
        change = float(relax(np.log([strain]), np.log([steps[-1].reached]))[0]) - math.log(strain)
        strain *= math.exp(min(max(change, -_LARGEST_STEP), _LARGEST_STEP))
    if not steps:
        assert wrong is not None
        raise InputError(f"whatever the strain of the dampers, {wrong} [E-DESIGN-04]") from wrong
    last = steps[-1]
    reason = (
        f"the strain at which properties are taken ({100.0 * last.strain:.4g} %) and the one that is reached "
        f"({100.0 * last.reached:.4g} %) did not agree to {AGREEMENT:g} within {MOST_ITERATIONS} iterations"
    )
    if wrong is not None:
        reason += f"; on the way to it {wrong}"
    return AtStrain(found, last.strain, tuple(steps), reason)
