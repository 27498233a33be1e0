"""Specimen, rig and structure of archived tests linearised as `edesign rts check` does it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from edesign.damper.harmonic import complex_stiffness
from edesign.errors import EdesignError
from edesign.report.substructure.file import ArchivedTests
from edesign.substructure.advice.expectation import (
    EFFECTIVE_AMPLITUDE,
    FREQUENCIES,
    LOWEST,
    Linearisation,
    first_moving,
    law_at,
)
from edesign.substructure.advice.transfers import phase_delay, rig_response
from edesign.substructure.stability.loop import Loop, Transfer
from edesign.substructure.stability.roots import structure_modes


@dataclass(frozen=True)
class LinearisedTests:
    """The tests as `edesign rts check` takes them.

    Attributes:
        specimen: at the effective amplitude.
        frequencies: of the structure with the specimen, Hz, from the lowest.
        rig: displacement of the specimen over command, the specimen loading the rig.
    """

    specimen: Linearisation
    frequencies: tuple[float, ...]
    rig: Transfer

    @property
    def rig_delay(self) -> float:
        """At the first frequency, s."""
        return phase_delay(self.rig, self.frequencies[0])


def linearised(described: ArchivedTests, largest: float) -> LinearisedTests | None:
    """Return the tests linearised; None: there is no structure or specimen, or they cannot be.

    Args:
        described: the file and its laboratory.
        largest: deformation of the specimen, m.
    """
    file, lab, plant = described.file, described.laboratory, described.plant
    if file is None or plant is None or lab is None or lab.structure is None or lab.damper is None:
        return None
    part, damper, step = lab.structure.part, lab.damper, file.loop.main_step
    amplitude, bare = EFFECTIVE_AMPLITUDE * largest, float(part.frequencies()[0])
    try:
        specimen = law_at(damper, amplitude, np.geomspace(LOWEST * bare, 0.5 / step, FREQUENCIES))
        frequency = first_moving(part, specimen)
        force, deformation = damper.scales
        exact = force * deformation * complex_stiffness(damper.values, amplitude * deformation, frequency)
        modes = structure_modes(Loop(part.mass, part.damping, part.stiffness, part.interface, specimen))
    except EdesignError:
        return None
    found = tuple(float(mode.omega) / (2.0 * np.pi) for mode in modes if mode.omega > 0.0)
    if not found:
        return None
    at = Linearisation(largest, amplitude, frequency, exact)
    return LinearisedTests(at, found, rig_response(plant, lab.transfer, specimen, step))
