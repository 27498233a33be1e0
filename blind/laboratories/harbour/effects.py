"""What may be hidden: drawing, sizes, and what each does to motion, damper and channels. SI units."""

import numpy as np
from scipy.signal import lfilter

from .sim import SLOT, SLOTS

KIND = {
    **{
        n: "damper"
        for n in (
            "payne mullins degradation ageing self_heating temperature_law hardening one_sided "
            "relaxation_branch velocity_exponent friction"
        ).split()
    },
    **{n: "rig" for n in "series_flexibility play inertia static_offset".split()},
    **{n: "instrument" for n in "lag gain offset drift hum".split()},
}
NAMES = list(KIND)
SOFT = ["mgmm", "kelvin_voigt", "zener"]
STEEL = ["bouc_wen", "elastic_plastic", "friction"]
FLUID = ["viscous_power", "maxwell_power"]
ALL = SOFT + STEEL + FLUID
SUITS = {
    "payne": SOFT,
    "mullins": SOFT,
    "degradation": ALL,
    "ageing": ALL,
    "self_heating": ALL,
    "temperature_law": ALL,
    "hardening": ALL,
    "one_sided": ALL,
    "relaxation_branch": ["mgmm", "kelvin_voigt", "zener", "viscous_power"] + STEEL,
    "velocity_exponent": ["kelvin_voigt", "zener"] + STEEL,
    "friction": SOFT + FLUID,
    "series_flexibility": ["mgmm", "kelvin_voigt", "viscous_power"],
    "play": ALL,
    "inertia": ALL,
    "lag": ALL,
    "gain": ALL,
    "offset": ALL,
    "static_offset": SOFT,
    "drift": ALL,
    "hum": ALL,
}
EQUATION = {
    "payne1": (
        "F_law (1 - d x/(1 + x)), x = (u_a/u_c)^(2m), u_a largest |u| fading with tau (Kraus 1984; fading envelope)"
    ),
    "payne2": (
        "F_law (1 - d (1 - lambda)), lambda' = (1 - lambda)/tau - |v| lambda/u_c (thixotropy: Lion & Kardelky 2004)"
    ),
    "mullins1": "F_law (1 - d (1 - (1 - exp(-x))/x)), x = u_max/u_m, u_max of all tests so far (Simo 1987)",
    "mullins2": (
        "F_law (1 - d erf((u_max^2 - u^2)/(u_m^2 + b u_max^2))), u_max of all tests so far (Ogden & Roxburgh 1999)"
    ),
    "degradation1": (
        "F_law (1 - d (1 - exp(-E/E_d))), E energy dissipated in all tests so far (Park & Ang 1985 in spirit)"
    ),
    "degradation2": "F_law (1 - d (1 - exp(-s/s_d))), s path of all tests so far (wear, Archard 1953)",
    "degradation3": "F_law / (1 + d E/E_d), E energy dissipated so far (Baber & Wen 1981)",
    "ageing1": "all forces of the damper times 1 + a i/(n - 1), i number of the test from 0",
    "ageing2": "all forces of the damper times 1 + a ln(1 + t/t_0)/ln(1 + t_end/t_0), t clock of the laboratory",
    "self_heating1": "F_law exp(-b dT), C dT' = P - h dT, P power dissipated by the law (Makris et al. 1998)",
    "self_heating2": (
        "F_law / (1 + b dT), C dT' = P - h dT, P power dissipated by the law (Kalpakidis & Constantinou 2009)"
    ),
    "temperature_law1": "F_law exp(-b (T - T_ref)) in place of the law's own dependence, if it has one",
    "temperature_law2": "F_law exp(Q (1/T - 1/T_ref)), T in K, in place of the law's own dependence (Arrhenius)",
    "temperature_law3": "dashpots of the law times exp(-b (T - T_ref)/(1 + (T - T_ref)/T_2)) (Ferry 1980, WLF)",
    "hardening1": "F_law + k u^3 (cubic stiffening)",
    "hardening2": "F_law + k (|u| - r)^p sgn u beyond r (Amin et al. 2002; Abe et al. 2004)",
    "one_sided1": "F_law (1 + a) for F_law > 0, F_law (1 - a) for F_law < 0",
    "one_sided2": "F_law + k u for u > 0 alone",
    "relaxation_branch1": "F_law + q, q' = k v - q/tau (Maxwell)",
    "velocity_exponent1": "F_law + c |v|^a sgn v",
    "velocity_exponent2": "F_law + c v/(1 + |v|/v_s) (flow saturation)",
    "friction1": "F_law + r, r' = F_f/s v, |r| <= F_f (Jenkin element, Iwan 1966)",
    "friction2": "F_law + r, dr/du = (F_f - r sgn v)/s (Dahl 1968)",
    "friction3": "F_law + F_f tanh(v/s) (1 + 0.35 exp(-(v/8s)^2)) (Stribeck; Armstrong-Helouvry et al. 1994)",
    "series_flexibility1": "F = K (u_measured - u_specimen), K = 1/compliance",
    "play1": (
        "F = K dz(u_measured - u_specimen), dz dead zone of half-width gap, K stiff contact (Nordin & Gutman 2002)"
    ),
    "inertia1": "F_measured = F + m a, a acceleration of the measured displacement",
    "lag1": "force channel late: F_measured(t) = F(t - tau)",
    "lag2": "force channel: tau F_m' + F_m = F",
    "lag3": "displacement channel late: u_m(t) = u(t - tau)",
    "lag4": "displacement channel: tau u_m' + u_m = u",
    "gain1": "force channel times 1 + g from test number `first` (from 0) on",
    "gain2": "displacement channel times 1 + g from test number `first` (from 0) on",
    "gain3": "force channel times 1 + g in the tests listed (other range of the amplifier)",
    "offset1": "F_measured = F + F_0, the same in all tests",
    "offset2": "F_measured = F + F_0i, i number of the test",
    "static_offset1": "the damper's deformation is u_measured + u_0, held long before each test",
    "drift1": "F_measured = F + A s_i t/30 s, s_i each test's own (sign and size)",
    "drift2": "F_measured = F + A (sin(2 pi t/P + phi_i) - sin phi_i)",
    "drift3": "u_measured = u + A s_i t/30 s",
    "hum1": "F_measured = F + A sin(2 pi f t + phi_i)",
}
SIZE = dict(
    payne="d",
    mullins="d",
    degradation="d",
    ageing="a",
    self_heating="b",
    temperature_law="b",
    hardening="k",
    one_sided="a",
    relaxation_branch="k",
    velocity_exponent="c",
    friction="F_f",
    series_flexibility="compliance",
    play="gap",
    inertia="m",
    lag="tau",
    gain="g",
    offset="F_0",
    static_offset="u_0",
    drift="A",
    hum="A",
)
SHAPE = dict(
    payne=["u_c", "tau"],
    mullins=["u_m"],
    degradation=["E_d"],
    self_heating=["h"],
    relaxation_branch=["tau"],
    velocity_exponent=["v"],
    friction=["s"],
)
LIMIT = dict(payne=0.6, mullins=0.6, degradation=0.6, ageing=0.5, one_sided=0.35, gain=0.25)


def draw(rng, name, law, sc, form=None):
    """An effect of a plausible size. sc: scales of the campaign (u, v, F, a, energy, path, power, n, T, clock, fs)."""
    s = rng.choice([-1.0, 1.0])

    def logu(a, b):
        return float(np.exp(rng.uniform(np.log(a), np.log(b))))

    p, n = {}, sc["n"]

    def pick(*forms):
        return int(form or rng.choice(forms))

    if name == "payne":
        f = pick(1, 2)
        p = dict(d=rng.uniform(0.15, 0.4), u_c=sc["u"] * logu(0.12, 0.5), tau=logu(1.0, 8), m=rng.uniform(0.5, 0.9))
        if f == 2:
            p["u_c"] *= rng.uniform(3, 8)
    elif name == "mullins":
        f = pick(1, 2)
        p = dict(d=rng.uniform(0.2, 0.5), u_m=sc["u"] * logu(0.2, 0.7), b=rng.uniform(0.1, 0.4))
    elif name == "degradation":
        f = pick(1, 2, 3)
        p = dict(d=rng.uniform(0.15, 0.4), E_d=(sc["path"] if f == 2 else sc["energy"]) * logu(0.3, 1.5))
    elif name == "ageing":
        f = pick(1, 2)
        p = dict(a=s * rng.uniform(0.08, 0.2), t_0=sc["clock"][-1] * logu(0.05, 0.5))
    elif name == "self_heating":
        f = pick(1, 2)
        C = sc["power"] * 10 / logu(6, 25)  # 6 to 25 K in ten seconds of the strongest test
        p = dict(b=rng.uniform(0.005, 0.02), C=C, h=C / logu(15, 400))
    elif name == "temperature_law":
        f = pick(1, 2, 3) if law in ("kelvin_voigt", "zener") else pick(1, 2)
        p = dict(b=rng.uniform(0.008, 0.03) * (2 if f == 3 else 1), T_2=rng.uniform(50, 90))
        if f == 2:
            p["b"] *= 293.15**2  # Q in K
    elif name == "hardening":
        f = pick(1, 2)
        r, q = sc["u"] * rng.uniform(0.3, 0.6), rng.uniform(1.2, 2.5)
        p = dict(k=0.2 * sc["F"] / (sc["u"] ** 3 if f == 1 else (sc["u"] - r) ** q), r=r, p=q)
    elif name == "one_sided":
        f = pick(1, 1, 2)
        p = dict(a=s * rng.uniform(0.04, 0.12) * (1 if f == 1 else sc["F"] / sc["u"]))
        p["a"] = abs(p["a"]) if f == 2 else p["a"]
    elif name == "relaxation_branch":
        f, tau = 1, logu(0.1, 1.5)
        p = dict(k=0.3 * sc["F"] / sc["u"], tau=tau)
    elif name == "velocity_exponent":
        f = pick(1, 2)
        e = rng.uniform(0.2, 0.6) if f == 1 else sc["v"] * logu(0.05, 0.3)
        p = dict(c=0.15 * sc["F"] / (sc["v"] ** e if f == 1 else e), v=e)
    elif name == "friction":
        f = pick(1, 2, 3)
        p = dict(F_f=0.1 * sc["F"], s=sc["u"] * logu(0.004, 0.03) if f < 3 else sc["v"] * logu(0.005, 0.02))
    elif name == "series_flexibility":
        f, p = 1, dict(compliance=0.1 * sc["u"] / sc["F"])
    elif name == "play":
        f, p = 1, dict(gap=sc["u"] * rng.uniform(0.02, 0.06), K=sc["F"] / sc["u"] * rng.uniform(60, 150))
    elif name == "inertia":
        f, p = 1, dict(m=0.15 * sc["F"] / sc["a"])
    elif name == "lag":
        f, p = pick(1, 2, 3, 4), dict(tau=logu(0.004, 0.02))
    elif name == "gain":
        f = pick(1, 1, 2, 3)
        first = int(rng.integers(max(2, n // 3), max(3, n - 2)))
        tests = sorted(int(i) for i in rng.choice(n, max(2, n // 3), replace=False))
        p = dict(g=s * rng.uniform(0.05, 0.12), first=first, tests=tests)
    elif name == "offset":
        f = pick(1, 2)
        w = np.ones(n) if f == 1 else rng.uniform(-1, 1, n)
        p = dict(F_0=s * 0.06 * sc["F"], shares=[round(float(x), 4) for x in w])
    elif name == "static_offset":
        f, p = 1, dict(u_0=s * rng.uniform(0.03, 0.1) * sc["u"])
    elif name == "drift":
        f = pick(1, 2, 3) if law in SOFT else pick(1, 2)
        p = dict(A=0.1 * (sc["F"] if f < 3 else sc["u"]), P=rng.uniform(20, 45))
        p["shares"] = [
            round(float(x), 4)
            for x in (rng.choice([-1, 1]) if rng.random() < 0.5 else rng.choice([-1, 1], n)) * rng.uniform(0.5, 1.0, n)
        ]
        p["phases"] = [round(float(x), 4) for x in rng.uniform(0, 6.28, n)]
    else:
        f = 1
        tones = [x for x in (50.0, 60.0, 16.7, float(np.round(rng.uniform(12, 35), 1))) if x < 0.4 * sc["fs"]]
        p = dict(A=0.05 * sc["F"], f=float(rng.choice(tones)))
        p["phases"] = [round(float(x), 4) for x in rng.uniform(0, 6.28, n)]
    return dict(
        name=name, form=f, par={k: float(v) if isinstance(v, (float, np.floating)) else v for k, v in p.items()}
    )


def slots(effects, i, sc, law, k_ref, extra=None):
    """The array of effects of test i, and the factor of dashpots (WLF)."""
    E = np.zeros(len(SLOTS))
    E[SLOT["factor"]], E[SLOT["k_ref"]], visc = 1.0, k_ref, 1.0

    def put(**kw):
        return [E.__setitem__(SLOT[k], v) for k, v in kw.items()]

    for e in effects:
        n, f, p = e["name"], e["form"], e["par"]
        if n == "payne":
            put(pay=f, pay_d=p["d"], pay_u=p["u_c"], pay_tau=p["tau"], pay_m=p["m"])
        elif n == "mullins":
            put(mul=f, mul_d=p["d"], mul_u=p["u_m"], mul_b=p["b"])
        elif n == "degradation":
            put(deg=f, deg_d=p["d"], deg_s=p["E_d"])
        elif n == "ageing":
            t = sc["clock"]
            x = i / (sc["n"] - 1) if f == 1 else np.log1p(t[i] / p["t_0"]) / np.log1p(t[-1] / p["t_0"])
            E[SLOT["factor"]] *= 1 + p["a"] * x
        elif n == "self_heating":
            put(heat=f, heat_b=p["b"], heat_C=p["C"], heat_h=p["h"])
        elif n == "temperature_law":
            d = sc["T"][i] - 20.0
            if f == 1:
                E[SLOT["factor"]] *= np.exp(-p["b"] * d)
            elif f == 2:
                E[SLOT["factor"]] *= np.exp(p["b"] * (1 / (293.15 + d) - 1 / 293.15))
            else:
                visc = np.exp(-p["b"] * d / (1 + d / p["T_2"]))
        elif n == "hardening":
            put(har=f, har_k=p["k"], har_r=p["r"], har_p=p["p"])
        elif n == "one_sided":
            put(one=f, one_a=p["a"])
        elif n == "relaxation_branch":
            put(rel_k=p["k"], rel_tau=p["tau"])
        elif n == "velocity_exponent":
            put(vel=f, vel_c=p["c"], vel_a=p["v"])
        elif n == "friction":
            put(fri=f, fri_F=p["F_f"], fri_s=p["s"])
        elif n == "series_flexibility":
            put(ks=1 / p["compliance"])
        elif n == "play":
            put(ks=p["K"], gap=p["gap"])
        elif n == "static_offset":
            put(u0=p["u_0"])
        elif n == "slip":
            put(slip_F=p["F_s"], slip_d=p["size"])
    return E, visc


def delayed(x, tau, dt):
    t = np.arange(x.size) * dt
    return np.interp(t - tau, t, x)


def first_order(x, tau, dt):
    """tau y' + y = x for a linear x in each step, from rest at x[0]."""
    e = np.exp(-dt / tau)
    r = tau / dt * (1 - e)
    d = x - x[0]
    return x[0] + lfilter([1 - r, r - e], [1, -e], d)


def channels(effects, i, t, u, F, sc, unlisted=None):
    """Channels of displacement and force of test i with the faults of the list."""
    dt = t[1] - t[0]
    D, F = u, F.copy()
    for e in effects:
        n, f, p = e["name"], e["form"], e["par"]
        if n == "inertia":
            F = F + p["m"] * np.gradient(np.gradient(u, dt), dt)
    for e in effects:
        n, f, p = e["name"], e["form"], e["par"]
        if n == "offset":
            F = F + p["F_0"] * p["shares"][i]
        elif n == "drift" and f == 1:
            F = F + p["A"] * p["shares"][i] * t / 30
        elif n == "drift" and f == 2:
            F = F + p["A"] * (np.sin(2 * np.pi * t / p["P"] + p["phases"][i]) - np.sin(p["phases"][i]))
        elif n == "drift":
            D = D + p["A"] * p["shares"][i] * t / 30
    for e in effects:
        n, f, p = e["name"], e["form"], e["par"]
        if n == "lag" and p["tau"] > 1e-7:
            if f in (1, 2):
                F = (delayed if f == 1 else first_order)(F, p["tau"], dt)
            else:
                D = (delayed if f == 3 else first_order)(D, p["tau"], dt)
        elif n == "gain":
            hit = i in p["tests"] if f == 3 else i >= p["first"]
            if hit and f == 2:
                D = D * (1 + p["g"])
            elif hit:
                F = F * (1 + p["g"])
        elif n == "hum":
            F = F + p["A"] * np.sin(2 * np.pi * p["f"] * t + p["phases"][i])
    return D, F


def moves_displacement(e):
    return (e["name"], e["form"]) in {("lag", 3), ("lag", 4), ("gain", 2), ("drift", 3)}
