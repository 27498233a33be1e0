"""Cross checks of the structure: devices that exist and move together, storeys, modes, and a step that is stable."""

from __future__ import annotations

import math

import numpy as np

from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.project.dampers.device_names import devices_by_name
from edesign.project.project import Project
from edesign.project.reading.problems import Keys, Problems, did_you_mean, listed, unknown_name
from edesign.project.substructure.checks_rig import nyquist
from edesign.project.substructure.rts_file import RtsFile
from edesign.project.substructure.structure import ProjectStructure, ShearBuilding, ShearModal, ShearRayleigh

_KEYS: Keys = ("structure",)
_NO_FRAME = "it is of a frame that may yield: `structure: {project: ..., physical: ..., frame: nonlinear}` [E-PART-06]"
LARGEST_STEP = {"newmark_explicit": 2.0, "central_difference": 2.0, "bogacki_shampine": math.sqrt(3.0)}
"""Largest product of circular frequency and step with which an explicit method does not diverge."""


def check_structure(rts: RtsFile, problems: Problems) -> None:
    """Check the numerical part of the tests; the file has no schema problems."""
    if isinstance(rts.structure, ProjectStructure) and rts.project is not None:
        _physical(rts.structure, rts.project, problems)
        if rts.project.isolation is not None:
            message = f"{rts.project.path} has an isolated base, which tests of its dampers do not know [E-DESIGN-07]"
            problems.at_value((*_KEYS, "project"), message)
        _analysis(rts.structure, rts.project, problems)
        _frame(rts, rts.structure, rts.project, problems)
        for key in ("masses", "damping"):
            if getattr(rts.project, key) is None:
                message = f"the numerical part needs `{key}`, and {rts.project.path} has none [E-KEY-02]"
                problems.at_value((*_KEYS, "project"), message)
    elif "frame_steps" in rts.integration.model_fields_set:
        problems.at_value(("integration", "frame_steps"), _NO_FRAME)
    if isinstance(rts.structure, ShearBuilding) and _storeys(rts.structure, problems):
        _modes(rts.structure, problems)
        _slow_enough(rts, rts.structure, problems)
        _stable(rts, rts.structure, problems)


def frequencies(building: ShearBuilding) -> tuple[float, ...]:
    """Return the natural frequencies of a shear building without the specimen, Hz, the lowest first."""
    k = np.asarray(building.stiffnesses)
    above = np.append(k[1:], 0.0)
    stiffness = np.diag(k + above) - np.diag(k[1:], 1) - np.diag(k[1:], -1)
    root = 1.0 / np.sqrt(np.asarray(building.masses))
    squares = np.linalg.eigvalsh(root[:, None] * stiffness * root)
    return tuple(float(w) / (2.0 * math.pi) for w in np.sqrt(np.maximum(squares, 0.0)))


def _physical(structure: ProjectStructure, project: Project, problems: Problems) -> None:
    known = devices_by_name(project.frame, project.dampers)
    keys = (*_KEYS, "physical")
    if not known:
        problems.at_value(keys, f"{project.path} has no devices under `dampers` [E-DAMPER-04]")
        return
    given = structure.physical
    for i, name in enumerate(given):
        if name not in known:
            problems.at_item(keys, i, unknown_name("device", name, known, "; they are named by kind, bay and storey"))
        elif name in given[:i]:
            problems.at_item(keys, i, f"`{name}` comes twice [E-NAME-02]")
        elif known[name][0].brace != "rigid":
            message = f"`{name}` has a brace in series; the laboratory has the device alone. Give it `brace: rigid`"
            problems.at_item(keys, i, f"{message} in the project, and the brace to the frame [E-DAMPER-02]")
    there = [known[name] for name in dict.fromkeys(given) if name in known]
    if len(there) < 2:
        return
    together = {(device.kind, storey) for device, storey in there}
    if len(together) > 1 or not all(storey for _, storey in there):
        message = f"{listed(given)} deform differently, and there is one actuator, which moves one device; name one"
        problems.at_value(keys, f"{message}, the others stay in the computer [E-PART-06]")
    elif len({device.law for device, _ in there}) > 1:
        problems.at_value(
            keys, f"{listed(given)} have different laws; the actuator moves one specimen of one law [E-PART-06]"
        )
    else:
        message = f"{listed(given)}: the actuator moves one device; give the project one device with"
        problems.at_value(keys, f"{message} `number: {len(there)}` for as many side by side, and name it [E-PART-06]")


def _analysis(structure: ProjectStructure, project: Project, problems: Problems) -> None:
    if structure.analysis is None:
        return
    keys = (*_KEYS, "analysis")
    histories = [one.name for one in project.analyses if isinstance(one, HistoryAnalysis)]
    found = next((one for one in project.analyses if one.name == structure.analysis), None)
    if found is None:
        hint = did_you_mean(structure.analysis, histories)
        message = (
            f"there is no analysis `{structure.analysis}`{hint} (histories there: {listed(histories)}) [E-NAME-01]"
        )
        problems.at_value(keys, message)
    elif not isinstance(found, HistoryAnalysis):
        problems.at_value(
            keys, f"`{found.name}` is a {found.kind} analysis; a history is needed: {listed(histories)} [E-VALUE-01]"
        )
    elif not found.dampers:
        message = f"`{found.name}` has `dampers: false`, so no device that could be tested [E-DAMPER-04]"
        others = [one.name for one in project.analyses if isinstance(one, HistoryAnalysis) and one.dampers]
        problems.at_value(keys, message + did_you_mean(found.name, others))


def _frame(rts: RtsFile, structure: ProjectStructure, project: Project, problems: Problems) -> None:
    """A frame that may yield is integrated as its project says, and no linear method is chosen for it."""
    given = rts.integration.model_fields_set
    if structure.frame == "linear":
        if "frame_steps" in given:
            problems.at_value(("integration", "frame_steps"), _NO_FRAME)
        return
    if project.integration is None:
        message = f"a frame that may yield needs `integration`, and {project.path} has none [E-KEY-02]"
        problems.at_value((*_KEYS, "frame"), message)
    for key in ("method", "rho_inf"):
        if key in given:
            message = (
                f"with `structure.frame: nonlinear` the frame is integrated as {project.path} says; leave it out"
                " [E-KEY-03]"
            )
            problems.at_value(("integration", key), message)


def _storeys(building: ShearBuilding, problems: Problems) -> bool:
    """Whether there is one stiffness for each mass."""
    count = len(building.masses)
    if len(building.stiffnesses) != count:
        message = (
            f"{len(building.stiffnesses)} stiffnesses for {count} masses; each storey carries one floor [E-VALUE-04]"
        )
        problems.at_value((*_KEYS, "stiffnesses"), message)
        return False
    if building.storey > count:
        problems.at_value(
            (*_KEYS, "storey"), f"there is no storey {building.storey}; they are numbered 1 to {count} [E-NAME-01]"
        )
    return True


def _modes(building: ShearBuilding, problems: Problems) -> None:
    damping, count = building.damping, len(building.masses)
    keys = (*_KEYS, "damping", "modes")
    numbered = f"there are modes 1 to {count}" if count > 1 else "there is mode 1 only, for which `kind: modal` does"
    if isinstance(damping, ShearRayleigh):
        for i, mode in enumerate(damping.modes):
            if mode > count:
                problems.at_value((*keys, i), f"there is no mode {mode}; {numbered} [E-NAME-01]")
        if damping.modes[0] == damping.modes[1]:
            problems.at_value(
                (*keys, 1), f"mode {damping.modes[0]} stands here twice; two different ones are needed [E-NAME-02]"
            )
    elif isinstance(damping, ShearModal) and damping.modes is not None and damping.modes > count:
        problems.at_value(keys, f"there are {damping.modes} modes asked for, and {count} of them [E-NAME-01]")


def _slow_enough(rts: RtsFile, building: ShearBuilding, problems: Problems) -> None:
    """Steps that do not see the lowest mode see nothing of the structure; higher ones may be as stiff as they like."""
    lowest = frequencies(building)[0]
    if not lowest < nyquist(rts):
        message = (
            f"the lowest frequency is {lowest:.3g} Hz, and half the rate of the main step is {nyquist(rts):.4g} Hz"
        )
        problems.at_value(
            (*_KEYS, "stiffnesses"), f"{message}; check masses and stiffnesses, or take a shorter step [E-RTS-03]"
        )


def _stable(rts: RtsFile, building: ShearBuilding, problems: Problems) -> None:
    """Explicit methods diverge beyond a step that the highest mode gives."""
    method = rts.integration.method
    if method not in LARGEST_STEP:
        return
    highest = frequencies(building)[-1]
    largest = LARGEST_STEP[method] / (2.0 * math.pi * highest)
    if rts.loop.main_step > largest:
        message = (
            f"with `{method}` mode {len(building.masses)} ({highest:.4g} Hz) diverges: the step may be at most "
            f"{1e3 * largest:.3g} ms, and it is {1e3 * rts.loop.main_step:.4g} ms; or take `kr_alpha` [E-RTS-03]"
        )
        problems.at_value(("loop", "main_step"), message)
