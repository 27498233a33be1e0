"""One campaign: programme, effects of a size that can be seen, names that are as good."""

import numpy as np

from . import effects as fx
from . import programmes
from .laws import draw_law, reference_stiffness
from .noise import draw_noise, floor_of
from .response import nrms, refit, simulate
from .unlisted import UNLISTED, draw_unlisted

ACCEPT = {("offset", 1): ["static_offset"], ("static_offset", 1): ["offset"]}


CONFOUNDED = dict(
    payne=["mullins", "degradation", "self_heating"],
    mullins=["degradation", "payne"],
    degradation=["ageing", "mullins", "self_heating"],
    ageing=["degradation", "gain", "mullins"],
    self_heating=["degradation", "payne"],
    temperature_law=["ageing"],
    hardening=["one_sided"],
    one_sided=["offset"],
    relaxation_branch=["lag", "velocity_exponent"],
    velocity_exponent=["friction", "relaxation_branch"],
    friction=["velocity_exponent"],
    series_flexibility=["lag", "relaxation_branch", "inertia"],
    play=["lag"],
    inertia=["lag"],
    lag=["series_flexibility", "inertia", "relaxation_branch"],
    gain=["ageing"],
    offset=["static_offset", "one_sided"],
    static_offset=["offset"],
    drift=["offset"],
    hum=[],
)


def base_campaign(rng, law, temperatures):
    P, u, vlim, fmax, spec = draw_law(rng, law)
    n = int(rng.integers(5, 12))
    if temperatures:
        n = max(n, 7)
    fs = float(
        rng.choice(
            [100, 128, 200, 250, 256, 400, 500, 512, 1000], p=[0.12, 0.08, 0.24, 0.14, 0.16, 0.08, 0.09, 0.05, 0.04]
        )
    )
    tests = programmes.make(rng, n, u, fmax, fs, vlim)
    for t in tests:
        t["stride"] = max(1, int(round(1 / (t["dt"] * 700.0))))
    val = list(rng.permutation(np.arange(1, n))[: max(1, int(round(n / 3)))])
    base_T = 20.0 if law == "mgmm" else float(rng.choice([18, 20, 20, 21, 22.5, 23]))
    if temperatures:
        levels = [20.0, 10.0, 30.0, 35.0] if law != "mgmm" else [20.0, 25.0, 30.0, 35.0]
        levels = levels[: int(rng.integers(3, 5))]
        T = [levels[i % len(levels)] for i in range(n)]
        T = sorted(T) if rng.random() < 0.3 else T
        used = {T[i] for i in range(n) if i not in val}
        val = [i for i in val if T[i] in used]
    else:
        T = [base_T] * n
    fit = [i for i in range(n) if i not in val]
    gaps = [0.0] + [float(np.exp(rng.uniform(np.log(180), np.log(5400)))) for _ in range(n - 1)]
    clock = list(np.cumsum(gaps))
    camp = dict(
        law=law,
        P=P,
        tests=tests,
        fs=fs,
        fit=fit,
        validate=sorted(int(i) for i in val),
        fmax=fmax,
        gaps=gaps,
        spec=spec,
        lasting=bool(law == "mgmm" and rng.random() < 0.3),
        cut={},
    )
    camp["sc"] = dict(n=n, T=T, clock=clock, fs=fs)
    ref = simulate(camp, P, [])
    us, Fs = [r[1] for r in ref], [r[2] for r in ref]
    dts = [r[0][1] - r[0][0] for r in ref]
    vs = [np.gradient(a, d) for a, d in zip(us, dts, strict=False)]
    k = reference_stiffness(law, P)
    work = [float(np.sum((f - k * a) * v) * d) for f, a, v, d in zip(Fs, us, vs, dts, strict=False)]
    camp["sc"].update(
        u=max(np.abs(a).max() for a in us),
        v=max(np.abs(a).max() for a in vs),
        F=max(np.abs(a).max() for a in Fs),
        a=max(np.abs(np.gradient(a, d)).max() for a, d in zip(vs, dts, strict=False)),
        energy=sum(work),
        path=sum(float(np.abs(np.diff(a)).sum()) for a in us),
        power=max(w / r[0][-1] for w, r in zip(work, ref, strict=False)),
    )
    camp["noise"] = draw_noise(rng, camp, [np.abs(f).max() for f in Fs])
    for i in list(rng.permutation(np.arange(1, n)))[: int(rng.integers(1, 3))] if rng.random() < 0.15 else []:
        if tests[i]["kind"] in ("sine", "quake", "steps") and tests[i]["t"][-1] > 10:
            camp["cut"][int(i)] = float(np.round(rng.uniform(2.2, 4.0), 2))
    return camp


def size_key(e):
    return "size" if e["name"] in UNLISTED or e["name"] == "slip" else fx.SIZE[e["name"]]


def set_sizes(rng, camp, effects, unlisted):
    """Sizes so that each effect leaves 3 to 30 times the noise after a refit beside the others, or None."""
    items = effects + ([unlisted] if unlisted else [])
    f, ref = floor_of(rng, camp, camp["noise"], effects, unlisted)
    targets = []
    for _ in items:
        lo, hi = max((5.5 if unlisted else 3.5) * f, 0.0125), min(24 * f, 0.13)
        if lo > hi:
            return None
        targets.append(float(np.exp(rng.uniform(np.log(lo), np.log(hi)))))
    for turn in range(5):
        left, good = [], True
        for e, target in zip(items, targets, strict=False):
            known = [o for o in effects if o is not e]
            a, b = refit(camp, ref, known, [e] if fx.moves_displacement(e) else [], nfev=6 if turn < 3 else 8)
            if unlisted is not None and e is not unlisted:
                a = b = 1.0
            left.append((a, b))
            if turn == 0 and a < target / 40:
                return None  # cannot be seen in this campaign
            if not (max(3.3 * f, 0.0108) * (1.55 if unlisted else 1) <= a <= min(27 * f, 0.25)) or b < max(
                2.5 * f, 0.008
            ):
                good = False
        if good and unlisted and unlisted["name"] != "crack":  # to be seen in the validate tests, whatever was fitted
            good = nrms(simulate(camp, camp["P"], effects), ref, camp["validate"]) > 3 * f
        if good:
            return f, left, ref
        for e, (a, b), target in zip(items, left, targets, strict=False):
            k = size_key(e)
            e["par"][k] *= float(np.clip(target / max(min(a, 1.4 * b), 1e-6), 0.25, 4.0)) ** 0.95
            top = fx.LIMIT.get(e["name"])
            if (top and abs(e["par"][k]) > top and not (e["name"] == "one_sided" and e["form"] == 2)) or (
                e["name"] == "lag" and e["par"]["tau"] > 0.08
            ):
                return None
            if (
                e["name"] == "static_offset"
                and abs(e["par"][k]) > 0.5 * camp["sc"]["u"]
                or e["name"] == "play"
                and e["par"][k] > 0.35 * camp["sc"]["u"]
            ):
                return None
        f, ref = floor_of(rng, camp, camp["noise"], effects, unlisted)
    return None


def accepted(rng, camp, effects, e, ref, f):
    """Names of the list that leave no more than 0.7 times the noise in the place of e (fitted with the law)."""
    names = list(ACCEPT.get((e["name"], e["form"]), [])) if camp["law"] in ("kelvin_voigt", "zener") else []
    known = [o for o in effects if o is not e]
    for other in CONFOUNDED[e["name"]]:
        if other in names or camp["law"] not in fx.SUITS[other]:
            continue
        tries = {
            "lag": (2, 3),
            "ageing": (1, 2),
            "degradation": (1, 2),
            "friction": (1, 3),
            "velocity_exponent": (1,),
        }.get(other, (1,))
        for form in tries:
            trial = fx.draw(rng, other, camp["law"], camp["sc"], form)
            if other == "gain":
                continue
            signed = other in ("ageing", "one_sided", "offset", "static_offset")
            starts = (0.5, -0.5) if signed else (0.5,)
            best = min(
                refit(
                    camp, ref, known, [e] if fx.moves_displacement(e) else [], dict(trial, signed=signed, start=s), 9
                )[0]
                for s in starts
            )
            if best < 0.7 * f:
                names.append(other)
                break
    return names


def make_campaign(rng, category, wanted, law_wanted, odd_one):
    """Draw until effects are as large as they have to be."""
    for attempt in range(6 if category.startswith("two") else 14):
        group = category[-1] if category != "unlisted" else ("F" if law_wanted in ("mgmm", "kelvin_voigt") else "H")
        law = law_wanted
        if attempt > 4 and wanted:  # another law may show it better
            pool = [
                q
                for q in fx.ALL
                if all(q in fx.SUITS[w] for w in wanted) and (q in ("mgmm", "kelvin_voigt")) == (group == "F")
            ]
            law = str(rng.choice(pool)) if pool else law
        hot = "temperature_law" in wanted or (rng.random() < 0.07)
        camp = base_campaign(rng, law, hot)
        if not camp["validate"]:
            continue
        if attempt > 3 and category[:5] != "clean" and camp["noise"]["force_share"] > 0.006:
            continue  # room for 3 to 30 times
        effects = [fx.draw(rng, w, law, camp["sc"]) for w in wanted]
        unlisted = draw_unlisted(rng, camp, odd_one) if odd_one else None
        if not effects and not unlisted:
            f, ref = floor_of(rng, camp, camp["noise"], [])
            if f > 0.05:
                continue
            return camp, [], None, f, [], ref
        done = set_sizes(rng, camp, effects, unlisted)
        if done:
            return camp, effects, unlisted, done[0], done[1], done[2]
    return None
