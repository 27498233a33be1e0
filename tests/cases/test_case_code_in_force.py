"""A study whose seismic action is not that of EN 1998-1 quotes the clauses of its own code."""

from __future__ import annotations

import math
import re
from pathlib import Path

import pytest
from cases.small_study import write

from edesign.cli.main import main
from edesign.frame.project_file import load_study
from edesign.ground_motion.hazard import action_of, objective_level, rules_in_force
from edesign.project.actions.hazard import NtcHazard

EC8 = """\
hazard:
  code: ec8-2004
  a_gR: 0.36 g
  ground: C
  spectrum: 1
  levels: {DBE: {probability: 10 %}, MCE: {probability: 2 %}}
"""
NTC = """\
hazard:
  code: ntc-2018
  nominal_life: 50 years
  class_of_use: II
  ground: C
  levels:
    DBE: {limit_state: SLV, a_g: 0.25 g, F_0: 2.5, T_C_star: 0.3 s}
    MCE: {limit_state: SLC, a_g: 0.32 g, F_0: 2.5, T_C_star: 0.3 s}
"""
ASCE = """\
hazard:
  code: asce7-16
  S_DS: 1 g
  S_D1: 0.6 g
  T_L: 8 s
  levels: {DBE: {earthquake: DE}, MCE: {earthquake: MCE_R}}
"""
LEVEL = ("{method: scale, ", "{method: scale, level: DBE, ")


@pytest.mark.parametrize(("nominal_life", "rarity"), [(50.0, 475.0), (75.0, 712.0)])
def test_limit_states_have_their_probability_in_50_years(nominal_life: float, rarity: float, tmp_path: Path) -> None:
    """SLV has 10 % in V_R (NTC 2018, Table 3.2.I), so 1 - 0.9^(50 / V_R) in 50 years, V_R = V_N C_U."""
    ntc = NTC.replace("50 years", f"{nominal_life:g} years")
    one_level = ("[bare, damped, upper], levels: [DBE, MCE]", "[bare, damped, upper], levels: DBE")
    study = load_study(write(tmp_path, one_level, project=((EC8, ntc), LEVEL)))
    hazard = study.base.hazard
    assert isinstance(hazard, NtcHazard)
    in_50_years = action_of(hazard).probability("DBE")
    assert in_50_years == pytest.approx(1.0 - 0.9 ** (50.0 / nominal_life), rel=1e-12)  # the same equation
    assert -50.0 / math.log(1.0 - in_50_years) == pytest.approx(rarity, abs=0.5)  # years, as the decree rounds them
    assert objective_level("h", hazard) == ("DBE" if nominal_life == 50.0 else None)


@pytest.mark.parametrize(
    ("block", "own", "number"),
    [(NTC, "NTC 2018, 7.3.5", "3"), (ASCE, "ASCE 7-16, 16.2.2", "11")],
    ids=["ntc-2018", "asce7-16"],
)
def test_a_study_quotes_the_code_of_its_action(
    block: str, own: str, number: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    level = (LEVEL,) if block == NTC else ()
    path = write(
        tmp_path,
        ("records: set, levels: DBE, criteria: drift", "records: set/first, levels: DBE, criteria: drift"),
        (
            "[bare, damped, upper], levels: [DBE, MCE], records: set,",
            "[bare, damped], levels: DBE, records: set/first,",
        ),
        ("objectives: [h]\n", ""),
        project=((EC8, block), *level),
    )
    main(["run", str(path), "--quiet"])
    capsys.readouterr()
    archive = tmp_path / "out.h5"
    main(["report", str(archive)])
    main(["show", str(archive), "--all"])
    printed = capsys.readouterr().out
    page = re.sub(r"<[^>]+>", "", (tmp_path / "out.html").read_text(encoding="utf-8"))
    assert f"{own}, asks for {number} at least" in " ".join(printed.split())
    for text in (printed, page):
        assert re.findall(r".{60}(?:EN 1998|EC8|Eurocode 8).{20}", text) == []
    assert rules_in_force(load_study(path).base.hazard).code in ("NTC 2018", "ASCE/SEI 7-16")
