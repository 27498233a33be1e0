"""The project files that come with edesign: the thesis frame, and the one that `edesign new` writes."""

from __future__ import annotations

import hashlib
from pathlib import Path

import pytest

from edesign.errors import InputError
from edesign.project import load_project, new_project
from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.project.analysis.damping import RayleighDamping
from edesign.project.analysis.integration import NewmarkIntegration
from edesign.project.frame.materials import BilinearMaterial
from edesign.project.reading.base import Model
from edesign.project.records.records import StructdynRecord

THESIS = Path(__file__).parents[3] / "projects" / "thesis_10_storey" / "project.yaml"


def test_thesis_frame_has_the_numbers_of_section_5_2() -> None:
    project = load_project(THESIS)
    frame = project.frame
    assert (frame.n_bays, frame.n_storeys) == (3, 10)
    assert frame.x[-1] == pytest.approx(21.6) and frame.height == pytest.approx(35.0)
    assert len(frame.column_at) == 40 and len(frame.beam_at) == 30 and len(frame.nodes) == 44
    columns = [frame.column_at["A", storey].section for storey in range(1, 11)]  # Table 5.2
    assert columns == ["HEB450"] * 4 + ["HEB360"] * 3 + ["HEB320"] * 3
    beams = [frame.beam_at[1, floor].section for floor in range(1, 11)]
    assert beams == ["IPE450"] * 4 + ["IPE400"] * 3 + ["IPE360"] * 3

    assert project.masses is not None and project.masses.given is not None
    total = sum(item.mass * len(frame.node_places(item.lines, item.floors)) for item in project.masses.given)
    assert total == pytest.approx(10 * (2 * 29500 + 2 * 19350))  # section 5.3.2: interior and corner nodes

    (load,) = project.loads.beams
    assert (load.G, load.Q) == (pytest.approx(23e3), pytest.approx(9.6e3))
    steel = project.materials["S275"]
    assert isinstance(steel, BilinearMaterial)
    assert (steel.E, steel.fy, steel.hardening) == (pytest.approx(210e9), pytest.approx(275e6), 0.0)
    assert isinstance(project.damping, RayleighDamping)
    assert (project.damping.ratio, project.damping.modes, project.damping.stiffness) == (0.02, (1, 2), "current")
    assert isinstance(project.integration, NewmarkIntegration)
    assert (project.integration.time_step, project.integration.tolerance) == (0.01, 1e-7)


def test_thesis_frame_runs_the_real_el_centro_record_unscaled() -> None:
    project = load_project(THESIS)
    assert [analysis.kind for analysis in project.analyses] == ["modal", "gravity", "history", "history", "history"]
    history = project.analyses[2]
    assert isinstance(history, HistoryAnalysis)
    assert history.pga is None and history.scale is None and history.free_vibration == 10.0
    record = project.records[history.record]
    assert isinstance(record, StructdynRecord) and "RSN6" in record.file and "I-ELC180" in record.file
    assert project.archive_path == THESIS.parent / "thesis_bare.h5"
    assert project.checksum == hashlib.sha256(THESIS.read_bytes()).hexdigest()


def test_a_new_project_is_valid_as_it_is(tmp_path: Path) -> None:
    path = new_project(tmp_path / "a" / "b", 'A "first" frame: \\ test')
    project = load_project(path)
    assert path == tmp_path / "a" / "b" / "project.yaml"
    assert project.title == 'A "first" frame: \\ test'
    assert (project.frame.n_bays, project.frame.n_storeys) == (3, 3)
    assert {analysis.kind for analysis in project.analyses} == {"modal", "gravity", "pushover", "history"}


def test_a_new_project_is_named_like_its_folder(tmp_path: Path) -> None:
    assert load_project(new_project(tmp_path / "tower")).title == "tower"


def test_a_new_project_overwrites_nothing(tmp_path: Path) -> None:
    path = new_project(tmp_path, "first")
    before = path.read_bytes()
    with pytest.raises(InputError, match="E-FILE-07"):
        new_project(tmp_path, "second")
    assert path.read_bytes() == before
    with pytest.raises(InputError, match="E-FILE-07"):
        new_project(path, "a file is no folder")


@pytest.mark.parametrize("name", ["", "  ", "two\nlines"])
def test_a_name_is_one_line(tmp_path: Path, name: str) -> None:
    with pytest.raises(InputError, match="E-VALUE-01"):
        new_project(tmp_path, name)
    assert not list(tmp_path.iterdir())


def test_every_key_is_documented() -> None:
    import edesign.project.building.building
    import edesign.project.study.reference
    import edesign.project.study.study
    import edesign.project.substructure.rts_file  # noqa: F401 - so that what is asked does not depend on the other tests

    pages = (
        "project_file",
        "hazard",
        "record_choice",
        "hinges_and_springs",
        "isolation",
        "foundations",
        "wave_passage",
        "study_file",
        "damper_connections",
        "damper_design",
        "viscous_design",
        "hysteretic_design",
        "damper_placement",
        "assessment",
        "incremental",
        "reference_files",
        "building_file",
        "members_under_dampers",
        "restrained_buildings",
        "section_selection",
        "rts_file",
    )
    docs = THESIS.parents[2] / "docs"
    text = "".join(next(docs.rglob(f"{page}.md")).read_text(encoding="utf-8") for page in pages)
    waiting, keys = [Model], set()
    while waiting:
        model = waiting.pop()
        waiting += [kind for kind in model.__subclasses__() if kind.__module__.startswith("edesign.project.")]
        keys |= {field.alias or name for name, field in model.model_fields.items()}
    assert len(keys) > 60
    assert not [key for key in sorted(keys) if f"`{key}`" not in text and f"{key}: " not in text]
