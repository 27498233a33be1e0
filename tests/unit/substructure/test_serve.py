"""A damper law as OpenSees' laboratory, asked by a client in Python that speaks the protocol of genericClient."""

from __future__ import annotations

import math
import os
import signal
import socket
import struct
import subprocess
import sys
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from queue import Queue
from typing import Any

import numpy as np
import pytest
from limited import limited

from edesign.core.damper import CoreDamper, LawValues
from edesign.damper.testing.measured_files import read_test
from edesign.damper.thesis_tables import prototype_damper
from edesign.errors import ArchiveError, EdesignError, InputError
from edesign.stopping import Stopped, stoppable
from edesign.substructure.server.connection import Connection, listen
from edesign.substructure.server.mounted_specimen import MountedSpecimen
from edesign.substructure.server.protocol import NotTheProtocol, check_first_size, parse_greeting
from edesign.substructure.server.serve import SessionError, SessionSummary, serve
from edesign.substructure.sized_damper import SizedDamper

K, C = 2e6, 3e4  # N/m, N s/m
GREETING = (1, 1, 1, 0, 1, 0, 0, 0, 1, 0, 256)  # as genericClient sends it for one degree of freedom
TRIAL, COMMIT, ALL, FORCE, INITIAL, TANGENT, DAMPING, MASS, LAST = 3, 5, 6, 10, 12, 13, 14, 15, 99
SOON = 20.0  # s: nothing here takes as long, on a busy machine either


def spring() -> CoreDamper:
    return CoreDamper("kelvin_voigt", (K, C))


class Client:
    """What OpenSees sends."""

    def __init__(self, port: int, greeting: Sequence[int] | None = GREETING) -> None:
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=SOON)
        if greeting is not None:
            self.socket.sendall(struct.pack("<11i", *greeting))

    def send(self, code: float, *numbers: float) -> None:
        self.socket.sendall(struct.pack(f"<{1 + len(numbers)}d", code, *numbers).ljust(2048, b"\0"))

    def ask(self, code: float, count: int = 1) -> tuple[float, ...]:
        self.send(code)
        return struct.unpack(f"<{count}d", self.receive()[: 8 * count])

    def receive(self) -> bytes:
        received = b""
        while len(received) < 2048:
            part = self.socket.recv(2048 - len(received))
            assert part, "the laboratory has gone"
            received += part
        return received

    def force(self, time_: float, displacement: float, velocity: float = 0.0) -> float:
        self.send(TRIAL, displacement, velocity, 0.0, time_)
        return self.ask(FORCE)[0]

    def bye(self) -> None:
        self.send(LAST)
        self.socket.close()


class Laboratory:
    """A server in a thread of its own."""

    def __init__(self, specimen: CoreDamper, options: dict[str, Any]) -> None:
        self.lines: list[str] = []
        self._first: Queue[str | None] = Queue()
        self.outcome: SessionSummary | EdesignError | ArithmeticError | None = None
        self.stop = threading.Event()
        self.thread = threading.Thread(target=self._run, args=(specimen, options))
        self.thread.start()
        line = self._first.get(timeout=SOON)
        assert line is not None, self.outcome
        self.port = int(line.rsplit(":", 1)[1])

    def _run(self, specimen: CoreDamper, options: dict[str, Any]) -> None:
        with stoppable(self.stop.is_set):
            try:
                self.outcome = serve(specimen, port=0, on_event=self._hear, **options)
            except (EdesignError, ArithmeticError) as error:
                self.outcome = error
            self._first.put(None)

    def _hear(self, line: str) -> None:
        self.lines.append(line)
        self._first.put(line)

    def end(self) -> SessionSummary:
        """The summary of a session that went well."""
        self.thread.join(SOON)
        assert isinstance(self.outcome, SessionSummary), self.outcome
        return self.outcome

    def fault(self) -> str:
        """The one line of a session that failed."""
        self.thread.join(SOON)
        assert isinstance(self.outcome, SessionError), self.outcome
        assert self.outcome.summary.ending == "failed"
        message = str(self.outcome)
        assert "\n" not in message
        return message


@contextmanager
def laboratory(specimen: CoreDamper | None = None, **options: Any) -> Iterator[Laboratory]:
    lab = Laboratory(specimen or spring(), {"patience": 1.0} | options)
    try:
        yield lab
    finally:
        lab.stop.set()
        lab.thread.join(SOON)
        assert not lab.thread.is_alive()


# ---- what a good client gets ----


def test_spring_and_dashpot(tmp_path: Path) -> None:
    """F = k u + c v; all questions; the record is a test file that edesign reads."""
    record = tmp_path / "session.csv"
    time_ = 0.01 * np.arange(1, 101)
    u, v = 5e-3 * np.sin(3.0 * time_), 15e-3 * np.cos(3.0 * time_)
    with laboratory(record=record) as lab:
        client = Client(lab.port)
        for t, ui, vi in zip(time_, u, v, strict=True):
            assert client.force(t, ui, vi) == pytest.approx(K * ui + C * vi, rel=1e-9)
            client.send(COMMIT)
        assert client.ask(TANGENT) == client.ask(INITIAL) == pytest.approx((K,), rel=1e-9)
        assert client.ask(DAMPING, 256) == client.ask(MASS, 256) == (0.0,) * 256
        client.bye()
        summary = lab.end()
    assert (summary.ending, summary.steps, summary.trials) == ("goodbye", 100, 100)
    assert summary.time == time_[-1] and summary.displacement == pytest.approx(np.max(np.abs(u)), rel=1e-12)
    assert summary.force == pytest.approx(np.max(np.abs(K * u + C * v)), rel=1e-9)
    assert summary.record == record and 0.0 < summary.longest_step < summary.seconds < SOON
    test = read_test(record, temperature_C=20.0)
    assert test.force is not None
    np.testing.assert_allclose(test.time, np.append(0.0, time_), rtol=1e-8)
    np.testing.assert_allclose(test.displacement, np.append(0.0, u), rtol=1e-8)
    np.testing.assert_allclose(test.force[1:], K * u + C * v, rtol=1e-8)
    assert record.read_text().splitlines()[0] == "time_s,displacement_mm,velocity_mm_s,force_kN"


def test_scales() -> None:
    """F = 3 law(2 u)."""
    with laboratory(SizedDamper(LawValues("kelvin_voigt", (K, C)), (3.0, 2.0))) as lab:
        client = Client(lab.port)
        assert client.force(0.01, 1e-3, 0.2) == pytest.approx(3.0 * (K * 2e-3 + C * 0.4), rel=1e-9)
        assert client.ask(TANGENT)[0] == pytest.approx(6.0 * K, rel=1e-9)
        client.bye()


def test_path_of_the_thesis_damper() -> None:
    """The MGMM softens as it moves: only committed steps count, not how often or what else was tried and asked."""
    damper = prototype_damper().core
    time_ = 0.002 * np.arange(1, 301)
    u, v = 6e-3 * np.sin(12.0 * time_) * time_, 6e-3 * (np.sin(12.0 * time_) + 12.0 * time_ * np.cos(12.0 * time_))
    expected = damper.force(np.append(0.0, time_), np.append(0.0, u), np.append(0.0, v))[1:]
    rng = np.random.default_rng(1)
    for iterations in (False, True):
        with laboratory(prototype_damper().core, allow_iterations=iterations) as lab:
            client, forces = Client(lab.port), []
            for t, ui, vi in zip(time_, u, v, strict=True):
                client.force(t, ui + iterations * 0.02 * rng.normal(), 0.5 * vi)  # an explicit integrator's first
                client.force(t, ui, vi)
                forces.append(client.ask(FORCE)[0])
                client.send(COMMIT)
                assert client.ask(FORCE)[0] == forces[-1]
            client.bye()
            assert lab.end().trials == 600
        np.testing.assert_allclose(forces, expected, rtol=1e-9, atol=1e-6)


def test_damper_between_two_nodes() -> None:
    """Deformation x_2 - x_1, forces -F and F, stiffness in all four places; measured as wanted."""
    greeting = (2, 2, 2, 0, 1, 2, 0, 0, 2, 1, 256)
    with laboratory(interface=(-1.0, 1.0)) as lab:
        client = Client(lab.port, greeting)
        client.send(TRIAL, 1e-3, 4e-3, 0.0, 0.1, 0.0, 0.0, 0.05)
        F = K * 3e-3 + C * 0.1
        assert client.ask(FORCE, 2) == pytest.approx((-F, F), rel=1e-9)
        assert client.ask(TANGENT, 4) == pytest.approx((K, -K, -K, K), rel=1e-9)
        assert client.ask(ALL, 5) == pytest.approx((-1.5e-3, 1.5e-3, -F, F, 0.05), rel=1e-9)
        client.bye()


def test_client_without_velocities() -> None:
    """The specimen goes straight to where it shall be."""
    with laboratory() as lab:
        client = Client(lab.port, (1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 256))
        client.send(TRIAL, 1e-3, 0.01)
        assert client.ask(FORCE)[0] == pytest.approx(K * 1e-3 + C * 0.1, rel=1e-9)
        client.bye()


def test_message_in_pieces() -> None:
    with laboratory() as lab:
        client = Client(lab.port, None)
        message = struct.pack("<11i", *GREETING) + struct.pack("<5d", TRIAL, 1e-3, 0.0, 0.0, 0.01).ljust(2048, b"\0")
        for part in (message[:2], message[2:50], message[50:]):
            client.socket.sendall(part)
            time.sleep(0.02)
        assert client.ask(FORCE)[0] == pytest.approx(K * 1e-3, rel=1e-9)
        client.bye()


# ---- what it refuses ----


def in_step(client: Client) -> None:
    client.force(0.01, 1e-3)
    client.send(COMMIT)
    client.force(0.02, 2e-3)


def second_trial(client: Client) -> None:
    in_step(client)
    client.send(TRIAL, 2.1e-3, 0.0, 0.0, 0.02)


def backwards(client: Client) -> None:
    in_step(client)
    client.send(TRIAL, 0.0, 0.0, 0.0, 0.001)


def jump(client: Client) -> None:
    client.send(TRIAL, 1e-3, 0.0, 0.0, 0.0)


def not_finite(client: Client) -> None:
    client.send(TRIAL, math.nan, 0.0, 0.0, 0.01)


def never(client: Client) -> None:
    client.send(TRIAL, 0.0, 0.0, 0.0, math.inf)


def far_away(client: Client) -> None:
    client.send(TRIAL, 1e305, 0.0, 0.0, 0.01)


def unknown_code(client: Client) -> None:
    client.send(7)


def no_code(client: Client) -> None:
    client.send(math.nan)


@pytest.mark.parametrize(
    ("do", "words"),
    [
        (second_trial, ["E-SERVE-02", "2.1 mm after 2 mm", "NewmarkExplicit"]),
        (backwards, ["E-SERVE-02", "from 0.01 s to 0.001 s", "loadConst"]),
        (jump, ["from 0 mm to 1 mm", "E-SERVE-02"]),
        (not_finite, ["t = 0.01 s", "E-SERVE-04"]),
        (never, ["E-SERVE-04"]),
        (far_away, ["no force at t = 0.01 s"]),
        (unknown_code, ["code 7", "E-SERVE-03"]),
        (no_code, ["code nan", "E-SERVE-03"]),
    ],
)
def test_refused_messages(do: Any, words: list[str], tmp_path: Path) -> None:
    """One line; the client's questions are answered with NaN until it goes; the record has what was committed."""
    record = tmp_path / "r.csv"
    with laboratory(record=record) as lab:
        client = Client(lab.port)
        do(client)
        assert math.isnan(client.ask(FORCE)[0])
        client.send(COMMIT)
        assert math.isnan(client.ask(DAMPING)[0])
        client.bye()
        fault = lab.fault()
    assert all(word in fault for word in words), fault
    assert len(record.read_text().splitlines()) == (3 if do in (second_trial, backwards) else 2)


@pytest.mark.parametrize(
    ("greeting", "words"),
    [
        ((1, 1, 1, 0, 1, 0, 0, 0, 1, 0, 512), ["512 numbers", "E-SERVE-03"]),
        ((2, 2, 2, 0, 1, 0, 0, 0, 2, 0, 256), ["2 displacements", "hangs on 1", "E-SERVE-03"]),
        ((1, 1, 1, 0, 0, 0, 0, 0, 1, 0, 256), ["0 times", "E-SERVE-03"]),
        ((1, 1, 1, 0, 1, 0, 0, 1, 1, 0, 256), ["1 accelerations measured", "E-SERVE-03"]),
    ],
)
def test_refused_sizes(greeting: tuple[int, ...], words: list[str]) -> None:
    with laboratory() as lab:
        client = Client(lab.port, greeting)
        client.socket.sendall(struct.pack("<d", FORCE) * greeting[10])
        assert math.isnan(struct.unpack_from("<d", client.receive())[0])
        client.socket.close()
        fault = lab.fault()
    assert all(word in fault for word in words), fault


def test_refused_client_that_stays_is_left() -> None:
    with laboratory(patience=0.2) as lab:
        client = Client(lab.port)
        jump(client)
        assert "jump" in lab.fault()
        client.socket.close()


@pytest.mark.parametrize(
    ("first", "words"),
    [
        (b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n", "'GET '..., as a web browser"),
        (b"GET", "closed the connection before"),
        (struct.pack(">11i", *GREETING), "big-endian"),
        (struct.pack("<11i", 300, *GREETING[1:]), "do not fit"),
        (struct.pack("<11i", 1, -1, *GREETING[2:]), "do not fit"),
        (struct.pack("<2i", 1, 1), "closed the connection within"),
        (b"\x16\x03\x01\x02\x00\x01", "not a size"),
    ],
)
def test_strangers_are_left(first: bytes, words: str) -> None:
    """The next client is served."""
    with laboratory() as lab:
        stranger = socket.create_connection(("127.0.0.1", lab.port), timeout=SOON)
        with suppress(OSError):  # it is closed as soon as it is known, with what was not read yet
            stranger.sendall(first)
            stranger.shutdown(socket.SHUT_WR)
            assert stranger.recv(1) == b""
        client = Client(lab.port)
        assert client.force(0.01, 1e-3) == pytest.approx(K * 1e-3)
        client.bye()
        assert lab.end().ending == "goodbye"
    assert words in lab.lines[1] and "still waiting" in lab.lines[1], lab.lines


def test_silent_stranger() -> None:
    with laboratory(patience=0.2) as lab:
        silent = socket.create_connection(("127.0.0.1", lab.port), timeout=SOON)
        assert silent.recv(1) == b""
        Client(lab.port).bye()
        assert lab.end().steps == 0
    assert "did not send the sizes of its vectors in 0.2 s" in lab.lines[1]


@pytest.mark.parametrize("seed", range(20))
def test_random_first_messages(seed: int) -> None:
    """Any 44 bytes are either a greeting or refused."""
    received = np.random.default_rng(seed).integers(0, 256, 44, dtype=np.uint8).tobytes()
    with pytest.raises(NotTheProtocol):
        parse_greeting(received)
    check_first_size(bytes(4))


def test_second_client() -> None:
    """The system refuses it, and the first goes on."""
    with laboratory() as lab:
        client = Client(lab.port)
        client.force(0.01, 1e-3)
        with pytest.raises(ConnectionRefusedError):
            Client(lab.port)
        client.send(COMMIT)
        assert client.force(0.02, 2e-3) > 0.0
        client.bye()


# ---- ends ----


@pytest.mark.parametrize("reset", [False, True])
def test_client_gone_in_a_step(reset: bool) -> None:
    with laboratory() as lab:
        client = Client(lab.port)
        in_step(client)
        if reset:  # as of a client that was killed with answers unread
            client.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        client.socket.close()
        assert "went in the middle of the step to t = 0.02 s, after 1 steps to t = 0.01 s" in lab.fault()


def test_client_gone_in_a_message() -> None:
    with laboratory() as lab:
        client = Client(lab.port)
        client.socket.sendall(b"abc")
        client.socket.close()
        assert "in the middle of a message" in lab.fault()


def test_client_gone_between_steps() -> None:
    with laboratory() as lab:
        client = Client(lab.port)
        client.force(0.01, 1e-3)
        client.send(COMMIT)
        client.socket.close()
        summary = lab.end()
    assert (summary.ending, summary.steps) == ("closed", 1)


@pytest.mark.parametrize("when", ["waiting", "serving"])
def test_wish_to_stop(when: str, tmp_path: Path) -> None:
    record = tmp_path / "r.csv"
    with laboratory(record=record) as lab:
        client = Client(lab.port) if when == "serving" else None
        if client is not None:
            in_step(client)
        lab.stop.set()
        summary = lab.end()
        assert (summary.ending, summary.steps) == ("stopped", int(when == "serving"))
        assert len(record.read_text().splitlines()) == 2 + summary.steps
        if client is not None:
            client.socket.close()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_signals(number: int, tmp_path: Path) -> None:
    """The client can end, the record is written, and there is no traceback."""
    code = (
        "import sys; from pathlib import Path; from edesign.core.damper import CoreDamper\n"
        "from edesign.substructure.server.serve import serve\n"
        "say = lambda line: print(line, flush=True)\n"
        "serve(CoreDamper('kelvin_voigt', (1.0, 0.0)), 0, record=Path(sys.argv[1]), on_event=say)\n"
    )
    environment = os.environ | {"PYTHONPATH": str(Path(__file__).parents[3])}
    record = tmp_path / "session.csv"
    with (
        subprocess.Popen(
            [sys.executable, "-c", code, str(record)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment
        ) as process,
        limited(process),
    ):
        assert process.stdout is not None and process.stderr is not None
        client = Client(int(process.stdout.readline().rsplit(b":", 1)[1]))
        in_step(client)
        process.send_signal(number)
        while not math.isnan(client.ask(FORCE)[0]):
            time.sleep(0.01)
        client.bye()
        assert process.wait(SOON) == 0
        assert process.stderr.read() == b""
        assert b"session ended (stopped): 1 steps" in process.stdout.read()
    assert len(record.read_text().splitlines()) == 3


def test_a_stop_within_a_message_loses_none_of_it() -> None:
    """What follows is read from its beginning, so that the client gets an answer to each question."""
    message = bytes(range(256))
    with listen("127.0.0.1", 0) as listener, socket.create_connection(listener.getsockname()) as there:
        connection = Connection(listener.accept()[0], "client", patience=1.0)
        there.sendall(message[:100])
        with stoppable(lambda: True), pytest.raises(Stopped):
            connection.read(len(message))
        there.sendall(message[100:] + message)
        assert bytes(connection.read(len(message))) == message
        assert bytes(connection.read(len(message))) == message
        connection.close()


def test_an_error_of_the_server_lets_the_client_end(monkeypatch: pytest.MonkeyPatch) -> None:
    """OpenSeesPy would wait for ever; its questions are answered with NaN, and the error is reported."""
    monkeypatch.setattr(MountedSpecimen, "move", lambda self, motion: 1 / 0)
    with laboratory() as lab:
        client = Client(lab.port)
        assert math.isnan(client.force(0.01, 1e-3))
        client.bye()
        lab.thread.join(SOON)
        assert isinstance(lab.outcome, ZeroDivisionError)


# ---- before a client comes ----


def test_port_in_use() -> None:
    with laboratory() as lab, pytest.raises(InputError, match=rf"port {lab.port} of 127.0.0.1 is in use"):
        serve(spring(), lab.port)


@pytest.mark.parametrize(
    ("host", "port", "words"),
    [
        ("127.0.0.1", 70000, "0 to 65535"),
        ("203.0.113.7", 0, r"203\.0\.113\.7: .*E-SERVE-01"),
        ("no.host.invalid", 0, r"no\.host\.invalid: .*E-SERVE-01"),
    ],
)
def test_wrong_address(host: str, port: int, words: str) -> None:
    with pytest.raises(InputError, match=words):
        serve(spring(), port, host)


def test_wrong_arguments(tmp_path: Path) -> None:
    for scales in ((0.0, 1.0), (1.0, math.nan)):
        with pytest.raises(ValueError, match="scales"):
            SizedDamper(LawValues("kelvin_voigt", (K, C)), scales)
    with pytest.raises(ValueError, match="interface"):
        serve(spring(), 0, interface=(0.0,))
    with pytest.raises(InputError, match=r"session\.h5: .*E-FILE-08"):
        serve(spring(), 0, record=tmp_path / "session.h5")
    (tmp_path / "file").touch()
    with pytest.raises(ArchiveError):
        serve(spring(), 0, record=tmp_path / "file" / "session.csv")
