"""An isolation layer that softens with amplitude, or stiffens at large drifts, beside its declared law."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from edesign.calibration.form import Values, Words, shape, size
from edesign.calibration.structures.building import Building
from edesign.calibration.structures.effect import Links, StructureForm
from edesign.calibration.structures.response import Link
from edesign.calibration.structures.sizes import StructureSizes, is_isolated
from edesign.estimation.parameters import Parameter

_SMOOTH = (0.0, 1.0, 0.5, 0.5, 1.0)  # alpha, A, beta, gamma, n of Bouc-Wen: no stiffness after yielding


def _links(of: Callable[[Values], Link]) -> tuple[Links]:
    """Return one link in the isolation layer; none of no size."""

    def links(p: Values, building: Building) -> tuple[Link, ...]:
        return (of(p),) if next(iter(p.values())) else ()

    return (Links(links),)


def _bouc_wen(p: Values) -> Link:
    return Link(0, p["F"] / p["Y"], "bouc_wen", (p["F"], p["Y"], *_SMOOTH))


def _slips(p: Values) -> Link:
    return Link(0, p["F"] / p["Y"], "elastic_plastic", (p["F"] / p["Y"], p["F"], 0.0))


def _hardens(p: Values) -> Link:
    # its tangent at twice the reference, which no drift passes, and p = 2
    return Link.alone(0, 3.0 * p["k"] * p["p"], "hardening.power", p["k"], p["p"], p["r"])


def _force(s: StructureSizes) -> Parameter:
    # friction and hysteresis give no energy: never below zero
    return size("F", "N", 0.2 * s.shear, 0.0, 3.0 * s.shear)


def _stiffness(s: StructureSizes) -> float:
    return float(s.building.stiffness[0])


def _of_drift(name: str, s: StructureSizes, centre: float, least: float, most: float) -> Parameter:
    drift = float(s.drift[0])
    return shape(name, "m", centre * drift, least * drift, most * drift)


_BOUC_WEN = StructureForm(
    "isolation_softening",
    "bouc_wen",
    "structure",
    "smooth hysteresis in the isolation layer",
    "the isolated period is longer in larger motions; the phase of the residual drifts with the amplitude",
    "Wen (1976), J. Engng Mech. 102, 249-263; Nagarajaiah, Reinhorn & Constantinou (1991)",
    _links(_bouc_wen),
    lambda s: (_force(s), _of_drift("Y", s, 0.05, 1e-3, 3.0)),
    lambda s: tuple((0.05 * s.shear, part * float(s.drift[0])) for part in (0.03, 0.15)),
    shown=is_isolated,
    meanings={
        "F": "force at which the layer yields or slips",
        "Y": "drift over which it does so",
        "k": "stiffness that is lost",
        "a0": "amplitude at which half of it is lost",
        "m": "power with which it is lost: the larger, the sharper",
        "tau_a": "memory of the amplitude",
        "d": "largest drift over which it is lost",
    },
)
_FRICTION = replace(
    _BOUC_WEN,
    form="friction",
    title="friction in the isolation layer",
    source="Constantinou, Mokha & Reinhorn (1990), J. Struct. Engng 116, 455-474",
    mechanisms=_links(_slips),
    parameters=lambda s: (_force(s), _of_drift("Y", s, 0.02, 1e-3, 1.0)),
    starts=lambda s: tuple((0.05 * s.shear, part * float(s.drift[0])) for part in (0.01, 0.1)),
)
_ENVELOPE = replace(
    _BOUC_WEN,
    form="envelope",
    title="stiffness of the isolation layer that falls with amplitude",
    source="Kraus (1984), J. Appl. Polym. Sci. Symp. 39, 75-92",
    mechanisms=_links(lambda p: Link.alone(0, p["k"], "payne.elastic", p["k"], p["a0"], p["m"], p["tau_a"])),
    parameters=lambda s: (
        size("k", "N/m", 0.5 * _stiffness(s), -2.0 * _stiffness(s), 3.0 * _stiffness(s)),
        _of_drift("a0", s, 0.4, 0.01, 10.0),
        shape("m", "", 1.0, 0.3, 4.0, spread=0.5),
        shape("tau_a", "s", 3.0 * s.period, 0.1 * s.period, 1e4 * s.period),
    ),
    starts=lambda s: tuple(
        (0.1 * _stiffness(s), part * float(s.drift[0]), 1.0, 3.0 * s.period) for part in (0.1, 0.4, 1.2)
    ),
    negative=Words(
        "stiffness of the isolation layer that grows with amplitude",
        "the isolated period is shorter in larger motions; the phase of the residual drifts with the amplitude",
    ),
)
_SCRAGGING = replace(
    _BOUC_WEN,
    form="scragging",
    title="stiffness of the isolation layer that is lost with the largest drift",
    source="Mullins (1969), Rubber Chem. Technol. 42, 339-362; EN 15129, 8.2 (scragging)",
    mechanisms=_links(lambda p: Link.breaking(0, p["k"], p["d"])),
    parameters=lambda s: (
        size("k", "N/m", 0.5 * _stiffness(s), 0.0, 10.0 * _stiffness(s)),
        _of_drift("d", s, 0.5, 0.02, 20.0),
    ),
    starts=lambda s: tuple((0.2 * _stiffness(s), part * float(s.drift[0])) for part in (0.3, 1.0)),
)
_POWER = replace(
    _BOUC_WEN,
    name="isolation_hardening",
    form="power",
    title="stiffness of the isolation layer that grows as a power of the drift",
    signature="peaks of acceleration at the largest drifts are too low, and come too late",
    source="Kelly (1997), Earthquake-Resistant Design with Rubber, 5.4; Yamamoto et al. (2009)",
    mechanisms=_links(_hardens),
    parameters=lambda s: (
        size("k", "N/m", 0.3 * _stiffness(s), -_stiffness(s), 3.0 * _stiffness(s)),
        shape("p", "", 3.0, 1.5, 9.0, spread=0.7),
    ),
    starts=lambda s: tuple((0.05 * _stiffness(s), p) for p in (3.0, 6.0)),
    constants=lambda s: {"r": float(s.drift[0])},
    meanings={
        "k": "of the added spring: force over drift at the largest one; of `threshold` beyond u0",
        "p": "power of the drift with which its force grows",
        "u0": "drift at which the stop is met",
    },
    negative=Words(
        "stiffness of the isolation layer that falls as a power of the drift",
        "peaks of acceleration at the largest drifts are too high, and come too early",
    ),
)
_THRESHOLD = replace(
    _POWER,
    form="threshold",
    title="a stop in the isolation layer",
    mechanisms=_links(lambda p: Link.alone(0, p["k"], "hardening.threshold", p["k"], p["u0"])),
    parameters=lambda s: (
        size("k", "N/m", _stiffness(s), 0.0, 100.0 * _stiffness(s)),
        _of_drift("u0", s, 0.6, 0.1, 1.5),
    ),
    starts=lambda s: tuple((0.1 * _stiffness(s), part * float(s.drift[0])) for part in (0.5, 0.8)),
    constants=lambda _: {},
    negative=None,
)

FORMS = (_BOUC_WEN, _FRICTION, _ENVELOPE, _SCRAGGING, _POWER, _THRESHOLD)
