"""Forces N, M_y, M_z of full plasticity of sections as they are drawn, and of their fibres, for a unit yield stress.

A drawing is a quarter of a doubly symmetric section in n columns along z: (4, n) places y, widths, which are negative
in a hole, and z of the lower and the upper end, m. Integrals along y are those of Gauss and Legendre, along z in closed
form. Nothing of it comes from edesign.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np

_GAUSS, _WEIGHTS = np.polynomial.legendre.leggauss(12)
_PIECES = 12

Drawing = np.ndarray


def drawn_i(h: float, b: float, tw: float, tf: float, r: float) -> Drawing:
    """Half height by half width of an I section with circular fillets of radius r."""
    clear = 0.5 * h - tf
    web = _columns(0.0, 0.5 * tw, lambda y: 0.0 * y, 0.5 * h)
    outstand = _columns(0.5 * tw + r, 0.5 * b, lambda y: clear + 0.0 * y, 0.5 * h)
    if r == 0.0:
        return np.hstack([web, outstand])
    angles, turns = _pieces(0.0, 0.5 * math.pi)
    lower = clear - r * (1.0 - np.sin(angles))
    fillet = [0.5 * tw + r * (1.0 - np.cos(angles)), turns * r * np.sin(angles), lower, np.full(angles.size, 0.5 * h)]
    return np.hstack([web, fillet, outstand])


def drawn_tube(h: float, b: float, t: float, outer: float, inner: float) -> Drawing:
    """A rectangular hollow section with its outer and inner radius of the corners."""
    return np.hstack([_rounded(h, b, outer, 1.0), _rounded(h - 2.0 * t, b - 2.0 * t, inner, -1.0)])


def drawn_ring(d: float, t: float) -> Drawing:
    """A circular hollow section."""
    return drawn_tube(d, d, t, 0.5 * d, 0.5 * d - t)


def moments(drawing: Drawing) -> tuple[float, float, float, float, float]:
    """A, I_y, I_z, W_pl_y and W_pl_z of a drawing."""
    y, width, low, high = drawing
    area, first = width * (high - low), 0.5 * width * (high**2 - low**2)
    second = width * (high**3 - low**3) / 3.0
    A, I_y, I_z, W_y, W_z = (4.0 * float(np.sum(of)) for of in (area, second, area * y**2, first, area * y))
    return A, I_y, I_z, W_y, W_z


def plastic_work(drawing: Drawing, e0: float, kappa_y: float, kappa_z: float) -> float:
    """Integral of |e0 - kappa_z y + kappa_y z| over a section: the support function of the surface N, M_y, M_z."""
    y, width, low, high = drawing
    total = 0.0
    for side in (-1.0, 1.0):
        at_middle = e0 - kappa_z * side * y
        for up in (-1.0, 1.0):
            one, other = at_middle + kappa_y * up * low, at_middle + kappa_y * up * high
            if abs(kappa_y) < 1e-9:
                total += np.sum(width * abs(at_middle) * (high - low))
            else:
                total += np.sum(width * (other * abs(other) - one * abs(one)) / (2.0 * kappa_y * up))
    return float(total)


def directions(drawing: Drawing, turns: int = 13, steps: int = 40) -> Iterator[tuple[float, float, float]]:
    """Strains e0, kappa_y, kappa_z of all neutral axes that meet a section, by symmetry for one quarter of them."""
    for angle in np.linspace(0.0, 0.5 * math.pi, turns):
        kappa_y, kappa_z = math.cos(angle) / drawing[3].max(), math.sin(angle) / drawing[0].max()
        for share in np.linspace(0.0, 1.0, steps):
            yield share * (math.cos(angle) + math.sin(angle)), kappa_y, kappa_z


def _pieces(start: float, end: float) -> tuple[np.ndarray, np.ndarray]:
    """Places and weights of Gauss and Legendre in pieces of an interval."""
    edges = np.linspace(start, end, _PIECES + 1)
    half = 0.5 * (edges[1] - edges[0])
    return (edges[:-1, None] + half * (1.0 + _GAUSS)).ravel(), np.tile(half * _WEIGHTS, _PIECES)


def _columns(start: float, end: float, low: Callable[[np.ndarray], np.ndarray], high: float) -> Drawing:
    y, widths = _pieces(start, end)
    return np.array([y, widths, low(y), np.full(y.size, high)])


def _rounded(h: float, b: float, r: float, sign: float) -> Drawing:
    """A quarter of a rectangle with rounded corners, of negative width where it is a hole."""
    flat = _columns(0.0, 0.5 * b - r, lambda y: 0.0 * y, 0.5 * h)
    angles, turns = _pieces(0.0, 0.5 * math.pi)
    high = 0.5 * h - r * (1.0 - np.cos(angles))
    corner = [0.5 * b - r * (1.0 - np.sin(angles)), turns * r * np.cos(angles), 0.0 * angles, high]
    found = np.hstack([flat, corner])
    found[1] *= sign
    return found
