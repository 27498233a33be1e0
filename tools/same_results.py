"""Run cases in two trees of the repository, and say whether their archives hold the same to the last bit.

Usage: python -m tools.same_results BEFORE AFTER [--archives FOLDER] [CASE ...]

BEFORE and AFTER are work trees with a built core. Each CASE is a YAML file in both, as
tests/cases/placement/study.yaml; without any, those of CASES are run, one at a time. With --archives the archives stay
in FOLDER, and those of BEFORE that are there are not computed again. Times of computing, the checksum of the code, the
place of the file and the group `provenance` do not count.
The exit code is 1 if anything differs.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from edesign.archive.checksum import content_checksum
from edesign.archive.dataset import Group
from edesign.archive.reader import Archive, open_archive

CASES = tuple(
    f"tests/cases/{case}.yaml"
    for case in (
        "chevron_mgmm/project",
        "brb_frame/project",
        "brb_pinned/project",
        "isolated_frame/project",
        "deteriorating_hinges/project",
        "footings_on_soil/project",
        "pushover_targets/project",
        "wave_passage/project",
        "leaning_column/project",
        "rigid_ends/project",
        "buckling_braces/project",
        "divided_beam/project",
        "loads_inside_members/project",
        "thesis_4_bays/project",
        "placement/study",
        "brb_frame/study",
        "isolated_frame/study",
        "wave_passage/study",
        "viscous_dampers/study",
        "hysteretic_dampers/study",
        "elastomer_strain/study",
    )
) + ("projects/thesis_building/building.yaml", "projects/office_6_storeys/designed.yaml")
UNCOUNTED = ("code_checksum", "source_file")


def run(tree: Path, case: str, archive: Path) -> None:
    """Run a case with the package of a tree."""
    print(f"{case} in {tree}", flush=True)
    archive.parent.mkdir(parents=True, exist_ok=True)
    command = [sys.executable, "-m", "edesign", "run", str(tree / case), "--archive", str(archive), "--quiet"]
    subprocess.run(command, cwd=tree, env=os.environ | {"PYTHONPATH": str(tree)}, check=True)


def groups(archive: Archive, parent: str = "/") -> Iterator[tuple[str, Group]]:
    """All groups but `provenance` by their places, without what may differ between runs of one code."""
    yield parent, counted(archive.group(parent))
    for name in archive.names(parent):
        if name != "provenance":
            yield from groups(archive, f"{parent.rstrip('/')}/{name}")


def counted(group: Group) -> Group:
    kept = {name: value for name, value in group.attributes.items() if name not in UNCOUNTED}
    if isinstance(kept.get("statistics"), dict):
        kept["statistics"] = {name: value for name, value in kept["statistics"].items() if name != "cpu_s"}
    return Group(group.coords, group.variables, kept)


def parts(group: Group) -> dict[str, str]:
    """The checksum of each attribute and variable of a group, by name."""
    found = {f"attribute {name}": content_checksum({name: repr(value)}, {}) for name, value in group.attributes.items()}
    variables = {**group.coords, **group.variables}
    return found | {name: content_checksum({}, {name: variable}) for name, variable in variables.items()}


def differences(before: Path, after: Path) -> list[str]:
    """What differs between two archives, one line for each group."""
    with open_archive(before) as first, open_archive(after) as second:
        old, new = dict(groups(first)), dict(groups(second))
    lines = [f"{place}: only in {'BEFORE' if place in old else 'AFTER'}" for place in sorted(set(old) ^ set(new))]
    for place in sorted(set(old) & set(new)):
        was, now = parts(old[place]), parts(new[place])
        names = [name for name in dict.fromkeys([*was, *now]) if was.get(name) != now.get(name)]
        if names or list(was) != list(now):
            lines.append(f"{place}: {', '.join(names) or 'another order'}")
    return lines


def main() -> int:
    parser = argparse.ArgumentParser(description="Compare results of two trees to the last bit.")
    parser.add_argument("before", type=Path)
    parser.add_argument("after", type=Path)
    parser.add_argument("cases", nargs="*", metavar="CASE")
    parser.add_argument("--archives", type=Path)
    asked = parser.parse_intermixed_args()
    different = False
    with tempfile.TemporaryDirectory() as folder:
        kept = (asked.archives or Path(folder)).resolve()
        for case in asked.cases or CASES:
            archives = [kept / side / Path(case).with_suffix(".h5") for side in ("before", "after")]
            archives[1].unlink(missing_ok=True)
            for tree, archive in zip((asked.before, asked.after), archives, strict=True):
                if not archive.exists():
                    run(tree.resolve(), case, archive)
            found = differences(*archives)
            different |= bool(found)
            print("\n".join(f"  {line}" for line in found) or "  the same", flush=True)
    return int(different)


if __name__ == "__main__":
    raise SystemExit(main())
