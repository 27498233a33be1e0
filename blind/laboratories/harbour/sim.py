"""Time stepping of damper laws with what may be hidden in them. SI units throughout (N, m, s, K).
Laws: textbook forms (Wen 1976; Zener 1948; Constantinou & Symans 1993; Makris & Constantinou 1991) and the MGMM as the
documents of the tool print it. All are stepped along a fine grid; a series element is met by a bracketed root search.
"""

import math

import numpy as np

from ..compiled import njit

LAWS = {
    "kelvin_voigt": 0,
    "mgmm": 1,
    "zener": 2,
    "viscous_power": 3,
    "maxwell_power": 4,
    "bouc_wen": 5,
    "elastic_plastic": 6,
    "friction": 7,
}
PARAMETERS = {
    "kelvin_voigt": ["k", "c"],
    "mgmm": ["k1", "c1", "k0", "c_NL", "alpha", "k_a", "k_b", "u_ref", "c_a", "c_b", "v_ref"],
    "zener": ["k0", "k1", "c1"],
    "viscous_power": ["c", "alpha"],
    "maxwell_power": ["c", "alpha", "k"],
    "bouc_wen": ["Fy", "Y", "alpha", "A", "beta", "gamma", "n"],
    "elastic_plastic": ["k", "Fy", "b"],
    "friction": ["mu", "N", "k"],
}
# slots of the effects' array
SLOTS = [
    "ks",
    "gap",
    "pay",
    "pay_d",
    "pay_u",
    "pay_tau",
    "pay_m",
    "mul",
    "mul_d",
    "mul_u",
    "mul_b",
    "deg",
    "deg_d",
    "deg_s",
    "heat",
    "heat_b",
    "heat_C",
    "heat_h",
    "har",
    "har_k",
    "har_r",
    "har_p",
    "one",
    "one_a",
    "rel_k",
    "rel_tau",
    "vel",
    "vel_c",
    "vel_a",
    "fri",
    "fri_F",
    "fri_s",
    "factor",
    "u0",
    "k_ref",
    "slip_F",
    "slip_d",
]
SLOT = {name: i for i, name in enumerate(SLOTS)}


@njit(cache=True)
def spow(v, a):
    if v > 0.0:
        return v**a
    if v < 0.0:
        return -((-v) ** a)
    return 0.0


@njit(cache=True)
def bw_slope(z, A, beta, gamma, n, s):
    """dz/du times Y; s is the sign of the motion (Wen 1976)."""
    return A - (beta + gamma * (1.0 if s * z > 0 else -1.0)) * abs(z) ** n


@njit(cache=True)
def law_step(law, P, x, y, u0, u1, v1, dt):
    """Force of the law at the end of the step; x state before, y state after."""
    for i in range(8):
        y[i] = x[i]
    du = u1 - u0
    if law == 0:
        return P[0] * u1 + P[1] * v1
    if law == 1:
        tau = P[1] / P[0]
        if u1 > y[2]:
            y[2] = u1
        if u1 < y[3]:
            y[3] = u1
        if v1 > y[4]:
            y[4] = v1
        if v1 < y[5]:
            y[5] = v1
        km = P[5] * math.exp(-0.5 * (y[2] - y[3]) / P[7]) + P[6]
        cm = P[8] * math.exp(-0.5 * (y[4] - y[5]) / P[10]) + P[9]
        r = (P[2] + km) * u1 + (tau * P[2] + P[1] + cm) * v1 + P[3] * spow(v1, P[4])
        e = math.exp(-dt / tau)
        y[0] = e * x[0] + r - x[1] * e - (r - x[1]) * tau / dt * (1.0 - e)
        y[1] = r
        return y[0]
    if law == 2:
        tau = P[2] / P[1]
        e = math.exp(-dt / tau)
        y[0] = e * x[0] + P[1] * tau / dt * (1.0 - e) * du
        return P[0] * u1 + y[0]
    if law == 3:
        return P[0] * spow(v1, P[1])
    if law == 4:  # implicit Euler in two parts, root by Newton within a bracket
        F = x[0]
        c, al, k = P[0], P[1], P[2]
        h = 0.5 * dt
        for _part in range(2):
            b = F + 0.5 * k * du
            lo, hi = min(0.0, b), max(0.0, b)
            f = F
            if f < lo or f > hi:
                f = 0.5 * (lo + hi)
            for _it in range(60):
                g = f + k * h * spow(f / c, 1.0 / al) - b
                if g > 0:
                    hi = f
                else:
                    lo = f
                d = 1.0 + k * h / (c * al) * abs(f / c) ** (1.0 / al - 1.0)
                f2 = f - g / d
                if f2 <= lo or f2 >= hi:
                    f2 = 0.5 * (lo + hi)
                if abs(f2 - f) < 1e-7 * c * 1e-2 + 1e-9:
                    f = f2
                    break
                f = f2
            F = f
        y[0] = F
        return F
    if law == 5:
        z = x[0]
        if du != 0.0:
            s = 1.0 if du > 0 else -1.0
            h = du / P[1]
            k1 = bw_slope(z, P[3], P[4], P[5], P[6], s)
            k2 = bw_slope(z + 0.5 * h * k1, P[3], P[4], P[5], P[6], s)
            k3 = bw_slope(z + 0.5 * h * k2, P[3], P[4], P[5], P[6], s)
            k4 = bw_slope(z + h * k3, P[3], P[4], P[5], P[6], s)
            z += h * (k1 + 2 * k2 + 2 * k3 + k4) / 6.0
        y[0] = z
        return P[2] * P[0] / P[1] * u1 + (1.0 - P[2]) * P[0] * z
    if law == 6:
        lim = (1.0 - P[2]) * P[1]
        y[0] = min(max(x[0] + (1.0 - P[2]) * P[0] * du, -lim), lim)
        return P[2] * P[0] * u1 + y[0]
    lim = P[0] * P[1]
    y[0] = min(max(x[0] + P[2] * du, -lim), lim)
    return y[0]


@njit(cache=True)
def total(law, P, E, x, y, z, zn, u0, u1, v1, dt, g):
    """Force of the specimen: law times its softening g, one-sidedness, and what stands beside."""
    f = g * law_step(law, P, x, y, u0, u1, v1, dt)
    if E[22] == 1:
        f *= 1.0 + E[23] if f > 0 else 1.0 - E[23]
    elif E[22] == 2 and u1 > 0:
        f += E[23] * u1
    y[7] = f
    if E[18] == 1:
        f += E[19] * u1**3
    elif E[18] == 2 and abs(u1) > E[20]:
        f += math.copysign(E[19] * (abs(u1) - E[20]) ** E[21], u1)
    du = u1 - u0
    if E[24] > 0:
        e = math.exp(-dt / E[25])
        zn[0] = e * z[0] + E[24] * E[25] / dt * (1.0 - e) * du
        f += zn[0]
    if E[26] == 1:
        f += E[27] * spow(v1, E[28])
    elif E[26] == 2:
        f += E[27] * v1 / (1.0 + abs(v1) / E[28])
    if E[29] == 1:
        zn[1] = min(max(z[1] + E[30] / E[31] * du, -E[30]), E[30])
        f += zn[1]
    elif E[29] == 2:  # Dahl: exact along a straight piece of the path
        s = 1.0 if du > 0 else -1.0
        zn[1] = s * E[30] + (z[1] - s * E[30]) * math.exp(-abs(du) / E[31]) if du != 0 else z[1]
        f += zn[1]
    elif E[29] == 3:  # Stribeck, smoothed sign
        f += E[30] * math.tanh(v1 / E[31]) * (1.0 + 0.35 * math.exp(-((v1 / (8 * E[31])) ** 2)))
    return f


@njit(cache=True)
def run(law, P, E, u, v, dt, S, X, fac, crack, F):
    """Whole test. S: [u_max, energy, path, warming, tests' largest u+, u-, v+, v-] lasting from test to test."""
    n = u.size
    x, y = X.copy(), np.zeros(8)
    z, zn = np.zeros(2), np.zeros(2)
    ks, gap = E[0], E[1]
    ur0 = u[0] + E[33]
    u0 = ur0
    if law == 0:
        f0 = P[0] * u0
    elif law == 1:
        x[2], x[3] = max(x[2], u0), min(x[3], u0)
        f0 = (P[2] + P[5] * math.exp(-0.5 * (x[2] - x[3]) / P[7]) + P[6]) * u0
        x[0], x[1] = f0, f0
    elif law == 2:
        f0 = P[0] * u0
    else:
        f0 = 0.0
    F[0] = f0
    ua, lam, um1 = abs(u0), 1.0, u0
    slip, target, peak = 0.0, 0.0, 0.0
    for i in range(1, n):
        g = E[32] * fac[i]
        if E[2] == 1:
            r = (ua / E[4]) ** (2.0 * E[6])
            g *= 1.0 - E[3] * r / (1.0 + r)
        elif E[2] == 2:
            g *= 1.0 - E[3] * (1.0 - lam)
        if E[7] == 1 and S[0] > 1e-9:
            r = S[0] / E[9]
            g *= 1.0 - E[8] * (1.0 - (1.0 - math.exp(-r)) / r)
        elif E[7] == 2:
            g *= 1.0 - E[8] * math.erf((S[0] ** 2 - min(abs(u0), S[0]) ** 2) / (E[9] ** 2 + E[10] * S[0] ** 2))
        if E[11] == 1:
            g *= 1.0 - E[12] * (1.0 - math.exp(-max(S[1], 0.0) / E[13]))
        elif E[11] == 2:
            g *= 1.0 - E[12] * (1.0 - math.exp(-S[2] / E[13]))
        elif E[11] == 3:
            g /= 1.0 + E[12] * max(S[1], 0.0) / E[13]
        if E[14] == 1:
            g *= math.exp(-E[15] * S[3])
        elif E[14] == 2:
            g /= 1.0 + E[15] * S[3]
        if crack[i] > 0 and u0 > 0:
            g *= 1.0 - crack[i]
        ur = u[i] + E[33] - slip
        if ks > 0:
            a = ur
            v1 = (3 * a - 4 * u0 + um1) / (2 * dt)
            fa = total(law, P, E, x, y, z, zn, u0, a, v1, dt, g)
            u1, f = a, fa
            if abs(fa) > 1e-9:
                s = 1.0 if fa > 0 else -1.0
                b = ur - s * (abs(fa) / ks + gap)
                fb = total(law, P, E, x, y, z, zn, u0, b, (3 * b - 4 * u0 + um1) / (2 * dt), dt, g) - s * abs(fa)
                side = 0
                for it in range(80):
                    w = (a * fb - b * fa) / (fb - fa) if it % 12 != 11 else 0.5 * (a + b)
                    f = total(law, P, E, x, y, z, zn, u0, w, (3 * w - 4 * u0 + um1) / (2 * dt), dt, g)
                    d = ur - w
                    h = f - (ks * (d - gap) if d > gap else (ks * (d + gap) if d < -gap else 0.0))
                    u1 = w
                    if abs(h) < 1e-2 + 2e-6 * peak or abs(b - a) < 1e-14:
                        break
                    if h * fa > 0:
                        a, fa = w, h
                        if side == 1:
                            fb *= 0.5
                        side = 1
                    else:
                        b, fb = w, h
                        if side == -1:
                            fa *= 0.5
                        side = -1
            v1 = (3 * u1 - 4 * u0 + um1) / (2 * dt)
        else:
            u1 = ur
            v1 = v[i] if E[35] == 0 else (3 * u1 - 4 * u0 + um1) / (2 * dt)
            f = total(law, P, E, x, y, z, zn, u0, u1, v1, dt, g)
        for j in range(8):
            x[j] = y[j]
        z[0], z[1] = zn[0], zn[1]
        F[i] = f
        peak = max(peak, abs(f))
        if E[35] > 0:  # anchorage: it gives way a little when it is overloaded
            if abs(f) > E[35] and abs(target - slip) < 0.1 * E[36]:
                target += math.copysign(E[36], f)
            slip += (target - slip) * (1.0 - math.exp(-dt / 0.02))
        p = (y[7] - E[34] * u1) * v1 * dt
        S[1] += p
        S[2] += abs(u1 - u0)
        if E[14] > 0:
            S[3] += p / E[16] - S[3] * E[17] / E[16] * dt
            if S[3] < 0:
                S[3] = 0.0
        if abs(u1) > S[0]:
            S[0] = abs(u1)
        ua = max(abs(u1), ua * math.exp(-dt / E[5])) if E[2] == 1 else ua
        if E[2] == 2:
            r = 1.0 / E[5] + abs(v1) / E[4]
            q = 1.0 / (E[5] * r)
            lam = q + (lam - q) * math.exp(-r * dt)
        um1, u0 = u0, u1
    for j in range(4):
        S[4 + j] = x[2 + j]
