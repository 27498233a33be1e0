"""Campaigns of the foundry. See summary.md."""

import time

import numpy as np

from .campaign import build
from .effects import EFFECTS, UNLISTED
from .laws import ALL
from .write import group, write

SHARES = {"one": 50, "two": 25, "clean": 15, "unlisted": 10}
ROUND = 20  # campaigns whose order is drawn at once, so that the first ones are the same, however many


def plan(seed, number):
    """Category, law and effects of each campaign: decks are shuffled, so that none comes twice before all came once."""
    rng = np.random.default_rng([seed, 999])
    deck, used, strange, acc = [], {x: 0 for x in ALL}, [], {k: 0.0 for k in SHARES}

    def next_effect(allowed):
        nonlocal deck
        for _ in range(2):
            for i, e in enumerate(deck):
                if allowed(e):
                    return str(deck.pop(i))
            fresh = list(EFFECTS)
            rng.shuffle(fresh)
            deck = deck + fresh
        raise RuntimeError

    def draw(kind):
        if kind == "clean":
            return [], ALL
        if kind == "unlisted":
            if not strange:
                strange.extend(UNLISTED)
                rng.shuffle(strange)
            name = str(strange.pop())
            return [name], UNLISTED[name]
        first = next_effect(lambda e: kind != "two" or e != "extremes")
        g, laws = EFFECTS[first]
        if kind == "one":
            return [first], laws
        second = next_effect(lambda e: EFFECTS[e][0] != g and e != "extremes" and set(laws) & set(EFFECTS[e][1]))
        return [first, second], sorted(set(laws) & set(EFFECTS[second][1]))

    out = []
    while len(out) < number:
        kinds = []
        for _ in range(ROUND):
            for k, share in SHARES.items():
                acc[k] += share / 100
            k = max(acc, key=lambda x: acc[x])
            acc[k] -= 1
            kinds.append(k)
        rng.shuffle(kinds)
        for kind in kinds:
            names, laws = draw(str(kind))
            order = list(laws)
            rng.shuffle(order)
            law = str(min(order, key=lambda x: used[x]))
            used[law] += 1
            out.append(("unlisted" if kind == "unlisted" else f"{kind}_{group(law)}", law, names))
    return out[:number]


def make(folder, seed, number, only=(), motion=False):
    """Make the campaigns that are not there yet.

    Args:
        folder: for all campaigns.
        seed: of everything.
        number: of campaigns, those of other categories counted too.
        only: categories; none: all.
        motion: changes nothing: some campaigns have a test in motion, whatever is asked for.
    """
    folder.mkdir(parents=True, exist_ok=True)
    for i, (category, law, names) in enumerate(plan(seed, number), 1):
        name = f"{i:03d}_{category}"
        if (only and category not in only) or (folder / f"{name}.truth.json").exists():
            continue
        start = time.process_time()
        for attempt in range(12):
            made = build(np.random.default_rng([seed, i, attempt]), law, names)
            if made:
                break
        else:
            print(f"{name}: could not be drawn", flush=True)
            continue
        write(folder, name, category, made)
        print(f"{name}: {len(made['tests'])} tests, {time.process_time() - start:.1f} s CPU", flush=True)
