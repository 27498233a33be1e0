"""The specimen was mounted crooked: a pre-shear or a dead load that stays."""

from __future__ import annotations

from dataclasses import replace
from typing import ClassVar

import numpy as np

from edesign.calibrate.dampers.effect import Form, Memory
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial, Values
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown


class _StaticOffset(Form):
    name: ClassVar[str] = "static_offset"
    kind: ClassVar[Kind] = "rig"


class PreShear(_StaticOffset):
    """The specimen is sheared by more than was measured: u + offset, long enough before the test to have relaxed."""

    form: ClassVar[str] = "pre_shear"
    title: ClassVar[str] = "shear of the specimen before its displacement was set to zero"
    signature: ClassVar[str] = (
        "a constant force of the elastic part alone, larger where the specimen is stiffer; bent loops if not linear"
    )
    source: ClassVar[str] = "relaxation to the long-term modulus: Ferry, Viscoelastic Properties of Polymers, chapter 1"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        u = sizes.displacement
        return (Unknown("offset", "m", -u, u, 0.1 * u),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.05 * sizes.displacement,),)

    def specimen(self, p: Values, trial: Trial, motion: Motion) -> Motion:
        return replace(motion, displacement=motion.displacement + p["offset"])


class Tared(PreShear):
    """A pre-shear at which the load cell was set to zero: F_law(u + offset) less its force at the beginning."""

    form: ClassVar[str] = "pre_shear_tared"
    title: ClassVar[str] = "shear of the specimen before displacement and force were set to zero"
    signature: ClassVar[str] = "no force at rest, and loops that are not alike on both sides: even harmonics"

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.15 * sizes.displacement,),)

    def channel(self, p: Values, trial: Trial, force: np.ndarray) -> np.ndarray:
        return np.asarray(force - force[0])

    def finer(self) -> tuple[Form, ...]:
        """With a zero of each test's own."""
        return (TaredByHand(),)


class TaredByHand(Tared):
    """As `pre_shear_tared`, but each test's zero is its own: it was set on another reading than the first sample."""

    form: ClassVar[str] = "pre_shear_tared_by_hand"
    title: ClassVar[str] = (
        "shear of the specimen before displacement and force were set to zero, the force in each test"
    )
    has_columns: bool = True

    def finer(self) -> tuple[Form, ...]:
        return ()

    def columns(self, p: Values, trial: Trial) -> np.ndarray:
        return np.ones((trial.force.size, 1))


class ConstantForce(_StaticOffset):
    """A dead load beside the specimen: F + P."""

    form: ClassVar[str] = "constant_force"
    title: ClassVar[str] = "dead load along the axis of the actuator"
    signature: ClassVar[str] = "a constant force, the same in all tests"
    source: ClassVar[str] = "equilibrium"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (Unknown("P", "N", -sizes.force, sizes.force, 0.1 * sizes.force),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.05 * sizes.force,),)

    def parallel(self, p: Values, trial: Trial, motion: Motion, memory: Memory) -> float:
        return p["P"]


class AxialLoad(_StaticOffset):
    """An axial load P below the buckling load P_E: springs times 1 - q, dashpots times 1 + q, q = (P/P_E)^2."""

    spares_loss: bool = True
    form: ClassVar[str] = "axial_load"
    title: ClassVar[str] = "axial load on the specimen, which softens its springs and thickens its losses"
    signature: ClassVar[str] = "less stiffness and more damping by the same share, in all tests alike"
    source: ClassVar[str] = "Koh & Kelly (1988), Int. J. Mech. Sci. 30, 933-943"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (Unknown("q", "", 0.0, 0.9, 0.1),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.05,),)

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> float:
        return 1.0 - p["q"]

    def dashpot_factor(self, p: Values, motion: Motion, factor: np.ndarray | float) -> float:
        return 1.0 + p["q"]


class PDelta(_StaticOffset):
    """An axial load P on a specimen of height h, tilted by its shear: F_law(u) - (P/h) u."""

    elastic: ClassVar[bool] = True
    form: ClassVar[str] = "p_delta"
    title: ClassVar[str] = "axial load on the specimen, which pushes it over"
    signature: ClassVar[str] = "a spring of negative stiffness, neither relaxing nor softening"
    source: ClassVar[str] = ConstantForce.source

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (Unknown("P_over_h", "N/m", -sizes.stiffness, sizes.stiffness, 0.1 * sizes.stiffness),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.05 * sizes.stiffness,),)

    def parallel(self, p: Values, trial: Trial, motion: Motion, memory: Memory) -> np.ndarray:
        return -p["P_over_h"] * motion.displacement


FORMS = (PreShear, Tared, ConstantForce, AxialLoad, PDelta)
