"""Write an archive: group by group into `NAME.h5.partial`, of which `NAME.h5` is made when the run is complete."""

from __future__ import annotations

import io
import os
import shutil
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import closing, contextmanager, suppress
from itertools import count
from pathlib import Path
from types import TracebackType
from typing import BinaryIO, TypeVar

import h5py

from edesign.archive.dataset import Group
from edesign.archive.files import is_hdf5, reason
from edesign.archive.hdf5 import LIBRARY_VERSIONS, image_of, join, put
from edesign.archive.pieces import PieceFile
from edesign.archive.seal import seal_of
from edesign.archive.tree import FORMAT, Tree
from edesign.errors import ArchiveError
from edesign.stopping import uninterrupted

Found = TypeVar("Found")
PARTIAL_SUFFIX = ".partial"
_ASIDE_SUFFIX = ".joining"  # no longer than the other, so that names that are too long are refused before a run
_MARGIN = 1 << 20  # bytes of the joined file beyond those of its parts


def partial_path(path: str | os.PathLike[str]) -> Path:
    """Return the path of an archive while it is not complete."""
    return Path(f"{os.fspath(path)}{PARTIAL_SUFFIX}")


class ArchiveWriter:
    """An archive that is being written.

    After every `write` the group is on the disk; a kill, a full disk or an error during it leaves the groups before
    it. Until `finish` they are in `NAME.h5.partial`, with the root attribute `complete` = 0, and an older `NAME.h5`
    stays untouched.

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
        on_rewrite: called with a line when the partial file was deleted and has been written again.

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
        self.on_rewrite: Callable[[str], None] = lambda line: None
        self.partial = partial_path(self.path)
        self._root = Group(root.coords, root.variables, {**root.attributes, "edesign_archive": FORMAT, "complete": 0})
        self._open = True
        try:
            self._check_place()
            existed = self.partial.exists() and self.partial.stat().st_size > 0
            self._disk = PieceFile(self.partial)
        except BlockingIOError as error:
            raise ArchiveError(
                f"{self.partial}: another run is writing this archive; wait for it, or stop it [E-ARCH-04]"
            ) from error
        except (OSError, ValueError) as error:  # ValueError: Python's for a null byte in a path
            raise self._failure(error) from error
        try:
            dropped = self._take_over(identity, reuse) if existed else ()
            added = {place: image_of(group) for place, group in {"": self._root, **(extra or {})}.items()}
            self._disk.append({**dict.fromkeys(dropped, b""), **added})
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

        Raises:
            ArchiveError: disk full or another failure; the archive is closed and holds what was written before.
        """
        self._check_open()
        with self._closed_on_failure():
            self._disk.append({path: image_of(group)})
            self._stay()

    def has(self, path: str) -> bool:
        """Return whether a group was written at a path, or is reused."""
        return path in self._disk.found.places

    @uninterrupted()
    def read(self, path: str) -> Group:
        """Read back a group that was written, or is reused and was verified."""
        self._check_open()
        return self._read(path, Tree.group)

    @uninterrupted()
    def finish(self, attributes: Mapping[str, object] | None = None) -> Path:
        """Join the groups to an archive that is complete, give it its final name, and return the path.

        It takes as much space as the partial file, which goes last.

        Args:
            attributes: last attributes of the root group, such as the status of the run.

        Raises:
            ArchiveError: the disk is full or the file cannot be renamed; the partial file stays.
        """
        self._check_open()
        self._root.attributes.update({**(attributes or {}), "complete": 1})
        places = self._disk.found.places

        def fill(file: h5py.File) -> None:
            join(file, self._root, ((place, self._disk.image(place)) for place in places if place))

        with self._closed_on_failure():
            self._stay()
            self._check_place()
            with io.BytesIO() as empty:
                h5py.File(empty, "w", libver=LIBRARY_VERSIONS).close()
                _complete(self.path, empty, self._disk.found.end + _MARGIN, fill)
            self.discard()
        return self.path

    @uninterrupted()
    def discard(self) -> None:
        """Close and delete the partial file, and no other that has taken its place."""
        with suppress(OSError):
            if self._disk.is_at(self.partial):
                self.partial.unlink()
        self.close()

    def close(self) -> None:
        """Close and keep the partial file as it is; does nothing a second time."""
        self._open = False
        self._disk.close()

    def _check_place(self) -> None:
        """Refuse a place that cannot be written to, or holds what is not HDF5: a project file, a table, a device.

        Raises:
            OSError: of the file system.
            ArchiveError: everything else.
        """
        if self.path.is_dir():
            raise ArchiveError(f"{self.path}: cannot write the archive: it is a folder [E-FILE-06]")
        if not self.path.parent.is_dir():
            raise ArchiveError(
                f"{self.path}: cannot write the archive: the folder {self.path.parent} does not exist [E-FILE-06]"
            )
        for place in (self.path, self.partial, _aside(self.path)):
            if not place.exists():
                continue
            if not place.is_file():
                raise ArchiveError(f"{place}: cannot write the archive: it is not a regular file [E-FILE-06]")
            lost = place != self.path and _was_never_written(place)
            if place.stat().st_size and not lost and not is_hdf5(place):
                raise ArchiveError(
                    f"{place}: cannot write the archive: this file is no archive, and it is left as it is; "
                    "choose another name [E-FILE-07]"
                )

    def _check_open(self) -> None:
        if not self._open:
            raise ArchiveError(f"{self.partial}: the archive is closed [E-ARCH-06]")

    def _stay(self) -> None:
        """See to it that the partial file is still where it was put, as a run may take hours.

        One that was deleted is written again from what the open file still holds. Another one in its place is left
        as it is.

        Raises:
            ArchiveError: it is elsewhere now; `partial` says where.
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
                raise ArchiveError(
                    f"{place}: the folder {folder} was renamed or removed during the run [E-ARCH-06]"
                ) from None
            folder.mkdir(parents=True, exist_ok=True)
            self._disk.write_again(place)
            self.on_rewrite(f"{place.name} was deleted during the run, and was written again")
            return
        self.partial = self._free_name()
        self._disk.write_again(self.partial)
        raise ArchiveError(f"{place}: another file has taken the place of this one during the run [E-ARCH-06]")

    def _free_name(self) -> Path:
        names = (partial_path(f"{self.path}.{number}") for number in count(1))
        return next(name for name in names if not os.path.lexists(name))

    def _take_over(
        self, identity: Sequence[str], reuse: Callable[[str, Mapping[str, object]], bool] | None
    ) -> tuple[str, ...]:
        """Keep the groups of the earlier partial file that are reused, and return the places of the others.

        It is emptied if it is damaged, or not of the same project.
        """
        found, fresh = self._disk.found, "starting afresh"
        if reuse is None:
            self.note = f"{self.partial.name}: results of an interrupted run discarded, as asked"
        elif found.damage or (not found.places and not is_hdf5(self.partial)):
            self.note = f"{self.partial.name}: an interrupted run left a damaged file; {fresh}"
        else:
            old = self._read("", Tree.attributes) if found.places else {}
            new = {name: self._root.attributes.get(name) for name in (*identity, "edesign_archive")}
            different = [name.replace("_", " ") for name in new if old.get(name) != new[name]]
            if not different:
                return self._keep(reuse)
            why = f"{', '.join(different)} {'differs' if len(different) == 1 else 'differ'}" if old else "another form"
            self.note = f"{self.partial.name}: results of an interrupted run not used ({why}); {fresh}"
        self._disk.clear()
        return ()

    def _keep(self, reuse: Callable[[str, Mapping[str, object]], bool]) -> tuple[str, ...]:
        """Find what is reused, two groups deep with all below, and return the places of what is not."""
        places = [place for place in self._disk.found.places if "/" in place]
        heads = dict.fromkeys("/".join(place.split("/")[:2]) for place in places)
        found = {head: self._read(head, Tree.attributes) if head in places else {} for head in heads}
        order = sorted(heads, key=lambda head: (head.split("/")[0], found[head].get("order", 0), head))
        self.kept = tuple(head for head in order if reuse(head, found[head]))
        return tuple(place for place in places if "/".join(place.split("/")[:2]) not in self.kept)

    def _read(self, place: str, read: Callable[[Tree, str], Found]) -> Found:
        image = self._disk.image(place)
        with h5py.File(io.BytesIO(image), "r") as file:
            return read(Tree(file, len(image), trusted=True), "")

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
        return ArchiveError(f"{self.path}: cannot write the archive: {words} [E-FILE-06]")


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
    marks = {"edesign_archive": FORMAT, "complete": 1}
    renewed = Group(root.coords, root.variables, {**root.attributes, **attributes, **marks})

    def fill(file: h5py.File) -> None:
        if file.attrs.get("edesign_archive") != FORMAT:
            raise ArchiveError(
                f"{path}: cannot renew its head: it has another layout; it is left as it was [E-ARCH-02]"
            )
        for name in [name for name, item in file.items() if isinstance(item, h5py.Dataset) or name in others]:
            del file[name]
        for name in list(file.attrs):
            del file.attrs[name]
        put(file, renewed)
        for place, group in others.items():
            put(file.create_group(place), group)

    try:
        with closing(PieceFile(partial_path(path))), Path(path).open("rb") as old:  # no run writes it meanwhile
            try:
                _complete(Path(path), old, os.path.getsize(path) + _MARGIN, fill)
            finally:
                partial_path(path).unlink()
    except OSError as error:
        raise ArchiveError(f"{path}: cannot write the archive: {reason(error)} [E-FILE-06]") from error


def _complete(path: Path, source: BinaryIO, size: int, fill: Callable[[h5py.File], None]) -> None:
    """Write a complete archive beside its place, seal it, and put it there.

    Args:
        source: a file of HDF5 that is copied first.
        size: that the archive has at most, bytes. So much is reserved, as HDF5 does not bear a disk that becomes full.
        fill: changes the copy.
    """
    aside = _aside(path)
    aside.unlink(missing_ok=True)  # left by a kill
    try:
        with aside.open("x+b") as file:
            source.seek(0)
            shutil.copyfileobj(source, file)
            file.flush()
            if sys.platform != "darwin":
                os.posix_fallocate(file.fileno(), 0, size)
            with h5py.File(file, "r+", libver=LIBRARY_VERSIONS) as target:
                fill(target)
            file.write(seal_of(file, file.seek(0, os.SEEK_END)))
            file.flush()
            os.fsync(file.fileno())
        os.replace(aside, path)
    except BaseException:
        aside.unlink(missing_ok=True)
        raise
    _sync_folder(path.parent)


def _aside(path: Path) -> Path:
    return Path(f"{path}{_ASIDE_SUFFIX}")


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
