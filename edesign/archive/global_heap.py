"""Collections of HDF5's global heap, where texts of variable length lie, are checked before the library reads them.

They alone among the library's structures have neither a checksum nor a bounded loop: a collection is a chain of
objects, each with its size, and a free object of size zero, as in a page of zeros, lets the library read the same
place for ever (HDF5 file format specification, version 3, III.E "Global Heap"). Archives of layout 1 have such texts.
"""

from __future__ import annotations

import re
import struct

SIGNATURE = b"GCOL\x01\0\0\0"  # with the version and the reserved bytes
_HEADER = 16  # bytes of a collection's header, and of that of an object
_OBJECT = struct.Struct("<HHIQ")  # index, references, reserved, size in bytes; index 0 is the free space


def without_broken_collections(content: bytes) -> bytes:
    """Return a file in which a collection has no signature unless its chain of objects ends at its end.

    The library reports an error then for every text in the collection.

    Args:
        content: of the file; lengths take 8 bytes in it, as in every archive.
    """
    broken = [found.start() for found in re.finditer(SIGNATURE, content) if not _sound(content, found.start())]
    if not broken:
        return content
    mended = bytearray(content)
    for place in broken:
        mended[place : place + len(SIGNATURE)] = bytes(len(SIGNATURE))
    return bytes(mended)


def _sound(content: bytes, start: int) -> bool:
    place = start + _HEADER
    end = start + int.from_bytes(content[start + len(SIGNATURE) : place], "little")
    if not place <= end <= len(content):
        return False
    while end - place >= _HEADER:
        index, _, _, size = _OBJECT.unpack_from(content, place)
        # the free space counts its header in its size, an object does not and is filled up to 8 bytes
        step = size if index == 0 else _HEADER + (size + 7) // 8 * 8
        if not _HEADER <= step <= end - place:
            return False
        place += step
    return True
