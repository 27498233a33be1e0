"""A campaign through the command: files, what they say, and the law in the ordinary path of a damper."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from kelvin_voigt_campaign import campaign, lawful

from edesign.archive.reader import open_archive
from edesign.cli.main import main
from edesign.damper.damper import Damper
from edesign.damper.law_file import read_law_file, resolve


def test_a_hidden_spring_is_found_and_stands_in_the_law_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    campaign(tmp_path / "c", lambda t, u, v, a, order: lawful(t, u, v, a, order) + 3e10 * u**3, tests=5)
    out = tmp_path / "out"
    words = ["calibrate", str(tmp_path / "c/campaign.yaml"), "--workers", "1", "--output", str(out)]
    assert main([*words, "--effort", "2000"]) == 0
    said = capsys.readouterr()
    assert "screening beside none" in said.err and "Explained: the tests show elastic hardening" in said.out
    assert {path.name for path in out.iterdir()} == {
        "calibration.json",
        "calibration.h5",
        "calibration.html",
        "law.yaml",
    }
    reported = json.loads((out / "calibration.json").read_text(encoding="utf-8"))
    assert (reported["verdict"], reported["search"]) == ("explained", "complete")
    assert [effect["name"] for effect in reported["effects"]] == ["hardening"]
    page = (out / "calibration.html").read_text(encoding="utf-8")
    assert "what no model can predict" in page and "In tests that nothing was fitted to" in page
    found = resolve(*read_law_file(out / "law.yaml"), 20.0)
    damper = Damper(found.law, found.values, effects=found.effects)
    with open_archive(out / "calibration.h5") as archive:
        test = archive.group("tests/test_02").variables
        force = damper.force(test["time"].values, test["displacement"].values)
        # parameters stand in the file with twelve digits, the velocity is that of the spline through the motion
        assert force == pytest.approx(test["corrected_force"].values, abs=1e-6 * abs(force).max())


def test_effort_is_refused_where_it_means_nothing(capsys: pytest.CaptureFixture[str]):
    path = Path("records/none.yaml")
    assert main(["calibrate", str(path), "--effort", "0"]) == 2
    assert "--effort" in capsys.readouterr().err
