"""Tables of every form that can be declared: what is written is read, and what is damaged is refused with its place."""

from __future__ import annotations

import math
import random
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from messages import says

from edesign.damper.testing.campaign import load_campaign
from edesign.damper.testing.measured_files import read_test
from edesign.errors import InputError
from edesign.ground_motion.formats.read import read_record_file
from edesign.project.notation.table_format import Decimal, Delimiter, Encoding, TableFormat
from edesign.tables.columns import Chosen
from edesign.tables.form import SIGNS
from edesign.tables.quantities import names_quantity
from edesign.tables.table import read_table
from edesign.tables.text import encoding_of

CODECS: dict[Encoding, str] = {
    "utf-8": "utf-8",
    "utf-16": "utf-16",
    "latin-1": "latin-1",
    "windows-1252": "cp1252",
    "gbk": "gbk",
    "shift-jis": "shift-jis",
}
NUMBERS = st.floats(-1e12, 1e12, allow_nan=False)


@settings(max_examples=150, deadline=None)
@given(
    rows=st.lists(st.tuples(NUMBERS, NUMBERS, NUMBERS), min_size=1, max_size=8),
    encoding=st.sampled_from(list(CODECS)),
    skip=st.integers(0, 4),
    headers=st.booleans(),
    units_row=st.booleans(),
    delimiter=st.sampled_from(list(SIGNS)),
    decimal=st.sampled_from(["point", "comma"]),
    end=st.sampled_from(["\n", "\r\n", "\r"]),
    trailing=st.booleans(),
)
def test_a_table_of_any_declared_form_is_read_exactly(
    tmp_path_factory: pytest.TempPathFactory,
    rows: list[tuple[float, float, float]],
    encoding: Encoding,
    skip: int,
    headers: bool,
    units_row: bool,
    delimiter: Delimiter,
    decimal: Decimal,
    end: str,
    trailing: bool,
) -> None:
    """repr has all digits of a number, so that it is read back as it was: nothing is lost on the way."""
    if delimiter == "comma" and decimal == "comma":
        return
    sign = SIGNS[delimiter] or "   "
    lines = [f"anything {i}, {i}; {i}" for i in range(skip)]
    if headers:
        lines.append(sign.join(("alpha", "beta", "gamma")))
        lines += [sign.join(("volt", "ampere", "ohm"))] if units_row else []
    point = "." if decimal == "point" else ","
    tail = sign if trailing and SIGNS[delimiter] and not headers else ""
    lines += [sign.join(repr(value).replace(".", point) for value in row) + tail for row in rows]
    path = tmp_path_factory.mktemp("t") / "t.csv"
    path.write_bytes((end.join(lines) + end).encode(CODECS[encoding]))
    said = TableFormat(
        encoding=encoding,
        skip=skip,
        headers=headers,
        units_row=units_row and headers,
        delimiter=delimiter,
        decimal=decimal,
    )
    table = read_table(path, "table", "a,b", lambda _: False, given=said)
    np.testing.assert_array_equal(table.rows, np.array(rows))
    first = skip + headers + (headers and units_row) + 1
    assert table.lines.tolist() == list(range(first, first + len(rows)))
    plain = ("alpha", "beta", "gamma")
    assert [name.partition(" (")[0] for name in table.headers] == (list(plain) if headers else ["1", "2", "3"])


ROWS = [(0.0, 0.25, 1.5), (0.01, 1.5, 2.0), (0.02, -2.0, 3.25), (0.03, 0.125, -0.5)]


def block(sign: str, point: str = ".", end: str = "\r\n", lead: str = "") -> str:
    return "".join(lead + sign.join(f"{value:.6f}".replace(".", point) for value in row) + end for row in ROWS)


EXPORTS = {
    "MTS": (
        "MTS793|MPT|DEU|1|2|,|.|:|1|0|0|A\r\n\r\nData Acquisition: Timed\r\nStation Name: Prüfstand\r\n"
        "Zeit\tWeg\tKraft\r\nSec\tmm\tkN\r\n" + block("\t", ",")
    ),
    "Instron": '"Instron 8802 Prüfung"\n"Prüfzeit";"Weg";"Kraft"\n"(s)";"(mm)";"(kN)"\n' + block(";", ",", "\n"),
    "dSPACE": (
        "sep=,\ndescriptions,,,\nControlDesk,7.4,Prüfstand,\n"
        'path,"Platform()://Model Root/time","Platform()://Model Root/disp","Platform()://Model Root/force"\n'
        "unit,s,mm,kN\ntrace_values" + block(",", ".", "\n", ",")
    ),
}


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "latin-1"])
@pytest.mark.parametrize("maker", list(EXPORTS))
def test_exports_are_known_by_their_marks_in_three_encodings(tmp_path: Path, maker: str, encoding: str) -> None:
    path = tmp_path / "export.csv"
    path.write_bytes(EXPORTS[maker].encode(encoding))
    test = read_test(path, temperature_C=20.0)
    np.testing.assert_array_equal(test.time, [row[0] for row in ROWS])
    np.testing.assert_array_equal(test.displacement, [1e-3 * row[1] for row in ROWS])
    np.testing.assert_array_equal(test.force, [1e3 * row[2] for row in ROWS])
    assert f"as exported by {maker}" in test.reading


@pytest.mark.parametrize(
    ("headers", "encoding", "found"),
    [
        ("时间(秒),位移(毫米),力(千牛)", "gbk", "gbk"),
        ("時間(s),変位(mm),荷重(kN)", "shift-jis", "shift-jis"),
        ("tempo (s),spostamento (mm),forza (kN)", "utf-8", "utf-8"),
        ("temps (s),déplacement (mm),force (kN)", "latin-1", "windows-1252"),
        ("tiempo_s,desplazamiento_mm,fuerza_kN", "utf-8", "utf-8"),
        ("Time (s),Position (mm),Load Cell (kN)", "utf-8", "utf-8"),
    ],
)
def test_names_in_other_languages(tmp_path: Path, headers: str, encoding: str, found: str) -> None:
    path = tmp_path / "t.csv"
    path.write_bytes((headers + "\n" + block(",", end="\n")).encode(encoding))
    assert encoding_of(path.read_bytes()) == found
    test = read_test(path, temperature_C=20.0)
    np.testing.assert_array_equal(test.force, [1e3 * row[2] for row in ROWS])


@pytest.mark.parametrize(
    ("length", "force"), [("inch", "lbs"), ("inches", "lbf"), ("Inch", "lb"), ("in", "pounds"), ("inches", "kips")]
)
def test_american_units_in_all_their_spellings(tmp_path: Path, length: str, force: str) -> None:
    """By definition 1 in = 25.4 mm, and 1 lbf = 0.45359237 kg x 9.80665 m/s2."""
    rows = "".join(f"2024-05-01 12:00:0{i},{i},{2 * i}\n" for i in range(3))
    test = read_test(write(tmp_path, f"Timestamp,Stroke ({length}),Load [{force}]\n{rows}"), temperature_C=20.0)
    newtons = 0.45359237 * 9.80665 * (1000.0 if force == "kips" else 1.0)
    np.testing.assert_allclose(test.displacement, [0.0, 0.0254, 0.0508], rtol=1e-14)  # rounding
    np.testing.assert_allclose(test.force, [0.0, 2.0 * newtons, 4.0 * newtons], rtol=1e-14)


def write(folder: Path, text: str, encoding: str = "utf-8") -> Path:
    path = folder / "t.csv"
    path.write_bytes(text.encode(encoding))
    return path


HEAD = "time_s;displacement_mm;force_kN\n"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (HEAD + "0;0;0\n1;1,234;1\n2;2,345;3\n", "t.csv:2 E-TABLE-09"),
        (HEAD + "0;0;0\n1;---;1\n2;2;3\n", "t.csv:3, column 2 E-TABLE-08"),
        (HEAD + "0;0;0\n1;1;OVERFLOW\n2;2;3\n", "t.csv:3, column 3 E-TABLE-08"),
        (HEAD + "0;0;0\n1;1;2\n2;2\n", "t.csv:4 E-TABLE-07"),
        ("Zeit (s);Weg (mm);Kraft (kN);Last (kN)\n0;0;0;0\n1;1;1;1\n2;1;1;1\n", "t.csv:1, column 4 E-TABLE-11"),
        ("Time;Stroke (mm);Load (kN)\n12:00:00;0;0\n12:00:01;1;1\nx;2;2\n", "t.csv:4 E-TABLE-16"),
        ("Time;Stroke (mm);Load (kN)\n05/01/2024 12:00:00;0;0\n", "t.csv:2, column 1 2024-05-01 E-TABLE-08"),
        ("Time;Stroke (mm);Load (kN)\n2024-02-30 12:00:00;0;0\n", "t.csv:2 E-TABLE-16"),
    ],
)
def test_what_is_refused(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(InputError) as raised:
        read_test(write(tmp_path, text), temperature_C=20.0)
    assert says(str(raised.value), said)


def test_a_file_in_utf_16_that_is_cut_off(tmp_path: Path) -> None:
    path = tmp_path / "t.csv"
    path.write_bytes((HEAD + "0;0;0\n").encode("utf-16")[:-1])
    with pytest.raises(InputError, match=r"t\.csv:2.*E-TABLE-01"):
        read_test(path, temperature_C=20.0)


@pytest.mark.parametrize(
    ("before", "after"),
    [("2024-02-28 ", "2024-02-29 "), ("28.02.2024 ", "29.2.2024 "), ("28.02.2024T", "29.02.2024T"), ("", "")],
)
def test_clock_times_go_over_midnight(tmp_path: Path, before: str, after: str) -> None:
    rows = [f"{before}23:59:59.99;0;0", f"{after}00:00:00.00;1;1", f"{after}00:00:00.02;2;-1"]
    test = read_test(write(tmp_path, "Time;Stroke (mm);Load (kN)\n" + "\n".join(rows) + "\n"), temperature_C=20.0)
    np.testing.assert_allclose(test.time, [0.0, 0.01, 0.03], atol=1e-9)  # to nanoseconds


def test_a_gap_is_reported_and_a_change_of_the_rate_is_none(tmp_path: Path) -> None:
    time = np.arange(100) / 100.0
    cut = np.delete(time, np.arange(40, 50))
    slower = np.concatenate([time, 1.0 + np.arange(20) / 2.0])

    def reading(of: np.ndarray) -> str:
        rows = "".join(f"{t:.3f};{np.sin(6.0 * t):.6f};{t:.3f}\n" for t in of)
        return read_test(write(tmp_path, HEAD + rows), temperature_C=20.0).reading

    assert reading(cut).endswith("no samples for 0.11 s before line 42, interpolated")
    assert "no samples" not in reading(time) + reading(slower)


def test_headers_that_come_again_are_left_out_and_reported(tmp_path: Path) -> None:
    text = HEAD + "0;0;0\n1;1;1\n" + HEAD + "2;2;2\n"
    test = read_test(write(tmp_path, text), temperature_C=20.0)
    assert test.time.tolist() == [0.0, 1.0, 2.0] and "1 repeated line of headers left out" in test.reading


CAMPAIGN = "specimen: {name: p, layers: 2, layer_area_mm2: 41400, layer_thickness_mm: 12}\n"


@pytest.mark.parametrize(
    ("zero", "first", "reported"),
    [
        (
            "as_recorded",
            2.0,
            "the first sample is displaced by 2 mm, taken as recorded, rest before the motion for 0.2 s",
        ),
        ("first_sample", 0.0, "2 mm, the displacement of the first sample, taken off all"),
        ("rest", 0.0, "2 mm, the displacement of the rest, taken off all, rest before the motion for 0.2 s"),
    ],
)
def test_columns_units_and_zero_are_said_in_the_campaign(
    tmp_path: Path, zero: str, first: float, reported: str
) -> None:
    rows = [(0.01 * i, 2.0 if i < 20 else 2.0 + math.sin(0.3 * (i - 19)), -0.5 * i) for i in range(60)]
    write(tmp_path, "rig 3\n\nCh 1;Ch 2;Ch 3\n" + "".join(f"{a!r};{b!r};{c!r}\n" for a, b, c in rows))
    said = (
        CAMPAIGN + "columns: {time: Ch 1, displacement: 2, force: Ch 3}\n"
        "units: {time: s, displacement: mm, force: kN/10}\nreversed: [force]\ntable: {skip: 2}\n"
        f"tests: [{{file: t.csv, temperature: 20 degC, displacement_zero: {zero}}}]\n"
    )
    path = tmp_path / "campaign.yaml"
    path.write_text(said)
    campaign = load_campaign(path)
    (test,) = campaign.tests
    np.testing.assert_array_equal(test.time, [row[0] for row in rows])
    assert test.displacement[0] == pytest.approx(1e-3 * first, abs=1e-12)  # of sums of decimals
    np.testing.assert_allclose(test.force, [50.0 * i for i in range(60)], rtol=1e-15)
    assert reported in campaign.notes[0]


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ("columns: {displacement: Ch 9}", "there is no column `Ch 9` (displacement); did you mean `Ch 3`?"),
        ("columns: {displacement: 7}", "t.csv:1 E-TABLE-10"),
        ("columns: {displacement: 2, force: Ch 2}", "t.csv:1, column 2 E-TABLE-11"),
        ("columns: {displacement: 2, time: 1}, units: {displacement: kN, time: s}", "t.csv:1, column 2 E-TABLE-12"),
        ("columns: {displacement: 2, time: 1}", "t.csv:1, column 1 E-TABLE-12"),
        ("table: {encoding: utf8}", "`utf8` is unknown; did you mean `utf-8`?"),
        ("table: {skip: -1}", "tests[0].table.skip E-VALUE-02"),
        (
            "time_step: 0.01 s, columns: {displacement: 2, time: 1}, units: {displacement: mm, time: s}",
            "t.csv:1 E-TEST-03",
        ),
    ],
)
def test_wrong_declarations(tmp_path: Path, keys: str, said: str) -> None:
    write(tmp_path, "Ch 1;Ch 2;Ch 3\n0;0;1\n1;1;2\n2;2;3\n")
    path = tmp_path / "campaign.yaml"
    path.write_text(CAMPAIGN + f"tests: [{{file: t.csv, temperature: 20 degC, {keys}}}]\n")
    with pytest.raises(InputError) as raised:
        load_campaign(path)
    assert says(str(raised.value), said)


def test_two_thousand_damaged_files_are_read_or_refused(tmp_path: Path) -> None:
    """Bytes changed, cut out and put in: what becomes of it has finite numbers, or is refused."""
    chance = random.Random(7)
    sources = [text.encode(codec) for text in EXPORTS.values() for codec in ("utf-8", "utf-16", "latin-1")]
    path = tmp_path / "t.csv"
    refused = 0
    for i in range(2000):
        data = bytearray(chance.choice(sources))
        for _ in range(chance.randint(1, 4)):
            at = chance.randrange(len(data))
            kind = chance.randrange(4)
            if kind == 0:
                data[at] = chance.randrange(256)
            elif kind == 1:
                del data[at : at + chance.randint(1, 30)]
            elif kind == 2:
                data[at:at] = chance.choice(
                    [b"NaN", b"---", b",", b";", b"\t", b"\n", b'"', b"1,234", b"\xff\xfe", b":"]
                )
            else:
                del data[at:]
            data = data or bytearray(b"x")
        path.write_bytes(bytes(data))
        try:
            assert (_as_test, _as_record)[i % 2](path)
        except InputError as error:
            assert "t.csv" in str(error)
            refused += 1
    assert 1000 < refused < 2000


def _as_test(path: Path) -> bool:
    test = read_test(path, temperature_C=20.0)
    return bool(np.isfinite(test.displacement).all() and np.isfinite(test.force).all())


def _as_record(path: Path) -> bool:
    record = read_record_file(path, file_format="table", acceleration_unit="g", time_column=1, acceleration_column=2)
    return bool(np.isfinite(record.acceleration).all())


def test_plain_names_are_taken_before_others(tmp_path: Path) -> None:
    text = "time_s;Position (mm);displacement_mm;Kraft (kN);force_kN\n0;9;0;9;0\n1;9;1;9;2\n2;9;2;9;1\n"
    test = read_test(write(tmp_path, text), temperature_C=20.0)
    assert test.unread == ("Position (mm)", "Kraft (kN)") and test.displacement.tolist() == [0.0, 1e-3, 2e-3]
    assert names_quantity("Position (mm)") and Chosen({"time": "x"}).names("x")
