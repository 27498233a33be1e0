"""Time and effort of `edesign calibrate` for blind campaigns, one at a time, as a user runs it, with the report.

The effort is the number of weighted predictions, the same on every machine; beside it stands the CPU time of one.

What stands in series with the damper costs most: `--effects play series_flexibility` asks for such campaigns alone.

Usage: python -m benchmarks.calibration [--number 23] [--every 2] [--seed 1] [--effects play series_flexibility]
       [--folder build/blind_bench]
"""

from __future__ import annotations

import argparse
import resource
import statistics
import tempfile
from pathlib import Path

from blind.effects import EFFECTS
from blind.generate import generate
from blind.plan import KINDS, plan
from blind.run import calibrate, result

BAR = 60.0  # s


def main() -> None:
    """Print a line for each campaign, and their median."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.calibration", description=__doc__)
    parser.add_argument("--number", type=int, default=23, help="campaigns planned (23: one round of all kinds)")
    parser.add_argument("--every", type=int, default=2, help="so manieth of them is run, from the first one on")
    parser.add_argument("--seed", type=int, default=1, help="of everything")
    parser.add_argument("--effects", nargs="+", choices=tuple(EFFECTS), help="one of these is hidden in each; any")
    parser.add_argument("--folder", type=Path, help="for campaigns and results; not kept unless given")
    chosen = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = chosen.folder or Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        print("campaign  tests  wall, s  CPU, s  effort  ms each  hidden -> found (verdict)")
        walls = []
        kinds = ("one",) if chosen.effects else KINDS
        for planned in plan(chosen.number, chosen.seed, kinds, chosen.effects or tuple(EFFECTS))[:: chosen.every]:
            place = generate(planned, chosen.seed, folder)
            before = _cpu()
            outcome = calibrate(place, again=True)
            found = result(place) or {"effects": [], "verdict": outcome["failure"]}
            hidden = " + ".join(name for name, _ in planned.effects) or "nothing"
            names = " + ".join(effect["name"] for effect in found["effects"]) or "nothing"
            tests, wall = len([*place.glob("*.csv")]), outcome["seconds"]
            effort = found.get("coverage", {}).get("effort", 0.0)
            cpu = _cpu() - before
            walls.append(wall)
            print(
                f"{planned.name:8}  {tests:5}  {wall:7.1f}  {cpu:6.1f}  {effort:6.0f}  "
                f"{1e3 * cpu / max(effort, 1.0):7.1f}  {hidden} -> {names} ({found['verdict']})",
                flush=True,
            )
    below = sum(wall < BAR for wall in walls)
    print(
        f"median {statistics.median(walls):.1f} s, longest {max(walls):.1f} s, {below} of {len(walls)} below {BAR:g} s"
    )


def _cpu() -> float:
    """CPU time of the processes that have ended, s."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


if __name__ == "__main__":
    main()
