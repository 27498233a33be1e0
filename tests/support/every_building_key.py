"""A building file that has every key of the format, in several forms: of some keys only one may stand in a file."""

from __future__ import annotations

EVERY_KEY = """\
edesign_building: 1
title: Every key
document: {client: C, project_number: "07", author: A. B., checker: C. D., revision: "02", date: 2026-05-04, notes: N}
plan: {x: [6 m, 5 m], y: {count: 2, width: 5 m}, axes: {x: [A, B, C], y: [1, 2, 3]}}
storeys: [4 m, 3.5 m, 3 m]
setbacks:
  - {floors: 3, bays: [{x: 1, y: all}]}
supports:
  default: fixed
  C: pinned
  A1: {ux: fixed, uy: fixed, uz: 900 MN/m, rx: 80 MN*m/rad, ry: 80 MN*m/rad, rz: fixed}
  B3: {footing: {soil: sand, length: 2.4 m, width: 2 m, embedment: 1 m, wall_contact: 0.8 m, formula: gazetas,
    radiation: true, period: 0.8 s, thickness: 0.6 m, density: 2500 kg/m^3, uplift: true, bearing_resistance: 400 kPa}}
soils:
  sand: {density: 1900 kg/m^3, shear_wave_velocity: 200 m/s, poisson: 0.3, damping: 5 %,
    strain: {code: asce7, site_class: D, acceleration: 0.2 g}}
  clay: {density: 1800 kg/m^3, shear_modulus: 60 MPa, poisson: 0.45, damping: 5 %,
    strain: {code: given, modulus_ratio: 0.7}}
diaphragms: 1-3
partial_diaphragms: [{floors: 1, bays: {x: 1-2, y: 1}}]
columns:
  - {at: all, storeys: 1, section: HEB300, material: S355, strong: x, group: C1}
  - {at: all, storeys: 2-3, section: HEB260, material: S355, strong: x, group: C2}
beams:
  - {along: x, frames: all, bays: all, floors: all, section: IPE330, material: S355, ends: rigid, group: BX,
     stiffness_factor: 1.5}
  - {along: x, frames: 2, bays: 2, floors: 1, section: IPE330, material: S355,
     ends: {start: 60 MN*m/rad, end: rigid}, group: BS}
  - {along: y, section: IPE270, material: S355, ends: pinned, group: BY}
  - {along: y, frames: B, bays: 1, floors: 1, section: IPE270, material: S355, ends: pinned, group: BC,
     slab: {thickness: 70 mm, ribs: 60 mm, E: 31 GPa, reinforcement: 0.5 %}}
braces:
  - {along: y, frames: [A, C], bays: 1, storeys: 1-2, kind: rising, link: 0.8 m, section: SHS120x8, material: S235,
     compression: true, group: D1}
  - {along: y, frames: A, bays: 1, storeys: 3, kind: rising, link: 0.6 m, section: SHS100x6, material: S235, group: D2}
  - {along: y, frames: B, bays: 1, storeys: 3, kind: rising, link: 0.6 m, section: SHS100x6, material: S235, group: D3}
missing:
  columns: [{at: B2, storeys: 3}]
  beams: [{along: x, frames: 2, bays: 1, floors: 3}]
materials:
  S355: {E: 210 GPa, fy: 355 MPa, nu: 0.3, density: 7850 kg/m^3}
  S235: {fy: 235 MPa}
sections:
  plates: {height: 300 mm, width: 200 mm, flange: 15 mm, web: 9 mm}
  box: {height: 300 mm, width: 250 mm, flange: 16 mm, web: 12 mm, webs: 2}
  stack: {rectangles: [{width: 200 mm, depth: 20 mm, centre: 0 mm}, {width: 12 mm, depth: 200 mm, centre: 110 mm}]}
  properties: {area: 50 cm^2, inertia: 8000 cm^4, weak_inertia: 600 cm^4, torsion_constant: 20 cm^4,
    shear_area: 20 cm^2, weak_shear_area: 25 cm^2}
loads:
  areas:
    - {floors: 1-2, bays: {x: 1-2, y: all}, G: 4 kN/m^2, Q: 2 kN/m^2, category: B, spans: x, secondary_beams: 2,
       secondary_section: IPE220, secondary_material: S355}
    - {floors: 3, bays: all, G: 3 kN/m^2, Q: 0.8 kN/m^2, category: snow, spans: x}
  perimeter: [{floors: 1-2, G: 1.2 kN/m, Q: 0.1 kN/m, category: B}]
  beams:
    - {along: y, frames: A, bays: 1, floors: 1, G: 2 kN/m, Q: 1 kN/m, category: B,
       points: [{at: [1/3, 2 m], G: 10 kN, Q: 4 kN}],
       partial: [{start: 1/4, end: 3 m, G: [2 kN/m, 4 kN/m], Q: 1 kN/m}]}
  nodes: [{at: A1-B1, floors: 3, G: 5 kN, Q: 2 kN, category: snow}]
  self_weight: true
  live_load_reduction: true
  cases:
    wind_x:
      category: wind
      reversed: true
      facades: [{side: x-, storeys: all, pressure: 0.7 kN/m^2}]
      floors: [{floors: 2, x: 4 kN, y: 1 kN, at: {x: 5 m, y: 4 m}}]
    crane:
      category: crane
      areas: [{floors: 1, bays: {x: 1, y: all}, q: 0.2 kN/m^2, spans: x, secondary_beams: 0}]
      beams: [{along: y, frames: A, bays: 1, floors: 1, q: 1 kN/m}]
      nodes: [{at: A1, floors: 1, x: 1 kN, y: 1 kN, down: 5 kN}]
  psi: {crane: [1, 0.9, 0.5]}
masses:
  from_loads: {G: 1.0, Q: {B: 0.3, snow: 0}}
  added: [{at: A1, floors: 2, mass: 4 t}]
  phi: 0.8
hinges:
  - {beams: {along: x, frames: 1, bays: all, floors: 1}, ends: both, parameters: lignos_krawinkler_2011,
     reduced_section: {a: 0.1 m, b: 0.2 m, c: 0.02 m}, unbraced_length: 1.2 m, stiffness_ratio: 10}
  - {columns: {at: C, storeys: 2}, ends: end, parameters: {M_y: 400 kN*m, theta_p: 0.02 rad, theta_pc: 0.15 rad,
     theta_u: 0.2 rad}}
  - beams: {along: x, frames: 3, floors: 1}
    distance: 0.3 m
    parameters: {M_y: 200 kN*m, M_c_ratio: 1.1, M_r_ratio: 0.4, theta_p: 0.02 rad, theta_pc: 0.15 rad,
      theta_u: 0.2 rad, Lambda: 0.8 rad, Lambda_s: 0.8 rad, Lambda_c: 0.8 rad, Lambda_k: 0.8 rad, c: 1, D: 0.9,
      hogging: {M_y: 180 kN*m, M_c_ratio: 1.2, M_r_ratio: 0.3, theta_p: 0.02 rad, theta_pc: 0.1 rad,
        theta_u: 0.15 rad, D: 1}}
joints:
  - {columns: {at: A-B, storeys: 1}, ends: start, stiffness: 200 MN*m/rad, resistance: 300 kN*m, hardening: 0.01}
  - {beams: {along: x, frames: 1, bays: all, floors: 2}, stiffness: 80 MN*m/rad}
panel_zones: [{at: A, floors: 1, doubler: 6 mm, hardening: 0.02}]
hazard:
  code: ec8-2004
  country: france
  zone: 4
  ground: B
  spectrum: 2
  damping: 5 %
  parameters: {S: 1.2, F_0: 2.5, T_B: 0.15 s, T_C: 0.5 s, T_D: 2 s}
  national:
    vertical: {ratio: 0.9, F_0: 3, T_B: 0.05 s, T_C: 0.15 s, T_D: 1 s}
    lower_bound_factor: 0.2
    importance_factors: {I: 0.8, II: 1.0, III: 1.2, IV: 1.4}
    phi: {roof: 1.0, correlated: 0.8}
    displacement_reduction: {I: 0.5, II: 0.5}
    low_ductility_q: 1.5
    material_overstrength: 1.25
    post_buckling: 0.3
    psi: {B: [0.7, 0.5, 0.3]}
    action_factors: {G_sup: 1.35, G_inf: 1.0, Q: 1.5, xi: 0.85}
    resistance_factors: {M0: 1.0, M1: 1.0, M2: 1.25}
  k: 3
  levels:
    DBE: {importance_class: II}
    MCE: {return_period: 2475 year}
    SLS: {probability: 50 %}
    other: {gamma_I: 1.1}
design:
  code: {actions: en1990-2002, steel: ec3-2005, seismic: ec8-2004}
  level: DBE
  ductility_class: medium
  systems:
    x: {type: moment_frame, q: table, alpha_u_over_alpha_1: 1.2}
    y: {type: eccentric, q: 3}
  regular_in_plan: false
  regular_in_elevation: false
  combination: cqc
  damping: 5 %
  modes: auto
  accidental_torsion: 5 %
  torsion_by: shifted_masses
  directions: 30 %
  imperfections: sway
  second_order: amplify
  displacement: elastic_cap
  drift: {limit: none_attached, nu: 0.5}
  serviceability: {beams: {total: 1/200, live: 1/300}, sway: {storey: 1/300, building: 1/500}}
  fundamental: {expression: 6.10a/b, favourable: true, stated: [{G: 1.2, Q_B: 0.5, wind_x: 1.1}]}
  partial_factors: {M0: 1.0, M1: 1.0, G: 1.35, Q: 1.5}
  overstrength: 1.25
  members:
    interaction: annex_b
    buckling_length: {columns: {y: 1, z: 1}, beams: {y: 1, z: 1}, braces: {y: 1, z: 1},
      places: [{kind: braces, groups: [D1], storeys: 1, y: 0.5, z: 0.6}]}
    lateral_restraint: {beams: ends, columns: floors}
    yield_by_thickness: en10025-2
    doubler_plates: true
    beams_beside_links: amplified
  select:
    lists: {columns: [HEB, HEM], beams: [IPE], braces: [SHS], groups: {C1: [HEB3*, HEM300]}}
    largest_depth: {braces: 200 mm, BY: 400 mm}
    objective: cost
    prices: {IPE: 1.5, HEB: 1.6, default: 2.2}
    columns_not_larger_above: true
    prices_each: {splice: 300, doubler: 200}
    same_depth: [columns]
    most_sections: {beams: 4}
    starts: 1
    evaluations: 300
    leave_out: [4.2.3.2(6), 6.8.2(4), 6.8.2(7), 6.8.2(10)]
"""

OTHER_FORMS = (
    EVERY_KEY.replace(
        "plan: {x: [6 m, 5 m], y: {count: 2, width: 5 m}", "plan: {x: {count: 2, width: 6 m}, y: [5 m, 5 m]"
    )
    .replace("storeys: [4 m, 3.5 m, 3 m]", "storeys: {count: 3, height: 3.5 m}")
    .replace(
        "from_loads: {G: 1.0, Q: {B: 0.3, snow: 0}}\n  added: [{at: A1, floors: 2, mass: 4 t}]\n  phi: 0.8",
        "given: [{at: all, floors: 1-3, mass: 9 t}]\n  directions: both",
    )
    .replace("  live_load_reduction: true\n", "  pattern: chessboard\n")
    .replace("loads:\n  areas:", "loads:\n  gravity: {G: 1.0, Q: {B: 0.3, snow: 0}}\n  areas:")
    .replace("country: france\n  zone: 4\n", "a_gR: 1.6 m/s^2\n")
    .replace(
        "kind: rising, link: 0.8 m, section: SHS120x8, material: S235,\n     compression: true",
        "kind: chevron, section: SHS120x8, material: S235",
    )
    .replace("kind: rising, link: 0.6 m", "kind: cross")
    .replace("y: {type: eccentric, q: 3}", "y: {type: concentric_v, q: 2}")
    .replace("6.8.2(4), 6.8.2(7), 6.8.2(10)", "6.7.3(1), 6.7.3(2), 6.7.3(8)")
    .replace("torsion_by: shifted_masses", "torsion_by: static_moments")
    .replace("interaction: annex_b", "interaction: annex_a")
    .replace("{beams: ends, columns: floors}", "{beams: slab, columns: floors}")
)

HELD = (
    EVERY_KEY[: EVERY_KEY.index("design:\n  code")]
    + """\
restrained_floors:
  - {floors: 1}
  - {floors: 2, ux: 80 MN/m, uy: 60 MN/m, rz: 9000 MN*m/rad}
"""
)
"""The same without its design, with floors that the ground holds."""

RESTRAINED = """\
edesign_building: 1
title: One storey on buckling-restrained braces
plan: {x: [6 m], y: [6 m]}
storeys: [4 m]
supports: pinned
columns: [{section: HEB260, material: S355, strong: x}]
beams:
  - {along: x, section: IPE400, material: S355, ends: pinned}
  - {along: y, section: HEA280, material: S355, ends: pinned}
braces:
  - {along: x, frames: all, bays: 1, kind: rising, section: BRB12, material: core, law: brb}
  - {along: y, frames: all, bays: 1, kind: chevron, section: BRB12, material: core, law: brb}
sections:
  OLD: {height: 400 mm, web: 8 mm, angles: L150x100x12, outstanding: long, covers: {width: 320 mm, thickness: 8 mm}}
materials: {S355: {fy: 355 MPa}, core: {fy: 235 MPa}}
dampers:
  laws:
    brb:
      type: buckling_restrained
      parameters: {A_sc: 1000 mm^2, F_ysc: 235 MPa, E: 210 GPa, L_wp: 5 m, L_y: 3.5 m, KF: 1.3, alpha: 0.5 %,
                   R_y: 1.1, strain: 3 %, omega: 1.4, beta: 1.1}
loads: {areas: [{G: 5 kN/m^2, Q: 3 kN/m^2, category: B, spans: x}]}
masses: {from_loads: {}}
hazard: {code: ec8-2004, a_gR: 0.20 g, ground: B, spectrum: 1, levels: {DBE: {probability: 10 %}}}
design:
  ductility_class: high
  systems:
    x: {type: buckling_restrained, q: 5, q_source: approval}
    y: {type: buckling_restrained, q: 5, q_source: approval}
"""
"""Keys of buckling-restrained braces, which are the system of their direction."""
