"""Makes planned campaigns in a folder: cNNN/ with the files, cNNN.truth.json beside."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

from blind.campaign import make
from blind.plan import Planned
from blind.run import outcome_path
from blind.write import truth_path, write


def write_new(planned: Planned, seed: int, folder: Path) -> None:
    """Make a campaign and write it into its folder."""
    write(make(planned, seed), folder)


def generate(
    planned: Planned, seed: int, folder: Path, write_new: Callable[[Planned, int, Path], None] = write_new
) -> Path:
    """Make a campaign, unless this very one is there.

    Args:
        planned: the campaign.
        seed: of everything.
        folder: for all campaigns.
        write_new: makes and writes it.

    Returns:
        Its folder.
    """
    place = folder / planned.name
    mark = folder / f"{planned.name}.plan.json"
    wanted = {"seed": seed, "kind": planned.kind, "effects": [list(pair) for pair in planned.effects]}
    if mark.exists() and truth_path(place).exists() and json.loads(mark.read_text(encoding="ascii")) == wanted:
        return place
    mark.unlink(missing_ok=True)
    outcome_path(place).unlink(missing_ok=True)
    for old in place.glob("*.csv"):
        old.unlink()
    write_new(planned, seed, place)
    mark.write_text(json.dumps(wanted) + "\n", encoding="ascii")
    return place
