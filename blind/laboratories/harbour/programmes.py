"""Displacement programmes as a servo-hydraulic rig runs them (unit amplitude; scaled later)."""

import numpy as np
from scipy.signal import butter, sosfiltfilt


def tukey_ramp(t, t0, t1, rise, fall):
    """1 between t0 and t1, with cosine flanks."""
    up = np.clip((t - t0) / rise, 0, 1)
    down = np.clip((t1 - t) / fall, 0, 1)
    return 0.5 * (1 - np.cos(np.pi * up)) * 0.5 * (1 - np.cos(np.pi * down))


def linear_ramp(t, t0, t1, rise, fall):
    return np.clip((t - t0) / rise, 0, 1) * np.clip((t1 - t) / fall, 0, 1)


def sine(rng, t, t0, t1, f):
    n = max(1, int((t1 - t0) * f))
    t1 = t0 + n / f
    ramp = linear_ramp if rng.random() < 0.5 else tukey_ramp
    k = rng.choice([0.5, 1.0, 2.0])
    return np.sin(2 * np.pi * f * (t - t0)) * ramp(t, t0, t1, k / f, k / f) * (t >= t0) * (t <= t1)


def triangle(rng, t, t0, t1, f):
    n = max(1, int((t1 - t0) * f))
    p = (t - t0) * f
    w = 2 / np.pi * np.arcsin(np.sin(2 * np.pi * p))
    return w * (p >= 0) * (p <= n)


def sweep(rng, t, t0, t1, f0, f1):
    T = t1 - t0
    x = np.clip(t - t0, 0, T)
    if rng.random() < 0.5:
        phase = 2 * np.pi * (f0 * x + (f1 - f0) * x**2 / (2 * T))
        f = f0 + (f1 - f0) * x / T
    else:
        r = np.log(f1 / f0)
        phase = 2 * np.pi * f0 * T / r * (np.exp(r * x / T) - 1)
        f = f0 * np.exp(r * x / T)
    a = (f0 / f) ** rng.uniform(0.2, 0.9)  # the pump's flow limits the speed
    return np.sin(phase) * a * tukey_ramp(t, t0, t1, 0.6 / f0, 0.4)


def steps(rng, t, t0, t1, f):
    """Blocks of cycles at amplitudes that rise, fall, or come in any order; a rest between them now and then."""
    m = int(rng.integers(3, 6))
    a = np.linspace(0.25, 1, m) * rng.uniform(0.92, 1.08, m)
    a = {0: a, 1: a[::-1], 2: rng.permutation(a)}[int(rng.integers(3))]
    rest = rng.choice([0.0, 0.0, 0.5])
    each = max(1, int((t1 - t0 - rest * m) * f / m))
    u, start = np.zeros_like(t), t0
    for ai in a:
        p = (t - start) * f
        u += ai * np.sin(2 * np.pi * p) * (p >= 0) * (p <= each)
        start += each / f + rest
        if start + each / f > t1:
            break
    return u / np.abs(a).max()


def quake(rng, t, t0, t1, band, dt):
    """White noise (Kanai 1957, Tajimi 1960), envelope of Jennings et al. (1968), seen through a storey's mode."""
    w = rng.standard_normal(t.size)
    sos = butter(2, list(band), btype="bandpass", fs=1 / dt, output="sos")
    u = sosfiltfilt(sos, w)
    fs = rng.uniform(*band) * 0.6 + band[0] * 0.4  # storey that carries the damper
    zeta, wn = rng.uniform(0.08, 0.25), 2 * np.pi * fs
    from scipy.signal import bilinear, lfilter

    b, a = bilinear([wn**2], [1, 2 * zeta * wn, wn**2], 1 / dt)
    u = u / u.std() + 1.5 * (lambda y: y / y.std())(lfilter(b, a, u))
    T, s = t1 - t0, np.clip(t - t0, 0, None)
    r, d = rng.uniform(0.12, 0.25) * T, rng.uniform(0.45, 0.65) * T
    env = np.where(s < r, (s / r) ** 2, np.where(s < d, 1.0, np.exp(-2.5 * (s - d) / (T - d))))
    return u * env * tukey_ramp(t, t0, t1, 0.3, 0.8)


def hold(rng, t, t0, t1, f):
    """Ramp and hold with a change of sign, then a few cycles (a relaxation test with a check)."""
    T = t1 - t0
    x = [t0, t0 + 0.5 / f * 0.5, t0 + 0.3 * T, t0 + 0.3 * T + 0.5 / f, t0 + 0.55 * T, t0 + 0.55 * T + 0.25 / f, t1]
    u = np.interp(t, x, [0, 1, 1, -0.7, -0.7, 0, 0])
    tc = t0 + 0.62 * T
    n = int((t1 - tc) * f)
    return u + (0.5 * np.sin(2 * np.pi * f * (t - tc)) * (t >= tc) * (t <= tc + n / f) if n >= 1 else 0)


def make(rng, n, amplitude, fmax, fs, vlim, quiet=True):
    """n tests: list of dicts with title, fine time and displacement. amplitude: largest of the campaign, m."""
    os = max(4, int(np.ceil(2400 / fs)))
    dt = 1 / (fs * os)
    kinds = ["sine", "sine", "quake", "steps", "sweep", "triangle", "sine", "quake", "steps", "hold", "sine"][:n]
    first = kinds[0]
    kinds = [first] + list(rng.permutation(kinds[1:]))
    tests = []
    base = float(np.exp(rng.uniform(np.log(0.2), np.log(1.2))))
    for i, kind in enumerate(kinds):
        T = float(np.round(rng.uniform(8, 20 if fs > 300 else 26), 1)) + (2 if kind in ("sweep", "quake") else 0)
        t0 = 1.0 if quiet and rng.random() < 0.9 else float(rng.choice([0.0, 0.25, 2.0]))
        t1 = T - rng.uniform(0.3, 1.0)
        a = amplitude * float(rng.choice([0.25, 0.4, 0.6, 0.8, 1.0], p=[0.12, 0.18, 0.2, 0.2, 0.3]))
        f = float(np.round(np.clip(base * rng.choice([0.4, 1, 1, 2, 3]), 0.15, fmax), 2))
        t = np.arange(int(round(T * fs)) * os + 1) * dt
        if kind == "sine":
            u, name = sine(rng, t, t0, t1, f), f"sine {f:g} Hz"
        elif kind == "triangle":
            f = min(f, 1.0)
            u, name = triangle(rng, t, t0, t1, f), f"triangle {f:g} Hz"
        elif kind == "steps":
            f = max(f, 0.35)
            u, name = steps(rng, t, t0, t1, f), f"stepped sine {f:g} Hz"
            a = amplitude * rng.uniform(0.7, 1)
        elif kind == "sweep":
            f1 = float(np.round(fmax * rng.uniform(0.7, 1), 1))
            f0 = float(np.round(rng.uniform(0.2, 0.4), 2))
            u, name = sweep(rng, t, t0, t1, f0, f1), f"sweep {f0:g} to {f1:g} Hz"
            a = amplitude * rng.uniform(0.5, 0.9)
        elif kind == "hold":
            f = min(max(f, 0.5), 1.5)
            u, name = hold(rng, t, t0, t1, f), "ramp and hold"
        else:
            band = (rng.uniform(0.12, 0.3), min(fmax, rng.uniform(1.5, 3.5)))
            u, name = quake(rng, t, t0, t1, band, dt), f"earthquake {chr(97 + i)}"
            a = amplitude * rng.uniform(0.6, 1)
        sos = butter(2, min(max(3.5 * fmax, 8.0), 0.3 * fs), fs=1 / dt, output="sos")
        u = sosfiltfilt(sos, u)  # an actuator follows no corner
        k0 = max(0, int((t0 - 0.6) / dt))  # no echo of the filter before the motion
        if t0 >= 0.5:
            u[:k0] = 0
        else:
            u = u - u[0]
        u *= a / np.abs(u).max()
        slow = min(1.0, vlim * rng.uniform(0.85, 1) / np.abs(np.gradient(u, dt)).max())
        u, a = u * slow, a * slow
        tests.append(dict(kind=kind, title=f"{name}, {1e3 * a:.3g} mm", t=t, u=u, dt=dt, os=os, fs=fs, f=f))
    return tests
