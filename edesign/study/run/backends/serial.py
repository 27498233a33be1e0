"""One call after the other, in the thread that asks for the results."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from edesign.one_thread import one_thread
from edesign.study.run.backends.call import Call, Control, LocalBackend, Results, check_keys, perform


class SerialBackend(LocalBackend):
    """A back end that runs calls one after the other."""

    name = "serial"

    def results(self, calls: Sequence[Call], control: Control, started: Callable[[str], None]) -> Results:
        """Yield the results in the order of the calls; see `Backend`.

        Args:
            calls: with unique keys.
            control: receives the progress and is asked whether to stop.
            started: called with the key of each call that starts.
        """
        check_keys(calls)
        with one_thread():
            for call in calls:
                if control.stopped():
                    return
                started(call.key)
                yield perform(call, control)
