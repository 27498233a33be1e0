"""Hidden effects: how they are drawn, where they act, what they are. Sizes are shares of F0, u0, v0 of the campaign."""

import numpy as np
from scipy.signal import butter, lfilter, sosfiltfilt

from .kernel import ROW, ROWS

KIND = {
    n: "damper"
    for n in (
        "payne",
        "mullins",
        "degradation",
        "ageing",
        "self_heating",
        "temperature_law",
        "hardening",
        "one_sided",
        "relaxation_branch",
        "velocity_exponent",
        "friction",
    )
}
KIND |= {n: "rig" for n in ("series_flexibility", "play", "inertia", "static_offset")}
KIND |= {n: "instrument" for n in ("lag", "gain", "offset", "drift", "hum")}
NAMES = list(KIND)
UNLISTED = [
    "stick_slip",
    "hunting_clamp",
    "sample_hold",
    "loose_bolt",
    "crosstalk",
    "dead_band",
    "clipping",
    "cracked_layer",
    "stuck_bit",
    "ripple",
    "zero_jumps",
]
UKIND = dict(
    stick_slip="rig",
    hunting_clamp="rig",
    sample_hold="instrument",
    loose_bolt="rig",
    crosstalk="rig",
    dead_band="instrument",
    clipping="instrument",
    cracked_layer="damper",
    stuck_bit="instrument",
    ripple="rig",
    zero_jumps="instrument",
)
ELASTIC = ("kelvin_voigt", "zener", "mgmm", "bouc_wen", "elastic_plastic")
NOT = {
    "series_flexibility": ("zener", "friction", "elastic_plastic", "maxwell_power"),
    "friction": ("friction", "elastic_plastic"),
    "static_offset": ("viscous_power", "maxwell_power", "friction"),
    "self_heating": (),
    "velocity_exponent": (),
    "relaxation_branch": (),
}
MAX = dict(
    payne=0.55,
    mullins=0.5,
    degradation=0.5,
    ageing=0.5,
    self_heating=0.7,
    temperature_law=0.45,
    hardening=1.5,
    one_sided=0.5,
    relaxation_branch=1.0,
    velocity_exponent=0.8,
    friction=0.4,
    series_flexibility=0.5,
    play=0.15,
    inertia=0.6,
    static_offset=0.5,
    lag=0.6,
    gain=0.3,
    offset=0.35,
    drift=0.35,
    hum=0.3,
    stick_slip=0.6,
    hunting_clamp=0.4,
    sample_hold=0.5,
    loose_bolt=0.5,
    crosstalk=0.3,
    dead_band=0.4,
    clipping=0.6,
    cracked_layer=0.7,
    stuck_bit=0.4,
    ripple=0.3,
    zero_jumps=0.3,
)


def allowed(name, law):
    return law not in NOT.get(name, ())


def draw(name, law, c, rng):
    """Effect with what does not scale; c: u0 v0 F0 a0 energy path tests (list) alpha tau."""
    u0, v0, F0, n = c["u0"], c["v0"], c["F0"], len(c["tests"])
    U = rng.uniform
    e = dict(name=name, size=0.08, seed=int(rng.integers(1 << 31)), kind=KIND.get(name) or UKIND[name])
    soft = law in ("kelvin_voigt", "zener", "mgmm")
    fits = [i for i, q in enumerate(c["tests"]) if q["use"] == "fit"]
    if name == "payne":
        form = int(rng.integers(1, 4))
        tau = float(np.exp(U(np.log(3), np.log(60))))
        e |= dict(form=form, tau=tau, m=U(0.5, 1), inner=int(soft and rng.random() < 0.4))
        e["scale"] = [0, tau * v0 * U(0.1, 0.6), u0 * U(0.2, 0.6), tau * F0 * v0 * U(0.03, 0.2)][form]
        e["eq"] = [
            "",
            "F (1 - s (1 - phi)), phi' = (1 - phi)/tau - phi |v|/scale (Lion & Kardelky 2004)",
            "F (1 - s y/(1 + y)), y = (a/scale)^(2m), a the amplitude kept, fading with tau (Kraus 1984)",
            "F (1 - s (1 - phi)), phi' = (1 - phi)/tau - phi |F v|/scale (structure broken by power)",
        ][form] + (" on the elastic part" if e["inner"] else "")
    elif name == "mullins":
        e |= dict(form=int(rng.integers(1, 3)), scale=u0 * U(0.2, 0.6))
        e["eq"] = [
            "",
            "F (1 - s (1 - exp(-u_ever/scale)))  (Qi & Boyce 2004)",
            "F (1 - s erf((u_ever^2 - u^2)/scale^2))  (Ogden & Roxburgh 1999)",
        ][e["form"]]
    elif name == "degradation":
        e |= dict(form=int(rng.integers(1, 4)))
        e["scale"] = [0, c["energy"] * U(0.3, 1), c["path"] * U(0.3, 1), c["energy"] * U(0.8, 1.2)][e["form"]]
        e["eq"] = ["", "F (1 - s (1 - exp(-E/scale)))", "F / (1 + s path/scale)", "F (1 - s E/scale)"][e["form"]]
    elif name == "ageing":
        e |= dict(form=int(rng.integers(1, 4)), sign=float(rng.choice([-1, 1])))
        e["eq"] = [
            "",
            "F (1 + sign s i/(n-1)), i number of the test",
            "F (1 + sign s ln(1+i)/ln(n))",
            "F exp(sign s (i/(n-1)))",
        ][e["form"]]
    elif name == "self_heating":
        e |= dict(form=1 + int(soft and rng.random() < 0.5), tau=U(30, 300), C=c["energy"] / n / 10.0)
        e["eq"] = (
            "C dT' = F v - C dT/tau; " + ("all force" if e["form"] == 1 else "dashpots") + " times exp(-a dT), a = s/10"
        )
        e["size"] = 0.15
    elif name == "temperature_law":
        e |= dict(form=int(rng.integers(1, 3)), where=int(rng.integers(0, 3)) if soft else 0)
        e["eq"] = (
            "factor exp(-s (T - T0)/10)" if e["form"] == 1 else "factor exp(b (1/T - 1/T0)), T in K, b = s T0^2/10"
        ) + [" of all force", " of springs", " of dashpots"][e["where"]]
        e["size"] = 0.15
    elif name == "hardening":
        e |= dict(form=int(rng.integers(1, 3)), r=u0 * U(0.4, 0.65), p=float(rng.choice([1, 1.5, 2, 3])))
        e["eq"] = "F + k3 u^3" if e["form"] == 1 else "F + k (|u| - r)_+^p sgn u"
        e["size"] = 0.3
    elif name == "one_sided":
        e |= dict(form=int(rng.integers(1, 4)), side=float(rng.choice([-1, 1])), r=u0 * U(0.1, 0.5))
        if e["form"] == 1 and law in ("viscous_power", "maxwell_power"):
            e["form"] = 3
        e["eq"] = [
            "",
            "F (1 + s side tanh(u/(0.1 u0)))",
            "F + k (side u - r)_+ side",
            "F (1 + s side tanh(v/(0.03 v0)))",
        ][e["form"]]
    elif name == "relaxation_branch":
        tau = float(np.exp(U(np.log(0.05), np.log(1.0))))
        if law == "zener":
            tau = c["tau"] * (U(8, 25) if c["tau"] < 0.1 or rng.random() < 0.5 else 1 / U(8, 25))
        e |= dict(tau=tau, eq="F + q, q' = k v - q/tau")
    elif name == "velocity_exponent":
        a = c["alpha"]
        form = 1 + int(rng.random() < 0.35)
        p = U(0.2, 0.6) if rng.random() < 0.5 else U(1.5, 2)
        if law in ("viscous_power", "maxwell_power"):
            form, p = 1, (U(1.4, 2) if a < 0.7 else U(0.15, 0.3))
        elif law not in ("kelvin_voigt", "mgmm", "zener"):
            p = U(0.3, 1)
        elif law == "mgmm":
            p = U(1.4, 2)
            form = 1
        e |= dict(form=form, p=p, vs=v0 * U(0.1, 0.5), eq="F + c |v|^p sgn v" if form == 1 else "F + c v/(1 + |v|/vs)")
    elif name == "friction":
        e |= dict(
            form=int(rng.integers(1, 4)),
            slip=u0 * U(0.003, 0.02),
            v1=v0 * U(0.01, 0.04),
            rise=U(0.1, 0.4),
            vs=v0 * U(0.05, 0.2),
        )
        e["eq"] = [
            "",
            "F + f, f' = Fc/slip v, |f| <= Fc (Prandtl)",
            "F + Fc tanh(v/v1)",
            "as Prandtl, limit Fc (1 + rise exp(-(v/vs)^2)) (Stribeck)",
        ][e["form"]]
    elif name == "series_flexibility":
        e |= dict(
            form=int(rng.integers(1, 3)), eq="specimen behind a spring K = F0/(s u0)" + (", K (1 + (y/(s u0))^2)")
        )
        if e["form"] == 1:
            e["eq"] = "specimen behind a spring K = F0/(s u0)"
    elif name == "play":
        e |= dict(eq="pins with clearance +- g = s u0, contact stiffness F0/(0.004 u0)", size=0.03)
    elif name == "inertia":
        e |= dict(eq="F + m x''")
    elif name == "static_offset":
        e |= dict(sign=float(rng.choice([-1, 1])), eq="law at u = x + sign s u0")
    elif name == "lag":
        e |= dict(form=int(rng.integers(1, 3)), channel=str(rng.choice(["force", "force", "displacement"])))
        e["eq"] = f"{e['channel']} channel " + ("delayed by tau" if e["form"] == 1 else "y + tau y' = x")
    elif name == "gain":
        j = [i for i in range(1, n) if sum(k < i for k in fits) >= 2 and sum(k >= i for k in fits) >= 2]
        e |= dict(
            sign=float(rng.choice([-1, 1])),
            channel="displacement" if rng.random() < 0.3 and law not in ("friction",) else "force",
            test=int(rng.choice(j)),
        )
        e["eq"] = f"{e['channel']} channel times (1 + sign s) from test {e['test'] + 1} on"
    elif name == "offset":
        o = rng.choice([-1, 1]) * np.ones(n) if rng.random() < 0.4 else U(-1, 1, n)
        if np.std(o) > 0:
            o[0] = np.sign(o[0]) * max(abs(o[0]), 0.6)
        e |= dict(each=[float(x) for x in o], eq="F + s F0 each[i]")
    elif name == "drift":
        e |= dict(
            form=int(rng.integers(1, 4)),
            channel="displacement" if law in ELASTIC and rng.random() < 0.2 else "force",
            each=[float(x) for x in rng.choice([-1, 1], n) * U(0.4, 1, n)],
            tau=U(3, 10),
            period=U(20, 40),
        )
        e["eq"] = (
            f"{e['channel']} channel + s F0 (or s u0) each[i] g(t), g = "
            + ["", "t/T", "1 - exp(-t/tau)", "sin(2 pi t/period)"][e["form"]]
        )
    elif name == "hum":
        f = 50.0 if c["fs"] >= 250 and rng.random() < 0.5 else U(8, min(0.35 * c["fs"], 70))
        e |= dict(f=float(f), eq="F + s F0 sin(2 pi f t + phi), phi of each test")
    # not in the list
    elif name == "stick_slip":
        e |= dict(
            drop=U(0.5, 0.8),
            vs=v0 * U(0.3, 0.8),
            size=0.25,
            eq="anchorage slides once |F| > (1 - s) F0 at speed vs until |F| < drop of that",
        )
    elif name == "hunting_clamp":
        e |= dict(f=U(0.07, 0.35), eq="force times 1 + s sin(2 pi f t + phi): clamping pressure hunts")
    elif name == "sample_hold":
        e |= dict(
            size=0.15, hold=[U(0.05, 0.1), U(0.15, 0.3)], eq="force channel frozen in random episodes, s of the time"
        )
    elif name == "loose_bolt":
        e |= dict(
            f=U(8, min(20, 0.3 * c["fs"])),
            tau=U(0.05, 0.2),
            rate=U(0.3, 1.2),
            eq="F + s F0 exp(-t/tau) sin(2 pi f t) from random times on",
        )
    elif name == "crosstalk":
        e |= dict(band=[U(0.3, 0.8), U(1.5, 4)], eq="F + s F0 * band noise: a transverse actuator that is not recorded")
    elif name == "dead_band":
        e |= dict(eq="reads nothing while |F| < s F0", size=0.1)
    elif name == "clipping":
        e |= dict(eq="|F| <= (1 - s) of the test's peak in some windows of time", size=0.2)
    elif name == "cracked_layer":
        e |= dict(
            test=int(rng.choice([k for k in fits if k > 1])),
            open=u0 * U(0.0, 0.15),
            eq="in one test force times 1 - s/2 (1 + tanh((u - open)/(0.03 u0)))",
            size=0.25,
        )
    elif name == "stuck_bit":
        e |= dict(shift=U(0, 1), eq="bit of weight s F0 of the converter stays 0")
    elif name == "ripple":
        e |= dict(length=u0 * U(0.1, 0.3), phase=U(0, 6), eq="F + s F0 sin(2 pi u/length + phase): worn guide")
    elif name == "zero_jumps":
        e |= dict(rate=U(0.15, 0.5), eq="zero of the force jumps at random times by up to +- s F0")
    return e


def rows(effs, c):
    E = np.zeros((len(ROWS), 6))
    u0, v0, F0 = c["u0"], c["v0"], c["F0"]
    for e in effs:
        n, s = e["name"], e["size"]
        if n == "payne":
            E[ROW[n]] = [e["form"], s, e["tau"], e["scale"], e["m"], e["inner"]]
        elif n in ("mullins", "degradation"):
            E[ROW[n], :3] = [e["form"], s, e["scale"]]
        elif n == "self_heating":
            E[ROW[n], :4] = [e["form"], s / 10, e["tau"], e["C"]]
        elif n == "hardening":
            E[ROW[n], :4] = (
                [1, s * F0 / u0**3, 0, 0] if e["form"] == 1 else [2, s * F0 / (u0 - e["r"]) ** e["p"], e["r"], e["p"]]
            )
        elif n == "one_sided":
            E[ROW[n], :4] = [
                [1, s * e["side"], 0.1 * u0, 0],
                [2, s * F0 / (u0 - e["r"]), e["r"], e["side"]],
                [3, s * e["side"], 0.03 * v0, 0],
            ][e["form"] - 1]
        elif n == "relaxation_branch":
            E[ROW[n], :3] = [1, s * F0 / min(u0, v0 * e["tau"]), e["tau"]]
        elif n == "velocity_exponent":
            E[ROW[n], :3] = (
                [1, s * F0 / v0 ** e["p"], e["p"]] if e["form"] == 1 else [2, s * F0 * (1 / v0 + 1 / e["vs"]), e["vs"]]
            )
        elif n == "friction":
            fc = s * F0
            E[ROW[n], :5] = (
                [2, fc, e["v1"], 0, 0] if e["form"] == 2 else [e["form"], fc, fc / e["slip"], e["rise"], e["vs"]]
            )
        elif n == "series_flexibility":
            E[ROW["rig"], :4] = [1, F0 / (s * u0), 0, s * u0 if e["form"] == 2 else 0]
        elif n == "play":
            E[ROW["rig"], :4] = [1, F0 / (0.004 * u0), s * u0, 0]
        elif n == "stick_slip":
            E[ROW[n], :4] = [1, (1 - s) * F0, (1 - s) * F0 * e["drop"], e["vs"]]
        elif n == "ripple":
            E[ROW[n], :4] = [1, s * F0, e["length"], e["phase"]]
        elif n == "cracked_layer":
            E[ROW["crack"], :4] = [1, s, e["open"], 0.03 * u0]
    return E


def factors(effs, i, T, c):
    f = np.ones(3)
    for e in effs:
        s = e["size"]
        n = len(c["tests"])
        if e["name"] == "ageing":
            f[0] *= [
                0,
                1 + e["sign"] * s * i / (n - 1),
                1 + e["sign"] * s * np.log(1 + i) / np.log(n),
                np.exp(e["sign"] * s * i / (n - 1)),
            ][e["form"]]
        elif e["name"] == "temperature_law":
            T0 = c["T0"] + 273.15
            f[e["where"]] *= (
                np.exp(-s * (T - c["T0"]) / 10)
                if e["form"] == 1
                else np.exp(s * T0**2 / 10 * (1 / (T + 273.15) - 1 / T0))
            )
    return f


def channels(effs, i, x, F, dt, i0, c):
    """What the two channels record of x and F; time zero is the first recorded sample."""
    n = len(x)
    t = (np.arange(n) - i0) * dt
    T = (n - i0) * dt
    F0, u0 = c["F0"], c["u0"]
    xm, F = x, F.copy()
    for e in effs:
        s, name = e["size"], e["name"]
        r = np.random.default_rng([e["seed"], i])
        if name == "inertia":
            a = np.gradient(np.gradient(x, dt), dt)
            F += s * F0 / c["a0"] * a
        elif name == "lag":
            tau = s / (2 * np.pi * c["fmax"])
            y = F if e["channel"] == "force" else xm
            if e["form"] == 1:
                y = np.interp(t - tau, t, y)
            else:
                b = 1 - np.exp(-dt / tau)
                y = lfilter([b / 2, b / 2], [1, b - 1], y, zi=[y[0] * (1 - b / 2)])[0]
            if e["channel"] == "force":
                F = y
            else:
                xm = y
        elif name == "gain" and i >= e["test"]:
            if e["channel"] == "force":
                F *= 1 + e["sign"] * s
            else:
                xm = xm * (1 + e["sign"] * s)
        elif name == "offset":
            F += s * F0 * e["each"][i]
        elif name == "drift":
            tt = np.maximum(t, 0)
            g = (
                [0, tt / T, 1 - np.exp(-tt / e["tau"]), np.sin(2 * np.pi * tt / e["period"])][e["form"]]
                * e["each"][i]
                * s
            )
            if e["channel"] == "force":
                F += F0 * g
            else:
                xm = xm + u0 * g
        elif name == "hum":
            F += s * F0 * np.sin(2 * np.pi * e["f"] * t + r.uniform(0, 6.28))
        elif name == "hunting_clamp":
            F *= 1 + s * np.sin(2 * np.pi * e["f"] * t + r.uniform(0, 6.28))
        elif name == "sample_hold":
            m = np.mean(e["hold"])
            at = np.cumsum(r.exponential(m / s, int(4 * T * s / m) + 8)) + t[0]
            for a in at[at < t[-1]]:
                k = int((a - t[0]) / dt)
                F[k : k + int(r.uniform(*e["hold"]) / dt)] = F[k]
        elif name == "loose_bolt":
            at = np.cumsum(r.exponential(1 / e["rate"], int(4 * T * e["rate"]) + 8)) + t[0] + 0.5
            for a in at[at < t[-1]]:
                k = int((a - t[0]) / dt)
                q = t[k:] - t[k]
                F[k:] += (
                    s
                    * F0
                    * r.choice([-1, 1])
                    * r.uniform(0.4, 1)
                    * np.exp(-q / e["tau"])
                    * np.sin(2 * np.pi * e["f"] * q)
                )
        elif name == "crosstalk":
            y = sosfiltfilt(
                butter(2, [2 * dt * e["band"][0], 2 * dt * e["band"][1]], "band", output="sos"), r.standard_normal(n)
            )
            F += s * F0 * y / np.max(np.abs(y))
        elif name == "dead_band":
            F = np.where(np.abs(F) < s * F0, 0.0, F)
        elif name == "clipping":
            lim = (1 - s) * np.max(np.abs(F))
            on = np.zeros(n, bool)
            for _ in range(int(r.integers(1, 4))):
                a = r.uniform(0.1, 0.7)
                on |= (t > a * T) & (t < (a + r.uniform(0.1, 0.3)) * T)
            F = np.where(on, np.clip(F, -lim, lim), F)
        elif name == "stuck_bit":
            W = s * F0
            F = F - W * (np.floor((F + (16 + e["shift"]) * W * 4) / W) % 2)
        elif name == "zero_jumps":
            at = np.sort(r.uniform(t[0], t[-1], 1 + r.poisson(T * e["rate"])))
            for k, a in enumerate(at):
                F += s * F0 * (r.uniform(-1, 1) * (t >= a)) * (1 if k < 3 else 0.5)
    return xm, F


def parameters(e, c):
    """Parameters in SI for the truth file."""
    F0, u0, v0, s = c["F0"], c["u0"], c["v0"], e["size"]
    p = {k: v for k, v in e.items() if k not in ("name", "kind", "eq", "size", "seed")} | {"s": s}
    E = rows([e], c)
    n = e["name"]
    extra = dict(
        hardening=("k", 4, 1),
        relaxation_branch=("k", 6, 1),
        velocity_exponent=("c", 7, 1),
        friction=("Fc", 8, 1),
        series_flexibility=("K", 9, 1),
        ripple=("A", 11, 1),
    )
    if n in extra:
        k, r, j = extra[n]
        p[k] = float(E[r, j])
    if n == "play":
        p |= dict(g=s * u0, K=F0 / (0.004 * u0))
    if n == "one_sided" and e["form"] == 2:
        p["k"] = float(E[5, 1])
    if n == "static_offset":
        p["u"] = e["sign"] * s * u0
    if n == "inertia":
        p["m"] = s * F0 / c["a0"]
    if n == "lag":
        p["tau"] = s / (2 * np.pi * c["fmax"])
    if n in ("offset", "drift", "hum", "loose_bolt", "crosstalk", "dead_band", "stuck_bit", "zero_jumps"):
        p["amplitude"] = s * (u0 if e.get("channel") == "displacement" else F0)
    return p | dict(F0=F0, u0=u0, v0=v0)
