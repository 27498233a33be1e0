"""What a suite of accelerograms must satisfy, EN 1998-1:2004, 3.2.3.1 and 4.3.3.4.3(3)."""

from __future__ import annotations

from edesign.codes.motion_sets import PairRule, SetClauses, SetRules

SET_RULES = SetRules(
    code="EN 1998-1:2004",
    clauses=SetClauses(
        number="3.2.3.1.2(4)a",
        zero_period="3.2.3.1.2(4)b",
        mean="3.2.3.1.2(4)c",
        stationary="3.2.3.1.2(2)P, (3)",
        use="4.3.3.4.3(3)",
    ),
    least_number=3,
    number_for_mean=7,
    band=(0.2, 2.0),
    least_ratio=0.90,
    pairs=PairRule(clauses="3.2.3.1.1(2)P, 3.2.3.1.2(4)"),
)
"""Source: EN 1998-1:2004, 3.2.3.1.2(2)-(4), which 3.2.3.1.3(3) extends to recorded and simulated accelerograms.

Of a spatial model, 3.2.3.1.1(2)P: accelerograms act at once along all directions, and never the same along both
horizontal ones. 3.2.3.1.2(4)c speaks of T_1 in the direction in which the accelerogram is applied, so that those along
each direction are a set of their own.
"""
