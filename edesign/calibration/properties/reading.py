"""How properties were read from the loops: faults that no loop has, only the table."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from edesign.calibration.dampers.acts import Values
from edesign.calibration.dampers.effect import Rows, size
from edesign.calibration.dampers.sizes import Sizes
from edesign.estimation.parameters import Parameter

_SOURCE = "thesis Eqs. 3.1-3.4 and section 3.3"


@dataclass(frozen=True, eq=False)
class Reading:
    """A form of an effect that changes what is read from the loops.

    Attributes:
        name: of the effect.
        form: how it acts.
        title: for people.
        signature: what it leaves in the residual of a model without it, for people.
        source: paper, book.
        factors: of the force in phase, the largest force and that of the energy, (3,) per unit of the parameter.
        added: forces (3,) per unit of the parameter.
        parameters: with priors that suit a table; the first is its size.
        starts: values, SI, to start from.
        meanings: of its parameter by name, for people.
    """

    name: str
    form: str
    title: str
    signature: str
    factors: tuple[float, float, float]
    added: tuple[float, float, float]
    parameters: Callable[[Sizes], tuple[Parameter, ...]]
    starts: Callable[[Sizes], Rows]
    meanings: Mapping[str, str]
    source: str = _SOURCE

    @property
    def constants(self) -> Values:
        """No number is fixed by the table."""
        return {}

    def read(self, p: Values, amplitudes: np.ndarray) -> np.ndarray:
        """Return force amplitudes (3, rows), N, as they were read.

        Args:
            p: value of the parameter by name, SI.
            amplitudes: (3, rows) true ones, N: in phase, largest, of the energy.
        """
        (value,) = p.values()
        factors, added = np.array(self.factors), np.array(self.added)
        return np.asarray((1.0 + value * factors)[:, np.newaxis] * amplitudes + value * added[:, np.newaxis])


FORMS = (
    Reading(
        "peak_reading",
        "share",
        "the largest stress read too large by a share, as in cycles before the material has softened",
        "G_eq off by one factor beside G' and loss factor, whatever strain, frequency and temperature",
        (0.0, 1.0, 0.0),
        (0.0, 0.0, 0.0),
        lambda _: (size("share", "", 0.1, -0.5, 1.0),),
        lambda _: ((0.05,),),
        {"share": "by which the largest stress is read too large"},
    ),
    Reading(
        "peak_reading",
        "force",
        "the largest stress read from noisy samples",
        "G_eq too large by one force at all amplitudes, most in small tests",
        (0.0, 0.0, 0.0),
        (0.0, 1.0, 0.0),
        lambda s: (size("force", "N", 0.05 * s.force, 0.0, 0.5 * s.force),),
        lambda s: ((0.02 * s.force,),),
        {"force": "by which the largest force is read too large"},
    ),
    Reading(
        "storage_reading",
        "share",
        "the stress at the largest strain read too small by a share",
        "G' too small and the loss factor too large by one factor, G_eq right",
        (-1.0, 0.0, 0.0),
        (0.0, 0.0, 0.0),
        lambda _: (size("share", "", 0.1, -1.0, 0.5),),
        lambda _: ((0.05,),),
        {"share": "by which the stress at the largest strain is read too small"},
    ),
)
