"""Calibrate a law by a property table: the whole loop."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from edesign.calibrate.dampers.law_unknowns import held_parameters
from edesign.calibrate.evidence import Judged
from edesign.calibrate.outcome import Outcome, stages
from edesign.calibrate.problem import Part
from edesign.calibrate.properties.arrangement import Arrangement
from edesign.calibrate.properties.campaign import PropertyCampaign
from edesign.calibrate.properties.gamma import FreeGamma
from edesign.calibrate.properties.next_test import next_test
from edesign.calibrate.properties.problem import PropertyProblem, as_measured, property_problem
from edesign.calibrate.properties.repeatability import noise_of
from edesign.calibrate.properties.result import CorrectedLaw, PropertyCalibration
from edesign.calibrate.properties.shape import shape_of
from edesign.calibrate.run import described
from edesign.calibrate.search.loop import Loop, Progress
from edesign.damper.amendment_kinds import kind_if_known
from edesign.damper.amendments import Amendment
from edesign.damper.temperature import GammaT


def calibrate_properties(
    campaign: PropertyCampaign, workers: int = 2, progress: Progress = lambda _: None, seconds: float = math.inf
) -> PropertyCalibration:
    """Run the loop on the rows of a property table.

    Args:
        campaign: the table, and the declared law.
        workers: processes.
        progress: told what is done.
        seconds: processor time after which the search goes on with what it has found.
    """
    begin = clock.perf_counter()
    size = noise_of(campaign.table)
    noise = (size,) * len(campaign.groups)
    quick = property_problem(campaign)
    found = Loop(quick, noise, campaign.law.refit, workers, progress, seconds).run()
    progress("predicting all rows")
    problem = as_measured(campaign)
    outcome = Outcome.of(problem, noise, found)
    found = outcome.found
    rows = {stage: problem.rows(j.fitted.base, j.fitted.parts) for stage, j in stages(found).items()}
    progress("asking which further test would tell more")
    told = outcome.calibration(
        campaign.title or campaign.specimen.name,
        problem.inner.law.name,
        described,
        shape_of(rows["corrected"], campaign.table) if outcome.more_is_left else "",
        next_test(quick, found),
        (),
        clock.perf_counter() - begin,
    )
    told = replace(told, held=held_parameters(problem.inner.law))
    return PropertyCalibration(told, campaign, rows, corrected_law(problem, found.final), size)


def corrected_law(problem: PropertyProblem, judged: Judged) -> CorrectedLaw:
    """The law with its effects as a law file carries it; readings, rig and instrument are no part of it."""
    printed = problem.inner.law_values(judged.fitted.base)
    values: Mapping[str, float] = printed
    effects: list[Amendment] = []
    left_out: list[str] = []
    gamma_T = GammaT() if problem.inner.law.name in GammaT().laws else None
    for candidate, own in judged.fitted.parts:
        form, fixed = candidate.effect
        told = described(candidate)
        parameters = _named((candidate, own)) | dict(fixed)
        if isinstance(form, Arrangement):
            values = form.arranged(values)
            effects += [Amendment(*one) for one in form.beside(printed)]
        elif isinstance(form, FreeGamma):
            gamma_T = form.gamma_T(parameters)
        elif candidate.kind != "damper":
            left_out.append(f"{candidate.label} ({candidate.kind}): {told.title}; no part of the damper")
        elif kind_if_known(candidate.name, told.amendment) is None:
            left_out.append(f"{candidate.label}: law files cannot carry this form")
        else:
            effects.append(Amendment(candidate.name, told.amendment, parameters))
    return CorrectedLaw(values, tuple(effects), gamma_T, tuple(left_out))


def _named(part: Part) -> dict[str, float]:
    candidate, values = part
    return {u.name: float(v) for u, v in zip(candidate.unknowns, np.asarray(values), strict=True)}
