"""What notebooks show of models, records and results beside their facts: drawings, figures and tables, as HTML."""

from __future__ import annotations

import base64
from collections.abc import Iterator
from html import escape
from itertools import islice
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.reader import open_archive
from edesign.damper.fitting.fit import Fit
from edesign.errors import EdesignError
from edesign.ground_motion.record import Record
from edesign.ground_motion.response_spectrum import response_spectra
from edesign.optional_stages import words_of_mistake
from edesign.project.reading.file_model import FileModel
from edesign.report.archive.tables import short_tables
from edesign.report.damper.fit_tables import tables_of
from edesign.report.drawing.style import new_figure, styled, svg_text
from edesign.report.ground_motion.record_tables import record_tables
from edesign.report.model_drawings import drawings_of
from edesign.report.tables.table import Table
from edesign.study.run.match import MatchSummary
from edesign.study.run.outcome import RunSummary

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DRAWINGS = 2
"""Of a model: its geometry, and its loads and masses."""
_PERIODS = np.geomspace(0.02, 4.0, 120)


def html_of(thing: object) -> str:
    """Return drawings or figures of a project, study, building or record, tables of a run, a match or a fit; or "".

    What stands in the way of a drawing stands in its place: a display of facts does not fail by it.
    """
    try:
        if isinstance(thing, FileModel):
            return "".join(_picture(figure, caption) for _, caption, figure in islice(drawings_of(thing), DRAWINGS))
        if isinstance(thing, Record):
            caption = f"{thing.name}: ground acceleration, and its response spectrum at 5 % damping."
            return _picture(record_figure(thing), caption)
        return "".join(table._repr_html_() for table in _tables(thing))
    except EdesignError as error:
        return f"<p>{escape(str(error))}</p>"
    except Exception as error:  # a display that fails would hide the object itself
        return f"<p>{escape(words_of_mistake(error))}</p>"


def _tables(thing: object) -> Iterator[Table]:
    if isinstance(thing, RunSummary):
        with open_archive(thing.archive) as archive:
            yield from short_tables(archive)
    elif isinstance(thing, MatchSummary):
        yield from record_tables(thing.archive)
    elif isinstance(thing, Fit):
        yield from tables_of([thing], None, [{}])


@styled
def record_figure(record: Record) -> Figure:
    """Draw a record over time, and its spectrum of pseudo-acceleration at 5 % damping."""
    figure, ((over_time, over_period),) = new_figure(1, 2, 8.0, 2.4)
    over_time.plot(record.time, record.acceleration, linewidth=0.6)
    over_time.set_xlabel("time [s]")
    over_time.set_ylabel("acceleration [m/s2]")
    over_period.plot(_PERIODS, response_spectra(record.acceleration, record.time_step, _PERIODS).psa[0])
    over_period.set_xlabel("period [s]")
    over_period.set_ylabel("Se [m/s2]")
    return figure


def _picture(figure: Figure, caption: str) -> str:
    """A figure as an image, in which no script runs and no name meets that of another figure."""
    data = base64.b64encode(svg_text(figure).encode("utf-8")).decode("ascii")
    return f"<p><img alt='{escape(caption)}' src='data:image/svg+xml;base64,{data}'></p><p>{escape(caption)}</p>"
