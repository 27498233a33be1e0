"""CPU of the selection of sections: the thesis building with 10 groups, and an interior frame of it with 6.

The building has the diagonals of a storey range in one group, which cannot meet the 25 % rule of EN 1998-1, 6.7.3(8),
and columns that no HEB can be; so the rule is left out and HEM and HD sections are in the list.

Usage: python -m benchmarks.section_selection [--building FILE] [--starts N] [--workers N]
"""

from __future__ import annotations

import argparse
import os
import time
from pathlib import Path

from edesign.frame.building_file import load_building
from edesign.one_thread import one_thread
from edesign.project.building.building import Building
from edesign.space.elastic_design import ElasticAnalysis
from edesign.space.selection.select import select_sections

THESIS = Path(__file__).parents[1] / "projects" / "thesis_building" / "building.yaml"
DESIGNS = 20  # of which one is timed


def thesis_building(path: Path, starts: int) -> Building:
    """Return the thesis building with lists that hold sections for it."""
    select = {"lists": {"columns": ["HEB", "HEM", "HD"]}, "leave_out": ["6.7.3(8)"], "starts": starts}
    return load_building(path).with_values({"design.select": select})


def main() -> None:
    """Time one design and the whole selection."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--building", type=Path, default=THESIS)
    parser.add_argument("--starts", type=int, default=3)
    parser.add_argument("--workers", type=int, default=2)
    words = parser.parse_args()
    building = thesis_building(words.building, words.starts)
    analysis = ElasticAnalysis(building)
    groups = list(dict.fromkeys(member.group for member in analysis.frame.members if member.kind == "beam"))
    with one_thread():
        analysis.design()
        began = time.process_time()
        for number in range(DESIGNS):
            analysis.design({groups[0]: ("IPE450", "IPE500")[number % 2]})
    print(f"one design with other sections: {(time.process_time() - began) / DESIGNS * 1e3:.1f} ms")
    began, clock = sum(os.times()[:4]), time.perf_counter()
    found = select_sections(building, workers=words.workers)
    cpu, wall = sum(os.times()[:4]) - began, time.perf_counter() - clock
    print(f"selection: {found.mass / 1e3:.1f} t, {found.evaluations} designs, {cpu:.1f} s CPU, {wall:.1f} s")
    print(", ".join(f"{row.group.name} {row.after}" for row in found.groups))


if __name__ == "__main__":
    main()
