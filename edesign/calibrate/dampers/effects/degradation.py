"""Degradation: work or path wears the damper for good, over the whole campaign."""

from __future__ import annotations

from collections.abc import Callable
from typing import ClassVar

import numpy as np

from edesign.calibrate.dampers.counted_work import how_counted, sized
from edesign.calibrate.dampers.drivers import weighted_path, worked
from edesign.calibrate.dampers.effect import Form, Memory
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial, Values
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown

_MOST = 10.0  # times the work of the campaign: a search may ask for stiffening that feeds itself


class _Degradation(Form):
    name: ClassVar[str] = "degradation"
    kind: ClassVar[Kind] = "damper"
    remembers: ClassVar[bool] = True


class _ByWork(_Degradation):
    counts_work: ClassVar[bool] = True
    may_spare_loss: ClassVar[bool] = True
    sized = False

    def _worked(
        self, p: Values, motion: Motion, force: np.ndarray, left: Callable[[np.ndarray], np.ndarray], memory: Memory
    ) -> np.ndarray:
        """Factor (n,) of the force (n,) N that is left by the work done in its life."""
        counted = how_counted(self, p, motion, force, memory)
        factor, memory["energy"] = worked(motion, factor=left, before=memory.get("energy", 0.0), **counted)
        return factor

    def finer(self) -> tuple[Form, ...]:
        """With a share of the work that springs give back counted as if it were done."""
        return () if self.sized else (sized(self),)


class Energy(_ByWork):
    """The force falls with the work done in its life: F = (1 - d (1 - exp(-max(E, 0)/E0))) F_law."""

    form: ClassVar[str] = "energy"
    title: ClassVar[str] = "lasting degradation by dissipated energy"
    signature: ClassVar[str] = (
        "the force falls within heavy tests and stays so in all later ones: a test repeated at the end is softer"
    )
    source: ClassVar[str] = (
        "Baber & Wen (1981), J. Eng. Mech. Div. ASCE 107, 1069-1087 (energy); Simo (1987) (exponential saturation)"
    )
    amendment: ClassVar[bool] = True

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        w = sizes.work
        return Unknown("d", "", -0.95, 0.95, 0.5), Unknown("E0", "J", 1e-3 * w, 1e2 * w, 0.3 * w, logarithmic=True)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((0.1, share * sizes.work) for share in (0.02, 0.1, 0.5)) + ((0.3, 3.0 * sizes.work),)

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        d, scale = p["d"], -1.0 / p["E0"]

        def left(energy: np.ndarray) -> np.ndarray:
            return np.asarray(1.0 + d * np.expm1(scale * np.maximum(energy, 0.0)))

        return self._worked(p, motion, force, left, memory)


class Work(_ByWork):
    """The force falls with a power of the work done in its life: F = (1 - d x^p) F_law, x = E/W from 0 to 10."""

    form: ClassVar[str] = "work"
    title: ClassVar[str] = "lasting degradation by dissipated energy, without end"
    signature: ClassVar[str] = Energy.signature
    source: ClassVar[str] = (
        "hysteresis energy as damage: Feltner & Morrow (1961), J. Basic Engng 83, 15-22; power of the damage sum: "
        "Marco & Starkey (1954), Trans. ASME 76, 627-632"
    )

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return Unknown("d", "", -0.95, 0.95, 0.5), Unknown("p", "", 0.1, 6.0, 1.0, logarithmic=True)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return (0.1, 0.3), (0.1, 1.0), (0.1, 2.5)

    def fixed(self, sizes: Sizes) -> dict[str, float]:
        return {"W": sizes.work}

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        def left(energy: np.ndarray) -> np.ndarray:
            return np.asarray(1.0 - p["d"] * np.clip(energy / p["W"], 0.0, _MOST) ** p["p"])

        return self._worked(p, motion, force, left, memory)


class Path(_Degradation):
    """The force falls with a power of the path travelled in its life, without end: F = (1 - d (s/S)^p) F_law."""

    form: ClassVar[str] = "path"
    may_spare_loss: ClassVar[bool] = True
    title: ClassVar[str] = "lasting degradation by the path travelled"
    signature: ClassVar[str] = (
        "the force falls from test to test with the path travelled, small amplitudes counting as much as large ones"
    )
    source: ClassVar[str] = (
        "wear by travelled path: Archard (1953), J. Appl. Phys. 24, 981-988; power of the damage sum: Marco & Starkey "
        "(1954), Trans. ASME 76, 627-632"
    )
    amendment: ClassVar[bool] = True

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return Unknown("d", "", -0.95, 0.95, 0.5), Unknown("p", "", 0.1, 6.0, 1.0, logarithmic=True)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return (0.1, 0.3), (0.1, 1.0), (0.1, 2.5)

    def fixed(self, sizes: Sizes) -> dict[str, float]:
        return {"S": sizes.path}

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        travelled = memory.get("path", 0.0) + motion.path
        memory["path"] = float(travelled[-1])
        return np.asarray(1.0 - p["d"] * (travelled / p["S"]) ** p["p"])


class Fatigue(_Degradation):
    """Path counts by a power of the deformation, large cycles more: F = (1 - d D^p) F_law, D' = |v| |u/U|^q / S."""

    form: ClassVar[str] = "fatigue"
    may_spare_loss: ClassVar[bool] = True
    title: ClassVar[str] = "lasting degradation by cycles, large ones counting more"
    signature: ClassVar[str] = "the force falls within tests of large amplitude and stays so; small cycles do nothing"
    source: ClassVar[str] = (
        "Miner (1945), J. Appl. Mech. 12, A159-A164, with the power law of life: Basquin (1910); power of the damage "
        "sum: Marco & Starkey (1954), Trans. ASME 76, 627-632"
    )

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (
            Unknown("d", "", -50.0, 50.0, 0.5),  # small cycles leave D, on the scale of the path, far below 1
            Unknown("q", "", 0.0, 8.0, 2.0),
            Unknown("p", "", 0.1, 4.0, 1.0, logarithmic=True),
        )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return (0.2, 1.0, 1.0), (1.0, 3.0, 1.0), (0.3, 3.0, 0.4)

    def fixed(self, sizes: Sizes) -> dict[str, float]:
        return {"S": sizes.path, "U": sizes.displacement}

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        ways = weighted_path(motion, np.abs(motion.displacement / p["U"]) ** p["q"])
        damage = memory.get("damage", 0.0) + ways / p["S"]
        memory["damage"] = float(damage[-1])
        return np.asarray(1.0 - p["d"] * damage ** p["p"])


FORMS = (Energy, Work, Path, Fatigue)
