"""Combinations of actions for buildings, EN 1990:2002+A1:2005, 6.4.3 and 6.5.3, as data.

A combination is a factor for each load case and one for each seismic component. What acts together is in `actions`.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import Literal

from edesign.codes.ec8.analysis.directions import DirectionRule, direction_factors
from edesign.codes.ec8.national import ActionFactors, Psi
from edesign.codes.en1990.actions import MOST_COMBINATIONS, Action, relieving_alone, sets_of_actions, split_cases
from edesign.codes.names import unknown
from edesign.errors import InputError

CombinationSet = Literal["fundamental", "seismic", "characteristic", "frequent", "quasi-permanent"]

_PAIR = "6.10a/b"
"""The expression, and the equation of a combination that both of the pair ask for."""
_COMPONENTS = ("E_x", "E_y", "E_z")


@dataclass(frozen=True)
class Combination:
    """A combination of actions.

    Attributes:
        name: as a report prints it: `1.35 G + 1.5 Q`, `G + 0.3 Q + E_x + 0.3 E_y`.
        set: design situation or serviceability combination that it belongs to.
        equation: of EN 1990; `6.10a/b` of one that both equations give.
        static: factor by name of the load case; cases that are absent do not act.
        seismic: factors of E_x, E_y, E_z.
        directions: how the seismic components add up: `30 %` as a sum of the effects times `seismic`, `srss` as the
            root of the sum of their squares, whose sign is that of `seismic`.
        leading: names of the cases of the leading variable action; empty without one.
    """

    name: str
    set: CombinationSet
    equation: str
    static: Mapping[str, float]
    seismic: tuple[float, float, float] = (0.0, 0.0, 0.0)
    directions: DirectionRule = "30 %"
    leading: Action = ()


def fundamental(
    cases: Mapping[str, str],
    psi: Mapping[str, Psi],
    factors: ActionFactors,
    expression: str = "6.10",
    favourable: bool = False,
    relieving: Collection[str] = (),
    patterns: Sequence[Collection[str]] = (),
    non_structural: Collection[str] = (),
) -> tuple[Combination, ...]:
    """Return the combinations for persistent and transient design situations.

    6.10 is sum gamma_G G + gamma_Q Q_1 + sum gamma_Q psi_0 Q_i; each variable action leads once. 6.10a has psi_0 at
    the leading action too, 6.10b has xi gamma_G,sup at permanent actions; the less favourable of both counts.

    Args:
        cases: category of each load case by its name: `permanent`, or a category of `psi`.
        psi: factors by category.
        expression: `6.10`, or `6.10a/b` for the pair.
        favourable: add combinations in which permanent actions are favourable (gamma_G,inf) and in which variable
            actions are absent.
        relieving: cases that may relieve what others load, as wind: each also acts not at all, and with gamma_G,inf
            without the other variable actions.
        patterns: cases of each pattern of imposed loads, which also act without the others where they lead.
        non_structural: permanent cases with the factors of such loads; where loads may be favourable, each of both
            kinds of permanent loads may be so without the other.

    Raises:
        InputError: a category or the expression is not known, no case is permanent, or there are too many combinations.

    Source: EN 1990:2002+A1, 6.4.3.2(3), Eqs. 6.10, 6.10a, 6.10b; Table A1.2(B) with Note 3 (all permanent actions of
        one origin take one factor). Loads that are not structural: NTC 2018, Table 2.6.I.
    """
    if expression not in ("6.10", _PAIR):
        raise unknown("expression of EN 1990", expression, ("6.10", _PAIR))
    permanent, variable = split_cases(cases, psi)
    sets = list(sets_of_actions(variable, favourable, relieving, patterns))
    G2_sup = factors.G_sup if factors.G2_sup is None else factors.G2_sup
    G2_inf = factors.G_inf if factors.G2_inf is None else factors.G2_inf
    of_both = list(product((factors.G_sup, factors.G_inf), (G2_sup, G2_inf) if non_structural else (G2_sup,)))

    def always(G: float, G2: float) -> dict[str, float]:
        return {case: G2 if case in non_structural else G for case in permanent}

    def rows() -> Iterator[Combination]:
        for actions in sets:
            in_part = _in_part(actions, patterns)
            for G, G2 in of_both if favourable else of_both[:1]:
                if expression == _PAIR and not in_part:
                    static = always(G, G2)
                    static |= {case: factors.Q * psi[cases[case]].psi_0 for action in actions for case in action}
                    yield _combination("fundamental", "6.10a", static)
                reduced = G * factors.xi if expression == _PAIR and G == factors.G_sup else G
                for leading in in_part or actions or ((),):
                    static = always(reduced, G2)
                    for action in actions:
                        for case in action:
                            static[case] = factors.Q * (1.0 if action == leading else psi[cases[case]].psi_0)
                    equation = "6.10" if expression == "6.10" else "6.10b"
                    yield _combination("fundamental", equation, static, leading)

    def relieved() -> Iterator[Combination]:
        for actions in relieving_alone(sets, relieving):
            for leading in actions:
                static = always(factors.G_inf, G2_inf)
                for action in actions:
                    for case in action:
                        static[case] = factors.Q * (1.0 if action == leading else psi[cases[case]].psi_0)
                yield _combination("fundamental", "6.10" if expression == "6.10" else "6.10b", static, leading)

    optional = {*relieving, *(case for pattern in patterns for case in pattern)}
    found = _distinct(rows(), favourable, optional)
    return _joined(found, _distinct(relieved(), True))


def stated(factors: Mapping[str, float]) -> Combination:
    """Return a combination for persistent situations whose factors a user states.

    Args:
        factors: by name of the load case.
    """
    return _combination("fundamental", "stated", factors)


def characteristic(
    cases: Mapping[str, str],
    psi: Mapping[str, Psi],
    favourable: bool = False,
    relieving: Collection[str] = (),
    patterns: Sequence[Collection[str]] = (),
) -> tuple[Combination, ...]:
    """Return the characteristic combinations, G + Q_1 + sum psi_0 Q_i; errors as `fundamental`.

    Args:
        cases: see `fundamental`.
        psi: see `fundamental`.
        favourable: see `fundamental`.
        relieving: see `fundamental`.
        patterns: see `fundamental`.

    Source: EN 1990:2002+A1, 6.5.3(2) a, Eq. 6.14b.
    """
    return _serviceability("characteristic", "6.14b", cases, psi, favourable, relieving, patterns)


def frequent(cases: Mapping[str, str], psi: Mapping[str, Psi], favourable: bool = False) -> tuple[Combination, ...]:
    """Return the frequent combinations, G + psi_1 Q_1 + sum psi_2 Q_i; errors as `fundamental`.

    Args:
        cases: see `fundamental`.
        psi: see `fundamental`.
        favourable: see `fundamental`.

    Source: EN 1990:2002+A1, 6.5.3(2) b, Eq. 6.15b.
    """
    return _serviceability("frequent", "6.15b", cases, psi, favourable)


def quasi_permanent(
    cases: Mapping[str, str], psi: Mapping[str, Psi], favourable: bool = False
) -> tuple[Combination, ...]:
    """Return the quasi-permanent combinations, G + sum psi_2 Q; errors as `fundamental`.

    Args:
        cases: see `fundamental`.
        psi: see `fundamental`.
        favourable: see `fundamental`.

    Source: EN 1990:2002+A1, 6.5.3(2) c, Eq. 6.16b.
    """
    return _serviceability("quasi-permanent", "6.16b", cases, psi, favourable)


def seismic(
    cases: Mapping[str, str],
    psi: Mapping[str, Psi],
    directions: str = "30 %",
    vertical: bool = False,
    relieving: Collection[str] = (),
) -> tuple[Combination, ...]:
    """Return the combinations for the seismic design situation, G + sum psi_2 Q + A_Ed.

    The seismic action contains gamma_I already, so its factor is 1 in the direction that leads.

    Args:
        cases: see `fundamental`.
        psi: see `fundamental`.
        directions: `30 %` or `srss`.
        vertical: the vertical component acts too.
        relieving: see `fundamental`.

    Returns:
        The combinations, each once.

    Raises:
        InputError: as `fundamental`, or there is no such rule of directions.

    Source: EN 1990:2002+A1, 6.4.3.4(2), Eq. 6.12b; EN 1998-1:2004, 3.2.4 and 4.3.3.5.
    """
    permanent, variable = split_cases(cases, psi)

    def rows() -> Iterator[Combination]:
        for actions in sets_of_actions(variable, False, relieving):
            static = dict.fromkeys(permanent, 1.0)
            static |= {case: psi[cases[case]].psi_2 for action in actions for case in action}
            for factors in direction_factors(directions, vertical):
                yield _combination("seismic", "6.12b", static, (), factors, directions)

    return _distinct(rows(), False, relieving)


def _serviceability(
    kind: CombinationSet,
    equation: str,
    cases: Mapping[str, str],
    psi: Mapping[str, Psi],
    favourable: bool,
    relieving: Collection[str] = (),
    patterns: Sequence[Collection[str]] = (),
) -> tuple[Combination, ...]:
    permanent, variable = split_cases(cases, psi)

    def factor(case: str, leads: bool) -> float:
        of_case = psi[cases[case]]
        if kind == "characteristic":
            return 1.0 if leads else of_case.psi_0
        return of_case.psi_1 if leads and kind == "frequent" else of_case.psi_2

    sets = list(sets_of_actions(variable, favourable, relieving, patterns))

    def rows(sets: Iterable[tuple[Action, ...]]) -> Iterator[Combination]:
        for actions in sets:
            for leading in (_in_part(actions, patterns) or actions or ((),)) if kind != "quasi-permanent" else ((),):
                static = dict.fromkeys(permanent, 1.0)
                static |= {case: factor(case, action == leading) for action in actions for case in action}
                yield _combination(kind, equation, static, leading)

    optional = {*relieving, *(case for pattern in patterns for case in pattern)}
    found = _distinct(rows(sets), favourable, optional)
    return _joined(found, _distinct(rows(relieving_alone(sets, relieving)), True))


def _combination(
    kind: CombinationSet,
    equation: str,
    static: Mapping[str, float],
    leading: Action = (),
    factors: tuple[float, float, float] = (0.0, 0.0, 0.0),
    directions: str = "30 %",
) -> Combination:
    acting = {case: factor for case, factor in static.items() if factor != 0.0}
    # a case that acts the other way has the name of the first with a minus: G - 1.5 wind_x
    terms = [(-factor, case[1:]) if case.startswith("-") else (factor, case) for case, factor in acting.items()]
    if directions == "srss":
        components = [name for name, factor in zip(_COMPONENTS, factors, strict=True) if factor]
        terms.append((max(factors, key=abs), f"SRSS({', '.join(components)})"))
        return Combination(_sum(terms), kind, equation, acting, factors, "srss", leading)
    # the component that leads is named first: G + E_y + 0.3 E_x
    order = sorted(zip(factors, _COMPONENTS, strict=True), key=lambda term: -abs(term[0]))
    terms += [term for term in order if term[0]]
    return Combination(_sum(terms), kind, equation, acting, factors, "30 %", leading)


def _sum(terms: Iterable[tuple[float, str]]) -> str:
    text = ""
    for factor, symbol in terms:
        size = abs(factor)
        term = symbol if size == 1.0 else f"{size:.6g} {symbol}"
        sign = "-" if factor < 0.0 else "+"
        text += f" {sign} {term}" if text else (f"-{term}" if factor < 0.0 else term)
    return text


def _distinct(rows: Iterator[Combination], favourable: bool, optional: Collection[str] = ()) -> tuple[Combination, ...]:
    """The rows without repetitions, and unless actions may be favourable without those that another row covers."""
    kept: dict[str, Combination] = {}
    for row in rows:
        same = kept.setdefault(row.name, row)  # one name stands for one set of factors
        if same.equation != row.equation:  # as without variable actions, or where psi_0 is 1
            kept[row.name] = replace(same, equation=_PAIR)
        if len(kept) > MOST_COMBINATIONS:
            raise InputError(
                f"there are more than {MOST_COMBINATIONS} combinations: merge load cases that act together"
                " [E-EN1990-02]"
            )
    found = tuple(kept.values())
    return found if favourable else tuple(row for row in found if not any(_covers(o, row, optional) for o in found))


def _in_part(actions: Iterable[Action], patterns: Sequence[Collection[str]]) -> list[Action]:
    """The imposed loads that act in a pattern alone; they lead, as patterns that accompany others are left out."""
    every = {case for pattern in patterns for case in pattern}
    return [of for of in actions if set(of) & every and not every <= set(of)]


def _joined(rows: Sequence[Combination], more: Sequence[Combination]) -> tuple[Combination, ...]:
    """The rows, and those of `more` that are not among them."""
    names = {row.name for row in rows}
    return (*rows, *(row for row in more if row.name not in names))


def _covers(other: Combination, row: Combination, optional: Collection[str]) -> bool:
    """Say whether each action of a row acts at least as much in the other one, and something more.

    Of the optional cases the same ones must act: without them others have more effect.
    """
    comparable = other.equation in (row.equation, _PAIR) and other.seismic == row.seismic
    if other is row or not comparable or any((case in other.static) != (case in row.static) for case in optional):
        return False
    return all(other.static.get(case, 0.0) >= factor for case, factor in row.static.items())
