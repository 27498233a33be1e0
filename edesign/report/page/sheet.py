"""The report of a laboratory's sheet: its sections and cover."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from edesign._version import __version__
from edesign.damper.testing.acceptance import Acceptance, Judged
from edesign.damper.testing.device_cycles import Run
from edesign.damper.testing.measured_histories import DamperTest
from edesign.project.document import Document
from edesign.report.damper.sheet_figures import force_velocity_figure, run_figure
from edesign.report.damper.sheet_tables import acceptance_table, cycles_table, name_of, tests_table, verdict_text
from edesign.report.html.render import Cover, Page
from edesign.report.html.section import Part, Section, made
from edesign.report.page.cover_facts import cover_lines
from edesign.report.page.source import drawn

NO_DOCUMENT = Document()
TOLERANCE = 0.15
"""Of the force of a viscous device from the design. Source: NTC 2018, Table 11.9.III, column of the supply."""


def sheet_page(
    title: str,
    tests: Sequence[DamperTest],
    runs: Sequence[Run],
    judged: Sequence[Judged],
    asked: Acceptance,
    notes: Sequence[str],
    document: Document = NO_DOCUMENT,
    designs: Sequence[Run | None] = (),
) -> Page:
    """Return the report as data.

    Args:
        title: of the campaign.
        runs: their cycles.
        judged: criteria on the runs.
        notes: what was left out.
        designs: the same cycles by the law; None: it gives no force. Without any there is no law.
    """
    parts: list[Part] = [tests_table(runs), *_force_velocity(runs, designs, asked)]
    sections = (
        made("acceptance", lambda: _acceptance(runs, judged)),
        made("tests", lambda: Section("tests", "Tests", (), tuple(parts), tuple(notes))),
        made("cycles", lambda: Section("cycles", "Cycles", (), tuple(_cycles(tests, runs, asked)))),
    )
    kind = asked.device.replace("_", " ")
    cover = Cover(
        title=title,
        kind="Test sheet",
        about=f"{kind} device · {len(runs)} runs in {len(tests)} tests · edesign {__version__}",
        document=cover_lines(document.said),
        origin=f"edesign {__version__}",
        footer=f"Made by edesign {__version__}. All numbers are computed from the measured tests.",
    )
    return Page(cover, tuple(section for section in sections if section))


def _acceptance(runs: Sequence[Run], judged: Sequence[Judged]) -> Section:
    text, table = (verdict_text(judged, runs),), (acceptance_table(judged, runs),)
    notes = ("Limits and clauses are those of the campaign file, or the usual ones of edesign; check the standards.",)
    return Section("acceptance", "Acceptance", text, table, notes)


def _force_velocity(runs: Sequence[Run], designs: Sequence[Run | None], asked: Acceptance) -> Iterator[Part]:
    """The force against the velocity, of a viscous device alone."""
    if asked.device != "viscous" or not runs:
        return
    tolerance = asked.from_design or TOLERANCE
    caption = "Force against velocity, third cycle of each run; the velocity is that of a sine."
    made_by = designs or [None] * len(runs)
    yield from drawn(
        "figure force-velocity",
        lambda: [("force-velocity", caption, force_velocity_figure(runs, made_by, tolerance))],
    )


def _cycles(tests: Sequence[DamperTest], runs: Sequence[Run], asked: Acceptance) -> Iterator[Part]:
    named = {test.name: test for test in tests}
    for number, run in enumerate(runs, 1):
        yield cycles_table(run, runs)
        allowed = f"; dashed: allowed by {' and '.join(asked.from_third_by)}" if asked.from_third_by else ""
        caption = f"{name_of(run, runs)}. Loops, and cycles beside the third one{allowed}."
        name, test = f"run-{number}", named[run.test]
        yield from drawn(f"figure {name}", lambda: [(name, caption, run_figure(test, run, asked))])  # noqa: B023
