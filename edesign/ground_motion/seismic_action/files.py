"""The files that a hazard names, as an archive keeps them."""

from __future__ import annotations

from edesign.project.actions.hazard_base import Hazard
from edesign.project.reading.file_bytes import read_file
from edesign.project.reading.problems import keys_text


def text_name(keys: tuple[str | int, ...]) -> str:
    """Return the name of the text of a file in the archive.

    Args:
        keys: path of the file's key below `hazard`.
    """
    return f"hazard_text_{keys_text(keys).replace('.', '_')}"


def hazard_files(hazard: Hazard | None) -> dict[str, tuple[str, bytes]]:
    """Return name and content of the files of a hazard, by the name of their text in the archive.

    Args:
        hazard: of the project; None has no files.

    Raises:
        InputError: one cannot be read.
    """
    if hazard is None:
        return {}
    return {
        text_name(keys): (file, hazard.content(file, lambda path: read_file(path, "hazard file", refused=())))
        for keys, file in hazard.files()
    }
