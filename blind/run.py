"""Runs the calibration on a campaign, as a person would: the command line, nothing else."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

LONGEST = 1800.0  # s
RESULT = "calibration.json"


def command(campaign: Path, out: Path, options: Sequence[str] = ()) -> list[str]:
    """The command; what changes in its options changes here."""
    return [sys.executable, "-m", "edesign", "calibrate", str(campaign / "campaign.yaml"), "--out", str(out), *options]


def outcome_path(campaign: Path) -> Path:
    """Where it stands how a run ended."""
    return campaign.with_name(f"{campaign.name}.outcome.json")


def result_folder(campaign: Path) -> Path:
    """Where the files of a run stand."""
    return campaign.with_name(f"{campaign.name}.result")


def calibrate(campaign: Path, again: bool = False, options: Sequence[str] = ()) -> dict[str, Any]:
    """Calibrate with a campaign, unless that has been done.

    Args:
        campaign: its folder.
        again: even if it has been done.
        options: more of the command.

    Returns:
        seconds, and failure: a message or None.
    """
    mark = outcome_path(campaign)
    if mark.exists() and not again:
        return json.loads(mark.read_text(encoding="utf-8"))
    out = result_folder(campaign)
    shutil.rmtree(out, ignore_errors=True)
    start = time.monotonic()
    failure = _run(command(campaign, out, options))
    outcome = {"seconds": time.monotonic() - start, "failure": failure}
    if failure is None and result(campaign) is None:
        outcome["failure"] = f"no readable {RESULT}"
    mark.write_text(json.dumps(outcome) + "\n", encoding="utf-8")
    return outcome


def result(campaign: Path) -> dict[str, Any] | None:
    """What the calibration says; None if it says nothing."""
    try:
        found = json.loads((result_folder(campaign) / RESULT).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return found if isinstance(found, dict) else None


def _run(words: list[str]) -> str | None:
    """Run a command; the end of what it complains about, or None."""
    single = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")
    try:
        done = subprocess.run(words, capture_output=True, text=True, timeout=LONGEST, env={**os.environ, **single})
    except subprocess.TimeoutExpired:
        return f"longer than {LONGEST:.0f} s"
    if done.returncode:
        return f"exit {done.returncode}: {(done.stderr or done.stdout).strip()[-400:]}"
    return None
