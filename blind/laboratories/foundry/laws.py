"""The laws of the specimens: their parameters, true and declared, with units."""

LINEAR = ["kelvin_voigt", "zener", "generalised_maxwell"]
FLUID = ["viscous_power", "maxwell_power", "bilinear_oil", "maxwell"]
YIELD = ["friction", "elastic_plastic", "lead_rubber", "bouc_wen", "friction_pendulum"]
ALL = LINEAR + FLUID + YIELD + ["mgmm"]


def draw_law(law, rng, F, U, w):
    r = rng.uniform
    V = w * U
    if law == "kelvin_voigt":
        return {"k": r(0.55, 0.85) * F / U, "c": r(0.35, 0.65) * F / V}
    if law == "zener":
        k1 = r(0.45, 0.8) * F / U
        return {"k0": r(0.3, 0.6) * F / U, "k1": k1, "c1": k1 * r(0.5, 1.4) / w}
    if law == "generalised_maxwell":
        k1, k2 = r(0.35, 0.6) * F / U, r(0.3, 0.5) * F / U
        return {
            "k0": r(0.25, 0.45) * F / U,
            "k1": k1,
            "c1": k1 * r(2.0, 4.0) / w,
            "k2": k2,
            "c2": k2 * r(0.15, 0.4) / w,
        }
    if law == "maxwell":
        return {"c0": r(0.9, 1.4) * F / V, "lambda": r(0.25, 0.8) / w}
    if law == "viscous_power":
        al = r(0.3, 0.75)
        return {"c": r(0.85, 1.1) * F / V**al, "alpha": al}
    if law == "maxwell_power":
        al = r(0.3, 0.75)
        return {"c": r(0.85, 1.1) * F / V**al, "alpha": al, "k": r(5, 12) * F / U}
    if law == "bilinear_oil":
        Fr = r(0.55, 0.8) * F
        return {"c": Fr / (r(0.25, 0.45) * V), "F_r": Fr, "p": r(0.05, 0.2)}
    if law == "friction":
        mu = r(0.15, 0.4)
        return {"mu": mu, "N": F / mu, "k": F / (r(0.015, 0.05) * U)}
    if law == "elastic_plastic":
        Fy = r(0.65, 0.85) * F
        return {"k": Fy / (r(0.07, 0.18) * U), "Fy": Fy, "b": r(0.025, 0.08)}
    if law == "lead_rubber":
        q = r(0.4, 0.65)
        return {"Q": q * F, "K_d": (1 - q) * F / U, "Y": r(0.03, 0.09) * U}
    if law == "friction_pendulum":
        ff, s = r(0.05, 0.11), r(0.45, 0.65)
        W = s * F / ff
        return {
            "W": W,
            "R": W * U / ((1 - s) * F),
            "f_slow": ff * r(0.45, 0.65),
            "f_fast": ff,
            "a": r(4, 9) / V,
            "Y": r(0.01, 0.03) * U,
        }
    if law == "bouc_wen":
        return {"Fy": r(0.65, 0.85) * F, "Y": r(0.08, 0.2) * U, "alpha": r(0.03, 0.1), "n": r(1.2, 3.0)}
    if law == "mgmm":
        al, k1 = r(0.33, 0.5), 0.06 * F / U
        return {
            "k1": k1,
            "c1": k1 * r(0.012, 0.025),
            "k0": 0.01 * F / U,
            "c_NL": r(0.15, 0.3) * F / V**al,
            "alpha": al,
            "k_a": r(0.3, 0.6) * F / U,
            "k_b": r(0.3, 0.5) * F / U,
            "u_ref": r(0.3, 0.6) * U,
            "c_a": r(0.15, 0.4) * F / V,
            "c_b": r(0.05, 0.12) * F / V,
            "v_ref": r(0.2, 0.5) * V,
        }
    raise ValueError(law)


UNITS = {
    "k": "kN/mm",
    "k0": "kN/mm",
    "k1": "kN/mm",
    "k2": "kN/mm",
    "k_a": "kN/mm",
    "k_b": "kN/mm",
    "K_d": "kN/mm",
    "c": "kN*s/mm",
    "c0": "kN*s/mm",
    "c1": "kN*s/mm",
    "c2": "kN*s/mm",
    "c_a": "kN*s/mm",
    "c_b": "kN*s/mm",
    "lambda": "s",
    "F_r": "kN",
    "N": "kN",
    "Fy": "kN",
    "Q": "kN",
    "W": "kN",
    "Y": "mm",
    "R": "mm",
    "u_ref": "mm",
    "v_ref": "mm/s",
    "a": "s/mm",
    "alpha": "",
    "n": "",
    "b": "",
    "p": "",
    "mu": "",
    "f_slow": "",
    "f_fast": "",
}
EXACT = {"friction": ["N"], "friction_pendulum": ["W", "R"], "mgmm": ["k0", "k1"]}  # weight and geometry are known


def declare(law, p, rng, V):
    q = {}
    for name, value in p.items():
        e = rng.uniform(0.05, 0.2) * rng.choice([-1, 1])
        if name in EXACT.get(law, []):
            e = 0.0
        q[name] = value * (1 + e)
    for c in ("c", "c_NL"):
        if c in q and "alpha" in q and law != "bouc_wen":
            q[c] = q[c] * V ** p["alpha"] / V ** q["alpha"]  # wrong by its force at the speed V
    if law == "bouc_wen":
        q["n"] = max(1.0, q["n"])
    return q


def unit_of(law, q, name):
    power = name in ("c", "c_NL") and "alpha" in q and law != "bouc_wen"
    return "kN*(s/mm)^alpha" if power else UNITS[name]


def yaml_parameters(law, q):
    return "\n".join(f"    {name}: {value:.6g} {unit_of(law, q, name)}".rstrip() for name, value in q.items())


FACTOR = {"kN/mm": 1e6, "kN*s/mm": 1e6, "kN": 1e3, "mm": 1e-3, "mm/s": 1e-3, "s/mm": 1e3, "s": 1.0, "": 1.0}


def si(law, q):
    """Parameters in SI, for the truth; those of Bouc-Wen that are not declared are the usual ones."""
    factors = FACTOR | {"kN*(s/mm)^alpha": 1e3 ** (1 + q.get("alpha", 0.0))}
    out = {name: float(value * factors[unit_of(law, q, name)]) for name, value in q.items()}
    return out | ({"A": 1.0, "beta": 0.5, "gamma": 0.5} if law == "bouc_wen" else {})
