"""`python -m blind.laboratories`: makes campaigns of a foreign program, calibrates, and counts what was found."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from importlib import import_module
from pathlib import Path
from typing import Any

import yaml

from blind.laboratories import CATEGORIES, LABORATORIES
from blind.laboratories.judge import judge
from blind.laboratories.table import line, summary
from blind.run import calibrate, result
from blind.score import SCORES
from blind.write import truth_path

OPTIONS = ("--no-page", "--workers", "1")  # and the time that a user has


def main(arguments: list[str] | None = None) -> None:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m blind.laboratories", description=__doc__)
    parser.add_argument("--laboratory", choices=LABORATORIES, required=True, help="whose program makes the campaigns")
    parser.add_argument("--number", type=_count, default=20, help="campaigns (20: some of each category)")
    parser.add_argument("--seed", type=_count, default=1, help="of everything")
    parser.add_argument("--motion", action="store_true", help="proving: each campaign again with tests in motion")
    parser.add_argument("--only", type=_categories, default=(), help=f"of the number only {', '.join(CATEGORIES)}")
    parser.add_argument("--jobs", type=_count, default=1, help="calibrations at a time")
    parser.add_argument("--folder", type=Path, default=Path("build/laboratories"), help="for campaigns and results")
    parser.add_argument("--again", action="store_true", help="calibrate also with those that have been judged")
    parser.add_argument("--only-make", action="store_true", help="make the campaigns, calibrate nothing")
    chosen = parser.parse_args(arguments)
    if chosen.motion and chosen.laboratory != "proving":
        parser.error(f"--motion is for proving; a part of the campaigns of {chosen.laboratory} has tests in motion")
    folder = chosen.folder / f"{chosen.laboratory}_{chosen.seed}"
    try:
        program = import_module(f"blind.laboratories.{chosen.laboratory}.generate")
    except ModuleNotFoundError as error:
        sys.exit(f"edesign: {error}")
    program.make(folder, chosen.seed, chosen.number, chosen.only, chosen.motion)
    if chosen.only_make:
        return
    scores = score(campaigns(folder, chosen.number, chosen.only, chosen.motion), folder, chosen.jobs, chosen.again)
    print(f"\n{summary(scores)}")


def campaigns(folder: Path, number: int, only: Sequence[str] = (), motion: bool = False) -> list[Path]:
    """Folders of the campaigns that were asked for; others may stand beside them."""
    found = []
    for truth in sorted(folder.glob("[0-9]*_*.truth.json")):
        name = truth.name.removesuffix(".truth.json")
        count, _, category = name.removesuffix("_m").partition("_")
        if int(count) <= number and (not only or category in only) and (motion or not name.endswith("_m")):
            found.append(folder / name)
    return found


def score(made: Sequence[Path], folder: Path, jobs: int = 1, again: bool = False) -> list[dict[str, Any]]:
    """Calibrate with campaigns, judge, print a line of each, and write scores.json.

    Args:
        made: folders of campaigns.
        folder: for scores.json.
        jobs: calibrations at a time.
        again: also those that have been calibrated with.

    Returns:
        Scores (see `judge`), in the order of the campaigns.
    """

    def one(campaign: Path) -> dict[str, Any]:
        outcome = calibrate(campaign, again, OPTIONS)
        truth = json.loads(truth_path(campaign).read_text(encoding="utf-8"))
        tests = yaml.safe_load((campaign / "campaign.yaml").read_text(encoding="utf-8"))["tests"]
        validate = [Path(test["file"]).stem for test in tests if test["use"] == "validate"]
        found = None if outcome["failure"] else result(campaign)
        judged = judge(campaign.name, truth, found, outcome, validate)
        print(line(judged), flush=True)
        return judged

    with ThreadPoolExecutor(jobs) as pool:
        scores = list(pool.map(one, made))
    (folder / SCORES).write_text(json.dumps(scores, indent=1) + "\n", encoding="utf-8")
    return scores


def _count(text: str) -> int:
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError(f"{text}: 1 or more")
    return number


def _categories(text: str) -> tuple[str, ...]:
    names = tuple(name.strip() for name in text.split(",") if name.strip())
    for name in names:
        if name not in CATEGORIES:
            raise argparse.ArgumentTypeError(f"there is no `{name}`; there are {', '.join(CATEGORIES)}")
    return names


if __name__ == "__main__":
    main()
