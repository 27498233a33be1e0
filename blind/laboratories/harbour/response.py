"""What a specimen answers, and what a refit of its law leaves."""

import numpy as np
from scipy.optimize import least_squares

from . import effects as fx
from .laws import at_temperature, reference_stiffness
from .sim import LAWS, PARAMETERS, run
from .unlisted import unlisted_arrays, unlisted_channel


def simulate(camp, P, effects, unknown=(), unlisted=None, coarse=True, noise=None):
    """Channels of all tests. unknown: effects that move the displacement channel and are not in the model, which
    therefore takes the channel for the motion. noise: added to the motion (per test)."""
    law, sc = camp["law"], camp["sc"]
    S, out = np.zeros(8), []
    kref = reference_stiffness(law, camp["P"])
    for i, test in enumerate(camp["tests"]):
        st = test["stride"] if coarse else 1
        t, u = test["t"][::st], test["u"][::st]
        dt = t[1] - t[0]
        if unknown:
            u = fx.channels([e for e in unknown if fx.moves_displacement(e)], i, t, u, np.zeros_like(u), sc)[0]
        if noise is not None:
            u = u + noise[i](t)
        E, visc = fx.slots(effects + ([unlisted] if unlisted and unlisted["name"] == "slip" else []), i, sc, law, kref)
        fac, crack = unlisted_arrays(unlisted, i, t)
        heat = next((e["par"] for e in effects if e["name"] == "self_heating"), None)
        S[3] = S[3] * np.exp(-camp["gaps"][i] * heat["h"] / heat["C"]) if heat else 0.0
        X, F = np.zeros(8), np.zeros_like(u)
        if camp["lasting"]:
            X[2:6] = S[4:8]
        run(
            LAWS[law],
            at_temperature(law, P, sc["T"][i], effects, visc),
            E,
            u,
            np.gradient(u, dt),
            dt,
            S,
            X,
            fac,
            crack,
            F,
        )
        D, F = fx.channels(effects, i, t, u, F, sc)
        F = unlisted_channel(unlisted, i, t, F)
        out.append((t, D, F))
    return out


def nrms(a, b, which):
    """Share of the rms force b that a - b leaves, over the tests named."""
    return float(
        np.sqrt(sum(np.sum((a[i][2] - b[i][2]) ** 2) for i in which) / sum(np.sum(b[i][2] ** 2) for i in which))
    )


def refit(camp, ref, known, unknown, free=None, nfev=7):
    """Least squares of the law's parameters (and of `free`, an effect on trial). Returns NRMS fit, validate."""
    law, names = (
        camp["law"],
        [p for p in PARAMETERS[camp["law"]] if p not in ("A", "k0" if camp["law"] == "mgmm" else "", "c_b")],
    )
    scale = np.sqrt(sum(np.mean(ref[i][2] ** 2) for i in camp["fit"]) / len(camp["fit"]))
    keys = [k for k in fx.SHAPE.get(free["name"], []) if k in free["par"]] if free else []

    def model(x):
        P = dict(camp["P"])
        for p, xi in zip(names, x, strict=False):
            P[p] = P[p] * np.exp(xi)
        if law == "bouc_wen":
            P["n"] = max(P["n"], 1.0)
        trial = []
        if free:
            par = dict(free["par"])
            par[fx.SIZE[free["name"]]] *= x[len(names)]
            for j, k in enumerate(keys):
                par[k] *= np.exp(x[len(names) + 1 + j])
            if free["name"] in ("offset", "gain"):
                par["shares"] = [1.0] * camp["sc"]["n"]
            trial = [dict(free, par=par)]
        return simulate(camp, P, known + trial, unknown)

    def residual(x):
        m = model(x)
        r = [(m[i][2] - ref[i][2])[::4] / scale / np.sqrt(ref[i][2][::4].size) for i in camp["fit"]]
        r = np.concatenate(r + [1e-4 * np.asarray(x)])
        return np.where(np.isfinite(r), np.clip(r, -1e3, 1e3), 1e3)

    n = len(names)
    lo, hi, x0 = [-1.5] * n, [1.5] * n, [0.0] * n
    if free:
        lo, hi, x0 = (
            lo + [-4.0 if free["signed"] else 0.0] + [-2.0] * len(keys),
            hi + [8.0] + [2.0] * len(keys),
            x0 + [free["start"]] + [0.0] * len(keys),
        )
    s = least_squares(residual, x0, bounds=(lo, hi), x_scale=0.2, max_nfev=nfev, ftol=1e-3, xtol=1e-4)
    m = model(s.x)
    return nrms(m, ref, camp["fit"]), nrms(m, ref, camp["validate"])
