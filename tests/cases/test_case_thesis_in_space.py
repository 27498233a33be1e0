"""projects/thesis_building in space beside its frames in their plane: docs/results/thesis_in_space.md in short.

References: all frames along x of the building in one plane, by `edesign extract`; the loads of Table 5.1 by hand. The
whole study runs by `python tools/thesis_in_space.py`.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import yaml

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.frame.building_file import load_building
from edesign.frame.project_file import load_study
from edesign.space.extract import frame_row, project_text
from edesign.space.structure.geometry import space_frame
from edesign.study.run.run import run_study
from tools import thesis_in_space

RECORDS = {
    "along_x": {"file": "x.csv", "acceleration_unit": "g"},
    "pairs": {"pair": [{"file": "x.csv", "acceleration_unit": "g"}, {"file": "y.csv", "acceleration_unit": "g"}]},
}
STUDY = """\
edesign_study: 1
title: {name}
project: {name}.yaml
variants: {{bare: {{dampers: none}}, damped: {{dampers: project}}}}
modal: {{modes: 1}}
histories:
  - {{records: along_x}}
{more}
"""


def run(folder: Path, name: str, text: str, more: str = "") -> dict[str, Group]:
    """Run a study of a file under the motions of the test."""
    file = yaml.safe_load(text)
    file["records"] = {name: one for name, one in RECORDS.items() if more or name != "pairs"}
    (folder / f"{name}.yaml").write_text(yaml.safe_dump(file, sort_keys=False), encoding="utf-8")
    path = folder / f"{name}_study.yaml"
    path.write_text(STUDY.format(name=name, more=more), encoding="utf-8")
    summary = run_study(load_study(path), workers=2)
    assert all(outcome.status == "completed" for outcome in summary.outcomes), summary.outcomes
    with open_archive(summary.archive) as archive:
        return {name: archive.group(f"analyses/{name}") for name in archive.names("analyses")}


def drift(group: Group, quantity: str = "storey_drift") -> np.ndarray:
    """The largest drift of each storey, along x in a building."""
    each = np.maximum(group.variables[f"{quantity}_max"].values, -group.variables[f"{quantity}_min"].values)
    return each[:, 0] if each.ndim == 2 else each


def axial(group: Group) -> float:
    """The largest compression of a column, N."""
    return -float(group.variables["column_axial_force_min"].values.min())


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> tuple[dict[str, Group], dict[str, Group]]:
    """The frames in their plane and the building, without and with dampers, under a motion that makes beams yield."""
    folder = tmp_path_factory.mktemp("thesis")
    time = np.arange(0.0, 2.4, 0.01)
    for name, peak, period in (("x", 0.15, 2.0), ("y", 0.3, 0.9)):
        motion = peak * np.sin(2.0 * np.pi * time / period)
        np.savetxt(folder / f"{name}.csv", np.column_stack([time, motion]), delimiter=",", fmt="%.6f")
    plane = run(folder, "plane", thesis_in_space.frames_of_the_building())
    pairs = "  - {records: pairs, eccentricity: [0, +x+y]}"
    return plane, run(folder, "building", thesis_in_space.BUILDING.read_text(encoding="utf-8"), pairs)


@pytest.mark.parametrize(("variant", "within"), [("bare", 0.002), ("damped", 0.005)])
def test_under_one_component_the_building_drifts_as_its_frames_in_their_plane(
    found: tuple[dict[str, Group], dict[str, Group]], variant: str, within: float
) -> None:
    """Elastic at first, beams then yield, at 2.4 % of drift, and both agree within 0.14 %, with dampers within 0.44 %.

    What is left: braces and beams along y tie columns of different frames, which shorten by different amounts, more so
    beside dampers.
    """
    plane, space = (one[f"{variant}.along_x"] for one in found)
    np.testing.assert_allclose(drift(space, "mean_storey_drift"), drift(plane), rtol=within)
    assert np.abs(space.variables["floor_rotation_max"].values).max() < 1e-4


@pytest.mark.parametrize("variant", ["bare", "damped"])
def test_the_other_component_and_masses_beside_their_places_add_what_the_plane_misses(
    found: tuple[dict[str, Group], dict[str, Group]], variant: str
) -> None:
    """Columns have the braces' forces, storey 1 drifts further along x, and so does the worst line of others."""
    alone, pair, beside = (found[1][f"{variant}.{name}"] for name in ("along_x", "pairs.0", "pairs.+x+y"))
    assert axial(pair) > 1.1 * axial(alone)
    assert drift(pair)[0] > 1.2 * drift(alone)[0]
    assert drift(beside)[2] > 1.1 * drift(pair)[2]


def test_the_plane_study_has_all_of_the_mass_of_an_interior_frame_and_two_thirds_of_its_load() -> None:
    """An interior column has 7.2 m by 7.2 m: 4.5 kN/m2 of G and 2 kN/m2 of Q, of which secondary beams bring a third.

    The frame of section 5.3.2 has 23 kN/m and 9.6 kN/m on its beams: what comes to them, with their weight. What the
    beams along y bring to the columns is missing; its mass, 29.5 t, is not.
    """
    area, of_area = 7.2**2, {"G": 4.5, "Q": 2.0}
    frame = yaml.safe_load(thesis_in_space.FRAME.read_text(encoding="utf-8"))
    (load,) = frame["loads"]["beams"]
    assert float(load["Q"].split()[0]) * 7.2 == pytest.approx(2.0 / 3.0 * of_area["Q"] * area)
    assert float(load["G"].split()[0]) * 7.2 == pytest.approx(2.0 / 3.0 * of_area["G"] * area, rel=0.07)
    interior = float(frame["masses"]["given"][0]["mass"].split()[0])
    assert interior * 9.81 == pytest.approx((of_area["G"] + 0.3 * of_area["Q"]) * area, rel=0.1)
    building = load_building(thesis_in_space.BUILDING)
    row = yaml.safe_load(project_text(frame_row(building, space_frame(building), "X2")))
    nodes = {str(one["lines"]): one for one in row["loads"]["nodes"] if one["floors"] in (1, "1-3")}
    assert float(nodes["B2-D2"]["Q"].split()[0]) == pytest.approx(of_area["Q"] * area / 3.0)
