"""Shaking table tests: the structure stands on a table whose actuator feels it (thesis 6.1.1)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from edesign.core.damper import CoreDamper
from edesign.errors import InputError
from edesign.substructure.indicators.correlation_delay import correlation_delay
from edesign.substructure.indicators.response_error import response_error
from edesign.substructure.indicators.undetermined import Undetermined
from edesign.substructure.methods.comparison import MethodRecord, checked_ground, positive
from edesign.substructure.methods.state_space import LinearSystem, fixed_base, respond
from edesign.substructure.structure.numerical import LinearPart

GAIN_MARGIN = 2.0
"""Of the table's own loop where nothing else is said: 6 dB, a usual one of servo loops."""


@dataclass(frozen=True)
class ShakingTable:
    """A table on a column of oil, in displacement control: F' = k_oil (gain (x_c - x_t) - x_t') - leakage F.

    Attributes:
        mass: kg.
        oil_frequency: of the bare table on its oil, Hz.
        gain: of the displacement loop, 1/s.
        leakage: rate at which the force fades, from leakage past the piston and feedback of its pressure, 1/s. The bare
            table is stable for gain < leakage; None: 2 gain, a gain margin of 6 dB.

    Raises:
        InputError: a number is not greater than zero, or a leakage is negative.

    Source: Conte & Trombetti, Earthquake Engineering and Structural Dynamics 29 (2000), without the lag of the valve
    and the flexibility of the foundation.
    """

    mass: float
    oil_frequency: float
    gain: float
    leakage: float | None = None

    def __post_init__(self) -> None:
        for name in ("mass", "oil_frequency", "gain"):
            positive(f"table: {name}", getattr(self, name))
        if self.leakage is not None and not 0.0 <= self.leakage < math.inf:
            raise InputError(f"table: leakage must not be negative, not {self.leakage:g} [E-VALUE-02]")

    @property
    def oil_stiffness(self) -> float:
        """Stiffness of the oil column, N/m."""
        return self.mass * (2.0 * math.pi * self.oil_frequency) ** 2

    @cached_property
    def fading(self) -> float:
        """Leakage, or what it is taken as, 1/s."""
        return GAIN_MARGIN * self.gain if self.leakage is None else self.leakage


@dataclass(frozen=True, eq=False, kw_only=True)
class ShakingTableRecord(MethodRecord):
    """A shaking table test beside the response to the ground motion itself; n samples, d degrees.

    Displacements of the structure are relative to the table.

    Attributes:
        command: (n,) acceleration that is commanded, the ground motion unless it was iterated, m/s2.
        ground: (n,) acceleration that the table should have, m/s2.
        table: (n,) acceleration of the table, m/s2.
        command_displacement: (n,) m.
        table_displacement: (n,) m.
        delay: by which the table is late as a whole, s; that does the structure no harm, and is taken off the errors.
        table_errors: (iterations + 1,) rms of table less ground over that of the ground, before and after each.
    """

    command: np.ndarray
    ground: np.ndarray
    table: np.ndarray
    command_displacement: np.ndarray
    table_displacement: np.ndarray
    delay: float
    table_errors: np.ndarray

    @property
    def response_error(self) -> float:
        """Error of the response against the direct one, which is taken as late as the table."""
        step = float(self.time[1] - self.time[0])
        return response_error(self.deformation, _later(self.direct_deformation, self.delay, step))


def shaking_table_test(
    part: LinearPart,
    damper: CoreDamper | None,
    step: float,
    ground: ArrayLike,
    table: ShakingTable,
    *,
    iterations: int = 0,
    band: float | None = None,
) -> ShakingTableRecord:
    """Run a test of a whole structure on a table from rest.

    The command is the ground motion. With iterations it is corrected offline by the error of the table through the
    inverse transfer function of the bare table, known before the test, and the test is run again, on a specimen that
    remembers nothing of it. Corrections begin with the record; so it should begin with some tenths of a second of rest.

    Args:
        damper: in the place of the specimen; None: there is none.
        step: s.
        ground: (n,) acceleration that the table should have, m/s2.
        band: corrections above this frequency are left out, Hz, as the inverse is large there; None: the oil's, which
            the table cannot follow beyond.

    Raises:
        InputError: an impossible number, the table is unstable with this structure, or the damper's force does not
            come into balance.
        CoreError: the law of the damper failed.
    """
    values = checked_ground(step, ground)
    band = table.oil_frequency if band is None else band
    if iterations < 0 or not band > 0.0:
        raise InputError(f"shaking table: {iterations} iterations up to {band:g} Hz are not possible [E-VALUE-02]")
    if iterations and table.fading <= table.gain:
        raise InputError(
            f"shaking table: the bare table is unstable with a gain of {table.gain:g} 1/s and a leakage of "
            f"{table.fading:g} 1/s, so that its inverse corrects nothing; take a gain below the leakage [E-RIG-05]"
        )
    system = _laboratory(part, table)
    _check_stable(system, table)
    command = values
    errors = []
    for again in range(iterations + 1):
        states, damper_force = respond(system, command, step, damper)
        achieved = _table_acceleration(system, states, damper_force, len(part.names))
        delay = _delay(values, achieved, step)
        errors.append(response_error(achieved, _later(values, delay, step)))
        if again < iterations:
            command = command + _correction(values - achieved, table, step, band)
    direct, direct_force = respond(fixed_base(part), values, step, damper)
    n = len(part.names)
    return ShakingTableRecord(
        time=step * np.arange(values.size),
        command=command,
        ground=values,
        table=achieved,
        command_displacement=states[:, 2 * n + 3],
        table_displacement=states[:, n],
        displacement=states[:, :n],
        deformation=states[:, :n] @ part.interface,
        damper_force=damper_force,
        direct_displacement=direct[:, :n],
        direct_deformation=direct[:, :n] @ part.interface,
        direct_force=direct_force,
        delay=delay,
        table_errors=np.array(errors),
    )


def table_transfer(
    table: ShakingTable, frequency: ArrayLike, part: LinearPart | None = None, damper_stiffness: complex = 0j
) -> np.ndarray:
    """Return x_t / x_c (m,), complex, at frequencies (m,) in Hz.

    k_oil gain / ((s + leakage) Z + k_oil s + k_oil gain) with Z = m s^2, and under a structure + r' M (r s^2 + x s^2),
    x its displacement relative to the table by a displacement of 1 of it.

    Args:
        frequency: (m,) Hz.
        part: the structure on it; None: the bare table.
        damper_stiffness: K' + i K'' of its damper at all of these frequencies, N/m.
    """
    s = 2j * math.pi * np.atleast_1d(np.asarray(frequency, dtype=float))
    impedance = table.mass * s**2
    if part is not None:
        square = (s**2)[:, None, None]
        damper = damper_stiffness * np.outer(part.interface, part.interface)
        dynamic = part.mass * square + part.damping * s[:, None, None] + part.stiffness + damper
        inertia = part.mass @ part.influence
        relative = np.linalg.solve(dynamic, -square * inertia[:, None])[..., 0]
        impedance = impedance + s**2 * (part.influence @ inertia + relative @ inertia)
    oil = table.oil_stiffness
    return np.asarray(oil * table.gain / ((s + table.fading) * impedance + oil * s + oil * table.gain))


def _laboratory(part: LinearPart, table: ShakingTable) -> LinearSystem:
    """Structure, table and actuator, by the commanded acceleration, m/s2.

    The state is displacement (n, relative to the table) and x_t, their velocities, then the actuator's force, x_c and
    its velocity.
    """
    n = len(part.names)
    inertia = part.mass @ part.influence
    mass = np.block(
        [[part.mass, inertia[:, None]], [inertia[None, :], np.array([[table.mass + part.influence @ inertia]])]]
    )
    inverse = np.linalg.inv(mass)
    d = n + 1
    force, command, rate = 2 * d, 2 * d + 1, 2 * d + 2
    A = np.zeros((2 * d + 3, 2 * d + 3))
    A[:d, d : 2 * d] = np.eye(d)
    A[d : 2 * d, :n] = -inverse[:, :n] @ part.stiffness
    A[d : 2 * d, d : d + n] = -inverse[:, :n] @ part.damping
    A[d : 2 * d, force] = inverse[:, n]
    oil = table.oil_stiffness
    A[force, [n, d + n, force, command]] = [-oil * table.gain, -oil, -table.fading, oil * table.gain]
    A[command, rate] = 1.0
    b, f, deformation, velocity = (np.zeros(len(A)) for _ in range(4))
    b[rate] = 1.0
    f[d : 2 * d] = -inverse[:, :n] @ part.interface
    deformation[:n], velocity[d : d + n] = part.interface, part.interface
    return LinearSystem(A, b, f, deformation, velocity)


def _table_acceleration(system: LinearSystem, states: np.ndarray, damper_force: np.ndarray, n: int) -> np.ndarray:
    """Acceleration (m,) of the table, m/s2, by states (m, s) and force of the damper (m,) N."""
    row = 2 * n + 1
    return np.asarray(states @ system.A[row] + damper_force * system.f[row])


def _check_stable(system: LinearSystem, table: ShakingTable) -> None:
    """Refuse a table that grows with its structure, without the damper; the two poles of the command are its own."""
    inside = len(system.A) - 2
    poles = np.linalg.eigvals(system.A[:inside, :inside])
    worst = poles[np.argmax(poles.real)]
    if worst.real > 1e-9 * np.abs(poles).max():  # rounding of an eigenvalue
        raise InputError(
            f"the shaking table is unstable with this structure: it grows at {abs(worst.imag) / (2.0 * math.pi):.3g} "
            f"Hz with a gain of {table.gain:g} 1/s and a leakage of {table.fading:g} 1/s; the bare table needs a gain "
            "below the leakage [E-RIG-05]"
        )


def _delay(ground: np.ndarray, achieved: np.ndarray, step: float) -> float:
    """Delay (s) at which the table correlates best with the ground; 0 where it does not follow at all."""
    try:
        return correlation_delay(ground, achieved, step).delay
    except Undetermined:
        return 0.0


def _later(values: np.ndarray, delay: float, step: float) -> np.ndarray:
    """A history (n,) or (n, d) from rest as it is when it comes later by a delay, s; it holds its ends."""
    time = step * np.arange(len(values))
    columns = values.reshape(len(values), -1).T
    later = [np.interp(time - delay, time, column) for column in columns]
    return np.array(later).T.reshape(values.shape)


def _correction(error: np.ndarray, table: ShakingTable, step: float, band: float) -> np.ndarray:
    """Change of the command (n,) m/s2 that takes an error (n,) m/s2 from the bare table."""
    padded = 2 * error.size  # the inverse must not come round from the end
    frequency = np.fft.rfftfreq(padded, step)
    spectrum = np.fft.rfft(error, padded) / table_transfer(table, frequency)
    return np.asarray(np.fft.irfft(np.where(frequency <= band, spectrum, 0.0), padded)[: error.size])
