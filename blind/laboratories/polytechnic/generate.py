"""Campaigns of the polytechnic. See summary.md."""

import time

import numpy as np

from . import hidden
from .campaign import campaign
from .write import write

SHARES = {"clean_F": 8, "clean_H": 10, "one_F": 30, "one_H": 22, "two_F": 10, "two_H": 10, "unlisted": 10}


def order(number):
    """Categories in turn by their shares: the first twenty hold some of each."""
    cats, count, out = list(SHARES), dict.fromkeys(SHARES, 0), []
    for i in range(number):
        c = max(cats, key=lambda x: SHARES[x] / 100 * (i + 1) + 0.001 - count[x])
        count[c] += 1
        out.append(c)
    return out


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
    r0 = np.random.default_rng(seed)
    o = [str(x) for x in r0.permutation(hidden.NAMES)]
    state = {"order_one_F": o, "order_one_H": o[10:] + o[:10], "first_unlisted": int(r0.integers(9)), "redraws": {}}
    for i, cat in enumerate(order(number)):
        if only and cat not in only:
            continue
        if cat != "unlisted" and (folder / f"{i + 1:03d}_{cat}.truth.json").exists():
            state[cat] = state.get(cat, 0) + 1  # the turns of names go on; those of the unlisted count attempts
            continue
        t0 = time.time()
        rng = np.random.default_rng([seed, i])
        camp, noisy, q, truth = campaign(cat, rng, state)
        name = f"{i + 1:03d}_{cat}"
        write(folder, name, camp, noisy, q, truth, rng)
        print(
            f"{name:15s} {truth['law']:15s} {camp['fs']:4d} Hz "
            f"{'+'.join(e['name'] for e in truth['effects']) or '-':32s} noise {truth['nrms_noise_fit']:.4f} "
            f"effect {truth['nrms_effect']:.4f} refit {truth['nrms_after_refit']:.4f} floor "
            f"{truth['noise_floor_validate']:.4f} "
            f"accept {[e['accept'] for e in truth['effects']]} tries {truth['attempts']} {time.time() - t0:.1f} s",
            flush=True,
        )
    if state["redraws"]:
        print("redraws:", state["redraws"])
