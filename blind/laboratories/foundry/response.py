"""Forces of laws, with effects and without, and what a law alone leaves."""

import math

import numpy as np
from scipy.optimize import least_squares

from .kernel import bilinear_path, deadzone, halves, relax, rk4
from .laws import EXACT
from .motions import Kin


def law_force(law, p, kin, series=None, memory=None):
    h, u, v = kin.h, kin.u, kin.v
    if law == "kelvin_voigt":
        if not series:
            return p["k"] * u + p["c"] * v
        Fe, _ = deadzone(series)
        k, c = p["k"], p["c"]
        return rk4(lambda y, a, b: (Fe(a - y) - k * y) / c, 0.0, halves(kin), h, lambda y, a, b: Fe(a - y))
    if law in ("zener", "generalised_maxwell"):
        F = p["k0"] * u
        for i in ("1", "2"):
            if "k" + i in p:
                tau = p["c" + i] / p["k" + i]
                F = F + relax(p["c" + i] * v, tau, h)
        return F
    if law == "maxwell":
        if not series:
            return relax(p["c0"] * v, p["lambda"], h)
        kM = p["c0"] / p["lambda"]
        s = dict(series, K=1 / (1 / series["K"] + 1 / kM))
        Fe, _ = deadzone(s)
        c = p["c0"]
        return rk4(lambda y, a, b: Fe(a - y) / c, 0.0, halves(kin), h, lambda y, a, b: Fe(a - y))
    if law == "viscous_power" and not series:
        return p["c"] * np.abs(v) ** p["alpha"] * np.sign(v)
    if law in ("viscous_power", "maxwell_power"):
        Fe, _ = deadzone(series or {"K": p["k"]})
        c, n = p["c"], 1 / p["alpha"]
        return rk4(
            lambda y, a, b: math.copysign((abs(Fe(a - y)) / c) ** n, Fe(a - y)),
            0.0,
            halves(kin),
            h,
            lambda y, a, b: Fe(a - y),
        )
    if law == "bilinear_oil":
        c, Fr, q = p["c"], p["F_r"], p["p"]
        if not series:
            x = c * np.abs(v)
            return np.sign(v) * np.where(x < Fr, x, Fr + q * (x - Fr))
        Fe, _ = deadzone(series)

        def speed(y, a, b):
            F = Fe(a - y)
            x = abs(F)
            return math.copysign(x / c if x < Fr else (Fr + (x - Fr) / q) / c, F)

        return rk4(speed, 0.0, halves(kin), h, lambda y, a, b: Fe(a - y))
    if law == "friction":
        return bilinear_path(kin, p["k"], p["mu"] * p["N"], p["k"] * u[0])
    if law == "elastic_plastic":
        k, b = p["k"], p["b"]
        return b * k * u + bilinear_path(kin, (1 - b) * k, (1 - b) * p["Fy"], (1 - b) * k * u[0])
    if law == "lead_rubber":
        return p["K_d"] * u + bilinear_path(kin, p["Q"] / p["Y"], p["Q"], p["Q"] / p["Y"] * u[0])
    if law == "friction_pendulum":
        mu = p["f_fast"] - (p["f_fast"] - p["f_slow"]) * np.exp(-p["a"] * np.abs(v))
        lim = (mu * p["W"]).tolist()
        k, q, x = p["f_slow"] * p["W"] / p["Y"], 0.0, u[0]
        path, where = kin.path()
        full = np.interp(np.arange(len(path)), where, np.array(lim))
        low = p["f_slow"] * p["W"]
        turn = np.ones(len(path), bool)
        turn[where] = False
        full[turn] = low
        Q = [q]
        for y, m in zip(path[1:], full.tolist()[1:], strict=True):
            q = max(-m, min(m, q + k * (y - x)))
            x = y
            Q.append(q)
        return p["W"] / p["R"] * u + np.array(Q)[where]
    if law == "bouc_wen":
        al, Fy, Y, n = p["alpha"], p["Fy"], p["Y"], p["n"]
        path, where = kin.path()
        slope = deadzone(series)[1] if series else None
        z, x, e, ud = 0.0, path[0], 0.0, path[0]
        zs, us = [z], [ud]
        for y in path[1:]:
            d = (y - x) / Y
            x = y
            if d == 0:
                zs.append(z)
                us.append(ud)
                continue
            sg = 1.0 if d > 0 else -1.0

            def f(z, sg=sg):
                return 1 - (abs(z) ** n if sg * z > 0 else 0.0)  # beta = gamma = 1/2, A = 1

            if slope is None:
                k1 = f(z)
                k2 = f(z + 0.5 * d * k1)
                k3 = f(z + 0.5 * d * k2)
                k4 = f(z + d * k3)
                z += d / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            else:

                def share(z, e):
                    s = slope(e)
                    kt = (al + (1 - al) * f(z)) * Fy / Y
                    return s / (s + kt)

                for _ in range(2):
                    dd = 0.5 * d
                    r = share(z, e)
                    zm, em = z + 0.5 * dd * r * f(z), e + 0.5 * dd * Y * (1 - r)
                    r = share(zm, em)
                    z, e, ud = z + dd * r * f(zm), e + dd * Y * (1 - r), ud + dd * Y * r
            zs.append(z)
            us.append(ud)
        if series:
            return al * Fy / Y * np.array(us)[where] + (1 - al) * Fy * np.array(zs)[where]
        return al * Fy / Y * u + (1 - al) * Fy * np.array(zs)[where]
    if law == "mgmm":
        m = memory or {"up": 0.0, "un": 0.0, "vp": 0.0, "vn": 0.0}
        up, un = np.maximum.accumulate(np.maximum(u, m["up"])), np.minimum.accumulate(np.minimum(u, m["un"]))
        vp, vn = np.maximum.accumulate(np.maximum(v, m["vp"])), np.minimum.accumulate(np.minimum(v, m["vn"]))
        if memory is not None:
            memory.update(up=up[-1], un=un[-1], vp=vp[-1], vn=vn[-1])
        tau = p["c1"] / p["k1"]
        kk = p["k0"] + p["k_a"] * np.exp(-(up - un) / 2 / p["u_ref"]) + p["k_b"]
        cc = tau * p["k0"] + p["c1"] + p["c_a"] * np.exp(-(vp - vn) / 2 / p["v_ref"]) + p["c_b"]
        R = kk * u + cc * v + p["c_NL"] * np.abs(v) ** p["alpha"] * np.sign(v)
        return relax(R, tau, h, R[0])
    raise ValueError(law)


def simulate(law, p, effects, tests, fs, over):
    """Noise-free forces and displacements at the samples of all tests, in their order."""
    states = [dict() for _ in effects]
    memory = {"up": 0.0, "un": 0.0, "vp": 0.0, "vn": 0.0} if any(e.name == "extremes" for e in effects) else None
    series = next((e.series() for e in effects if e.series()), None)
    shift = sum(e.shift() for e in effects)
    out = []
    for test in tests:
        n = int(test["duration"] * fs)
        kin0 = Kin(test["spline"], np.arange(n * over + 1) / (fs * over))
        kin = kin0.shifted(shift) if shift else kin0
        F = law_force(law, p, kin, series, memory)
        for e, st in zip(effects, states, strict=True):
            F = e.damper(F, kin, test, st)
        for e in effects:
            F = e.rig(F, kin, test)
        for e in effects:
            F = e.channel(F, kin, test)
        u = kin0.u[::over]
        for e in effects:
            u = e.displacement(u, test)
        out.append((kin0.t[::over], u, F[::over]))
    return out


def refit_residual(law, p, target, tests, fs, sigma):
    """What the law without effects leaves after its own refit, over the noise variance, in each test (coarse grid)."""
    names = [k for k in p if k not in EXACT.get(law, [])]
    stride = max(1, int(fs // 120))
    kins = []
    for test in tests:
        n = int(test["duration"] * fs)
        kins.append(Kin(test["spline"], np.arange(0, n + 1, stride) / fs))
    fit = [i for i, t in enumerate(tests) if t["use"] == "fit"]
    aim = [np.asarray(f)[::stride] for _, _, f in target]
    # forces of coarse and fine simulation differ a little: compare to the coarse one of the true law

    def forces(x, which):
        q = dict(p)
        q.update({k: p[k] * math.exp(min(max(y, -3), 3)) for k, y in zip(names, x, strict=True)})
        if "n" in q:
            q["n"] = max(1.0, q["n"])
        for k in ("alpha", "b", "p"):
            if k in q:
                q[k] = min(q[k], 0.99)
        for c in ("c", "c_NL"):
            if c in q and "alpha" in q:
                V = tests[0]["V"]
                q[c] = q[c] * V ** p["alpha"] / V ** q["alpha"]
        return [law_force(law, q, kins[i]) for i in which]

    def res(x):
        return np.concatenate([(f - aim[i]) / sigma for f, i in zip(forces(x, fit), fit, strict=True)])

    sol = least_squares(res, np.zeros(len(names)), diff_step=1e-3, max_nfev=6, x_scale=0.1, method="trf")
    every = range(len(tests))
    return [float(np.mean(((f - aim[i]) / sigma) ** 2)) for f, i in zip(forces(sol.x, every), every, strict=True)]
