"""How far edesign and OpenSeesPy differ on the thesis frame; prints the tables of docs/verification/overview.md.

Usage: python -m benchmarks.agreement
"""

from __future__ import annotations

import numpy as np

from benchmarks.peers import edesign_frame, opensees_frame
from benchmarks.peers.frame_data import PeerFrame, thesis_frame
from benchmarks.records import el_centro


def row(quantity: str, unit: str, theirs: float, ours: float) -> str:
    """One line of the table."""
    difference = f"{ours - theirs:+.2g} {unit}" if theirs == 0.0 else f"{100 * (ours / theirs - 1):+.4f} %"
    return f"| {quantity} ({unit}) | {theirs:.7g} | {ours:.7g} | {difference} |"


def compare(frame: PeerFrame) -> None:
    """Periods, pushover and El Centro at two levels."""
    print(f"\n### {frame.title}\n\n| quantity | OpenSeesPy | edesign | difference |\n|---|---|---|---|")
    states = ("bare", "under gravity")
    both = zip(states, opensees_frame.periods(frame, 1), edesign_frame.periods(frame, 1), strict=True)
    for state, theirs, ours in both:
        print(row(f"T1 {state}", "s", theirs[0], ours[0]))
    curve, peer = edesign_frame.pushover(frame), opensees_frame.pushover(frame)
    print(row("largest base shear, pushover to 2 %", "kN", np.max(peer[1]) / 1e3, np.max(curve[1]) / 1e3))
    worst = np.max(np.abs(curve[1] - peer[1])) / np.max(peer[1])
    print(f"| largest difference along the pushover, of the largest base shear | | | {100 * worst:.4f} % |")
    for pga in (None, 0.414):
        level = "El Centro" if pga is None else f"El Centro {pga} g"
        acceleration, dt = el_centro(pga)
        theirs_ = opensees_frame.history(frame, acceleration, dt)
        ours_, _ = edesign_frame.history(frame, acceleration, dt)
        drift = max(ours_.peak(f"drift_{floor}") for floor in range(1, frame.n_storeys + 1))
        print(row(f"{level}: roof displacement", "m", theirs_.roof_displacement, ours_.peak("roof")))
        print(row(f"{level}: interstorey drift", "%", 100 * theirs_.interstorey_drift, 100 * drift))
        print(row(f"{level}: base shear", "kN", theirs_.base_shear / 1e3, ours_.peak("base_shear") / 1e3))
        print(row(f"{level}: roof acceleration", "m/s2", theirs_.roof_acceleration, ours_.peak("roof_acceleration")))
        print(row(f"{level}: roof at the end", "mm", 1e3 * theirs_.residual, 1e3 * ours_.final["roof"]))


if __name__ == "__main__":
    for bays in (3, 4):
        compare(thesis_frame(bays))
