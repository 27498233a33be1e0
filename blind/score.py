"""Makes campaigns, runs the calibration on them, and judges; what has been run is not run again."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from blind.generate import generate, write_new
from blind.judge import judge
from blind.plan import Planned
from blind.run import calibrate, result
from blind.write import truth_path

SCORES = "scores.json"
Judge = Callable[[Mapping[str, Any], Mapping[str, Any] | None, Mapping[str, Any]], dict[str, Any]]


def score(
    planned: Sequence[Planned],
    seed: int,
    folder: Path,
    jobs: int = 1,
    again: bool = False,
    progress: Callable[[dict[str, Any]], None] = lambda score: None,
    *,
    write_new: Callable[[Planned, int, Path], None] = write_new,
    judge: Judge = judge,
    options: Sequence[str] = (),
) -> list[dict[str, Any]]:
    """Score campaigns, and write scores.json.

    Args:
        planned: what to make and run.
        seed: of everything.
        folder: for all files.
        jobs: calibrations at a time.
        again: also run those that have been run.
        progress: is given each score when it is there.
        write_new: makes and writes a campaign.
        judge: makes a score of truth, result and outcome.
        options: more of the command.

    Returns:
        Scores (see `judge`), in the order of the campaigns.
    """

    def one(each: Planned) -> dict[str, Any]:
        campaign = generate(each, seed, folder, write_new)
        outcome = calibrate(campaign, again, options)
        truth = json.loads(truth_path(campaign).read_text(encoding="ascii"))
        judged = judge(truth, None if outcome["failure"] else result(campaign), outcome)
        progress(judged)
        return judged

    with ThreadPoolExecutor(jobs) as pool:
        scores = list(pool.map(one, planned))
    (folder / SCORES).write_text(json.dumps(scores, indent=1) + "\n", encoding="utf-8")
    return scores
