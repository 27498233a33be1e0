"""A damper law as the laboratory of OpenSees: a TCP server for its element genericClient.

For slow (pseudo-dynamic) and soft real-time tests with one client. A general operating system gives no hard real time.
Whoever reaches the port can move the specimen: there is no password and no encryption.
"""

from __future__ import annotations

import math
import time
from array import array
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from edesign.archive.csv_files import write_csv_file
from edesign.archive.files import check_csv
from edesign.core.damper import CoreDamper
from edesign.errors import AnalysisError
from edesign.stopping import Stopped, StopRequest, stop_requested, stoppable
from edesign.study.run.interrupt import stop_on_signals
from edesign.substructure.server import protocol
from edesign.substructure.server.connection import Connection, address, listen, wait_for_client
from edesign.substructure.server.mounted_specimen import MountedSpecimen, RefusedMotion
from edesign.substructure.server.protocol import Code, Greeting, Measured, Messages, NotTheProtocol, RefusedClient

LOCAL = "127.0.0.1"
"""Reached from this machine only."""

PATIENCE = 10.0
"""s. A client greets at once; this is for slow networks and busy machines."""

RECORD_HEADERS = ("time_s", "displacement_mm", "velocity_mm_s", "force_kN")

Ending = Literal["goodbye", "closed", "stopped", "failed"]
OnEvent = Callable[[str], None]


@dataclass(frozen=True)
class SessionSummary:
    """Summary of a session.

    Attributes:
        client: its address; empty: none came.
        ending: the client said goodbye, closed the connection between two steps, the server was stopped, or it failed.
        steps: committed.
        trials: motions that were tried in them.
        time: reached in the client's analysis, s.
        seconds: from the first trial to the last commit, s of the clock.
        longest_step: from commit to commit, s of the clock.
        displacement: largest committed, m, of either sign.
        force: largest committed, N, of either sign.
        record: file of the session; None: none was asked for.
    """

    client: str = ""
    ending: Ending = "stopped"
    steps: int = 0
    trials: int = 0
    time: float = 0.0
    seconds: float = 0.0
    longest_step: float = 0.0
    displacement: float = 0.0
    force: float = 0.0
    record: Path | None = None

    @property
    def steps_per_second(self) -> float:
        """Mean number of steps in a second; 0 without steps."""
        return self.steps / self.seconds if self.seconds > 0.0 else 0.0

    def text(self) -> str:
        """Return the figures in one line."""
        if not self.steps:
            return "no steps"
        speed = f"{self.steps} steps to t = {self.time:.6g} s, {self.steps_per_second:.0f} steps/s"
        slowest = f"longest {1e3 * self.longest_step:.3g} ms"
        return f"{speed}, {slowest}, at most {1e3 * self.displacement:.4g} mm and {1e-3 * self.force:.4g} kN"


class SessionError(AnalysisError):
    """Error: a fault of the client ended a session.

    Attributes:
        summary: of what was done before.
    """

    def __init__(self, message: str, summary: SessionSummary) -> None:
        super().__init__(message)
        self.summary = summary


class _Course:
    """Committed steps of a session: figures, and rows if they shall be recorded."""

    def __init__(self, keep: bool) -> None:
        self.client = ""
        self.ending: Ending = "stopped"
        self._rows = array("d", [0.0] * len(RECORD_HEADERS)) if keep else None
        self._begun = self._last = math.nan
        self._time = self._longest = self._displacement = self._force = 0.0

    def begin(self) -> None:
        """Note a trial; the first begins the clock."""
        if math.isnan(self._begun):
            self._begun = self._last = time.perf_counter()

    def add(self, step: Measured) -> None:
        """Note a committed step."""
        now = time.perf_counter()
        self._longest = max(self._longest, now - self._last)
        self._last, self._time = now, step.time
        self._displacement = max(self._displacement, abs(step.displacement))
        self._force = max(self._force, abs(step.force))
        if self._rows is not None:
            self._rows.extend((step.time, 1e3 * step.displacement, 1e3 * step.velocity, 1e-3 * step.force))

    def summary(self, mounted: MountedSpecimen, record: Path | None) -> SessionSummary:
        """Return the figures so far."""
        seconds = self._last - self._begun if mounted.steps else 0.0
        figures = (mounted.steps, mounted.trials, self._time, seconds, self._longest, self._displacement, self._force)
        return SessionSummary(self.client, self.ending, *figures, record)

    def write(self, path: Path) -> None:
        """Write the rows; raises ArchiveError if that fails."""
        if self._rows is not None:
            columns = len(RECORD_HEADERS)
            rows = (self._rows[i : i + columns] for i in range(0, len(self._rows), columns))
            write_csv_file(RECORD_HEADERS, rows, path, digits=9)


class _Gone(Exception):
    """The client closed the connection.

    Args:
        where: it was, if that was in the middle of something.
    """

    def __init__(self, where: str = "") -> None:
        super().__init__(where)
        self.where = where


def serve(
    specimen: CoreDamper,
    port: int,
    host: str = LOCAL,
    *,
    interface: Sequence[float] = (1.0,),
    allow_iterations: bool = False,
    patience: float = PATIENCE,
    record: Path | None = None,
    on_event: OnEvent = lambda line: None,
) -> SessionSummary:
    """Wait for a client, be its laboratory until it ends, and return what happened.

    While a client is served, others are refused by the system. Connections that do not greet as a genericClient are
    closed with a line, and the wait goes on. If a session fails or is stopped, the client's questions are answered with
    NaN until it goes: OpenSeesPy 3.7.1 waits for ever for an answer of a laboratory that has gone.

    Args:
        specimen: the damper law, in m and N at the size of the device; it starts at rest, undeformed, at time 0.
        port: of TCP; 0: a free one, which the first line of `on_event` names.
        host: address of this machine; 0.0.0.0 lets everybody in who reaches it.
        interface: (n,) of the client's n degrees of freedom: the specimen's deformation is interface . x, its force on
            them interface F; (-1, 1): a damper between two nodes.
        allow_iterations: whether a step may have trials of different displacements, as of implicit integrators.
        patience: s that a client may take to greet, to take an answer, or to go when it is refused.
        record: CSV of the committed steps, RECORD_HEADERS; it appears when the session ends, however it ends.
        on_event: takes lines for people.

    Returns:
        The summary, also if Ctrl-C, SIGTERM or a request of `edesign.stopping.stoppable` ended it. A second Ctrl-C
        leaves the client alone at once.

    Raises:
        InputError: the port is in use, the address is not of this machine, or the record's name is no table's.
        ArchiveError: the record cannot be written.
        SessionError: a client that the specimen cannot serve: other sizes, more trials in a step, time that runs
            backwards, numbers that are not finite, unknown codes; or one that went in the middle of a step.
        ValueError: all of the interface is 0, or some of it not finite.
    """
    if not (all(map(math.isfinite, interface)) and any(interface)):
        raise ValueError(f"interface {tuple(interface)}: finite and not all 0")
    if record is not None:
        check_csv(record)
    mounted, course = MountedSpecimen(specimen, allow_iterations), _Course(record is not None)
    fault = None
    with suppress(KeyboardInterrupt), stop_on_signals() as stop:
        with stoppable(stop.is_set):
            client, greeting = _await_client(host, port, patience, on_event)
        try:
            course.client = client.name
            fault = _session(client, greeting, interface, mounted, course, on_event, stop.is_set)
        finally:
            client.close()
    summary = course.summary(mounted, record)
    on_event(f"session ended ({summary.ending}): {summary.text()}")
    if record is not None:
        course.write(record)
    if fault is not None:
        raise SessionError(fault, summary)
    return summary


def _await_client(host: str, port: int, patience: float, on_event: OnEvent) -> tuple[Connection, Greeting]:
    """Return the first connection that greets as a genericClient; others are closed."""
    with listen(host, port) as listener:
        on_event(f"waiting for genericClient on {address(listener.getsockname())}")
        while True:
            wait_for_client(listener)
            try:
                accepted, peer = listener.accept()
            except OSError:  # it has gone again
                continue
            connection = Connection(accepted, address(peer), patience)
            greeting = None
            try:
                greeting = _greeting(connection)
            except NotTheProtocol as error:
                on_event(f"{connection.name} is no genericClient: {error}; still waiting")
            finally:
                if greeting is None:
                    connection.close()
            if greeting is not None:
                on_event(f"{connection.name} is connected")
                return connection, greeting


def _greeting(connection: Connection) -> Greeting:
    """Read the first message.

    Raises:
        NotTheProtocol: it is another one, or none.
    """
    received = b""
    for size in (protocol.FIRST_SIZE_BYTES, protocol.GREETING_BYTES - protocol.FIRST_SIZE_BYTES):
        try:
            received += bytes(connection.read(size, connection.patience))
        except TimeoutError:
            raise NotTheProtocol(
                f"it did not send the sizes of its vectors in {connection.patience:g} s [E-SERVE-05]"
            ) from None
        if len(received) < protocol.FIRST_SIZE_BYTES:
            raise NotTheProtocol("it closed the connection before it said anything [E-SERVE-05]")
        protocol.check_first_size(received[: protocol.FIRST_SIZE_BYTES])
    if len(received) < protocol.GREETING_BYTES:
        raise NotTheProtocol("it closed the connection within its first message [E-SERVE-05]")
    return protocol.parse_greeting(received)


def _session(
    client: Connection,
    greeting: Greeting,
    interface: Sequence[float],
    mounted: MountedSpecimen,
    course: _Course,
    on_event: OnEvent,
    stop: StopRequest,
) -> str | None:
    """Serve a client to its end, or a request to stop; return what was wrong if something was."""
    fault = None
    try:
        with stoppable(stop):
            _exchange(client, Messages(greeting, interface), mounted, course)
        course.ending = "goodbye"
    except _Gone as gone:
        where = gone.where or (f"the step to t = {mounted.trial.time:.9g} s" if mounted.under_way else "")
        if where:
            so_far = f"after {mounted.steps} steps to t = {mounted.committed.time:.9g} s"
            fault = f"{client.name} went in the middle of {where}, {so_far} [E-SERVE-06]"
            on_event(fault)
        course.ending = "failed" if where else "closed"
    except (RefusedClient, RefusedMotion) as error:
        course.ending, fault = "failed", f"{client.name}: {error}"
        on_event(f"{fault}; its questions are answered with NaN until it goes")
        _answer_nan(client, greeting.data_size)
    except KeyboardInterrupt:
        on_event(f"stopped; questions are answered with NaN for {client.patience:g} s, so that the client can end")
        _answer_nan(client, greeting.data_size, time.monotonic() + client.patience)
    except Exception:  # also of edesign itself: the client would wait for ever
        course.ending = "failed"
        _answer_nan(client, greeting.data_size)
        raise
    return fault


def _exchange(client: Connection, messages: Messages, mounted: MountedSpecimen, course: _Course) -> None:
    """Answer messages until the client says goodbye.

    Raises:
        _Gone: it goes without.
        RefusedClient, RefusedMotion: it wants what is not served.
        KeyboardInterrupt: the server shall stop.
    """
    size = protocol.DATA_SIZE * protocol.NUMBER
    while not stop_requested():
        message = client.read(size)
        if len(message) < size:
            raise _Gone("a message" if message else "")
        code = messages.code(message)
        if code not in protocol.QUESTIONS:
            client.acknowledge()
        if code is Code.TRIAL:
            course.begin()
            mounted.move(messages.motion(message))
        elif code is Code.COMMIT:
            if mounted.commit():
                course.add(mounted.committed)
        elif code in protocol.ENDS:
            return
        elif not client.write(messages.answer(code, mounted.trial)):
            raise _Gone("an answer")
    raise Stopped


def _answer_nan(client: Connection, data_size: int, until: float | None = None) -> None:
    """Answer questions with NaN until the client goes, says nothing for its patience, or a time is over.

    Ctrl-C ends it at once.
    """
    size, nothing = data_size * protocol.NUMBER, protocol.no_answer(data_size)
    with suppress(TimeoutError, KeyboardInterrupt):
        while True:
            message = client.read(size, client.patience if until is None else until - time.monotonic())
            code = protocol.code_of(message) if len(message) == size else Code.END
            if code in protocol.ENDS or (code in protocol.QUESTIONS and not client.write(nothing)):
                return
            client.acknowledge()
