"""Laws of the proving ground: true and declared parameters."""

import numpy as np

PAR = dict(
    kelvin_voigt=["k", "c"],
    zener=["k0", "k1", "c1"],
    mgmm=["k1", "c1", "k0", "c_NL", "alpha", "k_a", "k_b", "u_ref", "c_a", "c_b", "v_ref"],
    bouc_wen=["Fy", "Y", "alpha", "A", "beta", "gamma", "n"],
    elastic_plastic=["k", "Fy", "b"],
    friction=["mu", "N", "k"],
    viscous_power=["c", "alpha"],
    maxwell_power=["c", "alpha", "k"],
)


HELD = dict(mgmm=["k0", "c_b"], bouc_wen=["A", "gamma"], friction=["N"])


UNIT = dict(
    k="kN/mm",
    k0="kN/mm",
    k1="kN/mm",
    k_a="kN/mm",
    k_b="kN/mm",
    c1="kN*s/mm",
    c_a="kN*s/mm",
    c_b="kN*s/mm",
    u_ref="mm",
    v_ref="mm/s",
    Fy="kN",
    Y="mm",
    N="kN",
)


FACTOR = {"kN/mm": 1e6, "kN*s/mm": 1e6, "mm": 1e-3, "mm/s": 1e-3, "kN": 1e3}


def draw_law(law, rng):
    """True parameters (SI), size of programme and of force, specimen."""
    U = rng.uniform

    def L(a, b):
        return float(np.exp(U(np.log(a), np.log(b))))

    spec = {}
    if law in ("kelvin_voigt", "mgmm", "zener"):
        h = float(np.round(U(5, 20)))
        u0 = h * 1e-3 * U(0.5, 1.3)
        F0 = L(10e3, 300e3)
        fmax = U(2, 5)
        v0 = u0 * 2 * np.pi * U(0.6, 1) * fmax * U(0.4, 0.8)
        n = int(rng.choice([2, 2, 4]))
        spec = dict(layers=n, layer_area_mm2=float(np.round(F0 / U(0.4, 0.9) / n * 2, -2)), layer_thickness_mm=h)
    elif law in ("viscous_power", "maxwell_power"):
        u0, F0, v0 = L(0.03, 0.15), L(50e3, 1000e3), L(0.15, 0.8)
        fmax = min(5.0, v0 / u0 / 2 / np.pi * U(2.5, 4))
    elif law == "friction":
        u0, F0, v0 = L(0.01, 0.08), L(20e3, 500e3), L(0.05, 0.4)
        fmax = min(4.0, v0 / u0 / 2 / np.pi * U(2, 4))
    else:
        u0, F0, v0 = L(0.012, 0.06), L(20e3, 500e3), L(0.05, 0.4)
        fmax = min(4.0, v0 / u0 / 2 / np.pi * U(2, 4))
    fmax = max(fmax, 0.8)
    if law == "kelvin_voigt":
        k = F0 / u0 * U(0.5, 0.9)
        P = [k, k * U(0.2, 0.9) / (2 * np.pi * U(0.5, 1.5))]
    elif law == "zener":
        k = F0 / u0 * U(0.4, 0.7)
        k1 = k * L(0.5, 3)
        P = [k, k1, k1 * L(0.02, 0.3)]
    elif law == "mgmm":

        def g(x):
            return x * float(np.exp(0.25 * rng.standard_normal()))

        a = g(0.374)
        K = F0 / u0 * 0.5
        f = K / 7.461e6  # stiffness against the prototype of the thesis
        P = [
            g(0.515e6 * f),
            0,
            g(0.107e6 * f),
            g(0.15 * F0) / v0**a,
            a,
            g(0.5 * K),
            g(0.5 * K),
            g(0.5 * u0),
            g(0.25 * F0 / v0),
            g(0.12 * F0 / v0),
            g(0.1 * v0),
        ]
        P[1] = P[0] * g(0.0293)
        P[0] *= 3
        P[1] *= 3
    elif law == "bouc_wen":
        b = U(0.3, 0.7)
        P = [F0 * 0.8, u0 / L(4, 15), L(0.01, 0.15), 1.0, b, 1 - b, float(np.round(U(1, 4), 2))]
    elif law == "elastic_plastic":
        P = [F0 * 0.8 / (u0 / L(4, 15)), F0 * 0.8, L(0.01, 0.1)]
    elif law == "friction":
        mu = U(0.08, 0.4)
        P = [mu, F0 / mu, F0 / L(0.2e-3, 1e-3)]
    elif law == "viscous_power":
        a = L(0.15, 1)
        P = [F0 / v0**a, a]
    else:
        a = L(0.2, 1)
        P = [F0 / v0**a, a, F0 / (u0 * L(0.015, 0.06))]
    return np.array(P + [0.0] * (12 - len(P))), dict(u0=u0, v0=v0, F0=F0, fmax=fmax), spec


def declared(law, P, c, rng):
    off = np.exp(rng.choice([-1, 1], 12) * np.exp(rng.uniform(np.log(0.03), np.log(0.2), 12)))
    D = P * off
    names = PAR[law]
    if law == "bouc_wen":
        D[3] = 1.0
        D[6] = max(D[6], 1.0)
    for cn in ("c", "c_NL"):
        if cn in names and "alpha" in names:
            j, a = names.index(cn), names.index("alpha")
            D[a] = min(D[a], 1.6)
            D[j] = P[j] * c["v0"] ** P[a] * off[j] / c["v0"] ** D[a]
    return D


def named(law, P):
    return {n: float(P[j]) for j, n in enumerate(PAR[law])}


def text(law, P):
    v = named(law, P)
    out = {}
    for n, x in v.items():
        if n in ("c", "c_NL") and "alpha" in v:
            out[n] = f"{x / 1e3:.6g} kN*(s/m)^{v['alpha']:.6g}"
        elif n == "c":
            out[n] = f"{x / 1e6:.6g} kN*s/mm"
        elif n in UNIT:
            out[n] = f"{x / FACTOR[UNIT[n]]:.6g} {UNIT[n]}"
        else:
            out[n] = f"{x:.6g}"
    if "alpha" in out and law != "bouc_wen":
        out["alpha"] = f"{v['alpha']:.6g}"
    return out
