"""How large things are in records of a structure: priors and starts of effects are set by it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from edesign.calibration.structures.building import Building
from edesign.calibration.structures.campaign import Isolation
from edesign.calibration.structures.isolation import linear
from edesign.calibration.structures.record import Measure, StructureTest
from edesign.calibration.structures.response import respond


@dataclass(frozen=True)
class StructureSizes:
    """Typical sizes of a structure and its tests; SI.

    Attributes:
        building: as declared, with a linear isolation layer.
        drift: (n,) largest drift of each storey: measured where displacements are, else of the declared building.
        period: of its first mode, s.
        step: of sampling, s.
        measures: of the channels.
        refit: whether level of damping and stiffness of the storeys are parameters anyhow.
    """

    building: Building
    drift: np.ndarray
    period: float
    step: float
    measures: frozenset[Measure]
    refit: bool

    @staticmethod
    def of(
        declared: Building, isolation: Isolation | None, tests: Sequence[StructureTest], refit: bool
    ) -> StructureSizes:
        """Return the sizes of a structure in tests.

        Args:
            declared: without its isolation layer.
            isolation: law of that layer; None: fixed base.
            tests: that are fitted.
            refit: whether stiffness and damping of the storeys are parameters.
        """
        building = declared if isolation is None else linear(declared, isolation.law, isolation.values, tests)
        measures = frozenset(channel.measure for test in tests for channel in test.channels)
        drift = np.max([_drifts(building, test) for test in tests], axis=0)
        return StructureSizes(building, drift, 1.0 / building.system().first_frequency, tests[0].step, measures, refit)

    @property
    def shear(self) -> float:
        """Largest force of storey 0, N."""
        return float(self.building.stiffness[0] * self.drift[0])

    @property
    def storey_shear(self) -> float:
        """Largest force of the lowest storey that is no isolation layer, N."""
        first = self.building.storeys[0]
        return float(self.building.stiffness[first] * self.drift[first])

    @property
    def storey_drift(self) -> float:
        """Largest drift of a storey that is no isolation layer, m."""
        return float(np.max(self.drift[list(self.building.storeys)]))


def is_isolated(s: StructureSizes) -> bool:
    """Return whether a structure has an isolation layer."""
    return s.building.isolated


def has_storeys(s: StructureSizes) -> bool:
    """Return whether a structure has storeys that are no isolation layer."""
    return len(s.building.storeys) > 0


def _drifts(building: Building, test: StructureTest) -> np.ndarray:
    """Largest deformation (n,) of each storey: measured where both floors are, else of the linear building, m."""
    (response,) = respond(building.system(), [(test.base, test.step)])
    found = np.max(np.abs(np.diff(response.displacement, axis=1, prepend=0.0)), axis=0)
    for i in range(building.floors):
        above = test.column("displacement", i)
        below = test.column("displacement", i - 1) if i else np.zeros(test.base.size)
        if above is not None and below is not None:
            found[i] = float(np.max(np.abs(above - below)))
    return np.asarray(np.maximum(found, 1e-12))
