"""One damper of every law, sized alike: about 100 kN at 5-10 mm and 0.25-4 Hz. SI units."""

from __future__ import annotations

from math import pi

EXAMPLES: dict[str, dict[str, float]] = {
    "kelvin_voigt": {"k": 8e6, "c": 0.4e6},
    "zener": {"k0": 5e6, "k1": 8e6, "c1": 0.8e6},
    "generalised_maxwell": {"k0": 4e6, "k1": 6e6, "c1": 0.6e6, "k2": 8e6, "c2": 0.15e6},
    "fractional_kelvin": {"k0": 8e6, "c": 0.3, "alpha": 0.4},
    "fractional_zener": {"k0": 8e6, "a": 0.02, "b": 0.3, "alpha": 0.5},
    "viscous": {"c": 1e6},
    "viscous_power": {"c": 300e3, "alpha": 0.35},
    "asymmetric_viscous": {"c_plus": 300e3, "c_minus": 200e3, "alpha": 0.35},
    "bilinear_oil": {"c": 2e6, "F_r": 80e3, "p": 0.05},
    "maxwell": {"c0": 1.5e6, "lambda": 0.05},
    "maxwell_power": {"c": 300e3, "alpha": 0.35, "k": 40e6},
    "fractional_maxwell": {"c0": 1.5e6, "lambda": 0.15, "nu": 0.6},
    "friction": {"mu": 0.3, "N": 330e3, "k": 100e6},
    "elastic_plastic": {"k": 50e6, "Fy": 100e3, "b": 0.03},
    "lead_rubber": {"Q": 80e3, "K_d": 3e6, "Y": 2e-3},
    "friction_pendulum": {"W": 1e6, "R": 1.5, "f_slow": 0.04, "f_fast": 0.09, "a": 30.0, "Y": 0.5e-3},
    "self_centring": {"k": 50e6, "Fy": 80e3, "b": 0.05, "beta": 0.8},
    "buckling_restrained": {
        "A_sc": 4e-4,
        "F_ysc": 250e6,
        "E": 200e9,
        "L_wp": 1.0,
        "L_y": 0.6,
        "KF": 1.3,
        "alpha": 0.005,
        "R_y": 1.1,
        "strain1": 0.01,
        "omega1": 1.3,
        "beta1": 1.1,
    },
    "gap": {"k": 25e6, "gap": 2e-3, "d": 1.0, "side": 0.0},
    "ramberg_osgood": {"k": 50e6, "Fy": 80e3, "a": 0.5, "n": 6.0},
    "bouc_wen": {"Fy": 100e3, "Y": 2e-3, "alpha": 0.05, "A": 1.0, "beta": 0.5, "gamma": 0.5, "n": 2.0},
    "modified_bouc_wen": {
        "k1": 8e6,
        "k2": 6e6,
        "u_ref": 8e-3,
        "Y": 4e-3,
        "alpha": 0.3,
        "A": 1.0,
        "beta": 0.5,
        "gamma": 0.5,
        "n": 1.0,
        "C": 40e3,
        "alpha_d": 0.35,
    },
    # softens, then hardens; the slope of the asymptotes stays above zero
    "asymptote": {"f0": 25e3, "k1": 8e6, "k2": -2e8, "k3": 1e10, "kappa": 3.0, "n": 1.5, "c": 0.1e6},
    "linearised": {"k_eff": 8e6, "zeta_eff": 0.2, "omega": 2.0 * pi},
    # thesis Table 4.2, k0 in kN/mm
    "mgmm": {
        "k1": 0.515e6,
        "c1": 15.1e3,
        "k0": 0.107e6,
        "c_NL": 1585.0 * 1000.0**0.374,
        "alpha": 0.374,
        "k_a": 3.741e6,
        "k_b": 3.613e6,
        "u_ref": 7.966e-3,
        "c_a": 902e3,
        "c_b": 190e3,
        "v_ref": 13.468e-3,
        "consistent": 0.0,
    },
}
"""Parameters by law."""
