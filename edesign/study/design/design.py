"""One design of a study: sizing by its method, verification by histories, everything kept."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from edesign.archive.dataset import Group
from edesign.codes.device_factors import NONE, DeviceFactors
from edesign.errors import AnalysisError, InputError
from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.dampers import Dampers
from edesign.project.dampers.designs import HystereticDesign, SizedDesign, ViscousDesign
from edesign.study.design.beside import NOTHING_BESIDE, Standing
from edesign.study.design.designer import Designer, labels
from edesign.study.design.elastomer.designer import ElastomerDesigner
from edesign.study.design.hysteretic.designer import HystereticDesigner
from edesign.study.design.loop import Round, Search
from edesign.study.design.verification import Judge, Respond
from edesign.study.design.viscous.designer import ViscousDesigner


@dataclass(frozen=True)
class DesignResult:
    """The result of a design: its dampers and what the archive keeps of it.

    Attributes:
        dampers: the laws of the project with the devices of the design (of its last round if it failed).
        group: for the archive, designs/NAME.
        status: "completed" or "failed".
        reason: of the failure.
        standing: its dampers as designs beside it see them.
    """

    dampers: Dampers
    group: Group
    status: str
    reason: str
    standing: Standing = NOTHING_BESIDE


def run_design(
    project: AnalysisFile,
    name: str,
    spec: SizedDesign,
    folder: Path,
    respond: Respond | None = None,
    judge: Judge | None = None,
    resume: Group | None = None,
    progress: Callable[[str], None] = lambda text: None,
    keep: Callable[[Group], None] | None = None,
    factors: DeviceFactors = NONE,
    beside: Standing = NOTHING_BESIDE,
) -> DesignResult:
    """Design dampers, and change them until the histories meet the criteria, if the design asks for it.

    Args:
        project: with the law; checked by `check_design`.
        folder: that files named in it are relative to.
        respond: runs the histories of a round; None: the design is not verified.
        judge: judges the histories of a round; None: the design is not verified.
        resume: what an earlier run kept; its rounds are not computed again.
        progress: called with what goes on.
        keep: given the group after each verified round, for `resume`.
        factors: of the code, on stroke and velocity of the dampers, and on what holds them.

    Returns:
        The dampers, the archived group and the status; a design that fails for numerical reasons has no dampers.

    Raises:
        InputError: no damper reaches the target, or a file or law is wrong.

    Source: thesis 5.3.4.
    """
    try:
        run = _designer(project, name, spec, folder, progress, factors, beside)
        done = run.search(respond, judge, resume, keep)
        status = "failed" if done.reason else "completed"
        group = run.group(done, status)
    except AnalysisError as error:
        before = project.dampers
        assert before is not None
        group = Group(attributes=labels(spec) | {"status": "failed", "reason": str(error)})
        return DesignResult(before.model_copy(update={"devices": ()}), group, "failed", str(error))
    except InputError as error:
        raise _named(name, error) from error
    sizing = done.chosen.sizing
    return DesignResult(run.dampers(sizing), group, status, done.reason, run.standing(sizing))


def check_sizing(
    project: AnalysisFile,
    name: str,
    spec: SizedDesign,
    folder: Path,
    factors: DeviceFactors = NONE,
    beside: Standing = NOTHING_BESIDE,
) -> Standing | None:
    """Size a design once, so that a target which no damper can reach shows before anything is run.

    A sizing that does not converge is left to `run_design`, which keeps its history.

    Args:
        project: the project with the law, as for `run_design`.
        folder: the folder that files named in the design are relative to.
        factors: of the code, on dampers and on what holds them.

    Returns:
        The dampers as designs beside this one see them; None: the sizing does not converge.

    Raises:
        InputError: no damper reaches the target, or a file or law is wrong.
    """
    try:
        run = _designer(project, name, spec, folder, lambda text: None, factors, beside)
        return run.standing(run.make(run.range()[0]))
    except AnalysisError:
        return None
    except InputError as error:
        raise _named(name, error) from error


def first_warnings(
    project: AnalysisFile,
    name: str,
    spec: SizedDesign,
    folder: Path,
    factors: DeviceFactors = NONE,
    beside: Standing = NOTHING_BESIDE,
) -> list[str]:
    """Return the warnings about a design before any history; for a verified design, those about its first round.

    Args:
        project: the project with the law, which has passed `check_sizing`.
        folder: the folder that files named in the design are relative to.
        factors: of the code, on dampers and on what holds them.

    Returns:
        One sentence for each warning.
    """
    try:
        run = _designer(project, name, spec, folder, lambda text: None, factors, beside)
        value = run.range()[0]
        only = Round(1, value, run.make(value))
        reason = only.sizing.reason
        found = run.group(Search((only,), only, reason), "checked").attributes.get("warnings", [])
        found = [f"it will fail: {reason}", *found] if reason else found
    except AnalysisError as error:
        found = [f"it will fail: {error}"]
    which = "" if spec.verify is None else ", first round"
    return [f"design {name}{which}: {text}" for text in found]


def _designer(
    project: AnalysisFile,
    name: str,
    spec: SizedDesign,
    folder: Path,
    progress: Callable[[str], None],
    factors: DeviceFactors,
    beside: Standing,
) -> Designer[Any]:
    run: Designer[Any]
    if isinstance(spec, ViscousDesign):
        run = ViscousDesigner(project, name, spec, progress, beside)
    elif isinstance(spec, HystereticDesign):
        run = HystereticDesigner(project, name, spec, progress, beside)
    else:
        run = ElastomerDesigner(project, name, spec, folder, progress, beside)
    run.factors = factors
    return run


def _named(name: str, error: InputError) -> InputError:
    return error if str(error).startswith("designs.") else InputError(f"designs.{name}: {error}")
