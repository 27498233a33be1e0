"""One campaign: law, programme, effects of a size that can be seen, records."""

import math

import numpy as np

from .effects import Effect
from .laws import LINEAR, declare, draw_law
from .motions import programme
from .noise import draw_noise, measured
from .response import refit_residual, simulate

FINE = 4000.0  # steps a second at least


def build(rng, law, names):
    """None if an effect is too small or too large in what was drawn."""
    F = float(np.exp(rng.uniform(np.log(1.5), np.log(900))))
    U = float(np.clip(12 * (F / 20) ** 0.25 * np.exp(rng.uniform(-0.6, 0.9)), 4, 150))
    f0 = float(np.exp(rng.uniform(np.log(0.4), np.log(1.3))))
    if "inertia" in names or "lag" in names:
        f0 = max(f0, 0.8)
    w = 2 * np.pi * f0
    V = w * U
    fs = float(rng.choice([200, 250, 256, 300, 400, 500]))
    over = 4 * int(math.ceil(_fine(law, names) / fs / 4))
    tests = programme(rng, U, f0, 1.25 * V)
    p = draw_law(law, rng, F, U, w)
    declared = declare(law, p, rng, V)
    Q = conditions(rng, law, names, tests)
    for t in tests:
        t["V"] = V
    # sizes of the campaign, of the law alone
    base = simulate(law, p, [], tests, fs, 4)
    peak = max(float(np.abs(f).max()) for _, _, f in base)
    path = sum(float(np.abs(np.diff(u)).sum()) for _, u, _ in base)
    work = sum(float((0.5 * (f[1:] + f[:-1]) * np.diff(u)).sum()) for _, u, f in base)
    amax = max(
        float(np.percentile(np.abs(t["spline"](np.arange(0, t["duration"], 0.005), 2)), 99))
        for t in tests
        if t["use"] == "fit"
    )
    n = len(tests)
    c = {
        "F": peak,
        "U": U,
        "V": V,
        "A": amax,
        "w": w,
        "fs": fs,
        "T0": 1 / f0,
        "S": path,
        "W": work,
        "n_tests": n,
        "T": float(np.mean([t["duration"] for t in tests])),
        "jump": int(rng.integers(2, n - 2)),
        "alpha": p.get("alpha", 1.0),
        "k_el": p.get("k", p.get("k0", 0)) if law in LINEAR else 0.0,
    }
    noise = draw_noise(rng, peak, U)
    effects = [Effect(e, law, rng, c) for e in names]
    sizes = []
    for e in effects:
        size = sized(e, rng, law, p, tests, fs, base, noise["sigma"])
        if size is None:
            return None
        sizes.append(size)
    result = simulate(law, p, effects, tests, fs, over)
    if not max(float(np.abs(f).max()) for _, _, f in result) < 1.45 * peak:
        return None
    # starts in motion: the head of some records was cut off
    if rng.random() < 0.4:
        t = tests[int(rng.integers(0, n))]
        if t["kind"] in ("sine", "sweep", "steps") and t["duration"] > 8:
            t["cut"] = float(0.7 + 0.15 * t["duration"])
            t["start"] = "in_motion" if rng.random() < 0.6 else None
    records, floor, floor_u = measured(rng, law, tests, result, noise, fs)
    return {
        "law": law,
        "p": p,
        "declared": declared,
        "effects": effects,
        "sizes": sizes,
        "tests": tests,
        "records": records,
        "floor": floor,
        "floor_u": floor_u,
        "Q": Q,
        "fs": fs,
        "noise": noise,
    }


def _fine(law, names):
    fine = FINE
    if law in ("viscous_power", "mgmm", "friction_pendulum") or "velocity_exponent" in names or "friction" in names:
        fine *= 8 if "lag" in names else (4 if law == "mgmm" else 1)  # roots of the velocity, filtered
    if law in ("viscous_power", "bilinear_oil") and {"play", "series_flexibility"} & set(names):
        fine *= 1.5
    return fine


def conditions(rng, law, names, tests):
    """Temperatures of the tests, and settings of the damper: their name and range, None where there are none."""
    if "temperature_law" in names:
        levels = rng.choice([8.0, 14.0, 20.0, 26.0, 33.0], len(tests))
        fits = [i for i, t in enumerate(tests) if t["use"] == "fit"]
        order = [8.0, 33.0, 20.0, 26.0, 14.0]
        rng.shuffle(order)
        for j, i in enumerate(fits):
            levels[i] = order[j % 5]
        for t, x in zip(tests, levels, strict=True):
            t["T"] = float(x + np.round(rng.uniform(-0.6, 0.6), 1))
    elif law != "mgmm":
        for t in tests:
            t["T"] = float(20 + np.round(rng.uniform(-0.8, 0.8), 1))
    if "condition" not in names:
        return None
    fits = [t for t in tests if t["use"] == "fit"]
    cycle = [1.0, 0.0, 0.5]
    rng.shuffle(cycle)
    for j, t in enumerate(fits):
        t["Q"] = cycle[j % 3]
    for t in tests:
        if t["use"] != "fit":
            t["Q"] = float(rng.choice([0.0, 0.5, 1.0]))
    return {"friction": ("clamping_pressure_MPa", 2.0, 6.0), "bouc_wen": ("current_A", 0.0, 2.0)}.get(
        law, ("clicks", 2, 14)
    )


def sized(e, rng, law, p, tests, fs, base, sigma):
    """Set the size of an effect, so that alone it leaves more than noise after a refit, in a third of the tests to fit.

    None if it cannot be.
    """
    target = float(np.exp(rng.uniform(np.log(0.025), np.log(0.12))))  # rms share of the force that the law cannot take
    stiff = bool(e.series()) and law in ("viscous_power", "bilinear_oil")
    if stiff:
        e.s, target = max(e.s, 0.04), max(target, 0.04)
    for _trial in range(4 if stiff else 5):
        e.build()
        with np.errstate(all="ignore"):
            alone = simulate(law, p, [e], tests, fs, 4 * int(math.ceil(3000 / fs / 4)) if stiff else 4)
        if not all(np.isfinite(a[2]).all() for a in alone):
            return None
        size = math.sqrt(
            sum(np.sum((a[2] - b[2]) ** 2) for a, b in zip(alone, base, strict=True))
            / sum(np.sum(a[2] ** 2) for a in alone)
        )
        left = refit_residual(law, p, alone, tests, fs, sigma)
        if e.name == "gain" and e.form == "displacement":
            # the force is as it was: what is left is seen in the displacement; take the force's change by the tangent
            changed = [
                (a, b, f / (1 + e.par["gain"] * (t["index"] >= e.c["jump"])))
                for (a, b, f), t in zip(alone, tests, strict=True)
            ]
            left = refit_residual(law, p, changed, tests, fs, sigma)
            size = abs(e.par["gain"])
        fit = [x for x, t in zip(left, tests, strict=True) if t["use"] == "fit"]
        seen = sum(x > 2.5 for x in fit)
        ok = seen >= max(2, len(fit) / 3) and np.mean(fit) > 4
        share = math.sqrt(
            sum(x * len(a[2]) for x, a in zip(left, alone, strict=True))
            * sigma**2
            / sum(np.sum(a[2] ** 2) for a in alone)
        )
        if e.name == "extremes" or (ok and 0.65 < share / target < 1.6):
            break
        e.s *= min(2.5, max(0.5 if stiff else 0.3, target / max(share, 1e-6)))
    if not ok or size > 0.3 or not 0.012 < share < 0.2:
        return None
    return {
        "rms_share_of_force": round(size, 4),
        "rms_share_after_refit": round(share, 4),
        "over_noise_after_refit": [round(x, 1) for x in left],
        "fit_tests_that_see_it": int(seen),
    }
