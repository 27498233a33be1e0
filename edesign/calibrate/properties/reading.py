"""How properties were read from the loops: faults that no loop has, only the table."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.trial import Sizes, Values
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown


class Reading(Form):
    """A form that changes what is read from the loops."""

    kind: ClassVar[Kind] = "instrument"
    source: ClassVar[str] = "thesis Eqs. 3.1-3.4 and section 3.3"

    def read(self, p: Values, amplitudes: np.ndarray) -> np.ndarray:
        """Force amplitudes (3, rows) N as they were read - in phase, largest, of the energy - of the true ones."""
        raise NotImplementedError


class Peak(Reading):
    """The largest stress is too large by a share: read in other cycles than the storage modulus, or overshot."""

    name: ClassVar[str] = "peak_reading"
    form: ClassVar[str] = "share"
    title: ClassVar[str] = "the largest stress read too large by a share, as in cycles before the material has softened"
    signature: ClassVar[str] = (
        "G_eq off by one factor beside G' and loss factor, whatever strain, frequency and temperature"
    )

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (Unknown("share", "", -0.5, 1.0, 0.1),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.05,),)

    def read(self, p: Values, amplitudes: np.ndarray) -> np.ndarray:
        return np.asarray(amplitudes * np.array([1.0, 1.0 + p["share"], 1.0])[:, None])


class Spikes(Reading):
    """The largest stress is too large by a force: the largest of noisy samples."""

    name: ClassVar[str] = "peak_reading"
    form: ClassVar[str] = "force"
    title: ClassVar[str] = "the largest stress read from noisy samples"
    signature: ClassVar[str] = "G_eq too large by one force at all amplitudes, most in small tests"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (Unknown("force", "N", 0.0, 0.5 * sizes.force, 0.02 * sizes.force),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.02 * sizes.force,),)

    def read(self, p: Values, amplitudes: np.ndarray) -> np.ndarray:
        return np.asarray(amplitudes + np.array([0.0, p["force"], 0.0])[:, None])


class Storage(Reading):
    """The stress at the largest strain is read too small by a share: beside the extreme, where it falls steeply."""

    name: ClassVar[str] = "storage_reading"
    form: ClassVar[str] = "share"
    title: ClassVar[str] = "the stress at the largest strain read too small by a share"
    signature: ClassVar[str] = "G' too small and the loss factor too large by one factor, G_eq right"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (Unknown("share", "", -1.0, 0.5, 0.1),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.05,),)

    def read(self, p: Values, amplitudes: np.ndarray) -> np.ndarray:
        return np.asarray(amplitudes * np.array([1.0 - p["share"], 1.0, 1.0])[:, None])


FORMS = (Peak, Spikes, Storage)
