"""The largest files that are read: far above what people and instruments write, far below what exhausts a computer.

A file beyond a limit is refused before it is parsed, so the refusal takes seconds at most. The limits are about a
hundred times the largest files that edesign was made for (the measure of each stands beside it).
"""

from __future__ import annotations

YAML_BYTES = 4_000_000
"""Of a YAML file. The largest in `projects/` and among the suites has 25 kB; 200 storeys of 20 bays, every column, beam
and load in a line of its own, make 0.7 MB."""

YAML_VALUES = 300_000
"""Values in a YAML file: every scalar, list and mapping is one. The frame of 200 x 20 has 61 000, the largest file in
`projects/` and among the suites 2 300."""

YAML_DEPTH = 30
"""Lists and mappings within each other. The deepest key of a project or study file lies 8 levels down."""

YAML_ADVICE = "name members by ranges such as `storeys: 1-10`, or take out what is no input"

TABLE_BYTES = 300_000_000
"""Of a file of samples, after decompression. The largest measured tables that edesign was tried with have 3 MB; an hour
of a damper test at 1 kHz with four columns has 150 MB."""

TABLE_LINES = 5_000_000
"""Lines of a text of samples. An hour of a damper test at 1 kHz has 3.6 million; the largest measured tables have
60 000."""

TABLE_COLUMNS = 10_000
"""Numbers in a line. A capture of dSPACE has about a hundred signals, the formats of networks eight numbers a line. A
record of 100 s at 100 samples a second may stand in one line."""

TABLE_CELLS = 20_000_000
"""Cells of a table between commas, semicolons or tabs. An hour of a damper test at 1 kHz with four columns has 14
million; as text each takes 60 bytes of memory."""

LINE_CHARACTERS = 25 * TABLE_COLUMNS
"""Characters in a line of a text of samples: a number of 17 digits has 24, and a sign behind it."""

TABLE_ADVICE = "cut it into several files, or take fewer samples a second"


def megabytes(size: int) -> str:
    """Return a size in bytes for people: 61.4 MB."""
    return f"{size / 1e6:.3g} MB" if size < 1e9 else f"{size / 1e9:.4g} GB"
