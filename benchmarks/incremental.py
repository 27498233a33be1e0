"""Time of an incremental dynamic analysis: the thesis' 10-storey frame, bare and with 20 MGMM dampers.

20 records at 12 levels: those of thesis Table 5.6 as recorded (simulated where no package has them), scaled to
spectral accelerations at T1 of the bare frame; dampers as in benchmarks/damped_frame.py. The bar is 300 s of wall time
in two threads.

Usage: python -m benchmarks.incremental [--records N] [--threads N] [--from G] [--to G] [--levels N] [--figures FOLDER]
"""

from __future__ import annotations

import argparse
import os
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from benchmarks.damped_frame import FILE, damped_project  # noqa: E402
from edesign.archive.dataset import Group  # noqa: E402
from edesign.assess.incremental import COLLAPSE, collect_stripes  # noqa: E402
from edesign.assess.limit_fragility import limit_fragility  # noqa: E402
from edesign.ground_motion.project_records import find_recordings, references  # noqa: E402
from edesign.project.incremental import SpectralAccelerationStudy  # noqa: E402
from edesign.project.loader import load_project  # noqa: E402
from edesign.project.units import STANDARD_GRAVITY  # noqa: E402
from edesign.report.figures import save  # noqa: E402
from edesign.report.incremental_figures import fragility_figure, ida_figure  # noqa: E402
from edesign.report.incremental_tables import fractile_table, fragility_table  # noqa: E402
from edesign.report.text import plain  # noqa: E402
from edesign.study.incremental import make_chains, run_chain  # noqa: E402
from edesign.study.intensity import first_period, level_intensity  # noqa: E402
from edesign.study.motions import Motion  # noqa: E402

BAR = 300.0  # s
SUITE, DRIFT = "table_5_6", "interstorey_drift"


def main() -> None:
    """Run the study and print times and fragilities."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--records", type=int, default=20)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--from", dest="first", type=float, default=0.1, help="spectral acceleration, g")
    parser.add_argument("--to", dest="last", type=float, default=1.2, help="spectral acceleration, g")
    parser.add_argument("--levels", type=int, default=12)
    parser.add_argument("--figures", type=Path, help="folder for figures")
    options = parser.parse_args()

    damped = damped_project(braces=True)
    thesis = load_project(FILE)
    bare = thesis.model_copy(update={"dampers": None})
    damped = thesis.model_copy(update={"dampers": damped.dampers})
    period = first_period(bare, dampers=False)
    study = SpectralAccelerationStudy.model_validate(
        {
            "name": "ida",
            "records": SUITE,
            "intensity": "spectral_acceleration",
            "period": f"{period!r} s",
            "levels": {"from": f"{options.first} g", "to": f"{options.last} g", "count": options.levels},
            "level": "MCE",
            "limits": {"LS": {DRIFT: "2.5 %"}, "CP": {DRIFT: "5 %"}},
        }
    )
    recordings = find_recordings(thesis, references(thesis, SUITE)[: options.records])
    motions = {name: Motion(name, found) for name, found in recordings.items()}
    chains = make_chains(study, {"bare": False, "damped": True}, motions)
    projects = {"bare": bare, "damped": damped}
    wall, cpu = time.perf_counter(), time.process_time()
    groups: dict[str, Group] = {}
    with ThreadPoolExecutor(options.threads) as pool:
        tasks = [pool.submit(run_chain, projects[c.variant], c, motions[c.record], period) for c in chains]
        for task in tasks:
            groups |= task.result()
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu

    print(f"T1 = {period:.3f} s; {len(motions)} records, {options.levels} levels, {options.threads} threads")
    for variant in projects:
        mine = [group for group in groups.values() if group.attributes["variant"] == variant]
        states = Counter(
            "collapsed" if group.attributes.get("collapsed") else str(group.attributes["status"]) for group in mine
        )
        steps = sum(group.attributes.get("statistics", {}).get("steps", 0) for group in mine)
        seconds = sum(group.attributes.get("statistics", {}).get("cpu_s", 0.0) for group in mine)
        each = 1e6 * seconds / steps
        print(f"{variant:8s} {dict(states)}; {steps} steps, {seconds:.1f} s of CPU in them ({each:.0f} us each)")
    print(f"wall {wall:.1f} s, CPU {cpu:.1f} s; bar: {BAR:g} s of wall time in two threads")

    reference = level_intensity(thesis, study, period)
    stripes = [collect_stripes(groups, study.name, variant, (DRIFT,))[DRIFT] for variant in projects]
    limits = {name: limit.value for name, limit in study.limits.items()} | {"collapse": COLLAPSE}
    found = [
        limit_fragility(one, name, value, method, reference)
        for method in ("counts", "capacities")
        for name, value in limits.items()
        for one in stripes
    ]
    print(plain(fragility_table(found, "m/s^2", "MCE")))
    print(plain(fractile_table(stripes, limits)))
    if options.figures is not None:
        options.figures.mkdir(parents=True, exist_ok=True)
        label, drawn = f"Sa({period:.2f} s, 5 %) (g)", {name: limits[name] for name in study.limits}
        figure = ida_figure(stripes, label, STANDARD_GRAVITY, "interstorey drift (%)", 0.01, drawn)
        save(figure, options.figures / "incremental_curves.png")
        counted = [one for one in found if one.method == "counts"]
        save(fragility_figure(counted, label, STANDARD_GRAVITY), options.figures / "fragility.png")


if __name__ == "__main__":
    main()
