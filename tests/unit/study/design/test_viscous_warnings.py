"""Viscous dampers that an engineer would not build: what is reported of them, against closed forms of one storey."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from design_examples import MadeVerdict, design, shear_project
from scipy.optimize import brentq
from shear_frames import MASS, STIFFNESS

from edesign.archive.dataset import Group
from edesign.project.dampers.dampers import Dampers
from edesign.project.project import Project
from edesign.study.design.design import first_warnings, run_design
from edesign.study.design.viscous import plausibility

LAW = "\ndampers: {laws: {oil: {type: viscous_power, parameters: {c: 1 kN*(s/m)^@, alpha: @}}}}\n"
TEXT = "method: viscous, law: oil, kind: storey, bays: 1, state: initial, "


def project(alpha: str = "1") -> Project:
    return shear_project(1, LAW.replace("@", alpha))


def warnings_of(text: str, alpha: str = "1") -> list[str]:
    made = project(alpha)
    return first_warnings(made, "tried", design(TEXT + text, made), Path("."))


def test_dampers_that_hold_their_storey() -> None:
    # c = 2 zeta sqrt(k m), so that omega c is 2 zeta k
    (reported,) = warnings_of("damping: 60 %")
    assert "the dampers of storey 1 push 1.2 times as hard as its columns (omega c_eq over k_S" in reported
    assert warnings_of("damping: 49 %") == []


def test_more_coefficient_than_adds_damping() -> None:
    made = project()
    verify = "verify: {records: shake, levels: DBE, criteria: drift, change: coefficient}"
    spec = design(f"{TEXT}damping: 15 %, brace: {{ratio: 1}}, level: DBE, {verify}", made)

    def respond(dampers: Dampers, number: int) -> Mapping[str, Group]:
        return {"only": Group()}

    result = run_design(made, "tried", spec, Path("."), respond, lambda groups: [MadeVerdict(1.0)])
    c = float(result.group.variables["damping_coefficient"].values[0])  # ten times that of the target

    def damping(c: float) -> float:
        """Of m u'' + k u + f = 0 with f + (c / k) f' = c u', a dashpot behind a brace as stiff as the storey."""
        roots = np.roots([MASS * c / STIFFNESS, MASS, 2.0 * c, STIFFNESS])
        s = roots[np.argmax(roots.imag)]
        return float(-s.real / abs(s))

    same = brentq(lambda x: damping(x) - damping(c), 1e-3 * c, 0.3 * c)
    reported = next(text for text in result.group.attributes["warnings"] if "beyond the size" in text)
    found = re.search(r"they add ([\d.]+) %, and ([\d.]+) % of the coefficients", reported)
    assert found is not None
    assert [float(x) for x in found.groups()] == pytest.approx([100.0 * damping(c), 100.0 * same / c], rel=5e-3)


def test_a_damper_larger_than_those_that_are_made(monkeypatch: pytest.MonkeyPatch) -> None:
    assert warnings_of("damping: 8 %, level: DBE") == []
    monkeypatch.setattr(plausibility, "LARGEST_FORCE", 1e4)
    (reported,) = warnings_of("damping: 8 %, level: DBE")
    assert "standard sizes end at 10 kN (Taylor Devices), so take more places or a larger `number` than 1" in reported


def test_an_amplitude_that_the_spectrum_does_not_have() -> None:
    (reported,) = warnings_of("damping: 8 %, level: DBE, amplitude: {roof_displacement: 10 mm}", "0.5")
    reached, ratio = (
        float(x) for x in re.findall(r"reaches ([\d.]+) mm at DBE: there c_eq is ([\d.]+) times", reported)[0]
    )
    assert ratio == pytest.approx((reached / 10.0) ** -0.5, rel=5e-3) and ratio < 0.85
    assert warnings_of("damping: 8 %, level: DBE, amplitude: spectrum", "0.5") == []


def test_dampers_with_next_to_no_force_beside_the_strongest(monkeypatch: pytest.MonkeyPatch) -> None:
    made = shear_project(2, LAW.replace("@", "1"))
    spec = design(TEXT + "storeys: all, damping: 8 %, level: DBE, distribution: storey_shear", made)
    assert first_warnings(made, "tried", spec, Path(".")) == []
    monkeypatch.setattr(plausibility, "LEAST_SHARE", 0.99)  # the upper storey has the smaller shear
    (reported,) = first_warnings(made, "tried", spec, Path("."))
    assert "the dampers of storey 2 have less than 99 % of the strongest one's force" in reported
