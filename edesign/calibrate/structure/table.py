"""Tables of records: CSV, also compressed."""

from __future__ import annotations

import gzip
import tempfile
import zlib
from dataclasses import replace
from pathlib import Path

from edesign.damper.csv_table import CsvTable, read_csv_table
from edesign.errors import InputError
from edesign.project.file_bytes import read_file

WHAT = "record file"
EXAMPLE = "time_s,base_m_s2,floor_1_m_s2"


def read_table(path: Path) -> CsvTable:
    """Read a table; a name that ends in .gz is that of a compressed one.

    Raises:
        InputError: the file cannot be read or is wrong.
    """
    if path.suffix.lower() != ".gz":
        return read_csv_table(path, WHAT, EXAMPLE)
    try:
        text = gzip.decompress(read_file(path, WHAT))
    except (OSError, EOFError, zlib.error):
        raise InputError(f"{path}: this is no compressed file (gzip)") from None
    with tempfile.TemporaryDirectory() as folder:
        plain = Path(folder) / path.stem
        plain.write_bytes(text)
        try:
            return replace(read_csv_table(plain, WHAT, EXAMPLE), path=path)
        except InputError as error:
            raise InputError(str(error).replace(str(plain), str(path))) from None
