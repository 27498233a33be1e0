"""Read an archive, complete or partial."""

from __future__ import annotations

import os
import shlex
from collections.abc import Callable
from pathlib import Path
from types import TracebackType
from typing import Self, TypeVar

from edesign.archive.dataset import Group, StoredVariable, Unread, Variable
from edesign.archive.files import reason
from edesign.archive.opening import Opened, open_file
from edesign.archive.tree import FORMAT, Damaged
from edesign.archive.writer import PARTIAL_SUFFIX, partial_path
from edesign.errors import ArchiveError, EdesignError, split_code
from edesign.file_kinds.kinds import ARCHIVE
from edesign.file_kinds.recognise import foreign_kind, kind_of, other_kind

Found = TypeVar("Found")
NAMED = 5  # damaged groups that a message names


class DamagedArchive(ArchiveError):
    """An archive is damaged, or has content that no archive can have."""


class Archive:
    """An open archive; usable in a `with` statement.

    A complete archive has a seal, and each group of a partial one its checksum; what these do not find right is not
    read. A damaged archive, or one of layout 1, is verified group by group instead.

    Args:
        path: `NAME.h5`, or `NAME.h5.partial` of a run that goes on or was interrupted.
        damaged: open a damaged archive too; groups that cannot be read are left out.

    Attributes:
        path: the file.
        attributes: those of the root group (title, status, versions, checksum ...).
        damage: why each group that cannot be read is left out, by its place.
        sealed: whether checksums have shown that every byte of its groups is as it was written.

    Raises:
        ArchiveError: missing, unreadable, damaged, or not an archive of edesign.
    """

    def __init__(self, path: str | os.PathLike[str], damaged: bool = False) -> None:
        self.path = Path(path)
        self.damage: dict[str, str] = {}
        self._readable = 0
        self._fault = ""
        self._opened: Opened | None = None
        self._closed = False
        try:
            self._check_file()
            self._opened = open_file(self.path)
            self._tree, self.sealed = self._opened.tree, self._opened.sealed
            self.damage, self._readable = self._opened.damage, self._opened.readable
            self.attributes = self._tree.attributes("")
            self._check(damaged)
        except OSError as error:
            self.close()
            raise ArchiveError(f"{self.path}: cannot read the archive: {reason(error)} [E-FILE-02]") from error
        except Damaged as error:
            self.close()
            raise self._damaged(error) from error
        except BaseException:
            self.close()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()

    @property
    def complete(self) -> bool:
        """Whether the run that wrote the archive was completed."""
        return str(self.attributes.get("complete")) == "1"  # a text too, as a damaged archive may have anything there

    def has(self, path: str) -> bool:
        """Return whether a readable group is at a path."""
        place = path.strip("/")
        try:
            return not self.lost(place) and self._tree.has(place)
        except Damaged as error:
            raise self._damaged(error) from error

    def lost(self, path: str) -> str:
        """Return why a group of a damaged archive cannot be read, "" if it can."""
        place = path.strip("/")
        while place and place not in self.damage:
            place = place.rpartition("/")[0]
        return self.damage.get(place, "") if place or not path.strip("/") else ""

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
        """Return the attributes of a group without reading its variables.

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

    def view(self, path: str = "/") -> Group:
        """Return a group whose variables are each read on their first access; otherwise as `group`.

        Values are read first, unit and long name when these are asked for.

        What is asked for must be so while the archive is open. Of an archive without a seal all is read at once,
        as only then the checksum of the group shows whether it is as it was written.

        Raises:
            ArchiveError: there is no such group, it is damaged, or a variable is asked for after the archive was
                closed.
        """
        return self._found(path, self._view if self.sealed else self._tree.group)

    def _view(self, place: str) -> Group:
        dims = self._tree.dimensions(place)

        def asked(name: str, read: Callable[[str, str], Found]) -> Found:
            if self._closed:
                raise ArchiveError(
                    f"{self.path}: {name} of {place} is asked for after the archive was closed [E-ARCH-06]"
                )
            try:
                return read(place, name)
            except Damaged as error:
                raise self._damaged(error) from error

        def variable(name: str) -> Variable:
            values = asked(name, self._tree.values)
            return StoredVariable(dims[name], values, lambda: asked(name, self._tree.labels))

        along = {name: own for name, own in dims.items() if own == (name,)}
        others = {name: own for name, own in dims.items() if name not in along}
        return Group(Unread(along, variable), Unread(others, variable), self._tree.attributes(place))

    def seen_through(self, lens: Callable[[Group], Group]) -> Archive:
        """Return this archive with its groups as a function shows them; it is closed with this one.

        Args:
            lens: gives the group to be seen for one that is read.
        """
        return _Seen(self, lens)

    def close(self) -> None:
        """Close the file."""
        self._closed = True
        if self._opened is not None:
            self._opened.tree.file.close()

    def damage_in_short(self) -> str:
        """Return one line on how much of a damaged archive can be read; "" unless it is damaged."""
        if not self.damage and not self._fault:
            return ""
        count = f"{self._readable} of {self._readable + len(self.damage)} groups can be read"
        return f"The archive is damaged: {self._fault}{count}."

    def describe_damage(self) -> str:
        """Return the damage and the readable part in lines, with the first damaged groups; "" unless it is damaged."""
        if not self.damage_in_short():
            return ""
        damage = [f"\n  {place or 'the root'}: {why}" for place, why in list(self.damage.items())[:NAMED]]
        if len(self.damage) > NAMED:
            damage.append(f"\n  and {len(self.damage) - NAMED} more")
        return f"{self.path}: {self.damage_in_short()}{''.join(damage)}"

    def _found(self, path: str, read: Callable[[str], Found]) -> Found:
        place = path.strip("/")
        if self.lost(place):
            raise self._damaged(Damaged(place, self.lost(place)))
        if not self.has(place):
            parent = path.rpartition("/")[0] or "/"
            have = ", ".join(self.names(parent)) or "none"
            raise ArchiveError(f"{self.path}: there is no {path}; below {parent} there are: {have} [E-ARCH-07]")
        try:
            return read(place)
        except Damaged as error:
            raise self._damaged(error) from error

    def _check_file(self) -> None:
        if self.path.is_file():
            kind = kind_of(self.path)
            if kind is None:
                kind = foreign_kind(self.path)
            if kind not in (None, ARCHIVE):
                raise ArchiveError(other_kind(self.path, kind, "archive"))
            return
        if self.path.is_dir():
            raise ArchiveError(f"{self.path}: this is a folder, not an archive [E-ARCH-01]")
        if self.path.exists():
            raise ArchiveError(f"{self.path}: this is not a regular file, so no archive [E-ARCH-01]")
        partial = partial_path(self.path)
        hint = f"; an incomplete one is there: {partial}" if partial.exists() else ""
        raise ArchiveError(f"{self.path}: no such archive{hint} [E-ARCH-01]")

    def _check(self, damaged: bool) -> None:
        found = self._tree.layout
        if found not in range(1, FORMAT + 1):
            what = "an HDF5 file, but not an archive of edesign" if found is None else f"an archive of layout {found}"
            raise ArchiveError(f"{self.path}: this is {what}; this version reads layouts 1 to {FORMAT} [E-ARCH-02]")
        if not self.sealed and found != 1 and self.complete and self.path.suffix != PARTIAL_SUFFIX:
            self._fault = "it is not as it was written (its seal does not fit); "
        if not damaged and self.damage_in_short():
            raise DamagedArchive(f"{self.describe_damage()} [E-ARCH-03]")

    def _damaged(self, error: Damaged) -> DamagedArchive:
        return DamagedArchive(f"{self.path}: the archive is damaged: {error} [E-ARCH-03]")


class _Seen(Archive):
    """An archive whose groups a function shows."""

    def __init__(self, whole: Archive, lens: Callable[[Group], Group]) -> None:
        self.__dict__.update(whole.__dict__)
        self._whole, self._lens = whole, lens

    def group(self, path: str = "/") -> Group:
        return self._lens(self._whole.group(path))

    def view(self, path: str = "/") -> Group:
        return self._lens(self._whole.view(path))


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


def refuse_calibration(archive: Archive) -> None:
    """Refuse the archive of a calibration, whose verdict, effects and law are in the files beside it.

    Raises:
        ArchiveError: it is one.
    """
    if archive.attributes.get("kind") == "calibration":
        page = archive.path.with_name("calibration.html")
        report = f"its report is {page}" if page.is_file() else f"there is no report {page}, which `calibrate` writes"
        raise ArchiveError(
            f"{archive.path}: this archive has the motions and forces of a calibration; {report}. "
            f"`edesign export {shlex.quote(str(archive.path))} --histories '*'` writes them as tables [E-ARCH-08]"
        )


def read_archive(path: str | os.PathLike[str], use: Callable[[Archive], Found]) -> tuple[Found, str]:
    """Call a function with an open archive, of a damaged one with its readable part.

    Args:
        path: `NAME.h5` or `NAME.h5.partial`.
        use: is handed the open archive.

    Returns:
        What `use` returned; one line on the damage, "" for a whole archive.

    Raises:
        ArchiveError: nothing can be read.
    """
    with Archive(path, damaged=True) as archive:
        damage = archive.describe_damage()
        return _used(archive, use, damage), damage


def _used(archive: Archive, use: Callable[[Archive], Found], damage: str) -> Found:
    try:
        return use(archive)
    except (DamagedArchive, OSError):
        raise
    except EdesignError as error:
        if not damage:
            raise
        why, _ = split_code(str(error))
        raise ArchiveError(f"{damage}\n  nothing of it can be shown: {why} [E-ARCH-03]") from error
    except Exception as error:
        if archive.sealed and not damage:
            raise  # what edesign wrote, edesign reads: its own mistake
        what = f"its content does not fit together ({type(error).__name__}: {error})"
        place = f"{damage}\n " if damage else f"{archive.path}: the archive is damaged:"
        raise DamagedArchive(f"{place} {what} [E-ARCH-03]") from error
