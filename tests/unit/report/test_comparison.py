"""Cells of a comparison, worked by hand from three histories of two storeys; what is missing is named."""

from __future__ import annotations

import csv
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from support.messages import says

from edesign.archive.dataset import Group, Variable
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.errors import InputError
from edesign.project.study.reference_loader import load_reference
from edesign.report.comparison.cells import ComparedCell, Comparison
from edesign.report.comparison.compare import compare
from edesign.report.comparison.files import comparison_data, write_comparison
from edesign.report.comparison.tables import block_tables
from edesign.report.comparison.wide_tables import wide_tables
from edesign.report.tables.text import plain

DRIFTS = {"r1": [0.010, 0.030], "r2": [0.020, 0.010], "r3": [0.030, 0.014]}  # of the two storeys
REFERENCE = """
edesign_reference: 1
title: Hand
tables:
  - title: Mean
    kind: responses
    statistic: mean
    records: suite
    change: {of: damped, against: bare}
    rows:
      - measure: interstorey_drift
        label: drift
        unit: "%"
        within: 5 %
        values: {bare: {DBE: 2.5, MCE: 4}, damped: {DBE: {value: 1.2, note: misprint}}}
        change: {DBE: -52}
      - {measure: interstorey_drift, statistic: mean_profile, label: profile, unit: "%", values: {bare: {DBE: 2}}}
      - {measure: interstorey_drift, statistic: 84%, label: high, unit: "1", values: {bare: {DBE: 0.03}}}
      - {measure: interstorey_drift, statistic: maximum, storeys: [2], label: two, unit: "%", values: {bare: {DBE: 3}}}
      - {measure: column_axial_force, members: [C_B_1], label: N, unit: kN, values: {bare: {DBE: 500}}}
      - {measure: roof_acceleration, label: a, unit: g, values: {bare: {DBE: 1}}}
  - title: Design
    kind: variables
    group: designs/thesis
    over: storey
    within: 10 %
    rows:
      - {variable: storey_stiffness, label: k, unit: kN/m, values: [100, 0.05, 3]}
      - {variable: area_ratio, label: A_D/A_P, unit: "1", values: [26.84, 4.97, 1]}
  - title: Damping
    kind: variables
    group: designs/thesis
    over: mode
    at: {assembly: dampers}
    rows:
      - {variable: damping, label: zeta, unit: "%", values: [9.86]}
"""


def history(name: str, variant: str, drifts: list[float], **attributes: object) -> Group:
    group = Group(coords={"storey": Variable(("storey",), np.array([1, 2]), "1", "storey")})
    group.coords["column"] = Variable(("column",), np.array(["C_A_1", "C_B_1"]), "", "column")
    for end, sign in (("max", 1.0), ("min", -0.5)):
        group.add(f"storey_drift_{end}", ("storey",), sign * np.array(drifts), "1", "drift")
        group.add(f"column_axial_force_{end}", ("column",), sign * np.array([9e5, 5.5e5]), "N", "axial force")
    group.attributes = {"name": name, "kind": "history", "variant": variant, "level": "DBE", "status": "completed"}
    group.attributes |= {"record": f"suite/{name.rpartition('.')[2]}", "height": 7.0, **attributes}
    return group


def design() -> Group:
    group = Group(coords={"storey": Variable(("storey",), np.array([1, 2]), "1", "storey")})
    group.add("storey_stiffness", ("storey",), [1.2e5, 50.0], "N/m", "stiffness")
    group.add("area_ratio", ("storey",), [26.81, 5.07], "1", "area")
    group.coords["assembly"] = Variable(("assembly",), np.array(["braced", "dampers"]), "", "assembly")
    group.coords["mode"] = Variable(("mode",), np.array([1, 2]), "1", "mode")
    group.add("damping", ("assembly", "mode"), [[0.05, 0.04], [0.0999, 0.03]], "1", "damping")
    group.add("rounds", (), 3, "1", "rounds")
    return group


def archive(path: Path, groups: dict[str, Group], planned: list[str] | None = None) -> Path:
    root = Group(attributes={"title": "trial", "planned": planned or []})
    with ArchiveWriter(path, root) as writer:
        for name, group in groups.items():
            writer.write(name, group)
        writer.finish()
    return path


def three(variant: str = "bare", factor: float = 1.0) -> dict[str, Group]:
    named = {f"{variant}.DBE.{name}": [factor * value for value in drifts] for name, drifts in DRIFTS.items()}
    return {f"analyses/{name}": history(name, variant, drifts) for name, drifts in named.items()}


def compared(
    folder: Path, groups: dict[str, Group], planned: list[str] | None = None, text: str = REFERENCE
) -> Comparison:
    reference = folder / "reference.yaml"
    reference.write_text(text, encoding="utf-8")
    with open_archive(archive(folder / "trial.h5", groups, planned)) as opened:
        return compare(opened, load_reference(reference))


def cell(comparison: Comparison, quantity: str, variant: str = "bare", index: str = "") -> ComparedCell:
    (one,) = [
        each
        for each in comparison.cells
        if each.quantity == quantity and (each.variant in ("", variant)) and each.level != "MCE" and each.index == index
    ]
    return one


def test_statistics_by_hand(tmp_path: Path) -> None:
    comparison = compared(tmp_path, three())
    mean = cell(comparison, "drift")
    assert mean.found == pytest.approx((3.0 + 2.0 + 3.0) / 3.0)  # maxima over the storeys: 3, 2, 3 %
    assert mean.difference == pytest.approx((8.0 / 3.0 - 2.5) / 2.5) and mean.inside is False  # 6.7 % for 5 %
    assert (mean.count, mean.of, mean.missing) == (3, 3, ())
    assert cell(comparison, "profile").found == pytest.approx(2.0)  # means of the storeys: 2.0 and 1.8 %
    assert cell(comparison, "high").found == pytest.approx(0.03)  # the third of three
    assert cell(comparison, "two").found == pytest.approx(3.0)
    assert cell(comparison, "N").found == pytest.approx(550.0)  # of column B, not the 900 of column A
    assert cell(comparison, "N").inside is None  # it has no bar


def test_the_change_is_that_of_the_statistics(tmp_path: Path) -> None:
    comparison = compared(tmp_path, {**three(), **three("damped", 0.5)})
    (change,) = comparison.tables[0].changes
    assert change.found == pytest.approx(-0.5) and change.reference == -0.52
    assert change.difference == pytest.approx(0.02)
    assert cell(comparison, "drift", "damped").note == "misprint"


def test_histories_without_a_value_are_named(tmp_path: Path) -> None:
    groups = three()
    groups["analyses/bare.DBE.r2"].attributes |= {"status": "failed", "reason": "no convergence at 3 s"}
    comparison = compared(tmp_path, groups, [*(name.partition("/")[2] for name in groups), "bare.DBE.r4"])
    mean = cell(comparison, "drift")
    assert mean.found == pytest.approx(3.0) and (mean.count, mean.of) == (2, 4)
    assert set(mean.missing) == {"bare.DBE.r2", "bare.DBE.r4"}
    assert cell(comparison, "profile").found == pytest.approx(2.2)  # (1.0 + 3.0) / 2 and (3.0 + 1.4) / 2
    assert comparison.reasons == {"bare.DBE.r2": "failed: no convergence at 3 s", "bare.DBE.r4": "not run"}
    acceleration = cell(comparison, "a")  # no history has it
    assert acceleration.found is None and acceleration.count == 0 and acceleration.of == 4
    text = "\n".join(plain(table) for table in block_tables(comparison))
    assert "without bare.DBE.r2: failed: no convergence at 3 s" in text and "without bare.DBE.r4: not run" in text
    assert "no history of `damped` at `DBE`" in text and "2/4" in text and "0/4" in text


def test_other_histories_do_not_count(tmp_path: Path) -> None:
    others = {
        "analyses/damped.35C.DBE.r1": history("damped.35C.DBE.r1", "bare", [0.9, 0.9], temperature_C=35.0),
        "analyses/ida.r1": history("ida.r1", "bare", [0.9, 0.9], incremental="ida", intensity=1.0),
        "analyses/bare.MCE.r1": history("bare.MCE.r1", "bare", [0.9, 0.9], level="SLE"),
        "analyses/bare.DBE.el_centro": history("el", "bare", [0.9, 0.9], record="el_centro"),
    }
    comparison = compared(tmp_path, {**three(), **others})
    assert cell(comparison, "drift").found == pytest.approx(8.0 / 3.0)
    without = REFERENCE.replace("    records: suite\n", "")
    (tmp_path / "all").mkdir()
    mixed = compared(tmp_path / "all", {**three(), **others}, text=without)
    assert cell(mixed, "drift").of == 4
    assert mixed.tables[0].notes == ("bare, DBE: records of el_centro, suite together; `records` chooses",)


def test_variables_in_printed_units(tmp_path: Path) -> None:
    comparison = compared(tmp_path, {"designs/thesis": design()})
    first, second = cell(comparison, "k", index="1"), cell(comparison, "k", index="2")
    assert first.found == pytest.approx(120.0) and first.difference == pytest.approx(0.2) and first.inside is False
    assert second.found == pytest.approx(0.05) and second.inside is True
    third = cell(comparison, "k", index="3")
    assert third.found is None and third.reason == "there are 2 values" and third.inside is False
    assert cell(comparison, "A_D/A_P", index="1").found == pytest.approx(26.81)
    assert cell(comparison, "zeta", index="1").found == pytest.approx(9.99)  # of `dampers`, mode 1
    absent = compared(tmp_path, three())
    assert absent.tables[1].notes == ("the archive has no designs/thesis",)
    assert all(one.inside is False for one in absent.tables[1].cells)


def test_a_failed_design_leaves_its_values_out(tmp_path: Path) -> None:
    failed = Group(attributes={"status": "failed", "reason": "no convergence"})
    comparison = compared(tmp_path, {"designs/thesis": failed})
    assert comparison.tables[1].notes == ("designs/thesis: failed: no convergence",)
    assert all(one.found is None and one.inside is False for one in comparison.tables[1].cells)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (
            "variable: storey_stiffness",
            "variable: storey_stifness",
            "28:20: designs/thesis: `storey_stifness`",
        ),
        ("variable: storey_stiffness", "variable: rounds", "28:20: designs/thesis: `rounds` E-ARCH-07"),
        ("unit: kN/m", "unit: kN", "28:54: `1 kN` E-UNIT-02"),
        ("at: {assembly: dampers}", "at: {assembly: damper}", "34:20: designs/thesis: `damper` E-NAME-01"),
    ],
)
def test_what_a_group_does_not_have_is_an_error(tmp_path: Path, old: str, new: str, said: str) -> None:
    with pytest.raises(InputError) as caught:
        compared(tmp_path, {"designs/thesis": design()}, text=REFERENCE.replace(old, new))
    assert says(str(caught.value), said)


def test_blocks_fit_a_terminal_and_bars_are_reported(tmp_path: Path) -> None:
    comparison = compared(tmp_path, {**three(), **three("damped", 0.5), "designs/thesis": design()})
    tables = block_tables(comparison, bars=True)
    text = "\n".join(plain(table) for table in tables)
    assert max(len(line) for table in tables for line in plain(table).splitlines()[1:] if table.headers) <= 80
    assert "5 NOT met" in text and "10 met" in text and "misprint" in text
    assert "15 reference values, 11 of them found" in text and "9 of them have a bar, 3 are" in text


def test_wide_tables_hold_every_cell_once(tmp_path: Path) -> None:
    comparison = compared(tmp_path, {**three(), **three("damped", 0.5), "designs/thesis": design()})
    wide = {table.title: table for table in wide_tables(comparison)}
    drift = wide["Mean - DBE"].texts[0]
    assert drift == ["drift [%]", "2.5", "2.67", "+6.7", "1.2 (1)", "1.33", "+11.1", "-52", "-50.0"]
    assert wide["Mean - MCE"].texts[0][:4] == ["drift [%]", "4", "-", "-"]
    assert wide["Design"].texts[0] == ["1", "100", "120", "+20.0", "26.84", "26.81", "-0.1"]


def test_files_hold_every_cell(tmp_path: Path) -> None:
    comparison = compared(tmp_path, {**three(), "designs/thesis": design()})
    write_comparison(comparison, tmp_path / "cells.csv")
    with (tmp_path / "cells.csv").open(encoding="utf-8", newline="") as file:
        lines = list(csv.DictReader(file))
    assert len(lines) == len(comparison.cells)
    assert float(lines[0]["found"]) == cell(comparison, "drift").found and lines[0]["inside"] == "false"
    titled = replace(comparison, tables=tuple(replace(table, title="=1+1") for table in comparison.tables))
    write_comparison(titled, tmp_path / "cells.csv")
    with (tmp_path / "cells.csv").open(encoding="utf-8", newline="") as file:
        assert {line["table"] for line in csv.DictReader(file)} == {"'=1+1"}  # no formula of a spreadsheet
    data = comparison_data(comparison)
    assert [len(table["cells"]) for table in data["tables"]] == [8, 6, 1] and data["outside"] == len(comparison.outside)
    assert data["tables"][0]["cells"][0]["difference"] == cell(comparison, "drift").difference
