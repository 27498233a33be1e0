"""The seismic action on a command line: of a project file, or given by options."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer
import yaml
from pydantic_core import PydanticCustomError

from edesign.errors import InputError
from edesign.frame.project_file import load_project
from edesign.ground_motion.hazard import checked_hazard, elastic_spectrum, factor_of_level
from edesign.project.actions.hazard import OTHER_CODES, AnyHazard, EC8Hazard
from edesign.project.actions.hazard_base import Hazard
from edesign.project.notation.quantities import TIME, Kind
from edesign.project.notation.units import parse_quantity
from edesign.project.project import Project
from edesign.project.reading.base import Model
from edesign.project.reading.yaml_file import check_model
from edesign.project.reading.yaml_nodes import parse
from edesign.study.analysis import modal

ProjectFile = Annotated[
    Path | None, typer.Option("--project", "-p", help="Take the seismic action (and T1) from this project file.")
]
LevelName = Annotated[
    str | None, typer.Option("--level", help="Hazard level of the project, or of --set; gamma_I = 1 without.")
]
Code = Annotated[str | None, typer.Option("--code", help="Without a project: the code, `ec8-2004` by default.")]
Values = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="KEY=VALUE", help="A key of the action of --code, such as `S_DS=1.0g`."),
]
Country = Annotated[str | None, typer.Option("--country", help="National parameters, such as `greece`.")]
Zone = Annotated[str | None, typer.Option("--zone", help="Seismic zone of the country, such as `3`.")]
GroundAcceleration = Annotated[str | None, typer.Option("--a-gr", help="a_gR instead of a zone: `0.36g`, `3.5m/s^2`.")]
Ground = Annotated[str | None, typer.Option("--ground", help="Ground type A to E.")]
SpectrumType = Annotated[str | None, typer.Option("--type", help="Type of the spectrum, 1 or 2.")]
Damping = Annotated[str | None, typer.Option("--damping", help="Of the elastic spectrum; `5%` by default.")]
Importance = Annotated[
    str | None, typer.Option("--gamma", help="Importance: a factor `1.71`, a class `III`, or a probability `2%`.")
]

POSSIBLE_T1 = (0.01, 60.0)  # s
CLASSES = ("I", "II", "III", "IV")
GIVEN = "given"  # name of the level that --gamma makes


def load(path: Path | None) -> Project | None:
    """Return the project of a path, if one is given."""
    return None if path is None else load_project(path)


def fundamental_period(project: Project | None, text: str | None) -> float | None:
    """Return T1 (s) as given, else that of the project's frame under gravity, else None."""
    if text is not None:
        period = quantity(text, TIME, "--t1")
        low, high = POSSIBLE_T1
        if not low <= period <= high:
            raise InputError(
                f"--t1: {period:g} s is no period of a structure; {low:g} s to {high:g} s are possible [E-CLI-04]"
            )
        return period
    return None if project is None else max(modal.fundamental_period(project) or (), default=None)


def hazard(
    project: Project | None, options: dict[str, str | None], level: str | None, values: list[str] | None = None
) -> tuple[Hazard, str | None]:
    """Return the seismic action, and the level asked for (None: gamma_I = 1).

    Args:
        project: the project, if one is named.
        options: of the command line: code, country, zone, a_gR, ground, spectrum, damping, gamma.
        level: of the project.
        values: of `--set`.

    Raises:
        InputError: project and options exclude each other, or a value is wrong; the message names the option.
    """
    given = {key: value for key, value in options.items() if value is not None}
    if values and project is not None:
        raise InputError("--set: the project file says this; leave the option out [E-CLI-02]")
    if given.get("code", "ec8-2004") in OTHER_CODES and project is None:
        return _of_other_code(given, values or [], level)
    if values:
        raise InputError("--set: only with a --code other than `ec8-2004`, whose action has options [E-CLI-01]")
    if project is not None:
        if given:
            raise InputError(f"{_flag(next(iter(given)))}: the project file says this; leave the option out [E-CLI-02]")
        found = checked_hazard(project)
        if level is not None:
            factor_of_level(found, level)
        return found, level
    if level is not None:
        raise InputError("--level: only with --project; without one, --gamma gives the importance [E-CLI-01]")
    return _from_options(given), GIVEN if "gamma" in given else None


def _from_options(given: dict[str, str]) -> Hazard:
    data: dict[str, Any] = {"code": "ec8-2004", "spectrum": "1", **{k: v for k, v in given.items() if k != "gamma"}}
    for key in ("spectrum",):
        data[key] = int(data[key]) if str(data[key]).isdigit() else data[key]
    if "gamma" in given:
        data["levels"] = {GIVEN: _importance(given["gamma"])}
    found, problems = check_model(yaml.safe_dump(data, sort_keys=False), EC8Hazard, "seismic action", "code: ec8-2004")
    if found is None:
        lines = [f"{_flag(problem.keys_text)}: {problem.message}" for problem in problems.found]
        raise InputError(
            "\n".join(lines) + "\n(the seismic action comes from --project, or from these options) [E-CLI-03]"
        )
    if found.zone is not None and found.a_gR is not None:
        raise InputError(
            "--zone: --a-gr gives the reference ground acceleration already; leave one of them out [E-CLI-02]"
        )
    if found.zone is None and found.a_gR is None:
        raise InputError(
            "--a-gr: the reference ground acceleration is missing; give it, or --country and --zone [E-CLI-03]"
        )
    elastic_spectrum(found, GIVEN if found.levels else None)  # names of the code that do not exist show here
    return found


class _OtherCode(Model):
    """An action with its key.

    Attributes:
        hazard: of any code.
    """

    hazard: AnyHazard


def _of_other_code(given: dict[str, str], values: list[str], level: str | None) -> tuple[Hazard, str | None]:
    """The action of a code whose keys `--set` gives, as a project file has them, and the level."""
    code = given["code"]
    if code == "user":
        raise InputError("--code: spectra as tables stand in a project file; name it by --project [E-CLI-04]")
    for key in ("country", "zone", "a_gR", "spectrum", "gamma"):
        if key in given:
            raise InputError(f"{_flag(key)}: only with the code `ec8-2004`; {code} has --set KEY=VALUE [E-CLI-01]")
    data: dict[str, Any] = {key: given[key] for key in ("code", "ground", "damping") if key in given}
    for text in values:
        key, sign, value = text.partition("=")
        if not sign or not key.strip() or not value.strip():
            raise InputError(f"--set: `{text}` is no KEY=VALUE, such as `S_DS=1.0g` [E-CLI-04]")
        *above, last = key.strip().split(".")
        place = data
        for name in above:
            place = place.setdefault(name, {})
            if not isinstance(place, dict):
                raise InputError(f"--set: `{text}`: {name} has a value already [E-CLI-02]")
        place[last] = parse(value.strip())[0].plain()
    found, problems = check_model(
        yaml.safe_dump({"hazard": data}, sort_keys=False), _OtherCode, "seismic action", "hazard:"
    )
    if found is None:
        lines = [f"{_set_flag(problem.keys_text)}: {problem.message}" for problem in problems.found]
        raise InputError(
            "\n".join(lines)
            + f"\n(the seismic action of {code} comes from --project, or from --set KEY=VALUE) [E-CLI-03]"
        )
    elastic_spectrum(found.hazard, level)  # a level that is missing or does not exist shows here
    return found.hazard, level


def _set_flag(keys: str) -> str:
    key = keys.removeprefix("hazard").removeprefix(".")
    return f"--{key}" if key in ("code", "ground", "damping") else f"--set {key}".strip()


def _importance(text: str) -> dict[str, str]:
    if text.upper() in CLASSES:
        return {"importance_class": text.upper()}
    return {"probability": text} if text.rstrip().endswith("%") else {"gamma_I": text}


_FLAGS = {"a_gR": "--a-gr", "spectrum": "--type", "levels": "--gamma"}


def _flag(key: str) -> str:
    key = key.partition(".")[0]
    return _FLAGS.get(key, f"--{key.replace('_', '-')}")


def quantity(text: str, kind: Kind, option: str) -> float:
    """Read the value of an option with its unit.

    Args:
        text: such as `0.05s`.
        kind: of `edesign.project.notation.units`.
        option: its name, for messages.

    Raises:
        InputError: no number, no unit, or the wrong one.
    """
    try:
        return parse_quantity(text, kind, "positive")
    except PydanticCustomError as error:
        raise InputError(f"{option}: {error.message()}") from None
