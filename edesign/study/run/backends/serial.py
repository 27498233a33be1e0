"""One call after the other, in the thread that asks for the results."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from edesign.one_thread import one_thread
from edesign.study.run.backends.call import Call, Control, LocalBackend, Results, check_keys, perform


class SerialBackend(LocalBackend):
    """Runs calls one after the other."""

    name = "serial"

    def results(self, calls: Sequence[Call], control: Control, started: Callable[[str], None]) -> Results:
        """Yield results in the order of the calls; see `Backend`."""
        check_keys(calls)
        with one_thread():
            for call in calls:
                if control.stopped():
                    return
                started(call.key)
                yield perform(call, control)
