"""Folders of files that run as they are, to begin with: the templates of `edesign new`."""

from __future__ import annotations

import os
import shlex
from dataclasses import dataclass
from pathlib import Path

import yaml

from edesign.errors import InputError
from edesign.project.reading.problems import unknown_name

FOLDER = Path(__file__).parent / "templates"
"""A folder for each template, one for their records, and what `edesign new` says of them."""
DEFAULT = "frame"
_ABOUT, _RECORDS = "templates.yaml", "records"
_TITLE, _MADE = "@title@", "FOLDER"


@dataclass(frozen=True)
class Template:
    """A folder of files to begin with.

    Attributes:
        name: by which it is asked for.
        about: what it is, one line.
        file: the one that commands are given first.
        records: names of the files in its folder of records.
        seconds: of CPU time that the commands of `next` take, about.
        next: commands, with `FOLDER` for the folder that was made.
    """

    name: str
    about: str
    file: str
    seconds: float
    next: tuple[str, ...]
    records: tuple[str, ...] = ()

    def commands(self, folder: Path) -> list[str]:
        """Return the commands that come next for a folder that was made, to be pasted into a shell."""
        return [
            " ".join(
                shlex.quote(str(folder / word.removeprefix(f"{_MADE}/"))) if word.startswith(f"{_MADE}/") else word
                for word in command.split()
            )
            for command in self.next
        ]


def templates() -> dict[str, Template]:
    """Return all templates by their names, in the order in which they are listed."""
    with (FOLDER / _ABOUT).open(encoding="utf-8") as file:
        about = yaml.safe_load(file)
    return {
        name: Template(
            name,
            said["about"],
            said["file"],
            said["seconds"],
            tuple(said["next"]),
            tuple(said.get("records", ())),
        )
        for name, said in about.items()
    }


def template(name: str) -> Template:
    """Return a template by its name.

    Raises:
        InputError: there is none of this name; names the nearest one.
    """
    known = templates()
    if name not in known:
        raise InputError(unknown_name("template", name, known))
    return known[name]


def new_project(folder: Path | str, name: str | None = None, kind: str = DEFAULT) -> Path:
    """Write the files of a template.

    Args:
        folder: where they go; made if it does not exist.
        name: title of the project, one line; None takes the name of the folder.
        kind: name of the template; `frame` is a plane steel frame.

    Returns:
        The path of the file that commands are given first.

    Raises:
        InputError: there is no such template, one of its files exists already (all are left alone), the name is not
            one line of text, or nothing can be written.
    """
    chosen = template(kind)
    if name is None:
        name = os.path.basename(os.path.realpath(folder)) or "New project"
    if not name.strip() or not name.isprintable():
        raise InputError("the name of a project is one line of text [E-VALUE-01]")
    texts = _texts(chosen, name.strip())
    folder = Path(folder)
    taken = next((folder / place for place in texts if os.path.lexists(folder / place)), None)
    if taken is not None:
        raise InputError(f"{taken}: exists already and is left as it is; choose another folder [E-FILE-07]")
    made: list[Path] = []
    try:
        for place, text in texts.items():
            path = folder / place
            path.parent.mkdir(parents=True, exist_ok=True)
            with path.open("x", encoding="utf-8", newline="\n") as file:
                made.append(path)
                file.write(text)
    except OSError as error:
        for path in made:
            path.unlink(missing_ok=True)
        where = error.filename or folder
        if isinstance(error, FileExistsError | NotADirectoryError):  # a file where a folder is needed
            raise InputError(
                f"{where}: exists already and is left as it is; choose another folder [E-FILE-07]"
            ) from None
        raise InputError(f"{where}: the file cannot be written: {error.strerror} [E-FILE-06]") from None
    return folder / chosen.file


def _texts(chosen: Template, title: str) -> dict[Path, str]:
    """The files of a template by their places in the new folder; in the YAML files its title."""
    own = FOLDER / chosen.name
    quoted = title.replace("\\", "\\\\").replace('"', '\\"')  # inside the quotes that the templates have
    found = {}
    for path in sorted(own.rglob("*")):
        if path.is_file():
            text = path.read_text(encoding="utf-8")
            found[path.relative_to(own)] = text.replace(_TITLE, quoted) if path.suffix == ".yaml" else text
    for record in chosen.records:
        found[Path(_RECORDS, record)] = (FOLDER / _RECORDS / record).read_text(encoding="utf-8")
    return found
