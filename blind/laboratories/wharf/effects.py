"""What is hidden in the tests: equations, drawn shapes, and where each acts. The size is a number that scales it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numba
import numpy as np
from numpy.typing import NDArray
from scipy.signal import butter, sosfilt

from blind.laboratories.wharf.laws import LAWS

Array = NDArray[np.float64]
Draws = dict[str, Any]

SPRINGY = ("kelvin_voigt", "zener", "generalised_maxwell", "fractional_kelvin", "lead_rubber", "friction_pendulum")
FLUIDS = ("maxwell", "viscous", "viscous_power", "asymmetric_viscous", "bilinear_oil", "maxwell_power")
SLIDERS = ("friction", "elastic_plastic", "lead_rubber", "friction_pendulum", "bouc_wen", "self_centring")
ALL = tuple(LAWS)


@dataclass
class Scale:
    """What sizes are measured in: of the campaign without effects."""

    force: float  # kN, root of the mean square
    peak: float  # kN
    u: float  # mm, largest
    v: float  # mm/s, root of the mean square
    a: float  # mm/s^2, likewise
    path: float  # mm, of all tests
    work: float  # kN mm, of a test, mean
    frequency: float  # Hz
    top: float  # Hz


@dataclass
class Run:
    """A test on the fine grid, as it goes through specimen, rig and instruments."""

    index: int
    count: int  # of the tests
    dt: float
    x: Array  # recorded displacement, before the logger
    u: Array  # deformation of the specimen
    v: Array
    a: Array
    parts: Array
    force: Array
    temperature: float
    condition: float  # over its mean
    seed: int
    stride: int  # points of the grid a sample
    stretch: float = 1.0  # of the recorded time
    gain: float = 1.0  # of the recorded displacement
    typed: float = 0.0  # added to the temperature that is written down
    before: Mapping[str, float] = field(default_factory=dict)  # path and largest deformation of earlier tests

    @property
    def time(self) -> Array:
        """Time, s."""
        return np.asarray(np.arange(len(self.x)) * self.dt, dtype=np.float64)

    @property
    def path(self) -> Array:
        """Path of the specimen in this test, mm."""
        return np.concatenate([[0.0], np.cumsum(np.abs(np.diff(self.u)))])


Act = Callable[[Run, float, Draws, Scale], None]


@dataclass(frozen=True)
class Kind:
    """An effect: where it acts, on which laws, its sizes, what else is drawn."""

    stage: str  # values, series, parts, total, rig, instrument, single
    act: Act
    sizes: tuple[float, float]
    draws: Callable[[np.random.Generator], Draws] = lambda rng: {}
    laws: tuple[str, ...] = ALL
    needs: str = ""  # temperature, condition


@dataclass
class Effect:
    """An effect as it is drawn."""

    name: str
    size: float
    draws: Draws
    test: int | None = None  # the single test it is in

    @property
    def kind(self) -> Kind:
        """Where and how it acts."""
        return KINDS[self.name]


STAGES = ("parts", "total", "rig", "instrument", "single")


def act(run: Run, effects: list[Effect], scale: Scale) -> None:
    """Let effects act on a run whose `parts` are those of the law, in the order of the way of the force."""
    for stage in STAGES:
        if stage == "total":
            run.force = run.parts.sum(axis=0)
        for effect in effects:
            if effect.kind.stage == stage and effect.test in (None, run.index):
                effect.kind.act(run, effect.size, effect.draws, scale)


# of the damper


def _softens(run: Run, s: float, q: Draws, at: Scale) -> None:
    before = run.before.get("extreme", 0.0) if q["lasting"] else 0.0
    most = np.maximum(np.maximum.accumulate(np.abs(run.u)), before) / (q["at"] * at.u)
    run.force = run.force * (1 - s * (-np.expm1(-most) if q["form"] == "exponential" else most / (1 + most)))


def _wears(run: Run, s: float, q: Draws, at: Scale) -> None:
    path = (run.before.get("path", 0.0) + run.path) / (q["at"] * at.path)
    if q["form"] == "exponential":
        run.force = run.force * (1 + s * np.expm1(-path))
    else:
        run.force = run.force / (1 + s * np.log1p(path))


def _hardens(run: Run, s: float, q: Draws, at: Scale) -> None:
    path = (run.before.get("path", 0.0) + run.path) / (q["at"] * at.path)
    run.parts[2] *= 1 - s * np.expm1(-path)


@numba.njit(cache=True)
def _heat(force: Array, v: Array, dt: float, work: float, leak: float, s: float, out: Array) -> None:
    heat, last = 0.0, 0.0
    for i in range(len(force)):
        out[i] = force[i] * np.exp(-s * heat)
        power = max(out[i] * v[i], 0.0) / work
        heat += 0.5 * dt * (power + last) - dt * heat / leak
        last = power


def _heats(run: Run, s: float, q: Draws, at: Scale) -> None:
    out = np.empty_like(run.force)
    _heat(run.force, run.v, run.dt, at.work, q["leak"], s, out)
    run.force = out


@numba.njit(cache=True)
def _structure(v: Array, dt: float, rest: float, way: float, out: Array) -> None:
    level = 1.0
    for i in range(len(v)):
        out[i] = level
        rate = 1 / rest + abs(v[i]) / way
        level = 1 / rest / rate + (level - 1 / rest / rate) * np.exp(-rate * dt)


def _breaks_down(run: Run, s: float, q: Draws, at: Scale) -> None:
    level = np.empty_like(run.u)
    _structure(run.v, run.dt, q["rest"], q["way"] * at.u, level)
    run.force = run.force * (1 - s * (1 - level))


def _warm(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.force = run.force * np.exp(-s * (run.temperature - 20) / 20)


def _thin(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.parts[1] *= np.exp(-s * (run.temperature - 20) / 20)


def _pinches(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.parts[2] *= 1 - s * np.exp(-((run.u / (q["at"] * at.u)) ** 2))


def _valves(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.parts[1] *= 1 + s * (run.v > 0)


def _sides(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.parts[0] *= 1 + s * (run.u > 0)


def _pushes(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.force = run.force * (1 + s * (run.force > 0))


def _ages(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.force = run.force * (1 + q["sign"] * s * run.index / (run.count - 1))


def _depends(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.force = run.force * (1 + s * (run.condition - 1))


def _rates(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.parts[2] *= 1 + s * np.log1p(np.abs(run.v) / (q["at"] * at.v))


def _wedges(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.parts[2] *= 1 + s * np.abs(run.u) / at.u


def _relieves(run: Run, s: float, q: Draws, at: Scale) -> None:
    force, bound = run.parts[1], q["at"] * at.peak
    beyond = np.maximum(np.abs(force) - bound, 0)
    run.parts[1] = force - np.sign(force) * s * beyond


def _bends(run: Run, s: float, q: Draws, at: Scale) -> None:
    speed = np.maximum(np.abs(run.v) / at.v, 1e-9)
    run.parts[1] *= speed**-s


def _stiffens(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.force = run.force + s * at.force * (run.u / at.u) ** q["power"]


def _gives(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.force = run.force + s * at.force * np.tanh(run.u / (q["at"] * at.u))


@numba.njit(cache=True)
def _stop(x: Array, k: float, bound: float, out: Array) -> None:
    state, last = 0.0, x[0]
    for i in range(len(x)):
        state = min(max(state + k * (x[i] - last), -bound), bound)
        out[i] = state
        last = x[i]


def _rubs(run: Run, s: float, q: Draws, at: Scale) -> None:
    rubbing = np.empty_like(run.u)
    _stop(run.u, 1 / (q["way"] * at.u), 1.0, rubbing)
    run.force = run.force + s * at.force * rubbing


def _stribeck(run: Run, s: float, q: Draws, at: Scale) -> None:
    level = 1 + q["rise"] * np.exp(-((run.v / (q["at"] * at.v)) ** 2))
    run.force = run.force + s * at.force * level * np.tanh(run.v / (0.02 * at.v))


def _dashes(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.force = run.force + s * at.force * run.v / at.v


def _squares(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.force = run.force + s * at.force * run.v * np.abs(run.v) / at.v**2


@numba.njit(cache=True)
def _branch(x: Array, dt: float, tau: float, out: Array) -> None:
    e = np.exp(-dt / tau)
    state, last = 0.0, x[0]
    for i in range(len(x)):
        state = e * state + tau / dt * (1 - e) * (x[i] - last)
        out[i] = state
        last = x[i]


def _relaxes(run: Run, s: float, q: Draws, at: Scale) -> None:
    out = np.empty_like(run.u)
    _branch(run.u, run.dt, q["tau"] / (2 * np.pi * at.frequency), out)
    run.force = run.force + s * at.force * out / at.u


def _stops(run: Run, s: float, q: Draws, at: Scale) -> None:
    beyond = np.maximum(np.abs(run.u) - q["at"] * at.u, 0) / ((1 - q["at"]) * at.u)
    run.force = run.force + s * at.force * np.sign(run.u) * beyond


def _gas(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.force = run.force + s * at.force * (1 - run.u / (q["length"] * at.u)) ** -1.4


def _first(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.force = run.force * (1 + s * np.exp(-run.path / (q["way"] * at.u)))


# of the rig


def _nothing(run: Run, s: float, q: Draws, at: Scale) -> None:
    """For those that act before."""


def _mass(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.force = run.force + s * at.force * run.a / at.a


def _guides(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.force = run.force + s * at.force * np.tanh(run.v / (0.01 * at.v))


def _weighs(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.force = run.force + q["sign"] * s * at.force


# of the instruments


def _cell_lags(run: Run, s: float, q: Draws, at: Scale) -> None:
    total, out = np.zeros_like(run.force), np.empty_like(run.force)
    for bound in (0.1, 0.2, 0.4, 0.8):
        _stop(run.force, 1.0, bound * at.peak, out)
        total += out
    run.force = run.force + s * total / 4


def _bows(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.force = run.force * (1 + q["sign"] * s * run.force / at.peak)


def _late(run: Run, s: float, q: Draws, at: Scale) -> None:
    lag = s / (2 * np.pi * at.frequency)
    run.force = np.interp(run.time - lag, run.time, run.force)


def _filters(run: Run, s: float, q: Draws, at: Scale) -> None:
    corner = min(at.frequency / s, 0.45 / run.dt)
    run.force = sosfilt(butter(q["poles"], corner, fs=1 / run.dt, output="sos"), run.force)


def _drifts(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.force = run.force + q["sign"] * s * at.force * run.time / run.time[-1]


def _clips(run: Run, s: float, q: Draws, at: Scale) -> None:
    bound = (1 - s) * at.peak
    run.force = np.clip(run.force, -bound, bound)


def _hums(run: Run, s: float, q: Draws, at: Scale) -> None:
    phase = np.random.default_rng(run.seed + 1).uniform(0, 2 * np.pi)
    run.force = run.force + s * at.force * np.sin(2 * np.pi * q["mains"] * run.time + phase)


def _spikes(run: Run, s: float, q: Draws, at: Scale) -> None:
    rng = np.random.default_rng(run.seed + 2)
    force = run.force.copy()
    samples = np.arange(0, len(force), run.stride)
    struck = samples[rng.random(len(samples)) < q["share"]]
    force[struck] += s * at.force * rng.choice([-1.0, 1.0], len(struck)) * rng.uniform(4, 12, len(struck))
    run.force = force


# of single tests


def _gain(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.force = run.force * (1 + q["sign"] * s)


def _stroke(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.gain = 1 + q["sign"] * s
    run.x = run.x * run.gain


def _clock(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.stretch = 1 + q["sign"] * s


def _typed(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.typed = q["sign"] * s


def _turned(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.force = -run.force


# in no list


@numba.njit(cache=True)
def _sticking(v: Array, dt: float, slow: float, way: float, out: Array) -> None:
    rested, slid, peak, last = 0.0, 0.0, 0.0, 0.0
    for i in range(len(v)):
        if abs(v[i]) < slow:
            rested += dt
            if rested > 0.02:
                last, slid = max(slid, last * 0.5), 0.0
        else:
            if rested > 0:
                peak = np.log1p(rested / 0.01) * (0.5 + last / (last + way))
                slid = 0.0
            rested = 0.0
            slid += abs(v[i]) * dt
        out[i] = np.tanh(v[i] / slow) * (1 + 0.5 * peak * np.exp(-slid / (0.1 * way)))


def _sticks(run: Run, s: float, q: Draws, at: Scale) -> None:
    out = np.empty_like(run.v)
    _sticking(run.v, run.dt, 0.05 * at.v, q["way"] * at.u, out)
    run.force = run.force + s * at.force * out


def _rack(run: Run, s: float, q: Draws, at: Scale) -> None:
    run.force = run.force + s * at.force * np.sin(2 * np.pi * run.u / (q["pitch"] * at.u) + q["phase"])


@numba.njit(cache=True)
def _valve(force: Array, dt: float, opens: float, shuts: float, late: float, out: Array) -> None:
    is_open, waited, level = False, 0.0, 0.0
    for i in range(len(force)):
        if not is_open:
            waited = waited + dt if abs(force[i]) > opens else 0.0
            is_open = waited > late
        elif abs(force[i]) < shuts:
            is_open, waited = False, 0.0
        level += dt / 0.01 * ((1.0 if is_open else 0.0) - level)
        out[i] = level


def _opens_late(run: Run, s: float, q: Draws, at: Scale) -> None:
    level = np.empty_like(run.force)
    _valve(run.force, run.dt, q["opens"] * at.peak, q["shuts"] * at.peak, q["late"] / at.frequency, level)
    run.force = run.force * (1 - s * level)


def _cracks(run: Run, s: float, q: Draws, at: Scale) -> None:
    if run.index < q["test"]:
        return
    grown = np.ones_like(run.u)
    if run.index == q["test"]:
        path = run.path / run.path[-1]
        grown = np.clip((path - q["from"]) / 0.3, 0, 1) ** 0.5
    run.force = run.force * (1 - s * grown * (1 + 0.5 * (run.u > 0)))


@numba.njit(cache=True)
def _tooth(u: Array, place: float, way: float, out: Array) -> None:
    caught, last = False, u[0]
    for i in range(len(u)):
        if not caught and last < place <= u[i]:
            caught = True
        if caught and (u[i] > place + way or u[i] < place):
            caught = False
        out[i] = np.sin(np.pi * (u[i] - place) / way) if caught else 0.0
        last = u[i]


def _catches(run: Run, s: float, q: Draws, at: Scale) -> None:
    out = np.empty_like(run.u)
    _tooth(run.u, q["place"] * at.u, q["way"] * at.u, out)
    run.force = run.force + s * at.force * out


@numba.njit(cache=True)
def _void(v: Array, dt: float, fast: float, share: float, out: Array) -> None:
    void = 0.0
    for i in range(len(v)):
        if v[i] > fast:
            void += share * (v[i] - fast) * dt
        elif v[i] < 0:
            void = max(void + v[i] * dt, 0.0)
        out[i] = 1.0 if v[i] < 0 and void > 0 else 0.0


def _cavitates(run: Run, s: float, q: Draws, at: Scale) -> None:
    out = np.empty_like(run.v)
    _void(run.v, run.dt, q["fast"] * at.v, 0.5, out)
    run.force = run.force * (1 - s * out)


def _ripples(run: Run, s: float, q: Draws, at: Scale) -> None:
    ripple = np.sin(2 * np.pi * q["pump"] * at.frequency * run.time + run.seed % 7)
    run.force = run.force * (1 + s * ripple * np.minimum(np.abs(run.v) / at.v, 2))


@numba.njit(cache=True)
def _ring(v: Array, dt: float, w: float, damping: float, out: Array) -> None:
    y, rate = 0.0, 0.0
    for i in range(len(v)):
        if i and v[i] * v[i - 1] < 0:
            rate += w * np.sign(v[i])
        rate += dt * (-2 * damping * w * rate - w * w * y)
        y += dt * rate
        out[i] = y


def _rattles(run: Run, s: float, q: Draws, at: Scale) -> None:
    out = np.empty_like(run.v)
    _ring(run.v, run.dt, 2 * np.pi * q["ring"] * at.frequency, 0.06, out)
    run.force = run.force + s * at.force * out


def _wanders(run: Run, s: float, q: Draws, at: Scale) -> None:
    rng = np.random.default_rng(run.seed + 3)
    knots = np.cumsum(rng.standard_normal(12))
    knots -= knots[0]
    centre = np.interp(run.time, np.linspace(0, run.time[-1], 12), knots)
    run.force = run.force + s * at.force * centre / 3


def _films(run: Run, s: float, q: Draws, at: Scale) -> None:
    rng = np.random.default_rng(run.seed + 4)
    jumps = np.sort(rng.uniform(0, run.path[-1], 6))
    level = np.searchsorted(jumps, run.path) % 2
    run.force = run.force * (1 - s * level)


def _uniform(**bounds: tuple[float, float]) -> Callable[[np.random.Generator], Draws]:
    return lambda rng: {name: float(rng.uniform(*ends)) for name, ends in bounds.items()}


def _sign(rng: np.random.Generator) -> Draws:
    return {"sign": float(rng.choice([-1.0, 1.0]))}


def _form(low: float, high: float, *forms: str) -> Callable[[np.random.Generator], Draws]:
    def draw(rng: np.random.Generator) -> Draws:
        return {
            "at": float(rng.uniform(low, high)),
            "form": str(rng.choice(forms)),
            "lasting": bool(rng.random() < 0.5),
        }

    return draw


_NOT_SOFT = tuple(name for name in ALL if name not in ("mgmm", "modified_bouc_wen"))
_NO_SPRING = tuple(n for n in ALL if n not in ("maxwell", "maxwell_power", "friction", "elastic_plastic", "mgmm"))
_RATELESS = ("friction", "elastic_plastic", "lead_rubber", "bouc_wen", "self_centring")

KINDS: dict[str, Kind] = {
    "mullins_softening": Kind(
        "total", _softens, (0.04, 0.5), _form(0.2, 0.7, "exponential", "hyperbolic"), laws=_NOT_SOFT
    ),
    "path_degradation": Kind("total", _wears, (0.03, 0.5), _form(0.1, 0.5, "exponential", "logarithmic")),
    "cyclic_hardening": Kind("parts", _hardens, (0.03, 0.6), _uniform(at=(0.05, 0.4)), laws=SLIDERS[1:5]),
    "self_heating": Kind("total", _heats, (0.03, 0.6), _uniform(leak=(10, 80))),
    "thixotropy": Kind("total", _breaks_down, (0.05, 0.6), _uniform(rest=(1, 10), way=(0.5, 4))),
    "temperature_softening": Kind("total", _warm, (0.05, 0.6), needs="temperature"),
    "viscosity_temperature": Kind(
        "parts", _thin, (0.05, 0.8), laws=("kelvin_voigt", *FLUIDS[1:5]), needs="temperature"
    ),
    "pinching": Kind("parts", _pinches, (0.05, 0.7), _uniform(at=(0.1, 0.4)), laws=SLIDERS[:5]),
    "one_sided_velocity": Kind("parts", _valves, (0.03, 0.5), laws=("kelvin_voigt", *FLUIDS[1:3], *FLUIDS[4:5])),
    "one_sided_displacement": Kind("parts", _sides, (0.03, 0.6), laws=SPRINGY),
    "one_sided_force": Kind(
        "total", _pushes, (0.03, 0.5), laws=("bouc_wen", "elastic_plastic", "modified_bouc_wen", "friction", "mgmm")
    ),
    "drift_over_tests": Kind("total", _ages, (0.03, 0.4), _sign),
    "condition_dependence": Kind("total", _depends, (0.05, 1.0), needs="condition"),
    "rate_dependence": Kind("parts", _rates, (0.02, 0.3), _uniform(at=(0.05, 0.5)), laws=_RATELESS),
    "wedge_action": Kind("parts", _wedges, (0.05, 0.6), laws=SLIDERS[:4]),
    "relief_valve": Kind(
        "parts", _relieves, (0.2, 0.97), _uniform(at=(0.25, 0.7)), laws=("kelvin_voigt", *FLUIDS[1:3])
    ),
    "power_of_velocity": Kind("parts", _bends, (0.04, 0.7), laws=("kelvin_voigt", "viscous")),
    "cubic_stiffening": Kind(
        "total",
        _stiffens,
        (0.05, 2),
        lambda rng: {"power": int(rng.choice([3, 3, 5]))},
        laws=tuple(name for name in ALL if name not in FLUIDS),
    ),
    "softening_spring": Kind("total", _gives, (0.05, 1), _uniform(at=(0.2, 0.6)), laws=SPRINGY),
    "seal_friction": Kind(
        "total", _rubs, (0.02, 0.4), _uniform(way=(0.003, 0.03)), laws=(*SPRINGY[:4], *FLUIDS, "mgmm")
    ),
    "stribeck_friction": Kind(
        "total",
        _stribeck,
        (0.02, 0.3),
        _uniform(rise=(0.3, 1.2), at=(0.1, 0.5)),
        laws=(*SPRINGY[:4], *FLUIDS[:2], "mgmm"),
    ),
    "viscous_branch": Kind("total", _dashes, (0.02, 0.4), laws=SLIDERS),
    "square_damping": Kind("total", _squares, (0.02, 0.4), laws=("kelvin_voigt", "viscous", "lead_rubber", "bouc_wen")),
    "relaxation_branch": Kind(
        "total",
        _relaxes,
        (0.05, 1),
        _uniform(tau=(0.2, 3)),
        laws=("kelvin_voigt", "lead_rubber", "zener", "bouc_wen", "viscous"),
    ),
    "end_stop": Kind("total", _stops, (0.1, 3), _uniform(at=(0.5, 0.85))),
    "gas_spring": Kind("total", _gas, (0.03, 0.4), _uniform(length=(1.8, 4)), laws=("kelvin_voigt", *FLUIDS)),
    "first_movement_peak": Kind(
        "total", _first, (0.05, 0.6), _uniform(way=(0.3, 3)), laws=(*SLIDERS[:5], "kelvin_voigt", "mgmm")
    ),
    "flexible_frame": Kind("series", _nothing, (0.01, 0.3), laws=_NO_SPRING),
    "bearing_play": Kind("series", _nothing, (0.003, 0.1)),
    "clamp_slip": Kind("series", _nothing, (0.05, 0.4)),
    "moving_mass": Kind("rig", _mass, (0.01, 0.3)),
    "guide_friction": Kind("rig", _guides, (0.02, 0.3), laws=(*SPRINGY[:4], *FLUIDS, "bouc_wen", "mgmm")),
    "dead_weight": Kind("rig", _weighs, (0.02, 0.4), _sign),
    "load_cell_hysteresis": Kind("instrument", _cell_lags, (0.03, 0.3)),
    "cell_nonlinearity": Kind("instrument", _bows, (0.02, 0.2), _sign),
    "channel_lag": Kind("instrument", _late, (0.01, 0.2)),
    "unequal_filters": Kind("instrument", _filters, (0.01, 0.3), lambda rng: {"poles": int(rng.choice([1, 2]))}),
    "force_drift": Kind("instrument", _drifts, (0.02, 0.4), _sign),
    "force_clipping": Kind("instrument", _clips, (0.05, 0.5)),
    "mains_hum": Kind("instrument", _hums, (0.01, 0.2), lambda rng: {"mains": float(rng.choice([50.0, 60.0]))}),
    "spikes": Kind("instrument", _spikes, (0.02, 0.4), _uniform(share=(0.001, 0.01))),
    "gain_of_one_test": Kind("single", _gain, (0.03, 0.5), _sign),
    "displacement_gain_of_one_test": Kind(
        "single", _stroke, (0.03, 0.4), _sign, laws=(*SPRINGY, "bouc_wen", "viscous", "mgmm")
    ),
    "clock_of_one_test": Kind("single", _clock, (0.02, 0.4), _sign, laws=(*FLUIDS, *SPRINGY[:4], "mgmm")),
    "sign_of_one_test": Kind("single", _turned, (1, 1)),
    "zero_of_one_test": Kind("single", _weighs, (0.03, 0.6), _sign),
    "lag_of_one_test": Kind("single", _late, (0.02, 0.4)),
    "temperature_of_one_test": Kind("single", _typed, (6, 30), _sign, needs="temperature"),
}

UNLISTED: dict[str, Kind] = {
    "stick_slip_with_memory": Kind("total", _sticks, (0.03, 0.5), _uniform(way=(0.2, 1))),
    "periodic_stiffness": Kind("total", _rack, (0.03, 0.5), _uniform(pitch=(0.15, 0.5), phase=(0, 6.28))),
    "late_valve": Kind(
        "total", _opens_late, (0.05, 0.6), _uniform(opens=(0.35, 0.55), shuts=(0.15, 0.3), late=(0.02, 0.08))
    ),
    "crack_in_one_test": Kind(
        "total",
        _cracks,
        (0.03, 0.5),
        lambda rng: {"test": int(rng.integers(1, 4)), "from": float(rng.uniform(0.1, 0.5))},
    ),
    "catching_tooth": Kind("total", _catches, (0.1, 1.5), _uniform(place=(-0.4, 0.3), way=(0.08, 0.3))),
    "cavitation_void": Kind("total", _cavitates, (0.1, 0.9), _uniform(fast=(0.3, 1))),
    "pump_ripple": Kind("total", _ripples, (0.02, 0.4), _uniform(pump=(2.2, 6.5))),
    "rattle_at_reversal": Kind("total", _rattles, (0.03, 0.6), _uniform(ring=(5, 12))),
    "wandering_centre": Kind("total", _wanders, (0.03, 0.5)),
    "two_level_film": Kind("total", _films, (0.03, 0.5)),
}
KINDS |= UNLISTED

LISTED = tuple(name for name in KINDS if name not in UNLISTED)
