"""Tables of footings and of suites of records: every variant is printed, and what holds of the histories there are."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path

import numpy as np
import pytest

from edesign.archive.dataset import Group, Variable
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.codes.ec8 import SET_RULES
from edesign.frame.footings import DIRECTIONS
from edesign.report.archive.tables import details, overview
from edesign.report.ground_motion.record_tables import _criteria
from edesign.report.response.ground_tables import SHOWN, ground_tables


def on_footings(modulus: float, work: dict[str, float]) -> Group:
    """Results of a history on footings on a soil of one modulus, Pa, with the work of their dashpots, J."""
    group = Group()
    group.coords["footing"] = Variable(("footing",), np.array(list(work)), "", "")
    group.add("footing_formula", ("footing",), ["gazetas"] * len(work), "", "")
    values = {"shear_modulus": modulus, "modulus_ratio": 1.0, "wave_velocity": 200.0, "period": 0.5, "a_0": 0.1}
    values |= {"soil_damping": 0.05, "mass": 0.0}
    for direction in DIRECTIONS:
        for name, value in (("static_stiffness", modulus), ("stiffness", modulus), ("radiation_damping", 0.1)):
            values[f"{name}_{direction}"] = value
        values[f"dashpot_{direction}"] = 1e6
    for name, value in values.items():
        group.add(f"footing_{name}", ("footing",), [value] * len(work), "", "")
    group.add("footing_work_final", ("footing",), list(work.values()), "J", "")
    return group


def test_footings_of_every_variant_are_reported() -> None:
    groups = {"bare": on_footings(60e6, {"A0": 1e3}), "soft": on_footings(30e6, {"A0": 2e3})}
    soils = [table for table in ground_tables(groups) if table.title.startswith("Footings")]
    assert [(table.title, table.texts[0][2]) for table in soils] == [
        ("Footings (bare)", "60.0"),
        ("Footings (soft)", "30.0"),
    ]
    assert len(ground_tables({"one": groups["bare"], "two": groups["bare"]})) == 3  # soils, stiffness, work


def test_work_stands_under_the_footing_that_does_it() -> None:
    """Frames of two variants stand on other footings."""
    groups = {"first": on_footings(60e6, {"A0": 1e3, "B0": 2e3}), "second": on_footings(60e6, {"B0": 3e3})}
    work = ground_tables(groups)[-1]
    assert work.headers == ["analysis", "A0", "B0"]
    assert work.texts == [["first", "1.000", "2.000"], ["second", "-", "3.000"]]


def test_a_page_of_histories_is_shown() -> None:
    work = ground_tables({str(i): on_footings(60e6, {"A0": 1e3}) for i in range(SHOWN + 2)})[-1]
    assert len(work.rows) == SHOWN and work.notes[-1] == f"The first {SHOWN} of {SHOWN + 2} histories."


def test_an_archive_of_a_project_describes_its_footings(tmp_path: Path) -> None:
    path = tmp_path / "project.h5"
    group = on_footings(60e6, {"A0": 1e3})
    group.attributes |= {"kind": "history", "status": "completed", "order": 0}
    with ArchiveWriter(path, Group(attributes={"title": "On footings", "planned": ["shake"]})) as writer:
        writer.write("analyses/shake", group)
        writer.finish()
    with open_archive(path) as opened:
        for tables in (overview(opened), details(opened, "shake")):
            titles = [table.title for table in tables]
            assert {"Footings", "Stiffness and damping of footings"} <= set(titles)


@pytest.mark.parametrize(
    ("run", "found", "words"),
    [(7, 7.0, "the mean of the responses may be used"), (3, 3.0, "histories have 3: the most unfavourable response")],
)
def test_what_a_suite_allows_is_what_its_histories_have(tmp_path: Path, run: int, found: float, words: str) -> None:
    """EN 1998-1, 4.3.3.4.3(3): seven histories allow the mean; three of a suite of seven are no seven."""
    rule = asdict(SET_RULES._use_of_results(7))
    suite = Group(attributes={"suite": True, "criteria": [rule]})
    about = {"kind": "history", "variant": "", "level": "DBE", "status": "completed"}
    with ArchiveWriter(tmp_path / "a.h5", Group(attributes={"kind": "project"})) as writer:
        for number in range(run):
            history = about | {"record": f"motions/r{number}", "record_checksum": str(number)}
            writer.write(f"analyses/DBE.r{number}", Group(attributes=history))
        writer.finish({"status": "completed"})
    with open_archive(tmp_path / "a.h5") as archive:
        (row,) = _criteria(archive, "motions", suite)
        assert row["value"] == found and words in row["detail"] and row["passed"] is None
        assert _criteria(archive, "others", suite) == [rule], "no history has a record of it"
