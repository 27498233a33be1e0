"""Writes the tables of docs/results/thesis_in_space.md: the plane study of the thesis beside its building in space.

The archives are those of projects/thesis_building/study.yaml and pairs.yaml. The plane frames are run here, under the
same twenty motions, without and with dampers: the one of projects/thesis_10_storey, and all frames along x that
`edesign extract` takes out of the building.

Usage: python tools/thesis_in_space.py ARCHIVE... [--recordings FOLDER] [--workers N]
"""

from __future__ import annotations

import argparse
import csv
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Mapping
from pathlib import Path
from statistics import mean

import yaml

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.assess.measures import located_measure
from edesign.frame.building_file import load_building
from edesign.project.criteria.measures import InSpace
from edesign.space.extract import frame_row, project_text
from edesign.space.structure.geometry import space_frame
from tools import result_tables

ROOT = Path(__file__).resolve().parents[1]
BUILDING = ROOT / "projects" / "thesis_building" / "table_5_2.yaml"
FRAME = ROOT / "projects" / "thesis_10_storey" / "project.yaml"
LAWS = ROOT / "projects" / "thesis_dampers"
PLANE_BAYS = [1, 4, 6, 9, 11, 14, 16, 19]  # bays 1 and 4 of four frames side by side, with a gap between them
MEASURES = (
    ("roof displacement [cm]", "roof_displacement_m", 100.0),
    ("interstorey drift [%]", "interstorey_drift", 100.0),
    ("drift at the end [%]", "final_interstorey_drift", 100.0),
    ("base shear of columns over weight [%]", "column_base_shear_N", 100.0),
    ("roof acceleration [m/s2]", "roof_acceleration_m_s2", 1.0),
    ("plastic rotation of beams [mrad]", "beam_plastic_rotation_rad", 1000.0),
    ("plastic rotation of columns [mrad]", "column_plastic_rotation_rad", 1000.0),
    ("axial force of a column [kN]", "column_axial_force_N", 1e-3),
    ("strain of dampers [%]", "damper_strain", 100.0),
)
DIRECTED = [measure for _, measure, _ in MEASURES[:5]]  # what has a direction; members count with both axes
WEIGHT = {"frame": 9.81 * 977e3, "building": 9.81 * 3621e3}  # N, of the masses; all frames have those of the building
STUDY = """\
edesign_study: 1
title: Plane frames
project: project.yaml
histories:
  - {variants: all, levels: DBE, records: table_5_6}
"""
THESIS = yaml.safe_load((FRAME.parent / "study.yaml").read_text(encoding="utf-8"))
OWN_DAMPERS = {"variants": {"bare": {"dampers": "none"}, "damped": {"dampers": "project"}}}
Histories = dict[str, Group]


def histories(*paths: Path) -> Histories:
    """The histories at the DBE of some archives by their names, without the level; those of earlier archives stay."""
    found: Histories = {}
    for path in paths:
        with open_archive(path) as archive:
            for name in archive.names("analyses"):
                if ".DBE." in name and name not in found:
                    found[name.replace(".DBE", "", 1)] = archive.group(f"analyses/{name}")
    return found


def frames_of_the_building() -> str:
    """All frames along x with their dampers as a project: what `extract` writes, and blocks of the building."""
    loaded = load_building(BUILDING)
    project = yaml.safe_load(project_text(frame_row(loaded, space_frame(loaded), "X")))
    building = yaml.safe_load(BUILDING.read_text(encoding="utf-8"))
    device = {key: value for key, value in building["dampers"]["devices"][0].items() if key not in ("along", "frames")}
    project["dampers"] = building["dampers"] | {"devices": [device | {"bays": PLANE_BAYS}]}
    for key in ("damping", "integration", "elements"):
        project[key] = building[key]
    project["records"] = {"table_5_6": building["records"]["table_5_6"]}
    return yaml.safe_dump(project, sort_keys=False)


def plane(project: str, variants: Mapping[str, object], recordings: Iterable[str], workers: int) -> Histories:
    """Run plane frames without and with dampers in a folder of their own."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "project.yaml").write_text(project.replace("../thesis_dampers", str(LAWS)), encoding="utf-8")
        (folder / "study.yaml").write_text(STUDY + yaml.safe_dump(variants), encoding="utf-8")
        command = [sys.executable, "-m", "edesign", "run", "study.yaml", "--quiet", "--workers", str(workers)]
        command += [word for one in recordings for word in ("--folder", one)]
        subprocess.run(command, cwd=folder, check=True)
        return histories(folder / "study.h5")


def means(groups: Mapping[str, Group], direction: str | None) -> dict[str, float | None]:
    """The mean of each measure over histories, along x or y in a building."""
    chosen = InSpace(direction=direction)
    found: dict[str, float | None] = {}
    for _, measure, factor in MEASURES:
        each = [located_measure(group, measure, chosen=chosen) for group in groups.values()]
        values = [one.value for one in each if one is not None]
        found[measure] = factor * mean(values) if values else None
    return found


def of(groups: Histories, variant: str, names: Iterable[str]) -> Histories:
    """The histories of a variant under some motions."""
    return {name: groups[f"{variant}.{name}"] for name in names}


def write(name: str, head: list[str], columns: list[dict[str, float | None]]) -> None:
    """Write a table with a row for each measure, four digits."""
    path = result_tables.RESULTS / "data" / f"thesis_in_space_{name}.csv"
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["mean of the motions, DBE", *head])
        for label, measure, _ in MEASURES:
            values = [column.get(measure) for column in columns]
            if all(value is None for value in values) or (name.endswith("_y") and measure not in DIRECTED):
                continue
            writer.writerow([label, *("-" if value is None else f"{value:.4g}" for value in values)])


def over_weight(found: dict[str, float | None], weight: float) -> dict[str, float | None]:
    """Measures with the base shear over the weight."""
    shear = found["column_base_shear_N"]
    return found | {"column_base_shear_N": None if shear is None else shear / weight}


def main() -> None:
    """Write the data files, and the page from them."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("archives", type=Path, nargs="+")
    parser.add_argument("--recordings", action="append", default=[])
    parser.add_argument("--workers", type=int, default=2)
    options = parser.parse_args()
    space = histories(*options.archives)
    sized = {key: THESIS[key] for key in ("designs", "variants")}
    thesis = plane(FRAME.read_text(encoding="utf-8"), sized, options.recordings, options.workers)
    frames = plane(frames_of_the_building(), OWN_DAMPERS, options.recordings, options.workers)
    records = [name.removeprefix("bare.") for name in frames if name.startswith("bare.")]
    models = {"frame of the thesis": thesis, "all frames, plane": frames, "building": space}
    head, columns = [], []
    for variant in ("bare", "damped"):
        for model, groups in models.items():
            head.append(f"{variant}: {model}")
            found = means(of(groups, variant, records), "x" if groups is space else None)
            columns.append(over_weight(found, WEIGHT["frame" if groups is thesis else "building"]))
    write("models", head, columns)
    tail = {name.split(".", 1)[1] for name in space} - set(records)
    pairs = sorted({name.split(".")[0] for name in tail if name[0].isdigit()})
    alone = sorted(name for name in tail if not name[0].isdigit())
    for direction in ("x", "y"):
        head, columns = [], []
        for variant in ("bare", "damped"):
            kinds = {"alone": alone} if direction == "x" else {}
            kinds |= {
                "pairs": [f"{pair}.0" for pair in pairs],
                "pairs, masses beside": [f"{pair}.+x+y" for pair in pairs],
            }
            head += [f"{variant}: {kind}" for kind in kinds]
            found = [means(of(space, variant, names), direction) for names in kinds.values()]
            columns += [over_weight(one, WEIGHT["building"]) for one in found]
        write(f"pairs_{direction}", head, columns)
    result_tables.main()


if __name__ == "__main__":
    main()
