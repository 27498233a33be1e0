"""Amplitude (Payne) softening: the filler network breaks with strain and heals again."""

from __future__ import annotations

from edesign.calibration.dampers.effect import EffectForm, placed
from edesign.calibration.dampers.mechanisms import CoreEffect, LastingExtremes, Placement
from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.form import Rows, Words, shape, size
from edesign.damper.testing.start import SOFTENED
from edesign.estimation.parameters import Parameter

_SIGNATURE = "the secant stiffness falls with the amplitude of the cycle and comes back when the amplitude falls"
_STIFFENS = "the secant stiffness grows with the amplitude of the cycle and falls back when the amplitude falls"
_SOURCE = "Payne (1962), J. Appl. Polym. Sci. 6, 57-63; Kraus (1984), J. Appl. Polym. Sci. Symp. 39, 75-92"


def _of_envelope(s: Sizes, first: Parameter) -> tuple[Parameter, ...]:
    return (
        first,
        shape("a0", "m", 0.4 * s.displacement, 0.01 * s.displacement, 10.0 * s.displacement),
        shape("m", "", 1.0, 0.3, 4.0, spread=0.5),
        shape("tau_a", "s", 3.0 * s.period, 0.1 * s.period, 1e4 * s.period),
    )


def _envelope_starts(s: Sizes, amplitude: float) -> Rows:
    return tuple((amplitude, a * s.displacement, 1.0, t * s.period) for a in (0.1, 0.4, 1.2) for t in (1.0, 10.0))


def _share(s: Sizes) -> tuple[Parameter, ...]:
    return _of_envelope(s, size("d", "", 0.6, -1.0, 0.95))


_WHOLE = EffectForm(
    "payne",
    "whole",
    "damper",
    "softening with amplitude of the whole force",
    _SIGNATURE,
    _SOURCE,
    (CoreEffect("payne.whole"),),
    _share,
    lambda s: _envelope_starts(s, 0.1),
    negative=Words("stiffening with amplitude of the whole force", _STIFFENS),
)
_EXPONENTIAL = EffectForm(
    "payne",
    "exponential",
    "damper",
    "softening of the whole force that goes exponentially with amplitude",
    _SIGNATURE,
    "Payne (1962), J. Appl. Polym. Sci. 6, 57-63; the course with amplitude: phenomenological",
    (CoreEffect("payne.exponential"),),
    _share,
    lambda s: _envelope_starts(s, 0.1),
    negative=Words("stiffening of the whole force that comes exponentially with amplitude", _STIFFENS),
)
_ELASTIC = EffectForm(
    "payne",
    "elastic",
    "damper",
    "softening with amplitude of the elastic force",
    _SIGNATURE,
    _SOURCE,
    (CoreEffect("payne.elastic"),),
    lambda s: _of_envelope(s, size("k", "N/m", 0.6 * s.stiffness, -2.0 * s.stiffness, 2.0 * s.stiffness)),
    lambda s: _envelope_starts(s, 0.1 * s.stiffness),
    negative=Words("stiffening with amplitude of the elastic force", _STIFFENS),
)
_NETWORK = EffectForm(
    "payne",
    "network",
    "damper",
    "softening by a filler network that breaks with motion and heals in rest",
    "the force falls within the first cycles, more in fast and large ones, and comes back at rest within seconds",
    "Kraus (1984), J. Appl. Polym. Sci. Symp. 39, 75-92; Lion (1998), Rubber Chem. Technol. 71, 410-429",
    (CoreEffect("payne.network"),),
    lambda s: (
        size("d", "", 0.5, -1.0, 0.95),
        shape("s0", "m", 5.0 * s.displacement, 0.1 * s.displacement, 30.0 * s.path / s.tests + s.displacement),
        shape("tau", "s", 1.5 * s.period, 0.1 * s.period, 30.0 * s.duration + s.period),
    ),
    lambda s: tuple((0.2, a * s.displacement, t * s.period) for a in (1.0, 5.0, 25.0) for t in (0.5, 5.0)),
    negative=Words(
        "stiffening with motion that fades in rest",
        "the force grows within the first cycles, more in fast and large ones, and falls back at rest within seconds",
    ),
)
_LASTING = EffectForm(
    "extremes",
    "lasting",
    "damper",
    "softening by the largest deformation and velocity that lasts from test to test",
    "too much force in tests after larger or faster ones, all along, whatever the rest between",
    "thesis section 4.5: the moduli of the MGMM fall with the extremes of the motion",
    (LastingExtremes(),),
    lambda s: (),
    lambda s: ((),),
    shown=lambda s: s.tests > 1 and s.ordered,
    laws=SOFTENED,
    exact=True,  # a reading of the law, and as right as that
)

FORMS = (
    _LASTING,
    *placed(_WHOLE, *Placement),
    _EXPONENTIAL,
    *placed(_ELASTIC, Placement.WHOLE, Placement.INSIDE),
    *placed(_NETWORK, *Placement),
)
