"""Texts that more than one code can stand behind take its name from the code in force, not from the text."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest
from unit.project.conftest import SMALL
from unit.project.test_other_hazards import ASCE, NTC, USER

from edesign.damper.testing.acceptance import Acceptance, Device, Standard
from edesign.ground_motion.hazard import rules_in_force
from edesign.project import parse_project

PACKAGE = Path(__file__).parents[3] / "edesign"
OF_BUILDINGS = ("report/building/",)  # their designs take the action of EN 1998-1 alone
METHODS = {
    # a method that is one code's own is named with it, whatever the action is
    "report/design/isolation_tables.py": "equivalent linear",  # the analysis of isolated bases, EN 1998-1, 10.9
    "report/assessment/verdict_tables.py": "EN 1998-3 limit states",  # where a criterion asks for them
    "study/analysis/target.py": "EN 1998-1, 4.3.3.4.2.",  # printed of `method: n2` alone
    "study/check/advice.py": "N2: EN 1998-1",
    "study/design/elastomer/plausibility.py": "NTC 2018, 3.2.1",  # of its hazard alone
    "study/design/estimate.py": "the lateral force method",  # of `method: simplified`
    "study/design/elastomer/simplified.py": "EN 1998-1, 4.3.3.2.1(2)",  # of `method: simplified`
}


def test_no_text_names_a_code_that_may_not_be_in_force() -> None:
    found = []
    for folder in ("report", "study", "assess"):
        for path in sorted((PACKAGE / folder).rglob("*.py")):
            place = path.relative_to(PACKAGE).as_posix()
            tree = ast.parse(path.read_text(encoding="utf-8"))
            reported = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}  # docstrings
            for node in ast.walk(tree):
                if not isinstance(node, ast.Constant) or not isinstance(node.value, str) or id(node) in reported:
                    continue
                if any(code in node.value for code in ("EN 1998", "EC8", "EN 15129", "NTC ")):
                    if not place.startswith(OF_BUILDINGS) and METHODS.get(place, "\0") not in node.value:
                        found.append(f"{place}:{node.lineno}: {node.value}")
    assert found == []


@pytest.mark.parametrize(
    ("block", "code", "number", "mean"),
    [
        ("", "EN 1998-1:2004", 3, 7),  # 3.2.3.1.2(4)a, 4.3.3.4.3(3)
        (NTC, "NTC 2018", 3, 7),  # 7.3.5
        (ASCE, "ASCE/SEI 7-22", 11, 11),  # 16.2.2
        (USER.replace("damping: 5 %", "damping: 5 %\n  criteria: asce7-16"), "ASCE/SEI 7-16", 11, 11),
    ],
)
def test_rules_are_those_of_the_action(block: str, code: str, number: int, mean: int) -> None:
    rules = rules_in_force(parse_project(SMALL + block).hazard)
    assert (rules.code, rules.least_number, rules.number_for_mean) == (code, number, mean)


@pytest.mark.parametrize(
    ("device", "standards", "by"),
    [
        ("viscous", ("ntc_2018",), ("NTC 2018, 11.9.6",)),
        ("viscous", ("asce_7", "en_15129"), ()),  # the mean of ASCE 7, the design of EN 15129: no third cycle
        ("viscoelastic", ("en_15129",), ("EN 15129, 6",)),
        ("viscoelastic", ("en_15129", "ntc_2018"), ("EN 15129, 6", "NTC 2018, 11.9.4")),
        ("elastomeric_isolator", ("asce_7", "en_15129", "ntc_2018"), ()),
    ],
)
def test_limits_beside_the_third_cycle_are_named_by_their_standard(
    device: Device, standards: tuple[Standard, ...], by: tuple[str, ...]
) -> None:
    """Read by eye: D.M. 17 January 2018, 11.9.4 and 11.9.6; EN 15129, 6; ASCE/SEI 7-16, 18.6.1.4."""
    assert Acceptance(device=device, standards=standards).from_third_by == by
