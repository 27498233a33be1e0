"""Stepwise simulation of a specimen behind a test rig. Units: mm, kN, s, K. Equations and sources: summary.md."""

import math

import numpy as np

from ..compiled import njit

LAWS = {
    "kelvin_voigt": 0,
    "zener": 1,
    "mgmm": 2,
    "viscous_power": 3,
    "friction": 4,
    "elastic_plastic": 5,
    "bouc_wen": 6,
    "maxwell_power": 7,
}
E_NAMES = (
    "pay_s pay_a pay_m pay_tau pay_form pay_part mul_s mul_c mul_b mul_form deg_s deg_w deg_form "
    "heat_b heat_C heat_tau "
    "factor hard_k hard_u hard_p one_e one_form br_k br_tau ve_c ve_a ve_form ve_v0 fr_F fr_k fr_s "
    "fr_v u0 rig_k rig_gap "
    "crack_f crack_u anc_F anc_jump aT"
).split()
IX = {n: i for i, n in enumerate(E_NAMES)}
NS = 22  # length of the state


def no_effects():
    E = np.zeros(len(E_NAMES))
    E[IX["factor"]] = 1.0
    E[IX["aT"]] = 1.0
    return E


@njit(cache=True, fastmath=False)
def spow(v, a):
    if v == 0.0:
        return 0.0
    return math.copysign(abs(v) ** a, v)


@njit(cache=True)
def bw_slope(z, sg, p):
    az = abs(z)
    zn = az ** p[6] if az > 0.0 else 0.0
    return (p[3] - zn * (p[5] * (sg * z / az if az > 0.0 else 0.0) + p[4])) / p[1]


@njit(cache=True)
def law_force(law, p, s, sn, d, v, dt, aT):
    """Force of the law alone; returns total and its elastic part. s: state before, sn: after."""
    dd = d - s[6]
    if law == 0:
        return p[0] * d + aT * p[1] * v, p[0] * d
    if law == 1:
        x = dt * p[1] / (p[2] * aT)
        e = math.exp(-x)
        sn[0] = s[0] * e + p[1] * dd * (1.0 - e) / x
        return p[0] * d + sn[0], p[0] * d
    if law == 2:  # p: k1 c1 k0 c_NL alpha k_a k_b u_ref c_a c_b v_ref
        sn[1] = max(s[1], d)
        sn[2] = min(s[2], d)
        sn[3] = max(s[3], v)
        sn[4] = min(s[4], v)
        um = 0.5 * (abs(sn[1]) + abs(sn[2]))
        vm = 0.5 * (abs(sn[3]) + abs(sn[4]))
        tau = p[1] / p[0]
        km = p[5] * math.exp(-um / p[7]) + p[6]
        cm = p[8] * math.exp(-vm / p[10]) + p[9]
        el = (p[2] + km) * d
        R = el + aT * ((tau * p[2] + p[1] + cm) * v + p[3] * spow(v, p[4]))
        x = dt / tau
        e = math.exp(-x)
        q = (1.0 - e) / x
        sn[0] = e * s[0] + R * (1.0 - q) + s[5] * (q - e)
        sn[5] = R
        return sn[0], el
    if law == 3:
        return aT * p[0] * spow(v, p[1]), 0.0
    if law == 4:
        m = p[0] * p[1]
        sn[0] = min(max(s[0] + p[2] * dd, -m), m)
        return sn[0], 0.0
    if law == 5:
        m = (1.0 - p[2]) * p[1]
        sn[0] = min(max(s[0] + (1.0 - p[2]) * p[0] * dd, -m), m)
        return p[2] * p[0] * d + sn[0], p[2] * p[0] * d
    if law == 6:  # p: Fy Y alpha A beta gamma n
        # v (A - |z|^n (gamma sgn(v z) + beta)) / Y, integrated along the path (RK4)
        z = s[0]
        sg = 1.0 if dd >= 0.0 else -1.0
        a = bw_slope(z, sg, p)
        b = bw_slope(z + 0.5 * dd * a, sg, p)
        c = bw_slope(z + 0.5 * dd * b, sg, p)
        f = bw_slope(z + dd * c, sg, p)
        sn[0] = z + dd * (a + 2 * b + 2 * c + f) / 6.0
        el = p[2] * p[0] / p[1] * d
        return el + (1.0 - p[2]) * p[0] * sn[0], el
    # maxwell_power: F' = k (v - sgn F (|F|/c)^(1/alpha)), weighted implicit step
    th = 0.55
    ia = 1.0 / p[1]
    F0 = s[0]
    rhs = F0 + p[2] * dd - (1.0 - th) * dt * p[2] * spow(F0 / (aT * p[0]), ia)
    lo, hi = min(rhs, 0.0), max(rhs, 0.0)
    x = F0 if lo <= F0 <= hi else 0.5 * (lo + hi)
    for _ in range(60):
        r = abs(x) / (aT * p[0])
        g = x + th * dt * p[2] * spow(x / (aT * p[0]), ia) - rhs
        if g > 0.0:
            hi = x
        else:
            lo = x
        sl = 1.0 + th * dt * p[2] * ia * (r ** (ia - 1.0)) / (aT * p[0])
        xn = x - g / sl
        if not (lo <= xn <= hi):
            xn = 0.5 * (lo + hi)
        if abs(xn - x) < 1e-10 * (1.0 + abs(F0)):
            x = xn
            break
        x = xn
    sn[0] = x
    return x, 0.0


@njit(cache=True)
def spec(law, p, E, s, sn, d, v, dt):
    """Force of the specimen with its effects at the new deformation d (speed v)."""
    for i in range(NS):
        sn[i] = s[i]
    Fl, Fe = law_force(law, p, s, sn, d, v, dt, E[39])
    dd = d - s[6]
    g = E[16]
    if E[4] > 0.0:  # payne
        if E[4] < 1.5:  # Kraus with an amplitude that fades
            a = max(abs(d), s[10] * math.exp(-dt / E[3]))
            sn[10] = a
            lam = 1.0 / (1.0 + (a / E[1]) ** (2.0 * E[2]))
        else:  # structure kinetics: fast breakdown, slow repair; s[10] is 1 - lambda
            leq = 1.0 / (1.0 + (abs(d) / E[1]) ** (2.0 * E[2]))
            lam0 = 1.0 - s[10]
            r = dt / (0.03 if leq < lam0 else E[3])
            lam = lam0 + (leq - lam0) * (1.0 - math.exp(-r))
            sn[10] = 1.0 - lam
        if E[5] > 0.5:
            Fl -= Fe * E[0] * (1.0 - lam)
        else:
            g *= 1.0 - E[0] * (1.0 - lam)
    if E[9] > 0.0:  # mullins
        um = max(s[11], abs(d))
        sn[11] = um
        if E[9] < 1.5:
            g *= 1.0 - E[6] * math.erf((um * um - d * d) / (E[7] * E[7] + E[8] * um * um))
        else:
            y = um / E[7]
            g *= 1.0 - E[6] * (1.0 - (1.0 - math.exp(-y)) / y if y > 1e-6 else 0.0)
    if E[12] > 0.0:  # degradation by energy or by path
        if E[12] < 1.5:
            g *= 1.0 - E[10] * (1.0 - math.exp(-s[13] / E[11]))
        else:
            g *= 1.0 - E[10] * s[14] / (s[14] + E[11])
    if E[13] != 0.0:  # self-heating
        g *= math.exp(-E[13] * s[15])
    F = g * Fl
    if E[21] > 0.0:
        if E[21] < 1.5:
            if F > 0.0:
                F *= 1.0 + E[20]
        elif E[21] < 2.5:
            F += E[20] * max(d, 0.0)
        elif v > 0.0:
            F *= 1.0 + E[20] * v / (v + 1.0)
    if E[35] != 0.0 and d > E[36]:  # crack that opens (unlisted)
        F *= 1.0 - E[35] * (1.0 - math.exp(-(d - E[36]) / (0.15 * E[36])))
    if E[17] != 0.0:
        x = abs(d) - E[18]
        if x > 0.0:
            F += math.copysign(E[17] * x ** E[19], d)
    if E[22] != 0.0:
        x = dt / E[23]
        e = math.exp(-x)
        sn[8] = s[8] * e + E[22] * dd * (1.0 - e) / x
        F += sn[8]
    if E[26] > 0.0:
        F += E[24] * spow(v, E[25]) if E[26] < 1.5 else E[24] * v / math.sqrt(v * v + E[27] * E[27])
    if E[28] != 0.0:  # Dahl / LuGre with Stribeck
        fc = E[28] * (1.0 + (E[30] * math.exp(-((v / E[31]) ** 2)) if E[30] != 0.0 else 0.0))
        sg = 1.0 if dd >= 0.0 else -1.0
        a = sg * fc
        sn[9] = a + (s[9] - a) * math.exp(-E[29] * abs(dd) / abs(fc))
        F += sn[9]
    sn[12] = s[12] + 0.5 * (F + s[16]) * dd
    sn[13] = max(s[13], sn[12])
    sn[14] = s[14] + abs(dd)
    if E[13] != 0.0:
        sn[15] = (s[15] + max(0.5 * (F + s[16]) * dd, 0.0) / E[14]) * math.exp(-dt / E[15])
    sn[16] = F
    sn[7] = v
    sn[17] = s[6]
    sn[6] = d
    return F


@njit(cache=True)
def rig_force(x, k, gap):
    if gap > 0.0:
        if x > gap:
            return k * (x - gap)
        if x < -gap:
            return k * (x + gap)
        return 0.0
    return k * x


@njit(cache=True)
def run(law, p, E, s, u, v, dt):
    """Force of a test. s is the state at its start (changed: the state at its end)."""
    n = u.size
    F = np.zeros(n)
    sn = np.zeros(NS)
    d0 = u[0] + E[32]
    s[6] = d0
    s[17] = d0
    s[1] = d0
    s[2] = d0
    s[3] = 0.0
    s[4] = 0.0
    if law == 2:
        s[5] = (p[2] + p[5] * math.exp(-abs(d0) / p[7]) + p[6]) * d0
        s[0] = s[5]
    a_now, a_to = 0.0, 0.0
    for i in range(n):
        if E[33] > 0.0:
            # equilibrium of specimen and rig, speed by BDF2, bracketed secant
            k, gap = E[33], E[34]
            d = s[6] + (u[i] - (u[i - 1] if i > 0 else u[0]))
            w = 1e-3 + abs(d - s[6])
            f = spec(law, p, E, s, sn, d, (1.5 * d - 2 * s[6] + 0.5 * s[17]) / dt, dt) - rig_force(u[i] - d, k, gap)
            lo, hi, flo, fhi = d, d, f, f
            j = 0
            while flo > 0.0 and j < 60:
                hi, fhi = lo, flo
                lo -= w
                w *= 2.0
                flo = spec(law, p, E, s, sn, lo, (1.5 * lo - 2 * s[6] + 0.5 * s[17]) / dt, dt) - rig_force(
                    u[i] - lo, k, gap
                )
                j += 1
            while fhi < 0.0 and j < 60:
                lo, flo = hi, fhi
                hi += w
                w *= 2.0
                fhi = spec(law, p, E, s, sn, hi, (1.5 * hi - 2 * s[6] + 0.5 * s[17]) / dt, dt) - rig_force(
                    u[i] - hi, k, gap
                )
                j += 1
            side = 0
            for _ in range(60):
                if fhi - flo == 0.0:
                    break
                d = (lo * fhi - hi * flo) / (fhi - flo)
                if not (lo <= d <= hi):
                    d = 0.5 * (lo + hi)
                f = spec(law, p, E, s, sn, d, (1.5 * d - 2 * s[6] + 0.5 * s[17]) / dt, dt) - rig_force(u[i] - d, k, gap)
                if f > 0.0:
                    hi, fhi = d, f
                    if side == 1:
                        flo *= 0.5
                    side = 1
                else:
                    lo, flo = d, f
                    if side == -1:
                        fhi *= 0.5
                    side = -1
                if hi - lo < 1e-8 or abs(f) < 1e-7 * (1.0 + abs(s[16])):
                    break
            F[i] = spec(law, p, E, s, sn, d, (1.5 * d - 2 * s[6] + 0.5 * s[17]) / dt, dt)
        else:
            vi = v[i]
            if E[37] > 0.0:  # anchorage that slips in jumps (unlisted)
                if abs(s[16]) > E[37] and abs(a_to - a_now) < 0.02 * E[38]:
                    a_to += math.copysign(E[38], s[16])
                da = (a_to - a_now) * (1.0 - math.exp(-dt / 0.02))
                a_now += da
                vi -= da / dt
            F[i] = spec(law, p, E, s, sn, u[i] + E[32] - a_now, vi, dt)
        for j in range(NS):
            s[j] = sn[j]
    return F
