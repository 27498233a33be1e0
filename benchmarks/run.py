"""Side by side with OpenSeesPy in one run: CPU time of the same histories, medians, ratio. `make bench`.

Neither side samples anything inside the loop. OpenSees is given its fastest solver and test for each frame (chosen here
by trial, unless --quick) and its fibres merged into the same 24 layers; edesign runs at its default tolerance. Only the
integration loop is timed, CPU time of the one thread that computes. Of the building in three dimensions peaks are
compared as well (benchmarks/building_histories.py).

Usage: python -m benchmarks.run [--quick] [--repeats N]
"""

from __future__ import annotations

import argparse
import math
import os
import resource
import subprocess
import sys
from dataclasses import replace

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np  # noqa: E402

from benchmarks.peers import edesign_frame  # noqa: E402
from benchmarks.peers.frame_data import MENEGOTTO_PINTO, PeerFrame, tall_frame, thesis_frame  # noqa: E402
from benchmarks.records import el_centro  # noqa: E402
from benchmarks.timing import describe, timed  # noqa: E402
from edesign.core import MenegottoPinto, Response, Steel  # noqa: E402

SOLVERS = ("BandGeneral", "SparseSYM", "UmfPack")
TESTS = (("NormDispIncr", 1e-6), ("EnergyIncr", 1e-8))
PGA = 0.414  # g


def core_run(
    frame: PeerFrame,
    seconds: float | None,
    keep: list[Response] | None = None,
    pga: float = PGA,
    law: Steel | None = None,
) -> float:
    """CPU seconds a step of edesign; `law` of the fibres, None for the frame's bilinear one."""
    acceleration, dt = el_centro(pga)
    count = acceleration.size if seconds is None else round(seconds / dt) + 1
    response, _ = edesign_frame.history(frame, acceleration[:count], dt, sampled=False, law=law)
    if response.status != "completed":
        raise SystemExit(f"{frame.title}: edesign: {response.reason}")
    if keep is not None:
        keep.append(response)
    return response.statistics["cpu_s"] / response.statistics["steps"]


def curved_law(frame: PeerFrame) -> Steel:
    """The law of Menegotto & Pinto with the frame's strength and hardening."""
    return MenegottoPinto(frame.E, frame.fy, frame.hardening, *MENEGOTTO_PINTO)


def side_by_side(frame: PeerFrame, seconds: float | None, repeats: int, quick: bool, curved: bool = False) -> None:
    """Print both times and their ratio; `curved`: with the law of Menegotto & Pinto, in OpenSees Steel02."""
    kept: list[Response] = []
    law = curved_law(frame) if curved else None
    core_run(frame, seconds, law=law)  # warms caches
    ours = timed(lambda: core_run(frame, seconds, kept, law=law), max(5, repeats))
    name = f"{frame.title}, Menegotto-Pinto" if curved else frame.title
    print(f"\n{name}, El Centro at {PGA} g, {seconds or 'all'} s, dt 0.01 s")
    spread = f"(median of {ours.repeats}, spread {100 * ours.spread:.0f} %)"
    print(f"  edesign      {ours.milliseconds:8.4f} ms a step {spread}")
    print(f"               {describe(kept[-1])}")
    try:
        from benchmarks.peers import opensees_frame
    except ImportError:
        print("  OpenSeesPy   not installed: no ratio (pip install 'edesign[peers]')")
        return
    acceleration, dt = el_centro(PGA)
    steps = None if seconds is None else round(seconds / dt)

    def theirs(solver: opensees_frame.SolverOptions, count: int | None) -> float:
        result = opensees_frame.benchmark_history(frame, acceleration, dt, steel, solver, steps=count)
        return result.cpu_s / result.steps

    # without hardening ElasticPP is the quicker of its two laws, with the same answers
    steel = opensees_frame.ModelOptions(steel="Steel02" if curved else "Steel01" if frame.hardening else "ElasticPP")
    options = [opensees_frame.SolverOptions(system=s, test=t, tolerance=tol) for s in SOLVERS for t, tol in TESTS]
    if quick:
        best = options[0]
    else:
        costs = [theirs(option, 300) for option in options]
        best = options[costs.index(min(costs))]
    peer = timed(lambda: theirs(best, steps), repeats)
    spread = f"median of {peer.repeats}, spread {100 * peer.spread:.0f} %"
    choice = f"{best.system}, {best.test} {best.tolerance:g}"
    print(f"  OpenSeesPy   {peer.milliseconds:8.4f} ms a step ({spread}; {choice})")
    print(f"  ratio        {peer.milliseconds / ours.milliseconds:8.1f}")


def pushovers(frame: PeerFrame) -> None:
    """Print what a step of a pushover costs with each law."""
    print(f"\n{frame.title}, pushover to 2 % in 200 steps")
    for name, law in (("bilinear", None), ("Menegotto-Pinto", curved_law(frame))):
        kept: list[Response] = []

        def step(law: Steel | None = law, kept: list[Response] = kept) -> float:
            kept.append(edesign_frame.pushover_response(frame, law=law))
            return kept[-1].statistics["cpu_s"] / kept[-1].statistics["steps"]

        cost = timed(step, 5)
        print(f"  {name:15}  {cost.milliseconds:8.4f} ms a step (median of 5, spread {100 * cost.spread:.0f} %)")
        print(f"               {describe(kept[-1])}")


def growth(repeats: int, seconds: float, pga: float) -> None:
    """Cost a step against the number of elements, from 10 x 4 to 80 x 16."""
    print(f"\nGrowth with size, {seconds:g} s of El Centro at {pga} g")
    sizes: list[tuple[int, float]] = []
    for storeys, bays in ((10, 4), (20, 8), (40, 8), (80, 16)):
        frame = thesis_frame(bays) if storeys == 10 else tall_frame(storeys, bays)
        kept: list[Response] = []
        cost = timed(lambda f=frame, k=kept: core_run(f, seconds, k, pga), repeats)  # type: ignore[misc]
        sizes.append((frame.n_members, cost.milliseconds))
        share = 1e3 * cost.milliseconds / frame.n_members
        size = f"{storeys:3d} x {bays:2d}  {frame.n_members:5d} elements"
        print(f"  {size}  {cost.milliseconds:8.4f} ms a step  {share:6.3f} us an element")
        print(f"            {describe(kept[-1])}")
    (n0, t0), (n1, t1) = sizes[0], sizes[-1]
    slope = np.polyfit(np.log([n for n, _ in sizes]), np.log([t for _, t in sizes]), 1)[0]
    print(f"  power: {math.log(t1 / t0) / math.log(n1 / n0):.2f} between the ends, {slope:.2f} fitted")


def memory() -> None:
    """Peak memory of whole processes that analyse one structure, the larger one last."""
    codes = {
        "thesis frame": "from benchmarks.run import core_run, thesis_frame; core_run(thesis_frame(4), None)",
        "thesis building": "from benchmarks.building_histories import thesis_history; thesis_history()",
    }
    for name, code in codes.items():
        subprocess.run([sys.executable, "-c", code], check=True)
        peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / (1024 if sys.platform != "darwin" else 1024**2)
        print(f"\nPeak memory of a process with the history of the {name}: {peak:.0f} MB")


def main() -> None:
    """Run all of it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="shorter histories, one repeat of the peer")
    parser.add_argument("--repeats", type=int, default=3, help="of the peer's histories (default 3)")
    arguments = parser.parse_args()
    repeats = 1 if arguments.quick else arguments.repeats
    memory()
    side_by_side(thesis_frame(4), None if not arguments.quick else 15.0, repeats, arguments.quick)
    hardening = replace(thesis_frame(4), hardening=0.01)
    for curved in (False, True):
        side_by_side(hardening, None if not arguments.quick else 15.0, repeats, arguments.quick, curved)
    pushovers(hardening)
    side_by_side(thesis_frame(3), None if not arguments.quick else 15.0, repeats, arguments.quick)
    side_by_side(tall_frame(40, 8), 15.0 if not arguments.quick else 3.0, repeats, arguments.quick)
    from benchmarks import building_histories  # not before: the memory of plane frames is measured without it

    building_histories.run("thesis", building_histories.PGA, 3.0 if arguments.quick else 20.0, repeats)
    growth(repeats, 15.0, PGA)
    growth(1, 15.0, 1.2)  # far beyond the bar: yielding everywhere, at every size


if __name__ == "__main__":
    main()
