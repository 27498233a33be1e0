"""The programs that a project or building can be translated for, by the endings of their files."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, cast

from edesign.archive.files import YAML, check_file, check_own_yaml, write_text, write_yaml
from edesign.errors import InputError
from edesign.file_kinds.kinds import BUILDING, STUDY
from edesign.file_kinds.recognise import head_of, kind_of
from edesign.frame.building_file import load_building
from edesign.frame.project_file import load_project
from edesign.input_files import spare_inputs
from edesign.project.building.building import Building
from edesign.project.project import Project

if TYPE_CHECKING:
    from edesign.exchange.sap2000.translate import TakenModel

MARK = "Written by edesign"
"""In the first line of every model that a translation writes, in a comment of its language."""
TAKEN = (".s2k", ".$2k")
"""How names of files of other programs end that edesign makes files of its own from: SAP2000's text."""


@dataclass(frozen=True)
class Translation:
    """What a translation writes.

    Attributes:
        files: texts by path, the model first, files that it reads after it.
        left_out: sentences on what the files do not have of the project; also in the head of the model.
        differences: sentences on what the program does in another way; also in the head of the model.
    """

    files: Mapping[Path, str]
    left_out: tuple[str, ...] = ()
    differences: tuple[str, ...] = ()


ProgressLine = Callable[[str], None]
Translator = Callable[[Project | Building, Path, bool, ProgressLine], Translation]


@dataclass(frozen=True)
class Format:
    """A kind of file of another program.

    Attributes:
        suffix: how its names end.
        program: that reads it.
        use: what to do with the file; `{}` stands for its name.
        place: the module and the function that translate, loaded when they are needed. The function takes the project,
            the path of the model, whether the dampers are left out, and what takes the names of its stages; it raises
            InputError, with the place in the project file, for what the program lacks.
        building: the function of the same module that takes a building in place of the project; "": the same one.
    """

    suffix: str
    program: str
    use: str
    place: tuple[str, str]
    building: str = ""

    def translate(
        self,
        source: Project | Building,
        path: Path,
        without_dampers: bool = False,
        progress: ProgressLine = lambda stage: None,
    ) -> Translation:
        """Return the files that describe a project or building to the program; nothing is written.

        Args:
            source: the validated project or building.
            path: of the model.
            without_dampers: whether dampers, isolators and tuned masses are left out.
            progress: takes the name of each stage of the work at its beginning.

        Raises:
            InputError: the program lacks something that the source has.
        """
        module, function = self.place
        if isinstance(source, Building) and self.building:
            function = self.building
        make = cast("Translator", getattr(import_module(module), function))
        return make(source, path, without_dampers, progress)


FORMATS = (
    Format(".py", "OpenSeesPy", "python {} all", ("edesign.exchange.opensees.translate", "translate_python")),
    Format(".tcl", "OpenSees", "OpenSees {} all", ("edesign.exchange.opensees.translate", "translate_tcl")),
    Format(
        ".s2k",
        "SAP2000",
        "in SAP2000 File > Import > SAP2000 .s2k Text File, {}",
        ("edesign.exchange.sap2000.translate", "translate_project"),
        "translate_building",
    ),
)


def translate(
    source: Project | Building | Path | str,
    target: Path | str,
    without_dampers: bool = False,
    overwrite: bool = False,
    progress: ProgressLine = lambda stage: None,
) -> Translation:
    """Write the model of a project or building for another program, or a SAP2000 model as a file of edesign.

    Args:
        source: a project or building, the path of its file, or that of SAP2000's text (.s2k).
        target: the file to write. Its ending says for which program: .py OpenSeesPy, .tcl OpenSees, .s2k SAP2000; .yaml
            for edesign, from .s2k.
        without_dampers: whether dampers, isolators and tuned masses are left out.
        overwrite: whether files that edesign did not write are replaced.
        progress: takes the name of each stage of the work at its beginning.

    Returns:
        The files, and sentences on what they lack and what the program does in another way.

    Raises:
        InputError: the program lacks something that the model has, or a file stands there that edesign did not write.
        ArchiveError: a file cannot be written.

    Examples:
        >>> found = edesign.translate(edesign.new_project("frame"), "frame/model.py", without_dampers=True)
        >>> [path.name for path in found.files][0]
        'model.py'
    """
    target = Path(target)
    if not isinstance(source, Project | Building):
        source = Path(source)
        if source.suffix.lower() in TAKEN:
            taken = take(source, target, overwrite)
            return Translation({target: taken.text}, taken.left_out)
        source = read_source(source)
    form = find_format(target)
    check_file(target)  # rather than after the records are fitted
    found = form.translate(source, target, without_dampers, progress)
    check_own_files(found, overwrite)
    write_translation(found)
    return found


def read_source(source: Path) -> Project | Building:
    """Return the project or building of a file.

    Raises:
        InputError: it is another file, or wrong.
    """
    kind = kind_of(source)
    if kind is STUDY:
        raise InputError(
            f"{source}: this is {STUDY.described}, and a project or building file is needed: name that of its "
            "`project`; dampers that a design found come into its `dampers` by `edesign show ARCHIVE --devices DESIGN`"
            " [E-FILE-05]"
        )
    return load_building(source) if kind is BUILDING else load_project(source)


def take(source: Path, target: Path, overwrite: bool = False) -> TakenModel:
    """Write a SAP2000 model as a project or building file.

    Args:
        source: SAP2000's text.
        overwrite: whether a file is replaced that edesign did not write.

    Raises:
        InputError: the model does not fit into a file of edesign, or another file stands there.
        ArchiveError: the file cannot be written.
    """
    from edesign.exchange.sap2000.translate import take_model

    if target.suffix.lower() not in YAML:
        raise InputError(
            f"{target}: the file of edesign that a SAP2000 model makes has a name that ends in .yaml [E-FILE-08]"
        )
    taken = take_model(source, target)
    check_own_yaml(target, source, overwrite)
    write_yaml(taken.text, target, source)
    return taken


def find_format(path: Path) -> Format:
    """Return the format that the name of a file asks for.

    Raises:
        InputError: its ending is that of no known program.
    """
    for known in FORMATS:
        if path.suffix.lower() == known.suffix:
            return known
    endings = ", ".join(f"{known.suffix} ({known.program})" for known in FORMATS)
    raise InputError(f"{path}: the name of the model says for which program it is; it ends in {endings} [E-FILE-08]")


def check_own_files(translation: Translation, overwrite: bool = False) -> None:
    """Check that the files of a translation take the place of earlier translations only.

    A model is known by its first line. Files of numbers beside it have no room for one: they are taken for ours where a
    model of ours with their stem stands beside them.

    Raises:
        InputError: another file is there, or an input of the command.
        ArchiveError: a file cannot be written there.
    """
    model = next(iter(translation.files))
    earlier = any(_is_ours(model.with_suffix(known.suffix)) for known in FORMATS)
    for path, text in translation.files.items():
        spare_inputs(path)
        check_file(path)
        ours = _is_ours(path) if path == model else earlier or _holds(path, text)
        if path.exists() and not (ours or overwrite):
            raise InputError(
                f"{path}: edesign did not write this file, and it is left as it is; choose another name, or --overwrite"
                " [E-FILE-07]"
            )


def _is_ours(model: Path) -> bool:
    """Whether a model is from an earlier translation."""
    return MARK in (head_of(model) or b"").decode("utf-8", errors="replace").partition("\n")[0]


def _holds(path: Path, text: str) -> bool:
    """Whether a file has this text already."""
    try:
        return path.is_file() and path.read_text(encoding="utf-8") == text
    except (OSError, ValueError):
        return False


def write_translation(translation: Translation) -> None:
    """Write the files of a translation, the model last: it never stands without what it reads.

    Raises:
        ArchiveError: a file cannot be written.
        InputError: an input of the command stands there.
    """
    for path, text in reversed(list(translation.files.items())):
        write_text(text, path)
