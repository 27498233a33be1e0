"""Files that appear only when they are whole, and the folders they go into."""

from __future__ import annotations

import errno
import json
import os
import re
import tempfile
from collections.abc import Callable
from contextlib import suppress
from itertools import count
from pathlib import Path

from edesign._version import __version__
from edesign.errors import ArchiveError, InputError
from edesign.file_kinds.recognise import HDF5, head_of
from edesign.input_files import note_output, spare_inputs

_WRITTEN = re.compile(r"# Written by edesign \S+ from (\".*\")")  # how YAML files of results begin

_REASONS = {
    errno.ENOSPC: "the disk is full",
    errno.EDQUOT: "the disk quota is used up",
    errno.EFBIG: "the file would exceed the allowed size",
    errno.EACCES: "no permission",
    errno.EPERM: "no permission",
    errno.EROFS: "the file system is read-only",
    errno.ENAMETOOLONG: "the name is too long",
    errno.ELOOP: "its symbolic links lead in a circle",
    errno.ENOTDIR: "a part of the path before the last is a file, not a folder",
    errno.EISDIR: "it is a folder",
}


def reason(error: OSError) -> str:
    """Return the reason of an error of the file system in words."""
    return _REASONS.get(error.errno or 0) or error.strerror or str(error)


def check_folder(folder: Path) -> None:
    """Check that files can be written into a folder, or that it can be made, without making it.

    Raises:
        ArchiveError: they cannot, or it cannot.
    """
    try:
        with suppress(FileNotFoundError, NotADirectoryError):
            os.stat(folder)  # refuses what is no path at all
        existing = _existing(folder)
        if not existing.is_dir():
            raise ArchiveError(f"{folder}: {existing} is a file, and a folder is needed [E-FILE-06]")
        if not os.access(existing, os.W_OK | os.X_OK):
            raise ArchiveError(f"{folder}: the folder {existing} cannot be written to [E-FILE-06]")
    except (OSError, ValueError) as error:
        raise ArchiveError(f"{folder}: the folder cannot be used: {_words(error)} [E-FILE-06]") from error


def try_folder(folder: Path) -> None:
    """Check that files can be written into a folder, or that it can be made, by making and removing another one there.

    Rights alone do not decide: to an administrator all folders seem to be writable, those of `/proc` too.

    Raises:
        ArchiveError: they cannot, or it cannot.
    """
    check_folder(folder)
    existing = _existing(folder)
    try:
        os.rmdir(tempfile.mkdtemp(prefix=".edesign-", dir=existing))
    except OSError as error:
        raise ArchiveError(
            f"{folder}: nothing can be made in the folder {existing}: {reason(error)} [E-FILE-06]"
        ) from error


def check_file(path: Path) -> None:
    """Check that a file can be written into a folder that is there or can be made, without writing it.

    Raises:
        ArchiveError: it cannot.
    """
    check_folder(path.parent)
    try:
        if path.is_dir():
            raise ArchiveError(f"{path}: cannot be written: it is a folder [E-FILE-06]")
        if path.exists() and not path.is_file():  # a file would take its place, and may be waited for before
            raise ArchiveError(f"{path}: cannot be written: it is a pipe or a device [E-FILE-06]")
        with suppress(FileNotFoundError):
            os.lstat(_existing(path.parent) / _partial(path).name)  # refused where the name is too long
    except (OSError, ValueError) as error:
        raise ArchiveError(f"{path}: cannot be written: {_words(error)} [E-FILE-06]") from error


YAML = (".yaml", ".yml")
"""How names of YAML files end."""
ARCHIVES = (".h5", ".hdf5", ".nc")
"""How names of archives end."""


def check_archive_name(path: Path) -> None:
    """Check that the name of an archive to be written cannot mean a file of another kind.

    Raises:
        InputError: it has another ending.
    """
    if path.suffix.lower() not in ARCHIVES:
        raise InputError(f"{path}: the name of an archive ends in .h5, .hdf5 or .nc [E-FILE-08]")


def check_csv(path: Path) -> None:
    """Check that a table can be written before it is made, and that its name cannot mean a file of another kind.

    Raises:
        InputError: it has another ending, or an input of the command stands there.
        ArchiveError: it cannot be written.
    """
    if path.suffix.lower() != ".csv":
        raise InputError(f"{path}: the name of a table ends in .csv [E-FILE-08]")
    spare_inputs(path)
    check_file(path)
    try_folder(path.parent)


def make_folder(folder: Path) -> None:
    """Make a folder if it does not exist.

    Raises:
        ArchiveError: it cannot be made.
    """
    check_folder(folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ArchiveError(f"{folder}: the folder cannot be made: {reason(error)} [E-FILE-06]") from error


def source_file(source: Path, result: Path) -> str:
    """Return the path of the source of a result, relative to the folder of the result.

    A source and its result that move together stay a pair.

    Args:
        source: the file that the result is computed from.
    """
    return Path(os.path.relpath(os.path.realpath(source), os.path.realpath(result.parent))).as_posix()


def check_own_yaml(path: Path, source: Path, overwrite: bool = False) -> None:
    """Check that a YAML file of results can be written, and replaces only an earlier result of the same source.

    Args:
        path: where the results go.
        overwrite: whether they may take the place of any other file.

    Raises:
        InputError: the name has another ending; a file of another source is there, or one that edesign did not write;
            or an input of the command.
        ArchiveError: it cannot be written.
    """
    if path.suffix.lower() not in YAML:
        raise InputError(f"{path}: the name of this file ends in {' or '.join(YAML)} [E-FILE-08]")
    spare_inputs(path)
    check_file(path)
    try_folder(path.parent)
    head = head_of(path)
    if head is None:
        return
    first_line = head.decode("utf-8", errors="replace").partition("\n")[0]
    other = _named_source(first_line)
    if overwrite or other == source_file(source, path):
        return
    what = f"this is the result of {other}" if other else "edesign did not write this file"
    raise InputError(f"{path}: {what}, and it is left as it is; choose another name, or --overwrite [E-FILE-07]")


def _named_source(first_line: str) -> str:
    """The source that the first line of a YAML file of results names; "" if edesign did not write the line."""
    written = _WRITTEN.match(first_line)
    try:
        return "" if written is None else str(json.loads(written[1]))
    except ValueError:  # changed by hand
        return ""


def write_yaml(text: str, path: Path, source: Path) -> None:
    """Write a YAML file of results under a line that names its source; otherwise as `write_text`."""
    of = json.dumps(source_file(source, path))
    write_text(f"# Written by edesign {__version__} from {of}; its next run replaces this file.\n{text}", path)


def write_text(text: str, path: Path) -> None:
    r"""Write a text file; otherwise as `write_whole`.

    Names of files that are no text are written with `\udcff` in place of what cannot be read.
    """
    content = text.encode("utf-8", "backslashreplace")
    write_whole(path, lambda partial: partial.write_bytes(content))


def write_whole(path: Path, write: Callable[[Path], object]) -> None:
    """Write a file that appears only when it is complete, a power failure included; it never replaces an archive.

    Its folder is made if it does not exist.

    Args:
        write: writes to the path that it is given, beside the file and with its suffix.

    Raises:
        ArchiveError: it cannot be written.
        InputError: an input of the command stands there.
    """
    if is_hdf5(path):
        raise ArchiveError(f"{path}: cannot be written: this file is an archive, and it is left as it is [E-FILE-07]")
    spare_inputs(path)
    check_file(path)
    make_folder(path.parent)
    partial: Path | None = None
    try:
        partial = _new_file_beside(path)
        write(partial)
        _sync(partial)  # file systems may rename first and write the content later
        os.replace(partial, path)
    except BaseException as error:
        with suppress(OSError):  # where nothing can be written, nothing can be deleted either
            if partial is not None:
                partial.unlink(missing_ok=True)
        if isinstance(error, OSError):
            raise ArchiveError(f"{path}: cannot be written: {reason(error)} [E-FILE-06]") from error
        raise
    note_output(path)


def _sync(path: Path) -> None:
    """Bring the content of a file to the disk."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def _new_file_beside(path: Path) -> Path:
    """An empty file of a name that nothing has yet, a file of the user neither: NAME.partial.SUFFIX."""
    for number in count(1):
        partial = _partial(path, number)
        with suppress(FileExistsError):
            os.close(os.open(partial, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666))
            return partial
    raise AssertionError("there are more numbers than files")


def _partial(path: Path, number: int = 1) -> Path:
    return path.with_name(f"{path.stem}.partial{number if number > 1 else ''}{path.suffix}")


def _existing(folder: Path) -> Path:
    """The folder, or the nearest one above it that exists."""
    while not folder.exists() and folder != folder.parent:
        folder = folder.parent
    return folder


def _words(error: OSError | ValueError) -> str:
    """Why a path is refused; Python refuses a null byte itself, with a ValueError."""
    return reason(error) if isinstance(error, OSError) else str(error)


def is_hdf5(path: Path) -> bool:
    """Return whether a file begins as one of HDF5."""
    return (head_of(path) or b"").startswith(HDF5)
