"""What a set of ground motions must satisfy, ASCE/SEI 7-16 and 7-22, 16.2."""

from __future__ import annotations

from edesign.codes.motion_sets import PairRule, SetClauses, SetRules

COMPONENTS = (
    "each component stands for the maximum direction of its pair, which it never exceeds; T_1 for the first periods of "
    "both directions, and 0.2 T_1 for the period that holds 90 % of the mass, if that is no shorter"
)
"""What the check of a plane frame assumes: the standard asks for pairs on a model in space."""


def set_rules(edition: str) -> SetRules:
    """Return the rules of an edition.

    Motions that were only scaled: the mean of the maximum-direction spectra at least 90 % of the target; spectrally
    matched: at least 110 %. Over 0.2 of the shortest to 2 times the longest first period.

    Args:
        edition: "7-16" or "7-22"; both have the same rules here.

    Source: ASCE/SEI 7-16 and 7-22, 16.2.2, 16.2.3.1 to 16.2.3.3, 16.2.4, 16.4.
    """
    name = f"ASCE {edition}"
    return SetRules(
        code=f"ASCE/SEI {edition}",
        clauses=SetClauses(number=f"{name}, 16.2.2", mean=f"{name}, 16.2.3", use=f"{name}, 16.4"),
        least_number=11,
        number_for_mean=11,
        band=(0.2, 2.0),
        least_ratio=0.90,
        least_ratio_matched=1.10,
        fewer="the standard has no rule for fewer",
        note=COMPONENTS,
        pairs=PairRule(
            "maximum direction",
            f"{name}, 16.2.3.2, 16.2.3.3",
            "both components have one factor, and the mean of the maximum-direction spectra of the pairs counts",
            orientation=f"{name}, 16.2.4",
            tolerance=0.10,
        ),
    )
