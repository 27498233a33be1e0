"""`python -m blind`: makes campaigns with hidden effects, runs the calibration on them, and counts what it found."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from blind.effects import EFFECTS
from blind.generate import generate
from blind.plan import KINDS, plan
from blind.score import score
from blind.table import summary


def main(arguments: list[str] | None = None) -> None:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m blind", description=__doc__)
    parser.add_argument("--number", type=int, default=23, help="campaigns (23: one round of all kinds)")
    parser.add_argument("--seed", type=int, default=1, help="of everything")
    parser.add_argument("--kinds", type=_names, default=KINDS, help=f"only these, with commas: {', '.join(KINDS)}")
    parser.add_argument("--effects", type=_names, default=tuple(EFFECTS), help=f"only these: {', '.join(EFFECTS)}")
    parser.add_argument("--jobs", type=int, default=1, help="calibrations at a time")
    parser.add_argument("--folder", type=Path, default=Path("build/blind"), help="for campaigns and results")
    parser.add_argument("--again", action="store_true", help="run also those that have been run")
    parser.add_argument("--only-make", action="store_true", help="make the campaigns, calibrate nothing")
    chosen = parser.parse_args(arguments)
    for given, known in ((chosen.kinds, KINDS), (chosen.effects, EFFECTS)):
        for name in given:
            if name not in known:
                parser.error(f"there is no `{name}`; there are {', '.join(known)}")
    planned = plan(chosen.number, chosen.seed, chosen.kinds, chosen.effects)
    chosen.folder.mkdir(parents=True, exist_ok=True)
    if chosen.only_make:
        for each in planned:
            generate(each, chosen.seed, chosen.folder)
        return
    scores = score(planned, chosen.seed, chosen.folder, chosen.jobs, chosen.again, _print_score)
    print(f"\n{summary(scores)}")


def _print_score(judged: dict[str, Any]) -> None:
    hidden = " + ".join(" ".join(effect) for effect in judged["effects"]) or "nothing"
    found = judged["failure"] or ", ".join(str(effect[0]) for effect in judged["found"]) or "none"
    print(f"c{judged['number']:03d}  {judged['seconds']:5.0f} s  {hidden}: {found}", flush=True)


def _names(text: str) -> tuple[str, ...]:
    return tuple(name.strip() for name in text.split(",") if name.strip())


if __name__ == "__main__":
    main()
