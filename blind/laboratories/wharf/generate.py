"""Makes campaigns: files of tests, campaign.yaml, and the truth beside each folder."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from blind.laboratories import CATEGORIES
from blind.laboratories.wharf.campaign import draw
from blind.laboratories.wharf.write import write

STREAM = 5  # of this laboratory


def make(folder: Path, seed: int, number: int, only: Sequence[str] = (), motion: bool = False) -> list[Path]:
    """Make campaigns; one of each category in turn.

    Args:
        folder: for the campaigns.
        seed: of everything.
        number: of campaigns; the first are the same whatever the number.
        only: categories to write; none: all.
        motion: not used here: three in ten campaigns have tests in motion.

    Returns:
        Folders of the campaigns that were not there before.
    """
    made = []
    for i in range(1, number + 1):
        category = CATEGORIES[(i - 1) % len(CATEGORIES)]
        if (only and category not in only) or (Path(folder) / f"{i:03d}_{category}.truth.json").exists():
            continue
        campaign = draw(category, np.random.default_rng([seed, i, STREAM]))
        made.append(write(campaign, Path(folder) / f"{i:03d}_{category}", seed))
    return made
