"""Write campaigns from the shake-table runs of a base-isolated building: of the building, and of its isolation layer.

    python tools/campaign_of_isolated_building.py FOLDER_OF_RUNS FOLDER [HELD_OUT]

FOLDER/building/campaign.yaml names the runs where they are, with base motion in and floor motion out.
FOLDER/layer/campaign.yaml and its CSV files are damper tests of the isolation layer: its drift, and minus the sum of
mass times acceleration over the floors. Masses are not given with the data; with equal ones of 75 t results per mass
are right. One run is held out (ICA50 if not said), the others are fitted to. The declared layer is a spring and a
dashpot that fit the run of the smallest drift, CNP100, alone.
"""

from __future__ import annotations

import os.path
import sys
from pathlib import Path

import numpy as np
import yaml

from edesign.archive.files import make_folder, write_text
from edesign.calibration.structures.campaign import StructureCampaign, load_structure_campaign
from edesign.damper.testing.campaign import write_campaign
from edesign.damper.testing.campaign_blocks import LawChoice
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.specimen import Specimen
from edesign.errors import InputError

RUNS = ("CNP100", "ICA50", "SP100")  # by largest drift: 87, 121, 143 mm
HELD_OUT = "ICA50"
FLOORS = 6
LAW = LawChoice("kelvin_voigt", {"k": "3.3 kN/mm", "c": "390 kN*s/m"})
LAYER = Specimen("isolation layer", 1, 0.5, 0.2)  # of no consequence: forces and drifts are those of the whole layer


def building(source: Path, folder: Path, held_out: str) -> dict[str, object]:
    """Campaign of the building."""
    return {
        "title": "base-isolated building on a shake table",
        "structure": {
            "name": "isolated building",
            "base": "isolated",
            "floor_masses": ["75 t"] * FLOORS,
            "storey_stiffness": ["80 kN/mm"] * (FLOORS - 1),
            "damping": {"type": "modal", "ratio": "3 %"},
        },
        "law": {"type": LAW.type, "parameters": LAW.parameters},
        "channels": {
            "time": "time_s",
            "base_acceleration": "table_acc_m_s2",
            "floor_accelerations": [f"floor{i}_acc_m_s2" for i in range(1, FLOORS + 1)],
            "floor_displacements": ["floor1_rel_disp_m", *[None] * (FLOORS - 1)],
            "units": {"time": "s", "acceleration": "m/s^2", "displacement": "m"},
        },
        "tests": [
            {
                "file": os.path.relpath(source / f"{run}.csv.gz", folder),
                "use": "validate" if run == held_out else "fit",
            }
            for run in RUNS
        ],
    }


def isolation_layer_tests(campaign: StructureCampaign, temperature_C: float = 20.0) -> tuple[DamperTest, ...]:
    """Tests of the isolation layer: displacement of the lowest floor, and F = -sum m_i a_i of all floors.

    What is above the layer needs no model, so the equation error in F is right for laws of the layer. Forces scale
    with the declared masses.

    Args:
        campaign: of an isolated building; accelerations of all floors and the displacement of the lowest are measured.
        temperature_C: of the layer.

    Raises:
        InputError: the base is fixed, or a channel is missing.
    """
    if not campaign.building.isolated:
        raise InputError(f"{campaign.path}: a building on a fixed base has no isolation layer [E-FILE-05]")
    found = []
    for test in campaign.tests:
        drift = test.column("displacement", 0)
        if drift is None:
            raise InputError(
                f"{test.source}: the drift of the layer is needed: the displacement of floor 1 [E-TABLE-10]"
            )
        force = np.zeros(test.base.size)
        for floor, mass in enumerate(campaign.building.masses):
            acceleration = test.column("acceleration", floor)
            if acceleration is None:
                raise InputError(
                    f"{test.source}: the acceleration of floor {floor + 1} is needed for the force [E-TABLE-10]"
                )
            force -= mass * acceleration
        found.append(
            DamperTest(test.name, test.time, drift, force, temperature_C, None, test.title, test.use, test.source)
        )
    return tuple(found)


def main(source: Path, target: Path, held_out: str) -> None:
    """Write both campaigns."""
    if held_out not in RUNS:
        sys.exit(f"{held_out}: the runs are {', '.join(RUNS)}")
    folder = target / "building"
    make_folder(folder)
    text = yaml.safe_dump(building(source, folder, held_out), sort_keys=False, default_flow_style=None, width=140)
    write_text(text, folder / "campaign.yaml")
    campaign = load_structure_campaign(folder / "campaign.yaml")
    tests = isolation_layer_tests(campaign)
    write_campaign(target / "layer", LAYER, tests, LAW, "isolation layer of the building")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3] if len(sys.argv) > 3 else HELD_OUT)
