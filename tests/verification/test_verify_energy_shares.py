"""Shares of the energy put in since the motion began, of a frame that gravity has loaded before.

A frame of one degree of freedom has two dashpots side by side, its inherent damping and a damper. Once it is at rest
again, they have shared all that the motion has put in as their coefficients, c_d to c_i, whatever the motion was.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from shear_frames import BAY, HEIGHT, INERTIA, MASS, E, shear_frame_text

from edesign.archive.dataset import Group
from edesign.assess.energy import BEFORE, energies, energy_share, final_energies
from edesign.assess.quantities import located_quantity
from edesign.frame.sections.profiles import profile_names
from edesign.project import Project, load_project, parse_project
from edesign.project.criteria.criteria import QuantityCriterion
from edesign.report.response.damper_results import dampers_table
from edesign.report.response.energy_figures import _numbers
from edesign.study.run.analyses import run_analysis

RHO = 1.0  # (I / L) of the beam over (I / h) of a column
STIFFNESS = 24.0 * E * INERTIA / HEIGHT**3 * (6.0 * RHO + 1.0) / (6.0 * RHO + 4.0)
"""N/m. Source: portal on fixed bases, Chopra, Dynamics of Structures (2012), section 1.3, with rho = 4 times his."""
OMEGA = np.sqrt(STIFFNESS / MASS)
INHERENT, ADDED = 0.05, 0.15
"""Damping ratios of the frame and of its damper: the damper takes 3/4 of the input."""
PULSE = [0.0, 1.0, -2.0, 3.0, 0.5, -1.0, 0.0]  # m/s2, every 0.02 s
DT, REST = 0.01, 6.0  # s


def project(folder: Path, load: str, dampers: str = "") -> Project:
    (folder / "pulse.csv").write_text("\n".join(map(str, PULSE)))
    beam = RHO * INERTIA * BAY / HEIGHT
    text = (
        shear_frame_text(1).replace("inertia: 1e3 m^4", f"inertia: {beam} m^4").replace("area: 1 m^2", "area: 1000 m^2")
    )
    c = 2.0 * ADDED * MASS * OMEGA
    text += f"""\
loads: {{beams: [{{floors: all, G: {load}}}]}}
dampers:
  laws: {{fluid: {{type: viscous, parameters: {{c: {c} N*s/m}}}}}}
  devices: [{{kind: storey, bays: 1, storeys: 1, law: fluid}}]
damping: {{kind: modal, ratio: {INHERENT}, modes: 1}}
integration: {{method: newmark, time_step: {DT} s, tolerance: 1e-10}}
records: {{pulse: {{file: pulse.csv, acceleration_unit: m/s^2, time_step: 0.02 s}}}}
analyses: [{{name: shake, kind: history, record: pulse, free_vibration: {REST} s}}]
outputs: {{histories: [energy]}}
"""
    return parse_project(text, str(folder / "project.yaml"), profile_names())


def shaken(one: Project) -> Group:
    group = run_analysis(one, one.analyses[0])
    assert group.attributes["status"] == "completed", group.attributes["reason"]
    return group


def input_of_one_mass() -> float:
    """J. Work of -m a_g on one mass by the average acceleration method (Chopra, Table 5.4.2), trapezoidal."""
    fine = np.interp(np.arange(13) * 0.5, np.arange(7), PULSE)
    ground = np.concatenate((fine, np.zeros(round(REST / DT))))
    k, m, c = STIFFNESS, MASS, 2.0 * (INHERENT + ADDED) * MASS * OMEGA
    u, v, a, work = 0.0, 0.0, -ground[0], 0.0
    for before, now in zip(ground[:-1], ground[1:], strict=True):
        known = m * (4 / DT**2 * u + 4 / DT * v + a) + c * (2 / DT * u + v)
        next_u = (known - m * now) / (k + 2 * c / DT + 4 * m / DT**2)
        work -= 0.5 * m * (before + now) * (next_u - u)
        v, a, u = 2 / DT * (next_u - u) - v, 4 / DT**2 * (next_u - u) - 4 / DT * v - a, next_u
    return float(work)


def test_the_dampers_take_their_share_of_what_the_motion_puts_in(tmp_path: Path) -> None:
    """exp(-2 * 0.2 * 12 * 6) of the motion is left. Members are rigid along their axes but for 1e-6."""
    one = project(tmp_path, "20 kN/m")
    group = shaken(one)
    share = ADDED / (ADDED + INHERENT)
    terms = final_energies(group)
    assert terms is not None
    assert terms["input"] == pytest.approx(input_of_one_mass(), rel=1e-5)
    assert energy_share(group, "dampers") == pytest.approx(share, rel=1e-5)
    assert energy_share(group, "damping") == pytest.approx(1.0 - share, rel=1e-5)
    asked = QuantityCriterion(name="share", quantity="energy_share", term="dampers", most=0.8)
    found = located_quantity(group, asked, one)
    assert found is not None and found.value == pytest.approx(share, rel=1e-5)
    assert dampers_table({"shake": group}).texts[0][-1] == "75.00"
    over_time = energies(group)
    assert over_time is not None
    assert "dampers 75 %" in _numbers({"": (group.coords["time"].values, over_time)})
    # what gravity put in would hide all of it; elastic beams leave out the constant of their loads alone
    before = dict(zip(terms, group.variables[BEFORE].values, strict=True))
    assert abs(before["input"]) > 10.0 * terms["input"]
    assert before["input"] == pytest.approx(before["elastic"], rel=1e-6)


def test_gravity_does_not_change_the_energies_of_a_linear_frame(tmp_path: Path) -> None:
    """Loads that deform the beam symmetrically do no work in a sway: as without them, to the equilibrium's 1e-10."""
    loaded, light = (shaken(project(tmp_path, load)) for load in ("20 kN/m", "1e-3 N/m"))
    for term, values in (energies(loaded) or {}).items():
        scale = (final_energies(light) or {})["input"]
        assert np.abs(values - (energies(light) or {})[term]).max() < 1e-6 * scale, term


def test_archives_with_gravity_in_their_energies_are_read_since_the_motion_began(tmp_path: Path) -> None:
    """Archives without `energy_before` count gravity in: its part is the first row, and is unknown without rows."""
    group = shaken(project(tmp_path, "20 kN/m"))
    before = group.variables[BEFORE].values
    old = Group(dict(group.coords), dict(group.variables), dict(group.attributes))
    del old.variables[BEFORE]
    for name in ("energy", "energy_final"):
        kept = group.variables[name]
        old.add(name, kept.dims, kept.values + before, kept.unit, kept.long_name)
    assert final_energies(old) == pytest.approx(final_energies(group), rel=1e-9, abs=1e-6)
    del old.variables["energy"]
    assert energy_share(old, "dampers") is None
    assert energy_share(group, "dampers") is not None


def test_braces_that_carry_gravity_count_their_work_since_the_motion_began() -> None:
    """Restrained braces work under gravity; the work of each and that of all leave this out alike."""
    one = load_project(Path(__file__).parents[1] / "cases" / "brb_pinned" / "project.yaml")
    (spec,) = (spec for spec in one.analyses if spec.kind == "history")
    group = run_analysis(one, spec)
    terms = final_energies(group)
    assert terms is not None
    before = dict(zip(terms, group.variables[BEFORE].values, strict=True))
    assert before["dampers"] > 1e-3 * terms["dampers"]
    # sums of the same works in another order
    assert group.variables["damper_work_final"].values.sum() == pytest.approx(terms["dampers"], rel=1e-9)
