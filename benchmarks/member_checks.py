"""CPU time of the pass of member checks: 510 members, 7 stations, 60 combinations.

Usage: python -m benchmarks.member_checks

Two sets of combinations: 60 different ones of two load cases and two directions, and the 60 rows of a design by EN 1990
and EN 1998-1 with sway and accidental torsion as load cases, of which 36 are different.
"""

from __future__ import annotations

import itertools
from functools import partial

import numpy as np

from benchmarks.timing import cpu_seconds
from edesign.codes.ec3.member import Stability
from edesign.core.member_checks import (
    BEAM_CHECKS,
    MEMBER_CHECKS,
    SECTION_CHECKS,
    Check,
    MemberTable,
    mask,
    member_checks,
)
from edesign.frame.sections.steel_section import steel_section
from edesign.space.checks.steel_member import SteelMember

MEMBERS, STATIONS, BEAMS = 510, 7, 200
SECTION = mask(*SECTION_CHECKS, *MEMBER_CHECKS)

Loads = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray]


def forces(draw: np.random.Generator, cases: int, directions: int) -> tuple[np.ndarray, np.ndarray]:
    """Diagrams like those of frames: loaded beams, columns in double curvature."""
    x = np.linspace(0.0, 1.0, STATIONS)
    bent = np.abs(1.0 - 2.0 * x)
    statics, spectral = np.zeros((cases, MEMBERS, STATIONS, 6)), np.zeros((directions, MEMBERS, STATIONS, 6))
    for case in statics:
        load = draw.uniform(5e3, 12e3, (MEMBERS, 1))
        case[..., 0] = -draw.uniform(0.0, 0.6e6, (MEMBERS, 1))
        case[..., 2] = 3.6 * load * (1.0 - 2.0 * x)
        case[..., 4] = 4.3 * load * (6.0 * x - 6.0 * x**2 - 1.0)
        case[..., 5] = draw.uniform(-5e3, 5e3, (MEMBERS, 1)) * (1.0 - 2.0 * x)
    for response, largest in itertools.product(spectral, (((0, 0.2e6), (1, 10e3), (2, 60e3), (4, 150e3), (5, 10e3)))):
        shape = bent if largest[0] > 3 else 1.0
        response[..., largest[0]] = draw.uniform(0.0, largest[1], (MEMBERS, 1)) * shape
    return statics, spectral


def different() -> Loads:
    """60 different combinations of G, Q and two directions."""
    draw = np.random.default_rng(1)
    factors = draw.uniform(0.3, 1.5, (60, 2))
    directions = draw.choice([0.0, 0.3, 1.0], (60, 2)) * draw.uniform(0.8, 1.2, (60, 1))
    return *forces(draw, 2, 2), factors, directions, directions.any(axis=1).astype(int), np.array([1, 1])


def design() -> Loads:
    """60 rows of G, Q, sway and torsion in two directions: 15 persistent, 32 seismic, 13 of serviceability."""
    statics, spectral = forces(np.random.default_rng(1), 6, 2)
    statics[2:] *= 0.05
    rows: list[tuple[list[float], list[float], int]] = []
    for gravity in ((1.35, 1.5), (1.35, 0.0), (1.0, 1.5)):
        for sway in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)):
            rows.append(([*gravity, *sway, 0, 0], [0, 0], 0))
    for amplified, (x, y) in itertools.product((1, 2), ((1.0, 0.3), (0.3, 1.0))):
        for a, b, t in itertools.product((1, -1), repeat=3):
            torsion = [t, 0] if x > y else [0, t]
            rows.append(([1, 0.3, 0, 0, *torsion], [a * x * amplified, b * y * amplified], amplified))
    rows += [([1, 0.1 * i, 0, 0, 0, 0], [0, 0], 3) for i in range(13)]
    factors, directions, sets = (np.array(x, dtype=float) for x in zip(*rows, strict=True))
    return statics, spectral, factors, directions, sets.astype(int), np.array([1, 1, 0, 0, 0, 0])


def main() -> None:
    """Print the median for each set."""
    beam = SteelMember(steel_section("IPE400"), 275e6, Stability(7.2, 2.4, 2.4), 1, V_M=200e3).constants
    column = SteelMember(steel_section("HEB320"), 275e6, Stability(3.5, 3.5, 3.5), 1).constants
    members = MemberTable.of([beam] * BEAMS + [column] * (MEMBERS - BEAMS))
    masks = np.zeros((MEMBERS, 4), dtype=int)
    masks[:, :3] = SECTION
    masks[:BEAMS, 1] |= mask(*BEAM_CHECKS)
    masks[BEAMS:, 2] |= mask(Check.COLUMN_V)
    for name, loads in (("60 different combinations", different()), ("60 rows of a design", design())):
        milliseconds = 1e3 * cpu_seconds(partial(member_checks, *loads, members, masks), 40)[0]
        print(f"{name}: {milliseconds:.2f} ms")


if __name__ == "__main__":
    main()
