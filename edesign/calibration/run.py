"""Calibrate a declared model by a campaign: from the tests to what the user gets."""

from __future__ import annotations

import time as clock
from dataclasses import replace
from pathlib import Path

from edesign.calibration.campaign import Campaign, DamperCampaign, load_campaign
from edesign.calibration.dampers.from_campaign import damper_problem
from edesign.calibration.properties.campaign import PropertyCampaign
from edesign.calibration.properties.from_campaign import property_problem
from edesign.calibration.properties.outcome import TableOutcome
from edesign.calibration.results.outcome import DamperOutcome
from edesign.calibration.results.result import Calibration
from edesign.calibration.results.steps import Progress, Steps, searched
from edesign.calibration.search.problem import Problem
from edesign.calibration.search.search import Found
from edesign.calibration.search.settings import SETTINGS, SearchSettings
from edesign.calibration.signals.interpolation import sampling_notes
from edesign.calibration.structures.campaign import StructureCampaign
from edesign.calibration.structures.from_campaign import structure_problem
from edesign.calibration.structures.outcome import StructureOutcome
from edesign.damper.fitting import fit_forces
from edesign.damper.laws import law as law_of
from edesign.damper.parameters import write_parameters
from edesign.damper.testing.clipping import clipping_notes
from edesign.damper.testing.spikes import spike_notes, without_spikes
from edesign.one_thread import one_thread


@one_thread()
def calibrate(
    campaign: Campaign | Path | str,
    settings: SearchSettings = SETTINGS,
    threads: int = 2,
    progress: Progress = lambda _: None,
) -> Calibration:
    """Find what the declared law or building of a campaign lacks, and correct it.

    An interrupt (Ctrl-C) ends the search, and what it has found is returned with the ending `interrupted`.

    Args:
        campaign: tests, and the declared model, or the path of their file; a law without parameters is fitted to tests
            of a damper first.
        settings: numbers of the search, its effort among them.
        threads: of predictions, at most so many. Results do not depend on it.
        progress: called with what is done.

    Returns:
        Errors before and after, effects, and what the tests cannot decide; of a table a `PropertyCalibration`.

    Raises:
        InputError: the campaign is wrong, or its model cannot predict the tests or be fitted to them.
        KeyboardInterrupt: before the model was fitted.

    Examples:
        Tests of a template, whose law lacks something:

        >>> found = edesign.calibrate(edesign.new_project("tests", kind="calibration"))
        >>> found.verdict, [effect.name for effect in found.effects]
        ('explained', ['payne'])
    """
    begin = clock.perf_counter()
    if isinstance(campaign, Path | str):
        campaign = load_campaign(campaign)
    if isinstance(campaign, DamperCampaign):
        campaign = with_fitted_law(campaign, threads, progress)
        progress("preparing the tests")
    problem = _problem(campaign, threads)
    structure = isinstance(campaign, StructureCampaign)
    progress(f"fitting the {'building' if structure else 'law'} alone")
    found = searched(problem, settings, progress, campaign.path, "structure" if structure else "law")
    steps = Steps(progress, found.ending)
    with steps.deferring_interrupts():
        calibration = _outcome(campaign, found, settings, steps).calibration(steps)
    return replace(calibration, seconds=clock.perf_counter() - begin)


def _problem(campaign: Campaign, threads: int) -> Problem:
    """Return what the search works on."""
    if isinstance(campaign, PropertyCampaign):
        return property_problem(campaign, threads=threads)
    if isinstance(campaign, StructureCampaign):
        return structure_problem(campaign, threads).thinned()
    return damper_problem(campaign, threads)


def _outcome(
    campaign: Campaign, found: Found, settings: SearchSettings, steps: Steps
) -> DamperOutcome | TableOutcome | StructureOutcome:
    """Return what the search found, compared with all samples of all tests."""
    if isinstance(campaign, PropertyCampaign):
        return TableOutcome.of(campaign, found, settings, steps)
    if isinstance(campaign, StructureCampaign):
        return StructureOutcome.of(campaign, found, settings, steps)
    return DamperOutcome.of(campaign, found, settings, steps)


def notes_of(campaign: Campaign) -> tuple[str, ...]:
    """Return what should be known of a campaign before the search: readings, lost samples, coarse sampling."""
    if not isinstance(campaign, DamperCampaign):
        return ()
    return (
        *campaign.notes,
        *clipping_notes(campaign.tests),
        *spike_notes(campaign.tests),
        *sampling_notes(campaign.tests),
    )


def with_fitted_law(campaign: DamperCampaign, threads: int = 1, progress: Progress = lambda _: None) -> DamperCampaign:
    """Return the campaign with parameters of its law: as they are if it has any, else fitted to its tests.

    Args:
        campaign: tests, and a law.
        threads: at most so many.
        progress: called when the law is fitted.

    Raises:
        InputError: the law cannot be fitted to these tests.
    """
    if campaign.law is None or campaign.law.parameters is not None:
        return campaign
    law = law_of(campaign.law.type)
    progress(f"fitting the law {law.name}, of which the campaign names no parameters")
    found = fit_forces(
        law, [without_spikes(one) for one in campaign.used_for("fit")], specimen=campaign.specimen, workers=threads
    )
    values = write_parameters(law, found.values)
    return replace(campaign, law=replace(campaign.law, parameters=values, fitted=True))
