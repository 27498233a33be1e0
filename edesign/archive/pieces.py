"""The file of an archive that is not complete: a row of small HDF5 files, one for each group, that only grows.

HDF5 does not promise that a file survives a kill or a full disk while it is written. So each group is made as a file of
its own in memory, and appended as a whole. A line of text behind it has its place and its checksum. What was appended
never changes: a kill leaves every group before it, and readers need no lock.

The root comes first, so that the file begins as one of HDF5.
"""

from __future__ import annotations

import fcntl
import hashlib
import json
import os
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

_LINE = re.compile(rb'\nedesign archive group: sha256 ([0-9a-f]{64}) of ([0-9]{20}) bytes at ("[ -~]*")\n')
_BLOCK = 1 << 20


@dataclass
class Pieces:
    """The groups that were found in the content of a file.

    Attributes:
        places: start and end of each group in the file, bytes, by its place, "" for the root.
        damage: why what else is there cannot be read, by its place.
        end: of the last whole piece, bytes; behind it a kill may have left a part of one.
    """

    places: dict[str, tuple[int, int]] = field(default_factory=dict)
    damage: dict[str, str] = field(default_factory=dict)
    end: int = 0

    def put(self, place: str, start: int, stop: int) -> None:
        """Note a group in place of an earlier one and of all below that; one of no bytes is none."""
        for old in [old for old in self.places if old == place or (place and old.startswith(f"{place}/"))]:
            del self.places[old]
        if start < stop:
            self.places[place] = start, stop


def find_pieces(content: bytes) -> Pieces:
    """Find the groups in the content of a file; one is there only if its checksum is right."""
    found, view = Pieces(), memoryview(content)
    for line in _LINE.finditer(content):
        checksum, text = line[1].decode(), line[3]
        start, stop = line.start() - int(line[2]), line.start()
        if start > found.end:
            found.damage[f"bytes {found.end} to {start}"] = "they are not as they were written"
        try:
            place = str(json.loads(text))
        except ValueError:
            place = text.decode()
        if start < found.end or checksum != _sha256(text, view[start:stop]):
            found.damage[place] = "its content is not as it was written (the checksum differs)"
        else:
            found.put(place, start, stop)
        found.end = line.end()
    return found


class PieceFile:
    """The file of an archive that is being written.

    Args:
        path: the file; it is created if missing, and locked against other writers.

    Attributes:
        found: the groups in it.

    Raises:
        BlockingIOError: another process writes to the file.
        OSError: it cannot be created or opened.
    """

    def __init__(self, path: Path) -> None:
        self._descriptor = _locked(path, os.O_RDWR | os.O_CREAT)
        with open(self._descriptor, "rb", closefd=False) as file:
            self.found = find_pieces(file.read())

    def append(self, images: Mapping[str, bytes]) -> None:
        """Write groups behind those that are there, and bring them to the disk.

        Args:
            images: the HDF5 file of each group by its place, b"" for one that is to be there no longer.

        Raises:
            OSError: no space, or another failure; the file is as it was.
        """
        start = self.found.end
        added = {}
        try:
            os.ftruncate(self._descriptor, start)  # without what a kill left
            for place, image in images.items():
                text = json.dumps(place).encode()
                checksum = _sha256(text, image).encode()
                line = b"\nedesign archive group: sha256 %b of %020d bytes at %b\n" % (checksum, len(image), text)
                added[place] = start, start + len(image)
                start = _write(self._descriptor, image + line, start)
            os.fsync(self._descriptor)
        except OSError:
            os.ftruncate(self._descriptor, self.found.end)
            raise
        for place, (first, last) in added.items():
            self.found.put(place, first, last)
        self.found.end = start

    def image(self, place: str) -> bytes:
        """Return the HDF5 file of a group that is there."""
        start, stop = self.found.places[place]
        with open(self._descriptor, "rb", closefd=False) as file:
            file.seek(start)
            return file.read(stop - start)

    def clear(self) -> None:
        """Begin anew with an empty file."""
        os.ftruncate(self._descriptor, 0)
        self.found = Pieces()

    @property
    def path(self) -> Path | None:
        """The present path of the file, if the system knows it and the file has not been deleted."""
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
        return os.path.samestat(os.stat(path), os.fstat(self._descriptor))

    def write_again(self, path: Path) -> None:
        """Write the content to a path where nothing is, and continue there.

        Raises:
            OSError: it cannot be written, or something is there.
        """
        descriptor = _locked(path, os.O_RDWR | os.O_CREAT | os.O_EXCL)
        try:
            place = 0
            while content := os.pread(self._descriptor, _BLOCK, place):
                place = _write(descriptor, content, place)
            os.fsync(descriptor)
        except OSError:
            os.close(descriptor)
            os.unlink(path)
            raise
        os.close(self._descriptor)
        self._descriptor = descriptor

    def close(self) -> None:
        """Release the file; does nothing a second time."""
        if self._descriptor >= 0:
            os.close(self._descriptor)
            self._descriptor = -1


def _locked(path: Path, flags: int) -> int:
    """Open a file that no other process writes to, and return its descriptor."""
    descriptor = os.open(path, flags, 0o644)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(descriptor)
        raise
    return descriptor


def _write(descriptor: int, content: bytes, place: int) -> int:
    """Write all of it, whatever the system takes at a time; return where it ends."""
    view = memoryview(content)
    while view:
        count = os.pwrite(descriptor, view, place)
        view, place = view[count:], place + count
    return place


def _sha256(text: bytes, image: bytes | memoryview) -> str:
    digest = hashlib.sha256(text)
    digest.update(image)
    return digest.hexdigest()
