"""Histories of buildings in three dimensions, side by side with OpenSeesPy in one run: CPU time and peaks.

Both have the same fibres, the same loads and masses, P-Delta in both planes, and begin after gravity. Only the
integration loop is timed, CPU time of the one thread that computes; edesign samples nothing in it. OpenSees is given
the fastest of the settings that find equilibrium to edesign's tolerance (`opensees_building.FASTEST`).

With --growth edesign alone: cost a step and memory of a process from 4 to 40 storeys.

Usage: python -m benchmarks.building_histories [--growth] [--case NAME] [--laws LAW ...] [--pga G ...]
    [--seconds S] [--repeats N] [--save FOLDER]
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import subprocess
import sys
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np  # noqa: E402

from benchmarks.peers import edesign_building  # noqa: E402
from benchmarks.peers.building_cases import irregular_building, office_building, thesis_building  # noqa: E402
from benchmarks.peers.building_data import Array, BuildingHistory, Law, PeerBuilding  # noqa: E402
from benchmarks.records import el_centro_pair  # noqa: E402
from benchmarks.timing import timed  # noqa: E402

CASES = {"thesis": thesis_building, "office": office_building, "irregular": irregular_building}
LAWS: tuple[Law, ...] = ("bilinear", "menegotto_pinto")
PGA = (0.36, 0.6)  # g, of the larger component
STOREYS = (4, 10, 20, 40)


def core_run(building: PeerBuilding, motion: tuple[Array, Array], dt: float) -> float:
    """CPU seconds a step of edesign."""
    history = edesign_building.history(building, motion, dt, sampled=False)
    return history.cpu_s / history.steps


def thesis_history() -> None:
    """20 s of the thesis building at 0.6 g, for the memory that a process with it takes."""
    core_run(thesis_building(), *el_centro_pair(0.6, 20.0))


def tall_history(storeys: int, law: Law, pga: float, seconds: float, repeats: int) -> None:
    """Print as JSON the members of a building, ms a step, and MB of this process."""
    building = replace(thesis_building(storeys), steel=law)
    motion, dt = el_centro_pair(pga, seconds)
    milliseconds = timed(lambda: core_run(building, motion, dt), repeats).milliseconds
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (1024 if sys.platform != "darwin" else 1024**2)
    cost = edesign_building.history(building, motion, dt, sampled=False).cost
    print(json.dumps([len(building.members), milliseconds, peak, cost]))


def growth(laws: Iterable[Law], pga: float, seconds: float, repeats: int) -> None:
    """Print cost a step and memory against the number of storeys; each building has a process of its own."""
    for law in laws:
        print(f"\nGrowth with size, {law}, {seconds:g} s of El Centro in two components at {pga:g} g")
        sizes = []
        for storeys in STOREYS:
            code = (
                "from benchmarks.building_histories import tall_history; "
                f"tall_history({storeys}, {law!r}, {pga}, {seconds}, {repeats})"
            )
            found = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
            members, milliseconds, peak, cost = json.loads(found.stdout)
            sizes.append((members, milliseconds))
            share = 1e3 * milliseconds / members
            print(
                f"  {storeys:3d} storeys  {members:5d} members  {milliseconds:8.4f} ms a step  {share:7.3f} us a member"
            )
            print(f"               {peak:.0f} MB; {cost}", flush=True)
        size, price = np.log(np.array(sizes)).T
        ends, slope = (price[-1] - price[0]) / (size[-1] - size[0]), np.polyfit(size, price, 1)[0]
        print(f"  power: {ends:.2f} between the ends, {slope:.2f} fitted")


def side_by_side(building: PeerBuilding, pga: float, seconds: float, repeats: int) -> dict[str, BuildingHistory]:
    """Print both times, their ratio and the peaks; the histories by program."""
    motion, dt = el_centro_pair(pga, seconds)
    name = f"{building.title}, {len(building.members)} members, {building.steel}"
    print(f"\n{name}, El Centro in two components, {pga:g} g, {seconds:g} s", flush=True)

    core_run(building, motion, dt)  # warms caches
    time = timed(lambda: core_run(building, motion, dt), repeats)
    found = {"edesign": edesign_building.history(building, motion, dt)}
    if found["edesign"].status != "completed":
        raise SystemExit(f"edesign: {found['edesign'].status} after {found['edesign'].steps} steps")
    spread = f"(median of {time.repeats}, spread {100 * time.spread:.0f} %)"
    print(f"  edesign      {time.milliseconds:8.4f} ms a step {spread}")
    print(f"               {found['edesign'].cost}", flush=True)
    try:
        from benchmarks.peers import opensees_building
    except ImportError:
        print("  OpenSeesPy   not installed: no ratio (pip install 'edesign[peers]')")
        return found
    options = opensees_building.BuildingOptions()
    found["OpenSeesPy"] = peer = opensees_building.history(building, motion, dt, options)
    solver = options.solver
    settings = f"{solver.system}, {' '.join(map(str, solver.algorithm))}, {solver.test} {solver.tolerance:g}"
    milliseconds = 1e3 * peer.cpu_s / max(1, peer.steps)
    print(f"  OpenSeesPy   {milliseconds:8.4f} ms a step ({settings}; {peer.status} after {peer.steps} steps)")
    print(f"               {peer.cost}")
    print(f"  ratio        {milliseconds / time.milliseconds:8.1f}")
    if peer.status == "completed":
        _peaks(building, found["edesign"], peer)
    return found


def _peaks(building: PeerBuilding, ours: BuildingHistory, theirs: BuildingHistory) -> None:
    """Print periods, peaks, and how far histories are apart."""
    rows = {
        f"T{k + 1} under gravity, s": (a, b) for k, (a, b) in enumerate(zip(ours.loaded, theirs.loaded, strict=True))
    }
    both = ours.peaks(building), theirs.peaks(building)
    rows |= {name: (both[0][name], both[1][name]) for name in both[0]}
    print(f"  {'':47}{'edesign':>14}{'OpenSeesPy':>14}{'difference':>13}")
    for name, (a, b) in rows.items():
        print(f"  {name:47}{a:14.6f}{b:14.6f}{100.0 * (a / b - 1.0):+11.5f} %")
    apart = np.abs(ours.floors - theirs.floors).max(axis=(0, 1))
    print(f"  floors at any time apart by {1e3 * apart[0]:.2g} mm, {1e3 * apart[1]:.2g} mm, {1e3 * apart[2]:.2g} mrad")


def save(file: Path, history: BuildingHistory) -> None:
    """Keep a history as arrays with the names of its attributes."""
    file.parent.mkdir(parents=True, exist_ok=True)
    arrays: dict[str, Any] = {name: np.asarray(value) for name, value in vars(history).items()}
    np.savez_compressed(file, **arrays)


def run(
    case: str,
    levels: Iterable[float],
    seconds: float,
    repeats: int,
    laws: Iterable[Law] = LAWS,
    folder: Path | None = None,
) -> None:
    """Print a case with each law at each level (g), and save the histories into a folder."""
    for law in laws:
        building = replace(CASES[case](), steel=law)
        for pga in levels:
            found = side_by_side(building, pga, seconds, repeats)
            if folder is not None:
                for program, history in found.items():
                    save(folder / f"{case}_{law}_{pga:g}g_{program}.npz", history)


def main() -> None:
    """Run all of it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--laws", choices=LAWS, nargs="+", default=LAWS)
    parser.add_argument("--case", choices=CASES, default="thesis")
    parser.add_argument("--pga", type=float, nargs="+", default=PGA, help="of the larger component, in g")
    parser.add_argument("--seconds", type=float, default=20.0, help="of the recording (default 20)")
    parser.add_argument("--repeats", type=int, default=5, help="of edesign's histories (default 5)")
    parser.add_argument("--save", type=Path, help="folder for the histories as NPZ")
    parser.add_argument(
        "--growth", action="store_true", help="from 4 to 40 storeys, without the peer, at the last --pga"
    )
    arguments = parser.parse_args()
    if arguments.growth:
        growth(arguments.laws, arguments.pga[-1], arguments.seconds, arguments.repeats)
        return
    run(arguments.case, arguments.pga, arguments.seconds, arguments.repeats, arguments.laws, arguments.save)


if __name__ == "__main__":
    main()
