"""Laws of the polytechnic: true and declared parameters."""

import numpy as np

from .laboratory import clip_p, loguni

P_NAMES = {
    "kelvin_voigt": ["k", "c"],
    "zener": ["k0", "k1", "c1"],
    "mgmm": ["k1", "c1", "k0", "c_NL", "alpha", "k_a", "k_b", "u_ref", "c_a", "c_b", "v_ref"],
    "viscous_power": ["c", "alpha"],
    "friction": ["mu", "N", "k"],
    "elastic_plastic": ["k", "Fy", "b"],
    "bouc_wen": ["Fy", "Y", "alpha", "A", "beta", "gamma", "n"],
    "maxwell_power": ["c", "alpha", "k"],
}


VE = ("kelvin_voigt", "zener", "mgmm")


def unit_of(law, name, alpha):
    if name == "c_NL" or (name == "c" and law in ("viscous_power", "maxwell_power")):
        return f"kN*(s/mm)^{alpha:.6g}", 1e3 * 1e3**alpha
    if (law, name) in (("bouc_wen", "Fy"), ("elastic_plastic", "Fy"), ("friction", "N")):
        return "kN", 1e3
    if name in ("k", "k0", "k1", "k_a", "k_b"):
        return "kN/mm", 1e6
    if name in ("c", "c1", "c_a", "c_b"):
        return "kN*s/mm", 1e6
    if name in ("Y", "u_ref"):
        return "mm", 1e-3
    if name == "v_ref":
        return "mm/s", 1e-3
    return "", 1.0


def draw_law(law, rng):
    """True parameters (kN, mm, s), largest amplitude in mm and base frequency in Hz, layers."""
    L = {}
    if law in VE:
        h = float(rng.choice([5, 8, 10, 12, 15, 20]))
        A, f, Fp = h * rng.uniform(0.5, 1.4), loguni(rng, 0.25, 1.5), loguni(rng, 10, 300)
        k = Fp / A
        L = {
            "layers": 2,
            "layer_thickness_mm": h,
            "layer_area_mm2": float(np.round(k * 1e3 * h / 2 / rng.uniform(0.3, 0.9), -2)),
        }
        if law == "kelvin_voigt":
            return np.array([k, k * rng.uniform(0.25, 0.9) / (2 * np.pi * f)]), A, f, L
        if law == "zener":
            k0, tau = k * rng.uniform(0.3, 0.7), loguni(rng, 0.3, 2.0) / (2 * np.pi * f)
            k1 = k * rng.uniform(0.4, 1.5)
            return np.array([k0, k1, k1 * tau]), A, f, L
        s, a = k / 4.6, A / 6.0

        def w():
            return np.exp(0.25 * rng.standard_normal())

        al = rng.uniform(0.25, 0.6)
        p = np.array(
            [
                0.515 * s * w(),
                0,
                0.107 * s * w(),
                0.17 * Fp * w() / 15.0**al,
                al,
                2.6 * s * w(),
                2.5 * s * w(),
                6.0 * a * w(),
                0.45 * s * w(),
                0.1 * s * w(),
                12.0 * a * w(),
            ]
        )
        p[1] = p[0] * loguni(rng, 0.015, 0.06)
        return p, A, f, L
    if law in ("viscous_power", "maxwell_power"):
        A, f, al = rng.uniform(15, 90), loguni(rng, 0.15, 1.2), rng.uniform(0.15, 1.0)
        f = min(f, 350 / (2 * np.pi * A))
        Fp = loguni(rng, 50, 1000)
        c = Fp / (2 * np.pi * f * A) ** al
        return np.array([c, al] + ([Fp / A * loguni(rng, 6, 25)] if law == "maxwell_power" else [])), A, f, L
    F, f = loguni(rng, 20, 500), loguni(rng, 0.1, 0.8)
    if law == "friction":
        mu, x = rng.uniform(0.1, 0.4), loguni(rng, 0.3, 1.2)
        return np.array([mu, F / mu, F / x]), rng.uniform(10, 40), f, L
    Y = rng.uniform(1.0, 8.0)
    if law == "elastic_plastic":
        return np.array([F / Y, F, rng.uniform(0.01, 0.1)]), Y * rng.uniform(3, 9), f, L
    g = rng.uniform(0.35, 0.7)
    return np.array([F, Y, rng.uniform(0.02, 0.25), 1.0, 1 - g, g, rng.uniform(1.2, 4.0)]), Y * rng.uniform(3, 8), f, L


def declare(law, p, rng, v_ref):
    """Declared parameters: each off by 3 to 30 %, log-normal; coefficients of powers are off at a usual speed."""
    names, q = P_NAMES[law], p.copy()
    sd = rng.uniform(0.08, 0.2)
    for i, n in enumerate(names):
        if n == "A":
            continue
        x = 1.0
        while not 0.03 <= abs(x - 1) <= 0.30:
            x = np.exp(sd * rng.standard_normal())
        q[i] *= x
    q = clip_p(law, q)
    if "alpha" in names and law != "bouc_wen":
        i, j = names.index("alpha"), names.index("c_NL" if law == "mgmm" else "c")
        q[i] = min(q[i], 1.0) if p[i] <= 1 else q[i]
        q[j] *= v_ref ** (p[i] - q[i])
    return q


def si_law(law, p):
    al = p[P_NAMES[law].index("alpha")] if "alpha" in P_NAMES[law] else 1.0
    return {
        "type": law,
        "parameters": {n: float(x * unit_of(law, n, al)[1]) for n, x in zip(P_NAMES[law], p, strict=False)},
    }
