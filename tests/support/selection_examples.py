"""Small buildings whose sections are to be chosen, and the choice by enumeration."""

from __future__ import annotations

from itertools import product

import numpy as np
from building_examples import building

from edesign.project.building import Building
from edesign.space.elastic_design import ElasticAnalysis
from edesign.space.selection.evaluate import Evaluation, Evaluator
from edesign.space.selection.groups import groups_of
from edesign.space.selection.search import column_order

FRAMES = """\
edesign_building: 1
title: Two frames along x, braced across
plan: {{x: {{count: {bays}, width: {width:.2f} m}}, y: [6 m]}}
storeys: {{count: {storeys}, height: 3.5 m}}
columns:
  - {{storeys: 1-{lower}, section: HEB300, material: S275, strong: x, group: C1}}
  - {{storeys: {above}-{storeys}, section: HEB260, material: S275, strong: x, group: C2}}
beams:
  - {{along: x, floors: 1-{lower}, section: IPE360, material: S275, group: B1}}
  - {{along: x, floors: {above}-{storeys}, section: IPE330, material: S275, group: {upper_beams}}}
  - {{along: y, section: HEA160, material: S275, ends: pinned, group: BY}}
braces:
  - {{along: y, frames: all, bays: 1, kind: cross, section: SHS150x8, material: S275, group: D}}
materials: {{S275: {{fy: 275 MPa}}}}
loads:
  areas: [{{G: {G:.2f} kN/m^2, Q: 2 kN/m^2, category: B, spans: y}}]
  self_weight: true
masses: {{from_loads: {{Q: 0.3}}}}
hazard:
  code: ec8-2004
  a_gR: {a_gR:.3f} g
  ground: C
  spectrum: 1
  levels: {{DBE: {{gamma_I: 1.0}}}}
design:
  ductility_class: {ductility}
  systems: {{x: {{type: moment_frame, q: {q}}}, y: {{type: concentric_diagonal, q: {q_y}}}}}
  drift: {{limit: {drift}, nu: 0.5}}
  select:
    lists:
      columns: [{columns}]
      beams: [{beams}]
      groups: {{BY: [HEA160], D: [SHS150x8]}}
    leave_out: [6.7.3(1), 6.7.3(2), 6.7.3(8)]
"""
"""Frames along x with two groups of columns and one or two of beams; what stands along y is given."""

COLUMNS = ("HEB200", "HEB220", "HEB240", "HEB260", "HEB280", "HEB300", "HEB340", "HEB400", "HEB450", "HEB500", "HEB600")
BEAMS = ("IPE240", "IPE270", "IPE300", "IPE330", "IPE360", "IPE400", "IPE450", "IPE500", "IPE550", "IPE600")


def random_frames(seed: int, sizes: int, groups: int) -> Building:
    """A building of random size, load, hazard and rules.

    Args:
        seed: of the random numbers.
        sizes: sections in each list.
        groups: 3 or 4 whose sections are to be chosen.
    """
    random = np.random.default_rng(seed)
    high = bool(random.integers(2))
    columns, beams = int(random.integers(len(COLUMNS) - sizes + 1)), int(random.integers(len(BEAMS) - sizes + 1))
    storeys = int(random.integers(2, 5))
    text = FRAMES.format(
        bays=int(random.integers(1, 3)),
        width=float(random.uniform(5.0, 8.0)),
        storeys=storeys,
        lower=storeys // 2,
        above=storeys // 2 + 1,
        upper_beams="B2" if groups == 4 else "B1",
        G=float(random.uniform(3.0, 8.0)),
        a_gR=float(random.uniform(0.11, 0.40)),
        ductility="high" if high else "medium",
        q=6.5 if high and int(random.integers(2)) else 4,
        q_y=4,
        drift=("ductile", "none_attached", "none")[int(random.integers(3))],
        columns=", ".join(COLUMNS[columns : columns + sizes]),
        beams=", ".join(BEAMS[beams : beams + sizes]),
    )
    if groups == 3:
        text = text.replace("section: IPE330", "section: IPE360")
    return building(text)


def enumerated(building: Building) -> Evaluation | None:
    """The cheapest choice that meets all checks, by enumeration of all; None if there is none."""
    analysis = ElasticAnalysis(building)
    evaluate = Evaluator(analysis, groups_of(analysis))
    order = column_order(analysis.frame, evaluate.groups)
    choices = [
        choice
        for choice in product(*(range(len(group.sections)) for group in evaluate.groups))
        if all(evaluate.groups[a].area[choice[a]] <= evaluate.groups[b].area[choice[b]] for a, b in order)
        and evaluate.wishes.met(choice)
    ]
    best: Evaluation | None = None
    for choice in sorted(choices, key=evaluate.cost):  # without doublers: the first that is met, or a later one
        if best is not None and evaluate.cost(choice) > best.cost:
            break
        found = evaluate(choice)
        if found.met and (best is None or found.cost < best.cost):
            best = found
    return best


INTERIOR = """\
edesign_building: 1
title: Interior frame of the thesis building, twice, with bays that hold it across
plan: {x: [2 m, 7.2 m, 7.2 m, 7.2 m, 7.2 m, 2 m], y: [21.6 m]}
storeys: {count: 10, height: 3.5 m}
supports: {A: pinned, G: pinned}
columns:
  - {at: B-F, storeys: 1-4, section: HEB450, material: S275, strong: x, group: C1}
  - {at: B-F, storeys: 5-7, section: HEB360, material: S275, strong: x, group: C2}
  - {at: B-F, storeys: 8-10, section: HEB320, material: S275, strong: x, group: C3}
  - {at: [A, G], section: HEM300, material: S275, strong: y, group: CE}
beams:
  - {along: x, bays: 2-5, floors: 1-4, section: IPE450, material: S275, group: B1}
  - {along: x, bays: 2-5, floors: 5-7, section: IPE400, material: S275, group: B2}
  - {along: x, bays: 2-5, floors: 8-10, section: IPE360, material: S275, group: B3}
  - {along: x, bays: [1, 6], section: IPE200, material: S275, ends: pinned, group: BE}
  - {along: y, section: HEB600, material: stiff, ends: pinned, group: BY}
braces:
  - {along: y, frames: [A, G], bays: 1, kind: cross, section: SHS200x12.5, material: stiff, group: D}
materials: {S275: {fy: 275 MPa}, stiff: {fy: 275 MPa, E: 2100 GPa}}
loads:
  beams: [{along: x, bays: 2-5, G: 23 kN/m, Q: 9.6 kN/m, category: B}]
  nodes:
    - {at: C-E, floors: all, G: 34.5 kN}
    - {at: [B, F], floors: all, G: 17.25 kN}
  self_weight: false
masses:
  given:
    - {at: C-E, floors: all, mass: 22.5 t}
    - {at: [B, F], floors: all, mass: 11.25 t}
hazard: {code: ec8-2004, country: greece, zone: 3, ground: C, spectrum: 1, levels: {DBE: {probability: 10 %}}}
design:
  ductility_class: high
  systems: {x: {type: moment_frame, q: 6.5}, y: {type: concentric_diagonal, q: 4}}
  accidental_torsion: none
  drift: {limit: ductile, nu: 0.5}
  select:
    lists: {groups: {CE: [HEM300], BE: [IPE200], BY: [HEB600], D: [SHS200x12.5]}}
    leave_out: [6.5.3(2), 6.6.3(6), 6.7.3(1), 6.7.3(2), 6.7.3(8)]
"""
"""Finding 8 of the design document: 90 t a floor and frame; the pinned bays at both ends carry the braces along y."""
