"""Calibrate a campaign of a structure and write the figures of docs/how_to/structures.md.

    python tools/isolated_building_figures.py FOLDER/building/campaign.yaml docs/results/figures

The campaign: see campaign_of_isolated_building.py.
"""

from __future__ import annotations

import sys
from pathlib import Path

from edesign.calibration import calibrate
from edesign.calibration.structures.campaign import load_structure_campaign
from edesign.report.calibration.figures import calibration_figures

WANTED = {"peaks": "peaks", "history-ICA50": "history"}


def main(campaign: Path, folder: Path) -> None:
    """Write the figures."""
    found = calibrate(load_structure_campaign(campaign), progress=lambda what: print(what, flush=True))
    for name, _, figure in calibration_figures(found):
        if name in WANTED:
            figure.savefig(folder / f"isolated_building_{WANTED[name]}.svg")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
