"""A campaign of virtual substructure tests: earthquakes in the loop and commands, under one rig."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.random import Generator

from blind.campaign import DRAWS, SMALLEST, SMALLEST_OF_TWO, Campaign, Hidden, draw_law, sized
from blind.effects import EFFECTS
from blind.effects.base import Effect, Histories
from blind.laboratory import observe
from blind.law import THICKNESS_MM, Parameters
from blind.noise import draw_noise, noisy_force
from blind.plan import Planned
from blind.programme import Trial
from blind.signals import SIGNALS, slow_enough
from blind.size import Unreachable, nrms, share
from blind.substructure.loop import RanAway, draw_storey, ground_motion, run
from blind.substructure.rig import Follower, Rig, draw_rig, envelope
from blind.write import truth, truth_path, write

STEP, EVERY = 0.0005, 2  # s of the loop; each second sample is recorded
TEMPERATURE = 20.0
SHORTEST, LONGEST = 5.0, 9.0  # s
STRAINS = (0.15, 0.5)
COMMANDS = ("sine_at_once", "random", "chirp", "staircase")
USES = ("fit", "validate")
FEWEST = 3
"""Tests to fit to of an effect or a rig that changes between tests: docs/how_to/calibration.md asks for so many."""
MEMORIES = tuple(float(memory) for memory in np.geomspace(0.05, 50.0, 13))
"""s: for which amplitudes are remembered."""


@dataclass(frozen=True)
class Tested:
    """What is recorded, and the truth.

    Attributes:
        campaign: as of a laboratory; its displacement is the target.
        rig: behind it.
        lag: the constant delay, s, whose errors of the force are least in the tests to fit to: the mean of the delay,
            weighted with the square of the force's rate.
        weights, times: of each test: that weight, 0 of tests to validate, and the mean time it has, s.
        amplitudes: (MEMORIES,) of each test: mean amplitude with that weight, m, of fading memories.
    """

    campaign: Campaign
    rig: Rig
    lag: float
    weights: tuple[float, ...]
    times: tuple[float, ...]
    amplitudes: tuple[tuple[float, ...], ...]


def make(planned: Planned, seed: int) -> Tested:
    """Make a campaign; the same for the same plan and seed."""
    for again in range(DRAWS):
        try:
            return _drawn(np.random.default_rng((seed, planned.number, again)), planned, seed)
        except (Unreachable, RanAway) as error:  # another rig, structure or size
            last = error
    raise last


def write_new(planned: Planned, seed: int, folder: Path) -> None:
    """Make a campaign and write it, the truth with rig and delay."""
    made = make(planned, seed)
    path = write(made.campaign, folder)
    text = path.read_text(encoding="ascii")
    path.write_text(text.replace("\ntests:\n", "\nstart: at_rest\ntests:\n"), encoding="ascii")
    truth_path(folder).write_text(json.dumps(truth_of(made), indent=1) + "\n", encoding="ascii")


def truth_of(made: Tested) -> dict[str, Any]:
    """What the judge knows."""
    weighted = {"weights": made.weights, "times": made.times, "memories": MEMORIES, "amplitudes": made.amplitudes}
    return {**truth(made.campaign), "rig": vars(made.rig), "lag": made.lag, **weighted}


def _drawn(rng: Generator, planned: Planned, seed: int) -> Tested:
    declared, true = draw_law(rng, exact=rng.random() < 0.45)
    uses = ["fit"] * int(rng.integers(2, 5)) + ["validate"] * int(rng.integers(1, 3))
    uses = [uses[i] for i in rng.permutation(len(uses))]
    lengths = rng.uniform(SHORTEST, LONGEST, len(uses))
    rig = draw_rig(rng, planned.kind, float(lengths.sum()))
    storey = draw_storey(rng)
    targets: Histories = []
    tests, lates = [], []
    for i, use in enumerate(uses):
        t = STEP * np.arange(EVERY * int(lengths[i] / (STEP * EVERY)) + 1)
        peak = THICKNESS_MM * rng.uniform(*STRAINS)
        before = float(sum(len(target) for target in targets)) * STEP
        if i == 0 or rng.random() < 0.5:
            target, title = _shaken(rng, storey, true, rig, before, t, peak)
        else:
            target, title = _commanded(rng, t, peak)
        follower = Follower(rig, STEP, before)
        x = np.array([0.0, *(follower.step(u) for u in target[1:].tolist())])
        targets.append(target)
        lates.append(follower.late)
        tests.append(Trial(i, len(uses), use, title, x, STEP, EVERY, TEMPERATURE, 600.0))
    forms = [EFFECTS[name][i % len(EFFECTS[name])] for name, i in planned.effects]
    if (rig.drift or any(form.memory for form in forms)) and uses.count("fit") < FEWEST:
        raise Unreachable(f"a change between tests in {uses.count('fit')} tests to fit to")
    effects = [_shown(rng, true, tests, form) for form in forms]
    force = observe(true, tests, [effect for effect, _ in effects])[1]
    force = [np.interp(test.t - rig.force_delay, test.t, f) for test, f in zip(tests, force, strict=True)]
    noise = replace(draw_noise(rng), displacement=0.0)  # a target has none
    clean = [f[::EVERY] for f in force]
    measured = noisy_force(rng, noise, clean)
    at = [i for i, test in enumerate(tests) if test.use == "validate"]
    floor = nrms([measured[i] - clean[i] for i in at], [measured[i] for i in at])
    campaign = Campaign(
        planned,
        seed,
        tests,
        declared,
        true,
        True,
        tuple(Hidden(effect, alone, alone) for effect, alone in effects),
        noise,
        [test.t[::EVERY] for test in tests],
        [target[::EVERY] for target in targets],
        measured,
        None,
        floor,
        floor,
        sum(alone for _, alone in effects),
        None,
    )
    powers = [
        np.gradient(f, STEP) ** 2 if test.use == "fit" else np.zeros(test.n)
        for f, test in zip(force, tests, strict=True)
    ]
    weights = tuple(float(power.sum()) for power in powers)

    def means(each: Histories) -> tuple[float, ...]:
        return tuple(float(p @ values) / max(w, 1e-300) for p, values, w in zip(powers, each, weights, strict=True))

    lag = float(np.dot(weights, means(lates))) / sum(weights)
    by_memory = [means([1e-3 * envelope(target, STEP, memory) for target in targets]) for memory in MEMORIES]
    return Tested(campaign, rig, lag, weights, means([test.t for test in tests]), tuple(zip(*by_memory, strict=True)))


def _shown(rng: Generator, true: Parameters, tests: list[Trial], form: type[Effect]) -> tuple[Effect, float]:
    """An effect sized by its share of the force in all tests, and that share: tests to fit to may be far larger than
    those to validate, or far smaller.

    Raises:
        Unreachable: those to fit to, or those to validate, do not show it.
    """
    counted = {use: [replace(test, use="validate" if test.use == use else "fit") for test in tests] for use in USES}
    effect, alone = sized(rng, true, [replace(test, use="validate") for test in tests], form, SMALLEST_OF_TWO)
    for use in USES:
        if (part := share(true, counted[use], [effect])) < SMALLEST:
            raise Unreachable(f"{form.name} {form.form} has {part:.2g} of the force in tests to {use}")
    return effect, alone


def _shaken(
    rng: Generator, storey: Any, p: Parameters, rig: Rig, before: float, t: np.ndarray, peak: float
) -> tuple[np.ndarray, str]:
    """Target (n,) mm of an earthquake in the loop, with about the wanted peak."""
    ground = ground_motion(rng, t)
    ground *= 1000.0 / np.max(np.abs(ground))  # a tenth of g
    for _ in range(DRAWS):
        try:
            target = run(storey, p, Follower(rig, STEP, before), ground, STEP, 2.0 * peak)
        except RanAway:
            ground *= 0.3
            continue
        miss = peak / float(np.max(np.abs(target)))
        if 0.9 < miss < 1.1:
            return target, f"earthquake in the loop, {100.0 * peak / miss / THICKNESS_MM:.0f} %"
        ground *= miss
    raise RanAway


def _commanded(rng: Generator, t: np.ndarray, peak: float) -> tuple[np.ndarray, str]:
    kind = str(rng.choice(COMMANDS))
    if kind != "sine_at_once":
        return SIGNALS[kind](rng, t, peak)
    f = float(rng.choice([0.5, 1.0, 2.0, 3.0, 4.0, 5.0]))
    a = slow_enough(peak, f)
    return a * np.sin(2.0 * np.pi * f * t), f"sine {f:g} Hz at once, {100.0 * a / THICKNESS_MM:.0f} %"
