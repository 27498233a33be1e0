"""Mullins softening: the virgin specimen is stiffer, and its first cycles take that away for long."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from scipy.special import erf

from edesign.calibrate.dampers.drivers import cycles, equivalent_cycles, largest, weighted_path
from edesign.calibrate.dampers.effect import BEGUN, Form, Memory
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial, Values
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown
from edesign.core.fading import fading

_LEAST_CYCLE = 0.05  # range of a half cycle, of the largest displacement


class _Mullins(Form):
    name: ClassVar[str] = "mullins"
    may_be_inside: ClassVar[bool] = True
    kind: ClassVar[Kind] = "damper"
    amendment: ClassVar[bool] = True
    remembers: ClassVar[bool] = True

    def fixed(self, sizes: Sizes) -> dict[str, float]:
        return {} if sizes.tests > 1 else {"recovery": 0.0}  # a single test cannot show what comes back between tests

    def _recovery(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (Unknown("recovery", "", 0.0, 1.0, 1.0),) if sizes.tests > 1 else ()

    def _each_recovery(self, rows: tuple[tuple[float, ...], ...], sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((*row, share) for share in (0.0, 1.0) for row in rows) if sizes.tests > 1 else rows


class _ByPath(_Mullins):
    _scale: ClassVar[str] = "s0"
    signature: ClassVar[str] = (
        "too little force in the first cycles of the specimen's life (or of every test), at all amplitudes, fading "
        "with the path travelled"
    )
    source: ClassVar[str] = (
        "Mullins (1969), Rubber Chem. Technol. 42, 339-362; Kelly & Konstantinidis (2011), Mechanics of Rubber "
        "Bearings, section 2.4 (scragging)"
    )

    def _unknowns(self, amplitude: Unknown, sizes: Sizes) -> tuple[Unknown, ...]:
        s0 = Unknown("s0", "m", 0.1 * sizes.displacement, 10.0 * sizes.path, sizes.path / sizes.tests, logarithmic=True)
        return (amplitude, s0, *self._recovery(sizes))

    def _starts(self, amplitude: float, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        own = sizes.path / sizes.tests
        rows = tuple((amplitude, s0) for s0 in (0.1 * own, 0.4 * own, 1.5 * own))
        beyond = ((amplitude, 0.4 * sizes.path, 0.0),) if sizes.tests > 3 else ()
        return (*self._each_recovery(rows, sizes), *beyond)

    def _virgin(self, p: Values, motion: Motion, memory: Memory) -> np.ndarray:
        """exp(-s / s0) (n,) of what wears it: what is left of the virgin specimen."""
        worn = memory.get("left")
        left = 1.0 if worn is None else self._rested(worn, p["recovery"])
        found = left * np.exp(-self._worn(p, motion) / p[self._scale])
        memory["left"] = float(found[-1])
        return np.asarray(found)

    def _worn(self, p: Values, motion: Motion) -> np.ndarray:
        """What has worn the virgin specimen (n,) in the test, in the unit of its scale: path, m."""
        return motion.path

    def _rested(self, left: float, recovery: float) -> float:
        """What is left of the virgin specimen when the next test begins."""
        return left + recovery * (1.0 - left)


class Path(_ByPath):
    """The whole force softens with the path travelled: F = (1 + m exp(-s/s0)) F_law."""

    may_spare_loss: ClassVar[bool] = True
    form: ClassVar[str] = "path"
    title: ClassVar[str] = "softening of the virgin specimen with the path travelled"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return self._unknowns(Unknown("m", "", -0.9, 3.0, 0.5), sizes)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return self._starts(0.15, sizes)

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        return np.asarray(1.0 + p["m"] * self._virgin(p, motion, memory))


class _Forgets:
    """Rest forgets a share of what has worn the specimen, not of what is worn off."""

    def _rested(self, left: float, recovery: float) -> float:
        return float(left ** (1.0 - recovery))


class ForgottenPath(_Forgets, Path):
    """As `path`, a share of the path being forgotten between tests: the next one begins at (1 - recovery) s."""

    amendment: ClassVar[bool] = False
    form: ClassVar[str] = "forgotten_path"
    title: ClassVar[str] = "softening of the virgin specimen with the path travelled, of which rest forgets a share"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return super().unknowns(sizes) if sizes.tests > 1 else ()  # one test: it is `path`

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        own = sizes.path / sizes.tests
        rows = tuple((0.15, s0, share) for share in (0.4, 0.8) for s0 in (0.1 * own, 0.4 * own, 1.5 * own))
        return rows if sizes.tests > 1 else ()


class Begun(_ByPath):
    """As `path`, each test begun as virgin as it shows, as pauses between tests are not recorded: F = (1 + x_i
    exp(-s/s0)) F_law.
    """

    begins: bool = True
    may_be_inside: ClassVar[bool] = False
    amendment: ClassVar[bool] = False
    remembers: ClassVar[bool] = False
    may_be_shaped: bool = False
    form: ClassVar[str] = "begun"
    title: ClassVar[str] = "softening with the path travelled, each test begun as virgin as it shows"

    def fixed(self, sizes: Sizes) -> dict[str, float]:
        return {}

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        own = sizes.path / sizes.tests
        # over a longer path it would be a gain of each test
        return (Unknown("s0", "m", 0.1 * sizes.displacement, 0.5 * own, 0.1 * own, logarithmic=True),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        own = sizes.path / sizes.tests
        return (0.02 * own,), (0.1 * own,), (0.3 * own,)

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        return np.asarray(1.0 + memory.get(BEGUN, 0.0) * np.exp(-motion.path / p["s0"]))


class Work(Path):
    """As `path`, a way counting by the deformation at which it is made: s' = |v| |u|/U, the work of a spring."""

    form: ClassVar[str] = "work"
    title: ClassVar[str] = "softening of the virgin specimen with the elastic work done on it"
    amendment: ClassVar[bool] = False
    signature: ClassVar[str] = (
        "too little force in the first large cycles of the specimen's life (or of every test), fading with their work"
    )
    source: ClassVar[str] = (
        "Mullins (1969), Rubber Chem. Technol. 42, 339-362; damage by the energy done: Miehe (1995), Eur. J. Mech. A "
        "14, 697-720 (continuous damage)"
    )

    def fixed(self, sizes: Sizes) -> dict[str, float]:
        return {**super().fixed(sizes), "U": sizes.displacement}

    def _worn(self, p: Values, motion: Motion) -> np.ndarray:
        return weighted_path(motion, np.abs(motion.displacement) / p["U"])


class Elastic(_ByPath):
    """A spring wears off with the path travelled: F = F_law + k exp(-s/s0) u."""

    form: ClassVar[str] = "elastic"
    title: ClassVar[str] = "softening of the virgin specimen's elastic force with the path travelled"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return self._unknowns(
            Unknown("k", "N/m", -2.0 * sizes.stiffness, 5.0 * sizes.stiffness, sizes.stiffness), sizes
        )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return self._starts(0.15 * sizes.stiffness, sizes)

    def parallel(self, p: Values, trial: Trial, motion: Motion, memory: Memory) -> np.ndarray:
        return np.asarray(p["k"] * self._virgin(p, motion, memory) * motion.displacement)


class Cycles(Path):
    """The whole force softens with the number of cycles, of whatever amplitude: F = (1 + m exp(-N/N0)) F_law."""

    _scale: ClassVar[str] = "N0"
    amendment: ClassVar[bool] = False
    form: ClassVar[str] = "cycles"
    title: ClassVar[str] = "softening of the virgin specimen with the number of cycles"
    signature: ClassVar[str] = (
        "too little force in the first cycles of the specimen's life (or of every test), small ones counting as much "
        "as large ones"
    )
    source: ClassVar[str] = (
        "Mullins (1969), Rubber Chem. Technol. 42, 339-362; ISO 22762-1:2018, 6.2.2 (properties of the third cycle)"
    )

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (
            Unknown("m", "", -0.9, 3.0, 0.5),
            Unknown("N0", "", 0.1, 1e3, 3.0, logarithmic=True),
            *self._recovery(sizes),
        )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        beyond = ((0.15, 50.0, 0.0),) if sizes.tests > 3 else ()
        return (*self._each_recovery(((0.15, 1.0), (0.15, 4.0), (0.15, 15.0)), sizes), *beyond)

    def fixed(self, sizes: Sizes) -> dict[str, float]:
        return {**super().fixed(sizes), "least": _LEAST_CYCLE * sizes.displacement}

    def _worn(self, p: Values, motion: Motion) -> np.ndarray:
        return cycles(motion, p["least"])


class Forgotten(_Forgets, Cycles):
    """As `cycles`, a share of the cycles being forgotten between tests: the next one begins at (1 - recovery) N."""

    form: ClassVar[str] = "forgotten_cycles"
    title: ClassVar[str] = "softening of the virgin specimen with the number of cycles, of which rest forgets a share"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return super().unknowns(sizes) if sizes.tests > 1 else ()  # one test: it is `cycles`

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        rows = ((0.15, 1.0), (0.15, 4.0), (0.15, 15.0))
        return tuple((*row, share) for share in (0.4, 0.8) for row in rows) if sizes.tests > 1 else ()


class Equivalent(Forgotten):
    """As `forgotten_cycles`, with a cycle for each path of four times the largest deformation of the test so far."""

    form: ClassVar[str] = "equivalent_cycles"
    title: ClassVar[str] = "softening of the virgin specimen with the number of equivalent cycles"
    source: ClassVar[str] = (
        "Mullins (1969), Rubber Chem. Technol. 42, 339-362; path over four amplitudes as a count of cycles: "
        "phenomenological"
    )

    def _worn(self, p: Values, motion: Motion) -> np.ndarray:
        return equivalent_cycles(motion, p["least"])


class _ByMaximum(_Mullins):
    def _largest(self, p: Values, motion: Motion, memory: Memory) -> np.ndarray:
        found = largest(motion, (1.0 - p["recovery"]) * memory.get("largest", 0.0))
        memory["largest"] = float(found[-1])
        return found


class _Below(_ByMaximum):
    """Soft below the largest so far, by a curve from 0 there to 1 far below."""

    curve = staticmethod(erf)

    def finer(self) -> tuple[Form, ...]:
        """With a curve that goes on longer.

        Source: Dorfmann & Ogden (2004), Int. J. Solids Struct. 41, 1855-1878 (tanh in the place of erf).
        """
        return () if self.curve is np.tanh else (self.variant("tanh", "by a hyperbolic tangent", curve=np.tanh),)


class Maximum(_Below):
    """Soft below the largest deformation ever, whole again at it: F = (1 - m erf((M - |u|)/r)) F_law."""

    may_spare_loss: ClassVar[bool] = True
    form: ClassVar[str] = "maximum"
    title: ClassVar[str] = "softening below the largest deformation so far"
    signature: ClassVar[str] = (
        "too much force in cycles smaller than one before, right again where the deformation reaches its largest so far"
    )
    source: ClassVar[str] = "Ogden & Roxburgh (1999), Proc. R. Soc. Lond. A 455, 2861-2877"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        u = sizes.displacement
        m, r = Unknown("m", "", -0.9, 0.95, 0.5), Unknown("r", "m", 0.02 * u, 20.0 * u, 0.3 * u, logarithmic=True)
        return (m, r, *self._recovery(sizes))

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return self._each_recovery(tuple((0.15, r * sizes.displacement) for r in (0.1, 0.4, 1.5)), sizes)

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        below = self._largest(p, motion, memory) - np.abs(motion.displacement)
        return np.asarray(1.0 - p["m"] * self.curve(below / p["r"]))


class PseudoElastic(_Below):
    """Soft below the largest elastic energy ever: F = (1 - m erf((M^2 - u^2)/(e^2 + b M^2))) F_law."""

    may_spare_loss: ClassVar[bool] = True
    amendment: ClassVar[bool] = False
    form: ClassVar[str] = "pseudo_elastic"
    title: ClassVar[str] = "softening below the largest elastic energy so far"
    signature: ClassVar[str] = Maximum.signature
    source: ClassVar[str] = (
        "Ogden & Roxburgh (1999), Proc. R. Soc. Lond. A 455, 2861-2877, energies as squares of the deformation; b: "
        "Bose, Hurtado, Snyman, Mars & Chen (2003), Constitutive Models for Rubber III, 231-238"
    )

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        u = sizes.displacement
        return (
            Unknown("m", "", -0.9, 0.95, 0.5),
            Unknown("e", "m", 0.02 * u, 20.0 * u, 0.3 * u, logarithmic=True),
            Unknown("b", "", 0.0, 10.0, 1.0),
            *self._recovery(sizes),
        )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        u = sizes.displacement
        return self._each_recovery(((0.15, 0.1 * u, 0.2), (0.15, 0.4 * u, 0.2), (0.15, u, 0.2)), sizes)

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        most = self._largest(p, motion, memory) ** 2
        return np.asarray(1.0 - p["m"] * self.curve((most - motion.displacement**2) / (p["e"] ** 2 + p["b"] * most)))


class Damage(_ByMaximum):
    """Damage by the largest deformation ever, the same at all deformations: F = (1 - m (1 - exp(-(M/r)^p))) F_law."""

    may_spare_loss: ClassVar[bool] = True
    form: ClassVar[str] = "damage"
    title: ClassVar[str] = "lasting softening by the largest deformation so far"
    signature: ClassVar[str] = (
        "the stiffness falls where the deformation goes beyond its largest so far, and stays lower in smaller cycles "
        "after it"
    )
    source: ClassVar[str] = (
        "Simo (1987), Comput. Methods Appl. Mech. Engrg 60, 153-173; Miehe (1995), Eur. J. Mech. A 14, 697-720"
    )

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        u = sizes.displacement
        return (
            Unknown("m", "", -0.9, 0.95, 0.5),
            Unknown("r", "m", 0.02 * u, 20.0 * u, 0.5 * u, logarithmic=True),
            Unknown("p", "", 0.3, 6.0, 1.0, logarithmic=True),
            *self._recovery(sizes),
        )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        u = sizes.displacement
        return self._each_recovery(((0.1, 0.15 * u, 1.0), (0.1, 0.5 * u, 1.0), (0.15, u, 2.0)), sizes)

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        ratio = self._largest(p, motion, memory) / p["r"]
        return np.asarray(1.0 + p["m"] * np.expm1(-(ratio ** p["p"])))


class Scragging(_ByMaximum):
    """Damage that goes with the path towards what the largest deformation ever allows: F = (1 - D) F_law,
    D' = (m (1 - exp(-M/r)) - D) |v|/s0 while that is above D; rest heals the share `recovery` of D and M.
    """

    may_be_inside: ClassVar[bool] = False
    may_spare_loss: ClassVar[bool] = True
    amendment: ClassVar[bool] = False
    form: ClassVar[str] = "scragging"
    title: ClassVar[str] = "softening in the first cycles at each new largest deformation"
    signature: ClassVar[str] = (
        "too little force in the first cycles at every deformation larger than all before, not in later ones"
    )
    source: ClassVar[str] = (
        "Kelly & Konstantinidis (2011), Mechanics of Rubber Bearings, section 2.4 (scragging); damage by the largest "
        "deformation: Simo (1987), Comput. Methods Appl. Mech. Engrg 60, 153-173"
    )

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        u, path = sizes.displacement, sizes.path
        return (
            Unknown("m", "", -0.9, 0.95, 0.5),
            Unknown("r", "m", 0.02 * u, 20.0 * u, 0.5 * u, logarithmic=True),
            Unknown("s0", "m", 0.1 * u, 10.0 * path, path / sizes.tests, logarithmic=True),
            *self._recovery(sizes),
        )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        u, own = sizes.displacement, sizes.path / sizes.tests
        rows = tuple((0.15, r * u, s * own) for r in (0.3, 1.0) for s in (0.1, 0.4, 1.5))
        return tuple((*row, 0.4) for row in rows) if sizes.tests > 1 else rows

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        before = (1.0 - p["recovery"]) * memory.get("damage", 0.0)  # of m
        allowed = np.maximum(-np.expm1(-self._largest(p, motion, memory) / p["r"]), before)
        stays = np.exp(-np.abs(motion.ways) / p["s0"])
        damage = fading(stays, (1.0 - stays) * allowed[1:], before)
        memory["damage"] = float(damage[-1])
        return np.asarray(1.0 - p["m"] * damage)


_BY_MAXIMUM = (Maximum, PseudoElastic, Damage, Scragging)
FORMS = (Path, ForgottenPath, Begun, Work, Elastic, Cycles, Forgotten, Equivalent, *_BY_MAXIMUM)
