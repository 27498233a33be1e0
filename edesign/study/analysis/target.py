"""The response of a frame at a target displacement: pushed there, with all that follows from its capacity curve."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from edesign.archive.dataset import Group
from edesign.codes.ec8.analysis.target_displacement import RANGE
from edesign.codes.fema356.target_displacement import unlimited_inelastic_factor
from edesign.codes.spectrum import characteristic_period
from edesign.ground_motion.hazard import checked_hazard, elastic_spectrum
from edesign.project.analysis.analyses import TargetAnalysis
from edesign.project.analysis.damping import first_ratio
from edesign.project.analysis.pushover import METHODS
from edesign.project.analysis_file import AnalysisFile
from edesign.study.analysis.capacity import Capacity, Target, capacity, level_spectrum
from edesign.study.analysis.dampers import goes_with_speed
from edesign.study.analysis.push import Progress, Push, Stop, push
from edesign.study.results.recording import coordinate
from edesign.study.results.warnings import AnalysisWarning, store_warnings

ROUNDING = 1e-9  # of a displacement


def run_target(
    project: AnalysisFile, spec: TargetAnalysis, progress: Progress | None = None, stop: Stop | None = None
) -> Group:
    """Find the capacity curve and the target displacement of a frame, and push the frame to it.

    The results are those of the push to the target; one that the frame does not reach has failed. Of dampers the
    spring that is left at rest acts: a push has no speed.

    Args:
        spec: the method and level, and the pushover.
        progress: called now and then with (steps done, steps).
        stop: asked now and then; True ends the push.

    Returns:
        The results of the push to the target; failed if the frame does not reach it.

    Raises:
        AnalysisError: no equilibrium under gravity, no usable mode, or no capacity curve.
        CoreError: the frame is a mechanism.
    """
    found = capacity(project, spec, progress, stop)
    if found.push.response.status == "interrupted":
        return found.push.group
    target = found.target(spec.method, spec.level)
    end = found.curve.end
    if target.d_t > end * (1.0 + ROUNDING):
        why = f" ({found.push.response.reason})" if found.push.response.reason else ""
        reason = (
            f"the target displacement of {target.d_t:.4g} m is beyond the end of the capacity curve at {end:.4g} m{why}"
        )
        group = Group(attributes={"status": "failed", "reason": reason})
        kept = found.push.group.attributes
        group.attributes |= {
            key: kept[key] for key in ("pattern", "direction", "eccentricity", "statistics") if key in kept
        }
        warnings = []
    else:
        at = found.push.start + found.push.sign * target.d_t
        pushed = push(project, spec, found.basis.loads, at, progress, stop)
        group, warnings = pushed.group, _warnings(project, spec, found, target)
        if spec.method == "n2":
            warnings += _amplified(project, spec, found, pushed)
    _store(group, spec, found, target)
    store_warnings(group, warnings)
    group.attributes |= {"method": spec.method, "spectrum_damping": level_spectrum(project, spec, spec.level).damping}
    return group


def _warnings(project: AnalysisFile, spec: TargetAnalysis, found: Capacity, target: Target) -> list[AnalysisWarning]:
    warnings = []
    reached, wanted = found.curve.end, RANGE * target.d_t
    if spec.method == "n2" and reached < wanted * (1.0 - ROUNDING):
        text = (
            f"the capacity curve ends at {reached:.4g} m, before {100 * RANGE:g} % of the target displacement, "
            f"{wanted:.4g} m (EN 1998-1, 4.3.3.4.2.3)"
        )
        warnings.append(AnalysisWarning("target_range", text, wanted / reached))
    if target.mu is not None and target.mu[0] > target.mu[1]:
        text = (
            f"mu_strength is {target.mu[0]:.3g}, more than mu_max = {target.mu[1]:.3g}: ASCE/SEI 41-17, 7.3.2.1, "
            "does not permit the nonlinear static procedure; histories are needed"
        )
        warnings.append(AnalysisWarning("target_strength", text, target.mu[0] / target.mu[1]))
    if spec.method == "fema356":
        given = {name: value for name, value, _, _ in target.values}
        corner = characteristic_period(level_spectrum(project, spec, spec.level))
        free = unlimited_inelastic_factor(given["R"], given["T_e"], corner) if corner is not None else 1.0
        if free > given["C_1"] * (1.0 + ROUNDING):
            text = (
                f"C_1 is {given['C_1']:.3g} by the limit of FEMA 356, 3.3.1.3.1, for short periods, and {free:.3g} "
                "without it; FEMA 440 advises against the limit, with which displacements come out too small"
            )
            warnings.append(AnalysisWarning("target_limit", text, free / given["C_1"]))
    return [*warnings, *_damping_warnings(project, spec, found, target)]


def _amplified(project: AnalysisFile, spec: TargetAnalysis, found: Capacity, pushed: Push) -> list[AnalysisWarning]:
    """Add the drifts of a building's column lines, amplified by torsion, to the results of a push, and warn of torsion.

    Source: EN 1998-1, 4.3.3.4.2.7; see `torsional_amplification`.
    """
    made = found.basis.amplification(pushed, level_spectrum(project, spec, spec.level))
    if made is None:
        return []
    group = pushed.group
    coordinate(group, "amplified_line", list(made.lines), "", "column line whose upper end is on a rigid floor")
    label = "displacement at the upper end of the column line over that of the centre of mass"
    group.add("line_ratio_elastic", ("amplified_line",), made.elastic, "1", f"{label}, elastic modal analysis")
    group.add("line_ratio_push", ("amplified_line",), made.pushed, "1", f"{label}, push")
    label = "torsional amplification of displacements and deformations on the column line"
    group.add("torsional_amplification", ("amplified_line",), made.factor, "1", label)
    factors = dict(zip(made.lines, made.factor.tolist(), strict=True))
    of_lines = [factors.get(str(name).partition(".")[0], 1.0) for name in group.coords["drift_line"].values]
    drifts = np.maximum(*(abs(group.variables[f"line_drift_{which}"].values) for which in ("max", "min")))
    label = "largest drift ratio of the storey on the column line in the direction of the push, torsion amplified"
    group.add("amplified_line_drift", ("drift_line",), drifts[:, pushed.direction] * of_lines, "1", label)
    worst = int(made.factor.argmax())
    return [
        AnalysisWarning(
            "target_torsion",
            f"mode {mode} is mostly a turn of the building about the vertical ({100 * part:.3g} % of its moment of "
            f"inertia): deformations on column lines are up to {made.factor[worst]:.3g} times those of the push, at "
            f"{made.lines[worst]} (EN 1998-1, 4.3.3.4.2.7); drifts with this factor are in `amplified_line_drift`, "
            "members are without it",
            part,
        )
        for mode, part in found.basis.torsional_modes.items()
    ]


def _damping_warnings(
    project: AnalysisFile, spec: TargetAnalysis, found: Capacity, target: Target
) -> list[AnalysisWarning]:
    """The damping of velocity-dependent dampers is for the spectrum, the work of others is in the capacity curve.

    Source: FEMA 356, 9.3.5.1.
    """
    devices = found.push.frame.devices
    fast = [device for device in devices if goes_with_speed(device)]
    if fast and spec.damping is None:
        of = "" if len(fast) == len(devices) else f", {len(fast)} of {len(devices)}"
        text = (
            f"the spectrum does not have the damping of the velocity-dependent dampers{of}; `damping` states that of "
            "frame and such dampers"
        )
        return [AnalysisWarning("target_damping", text, 1.0)]
    if not devices or fast or spec.damping is None:
        return []
    inherent = max(elastic_spectrum(checked_hazard(project), spec.level).damping, first_ratio(project.damping))
    if spec.damping <= inherent * (1.0 + ROUNDING):
        return []
    without = replace(found, spec=spec.model_copy(update={"damping": None})).target(spec.method, spec.level).d_t
    # a curve that was pushed for the smaller target may end before the other
    place = f"{1e3 * without:.4g} mm without `damping`" if without <= found.curve.end else "more without `damping`"
    text = (
        f"`damping` of {100.0 * spec.damping:g} % is more than the inherent {100.0 * inherent:g} %, and no damper is "
        "velocity-dependent: the capacity curve has the work of all, which FEMA 356, 9.3.5.1, counts nowhere else "
        f"({1e3 * target.d_t:.4g} mm in place of {place})"
    )
    return [AnalysisWarning("target_damping_twice", text, spec.damping / inherent)]


def _store(group: Group, spec: TargetAnalysis, found: Capacity, target: Target) -> None:
    for name, value, unit, label in target.values:
        group.add(f"{spec.method}_{name}", (), value, unit, f"{METHODS[spec.method]}: {label}")
    curve = found.curve
    coordinate(group, "curve_point", np.arange(curve.displacement.size), "1", "point of the capacity curve")
    label = "displacement of the control node since gravity, positive in the direction of the push"
    group.add("curve_displacement", ("curve_point",), curve.displacement, "m", label)
    group.add("curve_base_shear", ("curve_point",), curve.force, "N", "base shear in the direction of the push")
    displacement, force = target.idealised
    coordinate(group, "idealised_point", np.arange(len(force)), "1", "point of the idealised capacity curve")
    group.add("idealised_displacement", ("idealised_point",), displacement, "m", label)
    group.add("idealised_base_shear", ("idealised_point",), force, "N", "base shear of the idealised capacity curve")
