"""What all tests share: one thread of BLAS, no width of a terminal, and drawn examples judged by what they give.

Never by the time that a loaded machine takes.
"""

import os

# before numpy is imported, and for processes that tests start: threads of BLAS wait for each other in loops, and on
# cores that have other tests to run this takes up to ten times the work
for _library in ("OPENBLAS", "OMP", "MKL"):
    os.environ.setdefault(f"{_library}_NUM_THREADS", "1")

# commands that tests start would compile all they import, each time
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)

# workers of pytest-xdist have the width of the terminal; tables in a pipe, as tests read them, would be folded to it
os.environ.pop("COLUMNS", None)

import pytest  # noqa: E402
from hypothesis import HealthCheck, settings  # noqa: E402

from edesign.errors import CODE, EdesignError, Interrupted  # noqa: E402

settings.register_profile("edesign", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("edesign")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Whole studies take longer than what else counts as a hang."""
    for item in items:
        if item.get_closest_marker("study"):
            item.add_marker(pytest.mark.timeout(6 * 3600))


def _coded(self: EdesignError, *args: object) -> None:
    """Refuse a message for people without a code, also one that no test looks at."""
    Exception.__init__(self, *args)
    problems = getattr(self, "problems", ())  # with their places, or with names of parameters
    messages = [one[1] if isinstance(one, tuple) else one.message for one in problems] or [str(self)]
    for message in messages if self.exit_code not in (1, Interrupted.exit_code) else ():
        assert CODE.search(message), f"a message without a code: {message}"


EdesignError.__init__ = _coded  # type: ignore[method-assign]
