"""Test files and campaigns: what is read, what is written, and what is refused with its place."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from messages import says

from edesign.damper.testing.campaign import load_campaign, write_campaign
from edesign.damper.testing.campaign_blocks import LawChoice
from edesign.damper.testing.measured_files import read_displacement, read_test, write_test
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.specimen import Specimen
from edesign.errors import InputError

GOOD = "time_s,displacement_mm,force_kN\n0,0,0\n0.001,1.5,2\n0.002,-2,3.5\n"
HEAD = "specimen: {name: p, layers: 2, layer_area_mm2: 41400.0, layer_thickness_mm: 12.0}\n"


def write(folder: Path, text: str, name: str = "a.csv") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    "text",
    [
        GOOD,
        "\ufeff# rig 3\n\n time_s , displacement_mm , force_kN \n0, 0, 0\n# pause\n0.001, 1.5, 2\n0.002, -2, 3.5\n\n",
        "force_N,time_ms,displacement_m\n0,0,0\n2e3,1,1.5e-3\n3500,2,-0.002\n",
        "Time (s);Displacement [cm];Force (MN)\r\n0;0;0\r\n0.001;0.15;0.002\r\n0.002;-0.2;0.0035\r\n",
    ],
)
def test_one_test_in_many_forms(tmp_path: Path, text: str) -> None:
    test = read_test(write(tmp_path, text), temperature_C=25.0, title="x", use="validate")
    assert test.force is not None
    assert test.time == pytest.approx([0.0, 0.001, 0.002])
    assert test.displacement == pytest.approx([0.0, 0.0015, -0.002])
    assert test.force == pytest.approx([0.0, 2e3, 3.5e3])
    assert (test.name, test.title, test.use, test.temperature_C) == ("a", "x", "validate", 25.0)
    assert test.source == str(tmp_path / "a.csv")


ROWS = "0.000,0.0,0.0\n0.001,1.5,2.0\n0.002,-2.0,3.5\n"


@pytest.mark.parametrize(
    ("text", "unread"),
    [
        ("Time (sec),Stroke (mm),Load (kN)\n" + ROWS, ()),
        ("Time,Displacement,Force\n(s),(mm),(kN)\n" + ROWS, ()),
        (
            "MTS793|MPT|ENU|1|2|.|/|:|1|0|0|A\n\nData Acquisition: Timed\nStation Name: frame\n"
            "Time,Axial Displacement,Axial Force\nSec,mm,kN\n" + ROWS,
            (),
        ),
        ("time_s;displacement_mm;force_kN\n" + ROWS.replace(",", ";").replace(".", ","), ()),
        ("Running Time\tAxial Stroke\tLoad\n s\tmm\tkN\n" + ROWS.replace(",", "\t").replace(".", ","), ()),
        ("time_s,displacement_mm,force_kN,\n" + ROWS.replace("\n", ",\n"), ()),
        ("time_s,displacement_mm,force_kN,segment\n" + ROWS.replace("\n", ",1\n"), ("segment",)),
        (
            "Count,time_s,displacement_mm,force_kN,Valve (%)\n" + "".join(f"1,{r},2\n" for r in ROWS.split()),
            ("Count", "Valve (%)"),
        ),
    ],
)
def test_exports_of_test_machines(tmp_path: Path, text: str, unread: tuple[str, ...]) -> None:
    """Names of machines, units in a line of their own, lines above the headers, decimal commas, columns of others."""
    test = read_test(write(tmp_path, text), temperature_C=20.0)
    assert test.time == pytest.approx([0.0, 0.001, 0.002])
    assert test.displacement == pytest.approx([0.0, 0.0015, -0.002])
    assert test.force == pytest.approx([0.0, 2e3, 3.5e3])
    assert test.unread == unread


def test_columns_that_are_not_read_are_reported(tmp_path: Path) -> None:
    for name in ("test_01.csv", "test_02.csv"):
        write(tmp_path, "time_s,displacement_mm,force_kN,segment\n" + ROWS.replace("\n", ",1\n"), name)
    text = HEAD + "tests: [{file: test_01.csv, temperature_C: 20}, {file: test_02.csv, temperature_C: 20}]\n"
    campaign = load_campaign(write(tmp_path, text, "campaign.yaml"))
    assert campaign.notes == ("test_01, test_02: not read: `segment`",)


def test_temperatures_of_the_file(tmp_path: Path) -> None:
    text = "time_s,displacement_mm,force_kN,temperature_F\n0,0,0,68\n1,1,1,77\n2,0,1,86\n"
    test = read_test(write(tmp_path, text))
    assert test.temperature_history == pytest.approx([20.0, 25.0, 30.0])
    assert test.temperature_C == pytest.approx(25.0)
    assert read_test(write(tmp_path, text), temperature_C=20.0).temperature_C == 20.0


def test_a_file_without_force(tmp_path: Path) -> None:
    path = write(tmp_path, "time_s,displacement_mm\n0,0\n1,1\n2,0\n")
    assert read_test(path, temperature_C=20.0, needs_force=False).force is None
    assert read_displacement(path)[1] == pytest.approx([0.0, 0.001, 0.0])
    with pytest.raises(InputError, match=r"a\.csv:1: .*force_kN.*E-TABLE-10"):
        read_test(path, temperature_C=20.0)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "a.csv: E-TABLE-04"),
        ("0,0,0\n1,1,1\n", "a.csv:1 E-TABLE-05"),
        ("time_s,displacement_mm,force_kN\n", "a.csv:1 E-TABLE-04"),
        (
            GOOD.replace("force_kN", "forse_kN"),
            "a.csv:1, column 3 (`forse_kN`): the column is unknown; did you mean `force_kN`",
        ),
        (GOOD.replace("force_kN", "cell 7"), "a.csv:1: `force_kN` cell 7 E-TABLE-10"),
        (GOOD.replace("force_kN", "force_mm"), "a.csv:1, column 3 E-TABLE-12"),
        (GOOD.replace("displacement_mm", "displacement_kN"), "a.csv:1, column 2 E-TABLE-12"),
        (GOOD.replace("force_kN", "force_kn"), "the unit `kn` is unknown; did you mean `force_kN`?"),
        (GOOD.replace("force_kN", "force"), "a.csv:1, column 3 `force_kN`, E-TABLE-12"),
        (GOOD.replace("force_kN", "time_ms"), "a.csv:1, column 3 E-TABLE-11"),
        (GOOD.replace("0.002", "0.001"), "a.csv:4 E-TEST-05"),
        (GOOD.replace("0.002", "0.0005"), "a.csv:4 E-TEST-05"),
        (GOOD + GOOD, "a.csv:6 another E-TEST-05"),
        (GOOD.replace("3.5", "nan"), "a.csv:4, column 3 E-TABLE-08"),
        (GOOD.replace("1.5", ""), "a.csv:3, column 2 E-TABLE-08"),
        (GOOD.replace("1.5", "1.5 mm"), "a.csv:3, column 2 E-TABLE-08"),
        (GOOD.replace(",", ";").replace("1.5", "1,5"), "a.csv:3, column 2 E-TABLE-08"),
        (GOOD.replace(",3.5", ""), "a.csv:4 E-TABLE-07"),
        (GOOD.replace("1.5", "0").replace("-2", "0"), "a.csv:2 E-TEST-06"),
        ("time_s,displacement_mm,force_kN\n0,0,0\n1,1,1\n", "a.csv:3 E-TEST-04"),
        ("time_s\0,displacement_mm\n", "a.csv: E-TABLE-01"),
        ("rig 3\n1,2,3\n" + GOOD, "a.csv:1 E-TABLE-05"),
        (GOOD.replace("\n0,", "\nstart,"), "a.csv:2, column 1 E-TABLE-08"),
        ("Time,Stroke,Load\ns,mm,mm\n0,0,0\n", "a.csv:1, column 3 E-TABLE-12"),
        ("Time,Stroke,Load\n0,0,0\n1,1,1\n2,2,2\n", "a.csv:1, column 1 `time_s`, E-TABLE-12"),
        ("time_s;displacement_mm;force_kN\n0;0;0\n1;1.234,5;1\n", "a.csv:3, column 2 E-TABLE-09"),
    ],
)
def test_wrong_test_files(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(InputError) as raised:
        read_test(write(tmp_path, text), temperature_C=20.0)
    assert says(str(raised.value), said)


def test_files_that_are_not_there(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"no\.csv.*E-FILE-01"):
        read_test(tmp_path / "no.csv", temperature_C=20.0)
    with pytest.raises(InputError, match="E-FILE-02"):
        read_test(tmp_path, temperature_C=20.0)
    with pytest.raises(InputError, match=r"a\.csv:1: .*E-TEST-02"):
        read_test(write(tmp_path, GOOD))


@settings(max_examples=25, deadline=None)
@given(st.lists(st.tuples(st.floats(1e-4, 10.0), st.floats(-1, 1), st.floats(-1e6, 1e6)), min_size=3, max_size=20))
def test_what_is_written_is_read(
    tmp_path_factory: pytest.TempPathFactory, rows: list[tuple[float, float, float]]
) -> None:
    steps, u, force = (np.array(column) for column in zip(*rows, strict=True))
    u[0] += 2.0
    u[1] -= 2.0
    path = tmp_path_factory.mktemp("w") / "t.csv"
    test = DamperTest("t", np.cumsum(steps), u, force, 22.0, 20.0 + u)
    write_test(path, test)
    back = read_test(path, temperature_C=22.0)
    assert back.force is not None and back.temperature_history is not None
    for a, b in ((back.time, test.time), (back.displacement, u), (back.force, force)):
        assert a == pytest.approx(b, rel=1e-8, abs=1e-300)  # nine digits
    assert [path.name for path in path.parent.iterdir()] == ["t.csv"]


def test_a_campaign(tmp_path: Path) -> None:
    for name in ("test_01.csv", "test_02.csv"):
        write(tmp_path, GOOD, name)
    text = (
        "title: T\nspecimen:\n  {name: p, layers: 2, layer_area: 414 cm^2, layer_thickness: 1.2 cm}\n"
        "law: {type: mgmm, parameters: {k1: 0.515 kN/mm, alpha: 0.374}, refit: false}\n"
        "tests:\n  - {file: test_01.csv, title: sweep 0.5 Hz, temperature_C: 20, use: fit}\n"
        "  - {file: test_02.csv, temperature: 298.15 K, use: validate}\n"
    )
    campaign = load_campaign(write(tmp_path, text, "campaign.yaml"))
    assert (campaign.specimen.name, campaign.specimen.layers) == ("p", 2)
    assert (campaign.specimen.layer_area, campaign.specimen.layer_thickness) == pytest.approx((0.0414, 0.012))
    assert campaign.law == LawChoice("mgmm", {"k1": "0.515 kN/mm", "alpha": 0.374}, False)
    assert [test.name for test in campaign.tests] == ["test_01", "test_02"]
    assert [test.temperature_C for test in campaign.tests] == pytest.approx([20.0, 25.0])
    assert [test.name for test in campaign.used_for("validate")] == ["test_02"]
    assert campaign.specimen.stiffness(1e6) == pytest.approx(1e6 * 2 * 0.0414 / 0.012)


def test_the_form_of_the_notes_is_read_and_written(tmp_path: Path) -> None:
    write(tmp_path, GOOD, "test_01.csv")
    text = HEAD + (
        "law: {type: mgmm, parameters: thesis_table_4_2}\n"
        "tests:\n  - {file: test_01.csv, title: 'a: b, # c', temperature_C: 20, use: fit}\n"
    )
    campaign = load_campaign(write(tmp_path, text, "campaign.yaml"))
    written = write_campaign(tmp_path / "new", campaign.specimen, campaign.tests, campaign.law, "no")
    again = load_campaign(written.path)
    assert (again.specimen, again.law, again.title) == (campaign.specimen, campaign.law, "no")
    assert again.tests[0].title == "a: b, # c" and again.tests[0].temperature_C == 20.0
    assert again.tests[0].force == pytest.approx(campaign.tests[0].force)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "campaign.yaml:1:1: E-FILE-05"),
        (HEAD, "tests E-KEY-02"),
        (HEAD + "tests: []\n", "tests: the list is empty"),
        (HEAD + "tests: [{file: no.csv, temperature_C: 20}]\n", "campaign.yaml:2:16 tests[0].file E-FILE-01"),
        (HEAD + "tests: [{file: a.csv, temprature_C: 20}]\n", "unknown key; did you mean `temperature_C`?"),
        (HEAD + "tests: [{file: a.csv, temperature: 20}]\n", "tests[0].temperature E-VALUE-01"),
        (HEAD + "tests: [{file: a.csv, temperature_C: 20 degC}]\n", "tests[0].temperature_C E-UNIT-02"),
        (HEAD + "tests: [{file: a.csv, temperature_C: -300}]\n", "tests[0].temperature_C E-VALUE-02"),
        (HEAD + "tests: [{file: a.csv, temperature: 20 degC, temperature_C: 20}]\n", "tests[0].temperature_C E-KEY-03"),
        (HEAD + "tests: [{file: a.csv}]\n", "a.csv:1: E-TEST-02"),
        (HEAD + "tests: [{file: a.csv, temperature_C: 20, use: fitt}]\n", "`fitt` is unknown; did you mean `fit`?"),
        (
            HEAD + "tests: [{file: a.csv, temperature_C: 1}, {file: a.csv, temperature_C: 2}]\n",
            "tests[1].file line 2 E-FILE-09",
        ),
        (HEAD + "law: {type: mgm}\ntests: [{file: a.csv, temperature_C: 20}]\n", "did you mean `mgmm`?"),
        (
            HEAD.replace("layer_area_mm2: 41400.0, ", "") + "tests: [{file: a.csv, temperature_C: 1}]\n",
            "specimen.layer_area_mm2 E-KEY-02",
        ),
        (
            HEAD.replace("_mm2: 41400.0", ": 41400") + "tests: [{file: a.csv, temperature_C: 1}]\n",
            "specimen.layer_area E-UNIT-01",
        ),
        (
            HEAD.replace("41400.0", "-1") + "tests: [{file: a.csv, temperature_C: 1}]\n",
            "specimen.layer_area_mm2 E-VALUE-02",
        ),
        (
            HEAD.replace("layers: 2", "layers: 0") + "tests: [{file: a.csv, temperature_C: 1}]\n",
            "specimen.layers E-VALUE-02",
        ),
        (
            HEAD + "tests: [{file: bad.csv, temperature_C: 20}, {file: worse.csv, temperature_C: 20}]\n",
            "worse.csv:2, column 1 E-TABLE-08",
        ),
    ],
)
def test_wrong_campaigns(tmp_path: Path, text: str, said: str) -> None:
    write(tmp_path, GOOD)
    write(tmp_path, GOOD.replace("1.5", "x"), "bad.csv")
    write(tmp_path, GOOD.replace("\n0,", "\ny,"), "worse.csv")
    with pytest.raises(InputError) as raised:
        load_campaign(write(tmp_path, text, "campaign.yaml"))
    assert says(str(raised.value), said)


def test_tests_of_one_name_are_not_written(tmp_path: Path) -> None:
    test = DamperTest("t", np.arange(3.0), np.array([0.0, 1.0, 0.0]), np.zeros(3))
    with pytest.raises(InputError, match="called t; .*E-NAME-02"):
        write_campaign(tmp_path / "c", Specimen("p", 1, 1.0, 1.0), [test, test])
    assert not (tmp_path / "c").exists()
