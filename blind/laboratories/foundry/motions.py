"""Motions of the tests, and the programme of a campaign."""

import numpy as np
from scipy.interpolate import BSpline, make_interp_spline


class Kin:
    """A motion on a grid of times; for rate-independent laws also its path through all turning points."""

    def __init__(self, spline, t):
        self.t, self.h = t, t[1] - t[0]
        self.u = spline(t)
        self.v = spline(t, 1)
        self.a = spline(t, 2)
        self.spline = spline
        self._path = None

    def shifted(self, off):
        k = Kin.__new__(Kin)
        k.t, k.h, k.v, k.a, k.spline = self.t, self.h, self.v, self.a, self.spline
        k.u = self.u + off
        k._path = None
        k.off = off
        return k

    def path(self):
        """Displacements at grid and turning points, and where the grid points stand among them."""
        if self._path is None:
            off = getattr(self, "off", 0.0)
            i = np.nonzero(self.v[:-1] * self.v[1:] < 0)[0]
            tt = self.t[i] - self.v[i] * self.h / (self.v[i + 1] - self.v[i])
            x = self.spline(tt) + off
            where = np.arange(len(self.t)) + np.searchsorted(tt, self.t)
            u = np.empty(len(self.t) + len(i))
            u[where] = self.u
            u[i + 1 + np.arange(len(i))] = x
            self._path = (u.tolist(), where)
        return self._path


def smooth_motion(raw, rate, width):
    """Raw command at `rate`, freed from corners as an actuator does; a spline through it."""
    n = max(3, int(width * rate) | 1)
    w = np.hanning(n + 2)[1:-1]
    w /= w.sum()
    x = np.concatenate([np.full(n, raw[0]), raw, np.full(n, raw[-1])])
    x = np.convolve(np.convolve(x, w, "same"), w, "same")[n:-n]
    t = np.arange(len(x)) / rate
    return make_interp_spline(t, x, k=5)


def window(t, T, rise):
    return np.clip(t / rise, 0, 1) * np.clip((T - t) / rise, 0, 1)


def draw_motion(kind, rng, U, f0, vcap, level, ratio):
    """A spline of the motion and its duration. level: share of U; ratio: frequency over f0."""
    rate, rest = 1000.0, rng.uniform(0.3, 0.7)
    f = f0 * ratio
    A = min(level * U, vcap / (2 * np.pi * f))
    if kind == "sine":
        T = float(np.clip(rng.integers(5, 9) / f, 5, 16))
        t = np.arange(0, T, 1 / rate)
        u = A * np.sin(2 * np.pi * f * t) * window(t, T, 1 / f)
    elif kind == "steps":
        shares = [0.35, 0.7, 1.0, 0.7, 0.35] if rng.random() < 0.5 else [0.3, 1.0, 0.5, 0.8, 0.25]
        n = 2 if f < 0.8 else 3
        f = max(f, len(shares) * n / 18.0)
        A = min(A, vcap / (2 * np.pi * f))
        T = len(shares) * n / f
        t = np.arange(0, T, 1 / rate)
        part = np.minimum((t * f / n).astype(int), len(shares) - 1)
        env = np.convolve(np.array(shares)[part], np.ones(int(0.5 / f * rate)) / int(0.5 / f * rate), "same")
        u = A * env * np.sin(2 * np.pi * f * t) * window(t, T, 0.3 / f)
    elif kind == "sweep":
        T = rng.uniform(9, 16)
        fa, fb = 0.35 * f, 2.2 * f
        if rng.random() < 0.4:
            fa, fb = fb, fa
        t = np.arange(0, T, 1 / rate)
        r = np.log(fb / fa)
        phase = 2 * np.pi * fa * T / r * (np.exp(r * t / T) - 1)
        now = fa * np.exp(r * t / T)
        u = np.minimum(A, vcap / (2 * np.pi * now)) * np.sin(phase) * window(t, T, 1.0)
    elif kind == "quake":
        T = rng.uniform(10, 19)
        t = np.arange(0, T, 1 / rate)
        fr = np.exp(np.linspace(np.log(0.3 * f), np.log(5 * f), 70))
        fc, z = f * rng.uniform(0.8, 1.3), rng.uniform(0.25, 0.5)
        s = fr**0.5 / ((1 - (fr / fc) ** 2) ** 2 + (2 * z * fr / fc) ** 2) ** 0.5 / (1 + (fr / fc) ** 2)
        phases = rng.uniform(0, 6.283, len(fr))
        u = sum(a * np.sin(2 * np.pi * b * t + p) for a, b, p in zip(s, fr, phases, strict=True))
        tr, td = 0.2 * T, 0.5 * T
        env = np.where(t < tr, (t / tr) ** 2, np.where(t < td, 1.0, np.exp(-3 * (t - td) / (T - td))))
        u = u * env * window(t, T, 1.0)
        u *= level * U / np.abs(u).max()
        u *= min(1.0, 1.1 * vcap / np.abs(np.gradient(u, 1 / rate)).max())
    elif kind == "ramp":
        T = rng.uniform(10, 18)
        corners = np.array([0, 0.12, 0.2, 0.42, 0.5, 0.66, 0.72, 0.86, 1.0]) * T
        values = A * np.array([0, 1, 1, -1, -1, 0.55, 0.55, -0.4, 0])
        t = np.arange(0, T, 1 / rate)
        u = np.interp(t, corners, values)
    else:  # small fast cycles about a slow large one
        T = rng.uniform(9, 15)
        t = np.arange(0, T, 1 / rate)
        slow, fast = 0.25 * f, 1.9 * f
        u = (0.7 * A * np.sin(2 * np.pi * slow * t) + 0.22 * A * np.sin(2 * np.pi * fast * t)) * window(t, T, 1.0)
    tail = rng.uniform(0.2, 0.5)
    u = np.concatenate([np.zeros(int(rest * rate)), u, np.zeros(int(tail * rate))])
    spline = smooth_motion(u, rate, 0.05)
    return spline, (len(u) - 1) / rate, A, f


def programme(rng, U, f0, vcap):
    """The tests of a campaign: motions, uses, order."""
    n_fit, n_val = int(rng.integers(5, 9)), int(rng.integers(2, 4))
    n_fit = min(n_fit, 11 - n_val)
    kinds = ["steps", "sweep", "sine"] + list(
        rng.choice(["steps", "sine", "quake", "ramp", "mixed", "sweep", "quake"], n_fit - 3)
    )
    levels = [1.0, 0.65, 0.3] + list(rng.choice([1.0, 0.9, 0.7, 0.5, 0.35], n_fit - 3))
    ratios = [0.6, 1.0, 1.8] + list(rng.choice([0.3, 0.6, 1.0, 1.5], n_fit - 3))
    plan = [
        (k, level * rng.uniform(0.94, 1.0) if level < 1 else 1.0, r * rng.uniform(0.9, 1.1), "fit")
        for k, level, r in zip(kinds, levels, ratios, strict=True)
    ]
    rng.shuffle(plan)
    plan = [(str(k), float(level), float(r), str(u)) for k, level, r, u in plan]
    for j in range(n_val):
        kind = str(rng.choice(["quake", "sine", "steps", "sweep"])) if j else "quake"
        item = (
            kind,
            float(rng.uniform(0.45, 0.92)),
            float(rng.choice([0.45, 0.8, 1.25]) * rng.uniform(0.95, 1.05)),
            "validate",
        )
        plan.insert(int(rng.integers(2, len(plan) + 1)), item)
    motions = [draw_motion(kind, rng, U, f0, vcap, level, ratio) for kind, level, ratio, _ in plan]
    fast = [float(np.abs(m[0](np.arange(0, m[1], 0.002), 1)).max()) for m in motions]
    fastest = max(x for x, item in zip(fast, plan, strict=True) if item[3] == "fit")
    tests = []
    for i, (kind, _level, _ratio, use) in enumerate(plan):
        spline, T, A, f = motions[i]
        if fast[i] > fastest:  # no validation test is faster than all of those fitted to
            spline, A = BSpline(spline.t, spline.c * 0.95 * fastest / fast[i], spline.k), A * 0.95 * fastest / fast[i]
        title = {
            "sine": f"sine {f:.2f} Hz, {A:.1f} mm",
            "steps": f"amplitude steps to {A:.1f} mm at {f:.2f} Hz",
            "sweep": f"frequency sweep about {f:.2f} Hz, {A:.1f} mm",
            "quake": f"earthquake-like motion {chr(97 + i)}",
            "ramp": f"ramps and holds, {A:.1f} mm",
            "mixed": f"small cycles on a slow one, {A:.1f} mm",
        }[kind]
        tests.append(
            {
                "index": i,
                "kind": kind,
                "title": title,
                "use": use,
                "spline": spline,
                "duration": T,
                "T": 20.0,
                "Q": 0.0,
                "cut": 0.0,
                "start": None,
            }
        )
    return tests
