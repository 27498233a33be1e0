"""A file that changes on disk by whole transactions, so that a full disk does not spoil what was committed.

HDF5 itself gives no such promise: a write that fails leaves its library in a state that ends in a crash, and a process
that is killed between two flushes may leave a file that no longer opens. Here the library writes into memory, and
`commit` takes the changes to the disk: new space first, where nothing committed can be hurt, then the few changed
blocks of the existing space. A kill or an error of the disk in the instant of this second part, which has no journal,
may leave some of them old and some new; the checksums of HDF5 and of the groups tell.
"""

from __future__ import annotations

import errno
import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import BinaryIO

fcntl: ModuleType | None
try:
    import fcntl
except ImportError:  # not on this platform; two runs on one archive are then not told apart
    fcntl = None

PAGE = 1 << 16
PATIENCE = 10.0  # s to wait for a lock; both sides hold it for the time in which a file is copied at most
_COMMIT_LOCK = 1 << 62  # the byte that is locked, where no file has one


class TransactionFile:
    """A random-access binary file (seek, tell, readinto, write, truncate, flush) with `commit`.

    Args:
        path: the file; it is created if missing, and locked against other writers.
        read_only: True leaves the file as it is: it must exist, is not locked, and cannot be committed.

    Raises:
        BlockingIOError: another process writes to the file.
        OSError: it cannot be created or opened.
    """

    def __init__(self, path: str | os.PathLike[str], read_only: bool = False) -> None:
        self._descriptor = os.open(path, os.O_RDONLY if read_only else os.O_RDWR | os.O_CREAT, 0o644)
        try:
            if not read_only:
                _lock(self._descriptor)
        except OSError:
            os.close(self._descriptor)
            raise
        status = os.fstat(self._descriptor)
        self._identity = _identity(status)
        self._committed = status.st_size
        self._size = self._committed
        self._on_disk = self._committed  # bytes of the disk file that still are this file's content
        self._position = 0
        self._pages: dict[int, bytearray] = {}

    @property
    def size(self) -> int:
        """The size of the file in bytes, with the changes that were not committed."""
        return self._size

    @property
    def path(self) -> Path | None:
        """The present path of the file, if the system tells it and the file has not been deleted."""
        try:
            if os.fstat(self._descriptor).st_nlink:
                return Path(os.readlink(f"/proc/self/fd/{self._descriptor}"))
        except OSError:
            pass
        return None

    def is_at(self, path: Path) -> bool:
        """Return whether a path leads to this file.

        Raises:
            FileNotFoundError: it leads nowhere.
        """
        return _identity(os.stat(path)) == self._identity

    def write_again(self, path: Path) -> None:
        """Write the committed content to a path where nothing is, and continue there.

        Raises:
            OSError: it cannot be written, or something is there.
        """
        descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o644)
        try:
            _lock(descriptor)
            place = 0
            while content := os.pread(self._descriptor, PAGE, place):
                place += os.pwrite(descriptor, content, place)
            os.fsync(descriptor)
        except OSError:
            os.close(descriptor)
            os.unlink(path)
            raise
        os.close(self._descriptor)
        self._descriptor = descriptor
        self._identity = _identity(os.fstat(descriptor))

    def seek(self, offset: int, whence: int = os.SEEK_SET) -> int:
        """Move to a position and return it.

        Args:
            offset: bytes.
            whence: 0 from the start, 1 from the position, 2 from the end.
        """
        base = {os.SEEK_SET: 0, os.SEEK_CUR: self._position, os.SEEK_END: self._size}[whence]
        self._position = base + offset
        return self._position

    def tell(self) -> int:
        """Return the position in bytes."""
        return self._position

    def readinto(self, target: memoryview) -> int:
        """Fill `target` from the position on; return the number of bytes read."""
        view = memoryview(target).cast("B")
        total = max(0, min(len(view), self._size - self._position))
        done = 0
        while done < total:
            number, start = divmod(self._position, PAGE)
            count = min(PAGE - start, total - done)
            view[done : done + count] = self._page(number)[start : start + count]
            done += count
            self._position += count
        return total

    def read(self, size: int = -1) -> bytes:
        """Return up to `size` bytes from the position on, all of them for -1."""
        left = max(0, self._size - self._position)
        content = bytearray(left if size < 0 else min(size, left))
        self.readinto(memoryview(content))
        return bytes(content)

    def write(self, source: bytes | memoryview) -> int:
        """Change the bytes at the position in memory; return their number."""
        view = memoryview(source).cast("B")
        done = 0
        while done < len(view):
            number, start = divmod(self._position, PAGE)
            count = min(PAGE - start, len(view) - done)
            page = self._pages.get(number)
            if page is None:
                page = self._pages[number] = self._page(number)
            page[start : start + count] = view[done : done + count]
            done += count
            self._position += count
        self._size = max(self._size, self._position)
        return done

    def truncate(self, size: int | None = None) -> int:
        """Cut or extend (with zeros) the file in memory; return its size in bytes."""
        size = self._position if size is None else size
        if size < self._size:
            self._on_disk = min(self._on_disk, size)
            last, start = divmod(size, PAGE)
            for number in [n for n in self._pages if n > last]:
                del self._pages[number]
            if last in self._pages:
                self._pages[last][start:] = bytes(PAGE - start)
        self._size = size
        return size

    def load(self) -> None:
        """Read the whole file into memory, so that changes on the disk are not seen."""
        for number in range(-(-self._on_disk // PAGE)):
            self._pages.setdefault(number, self._page(number))

    def flush(self) -> None:
        """Do nothing: only `commit` touches the disk."""

    def commit(self) -> None:
        """Write all changes to the disk.

        Raises:
            OSError: no space, or another failure; the file on disk is as the last commit left it, unless blocks of
                existing space could not be overwritten.
        """
        for number in range(self._on_disk // PAGE, -(-min(self._committed, self._size) // PAGE)):
            self._pages.setdefault(number, self._page(number))  # cut off and grown again: zeros now
        try:
            for number in sorted(self._pages):
                self._put(number, self._committed, self._size)
            if self._size > self._committed:
                os.ftruncate(self._descriptor, self._size)
            os.fsync(self._descriptor)
        except OSError:
            os.ftruncate(self._descriptor, self._committed)
            raise
        with _locked(self._descriptor, write=True):
            for number in sorted(self._pages):
                self._put(number, 0, min(self._committed, self._size))
            os.ftruncate(self._descriptor, self._size)
        os.fsync(self._descriptor)
        self._pages.clear()
        self._committed = self._on_disk = self._size

    def close(self) -> None:
        """Release the file; changes that were not committed are dropped."""
        if self._descriptor >= 0:
            os.close(self._descriptor)
            self._descriptor = -1
        self._pages.clear()

    def _page(self, number: int) -> bytearray:
        if number in self._pages:
            return self._pages[number]
        start = number * PAGE
        page = bytearray(PAGE)
        count = min(PAGE, self._on_disk - start)
        if count > 0:
            content = os.pread(self._descriptor, count, start)
            page[: len(content)] = content
        return page

    def _put(self, number: int, lower: int, upper: int) -> None:
        """Write the part of a page between two positions of the file."""
        origin = number * PAGE
        start, stop = max(origin, lower), min(origin + PAGE, upper)
        page = memoryview(self._pages[number])
        while start < stop:
            start += os.pwrite(self._descriptor, page[start - origin : stop - origin], start)


@contextmanager
def between_commits(path: Path) -> Iterator[BinaryIO]:
    """Open a file for reading, and hold back other processes that commit to it.

    The lock is one of the process and goes as soon as the process closes the file by any descriptor. So another one may
    be opened meanwhile, but not closed before the copy is made.

    Raises:
        OSError: it cannot be opened.
    """
    with path.open("rb") as file, _locked(file.fileno(), write=False):
        yield file


@contextmanager
def _locked(descriptor: int, write: bool) -> Iterator[None]:
    """Hold the lock of commits; go on without it where the system has none, or another process does not let go."""
    held = False
    end = time.monotonic() + PATIENCE
    while fcntl is not None and not held and time.monotonic() < end:
        try:
            fcntl.lockf(descriptor, (fcntl.LOCK_EX if write else fcntl.LOCK_SH) | fcntl.LOCK_NB, 1, _COMMIT_LOCK)
            held = True
        except OSError as error:
            if error.errno not in (errno.EACCES, errno.EAGAIN):
                break
            time.sleep(0.002)
    try:
        yield
    finally:
        if fcntl is not None and held:
            fcntl.lockf(descriptor, fcntl.LOCK_UN, 1, _COMMIT_LOCK)


def _identity(status: os.stat_result) -> tuple[int, int]:
    return status.st_dev, status.st_ino


def _lock(descriptor: int) -> None:
    if fcntl is not None:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
