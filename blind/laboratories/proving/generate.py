"""Campaigns of the proving ground. See summary.md."""

import time

import numpy as np

from . import effects as fx
from .campaign import build
from .write import write

SHARES = dict(one_F=20, one_H=34, two_F=8, two_H=14, clean_F=6, clean_H=10, unlisted=8)


def plan(number, seed):
    """Category, effects and law of each campaign; categories interleaved by their shares, names in turn."""
    rng = np.random.default_rng([seed, 9])
    due = {k: v / 200 for k, v in SHARES.items()}
    turn = {k: [] for k in ("F", "H", "U")}
    F, H = (
        ["kelvin_voigt", "mgmm"],
        [
            "bouc_wen",
            "friction",
            "viscous_power",
            "zener",
            "elastic_plastic",
            "bouc_wen",
            "viscous_power",
            "friction",
            "zener",
            "elastic_plastic",
            "maxwell_power",
        ],
    )
    at = {"F": int(rng.integers(2)), "H": int(rng.integers(len(H)))}

    def names(g, pool):
        if not turn[g]:
            turn[g] += [pool[i] for i in rng.permutation(len(pool))]
        return turn[g].pop(0)

    out = []
    for _ in range(number):
        for k in due:
            due[k] += SHARES[k] / 100
        cat = max(due, key=due.get)
        due[cat] -= 1
        g = cat[-1] if cat != "unlisted" else "FH"[sum(o[0] == cat for o in out) % 2]
        at[g] += 1
        law = (F if g == "F" else H)[at[g] % (2 if g == "F" else len(H))]
        if cat.startswith("one"):
            want = [names(g, fx.NAMES)]
        elif cat.startswith("two"):
            kinds = rng.permutation(["damper", "rig", "instrument"])[:2]
            want = [str(rng.choice([n for n in fx.NAMES if fx.KIND[n] == k])) for k in kinds]
        elif cat == "unlisted":
            want = [names("U", fx.UNLISTED)]
        else:
            want = []
        out.append((cat, want, law, g, F if g == "F" else H))
    return out


def make(folder, seed, number, only=(), motion=False):
    """Make the campaigns that are not there yet.

    Args:
        folder: for all campaigns.
        seed: of everything.
        number: of campaigns, those of other categories counted too.
        only: categories; none: all.
        motion: also the copies with tests in motion.
    """
    folder.mkdir(parents=True, exist_ok=True)
    copies = [False, True] if motion else [False]
    for i, (cat, want, law, _g, laws) in enumerate(plan(number, seed), 1):
        if only and cat not in only:
            continue
        names = [f"{i:03d}_{cat}{'_m' if copy else ''}" for copy in copies]
        if all((folder / f"{name}.truth.json").exists() for name in names):
            continue
        t = time.time()
        r = np.random.default_rng([seed, i, 3])
        pool = list(dict.fromkeys([law] + [laws[j] for j in r.permutation(len(laws))]))
        for _tries in range(4):
            info = None
            for its_law in pool:
                if all(fx.allowed(n, its_law) for n in want):
                    info = build(cat, i, seed, want, its_law)
                    if info:
                        break
            if info or not cat.startswith("two"):
                break
            kinds = r.permutation(["damper", "rig", "instrument"])[:2]
            want = [str(r.choice([n for n in fx.NAMES if fx.KIND[n] == k])) for k in kinds]
        if not info:
            print(f"{i:03d} {cat} {want}: could not be drawn", flush=True)
            continue
        for copy in copies:
            tr = write(folder, f"{i:03d}_{cat}{'_m' if copy else ''}", cat, info, seed, i, copy)
            print(
                f"{i:03d} {cat}{'_m' if copy else ''} {info['law']} {'+'.join(want)} after refit "
                f"{tr['nrms_after_refit']:.4f} noise {tr['noise_floor_fit']:.4f} ratio "
                f"{tr['nrms_after_refit'] / tr['noise_floor_fit']:.1f}"
                f" accept {info['accept']} draws {info['attempt'] + 1} {time.time() - t:.1f} s",
                flush=True,
            )
