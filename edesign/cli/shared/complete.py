"""Names that a shell completes: each function is called by the shell alone, and must be quick and never fail.

Files are completed by the shell itself. `edesign --install-completion` sets a shell up; docs/reference/command_line.md.
"""

from __future__ import annotations

import os
import shlex
from collections.abc import Callable, Iterable
from pathlib import Path


def _names(names: Callable[[], Iterable[str]]) -> Callable[[str], list[str]]:
    """What completes a name that is begun."""

    def complete(incomplete: str) -> list[str]:
        try:
            return [name for name in dict.fromkeys(names()) if name.startswith(incomplete)]
        except Exception:  # a shell has no place for an error; the command itself prints it
            return []

    return complete


def _named(names: Callable[[Path], Iterable[str]]) -> Callable[[str], list[str]]:
    """What completes a name that stands in a file: the first one on the line."""

    def complete(incomplete: str) -> list[str]:
        file = next((word for word in _words() if os.path.isfile(word)), None)
        return _names(lambda: names(Path(file)) if file else ())(incomplete)

    return complete


def _words() -> list[str]:
    """The words of the line, as the shell gives them: an option without its value hides the arguments from typer."""
    line = os.environ.get("COMP_WORDS") or os.environ.get("_TYPER_COMPLETE_ARGS", "")
    try:
        return shlex.split(line)[1:]
    except ValueError:  # a quote that is not closed yet
        return line.split()[1:]


def _templates() -> Iterable[str]:
    from edesign.project.template import templates

    return templates()


def _laws() -> Iterable[str]:
    from edesign.damper.laws import LAWS

    return LAWS


def _sections() -> Iterable[str]:
    from edesign.frame.sections.profiles import profile_names

    return profile_names()


def _effects() -> Iterable[str]:
    from edesign.calibration.effect_list import known_effects

    return (effect.name for effect in known_effects())


def _suites() -> Iterable[str]:
    from edesign.ground_motion.suite import PACKAGES
    from edesign.project.records.suite_names import suite_names

    return (*PACKAGES, *suite_names())


def _keys(file: Path, key: str) -> list[object]:
    """What stands under a key of a YAML file: the items of a list, or the names of a mapping."""
    import yaml

    from edesign.project.reading.yaml_file import read_yaml_text
    from edesign.yaml_parser import quick_parser

    text = read_yaml_text(file, "file")
    found = yaml.load(text, Loader=quick_parser(text) or yaml.SafeLoader).get(key, ())
    return list(found)


def _analyses(file: Path) -> Iterable[str]:
    """Return the names of the analyses of a project; those of a study are made by its plan."""
    return (item["name"] for item in _keys(file, "analyses") if isinstance(item, dict))


def _archived(file: Path) -> Iterable[str]:
    from edesign.archive.reader import open_archive
    from edesign.report.archive_view import planned

    with open_archive(file) as archive:
        return planned(archive)


def _compensators(file: Path) -> Iterable[str]:
    return (str(name) for name in _keys(file, "compensators"))


def _kinds() -> Iterable[str]:
    from edesign.schema.kinds import KINDS

    return KINDS


template_names = _names(_templates)
law_names = _names(_laws)
section_names = _names(_sections)
effect_names = _names(_effects)
record_sources = _names(_suites)
kind_names = _names(_kinds)
analysis_names = _named(_analyses)
archived_names = _named(_archived)
compensator_names = _named(_compensators)
