"""The hidden effects: which laws show them, forms and sizes, and where in a test each acts."""

import math

import numpy as np

from .kernel import dahl, relax, softplus
from .laws import ALL, FLUID, LINEAR, YIELD

EFFECTS = {  # name: (group, laws in which tests can show it)
    "payne": (1, LINEAR + ["lead_rubber", "bouc_wen"]),
    "mullins": (1, LINEAR + ["lead_rubber", "bouc_wen", "mgmm"]),
    "degradation": (1, ["zener", "generalised_maxwell", "bouc_wen", "elastic_plastic", "lead_rubber", "friction"]),
    "self_heating": (
        1,
        ["zener", "kelvin_voigt", "viscous_power", "bilinear_oil", "friction", "lead_rubber", "friction_pendulum"],
    ),
    "ageing": (1, LINEAR + ["lead_rubber", "mgmm", "viscous_power"]),
    "temperature_law": (
        1,
        ["kelvin_voigt", "zener", "lead_rubber", "viscous_power", "bilinear_oil", "friction_pendulum"],
    ),
    "condition": (1, ["viscous_power", "bilinear_oil", "friction", "bouc_wen"]),
    "gain": (1, ALL),
    "extremes": (1, ["mgmm"]),
    "hardening": (2, LINEAR + ["lead_rubber", "bouc_wen", "elastic_plastic", "mgmm"]),
    "one_sided": (
        2,
        LINEAR
        + ["lead_rubber", "bouc_wen", "elastic_plastic", "friction", "viscous_power", "bilinear_oil", "maxwell_power"],
    ),
    "gas_spring": (2, FLUID),
    "pinching": (2, ["bouc_wen", "elastic_plastic"]),
    "friction": (3, LINEAR + ["maxwell", "bilinear_oil", "viscous_power"]),
    "velocity_exponent": (3, LINEAR + ["lead_rubber", "bouc_wen", "elastic_plastic", "viscous_power"]),
    "relaxation_branch": (3, ["kelvin_voigt", "zener", "lead_rubber", "elastic_plastic"]),
    "hysteresis": (3, LINEAR + ["viscous_power", "bilinear_oil"]),
    "play": (4, ["viscous_power", "maxwell", "kelvin_voigt", "bouc_wen"]),
    "series_flexibility": (4, ["kelvin_voigt", "viscous_power", "bilinear_oil"]),
    "lag": (4, YIELD + ["viscous_power", "bilinear_oil", "mgmm"]),
    "inertia": (
        4,
        [
            "zener",
            "generalised_maxwell",
            "kelvin_voigt",
            "elastic_plastic",
            "lead_rubber",
            "bouc_wen",
            "friction",
            "viscous_power",
        ],
    ),
    "offset": (5, ALL),
    "drift": (5, ALL),
    "static_offset": (5, LINEAR + ["lead_rubber", "elastic_plastic", "mgmm"]),
    "hum": (5, ALL),
}
UNLISTED = {
    "tooth_ripple": ["friction", "elastic_plastic", "bouc_wen", "viscous_power"],
    "axial_load_hunting": ["friction", "friction_pendulum", "lead_rubber"],
    "cavitation": ["viscous_power", "maxwell", "bilinear_oil"],
}


class Effect:
    """One effect: form and shape drawn once, its size s settable. c: sizes of the campaign (F, U, V, A, w, ...)."""

    def __init__(self, name, law, rng, c):
        self.name, self.law, self.c = name, law, c
        self.s = float(np.exp(rng.uniform(np.log(0.05), np.log(0.14))))
        self.r = rng.uniform(0, 1, 8).tolist()
        self.sign = float(rng.choice([-1, 1]))
        self.phases = rng.uniform(0, 2 * np.pi, 40).tolist()
        self.accept = []
        self.form = ""
        self.par = {}
        self.build()

    def between(self, i, a, b):
        return a + (b - a) * self.r[i]

    def build(self):
        n, c, s, law, B = self.name, self.c, self.s, self.law, self.between
        F, U, V, w = c["F"], c["U"], c["V"], c["w"]
        P, accept, pick = {}, [], self.r[7]
        if n == "payne":
            P = {
                "share": min(0.5, 3 * s),
                "amplitude_mm": B(0, 0.25, 0.5) * U,
                "exponent": B(1, 1.0, 1.8),
                "fade_s": B(2, 2, 6) * c["T0"],
            }
            self.form = "elastic" if law in LINEAR and pick < 0.4 else "whole"
            if self.form == "elastic":
                P["stiffness_kN_per_mm"] = min(0.45, 3 * s) * c["k_el"]
        elif n == "mullins":
            self.form = "path" if pick < 0.6 else "damage"
            P = {
                "share": min(0.5, 3 * s),
                "path_mm": B(0, 0.06, 0.2) * c["S"],
                "recovery": 0.0 if self.r[1] < 0.4 else B(2, 0.25, 0.7),
                "deformation_mm": B(3, 0.5, 0.9) * U,
            }
            if self.form == "damage" or P["recovery"] == 0:
                accept = ["degradation"]
            if self.form == "damage":
                P["recovery"] = 0.0
                accept += ["extremes"] if law == "mgmm" else []
        elif n == "degradation":
            self.form = "energy" if pick < 0.6 else "path"
            P = {"share": min(0.5, 3 * s), "half_work_share": B(0, 0.3, 0.8)}
            accept = ["mullins"]
        elif n == "self_heating":
            P = {"softening_of_mean_work": 3.5 * s, "cooling_s": B(0, 10, 40)}
        elif n == "ageing":
            self.form = "root" if pick < 0.5 else "levelling"
            P = {"per_test": self.sign * s * 0.8, "levelling_tests": B(0, 4, 9)}
            accept = ["degradation", "mullins"] if self.sign < 0 else []
        elif n == "temperature_law":
            P = {"Arrhenius_K": 0.12 * s * 293.15**2 * 2, "reference_C": 20.0}
        elif n == "condition":
            P = {"change_over_range": min(0.6, 3 * s), "saturation": B(0, 0.6, 1.5)}
        elif n == "gain":
            self.form = "displacement" if pick < 0.3 and law != "mgmm" else "force"
            P = {"gain": self.sign * (0.03 + 0.7 * s), "from_test_index": c["jump"]}
            if c["n_tests"] - c["jump"] < 2:
                accept = ["ageing"]
        elif n == "extremes":
            P = {"carried_to_next_test": 1.0}
            accept = ["mullins"]
        elif n == "hardening":
            self.form = ["limited_chain", "yeoh", "stop"][int(pick * 2.999)]
            P = {
                "force_at_largest_kN": 2.2 * s * F,
                "chain_limit_mm": B(0, 1.2, 1.6) * U,
                "begin_mm": B(1, 0.4, 0.65) * U,
            }
        elif n == "one_sided":
            if law in FLUID:
                self.form = "valve"
                P = {"share": self.sign * 2.5 * s, "velocity_mm_s": B(0, 0.03, 0.1) * V}
            elif law != "friction" and pick < 0.55:
                self.form = "contact"
                P = {"force_at_largest_kN": 3 * s * F, "begin_mm": B(0, 0.25, 0.55) * U, "side": self.sign}
            else:
                self.form = "factor"
                P = {"share": 2.5 * s, "blend_mm": B(0, 0.03, 0.08) * U, "side": self.sign}
        elif n == "gas_spring":
            P = {"preload_kN": 1.2 * s * F, "gas_length_mm": self.sign * B(0, 2.0, 3.0) * U, "polytropic": 1.4}
            accept = ["one_sided"]
        elif n == "pinching":
            P = {"share": min(0.8, 4 * s + 0.1), "width": B(0, 0.2, 0.4)}
            accept = ["hysteresis"]
        elif n == "friction":
            self.form = ["arctan", "dahl", "stribeck"][int(pick * 2.999)]
            P = {
                "force_kN": s * F,
                "velocity_mm_s": B(0, 0.003, 0.012) * V,
                "way_mm": B(1, 0.008, 0.03) * U,
                "peak": B(2, 0.3, 0.7),
                "stribeck_mm_s": B(3, 0.04, 0.1) * V,
            }
            if law == "viscous_power" and c["alpha"] < 0.45:
                accept = ["velocity_exponent"]
        elif n == "velocity_exponent":
            low = pick < 0.5 and law != "viscous_power"
            self.form = "logarithm" if low else "power"
            P = {
                "force_at_V_kN": 1.8 * s * F,
                "velocity_mm_s": B(0, 0.05, 0.15) * V,
                "exponent": B(1, 1.7, 2.0) if law in LINEAR + ["viscous_power"] else B(1, 0.5, 1.2),
            }
        elif n == "relaxation_branch":
            tau = B(0, 0.12, 0.35) / w if law in ("zener", "kelvin_voigt") else B(0, 0.4, 1.2) / w
            P = {"stiffness_kN_per_mm": 2.0 * s * F / U, "time_s": tau, "second_time_s": 2.5 * tau}
            accept = ["velocity_exponent"] if law in YIELD else []
        elif n == "hysteresis":
            P = {"force_at_largest_kN": 2 * s * F, "way_mm": B(0, 0.08, 0.2) * U}
            accept = ["friction", "velocity_exponent"]
        elif n == "play":
            P = {"gap_mm": 0.5 * s * U, "stiffness_kN_per_mm": B(0, 40, 70) * F / U}
            accept = ["series_flexibility"]
        elif n == "series_flexibility":
            P = {"stiffness_kN_per_mm": 0.8 / s * F / U}
            if pick < 0.5:
                self.form = "stiffening"
                P["doubling_stretch_mm"] = F / P["stiffness_kN_per_mm"] * B(0, 0.8, 1.5)
            # a spring in series with Kelvin and Voigt's element is a branch, and is that element behind a low-pass
            accept = ["relaxation_branch", "lag"] if law == "kelvin_voigt" else ["lag"]
        elif n == "lag":
            self.form = "two_filters" if pick < 0.5 else "delay"
            tick = 1 / (4 * c["fs"])
            P = {"time_s": tick * round(float(np.clip(1.1 * s / w, 0.004, 0.025)) / tick)}
            accept = ["series_flexibility"] if law in FLUID else []
        elif n == "inertia":
            P = {"mass_kg": 1.5 * s * F / c["A"] * 1e6}
            accept = ["lag"] if law in FLUID + ["kelvin_voigt"] else []
        elif n == "offset":
            self.form = "constant" if pick < 0.6 else "per_test"
            P = {"force_kN": self.sign * s * F * 0.7}
            accept = ["static_offset"] if law not in FLUID + ["friction"] else (["gas_spring"] if law in FLUID else [])
        elif n == "drift":
            P = {"rate_kN_per_s": self.sign * s * F / c["T"] * 1.5, "warm_up_s": B(0, 25, 60)}
        elif n == "static_offset":
            P = {"shear_mm": self.sign * 1.2 * s * U}
            accept = ["offset"] + (["one_sided"] if law == "mgmm" else [])
        elif n == "hum":
            P = {"force_kN": 0.35 * s * F, "frequency_Hz": 50.0 + 0.06 * (self.r[0] - 0.5)}
        elif n == "tooth_ripple":
            P = {"share": 1.2 * s, "pitch_mm": B(0, 0.15, 0.3) * U, "phase": 6.283 * self.r[1]}
        elif n == "axial_load_hunting":
            P = {"share": 1.4 * s, "frequency_Hz": B(0, 1.7, 3.5) * w / 6.283}
        elif n == "cavitation":
            P = {"limit_kN": max(0.35, 0.85 - 2 * s) * F, "side": self.sign}
            accept = ["one_sided"]
        self.par, self.accept = P, accept

    # where it acts
    def shift(self):
        return self.par["shear_mm"] if self.name == "static_offset" else 0.0

    def series(self):
        P = self.par
        if self.name == "play":
            return {"K": P["stiffness_kN_per_mm"], "gap": P["gap_mm"]}
        if self.name == "series_flexibility":
            return {"K": P["stiffness_kN_per_mm"], "e0": P.get("doubling_stretch_mm", 0.0)}
        return None

    def damper(self, F, kin, test, st):
        """Factors on the force of the law, and forces beside it. st: what lasts from test to test."""
        n, P, c, u, v = self.name, self.par, self.c, kin.u, kin.v
        if n == "payne":
            x, dec = np.abs(u), kin.h / P["fade_s"]
            a, env = 0.0, []
            keep = math.exp(-dec)
            for y in x.tolist():
                a = y if y > a else y + (a - y) * keep
                env.append(a)
            g = 2 / np.pi * np.arctan((np.array(env) / P["amplitude_mm"]) ** P["exponent"])
            return F - P["stiffness_kN_per_mm"] * g * u if self.form == "elastic" else F * (1 - P["share"] * g)
        if n == "mullins":
            if self.form == "path":
                s = st.get("s", 0.0) + np.concatenate([[0.0], np.cumsum(np.abs(np.diff(u)))])
                st["s"] = s[-1] * (1 - P["recovery"])
                return F * (1 + P["share"] / (1 + s / P["path_mm"]) ** 1.5)
            M = np.maximum.accumulate(np.maximum(np.abs(u), st.get("M", 0.0)))
            st["M"] = M[-1]
            return F * (1 - P["share"] * 2 * M**2 / (M**2 + P["deformation_mm"] ** 2) * 0.7)
        if n == "degradation":
            if self.form == "path":
                s = st.get("s", 0.0) + np.concatenate([[0.0], np.cumsum(np.abs(np.diff(u)))])
                st["s"], x = s[-1], s / (P["half_work_share"] * c["S"])
                return F * (1 - P["share"] * x / (1 + x))
            E0, E, d = P["half_work_share"] * c["W"], st.get("E", 0.0), P["share"]
            step = (0.5 * (F[1:] + F[:-1]) * np.diff(u)).tolist()
            phi = [1 - d * max(E, 0) / (max(E, 0) + E0)]
            for x in step:
                mid = E + 0.5 * phi[-1] * x
                E += x * (1 - d * max(mid, 0) / (max(mid, 0) + E0))
                phi.append(1 - d * max(E, 0) / (max(E, 0) + E0))
            st["E"] = E
            return F * np.array(phi)
        if n == "self_heating":
            step = (0.5 * (F[1:] + F[:-1]) * np.diff(u) / (c["W"] / c["n_tests"])).tolist()
            b, fade = P["softening_of_mean_work"], kin.h / P["cooling_s"]
            T, phi = 0.0, [1.0]  # warming, in those that the work of a mean test would give without cooling
            for x in step:
                mid = T + 0.5 * (x * phi[-1] - fade * T)
                T += x / (1 + b * max(mid, 0)) - fade * mid
                phi.append(1 / (1 + b * max(T, 0)))
            return F * np.array(phi)
        if n == "ageing":
            k = test["index"]
            return F * (
                1 + P["per_test"] * (math.sqrt(k) if self.form == "root" else k / (1 + k / P["levelling_tests"]))
            )
        if n == "temperature_law":
            return F * math.exp(P["Arrhenius_K"] * (1 / (test["T"] + 273.15) - 1 / 293.15))
        if n == "condition":
            q = P["saturation"]
            return F * (1 + P["change_over_range"] * (math.tanh(q * test["Q"]) / math.tanh(q) - 0.5))
        if n == "hardening":
            f, U = P["force_at_largest_kN"], c["U"]
            if self.form == "limited_chain":

                def g(x):
                    return x / (1 - np.minimum((x / P["chain_limit_mm"]) ** 2, 0.97)) - x

                return F + f * g(u) / g(U)
            if self.form == "yeoh":
                return F + f * (0.6 * (u / U) ** 3 + 0.4 * (u / U) ** 5)
            b, w = P["begin_mm"], 0.03 * U
            return F + f * w * (softplus((u - b) / w) - softplus((-u - b) / w)) / (U - b)
        if n == "one_sided":
            if self.form == "valve":
                y = np.maximum(v, 0) ** 2
                return F * (1 + P["share"] * y / (y + P["velocity_mm_s"] ** 2))
            if self.form == "contact":
                b, w, U = P["begin_mm"], 0.02 * c["U"], c["U"]
                x = w * softplus((P["side"] * u - b) / w) / (U - b)
                return F + P["side"] * P["force_at_largest_kN"] * (0.5 * x + 0.5 * x**2)
            return F * (1 + P["share"] * 0.5 * (1 + np.tanh(P["side"] * u / P["blend_mm"])))
        if n == "gas_spring":
            return F + P["preload_kN"] * (1 - u / P["gas_length_mm"]) ** -P["polytropic"]
        if n == "pinching":
            M = np.maximum.accumulate(np.maximum(np.abs(u), st.get("M", 1e-3 * c["U"])))
            st["M"] = M[-1]
            return F * (1 - P["share"] / (1 + (u / (P["width"] * M)) ** 4))
        if n == "velocity_exponent":
            if self.form == "power":
                return F + P["force_at_V_kN"] * np.sign(v) * np.abs(v / c["V"]) ** P["exponent"]
            v0 = P["velocity_mm_s"]
            return F + P["force_at_V_kN"] * np.sign(v) * np.log1p(np.abs(v) / v0) / math.log1p(c["V"] / v0)
        if n == "relaxation_branch":
            k = 0.5 * P["stiffness_kN_per_mm"]
            return F + sum(relax(k * tau * v, tau, kin.h) for tau in (P["time_s"], P["second_time_s"]))
        if n == "hysteresis":
            return F + P["force_at_largest_kN"] * np.abs(u) / c["U"] * dahl(kin, P["way_mm"], 1)
        if n == "tooth_ripple":
            return F * (1 + P["share"] * np.sin(2 * np.pi * u / P["pitch_mm"] + P["phase"]))
        if n == "axial_load_hunting":
            return F * (1 + P["share"] * np.sin(2 * np.pi * P["frequency_Hz"] * kin.t + self.phases[test["index"]]))
        if n == "cavitation":
            w, x = 0.03 * c["F"], -P["side"] * F
            return -P["side"] * (x - w * softplus((x - P["limit_kN"]) / w))
        return F

    def rig(self, F, kin, test):
        n, P, v = self.name, self.par, kin.v
        if n == "friction":
            if self.form == "dahl":
                return F + P["force_kN"] * dahl(kin, P["way_mm"], 1.5)
            s = 2 / np.pi * np.arctan(v / P["velocity_mm_s"])
            if self.form == "stribeck":
                s = s * (1 + P["peak"] / (1 + (v / P["stribeck_mm_s"]) ** 2))
            return F + P["force_kN"] * s
        if n == "inertia":
            return F + P["mass_kg"] * 1e-6 * kin.a
        return F

    def channel(self, F, kin, test):
        n, P, t = self.name, self.par, kin.t
        if n == "lag":
            if self.form == "delay":
                k = int(round(P["time_s"] / kin.h))  # a whole number of steps
                return np.concatenate([np.full(k, F[0]), F[:-k]])
            for _ in range(2):
                F = relax(F, 0.5 * P["time_s"], kin.h, F[0])
            return F
        if n == "gain" and self.form == "force" and test["index"] >= P["from_test_index"]:
            return F * (1 + P["gain"])
        if n == "offset":
            return F + P["force_kN"] * (1 if self.form == "constant" else 1.4 * math.cos(self.phases[test["index"]]))
        if n == "drift":
            return F + P["rate_kN_per_s"] * P["warm_up_s"] * (1 - np.exp(-t / P["warm_up_s"]))
        if n == "hum":
            i = test["index"]
            a = 1 + 0.3 * math.cos(self.phases[-1 - i])
            return F + P["force_kN"] * a * np.sin(2 * np.pi * P["frequency_Hz"] * t + self.phases[i])
        return F

    def displacement(self, u, test):
        if self.name == "gain" and self.form == "displacement" and test["index"] >= self.par["from_test_index"]:
            return u * (1 + self.par["gain"])
        return u
