"""Programmes of a proving ground: reference cycles, sines, sweeps, triangles, steps, holds, earthquake-like noise."""

import numpy as np
from scipy.signal import butter, sosfiltfilt


def smooth(t, a, b):
    s = np.clip((t - a) / max(b - a, 1e-9), 0, 1)
    return s * s * s * (10 - 15 * s + 6 * s * s)


def wave(test, n, dt, fmax, rng):
    """Displacement of length n of the test as commanded, from rest to rest."""
    t = np.arange(n) * dt
    T = n * dt
    a, f, kind = test["amplitude"], test["frequency"], test["kind"]
    lead, tail = 0.4 + 0.4 * rng.random(), 0.5
    ramp = min(1.0 / f, 0.2 * T)
    env = smooth(t, lead, lead + ramp) * (1 - smooth(t, T - tail - ramp, T - tail))
    ph = 2 * np.pi * f * (t - lead)
    if kind in ("sine", "reference"):
        x = np.sin(ph)
        if test["rest"]:
            m = T * (0.4 + 0.2 * rng.random())
            env = env * (
                1 - smooth(t, m, m + ramp / 2) * (1 - smooth(t, m + ramp / 2 + test["rest"], m + ramp + test["rest"]))
            )
    elif kind == "sweep":
        f2 = test["frequency_2"]
        r = np.clip((t - lead) / (T - lead - tail), 0, 1)
        if test["log"]:
            g = np.log(f2 / f)
            ph = 2 * np.pi * f * (T - lead - tail) * (np.exp(g * r) - 1) / g
            inst = f * np.exp(g * r)
        else:
            ph = 2 * np.pi * (T - lead - tail) * (f * r + (f2 - f) * r * r / 2)
            inst = f + (f2 - f) * r
        x = np.sin(ph) * np.minimum(1.0, test["limit"] / (2 * np.pi * inst * a)) * (f / inst) ** test["fall"]
    elif kind == "triangle":
        x = 2 / np.pi * np.arcsin(np.sin(ph))
    elif kind == "steps":
        levels = test["levels"]
        step = np.floor(np.clip((t - lead) / (T - lead - tail), 0, 0.999) * len(levels)).astype(int)
        x = np.sin(ph) * np.asarray(levels)[step]
    elif kind == "hold":
        k = np.floor(np.clip((t - lead) / (T - lead - tail), 0, 0.999) * len(test["levels"])).astype(int)
        x = np.asarray(test["levels"])[k] + 0.0
        sos = butter(2, 2 * dt * f, output="sos")
        x = sosfiltfilt(sos, np.where((t > lead) & (t < T - tail), x, 0.0))
        env = 1.0
    else:  # earthquake: band-limited noise in an envelope after Jennings
        lo, hi = test["band"]
        x = rng.standard_normal(n)
        sos = butter(2, [2 * dt * lo, 2 * dt * hi], "band", output="sos")
        x = sosfiltfilt(sos, x)
        r = np.clip((t - lead) / (T - lead - tail), 0, 1)
        env = (
            np.where(r < 0.15, (r / 0.15) ** 2, np.where(r < 0.5, 1.0, np.exp(-3.0 * (r - 0.5) / 0.5)))
            * (1 - smooth(t, T - tail - 1, T - tail))
            * smooth(t, lead, lead + 0.5)
        )
        x = x * env
        v = np.gradient(x, dt)
        return x * min(a / np.max(np.abs(x)), test["limit"] / np.max(np.abs(v)))
    x = x * env * a
    if kind in ("triangle", "steps"):
        x = sosfiltfilt(butter(2, 2 * dt * 5 * max(fmax, f), output="sos"), np.pad(x, 200))[200:-200]
        x = x * smooth(t, 0, 0.2)
    return x


def programme(rng, size, several):
    """Tests in their order; size has u0, v0, fmax."""
    u0, v0, fmax = size["u0"], size["v0"], size["fmax"]
    n = int(rng.integers(9, 13))
    f0 = min(fmax * 0.6, v0 / (2 * np.pi * u0)) * rng.uniform(0.6, 0.9)
    f0 = max(f0, 0.25)
    ref = dict(
        kind="reference",
        amplitude=min(u0 * rng.uniform(0.4, 0.6), 0.7 * v0 / (2 * np.pi * f0)),
        frequency=f0,
        duration=float(np.round(rng.uniform(8, 11), 1)),
        rest=0.0,
    )

    def fast(a):
        return float(np.clip(v0 / (2 * np.pi * a) * rng.uniform(0.75, 1.0), 0.2, fmax))

    middle = []
    for s in (0.15, 0.5, 1.0):
        a = u0 * s * rng.uniform(0.8, 1.0)
        f = fast(a) if (s == 1.0 or rng.random() < 0.6) else max(0.2, fast(a) * rng.uniform(0.1, 0.4))
        middle.append(dict(kind="sine", amplitude=a, frequency=f))
    a = u0 * rng.uniform(0.3, 0.7)
    middle.append(
        dict(
            kind="sweep",
            amplitude=a,
            frequency=max(0.2, fmax * rng.uniform(0.05, 0.12)),
            frequency_2=fmax * rng.uniform(0.7, 1.0),
            log=bool(rng.random() < 0.5),
            fall=rng.uniform(0.0, 0.5),
        )
    )
    middle.append(
        dict(
            kind="earthquake",
            amplitude=u0 * rng.uniform(0.8, 1.0),
            frequency=fmax / 2,
            band=(rng.uniform(0.15, 0.3), fmax * rng.uniform(0.3, 0.6)),
        )
    )
    a = u0 * rng.uniform(0.4, 0.9)
    middle.append(
        dict(
            kind="triangle",
            amplitude=a,
            frequency=float(np.clip(v0 / (4 * a) * rng.uniform(0.15, 0.6), 0.15, fmax * 0.5)),
        )
    )
    a = u0 * rng.uniform(0.8, 1.0)
    middle.append(
        dict(
            kind="steps",
            amplitude=a,
            frequency=max(0.3, fast(a)),
            levels=[0.25, 0.5, 0.75, 1.0] if rng.random() < 0.6 else [1.0, 0.3, 0.6, 0.15],
        )
    )
    extra = [
        dict(kind="earthquake", amplitude=u0 * rng.uniform(0.5, 1.0), frequency=fmax / 2, band=(0.2, fmax * 0.5)),
        dict(kind="sine", amplitude=u0 * 0.3, frequency=fast(u0 * 0.3)),
        dict(
            kind="hold",
            amplitude=u0 * rng.uniform(0.5, 0.9),
            frequency=rng.uniform(0.8, 2.5),
            levels=[0.4, 0.0, 1.0, -1.0, 0.0] if rng.random() < 0.5 else [1.0, -0.5, 0.5, 0.0],
        ),
    ]
    nref = 3 if n >= 10 else 2
    extra = [extra[i] for i in rng.permutation(len(extra))]
    middle += extra[: n - nref - len(middle)]
    if rng.random() < 0.65:
        middle.sort(key=lambda q: q["amplitude"])
    else:
        middle = [middle[i] for i in rng.permutation(len(middle))]
    tests = [dict(ref)] + middle
    tests.insert(len(tests) // 2 + 1, dict(ref))
    if nref == 3:
        tests.append(dict(ref))
    for q in tests:
        q.setdefault(
            "duration", float(np.round(rng.uniform(9, 22) if q["kind"] != "earthquake" else rng.uniform(14, 28), 1))
        )
        if q["kind"] in ("sine", "triangle", "sweep", "steps"):
            q["duration"] = float(np.clip(max(q["duration"], 4.5 / q["frequency"]), 8, 30))
        q.setdefault("rest", float(rng.uniform(1, 3)) if q["kind"] == "sine" and rng.random() < 0.3 else 0.0)
        q["limit"] = v0
        q["use"] = "fit"
        q["seed"] = int(rng.integers(1 << 31))
    # a third validates: one sine, one earthquake, another motion, a late reference
    third = round(len(tests) / 3)
    order = [k for k in rng.permutation(len(tests)) if k > 0]
    seen = []
    for want in ("sine", "earthquake", "other", "reference"):
        for k in order:
            kind = tests[k]["kind"]
            if (
                len(seen) < third
                and k not in seen
                and (kind == want or (want == "other" and kind in ("sweep", "steps", "triangle", "hold")))
                and k > 1
            ):
                seen.append(k)
                break
    for k in seen:
        tests[k]["use"] = "validate"
    t0 = float(np.round(rng.uniform(18, 25), 1))
    for q in tests:
        q["T"] = t0
    if several:
        d = [0.0, rng.uniform(5, 10), rng.uniform(12, 20)]
        if rng.random() < 0.5:
            d[1] = -d[1]
        for i, q in enumerate(tests[1:], 1):
            q["T"] = float(np.round(t0 + d[[0, 1, 2, 0, 2, 1][i % 6]], 1))
    return tests, t0


def recorded(test, dt, fmax, moving, rng2, v0, u0):
    """Whole motion and the index from which it is recorded; moving: None, 'cut', 'mean' or 'transient'."""
    rng = np.random.default_rng(test["seed"])
    n = int(round(test["duration"] / dt))
    if moving is None:
        return wave(test, n, dt, fmax, rng), 0, 0.0
    if moving == "cut":
        cut = rng2.uniform(0.15, 0.35) * test["duration"]
        more = dict(test, duration=test["duration"] + cut)
        m = n + int(round(cut / dt))
        x = wave(more, m, dt, fmax, rng)
        v = np.abs(np.gradient(x, dt))
        i = m - n
        j = i + np.flatnonzero((v[i:] > 0.35 * v.max()) | (np.abs(x[i:]) > 0.6 * np.abs(x).max()))
        i = int(j[0]) if len(j) and j[0] < m - int(7.5 / dt) else i
        return x, i, 0.0
    x = wave(test, n, dt, fmax, rng)
    mean = 0.0
    if moving == "mean":
        mean = float(rng2.choice([-1, 1]) * rng2.uniform(0.15, 0.4) * u0)
        ramp = max(1.875 * abs(mean) / (0.4 * v0), 0.5)
        wait = rng2.uniform(0.1, 1.5)
        k = int((ramp + wait) / dt)
        t = np.arange(k) * dt
        return np.concatenate([mean * smooth(t, 0.05, ramp), mean + x]), k, mean
    a = float(rng2.choice([-1, 1]) * rng2.uniform(0.3, 0.6) * u0)
    T = max(2 * 1.875 * abs(a) / (0.8 * v0), 0.3)
    k = int((T + 0.2) / dt)
    t = np.arange(k) * dt
    pulse = a * smooth(t, 0.0, T / 2) * (1 - smooth(t, T / 2, T))
    whole = np.concatenate([np.zeros(20), pulse, x])
    return whole, int(20 + rng2.uniform(0.45, 1.0) * T / dt), 0.0
