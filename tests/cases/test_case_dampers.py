"""Cases with dampers against equilibrium with the floors' inertia, work, and frames without dampers.

The cases have no inherent damping: at every step of the average acceleration method the inertia of the floors is
balanced by columns, dampers and the tuned mass alone, to the tolerance of equilibrium (1e-7 of the largest force).
"""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import scipy.linalg
from cases.conftest import HERE

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.errors import Interrupted
from edesign.frame.project_file import load_project
from edesign.study.run.progress import Progress
from edesign.study.run.run import run_project

Results = Callable[[str, str], Group]
G = 9.80665  # m/s2
MASSES = np.array([27e3, 27e3, 19.2e3]) * 11.0 / G  # kg: G + 0.3 Q on 11 m of beams


# N/m: three plates of HEB 140 and HEB 120, 2 E A cos^2 / L and E A / L; without brace infinite
HEB140, HEB120 = 2 * 0.140 * 0.012 + 0.116 * 0.007, 2 * 0.120 * 0.011 + 0.098 * 0.0065
CHEVRONS = np.hypot(3.0, [4.0, 3.3, 3.3])
BRACES = {
    "chevron_mgmm": np.array([*(2 * 210e9 * HEB140 * 9.0 / CHEVRONS**3), 60e6]),
    "bouc_wen_tuned_mass": np.array([*(210e9 * HEB120 / np.hypot(6.0, [4.0, 3.3])), np.inf, np.inf]),
}


def value(group: Group, name: str) -> np.ndarray:
    return np.asarray(group.variables[name].values)


def of_case(case: str, folder: Path, *changes: tuple[str, str]) -> Path:
    """A copy of a case with some of its text changed."""
    text = (HERE / case / "project.yaml").read_text(encoding="utf-8").replace("../records", str(HERE / "records"))
    for old, new in changes:
        assert text.count(old) == 1, f"{old!r} must stand in the case once"
        text = text.replace(old, new)
    folder.mkdir(exist_ok=True)
    (folder / "project.yaml").write_text(text, encoding="utf-8")
    return folder / "project.yaml"


def same(one: Path, other: Path, names: dict[str, str]) -> None:
    """Analyses of two archives are the same bit by bit; `names` of the first: of the second."""
    with open_archive(one) as a, open_archive(other) as b:
        for first, second in names.items():
            x, y = a.group(f"analyses/{first}").variables, b.group(f"analyses/{second}").variables
            assert x.keys() == y.keys() and len(x) >= 9
            for name in x:
                np.testing.assert_array_equal(x[name].values, y[name].values, err_msg=f"{first} {name}")


def tuned_mass(roof: np.ndarray, step: float) -> np.ndarray:
    """Force (n,) of the tuned mass on the roof, whose acceleration (n,) is taken as linear between its samples."""
    mass, omega, ratio = 4e3, 2.0 * np.pi * 1.3, 0.1
    system = np.zeros((4, 4))
    system[0, 1] = system[2, 3] = 1.0
    system[1, :3] = -(omega**2), -2.0 * ratio * omega, -1.0
    over_step = scipy.linalg.expm(system * step)[:2]
    state, found = np.zeros(2), [0.0]
    for now, following in zip(roof[:-1], roof[1:], strict=True):
        state = over_step @ np.array([*state, now, (following - now) / step])
        found.append(mass * (omega**2 * state[0] + 2.0 * ratio * omega * state[1]))
    return np.array(found)


@pytest.mark.parametrize(
    ("case", "tolerance"), [("chevron_mgmm", 1e-6), ("bouc_wen_tuned_mass", 0.01), ("devices_of_practice", 1e-6)]
)
def test_columns_and_dampers_balance_the_inertia_of_the_floors(
    case: str, tolerance: float, results_of: Results
) -> None:
    """In every storey. The tuned mass is integrated exactly here, by steps of a twelfth of a radian there: 1 %."""
    group = results_of(case, "shake")
    masses = np.array([28e3, 28e3]) * 18.0 / G if case == "devices_of_practice" else MASSES
    inertia = value(group, "floor_acceleration") * masses
    if case == "bouc_wen_tuned_mass":
        inertia[:, 2] -= tuned_mass(value(group, "floor_acceleration")[:, 2], 0.01)
    above = np.cumsum(inertia[:, ::-1], axis=1)[:, ::-1]
    carried = value(group, "storey_shear") + value(group, "storey_damper_force")
    largest = np.max(np.abs(carried), axis=0)
    assert np.all(np.max(np.abs(above + carried), axis=0) < tolerance * largest[0])
    assert np.max(np.abs(value(group, "base_shear") + above[:, 0])) < tolerance * largest[0]
    assert np.max(np.abs(value(group, "storey_damper_force")[:, 0])) > 0.3 * largest[0]  # the dampers do count


@pytest.mark.parametrize("case", ["chevron_mgmm", "bouc_wen_tuned_mass"])
def test_the_work_of_the_dampers_is_found_again_in_the_balance(case: str, results_of: Results) -> None:
    """Force on total deformation by the trapezoidal rule; the brace's part is elastic. The tuned mass has a dashpot."""
    group = results_of(case, "shake")
    force, own = value(group, "damper_force"), value(group, "damper_deformation")
    at_own = np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(own, axis=0), axis=0)
    work = value(group, "damper_work_final")
    assert np.all(at_own > 0.0)
    left = 0.5 * force[-1] ** 2 / BRACES[case]  # in the braces, by hand
    assert at_own + left == pytest.approx(work, rel=1e-6)
    energy = dict(zip(group.coords["energy_term"].values, value(group, "energy_final"), strict=True))
    if case == "chevron_mgmm":
        assert energy["dampers"] == pytest.approx(work.sum(), rel=1e-9)
    else:
        assert energy["dampers"] > 1.02 * work.sum()
    assert energy["dampers"] > 0.5 * energy["input"]
    assert group.attributes["statistics"]["energy_error"] < 1e-3


def test_analyses_without_dampers_are_those_of_the_frame_without_dampers(
    tmp_path: Path, archive_of: Callable[[str], Path]
) -> None:
    """Bit by bit: neither block nor `dampers: false` leaves a trace."""
    path = of_case("chevron_mgmm", tmp_path)
    text = path.read_text(encoding="utf-8")
    start, stop = text.index("dampers:\n"), text.index("damping:")
    text = text[:start] + text[stop:]
    text = text.replace("damper_strain: 30 %", "variant: none").replace(", dampers: false", ", variant: none")
    assert "dampers:" not in text
    path.write_text(text.replace("energy, dampers]", "energy]"), encoding="utf-8")
    bare = run_project(load_project(path)).archive
    names = {name: name for name in ("modes_bare", "push_bare", "shake_bare")}
    same(archive_of("chevron_mgmm"), bare, names)
    same(archive_of("chevron_mgmm"), bare, {f"{name}_bare": name for name in ("modes", "push", "shake")})


@pytest.mark.parametrize("case", ["chevron_mgmm", "bouc_wen_tuned_mass"])
def test_an_interrupted_run_goes_on_to_the_same_results(
    case: str, tmp_path: Path, archive_of: Callable[[str], Path]
) -> None:
    """Ctrl-C when the history begins; then two workers."""
    project = load_project(of_case(case, tmp_path))
    names = [item.name for item in project.analyses]

    def listen(report: Progress) -> None:
        if report.event == "start" and report.analysis == "shake":
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(Interrupted, match=f"{names.index('shake')} of {len(names)} analyses are finished"):
        run_project(project, progress=listen)
    summary = run_project(project, workers=2)
    assert [outcome.reused for outcome in summary.outcomes[:2]] == [True, True]
    assert not summary.outcomes[-1].reused
    same(summary.archive, archive_of(case), {name: name for name in names})


def test_modes_with_the_dampers_stiffness(results_of: Results) -> None:
    """Rayleigh's quotient with the dampers' stiffness added on the shape found gives its frequency again.

    k_d of each chevron acts on its storey's drift of the mode, whose verticals at the lower ends are small: 2 %.
    """
    bare, damped = results_of("chevron_mgmm", "modes_bare"), results_of("chevron_mgmm", "modes")
    k = value(damped, "damper_storage_stiffness")
    names = list(damped.coords["damper"].values)
    assert names == ["V_1_1", "V_1_2", "V_1_3", "V_2_1"]
    storey = np.array([1, 2, 3, 1])
    shapes, omega = value(bare, "floor_shape"), value(bare, "circular_frequency")
    modal = (shapes**2) @ MASSES
    drifts = np.diff(np.concatenate([np.zeros((3, 1)), shapes], axis=1), axis=1)
    added = sum(
        stiffness * np.outer(drifts[:, s - 1], drifts[:, s - 1]) for stiffness, s in zip(k, storey, strict=True)
    )
    squares = scipy.linalg.eigh(np.diag(modal * omega**2) + added, np.diag(modal), eigvals_only=True)
    assert np.sqrt(squares) == pytest.approx(value(damped, "circular_frequency"), rel=0.02)
    assert np.all(value(damped, "circular_frequency") > 1.03 * omega)


def test_a_pushover_holds_what_is_left_after_a_long_time(results_of: Results) -> None:
    """At rest the MGMM is a spring k0 + k_a exp(-u_max / u_ref) + k_b (Eq. 4.29), here at 25 degC."""
    group = results_of("chevron_mgmm", "push")
    gamma, scale = 0.935, np.array([0.18, 0.14, 0.08, 2 * 2 * 0.0414]) / 0.0414
    own, force = value(group, "damper_deformation_final"), value(group, "damper_force_final")
    u = own * 12.0 / 70.0
    k = gamma * (0.107e6 + 3.613e6 + 3.741e6 * np.exp(-0.5 * np.abs(u) / (gamma * 7.966e-3)))
    assert force == pytest.approx(scale * k * u, rel=1e-5)  # c_NL |v|^alpha is not quite gone


def test_each_device_of_practice_follows_its_law(results_of: Results) -> None:
    """Force against the deformation in the archive, by the equation of its page in docs/reference/laws."""
    group = results_of("devices_of_practice", "shake")
    names = list(group.coords["damper"].values)
    force = dict(zip(names, value(group, "damper_force").T, strict=True))
    u = dict(zip(names, value(group, "damper_deformation").T, strict=True))
    digits = 1e-5  # float32 in the archive, on the steep side of a law

    oil = np.abs(force["V_1_1"])  # 2 kN s/mm to 60 kN, then 5 % of it: u is the damper's own, without play and brace
    speed = np.abs(np.gradient(u["V_1_1"], 0.005))
    opened = oil > 60e3
    assert opened.any() and np.max(oil) == pytest.approx(60e3 + 0.05 * (2e6 * np.max(speed) - 60e3), rel=0.02)

    k, fy, b, beta = 40e6, 70e3, 0.04, 0.9
    size = np.abs(u["R_2_1"])
    high = np.minimum(k * size, (1.0 - b) * fy + b * k * size)
    low = np.minimum(k * size, (1.0 - b) * (1.0 - beta) * fy + b * k * size)
    flag = force["R_2_1"] * np.sign(u["R_2_1"])
    assert np.all(flag <= high + digits * fy) and np.all(flag >= low - digits * fy)
    assert np.max(flag) > fy

    one_way = force["S_2_2"]
    assert np.max(one_way) / -np.min(one_way) == pytest.approx(
        2.0 * np.sqrt(np.max(np.gradient(u["S_2_2"], 0.005)) / -np.min(np.gradient(u["S_2_2"], 0.005))), rel=0.02
    )

    lead = force["S_3_1"] - 1e6 * u["S_3_1"]
    assert np.max(np.abs(lead)) == pytest.approx(40e3, rel=digits)
    dish = np.abs(force["S_3_2"] - 600e3 / 1.5 * u["S_3_2"])
    assert 0.04 * 600e3 < np.max(dish) < 0.08 * 600e3

    touching = u["N_A0_B1"] > 6e-3
    assert touching.any() and np.all(force["N_A0_B1"][~touching] == 0.0) and np.all(force["N_A0_B1"] >= 0.0)
    closing = np.gradient(u["N_A0_B1"], 0.005)
    expected = 30e6 * (u["N_A0_B1"] - 6e-3) * (1.0 + 0.2 * closing)
    np.testing.assert_allclose(force["N_A0_B1"][touching], expected[touching], atol=0.02 * np.max(expected))
