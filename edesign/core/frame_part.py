"""A frame that may yield as the numerical part of a substructure test."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from edesign.core._edcore import ffi
from edesign.core.analysis import AVERAGE_ACCELERATION, Analysis
from edesign.core.integrators import Integrator
from edesign.core.response import Channel


@dataclass(frozen=True, eq=False)
class FrameNumericalPart:
    """A frame whose time history is advanced by one main step at a time, with the force of the specimen.

    The integration is implicit, and the force at the end of a main step is not known then. It is extrapolated or held,
    so the loop is stable only for steps that are short against the period of the interface's mass on the specimen: with
    2 % damping and extrapolation up to 0.38 sqrt(m / k_E).

    Attributes:
        analysis: in the state in which tests begin, when a loop is made of it: loaded, damped, its dampers installed.
            Nothing else may use it while a test runs.
        terms: (coefficient, node, degree) that the specimen's deformation is the sum of; degrees 0 ux, 1 uy, 2 rz.
        channels: what is recorded of a test at main steps, extremes over all steps; the given force 0 is that of the
            specimen, as the frame meets it. Without any nothing is recorded.
        limits: by name of a channel; a test ends where its magnitude passes it.
        method: of integration.
        force: over a main step `extrapolated` from the last two, or `held`.
        steps: of the frame in a main step.
    """

    analysis: Analysis
    terms: tuple[tuple[float, int, int], ...]
    channels: tuple[Channel, ...] = ()
    limits: Mapping[str, float] = field(default_factory=dict)
    method: Integrator = AVERAGE_ACCELERATION
    force: Literal["extrapolated", "held"] = "extrapolated"
    steps: int = 1

    def fill(self, data: Any) -> list[Any]:
        """Write the numerical part into the core's struct.

        Returns:
            What must live until a test has been made of it.
        """
        method, parameters = self.method.parameters()
        part = ffi.new("ed_frame_part *")
        coefficients, nodes, degrees = zip(*self.terms, strict=True)
        keep = [ffi.new("int[]", list(nodes)), ffi.new("int[]", list(degrees)), ffi.new("double[]", list(coefficients))]
        part.analysis, part.divisions, part.held = self.analysis.handle, self.steps, int(self.force == "held")
        part.method, part.parameters = method, parameters + [0.0] * (4 - len(parameters))
        part.n_terms, part.node, part.degree, part.coefficient = len(self.terms), *keep
        data.frame = part
        return [part, *keep]
