"""Write an archive: group by group into `NAME.h5.partial`, which becomes `NAME.h5` only when the run is complete."""

from __future__ import annotations

import errno
import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import TracebackType

import h5py

from edesign.archive.attributes import decode
from edesign.archive.dataset import Group
from edesign.archive.hdf5 import LIBRARY_VERSIONS, read_attributes, read_group, write_group
from edesign.archive.transaction import TransactionFile
from edesign.errors import ArchiveError

PARTIAL_SUFFIX = ".partial"
FORMAT = 1  # version of the layout, in the root attribute `edesign_archive`


def partial_path(path: str | os.PathLike[str]) -> Path:
    """Return where an archive lies while it is not complete."""
    return Path(f"{os.fspath(path)}{PARTIAL_SUFFIX}")


class ArchiveWriter:
    """An archive that is being written.

    Every `write` is one transaction: after it the group is on the disk; a kill, a full disk or an error during it
    leaves the groups before it. Until `finish` the file is `NAME.h5.partial` with the root attribute `complete` = 0,
    and an older `NAME.h5` stays untouched.

    Args:
        path: the archive, `NAME.h5`.
        root: attributes and variables of the root group (project text, versions ...).
        identity: names of the root attributes that must agree before groups of an earlier partial file are reused.
        reuse: decides by (group path, its attributes) whether a group of the partial file is kept; None starts afresh.
        extra: further groups written at the start, by path (they replace those of the partial file).

    Attributes:
        path: the archive, `NAME.h5`.
        kept: paths of the groups that were found in the partial file and are reused.
        note: one line on what happened to an earlier partial file, "" if there was none.

    Raises:
        ArchiveError: the folder is missing or unwritable, the disk is full, another run writes the same archive, or
            the path is that of a file of another kind.
    """

    def __init__(
        self,
        path: str | os.PathLike[str],
        root: Group,
        identity: Sequence[str] = (),
        reuse: Callable[[str, Mapping[str, object]], bool] | None = None,
        extra: Mapping[str, Group] | None = None,
    ) -> None:
        self.path = Path(path)
        self.kept: tuple[str, ...] = ()
        self.note = ""
        self._partial = partial_path(self.path)
        self._file: h5py.File | None = None
        if self.path.is_dir():
            raise ArchiveError(f"{self.path}: cannot write the archive: it is a folder")
        self._spare_other_files()
        if not self.path.parent.is_dir():
            raise ArchiveError(f"{self.path}: cannot write the archive: the folder {self.path.parent} does not exist")
        existed = self._partial.exists() and self._partial.stat().st_size > 0
        try:
            self._disk = TransactionFile(self._partial)
        except BlockingIOError as error:
            raise ArchiveError(
                f"{self._partial}: another run is writing this archive; wait for it, or stop it"
            ) from error
        except OSError as error:
            raise self._failure(error) from error
        try:
            if existed:
                self._take_over(root, identity, reuse)
            self._start(root, extra or {})
        except OSError as error:
            self.close()
            if not self.kept:
                self._partial.unlink(missing_ok=True)
            raise self._failure(error) from error
        except BaseException:
            self.close()
            raise

    def __enter__(self) -> ArchiveWriter:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()

    def write(self, path: str, group: Group) -> None:
        """Write a group at a path, replacing what is there, and take it to the disk.

        Args:
            path: place in the archive, such as "analyses/el_centro".
            group: what is written.

        Raises:
            ArchiveError: disk full or another failure; the archive is closed and holds what was written before.
        """
        try:
            self._put(path, group)
            self._commit()
        except OSError as error:
            self.close()
            raise self._failure(error) from error
        except BaseException:
            self.close()
            raise

    def has(self, path: str) -> bool:
        """Whether a group was written at a path, or is reused."""
        return path in self._open_file()

    def read(self, path: str) -> Group:
        """Read back a group that was written or is reused."""
        return read_group(self._open_file()[path])

    def finish(self, attributes: Mapping[str, object] | None = None) -> Path:
        """Mark the archive complete, give it its final name, and return the path.

        Args:
            attributes: last attributes of the root group, such as the status of the run.

        Raises:
            ArchiveError: the disk is full or the file cannot be renamed; the partial file stays.
        """
        file = self._open_file()
        try:
            write_group(file, Group(attributes=dict(attributes or {})))
            file.attrs["complete"] = 1
            self._commit()
            self.close()
            os.replace(self._partial, self.path)
            _sync_folder(self.path.parent)
        except OSError as error:
            self.close()
            raise self._failure(error) from error
        return self.path

    def discard(self) -> None:
        """Close and delete the partial file."""
        self.close()
        self._partial.unlink(missing_ok=True)

    def close(self) -> None:
        """Close and keep the partial file as the last transaction left it; does nothing a second time."""
        if self._file is not None:
            self._file.close()  # writes into memory only
            self._file = None
        self._disk.close()

    def _spare_other_files(self) -> None:
        """Refuse to replace what is not HDF5: a project file, a table, a device."""
        if not self.path.exists():
            return
        if not self.path.is_file():
            raise ArchiveError(f"{self.path}: cannot write the archive: it is not a regular file")
        try:
            ours = self.path.stat().st_size == 0 or h5py.is_hdf5(self.path)
        except OSError as error:
            raise self._failure(error) from error
        if not ours:
            raise ArchiveError(
                f"{self.path}: cannot write the archive: this file is no archive, and it is left as it is; "
                "choose another name"
            )

    def _open_file(self) -> h5py.File:
        if self._file is None:
            raise ArchiveError(f"{self._partial}: the archive is closed")
        return self._file

    def _commit(self) -> None:
        self._open_file().flush()
        self._disk.commit()

    def _put(self, path: str, group: Group) -> None:
        file = self._open_file()
        if path in file:
            del file[path]
        write_group(file.create_group(path), group)

    def _take_over(
        self, root: Group, identity: Sequence[str], reuse: Callable[[str, Mapping[str, object]], bool] | None
    ) -> None:
        """Open the earlier partial file if it belongs to the same project; else leave it to be overwritten."""
        if reuse is None:
            self.note = f"{self._partial.name}: results of an interrupted run discarded, as asked"
            return
        try:
            file = h5py.File(self._disk, "r+", libver=LIBRARY_VERSIONS)
        except (OSError, RuntimeError, ValueError):
            self.note = f"{self._partial.name}: an interrupted run left a damaged file; starting afresh"
            return
        old = {name: decode(file.attrs.get(name)) for name in (*identity, "edesign_archive")}
        new = {**{name: root.attributes.get(name) for name in identity}, "edesign_archive": FORMAT}
        different = [name for name in new if old[name] != new[name]]
        if different:
            file.close()
            names = ", ".join(name.replace("_", " ") for name in different)
            self.note = (
                f"{self._partial.name}: results of an interrupted run not used ({names} differ); starting afresh"
            )
            return
        kept = []
        for parent in [item for item in file.values() if isinstance(item, h5py.Group)]:
            for name, item in list(parent.items()):
                if not isinstance(item, h5py.Group):
                    continue
                place = f"{parent.name.strip('/')}/{name}"
                if reuse(place, read_attributes(item)):
                    kept.append(place)
                else:
                    del parent[name]
        self._file = file
        self.kept = tuple(kept)

    def _start(self, root: Group, extra: Mapping[str, Group]) -> None:
        if self._file is None:
            self._disk.truncate(0)
            self._disk.seek(0)
            self._file = h5py.File(self._disk, "w", libver=LIBRARY_VERSIONS)
        else:
            for name in [name for name, item in self._file.items() if isinstance(item, h5py.Dataset)]:
                del self._file[name]
            for name in list(self._file.attrs):
                del self._file.attrs[name]
        marks = {"edesign_archive": FORMAT, "complete": 0}
        write_group(self._file, Group(root.coords, root.variables, {**root.attributes, **marks}))
        for path, group in extra.items():
            self._put(path, group)
        self._commit()

    def _failure(self, error: OSError) -> ArchiveError:
        reasons = {
            errno.ENOSPC: "the disk is full",
            errno.EDQUOT: "the disk quota is used up",
            errno.EFBIG: "the file would exceed the allowed size",
            errno.EACCES: "no permission",
            errno.EPERM: "no permission",
            errno.EROFS: "the file system is read-only",
        }
        reason = reasons.get(error.errno or 0, error.strerror or str(error))
        return ArchiveError(f"{self.path}: cannot write the archive: {reason}")


def _sync_folder(folder: Path) -> None:
    """Make a rename durable; file systems that cannot do it are left as they are."""
    try:
        descriptor = os.open(folder, os.O_RDONLY)
    except OSError:
        return
    try:
        os.fsync(descriptor)
    except OSError:
        pass
    finally:
        os.close(descriptor)
