"""`python -m blind.substructure`: makes campaigns of substructure tests with a late rig, calibrates, and counts."""

from __future__ import annotations

import argparse
from pathlib import Path

from blind.score import score
from blind.substructure.campaign import write_new
from blind.substructure.judge import judge, line, summary
from blind.substructure.plan import plan


def main(arguments: list[str] | None = None) -> None:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m blind.substructure", description=__doc__)
    parser.add_argument("--number", type=int, default=20, help="campaigns (20: one round of all rigs)")
    parser.add_argument("--seed", type=int, default=1, help="of everything")
    parser.add_argument("--jobs", type=int, default=1, help="calibrations at a time")
    parser.add_argument("--folder", type=Path, default=Path("build/blind_rts"), help="for campaigns and results")
    parser.add_argument("--again", action="store_true", help="run also those that have been run")
    chosen = parser.parse_args(arguments)
    chosen.folder.mkdir(parents=True, exist_ok=True)
    scores = score(
        plan(chosen.number, chosen.seed),
        chosen.seed,
        chosen.folder,
        chosen.jobs,
        chosen.again,
        lambda judged: print(line(judged), flush=True),
        write_new=write_new,
        judge=judge,
        options=("--no-page", "--workers", "1"),  # and the time that a user has
    )
    print(f"\n{summary(scores)}")


if __name__ == "__main__":
    main()
