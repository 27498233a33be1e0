"""Time of an incremental dynamic analysis: the thesis' 10-storey frame, bare and with elastomeric dampers.

20 records at 12 levels: projects/thesis_10_storey/incremental.yaml, with the records as recorded (simulated where no
package has them) and the whole run from the study file to the finished archive. The bar is 300 s of wall time on two
cores.

Usage: python -m benchmarks.incremental [--records N] [--workers N] [--from G] [--to G] [--levels N] [--figures FOLDER]
"""

from __future__ import annotations

import argparse
import os
import resource
import tempfile
import time
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import yaml  # noqa: E402

from edesign.archive.reader import open_archive  # noqa: E402
from edesign.frame.project_file import load_project, load_study  # noqa: E402
from edesign.ground_motion.project_records import references  # noqa: E402
from edesign.report.archive_view import all_results  # noqa: E402
from edesign.report.capacity.incremental_figures import results_figures  # noqa: E402
from edesign.report.capacity.incremental_results import IncrementalResults, read_incremental  # noqa: E402
from edesign.report.capacity.incremental_tables import results_tables  # noqa: E402
from edesign.report.drawing.style import save  # noqa: E402
from edesign.report.tables.text import plain  # noqa: E402
from edesign.study.run.run import run_study  # noqa: E402

BAR = 300.0  # s
FILE = Path(__file__).resolve().parents[1] / "projects" / "thesis_10_storey" / "incremental.yaml"


def study_text(records: int, first: float, last: float, levels: int) -> str:
    """The study with some of its records and other levels (g), for a file elsewhere."""
    content = yaml.safe_load(FILE.read_text(encoding="utf-8"))
    project = FILE.parent / content["project"]
    (study,) = content["incremental"]
    study["records"] = list(references(load_project(project), study["records"])[:records])
    study["levels"] = {"from": f"{first} g", "to": f"{last} g", "count": levels}
    return yaml.safe_dump({**content, "project": str(project)}, sort_keys=False)


def main() -> None:
    """Run the study and print times, states and fragilities."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--records", type=int, default=20)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--from", dest="first", type=float, default=0.1, help="spectral acceleration, g")
    parser.add_argument("--to", dest="last", type=float, default=1.2, help="spectral acceleration, g")
    parser.add_argument("--levels", type=int, default=12)
    parser.add_argument("--figures", type=Path, help="folder for figures")
    options = parser.parse_args()

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "study.yaml"
        path.write_text(study_text(options.records, options.first, options.last, options.levels), encoding="utf-8")
        load, wall, cpu = os.getloadavg()[0], time.perf_counter(), _cpu()
        summary = run_study(load_study(path), workers=options.workers)
        wall, cpu = time.perf_counter() - wall, _cpu() - cpu
        size = summary.archive.stat().st_size
        with open_archive(summary.archive) as archive:
            groups = all_results(archive)
            (found,) = read_incremental(archive, groups)
    print(
        f"{options.records} records, {options.levels} levels, {options.workers} workers; archive of {size / 1e6:.1f} MB"
    )
    print(
        f"wall {wall:.1f} s, CPU {cpu:.1f} s, load average {load:.1f} before; bar: {BAR:g} s of wall time on two cores"
    )
    for variant, states in found.states.items():
        cost = [
            group.attributes.get("statistics", {})
            for group in groups.values()
            if group.attributes.get("incremental") and group.attributes.get("variant") == variant
        ]
        steps, seconds = (sum(item.get(key, 0) for item in cost) for key in ("steps", "cpu_s"))
        counted = ", ".join(f"{count} {state}" for state, count in states.items())
        print(f"{variant}: {counted}; {steps} steps, {seconds:.1f} s in them ({1e6 * seconds / steps:.0f} us each)")
    for table in results_tables(found):
        print(plain(table))
    if options.figures is not None:
        _draw(found, options.figures)


def _cpu() -> float:
    """CPU seconds of this process, all threads."""
    used = resource.getrusage(resource.RUSAGE_SELF)
    return used.ru_utime + used.ru_stime


def _draw(found: IncrementalResults, folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    for name, _, figure in results_figures(found):
        save(figure, folder / f"{name}.png")


if __name__ == "__main__":
    main()
