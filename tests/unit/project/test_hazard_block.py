"""The block `hazard` of a project file: what it means, and that whatever is wrong in it is reported with its place."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from messages import says

from edesign.project import Problem, parse_project
from edesign.project.actions.hazard import EC8Hazard
from edesign.project.actions.hazard_base import YEAR

Broken = Callable[..., list[Problem]]

HAZARD = """\
hazard:
  code: ec8-2004
  country: greece
  zone: 3
  ground: C
  spectrum: 1
  parameters: {T_B: 0.2 s, T_D: 2.5 s}
  behaviour_factor: 4
  levels:
    DBE: {probability: 10 %}
    MCE: {probability: 2 %}
    rare: {return_period: 2475 years}
    hospital: {importance_class: IV}
    own: {gamma_I: 1.3}
"""


def block(text: str) -> EC8Hazard:
    hazard = parse_project(text).hazard
    assert hazard is not None
    return hazard


def test_a_complete_block(small: str) -> None:
    hazard = block(small + HAZARD)
    assert (hazard.code, hazard.country, hazard.zone, hazard.a_gR) == ("ec8-2004", "greece", "3", None)
    assert (hazard.ground, hazard.spectrum, hazard.damping, hazard.behaviour_factor) == ("C", 1, 0.05, 4.0)
    assert (hazard.parameters.T_B, hazard.parameters.T_D, hazard.parameters.S) == (0.2, 2.5, None)
    assert list(hazard.levels) == ["DBE", "MCE", "rare", "hospital", "own"]
    assert hazard.levels["MCE"].probability == 0.02
    assert hazard.levels["rare"].return_period == pytest.approx(2475 * YEAR, rel=1e-12)
    assert hazard.levels["hospital"].importance_class == "IV" and hazard.levels["own"].gamma_I == 1.3


def test_the_least_that_is_needed(small: str) -> None:
    hazard = block(small + "hazard: {code: ec8-2004, a_gR: 0.36 g, ground: C, spectrum: 2}\n")
    assert hazard.a_gR == pytest.approx(0.36 * 9.80665, rel=1e-15)
    assert (hazard.damping, hazard.k, hazard.levels, hazard.behaviour_factor) == (0.05, None, {}, None)


def test_a_project_needs_no_hazard(small: str) -> None:
    assert parse_project(small).hazard is None


@pytest.mark.parametrize("zone", ["3", "Z3", '"3"'])
def test_a_zone_is_a_number_or_a_name(small: str, zone: str) -> None:
    assert block(small + HAZARD.replace("zone: 3", f"zone: {zone}")).zone in ("3", "Z3")


ONE_PROBLEM = {
    "unknown code": ("code: ec8-2004", "code: «ec8-2005", "hazard.code", "`ec8-2004` E-VALUE-03"),
    "missing ground": ("hazard:\n", "«hazard:\n", "hazard.ground", "`A` E-KEY-02", ("  ground: C\n", "")),
    "unknown ground": ("ground: C", "ground: «F", "hazard.ground", "E-VALUE-03"),
    "special ground": ("ground: C", "ground: «S1", "hazard.ground", "E-VALUE-03"),
    "type that is no number": ("spectrum: 1", "spectrum: «true", "hazard.spectrum", "E-VALUE-03"),
    "unknown type": ("spectrum: 1", "spectrum: «3", "hazard.spectrum", "E-VALUE-03"),
    "zone that is no name": ("zone: 3", "zone: «[3]", "hazard.zone", "E-VALUE-01"),
    "zone without a country": ("hazard:\n", "«hazard:\n", "hazard.country", "E-KEY-02", ("  country: greece\n", "")),
    "zone and acceleration": ("zone: 3", "zone: 3\n  «a_gR: 0.36 g", "hazard.a_gR", "E-KEY-03"),
    "neither": ("hazard:\n", "«hazard:\n", "hazard", "`country` E-KEY-03", ("  zone: 3\n", "")),
    "bare acceleration": ("zone: 3", "a_gR: «0.36", "hazard.a_gR", "E-UNIT-01"),
    "zero acceleration": ("zone: 3", "a_gR: «0 g", "hazard.a_gR", "E-VALUE-02"),
    "misspelt key": ("behaviour_factor", "«behavior_factor", "hazard.behavior_factor", "`behaviour_factor` E-KEY-01"),
    "q below one": ("behaviour_factor: 4", "behaviour_factor: «0.5", "hazard.behaviour_factor", "E-VALUE-02"),
    "bare period": ("T_D: 2.5 s", "T_D: «2.5", "hazard.parameters.T_D", "E-UNIT-01"),
    "unknown parameter": ("T_D: 2.5 s", "«T_E: 6 s", "hazard.parameters.T_E", "E-KEY-01"),
    "corners in disorder": ("T_D: 2.5 s", "T_D: «0.1 s", "hazard.parameters.T_D", "0.2 E-VALUE-04"),
    "damping in per cent without the sign": ("ground: C", "ground: C\n  damping: «5", "hazard.damping", "E-VALUE-02"),
    "zero k": ("ground: C", "ground: C\n  k: «0", "hazard.k", "E-VALUE-02"),
    "empty level": ("own: {gamma_I: 1.3}", "«own: {}", "hazard.levels.own", "`probability` E-KEY-02"),
    "two ways": ("{gamma_I: 1.3}", "{«gamma_I: 1.3, probability: 5 %}", "hazard.levels.own.gamma_I", "E-KEY-03"),
    "sure event": ("probability: 2 %", "probability: «100 %", "hazard.levels.MCE.probability", "E-VALUE-02"),
    "impossible event": ("probability: 2 %", "probability: «0 %", "hazard.levels.MCE.probability", "E-VALUE-02"),
    "bare return period": ("2475 years", "«2475", "hazard.levels.rare.return_period", "E-UNIT-01"),
    "short return period": ("2475 years", "«2475 s", "hazard.levels.rare.return_period", "E-VALUE-02"),
    "unknown class": ("IV}", "«V}", "hazard.levels.hospital.importance_class", "E-VALUE-03"),
    "zero factor": ("gamma_I: 1.3", "gamma_I: «0", "hazard.levels.own.gamma_I", "E-VALUE-02"),
    "bad level name": ("own: {", "«my own: {", "hazard.levels.my own", "E-NAME-03"),
    "list for mapping": ("own: {gamma_I: 1.3}", "own: «[1.3]", "hazard.levels.own", "E-VALUE-01"),
}


@pytest.mark.parametrize("case", ONE_PROBLEM)
def test_one_problem(broken: Broken, case: str) -> None:
    old, new, keys, words, *more = ONE_PROBLEM[case]
    text = HAZARD
    for before, after in [(old, new), *more]:
        assert text.count(before) == 1, before
        text = text.replace(before, after)
    (problem,) = broken(("title: Small frame\n", f"title: Small frame\n{text}"))
    assert problem.keys_text == keys
    assert says(problem.message, words)
