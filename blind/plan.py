"""Which campaign is of which kind and hides which effects: the same for a seed, however many are asked for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import islice

import numpy as np

from blind.effects import EFFECTS
from blind.unlisted import FORMS as UNLISTED_DAMPER
from blind.unlisted_channels import FORMS as UNLISTED_CHANNELS

KINDS = ("clean", "one", "two", "unlisted")
PATTERN = (
    *("one", "one", "one", "clean", "one", "one", "two", "one", "one", "one", "unlisted", "one"),
    *("one", "clean", "one", "two", "one", "one", "one", "clean", "one", "unlisted", "two"),
)
"""15 with one effect, 3 clean, 3 with two, 2 with an unlisted one."""
UNLISTED = {form.name: form for pair in zip(UNLISTED_DAMPER, UNLISTED_CHANNELS, strict=False) for form in pair} | {
    form.name: form for form in (*UNLISTED_DAMPER, *UNLISTED_CHANNELS)
}
_CONFOUNDED = ({"offset", "static_offset", "drift"}, {"ageing", "degradation", "gain"}, {"payne", "mullins"})


@dataclass(frozen=True)
class Planned:
    """A campaign that is to be made.

    Attributes:
        number: 1, 2, ..
        kind: one of KINDS.
        effects: names, with the number of the form.
    """

    number: int
    kind: str
    effects: tuple[tuple[str, int], ...] = ()

    @property
    def name(self) -> str:
        return f"c{self.number:03d}"


def plan(
    number: int, seed: int, kinds: Sequence[str] = KINDS, effects: Sequence[str] = tuple(EFFECTS)
) -> list[Planned]:
    """So many campaigns.

    Args:
        number: how many.
        seed: of the choice of pairs.
        kinds: only these.
        effects: only these among the listed ones.
    """
    rng = np.random.default_rng((seed, 7))
    first = {name: int(rng.integers(12)) for name in (*EFFECTS, "unlisted")}
    pattern = [kind for kind in PATTERN if kind in kinds]
    made = {kind: 0 for kind in KINDS}
    out = []
    for i in range(number):
        kind = pattern[i % len(pattern)]
        j = made[kind]
        made[kind] += 1
        out.append(Planned(i + 1, kind, _effects(kind, j, rng, effects, first)))
    return out


def _effects(
    kind: str, j: int, rng: np.random.Generator, names: Sequence[str], first: dict[str, int]
) -> tuple[tuple[str, int], ...]:
    if kind == "clean":
        return ()
    if kind == "unlisted":
        return ((next(islice(UNLISTED, (first["unlisted"] + j) % len(UNLISTED), None)), 0),)
    if kind == "one":
        name = names[j % len(names)]
        return ((name, first[name] + j // len(names)),)
    while True:
        first, second = rng.choice(list(EFFECTS), 2, replace=False)
        if {first, second}.isdisjoint(names) or any({first, second} <= confounded for confounded in _CONFOUNDED):
            continue
        return tuple((str(name), int(rng.integers(12))) for name in (first, second))
