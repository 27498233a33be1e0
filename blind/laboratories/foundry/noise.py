"""Noise of the channels, what they record, and the floors that it makes."""

import math

import numpy as np

from .laws import YIELD


def draw_noise(rng, peak, U):
    """White noise and steps of both channels; sigma is all that the force has."""
    sF, sU = rng.uniform(0.0008, 0.003), rng.uniform(0.00005, 0.0003)
    bits = int(rng.choice([14, 16, 16, 18]))
    qF, qU = 2 * 1.5 * peak / 2**bits, 2 * 1.5 * U / 2 ** (bits + 1 if bits < 18 else bits)
    return {"F": sF * peak, "U": sU * U, "qF": qF, "qU": qU, "sigma": math.hypot(sF * peak, qF / math.sqrt(12))}


def measured(rng, law, tests, result, noise, fs):
    """Records of all tests, and the floors of force and displacement in those to validate, as shares of power."""
    qF, qU = noise["qF"], noise["qU"]
    records, num, den, num_u = [], 0.0, 0.0, 0.0
    for t, (time, u, f) in zip(tests, result, strict=True):
        k = int(t["cut"] * fs)
        time, u, f = time[k:] - time[k], u[k:], f[k:]
        fm = np.round((f + noise["F"] * rng.standard_normal(len(f))) / qF) * qF
        um = np.round((u + noise["U"] * rng.standard_normal(len(u))) / qU) * qU
        if t["use"] == "validate":
            num, den = num + float(np.sum((fm - f) ** 2)), den + float(np.sum(fm**2))
            # noise of the displacement, by the slope of the loop: for white noise that nobody filters
            du, df = u[2:] - u[:-2], f[2:] - f[:-2]
            su = math.hypot(noise["U"], qU / math.sqrt(12))
            far = np.abs(du) > 2 * su
            num_u += float(np.sum((df[far] / du[far] * su) ** 2)) if law in [*YIELD, "mgmm"] else 0.0
        records.append((time, um, fm))
    return records, num / den, num_u / den
