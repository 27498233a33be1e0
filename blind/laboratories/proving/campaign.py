"""One campaign: programme, effects of a size that can be seen, names that are as good."""

import numpy as np

from . import effects as fx
from .laws import draw_law
from .motions import programme, recorded
from .response import Fit, law_only, noise_floor, simulate


def accepted(e, law, c, M, fresh, fit, noise, q, rng, several):
    """Other effects whose signature beside the refitted law is that of e within half the noise and a tenth of it."""
    Q = np.linalg.qr(fit.J)[0] if fit.J is not None else np.zeros((len(fit.res), 0))
    r = fit.res - Q @ (Q.T @ fit.res)
    P = fit.at(fit.theta)
    base = law_only(law, P, [m[0][::q] for m in M], c, fresh, fit.dt)
    b = fit.cat(base)
    found = {}
    for n in fx.NAMES:
        if (
            n == e["name"]
            or not fx.allowed(n, law)
            and n != "series_flexibility"
            or n == "play"
            or (n == "temperature_law" and not several)
        ):
            continue
        for k in range(3 if n in ("hum", "series_flexibility", "static_offset", "inertia") else 3):
            try:
                alt = fx.draw(n, law, c, rng)
            except (ValueError, IndexError):
                break
            if n == "offset":
                alt["each"] = [1.0] * len(M) if k % 2 else alt["each"]
            alt["size"] = max(0.3 * e["size"], 0.003) if n in ("lag", "inertia") else 0.05
            sims = simulate(law, P, [alt], M, c, fresh, q)[0]
            if alt.get("channel") == "displacement":
                f = law_only(law, P, [s[0] for s in sims], c, fresh, fit.dt)
                sig = b - fit.cat(f)
            else:
                sig = fit.cat([s[1] for s in sims]) - b
            sig = sig - Q @ (Q.T @ sig)
            if sig @ sig < 1e-16:
                continue
            a = (sig @ r) / (sig @ sig)
            if a <= 0 and n in (
                "friction",
                "inertia",
                "lag",
                "relaxation_branch",
                "series_flexibility",
                "mullins",
                "degradation",
                "payne",
                "self_heating",
            ):
                continue
            rest = np.sqrt(max(r @ r - a * a * (sig @ sig), 0))
            found[n] = min(found.get(n, 9.0), float(rest))
    lim = min(0.5 * noise, 0.1 * np.sqrt(r @ r))
    acc = [n for n, v in found.items() if v < lim]
    if law == "kelvin_voigt" and e["name"] == "series_flexibility" and e["form"] == 1:
        acc.append("relaxation_branch")  # k + i w c behind K is a Zener solid
    if law == "viscous_power" and c["alpha"] > 0.9 and e["name"] == "series_flexibility":
        acc.append("relaxation_branch")
    if e["name"] == "static_offset":
        acc.append("offset")
    if e["name"] == "offset" and np.std(e["each"]) == 0 and law in fx.ELASTIC:
        acc.append("static_offset")
    if e["name"] == "friction" and e["form"] == 2:
        acc.append("velocity_exponent")
    return sorted(set(acc)), {n: v for n, v in sorted(found.items(), key=lambda z: z[1])[:4]}


def build(category, number, seed, wanted, law):
    """Draws until the effects have the size that they must have."""
    for attempt in range(60):
        rng = np.random.default_rng([seed, number, attempt])
        P, size, spec = draw_law(law, rng)
        hidden_T = "temperature_law" in wanted
        several = hidden_T or rng.random() < 0.12
        tests, T0 = programme(rng, size, several)
        rates = [r for r in (100, 200, 250, 500, 1000) if r >= 40 * size["fmax"]]
        fs = int(rng.choice(rates))
        m = -(-4000 // fs)
        c = dict(
            size,
            tests=tests,
            T0=T0,
            fs=fs,
            m=m,
            dt=1 / (fs * m),
            tau=P[2] / P[1] if law == "zener" else 0.1,
            alpha=P[1] if "power" in law else 0.5,
            energy=1.0,
            path=1.0,
            a0=1.0,
        )
        fresh = bool(rng.random() < 0.6) if law == "mgmm" and not set(wanted) & {"mullins", "payne"} else True
        mrng = np.random.default_rng([seed, number, attempt, 5])
        M = [recorded(t, c["dt"], c["fmax"], None, mrng, c["v0"], c["u0"]) for t in tests]
        q = max(1, int(1 / (c["dt"] * 500)))
        while c["m"] % q:
            q -= 1
        clean, S = simulate(law, P, [], M, c, fresh, q)
        c["energy"], c["path"] = max(S[1], 1.0), S[2]
        c["F0"] = float(max(np.max(np.abs(s[1])) for s in clean))
        c["a0"] = float(max(np.max(np.abs(np.gradient(np.gradient(mo[0], c["dt"]), c["dt"]))) for mo in M))
        peaks = [float(np.max(np.abs(s[1]))) for s in clean]
        share = float(np.exp(rng.uniform(np.log(0.001), np.log(0.01 if attempt < 8 else 0.004))))
        noise = dict(
            force=share * float(np.mean(peaks)),
            disp=0.0 if rng.random() < 0.2 else c["u0"] * float(np.exp(rng.uniform(np.log(2e-5), np.log(1e-3)))),
            filter=float(rng.uniform(0.3, 0.7)) if rng.random() < 0.35 else 0.0,
            bits=int(rng.choice([12, 14, 16])) if rng.random() < 0.4 else 0,
            seed=int(rng.integers(1 << 31)),
        )
        if law in ("viscous_power", "maxwell_power") and noise["disp"]:
            noise["disp"] *= 0.3
        full = 1.25 * c["F0"]
        noise["step"] = 2 * full / 2 ** noise["bits"] if noise["bits"] else 0.0
        noise["force_eff"] = float(np.sqrt(noise["force"] ** 2 * (noise["filter"] or 1.0) + noise["step"] ** 2 / 12))
        info = dict(
            law=law,
            P=P,
            c=c,
            spec=spec,
            noise=noise,
            fresh=fresh,
            M=M,
            effs=[],
            several=several,
            q=q,
            attempt=attempt,
            accept=[],
            near=[],
        )
        for _ in range(3):  # power laws make much of displacement noise: at most twice the power of the force noise
            quiet = noise_floor(law, P, [], M, c, fresh, dict(noise, disp=0.0), "fit", q, clean)
            if noise["disp"] == 0 or noise_floor(law, P, [], M, c, fresh, noise, "fit", q, clean) < 1.8 * quiet:
                break
            noise["disp"] *= 0.3
        if not wanted:
            info |= dict(
                nrms_effect=0.0,
                nrms_after=Fit(law, P, c, fresh, clean, M, q).solve(1),
                noise_fit=noise_floor(law, P, [], M, c, fresh, noise, "fit", q, clean),
            )
            return info
        try:
            effs = [fx.draw(n, law, c, rng) for n in wanted]
        except (ValueError, IndexError):
            continue
        nf = noise_floor(law, P, [], M, c, fresh, noise, "fit", q, clean)
        least = 5.5 if category == "unlisted" else 3.3
        lo, hi = max(least * nf, 0.0115), min(27 * nf, 0.25)
        if lo > hi:
            continue
        singles = []
        good = True
        base = Fit(law, P, c, fresh, clean, M, q)
        J0 = []
        for j in range(len(base.free)):
            d = np.zeros(len(base.free))
            d[j] = 2e-3
            J0.append(
                [
                    (x - s[1]) / 2e-3
                    for x, s in zip(law_only(law, base.at(d), base.X, c, fresh, base.dt), clean, strict=False)
                ]
            )
        for e in effs:
            target = float(np.exp(rng.uniform(np.log(lo), np.log(hi))))
            ok = False
            rho = 1.0  # what a refit leaves over what the projection off the slopes of the law leaves
            for k in range(7):
                sim = simulate(law, P, [e], M, c, fresh, q)[0]
                if not all(np.all(np.isfinite(s[1])) for s in sim):
                    break
                f = Fit(law, P, c, fresh, sim, M, q)
                f.y = f.cat(f.Y)
                r0 = f.r(np.zeros(len(f.free)))
                Q = np.linalg.qr(np.column_stack([f.cat(j) for j in J0]))[0]
                left = est = float(np.linalg.norm(r0 - Q @ (Q.T @ r0)))
                left *= rho
                top = e["size"] >= fx.MAX[e["name"]]
                if abs(np.log(left / target)) < 0.25 or (lo < left < hi and (top or k > 3)):
                    left = f.solve(6)
                    rho = left / est
                    if lo < left < hi * 1.05:
                        ok = True
                        break
                if top and left < target:
                    break
                e["size"] = min(e["size"] * float(np.clip(target / max(left, 1e-9), 0.1, 8)), fx.MAX[e["name"]])
            if not ok:
                good = False
                break
            singles.append(f)
        if not good:
            continue
        if len(effs) == 2:
            a, b = (x.res - (lambda Q: Q @ (Q.T @ x.res))(np.linalg.qr(x.J)[0]) for x in singles)
            cc = (a @ b) / np.sqrt((a @ a) * (b @ b))
            if min(a @ a, b @ b) ** 0.5 * np.sqrt(max(1 - cc * cc, 0)) < max(3 * nf, 0.01) or abs(cc) > 0.8:
                continue
            sim = simulate(law, P, effs, M, c, fresh, q)[0]
            fit = Fit(law, P, c, fresh, sim, M, q)
            left = fit.solve(6)
            if not np.isfinite(left) or left < 3 * nf or left > 0.4:
                continue
        else:
            fit = singles[0]
        plain = law_only(law, P, [mo[0][::q] for mo in M], c, fresh, fit.dt)
        nfe = noise_floor(law, P, effs, M, c, fresh, noise, "fit", q, sim)
        if fit.left < 3 * nfe or fit.left > 30 * nfe or (category == "unlisted" and fit.left < 5 * nfe):
            continue
        info |= dict(
            effs=effs,
            nrms_effect=float(np.linalg.norm(fit.cat([s[1] for s in sim]) - fit.cat(plain))),
            nrms_after=fit.left,
            noise_fit=nfe,
            each=[f.left for f in singles],
        )
        arng = np.random.default_rng([seed, number, 77])
        for e, f in zip(effs, singles, strict=False):
            acc, near = accepted(e, law, c, M, fresh, f, nf, q, arng, several)
            info["accept"].append(acc)
            info["near"].append({n: round(x / f.left, 3) for n, x in near.items()})
        if category == "unlisted" and min(info["near"][0].values()) < 0.6:
            continue  # nearly one of the list
        return info
    return None
