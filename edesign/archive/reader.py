"""Read an archive, complete or partial."""

from __future__ import annotations

import os
from pathlib import Path
from types import TracebackType

import h5py

from edesign.archive.dataset import Group
from edesign.archive.hdf5 import read_attributes, read_group
from edesign.archive.writer import FORMAT, partial_path
from edesign.errors import ArchiveError


class Archive:
    """An open archive; usable in a `with` statement.

    Args:
        path: `NAME.h5`, or `NAME.h5.partial` of a run that goes on or was interrupted.

    Attributes:
        path: the file.
        attributes: those of the root group (title, status, versions, checksum ...).

    Raises:
        ArchiveError: missing, unreadable, damaged, or not an archive of edesign.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)
        if self.path.is_dir():
            raise ArchiveError(f"{self.path}: this is a folder, not an archive")
        if not self.path.exists():
            partial = partial_path(self.path)
            hint = f"; an incomplete one is there: {partial}" if partial.exists() else ""
            raise ArchiveError(f"{self.path}: no such archive{hint}")
        try:
            self._file = _open(self.path)
        except PermissionError as error:
            raise ArchiveError(f"{self.path}: cannot read the archive: no permission") from error
        except (OSError, RuntimeError) as error:
            raise ArchiveError(f"{self.path}: not an HDF5 file, or damaged") from error
        try:
            self.attributes = read_attributes(self._file)
        except (OSError, RuntimeError, ValueError) as error:
            self._file.close()
            raise ArchiveError(f"{self.path}: the archive is damaged: {error}") from error
        found = self.attributes.get("edesign_archive")
        if found != FORMAT:
            self._file.close()
            what = "an HDF5 file, but not an archive of edesign" if found is None else f"an archive of layout {found}"
            raise ArchiveError(f"{self.path}: this is {what}; this version reads layout {FORMAT}")

    def __enter__(self) -> Archive:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()

    @property
    def complete(self) -> bool:
        """Whether the run that wrote the archive came to its end."""
        return bool(self.attributes.get("complete"))

    def has(self, path: str) -> bool:
        """Whether there is a group at a path."""
        return path in self._file

    def names(self, path: str = "/") -> list[str]:
        """Return the names of the groups below a path, by attribute `order`, then name; [] if it is not there."""
        if path not in self._file:
            return []
        parent = self._file[path]
        names = [name for name, item in parent.items() if isinstance(item, h5py.Group)]
        return sorted(names, key=lambda name: (int(parent[name].attrs.get("order", 0)), name))

    def group_attributes(self, path: str) -> dict[str, object]:
        """Return only the attributes of a group.

        Raises:
            ArchiveError: there is no such group, or it is damaged.
        """
        try:
            return read_attributes(self._find(path))
        except (OSError, RuntimeError, ValueError) as error:
            raise ArchiveError(f"{self.path}: {path} is damaged: {error}") from error

    def group(self, path: str = "/") -> Group:
        """Read a group with all its variables, without its subgroups.

        Raises:
            ArchiveError: there is no such group, or it is damaged.
        """
        try:
            return read_group(self._find(path))
        except (OSError, RuntimeError, ValueError, IndexError) as error:
            raise ArchiveError(f"{self.path}: {path} is damaged: {error}") from error

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def _find(self, path: str) -> h5py.Group:
        if path not in self._file or not isinstance(self._file[path], h5py.Group):
            parent = path.rpartition("/")[0] or "/"
            have = ", ".join(self.names(parent)) or "none"
            raise ArchiveError(f"{self.path}: there is no {path}; below {parent} there are: {have}")
        return self._file[path]


def _open(path: Path) -> h5py.File:
    """Open without a lock: a complete archive never changes, and a partial one changes only by whole transactions."""
    try:
        return h5py.File(path, "r", locking=False)
    except OSError as error:
        if "locking flag" not in str(error):
            raise
        return h5py.File(path, "r")  # open in this process already, with a lock, as xarray does: HDF5 wants the same


def open_archive(path: str | os.PathLike[str]) -> Archive:
    """Open an archive for reading.

    Args:
        path: `NAME.h5` or `NAME.h5.partial`.

    Returns:
        The open archive; close it, or use it in a `with` statement.

    Raises:
        ArchiveError: missing, unreadable, damaged, or not an archive of edesign.
    """
    return Archive(path)
