"""`edesign check`: read a project, study, building or substructure tests, build the frame, and run nothing."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def check(
    project: Annotated[
        Path, typer.Argument(help="The project, study, building or substructure test file.", show_default=False)
    ],
) -> None:
    """Check a project, study, building or substructure test file, its records and its frame; print a summary."""
    from edesign.file_kinds import BUILDING, STUDY, SUBSTRUCTURE_TESTS, kind_of
    from edesign.report.tables.visible import visible_line

    kind = kind_of(project)  # what is needed for one kind alone is loaded for it alone
    if kind == SUBSTRUCTURE_TESTS:
        from edesign.building.building_sections import BuildingSections
        from edesign.project.substructure import load_rts_file
        from edesign.project.substructure.summary import summary
        from edesign.substructure.virtual_tests import VirtualLaboratory

        tests = load_rts_file(project, BuildingSections())
        laboratory = VirtualLaboratory(tests)
        _ = laboratory.drives  # records and commands are read
        warned = "\n".join(laboratory.laboratory.warnings)
        found = summary(tests) | ({"warnings": warned} if warned else {})
    elif kind == BUILDING:
        from edesign.building.building_file import load_building
        from edesign.space.check import check_building

        found = check_building(load_building(project))
    else:
        from edesign.building.project_file import load_project, load_study
        from edesign.study.check.summary import check_project, check_study

        found = check_study(load_study(project)) if kind == STUDY else check_project(load_project(project))
    for label, text in found.items():
        for i, line in enumerate(text.split("\n")):
            print(visible_line(f"{label + ':' if i == 0 else '':<11} {line}"))
    count = len(found.get("warnings", "").splitlines())
    print("ok" if not count else f"ok, with {count} warning{'s' * (count > 1)}")
