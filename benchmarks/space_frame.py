"""CPU of whole elastic analyses of buildings in space: the thesis building, and one of 20 storeys by 8 by 6 bays.

One analysis is: two static cases with loads on the beams, 27 natural modes with all member forces, and the combination
(CQC) of all internal forces at three stations under ground motion along x and along y. It is timed from the arrays of a
frame on, and once more for new sections of a frame that is there, as a design loop asks.

Usage: python -m benchmarks.space_frame [--repeats N]
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable
from dataclasses import dataclass
from math import inf

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np  # noqa: E402

from benchmarks.timing import cpu_seconds  # noqa: E402
from edesign.core.space import PROPERTIES, SpaceMembers, SpaceModel, combine_internal  # noqa: E402

BAY, HEIGHT = 7.2, 3.5  # m
E, NU = 210e9, 0.3
FLOOR_MASS = (362.9e3, 362.9e3, 362.9e3, 361.9e3, 359.6e3, 359.6e3, 359.1e3, 357.5e3, 357.5e3, 353.0e3)  # kg
TABLE_5_3 = (2.651286, 0.973412, 0.923146, 0.747592, 0.51529, 0.32702, 0.320467, 0.248166, 0.232642)  # s
COUNT, STATIONS = 27, (0.0, 0.5, 1.0)

# h, b, t_w, t_f, r (mm) of EN 10365
PROFILES = {
    "HEB450": (450, 300, 14, 26, 27),
    "HEB360": (360, 300, 12.5, 22.5, 27),
    "HEB320": (320, 300, 11.5, 20.5, 27),
    "IPE400": (400, 180, 8.6, 13.5, 21),
    "IPE360": (360, 170, 8.0, 12.7, 18),
    "IPE330": (330, 160, 7.5, 11.5, 18),
}
# lower, middle and upper storeys; beams along x one size lighter than in Table 5.2 (its periods belong to these)
COLUMNS, BEAMS_X = ("HEB450", "HEB360", "HEB320"), ("IPE400", "IPE360", "IPE330")
BRACES = (74.93e-4, 66.93e-4, 58.93e-4)  # m2: SHS 200, 180, 160 x 10


def rolled(name: str) -> tuple[float, ...]:
    """E, G, A, A_y, A_z, I_t, I_y, I_z of an I section in SI; the fillets count in A and I_y."""
    h, b, t_w, t_f, r = (1e-3 * v for v in PROFILES[name])
    web, fillet = h - 2.0 * t_f, (1.0 - np.pi / 4.0) * r**2
    # the fillet's centre is 0.2234 r from the corner between web and flange
    A = 2.0 * b * t_f + web * t_w + 4.0 * fillet
    I_y = (b * h**3 - (b - t_w) * web**3) / 12.0 + 4.0 * fillet * (web / 2.0 - 0.2234 * r) ** 2
    I_z = (2.0 * t_f * b**3 + web * t_w**3) / 12.0
    I_t = (2.0 * b * t_f**3 + web * t_w**3) / 3.0
    return E, E / 2.6, A, 2.0 * b * t_f / 1.2, h * t_w, I_t, I_y, I_z


@dataclass
class Building:
    """A regular frame with rigid diaphragms: arguments of SpaceModel and what acts on it."""

    coordinates: np.ndarray
    node_floor: np.ndarray
    masters: np.ndarray
    fixed: np.ndarray
    members: SpaceMembers
    node_mass: np.ndarray
    uniform: np.ndarray

    def model(self) -> SpaceModel:
        """A new model of it."""
        n, m = len(self.coordinates), self.members.count
        names = [f"N{i}" for i in range(n)], [f"M{i}" for i in range(m)]
        springs = np.zeros((n, 6))
        return SpaceModel(self.coordinates, self.node_floor, self.masters, self.fixed, springs, self.members, *names)


def building(bays_x: int, bays_y: int, storeys: int) -> Building:
    """A frame whose beams along x are rigid and those along y on hinges, a diagonal in each bay of both end frames."""
    nx, ny = bays_x + 1, bays_y + 1
    grid = np.arange((storeys + 1) * ny * nx).reshape(storeys + 1, ny, nx)
    k, j, i = np.meshgrid(np.arange(storeys + 1), np.arange(ny), np.arange(nx), indexing="ij")
    coordinates = np.stack([BAY * i, BAY * j, HEIGHT * k], axis=-1).reshape(-1, 3).astype(float)
    start, end, web, ends, section, bar, load = [], [], [], [], [], [], []

    def add(a: int, b: int, direction: tuple[int, int, int], hinged: bool, values: tuple[float, ...], q: float) -> None:
        start.append(a)
        end.append(b)
        web.append(direction)
        ends.append([0.0 if hinged else inf] * 4)
        section.append(values)
        bar.append(False)
        load.append(q)

    for s in range(1, storeys + 1):
        third = 0 if s <= 0.4 * storeys else 1 if s <= 0.7 * storeys else 2
        for y in range(ny):
            for x in range(nx):
                add(grid[s - 1, y, x], grid[s, y, x], (1, 0, 0), False, rolled(COLUMNS[third]), 0.0)
                if x < bays_x:
                    add(grid[s, y, x], grid[s, y, x + 1], (0, 0, 1), False, rolled(BEAMS_X[third]), -23e3)
                if y < bays_y:
                    add(grid[s, y, x], grid[s, y + 1, x], (0, 0, 1), True, rolled("IPE360"), -5e3)
        for x in (0, bays_x):
            for y in range(bays_y):
                low, high = (y, y + 1) if (s + y) % 2 else (y + 1, y)
                add(grid[s - 1, low, x], grid[s, high, x], (1, 0, 0), True, (E, 1.0, BRACES[third], 0, 0, 1, 1, 1), 0.0)
                bar[-1] = True
    n = len(coordinates)
    fixed = np.zeros((n, 6), dtype=bool)
    fixed[: nx * ny] = True
    share = np.ones((ny, nx))
    share[[0, -1]] *= 0.5
    share[:, [0, -1]] *= 0.5
    mass = np.zeros((storeys + 1, ny, nx))
    for s in range(1, storeys + 1):
        mass[s] = FLOOR_MASS[(s - 1) * 10 // storeys] * share / share.sum()
    uniform = np.zeros((2, len(start), 3))
    uniform[:, :, 2] = np.outer([1.0, 0.4], load)
    columns = dict(zip(PROPERTIES, np.array(section, dtype=float).T, strict=True))
    members = SpaceMembers(
        np.array(start), np.array(end), np.array(web, float), **columns, ends=np.array(ends), axial_only=np.array(bar)
    )
    masters = np.tile([BAY * bays_x / 2.0, BAY * bays_y / 2.0], (storeys, 1))
    return Building(
        coordinates, np.repeat(np.arange(-1, storeys), nx * ny), masters, fixed, members, mass.ravel(), uniform
    )


def correlation(omega: np.ndarray, damping: float) -> np.ndarray:
    """CQC coefficients of modes of equal damping (Wilson, Der Kiureghian & Bayo 1981)."""
    r = omega[:, None] / omega
    return np.asarray(
        8.0 * damping**2 * (1.0 + r) * r**1.5 / ((1.0 - r**2) ** 2 + 4.0 * damping**2 * r * (1.0 + r) ** 2)
    )


def analyse(model: SpaceModel, b: Building) -> np.ndarray:
    """Static cases, modes, combination; the periods."""
    static = model.static(uniform=b.uniform)
    model.internal(static.end_forces, STATIONS, uniform=b.uniform)
    modes = model.modes(b.node_mass, COUNT)
    rho = correlation(modes.omega, 0.05)
    acceleration = np.minimum(3.0, 1.5 / modes.period)
    for direction in (0, 1):
        ordinate = modes.participation[:, direction] * acceleration / modes.omega**2
        combine_internal(modes.end_forces, ordinate[:, None] * rho * ordinate, STATIONS)
    return modes.period


def report(title: str, b: Building, repeats: int) -> None:
    """Print what one analysis of a building costs."""
    model = b.model()
    members = np.arange(b.members.count)
    properties = np.stack([getattr(b.members, name) for name in PROPERTIES], axis=1)
    modes = model.modes(b.node_mass, COUNT)
    calls: dict[str, Callable[[], object]] = {
        "whole analysis from arrays": lambda: analyse(b.model(), b),
        "analysis with new sections": lambda: (model.change_sections(members, properties), analyse(model, b)),
        "  model from arrays": b.model,
        "  new sections, factors": lambda: model.change_sections(members, properties),
        "  2 static cases": lambda: model.static(uniform=b.uniform),
        f"  {COUNT} modes, member forces": lambda: model.modes(b.node_mass, COUNT),
        "  CQC, one direction": lambda: combine_internal(modes.end_forces, np.eye(COUNT), STATIONS),
        "  critical factor": lambda: model.critical_factor(np.where(b.members.web[:, 0] == 1, -1e5, 0.0)),
    }
    print(
        f"\n{title}: {model.n_equations} equations, {model.n_members} members, {model.n_nonzeros} values of stiffness"
    )
    for name, call in calls.items():
        middle, spread = cpu_seconds(call, repeats)
        print(f"  {name:32s}{1e3 * middle:8.2f} ms{100 * spread:6.0f} %")


def main() -> None:
    """Run all of it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeats", type=int, default=21, help="of each call (default 21)")
    repeats = parser.parse_args().repeats
    thesis = building(4, 3, 10)
    report("Thesis building, 4 x 3 bays, 10 storeys", thesis, repeats)
    period = analyse(thesis.model(), thesis)
    error = 100.0 * (period[: len(TABLE_5_3)] / TABLE_5_3 - 1.0)
    print("  periods against Table 5.3 of the thesis, %: " + " ".join(f"{e:+.1f}" for e in error))
    report("8 x 6 bays, 20 storeys", building(8, 6, 20), max(3, repeats // 3))


if __name__ == "__main__":
    main()
