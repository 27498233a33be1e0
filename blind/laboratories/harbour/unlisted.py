"""Effects that are in no list: what a laboratory does not think of."""

import numpy as np
from scipy.signal import butter, sosfiltfilt

UNLISTED = {
    "slip": (
        "anchorage_slip",
        "rig",
        "anchorage gives way by `size` (in 20 ms) in the direction of the force whenever |F| > F_s",
    ),
    "clamp": ("clamping_hunts", "rig", "F_law (1 + size sin(2 pi f t + phi_i)): pressure of the clamping jacks hunts"),
    "freeze": (
        "telemetry_freezes",
        "instrument",
        "force channel holds its last value from times t_ij on, for `size` s each",
    ),
    "bolt": ("loose_bolt", "rig", "F_measured = F + size L_i(t), L jumps at random times to random levels"),
    "cross": (
        "transverse_crosstalk",
        "instrument",
        "F_measured = F + size w_i(t), w motion of a transverse actuator, not recorded",
    ),
    "dead": ("amplifier_dead_band", "instrument", "F_measured = 0 where |F| < size"),
    "clip": (
        "clipped_load_cell",
        "instrument",
        "|F_measured| <= F_peak (1 - size): the amplifier of the load cell is at its end in the strongest cycles",
    ),
    "crack": ("cracked_layer", "damper", "F_law (1 - size) for u > 0 from t_0 on in the tests listed: a crack opens"),
    "burst": (
        "bursts",
        "instrument",
        "F_measured = F + size b_i(t), half sines of 40 to 200 ms at random times, either sign",
    ),
    "clock": (
        "clock_wander",
        "instrument",
        "F_measured(t) = F(t - size sin(2 pi f t + phi_i)): clocks of two recorders",
    ),
}


def draw_unlisted(rng, camp, name):
    sc, n = camp["sc"], camp["sc"]["n"]
    title, kind, equation = UNLISTED[name]
    T = [float(t["t"][-1]) for t in camp["tests"]]
    p = {}
    if name == "slip":
        p = dict(F_s=sc["F"] * rng.uniform(0.5, 0.8), size=sc["u"] * rng.uniform(0.03, 0.1))
    elif name == "clamp":
        p = dict(size=rng.uniform(0.04, 0.12), f=rng.uniform(0.13, 0.5), phi=rng.uniform(0, 6.28, n).tolist())
    elif name == "freeze":
        p = dict(
            size=rng.uniform(0.1, 0.25),
            times=[sorted(rng.uniform(1.2, t - 0.5, max(3, int(t / 2.2))).tolist()) for t in T],
        )
    elif name == "bolt":
        p = dict(
            size=0.08 * sc["F"],
            times=[sorted(rng.uniform(0.5, t, int(t / 3) + 1).tolist()) for t in T],
            levels=[rng.uniform(-1, 1, int(t / 3) + 1).tolist() for t in T],
        )
    elif name == "cross":
        p = dict(
            size=0.04 * sc["F"], seed=int(rng.integers(1 << 30)), band=[rng.uniform(0.3, 0.8), rng.uniform(1.5, 4)]
        )
    elif name == "dead":
        p = dict(size=sc["F"] * rng.uniform(0.05, 0.15))
    elif name == "clip":
        p = dict(size=rng.uniform(0.15, 0.3), F_peak=sc["F"])
    elif name == "crack":
        fit = [i for i in camp["fit"] if i > 0]
        j = int(rng.choice(fit))
        p = dict(size=rng.uniform(0.2, 0.4), tests=[j] + ([j + 1] if j + 1 < n else []), t_0=0.35 * T[j])
    elif name == "burst":
        p = dict(
            size=0.3 * sc["F"],
            times=[sorted(rng.uniform(1.2, t - 0.5, max(2, int(t / 3))).tolist()) for t in T],
            lengths=[rng.uniform(0.04, 0.2, max(2, int(t / 3))).tolist() for t in T],
            heights=[
                (rng.choice([-1, 1], max(2, int(t / 3))) * rng.uniform(0.4, 1, max(2, int(t / 3)))).tolist() for t in T
            ],
        )
    else:
        p = dict(size=rng.uniform(0.01, 0.03), f=rng.uniform(0.1, 0.4), phi=rng.uniform(0, 6.28, n).tolist())
    return dict(name=name, form=1, title=title, kind=kind, equation=equation, par=p)


def unlisted_arrays(e, i, t):
    fac, crack = np.ones_like(t), np.zeros_like(t)
    if e and e["name"] == "clamp":
        fac = 1 + e["par"]["size"] * np.sin(2 * np.pi * e["par"]["f"] * t + e["par"]["phi"][i])
    if e and e["name"] == "crack" and i in e["par"]["tests"]:
        crack = e["par"]["size"] * (t > e["par"]["t_0"] if i == e["par"]["tests"][0] else np.ones_like(t))
    return fac, crack


def unlisted_channel(e, i, t, F):
    if not e:
        return F
    n, p, _dt = e["name"], e["par"], t[1] - t[0]
    if n == "freeze":
        F = F.copy()
        for t0 in p["times"][i]:
            a, b = np.searchsorted(t, [t0, t0 + p["size"]])
            F[a:b] = F[min(a, F.size - 1)]
    elif n == "bolt":
        k = np.searchsorted(np.array(p["times"][i]), t, side="right")
        F = F + p["size"] * np.concatenate([[0.0], p["levels"][i]])[k]
    elif n == "cross":
        m = int(t[-1] * 200) + 2  # the same motion on every grid
        w = np.random.default_rng([p["seed"], i]).standard_normal(m)
        w = sosfiltfilt(butter(2, p["band"], btype="bandpass", fs=200, output="sos"), w)
        F = F + p["size"] * np.interp(t, np.arange(m) / 200, w / w.std())
    elif n == "dead":
        F = np.where(np.abs(F) < p["size"], 0.0, F)
    elif n == "clip":
        F = np.clip(F, -p["F_peak"] * (1 - p["size"]), p["F_peak"] * (1 - p["size"]))
    elif n == "burst":
        F = F.copy()
        for t0, d, h in zip(p["times"][i], p["lengths"][i], p["heights"][i], strict=False):
            s = (t - t0) / d
            F += p["size"] * h * np.where((s > 0) & (s < 1), np.sin(np.pi * np.clip(s, 0, 1)), 0)
    elif n == "clock":
        F = np.interp(t - p["size"] * np.sin(2 * np.pi * p["f"] * t + p["phi"][i]), t, F)
    return F
