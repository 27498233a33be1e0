"""Read an archive, complete or partial."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from pathlib import Path
from types import TracebackType
from typing import TypeVar

import h5py

from edesign.archive.dataset import Group
from edesign.archive.files import reason
from edesign.archive.global_heap import broken_collections, disable
from edesign.archive.seal import sealed_size
from edesign.archive.transaction import TransactionFile, between_commits
from edesign.archive.tree import Damaged, Tree
from edesign.archive.writer import FORMAT, PARTIAL_SUFFIX, partial_path
from edesign.errors import ArchiveError, EdesignError

Found = TypeVar("Found")
BROKEN_SEAL = "it is not as it was written (its seal does not fit)"
NAMED = 5  # damaged groups that a message names
TRIES = 5  # of reading an archive that changes meanwhile
PAUSE = 0.1  # s between them; a run writes a group in less


class DamagedArchive(ArchiveError):
    """An archive is damaged, or holds what no archive can contain.

    Attributes:
        changed: whether the file changed while it was read, as a partial archive does while its run goes on.
    """

    def __init__(self, message: str, changed: bool = False) -> None:
        super().__init__(message)
        self.changed = changed


class Archive:
    """An open archive; usable in a `with` statement.

    A complete archive has a seal, and none of it is read before the seal is found right. What has none, a partial
    archive or one of layout 1, is verified group by group as it is read.

    Args:
        path: `NAME.h5`, or `NAME.h5.partial` of a run that goes on or was interrupted.
        damaged: open a damaged archive too; every group is then read once, and those that cannot be are left out.

    Attributes:
        path: the file.
        attributes: those of the root group (title, status, versions, checksum ...).
        damage: why each group that cannot be read is left out, by its place; {} unless `damaged`.
        sealed: whether a seal has told that every byte of the file is as it was written.

    Raises:
        ArchiveError: missing, unreadable, damaged, or not an archive of edesign.
    """

    def __init__(self, path: str | os.PathLike[str], damaged: bool = False) -> None:
        self.path = Path(path)
        self.damage: dict[str, str] = {}
        self._fault = ""
        self._readable = 0
        self._file: h5py.File | None = None
        self._memory: TransactionFile | None = None
        try:
            self._check_file()
            with between_commits(self.path):
                self._state = _state(self.path)
                self.sealed, broken = _verify(self.path)
                self._file = self._open(broken, damaged)
        except OSError as error:
            raise ArchiveError(f"{self.path}: cannot read the archive: {reason(error)}") from error
        except BaseException:
            self.close()
            raise
        try:
            self._tree = Tree(self._file, self._state[1], self.sealed)
            self.attributes = self._tree.attributes("")
            self._check(damaged)
        except Damaged as error:
            self.close()
            raise self._damaged(error) from error
        except BaseException:
            self.close()
            raise

    def __enter__(self) -> Archive:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()

    @property
    def complete(self) -> bool:
        """Whether the run that wrote the archive came to its end."""
        return str(self.attributes.get("complete")) == "1"  # a text too, as a damaged archive may have anything there

    @property
    def changed(self) -> bool:
        """Whether the file has changed since it was opened, as a partial archive does while its run goes on."""
        try:
            return _state(self.path) != self._state
        except OSError:
            return True

    def has(self, path: str) -> bool:
        """Whether there is a group at a path that can be read."""
        try:
            return path.strip("/") not in self.damage and self._tree.has(path)
        except Damaged as error:
            if error.place in self.damage:
                return False
            raise self._damaged(error) from error

    def names(self, path: str = "/") -> list[str]:
        """Return the names of the groups below a path, by attribute `order`, then name; [] if it is not there.

        Raises:
            ArchiveError: it, or one of them, is damaged.
        """
        place = path.strip("/")
        if not self.has(place):
            return []
        try:
            return self._tree.groups(place, self.damage)
        except Damaged as error:
            raise self._damaged(error) from error

    def group_attributes(self, path: str) -> dict[str, object]:
        """Return only the attributes of a group.

        Raises:
            ArchiveError: there is no such group, or it is damaged.
        """
        return self._found(path, self._tree.attributes)

    def group(self, path: str = "/") -> Group:
        """Read a group with all its variables, without its subgroups.

        Raises:
            ArchiveError: there is no such group, or it is damaged.
        """
        return self._found(path, self._tree.group)

    def close(self) -> None:
        """Close the file."""
        if self._file is not None:
            self._file.close()
        if self._memory is not None:
            self._memory.close()

    def damage_in_short(self) -> str:
        """Return one line on how much of a damaged archive can be read; "" unless something is damaged."""
        if not self.damage and not self._fault:
            return ""
        count = f"{self._readable} of {self._readable + len(self.damage)} groups can be read"
        return f"The archive is damaged: {self._fault}{count}."

    def describe_damage(self) -> str:
        """Return what is damaged and what can be read, with a line for each of the first damaged groups; or ""."""
        if not self.damage_in_short():
            return ""
        told = [f"\n  {place or 'the root'}: {why}" for place, why in list(self.damage.items())[:NAMED]]
        if len(self.damage) > NAMED:
            told.append(f"\n  and {len(self.damage) - NAMED} more")
        return f"{self.path}: {self.damage_in_short()}{''.join(told)}"

    def _found(self, path: str, read: Callable[[str], Found]) -> Found:
        place = path.strip("/")
        if place in self.damage:
            raise self._damaged(Damaged(place, self.damage[place]))
        if not self.has(place):
            parent = path.rpartition("/")[0] or "/"
            have = ", ".join(self.names(parent)) or "none"
            raise ArchiveError(f"{self.path}: there is no {path}; below {parent} there are: {have}")
        try:
            return read(place)
        except Damaged as error:
            raise self._damaged(error) from error

    def _check_file(self) -> None:
        if self.path.is_file():
            return
        if self.path.is_dir():
            raise ArchiveError(f"{self.path}: this is a folder, not an archive")
        if self.path.exists():
            raise ArchiveError(f"{self.path}: this is not a regular file, so no archive")
        partial = partial_path(self.path)
        hint = f"; an incomplete one is there: {partial}" if partial.exists() else ""
        raise ArchiveError(f"{self.path}: no such archive{hint}")

    def _open(self, broken: list[int], damaged: bool) -> h5py.File:
        """Open the file.

        A complete archive never changes. A partial one is read as it is now: a copy of it in memory. Where texts
        cannot be read without harm, or bytes are missing, the copy is without them.
        """
        try:
            if broken or (damaged and not self.sealed):
                self._memory = _mended(self.path, broken)
                return h5py.File(self._memory, "r")
            if self.path.suffix == PARTIAL_SUFFIX and not self.sealed:
                return h5py.File(self.path, "r", driver="core", backing_store=False, locking=False)
            try:
                return h5py.File(self.path, "r", locking=False)
            except OSError as error:
                if "locking flag" not in str(error):
                    raise
                # open in this process already, with a lock, as xarray does: HDF5 wants the same
                return h5py.File(self.path, "r")
        except (OSError, RuntimeError, ValueError) as error:
            raise DamagedArchive(f"{self.path}: not an HDF5 file, or damaged", self.changed) from error

    def _check(self, damaged: bool) -> None:
        found = self._tree.layout
        if found not in (1, FORMAT):
            what = "an HDF5 file, but not an archive of edesign" if found is None else f"an archive of layout {found}"
            raise ArchiveError(f"{self.path}: this is {what}; this version reads layouts 1 to {FORMAT}")
        if not self.sealed and found != 1 and self.complete and self.path.suffix != PARTIAL_SUFFIX:
            if not damaged:
                raise DamagedArchive(f"{self.path}: the archive is damaged: {BROKEN_SEAL}", self.changed)
            self._fault = f"{BROKEN_SEAL}; "
        if not damaged and not self.sealed:
            self._tree.group("")  # what is told of the whole archive stands there
        if damaged:
            for place in self._tree.places():
                try:
                    self._tree.group(place)
                    self._readable += 1
                except Damaged as error:
                    self.damage[place] = error.why

    def _damaged(self, error: Damaged) -> DamagedArchive:
        return DamagedArchive(f"{self.path}: the archive is damaged: {error}", self.changed)


def open_archive(path: str | os.PathLike[str], damaged: bool = False) -> Archive:
    """Open an archive for reading.

    Args:
        path: `NAME.h5` or `NAME.h5.partial`.
        damaged: open a damaged archive too, without what cannot be read of it; see `Archive.damage`.

    Returns:
        The open archive; close it, or use it in a `with` statement.

    Raises:
        ArchiveError: missing, unreadable, damaged, or not an archive of edesign.
    """
    return Archive(path, damaged)


def read_archive(path: str | os.PathLike[str], use: Callable[[Archive], Found]) -> tuple[Found, str]:
    """Use an archive, and of a damaged one what can be read.

    Args:
        path: `NAME.h5` or `NAME.h5.partial`.
        use: is handed the open archive, a second time if it proves to be damaged.

    Returns:
        What `use` returned; one line on the damage, "" for a whole archive.

    Raises:
        ArchiveError: nothing can be read.
    """
    for _ in range(TRIES):
        try:
            return _use(path, use, damaged=False)
        except DamagedArchive as error:
            if not error.changed:
                break
            time.sleep(PAUSE)
    return _use(path, use, damaged=True)


def _use(path: str | os.PathLike[str], use: Callable[[Archive], Found], damaged: bool) -> tuple[Found, str]:
    with Archive(path, damaged) as archive:
        told = archive.describe_damage()
        try:
            return use(archive), told
        except (DamagedArchive, OSError):
            raise
        except EdesignError as error:
            if not told:
                raise
            raise ArchiveError(f"{told}\n  nothing of it can be shown: {error}") from error
        except Exception as error:
            if archive.sealed:
                raise  # what edesign wrote, edesign reads: its own mistake
            what = f"its content does not fit together ({type(error).__name__}: {error})"
            message = f"{told}\n  {what}" if told else f"{archive.path}: the archive is damaged: {what}"
            raise DamagedArchive(message, archive.changed) from error


def _verify(path: Path) -> tuple[bool, list[int]]:
    """Return whether a file has its seal, and if not, the broken collections of its global heap."""
    with path.open("rb") as file:
        if sealed_size(file) is not None:
            return True, []
        return False, broken_collections(file)


def _mended(path: Path, broken: list[int]) -> TransactionFile:
    """Return a file in memory in which broken collections are none, and bytes that were cut off are zeros."""
    file = TransactionFile(path, read_only=True)
    file.load()
    file.truncate(max(file.size, _named_end(file)))
    disable(file, broken)
    return file


def _named_end(file: TransactionFile) -> int:
    """Return the end that the superblock (version 2, lengths of 8 bytes) names; its checksum is HDF5's matter."""
    file.seek(28)
    return int.from_bytes(file.read(8), "little")


def _state(path: Path) -> tuple[int, int, int]:
    found = path.stat()
    return found.st_ino, found.st_size, found.st_mtime_ns
