"""What is allowed in a project, but may not be what its author means."""

from __future__ import annotations

from collections.abc import Iterable

from edesign.ground_motion.plausibility import doubts
from edesign.ground_motion.record import Record
from edesign.project.materials import ElasticMaterial
from edesign.project.problems import listed
from edesign.project.project import Project
from edesign.project.sections import ElasticSection

STEPS_A_PERIOD = 10  # Bathe (2014), 9.4.4: the trapezoidal rule lengthens a period by 3 % at ten steps


def advice(project: Project, period: float | None, records: Iterable[Record]) -> list[str]:
    """Return one sentence for each thing that the author should know.

    Args:
        project: the validated project.
        period: fundamental period of its frame, s; None if it has no masses.
        records: as recorded, those that its histories use.
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
    records = tuple(records)
    found += [f"record {record.name}: {doubt}" for record in records for doubt in doubts(record)]
    given = project.integration.time_step if project.integration is not None else None
    if given is not None:
        passed = [record for record in records if given > record.time_step * (1 + 1e-9)]
        if passed:
            shortest = min(record.time_step for record in passed)
            found.append(
                f"the time step of {given:g} s is longer than that of {listed([r.name for r in passed], 3)} "
                f"({shortest:g} s): samples between the steps are passed over"
            )
    longest = given or max((record.time_step for record in records), default=0.0)
    if period is not None and longest > period / STEPS_A_PERIOD:
        found.append(
            f"the time step of {longest:g} s is longer than 1/{STEPS_A_PERIOD} of the period T1 = {period:.4g} s"
        )
    return found
