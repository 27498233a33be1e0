"""The block `hazard` by NTC 2018, ASCE 7 and tables of the user: what is wrong is reported with its place."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

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
    "unknown code": (NTC, "ntc-2018", "«ntc-2008", "hazard.code", "did you mean `ntc-2018`?"),
    "key of another code": (NTC, "ground: C\n", "ground: C\n  «a_gR: 0.1 g\n", "hazard.a_gR", "unknown key"),
    "class of use": (NTC, "class_of_use: II", "class_of_use: «V", "hazard.class_of_use", "`V` is unknown"),
    "life without a unit": (NTC, "50 years", "«50", "hazard.nominal_life", "needs a unit"),
    "limit state": (NTC, "limit_state: SLD", "limit_state: «SLE", "hazard.levels.SLD.limit_state", "`SLE` is unknown"),
    "amplification": (NTC, "F_0: 2.4", "F_0: «2", "hazard.levels.SLD.F_0", "at least 2.2"),
    "bare period": (NTC, "0.28 s", "«0.28", "hazard.levels.SLD.T_C_star", "needs a unit"),
    "relief": (NTC, "ground: C", "ground: C\n  topography: «T5", "hazard.topography", "`T5` is unknown"),
    "low topographic factor": (NTC, "ground: C", "ground: C\n  S_T: «0.9", "hazard.S_T", "at least 1"),
    "earthquake": (ASCE, "earthquake: DE}", "earthquake: «MCE}", "hazard.levels.DE.earthquake", "`MCE` is unknown"),
    "bare S_DS": (ASCE, "S_DS: 1.0 g", "S_DS: «1.0", "hazard.S_DS", "needs a unit"),
    "low R": (ASCE, "R: 8", "R: «0.5", "hazard.R", "at least 1"),
    "missing T_L": (ASCE.replace("  T_L: 8 s\n", ""), "hazard:\n", "«hazard:\n", "hazard.T_L", "this key is missing"),
    "fewer ordinates": (
        USER,
        "[0.4 g, 1 g, 0.1 g]",
        "«[0.4 g, 1 g]",
        "hazard.spectrum.accelerations",
        "2 ordinates for 3",
    ),
    "bare ordinate": (USER, "1 g,", "«1,", "hazard.spectrum.accelerations[1]", "needs a unit"),
    "no damping": (USER.replace("  damping: 5 %\n", ""), "hazard:\n", "«hazard:\n", "hazard.damping", "is missing"),
    "law": (USER, "damping: 5 %", "damping: 5 %\n  interpolation: «loglog", "hazard.interpolation", "`log-log`"),
    "law of damping": (
        USER,
        "damping: 5 %",
        "damping: 5 %\n  damping_correction: «ec8-2004",
        "hazard.damping_correction",
        "allowed: `ec8`, `asce7`",
    ),
    "bare corner": (USER, "0.1 g]}", "0.1 g], corner_period: «0.5}", "hazard.spectrum.corner_period", "needs a unit"),
    "criteria": (USER, "damping: 5 %", "damping: 5 %\n  criteria: «asce7", "hazard.criteria", "did you mean"),
    "level without a factor": (USER, "MCE: {factor: 1.5}", "«MCE: {}", "hazard.levels.MCE.factor", "is missing"),
    "two ways of rarity": (
        USER,
        "return_period: 475 years}",
        "probability: 10 %, «return_period: 475 years}",
        "hazard.levels.DBE.return_period",
        "exclude each other",
    ),
    "factor without a table": (
        EACH,
        "CMS: {spectrum: {periods: [0 s, 4 s], accelerations: [0.3 g, 0.1 g]}}",
        "CMS: {«factor: 2}",
        "hazard.levels.CMS.factor",
        "a factor needs a spectrum",
    ),
    "neither": (
        EACH,
        "CMS: {spectrum: {periods: [0 s, 4 s], accelerations: [0.3 g, 0.1 g]}}",
        "«CMS: {}",
        "hazard.levels.CMS.spectrum",
        "this key is missing",
    ),
}


@pytest.mark.parametrize("case", ONE_PROBLEM)
def test_one_problem(broken: Broken, case: str) -> None:
    text, old, new, keys, words = ONE_PROBLEM[case]
    assert text.count(old) == 1, old
    (problem,) = broken(("title: Small frame\n", f"title: Small frame\n{text.replace(old, new)}"))
    assert problem.keys_text == keys
    assert words in problem.message


def test_a_missing_file_of_a_table(broken: Broken) -> None:
    text = USER.replace("{periods: [0 s, 0.1 s, 4 s], accelerations: [0.4 g, 1 g, 0.1 g]}", "{file: «uhs.csv}")
    (problem,) = broken(("title: Small frame\n", f"title: Small frame\n{text}"))
    assert problem.keys_text == "hazard.spectrum.file" and "there is no file" in problem.message


def test_the_corner_of_a_table_lies_on_it(small: str) -> None:
    text = USER.replace("0.1 g]}", "0.1 g], corner_period: 5 s}")
    project = parse_project(small + text, "small.yaml")
    with pytest.raises(InputError, match=r"spectrum: corner_period: 5 s is not between the largest ordinate, at 0.1 s"):
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
    with pytest.raises(InputError, match="each has a spectrum of its own; name one of `SLD`, `SLV`"):
        elastic_spectrum(ntc)
    with pytest.raises(InputError, match=r"there is no level `SLC`; did you mean `SL"):
        elastic_spectrum(ntc, "SLC")
    # the worked table of tests/published/test_ntc2018_spectra.py
    assert float(design_spectrum(ntc, "SLV").acceleration(1.0)) == pytest.approx(0.099516 * 9.80665, abs=6e-6)


def test_design_spectra_of_ntc_2018(small: str) -> None:
    """On the plateau a_g F_V / q with F_V = 1.35 F_0 sqrt(a_g / g) = 1.6875; 3.2.3.4: none at SLO; 7.3.1: q <= 1.5."""
    action = action_of(hazard_of(small, NTC.replace("SLD", "SLO")))
    assert isinstance(action, NtcAction)
    vertical = action.vertical_design("SLV", 1.5)
    assert float(vertical.acceleration(0.1)) == pytest.approx(0.25 * 1.6875 / 1.5 * 9.80665, rel=1e-9)
    with pytest.raises(InputError, match=r"q = 2 is too large for the vertical component: 1.5 at most"):
        action.vertical_design("SLV", 2.0)
    assert action.design("SLO", None) is None
    with pytest.raises(InputError, match="for SLO the design spectrum is the elastic one"):
        action.design("SLO", 3.0)


def test_what_only_the_code_knows(small: str) -> None:
    late = ASCE.replace("S_D1: 0.6 g", "S_D1: 9 g")
    with pytest.raises(InputError, match=r"small.yaml:\d+:8: hazard.T_L: T_S = .* T_S <= T_L is needed"):
        checked_hazard(parse_project(small + late, "small.yaml"))
    disorder = USER.replace("[0 s, 0.1 s, 4 s]", "[0 s, 5 s, 4 s]")
    with pytest.raises(InputError, match=r"small.yaml:\d+:13: hazard.spectrum: the period 4 s stands after 5 s"):
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
        ("", r"uhs.csv: the spectrum file is empty; its first line is like `T \[s\],Se \[g\]`"),
        ("T [s]\n0\n", "uhs.csv:1: two columns are needed"),
        (TABLE.replace("T [s]", "T"), r"uhs.csv:2: the first column is `T`; it must be the period in s"),
        (TABLE.replace("Se [m/s2]", "Sa [m/s2]"), r"no column `Se \[m/s2\]`; did you mean `Sa \[m/s2\]`"),
        (TABLE.replace("10", "ten"), "uhs.csv:5: `ten` is not a number; a spectral acceleration is expected"),
        (TABLE.replace("0.1;0.1;10", "0.1;10"), "uhs.csv:5: there are 2 columns here, and 3 in line 2"),
        (TABLE.replace("0;0;4", "0.05;0;4"), "the first period is 0.05 s; the table begins at 0 s"),
        (TABLE.replace("4;1;1", "4;1;nan"), "uhs.csv:6: `nan` is not a finite number"),
    ],
)
def test_wrong_files_of_ordinates(small: str, tmp_path: Path, content: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        file_hazard(small, tmp_path, content)


def test_a_column_without_a_unit_of_acceleration(small: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"`Sv \[m/s\]` has no unit of acceleration in brackets"):
        file_hazard(small, tmp_path, TABLE, "{file: uhs.csv}")


def test_a_suite_is_compared_at_five_per_cent(broken: Broken) -> None:
    block = USER.replace("damping: 5 %", "damping: «2 %")
    (problem,) = broken(
        ("title: Small frame\n", f"title: Small frame\n{block}"),
        ("records:\n", "records:\n  set: {suite: «set.yaml, match: {method: scale}}\n"),
    )[:1]
    assert problem.keys_text == "hazard.damping" and "spectra of 5 % damping" in problem.message


def test_the_level_that_a_record_is_fitted_to(broken: Broken) -> None:
    one_shape = ("title: Small frame\n", f"title: Small frame\n{ASCE}")
    record = ("records:\n", "records:\n  set: {suite: «set.yaml, match: {«level: DE}}\n")
    messages = [problem.message for problem in broken(one_shape, record)]
    assert any("the levels have spectra of one shape" in message for message in messages)
    own = ("title: Small frame\n", f"title: Small frame\n{NTC}")
    record = ("records:\n", "records:\n  set: {suite: «set.yaml, match: {level: «SLW}}\n")
    assert any("no level `SLW`; did you mean" in problem.message for problem in broken(own, record))


def test_target_displacements_of_other_codes(broken: Broken) -> None:
    """N2 needs T_C, a table has none; only a ground type of EN 1998-1 stands for a site class of ASCE 41."""
    push = "  - {name: t, kind: pushover, pattern: uniform, targets: [«n2, asce41], site_class: C}\n"
    (problem,) = broken(("title: Small frame\n", f"title: Small frame\n{USER}"), ("analyses:\n", f"analyses:\n{push}"))
    assert problem.keys_text == "analyses[0].targets[0]" and "needs the corner period" in problem.message
    known = USER.replace("0.1 g]}", "0.1 g], corner_period: 0.5 s}")
    push = "  - {name: t, kind: pushover, pattern: uniform, targets: n2, damping: «7 %}\n"
    (problem,) = broken(("title: Small frame\n", f"title: Small frame\n{known}"), ("analyses:\n", f"analyses:\n{push}"))
    assert problem.keys_text == "analyses[0].damping" and "give `hazard.damping_correction`" in problem.message
    push = "  - «{name: t, kind: pushover, pattern: uniform, targets: [n2, asce41]}\n"
    (problem,) = broken(("title: Small frame\n", f"title: Small frame\n{ASCE}"), ("analyses:\n", f"analyses:\n{push}"))
    assert problem.keys_text == "analyses[0].site_class" and "of `asce7-22`" in problem.message
