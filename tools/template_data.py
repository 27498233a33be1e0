"""Write the records and damper tests that the templates of `edesign new` ship: simulated, so free of any licence.

    python tools/template_data.py

Records go to edesign/project/templates/records; the tests of a programme.yaml go to `tests` beside it.
tests/unit/project/test_templates.py simulates them again.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

from edesign.damper.testing.programme import run_programme
from edesign.damper.testing.programme_file import load_programme
from edesign.ground_motion.record import Record
from edesign.ground_motion.simulation import simulate
from edesign.ground_motion.sources import SIMULATED
from edesign.project.notation.units import STANDARD_GRAVITY

TEMPLATES = Path(__file__).parents[1] / "edesign" / "project" / "templates"
V_S30 = 420.0  # m/s; ground B of EN 1998-1, Table 3.1
SCENARIOS = ((6.4, 8e3), (6.5, 6e3), (6.6, 9e3), (6.6, 10e3), (6.8, 10e3), (7.0, 15e3), (7.1, 12e3))
"""Magnitudes, and distances to the rupture in m."""
_FIRST_SEED = 101
_IN_LINE = 5
TEST_HEAD = "# Simulated by `edesign test programme.yaml`, not measured.\n"
PROGRAMMES = ("laboratory", "calibration")
"""Templates with damper tests."""


def records() -> Iterator[tuple[str, Record]]:
    """Yield the names of the record files, and their records."""
    for i, (magnitude, distance) in enumerate(SCENARIOS):
        yield f"simulated_{i + 1}.AT2", simulate(magnitude, distance, V_S30, _FIRST_SEED + i)


def at2_text(record: Record) -> str:
    """Return a record as a file in the format of the PEER data base, samples in g."""
    samples = [f"{value:15.7E}" for value in record.acceleration / STANDARD_GRAVITY]
    head = [
        f"{SIMULATED}: NO EVIDENCE FOR A DESIGN",
        record.source,
        "ACCELERATION TIME SERIES IN UNITS OF G",
        f"NPTS= {len(samples):6d}, DT= {record.time_step:7.4f} SEC",
    ]
    return "\n".join([*head, *("".join(samples[i : i + _IN_LINE]) for i in range(0, len(samples), _IN_LINE))]) + "\n"


def tests(template: str) -> Iterator[tuple[str, str]]:
    """Yield the names and texts of the test files of a template, with five digits as a logger of 16 bits has them."""
    with tempfile.TemporaryDirectory() as folder:
        run_programme(load_programme(TEMPLATES / template / "programme.yaml"), Path(folder))
        for path in sorted(Path(folder).glob("[0-9]*.csv")):
            header, *rows = path.read_text(encoding="utf-8").splitlines()
            rounded = (",".join(f"{float(cell):.5g}" for cell in row.split(",")) for row in rows)
            yield path.name, TEST_HEAD + "\n".join([header, *rounded]) + "\n"


def main() -> None:
    """Write all files."""
    for name, record in records():
        _write(TEMPLATES / "records" / name, at2_text(record))
    for template in PROGRAMMES:
        for name, text in tests(template):
            _write(TEMPLATES / template / "tests" / name, text)


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(exist_ok=True)
    path.write_text(text, encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
