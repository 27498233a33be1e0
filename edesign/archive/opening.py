"""Open the file of an archive for reading, so that nothing in it can do harm."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import h5py

from edesign.archive.global_heap import broken_collections, disable
from edesign.archive.seal import sealed_size
from edesign.archive.transaction import TransactionFile, between_commits
from edesign.archive.tree import Damaged, Tree

PARTIAL_SUFFIX = ".partial"


@dataclass
class Opened:
    """An open HDF5 file.

    Attributes:
        tree: its groups.
    """

    tree: Tree
    _memory: TransactionFile | None

    def close(self) -> None:
        """Close the file."""
        self.tree.file.close()
        if self._memory is not None:
            self._memory.close()


def has_seal(path: Path) -> bool:
    """Return whether a file has a seal that proves every byte unchanged.

    Raises:
        OSError: the system cannot read it.
    """
    with path.open("rb") as file:
        return sealed_size(file) is not None


def open_file(path: Path, sealed: bool, mend: bool = False) -> Opened:
    """Open a file.

    A complete archive never changes. A partial one is read as it is now: a copy of it in memory. Where texts cannot be
    read without harm, the copy is without them.

    Args:
        path: of the file.
        sealed: whether `has_seal` found its seal; what it holds is then not verified again.
        mend: read a damaged file too; where bytes were cut off, there are zeros then.

    Raises:
        OSError: the system cannot read it.
        Damaged: it is no file of HDF5, or its root is damaged.
    """
    memory = None
    with between_commits(path) as content:
        broken = [] if sealed else broken_collections(content)
        size = path.stat().st_size
        if broken or (mend and not sealed):
            memory = _mended(path, broken)
        try:
            copy = not sealed and is_partial(path)
            file = h5py.File(memory, "r") if memory is not None else _plainly(path, copy)
        except (OSError, RuntimeError, ValueError) as error:
            if memory is not None:
                memory.close()
            raise Damaged("", "not an HDF5 file, or damaged") from error
    try:
        return Opened(Tree(file, size, sealed), memory)
    except BaseException:
        file.close()
        if memory is not None:
            memory.close()
        raise


def is_partial(path: Path) -> bool:
    """Return whether the name of a file is that of an archive that is not complete."""
    return path.suffix == PARTIAL_SUFFIX


def _plainly(path: Path, copy: bool) -> h5py.File:
    if copy:
        return h5py.File(path, "r", driver="core", backing_store=False, locking=False)
    try:
        return h5py.File(path, "r", locking=False)
    except OSError as error:
        if "locking flag" not in str(error):
            raise
        return h5py.File(path, "r")  # open in this process already, with a lock, as xarray does: HDF5 wants the same


def _mended(path: Path, broken: list[int]) -> TransactionFile:
    """Return a copy in memory in which broken collections are none, and bytes that were cut off are zeros."""
    file = TransactionFile(path, read_only=True)
    file.load()
    file.seek(28)  # of a superblock of version 2, with lengths of 8 bytes: the end of the file
    file.truncate(max(file.size, int.from_bytes(file.read(8), "little")))
    disable(file, broken)
    return file
