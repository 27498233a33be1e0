"""Progress of many short steps as one analysis of the usual progress."""

from __future__ import annotations

import time
from collections.abc import Callable

from edesign.study.run.progress import Listener, Progress


def reporter(listen: Listener, name: str) -> Callable[[int, int, str], None]:
    """Return the function to be called before each step with its number from 1, the number of steps, and its name.

    Args:
        listen: of the command line.
        name: of the whole.
    """
    began = time.monotonic()

    def tell(index: int, count: int, step: str) -> None:
        if index == 1:
            listen(Progress("start", f"{count} {name}"))
        listen(Progress("advance", f"{count} {name}", fraction=(index - 1) / count))
        if index == count:
            listen(
                Progress(
                    "end", f"{count} {name}", fraction=1.0, message=f"last: {step}", seconds=time.monotonic() - began
                )
            )

    return tell
