"""Compensators for the signal processor of a laboratory: a folder of C99, a self test, and matrices."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from importlib import resources
from pathlib import Path
from string import Template

import numpy as np

from edesign._version import __version__
from edesign.archive.files import make_folder, reason, write_text
from edesign.core.compensator import AdaptiveTimeSeries, Compensator, DifferenceEquation, LiveDelay, run_compensator
from edesign.core.compensator_source import HEADER, header_text, hexadecimal, initialiser, least_sizes
from edesign.core.damper import LawValues
from edesign.core.substructure import SubstructureLoop
from edesign.errors import ArchiveError, InputError
from edesign.file_kinds.recognise import head_of
from edesign.input_files import spare_inputs
from edesign.substructure.compensation.compensator_matrices import INPUTS, OUTPUTS, StateSpace, state_space
from edesign.substructure.rig import rigs

FILES = (HEADER, "compensator.h", "compensator.c", "self_test.c", "self_test.csv", "timing.c", "README.md")
"""Of every export; `matrices.csv` is added for a difference equation."""
MATRICES = "matrices.csv"
_TEST_STEPS = 2048
_SUB_STEPS = 5
_WRITTEN = re.compile(r"Written by edesign \S+ for the compensator (\"[^\"]*\")")  # in the first line of each file
_SINES = ((3e-3, 0.7, 0.1), (2e-3, 1.9, 1.0), (1e-3, 3.8, 2.0))  # m, Hz, rad: targets of the self test
_COLUMNS = "target, target_velocity, target_acceleration, measured, command, force_correction"


def export(
    compensator: Compensator, step: float, folder: Path, name: str, *, overwrite: bool = False
) -> tuple[Path, ...]:
    """Write a compensator as C99 for a signal processor, with a self test, a timing program and a README.

    Files of an earlier export of a compensator of the same name are replaced; a file of it that is no longer made is
    deleted.

    Args:
        step: main step, s.
        folder: where the files go; made if it is not there.
        name: of the compensator; functions begin with it, as far as it can stand in C.
        overwrite: whether other files of the same names are replaced too.

    Returns:
        The files, whose names are `FILES` and, for a difference equation, `MATRICES`.

    Raises:
        ArchiveError: they cannot be written.
        CoreError: a parameter of the compensator is out of range.
        InputError: a file is there that edesign did not write, or wrote for another compensator; or an input of the
            command. Nothing is written then.
    """
    run_compensator(compensator, step, np.zeros((0, 3)), np.zeros(0))  # checks the parameters
    known_as = identifier(name)
    texts = _texts(compensator, step, known_as, " ".join(name.split()) or known_as)
    check_export(folder, name, overwrite=overwrite)
    make_folder(folder)
    _delete_stale(folder, texts, known_as)
    for file, text in texts.items():
        write_text(text, folder / file)
    return tuple(folder / file for file in texts)


def check_export(folder: Path, name: str, *, overwrite: bool = False) -> None:
    """Check that `export` may write into a folder: nothing of the user and of another compensator is replaced.

    Args:
        folder: where the files go.
        overwrite: whether other files may be replaced.

    Raises:
        InputError: a file is there that edesign did not write, or wrote for another compensator; or an input of the
            command.
    """
    for path in (folder / file for file in (*FILES, MATRICES)):
        spare_inputs(path)
        owner = _owner(path)
        if owner is None or overwrite or owner == identifier(name):
            continue
        what = f"this is of the compensator `{owner}`" if owner else "edesign did not write this file"
        raise InputError(f"{path}: {what}, and it is left as it is; choose another folder, or --overwrite [E-FILE-07]")


def identifier(name: str) -> str:
    """Return a name as it can stand in C: letters of ASCII, digits and underscores, and none of edesign's own.

    Args:
        name: of the compensator.
    """
    known_as = re.sub(r"[^A-Za-z0-9]+", "_", name).strip("_")
    usual = re.match(r"[A-Za-z]", known_as) and not known_as.lower().startswith("ed_")
    return known_as if usual else f"compensator_{known_as}".rstrip("_")


def _owner(path: Path) -> str | None:
    """The compensator that a file was written for; "": it is another file; None: there is none."""
    if not os.path.lexists(path):
        return None
    first_line = (head_of(path) or b"").decode("utf-8", errors="replace").partition("\n")[0]
    written = _WRITTEN.search(first_line)
    return json.loads(written[1]) if written else ""


def _delete_stale(folder: Path, texts: Mapping[str, str], known_as: str) -> None:
    path = folder / MATRICES
    if MATRICES in texts or _owner(path) != known_as:
        return
    try:
        path.unlink()
    except OSError as error:
        raise ArchiveError(
            f"{path}: cannot be deleted, and is of an earlier export: {reason(error)} [E-FILE-06]"
        ) from error


# --- texts of the files


def _texts(compensator: Compensator, step: float, known_as: str, title: str) -> dict[str, str]:
    mark = f'Written by edesign {__version__} for the compensator "{known_as}"; its next export replaces this file.'
    matrices = state_space(compensator) if isinstance(compensator, DifferenceEquation) else None
    rows = _self_test(compensator, step)
    values = {"mark": mark, "title": title, "rows": str(len(rows))}
    values |= _of_compensator(compensator, step) | _of_code(compensator, step, known_as) | _of_matrices(matrices)
    made = {
        HEADER: f"/* {mark} */\n{header_text()}",
        "self_test.csv": f"# {mark}\n# {_COLUMNS}\n{_lines(map(hexadecimal, row) for row in rows)}",
    }
    texts = {file: made[file] if file in made else _filled(file, values) for file in FILES}
    return texts if matrices is None else {**texts, MATRICES: f"# {mark}\n{_matrices(matrices)}"}


def _of_compensator(compensator: Compensator, step: float) -> dict[str, str]:
    """What the templates say of it in words."""
    return {
        "rate": f"{1.0 / step:.6g}",
        "budget": f"{1e6 * step:.6g}",
        "needs": _needs(compensator),
        "force_note": "" if _corrects_force(compensator) else "; this compensator always returns 0",
        "described": "\n    ".join(_described(compensator)),
    }


def _of_code(compensator: Compensator, step: float, known_as: str) -> dict[str, str]:
    """What the templates have of its code."""
    sizes = least_sizes(compensator, step)
    return {
        "name": known_as,
        "guard": f"{known_as.upper()}_COMPENSATOR_H",
        "step": repr(float(step)),
        "memory": str(sizes.memory),
        "window": str(sizes.window),
        "state_size": str(sizes.state),
        "parameters_size": str(sizes.parameters),
        "parameters": initialiser(compensator, step),
    }


def _of_matrices(found: StateSpace | None) -> dict[str, str]:
    """What the README says of matrices."""
    if found is None:
        return {"matrices_file": "", "matrices": ""}
    return {
        "matrices_file": "| `matrices.csv` | the same as a discrete state space |\n",
        "matrices": _filled("matrices.md", {"states": str(found.states)}),
    }


def _filled(file: str, values: Mapping[str, str]) -> str:
    template = (
        resources.files("edesign.substructure.compensation")
        .joinpath(f"exported/{file}.template")
        .read_text(encoding="utf-8")
    )
    return Template(template).substitute(values)


def _lines(rows: Iterable[Iterable[str]]) -> str:
    return "".join(",".join(row) + "\n" for row in rows)


def _matrices(found: StateSpace) -> str:
    """[A B; C D] under names, in as many digits as a number needs."""
    states = [f"state_{i + 1}" for i in range(found.states)]
    block = np.block([[found.A, found.B], [found.C, found.D]])
    rows = ([of, *map(_shortest, values)] for of, values in zip([*states, *OUTPUTS], block.tolist(), strict=True))
    return _lines([["", *states, *INPUTS], *rows])


def _shortest(value: float) -> str:
    return repr(int(value) if value == int(value) and abs(value) < 1e15 else value)


def _corrects_force(compensator: Compensator) -> bool:
    return isinstance(compensator, DifferenceEquation) and bool(compensator.force_terms)


def _needs(compensator: Compensator) -> str:
    """Which inputs count."""
    if isinstance(compensator, LiveDelay):
        used = ["target", "measured"]
    elif isinstance(compensator, AdaptiveTimeSeries):
        used = ["target", "measured"] if compensator.differences else ["target", "velocity", "acceleration", "measured"]
    else:
        of = {term.of for term in (*compensator.terms, *compensator.force_terms)}
        used = [signal for signal in INPUTS if signal in of]
    shown = {"target": "`x`", "velocity": "`v`", "acceleration": "`a`", "measured": "`measured`"}
    unused = [shown[signal] for signal in INPUTS if signal not in used]
    if not unused:
        return "This compensator needs all of them."
    return f"This compensator does not look at {' and '.join(unused)}; any finite value will do."


def _described(compensator: Compensator) -> list[str]:
    """Its equation or its parameters, a line each."""
    if isinstance(compensator, DifferenceEquation):
        return [*_sum("command", compensator), *(_sum("force", compensator) if compensator.force_terms else [])]
    shown = {key: value for key, value in vars(compensator).items() if value is not None}
    return [f"{key} = {np.asarray(value).tolist()}" for key, value in shown.items()]


def _sum(of: str, equation: DifferenceEquation) -> list[str]:
    terms = equation.terms if of == "command" else equation.force_terms
    shown = [f"  {term.coefficient:+.17g} {term.of}[k{-term.lag or '':}]" for term in terms]
    return [f"{'force correction' if of == 'force' else of}[k] =", *(shown or ["  0"])]


# --- self test


def _self_test(compensator: Compensator, step: float) -> Sequence[Sequence[float]]:
    """Rows of a virtual test: what the compensator was given, (m, 4), its command, and its correction of the force.

    The rig is late by some 10 ms, the specimen a spring; what is measured thus depends on the command.
    """
    time = step * np.arange(_TEST_STEPS + 1)
    motion = np.zeros((len(time), 3))
    for amplitude, frequency, phase in _SINES:
        omega = 2.0 * np.pi * frequency
        for order in range(3):  # each derivative is a quarter ahead
            motion[:, order] += amplitude * omega**order * np.sin(omega * time + phase + 0.5 * np.pi * order)
    rig = rigs.second_order(21.4, 0.4, 4.3e-3).discrete(step / _SUB_STEPS)
    loop = SubstructureLoop(step, _SUB_STEPS, compensator, rig, LawValues("kelvin_voigt", (1e6, 0.0)), abort=1.0)
    measured = loop.run(motion).measured
    target, measured = motion[1 : len(measured)], measured[:-1]
    command = run_compensator(compensator, step, target, measured)
    force = _force_corrections(compensator, target, measured, command)
    rows: list[list[float]] = np.column_stack([target, measured, command, force]).tolist()
    return rows


def _force_corrections(
    compensator: Compensator, target: np.ndarray, measured: np.ndarray, command: np.ndarray
) -> np.ndarray:
    """What is added to the force (N), summed in the order in which the core sums it."""
    corrections = np.zeros(len(command))
    if not isinstance(compensator, DifferenceEquation):
        return corrections
    signals = dict(zip(INPUTS, (*target.T, measured), strict=True)) | {"command": command}
    for term in compensator.force_terms:
        late = np.concatenate([np.zeros(term.lag), signals[term.of]])[: len(command)]
        corrections += term.coefficient * late
    return corrections
