"""Hidden effects: draws of form and parameters, equations, sizes. Units inside: mm, kN, s."""

import numpy as np

from .laboratory import loguni, smooth01

NAMES = (
    "payne mullins degradation ageing self_heating temperature_law hardening one_sided "
    "relaxation_branch velocity_exponent "
    "friction series_flexibility play inertia lag gain offset static_offset drift hum"
).split()
H_LAWS = ["bouc_wen", "friction", "viscous_power", "zener", "elastic_plastic", "maxwell_power"]
FOR = {  # laws of group H (and F) that can show the effect beside their own parameters
    "payne": ["zener", "mgmm", "kelvin_voigt"],
    "mullins": ["zener", "bouc_wen", "kelvin_voigt", "mgmm"],
    "relaxation_branch": ["zener", "bouc_wen", "elastic_plastic", "friction", "viscous_power", "kelvin_voigt", "mgmm"],
    "velocity_exponent": ["zener", "bouc_wen", "elastic_plastic", "friction", "kelvin_voigt"],
    "friction": ["zener", "viscous_power", "maxwell_power", "kelvin_voigt", "mgmm"],
    "series_flexibility": ["viscous_power", "bouc_wen", "kelvin_voigt", "mgmm"],
    "static_offset": ["bouc_wen", "elastic_plastic", "zener", "mgmm"],
}
# factor to SI of parameters: kN -> N etc.; keys not named have none
SI = {
    "pay_a": 1e-3,
    "mul_c": 1e-3,
    "heat_C": 1.0,
    "hard_u": 1e-3,
    "br_k": 1e6,
    "ve_v0": 1e-3,
    "fr_F": 1e3,
    "fr_k": 1e6,
    "fr_v": 1e-3,
    "u0": 1e-3,
    "rig_k": 1e6,
    "rig_gap": 1e-3,
    "crack_u": 1e-3,
    "anc_F": 1e3,
    "anc_jump": 1e-3,
    "mass": 1e6,
    "zero": 1e3,
    "tone": 1e3,
    "hunt": 1e-3,
    "bolt_u": 1e-3,
    "bolt_F": 1e3,
    "cross": 1e3,
    "band": 1e3,
}
GROUP_OF = {
    n: k
    for k, names in {
        "damper": " ".join(NAMES[:10]),
        "rig": "friction series_flexibility play inertia static_offset",
        "instrument": "lag gain offset drift hum",
    }.items()
    for n in names.split()
}


def to_si(par):
    out = {}
    for k, v in par.items():
        if k.startswith("_"):
            continue
        f = SI.get(k, 1.0)
        if k == "hard_k":
            f = 1e3 * 1e3 ** par["hard_p"]
        if k == "ve_c":
            f = 1e3 * 1e3 ** par["ve_a"] if par["ve_form"] < 1.5 else 1e3
        if k == "deg_w":
            f = 1.0 if par["deg_form"] < 1.5 else 1e-3
        if k == "one_e":
            f = 1e6 if par["one_form"] == 2 else 1.0
        if k == "drift":
            f = 1e3 if par["channel"] == "force" else 1e-3
        out[k] = (
            v if isinstance(v, (str, bool)) else (np.asarray(v, float) * f).tolist() if np.ndim(v) else float(v) * f
        )
    return out


def draw(name, rng, camp, ctx):
    """An effect: name, kind, equation, par; size: the key whose number is its size, with its bounds."""
    A, V, Fp, W, acc, S = ctx["A"], ctx["V"], ctx["F"], ctx["W"], ctx["acc"], ctx["path"]
    law, n = camp["law"], len(camp["motions"])
    ve = law in ("kelvin_voigt", "zener", "mgmm")
    sign = rng.choice([-1.0, 1.0])
    kind, c = GROUP_OF[name], rng.random()
    if name == "payne":
        form = 1.0 if c < 0.6 else 2.0
        part = 1.0 if law in ("kelvin_voigt", "zener") and rng.random() < 0.5 else 0.0
        par = dict(
            pay_s=0.2,
            pay_a=A * loguni(rng, 0.1, 0.5),
            pay_m=rng.uniform(0.5, 1.2),
            pay_tau=loguni(rng, 2, 25),
            pay_form=form,
            pay_part=part,
        )
        eq = (
            ("F = [1 - s (1 - L)] F_law" if not part else "F = F_law - s (1 - L) k u")
            + ", L = 1/(1 + (a/a_c)^2m), "
            + (
                "a = max(|u|, a faded by exp(-dt/tau)) (Kraus 1984 with healing)"
                if form < 1.5
                else (
                    "L relaxes to L_eq(|u|): at once downwards (0.03 s), in tau upwards (structure kinetics, Lion 2004)"
                )
            )
        )
        size = ("pay_s", 0.02, 0.75)
    elif name == "mullins":
        if c < 0.6 or law == "mgmm":
            par = dict(mul_s=0.2, mul_c=A * loguni(rng, 0.2, 0.6), mul_b=rng.uniform(0, 0.3), mul_form=1.0)
            eq = (
                "F = eta F_law, eta = 1 - s erf((um^2 - u^2)/(c^2 + b um^2)), um the largest |u| so far in all "
                "tests (Ogden & Roxburgh 1999)"
            )
        else:
            par = dict(mul_s=0.2, mul_c=A * loguni(rng, 0.15, 0.6), mul_form=2.0)
            eq = "F = [1 - s (1 - (1 - exp(-y))/y)] F_law, y = um/c, um the largest |u| so far in all tests (Simo 1987)"
        size = ("mul_s", 0.02, 0.75)
    elif name == "degradation":
        if c < 0.5:
            par = dict(deg_s=0.2, deg_w=W * loguni(rng, 0.2, 1.5), deg_form=1.0)
            eq = (
                "F = [1 - s (1 - exp(-E/E0))] F_law, E energy dissipated since the first test (after Baber & "
                "Noori 1985)"
            )
        else:
            par = dict(deg_s=0.2, deg_w=S * loguni(rng, 0.3, 1.5), deg_form=2.0)
            eq = "F = [1 - s S/(S + S0)] F_law, S path travelled since the first test (wear, after Archard 1953)"
        size = ("deg_s", 0.02, 0.8)
    elif name == "ageing":
        k = np.arange(n)
        if c < 0.4:
            w, eq = k / (n - 1), "F = (1 + a i/(n-1)) F_law in test i of n"
        elif c < 0.7:
            w, eq = np.log1p(k * loguni(rng, 0.5, 4)), "F = (1 + a ln(1 + r i)) F_law in test i"
            w = w / w[-1]
        else:
            w = 1 - np.exp(-k / (n * rng.uniform(0.2, 0.8)))
            w, eq = w / w[-1], "F = (1 + a w_i) F_law, w_i = 1 - exp(-i/i0), made 1 in the last test"
        par = dict(a=0.1 * sign, factor_tests=w)
        size = ("a", 0.01, 0.5)
    elif name == "self_heating":
        dT = loguni(rng, 5, 25)
        par = dict(heat_b=0.01, heat_C=ctx["Wmax"] / dT, heat_tau=loguni(rng, 20, 300))
        eq = (
            "F = exp(-b theta) F_law, C theta' = |F v|+ - C theta/tau; cools between the tests (Kasai 1993; "
            "Black & Makris 2007)"
        )
        size = ("heat_b", 0.001, 0.09)
    elif name == "temperature_law":
        if c < 0.35:
            par, eq, size = (
                dict(b_T=0.01 * sign if not ve else 0.01),
                "F = exp(-b (T - 20 degC)) F_law",
                ("b_T", 0.001, 0.05),
            )
        elif c < 0.65 or law in ("friction", "elastic_plastic", "bouc_wen", "zener"):
            par, eq, size = (
                dict(Q_T=8000.0),
                "F = exp(Q/R (1/T - 1/293.15 K)) F_law (Arrhenius)",
                ("Q_T", 800.0, 45000.0),
            )
        else:
            par = dict(c1_T=3.0, c2_T=rng.uniform(60, 120))
            eq = (
                "viscous part (dashpots) of F_law times a_T = 10^(-c1 (T - 20)/(c2 + T - 20)) (Williams, Landel "
                "& Ferry 1955)"
            )
            size = ("c1_T", 0.2, 12.0)
    elif name == "hardening":
        if c < 0.6:
            q = rng.uniform(2.2, 5.0)
            par, eq = dict(hard_k=0.2 * Fp / A**q, hard_p=q), "F = F_law + k |u|^p sgn u"
        else:
            q, x = rng.uniform(1.0, 2.0), A * rng.uniform(0.35, 0.65)
            par = dict(hard_k=0.3 * Fp / (A - x) ** q, hard_p=q, hard_u=x)
            eq = "F = F_law + k (|u| - u_h)^p sgn u beyond |u| = u_h"
        size = ("hard_k", 0.02, 12.0, "rel")
    elif name == "one_sided":
        form = rng.choice([1.0, 3.0]) if law in ("viscous_power", "maxwell_power") else rng.choice([1.0, 2.0])
        if law in ("viscous_power",):
            form = 1.0
        par = dict(one_e=0.15 * sign if form != 2 else 0.2 * Fp / A, one_form=form)
        eq = {
            1.0: "F = (1 + e) F_law where F_law > 0",
            2.0: "F = F_law + k max(u, 0)",
            3.0: "F = (1 + e v/(v + 1 mm/s)) F_law where v > 0",
        }[form]
        size = ("one_e", 0.02, 6.0, "rel") if form == 2 else ("one_e", 0.01, 0.6)
    elif name == "relaxation_branch":
        par, eq = dict(br_k=0.3 * Fp / A, br_tau=loguni(rng, 0.02, 3.0)), "F = F_law + q, q' + q/tau = k u' (Maxwell)"
        size = ("br_k", 0.02, 20.0, "rel")
    elif name == "velocity_exponent":
        if c < 0.6:
            a = rng.uniform(0.2, 0.6) if rng.random() < 0.7 else rng.uniform(1.5, 2.0)
            par, eq = dict(ve_c=0.2 * Fp / V**a, ve_a=a, ve_form=1.0), "F = F_law + c |v|^a sgn v"
        else:
            par = dict(ve_c=0.2 * Fp, ve_v0=V * loguni(rng, 0.08, 0.5), ve_form=2.0)
            eq = "F = F_law + F_s v/sqrt(v^2 + v0^2) (flow that saturates)"
        size = ("ve_c", 0.02, 10.0, "rel")
    elif name == "friction":
        Ff = 0.08 * Fp
        par = dict(fr_F=Ff, fr_k=Ff / (A * loguni(rng, 0.003, 0.03)))
        eq = "F = F_law + f, df/du = sigma (1 - f sgn(v)/F_c) (Dahl 1968)"
        if c < 0.35:
            par.update(fr_s=rng.uniform(0.2, 0.6), fr_v=V * loguni(rng, 0.05, 0.3))
            eq += ", F_c = F_f (1 + s exp(-(v/v_s)^2)) (Stribeck)"
        kind = rng.choice(["rig", "damper"])
        size = ("fr_F", 0.05, 12.0, "rel")
    elif name == "series_flexibility":
        par, eq = dict(rig_k=12.0 * Fp / A), "u = d + F(d)/k_rig, d the deformation of the specimen"
        size = ("rig_k", 0.08, 20.0, "inverse")
    elif name == "play":
        par = dict(rig_gap=0.01 * A, rig_k=Fp / A * loguni(rng, 50, 150))
        eq = "u - d = x; F = k_c (|x| - g) sgn x beyond |x| = g, else 0 (clearance 2 g, contact stiffness k_c)"
        size = ("rig_gap", 0.02, 20.0, "rel")
    elif name == "inertia":
        par, eq = dict(mass=0.05 * Fp / acc), "F_cell = F + m u''"
        size = ("mass", 0.01, 20.0, "rel")
    elif name == "lag":
        if c < 0.4:
            par, eq, size = dict(lag_F=0.005), "F_rec(t) = F(t - tau)", ("lag_F", 0.0005, 0.06)
        elif c < 0.7:
            par, eq, size = dict(lag_u=0.005), "u_rec(t) = u(t - tau)", ("lag_u", 0.0005, 0.06)
        else:
            par, eq, size = dict(lag1_F=0.005), "tau F_rec' + F_rec = F", ("lag1_F", 0.0005, 0.06)
    elif name == "gain":
        fit = [j for j in range(n) if camp["use"][j] == "fit"]
        channel = "force" if law in ("kelvin_voigt", "zener") or c < 0.65 else "displacement"
        par = dict(gain=0.08 * sign, channel=channel)
        par["from"] = int(fit[rng.integers(2, len(fit) - 1)] if len(fit) > 3 else fit[-1])
        eq = f"recorded {channel} = (1 + gain) true, from test number `from` on (0 is the first)"
        size = ("gain", 0.01, 0.35)
    elif name == "offset":
        w = (
            np.ones(n)
            if c < 0.4
            else rng.uniform(0.3, 1.0, n) * rng.choice([-1, 1], n)
            if c < 0.8
            else 1 + 0.3 * rng.standard_normal(n)
        )
        par, eq, size = (
            dict(zero=0.05 * Fp * sign, of_tests=w),
            "F_rec = F + F0 w_i, constant in test i",
            ("zero", 0.05, 12.0, "rel"),
        )
    elif name == "static_offset":
        par, eq = dict(u0=0.1 * A * sign), "d = u + u0 in all tests; relaxed at u0 before each"
        size = ("u0", 0.05, 6.0, "rel")
    elif name == "drift":
        form = rng.choice(["linear", "warm-up", "wander"])
        channel = "force" if c < 0.75 or law in ("friction", "viscous_power", "maxwell_power") else "displacement"
        w = rng.uniform(0.4, 1.0, n) * (rng.choice([-1, 1], n) if rng.random() < 0.5 else sign)
        par = dict(
            drift=0.1 * (Fp if channel == "force" else A),
            form=form,
            channel=channel,
            of_tests=w,
            tau=loguni(rng, 4, 12) if form != "wander" else loguni(rng, 25, 60),
        )
        eq = {
            "linear": "w_i D t/(30 s)",
            "warm-up": "w_i D (1 - exp(-t/tau))",
            "wander": "w_i D sin(2 pi t/tau + 0.7 i)",
        }[form]
        eq = f"{channel} + {eq} in test i"
        size = ("drift", 0.05, 15.0, "rel")
    else:
        fs = camp["motions"][0]["fs"]
        f = (
            float(rng.choice([50.0, 49.9, 16.7, 24.0]))
            if fs >= 200 and c < 0.6
            else loguni(rng, 6.0, min(30.0, 0.3 * fs))
        )
        par = dict(tone=0.03 * Fp, f_tone=f, phase=rng.uniform(0, 2 * np.pi, n))
        eq, size = "F_rec = F + a sin(2 pi f t + phase_i) in test i", ("tone", 0.05, 10.0, "rel")
    return {"name": name, "kind": str(kind), "equation": eq, "par": par, "size": size}


UNLISTED = (
    "anchorage_stick_slip sample_and_hold loose_bolt cross_talk dead_band clipping cracked_layer hunting freezing"
).split()


def draw_unlisted(name, rng, camp, ctx):
    A, _V, Fp = ctx["A"], ctx["V"], ctx["F"]
    n = len(camp["motions"])
    seed = int(rng.integers(1 << 30))
    e = {"name": name, "kind": "rig"}
    if name == "anchorage_stick_slip":
        e.update(
            equation=(
                "anchorage slips by a jump towards the force each time |F| exceeds F_s (0.02 s each); d = u - "
                "sum of jumps"
            ),
            par=dict(anc_F=Fp * rng.uniform(0.55, 0.8), anc_jump=0.02 * A),
            size=("anc_jump", 0.05, 10.0, "rel"),
        )
    elif name == "sample_and_hold":

        def ch(q, u, F, t, j):
            i = np.arange(F.size)
            k = max(2, int(round(q["hold"] / (t[1] - t[0]))))
            i = (i // k) * k
            return u, F[i]

        e.update(
            kind="instrument",
            equation="force channel is held for `hold` s and renewed then",
            par=dict(hold=0.04),
            channels=ch,
            size=("hold", 0.02, 0.4),
        )
    elif name == "loose_bolt":
        rate = loguni(rng, 0.15, 0.5)
        spring = camp["law"] not in ("viscous_power", "maxwell_power", "friction")

        def state(m, j):
            r = np.random.default_rng([seed, j])
            t = m["t"] if isinstance(m, dict) else m
            k = max(2, r.poisson(rate * (t[-1] - t[0])))
            tj = np.sort(r.uniform(t[0], t[-1], k))
            lv = r.uniform(-1, 1, k + 1)
            lv[0] = 0
            x = np.zeros(t.size)
            for a, b, c0 in zip(tj, lv[1:], lv[:-1], strict=False):
                x += (b - c0) * smooth01((t - a) / 0.02)
            return x

        e.update(
            equation=("d = u + b" if spring else "F_rec = F + b")
            + ", b jumps at random times to random levels within +- size"
        )
        if spring:
            e.update(
                par=dict(bolt_u=0.05 * A, rate_Hz=rate),
                motion=lambda q, m, j: q["bolt_u"] * state(m, j),
                size=("bolt_u", 0.05, 10.0, "rel"),
            )
        else:
            e.update(
                par=dict(bolt_F=0.08 * Fp, rate_Hz=rate),
                channels=lambda q, u, F, t, j: (u, F + q["bolt_F"] * state(t, j)),
                size=("bolt_F", 0.05, 10.0, "rel"),
            )
    elif name == "cross_talk":
        f = loguni(rng, 0.3, 1.2)

        def ch(q, u, F, t, j):
            r = np.random.default_rng([seed, j])
            x = sum(
                r.standard_normal() * np.sin(2 * np.pi * f * s * t + r.uniform(0, 6.3))
                for s in np.linspace(0.6, 1.7, 9)
            )
            w = smooth01(np.sin(2 * np.pi * (t / r.uniform(6, 12) + r.random())) * 2)
            return u, F + q["cross"] * x * w / 3.0

        e.update(
            kind="instrument",
            equation="force channel + bursts of narrow-band random force of a transverse actuator that is not recorded",
            par=dict(cross=0.1 * Fp, band_Hz=f),
            channels=ch,
            size=("cross", 0.05, 10.0, "rel"),
        )
    elif name == "dead_band":
        e.update(
            kind="instrument",
            equation="F_rec = sgn F max(|F| - b, 0): dead band of the amplifier",
            par=dict(band=0.05 * Fp),
            channels=lambda q, u, F, t, j: (u, np.sign(F) * np.maximum(np.abs(F) - q["band"], 0.0)),
            size=("band", 0.05, 8.0, "rel"),
        )
    elif name == "clipping":

        def ch(q, u, F, t, j):
            r = np.random.default_rng([seed, j])
            c = q["level"] * np.abs(F).max()
            w = np.sin(2 * np.pi * (t / r.uniform(5, 10) + r.random())) > 0
            return u, np.where(w, np.clip(F, -c, c), F)

        e.update(
            kind="instrument",
            equation="force clipped at +-level of its peak in the test, in part of the cycles",
            par=dict(level=0.75, inverse=1.0),
            channels=ch,
            size=("level", 0.2, 0.95, "clip"),
        )
    elif name == "cracked_layer":
        fit = [j for j in range(n) if camp["use"][j] == "fit" and camp["motions"][j]["A"] > 0.5 * A]
        e.update(
            kind="damper",
            equation=(
                "in test `only_test` F = F_law (1 - f (1 - exp(-(u - u_c)/(0.15 u_c)))) where u > u_c: a layer opens"
            ),
            par=dict(crack_f=0.4, crack_u=A * rng.uniform(0.15, 0.3), only_test=int(rng.choice(fit or [0]))),
            size=("crack_f", 0.05, 0.95),
        )
    elif name == "hunting":
        f = loguni(rng, 0.15, 0.6)

        def mo(q, m, j):
            r = np.random.default_rng([seed, j])
            t = m["t"]
            w = smooth01((t - t[0]) / 1.0) * (0.5 + 0.5 * np.sin(2 * np.pi * (t / r.uniform(7, 14) + r.random())))
            ph = np.cumsum(1 + 0.25 * np.sin(2 * np.pi * t / r.uniform(3, 6))) * m["h"]
            return q["hunt"] * w * (np.sin(2 * np.pi * f * ph + r.uniform(0, 6.3)) - 0 * t)

        e.update(
            equation="d = u + h(t): the controller hunts with an own motion that the recorded transducer does not see",
            par=dict(hunt=0.05 * A, f_Hz=f),
            motion=mo,
            size=("hunt", 0.05, 15.0, "rel"),
        )
    else:

        def ch(q, u, F, t, j):
            r = np.random.default_rng([seed, j])
            F = F.copy()
            for _ in range(max(1, r.poisson(0.12 * (t[-1] - t[0])))):
                a = r.uniform(t[0], t[-1] - q["gap_s"])
                i = np.flatnonzero((t >= a) & (t < a + q["gap_s"]))
                F[i] = F[i[0]]
            return u, F

        e.update(
            kind="instrument",
            equation="force channel freezes now and then for gap_s",
            par=dict(gap_s=0.3),
            channels=ch,
            size=("gap_s", 0.06, 1.5),
        )
    return e
