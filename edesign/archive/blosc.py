"""Chunks of the compressor Blosc, opened: HDF5 filter 32001, which h5py cannot pass without a plug-in of 190 MB.

Only what the data files of record packages need: Blosc 1 with the codecs BloscLZ and LZ4, bytes shuffled or not.

Source: c-blosc 1, README_CHUNK_FORMAT.rst; LZ4 block format description, lz4_Block_format.md; FastLZ 0.1 level 2, of
which BloscLZ is a variant.
"""

from __future__ import annotations

import struct
from collections.abc import Callable

import numpy as np

FILTER = 32001
"""Number of Blosc among the registered filters of HDF5."""
_HEADER = struct.Struct("<BBBBIII")  # version, of the codec, flags, bytes of a value, bytes, of a block, of the chunk
_SHUFFLED, _COPIED, _BITS_SHUFFLED, _WHOLE_BLOCKS = 1, 2, 4, 16
_FURTHEST = 8191  # distance in a short match of BloscLZ; what lies further has two bytes more


def decompress(chunk: bytes) -> bytes:
    """Return the decompressed bytes of a chunk.

    Args:
        chunk: of Blosc 1, with its header.

    Raises:
        ValueError: it is damaged, or compressed in a way that is not known here.
    """
    try:
        _, _, flags, itemsize, size, block, stored = _HEADER.unpack_from(chunk)
        if stored != len(chunk):
            raise ValueError(f"a Blosc chunk of {stored} bytes has {len(chunk)}")
        if flags & _COPIED:
            found = chunk[_HEADER.size :]
        else:
            found = b"".join(_blocks(chunk, flags, itemsize, size, block))
    except (struct.error, IndexError, ZeroDivisionError) as error:
        raise ValueError(f"a damaged Blosc chunk: {error}") from error
    if len(found) != size:
        raise ValueError(f"a damaged Blosc chunk: {len(found)} bytes in place of {size}")
    return found


def _blocks(chunk: bytes, flags: int, itemsize: int, size: int, block: int) -> list[bytes]:
    codec = _CODECS.get(flags >> 5)
    if codec is None or flags & _BITS_SHUFFLED:
        raise ValueError(f"a Blosc chunk with the flags {flags:#x}, which is not known here")
    found = []
    for number, first in enumerate(range(0, size, block)):
        length = min(block, size - first)
        parts = 1 if flags & _WHOLE_BLOCKS or length < block else itemsize
        (place,) = struct.unpack_from("<i", chunk, _HEADER.size + 4 * number)
        pieces = []
        for _ in range(parts):
            (stored,) = struct.unpack_from("<i", chunk, place)
            piece = chunk[place + 4 : place + 4 + stored]
            pieces.append(piece if stored == length // parts else codec(piece))
            place += 4 + stored
        content = b"".join(pieces)
        found.append(_unshuffled(content, itemsize) if flags & _SHUFFLED and itemsize > 1 else content)
    return found


def _unshuffled(content: bytes, itemsize: int) -> bytes:
    """Values whose first bytes stand first, then their second ones; what is no whole value stands at the end."""
    whole = len(content) // itemsize * itemsize
    values = np.frombuffer(content[:whole], np.uint8).reshape(itemsize, -1).T
    return values.tobytes() + content[whole:]


def _lz4(source: bytes) -> bytes:
    out, place = bytearray(), 0
    while True:
        token = source[place]
        literals, place = _lz4_length(source, place + 1, token >> 4)
        out += source[place : place + literals]
        place += literals
        if place >= len(source):
            return bytes(out)
        distance = source[place] | source[place + 1] << 8
        length, place = _lz4_length(source, place + 2, token & 15)
        _repeat(out, distance, length + 4)


def _lz4_length(source: bytes, place: int, length: int) -> tuple[int, int]:
    """A length of four bits, with the bytes that go on after 15."""
    more = 255 if length == 15 else 0
    while more == 255:
        more, place = source[place], place + 1
        length += more
    return length, place


def _blosclz(source: bytes) -> bytes:
    out, place, control = bytearray(), 1, source[0] & 31
    while True:
        if control < 32:
            out += source[place : place + control + 1]
            place += control + 1
        else:
            length, distance, more = (control >> 5) + 2, (control & 31) << 8, 255 if control >> 5 == 7 else 0
            while more == 255:
                more, place = source[place], place + 1
                length += more
            near, place = source[place], place + 1
            distance += near
            if distance == _FURTHEST:
                distance += source[place] << 8 | source[place + 1]
                place += 2
            _repeat(out, distance + 1, length)
        if place >= len(source):
            return bytes(out)
        control, place = source[place], place + 1


def _repeat(out: bytearray, distance: int, length: int) -> None:
    """Append what stands `distance` bytes before the end; what is longer than that repeats itself."""
    if not 0 < distance <= len(out):
        raise ValueError("a damaged Blosc chunk: a repetition of what was not there")
    pattern = bytes(out[-distance:])
    out += (pattern * (length // distance + 1))[:length]


_CODECS: dict[int, Callable[[bytes], bytes]] = {0: _blosclz, 1: _lz4}
