"""A study that designs dampers of a building along x and along y, and has both in one variant."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest
from building_examples import SMALL
from cases.small_frame import RECORD, TEXT

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.errors import InputError
from edesign.frame.project_file import load_study
from edesign.report.archive.document import page_text
from edesign.report.archive.tables import overview
from edesign.study.check.summary import check_study
from edesign.study.design.verification import along_design
from edesign.study.plan.study_plan import verifying_histories
from edesign.study.run.run import run_study

LAWS = """\
dampers:
  laws:
    oil: {type: viscous_power, parameters: {c: 100 kN*(s/m)^0.5, alpha: 0.5}}
    steel: {type: elastic_plastic, parameters: {k: 50 kN/mm, Fy: 120 kN, b: 0.02}}
"""
REST = """\
damping: {kind: rayleigh, ratio: 3 %, periods: [1.2 s, 0.2 s]}
integration: {method: newmark, time_step: 0.01 s}
records:
  pair: {pair: [{file: motion.AT2}, {file: across.AT2}]}
  one: {file: motion.AT2}
"""
STUDY = """\
edesign_study: 1
title: Two storeys with dampers along x and y
project: building.yaml
designs:
  x: {method: viscous, law: oil, kind: chevron, along: x, frames: [X1, X3], bays: 1, damping: 12 %,
    amplitude: spectrum, level: DBE, brace: {ratio: 10}}
  y: {method: hysteretic, law: steel, kind: rising, along: y, frames: B, bays: all, shear_share: 15 %, level: DBE,
    verify: {records: [pair, one], levels: DBE, criteria: drift, change: yield_force, rounds: 3}}
variants:
  bare: {dampers: none}
  damped: {design: [x, y]}
histories:
  - {variants: damped, levels: DBE, records: pair, eccentricity: [0, +x+y]}
criteria:
  - {name: drift, measure: interstorey_drift, most: 1.5 %, levels: DBE}
outputs: {histories: [floors, storeys, dampers]}
"""


def write(folder: Path, study: str = STUDY, dampers: str = LAWS) -> Path:
    (folder / "motion.AT2").write_text(RECORD, encoding="utf-8")
    (folder / "across.AT2").write_text(RECORD.replace("0.20", "0.15"), encoding="utf-8")
    (folder / "building.yaml").write_text(SMALL + dampers + REST, encoding="utf-8")
    path = folder / "study.yaml"
    path.write_text(study, encoding="utf-8")
    return path


def histories(archive: Path, variant: str) -> dict[str, Group]:
    with open_archive(archive) as found:
        names = [name for name in found.names("analyses") if name.startswith(f"{variant}.DBE")]
        return {name.removeprefix(variant): found.group(f"analyses/{name}") for name in names}


def test_dampers_of_two_designs_are_those_that_a_building_file_may_have_itself(tmp_path: Path) -> None:
    """Histories bit for bit: the devices in the archive have all digits."""
    study = load_study(write(tmp_path))
    assert check_study(study)["designs"] == "x (viscous), y (hysteretic)"
    summary = run_study(study)
    assert all(outcome.status == "completed" for outcome in summary.outcomes), summary.outcomes
    designed = histories(summary.archive, "damped")
    assert list(designed) == [".DBE.pair.0", ".DBE.pair.+x+y"]
    with open_archive(summary.archive) as archive:
        groups = [archive.group(f"designs/{name}") for name in "xy"]
        tables = {table.title for table in overview(archive)}
        page = page_text(archive)
    assert {"Design x: viscous, completed", "Design y: hysteretic, completed"} <= tables
    assert "Modes of the building with the dampers of this design" in page and "could not be" not in page
    assert all(f"figure-model_damped_{frame}" in page for frame in ("X1", "YB"))
    names = [name for group in groups for name in group.attributes["device_names"]]
    dampers = next(iter(designed.values())).coords["damper"].values.tolist()
    assert names == dampers and {name[:2] for name in names} == {"VX", "RY"}
    # along y the single record acts along y too
    assert groups[1].coords["criterion"].values.tolist() == ["drift, DBE"]

    own = tmp_path / "own"
    own.mkdir()
    texts = [re.sub("^", "  ", str(group.attributes["devices"]), flags=re.MULTILINE).rstrip() for group in groups]
    text = "\n".join([texts[0], texts[1].partition("\n")[2]]) + "\n"
    plain = STUDY[: STUDY.index("designs:")] + STUDY[STUDY.index("variants:") :]
    path = write(own, plain.replace("{design: [x, y]}", "{dampers: project}"), LAWS + text)
    again = histories(run_study(load_study(path)).archive, "damped")
    for name, group in designed.items():
        for key in ("storey_drift_max", "floor_displacement", "damper_force", "damper_deformation"):
            assert np.array_equal(group.variables[key].values, again[name].variables[key].values), (name, key)


def test_a_verification_looks_along_its_design(tmp_path: Path) -> None:
    """A single record acts along y, a pair as it does in histories; so do angles that are told."""
    study = load_study(write(tmp_path))
    angles = {spec.record: spec.angles for spec in verifying_histories(study, "y", 1)}
    assert angles == {"pair": (0.0,), "one": (math.pi / 2,)}
    told = load_study(write(tmp_path, STUDY.replace("rounds: 3}", "rounds: 3, angles: 30 deg, eccentricity: [0, +y]}")))
    specs = list(verifying_histories(told, "y", 2))
    assert [spec.name for spec in specs] == [f"y.2.DBE.{name}.{at}" for name in ("pair", "one") for at in ("0", "+y")]
    assert {spec.angles for spec in specs} == {(math.pi / 6,)}
    (drift,) = study.criteria
    assert along_design(drift, study.designs["y"]).direction == "y"
    assert along_design(drift.model_copy(update={"direction": "x"}), study.designs["y"]).direction == "x"


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("along: x, frames: [X1, X3], bays: 1,", "bays: 1,"), "designs.x.along: this key is missing"),
        (("frames: [X1, X3]", "frames: [X1, X9]"), "designs.x.frames"),
        (("frames: [X1, X3]", "frames: [A, C]"), "designs.x.frames"),
        (("bays: 1, damping", "bays: 3, damping"), "there is no bay 3 along x"),
        (("[x, y]}", "[x, z]}"), "variants.damped.design[1]: there is no design `z`"),
        (("[x, y]}", "[x, x]}"), "variants.damped.design[1]: `x` comes twice"),
        (("rounds: 3}", "rounds: 3, angles: [0 deg, 360 deg]}"), "stands here twice"),
    ],
)
def test_designs_that_a_building_cannot_have_are_refused_with_their_place(
    tmp_path: Path, change: tuple[str, str], said: str
) -> None:
    assert STUDY.count(change[0]) == 1
    with pytest.raises(InputError, match="study.yaml:") as found:
        load_study(write(tmp_path, STUDY.replace(*change)))
    assert said in str(found.value)


PLANE = """\
edesign_study: 1
title: Rising and falling dampers
project: project.yaml
designs:
  up: {method: viscous, law: oil, kind: rising, bays: 1, storeys: 1, damping: 5 %, amplitude: {drift: 1 %}}
  down: {method: viscous, law: oil, kind: falling, bays: 1, storeys: 2, damping: 5 %, amplitude: {drift: 1 %}}
variants: {both: {design: [up, down]}, one: {design: up}}
histories: [{variants: all, records: motion}]
"""


def plane(folder: Path, *changes: tuple[str, str]) -> Path:
    (folder / "motion.AT2").write_text(RECORD, encoding="utf-8")
    (folder / "project.yaml").write_text(TEXT + LAWS, encoding="utf-8")
    text = PLANE
    for old, new in changes:
        assert text.count(old) == 1
        text = text.replace(old, new)
    path = folder / "study.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def test_a_plane_frame_has_the_dampers_of_several_designs(tmp_path: Path) -> None:
    summary = run_study(load_study(plane(tmp_path)))
    assert all(outcome.status == "completed" for outcome in summary.outcomes), summary.outcomes
    with open_archive(summary.archive) as archive:
        dampers = {name: archive.group(f"analyses/{name}.motion").coords["damper"] for name in ("both", "one")}
    assert {name: of.values.tolist() for name, of in dampers.items()} == {"both": ["R_1_1", "F_1_2"], "one": ["R_1_1"]}


def test_designs_of_two_directions_beside_each_other(tmp_path: Path) -> None:
    """The drift of the chosen round is, to the last digit, that of the variant with both designs.

    What stands along x is hardly felt along y: by what its braces lengthen columns, and by turns of the floors.
    """
    one = STUDY.replace("[pair, one]", "pair")
    forces = []
    for name, text in (
        ("alone", one),
        ("with_x", one.replace("kind: rising, along: y,", "kind: rising, along: y, beside: x,")),
    ):
        (folder := tmp_path / name).mkdir()
        study = load_study(write(folder, text))
        check_study(study)
        summary = run_study(study)
        with open_archive(summary.archive) as archive:
            group = archive.group("designs/y")
        forces.append(group.variables["yield_force"].values)
    np.testing.assert_allclose(forces[1], forces[0], rtol=0.02)
    assert study.beside("y") == ("x",) and group.attributes["beside"] == ["x"]
    assert group.attributes["beside_damping"] < 0.005  # of the 12 % that they add along x
    (shaken,) = [
        of for name, of in histories(summary.archive, "damped").items() if of.attributes["eccentricity"] == "0"
    ]
    along = list(shaken.coords["direction"].values).index("y")
    drift = max(np.abs(shaken.variables[f"storey_drift_{side}"].values[:, along]).max() for side in ("min", "max"))
    chosen = int(str(group.attributes["chosen_round"])) - 1
    assert group.variables["verdict_value"].values[chosen, 0] == drift


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        (
            (("kind: falling", "kind: rising"), ("storeys: 2", "storeys: all")),
            "variants.both.design[1]: `down` places dampers where `up` does: `R_1_1`",
        ),
        ((("storeys: 2,", "storeys: 2, temperature: 10 degC,"),), "`down` and `up` have the law `oil` at different"),
        ((("storeys: 1,", "storeys: 1, along: x,"),), "designs.up.along: a plane frame has one direction"),
        (
            (("storeys: 1,", "storeys: 1, beside: down,"),),
            "designs.up.beside: `down` stands below; designs are sized in",
        ),
        ((("storeys: 2,", "storeys: 2, beside: upp,"),), "designs.down.beside: there is no design `upp`; did you mean"),
        (
            (("storeys: 2,", "storeys: 2, beside: up,"), ("one: {design: up}", "one: {design: down}")),
            "variants.one.design: `down` is sized beside `up`, which the variant lacks; write `design: [up, down]`",
        ),
        (
            (("kind: falling, bays: 1", "places: [{kind: falling, bays: 1}, {kind: falling, bays: 1}]"),),
            "designs.down.places[1]: `F_1_2` stands there by places[0] already",
        ),
        ((("kind: falling, bays", "places: [{kind: falling, bays: 1}], bays"),), "`places` says this for each kind"),
        ((("kind: falling, bays: 1, ", ""),), "designs.down.kind: this key is missing: how the dampers stand; or give"),
    ],
)
def test_designs_that_do_not_go_together_are_refused(
    tmp_path: Path, changes: tuple[tuple[str, str], ...], said: str
) -> None:
    with pytest.raises(InputError) as found:
        load_study(plane(tmp_path, *changes))
    assert said in str(found.value)
