"""A small project whose report has all kinds of content: variants, levels, dampers, recorded members."""

from __future__ import annotations

import math
from pathlib import Path

from small_frame import write

TITLE = "Office <script>document.title = 'hacked'</script> \"A&B\" 'north'"
_YAML_TITLE = "'" + TITLE.replace("'", "''") + "'"
_DAMPERS = """\
dampers:
  laws:
    tested:
      type: mgmm
      parameters: thesis_table_4_2
      prototype: {layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}
  devices:
    - {kind: chevron, bays: all, storeys: all, law: tested}
analyses:
  - {name: bare.modes, kind: modal, modes: 2, variant: bare, dampers: false}
  - {name: damped.modes, kind: modal, modes: 2, variant: damped}
  - {name: bare.gravity, kind: gravity, variant: bare, dampers: false}
  - {name: bare.DBE, kind: history, record: motion, pga: 0.3 g, level: DBE, variant: bare, dampers: false}
  - {name: damped.DBE, kind: history, record: motion, pga: 0.3 g, level: DBE, variant: damped}
  - {name: bare.MCE, kind: history, record: motion, pga: 0.6 g, level: MCE, variant: bare, dampers: false}
outputs: {members: [C_A_1, B_1_1], histories: [floors, storeys, energy, dampers]}
"""


def write_report_project(folder: Path) -> Path:
    """Write project and record; return the path of the project."""
    path = write(
        folder,
        ("Two storeys", _YAML_TITLE),
        ("hardening: 1 %", "hardening: 0 %"),
        (
            "damping: {kind: rayleigh, ratio: 2 %}",
            "elements: {geometry: {columns: p_delta, beams: linear}}\ndamping: {kind: rayleigh, ratio: 2 %}",
        ),
        (_analyses(), _DAMPERS),
        record=_record(),
    )
    return path


def _analyses() -> str:
    from small_frame import TEXT

    return TEXT[TEXT.index("analyses:") :]


def _record(count: int = 400, step: float = 0.02) -> str:
    """A motion that swells and fades, in the form of the data base."""
    values = [0.3 * math.sin(0.5 * math.pi * i / 12.5) * math.sin(math.pi * i / count) ** 2 for i in range(count)]
    lines = [" ".join(f"{value:.6f}" for value in values[i : i + 5]) for i in range(0, count, 5)]
    head = ["PEER NGA STRONG MOTION DATABASE RECORD", "Made for tests", "ACCELERATION TIME SERIES IN UNITS OF G"]
    return "\n".join([*head, f"NPTS=  {count}, DT=  {step:.4f} SEC", *lines, ""])
