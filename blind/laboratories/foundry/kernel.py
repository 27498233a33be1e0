"""Steps of what laws and effects are made of: relaxation, elastic limits, things in series, friction over a way."""

import math

import numpy as np
from scipy.signal import lfilter


def relax(x, tau, h, x0=0.0):
    """y + tau y' = x, x linear between samples, exact."""
    e = math.exp(-h / tau)
    w1 = 1 - (1 - e) * tau / h
    w0 = (1 - e) - w1
    y0 = x0
    b, a = [w1, w0], [1, -e]
    zi = np.array([y0 - w1 * x[0]])
    # start so that y[0] = x0
    y, _ = lfilter(b, a, x, zi=zi)
    return y


def rk4(fun, y, xs, h, out):
    """Scalar equation y' = fun(y, u, v); xs: u and v at grid and half-way points; out(y, u, v) is the force."""
    u, v = xs
    F = [out(y, u[0], v[0])]
    for i in range(0, len(u) - 2, 2):
        um, vm, u1, v1 = u[i + 1], v[i + 1], u[i + 2], v[i + 2]
        k1 = fun(y, u[i], v[i])
        k2 = fun(y + 0.5 * h * k1, um, vm)
        k3 = fun(y + 0.5 * h * k2, um, vm)
        k4 = fun(y + h * k3, u1, v1)
        y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        F.append(out(y, u1, v1))
    return np.array(F)


def halves(kin):
    t = kin.t[0] + np.arange(2 * len(kin.t) - 1) * kin.h / 2
    return kin.spline(t).tolist(), kin.spline(t, 1).tolist()


def bilinear_path(kin, k, limit, z0=0.0):
    """Elastic, perfectly plastic force along the path."""
    u, where = kin.path()
    q, x = z0, u[0]
    Q = [q]
    for y in u[1:]:
        q += k * (y - x)
        if q > limit:
            q = limit
        elif q < -limit:
            q = -limit
        x = y
        Q.append(q)
    return np.array(Q)[where]


def deadzone(series):
    """Force of the element in series against its stretch e, and its slope."""
    K, g, e0 = series["K"], series.get("gap", 0.0), series.get("e0", 0.0)
    if g:
        w, half = 0.06 * g, 0.5 * g

        def sp(x):
            x /= w
            return w * (x if x > 30 else (math.exp(x) if x < -30 else math.log1p(math.exp(x))))

        def sg(x):
            x /= w
            return 1.0 if x > 30 else (math.exp(x) if x < -30 else 1 / (1 + math.exp(-x)))

        return (lambda e: K * (sp(e - half) - sp(-e - half))), (lambda e: K * (sg(e - half) + sg(-e - half)))
    if e0:
        return (lambda e: K * e * (1 + (e / e0) ** 2)), (lambda e: K * (1 + 3 * (e / e0) ** 2))
    return (lambda e: K * e), (lambda e: K)


def softplus(x):
    return np.logaddexp(0.0, x)


def dahl(kin, x0, power):
    """Friction over a way x0 after each reversal: dz = (1 - sgn z)^power du / x0, exact in each piece."""
    u, where = kin.path()
    z, x, Z = 0.0, u[0], [0.0]
    for y in u[1:]:
        d = y - x
        x = y
        if d:
            s = 1.0 if d > 0 else -1.0
            w = 1 - s * z
            if w > 0:
                if power == 1:
                    w *= math.exp(-abs(d) / x0)
                else:
                    w = (w ** (1 - power) + (power - 1) * abs(d) / x0) ** (1 / (1 - power))
            z = s * (1 - w)
        Z.append(z)
    return np.array(Z)[where]
