"""The papers of the house: version numbers that agree, files that parse, links that lead somewhere."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import get_args

import pytest
import yaml

import edesign
from edesign.assess import measures, quantities
from edesign.assess.requirement import MAKERS
from edesign.calibration.dampers.effects import TABLES
from edesign.file_kinds.kinds import YAML_KINDS
from edesign.ground_motion.formats.read import COMPONENT_FORMATS, FORMATS
from edesign.project.criteria.criteria import Criterion
from edesign.project.criteria.criterion_quantities import QUANTITIES
from edesign.project.criteria.measures import MEASURES
from edesign.project.records.records import FileFormat
from edesign.report.check.by_kind import SUMMARIES

ROOT = Path(__file__).parents[3]
PAPERS = (
    "CONTRIBUTING.md",
    "CHANGELOG.md",
    "docs/develop/versioning.md",
    "docs/develop/packaging.md",
    "licences/README.md",
)
NOT_FILES = {"CODE", "NAME", "PACKAGE", "FORMAT", "FILE", "VERSION"}


def text(name: str) -> str:
    return (ROOT / name).read_text(encoding="utf-8")


def test_the_version_is_the_same_everywhere() -> None:
    assert yaml.safe_load(text("CITATION.cff"))["version"] == edesign.__version__
    assert f'return "{edesign.__version__}";' in text("core_c/src/base/status.c")
    assert f"edesign-{edesign.__version__}-cp311" in text("docs/index.md")
    released = re.findall(r"^## \[(\d.+?)\] - \d{4}-\d\d-\d\d$", text("CHANGELOG.md"), re.MULTILINE)
    assert released[0] == edesign.__version__


def test_the_citation_has_what_its_schema_requires() -> None:
    """Source: Citation File Format 1.2.0, required keys; `cffconvert --validate` reads the whole schema."""
    assert {"cff-version", "message", "title", "authors"} <= yaml.safe_load(text("CITATION.cff")).keys()


@pytest.mark.parametrize("path", sorted((ROOT / ".github").rglob("*.yml")), ids=lambda path: path.name)
def test_files_of_the_forge_parse(path: Path) -> None:
    found = yaml.safe_load(path.read_text(encoding="utf-8"))
    assert isinstance(found, dict)
    for job in found.get("jobs", {}).values():
        assert job["timeout-minutes"] and job["runs-on"] and job["steps"]
        for step in job["steps"]:
            assert ("uses" in step) != ("run" in step)


def test_workflows_call_targets_that_are_there() -> None:
    targets = set(re.findall(r"^([\w-]+):", text("Makefile"), re.MULTILINE))
    for workflow in (".github/workflows/test.yml", ".github/workflows/wheels.yml", "CONTRIBUTING.md"):
        for line in text(workflow).splitlines():
            called = re.search(r"(?:run: |^    |^          )make (?:-C \S+ )?([\w-]+)", line)
            assert called is None or called[1] in targets, line


@pytest.mark.parametrize("name", PAPERS)
def test_links_and_files_that_are_named_are_there(name: str) -> None:
    paper = text(name)
    linked = [target for target in re.findall(r"\]\(([^)#]+?)(?:#[^)]*)?\)", paper) if "://" not in target]
    assert [target for target in linked if not (ROOT / name).parent.joinpath(target).exists()] == []
    named = re.findall(r"`((?:edesign|core_c|tests|docs|blind|tools|licences)/[\w./]+)`", paper)
    missing = [path for path in named if not NOT_FILES & set(re.split(r"[/.]", path)) and not (ROOT / path).exists()]
    assert missing == []


def test_contributing_names_what_a_newcomer_must_change() -> None:
    """The lists that it names are those of the code."""
    paper = text("CONTRIBUTING.md")
    assert TABLES and all(f"`{name}`" in paper for name in ("TABLES", "COMPONENT_FORMATS", "FileFormat"))
    assert COMPONENT_FORMATS.keys() <= FORMATS.keys() == set(get_args(FileFormat))


def test_the_recipes_of_a_criterion_and_a_kind_of_file_name_what_is_there() -> None:
    """Every quantity, measure and class of criteria of the project is measured in `assess`, and no other."""
    recipe = re.search(r"\*\*A criterion of a study\.\*\*.*?\n\n", text("CONTRIBUTING.md"), re.DOTALL)
    assert recipe is not None and recipe[0].count("\n") <= 9  # eight lines and an empty one
    names = ("QUANTITIES", "Source", "Measure", "traits", "Criterion", "MAKERS")
    assert [name for name in names if f"`{name}`" not in recipe[0]] == []
    assert measures.SOURCES.keys() == MEASURES.keys()
    assert quantities.SOURCES.keys() <= QUANTITIES.keys()
    computed = {name for name, source in quantities.SOURCES.items() if source.over_time is not None}
    assert computed == {name for name, quantity in QUANTITIES.items() if quantity.over_time}
    of_each_kind, _ = get_args(Criterion)
    assert set(get_args(of_each_kind)) == set(MAKERS)
    assert {"FileKind", "YAML_KINDS", "SUMMARIES"} <= set(re.findall(r"`(\w+)`", text("CONTRIBUTING.md")))
    assert YAML_KINDS and SUMMARIES


def test_contributing_lists_the_layers_that_are_checked() -> None:
    checked = tomllib.loads(text("pyproject.toml"))["tool"]["importlinter"]["contracts"][0]["layers"]
    listed = re.search(r"^    (cli >[^-]*?)\n\n", text("CONTRIBUTING.md"), re.MULTILINE | re.DOTALL)
    assert listed is not None
    reported = [{name.strip() for name in layer.split(",")} for layer in listed[1].split(">")]
    modules = [{name.strip() for name in layer.split("|")} - {"__main__", "_version"} for layer in checked]
    assert reported == [names for names in modules if names]


def test_cibuildwheel_runs_files_of_the_project() -> None:
    config = tomllib.loads(text("pyproject.toml"))["tool"]["cibuildwheel"]
    commands = [*config["test-command"], config["linux"]["before-all"], config["macos"]["before-all"]]
    named = [path for command in commands for path in re.findall(r"\{project\}/(\S+)", command)]
    assert len(named) == 2 and all((ROOT / path).exists() for path in named)
