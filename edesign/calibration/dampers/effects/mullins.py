"""Mullins softening: the virgin specimen is stiffer, and its first cycles take that away for long."""

from __future__ import annotations

from collections.abc import Mapping

from edesign.calibration.dampers.effect import EffectForm, placed
from edesign.calibration.dampers.effects.wear import KOHLRAUSCH
from edesign.calibration.dampers.mechanisms import CoreEffect, Placement
from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.form import Rows, Words, fading, shape, share, size
from edesign.estimation.parameters import Parameter

_SIGNATURE = (
    "too little force in the first cycles of the specimen's life (or of every test), at all amplitudes, fading with "
    "the path travelled"
)
_HARDENS = (
    "too much force in the first cycles of the specimen's life (or of every test), at all amplitudes, fading with the "
    "path travelled"
)
_SOURCE = (
    "Mullins (1969), Rubber Chem. Technol. 42, 339-362; Kelly & Konstantinidis (2011), Mechanics of Rubber Bearings, "
    "section 2.4 (scragging)"
)


def _recovery(s: Sizes) -> tuple[Parameter, ...]:
    return (share("recovery"),) if s.tests > 1 else ()


def _with_recovery(s: Sizes, rows: Rows) -> Rows:
    return tuple((*row, regained) for regained in (0.0, 1.0) for row in rows) if s.tests > 1 else rows


def _constants(s: Sizes) -> Mapping[str, float]:
    return {} if s.tests > 1 else {"recovery": 0.0}  # a single test cannot show what comes back between tests


def _by_path(s: Sizes, first: Parameter) -> tuple[Parameter, ...]:
    own = s.path / s.tests
    return first, shape("s0", "m", 0.4 * own, 0.1 * min(s.displacement, own), 10.0 * s.path), fading(), *_recovery(s)


def _path_starts(s: Sizes, amplitude: float) -> Rows:
    own = s.path / s.tests
    return _with_recovery(s, tuple((amplitude, part * own, 1.0) for part in (0.1, 0.4, 1.5)))


def _distance(s: Sizes, centre: float) -> Parameter:
    return shape("r", "m", centre * s.displacement, 0.02 * s.displacement, 20.0 * s.displacement)


_PATH = EffectForm(
    "mullins",
    "path",
    "damper",
    "softening of the virgin specimen with the path travelled",
    _SIGNATURE,
    f"{_SOURCE}; q: {KOHLRAUSCH}",
    (CoreEffect("mullins.path"),),
    lambda s: _by_path(s, size("m", "", 0.5, -0.9, 3.0)),
    lambda s: _path_starts(s, 0.15),
    _constants,
    negative=Words("hardening of the virgin specimen with the path travelled", _HARDENS),
)
_ELASTIC = EffectForm(
    "mullins",
    "elastic",
    "damper",
    "softening of the virgin specimen's elastic force with the path travelled",
    _SIGNATURE,
    f"{_SOURCE}; q: {KOHLRAUSCH}",
    (CoreEffect("mullins.elastic"),),
    lambda s: _by_path(s, size("k", "N/m", 0.5 * s.stiffness, -2.0 * s.stiffness, 5.0 * s.stiffness)),
    lambda s: _path_starts(s, 0.15 * s.stiffness),
    _constants,
    negative=Words("hardening of the virgin specimen's elastic force with the path travelled", _HARDENS),
)
_MAXIMUM = EffectForm(
    "mullins",
    "maximum",
    "damper",
    "softening below the largest deformation so far",
    "too much force in cycles smaller than one before, right again where the deformation reaches its largest so far",
    "Ogden & Roxburgh (1999), Proc. R. Soc. Lond. A 455, 2861-2877; beta: Abaqus Theory Manual, section 4.7.1",
    (CoreEffect("mullins.maximum"),),
    lambda s: (size("m", "", 0.5, -0.9, 0.95), _distance(s, 0.4), share("beta", 0.1, 0.3), *_recovery(s)),
    lambda s: _with_recovery(s, tuple((0.15, r * s.displacement, 0.1) for r in (0.1, 0.4, 1.5))),
    _constants,
    negative=Words(
        "hardening below the largest deformation so far",
        "too little force in cycles smaller than one before, right again where the deformation reaches its largest so "
        "far",
    ),
)
_DAMAGE = EffectForm(
    "mullins",
    "damage",
    "damper",
    "lasting softening by the largest deformation so far",
    "the stiffness falls where the deformation goes beyond its largest so far, and stays lower in smaller cycles after",
    "Simo (1987), Comput. Methods Appl. Mech. Engrg 60, 153-173; Miehe (1995), Eur. J. Mech. A 14, 697-720",
    (CoreEffect("mullins.damage"),),
    lambda s: (
        size("m", "", 0.5, -0.9, 0.95),
        _distance(s, 0.5),
        shape("p", "", 1.0, 0.3, 6.0, spread=0.5),
        *_recovery(s),
    ),
    lambda s: _with_recovery(s, ((0.1, 0.15 * s.displacement, 1.0), (0.1, 0.5 * s.displacement, 1.0))),
    _constants,
    negative=Words(
        "lasting hardening by the largest deformation so far",
        "the stiffness grows where the deformation goes beyond its largest so far, and stays in smaller cycles after",
    ),
)

FORMS = (*placed(_PATH, *Placement), *placed(_MAXIMUM, *Placement), _DAMAGE, _ELASTIC)
