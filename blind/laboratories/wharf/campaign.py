"""One campaign: law, programme, what is hidden in it, noise, and what is true of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.optimize import least_squares
from scipy.signal import butter, sosfilt, sosfiltfilt

from blind.laboratories.wharf import effects as hidden
from blind.laboratories.wharf import laws, motions, programme
from blind.laboratories.wharf.effects import KINDS, LISTED, UNLISTED, Effect, Run, Scale

Array = NDArray[np.float64]

RATIOS = (2.0, 50.0)  # of an effect to the noise, after a refit
NOISES = (0.0012, 0.03)  # of the noise to the force, as roots of powers
TRIES = 40
FEW = 5  # parameters of a law whose refit finds its slopes anew in each step
FAULTS = 0.15  # of campaigns with one effect: a fault of a single test
LAST = ("bearing_play", "clamp_slip", "flexible_frame")  # beside these, no effect of the damper itself
FAMILIES = (
    ("mullins_softening", "path_degradation", "self_heating", "thixotropy", "first_movement_peak", "cyclic_hardening"),
    ("seal_friction", "guide_friction", "stribeck_friction", "clamp_slip"),
    ("channel_lag", "unequal_filters", "moving_mass", "lag_of_one_test", "flexible_frame", "viscous_branch"),
    ("relief_valve", "power_of_velocity", "force_clipping", "square_damping"),
    ("cubic_stiffening", "end_stop", "softening_spring", "gas_spring", "bearing_play", "pinching", "wedge_action"),
    ("dead_weight", "gas_spring", "force_drift", "zero_of_one_test"),
    (
        "one_sided_displacement",
        "one_sided_velocity",
        "one_sided_force",
        "cell_nonlinearity",
        "gas_spring",
        "dead_weight",
    ),
    ("drift_over_tests", "path_degradation", "condition_dependence", "temperature_softening", "viscosity_temperature"),
    ("viscous_branch", "rate_dependence", "square_damping"),
)
"""Effects that look alike in part: two of one campaign are not of one family."""


@dataclass
class Reading:
    """A test as its file has it, and the powers that nobody can explain."""

    test: programme.Test
    time: Array
    displacement: Array
    force: Array
    temperature: Array | None
    typed: float
    noise: float  # kN^2, sum over samples
    power: float  # kN^2, likewise


@dataclass
class Campaign:
    """Everything of a campaign."""

    category: str
    law: str
    true: Array
    stated: Array
    exact: bool
    size: programme.Size
    tests: list[programme.Test]
    in_motion: bool
    lasting: bool  # of extremes, from test to test
    seeds: list[int]
    motions: list[motions.Motion] = field(default_factory=list)
    parts: list[Array] = field(default_factory=list)
    scale: Scale | None = None
    effects: list[Effect] = field(default_factory=list)
    ratios: list[float] = field(default_factory=list)
    noise: float = 0.0  # kN
    slopes: Array | None = None
    readings: list[Reading] = field(default_factory=list)
    habits: dict[str, Any] = field(default_factory=dict)
    conditions: tuple[str, list[float]] | None = None
    order_unknown: bool = False
    say_start: bool = False

    @property
    def group(self) -> str:
        """F or H."""
        return "F" if self.law in ("kelvin_voigt", "mgmm") else "H"

    @property
    def floor(self) -> float:
        """Noise over force in the tests to validate, as roots of powers."""
        of = [reading for reading in self.readings if reading.test.use == "validate"]
        return float(np.sqrt(sum(r.noise for r in of) / sum(r.power for r in of)))


def draw(category: str, rng: np.random.Generator) -> Campaign:
    """A campaign of a category; drawn anew until its effects are within the range of sizes."""
    for _ in range(TRIES):
        made = _attempt(category, rng)
        if made is not None:
            return made
    raise RuntimeError(f"no {category} campaign in {TRIES} draws")


def _attempt(category: str, rng: np.random.Generator) -> Campaign | None:
    kind, _, group = category.partition("_")
    law = _law(kind, group, rng)
    names = _names(kind, law, rng)
    needs = {KINDS[name].needs for name in names} - {""}
    size = programme.size(rng)
    true = programme.parameters(law, size, rng)
    stated, exact = programme.declared(law, true, rng)
    tests, in_motion = programme.tests(size, rng, needs, warm=law != "mgmm")
    in_series = any(KINDS[name].stage == "series" for name in names)  # stepped from a virgin specimen in each test
    lasting = law in laws.REMEMBER and bool(rng.random() < 0.5) and not in_series
    seeds = [int(seed) for seed in rng.integers(1 << 30, size=len(tests))]
    of = Campaign(category, law, true, stated, exact, size, tests, in_motion, lasting, seeds)
    _base(of)
    if not _hide(of, names, rng):
        return None
    if "condition" in needs or (not needs and rng.random() < 0.08):
        name = str(rng.choice(list(programme.CONDITIONS)))
        low, high = programme.CONDITIONS[name]
        middle = round(float(rng.uniform(low, high)), 2)
        of.conditions = (name, [round(middle * test.condition, 4) for test in tests])
    remembers = lasting or any(
        effect.draws.get("lasting")
        or effect.name in ("path_degradation", "cyclic_hardening", "drift_over_tests", "crack_in_one_test")
        for effect in of.effects
    )
    of.order_unknown = not remembers and bool(rng.random() < 0.15)
    of.say_start = bool(rng.random() < 0.5)
    return of if _read(of, rng) else None


def _law(kind: str, group: str, rng: np.random.Generator) -> str:
    if kind == "unlisted":
        group = str(rng.choice(["F", "H"], p=[0.3, 0.7]))
    if group == "F":
        return str(rng.choice(["kelvin_voigt", "mgmm"], p=[0.6, 0.4]))
    return str(rng.choice([law for law in laws.LAWS if law not in ("kelvin_voigt", "mgmm")]))


def _names(kind: str, law: str, rng: np.random.Generator) -> list[str]:
    if kind == "clean":
        return []
    if kind == "unlisted":
        return [str(rng.choice(list(UNLISTED)))]
    fit = [name for name in LISTED if law in KINDS[name].laws and name != "temperature_of_one_test"]
    names = [str(rng.choice(fit))]
    if kind == "one" and rng.random() < FAULTS:
        names = [str(rng.choice([name for name in fit if KINDS[name].stage == "single"]))]
    while kind == "two" and len(names) < 2:
        if names[0] == "temperature_softening" and rng.random() < 0.5:
            return [*names, "temperature_of_one_test"]
        other = str(rng.choice(fit))
        pair = {names[0], other}
        own = [name for name in pair if KINDS[name].stage in ("values", "parts", "total")]
        alone = pair & set(LAST) and (own or pair <= set(LAST))
        singles = all(KINDS[name].stage == "single" for name in pair)
        if other != names[0] and not alone and not singles and not any(pair <= set(family) for family in FAMILIES):
            names.append(other)
    return names


def _base(of: Campaign) -> None:
    """The motions and the forces of the law alone; what sizes are measured in."""
    repeated: dict[tuple[motions.Plan, float], motions.Motion] = {}
    state = None
    for test in of.tests:
        rate = float(test.sampling * test.stride)
        key = (test.plan, rate)
        if key not in repeated:
            repeated[key] = motions.make(test.plan, rate)
        of.motions.append(repeated[key])
        motion = repeated[key]
        parts, end = laws.run(of.law, of.true, motion.dt, motion.x, motion.v, state)
        state = laws.memory(of.law, end) if of.lasting else None
        of.parts.append(parts)
    forces = [parts.sum(axis=0) for parts in of.parts]

    def root(values: Sequence[Array]) -> float:
        return float(np.sqrt(np.mean([np.mean(value**2) for value in values])))

    of.scale = Scale(
        force=root(forces),
        peak=max(float(np.abs(force).max()) for force in forces),
        u=max(float(np.abs(m.x).max()) for m in of.motions),
        v=root([m.v for m in of.motions]),
        a=root([m.a for m in of.motions]),
        path=sum(float(np.abs(np.diff(m.x)).sum()) for m in of.motions),
        work=float(np.mean([np.sum(np.maximum(f * m.v, 0)) * m.dt for f, m in zip(forces, of.motions, strict=True)])),
        frequency=of.size.frequency,
        top=max(m.fastest for m in of.motions),
    )


def simulate(of: Campaign, effects: list[Effect]) -> list[Run]:
    """The tests with effects, before noise and the logger."""
    assert of.scale is not None
    runs, path, extreme = [], 0.0, 0.0
    for i, (test, motion, parts) in enumerate(zip(of.tests, of.motions, of.parts, strict=True)):
        u, v, a, forces = motion.x, motion.v, motion.a, parts.copy()
        for effect in effects:
            if effect.kind.stage == "series":
                connection = _connection(effect, of.scale)
                force, u = laws.run_in_series(of.law, of.true, motion.dt, motion.x, *connection)
                forces = np.zeros_like(parts)
                forces[2] = force
        run = Run(
            index=i,
            count=len(of.tests),
            dt=motion.dt,
            x=motion.x,
            u=u,
            v=v,
            a=a,
            parts=forces,
            force=forces.sum(axis=0),
            temperature=test.temperature,
            condition=test.condition,
            seed=of.seeds[i],
            stride=test.stride,
            before={"path": path, "extreme": extreme},
        )
        hidden.act(run, effects, of.scale)
        path, extreme = path + run.path[-1], max(extreme, float(np.abs(u).max()))
        runs.append(run)
    return runs


def _connection(effect: Effect, scale: Scale) -> tuple[float, float, float]:
    """Stiffness, gap, force of slip."""
    if effect.name == "flexible_frame":
        return scale.peak / (effect.size * scale.u), 0.0, 1e3 * scale.peak
    stiff = scale.peak / (0.004 * scale.u)
    if effect.name == "bearing_play":
        return stiff, effect.size * scale.u, 1e3 * scale.peak
    return stiff, 0.0, (1 - effect.size) * scale.peak


def answers(of: Campaign, values: Array, runs: list[Run] | None = None) -> list[Array]:
    """Forces of the law along recorded displacements; None: along the motions."""
    forces, state = [], None
    for i, motion in enumerate(of.motions):
        if not of.lasting and of.tests[i].use != "fit":
            forces.append(np.empty(0))
            continue
        gain, stretch = (1.0, 1.0) if runs is None else (runs[i].gain, runs[i].stretch)
        parts, end = laws.run(of.law, values, motion.dt * stretch, motion.x * gain, motion.v * gain / stretch, state)
        state = laws.memory(of.law, end) if of.lasting else None
        forces.append(parts.sum(axis=0))
    return forces


def _samples(test: programme.Test, length: int) -> NDArray[np.intp]:
    """Points of the fine grid that are in the file."""
    first = round(test.start * test.sampling) * test.stride
    last = min(round(test.end * test.sampling) * test.stride, length - 1)
    return np.arange(first, last + 1, test.stride)


def _fitted(of: Campaign, forces: Sequence[Array]) -> Array:
    """Samples of the tests to fit, one after the other."""
    return np.concatenate(
        [f[_samples(test, len(f))] for test, f in zip(of.tests, forces, strict=True) if test.use == "fit"]
    )


def refit(of: Campaign, runs: list[Run], start: Array | None = None, slopes: Array | None = None) -> float:
    """Root of the mean power that is left after a refit of the law alone, kN.

    Args:
        of: the campaign.
        runs: its tests with effects.
        start: logarithms of the parameters over the true ones.
        slopes: of the samples by these logarithms, to be kept; None: found anew in each step.

    Returns:
        The root, over the samples of all tests to fit.
    """
    free = np.array(laws.LAWS[of.law].free)
    target = _fitted(of, [run.force for run in runs])

    def values(x: Array) -> Array:
        changed = of.true.copy()
        changed[free] *= np.exp(x)
        names = [laws.LAWS[of.law].names[i] for i in free]
        for i, name in zip(free, names, strict=True):
            if name in ("b", "alpha", "beta", "p", "alpha_d") and of.true[i] < 1:
                changed[i] = min(changed[i], 0.99)
            if name == "n":
                changed[i] = max(changed[i], 1.0)
        return changed

    def error(x: Array) -> Array:
        return (_fitted(of, answers(of, values(x), runs)) - target) / of.scale.force  # type: ignore[union-attr]

    if start is not None and not np.isfinite(start).all():  # slopes of what overflows: as large as can be
        return np.inf
    first = np.zeros(len(free)) if start is None else np.clip(start, -0.7, 0.7)
    scaled = None if slopes is None else slopes / of.scale.force  # type: ignore[union-attr]
    best = least_squares(
        error,
        first,
        jac="2-point" if scaled is None else lambda x: scaled,
        bounds=(-1.5, 1.5),
        max_nfev=5 if scaled is None else 10,
        x_scale=0.1,
        diff_step=1e-4,
        ftol=2e-3,
    )
    return float(np.sqrt(np.mean(best.fun**2)) * of.scale.force)  # type: ignore[union-attr]


def _hide(of: Campaign, names: list[str], rng: np.random.Generator) -> bool:
    """Draw effects, their sizes and the noise; False: a size out of range."""
    assert of.scale is not None
    share = float(np.exp(rng.uniform(np.log(0.002), np.log(0.015))))
    if not names:
        of.noise = share * of.scale.force
        return True
    free = laws.LAWS[of.law].free
    plain = _fitted(of, answers(of, of.true))
    columns = []
    for i in free:
        moved = of.true.copy()
        moved[i] *= 1 + 1e-3
        columns.append((_fitted(of, answers(of, moved)) - plain) / 1e-3)
    slopes = np.array(columns).T
    basis, sizes, turn = np.linalg.svd(slopes, full_matrices=False)
    strong = sizes > 1e-6 * sizes[0]
    basis, turn = basis[:, strong], turn[strong] / sizes[strong, None]
    for name in names:
        if name == "temperature_of_one_test":
            effect, ratio = _mistype(of, of.effects[0], rng)
            if not RATIOS[0] <= ratio <= RATIOS[1]:
                return False
            of.effects.append(effect)
            of.ratios.append(ratio)
            continue
        kind = KINDS[name]
        effect = Effect(name, 0.0, kind.draws(rng), _one(of, rng) if kind.stage == "single" else None)
        low, high = kind.sizes
        effect.size = float(np.exp(rng.uniform(np.log(low), np.log(high))))
        ratio = float(np.exp(rng.uniform(*np.log(RATIOS))))
        left = 0.0
        for again in range(5):
            runs = simulate(of, [effect])
            error = _fitted(of, [run.force for run in runs]) - _fitted(of, answers(of, of.true, runs))
            along = basis.T @ error
            left = float(np.sqrt(np.mean((error - basis @ along) ** 2)))
            wanted = ratio * (of.noise or share * of.scale.force)
            if again == 4 or left == 0 or 0.8 < left / wanted < 1.25 or low == high:
                break
            tried = effect.size
            effect.size = float(np.clip(tried * np.clip(wanted / left, 0.1, 10), low, high))
            if effect.size == tried:
                break
        left = refit(of, runs, turn.T @ along, slopes if len(free) > FEW else None)
        if not 1e-4 * of.scale.force < left < np.inf:
            return False
        if low == high and not of.noise:
            of.noise = share * of.scale.force
        if not of.noise:
            of.noise = left / ratio
        ratio = left / of.noise
        if not NOISES[0] < of.noise / of.scale.force < NOISES[1]:
            return False
        if ratio < RATIOS[0] or (ratio > RATIOS[1] and low < high):
            return False
        of.effects.append(effect)
        of.ratios.append(ratio)
    return len(names) < 2 or _both_show(of, basis)


def _both_show(of: Campaign, basis: Array) -> bool:
    """Whether each of two effects changes the force beyond what parameters can do, where the other one is."""
    together = _fitted(of, [run.force for run in simulate(of, of.effects)])
    for other in of.effects:
        if "temperature_of_one_test" in (other.name, of.effects[-1].name):
            continue
        change = together - _fitted(of, [run.force for run in simulate(of, [other])])
        if np.sqrt(np.mean((change - basis @ (basis.T @ change)) ** 2)) < RATIOS[0] * of.noise:
            return False
    return True


def _mistype(of: Campaign, law: Effect, rng: np.random.Generator) -> tuple[Effect, float]:
    """A mistyped temperature beside a law of temperature; what that law then gets wrong, over the noise."""
    kind = KINDS["temperature_of_one_test"]
    effect = Effect("temperature_of_one_test", float(rng.uniform(*kind.sizes)), kind.draws(rng), _one(of, rng))
    forces = [run.force if run.index == effect.test else 0 * run.force for run in simulate(of, [law])]
    wrong = np.expm1(-law.size * effect.draws["sign"] * effect.size / 20)
    return effect, float(np.sqrt(np.mean((wrong * _fitted(of, forces)) ** 2))) / of.noise


def _one(of: Campaign, rng: np.random.Generator) -> int:
    """A test to fit."""
    return int(rng.choice([i for i, test in enumerate(of.tests) if test.use == "fit"]))


def _read(of: Campaign, rng: np.random.Generator) -> bool:
    """What the logger makes of the tests: filters, noise, steps; the powers of these. False: it is too coarse."""
    assert of.scale is not None
    runs = simulate(of, of.effects)
    by_displacement = float(rng.uniform(0.05, 0.4)) if rng.random() < 0.7 else 0.0
    by_steps = float(rng.uniform(0.02, 0.5)) if rng.random() < 0.6 else 0.005
    memory = float(rng.uniform(0.2, 0.5)) if rng.random() < 0.3 else 0.0  # of the noise of the force, sample to sample
    corner = float(rng.uniform(0.38, 0.47)) if rng.random() < 0.6 else 0.0  # of the logger, times the sampling rate
    shakes = [_shake(of, i, rng) for i in range(len(of.tests))]
    probe = 1e-4 * of.scale.u
    power = np.mean([np.mean(_along(of, i, probe * shake) ** 2) for i, shake in enumerate(shakes)])
    amplitude = probe * float(np.sqrt(by_displacement / power)) * of.noise
    corner, left = _logger(of, corner)
    if left is None:
        return False
    f_step = of.noise * float(np.sqrt(12 * by_steps * (1 - by_displacement)))
    white = of.noise * float(np.sqrt((1 - by_steps) * (1 - by_displacement)))
    x_step = 0.5 * amplitude
    column = bool(rng.random() < 0.4) and not any(e.name == "temperature_of_one_test" for e in of.effects)
    keeps_clock = bool(rng.random() < 0.4)  # time of a cut test goes on from the trigger
    for i, (test, run, shake) in enumerate(zip(of.tests, runs, shakes, strict=True)):
        at = _samples(test, len(run.x))
        x, force = run.x, run.force
        if corner:
            sections = butter(4, corner * test.sampling, fs=1 / run.dt, output="sos")
            x, force = sosfilt(sections, x), sosfilt(sections, force)
        noise = rng.standard_normal(len(at))
        for k in range(1, len(at)) if memory else ():
            noise[k] = memory * noise[k - 1] + np.sqrt(1 - memory**2) * noise[k]
        read = np.round((force[at] + white * noise) / f_step) * f_step
        shown = x[at] + amplitude * shake[at]
        shown = np.round(shown / x_step) * x_step if x_step else np.round(shown, 5)
        moved = amplitude * shake + _in_band(of, i, at, shown - x[at] - amplitude * shake[at])
        lost = float(np.sum((read - force[at]) ** 2) + np.sum(_along(of, i, moved)[at] ** 2))
        lost += float(np.sum(left[i][at] ** 2))
        time = (at - (0 if keeps_clock else at[0])) * run.dt * run.stretch
        temperature = None
        if column:
            drift = rng.uniform(-0.3, 0.3) * np.linspace(-1, 1, len(at))
            temperature = np.round(test.temperature + drift + 0.02 * rng.standard_normal(len(at)), 2)
        reading = Reading(
            test, time, shown, read, temperature, test.temperature + run.typed, lost, float(np.sum(read**2))
        )
        of.readings.append(reading)
    of.habits = {
        "noise_kN": of.noise,
        "noise_share_of_displacement": by_displacement,
        "noise_share_of_steps": by_steps,
        "noise_memory": memory,
        "displacement_noise_mm": amplitude,
        "filter_over_sampling": corner,
        "keeps_clock": keeps_clock,
    }
    return True


def _shake(of: Campaign, i: int, rng: np.random.Generator) -> Array:
    """Noise of a displacement, of unit size, in the band of the motion: no filter parts it from the motion."""
    motion = of.motions[i]
    shake = sosfilt(_band(of, i), rng.standard_normal(len(motion.x)))
    return np.asarray(shake / shake.std())


def _band(of: Campaign, i: int) -> Array:
    """A filter that lets the band of a motion pass."""
    motion = of.motions[i]
    return np.asarray(butter(2, min(1.5 * motion.fastest, 0.4 * of.tests[i].sampling), fs=1 / motion.dt, output="sos"))


def _in_band(of: Campaign, i: int, at: NDArray[np.intp], rounding: Array) -> Array:
    """What rounding of the samples leaves in the band of the motion, where no filter parts it from the motion."""
    found = np.zeros_like(of.motions[i].x)
    found[at[0] : at[-1] + 1] = CubicSpline(at, rounding)(np.arange(at[0], at[-1] + 1))
    return np.asarray(sosfiltfilt(_band(of, i), found))


def _along(of: Campaign, i: int, moved: Array) -> Array:
    """What an error of the displacement does to the force, through the law's own loops."""
    motion = of.motions[i]
    v = motion.v + np.gradient(moved, motion.dt)
    if of.lasting:  # beside its own memory, as the noise is small
        straight = laws.run(of.law, of.true, motion.dt, motion.x, motion.v)[0].sum(axis=0)
    else:
        straight = of.parts[i].sum(axis=0)
    return np.asarray(laws.run(of.law, of.true, motion.dt, motion.x + moved, v)[0].sum(axis=0) - straight)


def _logger(of: Campaign, corner: float) -> tuple[float, list[Array] | None]:
    """The corner of the logger, none if it would bend the loops beyond half the noise; and what the logger leaves.

    None is left where sampling alone takes more of the loops than the noise does.
    """
    for chosen, most in ((corner, 0.5), (0.0, 1.0)):
        left = [_left(of, i, chosen) for i in range(len(of.tests))]
        if np.sqrt(np.mean([np.mean(change**2) for change in left])) <= most * of.noise:
            return chosen, left
    return 0.0, None


def _left(of: Campaign, i: int, corner: float) -> Array:
    """What equal filters and sampling leave between the force and the law along a spline through the samples."""
    motion, test = of.motions[i], of.tests[i]
    straight = laws.run(of.law, of.true, motion.dt, motion.x, motion.v)[0].sum(axis=0)
    x = motion.x
    if corner:
        sections = butter(4, corner * test.sampling, fs=1 / motion.dt, output="sos")
        x, straight = sosfilt(sections, x), sosfilt(sections, straight)
    spline = CubicSpline(motion.time[:: test.stride], x[:: test.stride])
    read = laws.run(of.law, of.true, motion.dt, spline(motion.time), spline(motion.time, 1))[0].sum(axis=0)
    return np.asarray(straight - read)
