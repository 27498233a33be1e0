"""What a file is that is no text, by its first bytes, and how its numbers become text."""

from __future__ import annotations

import re

_KNOWN = (
    (b"TDSm", "it is a TDMS file of LabVIEW: write it as a LabVIEW measurement (.lvm) or as CSV"),
    (b"|CF", "it is a FAMOS file of imc: export it as CSV"),
    (b"MATLAB 7.3 MAT-file", "it is a MATLAB file of version 7.3: save it by `save -v7`, or write columns as CSV"),
    (b"MATLAB 5.0 MAT-file", "it is a MATLAB file: write its columns as CSV, in MATLAB by `writetable`"),
    (b"%PDF", "it is a document; save its numbers as text"),
    (b"\xd0\xcf\x11\xe0", "it is a document; save its numbers as text"),
    (b"\x1f\x8b", "it is compressed; unpack it"),
    (b"Rar!", "it is compressed; unpack it"),
)
_MINISEED = re.compile(rb"[0-9 ]{6}[DRQM][ \0][A-Z0-9 ]{5}|MS\x03")


def describe_binary(data: bytes) -> str:
    """Return what a file that is not text looks like, and how to read it; "" if it looks like nothing known.

    Args:
        data: first bytes of the file.
    """
    if data[:2] == b"PK":  # packed files, which those of Office programs are too
        office = b"[Content_Types].xml" in data[:1000] or b"xl/" in data[:4000]
        return "it is a workbook or document; save its numbers as CSV" if office else "it is compressed; unpack it"
    if _MINISEED.match(data):
        return "it looks like miniSEED: convert it to text, for instance with ObsPy, and declare that as a table"
    return next((what for beginning, what in _KNOWN if data.startswith(beginning)), "")
