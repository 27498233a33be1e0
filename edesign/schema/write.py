"""Schemas as text and as files."""

from __future__ import annotations

import json
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from edesign.archive.files import make_folder, write_text
from edesign.errors import InputError
from edesign.file_kinds.kinds import FileKind
from edesign.project.notation.written import Json
from edesign.schema.build import COMBINED, DIALECT, combined_schema, file_name, schema_of
from edesign.schema.kinds import KINDS


def schema_text(kind: FileKind) -> str:
    """Return the JSON Schema of a kind of file as text."""
    return _text(schema_of(kind))


def write_schemas(kinds: Sequence[FileKind], folder: Path, combined: bool) -> list[Path]:
    """Write the schemas of some kinds of files.

    Args:
        folder: where KIND.schema.json are written; is made if it is not there.
        combined: whether to write edesign.schema.json too, which finds out the kind of a file.

    Returns:
        The files, the combined one last.

    Raises:
        ArchiveError: the folder or a file cannot be written.
        InputError: a file that is no schema stands in the place of one.
    """
    names = [file_name(kind) for kind in kinds] + ([COMBINED] if combined else [])
    make_folder(folder)
    for name in names:
        _refuse_other(folder / name)
    texts = [schema_text(kind) for kind in kinds] + ([_text(combined_schema())] if combined else [])
    for name, text in zip(names, texts, strict=True):
        write_text(text, folder / name)
    return [folder / name for name in names]


def kinds_table() -> str:
    """Return a list of the kinds of files that have a schema, for people."""
    width = max(map(len, KINDS))
    rows = [f"{kind.schema:{width}}  {kind.titled}; known by {', '.join(kind.keys)}" for kind in KINDS.values()]
    return "\n".join(
        [*rows, "", "`edesign schema KIND` prints the schema of one, `edesign schema -o FOLDER` writes all."]
    )


def _text(schema: Json) -> str:
    return json.dumps(schema, indent=1, ensure_ascii=False) + "\n"


def _refuse_other(path: Path) -> None:
    with suppress(OSError, UnicodeDecodeError):
        if DIALECT in path.read_text(encoding="utf-8")[:200]:
            return
    if path.exists():
        raise InputError(
            f"{path}: this file is no schema of edesign, and it is left as it is; choose another folder [E-FILE-07]"
        )
