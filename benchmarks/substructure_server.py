"""Steps a second of OpenSeesPy with a damper in the laboratory of edesign, both on this machine: thesis 6.2.5, 1 ms.

The bar is a mean of 1000 steps a second. Means depend on what else the machine does, and single steps more so: this is
no hard real time.

Usage: python -m benchmarks.substructure_server [--repeats 3]
"""

from __future__ import annotations

import argparse
import json
import tempfile
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from queue import Queue
from typing import Any

from benchmarks.peers.opensees_laboratory import el_centro, start_client
from edesign.damper.thesis_tables import prototype_damper
from edesign.errors import EdesignError
from edesign.stopping import stoppable
from edesign.substructure.server.serve import SessionSummary, serve


@dataclass
class Laboratory:
    """A server in a thread.

    Attributes:
        port: where it waits.
        lines: what it said.
        stop: ends it if set.
        outcome: its summary or error, once it has ended.
    """

    port: int = 0
    lines: list[str] = field(default_factory=list)
    stop: threading.Event = field(default_factory=threading.Event)
    outcome: SessionSummary | EdesignError | None = None
    wait: Callable[[float], None] = lambda seconds: None


@contextmanager
def laboratory(**options: Any) -> Iterator[Laboratory]:
    """Serve the thesis' damper with Table 4.2 on a free port; options as of `serve`."""
    lab, said = Laboratory(), Queue[str]()

    def say(line: str) -> None:
        lab.lines.append(line)
        said.put(line)

    def run() -> None:
        with stoppable(lab.stop.is_set):
            try:
                lab.outcome = serve(prototype_damper().core, 0, on_event=say, **options)
            except EdesignError as error:
                lab.outcome = error

    thread = threading.Thread(target=run)
    thread.start()
    lab.port, lab.wait = int(said.get().rsplit(":", 1)[1]), thread.join
    try:
        yield lab
    finally:
        lab.stop.set()
        thread.join()


def main() -> None:
    """Print a line for each repeat."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.substructure_server", description=__doc__)
    parser.add_argument("--repeats", type=int, default=3)
    repeats, motion = parser.parse_args().repeats, el_centro()
    print("steps   steps/s (server)   mean, ms   median   99 %   longest   peak, mm   force, kN")
    for _ in range(repeats):
        with laboratory() as lab, tempfile.TemporaryDirectory() as folder:
            output, errors = start_client(lab.port, motion, Path(folder)).communicate()
            lab.wait(10.0)
            if not isinstance(lab.outcome, SessionSummary):
                raise SystemExit(f"{lab.outcome}\n{errors}")
            found, done = json.loads(output.splitlines()[-1]), lab.outcome
            times = "   ".join(f"{1e3 * found[name]:7.3f}" for name in ("mean", "p50", "p99", "longest"))
            figures = f"{1e3 * found['peak']:8.4f}   {1e-3 * done.force:8.3f}"
            print(f"{done.steps:5}   {done.steps_per_second:16.0f}   {times}   {figures}", flush=True)


if __name__ == "__main__":
    main()
