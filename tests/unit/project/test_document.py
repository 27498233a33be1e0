"""What the cover of a report says: read from every kind of file, refused where it is no such thing."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from messages import says

from edesign.calibration.properties.campaign import load_property_campaign
from edesign.calibration.structures.campaign import load_structure_campaign
from edesign.damper.testing.campaign import load_campaign
from edesign.errors import InputError
from edesign.project import load_project
from edesign.project.building import load_building
from edesign.project.document import LONGEST, Document
from edesign.project.study.study_loader import load_study
from edesign.project.substructure import load_rts_file

PROJECTS = Path(__file__).parents[3] / "projects"
BLOCK = """\
document:
  client: Municipality of Chania
  project_number: "0123"
  author: A. Petrou
  checker: B. Ioannou
  revision: "02"
  date: 2026-03-31
  notes: |
    For approval.
    Not for construction.
"""
SAID = {
    "client": "Municipality of Chania",
    "project_number": "0123",
    "author": "A. Petrou",
    "checker": "B. Ioannou",
    "revision": "02",
    "date": "2026-03-31",
    "notes": "For approval.\nNot for construction.\n",
}
FILES = (
    (load_project, "thesis_10_storey/project.yaml"),
    (load_study, "thesis_10_storey/study.yaml"),
    (load_building, "office_6_storeys/building.yaml"),
    (load_rts_file, "thesis_substructure/one_storey.yaml"),
)


@pytest.fixture(scope="module")
def projects(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of the projects that come with edesign, each file with the block at its end."""
    folder = tmp_path_factory.mktemp("document") / "projects"
    shutil.copytree(PROJECTS, folder, ignore=shutil.ignore_patterns("*.h5*", "*.html"))
    for _, file in FILES:
        path = folder / file
        path.write_text(path.read_text(encoding="utf-8") + "\n" + BLOCK, encoding="utf-8")
    return folder


@pytest.mark.parametrize(("load", "file"), FILES)
def test_files_say_whose_the_document_is(load: Callable[[Path], Any], file: str, projects: Path) -> None:
    assert dict(load(projects / file).document.said) == SAID


@pytest.mark.parametrize("load", [load_campaign, load_structure_campaign, load_property_campaign])
def test_campaigns_know_the_block(load: Callable[[Path], Any], tmp_path: Path) -> None:
    """Their readers name the key that is misspelt, and nothing of the block itself."""
    path = tmp_path / "campaign.yaml"
    path.write_text("document: {clients: A}\n", encoding="utf-8")
    with pytest.raises(InputError, match="document.clients.*`client`.*E-KEY-01") as caught:
        load(path)
    assert "document: unknown" not in str(caught.value)


def test_a_study_says_it_over_its_project() -> None:
    project = Document(client="A", revision="1", notes="of the project")
    assert dict(Document(revision="2", author="B").over(project).said) == {
        "client": "A",
        "author": "B",
        "revision": "2",
        "notes": "of the project",
    }
    assert Document().over(project) == project


@pytest.mark.parametrize(
    ("wrong", "reported"),
    [
        ("{autor: A. Petrou}", "document.autor `author` E-KEY-01"),
        ("{revision: 2}", "document.revision E-VALUE-01"),
        ("{project_number: 0123}", "document.project_number E-VALUE-01"),
        ("{date: 31.03.2026}", "document.date E-VALUE-01"),
        ("{date: 2026-02-30}", "document.date E-VALUE-01"),
        ('{date: "20260331"}', "document.date E-VALUE-01"),
        ('{client: "  "}', "document.client E-VALUE-01"),
        ('{client: "A\\nB"}', "document.client E-VALUE-01"),
        (f"{{client: {'x' * (LONGEST + 1)}}}", f"document.client {LONGEST} E-VALUE-01"),
        ("Chania", "document E-VALUE-01"),
    ],
)
def test_what_is_no_document_is_refused(wrong: str, reported: str, projects: Path) -> None:
    path = projects / "thesis_10_storey" / "wrong.yaml"
    text = (PROJECTS / "thesis_10_storey" / "project.yaml").read_text(encoding="utf-8")
    path.write_text(f"{text}\ndocument: {wrong}\n", encoding="utf-8")
    with pytest.raises(InputError) as caught:
        load_project(path)
    assert says(str(caught.value), reported)
    assert f"{path}:" in str(caught.value)
