"""Motions, recording chain, noise and refit of the polytechnic's virtual laboratory. Units: mm, kN, s."""

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import least_squares
from scipy.signal import butter, lfilter, sosfiltfilt

from .kernel import IX, LAWS, NS, no_effects, run

FREE = {
    "kelvin_voigt": [0, 1],
    "zener": [0, 1, 2],
    "mgmm": [0, 1, 3, 4, 5, 6, 7, 8, 10],
    "viscous_power": [0, 1],
    "friction": [0, 2],
    "elastic_plastic": [0, 1, 2],
    "bouc_wen": [0, 1, 2, 4, 6],
    "maxwell_power": [0, 1, 2],
}


def loguni(rng, a, b):
    return float(np.exp(rng.uniform(np.log(a), np.log(b))))


def smooth01(x):
    x = np.clip(x, 0.0, 1.0)
    return x * x * (3.0 - 2.0 * x)


def command(kind, t, A, f, rng):
    """Commanded motion on t >= 0, from rest."""
    D = t[-1]
    up = smooth01(t * f / rng.choice([0.25, 0.5, 1.0, 2.0])) * smooth01((D - t) * f / 0.5)
    if kind == "sine":
        return A * up * np.sin(2 * np.pi * f * t), f"sine {A:.1f} mm {f:.2g} Hz"
    if kind == "triangle":
        return A * up * 2 / np.pi * np.arcsin(np.sin(2 * np.pi * f * t)), f"triangle {A:.1f} mm {f:.2g} Hz"
    if kind == "stepped":
        n = rng.integers(3, 6)
        lv = np.linspace(0.3, 1.0, n) if rng.random() < 0.6 else np.concatenate([np.linspace(0.4, 1, n - 1), [0.5]])
        cyc = max(1, int(D * f / n))
        i = np.minimum((t * f / cyc).astype(int), len(lv) - 1)
        return A * lv[i] * np.sin(2 * np.pi * f * t) * smooth01(
            (D - t) * f
        ), f"stepped amplitudes to {A:.1f} mm {f:.2g} Hz"
    if kind == "sweep":
        f1, f2 = 0.4 * f, min(2.2 * f, 4.0)
        L = D / np.log(f2 / f1)
        amp = A * (np.exp(t / L)) ** (-rng.choice([0.0, 0.5, 0.8]))
        return amp * up * np.sin(2 * np.pi * f1 * L * (np.exp(t / L) - 1)), f"sweep {f1:.2g}-{f2:.2g} Hz {A:.1f} mm"
    if kind == "bursts":
        x = t / D
        w = smooth01(x / 0.05) * smooth01((0.35 - x) / 0.05) + smooth01((x - 0.6) / 0.05) * smooth01(
            (0.93 - x) / 0.05
        ) * rng.uniform(0.5, 1)
        return A * w * np.sin(2 * np.pi * f * t), f"two bursts with rest {A:.1f} mm {f:.2g} Hz"
    dt = t[1]
    w = rng.standard_normal(t.size)
    if kind == "quake":  # Kanai-Tajimi like: resonant band, Saragoni-Hart envelope, no mean
        lo, hi = 0.25 * f, min(2.5 * f, 4.0)
        tp = D * rng.uniform(0.2, 0.4)
        env = (t / tp) ** 2 * np.exp(2 * (1 - t / tp))
    else:  # stationary random
        lo, hi = 0.15 * f, min(1.8 * f, 4.0)
        env = smooth01(t / 1.5)
    b, a = butter(2, [lo, hi], btype="band", fs=1 / dt)
    x = lfilter(b, a, w) * env * smooth01((D - t) / 1.0)
    return A * x / np.abs(x).max(), f"{'earthquake' if kind == 'quake' else 'random'} {A:.1f} mm {lo:.2g}-{hi:.2g} Hz"


def make_motion(kind, A, f, D, fs, rng, servo, moving=None):
    """Fine grid motion: t (0 at the first sample; before it what was not recorded), u, title."""
    M = int(np.ceil(2500 / fs))
    h = 1.0 / (fs * M)
    pre = {
        None: 0.0,
        "cut": rng.uniform(2.0, 5.0),
        "late": rng.uniform(0.25, 1.0),
        "ramp": rng.uniform(1.0, 3.0),
        "transient": rng.uniform(0.4, 1.0),
    }[moving]
    npre = int(round(pre * fs)) * M
    n = int(round(D * fs)) * M + 1
    t = (np.arange(npre + n) - npre) * h
    lead = rng.choice([0.0, 0.3, 1.0]) if moving is None else 0.0
    tail = rng.choice([0.0, 0.5, 1.5])
    if moving in ("ramp", "transient"):
        mean = A * rng.uniform(0.2, 0.45) * rng.choice([-1, 1])
        c, title = command(kind, np.arange(n) * h, A - abs(mean), f, rng)
        tr = (t - t[0]) / (pre * (0.75 if moving == "ramp" else 1.6))
        late = 0 if moving == "ramp" else int(round(0.7 * pre / h))
        u = mean * smooth01(tr)
        u[npre + late :] += c[: n - late]
    else:
        m = n + npre - int(lead / h) - int(tail / h)
        c, title = command(kind, np.arange(m) * h, A, f, rng)
        u = np.zeros(n + npre)
        i0 = int(lead / h)
        u[i0 : i0 + m] = c
    b, a = butter(2, servo, fs=1 / h)
    return {
        "t": t,
        "u": lfilter(b, a, u),
        "npre": npre,
        "M": M,
        "h": h,
        "fs": fs,
        "title": title,
        "kind": kind,
        "A": A,
        "f": f,
        "moving": moving,
    }


def shift(x, n):
    """x delayed by n steps (may be fractional)."""
    i = np.arange(x.size)
    return np.interp(i - n, i, x)


def params_E(effects, j, T):
    E = no_effects()
    for e in effects:
        for k, v in e["par"].items():
            if k in IX and not (k.startswith(("crack", "anc")) and e["par"].get("only_test", j) != j):
                E[IX[k]] = v
    for e in effects:
        q = e["par"]
        if "factor_tests" in q:
            E[IX["factor"]] *= 1.0 + q["a"] * q["factor_tests"][j]
        if "b_T" in q:
            E[IX["factor"]] *= np.exp(-q["b_T"] * (T - 20.0))
        if "Q_T" in q:  # Arrhenius, Q in J/mol
            E[IX["factor"]] *= np.exp(q["Q_T"] / 8.314 * (1 / (T + 273.15) - 1 / 293.15))
        if "c1_T" in q:  # WLF on viscosity
            E[IX["aT"]] *= 10 ** (-q["c1_T"] * (T - 20.0) / (q["c2_T"] + T - 20.0))
    return E


def measure(camp, effects):
    """What the channels would record without noise: list of (u, F) on the recorded grid, with the part before t = 0."""
    out = []
    s = np.zeros(NS)
    for j, m in enumerate(camp["motions"]):
        rest = camp["rest"]
        keep = (s[11], s[12], s[13], s[14], s[15])
        tau = [e["par"]["heat_tau"] for e in effects if "heat_tau" in e["par"]]
        s = np.zeros(NS)
        s[11], s[14] = keep[0], keep[3]
        s[12] = s[13] = keep[2]
        s[15] = keep[4] * (np.exp(-rest / tau[0]) if tau else 0.0)
        E = params_E(effects, j, camp["T"][j])
        u = m["u"]
        h = m["h"]
        d = u
        chan = [e for e in effects if e.get("motion")]
        for e in chan:
            d = d + e["motion"](e["par"], m, j)
        v = np.gradient(d, h)
        if not chan:
            v[0] = 0.0
        F = run(LAWS[camp["law"]], camp["p"], E, s, d, v, h)
        ur = u
        for e in effects:
            q = e["par"]
            if "mass" in q:
                F = F + q["mass"] * np.gradient(v, h)
        for e in effects:
            q = e["par"]
            if "lag_F" in q:
                F = shift(F, q["lag_F"] / h)
            if "lag_u" in q:
                ur = shift(ur, q["lag_u"] / h)
            if "lag1_F" in q:
                w = np.exp(-h / q["lag1_F"])
                F = lfilter([1 - w], [1, -w], F)
        ur, F = ur[:: m["M"]].copy(), F[:: m["M"]].copy()
        t = m["t"][:: m["M"]]
        for e in effects:
            q = e["par"]
            if "gain" in q and j >= q["from"]:
                if q["channel"] == "force":
                    F *= 1.0 + q["gain"]
                else:
                    ur *= 1.0 + q["gain"]
            if "zero" in q:
                F += q["zero"] * q["of_tests"][j]
            if "drift" in q:
                x = (t - t[0]) / 30.0
                w = (
                    x
                    if q["form"] == "linear"
                    else 1 - np.exp(-(t - t[0]) / q["tau"])
                    if q["form"] == "warm-up"
                    else np.sin(2 * np.pi * x * 30.0 / q["tau"] + 0.7 * j)
                )
                if q["channel"] == "force":
                    F += q["drift"] * q["of_tests"][j] * w
                else:
                    ur += q["drift"] * q["of_tests"][j] * w
            if "tone" in q:
                F += q["tone"] * np.sin(2 * np.pi * q["f_tone"] * t + q["phase"][j])
            if e.get("channels"):
                ur, F = e["channels"](q, ur, F, t, j)
        out.append((ur, F))
    return out


def record_part(camp, rec):
    return [
        (u[m["npre"] // m["M"] :], F[m["npre"] // m["M"] :]) for (u, F), m in zip(rec, camp["motions"], strict=False)
    ]


def upsampled(camp, us):
    """Recorded displacements on the grid of predictions, by cubic splines."""
    out = []
    for u, m in zip(us, camp["motions"], strict=False):
        k = max(2, int(round(600 / m["fs"])))
        i = np.arange(u.size)
        x = np.arange((u.size - 1) * k + 1) / k
        sp = CubicSpline(i, u)
        out.append((sp(x), sp(x, 1) * m["fs"], k, 1.0 / (m["fs"] * k)))
    return out


def predict(camp, ups, p, par=None, which=None):
    """Force of the law (with rival effects in par: scalars) in recorded motions, at the samples of the record."""
    par = par or {}
    E = no_effects()
    for k, v in par.items():
        if k in IX:
            E[IX[k]] = v
    out = []
    for j, (u, v, k, h) in enumerate(ups):
        if which is not None and j not in which:
            out.append(None)
            continue
        F = run(LAWS[camp["law"]], p, E, np.zeros(NS), u, v, h)
        if "mass" in par:
            F = F + par["mass"] * np.gradient(v, h)
        if "lag" in par:
            F = shift(F, par["lag"] / h)
        F = F * (1.0 + par.get("a", 0.0) * j) + par.get("zero", 0.0)
        m = camp["motions"][j]
        out.append(F[::k][m["npre"] // m["M"] :])
    return out


RIVALS = {  # name: (par keys, starts in units of the campaign, positive only)
    "lag": (["lag"], [[0.004], [-0.004]]),
    "series_flexibility": (["rig_k"], [[12.0]]),
    "relaxation_branch": (["br_k", "br_tau"], [[0.3, 0.05], [0.3, 0.8]]),
    "inertia": (["mass"], [[0.05]]),
    "velocity_exponent": (["ve_c", "ve_a"], [[0.05, 0.3]]),
    "friction": (["fr_F", "fr_k"], [[0.05, 3.0]]),
    "static_offset": (["u0"], [[0.05]]),
    "offset": (["zero"], [[0.05]]),
    "ageing": (["a"], [[0.01]]),
}
ASK = {
    "lag": ["series_flexibility", "relaxation_branch", "inertia"],
    "series_flexibility": ["relaxation_branch", "lag", "inertia"],
    "relaxation_branch": ["series_flexibility", "lag", "velocity_exponent"],
    "inertia": ["lag", "relaxation_branch"],
    "velocity_exponent": ["friction", "relaxation_branch"],
    "friction": ["velocity_exponent"],
    "static_offset": ["offset"],
    "offset": ["static_offset"],
    "gain": ["ageing"],
    "degradation": ["ageing"],
    "mullins": ["ageing"],
    "play": ["friction"],
    "temperature_law": ["ageing"],
    "one_sided": ["offset", "static_offset"],
    "drift": ["offset"],
}
LOGS = {"mass", "rig_k", "br_k", "br_tau", "ve_c", "ve_a", "fr_F", "fr_k"}


def clip_p(law, p):
    p = p.copy()
    if law == "bouc_wen":
        p[2] = min(p[2], 0.95)
        p[6] = max(p[6], 1.0)
    if law == "elastic_plastic":
        p[2] = min(p[2], 0.95)
    if law in ("viscous_power", "maxwell_power"):
        p[1] = min(max(p[1], 0.05), 2.0)
    if law == "mgmm":
        p[4] = min(max(p[4], 0.05), 2.0)
    return p


class Refit:
    """Least squares of the law's parameters (logarithms) over the fit tests, samples in share of the rms force."""

    def __init__(self, camp, rec):
        self.camp = camp
        self.ups = upsampled(camp, [u for u, _ in rec])
        self.F = [F for _, F in record_part(camp, rec)]
        self.fit = [j for j in range(len(self.F)) if camp["use"][j] == "fit"]
        self.norm = np.sqrt(np.mean(np.concatenate([self.F[j] for j in self.fit]) ** 2))
        self.free = FREE[camp["law"]]

    def residual(self, x, par=None):
        p = self.camp["p"].copy()
        p[self.free] *= np.exp(np.clip(x, -2.5, 2.5))
        pr = predict(self.camp, self.ups, clip_p(self.camp["law"], p), par, self.fit)
        r = np.concatenate([self.F[j] - pr[j] for j in self.fit]) / self.norm
        return np.nan_to_num(r, nan=10.0, posinf=10.0, neginf=-10.0) / np.sqrt(r.size)

    def basis(self):
        n = len(self.free)
        r0 = self.residual(np.zeros(n))
        J = np.array([(self.residual(0.02 * e) - self.residual(-0.02 * e)) / 0.04 for e in np.eye(n)]).T
        return r0, J

    def linear(self, J):
        r0 = self.residual(np.zeros(len(self.free)))
        c = np.linalg.lstsq(J, r0, rcond=1e-6)[0]
        return np.linalg.norm(r0 - J @ c), np.linalg.norm(r0)

    def full(self, rounds=7):
        n = len(self.free)
        s = least_squares(
            lambda y: self.residual(y - 1),
            np.ones(n),
            method="trf",
            x_scale=0.1,
            diff_step=2e-3,
            max_nfev=rounds,
            ftol=1e-4,
            xtol=1e-5,
            gtol=1e-10,
        )
        self.x = s.x - 1
        self.r = s.fun
        return np.linalg.norm(s.fun)

    def rival(self, name, ctx):
        keys, starts = RIVALS[name]
        A, V, Fp, am = ctx["A"], ctx["V"], ctx["F"], ctx["acc"]
        unit = {
            "rig_k": Fp / A,
            "br_k": Fp / A,
            "fr_F": Fp,
            "ve_c": Fp / V**0.3,
            "fr_k": Fp / A,
            "mass": Fp / am,
            "u0": A,
            "zero": Fp,
        }
        n = len(self.free)
        best = np.inf
        for st in starts:
            base = [a * unit.get(k, 1.0) for a, k in zip(st, keys, strict=False)]

            def par(y, base=base):
                q = {
                    k: b * np.exp(np.clip(z, -6, 6)) if k in LOGS else b * (1 + z)
                    for k, b, z in zip(keys, base, y, strict=False)
                }
                if "ve_c" in q:
                    q["ve_form"], q["ve_a"] = 1.0, min(q["ve_a"], 2.0)
                return q

            s = least_squares(
                lambda x: self.residual(x[:n] - 1, par(x[n:] - 1)),
                np.concatenate([self.x + 1, np.ones(len(keys))]),
                method="trf",
                x_scale=np.r_[0.1 * np.ones(n), 0.5 * np.ones(len(keys))],
                diff_step=2e-3,
                max_nfev=12,
                ftol=1e-3,
            )
            best = min(best, np.linalg.norm(s.fun))
        return best


def lowpass(x, fc, fs, order=4):
    if fc >= 0.45 * fs:
        return x
    return sosfiltfilt(butter(order, fc, fs=fs, output="sos"), x, padlen=min(x.size - 1, 3 * int(fs / fc) + 20))


def add_noise(camp, rec, rng):
    """Noisy channels: white noise, perhaps both channels through one zero-phase Butterworth, perhaps quantised."""
    n = camp["noise"]
    peakF = max(np.abs(F).max() for _, F in rec)
    peakU = max(np.abs(u).max() for u, _ in rec)
    sF = n["force"] * peakF
    if n["filter"]:  # the channels themselves are filtered: only where this leaves the signals as they are
        for share in [x for x in (0.15, 0.2, 0.25, 0.3, 0.35, 0.4) if x >= n["filter"]]:
            err = np.sqrt(
                np.mean(
                    np.concatenate(
                        [
                            lowpass(F, share * m["fs"], m["fs"]) - F
                            for (_, F), m in zip(rec, camp["motions"], strict=False)
                        ]
                    )
                    ** 2
                )
            )
            if err < 0.25 * sF:
                break
        else:
            share = None
        n["filter"] = share
    out = []
    for (u, F), m in zip(rec, camp["motions"], strict=False):
        own = sF if n["of"] == "campaign" else n["force"] * max(np.abs(F).max(), 0.1 * peakF)
        a, b = rng.standard_normal(F.size), rng.standard_normal(F.size)
        if n["filter"]:
            fc = n["filter"] * m["fs"]
            a, b = lowpass(a, fc, m["fs"]), lowpass(b, fc, m["fs"])
            a, b = a / a.std(), b / b.std()
            u, F = lowpass(u, fc, m["fs"]), lowpass(F, fc, m["fs"])
        F, u = F + own * a, u + n["disp"] * peakU * b
        if n["bits"]:
            qF, qU = 2.5 * peakF / 2 ** n["bits"], 2.5 * peakU / 2 ** n["bits_u"]
            F, u = np.round(F / qF) * qF, np.round(u / qU) * qU
        out.append((u, F))
    return out
