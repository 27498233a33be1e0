"""Renew projects/office_6_storeys: the commands of docs/tutorials/building.md in turn, and the results for regression.

Usage: renew_office.py [--keep-sections]

With --keep-sections designed.yaml stays as it is, and no sections are searched. What the commands print is to be quoted
in docs/tutorials/building.md. reference.yaml and reference_study.yaml are written anew from the archives.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from statistics import mean

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.assess.measures import response_measures

PROJECT = Path(__file__).parents[1] / "projects" / "office_6_storeys"
SEARCH = ("design", "building.yaml", "--output", "designed.yaml")
BUILDING = ("run", "designed.yaml")
EXTRACT = ("extract", "designed.yaml", "--frame", "X", "--output", "frame.yaml", "--study", "study.yaml")
STUDY = ("run", "study.yaml", "--workers", "2")
SPACE = ("run", "space_study.yaml", "--workers", "2")
N_MODES = 6
OF_STOREYS = {"shear": "storey shear", "theta": "theta", "reduced": "nu d_r / h"}
MEASURES = (
    ("interstorey_drift", "interstorey drift", "%", 100.0),
    ("roof_displacement_m", "roof displacement", "cm", 100.0),
    ("base_shear_N", "base shear, reactions", "kN", 1e-3),
    ("column_base_shear_N", "base shear, columns", "kN", 1e-3),
    ("column_axial_force_N", "column axial force", "kN", 1e-3),
)

HEAD = """\
# Results of edesign itself, for regression: {what}
#   edesign run projects/office_6_storeys/{source}.yaml
#   edesign compare projects/office_6_storeys/{source}.h5 projects/office_6_storeys/{name}
# Written by tools/renew_office.py. {bars}

edesign_reference: 1
title: Office building of six storeys, {title}
source: edesign

tables:
"""


def edesign(*words: str) -> None:
    """Run a command in the folder of the project."""
    print(f"$ edesign {' '.join(words)}", flush=True)
    subprocess.run([sys.executable, "-m", "edesign", *words], cwd=PROJECT, check=True)


def four(values: Iterable[float]) -> str:
    """Values with four digits."""
    return ", ".join(f"{value:.4g}" for value in values)


def building_reference() -> str:
    """The file that has the modes and storeys of the building."""
    text = HEAD.format(
        what="the building with its sections.",
        source="designed",
        name="reference.yaml",
        title="elastic design",
        bars="Four digits are printed, and the bars are their rounding.",
    )
    with open_archive(PROJECT / "designed.h5") as archive:
        modes = archive.group("building/modes")
        text += table("natural modes", "building/modes", "mode", modes, {"period": "natural period"}, N_MODES)
        for axis in ("x", "y"):
            path = f"building/storeys_{axis}"
            text += table(f"storeys, direction {axis}", path, "storey", archive.group(path), OF_STOREYS)
    return text


def table(
    title: str, path: str, over: str, group: Group, variables: Mapping[str, str], count: int | None = None
) -> str:
    """A table of the first values of some variables of a group; labels by variable."""
    text = (
        f"  - title: {title}\n    kind: variables\n    group: {path}\n    over: {over}\n    within: 0.1 %\n    rows:\n"
    )
    for name, label in variables.items():
        variable = group.variables[name]
        values = f"[{four(variable.values[:count])}]"
        text += f"      - {{variable: {name}, label: {label}, unit: {json.dumps(variable.unit)}, values: {values}}}\n"
    return text


def study_reference() -> str:
    """The file that has the mean responses of the study."""
    text = HEAD.format(
        what="the frames along x with and without dampers.",
        source="study",
        name="reference_study.yaml",
        title="mean responses of the study",
        bars="The bars are for other versions of numpy and scipy, whose simulated motions differ.",
    )
    text += "  - title: mean responses\n    kind: responses\n    statistic: mean\n    within: 3 %\n    rows:\n"
    found: dict[tuple[str, str], list[dict[str, float | None]]] = {}
    with open_archive(PROJECT / "study.h5") as archive:
        for name in archive.names("analyses"):
            of = archive.group_attributes(f"analyses/{name}")
            if of["kind"] == "history":
                measures = response_measures(archive.group(f"analyses/{name}"))
                found.setdefault((str(of["variant"]), str(of["level"])), []).append(measures)
    for measure, label, unit, factor in MEASURES:
        row = measure.removesuffix("_m").removesuffix("_N")
        text += f"      - measure: {row}\n        label: {label}\n        unit: {json.dumps(unit)}\n        values:\n"
        for variant in dict.fromkeys(variant for variant, _ in found):
            means = {
                level: factor * mean(one[measure] or 0.0 for one in histories)
                for (of_variant, level), histories in found.items()
                if of_variant == variant
            }
            values = ", ".join(f"{level}: {value:.4g}" for level, value in means.items())
            text += f"          {variant}: {{{values}}}\n"
    return text


def main() -> None:
    """Run the chain and write the references."""
    if "--keep-sections" not in sys.argv[1:]:
        edesign(*SEARCH)
    for command in (BUILDING, EXTRACT, STUDY, SPACE):
        edesign(*command)
    (PROJECT / "reference.yaml").write_text(building_reference(), encoding="utf-8")
    (PROJECT / "reference_study.yaml").write_text(study_reference(), encoding="utf-8")


if __name__ == "__main__":
    main()
