"""The files of a calibration: JSON for programs, the corrected model for projects, histories in an archive."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, astuple
from pathlib import Path
from typing import Any

import numpy as np

from edesign._version import __version__
from edesign.archive.dataset import Group, Variable
from edesign.archive.files import check_file, check_own_yaml, make_folder, source_file, write_text, write_yaml
from edesign.archive.owner import check_owner
from edesign.archive.writer import ArchiveWriter
from edesign.calibration.campaign import Campaign, DamperCampaign
from edesign.calibration.properties.outcome import PropertyCalibration
from edesign.calibration.properties.write import property_law_text, rows_json
from edesign.calibration.residual.curves import FreeCurve
from edesign.calibration.residual.series import STAGES
from edesign.calibration.results.law_file import LAW, law_text
from edesign.calibration.results.result import Calibration, Effect, Estimate, LawFile, OfTests, OutlyingTest, Tested
from edesign.calibration.structures.campaign import StructureCampaign
from edesign.calibration.structures.corrected import FILES, STRUCTURE, corrected_texts
from edesign.damper.effects import LawEffect
from edesign.input_files import spare_inputs
from edesign.optional_stages import earlier, optional

JSON, PAGE, ARCHIVE = "calibration.json", "calibration.html", "calibration.h5"


def model_names(campaign: Campaign) -> tuple[str, ...]:
    """Return the names of all files of the corrected model that a calibration may write.

    Args:
        campaign: by which the model is calibrated.
    """
    return FILES if isinstance(campaign, StructureCampaign) else (LAW,)


def model_texts(found: Calibration) -> dict[str, str]:
    """Return the files of the corrected model by name."""
    if isinstance(found, PropertyCalibration):
        return {LAW: property_law_text(found)}
    if isinstance(found.campaign, StructureCampaign):
        return corrected_texts(found, found.campaign)
    assert isinstance(found.campaign, DamperCampaign)
    return {LAW: law_text(found, found.campaign)}


def check_files(campaign: Campaign, folder: Path, overwrite: bool = False) -> None:
    """Refuse to write over inputs, and over laws and archives that are no results of this campaign.

    Args:
        campaign: by which the model is calibrated.
        folder: where the files go.
        overwrite: whether results of other campaigns, and laws that edesign did not write, may be replaced.

    Raises:
        InputError: a file of the calibration would stand in the place of something else.
        ArchiveError: likewise, of an archive; or a file cannot be written.
    """
    models = [folder / name for name in model_names(campaign)]
    files = [*(folder / name for name in (JSON, PAGE, ARCHIVE)), *models]
    spare_inputs(*files)
    for file in files:
        check_file(file)
    for model in models:
        check_own_yaml(model, campaign.path, overwrite)
    check_owner(folder / ARCHIVE, _root(campaign, folder), overwrite)


def write_files(found: Calibration, folder: Path) -> list[Path]:
    """Write calibration.json, the files of the corrected model, and of tests and records calibration.h5.

    Each appears when it is whole. The first has all that was found: it stands where the others cannot be made.

    Args:
        folder: where the files go.

    Returns:
        The files.

    Raises:
        ArchiveError: one cannot be written.
    """
    make_folder(folder)
    text = json.dumps(calibration_json(found), indent=1, allow_nan=False) + "\n"
    write_text(text, folder / JSON)
    texts: Mapping[str, str] = {}
    kept = f"{folder / JSON} is written"
    with optional("the corrected model", kept + earlier(folder / LAW, folder / STRUCTURE)):
        texts = model_texts(found)
    for name, model in texts.items():
        write_yaml(model, folder / name, found.campaign.path)
    groups: Mapping[str, Group] = {}
    with optional(ARCHIVE, kept + earlier(folder / ARCHIVE)):
        groups = archive_groups(found)
    if not groups:  # a table has no histories
        return [folder / name for name in (JSON, *texts)]
    root = _root(found.campaign, folder)
    root.attributes |= {"verdict": found.verdict, "search": found.ending}
    root.add("calibration", (), text, "", JSON)
    root.add("campaign", (), found.campaign.text, "", "the campaign file")
    with ArchiveWriter(folder / ARCHIVE, root) as writer:
        for name, group in groups.items():
            writer.write(name, group)
        writer.finish({"status": "completed"})
    return [folder / name for name in (JSON, *texts, ARCHIVE)]


def _root(campaign: Tested, folder: Path) -> Group:
    source = source_file(campaign.path, folder / ARCHIVE)
    about = {"title": campaign.label, "kind": "calibration", "source_file": source}
    return Group(attributes={**about, "planned": [], "edesign_version": __version__})


def archive_groups(found: Calibration) -> dict[str, Group]:
    """Return histories of every test or channel: motion, what was measured and predicted; by the name of the group."""
    groups = {}
    for series in found.series:
        judged_from = series.start.judged_from if series.start else 0.0
        about = {"title": series.title, "use": series.use, "order": series.order, "noise": series.noise}
        group = Group(attributes={**about, "judged_from": judged_from})
        group.add("time", ("sample",), series.time, "s", "time")
        group.add("displacement", ("sample",), series.displacement, "m", "displacement, freed from noise")
        group.add("temperature", ("sample",), series.temperature, "degC", "temperature")
        what, unit = series.quantity, series.unit
        group.add(f"measured_{what}", ("sample",), series.measured, unit, f"measured {what}")
        if series.clipped is not None:
            words = f"1 where the measured {what} stands at the end of its range and is not judged"
            group.add("clipped", ("sample",), series.clipped.astype(np.int8), "1", words)
        for name, at, channel in (("spikes", series.spikes, what), ("motion_spikes", series.motion_spikes, "motion")):
            if at is not None:
                words = f"1 where the measured {channel} had a spike, over which it is interpolated"
                group.add(name, ("sample",), at.astype(np.int8), "1", words)
        for stage, values in series.predicted.items():
            words = f"{what} predicted by the {stage} {'law' if found.subject == 'damper' else 'building'}"
            group.add(f"{stage}_{what}", ("sample",), values, unit, words)
        group.coords["sample"] = Variable(("sample",), np.arange(series.time.size), "1", "sample")
        groups[f"tests/{series.name}"] = group
    return groups


def calibration_json(found: Calibration) -> dict[str, Any]:
    """Return all that was found, in SI; NRMS as ratios, numbers that are not finite as null."""
    better = None if found.other_law is None else _finite_values(asdict(found.other_law))
    return {
        "title": found.title,
        "subject": found.subject,
        "law": found.law,
        "verdict": found.verdict,
        "law_kind": {"fitted_first": found.fitted_first, "better": better},
        "search": found.ending,
        "failed_steps": dict(found.failed),
        "coverage": {
            "forms": found.forms,
            "effort": found.effort,
            "effort_by_step": dict(found.effort_by_step),
            "most_effort": _finite(found.most_effort),
            "depths": [asdict(one) for one in found.depths],
        },
        "error": {
            stage: {
                "fit": found.errors[stage].fit,
                "validate": found.errors[stage].validate,
                "tests": dict(found.errors[stage].tests),
                **({"channels": dict(channels)} if (channels := found.errors[stage].channels) else {}),
            }
            for stage in STAGES
        },
        "noise_floor": found.noise_floor,
        "noise_floor_fit": found.noise_floor_fit,
        "noise_floor_interpolation": found.interpolation,
        "noise_floor_interpolation_fit": found.interpolation_fit,
        "noise_floor_doubtful": found.doubtful,
        "worst_test": None if found.worst is None else asdict(found.worst),
        "outlying_tests": [_outlying(one) for one in found.outlying],
        "effects": [_effect(one) for one in found.effects],
        "hypotheses": [{**_effect(one.effect), "why": one.why} for one in found.hypotheses],
        "unexplained": {
            "share": _finite(found.unexplained_share),
            "shape": found.unexplained_shape,
            "curves": [_free_curve(one) for one in found.unexplained_curves],
        },
        "models": [_finite_values(asdict(one)) for one in found.models],
        "next_test": None
        if found.next_test is None
        else {
            "test": found.next_test.text,
            "separates": list(found.next_test.separates),
            "difference": _finite(found.next_test.difference),
            "largest_so_far": _finite(found.next_test.largest),
        },
        "law_held": found.law_fixed,
        "law_as_declared": found.as_declared,
        **_of_a_damper(found),
        "law_file": _law_file(found.law_file),
        "parameters": {
            stage: {name: _estimate(value) for name, value in found.parameters[stage].items()} for stage in STAGES
        },
        "held": dict(found.fixed),
        "seconds": round(found.seconds, 2),
        **(rows_json(found) if isinstance(found, PropertyCalibration) else {}),
    }


def _effect(effect: Effect) -> dict[str, Any]:
    return {
        "name": effect.name,
        "kind": effect.kind,
        "form": effect.form,
        "title": effect.title,
        "parameters": {key: _estimate(value) for key, value in effect.parameters.items()},
        "delta_validate": _finite(effect.delta_validate),
        "gain": _finite(effect.gain),
        "gain_error": _finite(effect.gain_error),
        "probability": _finite(effect.probability),
        "indistinguishable_from": list(effect.indistinguishable_from),
        "may_be": None if effect.other_kind is None else {"kind": effect.other_kind, "title": effect.other_title},
        "not_carried": effect.not_carried,
    }


def _outlying(test: OutlyingTest) -> dict[str, Any]:
    return {
        "test": test.name,
        "use": test.use,
        "student_t": _finite(test.ratio),
        "chance": test.chance,
        "others_with": _finite(test.others_with),
        "others_without": _finite(test.others_without),
        "only_noise_without": test.only_noise,
        "faults": [
            {
                "name": one.name,
                "form": one.form,
                "title": one.title,
                "parameters": {key: _estimate(value) for key, value in one.parameters.items()},
            }
            for one in test.faults
        ],
        "beyond_others_in": list(test.beyond),
    }


def _free_curve(found: FreeCurve) -> dict[str, Any]:
    return {
        "of": found.of,
        "share": found.share,
        "curves": [
            {
                one.driver: one.at.tolist(),
                "value": one.value.tolist(),
                "interval": [end.tolist() for end in one.band],
            }
            for one in found.curves
        ],
    }


def _law_file(law: LawFile) -> dict[str, Any]:
    return {
        "stage": law.stage,
        "validate": _finite(law.validate),
        "effects": _effects(law.effects),
        "brace": law.brace,
        "if_of_the_damper": [one for own in law.otherwise.values() for one in _effects(own)],
        "measurement_effects": list(law.measurement_effects),
        "lacking": list(law.lacking),
        "withheld": law.withheld,
    }


def _effects(effects: Sequence[LawEffect]) -> list[dict[str, str]]:
    return [{"name": one.name, "form": one.form, "placement": one.placement} for one in effects]


def _of_a_damper(found: Calibration) -> dict[str, Any]:
    """What only tests of a damper have."""
    if found.subject != "damper":
        return {}
    return {
        "extremes": "lasting" if found.lasting else "fresh",
        "gamma_T_of": found.gamma_of,
        "starts": _starts(found),
        "nuisances": [_of_tests(one) for one in found.nuisances],
        "noise_assumed": [one.name for one in found.series if one.assumed],
        "clipped_samples": {
            one.name: int(np.count_nonzero(one.clipped)) for one in found.series if one.clipped is not None
        },
        "spikes": {
            channel: {one.name: one.time[at].tolist() for one in found.series if (at := getattr(one, name)) is not None}
            for channel, name in (("force", "spikes"), ("displacement", "motion_spikes"))
        },
    }


def _of_tests(one: OfTests) -> dict[str, Any]:
    wave = {} if one.frequency is None else {"frequency": _estimate(one.frequency)}
    names = ("value", "standard_error", "phase", "phase_error")[: 4 if wave else 2]
    return {
        "of": one.of,
        "name": one.name,
        "unit": one.unit,
        **wave,
        "tests": {
            test: {name: _finite(value) for name, value in zip(names, astuple(number), strict=False)}
            for test, number in one.tests.items()
        },
    }


def _starts(found: Calibration) -> dict[str, Any]:
    """Tests that start away from rest, by name."""
    return {
        series.name: {
            "displacement": start.displacement,
            "velocity": start.velocity,
            "judged_from": start.judged_from,
            "dies_away": start.dies_away,
            "deformation_before": start.before[0],
            "velocity_before": start.before[1],
            "before_is": "said" if start.known else "found",
        }
        for series in found.series
        if (start := series.start) is not None
    }


def _estimate(estimate: Estimate) -> dict[str, Any]:
    ends: Sequence[float] = estimate.interval
    return {
        "value": _finite(estimate.value),
        "standard_error": _finite(estimate.standard_error),
        "interval": [_finite(end) for end in ends],
        "unit": estimate.unit,
        **({"not_determined": estimate.not_determined} if estimate.not_determined else {}),
    }


def _finite_values(values: Mapping[str, Any]) -> dict[str, Any]:
    return {key: _finite(value) if isinstance(value, float) else value for key, value in values.items()}


def _finite(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
