"""Campaigns of the harbour laboratory. See summary.md."""

import time

import numpy as np

from . import effects as fx
from .campaign import accepted, make_campaign
from .unlisted import UNLISTED
from .write import write

SHARES = dict(clean_F=8, clean_H=10, one_F=30, one_H=22, two_F=10, two_H=10, unlisted=10)


def plan(rng, N):
    """Categories interleaved by their shares; the first 20 hold some of each."""
    total = sum(SHARES.values())
    counts = {c: 0 for c in SHARES}
    order = []
    for i in range(N):
        c = max(SHARES, key=lambda c: (SHARES[c] / total * (i + 1) - counts[c], SHARES[c]))
        counts[c] += 1
        order.append(c)
    for c in SHARES:
        if N >= 14 and c not in order[:20]:
            order[min(N, 20) - 1 - list(SHARES).index(c)] = c
    return order


def make(folder, seed, number, only=(), motion=False):
    """Make the campaigns that are not there yet.

    Args:
        folder: for all campaigns.
        seed: of everything.
        number: of campaigns, those of other categories counted too.
        only: categories; none: all.
        motion: changes nothing: some campaigns have tests in motion, whatever is asked for.
    """
    folder.mkdir(parents=True, exist_ok=True)
    top = np.random.default_rng([seed, 7919])
    order = plan(top, max(number, 20))[:number]  # so that the first ones are the same, however many
    rounds = {c: list(top.permutation(fx.NAMES)) for c in ("one_F", "one_H")}
    odd = list(top.permutation(list(UNLISTED)))
    used = {c: 0 for c in SHARES}
    for number, category in enumerate(order, 1):
        k = used[category]
        used[category] += 1
        if (only and category not in only) or (folder / f"{number:03d}_{category}.truth.json").exists():
            continue
        start, rng = time.process_time(), np.random.default_rng([seed, number])
        fast, heavy = (
            ["mgmm", "kelvin_voigt"],
            ["bouc_wen", "friction", "viscous_power", "zener", "elastic_plastic", "maxwell_power"],
        )
        weights = [0.2, 0.17, 0.2, 0.18, 0.17, 0.08]
        for again in range(8):
            wanted, pool = [], fast if category.endswith("F") else heavy
            if category.startswith("one"):
                wanted = [str(rounds[category][(k + again * 7) % 20])]
            elif category.startswith("two"):
                while True:
                    wanted = [str(x) for x in rng.choice(fx.NAMES, 2, replace=False)]
                    if (
                        fx.KIND[wanted[0]] != fx.KIND[wanted[1]]
                        and any(all(q in fx.SUITS[w] for w in wanted) for q in pool)
                        and set(wanted) not in ({"play", "series_flexibility"}, {"offset", "static_offset"})
                    ):
                        break
            odd_one = odd[(k + again * 3) % len(odd)] if category == "unlisted" else None
            if odd_one:
                pool = fast if rng.random() < 0.5 else heavy
            ok = [
                (q, w)
                for q, w in zip(pool, weights if pool is heavy else [0.5, 0.5], strict=False)
                if all(q in fx.SUITS[x] for x in wanted)
            ]
            if not ok:
                continue
            w = np.array([x for _, x in ok])
            law = str(rng.choice([q for q, _ in ok], p=w / w.sum()))
            made = make_campaign(rng, category, wanted, law, odd_one)
            if made:
                break
        else:
            print(f"{number:03d} {category}: gave up", flush=True)
            continue
        camp, effects, unlisted, f, left, ref = made
        accept = [accepted(rng, camp, effects, e, ref, f) for e in effects]
        write(folder, number, category, rng, camp, effects, unlisted, f, left, ref, accept)
        what = " + ".join(
            f"{e['name']}{e['form']}{'~' + '/'.join(a) if a else ''}" for e, a in zip(effects, accept, strict=False)
        ) or (unlisted["title"] if unlisted else "-")
        print(
            f"{number:03d} {category:8s} {camp['law']:15s} {what:45s} floor {f:.4f} left "
            f"{' '.join(f'{x:.4f}' for x, _ in left)}  {time.process_time() - start:.1f} s CPU",
            flush=True,
        )
