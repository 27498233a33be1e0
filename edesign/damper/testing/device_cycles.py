"""Properties of a device, in its own units, of each cycle of its tests: the numbers of a laboratory's sheet."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from edesign.damper.damper import Damper
from edesign.damper.testing.cycles import find_blocks
from edesign.damper.testing.loops import Loops, LoopValues
from edesign.damper.testing.measured_histories import DamperTest
from edesign.errors import InputError

LEAST_CYCLES = 3
"""Of a run: standards ask for three cycles of the largest amplitude at least, and judge devices by the third."""

_STORES = 0.03
"""k' over k'' from which a device is said to store energy: the tangent of 1.8 degrees, by which filters and clocks of
two channels may differ (5 ms at 1 Hz). Below it k' of a dashpot is what noise and phase leave."""
_GIVES = 1e-3
"""-k'' over k_eq from which a device gives energy: below it is what estimates of a spring leave."""


@dataclass(frozen=True)
class Run:
    """Successive cycles of a test at one amplitude and frequency.

    Attributes:
        test: name of the test.
        title: of the test, for people.
        block: number of the run in the test, from 1.
        loops: displacements in m, forces in N, work in J.
        temperature_C: (n,) mean of each cycle.
    """

    test: str
    title: str
    block: int
    loops: LoopValues
    temperature_C: np.ndarray

    @property
    def cycles(self) -> int:
        """Number of cycles."""
        return self.loops.start.size

    @property
    def frequency(self) -> np.ndarray:
        """Frequency of each cycle, Hz."""
        return 1.0 / self.loops.period

    @property
    def storage_stiffness(self) -> np.ndarray:
        """Storage stiffness k' of each cycle, N/m.

        It is the difference of the forces at the largest and smallest displacement over that of these displacements.

        Source: thesis Eq. 3.1; the effective stiffness of EN 1998-1:2004, 10.9.2 and ASCE/SEI 7-16, Eq. 17.8-3.
        """
        return self.loops.storage

    @property
    def loss_stiffness(self) -> np.ndarray:
        """Loss stiffness k'' = W / (pi x0^2) of each cycle, N/m."""
        return self.loops.loss

    @property
    def equivalent_stiffness(self) -> np.ndarray:
        """Stiffness of each cycle, N/m: range of the force over the range of the displacement."""
        return self.loops.equivalent

    @property
    def damping(self) -> np.ndarray:
        """Damping coefficient c = W / (pi omega x0^2) of each cycle, N s/m: of the dashpot that does the same work."""
        return self.loss_stiffness / (2.0 * np.pi * self.frequency)

    @property
    def damping_ratio(self) -> np.ndarray:
        """Effective damping xi = W / (2 pi k' x0^2) of each cycle; nan of a device that stores nothing.

        Source: EN 1998-1:2004, 10.9.2(3); ASCE/SEI 7-16, Eq. 17.8-4.
        """
        storage, loss = self.storage_stiffness, self.loss_stiffness
        stores = storage > _STORES * np.abs(loss)
        return np.divide(loss, 2.0 * storage, out=np.full(storage.size, np.nan), where=stores)

    @property
    def gives_energy(self) -> bool:
        """True if the device gives energy in a cycle, as no damper does: a channel has the other sign."""
        return bool(np.any(self.loss_stiffness < -_GIVES * np.abs(self.equivalent_stiffness)))

    def from_third(self, values: np.ndarray) -> np.ndarray:
        """Return the deviation of the value of each cycle from that of the third one, as a ratio.

        Args:
            values: (n,) in any unit.

        Returns:
            (n,), dimensionless.
        """
        return values / values[LEAST_CYCLES - 1] - 1.0


def runs_of(test: DamperTest) -> tuple[Run, ...]:
    """Find the runs of a test.

    Args:
        test: with measured force.

    Raises:
        InputError: no force, or no three cycles of one amplitude and frequency.
    """
    force = test.varying_force()
    blocks = [b for b in find_blocks(test.time, test.displacement) if b.cycles >= LEAST_CYCLES and b.steady]
    if not blocks:
        raise InputError(
            f"{test.where}: there are no {LEAST_CYCLES} successive cycles of one amplitude and period [E-TEST-08]"
        )
    loops = Loops(test.time, test.displacement, force, test.where)
    found = []
    for number, block in enumerate(blocks, 1):
        degrees = [_mean_temperature(test, *block.bounds[i : i + 2]) for i in range(block.cycles)]
        found.append(Run(test.name, test.title, number, loops.of(block), np.array(degrees)))
    return tuple(found)


def predicted_runs(test: DamperTest, damper: Damper) -> tuple[Run, ...]:
    """Find the runs of a test with the force that a damper gives in its motion.

    Args:
        test: the test; its own force does not count.
        damper: at rest before the test.

    Raises:
        InputError: no three cycles of one amplitude and frequency.
        CoreError: the law gives no force.
    """
    return runs_of(test.with_force(damper.force(test.time, test.displacement)))


def _mean_temperature(test: DamperTest, start: float, end: float) -> float:
    if test.temperature_history is None:
        return test.temperature_C
    inside = (test.time >= start) & (test.time <= end)
    return float(np.mean(test.temperature_history[inside]))
