"""Specimen, rig and structure of archived tests linearised as `edesign rts check` does it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from edesign.errors import EdesignError
from edesign.report.substructure.file import ArchivedTests
from edesign.substructure.advice.expectation import Linearisation, LinearModel
from edesign.substructure.stability.loop import Transfer, phase_delay


@dataclass(frozen=True)
class LinearisedTests:
    """The linearised tests that `edesign rts check` analyses.

    Attributes:
        model: rig, linearised damper and structure.
        motion: (n,) deformation of the specimen that they are linearised for, m, at main steps.
        frequencies: of the structure with the specimen, Hz, from the lowest.
    """

    model: LinearModel
    motion: np.ndarray
    frequencies: tuple[float, ...]

    @property
    def specimen(self) -> Linearisation:
        """The linearised specimen at the effective amplitude."""
        return self.model.linearisation

    @property
    def rig(self) -> Transfer:
        """Transfer function from the command to the displacement of the specimen, which loads the rig."""
        return self.model.rig

    @property
    def rig_delay(self) -> float:
        """Delay of the rig at the first frequency, s."""
        return phase_delay(self.rig, self.frequencies[0])


def linearised(described: ArchivedTests, motion: np.ndarray) -> LinearisedTests | None:
    """Return the tests linearised; None: there is no structure or specimen, or they cannot be.

    Args:
        described: the file and its laboratory.
        motion: (n,) deformation of the specimen, m, at main steps.
    """
    tests = described.tests
    if tests is None or tests.laboratory.structure is None or tests.laboratory.damper is None:
        return None
    try:
        model = LinearModel.of(tests, motion, tests.laboratory.structure.part)
        modes = model.whole.modes
    except EdesignError:
        return None
    found = tuple(float(mode.omega) / (2.0 * np.pi) for mode in modes if mode.omega > 0.0)
    return LinearisedTests(model, motion, found) if found else None
