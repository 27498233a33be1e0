"""Reading files that a user names, with errors for people."""

from __future__ import annotations

import os
import stat
from itertools import islice
from pathlib import Path
from typing import BinaryIO, Protocol

from edesign.errors import InputError
from edesign.file_kinds.kinds import ARCHIVE, PAGE, PDF, PICTURE, SAP2000, YAML_KINDS, FileKind
from edesign.file_kinds.recognise import HEAD, foreign_content, kind_of_content, refuse_kind
from edesign.input_files import note_input
from edesign.project.reading.limits import TABLE_ADVICE, TABLE_BYTES, megabytes
from edesign.project.reading.problems import nearest


class Readable(Protocol):
    """A file that is open for bytes."""

    def read(self, size: int, /) -> bytes:
        """Read at most `size` bytes."""


_CHUNK = 1 << 20  # bytes
_MOST_NAMES = 2000  # of files in a folder that are compared with a missing one, which takes 50 ms


def read_file(
    path: Path,
    what: str,
    most: int = TABLE_BYTES,
    advice: str = TABLE_ADVICE,
    refused: tuple[FileKind, ...] = (ARCHIVE, *YAML_KINDS, SAP2000, PDF, PICTURE, PAGE),
) -> bytes:
    """Read a file within a limit of size.

    Args:
        path: the file; what is said to be of no size, as files of /proc are, is read up to the limit.
        what: it is, for messages: "project file".
        most: bytes that are read; a file of more is refused before it is read.
        advice: what to do about a larger one.
        refused: kinds of files that it cannot be.

    Raises:
        InputError: missing, a folder, a pipe or device, unreadable, of a kind that is refused, or too large.
    """
    try:
        with _opened(path) as file:
            size = os.fstat(file.fileno()).st_size
            data = read_up_to(file, most) if size <= most else file.read(HEAD)
    except FileNotFoundError:
        raise missing(path, what) from None
    except IsADirectoryError:
        raise InputError(f"{path}: this is a folder; name the {what} in it [E-FILE-02]") from None
    except OSError as error:
        raise InputError(f"{path}: the {what} cannot be read: {error.strerror} [E-FILE-02]") from None
    except ValueError as error:  # Python's for a null byte in a name
        raise InputError(f"{path}: the {what} cannot be read: {error} [E-FILE-02]") from None
    head = data[:HEAD]
    refuse_kind(path, kind_of_content(head) or foreign_content(head), what, *refused)
    if size > most or len(data) > most:
        raise too_large(path, what, max(size, len(data)), most, advice)
    note_input(path)
    return data


def _opened(path: Path) -> BinaryIO:
    """Open a regular file for bytes: a pipe may be waited for without end, and a device may have none.

    Raises:
        InputError: it is a pipe, a device or a socket.
        OSError, ValueError: the system cannot open it.
    """
    mode = os.stat(path).st_mode
    if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
        what = "pipe" if stat.S_ISFIFO(mode) else "socket" if stat.S_ISSOCK(mode) else "device"
        raise InputError(
            f"{path}: this is a {what}, and only files are read; write into a file what is to be read [E-FILE-02]"
        )
    return path.open("rb")


def missing(path: Path, what: str) -> InputError:
    """Return the error of a file that is not there, with the file of its kind beside it whose name is nearest.

    Args:
        what: it would be, for the message.
    """
    try:
        beside = [entry.name for entry in islice(os.scandir(path.parent), _MOST_NAMES)]
    except FileNotFoundError:
        return InputError(f"{path}: there is no such {what}; the folder {path.parent} does not exist [E-FILE-01]")
    except (OSError, ValueError):
        beside = []
    endings = {".yaml", ".yml"} if path.suffix.lower() in (".yaml", ".yml", "") else {path.suffix.lower()}
    alike = {Path(name).stem: name for name in beside if Path(name).suffix.lower() in endings}
    del_digits = str.maketrans("", "", "0123456789")  # record_2 and record_7 are alike, and not the same
    same = path.stem.translate(del_digits)
    near = alike.get(nearest(path.stem, [stem for stem in alike if stem.translate(del_digits) != same]))
    hint = f"; did you mean `{near}`?" if near else ""
    return InputError(f"{path}: there is no such {what}{hint} [E-FILE-01]")


def read_up_to(file: Readable, most: int) -> bytes:
    """Read at most one byte more than `most`, by which a file that is too large is known.

    Args:
        most: the largest number of bytes.
    """
    chunks: list[bytes] = []
    left = most + 1
    while left > 0 and (chunk := file.read(min(_CHUNK, left))):
        chunks.append(chunk)
        left -= len(chunk)
    return b"".join(chunks)


def too_large(path: Path, what: str, size: int, most: int, advice: str = TABLE_ADVICE) -> InputError:
    """Return the error of a file that is too large.

    Args:
        what: what the file is, for messages.
        size: its bytes, at least.
        advice: what the user can do.
    """
    seen = f"more than {megabytes(most)}" if size == most + 1 else megabytes(size)
    return InputError(f"{path}: the {what} has {seen}; at most {megabytes(most)} are read: {advice} [E-FILE-02]")


def is_file(path: Path) -> bool:
    """Return whether a path is that of a file; False where the system refuses the path."""
    return os.path.isfile(path)


def is_folder(path: Path) -> bool:
    """Return whether a path is that of a folder; False where the system refuses the path."""
    return os.path.isdir(path)


def is_there(path: Path) -> bool:
    """Return whether a path exists; False where the system refuses the path."""
    return os.path.exists(path)
