"""Which actions act together, EN 1990:2002+A1:2005, 6.4.3 and EN 1991-1-1:2002, 3.3.

Permanent cases act always. Of variable cases

- imposed loads of categories A to G are one action (EN 1991-1-1, 3.3.1(3)P);
- imposed loads of roofs, category H, are one action, and never act with snow or wind (EN 1991-1-1, 3.3.2(1));
- cases of snow, of wind, of temperature and of any other category are alternatives: of each at most one acts at a
  time. Snow on several roofs is therefore one case, wind from two sides are two.

Cases that do not act downwards, as wind, may relieve what others load (`relieving`): they may be absent, and they also
act with favourable permanent actions and without the other variable ones. Those act downwards as permanent ones do, so
that both are favourable at the same places.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from itertools import combinations, product
from math import prod

from edesign.codes.ec8.national import Psi
from edesign.codes.names import unknown
from edesign.errors import InputError

Action = tuple[str, ...]
"""Names of load cases that act together as one action."""

PERMANENT = "permanent"
MOST_COMBINATIONS = 1000
"""More rows are refused: nobody reads them, and their number doubles with each case."""

_IMPOSED = "ABCDEFG"
_KINDS = {**dict.fromkeys(_IMPOSED, "imposed"), "H": "roof", "snow": "snow", "snow_above_1000_m": "snow"}
_NOT_WITH_ROOF = {"snow", "wind"}


def split_cases(cases: Mapping[str, str], psi: Mapping[str, Psi]) -> tuple[list[str], dict[str, list[str]]]:
    """Return the permanent cases, and the variable ones by kind: `imposed`, `roof`, `snow`, `wind`, `temperature`.

    Args:
        cases: category of each load case by its name, `permanent` or a category of `psi`.
        psi: the categories that are known.

    Returns:
        Names of the permanent cases; names of the variable ones by kind.

    Raises:
        InputError: a category is not known, or no case is permanent.
    """
    permanent: list[str] = []
    variable: dict[str, list[str]] = {}
    for name, category in cases.items():
        if category == PERMANENT:
            permanent.append(name)
        elif category in psi:
            variable.setdefault(_KINDS.get(category, category), []).append(name)
        else:
            raise unknown(f"category of the load case {name},", category, (PERMANENT, *psi))
    if not permanent:
        raise InputError("no load case is permanent: every combination of EN 1990 needs one [E-EN1990-01]")
    return permanent, variable


def sets_of_actions(
    variable: Mapping[str, Sequence[str]],
    favourable: bool,
    relieving: Collection[str] = (),
    patterns: Sequence[Collection[str]] = (),
) -> Iterator[tuple[Action, ...]]:
    """Yield the sets of variable actions that may act at the same time.

    Args:
        variable: names of the cases by kind, from `split_cases`.
        favourable: any action may also be absent, and imposed loads may act in part; otherwise only the largest sets
            come, in which every action is unfavourable.
        relieving: cases that may always be absent; the largest sets are those of the others, beside each choice of
            these.
        patterns: cases of each pattern of imposed loads: they act together, and each pattern alone.

    Raises:
        InputError: there are too many sets.
    """
    kinds = list(variable)
    rows = prod(_number_of_choices(kind, len(variable[kind]), favourable, len(patterns)) + 1 for kind in kinds)
    if rows > MOST_COMBINATIONS:
        raise InputError(
            f"{sum(map(len, variable.values()))} variable load cases make up to {rows} sets of actions, more than "
            f"{MOST_COMBINATIONS}: merge cases that act together [E-EN1990-02]"
        )
    options = [[(), *_choices(kind, variable[kind], favourable, patterns)] for kind in kinds]
    sets = [
        {kind: action for kind, action in zip(kinds, chosen, strict=True) if action} for chosen in product(*options)
    ]
    sets = [chosen for chosen in sets if "roof" not in chosen or not _NOT_WITH_ROOF & set(chosen)]
    for chosen in sets:
        if favourable or not any(
            chosen.items() < larger.items() and not any(set(action) & set(relieving) for _, action in more)
            for larger in sets
            for more in [larger.items() - chosen.items()]
        ):
            yield tuple(chosen.values())


def relieving_alone(sets: Iterable[tuple[Action, ...]], relieving: Collection[str]) -> list[tuple[Action, ...]]:
    """Return the sets of the relieving actions without any other, each once.

    Args:
        sets: of actions that may act at the same time.
        relieving: names of the cases that may relieve what others load.
    """
    alone = [tuple(action for action in actions if set(action) & set(relieving)) for actions in sets]
    return [actions for actions in dict.fromkeys(alone) if actions]


def _choices(kind: str, names: Sequence[str], favourable: bool, patterns: Sequence[Collection[str]]) -> list[Action]:
    if kind not in ("imposed", "roof"):
        return [(name,) for name in names]
    if not favourable:
        each = [tuple(name for name in names if name in pattern) for pattern in patterns]
        return [tuple(names), *(part for part in each if part and part != tuple(names))]
    return [part for size in range(len(names), 0, -1) for part in combinations(names, size)]


def _number_of_choices(kind: str, number: int, favourable: bool, patterns: int) -> int:
    if kind not in ("imposed", "roof"):
        return number
    return 2**number - 1 if favourable else 1 + patterns
