"""One work after the other, in the thread that asks for the results."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from edesign.one_thread import one_thread
from edesign.study.run.backends.work import Control, LocalBackend, Results, Work, check_keys, perform


class SerialBackend(LocalBackend):
    """Runs works one after the other."""

    name = "serial"

    def results(self, works: Sequence[Work], control: Control, started: Callable[[str], None]) -> Results:
        """Yield results in the order of the works; see `Backend`."""
        check_keys(works)
        with one_thread():
            for work in works:
                if control.stopped():
                    return
                started(work.key)
                yield perform(work, control)
