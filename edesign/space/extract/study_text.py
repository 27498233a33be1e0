"""A study of an extracted frame: without and with dampers, under motions that fit the building's hazard."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from edesign.codes.ec8.action.ground import ground_type
from edesign.codes.fema356.objectives import BASIC, OBJECTIVES
from edesign.errors import InputError
from edesign.ground_motion.hazard import elastic_spectrum
from edesign.ground_motion.simulation.simulate import simulate
from edesign.ground_motion.simulation.site import V_S30_RANGE
from edesign.project.actions.hazard import EC8Hazard
from edesign.project.building.names import BeamPlace
from edesign.project.reading.yaml_edit import yaml_text
from edesign.space.extract.frame_row import FrameRow
from edesign.space.extract.selections import selection, value
from edesign.space.extract.study_limits import study_hazard, study_limits
from edesign.space.structure.design_block import MOMENT_FRAME, design_of, system_of

MOTIONS = "motions"
"""Name of the records in the project."""
LAW = "elastomer"
"""Name of the law of the dampers in the project."""

N_MOTIONS = 7
"""As many as let the mean of their results count. Source: EN 1998-1:2004, 4.3.3.4.3(3); NTC 2018, 7.3.5."""
MAGNITUDES = {1: 6.5, 2: 5.5}
"""Of simulated records, by the type of spectrum. Source: EN 1998-1:2004, 3.2.2.2(2)P, Note 1: type 2 to M_s = 5.5.

NTC 2018 has no types; its records are those of type 1.
"""
DISTANCES = (5e3, 10e3, 15e3, 20e3, 30e3, 40e3, 60e3, 80e3)
"""Of simulated records, m: that whose motion has the peak nearest to a_g S is taken, so that scaling stays modest."""
_SURFACE_OF_E = "C"  # ground E has the velocity of C or D near the surface

RESIDUAL_DRIFT, RESIDUAL_SOURCE = 0.005, "FEMA P-58-1, Appendix C, damage state 2"
"""Damage state 2 (edition of 2012), from which on a frame has to be straightened."""


@dataclass(frozen=True)
class StudyNames:
    """Names by which the files of a study refer to each other.

    Attributes:
        project: the project file, from the study's folder.
        suite: the suite file, from the project's folder.
        folder: of the user's recordings, from the project's folder; "" for none.
    """

    project: str
    suite: str
    folder: str = ""


def study_blocks(row: FrameRow, names: StudyNames) -> str:
    """Return what the project file of a frame needs for a study: damping, integration, records, a law of dampers.

    Args:
        row: one frame of a building, or all of a direction.
    """
    modes = "kind: rayleigh, ratio: 2 %, modes: [1, 2]" if row.top > 1 else "kind: modal, ratio: 2 %, modes: 1"
    folders = f", folders: [{yaml_text(names.folder)}]" if names.folder else ""
    records = "\n".join(
        f"  {name}: {{suite: {yaml_text(names.suite)}{folders}, match: {{{fitted}method: wavelets}}}}"
        for name, (_, fitted) in _motions(row).items()
    )
    return f"""\
damping: {{{modes}}}

integration: {{method: newmark, time_step: 0.01 s}}

records:                                # fitted to the spectrum of the hazard
{records}

dampers:
  laws:                                 # a tested elastomer; `edesign fit` makes the law of another one
    {LAW}:
      type: mgmm
      parameters: thesis_table_4_2
      prototype: {{layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}}
"""


def study_text(row: FrameRow, names: StudyNames, drift: float | None = None) -> str:
    """Return the study of a frame without dampers and with dampers that are sized until the criteria are met.

    Viscoelastic dampers on chevrons stand in the first and the last bay that is free of braces from base to top; of
    several frames, in those of the first and the last one that resist.

    Args:
        row: one frame, or all of a direction, of a building with a hazard and masses.
        drift: largest storey drift at the level at which it is limited, a ratio; None: that of the building's own
            limit.

    Raises:
        InputError: as `study_limits`, or no bay has room for dampers.
    """
    building, limits = row.building, study_limits(row.building, drift)
    level, bays = yaml_text(limits.level), _bays(row)
    motions = _motions(row)
    histories = "\n".join(
        f"  - {{variants: all, levels: [{', '.join(levels)}], records: {name}, free_vibration: 20 s}}"
        for name, (levels, _) in motions.items()
    )
    verified = list(dict.fromkeys((limits.drift_level, limits.level)))
    proofs = [name for name in motions if name == MOTIONS or name.removeprefix(f"{MOTIONS}_") in verified]
    proved = f"records: {_list(proofs)}, levels: {_list(verified)}"
    objectives = f"objectives: [{', '.join(limits.objectives)}]"
    last = f"{objectives}                       # {_safety(limits.objectives)}\n\n"
    return f"""\
# Motions: `edesign check` says which of them are recordings and which are simulated.

edesign_study: 1
title: {yaml_text(f"{building.title}, {row.name}, with and without dampers")}
project: {yaml_text(names.project)}

designs:
  dampers:
    method: strain_energy
    law: {LAW}
    kind: chevron
    bays: {bays}
    layers: 2
    damping: 10 %                       # of critical, in the first mode; more if the criteria ask for it
    level: {level}                          # its spectrum gives what the dampers reach
    strain: spectrum                    # of the layers, at which their properties are taken: what they reach
    properties: {{table: thesis_appendix_a}}
    drift: {100.0 * limits.reached:.6g} %                        # {limits.reached_by}
    strain_limit: 50 %
    brace: {{ratio: 7}}                   # braces of a storey over its stiffness
    braces_in_target: false             # the damping is of the dampers alone; behind the braces they add less
    target_in: storeys                  # in each storey by itself, thesis Eq. 5.9
    verify: {{{proved}, criteria: [drift, residual drift], free_vibration: 20 s}}

variants:
  bare: {{dampers: none}}
  damped: {{design: dampers}}

histories:
{histories}

criteria:
  - name: drift                         # {limits.drift_is}
{_source(limits.source)}    measure: interstorey_drift
    levels: {yaml_text(limits.drift_level)}
    most: {100.0 * limits.drift:.6g} %
  - name: residual drift                # up to it a frame needs no straightening
{_source(RESIDUAL_SOURCE)}    measure: residual_interstorey_drift
    levels: {level}
    most: {100.0 * RESIDUAL_DRIFT:g} %
{_uses(row, level)}
{last if limits.objectives else ""}outputs: {{histories: [floors], every: 2}}
"""


def _safety(letters: Sequence[str]) -> str:
    """What objectives are in FEMA 356, of which h and l together are the basic safety objective."""
    absent = [letter for letter in BASIC if letter not in letters]
    if not absent:
        return "the basic safety objective of FEMA 356"
    rarities = ", ".join(f"{letter}: {100.0 * OBJECTIVES[letter].probability:g} %" for letter in absent)
    return f"a part of the basic safety objective of FEMA 356; no level is of {rarities} in 50 years"


def _uses(row: FrameRow, level: str) -> str:
    """Criteria of members that are not meant to yield: columns, and beams and braces that are not dissipative."""
    if row.building.design is None:
        return ""
    asked = [("sections", "section_use", "6.2", "# columns, and what is not meant to yield")]
    asked.append(("members", "member_use", "6.3", "# likewise against buckling"))
    of_design = design_of(row.building)
    yields = of_design.ductility_class != "low" and system_of(of_design, row.along).type != MOMENT_FRAME
    if any(frame.braces for frame in row.frames) and not yields:
        asked.append(("braces", "brace_use", "6.2.3, 6.3.1", "# likewise in tension and against buckling"))
    return "".join(
        f"  - name: {name:<30}{told}\n{_source(f'EN 1993-1-1, {clause}')}    quantity: {quantity}\n"
        f"    of: not_dissipative\n    levels: {level}\n    most: 1\n"
        for name, quantity, clause, told in asked
    )


def _source(clause: str) -> str:
    """The line of a criterion that says where its limit comes from, which the report prints beside the check."""
    return f"    source: {yaml_text(clause)}\n" if clause else ""


def _motions(row: FrameRow) -> dict[str, tuple[list[str], str]]:
    """Records of the project by name: the levels of their histories, and what says to which one they are fitted."""
    hazard = study_hazard(row.building)
    levels = {name: yaml_text(name) for name in hazard.levels}
    if not hazard.own_shapes:
        return {MOTIONS: (list(levels.values()), "")}
    return {f"{MOTIONS}_{name}": ([level], f"level: {level}, ") for name, level in levels.items()}


def suite_text(row: FrameRow) -> str:
    """Return a suite of motions, each of which stands for a recording until the user has one.

    Args:
        row: one frame, or all of a direction, of a building with a hazard.

    Raises:
        InputError: as `study_limits`.
    """
    hazard = study_hazard(row.building)
    kind, level = (hazard.spectrum, None) if isinstance(hazard, EC8Hazard) else (1, study_limits(row.building).level)
    magnitude, v_s30 = MAGNITUDES[kind], _v_s30(hazard.ground)
    peak = elastic_spectrum(hazard, level).zero_period
    shape = f"spectrum of type {kind}" if level is None else f"spectrum of NTC 2018 under {level}"
    peaks = [float(np.max(np.abs(simulate(magnitude, far, v_s30, 1).acceleration))) for far in DISTANCES]
    distance = min(zip(DISTANCES, peaks, strict=True), key=lambda pair: abs(math.log(pair[1] / peak)))[0]
    text = f"""\
# Motions for a study. Give each entry a recording: `peer: RSN6_IMPVALL.I_I-ELC180.AT2` for a file of PEER in the folder
# of --recordings, or `file: motions/mine.csv` in place of all other keys. An entry without one is simulated.

edesign_suite: 1
title: Motions for ground {hazard.ground}, {shape}
records:
"""
    for seed in range(1, N_MOTIONS + 1):
        text += f"""\
  - id: motion_{seed}
    magnitude: {magnitude:g}
    distance: {value(distance / 1e3, "km")}
    simulated: {{seed: {seed}, v_s30: {value(v_s30, "m/s")}}}
"""
    return text


def _list(names: list[str]) -> str:
    """One name, or a list of several."""
    texts = [yaml_text(name) for name in names]
    return texts[0] if len(texts) == 1 else f"[{', '.join(texts)}]"


def _v_s30(ground: str) -> float:
    """Shear wave velocity of a ground type in the range of the simulation: the middle of Table 3.1, m/s."""
    low, high = ground_type(ground).v_s30 or ground_type(_SURFACE_OF_E).v_s30 or V_S30_RANGE
    middle = low if math.isinf(high) else 0.5 * (low + high)
    return min(max(middle, V_S30_RANGE[0]), V_S30_RANGE[1])


def _bays(row: FrameRow) -> str:
    """The first and the last free bay of the frame; of several frames, of the first and the last that reach the top.

    A bay is free if it has columns and beams in all storeys, and no braces.
    """
    storeys = range(1, row.top + 1)
    free = []
    for frame, start in zip(row.frames, row.starts, strict=True):
        braced = {place.bay for place in frame.braces}
        of_frame = [
            start + bay
            for bay in range(1, len(frame.lines))
            if bay not in braced
            and all((i, storey) in frame.columns for i in (bay - 1, bay) for storey in storeys)
            and all(
                BeamPlace(frame.along, frame.number, bay, floor, frame.building.axes) in frame.beams
                for floor in storeys
            )
        ]
        free += [(of_frame[0], of_frame[-1])] if of_frame and frame.resists else []
    if not free:
        where = row.building.where("braces")
        raise InputError(
            f"{where}: {row.name}: no bay is free of braces, with columns and beams in all storeys, for "
            "dampers to stand in [E-SPACE-06]"
        )
    return selection(sorted({*free[0], *free[-1]}), [], str)
