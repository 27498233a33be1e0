"""Calibrate a damper law by a campaign: from the tests to what the user gets."""

from __future__ import annotations

import time as clock
from dataclasses import replace

from edesign.calibration.dampers.from_campaign import damper_problem
from edesign.calibration.results.outcome import Outcome
from edesign.calibration.results.result import Calibration
from edesign.calibration.results.steps import Progress, Steps, searched
from edesign.calibration.search.settings import SETTINGS, SearchSettings
from edesign.damper.fitting import fit_forces
from edesign.damper.laws import law as law_of
from edesign.damper.parameters import write_parameters
from edesign.damper.testing.campaign import Campaign
from edesign.one_thread import one_thread


@one_thread()
def calibrate(
    campaign: Campaign, settings: SearchSettings = SETTINGS, threads: int = 2, progress: Progress = lambda _: None
) -> Calibration:
    """Find what the law of a campaign lacks, and correct it.

    An interrupt (Ctrl-C) ends the search, and what it has found is returned with the ending `interrupted`.

    Args:
        campaign: tests, and the declared law; a law without parameters is fitted to the tests first.
        settings: numbers of the search, its effort among them.
        threads: of predictions, at most so many. Results do not depend on it.
        progress: told what is done.

    Raises:
        InputError: the campaign is wrong, or its law cannot be fitted to the tests.
        KeyboardInterrupt: before the law was fitted.
    """
    begin = clock.perf_counter()
    campaign = with_fitted_law(campaign, threads, progress)
    progress("preparing the tests")
    problem = damper_problem(campaign, threads)
    progress("fitting the law alone")
    found = searched(problem, settings, progress, campaign.path, "law")
    steps = Steps(progress, found.ending)
    with steps.held():
        calibration = Outcome.of(campaign, found, settings, steps).calibration(steps)
    return replace(calibration, seconds=clock.perf_counter() - begin)


def with_fitted_law(campaign: Campaign, threads: int = 1, progress: Progress = lambda _: None) -> Campaign:
    """Return the campaign with parameters of its law: as they are if it has any, else fitted to its tests.

    Args:
        campaign: tests, and a law.
        threads: at most so many.
        progress: told that the law is fitted.

    Raises:
        InputError: the law cannot be fitted to these tests.
    """
    if campaign.law is None or campaign.law.parameters is not None:
        return campaign
    law = law_of(campaign.law.type)
    progress(f"fitting the law {law.name}, of which the campaign names no parameters")
    found = fit_forces(law, campaign.used_for("fit"), specimen=campaign.specimen, workers=threads)
    values = write_parameters(law, found.values)
    return replace(campaign, law=replace(campaign.law, parameters=values, fitted=True))
