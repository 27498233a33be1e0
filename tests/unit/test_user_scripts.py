"""Scripts of users as editors and type checkers see them: names, signatures, results and wrong arguments."""

from __future__ import annotations

import ast
import os
import subprocess
import sys
from pathlib import Path

import pytest

import edesign

RIGHT = """
import edesign
import edesign.keys

project = edesign.load_project("frame/project.yaml")
changed = project.with_values("materials.S275.fy", "355 MPa")
done = edesign.run_project(changed, "frame.h5", workers=2, progress=lambda report: print(report.fraction))
names = [outcome.name for outcome in done.failed]
with edesign.open_archive(done.archive) as archive:
    drifts = archive.table("analyses_by_storey")["storey_drift_max"]
study = edesign.load_study("frame/study.yaml")
again: edesign.RunSummary = edesign.run_study(study.of(changed), only=["damped.DBE"])
building = edesign.load_building("building.yaml")
elastic = edesign.run_building(building)
passed: bool = elastic.design.passed
chosen = edesign.design_building(building, workers=2)
steel: float = chosen.selection.mass
page = edesign.write_page(chosen.archive)
campaign = edesign.load_campaign("tests/campaign.yaml")
effects = [effect.name for effect in edesign.calibrate(campaign).effects]
fit = edesign.fit_law("mgmm", "tests/campaign.yaml", fixed=["G2"], loss="huber", workers=2)
stiffness: float = fit.values["k"]
target = edesign.elastic_spectrum(edesign.checked_hazard(project), "DBE")
record = edesign.read_record_file("el_centro.AT2")
options = edesign.MatchOptions("scale", periods=(0.2, 2.0))
matched = edesign.match_records({"el_centro": record}, target, options, "matched.h5")
factors = {name: motion.scale for name, motion in matched.motions.items()}
tests = edesign.run_tests(edesign.load_rts_file("rts.yaml"))
outcomes = [run.outcome for result in tests.tests for run in result.runs]
columns = [{"storeys": "all", "section": name, "material": "S275"} for name in ("HEB240",)]
made = edesign.make_project(
    "Portal",
    frame={"storeys": [4.0, "3.5 m"], "bays": [6.0], "columns": columns, "beams": []},
    materials={"S275": {"law": "elastic", "E": 210e9}},
    analyses=[{"name": "modes", "kind": "modal"}],
)
text: str = made.to_yaml("portal.yaml")
runs = [edesign.keys.ColumnRun(storeys="all", section=name, material="S275") for name in ("HEB240", "HEB260")]
frame = edesign.keys.Frame(storeys=[4.0, "3.5 m"], bays={"count": 2, "width": 6.0}, columns=runs, beams=[])
laws: dict[str, edesign.keys.DamperLaw] = {"oil": {"type": "viscous", "parameters": {"c": "1 kN*s/m"}}}
brace: edesign.keys.BraceSection = {"section": "SHS100x5", "material": "S275"}
dampers = edesign.keys.Dampers(laws=laws, devices=[{"kind": "chevron", "bays": 1, "law": "oil", "brace": brace}])
elastic_steel = edesign.keys.ElasticMaterial(law="elastic", E=210e9)
modes = edesign.keys.ModalAnalysis(name="modes", kind="modal")
edesign.make_project("Portal", frame=frame, dampers=dampers, materials={"S275": elastic_steel}, analyses=[modes])
plan = edesign.keys.Plan(x=[6.0, 4.0], y={"count": 2, "width": 5.0})
edesign.make_building("Office", plan=plan, storeys=[3.0], columns=[{"section": "HEB200"}], beams=[], materials={})
sweep = edesign.make_study("Sweep", made, variants={"bare": {"dampers": "none"}}, path="sweep.yaml")
try:
    edesign.check_study(study)
except edesign.InputError as error:
    print(error)
"""
WRONG = {
    'edesign.run_project(edesign.load_project("a.yaml"), worker=2)': "call-arg",
    'edesign.run_project("a.yaml")': "arg-type",
    'edesign.run_study(edesign.load_project("a.yaml"))': "arg-type",
    'edesign.run_project(edesign.load_project("a.yaml")).archives': "attr-defined",
    'edesign.design_building(edesign.load_building("a.yaml"), workers="2")': "arg-type",
    'edesign.fit_law("mgmm", "a.yaml", losses="huber")': "call-arg",
    'edesign.fit_law("mgmm", "a.yaml", loss="hubert")': "arg-type",
    'edesign.MatchOptions("wavelet")': "arg-type",
    'edesign.calibrate("a.yaml").effect': "attr-defined",
    'edesign.open_archive("a.h5").table(3)': "arg-type",
    "edesign.load_projects": "attr-defined",
    'edesign.make_project("a", frame={}, material={}, analyses=[])': "call-arg",
    'edesign.make_project("a", frame=3.0, materials={}, analyses=[])': "arg-type",
    'edesign.make_study("a", "project.yaml", variants={})': "arg-type",
    'edesign.keys.ColumnRun(storeys="all", sectoin="HEB240")': "typeddict-unknown-key",
    'edesign.keys.Frame(columns=[{"storeys": "all", "sectoin": "HEB240"}])': "typeddict-unknown-key",
    'edesign.keys.DamperRun(kind="chevron", brace={"sektion": "SHS100x5"})': "typeddict-item",
    'edesign.keys.Plan(x={"coumt": 2, "width": 5.0})': "typeddict-item",
}


def test_type_checkers_see_the_names_that_are_loaded_later() -> None:
    source = ast.parse(Path(edesign.__file__).read_text(encoding="utf-8"))
    seen = {
        alias.name: node.module
        for block in source.body
        if isinstance(block, ast.If) and ast.unparse(block.test) == "TYPE_CHECKING"
        for node in block.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }
    assert seen == edesign._PLACES
    assert edesign.__all__ == sorted(["__version__", *seen])
    assert (Path(edesign.__file__).parent / "py.typed").is_file()


def test_import_loads_nothing_else() -> None:
    code = "import sys, edesign; print(*(name for name in sys.modules if name.partition('.')[0] in "
    code += "('edesign', 'numpy', 'pydantic', 'h5py', 'matplotlib')))"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert set(found.stdout.split()) == {"edesign", "edesign._version"}


@pytest.mark.slow
def test_mypy_finds_each_wrong_argument_and_passes_right_ones(tmp_path: Path) -> None:
    right, wrong = tmp_path / "right.py", tmp_path / "wrong.py"
    right.write_text(RIGHT)
    wrong.write_text("import edesign, edesign.keys\n" + "\n".join(WRONG) + "\n")
    config = tmp_path / "mypy.ini"  # a user has none: without this mypy would take that of the repository
    config.write_text("[mypy]\n")
    command = [sys.executable, "-m", "mypy", "--strict", "--no-pretty", "--no-error-summary", "--hide-error-context"]
    command += ["--config-file", str(config), "--cache-dir", str(tmp_path / "cache"), str(right), str(wrong)]
    # on the path of Python, mypy takes the package as an installed one, and tells the faults of the script alone
    installed = {**os.environ, "PYTHONPATH": str(Path(edesign.__file__).parent.parent)}
    found = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, env=installed)
    errors = [line.partition("wrong.py:")[2] for line in found.stdout.splitlines() if ": error: " in line]
    assert [f"{error.partition(':')[0]} {error.rpartition('[')[2].rstrip(']')}" for error in errors] == [
        f"{line} {code}" for line, code in enumerate(WRONG.values(), start=2)
    ], found.stdout


def test_jedi_completes_names_results_and_arguments() -> None:
    jedi = pytest.importorskip("jedi")
    project = jedi.Project(Path(edesign.__file__).parent.parent)

    def at_end(code: str) -> object:
        return jedi.Script(code, project=project)

    completed = {found.name: found for found in at_end("import edesign\nedesign.").complete()}
    assert set(edesign.__all__) - {"__version__"} <= set(completed)
    assert completed["run_study"].docstring().partition("\n\n")[2].startswith("Make the designs of a study")
    script = 'import edesign\ndone = edesign.run_project(edesign.load_project("a.yaml"))\ndone.'
    assert {"archive", "outcomes", "failed", "seconds"} <= {found.name for found in at_end(script).complete()}
    (signature,) = at_end("import edesign\nedesign.design_building(").get_signatures()
    assert [one.name for one in signature.params] == ["building", "output", "overwrite", "workers", "progress"]
    assert "Choose the lightest sections" in signature.docstring()
