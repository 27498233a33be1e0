"""Forces of a law with its effects in tests, in series with a rig: campaigns of the C core."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np

from edesign.calibration.dampers.mechanisms import RigValues
from edesign.calibration.dampers.motion import Motion
from edesign.core import CampaignTest, CoreError, SeriesRig, campaign_forces
from edesign.core.damper import CoreDamper, EffectValues
from edesign.damper.history import Extremes
from edesign.damper.law import Law
from edesign.estimation.model import PredictionError

LONG = 1e9
"""s: a rest after which heat has gone and all has healed that does so in time."""


@dataclass(frozen=True)
class LawTest:
    """A law in a test.

    Attributes:
        law: its name.
        values: parameters in the order of the core, SI.
        effects: beside or on it.
        rig: in series with it; None: nothing.
        prior_extremes: extremes that the specimen went through before.
        rest: s since the test before.
        keeps_extremes: whether extremes go on from the test before, as the specimen had them behind its rig.
    """

    law: str
    values: tuple[float, ...]
    effects: tuple[EffectValues, ...]
    rig: RigValues | None
    prior_extremes: Extremes
    rest: float = LONG
    keeps_extremes: bool = False


Run = tuple[tuple[LawTest, Motion], ...]
"""Tests of one specimen in their order, each with its motion: effects go on from one to the next."""


def forces(runs: Sequence[Run], threads: int, length: float) -> list[list[np.ndarray] | PredictionError]:
    """Return the force (n,) N in each test of each run, or why there is none.

    Runs with the same motions and rig are one call of the core.

    Args:
        runs: that do not depend on each other.
        threads: at most so many.
        length: of a deformation in which the law changes, m: sub-steps of laws without an exact step go by it.
    """
    together: dict[Hashable, list[int]] = {}
    for i, run in enumerate(runs):
        alone = len(run) == 1
        key = tuple((id(of), one.rig, LONG if alone else one.rest, one.keeps_extremes) for one, of in run)
        together.setdefault(key, []).append(i)
    groups = list(together.values())
    out: list[list[np.ndarray] | PredictionError] = [PredictionError("not predicted")] * len(runs)
    across = threads > 1 and len(groups) >= threads

    def predict(group: list[int]) -> list[list[np.ndarray] | PredictionError]:
        return _together([runs[i] for i in group], 1 if across else threads, length)

    if across:
        with ThreadPoolExecutor(threads) as pool:
            found = list(pool.map(predict, groups))
    else:
        found = [predict(group) for group in groups]
    for group, of_group in zip(groups, found, strict=True):
        for i, one in zip(group, of_group, strict=True):
            out[i] = one
    return out


def _together(runs: Sequence[Run], threads: int, length: float) -> list[list[np.ndarray] | PredictionError]:
    """Return the forces of runs with the same motions and rig."""
    dampers: dict[int, list[CoreDamper]] = {}
    out: list[list[np.ndarray] | PredictionError] = []
    for i, run in enumerate(runs):
        try:
            dampers[i] = [
                CoreDamper(one.law, one.values, effects=one.effects, prior_extremes=one.prior_extremes)
                for one, _ in run
            ]
            out.append([])
        except CoreError as error:
            out.append(PredictionError(str(error)))
    if not dampers:
        return out
    tests, own = [], []
    for k, (test, motion) in enumerate(runs[0]):
        whole = motion.with_onset if test.rig is None else None
        driven = motion if whole is None else whole[0]
        own.append(slice(motion.preceded, None) if whole is None else whole[1])
        rig = None if test.rig is None else SeriesRig(**test.rig._asdict())
        tests.append(
            CampaignTest(
                driven.time,
                driven.displacement,
                driven.velocity,
                rig=rig,
                rest=test.rest,
                dampers=[of_run[k] for of_run in dampers.values()],
            )
        )
    try:
        found = campaign_forces(
            [of_run[0] for of_run in dampers.values()],
            tests,
            "fixed",
            length=length,
            carry=runs[0][0][0].keeps_extremes or ("effects" if len(tests) > 1 else False),
            threads=threads,
        )
    except CoreError as error:
        return [PredictionError(str(error))] * len(runs)
    for at, i in enumerate(dampers):
        failed = found.failed.get(at)
        out[i] = (
            [np.ascontiguousarray(force[at][of]) for force, of in zip(found.force, own, strict=True)]
            if failed is None
            else PredictionError(failed)
        )
    return out


def length_of(law: Law, values: Mapping[str, float], force: float, displacement: float) -> float:
    """Return the deformation in which a law changes, m: the least that its parameters name, as that at yield.

    Args:
        values: its parameters by name, SI.
        force: largest of the tests, N; taken where the law has a stiffness and no force.
        displacement: largest of the tests, m; nothing finer than a thousandth of it counts, nothing coarser either.
    """
    of_unit: dict[str, list[float]] = {}
    for one in law.all_parameters(values):
        if values[one.name] > 0.0:
            of_unit.setdefault(one.unit, []).append(values[one.name])
    yielding = [f / k for f in of_unit.get("N", [force]) for k in of_unit.get("N/m", [])]
    lengths = [*of_unit.get("m", []), *yielding, displacement]
    return max(min(lengths), 1e-3 * displacement)


def accepted(law: Law, values: Mapping[str, float], effects: Sequence[EffectValues]) -> bool:
    """Say whether the core takes effects with a law.

    Args:
        values: its parameters by name, in the order of the core, SI.
        effects: beside or on it.
    """
    try:
        CoreDamper(law.name, tuple(values.values()), effects=effects)
    except CoreError:
        return False
    return True
