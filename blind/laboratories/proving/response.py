"""What a specimen answers, what a refit of its law leaves, and the floor of the noise."""

import numpy as np
from scipy.signal import butter, sosfiltfilt

from . import effects as fx
from .kernel import LAWS, NS, ROWS, run
from .laws import HELD, PAR

E0 = np.zeros((len(ROWS), 6))


def simulate(law, P, effs, M, c, fresh, q=1):
    """Channels of all tests in their order; M motions, q coarser step."""
    E = fx.rows(effs, c) if effs else E0
    S, ext = np.zeros(NS), np.zeros(4)
    shift = sum(e["sign"] * e["size"] * c["u0"] for e in effs if e["name"] == "static_offset")
    crack = next((e["test"] for e in effs if e["name"] == "cracked_layer"), -1)
    dt = c["dt"] * q
    out = []
    for i, (x, i0, _) in enumerate(M):
        x = x[::q]
        F = np.zeros(len(x))
        run(
            LAWS[law],
            P,
            E,
            x + shift,
            np.gradient(x, dt),
            dt,
            fx.factors(effs, i, c["tests"][i]["T"], c),
            int(i == crack),
            fresh,
            ext,
            S,
            F,
        )
        out.append(fx.channels(effs, i, x, F, dt, -(-i0 // q), c))
    return out, S


def law_only(law, P, X, c, fresh, dt):
    S, ext = np.zeros(NS), np.zeros(4)
    out = []
    for x in X:
        F = np.zeros(len(x))
        run(LAWS[law], P, E0, x, np.gradient(x, dt), dt, np.ones(3), 0, fresh, ext, S, F)
        out.append(F)
    return out


class Fit:
    """Least squares of the law's own parameters, each test alike."""

    def __init__(self, law, P, c, fresh, sim, M, q, use="fit"):
        self.law, self.c, self.fresh = law, c, fresh
        self.dt = c["dt"] * q
        self.X = [s[0] for s in sim]
        self.k = [i for i, t in enumerate(c["tests"]) if t["use"] == use]
        self.i0 = [-(-m[1] // q) for m in M]
        self.Y = [s[1] for s in sim]
        self.rms = [np.sqrt(np.mean(self.Y[i][self.i0[i] :] ** 2)) for i in range(len(M))]
        names = PAR[law]
        self.free = [j for j, n in enumerate(names) if n not in HELD.get(law, []) and P[j] > 0]
        self.P = P.copy()
        self.lin = [names[j] == "beta" for j in self.free]

    def cat(self, forces):
        n = sum(len(self.Y[i]) - self.i0[i] for i in self.k)
        return (
            np.concatenate(
                [
                    forces[i][self.i0[i] :] / self.rms[i] / np.sqrt((len(self.Y[i]) - self.i0[i]) * len(self.k))
                    for i in self.k
                ]
            )
            if n
            else np.zeros(0)
        )

    def at(self, theta):
        P = self.P.copy()
        for j, t, lin in zip(self.free, theta, self.lin, strict=False):
            P[j] = P[j] + t if lin else P[j] * np.exp(np.clip(t, -3, 3))
        n = PAR[self.law]
        if self.law == "bouc_wen":
            P[6] = min(max(P[6], 1.0), 8.0)
            P[2] = min(P[2], 0.9)
            P[4] = max(P[4], -P[5] + 0.05)
        if self.law == "elastic_plastic":
            P[2] = min(P[2], 0.95)
        if "alpha" in n and self.law != "bouc_wen":
            j = n.index("alpha")
            P[j] = min(P[j], 2.0)
        return P

    def r(self, theta):
        return self.y - self.cat(law_only(self.law, self.at(theta), self.X, self.c, self.fresh, self.dt))

    def solve(self, steps=6):
        self.y = self.cat(self.Y)
        th = np.zeros(len(self.free))
        r = self.r(th)
        lam = 1e-4
        self.J = None
        for _ in range(steps):
            J = np.empty((len(r), len(th)))
            for j in range(len(th)):
                d = th.copy()
                d[j] += 2e-3
                J[:, j] = (self.r(d) - r) / 2e-3
            self.J = J
            A, g = J.T @ J, J.T @ r
            ok = False
            for _ in range(4):
                step = np.linalg.solve(A + lam * np.diag(np.diag(A) + 1e-12), -g)
                new = np.clip(th + np.clip(step, -0.7, 0.7), -2, 2)
                rn = self.r(new)
                if rn @ rn < r @ r:
                    ok = True
                    break
                lam = max(lam * 10, 1e-3)
            if not ok:
                break
            better = 1 - (rn @ rn) / (r @ r)
            th, r = new, rn
            lam /= 5
            if better < 2e-3:
                break
        self.theta, self.res = th, r
        self.left = float(np.sqrt(r @ r))
        return self.left


def noise_floor(law, P, effs, M, c, fresh, noise, use, q, sim):
    """Root of the mean over tests of (force noise^2 + displacement noise through law and effects^2)/force^2."""
    out = []
    rng = np.random.default_rng(1)
    low = {}
    if noise["disp"] > 0:
        M2 = []
        for x, i0, m in M:
            sos = butter(2, min(2 * c["dt"] * 4 * c["fmax"], 0.9), output="sos")
            d = rng.standard_normal(len(x)) * noise["disp"] * np.sqrt(1 / (c["fs"] * c["dt"]))
            M2.append((x + sosfiltfilt(sos, d), i0, m))
        low = simulate(law, P, effs, M2, c, fresh, q)[0]
    for i, t in enumerate(c["tests"]):
        if t["use"] != use:
            continue
        k = -(-M[i][1] // q)
        F = sim[i][1][k:]
        v = noise["force_eff"] ** 2
        if noise["disp"] > 0:
            v += np.mean((low[i][1][k:] - F) ** 2)
        out.append(v / np.mean(F**2))
    return float(np.sqrt(np.mean(out)))
