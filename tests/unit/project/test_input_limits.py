"""Files that are too large are refused at once, whatever they are."""

from __future__ import annotations

import gzip
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from messages import says

from edesign.calibration.properties.campaign import load_property_campaign
from edesign.calibration.structures.campaign import load_structure_campaign
from edesign.damper.law_file import read_law_file
from edesign.damper.testing.campaign import load_campaign
from edesign.damper.testing.measured_files import read_test
from edesign.damper.testing.programme_file import load_programme
from edesign.damper.testing.property_table import read_property_table
from edesign.errors import InputError
from edesign.ground_motion.formats.read import read_record_file
from edesign.ground_motion.suite import load_suite
from edesign.project import load_project
from edesign.project.reading import limits
from edesign.project.reading.yaml_nodes import parse
from edesign.project.study.reference_loader import load_reference
from edesign.project.study.study_loader import load_study
from edesign.tables.compressed import read_table

REFUSAL = 2.0
"""s, for a refusal. It reads the size of a file, or counts signs in 4 MB, which takes some milliseconds. To parse
the files of these tests takes from 20 s to minutes. The rest is for a loaded machine."""

YAML_READERS: tuple[Callable[[Path], object], ...] = (
    load_project,
    load_study,
    load_suite,
    load_reference,
    load_campaign,
    load_structure_campaign,
    load_property_campaign,
    load_programme,
    read_law_file,
)
TABLE_READERS: tuple[Callable[[Path], object], ...] = (read_record_file, read_test, read_property_table, read_table)


@contextmanager
def refused_at_once(said: str) -> Iterator[None]:
    begin = time.process_time()
    with pytest.raises(InputError) as caught:
        yield
    assert time.process_time() - begin < REFUSAL
    assert says(str(caught.value), said)


@pytest.mark.parametrize("read", YAML_READERS)
def test_yaml_files(read: Callable[[Path], object], tmp_path: Path) -> None:
    path = tmp_path / "large.yaml"
    path.write_text("# a comment\n" * 5_000_000)
    with refused_at_once(f"{path}: E-FILE-02"):
        read(path)
    with refused_at_once("60 MB 4 MB E-FILE-02"):
        read(path)
    path.write_text("edesign: 1\ntitle:\n" + "- a\n" * 600_000)
    with refused_at_once("600003 300000 E-FILE-02"):
        read(path)


@pytest.mark.parametrize(
    "text",
    ["- a\n" * 600_000, "-\n" * 600_000, "a: [" + "1," * 600_000 + "]", "[" * 600_000, '{"a":' * 300_000,
     "".join(f"k{i}: 1\n" for i in range(320_000)), "{" + "a, " * 600_000 + "}"],
)  # fmt: skip
def test_every_way_to_write_many_values_is_counted(text: str) -> None:
    begin = time.process_time()
    root, faults = parse(text)
    assert time.process_time() - begin < REFUSAL
    assert not root.entries and len(faults) == 1 and says(faults[0].message, "values 300000 E-FILE-02")


def test_nesting_and_aliases_do_not_grow() -> None:
    begin = time.process_time()
    for text in ("a: " + "[" * 100_000, "\n".join(" " * i + "a:" for i in range(1_000))):
        assert says(parse(text)[1][0].message, "30 levels E-FILE-04")
    lines = ["a0: &a0 [x, x]", *(f"a{i}: &a{i} [{', '.join(9 * [f'*a{i - 1}'])}]" for i in range(1, 30))]
    faults = parse("\n".join(lines))[1]  # 9^29 values if aliases stood for them
    assert time.process_time() - begin < REFUSAL
    assert says(faults[0].message, "`&a0` E-FILE-04")


@pytest.mark.parametrize("read", TABLE_READERS)
def test_tables(read: Callable[[Path], object], tmp_path: Path) -> None:
    path = tmp_path / "large.csv"
    path.touch()
    os.truncate(path, 2_500_000_000)  # takes no space on the disk
    with refused_at_once(f"{path}: E-FILE-02"):
        read(path)
    with refused_at_once("2.5 GB 300 MB E-FILE-02"):
        read(path)


def test_compressed_tables(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("edesign.tables.compressed.TABLE_BYTES", 1_000_000)
    bomb = tmp_path / "bomb.csv.gz"
    bomb.write_bytes(gzip.compress(bytes(40_000_000)))  # 40 kB
    with refused_at_once(f"{bomb}: 40 MB 1 MB E-FILE-02"):
        read_table(bomb)
    bomb.write_bytes(gzip.compress(bytes(40_000_000)) + gzip.compress(b"1"))  # whose end says one byte
    with refused_at_once(f"{bomb}: more than 1 MB E-FILE-02"):
        read_table(bomb)
    bomb.write_bytes(b"no compressed file, whose last bytes say nothing")
    with pytest.raises(InputError, match="E-TABLE-02"):
        read_table(bomb)


def test_matlab_files_that_grow(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from scipy.io import savemat

    path = tmp_path / "capture.mat"
    savemat(path, {"a": np.zeros(1_000_000)}, do_compression=True)
    assert path.stat().st_size < 100_000
    monkeypatch.setattr("edesign.tables.matlab.TABLE_BYTES", 1_000_000)
    with pytest.raises(InputError, match=r"capture\.mat: .* more than 1 MB.*E-FILE-02"):
        read_test(path)


LIMITED = {
    "one line": ("0.1," * 5_000_000, ":1: 20000000 250000 E-TABLE-03"),
    "digits": ("1" * 5_000_000, ":1: 5000000 E-TABLE-03"),
    "blanks": ("1,2\n" + " " * 5_000_000 + "x", ":2: 5000001 E-TABLE-03"),
    "columns": ("t,a\n1,2\n" + "1," * 20_000, ":3: 20001 10000 E-TABLE-03"),
    "words": ("1 2\n" + "a " * 20_000, ":2: 20000 E-TABLE-03"),
    "lines": ("1,2\n" * 5_000_003, ":5000001: 5000000 E-TABLE-03"),
    "carriage returns": ("1,2" + "\r" * 5_000_001 + "1", ":5000001: 5000000 E-TABLE-03"),
    "cells": (("1,2,3,4,5,6,7,8,9,0" + "\n") * 2_300_000, ": 20700000 20000000 E-TABLE-03"),
}


@pytest.mark.parametrize("name", LIMITED)
@pytest.mark.parametrize("read", (partial(read_record_file, acceleration_unit="g"), *TABLE_READERS[1:]))
def test_text_that_is_small_to_write_and_large_to_read(
    read: Callable[[Path], object], name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Refused by counting, before a cell is parsed;"""
    path = tmp_path / "large.csv"
    text, said = LIMITED[name]
    path.write_text(text, encoding="utf-8")
    monkeypatch.setattr("edesign.tables.text.is_number", lambda cell: pytest.fail("a cell was parsed"))
    with pytest.raises(InputError) as caught:
        read(path)
    assert says(str(caught.value), f"{path}{said}")


def test_within_the_limits_the_work_grows_as_the_text(tmp_path: Path) -> None:
    """Lines of one sign, as long as they may be: what looks at them takes no square of their length.

    A square of 250 000 is ten minutes of a processor; the limit of processor time is a safety net alone.
    """
    program = "import resource; resource.setrlimit(resource.RLIMIT_CPU, (60, 60))\nimport sys\n"
    program += (
        "from edesign.cli.main import main\nfor path in sys.argv[1:]:\n  for c in 'check', 'inspect': main([c, path])"
    )
    paths = []
    for i, line in enumerate((" " * 240_000 + "x", "1" + " " * 240_000 + "x", "a (" * 8_000, "\t" * 9_000 + "x")):
        paths.append(tmp_path / f"{i}.csv")
        paths[-1].write_text((line + "\n") * 5 + "1,2\n" * 5, encoding="utf-8")
    done = subprocess.run([sys.executable, "-c", program, *map(str, paths)], capture_output=True, check=False)
    assert done.returncode == 0, done.stderr.decode()


def test_a_value_that_overflows_with_its_unit_is_reported_with_its_place(
    tmp_path: Path, recwarn: pytest.WarningsRecorder
) -> None:
    path = tmp_path / "a.csv"
    path.write_text("time_s,displacement_mm,force_kN\n" + "".join(f"{i},{i % 3},1e{300 + i}\n" for i in range(9)))
    with pytest.raises(InputError, match=r"a\.csv:8, column 3 \(`force_kN`\): 1e\+306 .*E-TABLE-08"):
        read_test(path)  # 1e306 kN are 1e309 N, above the largest double of 1.8e308
    path.write_text("0.00,1\n0.01,2\n0.02,1e308\n0.03,1\n0.04,2\n0.05,1\n")
    with pytest.raises(InputError, match=r"a\.csv: sample 3 .*1e\+308 g.*E-UNIT-03"):
        read_record_file(path, acceleration_unit="g")
    assert not recwarn.list


@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="a device without end")
def test_a_device_without_end_is_refused() -> None:
    with pytest.raises(InputError, match="/dev/zero: .*E-FILE-02"):
        load_project("/dev/zero")


def test_the_limits_are_a_hundred_times_what_there_is() -> None:
    folder = Path(__file__).parents[3]
    files = [path for name in ("projects", "records/suites") for path in (folder / name).rglob("*.yaml")]
    texts = [path.read_text(encoding="utf-8") for path in files]
    assert files and 100 * max(map(len, texts)) < limits.YAML_BYTES

    def count(text: str) -> int:
        return sum(text.count(sign) for sign in (",", "[", ":", "- "))  # no fewer than there are values

    assert 100 * max(count(text) for text in texts) < limits.YAML_VALUES


def test_of_very_many_problems_the_first_are_shown(tmp_path: Path) -> None:
    path = tmp_path / "project.yaml"
    path.write_text("edesign: 1\n" + "".join(f"key_{i}: 1\n" for i in range(1000)))
    with pytest.raises(InputError) as caught:
        load_project(path)
    lines = str(caught.value).splitlines()
    assert len(lines) == 101 and "key_0" in str(caught.value)
    assert lines[-1].endswith(f" problems in {path}, of which the first 100 are shown")
