"""Laws of the harbour laboratory: true and declared parameters."""

import numpy as np

from . import effects as fx
from .sim import PARAMETERS

GAMMA_T = ([20.0, 25.0, 30.0, 35.0], [1.0, 0.935, 0.875, 0.82])  # Table 4.4 as the tool's documents print it


def draw_law(rng, law):
    """True parameters in SI, largest deformation, largest speed, largest frequency, specimen."""

    def logu(a, b):
        return float(np.exp(rng.uniform(np.log(a), np.log(b))))

    spec = None
    if law in fx.SOFT:
        h = float(rng.choice([5, 6, 8, 10, 12, 12.5, 15, 20])) * 1e-3
        layers = int(rng.choice([2, 2, 2, 4]))
        area = float(np.round(logu(12e3, 120e3), -2)) * 1e-6
        spec = dict(layers=layers, layer_area_mm2=area * 1e6, layer_thickness_mm=h * 1e3)
        u, v, fmax = h * rng.uniform(0.4, 1.1), 0.35, float(rng.uniform(2.5, 5))
        kg = layers * area / h  # N/m per Pa of shear modulus
        if law == "mgmm":
            s, r = kg / (2 * 41400e-6 / 0.012), h / 0.012

            def j(x, w=0.22):
                return x * float(np.exp(w * rng.standard_normal()))

            al = float(np.clip(j(0.374, 0.15), 0.2, 0.65))
            P = dict(
                k1=j(0.515e6) * s,
                c1=0.0,
                k0=j(0.107e6) * s,
                alpha=al,
                c_NL=j(1.585) * 1e3 * 1e3**al * s * r ** (1 - al),
                k_a=j(3.741e6) * s,
                k_b=j(3.613e6) * s,
                u_ref=j(7.966e-3) * r,
                c_a=j(0.902e6) * s,
                c_b=j(0.19e6) * s,
                v_ref=j(13.47e-3) * r,
            )
            P["c1"] = P["k1"] * j(0.0293)
        elif law == "kelvin_voigt":
            k = kg * logu(0.25e6, 1.2e6)
            P = dict(k=k, c=k * rng.uniform(0.2, 0.9) / (2 * np.pi))
        else:
            k = kg * logu(0.2e6, 0.8e6)
            k1 = k * logu(0.5, 3)
            P = dict(k0=k, k1=k1, c1=k1 * logu(0.05, 0.4))
    elif law in fx.FLUID:
        u, v, fmax = logu(12e-3, 60e-3), float(rng.uniform(0.2, 0.5)), float(rng.uniform(1.5, 3.5))
        F, al = logu(60e3, 900e3), float(rng.uniform(0.15, 1.0))
        P = dict(c=F / v**al, alpha=al)
        if law == "maxwell_power":
            P["k"] = F / (u * logu(0.04, 0.2))
    else:
        F, fmax, v = logu(25e3, 450e3), float(rng.uniform(0.8, 2.5)), float(rng.uniform(0.1, 0.25))
        if law == "friction":
            mu, y = float(rng.uniform(0.08, 0.4)), logu(0.2e-3, 0.9e-3)
            P, u = dict(mu=mu, N=F / mu, k=F / y), y * logu(15, 50)
        else:
            y = logu(0.6e-3, 4e-3)
            u = y * logu(5, 14)
            if law == "elastic_plastic":
                P = dict(k=F / y, Fy=F, b=float(rng.uniform(0.015, 0.08)))
            else:
                be = float(rng.uniform(0.35, 0.6))
                P = dict(
                    Fy=F,
                    Y=y,
                    alpha=float(rng.uniform(0.03, 0.2)),
                    A=1.0,
                    beta=be,
                    gamma=1 - be,
                    n=float(rng.uniform(1, 2.8)),
                )
    return {p: float(P[p]) for p in PARAMETERS[law]}, u, v, fmax, spec


def reference_stiffness(law, P):
    return (
        {"kelvin_voigt": "k", "zener": "k0"}.get(law)
        and P[{"kelvin_voigt": "k", "zener": "k0"}[law]]
        or (
            P["k_b"] + P["k0"] + 0.4 * P["k_a"]
            if law == "mgmm"
            else P["alpha"] * P["Fy"] / P["Y"]
            if law == "bouc_wen"
            else P["b"] * P["k"]
            if law == "elastic_plastic"
            else 0.0
        )
    )


def at_temperature(law, P, T, effects, visc):
    P = dict(P)
    if law == "mgmm" and not any(e["name"] == "temperature_law" for e in effects):
        g = (
            float(np.interp(T, *GAMMA_T))
            if 20 <= T <= 35
            else (1 - 0.013 * (T - 20) if T < 20 else 0.82 - 0.011 * (T - 35))
        )
        al = P["alpha"]
        P = {k: v * g for k, v in P.items()}  # c1/k1 stays; velocities as multiples of 1 mm/s
        P["c_NL"] *= 1e-3 ** (al - al * g)
    for p in {"kelvin_voigt": ["c"], "zener": ["c1"]}.get(law, []):
        P[p] *= visc
    return np.array([P[p] for p in PARAMETERS[law]])


def declared(rng, law, P):
    out = {}
    for p, v in P.items():
        s = float(np.exp(rng.uniform(np.log(0.03), np.log(0.2))) * rng.choice([-1, 1]))
        out[p] = 1.0 if p == "A" else v * np.exp(s)
    if law == "bouc_wen":
        out["n"] = max(out["n"], 1.0)
    if law == "mgmm":  # c_NL is off as a number of kN (s/mm)^alpha
        out["c_NL"] *= 1e3 ** (out["alpha"] - P["alpha"])
    return out


UNIT = {
    "k": "kN/mm",
    "k0": "kN/mm",
    "k1": "kN/mm",
    "k_a": "kN/mm",
    "k_b": "kN/mm",
    "c1": "kN*s/mm",
    "c_a": "kN*s/mm",
    "c_b": "kN*s/mm",
    "u_ref": "mm",
    "v_ref": "mm/s",
    "Fy": "kN",
    "Y": "mm",
    "N": "kN",
}


def with_unit(law, P, p):
    v = P[p]
    if p == "c" and law in ("viscous_power", "maxwell_power"):
        return f"{v / 1e3:.6g} kN*(s/m)^{P['alpha']:.6g}"
    if p == "c_NL":
        a = float(f"{P['alpha']:.6g}")
        return f"{v / 1e3 / 1e3**a:.6g} kN*(s/mm)^{a:.6g}"
    unit = "kN*s/mm" if p == "c" else UNIT.get(p)
    if unit is None:
        return f"{v:.6g}"
    return f"{v / {'kN/mm': 1e6, 'kN*s/mm': 1e6, 'mm': 1e-3, 'mm/s': 1e-3, 'kN': 1e3}[unit]:.6g} {unit}"
