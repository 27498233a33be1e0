"""Write a campaign of damper tests from ramp-and-hold tests of an adhesive in shear.

    python tools/campaign_of_adhesive.py FOLDER_OF_CSV CAMPAIGN_FOLDER

The tests: one layer of 100 mm2, 0.13 mm thick; columns time_s, displacement_mm, force_N. Files differ in the rate of
shear only; the middle one is held out. Each is led back along its first ramp to zero deformation and force, from where
laws count.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from edesign.damper.testing.campaign import write_campaign
from edesign.damper.testing.campaign_blocks import LawChoice
from edesign.damper.testing.measured_files import read_test
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.specimen import Specimen

SPECIMEN = Specimen("acrylic adhesive", 1, 100e-6, 0.13e-3)
LAW = LawChoice("zener", {"k0": "1.5 N/mm", "k1": "7 N/mm", "c1": "2400 N*s/mm"})  # fits the slowest test alone
TEMPERATURE = 20.0  # degC; not given with the data


def from_rest(test: DamperTest) -> DamperTest:
    """With a sample before the first, where the ramp through the first two begins."""
    time, u = test.time, test.displacement
    start = time[0] - u[0] * (time[1] - time[0]) / (u[1] - u[0])
    return replace(
        test,
        time=np.concatenate(([0.0], time - start)),
        displacement=np.concatenate(([0.0], u)),
        force=np.concatenate(([0.0], test.measured_force())),
    )


def main(source: Path, target: Path) -> None:
    """Write the campaign."""
    paths = sorted(source.glob("ramp_hold_*_per_s.csv"))
    if not paths:
        sys.exit(f"{source}: there are no files ramp_hold_RATE_per_s.csv")
    tests = []
    for i, path in enumerate(paths):
        rate = path.stem.removeprefix("ramp_hold_").removesuffix("_per_s")
        test = read_test(path, temperature_C=TEMPERATURE, use="validate" if i == 1 else "fit")
        # a point in the name of a test would end it as a name of a file
        named = replace(from_rest(test), name=path.stem.replace(".", "_"), title=f"{rate} per second")
        tests.append(named)
    write_campaign(target, SPECIMEN, tests, LAW, "adhesive in shear, ramp and hold")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
