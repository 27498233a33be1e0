"""Tables of records: CSV, also compressed."""

from __future__ import annotations

import gzip
import io
import tempfile
import zlib
from dataclasses import replace
from pathlib import Path

from edesign.errors import InputError
from edesign.project.reading.file_bytes import read_file, read_up_to, too_large
from edesign.project.reading.limits import TABLE_BYTES
from edesign.tables import table as tables

WHAT = "record file"
EXAMPLE = "time_s,base_m_s2,floor_1_m_s2"


def read_table(path: Path) -> tables.Table:
    """Read a table; a name that ends in .gz is that of a compressed one.

    Raises:
        InputError: the file cannot be read, is wrong, or too large (also once it is decompressed).
    """
    if path.suffix.lower() != ".gz":
        return tables.read_table(path, WHAT, EXAMPLE)
    text = _decompressed(path)
    with tempfile.TemporaryDirectory() as folder:
        plain = Path(folder) / path.stem
        plain.write_bytes(text)
        try:
            return replace(tables.read_table(plain, WHAT, EXAMPLE), path=path)
        except InputError as error:
            raise InputError(str(error).replace(str(plain), str(path))) from None


def _decompressed(path: Path) -> bytes:
    data = read_file(path, WHAT)
    said = int.from_bytes(data[-4:], "little")  # RFC 1952: a file ends with the size of its content modulo 2^32
    if data[:2] == b"\x1f\x8b" and said > TABLE_BYTES:
        raise too_large(path, WHAT, said, TABLE_BYTES)
    try:
        with gzip.GzipFile(fileobj=io.BytesIO(data)) as file:  # a file in several parts gives the size of the last one
            text = read_up_to(file, TABLE_BYTES)
    except (OSError, EOFError, zlib.error):
        raise InputError(f"{path}: this is no compressed file (gzip) [E-TABLE-02]") from None
    if len(text) > TABLE_BYTES:
        raise too_large(path, WHAT, len(text), TABLE_BYTES)
    return text
