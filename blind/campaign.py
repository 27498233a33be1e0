"""A campaign with what is hidden in it, as the laboratory makes it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.random import Generator

from blind import law
from blind.effects import EFFECTS
from blind.effects.base import Effect, Histories, log_uniform
from blind.laboratory import observe
from blind.law import Parameters
from blind.noise import Noise, draw_noise, noisy_displacement, noisy_force, thermometer
from blind.plan import UNLISTED, Planned
from blind.programme import Trial, programme
from blind.refit import left_after_refit
from blind.size import Unreachable, fit_size, nrms, share

SMALLEST, LARGEST = 0.001, 0.10  # NRMS of one effect
SMALLEST_OF_TWO = 0.003
DRAWS = 12


@dataclass(frozen=True)
class Hidden:
    """An effect with its share, alone and beside the others.

    Attributes:
        effect: with its size.
        alone: NRMS on the tests to validate.
        beside: likewise, between records with all effects and with all but this one.
    """

    effect: Effect
    alone: float
    beside: float


@dataclass(frozen=True)
class Campaign:
    """What is recorded, and the truth.

    Attributes:
        planned: what was asked for.
        seed: of everything.
        tests: in order.
        declared: parameters the campaign file names; None: those of Table 4.2 by name.
        true: parameters of the damper.
        refit: whether the declared ones are a first guess.
        hidden: effects.
        noise: of the channels.
        time, displacement, force: samples (m,) of each test in s, mm, kN.
        temperature: likewise in degC, or None.
        floor: NRMS of the noise of the force on the tests to validate.
        floor_with_law: NRMS there between records and the true law with its effects, if fed with displacements and
            temperatures as recorded: what noise of the displacement and the thermometer's error add.
        joint: NRMS there of all effects together.
        after_refit: what a refit of the law's parameters leaves of it; None if there are none.
    """

    planned: Planned
    seed: int
    tests: list[Trial]
    declared: Parameters | None
    true: Parameters
    refit: bool
    hidden: tuple[Hidden, ...]
    noise: Noise
    time: Histories
    displacement: Histories
    force: Histories
    temperature: Histories | None
    floor: float
    floor_with_law: float
    joint: float
    after_refit: float | None


def make(planned: Planned, seed: int) -> Campaign:
    """Make a campaign; the same for the same plan and seed."""
    for again in range(DRAWS):
        drawn = (seed, planned.number, again) if again else (seed, planned.number)
        try:
            return _drawn(np.random.default_rng(drawn), planned, seed)
        except Unreachable as error:  # these tests cannot show it: others
            last = error
    raise last


def _drawn(rng: Generator, planned: Planned, seed: int) -> Campaign:
    forms = [_form(name, i) for name, i in planned.effects]
    trusted = any(form.needs == "trusted" for form in forms) or rng.random() < 0.12
    declared, true = draw_law(rng, exact=trusted or rng.random() < 0.45)
    warm = any(form.needs == "temperatures" for form in forms)
    tests = programme(rng, warm)
    effects, alone = _effects(rng, true, tests, forms)
    x, force = observe(true, tests, effects)
    hidden = tuple(
        Hidden(
            effect,
            each,
            share(true, tests, effects, [e for e in effects if e is not effect]) if len(effects) > 1 else each,
        )
        for effect, each in zip(effects, alone, strict=True)
    )
    return _recorded(rng, planned, seed, tests, declared, true, not trusted, hidden, x, force)


def _recorded(
    rng: Generator,
    planned: Planned,
    seed: int,
    tests: list[Trial],
    declared: Parameters | None,
    true: Parameters,
    refit: bool,
    hidden: tuple[Hidden, ...],
    x: Histories,
    force: Histories,
) -> Campaign:
    noise = draw_noise(rng)
    clean = [f[:: test.every] for test, f in zip(tests, force, strict=True)]
    measured = noisy_force(rng, noise, clean)
    exact = [y[:: test.every] for test, y in zip(tests, x, strict=True)]
    displacement = noisy_displacement(rng, noise, exact)
    added = [m - c for m, c in zip(measured, clean, strict=True)]
    column = len({test.temperature for test in tests}) > 1 and rng.random() < 0.6 or rng.random() < 0.1
    read = [thermometer(rng, test.temperature, m.size) for test, m in zip(tests, measured, strict=True)]
    known = [float(np.mean(values)) if column else test.temperature for test, values in zip(tests, read, strict=True)]
    effects = [h.effect for h in hidden]
    warmer = [replace(test, temperature=warmth) for test, warmth in zip(tests, known, strict=True)]
    as_read = observe(true, warmer, effects)[1] if column else force  # what the truth would do at those temperatures
    through = [
        law.force(law.at_temperature(true, test.temperature), a, test.h * test.every)
        - law.force(law.at_temperature(true, test.temperature), b, test.h * test.every)
        + (warm - f)[:: test.every]
        for test, a, b, warm, f in zip(tests, displacement, exact, as_read, force, strict=True)
    ]
    at = [i for i, test in enumerate(tests) if test.use == "validate"]
    return Campaign(
        planned,
        seed,
        tests,
        declared,
        true,
        refit,
        hidden,
        noise,
        [test.h * test.every * np.arange(m.size) for test, m in zip(tests, measured, strict=True)],
        displacement,
        measured,
        read if column else None,
        nrms([added[i] for i in at], [measured[i] for i in at]),
        nrms([added[i] - through[i] for i in at], [measured[i] for i in at]),
        share(true, tests, effects) if effects else 0.0,
        left_after_refit(true, tests, x, force) if effects else None,
    )


def _form(name: str, i: int) -> type[Effect]:
    if name in UNLISTED:
        return UNLISTED[name]
    return EFFECTS[name][i % len(EFFECTS[name])]


def _effects(
    rng: Generator, true: Parameters, tests: list[Trial], forms: list[type[Effect]]
) -> tuple[list[Effect], list[float]]:
    """Effects with sizes drawn so that their shares are log-uniform."""
    least = SMALLEST if len(forms) < 2 else SMALLEST_OF_TWO
    for _ in range(DRAWS):
        drawn = [sized(rng, true, tests, form, least) for form in forms]
        effects, alone = [effect for effect, _ in drawn], [value for _, value in drawn]
        if len(effects) < 2:
            return effects, alone
        try:
            beside = [share(true, tests, effects, [e for e in effects if e is not effect]) for effect in effects]
        except ArithmeticError:  # too much for each other
            continue
        if min(beside) >= SMALLEST_OF_TWO:
            return effects, alone
    raise Unreachable(f"no draw of {', '.join(f'{form.name} {form.form}' for form in forms)} shows both")


def sized(
    rng: Generator, true: Parameters, tests: list[Trial], form: type[Effect], least: float
) -> tuple[Effect, float]:
    """An effect with a size that makes its share log-uniform from the least one on, and that share."""
    target = log_uniform(rng, least, LARGEST)
    for i in range(DRAWS):
        effect = form(rng, tests)
        try:
            return effect, fit_size(true, tests, effect, target)
        except Unreachable:
            if i >= DRAWS // 2:  # too much is asked of this form
                target = log_uniform(rng, least, target)
    raise Unreachable(f"{form.name} {form.form}: no draw reaches {target:.2g}")


def draw_law(rng: Generator, exact: bool) -> tuple[Parameters | None, Parameters]:
    """Declared parameters (None: Table 4.2 by name) and true ones."""
    own = rng.random() < 0.3
    spread = rng.uniform(0.03, 0.15)
    declared = {name: _rounded(v * (1.0 + rng.uniform(-0.2, 0.2))) for name, v in law.TABLE_4_2.items()}
    base = declared if own else law.TABLE_4_2
    changed = {name: value * (1.0 + spread * rng.uniform(-1.0, 1.0)) for name, value in base.items()}
    return declared if own else None, dict(base) if exact else changed


def _rounded(value: float) -> float:
    return float(f"{value:.4g}")
