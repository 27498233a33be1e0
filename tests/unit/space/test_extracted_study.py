"""The study that `edesign extract --study` writes: it is read as it stands, and says what the building says."""

from __future__ import annotations

from pathlib import Path

import pytest
from building_examples import SMALL
from typer.testing import CliRunner

from edesign.cli.main import app
from edesign.codes.ec8.action.ground import ground_type
from edesign.errors import InputError
from edesign.frame.project_file import load_study
from edesign.ground_motion.sources import find_suite
from edesign.ground_motion.suite import load_suite
from edesign.project.criteria.criteria import QuantityCriterion
from edesign.project.dampers.designs import StrainEnergyDesign
from edesign.project.study.study import Study
from edesign.study.check.summary import check_study
from edesign.study.plan.study_plan import verifying_histories


def extract(folder: Path, text: str, *more: str, frame: str = "X2") -> str:
    """Run the command in a folder; returns what it prints."""
    (folder / "building.yaml").write_text(text, encoding="utf-8")
    names = ["-o", str(folder / "frame.yaml"), "--study", str(folder / "study.yaml")]
    done = CliRunner().invoke(app, ["extract", str(folder / "building.yaml"), "--frame", frame, *names, *more])
    return done.output if done.exit_code == 0 else f"{done.exception or ''}{done.output}"


def study_of(folder: Path, text: str, *more: str) -> Study:
    said = extract(folder, text, *more)
    assert "study.yaml written" in said, said
    return load_study(folder / "study.yaml")


def test_the_study_is_that_of_the_building(tmp_path: Path) -> None:
    """Limit of ductile partitions 0.75 %, nu 0.5: 1.5 % at the level of the design; a second level is judged too."""
    two = SMALL.replace("{DBE: {probability: 10 %}}", "{DBE: {probability: 10 %}, MCE: {return_period: 2475 year}}")
    study = study_of(tmp_path, two.replace("  ductility_class", "  level: DBE\n  ductility_class"))
    drift, residual, *uses = study.criteria
    assert (drift.most, residual.most) == (pytest.approx(0.015), pytest.approx(0.005))
    assert [(of.quantity, of.of, of.most) for of in uses if isinstance(of, QuantityCriterion)] == [
        ("section_use", "not_dissipative", 1.0),
        ("member_use", "not_dissipative", 1.0),
    ]
    assert [of.source for of in study.criteria] == [
        "EN 1998-1, 4.4.3.2",
        "FEMA P-58-1, Appendix C, damage state 2",
        "EN 1993-1-1, 6.2",
        "EN 1993-1-1, 6.3",
    ]
    columns = [name for name in study.base.grid.members if not study.base.dissipative(name)]
    assert columns and {name[0] for name in columns} == {"C"}  # all beams of the moment frame are to yield
    assert study.objectives == ("h", "l")
    design = study.designs["dampers"]
    assert isinstance(design, StrainEnergyDesign) and design.verify is not None
    assert design.bays.numbers(1, 2) == (1, 2) and design.verify.levels == ("DBE",)
    assert study.base.damping is not None and study.base.integration is not None


_EC8 = SMALL[SMALL.index("hazard:") : SMALL.index("design:")]
_STATES = {
    "SLO": "a_g: 0.079 g, F_0: 2.4, T_C_star: 0.272 s",
    "SLD": "a_g: 0.104 g, F_0: 2.332, T_C_star: 0.281 s",
    "SLV": "a_g: 0.261 g, F_0: 2.364, T_C_star: 0.347 s",
    "SLC": "a_g: 0.334 g, F_0: 2.4, T_C_star: 0.364 s",
}


def ntc(use: str = "II", without: str = "") -> str:
    """The building by NTC 2018 on ground B."""
    levels = ", ".join(f"{name}: {{limit_state: {name}, {of}}}" for name, of in _STATES.items() if name != without)
    hazard = f"{{code: ntc-2018, nominal_life: 50 years, class_of_use: {use}, ground: B, levels: {{{levels}}}}}"
    text = SMALL.replace(_EC8, f"hazard: {hazard}\n")
    return text.replace("  ductility_class", "  code: {seismic: ntc-2018}\n  ductility_class")


def test_the_study_of_a_building_by_ntc_2018(tmp_path: Path) -> None:
    """Drifts are those of SLD, 0.75 % (7.3.6.1); each limit state has motions fitted to its own spectrum.

    Layers are for the drift under SLV. S_De goes with a_g S_S F_0 T_C, T_C = 1.1 (T_C*)^0.8 on ground B:
    SLV: S_S = 1.4 - 0.4 x 2.364 x 0.261 = 1.1532, T_C = 0.47164 s: 0.261 x 1.1532 x 2.364 x 0.47164 = 0.33558
    SLD: S_S = 1.2 at most,                        T_C = 0.39844 s: 0.104 x 1.2 x 2.332 x 0.39844 = 0.11596
    so that 0.75 % under SLD is 0.75 % x 2.8940 = 2.1705 % under SLV (1e-3: the figures above have five digits).
    SLC: S_S = 1.4 - 0.4 x 2.4 x 0.334 = 1.0794,   T_C = 0.49006 s: 0.334 x 1.0794 x 2.4 x 0.49006 = 0.42402
    so that layers have 0.42402 / 0.33558 = 1.26 times the strain of SLV under SLC, far below the 50 % that they bear.
    """
    study = study_of(tmp_path, ntc())
    drift, residual, *_ = study.criteria
    assert (drift.levels, drift.most, drift.statistic) == (("SLD",), pytest.approx(0.0075), "code")
    assert residual.levels == ("SLV",) and study.objectives == () and drift.source == "NTC 2018, 7.3.6.1"
    design = study.designs["dampers"]
    assert isinstance(design, StrainEnergyDesign) and design.verify is not None
    assert design.level == "SLV" and design.drift == pytest.approx(0.021705, rel=1e-3)
    assert {of.levels: of.records for of in study.histories} == {(name,): (f"motions_{name}",) for name in _STATES}
    assert {name: study.base.fitted_level(f"motions_{name}") for name in _STATES} == {n: n for n in _STATES}
    proofs = [(spec.level, spec.record.partition("/")[0]) for spec in verifying_histories(study, "dampers", 1)]
    assert sorted(proofs) == [("SLD", "motions_SLD")] * 7 + [("SLV", "motions_SLV")] * 7
    assert "thicker than they need to be: under 1.26 times SLV (SLC at T = " in check_study(study)["warnings"]


def test_drifts_of_strategic_buildings_are_those_of_slo(tmp_path: Path) -> None:
    """Two thirds of 0.75 % under SLO (7.3.6.1)."""
    drift = study_of(tmp_path, ntc("IV")).criteria[0]
    assert drift.levels == ("SLO",) and drift.most == pytest.approx(0.005)


@pytest.mark.parametrize("state", ["SLD", "SLV"])
def test_a_limit_state_that_is_missing(tmp_path: Path, state: str) -> None:
    text = ntc(without=state)
    output = extract(tmp_path, text[: text.index("design:")])
    assert f"a study needs a level with `limit_state: {state}`" in output and "[E-HAZ-06]" in output


@pytest.mark.parametrize(
    ("new", "said"),
    [
        ("records: motions_SLD, levels: [SLD, SLV]", "no record here is fitted to the spectrum of `SLV`, only to that"),
        ("records: [motions_SLD, motions_SLV], levels: SLV", "`motions_SLD` is fitted to the spectrum of `SLD`"),
    ],
)
def test_records_of_a_verification_are_at_their_own_level(tmp_path: Path, new: str, said: str) -> None:
    study_of(tmp_path, ntc())
    path = tmp_path / "study.yaml"
    old = "records: [motions_SLD, motions_SLV], levels: [SLD, SLV]"
    path.write_text(path.read_text(encoding="utf-8").replace(old, new), encoding="utf-8")
    with pytest.raises(InputError, match=said):
        load_study(path)


@pytest.mark.parametrize("storey", [1, 2])
def test_a_bay_without_a_beam_has_no_dampers(tmp_path: Path, storey: int) -> None:
    """Of the two bays of X2 the second lacks its beam at one floor."""
    gone = f"missing: {{beams: [{{along: x, frames: 2, bays: 2, floors: {storey}}}]}}\nmaterials: {{"
    design = study_of(tmp_path, SMALL.replace("materials: {", gone, 1)).designs["dampers"]
    assert isinstance(design, StrainEnergyDesign) and design.bays.numbers(1, 2) == (1,)


def test_motions_are_simulated_for_the_ground_until_recordings_are_named(tmp_path: Path) -> None:
    """Ground B: 360 to 800 m/s. Of seven motions the mean counts; their peaks need no factor above 3."""
    study_of(tmp_path, SMALL)
    suite = load_suite(tmp_path / "study_records.yaml")
    found = find_suite(suite, [])
    assert [one.origin for one in found] == ["simulated"] * 7
    low, high = ground_type("B").v_s30 or (0.0, 0.0)
    assert all(low < (entry.simulated.v_s30 if entry.simulated else 0.0) < high for entry in suite.records)
    peaks = [float(abs(one.record.acceleration).max()) for one in found]
    assert all(1 / 3 < 0.24 * 9.81 * 1.2 / peak < 3 for peak in peaks)


def test_recordings_and_drift_of_the_command(tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    study = study_of(tmp_path, SMALL, "--recordings", str(tmp_path / "mine"), "--drift", "1 %")
    assert study.criteria[0].most == pytest.approx(0.01) and study.criteria[0].source is None
    assert 'folders: ["mine"]' in study.base.text or "folders: [mine]" in study.base.text


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("masses: {from_loads: {}}\n", "", "a study needs `masses`"),
        (
            "hazard: {code: ec8-2004, a_gR: 0.24 g, ground: B, spectrum: 1, levels: {DBE: {probability: 10 %}}}\n",
            "",
            "a study needs a `hazard` with `levels`",
        ),
        (
            "  - {along: y, frames: [A, C]",
            "  - {along: x, frames: 2, bays: all, kind: cross, section: CHS101.6x5, material: S275}\n"
            "  - {along: y, frames: [A, C]",
            "[E-SPACE-06]",
        ),
    ],
)
def test_what_a_study_needs(tmp_path: Path, old: str, new: str, said: str) -> None:
    output = extract(tmp_path, SMALL[: SMALL.index("design:")].replace(old, new))
    assert said in output and not (tmp_path / "frame.yaml").exists()


@pytest.mark.parametrize(
    ("more", "said"),
    [
        (["--recordings", "nowhere"], "--recordings: there is no folder `nowhere`"),
        (["--drift", "0.5 m"], "--drift: `0.5 m` has the unit `m`"),
        (["--drift", "-1 %"], "--drift: `-1 %` is out of range"),
    ],
)
def test_options_that_are_wrong(tmp_path: Path, more: list[str], said: str) -> None:
    assert said in extract(tmp_path, SMALL, *more)


def test_options_of_a_study_without_one(tmp_path: Path) -> None:
    (tmp_path / "building.yaml").write_text(SMALL, encoding="utf-8")
    arguments = ["extract", str(tmp_path / "building.yaml"), "--frame", "X2", "-o", str(tmp_path / "frame.yaml")]
    done = CliRunner().invoke(app, [*arguments, "--drift", "1 %"])
    assert done.exit_code != 0 and "give --study FILE too" in f"{done.exception}{done.output}"
