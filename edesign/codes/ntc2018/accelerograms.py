"""What a set of time histories must satisfy, NTC 2018, 3.2.3.6 and 7.3.5."""

from __future__ import annotations

from dataclasses import replace

from edesign.codes.motion_sets import PairRule, SetClauses, SetRules

ULTIMATE = SetRules(
    code="NTC 2018",
    clauses=SetClauses(
        number="NTC 2018, 7.3.5", mean="NTC 2018, 3.2.3.6", stationary="NTC 2018, 3.2.3.6", use="NTC 2018, 7.3.5"
    ),
    least_number=3,
    number_for_mean=7,
    band=(0.0, 2.0),
    shortest=0.15,
    longest=2.0,
    least_ratio=0.90,
    greatest_ratio=1.30,
    pairs=PairRule(clauses="NTC 2018, 3.2.3.6, 7.3.5"),
)
"""Of ultimate limit states. The band is that of artificial time histories, which 3.2.3.6 leaves open for recorded ones:
the larger of 0.15 s to 2 s and 0.15 s to 2 T. The limit of + 30 % is that of recorded ones.
"""

SERVICEABILITY = replace(ULTIMATE, band=(0.0, 1.5))
"""Of serviceability limit states: to 1.5 T."""
