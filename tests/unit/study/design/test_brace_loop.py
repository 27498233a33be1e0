"""Braces of a design that histories load more than the estimate: chosen anew, kept in archives, reported."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from design_examples import MadeVerdict, design, shear_project

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.errors import InputError
from edesign.ground_motion.hazard import rules_in_force
from edesign.project.dampers.dampers import BraceSection, DamperRun, Dampers
from edesign.report.design.braces_table import braces_table
from edesign.study.design.design import DesignResult, run_design
from edesign.study.results.recording import coordinate

LAWS = "\ndampers: {laws: {oil: {type: viscous_power, parameters: {c: 1 kN*(s/m)^0.5, alpha: 0.5}}}}\n"
TEXT = (
    "method: viscous, law: oil, kind: chevron, bays: 1, state: initial, level: DBE, damping: 12 %, "
    "brace: {choose: [SHS], material: S355}, verify: {records: shake, levels: DBE, criteria: drift, change: target}"
)


class Histories:
    """The drift is met, and the dampers have a force that a design does not know."""

    def __init__(self, force: float) -> None:
        self.force, self.sections = force, list[tuple[str, ...]]()

    def respond(self, dampers: Dampers, number: int) -> Mapping[str, Group]:
        (run,) = dampers.devices
        assert isinstance(run, DamperRun) and isinstance(run.brace, BraceSection)
        self.sections.append(run.brace.sections)
        group = Group(attributes={"drift": 0.005, "level": "DBE", "status": "completed"})
        coordinate(group, "damper", ["V_1_1", "V_1_2"], "", "damper")
        group.add("damper_storey", ("damper",), [1, 2], "1", "storey")
        for which, sign in (("max", 1.0), ("min", -0.9)):
            group.add(f"damper_force_{which}", ("damper",), [sign * self.force] * 2, "N", "force")
        return {"only": group}

    def judge(self, groups: Mapping[str, Group]) -> list[MadeVerdict]:
        return [MadeVerdict(float(str(groups["only"].attributes["drift"])))]


def run(histories: Histories, resume: Group | None = None) -> DesignResult:
    project = shear_project(2, LAWS).with_values(
        {"materials.S355": {"law": "bilinear", "E": "210 GPa", "fy": "355 MPa"}}
    )
    made = (histories.respond, histories.judge)
    return run_design(project, "tried", design(TEXT, project), Path("."), *made, resume=resume)


def test_braces_are_chosen_for_the_forces_of_histories() -> None:
    """N_Ed is then the force of the histories over two braces at 45 degrees, whatever was estimated."""
    weak, strong = Histories(1.0), Histories(2e6)
    light, heavy = run(weak), run(strong)
    assert light.status == heavy.status == "completed"
    assert len(weak.sections) == 1 and len(strong.sections) == 2 and strong.sections[0] != strong.sections[1]
    force, resistance = (np.asarray(heavy.group.variables[f"brace_{name}"].values) for name in ("force", "resistance"))
    assert force == pytest.approx(np.full(2, 2e6 / np.sqrt(2.0))) and np.all(force <= resistance)
    assert tuple(heavy.group.variables["brace_section"].values) == strong.sections[-1]
    table = braces_table(heavy.group, (), {}, rules_in_force(None))
    assert [row[0] for row in table.rows] == ["design", "design"] and "chosen from lists" in table.title


def test_a_list_that_ends_too_soon_fails_the_design_and_says_so() -> None:
    """1e9 N over two braces at 45 degrees are 707.1 MN."""
    result = run(Histories(1e9))
    assert result.status == "failed" and "no section holds 7.071e+05 kN" in result.reason


def test_braces_that_nothing_limits_are_refused_until_their_steel_yields() -> None:
    """The steel of the shear frame is elastic without `fy`; that of all other tests here yields."""
    project, histories = shear_project(2, LAWS), Histories(1.0)
    spec = design(TEXT.replace("S355", "steel"), project)
    with pytest.raises(InputError, match=r"brace\.material: `steel` does not yield.*give one with `fy`"):
        run_design(project, "tried", spec, Path("."), histories.respond, histories.judge)


def test_finished_rounds_keep_their_forces(tmp_path: Path) -> None:
    whole = run(Histories(2e6))
    with ArchiveWriter(tmp_path / "a.h5", Group()) as writer:
        writer.write("designs/tried", whole.group)
        path = writer.finish({"status": "completed"})
    with open_archive(path) as archive:
        kept = archive.group("designs/tried")
    again = Histories(2e6)
    result = run(again, kept)
    assert again.sections == []
    assert result.group.attributes["devices"] == whole.group.attributes["devices"]
