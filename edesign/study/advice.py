"""What is allowed in a project, but may not be what its author means."""

from __future__ import annotations

from edesign.ground_motion.project_records import read_record
from edesign.project.analyses import HistoryAnalysis
from edesign.project.materials import ElasticMaterial
from edesign.project.problems import listed
from edesign.project.project import Project
from edesign.project.sections import ElasticSection

STEPS_A_PERIOD = 10  # Bathe (2014), 9.4.4: the trapezoidal rule lengthens a period by 3 % at ten steps


def advice(project: Project, period: float | None) -> list[str]:
    """Return one sentence for each thing that the author should know.

    Args:
        project: the validated project.
        period: fundamental period of its frame, s; None if it has no masses.

    Raises:
        InputError: a record cannot be read.
    """
    found = []
    staying = [
        name
        for name, run in project.frame.members.items()
        if isinstance(project.sections.get(run.section), ElasticSection)
        and not isinstance(project.materials[run.material], ElasticMaterial)
    ]
    if staying:
        found.append(
            f"{listed(staying, 3)} will not yield: a section given by `area` and `inertia` stays elastic whatever its "
            "material; give plates or `rectangles` for a section that yields"
        )
    given = project.integration.time_step if project.integration is not None else None
    names = dict.fromkeys(spec.record for spec in project.analyses if isinstance(spec, HistoryAnalysis))
    for record in (read_record(project, name) for name in names):
        step = given or record.time_step
        if step > record.time_step * (1 + 1e-9):
            found.append(
                f"the time step of {step:g} s is longer than that of the record {record.name}, {record.time_step:g} s: "
                "samples between the steps are passed over"
            )
        if period is not None and step > period / STEPS_A_PERIOD:
            found.append(
                f"the time step of {step:g} s is longer than 1/{STEPS_A_PERIOD} of the period T1 = {period:.4g} s"
            )
    return found
