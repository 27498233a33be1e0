"""Linear algebra in one thread: faster for matrices of this size, and the same bits on any number of cores."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def one_thread() -> Iterator[None]:
    """Keep the BLAS of this process to one thread; contexts may lie in each other, also in threads of the outer one."""
    from threadpoolctl import threadpool_limits

    with threadpool_limits(limits=1, user_api="blas"):
        yield
