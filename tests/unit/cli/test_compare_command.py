"""`edesign compare`: tables, files, and the exit code of its check."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from support.messages import says

from edesign.archive.dataset import Group, Variable
from edesign.archive.writer import ArchiveWriter
from edesign.cli.main import main

REFERENCE = """edesign_reference: 1
title: Old report
tables:
  - title: Design
    kind: variables
    group: designs/a
    over: storey
    rows:
      - {variable: storey_stiffness, label: k, unit: kN/m, within: 5 %, values: [100, 50]}
"""


@pytest.fixture
def files(tmp_path: Path) -> list[str]:
    """An archive with 103 and 50 kN/m, and the reference."""
    group = Group(coords={"storey": Variable(("storey",), np.array([1, 2]), "1", "storey")})
    group.add("storey_stiffness", ("storey",), [1.03e5, 5e4], "N/m", "stiffness")
    with ArchiveWriter(tmp_path / "study.h5", Group(attributes={"title": "study"})) as writer:
        writer.write("designs/a", group)
        writer.finish()
    (tmp_path / "reference.yaml").write_text(REFERENCE, encoding="utf-8")
    return [str(tmp_path / "study.h5"), str(tmp_path / "reference.yaml")]


def test_tables(files: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["compare", *files, "--bars", "--check"]) == 0
    out = capsys.readouterr().out
    assert "Design - k [kN/m]" in out
    assert ["1", "100", "103", "+3.0", "5", "met"] in [line.split() for line in out.splitlines()]
    assert "2 of them have a bar, 2 are within it" in out


def test_check_reports_what_is_outside(files: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    path = Path(files[1])
    path.write_text(REFERENCE.replace("5 %", "2 %"), encoding="utf-8")
    assert main(["compare", *files]) == 0
    assert main(["compare", *files, "--check"]) == 3
    assert "1 of 2 values are not within their bars" in capsys.readouterr().err


def test_json_and_csv(files: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["compare", *files, "--json", "--csv", str(tmp_path / "cells.csv")]) == 0
    cells = json.loads(capsys.readouterr().out)["tables"][0]["cells"]
    assert [cell["found"] for cell in cells] == pytest.approx([103.0, 50.0])
    assert cells[0]["difference"] == pytest.approx(0.03) and cells[0]["inside"] is True
    assert len((tmp_path / "cells.csv").read_text(encoding="utf-8").splitlines()) == 3


def test_a_mistake_in_the_reference_is_reported(files: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    Path(files[1]).write_text(REFERENCE.replace("variable:", "varable:"), encoding="utf-8")
    assert main(["compare", *files]) == 2
    assert says(capsys.readouterr().err, "reference.yaml:9:10 E-KEY-01")


@pytest.mark.parametrize("option", ["--csv=made.csv", "--json", "--bars", "--check"])
def test_variants_take_no_options_that_they_would_not_heed(
    files: list[str], option: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["compare", *files, "--variants", "damped", option]) == 2
    assert says(capsys.readouterr().err, f"{option.partition('=')[0]} E-CLI-02")
