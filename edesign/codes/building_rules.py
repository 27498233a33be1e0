"""What a seismic code asks of a steel building where its rules differ from those of EN 1998-1."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

from edesign.codes.ec8.analysis.regularity import ChangeLimits
from edesign.codes.en1990.combinations import Combination
from edesign.codes.rule_check import RuleCheck

_CITED = re.compile(r"EN 1998-1(?::2004)?, (\d+(?:\.\d+)+(?:\(\d+\)P?)?[a-c]?)(?:, (Eqs?\. [0-9.]+))?")
_FURTHER = re.compile(r"(EN 1998-1, \d[\d.]*(?:\(\d+\)P?)?)(, | and |; )(\d+\.\d)")


@dataclass(frozen=True)
class BuildingRules:
    """The rules of a seismic code for the elastic design of a steel building.

    Checks and rules carry the clause of EN 1998-1 that they are known by; `clauses` has the one of the code in its
    place. A clause without an entry is of EN 1998-1 in every code: the measure is taken from there.

    Attributes:
        code: name in a building file.
        title: for people.
        ductility: what the code calls the ductility classes `low`, `medium` and `high`.
        largest_q: upper limit of q by structural type, class, alpha_u / alpha_1, regularity in elevation, and q of low
            ductility of the country.
        section_class: highest class of dissipative sections by class of ductility and q.
        modal_mass: sum of effective modal masses that is enough.
        every_large_mode: whether every mode above 5 % of the mass is asked for as well, and not in its place.
        changes: changes from storey to storey that still are gradual; None: the code has no figures.
        setbacks: rules for the setbacks by lower faces, upper faces and levels of the storeys, m.
        vertical: whether a member needs the vertical component, by a_vg in m/s2, span and cantilever in m.
        gravity_apart: Omega of beams is (M_pl,Rd - M_Ed,G) / M_Ed,E, and not M_pl,Rd / M_Ed.
        foundations: factor on the effects of the superstructure by class of ductility; empty: gamma_Rd Omega.
        base_axial: largest N_Ed / N_pl,Rd of columns with hinges at their bases; None: there is no limit.
        hollow_braces: largest ratios of width and of diameter to thickness of hollow braces; None: there is no limit.
        clauses: of the code, by that of EN 1998-1.
        equations: of combinations, by that of EN 1990.
        words: what stands in texts in place of words of EN 1998-1.
    """

    code: str
    title: str
    ductility: Mapping[str, str]
    largest_q: Callable[[str, str, float, bool, float], float]
    section_class: Callable[[str, float], int]
    modal_mass: float
    setbacks: Callable[..., tuple[RuleCheck, ...]]
    vertical: Callable[[float, float, float], bool]
    every_large_mode: bool = False
    changes: ChangeLimits | None = None
    gravity_apart: bool = False
    foundations: Mapping[str, float] = field(default_factory=dict)
    base_axial: float | None = None
    hollow_braces: tuple[float, float] | None = None
    clauses: Mapping[str, str] = field(default_factory=dict)
    equations: Mapping[str, str] = field(default_factory=dict)
    words: Mapping[str, str] = field(default_factory=dict)

    def clause(self, of_ec8: str) -> str:
        """Return the clause of the code with its standard for one of EN 1998-1; others stay as they are.

        Args:
            of_ec8: number of the clause, or a clause that names another standard.
        """
        if not self.clauses or not of_ec8[:1].isdigit():
            return of_ec8
        own = self.clauses.get(of_ec8)
        return f"EN 1998-1, {of_ec8}" if own is None else f"{self.title}, {own}"

    def told(self, text: str) -> str:
        """Return a text in which clauses and words of EN 1998-1 are those of the code.

        Args:
            text: with clauses such as `EN 1998-1, 4.4.2.6(4)`.
        """
        if not self.clauses:
            return text

        def cited(found: re.Match[str]) -> str:
            own = self.clauses.get(found[1])
            return found[0] if own is None else f"{self.title}, {own}"

        for word, own in self.words.items():
            text = text.replace(word, own)
        return _CITED.sub(cited, _spelled_out(text))

    def combination(self, combination: Combination) -> Combination:
        """Return a combination of EN 1990 with the equation of the code."""
        return replace(combination, equation=self.equations.get(combination.equation, combination.equation))

    def rule(self, rule: RuleCheck) -> RuleCheck:
        """Return a rule that tells the clause of the code beside the one that it is known by."""
        return replace(rule, told=self.clause(rule.clause)) if self.clauses else rule


def _spelled_out(text: str) -> str:
    """Return a text in which each of several clauses of EN 1998-1 names the standard."""
    found, spelled = "", text
    while spelled != found:
        found, spelled = spelled, _FURTHER.sub(r"\1\2EN 1998-1, \3", spelled)
    return found
