"""All figures of an archive of virtual substructure tests."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain
from typing import TYPE_CHECKING

from edesign.archive.reader import Archive
from edesign.report.substructure.alpha_figures import alpha_figures
from edesign.report.substructure.diagram import loop_diagrams
from edesign.report.substructure.map_figures import map_figures
from edesign.report.substructure.method_figures import method_figures
from edesign.report.substructure.model_figures import tested_structures
from edesign.report.substructure.response_figures import energy_error_figures, loop_figures, response_figures
from edesign.report.substructure.results import SubstructureResults
from edesign.report.substructure.rig_figures import rig_figures
from edesign.report.substructure.tracking_figures import synchronisation_figures, tracking_figures

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SUBSTRUCTURE_FIGURES = (
    loop_diagrams,
    tested_structures,
    rig_figures,
    map_figures,
    tracking_figures,
    synchronisation_figures,
    alpha_figures,
    loop_figures,
    response_figures,
    energy_error_figures,
    method_figures,
)


def substructure_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield all figures of an archive of virtual substructure tests.

    Yields:
        Name of the file, caption and figure.
    """
    results = SubstructureResults(archive)
    return chain.from_iterable(figures(results) for figures in SUBSTRUCTURE_FIGURES)
