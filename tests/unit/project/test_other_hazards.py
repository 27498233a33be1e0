"""The block `hazard` by NTC 2018, ASCE 7 and tables of the user: what is wrong is reported with its place."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from messages import says

from edesign.errors import InputError
from edesign.ground_motion.hazard import action_of, checked_hazard, design_spectrum, elastic_spectrum, factor_of_level
from edesign.ground_motion.seismic_action.ntc2018 import NtcAction
from edesign.project import Problem, parse_project
from edesign.project.actions.hazard_base import Hazard

Broken = Callable[..., list[Problem]]

NTC = """\
hazard:
  code: ntc-2018
  nominal_life: 50 years
  class_of_use: II
  ground: C
  behaviour_factor: 3.9
  levels:
    SLD: {limit_state: SLD, a_g: 0.1 g, F_0: 2.4, T_C_star: 0.28 s}
    SLV: {limit_state: SLV, a_g: 0.25 g, F_0: 2.5, T_C_star: 0.3 s}
"""
ASCE = """\
hazard:
  code: asce7-22
  S_DS: 1.0 g
  S_D1: 0.6 g
  T_L: 8 s
  R: 8
  levels: {DE: {earthquake: DE}, MCE: {earthquake: MCE_R}}
"""
USER = """\
hazard:
  code: user
  damping: 5 %
  spectrum: {periods: [0 s, 0.1 s, 4 s], accelerations: [0.4 g, 1 g, 0.1 g]}
  levels: {DBE: {factor: 1, return_period: 475 years}, MCE: {factor: 1.5}}
"""
EACH = """\
hazard:
  code: user
  damping: 5 %
  levels:
    UHS: {spectrum: {periods: [0 s, 4 s], accelerations: [0.4 g, 0.1 g]}}
    CMS: {spectrum: {periods: [0 s, 4 s], accelerations: [0.3 g, 0.1 g]}}
"""

ONE_PROBLEM = {
    "unknown code": (NTC, "ntc-2018", "«ntc-2008", "hazard.code", "`ntc-2018` E-VALUE-03"),
    "key of another code": (NTC, "ground: C\n", "ground: C\n  «a_gR: 0.1 g\n", "hazard.a_gR", "E-KEY-01"),
    "class of use": (NTC, "class_of_use: II", "class_of_use: «V", "hazard.class_of_use", "E-VALUE-03"),
    "life without a unit": (NTC, "50 years", "«50", "hazard.nominal_life", "E-UNIT-01"),
    "limit state": (NTC, "limit_state: SLD", "limit_state: «SLE", "hazard.levels.SLD.limit_state", "E-VALUE-03"),
    "amplification": (NTC, "F_0: 2.4", "F_0: «2", "hazard.levels.SLD.F_0", "2.2 E-VALUE-02"),
    "bare period": (NTC, "0.28 s", "«0.28", "hazard.levels.SLD.T_C_star", "E-UNIT-01"),
    "relief": (NTC, "ground: C", "ground: C\n  topography: «T5", "hazard.topography", "E-VALUE-03"),
    "low topographic factor": (NTC, "ground: C", "ground: C\n  S_T: «0.9", "hazard.S_T", "E-VALUE-02"),
    "earthquake": (ASCE, "earthquake: DE}", "earthquake: «MCE}", "hazard.levels.DE.earthquake", "E-VALUE-03"),
    "bare S_DS": (ASCE, "S_DS: 1.0 g", "S_DS: «1.0", "hazard.S_DS", "E-UNIT-01"),
    "low R": (ASCE, "R: 8", "R: «0.5", "hazard.R", "E-VALUE-02"),
    "missing T_L": (ASCE.replace("  T_L: 8 s\n", ""), "hazard:\n", "«hazard:\n", "hazard.T_L", "E-KEY-02"),
    "fewer ordinates": (USER, "[0.4 g, 1 g, 0.1 g]", "«[0.4 g, 1 g]", "hazard.spectrum.accelerations", "E-VALUE-04"),
    "bare ordinate": (USER, "1 g,", "«1,", "hazard.spectrum.accelerations[1]", "E-UNIT-01"),
    "no damping": (USER.replace("  damping: 5 %\n", ""), "hazard:\n", "«hazard:\n", "hazard.damping", "E-KEY-02"),
    "law": (
        USER,
        "damping: 5 %",
        "damping: 5 %\n  interpolation: «loglog",
        "hazard.interpolation",
        "`log-log` E-VALUE-03",
    ),
    "law of damping": (
        USER,
        "damping: 5 %",
        "damping: 5 %\n  damping_correction: «ec8-2004",
        "hazard.damping_correction",
        "`asce7` E-VALUE-03",
    ),
    "bare corner": (USER, "0.1 g]}", "0.1 g], corner_period: «0.5}", "hazard.spectrum.corner_period", "E-UNIT-01"),
    "criteria": (USER, "damping: 5 %", "damping: 5 %\n  criteria: «asce7", "hazard.criteria", "E-VALUE-03"),
    "level without a factor": (USER, "MCE: {factor: 1.5}", "«MCE: {}", "hazard.levels.MCE.factor", "E-KEY-02"),
    "two ways of rarity": (
        USER,
        "return_period: 475 years}",
        "probability: 10 %, «return_period: 475 years}",
        "hazard.levels.DBE.return_period",
        "E-KEY-03",
    ),
    "factor without a table": (
        EACH,
        "CMS: {spectrum: {periods: [0 s, 4 s], accelerations: [0.3 g, 0.1 g]}}",
        "CMS: {«factor: 2}",
        "hazard.levels.CMS.factor",
        "E-HAZ-04",
    ),
    "neither": (
        EACH,
        "CMS: {spectrum: {periods: [0 s, 4 s], accelerations: [0.3 g, 0.1 g]}}",
        "«CMS: {}",
        "hazard.levels.CMS.spectrum",
        "E-KEY-02",
    ),
}


@pytest.mark.parametrize("case", ONE_PROBLEM)
def test_one_problem(broken: Broken, case: str) -> None:
    text, old, new, keys, words = ONE_PROBLEM[case]
    assert text.count(old) == 1, old
    (problem,) = broken(("title: Small frame\n", f"title: Small frame\n{text.replace(old, new)}"))
    assert problem.keys_text == keys
    assert says(problem.message, words)


def test_a_missing_file_of_a_table(broken: Broken) -> None:
    text = USER.replace("{periods: [0 s, 0.1 s, 4 s], accelerations: [0.4 g, 1 g, 0.1 g]}", "{file: «uhs.csv}")
    (problem,) = broken(("title: Small frame\n", f"title: Small frame\n{text}"))
    assert problem.keys_text == "hazard.spectrum.file" and "E-FILE-01" in problem.message


def test_the_corner_of_a_table_lies_on_it(small: str) -> None:
    text = USER.replace("0.1 g]}", "0.1 g], corner_period: 5 s}")
    project = parse_project(small + text, "small.yaml")
    with pytest.raises(InputError, match="spectrum: corner_period.* 0.1 s.*E-CURVE-02"):
        checked_hazard(project)


def hazard_of(small: str, block: str, path: Path | str = "small.yaml") -> Hazard:
    hazard = parse_project(small + block, path).hazard
    assert hazard is not None
    return hazard


def test_levels(small: str) -> None:
    ntc, asce, user, each = (hazard_of(small, block) for block in (NTC, ASCE, USER, EACH))
    assert [hazard.own_shapes for hazard in (ntc, asce, user, each)] == [True, False, False, True]
    assert (factor_of_level(asce, "MCE"), factor_of_level(user, "MCE"), factor_of_level(ntc, "SLV")) == (1.5, 1.5, 1.0)
    known = action_of(user).probability("DBE")
    assert known == pytest.approx(0.0999, abs=5e-5) and action_of(asce).probability("DE") is None
    with pytest.raises(InputError, match="hazard.levels.*`SLD`, `SLV`.*E-HAZ-04"):
        elastic_spectrum(ntc)
    with pytest.raises(InputError, match="hazard.levels.*`SLV`.*E-NAME-01"):
        elastic_spectrum(ntc, "SLC")
    # the worked table of tests/published/test_ntc2018_spectra.py
    assert float(design_spectrum(ntc, "SLV").acceleration(1.0)) == pytest.approx(0.099516 * 9.80665, abs=6e-6)


def test_design_spectra_of_ntc_2018(small: str) -> None:
    """On the plateau a_g F_V / q with F_V = 1.35 F_0 sqrt(a_g / g) = 1.6875; 3.2.3.4: none at SLO; 7.3.1: q <= 1.5."""
    action = action_of(hazard_of(small, NTC.replace("SLD", "SLO")))
    assert isinstance(action, NtcAction)
    vertical = action.vertical_design("SLV", 1.5)
    assert float(vertical.acceleration(0.1)) == pytest.approx(0.25 * 1.6875 / 1.5 * 9.80665, rel=1e-9)
    with pytest.raises(InputError, match="E-SPEC-04"):
        action.vertical_design("SLV", 2.0)
    assert action.design("SLO", None) is None
    with pytest.raises(InputError, match="E-SPEC-04"):
        action.design("SLO", 3.0)


def test_what_only_the_code_knows(small: str) -> None:
    late = ASCE.replace("S_D1: 0.6 g", "S_D1: 9 g")
    with pytest.raises(InputError, match=r"small.yaml:\d+:8: hazard.T_L.*E-VALUE-04"):
        checked_hazard(parse_project(small + late, "small.yaml"))
    disorder = USER.replace("[0 s, 0.1 s, 4 s]", "[0 s, 5 s, 4 s]")
    with pytest.raises(InputError, match=r"small.yaml:\d+:13: hazard.spectrum.*E-CURVE-01"):
        checked_hazard(parse_project(small + disorder, "small.yaml"))


TABLE = "# by hand\nT [s];Sv [m/s];Se [m/s2]\n0;0;4\n\n0.1;0.1;10\n4;1;1\n"


def file_hazard(small: str, folder: Path, content: str, table: str = "{file: uhs.csv, column: 'Se [m/s2]'}") -> Hazard:
    (folder / "uhs.csv").write_text(content, encoding="utf-8")
    text = USER.replace("{periods: [0 s, 0.1 s, 4 s], accelerations: [0.4 g, 1 g, 0.1 g]}", table)
    return checked_hazard(parse_project(small + text, folder / "small.yaml"))


def test_a_file_of_ordinates(small: str, tmp_path: Path) -> None:
    spectrum = elastic_spectrum(file_hazard(small, tmp_path, TABLE), "MCE")
    assert float(spectrum.acceleration(0.1)) == pytest.approx(15.0, rel=1e-12) and spectrum.zero_period == 6.0
    in_g = elastic_spectrum(file_hazard(small, tmp_path, "T [s],Se [g]\n0,0.4\n4,0.1\n", "{file: uhs.csv}"))
    assert float(in_g.acceleration(4.0)) == pytest.approx(0.980665, rel=1e-12)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("", "uhs.csv.*E-SPEC-05"),
        ("T [s]\n0\n", "uhs.csv:1.*E-SPEC-05"),
        (TABLE.replace("T [s]", "T"), "uhs.csv:2.*E-SPEC-05"),
        (TABLE.replace("Se [m/s2]", "Sa [m/s2]"), r"hazard.spectrum.*`Sa \[m/s2\]`.*E-SPEC-06"),
        (TABLE.replace("10", "ten"), "uhs.csv:5.*E-TABLE-08"),
        (TABLE.replace("0.1;0.1;10", "0.1;10"), "uhs.csv:5.*E-TABLE-07"),
        (TABLE.replace("0;0;4", "0.05;0;4"), "hazard.spectrum.*E-CURVE-01"),
        (TABLE.replace("4;1;1", "4;1;nan"), "uhs.csv:6.*E-TABLE-08"),
    ],
)
def test_wrong_files_of_ordinates(small: str, tmp_path: Path, content: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        file_hazard(small, tmp_path, content)


def test_a_column_without_a_unit_of_acceleration(small: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"hazard.spectrum.*`Sv \[m/s\]`.*E-SPEC-05"):
        file_hazard(small, tmp_path, TABLE, "{file: uhs.csv}")


def test_a_suite_is_compared_at_five_per_cent(broken: Broken) -> None:
    block = USER.replace("damping: 5 %", "damping: «2 %")
    (problem,) = broken(
        ("title: Small frame\n", f"title: Small frame\n{block}"),
        ("records:\n", "records:\n  set: {suite: «set.yaml, match: {method: scale}}\n"),
    )[:1]
    assert problem.keys_text == "hazard.damping" and "E-SCALE-02" in problem.message


def test_the_level_that_a_record_is_fitted_to(broken: Broken) -> None:
    one_shape = ("title: Small frame\n", f"title: Small frame\n{ASCE}")
    record = ("records:\n", "records:\n  set: {suite: «set.yaml, match: {«level: DE}}\n")
    messages = [problem.message for problem in broken(one_shape, record)]
    assert any("E-KEY-03" in message for message in messages)
    own = ("title: Small frame\n", f"title: Small frame\n{NTC}")
    record = ("records:\n", "records:\n  set: {suite: «set.yaml, match: {level: «SLW}}\n")
    assert any(says(problem.message, "`SLV`? E-NAME-01") for problem in broken(own, record))


def test_target_displacements_of_other_codes(broken: Broken) -> None:
    """N2 needs T_C, a table has none; only a ground type of EN 1998-1 stands for a site class of ASCE 41."""
    push = "  - {name: t, kind: pushover, pattern: uniform, targets: [«n2, asce41], site_class: C}\n"
    (problem,) = broken(("title: Small frame\n", f"title: Small frame\n{USER}"), ("analyses:\n", f"analyses:\n{push}"))
    assert problem.keys_text == "analyses[0].targets[0]" and "E-HAZ-02" in problem.message
    known = USER.replace("0.1 g]}", "0.1 g], corner_period: 0.5 s}")
    push = "  - {name: t, kind: pushover, pattern: uniform, targets: n2, damping: «7 %}\n"
    (problem,) = broken(("title: Small frame\n", f"title: Small frame\n{known}"), ("analyses:\n", f"analyses:\n{push}"))
    assert problem.keys_text == "analyses[0].damping" and "E-KEY-03" in problem.message
    push = "  - «{name: t, kind: pushover, pattern: uniform, targets: [n2, asce41]}\n"
    (problem,) = broken(("title: Small frame\n", f"title: Small frame\n{ASCE}"), ("analyses:\n", f"analyses:\n{push}"))
    assert problem.keys_text == "analyses[0].site_class" and "E-KEY-02" in problem.message
