"""Sockets of the laboratory: whole messages in and out, waits that end by Ctrl-C, a request to stop, or a time."""

from __future__ import annotations

import errno
import selectors
import socket
import struct
import time
from contextlib import suppress

from edesign.archive.files import reason
from edesign.errors import InputError
from edesign.stopping import stop_if_requested

LARGEST_PORT = 65535

WISHES_MS = 200
"""How often a wait asks for requests to stop, as calls of the core do."""


class Connection:
    """A client's connection.

    Args:
        accepted: its socket, which this object owns.
        name: of the client, for messages.
        patience: s that the client may take to receive an answer.
    """

    def __init__(self, accepted: socket.socket, name: str, patience: float) -> None:
        self.name, self.patience, self._socket = name, patience, accepted
        accepted.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        accepted.setsockopt(
            socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1
        )  # notices a client's machine that is switched off
        for direction in (socket.SO_RCVTIMEO, socket.SO_SNDTIMEO):  # no poll before each message: a tenth of a step
            accepted.setsockopt(socket.SOL_SOCKET, direction, struct.pack("ll", 0, 1000 * WISHES_MS))
        self._buffer = memoryview(bytearray())
        self._done = 0  # bytes of a message that a stop left unread

    def read(self, size: int, seconds: float | None = None) -> memoryview:
        """Return the next bytes, valid until the next call; fewer than `size` if the client has gone.

        After an exception the next call of the same size goes on where it ended, so no message is read in two.

        Args:
            size: bytes, at least 1.
            seconds: for all of them; None: as long as it takes.

        Raises:
            TimeoutError: they did not come in time.
            KeyboardInterrupt: Ctrl-C or a request to stop.
        """
        if size > len(self._buffer):
            self._buffer = memoryview(bytearray(size))
        view = self._buffer[:size]
        until = None if seconds is None else time.monotonic() + seconds
        while self._done < size:
            try:
                received = self._socket.recv_into(view[self._done :])
            except BlockingIOError:
                _go_on_waiting(until)
                continue
            except OSError:  # reset: as good as closed
                received = 0
            if received == 0:
                break
            self._done += received
            if self._done < size:
                self.acknowledge()
                _go_on_waiting(until)
        done, self._done = self._done, 0
        return view[:done]

    def acknowledge(self) -> None:
        """Acknowledge what was read at once, if no answer follows that does it.

        A client with Nagle's algorithm holds its next message until then: 40 ms without this. The system forgets the
        request after a while, hence after every such receipt. Systems without the option have no such delay.
        """
        if hasattr(socket, "TCP_QUICKACK"):
            with suppress(OSError):  # reset meanwhile; the next receipt sees it
                self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_QUICKACK, 1)

    def write(self, message: bytes) -> bool:
        """Send a message; return whether the client is there and takes it in time.

        Args:
            message: bytes as they are sent.
        """
        rest = memoryview(message)
        until = time.monotonic() + self.patience
        while rest:
            try:
                rest = rest[self._socket.send(rest) :]
            except BlockingIOError:
                if time.monotonic() >= until:
                    return False
            except OSError:
                return False
        return True

    def close(self) -> None:
        """Close the connection."""
        self._socket.close()


def wait_for_client(listener: socket.socket) -> None:
    """Wait until a client connects.

    Args:
        listener: the listening socket.

    Raises:
        KeyboardInterrupt: Ctrl-C; Stopped: a request of `edesign.stopping.stoppable`.
    """
    with selectors.DefaultSelector() as waiting:  # not every system has poll
        waiting.register(listener, selectors.EVENT_READ)
        while not waiting.select(1e-3 * WISHES_MS):
            _go_on_waiting(None)


def listen(host: str, port: int) -> socket.socket:
    """Return a socket that listens.

    Args:
        host: name or IPv4 address of this machine under which clients reach it.
        port: 0: one that is free.

    Raises:
        InputError: the port is in use or not allowed, or the address is not of this machine.
    """
    if not 0 <= port <= LARGEST_PORT:
        raise InputError(f"port {port}: ports are numbers from 0 to {LARGEST_PORT} [E-SERVE-01]")
    listener = socket.socket()
    try:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)  # also just after another session
        listener.bind((host, port))
        listener.listen(1)
    except OSError as error:
        listener.close()
        raise InputError(_why_not(host, port, error)) from error
    return listener


def address(pair: tuple[str, int]) -> str:
    """Return an address as people write it.

    Args:
        pair: host and port.
    """
    return f"{pair[0]}:{pair[1]}"


def _go_on_waiting(until: float | None) -> None:
    stop_if_requested()
    if until is not None and time.monotonic() >= until:
        raise TimeoutError


def _why_not(host: str, port: int, error: OSError) -> str:
    if error.errno == errno.EADDRINUSE:
        return f"port {port} of {host} is in use by another program; choose another port [E-SERVE-01]"
    if error.errno == errno.EACCES:
        return f"port {port} of {host}: no permission; ports from 1024 on need none [E-SERVE-01]"
    if isinstance(error, socket.gaierror) or error.errno == errno.EADDRNOTAVAIL:
        return f"{host}: this is no address of this machine [E-SERVE-01]"
    return f"port {port} of {host} cannot be used: {reason(error)} [E-SERVE-01]"
