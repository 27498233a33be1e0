"""Makes planned campaigns in a folder: cNNN/ with the files, cNNN.truth.json beside."""

from __future__ import annotations

import json
from pathlib import Path

from blind.campaign import make
from blind.plan import Planned
from blind.run import outcome_path
from blind.write import truth_path, write


def generate(planned: Planned, seed: int, folder: Path) -> Path:
    """Make a campaign, unless this very one is there.

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
    write(make(planned, seed), place)
    mark.write_text(json.dumps(wanted) + "\n", encoding="ascii")
    return place
