"""Programmes of tests: laws with parameters, motions, sampling, cuts, temperatures, conditions."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from blind.laboratories.wharf.laws import LAWS
from blind.laboratories.wharf.motions import FINE, PER_PERIOD, Plan

Array = NDArray[np.float64]

RATES = (25, 30, 40, 50, 60, 64, 80, 100, 120, 128, 150, 200, 240, 250, 256, 300, 400, 500, 512, 600, 800, 1000)
ROWS = 9000  # most of a test
CONDITIONS = {"current_A": (0.3, 2.0), "gas_pressure_MPa": (0.4, 2.0), "bolt_force_kN": (20.0, 120.0)}


@dataclass(frozen=True)
class Test:
    """A test of a programme."""

    name: str
    plan: Plan
    use: str
    sampling: int  # Hz
    stride: int  # points of the fine grid a sample
    start: float  # s of the fine grid that the record leaves out
    end: float  # s
    temperature: float
    condition: float  # 1: the mean
    in_motion: bool
    note: str = ""


@dataclass(frozen=True)
class Size:
    """Of the device."""

    force: float  # kN
    u: float  # mm
    frequency: float  # Hz

    @property
    def v(self) -> float:
        """Speed, mm/s."""
        return 2 * np.pi * self.frequency * self.u


def size(rng: np.random.Generator) -> Size:
    """Of a device between a strut of a laboratory and an isolator of a bridge."""
    return Size(_log(rng, 30, 900), _log(rng, 8, 120), _log(rng, 0.15, 1.5))


def parameters(law: str, of: Size, rng: np.random.Generator) -> Array:
    """True parameters of a law for a device."""
    k, c = of.force / of.u, of.force / of.v
    u = rng.uniform
    alpha = float(u(0.15, 0.8))
    values: list[float]
    cp = of.force / of.v**alpha
    tau = float(u(0.3, 2)) / (2 * np.pi * of.frequency)
    match law:
        case "kelvin_voigt":
            share = u(0.15, 0.8)
            values = [k * share, c * float(np.sqrt(1 - share**2))]
        case "zener":
            values = [k * u(0.2, 0.7), k * (stiff := u(0.4, 1.2)), k * stiff * tau]
        case "maxwell":
            values = [c * u(0.8, 1.3), tau * 0.4]
        case "generalised_maxwell":
            one, two = u(0.3, 0.8), u(0.3, 0.8)
            values = [k * u(0.2, 0.5), k * one, k * one * tau * 2, k * two, k * two * tau * 0.15]
        case "viscous":
            values = [c]
        case "viscous_power":
            values = [cp, alpha]
        case "asymmetric_viscous":
            values = [cp * u(0.9, 1.3), cp * u(0.6, 0.9), alpha]
        case "bilinear_oil":
            relief = of.force * u(0.35, 0.7)
            values = [c * u(1.0, 1.8), relief, u(0.03, 0.3)]
        case "maxwell_power":
            values = [cp, alpha, k * u(3, 12)]
        case "friction":
            values = [mu := u(0.1, 0.5), of.force / mu, k * u(10, 50)]
        case "elastic_plastic":
            values = [k * (stiff := u(4, 15)), of.force * u(0.5, 0.8), u(0.01, 0.3) / stiff]
        case "lead_rubber":
            values = [of.force * (q := u(0.3, 0.6)), k * (1 - q), of.u * u(0.03, 0.15)]
        case "friction_pendulum":
            fast = u(0.05, 0.12)
            weight = of.force * 0.5 / fast
            values = [weight, weight / (0.5 * k), fast * u(0.3, 0.7), fast, u(2, 8) / of.v, of.u * u(0.004, 0.02)]
        case "self_centring":
            values = [k * (stiff := u(3, 10)), of.force * u(0.4, 0.7), u(0.1, 0.4) / stiff, u(0.4, 0.95)]
        case "bouc_wen":
            beta = u(0.3, 0.7)
            values = [of.force * u(0.5, 0.8), of.u * u(0.05, 0.2), u(0.01, 0.1), 1.0, beta, 1 - beta, u(1, 3)]
        case "modified_bouc_wen":
            beta = u(0.3, 0.7)
            one, two, bend = k * u(0.5, 1.5), k * u(0.7, 1.5), of.u * u(0.15, 0.4)
            values = [one, two, of.u * u(0.2, 0.6), bend, u(0.2, 0.5), 1.0, beta, 1 - beta, u(1, 2), 0.25 * cp, alpha]
        case "mgmm":
            first = k * u(0.05, 0.2)
            branch, middle = [first, first * u(0.01, 0.05) / of.frequency], k * u(0.02, 0.1)
            alpha = u(0.3, 0.5)
            nonlinear = of.force * u(0.1, 0.25) / of.v**alpha
            springs = [k * u(0.2, 0.5), k * u(0.3, 0.6), of.u * u(0.25, 0.6)]
            values = [
                *branch,
                middle,
                nonlinear,
                alpha,
                *springs,
                c * u(0.15, 0.4),
                c * u(0.1, 0.3),
                of.v * u(0.2, 0.5),
            ]
        case _:
            order = u(0.2, 0.6)
            values = [k * u(0.3, 0.6), u(0.5, 1.2) / (2 * np.pi * of.frequency) ** order, order]
    return np.array([float(f"{value:.5g}") for value in values])


def declared(law: str, values: Array, rng: np.random.Generator) -> tuple[Array, bool]:
    """Parameters that the campaign states: the true ones in a third, else 3 to 30 % off; and whether they are true."""
    if rng.random() < 1 / 3:
        return values.copy(), True
    stated = values.copy()
    for i in LAWS[law].free:
        stated[i] *= 1 + rng.choice([-1, 1]) * rng.uniform(0.03, 0.3)
        name = LAWS[law].names[i]
        if name in ("b", "alpha", "beta", "p") and values[i] < 1:
            stated[i] = min(stated[i], 0.97)
        if name == "n":
            stated[i] = max(stated[i], 1.0)
        stated[i] = float(f"{stated[i]:.4g}")
    if law == "friction_pendulum":
        stated[2] = min(stated[2], stated[3])
    return stated, False


def tests(of: Size, rng: np.random.Generator, needs: set[str], warm: bool) -> tuple[list[Test], bool]:
    """A programme.

    Args:
        of: the device.
        rng: draws.
        needs: what an effect needs to be seen: temperature, condition.
        warm: whether temperatures may differ otherwise.

    Returns:
        Tests in order, and whether some begin in motion.
    """
    number = int(rng.integers(5, 8))
    actuator = (float(rng.uniform(6, 20)) * max(of.frequency, 0.5), float(rng.uniform(0.45, 0.9)))
    top = float(rng.uniform(12, 36)) if rng.random() < 0.7 else float(rng.uniform(4, 12))
    coarse = bool(rng.random() < 0.55)
    a_period = rng.uniform(8, 20) if coarse else rng.uniform(25, 70)
    same_rate = bool(rng.random() < 0.5)
    in_motion = bool(rng.random() < 0.3)
    rests = float(rng.uniform(0.2, 1.0)) if rng.random() < 0.5 else 0.0
    kinds = [str(kind) for kind in rng.choice(["sine", "sine", "stairs", "dwell", "triangle", "sweep"], number - 3)]
    kinds += ["random", "earthquake", str(rng.choice(["sine", "random", "earthquake"]))]
    uses = ["fit"] * (number - 2) + ["validate", "validate" if rng.random() < 0.6 else "fit"]
    plans = []
    for kind in kinds:
        frequency = of.frequency * float(rng.choice([0.3, 0.6, 1.0, 1.0, 1.6, 2.5]))
        amplitude = of.u * float(rng.choice([0.25, 0.5, 0.75, 1.0])) * min(1.0, 1.6 * of.frequency / frequency)
        if kind in ("random", "earthquake"):
            frequency, amplitude = of.frequency, of.u * float(rng.uniform(0.6, 1.0))
        seconds = float(np.clip(rng.uniform(4, 9) / frequency, 6, 26))
        fastest = top if kind in ("random", "earthquake") else frequency * (3.0 if kind in ("sine", "stairs") else 6.0)
        if kind == "sweep":
            fastest = min(4 * frequency, 12.0)
        ramp = float(rng.choice([0.15, 0.5, 1.0, 2.0]))
        seed = int(rng.integers(1 << 30))
        plans.append(Plan(kind, amplitude, frequency, fastest, seconds, rests, seed, actuator, ramp))
    order = [int(i) for i in rng.permutation(number)] if rng.random() < 0.3 else list(range(number))
    plans, uses = [plans[i] for i in order], [uses[i] for i in order]
    if rng.random() < 0.3 and "fit" in uses:
        place = uses.index("fit")
        plans.append(plans[place])  # repeated at the end
        uses.append("fit")
    if rng.random() < 0.3:
        warm_up = Plan(
            "sine", 0.4 * of.u, of.frequency, 3 * of.frequency, min(6 / of.frequency, 15), rests, 1, actuator, 1
        )
        plans, uses = [warm_up, *plans], ["fit", *uses]
    temperatures = np.full(len(plans), 20.0)
    if "temperature" in needs or (warm and rng.random() < 0.3):
        temperatures = np.round(rng.choice([5, 12, 20, 20, 28, 35], len(plans)) + rng.uniform(-1, 1, len(plans)), 1)
        temperatures[int(rng.integers(len(plans)))] = 20.0
    conditions = np.ones(len(plans))
    if "condition" in needs:
        conditions = rng.choice([0.5, 0.75, 1.0, 1.25, 1.5], len(plans))
    quickest = max(plan.top for plan in plans)
    made = []
    for i, (plan, use) in enumerate(zip(plans, uses, strict=True)):
        longest = plan.seconds + plan.rest
        wanted = min(a_period * (quickest if same_rate else plan.top), ROWS / longest)
        rate = min(RATES, key=lambda r: abs(np.log(r / max(wanted, 8 * plan.top))))
        stride = int(np.ceil(max(FINE, PER_PERIOD * plan.top) / rate))
        start, end = 0.0, longest
        cut = in_motion and rng.random() < 0.6 and plan.kind != "earthquake"
        if cut:
            start = plan.rest + float(rng.uniform(0.2, 0.45)) * plan.seconds
        if rng.random() < 0.4:
            end = plan.rest + float(rng.uniform(0.8, 0.98)) * plan.seconds
        made.append(
            Test(
                f"t{i + 1:02d}_{plan.kind}",
                plan,
                use,
                rate,
                stride,
                start,
                end,
                float(temperatures[i]),
                float(conditions[i]),
                cut,
            )
        )
    if in_motion and not any(test.in_motion for test in made):
        place = next(i for i, test in enumerate(made) if test.plan.kind != "earthquake")
        plan = made[place].plan
        made[place] = replace(made[place], in_motion=True, start=plan.rest + 0.3 * plan.seconds)
    return made, in_motion


def _log(rng: np.random.Generator, low: float, high: float) -> float:
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))
