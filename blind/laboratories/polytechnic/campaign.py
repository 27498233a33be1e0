"""One campaign: effects of a size that can be seen, names that are as good."""

import numpy as np

from . import hidden
from .base import base, context, noise_nrms
from .laboratory import ASK, Refit, add_noise, loguni, measure
from .laws import VE, declare, si_law


def resize(e, ratio, ref):
    """Multiply the size of an effect; returns whether it stays in its bounds. ref: the nominal size."""
    key, lo, hi = e["size"][:3]
    how = e["size"][3] if len(e["size"]) > 3 else "abs"
    x = e["par"][key]
    if how == "inverse":
        new = x / ratio
        r = ref / new
        ok = lo <= r <= hi
    elif how == "clip":
        new = 1 - (1 - x) * ratio**0.7
        ok = lo <= new <= hi
        new = min(max(new, lo), hi)
    else:
        new = x * ratio
        r = abs(new / ref) if how == "rel" else abs(new)
        ok = lo <= r <= hi
    e["par"][key] = new
    return ok


def tune(camp, e, target, others=()):
    """Size of an effect so that it leaves the target after a linear refit of the law."""
    ref, J, ok, left = e["par"][e["size"][0]], None, True, 0.0
    for it in range(5):
        rec = measure(camp, [*others, e])
        if not all(np.isfinite(F).all() for _, F in rec):
            return False
        R = Refit(camp, rec)
        if J is None or it == 2:
            J = R.basis()[1]
        left, _ = R.linear(J)
        if 0.8 < left / target < 1.25:
            break
        ok = resize(e, float(np.clip(target / max(left, 1e-9), 0.12, 8.0)), ref)
        if not ok and it > 1:
            return False
    return ok and 0.5 < left / target < 2.0


def campaign(category, rng, state):
    """Draws until the effects have the sizes asked for. Returns camp, effects, recordings, truth."""
    group = category[-1] if category[-1] in "FH" and category != "unlisted" else str(rng.choice(["F", "H"]))
    laws = ["mgmm", "kelvin_voigt"] if group == "F" else hidden.H_LAWS
    names = []
    if category.startswith("one"):
        c = state.setdefault(category, 0)
        state[category] = c + 1
    for attempt in range(120):
        if category.startswith("one"):  # after forty failures the next effect
            names = [state["order_" + category][(c + attempt // 40) % 20]]
        if category.startswith("two"):
            while True:
                names = [str(x) for x in rng.choice(hidden.NAMES, 2, replace=False)]
                if hidden.GROUP_OF[names[0]] != hidden.GROUP_OF[names[1]] and not any(set(names) <= s for s in TWINS):
                    break
        ok_laws = [x for x in laws if all(x in hidden.FOR.get(n, [x]) for n in names)]
        if not ok_laws:
            continue
        w = np.array(
            [
                {
                    "bouc_wen": 0.22,
                    "friction": 0.16,
                    "viscous_power": 0.24,
                    "maxwell_power": 0.07,
                    "elastic_plastic": 0.15,
                }.get(x, 0.16)
                for x in ok_laws
            ]
        )
        law = str(rng.choice(ok_laws, p=w / w.sum()))
        several = "temperature_law" in names or (rng.random() < 0.15 and law not in VE)
        motion_share = rng.random() < 1 / 3
        b = base(
            law,
            rng,
            several,
            bool({"mullins"} & set(names)) or rng.random() < 0.3,
            "hum" in names,
            motion_share,
            7 if set(names) & {"ageing", "gain", "mullins", "degradation", "temperature_law"} else 5,
        )
        if b is None:
            continue
        camp, rec0 = b
        for _ in range(12):  # the displacement's noise must not make more of the force than its own noise
            noisy0 = add_noise(camp, rec0, np.random.default_rng(1))
            nz, by_disp = noise_nrms(camp, rec0, noisy0, "fit")
            if by_disp < 0.6 * nz:
                break
            camp["noise"]["disp"] *= 0.6
            camp["noise"]["bits_u"] += 1 if camp["noise"]["bits"] else 0
        ctx = context(camp, rec0)
        camp["v_ref"] = 0.5 * ctx["V"]
        # what the file says of the start
        moving = [j for j, m in enumerate(camp["motions"]) if m["moving"]]
        camp["declared_start"] = bool(moving) and rng.random() < 0.5
        effects, rec, left, total, accept = [], rec0, 0.0, 0.0, []
        if category.startswith("clean"):
            R = Refit(camp, rec0)
            total = np.linalg.norm(R.residual(np.zeros(len(R.free))))
            left = R.full(4)
        else:
            lo, hi = max(3.6 * nz, 0.0125), min(25 * nz, 0.2)
            if category == "unlisted":
                lo, hi = max(5.5 * nz, 0.0125), min(25 * nz, 0.2)
                c = state.setdefault("unlisted", 0)
                names = [hidden.UNLISTED[(c + state["first_unlisted"] + attempt // 25) % len(hidden.UNLISTED)]]
                if names[0] in ("cracked_layer",) and law in ("viscous_power", "maxwell_power", "friction"):
                    continue
            if lo > hi:
                continue
            draws = [
                hidden.draw_unlisted(n, rng, camp, ctx) if category == "unlisted" else hidden.draw(n, rng, camp, ctx)
                for n in names
            ]
            good = True
            for e in draws:
                good = good and tune(camp, e, loguni(rng, lo, hi if len(draws) == 1 else min(hi, 4 * lo)))
                if not good:
                    break
            if not good:
                state["redraws"][names[0]] = state["redraws"].get(names[0], 0) + 1
                continue
            effects = draws
            rec = measure(camp, effects)
            R = Refit(camp, rec)
            total = np.linalg.norm(R.residual(np.zeros(len(R.free))))
            left = R.full()
            top = min(30 * nz, 0.25)
            bottom = max((3 if category != "unlisted" else 5) * nz, 0.01)
            peak_law = ctx["F"]
            if not bottom <= left <= top or total > 0.7 or max(np.abs(F).max() for _, F in rec) > 3 * peak_law:
                state["redraws"][names[0]] = state["redraws"].get(names[0], 0) + 1
                continue
            if len(effects) == 2:  # neither may hide the other
                rr = []
                for e in effects:
                    Ra = Refit(camp, measure(camp, [e]))
                    rr.append((Ra.full(5), Ra.r))
                if (
                    min(x for x, _ in rr) < max(3 * nz, 0.008)
                    or abs(rr[0][1] @ rr[1][1]) / (rr[0][0] * rr[1][0]) > 0.6
                    or left < 0.8 * max(x for x, _ in rr)
                ):
                    continue
                accept = [[], []]
                for i, e in enumerate(effects):
                    e["alone"] = float(rr[i][0])
                    Ra = Refit(camp, measure(camp, [e]))
                    Ra.x = np.zeros(len(Ra.free))
                    accept[i] = rivals(Ra, e, ctx, nz, rr[i][0])
                if set(accept[0]) & {names[1]} or set(accept[1]) & {names[0]}:
                    continue
            elif category != "unlisted":
                accept = [rivals(R, effects[0], ctx, nz, left)]
            else:
                accept = [[]]
                state["unlisted"] += 1
        noisy = add_noise(camp, rec, rng)
        floor = noise_nrms(camp, rec, noisy, "validate")[0]
        q = declare(law, camp["p"], rng, camp["v_ref"])
        truth = {
            "category": category,
            "law": law,
            "group": group,
            "effects": [],
            "nrms_effect": float(total),
            "nrms_after_refit": float(left),
            "nrms_noise_fit": nz,
            "noise_floor_validate": floor,
            "nrms_definition": "rms error / rms force, pooled over samples (with the root)",
            "nrms_sampling": float(camp["sampling_error"]),
            "sampling_rate": camp["fs"],
            "noise": camp["noise"],
            "tests_in_motion": [f"test_{j + 1:02d}" for j in moving],
            "start_declared": camp["declared_start"],
            "start_kinds": {f"test_{j + 1:02d}": camp["motions"][j]["moving"] for j in moving},
            "law_true": si_law(law, camp["p"]),
            "law_declared": si_law(law, q),
            "attempts": attempt + 1,
        }
        for e, acc in zip(effects, accept, strict=False):
            t = {
                "name": e["name"],
                "kind": e["kind"],
                "equation": e["equation"],
                "parameters": hidden.to_si(e["par"]),
                "accept": acc,
                "parts": ["offset"] if e["par"].get("form") == "wander" else [],
            }
            if "alone" in e:
                t["nrms_after_refit_alone"] = e["alone"]
            truth["effects"].append(t)
        return camp, noisy, q, truth
    raise RuntimeError(f"no {category} {names} in 120 attempts")


TWINS = [
    {"offset", "static_offset"},
    {"offset", "drift"},
    {"static_offset", "drift"},
    {"lag", "series_flexibility"},
    {"lag", "relaxation_branch"},
    {"series_flexibility", "relaxation_branch"},
    {"ageing", "gain"},
    {"mullins", "gain"},
    {"degradation", "gain"},
    {"friction", "velocity_exponent"},
    {"lag", "inertia"},
    {"series_flexibility", "play"},
]


def rivals(R, e, ctx, nz, left):
    """Names that, fitted with the law, leave less than half the noise and a twentieth of what the law alone leaves."""
    out = []
    if e["name"] == "static_offset" and R.camp["law"] in ("kelvin_voigt", "zener", "elastic_plastic", "bouc_wen"):
        return ["offset"]
    if R.camp["law"] == "kelvin_voigt":  # spring and dashpot behind a spring: Zener; so is F + tau F' = k u + c v
        out = (
            ["relaxation_branch", "lag"]
            if e["name"] == "series_flexibility"
            else ["series_flexibility", "relaxation_branch"]
            if "lag1_F" in e["par"]
            else []
        )
    for n in [x for x in ASK.get(e["name"], []) if x not in out]:
        if n in ("static_offset",) and R.camp["law"] in ("viscous_power", "friction", "maxwell_power"):
            continue
        if R.rival(n, ctx) < max(min(0.5 * nz, 0.15 * left), 0.02 * left):
            out.append(n)
    return out
