"""Write an archive: group by group into `NAME.h5.partial`, which becomes `NAME.h5` only when the run is complete."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from itertools import count
from pathlib import Path
from types import TracebackType

import h5py

from edesign.archive.dataset import Group
from edesign.archive.files import is_hdf5, reason
from edesign.archive.global_heap import broken_collections, disable
from edesign.archive.hdf5 import LIBRARY_VERSIONS, write_attributes, write_group
from edesign.archive.opening import PARTIAL_SUFFIX
from edesign.archive.seal import seal_of, sealed_size
from edesign.archive.survey import survey
from edesign.archive.transaction import TransactionFile
from edesign.archive.tree import FORMAT, Damaged, Tree
from edesign.errors import ArchiveError
from edesign.stopping import uninterrupted


def partial_path(path: str | os.PathLike[str]) -> Path:
    """Return the path of an archive while it is not complete."""
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
        partial: where the archive lies while it is not complete.
        tell: called with a line when the partial file was deleted and has been written again.

    Raises:
        ArchiveError: the folder is missing or unwritable, the disk is full, another run writes the same archive, or
            the path is that of a file of another kind.
    """

    @uninterrupted()
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
        self.tell: Callable[[str], None] = lambda line: None
        self.partial = partial_path(self.path)
        self._file: h5py.File | None = None
        try:
            self._check_place()
            existed = self.partial.exists() and self.partial.stat().st_size > 0
            self._disk = TransactionFile(self.partial)
        except BlockingIOError as error:
            raise ArchiveError(
                f"{self.partial}: another run is writing this archive; wait for it, or stop it"
            ) from error
        except (OSError, ValueError) as error:  # ValueError: Python's for a null byte in a path
            raise self._failure(error) from error
        try:
            if existed:
                self._take_over(root, identity, reuse)
            self._start(root, extra or {})
        except OSError as error:
            self.close()
            if not self.kept:
                self.partial.unlink(missing_ok=True)
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

    @uninterrupted()
    def write(self, path: str, group: Group) -> None:
        """Write a group at a path, in place of an earlier one, and commit it to the disk.

        Args:
            path: place in the archive, such as "analyses/el_centro".
            group: what is written.

        Raises:
            ArchiveError: disk full or another failure; the archive is closed and holds what was written before.
        """
        with self._closed_on_failure():
            self._put(path, group)
            self._commit()

    @uninterrupted()
    def has(self, path: str) -> bool:
        """Return whether a group was written at a path, or is reused."""
        return path in self._open_file()

    @uninterrupted()
    def read(self, path: str) -> Group:
        """Read back a group that was written, or is reused and was verified."""
        return Tree(self._open_file(), self._disk.size, trusted=True).group(path)

    @uninterrupted()
    def finish(self, attributes: Mapping[str, object] | None = None) -> Path:
        """Mark the archive complete, give it its final name, and return the path.

        Args:
            attributes: last attributes of the root group, such as the status of the run.

        Raises:
            ArchiveError: the disk is full or the file cannot be renamed; the partial file stays.
        """
        file = self._open_file()
        self._root.attributes.update({**(attributes or {}), "complete": 1})
        with self._closed_on_failure():
            write_attributes(file, self._root)
            self._commit()
            seal = seal_of(self._disk, self._disk.size)
            self._disk.seek(0, os.SEEK_END)
            self._disk.write(seal)
            self._disk.commit()
            self._stay()
            self._check_place()
            self.close()
            os.replace(self.partial, self.path)
            _sync_folder(self.path.parent)
        return self.path

    @uninterrupted()
    def discard(self) -> None:
        """Close and delete the partial file, and no other that has taken its place."""
        with suppress(OSError):
            if self._disk.is_at(self.partial):
                self.partial.unlink()
        self.close()

    @uninterrupted()
    def close(self) -> None:
        """Close and keep the partial file as the last transaction left it; does nothing a second time."""
        if self._file is not None:
            self._file.close()  # writes into memory only
            self._file = None
        self._disk.close()

    def _check_place(self) -> None:
        """Refuse a place that cannot be written to, or holds what is not HDF5: a project file, a table, a device.

        Raises:
            OSError: of the file system.
            ArchiveError: everything else.
        """
        if self.path.is_dir():
            raise ArchiveError(f"{self.path}: cannot write the archive: it is a folder")
        if not self.path.parent.is_dir():
            raise ArchiveError(f"{self.path}: cannot write the archive: the folder {self.path.parent} does not exist")
        for place in (self.path, self.partial):
            if not place.exists():
                continue
            if not place.is_file():
                raise ArchiveError(f"{place}: cannot write the archive: it is not a regular file")
            lost = place == self.partial and _was_never_written(place)
            if place.stat().st_size and not lost and not is_hdf5(place):
                raise ArchiveError(
                    f"{place}: cannot write the archive: this file is no archive, and it is left as it is; "
                    "choose another name"
                )

    def _open_file(self) -> h5py.File:
        if self._file is None:
            raise ArchiveError(f"{self.partial}: the archive is closed")
        return self._file

    def _commit(self) -> None:
        self._open_file().flush()
        self._disk.commit()
        self._stay()

    def _stay(self) -> None:
        """See to it that the partial file is still where it was put, as a run may take hours.

        One that was deleted is written again from what the open file still holds. Another one in its place is left
        as it is.

        Raises:
            ArchiveError: it is elsewhere now; `partial` tells where.
            OSError: it cannot be written again.
        """
        place, folder = self.partial, self.partial.parent
        try:
            if self._disk.is_at(place):
                return
        except (FileNotFoundError, NotADirectoryError):
            now = self._disk.path
            if now is not None and not folder.is_dir():
                self.partial = now
                raise ArchiveError(f"{place}: the folder {folder} was renamed or removed during the run") from None
            folder.mkdir(parents=True, exist_ok=True)
            self._disk.write_again(place)
            self.tell(f"{place.name} was deleted during the run, and was written again")
            return
        self.partial = self._free_name()
        self._disk.write_again(self.partial)
        raise ArchiveError(f"{place}: another file has taken the place of this one during the run")

    def _free_name(self) -> Path:
        names = (partial_path(f"{self.path}.{number}") for number in count(1))
        return next(name for name in names if not os.path.lexists(name))

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
            self.note = f"{self.partial.name}: results of an interrupted run discarded, as asked"
            return
        file: h5py.File | None = None
        try:
            if damage := survey(self.partial).damage:
                raise Damaged(*next(iter(damage.items())))
            disable(self._disk, broken_collections(self._disk))
            file = h5py.File(self._disk, "r+", libver=LIBRARY_VERSIONS)
            tree = Tree(file, self._disk.size, trusted=False)
            old = tree.attributes("")
            new = {**{name: root.attributes.get(name) for name in identity}, "edesign_archive": FORMAT}
            different = [name for name in new if old.get(name) != new[name]]
            if different:
                names = ", ".join(name.replace("_", " ") for name in different)
                verb = "differs" if len(different) == 1 else "differ"
                self.note = (
                    f"{self.partial.name}: results of an interrupted run not used ({names} {verb}); starting afresh"
                )
                file.close()
                return
            self.kept = self._keep(file, tree, reuse)
            self._file = file
        except (Damaged, OSError, RuntimeError, ValueError):
            self.note = f"{self.partial.name}: an interrupted run left a damaged file; starting afresh"
            if file is not None:
                file.close()

    def _keep(self, file: h5py.File, tree: Tree, reuse: Callable[[str, Mapping[str, object]], bool]) -> tuple[str, ...]:
        """Delete the groups that are not reused, once all others are found as they were written.

        Raises:
            Damaged: one is not.
        """
        places = [f"{parent}/{name}" for parent in tree.groups("") for name in tree.groups(parent)]
        found = {place: tree.group(place).attributes for place in places}
        kept = tuple(place for place in places if reuse(place, found[place]))
        for place in places:
            if place not in kept:
                del file[place]
        return kept

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
        self._root = Group(root.coords, root.variables, {**root.attributes, **marks})
        write_group(self._file, self._root)
        for path, group in extra.items():
            self._put(path, group)
        self._commit()

    @contextmanager
    def _closed_on_failure(self) -> Iterator[None]:
        """Close the file if anything fails, and turn an error of the disk into an ArchiveError."""
        try:
            yield
        except OSError as error:
            self.close()
            raise self._failure(error) from error
        except BaseException:
            self.close()
            raise

    def _failure(self, error: OSError | ValueError) -> ArchiveError:
        words = reason(error) if isinstance(error, OSError) else str(error)
        return ArchiveError(f"{self.path}: cannot write the archive: {words}")


def renew_root(
    path: str | os.PathLike[str], root: Group, others: Mapping[str, Group], attributes: Mapping[str, object]
) -> None:
    """Replace the root group of a complete archive, and some other groups; all else stays as it is.

    It is done in a copy that takes the place of the archive at the end, so a failure leaves the archive as it was.

    Args:
        path: the archive, `NAME.h5`, with its seal.
        root: attributes and variables of the root group.
        others: further groups by path.
        attributes: last attributes of the root group, as of `ArchiveWriter.finish`.

    Raises:
        ArchiveError: the archive cannot be read, the disk is full, or another failure.
    """
    partial = partial_path(path)
    try:
        with Path(path).open("rb") as archive, partial.open("xb") as copy:
            try:
                size = sealed_size(archive)
                archive.seek(0)
                shutil.copyfileobj(archive, copy)
                copy.truncate(size)
            except BaseException:
                partial.unlink(missing_ok=True)
                raise
    except OSError as error:
        raise ArchiveError(f"{path}: cannot write the archive: {reason(error)}") from error
    with ArchiveWriter(path, root, (), lambda place, found: place not in others, others) as writer:
        if writer.note:  # the copy was not taken over: finished, it would be an archive without results
            writer.discard()
            raise ArchiveError(f"{path}: cannot renew its head: its copy could not be read back; it is left as it was")
        writer.finish(attributes)


def _was_never_written(partial: Path) -> bool:
    """Whether the first page never came to the disk, as a power failure may leave a partial file."""
    with partial.open("rb") as file:
        return not any(file.read(8))


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
