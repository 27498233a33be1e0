"""Time stepping of a damper with its effects, SI units. Own equations; sources in summary.md."""

import math

import numpy as np

from ..compiled import njit

LAWS = {
    "kelvin_voigt": 0,
    "zener": 1,
    "mgmm": 2,
    "bouc_wen": 3,
    "elastic_plastic": 4,
    "friction": 5,
    "viscous_power": 6,
    "maxwell_power": 7,
}
ROWS = [
    "payne",
    "mullins",
    "degradation",
    "self_heating",
    "hardening",
    "one_sided",
    "relaxation_branch",
    "velocity_exponent",
    "friction",
    "rig",
    "stick_slip",
    "ripple",
    "crack",
]
ROW = {n: i for i, n in enumerate(ROWS)}
NZ = 16  # 0-5 law, 6 branch, 7 friction, 8 phi of Payne, 9 kept amplitude, 10 heat
NS = 4  # lasting between tests: 0 largest deformation, 1 energy, 2 path, 3 largest energy of the spring


@njit(cache=True, fastmath=False)
def power(v, a):
    s = abs(v)
    if s < 1e-12:
        return 0.0
    return math.copysign(s**a, v)


@njit(cache=True)
def law_force(law, P, d0, d1, v1, dt, z0, z1, se, sv):
    if law == 0:
        return P[0] * se * d1 + P[1] * sv * v1
    if law == 1:
        k1 = P[1] * se
        tau = P[2] * sv / k1
        e = math.exp(-dt / tau)
        q = z0[0] * e + k1 * tau * (1.0 - e) / dt * (d1 - d0)
        z1[0] = q
        return P[0] * se * d1 + q
    if law == 2:  # k1 c1 k0 cNL alpha ka kb uref ca cb vref
        tau = P[1] / P[0]
        z1[1] = max(z0[1], d1)
        z1[2] = min(z0[2], d1)
        z1[3] = max(z0[3], v1)
        z1[4] = min(z0[4], v1)
        um = 0.5 * (z1[1] - z1[2])
        vm = 0.5 * (z1[3] - z1[4])
        km = P[5] * math.exp(-um / P[7]) + P[6]
        cm = P[8] * math.exp(-vm / P[10]) + P[9]
        r = (P[2] + km) * se * d1 + sv * ((tau * P[2] + P[1] + cm) * v1 + P[3] * power(v1, P[4]))
        e = math.exp(-dt / tau)
        g = tau / dt * (1.0 - e)
        f = e * z0[0] + (g - e) * z0[5] + (1.0 - g) * r
        z1[0] = f
        z1[5] = r
        return f
    if law == 3:  # Fy Y alpha A beta gamma n
        h = (d1 - d0) / P[1]
        s = 1.0 if h > 0 else -1.0
        z = z0[0]
        m = 1 + int(abs(h) * 20.0)
        h /= m
        for _ in range(m):
            k = (P[3] - (P[5] * math.copysign(1.0, z * s) + P[4]) * abs(z) ** P[6]) * h
            y = z + 0.5 * k
            k2 = (P[3] - (P[5] * math.copysign(1.0, y * s) + P[4]) * abs(y) ** P[6]) * h
            y = z + 0.5 * k2
            k3 = (P[3] - (P[5] * math.copysign(1.0, y * s) + P[4]) * abs(y) ** P[6]) * h
            y = z + k3
            k4 = (P[3] - (P[5] * math.copysign(1.0, y * s) + P[4]) * abs(y) ** P[6]) * h
            z += (k + 2 * k2 + 2 * k3 + k4) / 6.0
        z1[0] = z
        return P[2] * P[0] / P[1] * d1 + (1.0 - P[2]) * P[0] * z
    if law == 4:  # k Fy b
        lim = (1.0 - P[2]) * P[1]
        f = z0[0] + (1.0 - P[2]) * P[0] * (d1 - d0)
        f = min(max(f, -lim), lim)
        z1[0] = f
        return P[2] * P[0] * d1 + f
    if law == 5:  # mu N k
        lim = P[0] * P[1]
        f = min(max(z0[0] + P[2] * (d1 - d0), -lim), lim)
        z1[0] = f
        return f
    if law == 6:
        return P[0] * power(v1, P[1])
    # maxwell_power c alpha k: trapezoidal rule, Newton held in a bracket
    ia = 1.0 / P[1]
    rhs = z0[0] + P[2] * (d1 - d0) - 0.5 * dt * P[2] * power(z0[0] / P[0], ia)
    lo = min(rhs, 0.0)
    hi = max(rhs, 0.0)
    f = z0[0]
    if f < lo or f > hi:
        f = 0.5 * (lo + hi)
    for _ in range(40):
        y = abs(f) / P[0]
        g = f + 0.5 * dt * P[2] * math.copysign(y**ia, f) - rhs
        if g > 0:
            hi = f
        else:
            lo = f
        dg = 1.0 + 0.5 * dt * P[2] * ia * y ** (ia - 1.0) / P[0]
        new = f - g / dg
        if new < lo or new > hi:
            new = 0.5 * (lo + hi)
        if abs(new - f) <= 1e-9 * P[0] * 1e-3 + 1e-10 * abs(new):
            f = new
            break
        f = new
    z1[0] = f
    return f


@njit(cache=True)
def total(law, P, E, d0, d1, v1, dt, z0, z1, sw, se, sv, crack):
    f = sw * law_force(law, P, d0, d1, v1, dt, z0, z1, se, sv)
    if crack > 0:  # s, opening
        f *= 1.0 - E[12, 1] * 0.5 * (1.0 + math.tanh((d1 - E[12, 2]) / E[12, 3]))
    o = E[5, 0]
    if o == 1:
        f *= 1.0 + E[5, 1] * math.tanh(d1 / E[5, 2])
    elif o == 2:
        f += E[5, 1] * max(d1 * E[5, 3] - E[5, 2], 0.0) * E[5, 3]
    elif o == 3:
        f *= 1.0 + E[5, 1] * math.tanh(v1 / E[5, 2])
    h = E[4, 0]
    if h == 1:
        f += E[4, 1] * d1**3
    elif h == 2:
        f += E[4, 1] * math.copysign(max(abs(d1) - E[4, 2], 0.0) ** E[4, 3], d1)
    if E[6, 0] == 1:  # k, tau
        e = math.exp(-dt / E[6, 2])
        q = z0[6] * e + E[6, 1] * E[6, 2] * (1.0 - e) / dt * (d1 - d0)
        z1[6] = q
        f += q
    if E[7, 0] == 1:
        f += E[7, 1] * power(v1, E[7, 2])
    elif E[7, 0] == 2:
        f += E[7, 1] * v1 / (1.0 + abs(v1) / E[7, 2])
    if E[8, 0] == 1 or E[8, 0] == 3:  # F, presliding k, rise at rest, speed
        lim = E[8, 1]
        if E[8, 0] == 3:
            lim *= 1.0 + E[8, 3] * math.exp(-((v1 / E[8, 4]) ** 2))
        q = min(max(z0[7] + E[8, 2] * (d1 - d0), -lim), lim)
        z1[7] = q
        f += q
    elif E[8, 0] == 2:
        f += E[8, 1] * math.tanh(v1 / E[8, 2])
    if E[11, 0] == 1:
        f += E[11, 1] * math.sin(2 * math.pi * d1 / E[11, 2] + E[11, 3])
    return f


@njit(cache=True)
def pin(E, y):
    """Force of the rig's connection, stretched by y: stiffness, clearance, length of stiffening."""
    a = abs(y) - E[9, 2]
    if a <= 0.0:
        return 0.0
    k = E[9, 1]
    if E[9, 3] > 0:
        k *= 1.0 + (a / E[9, 3]) ** 2
    return math.copysign(k * a, y)


@njit(cache=True)
def run(law, P, E, x, v, dt, factors, crack, fresh, ext, S, F):
    """x, v motion at the specimen's end of the rig; factors whole, elastic, viscous; S lasting state; F result."""
    n = len(x)
    z0 = np.zeros(NZ)
    z1 = np.zeros(NZ)
    z0[8] = 1.0
    if law == 2:
        if not fresh:
            for i in range(4):
                z0[1 + i] = ext[i]
        z0[1] = max(z0[1], x[0])
        z0[2] = min(z0[2], x[0])
        um = 0.5 * (z0[1] - z0[2])
        z0[5] = (P[2] + P[5] * math.exp(-um / P[7]) + P[6]) * x[0] * factors[1]
        z0[0] = z0[5]
    z1[:] = z0
    rig = E[9, 0] > 0
    d0 = x[0]
    dm = x[0]
    w = 0.0
    slipping = 0.0
    f = 0.0
    if law == 0:
        f = P[0] * x[0]
    scale = max(np.max(np.abs(x)), 1e-6)
    if E[9, 0] > 0 and E[9, 2] == 0.0:  # a pre-strained specimen is clamped with the rig unloaded
        pass
    for i in range(n):
        sw = factors[0]
        se = factors[1]
        sv = factors[2]
        s = 1.0
        if E[0, 0] == 1 or E[0, 0] == 3:
            s = 1.0 - E[0, 1] * (1.0 - z0[8])
        elif E[0, 0] == 2:
            y = (z0[9] / E[0, 3]) ** (2.0 * E[0, 4])
            s = 1.0 - E[0, 1] * y / (1.0 + y)
        if E[0, 5] == 1:
            se *= s
        else:
            sw *= s
        if E[1, 0] == 1:
            sw *= 1.0 - E[1, 1] * (1.0 - math.exp(-S[0] / E[1, 2]))
        elif E[1, 0] == 2:  # Ogden & Roxburgh: inside the largest deformation ever
            y = (S[0] ** 2 - d0**2) / E[1, 2] ** 2
            sw *= 1.0 - E[1, 1] * math.erf(max(y, 0.0))
        if E[2, 0] == 1:
            sw *= 1.0 - E[2, 1] * (1.0 - math.exp(-max(S[1], 0.0) / E[2, 2]))
        elif E[2, 0] == 2:
            sw *= 1.0 / (1.0 + E[2, 1] * S[2] / E[2, 2])
        elif E[2, 0] == 3:
            sw *= 1.0 - E[2, 1] * max(S[1], 0.0) / E[2, 2]
        if E[3, 0] == 1:
            y = math.exp(-E[3, 1] * z0[10])
            sw *= y
        elif E[3, 0] == 2:
            sv *= math.exp(-E[3, 1] * z0[10])
        if rig:
            # equilibrium F(d) = pin(x - d), velocity by BDF2, root by bracketing and false position (Illinois)
            lo = d0 - 1e-9 * scale
            hi = d0 + 1e-9 * scale
            step = abs(x[i] - x[max(i - 1, 0)]) + 1e-7 * scale
            glo = 1.0
            ghi = -1.0
            for _ in range(60):
                glo = total(law, P, E, d0, lo, (3 * lo - 4 * d0 + dm) / (2 * dt), dt, z0, z1, sw, se, sv, crack) - pin(
                    E, x[i] - lo
                )
                if glo <= 0:
                    break
                lo -= step
                step *= 2
            step = abs(x[i] - x[max(i - 1, 0)]) + 1e-7 * scale
            for _ in range(60):
                ghi = total(law, P, E, d0, hi, (3 * hi - 4 * d0 + dm) / (2 * dt), dt, z0, z1, sw, se, sv, crack) - pin(
                    E, x[i] - hi
                )
                if ghi >= 0:
                    break
                hi += step
                step *= 2
            side = 0
            d1 = 0.5 * (lo + hi)
            for k in range(60):
                if ghi - glo > 0 and k % 4 != 3:
                    d1 = (lo * ghi - hi * glo) / (ghi - glo)
                else:
                    d1 = 0.5 * (lo + hi)
                g = total(law, P, E, d0, d1, (3 * d1 - 4 * d0 + dm) / (2 * dt), dt, z0, z1, sw, se, sv, crack) - pin(
                    E, x[i] - d1
                )
                if hi - lo < 1e-11 * scale or g == 0:
                    break
                if g > 0:
                    hi = d1
                    ghi = g
                    if side == 1:
                        glo *= 0.5
                    side = 1
                else:
                    lo = d1
                    glo = g
                    if side == -1:
                        ghi *= 0.5
                    side = -1
            v1 = (3 * d1 - 4 * d0 + dm) / (2 * dt)
            total(law, P, E, d0, d1, v1, dt, z0, z1, sw, se, sv, crack)
            f = pin(E, x[i] - d1)
        else:
            v1 = v[i]
            if E[10, 0] == 1:  # anchorage: F at rest, F sliding, speed
                if slipping == 0.0 and abs(f) > E[10, 1]:
                    slipping = math.copysign(1.0, f)
                elif slipping != 0.0 and abs(f) < E[10, 2]:
                    slipping = 0.0
                w += slipping * E[10, 3] * dt
                v1 -= slipping * E[10, 3]
            d1 = x[i] - w
            f = total(law, P, E, d0, d1, v1, dt, z0, z1, sw, se, sv, crack)
        F[i] = f
        sp = abs(v1)
        if E[0, 0] == 1:
            a = 1.0 / E[0, 2]
            b = sp / E[0, 3]
            e = math.exp(-(a + b) * dt)
            z1[8] = z0[8] * e + a / (a + b) * (1.0 - e)
        elif E[0, 0] == 3:
            a = 1.0 / E[0, 2]
            b = abs(f * v1) / E[0, 3]
            e = math.exp(-(a + b) * dt)
            z1[8] = z0[8] * e + a / (a + b) * (1.0 - e)
        elif E[0, 0] == 2:
            z1[9] = max(abs(d1), z0[9] * math.exp(-dt / E[0, 2]))
        if E[3, 0] > 0:
            e = math.exp(-dt / E[3, 2])
            z1[10] = z0[10] * e + max(f * v1, -1e30) / E[3, 3] * E[3, 2] * (1.0 - e)
        S[0] = max(S[0], abs(d1))
        S[1] += f * (d1 - d0)
        S[2] += abs(d1 - d0)
        dm = d0
        d0 = d1
        z0[:] = z1
    for i in range(4):
        ext[i] = z0[1 + i]
