"""What identifies a run: everything that its results depend on, in the state in which it was used."""

from __future__ import annotations

import pickle
import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import edesign
from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.damper.testing.property_table import write_property_table
from edesign.damper.thesis_tables import measured
from edesign.errors import InputError
from edesign.frame.project_file import load_project, load_study
from edesign.ground_motion.record import Record
from edesign.project.project import Project
from edesign.study.analysis.dampers import device_laws
from edesign.study.check.check import check_study_inputs
from edesign.study.check.summary import check_project
from edesign.study.plan.study_plan import make_study_plan
from edesign.study.results import provenance
from edesign.study.results.provenance import IDENTITY, root_group, study_root_group
from edesign.study.run.progress import Progress
from edesign.study.run.run import run_project, run_study

PROJECT = """\
edesign: 1
title: Portal with a damper
frame:
  bays: [6 m]
  storeys: [3.5 m]
  columns: [{storeys: all, section: HEB260, material: S275}]
  beams: [{floors: all, section: IPE360, material: S275}]
materials:
  S275: {law: elastic, E: 210 GPa}
masses: {given: [{lines: all, floors: all, mass: 20 t}]}
dampers:
  laws:
    tested: {file: laws/tested.yaml}
  devices: [{kind: storey, bays: 1, storeys: 1, law: tested}]
analyses:
  - {name: first, kind: modal, modes: 1, damper_deformation: 3 mm}
  - {name: second, kind: modal, modes: 1, damper_deformation: 3 mm}
"""
LAW = """\
type: kelvin_voigt
parameters: {k: 3 kN/mm, c: 0.2 kN*s/mm}
prototype: {layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}
"""
STIFFER = LAW.replace("3 kN/mm", "9 kN/mm")
STUDY = """\
edesign_study: 1
title: A design
project: project.yaml
designs:
  sized:
    method: strain_energy
    law: tested
    damping: 15 %
    strain: 50 %
    kind: storey
    bays: 1
    layer_thickness: 12 mm
    properties: {file: moduli.csv}
variants:
  damped: {design: sized}
"""


@pytest.fixture
def project(tmp_path: Path) -> Project:
    (tmp_path / "laws").mkdir()
    (tmp_path / "laws/tested.yaml").write_text(LAW)
    (tmp_path / "project.yaml").write_text(PROJECT)
    return load_project(tmp_path / "project.yaml")


def identity(project: Project, records: dict[str, str] | None = None) -> dict[str, object]:
    attributes = root_group(project.afresh(), ["first"], records or {}).attributes
    return {name: attributes[name] for name in IDENTITY}


def sample(scale: float = 1.0, step: float = 0.01) -> dict[str, str]:
    return {"wave": Record("wave", scale * np.sin(np.arange(100.0)), step, "here").checksum}


def change_value(project: Project, monkeypatch: pytest.MonkeyPatch) -> dict[str, object]:
    return identity(project.with_values("frame.columns[0].section", "HEB280"), sample())


def change_law_file(project: Project, monkeypatch: pytest.MonkeyPatch) -> dict[str, object]:
    (project.folder / "laws/tested.yaml").write_text(STIFFER)
    return identity(project, sample())


def change_sample(project: Project, monkeypatch: pytest.MonkeyPatch) -> dict[str, object]:
    return identity(project, sample(1.0 + 1e-15))


def change_time_step(project: Project, monkeypatch: pytest.MonkeyPatch) -> dict[str, object]:
    return identity(project, sample(step=0.02))


def change_records(project: Project, monkeypatch: pytest.MonkeyPatch) -> dict[str, object]:
    return identity(project, {"other": sample()["wave"]})


def change_numpy(project: Project, monkeypatch: pytest.MonkeyPatch) -> dict[str, object]:
    monkeypatch.setattr(provenance.np, "__version__", "0.0")
    return identity(project, sample())


def change_processor(project: Project, monkeypatch: pytest.MonkeyPatch) -> dict[str, object]:
    monkeypatch.setattr(provenance.platform, "machine", lambda: "abacus")
    return identity(project, sample())


def change_package(place: str) -> Callable[[Project, pytest.MonkeyPatch], dict[str, object]]:
    def change(project: Project, monkeypatch: pytest.MonkeyPatch) -> dict[str, object]:
        copy = project.folder / "edesign"
        shutil.copytree(Path(edesign.__file__).parent, copy, ignore=shutil.ignore_patterns("__pycache__"))
        monkeypatch.setattr(provenance.edesign, "__file__", str(copy / "__init__.py"))
        same = identity(project, sample())
        with next(copy.glob(place)).open("a") as file:
            file.write("\n")
        assert identity(project, sample()) != same
        return identity(project, sample())

    change.__name__ = place
    return change


CHANGES = (
    change_value,
    change_law_file,
    change_sample,
    change_time_step,
    change_records,
    change_numpy,
    change_processor,
    change_package("study/run/run.py"),
    change_package("frame/sections/data/profiles.csv"),
    change_package("damper/data/parameter_sets.yaml"),
    change_package("codes/ec8/data/*.yaml"),  # national parameters
)


@pytest.mark.parametrize("change", CHANGES, ids=lambda change: change.__name__)
def test_results_of_other_inputs_are_not_reused(
    project: Project,
    change: Callable[[Project, pytest.MonkeyPatch], dict[str, object]],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
) -> None:
    path = tmp_path / "archive.h5"
    same = identity(project, sample())
    with ArchiveWriter(path, Group(attributes=same), IDENTITY) as writer:
        writer.write("analyses/first", Group(attributes={"status": "completed"}))
    with ArchiveWriter(path, Group(attributes=identity(project, sample())), IDENTITY, lambda *_: True) as writer:
        assert writer.kept == ("analyses/first",)
    other = change(project, monkeypatch)
    with ArchiveWriter(path, Group(attributes=other), IDENTITY, lambda *_: True) as writer:
        assert writer.kept == () and "); starting afresh" in writer.note


def test_a_changed_copy_is_neither_run_nor_checked(project: Project) -> None:
    steel = project.materials["S275"].model_copy(update={"E": 100e9})
    changed = project.model_copy(update={"materials": {"S275": steel}})
    for call in (run_project, check_project):
        with pytest.raises(InputError, match=r"materials\.S275\.E: .*with_values.*E-EDIT-01"):
            call(changed)
    assert not list(project.folder.glob("*.h5*"))


def test_text_checksum_and_results_are_of_the_values_that_run(project: Project, tmp_path: Path) -> None:
    periods, checksums = {}, set()
    bare = [{"name": "first", "kind": "modal", "modes": 1}]
    for name, modulus in (("stiff", "210 GPa"), ("soft", "105 GPa")):
        changed = project.with_values({"materials.S275.E": modulus, "dampers": {}, "analyses": bare})
        with open_archive(run_project(changed, tmp_path / f"{name}.h5").archive) as archive:
            periods[name] = archive.group("analyses/first").variables["period"].values[0]
            text = str(archive.group().variables["project_text"].values)
            checksums.add(archive.attributes["input_checksum"])
        again = tmp_path / f"{name}.yaml"
        again.write_text(text)
        assert load_project(again).materials["S275"].E == changed.materials["S275"].E
    assert len(checksums) == 2
    # an elastic frame: stiffness as E, period as its inverse root; the error of the eigenvalues is far below 1e-9
    np.testing.assert_allclose(periods["soft"] / periods["stiff"], np.sqrt(2.0), rtol=1e-9)


def test_a_run_sees_one_state_of_a_law_file(project: Project) -> None:
    file = project.folder / "laws/tested.yaml"

    def change(report: Progress) -> None:
        if report.event == "end" and report.analysis == "first":
            file.write_text(STIFFER)

    with open_archive(run_project(project, progress=change, backend="serial").archive) as archive:
        first, second = (archive.group(f"analyses/{name}").variables["period"].values for name in ("first", "second"))
        np.testing.assert_array_equal(first, second)
        assert str(archive.group().variables["law_text_tested"].values) == LAW
        before = archive.attributes["input_checksum"]
    with open_archive(run_project(project).archive) as archive:  # the next run sees the new state
        assert str(archive.group().variables["law_text_tested"].values) == STIFFER
        assert archive.attributes["input_checksum"] != before
        assert archive.group("analyses/first").variables["period"].values[0] < first[0]


def test_workers_need_no_law_file(project: Project) -> None:
    here = device_laws(project)
    travelled = pickle.loads(pickle.dumps(project))
    shutil.rmtree(project.folder / "laws")
    assert device_laws(travelled) == here


def test_tables_and_texts_of_a_study_count(project: Project) -> None:
    folder = project.folder
    write_property_table(measured(), folder / "moduli.csv")
    (folder / "study.yaml").write_text(STUDY)

    def root(name: str = "study.yaml") -> Group:
        study = load_study(folder / name)
        check_study_inputs(study, make_study_plan(study))
        return study_root_group(study, [], {})

    first = root()
    table = (folder / "moduli.csv").read_text()
    assert str(first.variables["properties_text_sized"].values) == table
    (folder / "moduli.csv").write_text(table.replace("\n", "\n# measured again\n", 1))
    (folder / "other.yaml").write_text(STUDY.replace("A design", "Another"))
    checksums = {str(one.attributes["input_checksum"]) for one in (first, root(), root("other.yaml"))}
    (folder / "project.yaml").write_text(PROJECT.replace("HEB260", "HEB280"))
    checksums.add(str(root().attributes["input_checksum"]))
    (folder / "laws/tested.yaml").write_text(STIFFER)
    checksums.add(str(root().attributes["input_checksum"]))
    assert len(checksums) == 5

    study = load_study(folder / "study.yaml")
    for changed in (
        study.model_copy(update={"title": "Another"}),
        study.model_copy().set_base(study.base.model_copy(update={"title": "Another"})),
    ):
        with pytest.raises(InputError, match="title.*E-EDIT-01"):
            run_study(changed)
