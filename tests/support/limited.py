"""Processes that tests read from or wait for: none keeps a test waiting without end."""

from __future__ import annotations

import subprocess
import threading
from collections.abc import Iterator
from contextlib import contextmanager

LIMIT = 120.0  # s: nothing here takes as long, on a busy machine either


@contextmanager
def limited(process: subprocess.Popen[str] | subprocess.Popen[bytes], limit: float = LIMIT) -> Iterator[None]:
    """Kill a process once the context has taken too long, so that who waits for it goes on, or is left by an error.

    `Popen` as a context waits at its end without limit: name it before this one.
    """
    end = threading.Timer(limit, process.kill)
    end.start()
    try:
        yield
    except BaseException:
        process.kill()
        raise
    finally:
        end.cancel()
