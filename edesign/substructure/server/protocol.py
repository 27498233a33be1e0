"""Messages between a numerical part and its laboratory, as OpenSees' element genericClient speaks them over TCP.

All numbers are little-endian. The client greets with 11 int32: how many displacements, velocities, accelerations,
forces and times it controls, how many of each it wants measured, and the length of all later messages in float64. The
first number of a message is its code; questions are answered by a message of the same length.

Source: OpenSees, SRC/element/generic/GenericClient.cpp; the order of questions was seen with OpenSeesPy 3.7.1.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from edesign.errors import AnalysisError

DATA_SIZE = 256
"""Numbers of a message: what genericClient takes without -dataSize."""

NUMBER = 8
"""Bytes of a number in a message."""

LARGEST_DATA_SIZE = 2**16
"""Above it a greeting is none: text or a swapped byte order, read as an integer, lies far above."""

_FIRST = struct.Struct("<d")
_GREETING = struct.Struct("<11i")
GREETING_BYTES = _GREETING.size
FIRST_SIZE_BYTES = 4
"""Of a greeting, enough to know text from it."""

_CONTROLLED = ("displacements", "velocities", "accelerations", "forces", "times")


class Code(Enum):
    """Subject of a message: its first number."""

    TRIAL = 3.0
    COMMIT = 5.0
    ALL_MEASURED = 6.0
    FORCE = 10.0
    INITIAL_STIFFNESS = 12.0
    TANGENT_STIFFNESS = 13.0
    DAMPING = 14.0
    MASS = 15.0
    END = 98.0
    LAST = 99.0


_CODES = {code.value: code for code in Code}
ENDS = (Code.END, Code.LAST)
"""Codes of a goodbye."""
QUESTIONS = tuple(code for code in Code if code not in (Code.TRIAL, Code.COMMIT, *ENDS))
"""Codes of messages that the client waits for an answer to."""


class NotTheProtocol(AnalysisError):
    """Error: what was received is no greeting of a genericClient."""


class RefusedClient(AnalysisError):
    """Error: the client speaks the protocol, but asks for what the laboratory does not do."""


@dataclass(frozen=True)
class Greeting:
    """First message of a client.

    Attributes:
        controlled: numbers of displacements, velocities, accelerations, forces and times that it sends.
        measured: the same of what it wants back.
        data_size: float64 of every later message.
    """

    controlled: tuple[int, ...]
    measured: tuple[int, ...]
    data_size: int


@dataclass(frozen=True)
class Motion:
    """Motion that the client wants of the specimen.

    Attributes:
        time: s, of the client's analysis.
        displacement: deformation of the specimen, m.
        velocity: m/s; None: the client sends none.
    """

    time: float
    displacement: float
    velocity: float | None


@dataclass(frozen=True)
class Measured:
    """Quantities that the laboratory measures.

    Attributes:
        time: s.
        displacement: m.
        velocity: m/s.
        force: N, pulling back with a positive force for a positive displacement.
        stiffness: dF/du, N/m.
    """

    time: float
    displacement: float
    velocity: float
    force: float
    stiffness: float


def check_first_size(received: bytes) -> None:
    """Check the first four bytes of a greeting, so that a web browser need not be waited for.

    Raises:
        NotTheProtocol: they are no size.
    """
    (size,) = struct.unpack("<i", received)
    if 0 <= size <= LARGEST_DATA_SIZE:
        return
    if received.isascii() and received.decode().isprintable():
        raise NotTheProtocol(
            f"it sent the text {received.decode()!r}..., as a web browser would, not sizes of vectors [E-SERVE-05]"
        )
    if 0 <= int.from_bytes(received, "big", signed=True) <= LARGEST_DATA_SIZE:
        raise NotTheProtocol("its integers are big-endian; only little-endian clients are understood [E-SERVE-05]")
    raise NotTheProtocol(f"its first number is {size}, not a size of a vector [E-SERVE-05]")


def parse_greeting(received: bytes) -> Greeting:
    """Return the greeting in the first message of a client.

    Args:
        received: GREETING_BYTES bytes.

    Raises:
        NotTheProtocol: the numbers cannot be sizes of vectors.
    """
    check_first_size(received[:FIRST_SIZE_BYTES])
    sizes = _GREETING.unpack(received)
    greeting = Greeting(sizes[:5], sizes[5:10], sizes[10])
    longest = max(1 + sum(greeting.controlled), sum(greeting.measured))
    if min(sizes) < 0 or not longest <= greeting.data_size <= LARGEST_DATA_SIZE:
        raise NotTheProtocol(f"its sizes {', '.join(map(str, sizes))} do not fit each other [E-SERVE-05]")
    return greeting


class Messages:
    """Messages of one client, read and answered.

    Args:
        interface: (n,) share of each of the client's degrees of freedom in the specimen's deformation.

    Raises:
        RefusedClient: the client's sizes are not those of the specimen.
    """

    def __init__(self, greeting: Greeting, interface: Sequence[float]) -> None:
        n = len(interface)
        displacements, velocities, accelerations, forces, times = greeting.controlled
        if greeting.data_size != DATA_SIZE:
            raise RefusedClient(
                f"its messages have {greeting.data_size} numbers, and {DATA_SIZE} are served: leave out -dataSize"
                " [E-SERVE-03]"
            )
        if displacements != n:
            raise RefusedClient(
                f"it controls {displacements} displacements, and the specimen hangs on {n}: give genericClient "
                f"{n} node{'s' * (n > 1)} with one -dof each [E-SERVE-03]"
            )
        if velocities not in (0, n) or times != 1:
            given = ", ".join(f"{size} {name}" for size, name in zip(greeting.controlled, _CONTROLLED, strict=True))
            raise RefusedClient(f"it sends {given}; one time is needed, and {n} or no velocities [E-SERVE-03]")
        for size, name in zip(greeting.measured[:4], _CONTROLLED, strict=False):
            if size not in (0, n) or (size and name == "accelerations"):
                raise RefusedClient(
                    f"it wants {size} {name} measured; {0 if name == 'accelerations' else n} are [E-SERVE-03]"
                )
        self._interface = tuple(interface)
        self._numbers = struct.Struct(f"<{1 + sum(greeting.controlled)}d")
        self._moves = velocities > 0
        self._time_at = 1 + displacements + velocities + accelerations + forces
        self._measured = greeting.measured

    def code(self, message: memoryview) -> Code:
        """Return the code of a message of DATA_SIZE numbers.

        Args:
            message: as it was received.

        Raises:
            RefusedClient: it is unknown.
        """
        code = code_of(message)
        if code is None:
            (number,) = _FIRST.unpack_from(message)
            raise RefusedClient(f"its message has the code {number:g}, which is not served [E-SERVE-03]")
        return code

    def motion(self, message: memoryview) -> Motion:
        """Return where a trial puts the specimen.

        Args:
            message: as it was received.

        Raises:
            RefusedClient: a number is not finite: the client's own analysis has failed.
        """
        numbers = self._numbers.unpack_from(message)
        time = numbers[self._time_at]
        if not all(map(math.isfinite, numbers)):
            raise RefusedClient(
                f"it sent a number that is not finite for t = {time:g} s: its own analysis has failed [E-SERVE-04]"
            )
        n = len(self._interface)
        displacement = self._along(numbers[1 : 1 + n])
        return Motion(time, displacement, self._along(numbers[1 + n : 1 + 2 * n]) if self._moves else None)

    def answer(self, question: Code, measured: Measured) -> bytes:
        """Return the answer to one of QUESTIONS.

        Args:
            question: one of QUESTIONS.
            measured: state of the specimen.
        """
        if question is Code.FORCE:
            return _filled([share * measured.force for share in self._interface])
        if question is Code.ALL_MEASURED:
            return _filled(self._all_measured(measured))
        if question in (Code.DAMPING, Code.MASS):
            return _ZEROS  # the force has all that the specimen does
        return _filled([a * measured.stiffness * b for a in self._interface for b in self._interface])

    def _all_measured(self, measured: Measured) -> list[float]:
        """Displacements, velocities, forces and time as far as the client wants them; a deformation in equal shares."""
        back = sum(share**2 for share in self._interface)
        numbers: list[float] = []
        values = (measured.displacement / back, measured.velocity / back, 0.0, measured.force)
        for size, value in zip(self._measured[:4], values, strict=True):
            numbers += [share * value for share in self._interface] if size else []
        return numbers + [measured.time] * self._measured[4]

    def _along(self, values: Sequence[float]) -> float:
        return math.fsum(share * value for share, value in zip(self._interface, values, strict=True))


def code_of(message: memoryview) -> Code | None:
    """Return the code of a message; None: it is unknown.

    Args:
        message: as it was received.
    """
    (number,) = _FIRST.unpack_from(message)
    return _CODES.get(number)


def no_answer(data_size: int) -> bytes:
    """Return an answer of NaN, by which a client that waits for a force learns that there is none.

    Args:
        data_size: numbers of a message.
    """
    return struct.pack("<d", math.nan) * data_size


def _filled(numbers: Sequence[float]) -> bytes:
    return struct.pack(f"<{len(numbers)}d", *numbers).ljust(DATA_SIZE * NUMBER, b"\0")


_ZEROS = _filled([])
